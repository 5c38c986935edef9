#pragma once
#include <string>
#include <string_view>

namespace flowslide::study {

/// A drawing as text. Colours are classes, so that a page can give them for light and dark.
class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  void line(double x1, double y1, double x2, double y2, std::string_view kind);
  void circle(double x, double y, double radius, std::string_view kind,
              std::string_view title = "");
  void rectangle(double x, double y, double width, double height, std::string_view kind,
                 std::string_view title = "");
  /// `points` as "x,y x,y ...".
  void polyline(const std::string& points, std::string_view kind);
  void polygon(const std::string& points, std::string_view kind);
  /// anchor: start, middle, end; turned: read from below.
  void text(double x, double y, std::string_view text, std::string_view anchor = "middle",
            std::string_view kind = "label", bool turned = false);

  /// To be put into a page; `title` is for those who cannot see it.
  [[nodiscard]] std::string inside_page(std::string_view title) const;
  /// A file of its own.
  [[nodiscard]] std::string alone(std::string_view title) const;

 private:
  double width_, height_;
  std::string body_;
};

/// "12.5": at most a tenth of a pixel counts.
std::string pixels(double value);

}  // namespace flowslide::study

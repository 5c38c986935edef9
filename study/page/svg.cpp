#include "study/page/svg.hpp"

#include "core/xml_text.hpp"

#include <fmt/format.h>

namespace flowslide::study {
namespace {

constexpr std::string_view kChartStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#444}.head{font-weight:600;fill:#222}"
    ".axis{stroke:#888}.grid{stroke:#e6e6e6}.bar{stroke:#888}.fit{stroke:#c2410c;fill:none;"
    "stroke-width:2}.curve{stroke:#1d4ed8;fill:none;stroke-width:2}.band{fill:#1d4ed822;stroke:none}"
    ".s0{fill:#1d4ed8}.s1{fill:#c2410c}.s2{fill:#15803d}.s3{fill:#7e22ce}.s4{fill:#a16207}"
    ".f0{stroke:#1d4ed8}.f1{stroke:#c2410c}.f2{stroke:#15803d}.f3{stroke:#7e22ce}"
    ".f4{stroke:#a16207}.f5{stroke:#0e7490}.s5{fill:#0e7490}circle{fill-opacity:.75}.low{fill:#0e7490}.high{fill:#c2410c}</style>"
    "<rect width='100%' height='100%' fill='#fff'/>";

}  // namespace

std::string pixels(double value) { return fmt::format("{:.1f}", value); }

void Svg::line(double x1, double y1, double x2, double y2, std::string_view kind) {
  body_ += fmt::format("<line x1='{}' y1='{}' x2='{}' y2='{}' class='{}'/>", pixels(x1), pixels(y1),
                       pixels(x2), pixels(y2), kind);
}

void Svg::circle(double x, double y, double radius, std::string_view kind, std::string_view title) {
  body_ += fmt::format("<circle cx='{}' cy='{}' r='{}' class='{}'><title>{}</title></circle>",
                       pixels(x), pixels(y), pixels(radius), kind, xml_text(title));
}

void Svg::rectangle(double x, double y, double width, double height, std::string_view kind,
                    std::string_view title) {
  body_ +=
      fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class='{}'><title>{}</title></rect>",
                  pixels(x), pixels(y), pixels(width), pixels(height), kind, xml_text(title));
}

void Svg::polyline(const std::string& points, std::string_view kind) {
  body_ += fmt::format("<polyline points='{}' class='{}'/>", points, kind);
}

void Svg::polygon(const std::string& points, std::string_view kind) {
  body_ += fmt::format("<polygon points='{}' class='{}'/>", points, kind);
}

void Svg::text(double x, double y, std::string_view text, std::string_view anchor,
               std::string_view kind, bool turned) {
  const std::string turn =
      turned ? fmt::format(" transform='rotate(-90 {} {})'", pixels(x), pixels(y)) : "";
  body_ += fmt::format("<text x='{}' y='{}' text-anchor='{}' class='{}'{}>{}</text>", pixels(x),
                       pixels(y), anchor, kind, turn, xml_text(text));
}

std::string Svg::inside_page(std::string_view title) const {
  return fmt::format("<svg viewBox='0 0 {} {}' role='img' aria-label='{}'>{}</svg>", pixels(width_),
                     pixels(height_), xml_text(title), body_);
}

std::string Svg::alone(std::string_view title) const {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}' "
      "role='img' aria-label='{2}'>{3}{4}</svg>\n",
      pixels(width_), pixels(height_), xml_text(title), kChartStyle, body_);
}

}  // namespace flowslide::study

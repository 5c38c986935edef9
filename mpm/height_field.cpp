#include "mpm/height_field.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>

namespace flowslide::mpm {
namespace {

/// A node and how far the place lies from it towards the next [spacings].
struct Cell {
  int column, row;
  double right, up;
};

Cell find_cell(const HeightField& f, double x, double y) {
  const double c = std::cos(f.place.heading), s = std::sin(f.place.heading);
  const double east = f.place.origin[0] + c * x - s * y;
  const double north = f.place.origin[1] + s * x + c * y;
  const double i = std::clamp((east - f.corner[0]) / f.spacing, 0.0, f.columns - 1.0);
  const double j = std::clamp((north - f.corner[1]) / f.spacing, 0.0, f.rows - 1.0);
  const int column = std::min(static_cast<int>(i), f.columns - 2);
  const int row = std::min(static_cast<int>(j), f.rows - 2);
  return {column, row, i - column, j - row};
}

/// Words of a text file with the lines they stand on.
class GridFile {
 public:
  explicit GridFile(const std::filesystem::path& path)
      : name_(path.filename().string()), in_(path) {
    if (!in_ || std::filesystem::is_directory(path))
      throw FileError(fmt::format("{}: cannot be opened (no such file, or no right to read it)",
                                  path.string()));
  }
  /// Words of the next line that has any; false at the end of the file.
  bool next() {
    words_.clear();
    while (words_.empty() && std::getline(in_, text_)) {
      ++line_;
      const std::string_view text = text_;
      for (std::size_t at = 0; at < text.size();) {
        const std::size_t first = text.find_first_not_of(" \t\r", at);
        if (first == std::string_view::npos) break;
        at = std::min(text.find_first_of(" \t\r", first), text.size());
        words_.push_back(text.substr(first, at - first));
      }
    }
    return !words_.empty();
  }
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::string place() const { return fmt::format("{}:{}", name_, line_); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] double number(std::string_view word) const {
    double value = kUnset;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    validate(error == std::errc{} && end == word.data() + word.size() && std::isfinite(value),
             "{}: '{}' is not a finite number (heights are plain numbers) mark missing ones with "
             "the nodata_value of the header",
             place(), word.substr(0, 40));
    return value;
  }

 private:
  std::string name_;
  std::ifstream in_;
  std::string text_;
  std::vector<std::string_view> words_;
  int line_ = 0;
};

std::string lower(std::string_view word) {
  std::string out(word);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

struct Header {
  int columns = 0, rows = 0;
  double spacing = kUnset;
  std::array<double, 2> corner{kUnset, kUnset};  ///< middle of the lowest cell on the left
  std::optional<double> no_data;
};

constexpr int kFewest = 2, kMost = 100000;

/// Reads up to the first row of heights, whose words are left in the file's line.
Header read_header(GridFile& file) {
  std::map<std::string, double> value;
  bool more = file.next();
  for (; more && std::isalpha(static_cast<unsigned char>(file.words()[0][0])); more = file.next()) {
    const std::string key = lower(file.words()[0]);
    if (key == "nan" || key == "inf") break;
    static constexpr std::array<std::string_view, 8> known{"ncols",     "nrows",       "xllcorner",
                                                           "yllcorner", "xllcenter",   "yllcenter",
                                                           "cellsize",  "nodata_value"};
    validate(std::find(known.begin(), known.end(), key) != known.end() && file.words().size() == 2,
             "{}: '{}' is no line of the header of an ESRI ASCII grid (it has ncols, nrows, "
             "xllcorner, yllcorner, cellsize and nodata_value, each with one number) export the "
             "terrain as Arc/Info ASCII grid with square cells",
             file.place(), file.words()[0].substr(0, 40));
    validate(value.emplace(key, file.number(file.words()[1])).second,
             "{}: {} is given twice (only one can hold) remove one", file.place(), key);
  }
  const auto need = [&](const char* key, const char* other = nullptr) {
    if (other && value.count(other)) return value.at(other);
    validate(value.count(key) > 0,
             "{}: the header has no {} (an ESRI ASCII grid needs it) export the terrain anew",
             file.name(), key);
    return value.at(key);
  };
  Header h;
  const double columns = need("ncols"), rows = need("nrows");
  for (const double n : {columns, rows})
    validate(n >= kFewest && n <= kMost && n == std::floor(n),
             "{}: ncols and nrows are {:g} and {:g} (whole numbers from {} to {} are read) check "
             "the header",
             file.name(), columns, rows, kFewest, kMost);
  h.columns = static_cast<int>(columns);
  h.rows = static_cast<int>(rows);
  h.spacing = need("cellsize");
  validate(h.spacing > 0.0, "{}: cellsize is {:g} (it is a length) check the header", file.name(),
           h.spacing);
  const bool centre_x = value.count("xllcenter") > 0, centre_y = value.count("yllcenter") > 0;
  h.corner = {need("xllcorner", "xllcenter") + (centre_x ? 0.0 : 0.5 * h.spacing),
              need("yllcorner", "yllcenter") + (centre_y ? 0.0 : 0.5 * h.spacing)};
  if (value.count("nodata_value")) h.no_data = value.at("nodata_value");
  validate(more, "{}: ends after its header (it has no heights) export the terrain anew",
           file.name());
  return h;
}

}  // namespace

double HeightField::at(double x, double y) const {
  const Cell c = find_cell(*this, x, y);
  const double* low = height.data() + std::size_t(c.row) * columns + c.column;
  const double* high = low + columns;
  const double below = low[0] + c.right * (low[1] - low[0]);
  const double above = high[0] + c.right * (high[1] - high[0]);
  return below + c.up * (above - below) - place.level;
}

std::string HeightField::name_place(double x, double y) const {
  const Cell c = find_cell(*this, x, y);
  for (const int row : {c.row, c.row + 1})
    for (const int column : {c.column, c.column + 1})
      if (std::isnan(height[std::size_t(row) * columns + column]))
        return fmt::format("{}:{} (row {}, column {})", source, first_line + rows - 1 - row,
                           rows - row, column + 1);
  return source;
}

HeightField read_height_field(const std::filesystem::path& path, const MapPlace& place) {
  GridFile file(path);
  const Header header = read_header(file);
  HeightField f;
  f.corner = header.corner;
  f.spacing = header.spacing;
  f.columns = header.columns;
  f.rows = header.rows;
  f.place = place;
  f.source = file.name();
  f.first_line = file.line();
  f.height.resize(std::size_t(f.columns) * f.rows);
  for (int row = f.rows - 1; row >= 0; --row) {
    validate(!file.words().empty(),
             "{}: ends after {} rows of heights (the header says nrows {}) the file was cut; copy "
             "or export it again",
             file.place(), f.rows - 1 - row, f.rows);
    validate(std::ssize(file.words()) == f.columns,
             "{}: {} heights in this line (the header says ncols {}) write every row of the grid "
             "on a line of its own",
             file.place(), file.words().size(), f.columns);
    for (int i = 0; i < f.columns; ++i) {
      const double value = file.number(file.words()[i]);
      const bool missing = header.no_data && value == *header.no_data;
      f.height[std::size_t(row) * f.columns + i] = missing ? kUnset : value;
      f.complete = f.complete && !missing;
    }
    file.next();
  }
  validate(file.words().empty(),
           "{}: more rows of heights than nrows {} (the header and the rows disagree) export the "
           "terrain anew",
           file.place(), f.rows);
  return f;
}

void check_covered(const HeightField& field, std::span<const double> x, std::span<const double> y,
                   double time) {
  if (field.complete) return;
  for (std::size_t q = 0; q < x.size(); ++q) {
    if (!std::isnan(field.at(x[q], y[q]))) continue;
    throw NumericsError(fmt::format(
        "t = {:.2f} s: soil has come to ({:.1f}, {:.1f}), where the terrain has no height, see {} "
        "(it would fall for ever) fill the gap in the file, or let the flow leave before it with "
        "`outlet`",
        time, x[q], y[q], field.name_place(x[q], y[q])));
  }
}

}  // namespace flowslide::mpm

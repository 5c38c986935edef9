#include "mpm/walls/height_field.hpp"

#include "core/check.hpp"
#include "core/elementary.hpp"
#include "core/odd_characters.hpp"
#include "core/unreadable.hpp"
#include "mpm/walls/is_height_field.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <map>
#include <string_view>

namespace flowslide::mpm {
namespace {

/// A node and how far the place lies from it towards the next [spacings].
struct Cell {
  int column, row;
  double right, up;
};

Cell find_cell(const HeightField& f, double x, double y) {
  const double c = cos(f.place.heading), s = sin(f.place.heading);
  const double east = f.place.origin[0] + c * x - s * y;
  const double north = f.place.origin[1] + s * x + c * y;
  // A place that is no number must not become an index: max and min hand on their first argument.
  const double i = std::min(f.columns - 1.0, std::max(0.0, (east - f.corner[0]) / f.spacing));
  const double j = std::min(f.rows - 1.0, std::max(0.0, (north - f.corner[1]) / f.spacing));
  const int column = std::min(static_cast<int>(i), f.columns - 2);
  const int row = std::min(static_cast<int>(j), f.rows - 2);
  return {column, row, i - column, j - row};
}

/// Words of a text file with the lines they stand on.
class GridFile {
 public:
  explicit GridFile(const std::filesystem::path& path)
      : path_(path), name_(path.filename().string()) {
    const std::string why = why_unreadable(path);
    if (why.empty()) in_.open(path);
    std::error_code error;
    bytes_ = std::filesystem::file_size(path, error);
    if (!why.empty() || !in_ || error)
      throw FileError(fmt::format("{}: {}", path.string(), why.empty() ? "cannot be opened" : why));
  }
  /// Words of the next line that has any; false at the end of the file.
  bool next() {
    words_.clear();
    while (words_.empty() && in_.getline(line_text_.data(), std::ssize(line_text_))) {
      ++line_;
      // The end of the line counts, but the last line may have none.
      std::string_view text(line_text_.data(), in_.gcount() - (in_.eof() ? 0 : 1));
      if (line_ == 1) {
        if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
        expect_text(text);
      }
      for (std::size_t at = 0; at < text.size();) {
        const std::size_t first = text.find_first_not_of(" \t\r", at);
        if (first == std::string_view::npos) break;
        at = std::min(text.find_first_of(" \t\r", first), text.size());
        words_.push_back(text.substr(first, at - first));
      }
    }
    if (in_.bad()) throw FileError(fmt::format("{}: cannot be read", path_.string()));
    validate(in_.gcount() + 1 < std::ssize(line_text_),
             "{}:{}: the line has more than {} MiB (no row of a terrain has so many heights) is "
             "this a text file?",
             name_, line_ + 1, kLongestLine >> 20u);
    return !words_.empty();
  }
  /// Numbers that a file of this size can hold: each takes a digit and a blank.
  [[nodiscard]] double most_numbers() const { return 0.5 * static_cast<double>(bytes_ + 1); }
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] std::string place() const { return fmt::format("{}:{}", name_, line_); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] double height(std::string_view word) const {
    return number(word,
                  "(heights are plain numbers with blanks between them) mark missing ones with the "
                  "nodata_value of the header, such as -9999");
  }
  /// Of the header.
  [[nodiscard]] double header_number(const std::string& key, std::string_view word) const {
    return number(word, key == "nodata_value"
                            ? "(missing heights cannot be told from others by it) export the "
                              "terrain with a number, such as -9999"
                            : fmt::format("(it is the {} of the grid) correct the header", key));
  }

 private:
  [[nodiscard]] double number(std::string_view word, std::string_view hint) const {
    double value = kUnset;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc{} && end == word.data() + word.size() && std::isfinite(value))
      return value;
    const std::string odd = odd_characters(word);
    throw InputError(
        fmt::format("{}: '{}' {}", place(), word.substr(0, 40),
                    odd.empty() ? fmt::format("is not a finite number {}", hint) : odd));
  }
  /// The first bytes of images and of UTF-16 tell themselves.
  void expect_text(std::string_view start) const {
    const bool is_text = std::none_of(start.begin(), start.end(), [](char c) {
      return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r';
    });
    validate(is_text,
             "{}: holds control characters (a binary grid such as GeoTIFF, an archive or UTF-16 "
             "text) export the terrain as Arc/Info ASCII grid, and save it as plain text",
             name_);
    const std::size_t line_end = start.find('\r');
    validate(line_end == std::string_view::npos || line_end + 1 == start.size(),
             "{}: a carriage return without a line feed (line ends of an old text format) save it "
             "with Unix or Windows line ends",
             name_);
  }

  std::filesystem::path path_;
  std::string name_;
  std::ifstream in_;
  std::uintmax_t bytes_ = 0;
  static constexpr std::size_t kLongestLine = std::size_t{4} << 20;  ///< 100000 heights have 2.5
  std::vector<char> line_text_ = std::vector<char>(kLongestLine);
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
  double no_data = kUnset;
};

/// What the format means where the header has no nodata_value.
constexpr double kUsualNoData = -9999.0;
// The shore of the Dead Sea lies at -430 m, no pit is deeper than -1000 m; Everest has 8850 m.
constexpr double kLowestGround = -1100.0, kHighestGround = 9000.0;

constexpr int kFewest = 2, kMost = 100000;
// From sand boxes in the laboratory to maps of the world [m].
constexpr double kFinest = 1e-6, kCoarsest = 1e6;
constexpr double kMostCells = 1e12;  ///< from the origin of the map to its corner

constexpr std::array<std::string_view, 8> kHeaderWords{"ncols",     "nrows",       "xllcorner",
                                                       "yllcorner", "xllcenter",   "yllcenter",
                                                       "cellsize",  "nodata_value"};

/// Corners may be told of the lowest cell on the left or of its middle.
void check_corners(const GridFile& file, const std::map<std::string, double>& value) {
  for (const auto& [corner, centre] :
       {std::pair("xllcorner", "xllcenter"), std::pair("yllcorner", "yllcenter")})
    validate(value.count(corner) + value.count(centre) < 2,
             "{}: {} and {} are both given (they are half a cell apart) remove one", file.name(),
             corner, centre);
}

/// Reads up to the first row of heights, whose words are left in the file's line.
Header read_header(GridFile& file) {
  std::map<std::string, double> value;
  bool more = file.next();
  for (; more && std::isalpha(static_cast<unsigned char>(file.words()[0][0])); more = file.next()) {
    const std::string key = lower(file.words()[0]);
    if (key == "nan" || key == "inf") break;
    const bool known =
        std::find(kHeaderWords.begin(), kHeaderWords.end(), key) != kHeaderWords.end();
    validate(known && file.words().size() == 2,
             "{}: '{}' is no line of the header of an ESRI ASCII grid (it has ncols, nrows, "
             "xllcorner, yllcorner, cellsize and nodata_value, each with one number) export the "
             "terrain as Arc/Info ASCII grid with square cells",
             file.place(), file.words()[0].substr(0, 40));
    validate(value.emplace(key, file.header_number(key, file.words()[1])).second,
             "{}: {} is given twice (only one can hold) remove one", file.place(), key);
  }
  check_corners(file, value);
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
  validate(columns * rows <= file.most_numbers(),
           "{}: the header says {:g} x {:g} heights (the file is too short for so many) it was "
           "cut, or the header is wrong; copy or export it again",
           file.name(), columns, rows);
  h.spacing = need("cellsize");
  validate(h.spacing >= kFinest && h.spacing <= kCoarsest,
           "{}: cellsize is {:g} (a length from {:g} to {:g} m is read) check the header and the "
           "unit of the map",
           file.name(), h.spacing, kFinest, kCoarsest);
  const bool centre_x = value.count("xllcenter") > 0, centre_y = value.count("yllcenter") > 0;
  h.corner = {need("xllcorner", "xllcenter") + (centre_x ? 0.0 : 0.5 * h.spacing),
              need("yllcorner", "yllcenter") + (centre_y ? 0.0 : 0.5 * h.spacing)};
  // Beyond, a coordinate could not tell neighbours.
  for (const double at : h.corner)
    validate(
        std::abs(at) < h.spacing * kMostCells,
        "{}: the corner lies at {:g} and {:g} m (its place is lost in rounding beside cells of "
        "{:g} m) check the header and the unit of the map",
        file.name(), h.corner[0], h.corner[1], h.spacing);
  h.no_data = value.count("nodata_value") ? value.at("nodata_value") : kUsualNoData;
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
  // Grows with what the file holds: a header alone must not take the memory of the machine.
  std::vector<double>& height = f.height;
  for (int row = 0; row < f.rows; ++row) {
    validate(!file.words().empty(),
             "{}: ends after {} rows of heights (the header says nrows {}) the file was cut; copy "
             "or export it again",
             file.place(), row, f.rows);
    if (std::ssize(file.words()) != f.columns)  // a word that is no number says more
      for (const std::string_view word : file.words()) (void)file.height(word);
    validate(std::ssize(file.words()) == f.columns,
             "{}: {} heights in this line (the header says ncols {}) write every row of the grid "
             "on a line of its own",
             file.place(), file.words().size(), f.columns);
    for (int i = 0; i < f.columns; ++i) {
      const double value = file.height(file.words()[i]);
      const bool missing = value == header.no_data;
      if (!missing && !(value > kLowestGround && value < kHighestGround))
        throw InputError(fmt::format(
            "{}: column {}: a height of {:g} m (no ground lies there; a mark for missing data that "
            "the header does not tell, or heights in another unit) write 'nodata_value {:g}' into "
            "the header if it is such a mark",
            file.place(), i + 1, value, value));
      height.push_back(missing ? kUnset : value);
      f.complete = f.complete && !missing;
    }
    file.next();
  }
  // The file begins with the last row.
  for (int low = 0, high = f.rows - 1; low < high; ++low, --high)
    std::swap_ranges(height.begin() + std::ptrdiff_t(low) * f.columns,
                     height.begin() + std::ptrdiff_t(low + 1) * f.columns,
                     height.begin() + std::ptrdiff_t(high) * f.columns);
  validate(file.words().empty(),
           "{}: more rows of heights than nrows {} (the header and the rows disagree) export the "
           "terrain anew",
           file.place(), f.rows);
  validate(std::any_of(height.begin(), height.end(), [](double h) { return is_set(h); }),
           "{}: every height is {:g}, the mark of missing data (there is no ground) export the "
           "terrain of the place anew",
           f.source, header.no_data);
  return f;
}

bool is_height_field(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  const std::string word = lower(head.substr(0, head.find_first_of(" \t\r\n:=")));
  return std::find(kHeaderWords.begin(), kHeaderWords.end(), word) != kHeaderWords.end();
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

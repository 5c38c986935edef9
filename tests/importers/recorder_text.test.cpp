#include "importers/recorder_text.hpp"

#include "core/check.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/paths.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <sys/stat.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::DataFolder;

namespace {

using Rows = std::vector<std::vector<double>>;

Rows read_all(const std::filesystem::path& path, std::vector<std::string>* notes = nullptr) {
  RecorderReader reader(path);
  Rows rows;
  std::vector<double> values;
  while (reader.next(values)) rows.push_back(values);
  if (notes) *notes = reader.notes();
  return rows;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same_bits(const Rows& a, const Rows& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t r = 0; r < a.size(); ++r) {
    if (a[r].size() != b[r].size()) return false;
    for (std::size_t c = 0; c < a[r].size(); ++c)
      if (!same_bits(a[r][c], b[r][c])) return false;
  }
  return true;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

const std::string kPlain =
    "0.01 -1.17133e-06 0 -0\n"
    "0.02 0.1 123456.789 1e-300\n"
    "0.03 3.14159265358979 -2 7\n";

}  // namespace

TEST_CASE("a text recorder is read to the bit", "[importers]") {
  const DataFolder folder;
  const Rows rows = read_all(folder.write("a.out", kPlain));
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == std::vector<double>{0.01, -1.17133e-06, 0.0, 0.0});
  CHECK(std::signbit(rows[0][3]));
  CHECK(rows[2] == std::vector<double>{0.03, 3.14159265358979, -2.0, 7.0});
}

TEST_CASE("every spelling of the same table reads to the same bits", "[importers]") {
  const DataFolder folder;
  const Rows plain = read_all(folder.write("plain.out", kPlain));
  const std::string csv = replaced(kPlain, " ", ",");
  const std::vector<std::pair<std::string, std::string>> spellings = {
      {"CRLF", replaced(kPlain, "\n", "\r\n")},
      {"CR", replaced(kPlain, "\n", "\r")},
      {"tabs", replaced(kPlain, " ", "\t")},
      {"several blanks", "  " + replaced(kPlain, " ", "   ")},
      {"trailing blank", replaced(kPlain, "\n", " \n")},
      {"form feed", "\f" + kPlain},
      {"byte order mark", "\xEF\xBB\xBF" + kPlain},
      {"blank lines", replaced(kPlain, "\n", "\n\n")},
      {"CSV", csv},
      {"CSV with CRLF", replaced(csv, "\n", "\r\n")},
      {"CSV with blanks", replaced(csv, ",", ", ")},
      {"CSV with a comma at the end", replaced(csv, "\n", ",\n")}};
  for (const auto& [name, text] : spellings) {
    CAPTURE(name);
    CHECK(same_bits(plain, read_all(folder.write("b.out", text))));
  }
  CHECK(same_bits(plain, read_all(folder.write_gzip("plain.out.gz", kPlain))));
  CHECK(same_bits(plain, read_all(folder.write_gzip("csv.gz", csv))));
}

TEST_CASE("line ends may fall on the border of a block", "[importers]") {
  const DataFolder folder;
  // 2^18 bytes are read at a time; the row ends are moved across that border.
  for (std::size_t pad = (1 << 18) - 4; pad <= (1 << 18) + 2; ++pad) {
    CAPTURE(pad);
    const std::string text = "1 2" + std::string(pad - 3, ' ') + "\r\n3 4\r\n";
    CHECK(read_all(folder.write("a.out", text)) == Rows{{1, 2}, {3, 4}});
  }
}

TEST_CASE("numbers of all programs are understood", "[importers]") {
  const DataFolder folder;
  const double inf = std::numeric_limits<double>::infinity();
  const Rows rows = read_all(
      folder.write("a.out", "+1.0 .5 5. 1e-005 4e-310 1e-400 inf -inf 1.#INF -1.#INF000\n"));
  CHECK(rows == Rows{{1.0, 0.5, 5.0, 1e-5, 4e-310, 0.0, inf, -inf, inf, -inf}});
  const Rows words = read_all(folder.write("b.out", "nan -nan NaN 1.#QNAN -1.#IND\n"));
  REQUIRE(words.at(0).size() == 5);
  for (const double x : words[0]) CHECK(std::isnan(x));
}

TEST_CASE("a last line without newline is dropped and reported", "[importers]") {
  const DataFolder folder;
  std::vector<std::string> notes;
  // The last number of the full-length row has lost a digit: nothing else would show it.
  const Rows rows = read_all(folder.write("displacement.out", "1 2\n3 4\n5 6.88511e-0"), &notes);
  CHECK(rows == Rows{{1, 2}, {3, 4}});
  CHECK(notes == std::vector<std::string>{"displacement.out: last line (row 3) is torn, dropped"});
}

TEST_CASE("the tail of a killed run is read up to the torn row", "[importers]") {
  std::vector<std::string> notes;
  const Rows rows = read_all(test::fixture("opensees/killed/displacement.out"), &notes);
  CHECK(rows.size() == 318);
  CHECK(rows.back()[0] == 206.06);
  CHECK(notes ==
        std::vector<std::string>{"displacement.out: last line (row 319) is torn, dropped"});
}

TEST_CASE("a header is skipped only if it holds no number", "[importers]") {
  const DataFolder folder;
  std::vector<std::string> notes;
  CHECK(read_all(folder.write("a.csv", "\"time (s)\",ux,uy\n1,2,3\n"), &notes) == Rows{{1, 2, 3}});
  CHECK(notes == std::vector<std::string>{"a.csv:1: header line skipped"});
  CHECK(read_all(folder.write("b.out", "# t u\n// 1 2\n1 2\n"), &notes) == Rows{{1, 2}});
  CHECK(notes.size() == 2);
  CHECK_THROWS_WITH(read_all(folder.write("c.out", "t 2 3\n1 2 3\n")),
                    Contains("c.out:1: column 1 't' is not a number"));
  CHECK_THROWS_WITH(read_all(folder.write("d.out", "1 2\n# note\n")),
                    Contains("d.out:2: column 1"));
}

TEST_CASE("what is no row of numbers is explained with its place", "[importers]") {
  const DataFolder folder;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"1 2 3\n4 5\n", "a.out:2: 2 columns, but the first row has 3"},
      {"1 2\n3 4 5\n", "a.out:2: 3 columns, but the first row has 2"},
      {"1 1d-05\n", "a.out:1: column 2 '1d-05' has a Fortran exponent"},
      {"1 2\n1 ****\n", "a.out:2: column 2 '****' is a Fortran overflow"},
      {"**** 2\n", "column 1 '****' is a Fortran overflow"},
      {"1;2;3\n", "holds ';'"},
      {"1,5 2,5\n", "decimal or thousands comma"},
      {"1 2\n1,5 2\n", "a.out:2: column 1 '1,5' mixes commas and blanks"},
      {"1,,3\n", "column 2 '' is empty"},
      {"1,\"2\"\n", "column 2 '\"2\"' is quoted"},
      {"1 0x10\n", "column 2 '0x10' is not a number"},
      {"1 1.234-105\n", "column 2 '1.234-105' is not a number"},
      {"1 +-2\n", "column 2 '+-2' is not a number"},
      {"1 \xC2\xA0\x32\n", "column 2"}};
  for (const auto& [text, message] : cases) {
    CAPTURE(text);
    const auto path = folder.write("a.out", text);
    CHECK_THROWS_AS(read_all(path), InputError);
    CHECK_THROWS_WITH(read_all(path), Contains(message));
  }
}

TEST_CASE("what is no text is explained", "[importers]") {
  const DataFolder folder;
  using namespace std::string_literals;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"\xFF\xFE"
       "1\0 \0"s,
       "UTF-16"},
      {"1\0 \0\x32\0"s, "NUL bytes in a text file (binary recorder or UTF-16?)"},
      {"1 2\n3 4\n\0\0\0\0"s,
       "a.out:3: NUL bytes in a text file (a crash or a full disk left a hole)"},
      {"\x7B\x14\xAE\x47\xE1\x7A\x84\x3F"s, "binary recorder"},
      {"\x89HDF\r\n\x1A\n"s, "HDF5"},
      {"<?xml version=\"1.0\"?>\n", "XML recorder"},
      {"version https://git-lfs.github.com/spec/v1\n", "Git LFS"},
      {"PK\x03\x04", "zip archive"},
      {"\xFD"
       "7zXZ\0"s,
       "xz archive"}};
  for (const auto& [bytes, message] : cases) {
    CAPTURE(message);
    CHECK_THROWS_WITH(read_all(folder.write("a.out", bytes)), Contains(message));
  }
  const std::string gz = read_text_file(folder.write_gzip("whole.gz", kPlain));
  CHECK_THROWS_WITH(read_all(folder.write("cut.gz", gz.substr(0, gz.size() - 6))),
                    Contains("gzip data end too early"));
  std::string damaged = gz;
  damaged[gz.size() - 6] = static_cast<char>(damaged[gz.size() - 6] ^ 1);
  CHECK_THROWS_WITH(read_all(folder.write("damaged.gz", damaged)),
                    Contains("gzip data are damaged"));
}

TEST_CASE("files that cannot be opened are told apart", "[importers]") {
  const DataFolder folder;
  CHECK_THROWS_AS(RecorderReader(folder.path("none.out")), FileError);
  CHECK_THROWS_WITH(RecorderReader(folder.path("none.out")), Contains("no such file"));
  CHECK_THROWS_WITH(RecorderReader("~/none.out"), Contains("'~' is not expanded"));
  CHECK_THROWS_WITH(RecorderReader(folder.path("")), Contains("is a folder"));
  CHECK_THROWS_WITH(RecorderReader("/dev/zero"), Contains("a pipe or a device"));
  REQUIRE(::mkfifo(folder.path("pipe").c_str(), 0600) == 0);
  CHECK_THROWS_AS(RecorderReader(folder.path("pipe")), FileError);
}

TEST_CASE("a compressed line without an end does not fill the memory", "[importers]") {
  const DataFolder folder;
  const std::string line(65u << 20u, '1');
  CHECK_THROWS_WITH(read_all(folder.write_gzip("line.gz", "1 2\n" + line)),
                    Contains("line.gz:2") && Contains("more than 64 MiB"));
}

TEST_CASE("a scan explains what is empty", "[importers]") {
  const DataFolder folder;
  const auto problem = [&](std::string_view text) {
    const RecorderScan scan = scan_recorder(folder.write("a.out", text));
    REQUIRE(scan.problems.size() == 1);
    return scan.problems[0];
  };
  CHECK_THAT(problem(""), Contains("a.out: is empty (the recorder wrote nothing"));
  CHECK_THAT(problem("\n\n"), Contains("is empty"));
  CHECK_THAT(problem("1 2 3"), Contains("has no complete row (a.out: last line (row 1) is torn"));
  CHECK_THAT(problem("time ux\n"), Contains("has no complete row (a.out:1: header line skipped)"));
}

TEST_CASE("a scan lists the first values that are not finite", "[importers]") {
  const DataFolder folder;
  const auto label = [](std::size_t c) { return c == 2 ? std::string("node 7 x") : std::string(); };
  const RecorderScan scan =
      scan_recorder(folder.write("a.out", "1 5 6\n2 nan 7\n3 8 -inf\n"), label);
  CHECK(scan.rows == 3);
  CHECK(scan.good_rows == 1);
  CHECK(scan.first_column == std::vector<double>{1.0});
  CHECK(scan.non_finite == 2);
  CHECK(scan.problems == std::vector<std::string>{"a.out:2: column 2 (node 7 x) is nan",
                                                  "a.out:3: column 3 is -inf"});
  CHECK(scan.value_min == 5.0);
  CHECK(scan.value_max == 8.0);
  std::string many;
  for (int i = 0; i < 100; ++i) many += "1 nan\n";
  const RecorderScan all = scan_recorder(folder.write("b.out", many));
  CHECK(all.problems.size() == 10);
  CHECK(all.non_finite == 100);
}

TEST_CASE("a bad row does not hide the rows after it from a scan", "[importers]") {
  const DataFolder folder;
  const RecorderScan scan = scan_recorder(folder.write("a.out", "1 2\n3\n5 6\n7 x\n9 10\n"));
  CHECK(scan.rows == 5);
  CHECK(scan.good_rows == 1);
  CHECK(scan.problems.size() == 2);
}

TEST_CASE("a row of a million columns is read", "[importers]") {
  const DataFolder folder;
  constexpr std::size_t columns = 1'000'000;
  std::string text;
  for (std::size_t c = 0; c < columns; ++c) text += c % 2 == 0 ? "1 " : "0.25 ";
  text += '\n';
  const Rows rows = read_all(folder.write("a.out", text));
  REQUIRE(rows.size() == 1);
  REQUIRE(rows[0].size() == columns);
  CHECK(rows[0].back() == 0.25);
}

TEST_CASE("a file cut at any byte gives its complete rows or an error", "[importers][fuzz]") {
  const DataFolder folder;
  const std::string text = "0.1 -0.0645595 1.3e-05\r\n0.2 nan 3\n0.3 -1.#IND 4 \n";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    CAPTURE(size);
    const std::string cut = text.substr(0, size);
    // A CR ends a line as well, so CRLF counts once.
    const auto complete =
        std::count(cut.begin(), cut.end(), '\n') + (size == text.find('\r') + 1 ? 1 : 0);
    CHECK(static_cast<std::ptrdiff_t>(read_all(folder.write("a.out", cut)).size()) == complete);
  }
  const std::string gz = read_text_file(folder.write_gzip("whole.gz", text));
  for (std::size_t size = 0; size < gz.size(); ++size) {
    CAPTURE(size);
    const RecorderScan scan = scan_recorder(folder.write("a.gz", gz.substr(0, size)));
    CHECK_FALSE(scan.problems.empty());
  }
}

TEST_CASE("a file with any byte replaced never crashes", "[importers][fuzz]") {
  const DataFolder folder;
  const std::string text = "0.1 -0.06 1.3e-05\n0.2 1,5 nan\n";
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const char byte : std::string("\0\1\n\r ,-#\"e\x7F\xFF", 12)) {
      std::string changed = text;
      changed[at] = byte;
      const RecorderScan scan = scan_recorder(folder.write("a.out", changed));
      CHECK(scan.good_rows <= scan.rows);
      CHECK(scan.first_column.size() == static_cast<std::size_t>(scan.good_rows));
    }
  }
}

TEST_CASE("a summary says what a recorder holds", "[importers]") {
  const DataFolder folder;
  const RecorderSummary s =
      summarize_recorder(folder.write("a.out", "0.1 5 -7\n0.2 6 8\n0.5 1 2\n0.6 1"));
  CHECK(s.columns == 3);
  CHECK(s.rows == 3);
  CHECK(s.has_time);
  CHECK(s.stages == 1);
  CHECK(s.time_first == 0.1);
  CHECK(s.time_last == 0.5);
  CHECK(s.step_min == Approx(0.1));
  CHECK(s.step_max == Approx(0.3));
  CHECK(s.value_min == -7.0);
  CHECK(s.value_max == 8.0);
  CHECK(s.problems.empty());
  CHECK(s.notes.size() == 1);
  CHECK_FALSE(summarize_recorder(folder.write("b.out", "3 1\n-2 1\n1 1\n-5 1\n")).has_time);
  const RecorderSummary t = summarize_recorder(folder.write("c.out", "0.1\n0.2\n"));
  CHECK_THAT(t.notes.at(0), Contains("one column only"));
  CHECK_THAT(summarize_recorder(folder.write("d.out", "1 x\n")).problems.at(0),
             Contains("d.out:1"));
}

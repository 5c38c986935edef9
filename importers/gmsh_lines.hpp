#pragma once
#include "core/check.hpp"
#include "core/odd_characters.hpp"
#include "core/units.hpp"
#include "importers/text_lines.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace flowslide {

/// Lines of a .msh file as numbers, with their place for messages.
class GmshLines {
 public:
  explicit GmshLines(const std::filesystem::path& path) : reader_(path) {}

  bool next() {
    while (reader_.next(line_)) {
      const auto first = line_.find_first_not_of(" \t");
      if (first == std::string_view::npos) continue;
      line_.remove_prefix(first);
      while (line_.back() == ' ' || line_.back() == '\t') line_.remove_suffix(1);
      return true;
    }
    return false;
  }
  [[nodiscard]] std::string_view text() const { return line_; }
  [[nodiscard]] const std::string& name() const { return reader_.name(); }
  [[nodiscard]] std::int64_t number() const { return reader_.line_number(); }

  /// Numbers of the next line; at least `least` of them.
  const std::vector<double>& numbers(std::size_t least, std::string_view what) {
    if (!next()) fail(fmt::format("the file ends where {} should stand (it was cut)", what));
    if (split(line_, what).size() < least)
      fail(fmt::format("{} numbers, but {} has at least {}", values_.size(), what, least));
    return values_;
  }
  /// Exactly `count` numbers: one too many means that columns are not what they are taken for.
  const std::vector<double>& exactly(std::size_t count, std::string_view what) {
    (void)numbers(count, what);
    expect(count, what);
    return values_;
  }
  /// Has the line that was read last so many numbers?
  void expect(std::size_t count, std::string_view what) const {
    if (values_.size() != count)
      fail(
          fmt::format("{} numbers, but {} has {} (what the others mean is not known, and all could "
                      "be shifted) take them away, or save the mesh anew",
                      values_.size(), what, count));
  }
  /// Numbers of a text with blanks between them.
  const std::vector<double>& split(std::string_view text, std::string_view what) {
    values_.clear();
    std::string_view rest = text;
    while (!rest.empty()) {
      double value = 0.0;
      std::size_t length = 0;
      if (!parse_number(rest, value, length) || !std::isfinite(value)) fail(no_numbers(what));
      values_.push_back(value);
      rest.remove_prefix(length);
      const auto first = rest.find_first_not_of(" \t");
      if (first == 0) fail(no_numbers(what));
      rest.remove_prefix(first == std::string_view::npos ? rest.size() : first);
    }
    return values_;
  }

  std::int64_t whole(double value, std::string_view what) const {
    if (value != std::floor(value) || std::abs(value) > kLargestExactInteger)
      fail(fmt::format("{} is no whole number ({})", value, what));
    return static_cast<std::int64_t>(value);
  }
  /// A number of gmsh's own, which are 32 bits wide: a larger one must not become a smaller.
  int tag(double value, std::string_view what) const {
    const std::int64_t n = whole(value, what);
    if (std::abs(n) > std::numeric_limits<int>::max())
      fail(fmt::format("{} {} is larger than gmsh writes", what, n));
    return static_cast<int>(n);
  }
  std::size_t count(double value, std::string_view what) const {
    const std::int64_t n = whole(value, what);
    if (n < 0 || n > 100'000'000) fail(fmt::format("{} {} (0 to 100 million)", n, what));
    return static_cast<std::size_t>(n);
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}: {}", name(), number(), problem));
  }

 private:
  [[nodiscard]] std::string no_numbers(std::string_view what) const {
    const std::string odd = odd_characters(line_);
    return fmt::format("'{}' {}", line_.substr(0, 60),
                       odd.empty() ? fmt::format("is not {}", what) : odd);
  }

  LineReader reader_;
  std::string_view line_;
  std::vector<double> values_;
};

}  // namespace flowslide

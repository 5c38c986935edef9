#pragma once
#include "core/check.hpp"
#include "tests/support/scratch.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

/// What the targets share.
namespace flowslide::fuzz {

/// A folder that goes when the program ends; TMPDIR says on which disk.
inline const Scratch& folder() {
  static const Scratch scratch;
  return scratch;
}

inline std::filesystem::path file(const std::string& name, std::string_view bytes) {
  const std::filesystem::path path = folder() / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// True if f() ends; false if it refuses the input with an Error, whose text must be fit to read.
template <class F>
bool accepts(F&& f) {
  constexpr std::size_t kLongestMessage = 65536;
  try {
    std::forward<F>(f)();
    return true;
  } catch (const Error& error) {
    const std::size_t length = std::strlen(error.what());
    if (length == 0 || length > kLongestMessage) std::abort();
    return false;
  }
}

/// Takes an input apart from its front; what is missing reads as zero.
class Parts {
 public:
  explicit Parts(std::string_view rest) : rest_(rest) {}

  [[nodiscard]] bool empty() const { return rest_.empty(); }
  [[nodiscard]] std::string_view rest() const { return rest_; }
  template <class T = std::uint8_t>
  T number() {
    T value{};
    const std::size_t n = std::min(sizeof value, rest_.size());
    if (n > 0) std::memcpy(&value, rest_.data(), n);
    rest_.remove_prefix(n);
    return value;
  }
  /// Up to a line that holds only "----", or to the end.
  std::string_view section() {
    constexpr std::string_view kLine = "----\n";
    for (std::size_t at = 0; (at = rest_.find(kLine, at)) != std::string_view::npos; ++at)
      if (at == 0 || rest_[at - 1] == '\n')
        return std::exchange(rest_, rest_.substr(at + kLine.size())).substr(0, at);
    return std::exchange(rest_, {});
  }

 private:
  std::string_view rest_;
};

/// Bits of a line of switches, such as "a 0 1": a letter is one choice of many, so that corpora are
/// text.
class Switches {
 public:
  explicit Switches(std::string_view line) : line_(line) {}
  /// A number below `count`, from the next character.
  std::size_t choose(std::size_t count) {
    if (line_.empty()) return 0;
    const auto c = static_cast<unsigned char>(line_[0]);
    line_.remove_prefix(1);
    return (c >= '0' ? c - '0' : 0u) % count;
  }
  bool flag() { return choose(2) == 1; }

 private:
  std::string_view line_;
};

}  // namespace flowslide::fuzz

#include "core/odd_characters.hpp"

#include <array>

namespace flowslide {
namespace {

struct Odd {
  std::string_view bytes, text;
};

constexpr std::string_view kBlank =
    "holds a non-breaking space (it looks like a blank but is none) "
    "replace it by a blank";
constexpr std::string_view kMinus =
    "holds a long minus sign (from a word processor or a web page) write '-'";

constexpr std::array kOdd = {
    Odd{"\xC2\xA0", kBlank},      // U+00A0
    Odd{"\xE2\x80\xAF", kBlank},  // U+202F
    Odd{"\xE2\x80\x89", kBlank},  // U+2009
    Odd{"\xE2\x80\x87", kBlank},  // U+2007
    Odd{"\xE2\x88\x92", kMinus},  // U+2212
    Odd{"\xE2\x80\x93", kMinus},  // U+2013
    Odd{"\xEF\xBB\xBF",
        "holds a byte-order mark (files were joined, or one was added twice) remove it"},
    Odd{"\xEF\xBC", "holds full-width characters (of an East Asian keyboard) write plain digits"},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string odd_characters(std::string_view token) {
  for (const Odd& odd : kOdd)
    if (token.find(odd.bytes) != std::string_view::npos) return std::string(odd.text);
  for (std::size_t i = 0; i < token.size(); ++i) {
    // 0xA0 that no UTF-8 character leads up to: Latin-1
    const bool after_ascii = i == 0 || static_cast<unsigned char>(token[i - 1]) < 0x80;
    if (token[i] == '\xA0' && after_ascii) return std::string(kBlank);
  }
  for (std::size_t i = 0; i + 1 < token.size(); ++i)
    if (token[i] == ',' && is_digit(token[i + 1]) && token.find('.') == std::string_view::npos &&
        (i == 0 || is_digit(token[i - 1]) || token[i - 1] == '-' || token[i - 1] == '+'))
      return "has a decimal comma (numbers have a decimal point) write '.'";
  return {};
}

}  // namespace flowslide

#pragma once
#include <optional>
#include <string>
#include <string_view>

/// Units of acceleration in the words of a file: "CM/SEC/SEC", "g's", "acc_m_s2".
namespace flowslide {

inline bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "CM / SEC ** 2, ..." -> "CM/SEC^2, ...".
std::string closed_up(std::string_view text);

/// The unit, spelled as in settings, with which closed-up text in capitals starts.
std::optional<std::string> unit_at_start(std::string_view text);

/// The unit that the heading of columns gives for one of them, from 1; of the whole heading where
/// its parts, between commas, semicolons or tabs, are not as many as the columns. A unit behind a
/// number is that of a value. Empty where it names none, or several.
std::optional<std::string> unit_in_heading(std::string_view heading, std::size_t column,
                                           std::size_t columns);

}  // namespace flowslide

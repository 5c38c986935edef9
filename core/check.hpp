#pragma once
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/core.h>

/// Errors for users and contracts for developers.
///
/// Grammar of a user's message: "<problem> (<why it is a problem>) <what to do>".
/// Exit codes are those of the command-line contract: 2 input, 3 numerics, 4 files.
namespace flowslide {

/// Marks a number that nobody has set. Checks are written so that NaN fails them.
inline constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
inline bool is_set(double x) { return !std::isnan(x); }

class Error : public std::runtime_error {
 public:
  Error(int exit_code, const std::string& what) : std::runtime_error(what), exit_code_(exit_code) {}
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

/// What the user wrote, or what a data file holds, is wrong (exit 2).
class InputError : public Error {
 public:
  explicit InputError(const std::string& what) : Error(2, what) {}
};

/// The computation left the range in which its numbers mean something (exit 3).
class NumericsError : public Error {
 public:
  explicit NumericsError(const std::string& what) : Error(3, what) {}
};

/// A file is missing, unreadable or cannot be written (exit 4).
class FileError : public Error {
 public:
  explicit FileError(const std::string& what) : Error(4, what) {}
};

/// Stopped by a signal after a checkpoint was written (exit 130).
class Interrupted : public Error {
 public:
  explicit Interrupted(const std::string& what) : Error(130, what) {}
};

/// Always on: checks what comes from outside. Write `validate(x > 0, ...)`, never `if (x <= 0)`:
/// a NaN must fail.
template <class... Args>
void validate(bool ok, fmt::format_string<Args...> text, Args&&... args) {
  if (!ok) throw InputError(fmt::format(text, std::forward<Args>(args)...));
}

namespace detail {
[[noreturn]] inline void contract_failed(const char* kind, const char* expr, const char* file,
                                         int line) {
  throw std::logic_error(fmt::format("{}:{}: {} failed: {}", file, line, kind, expr));
}
}  // namespace detail

}  // namespace flowslide

#ifdef FLOWSLIDE_CONTRACTS
#define FLOWSLIDE_CONTRACT_(kind, expr) \
  ((expr) ? void() : ::flowslide::detail::contract_failed(kind, #expr, __FILE__, __LINE__))
#else
#define FLOWSLIDE_CONTRACT_(kind, expr) void()
#endif
/// Precondition and postcondition; on in the presets dev, audit and asan.
#define FLOWSLIDE_EXPECT(expr) FLOWSLIDE_CONTRACT_("precondition", expr)
#define FLOWSLIDE_ENSURE(expr) FLOWSLIDE_CONTRACT_("postcondition", expr)

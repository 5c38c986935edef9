#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace flowslide {

/// Length of a SHA-256 in hexadecimal.
inline constexpr std::size_t kSha256Digits = 64;

/// SHA-256 of bytes that come in pieces.
class Sha256 {
 public:
  Sha256();
  void add(const void* bytes, std::size_t size);
  /// In lower-case hexadecimal digits; once, after the last piece.
  std::string hex();

 private:
  struct Free {
    void operator()(void* context) const;
  };
  std::unique_ptr<void, Free> context_;
};

/// SHA-256 in lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace flowslide

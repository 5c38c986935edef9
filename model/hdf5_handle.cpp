#include "model/hdf5_handle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

namespace flowslide {
namespace {

// Errors of the operating system come with addresses and times, which help no user.
constexpr std::string_view kSystem = "error message = '";

/// The reason that the system gave HDF5 last.
std::string& system_error() {
  static std::string reason;
  return reason;
}

/// What HDF5 calls when one of its functions fails; others may follow before anybody asks.
herr_t note_system_error(hid_t stack, void*) {
  return H5Ewalk2(
      stack, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* entry, void*) -> herr_t {
        const std::string_view text = n == 0 && entry->desc ? entry->desc : "";
        if (const std::size_t at = text.find(kSystem); at != std::string::npos) {
          const std::string_view reason = text.substr(at + kSystem.size());
          system_error() = reason.substr(0, reason.find('\''));
        }
        return 0;
      },
      nullptr);
}

}  // namespace

void start_hdf5() {
  static const bool started = [] {
    // Every handle is closed by its owner. After a failed write (disk full) HDF5's own clean-up at
    // exit would touch what is left of the file and crash.
    H5dont_atexit();
    H5open();
    H5Eset_auto2(H5E_DEFAULT, &note_system_error, nullptr);
    H5PLset_loading_state(0);
    return true;
  }();
  static_cast<void>(started);
  system_error().clear();
}

void expect_no_system_error(const std::filesystem::path& file) {
  if (!system_error().empty())
    throw FileError(fmt::format("'{}' cannot be read ({})", file.string(), system_error()));
}

std::string hdf5_error() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* entry, void* out) -> herr_t {
        if (n == 0 && entry->desc) *static_cast<std::string*>(out) = entry->desc;
        return 0;
      },
      &text);
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  if (const std::size_t at = text.find(kSystem); at != std::string::npos) {
    text.erase(0, at + kSystem.size());
    text.resize(std::min(text.find('\''), text.size()));
  }
  return text;
}

void throw_file_error(const std::filesystem::path& file, std::string_view dataset,
                      std::string_view problem) {
  const std::string reason = hdf5_error();
  throw FileError(fmt::format("'{}': {}{}{}", file.string(),
                              dataset.empty() ? "" : fmt::format("dataset '{}': ", dataset),
                              problem, reason.empty() ? "" : fmt::format(" ({})", reason)));
}

std::string shape_text(const Shape& shape) {
  std::string text = "(";
  for (std::size_t n : shape) text += fmt::format("{}{}", text.size() > 1 ? ", " : "", n);
  return text + ")";
}

hid_t memory_type(Scalar type) {
  switch (type) {
    case Scalar::f64:
      return H5T_NATIVE_DOUBLE;
    case Scalar::i64:
      return H5T_NATIVE_INT64;
    case Scalar::i32:
      return H5T_NATIVE_INT32;
    case Scalar::u8:
      return H5T_NATIVE_UINT8;
  }
  std::abort();
}

hid_t disk_type(Scalar type) {
  switch (type) {
    case Scalar::f64:
      return H5T_IEEE_F64LE;
    case Scalar::i64:
      return H5T_STD_I64LE;
    case Scalar::i32:
      return H5T_STD_I32LE;
    case Scalar::u8:
      return H5T_STD_U8LE;
  }
  std::abort();
}

void expect_hdf5(bool done) {
  if (!done) throw std::bad_alloc();
}

Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
  expect_hdf5(H5Tset_size(type, std::max<std::size_t>(length, 1)) >= 0 &&
              H5Tset_strpad(type, H5T_STR_NULLPAD) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0);
  return type;
}

Hdf5Handle file_access() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
  expect_hdf5(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110) >= 0 &&
              H5Pset_file_locking(access, false, true) >= 0 &&
              H5Pset_fclose_degree(access, H5F_CLOSE_SEMI) >= 0);
  return access;
}

void check_finite(const std::filesystem::path& file, std::string_view dataset, const double* values,
                  std::size_t count, Nan nan) {
  for (std::size_t i = 0; i < count; ++i)
    validate(std::isfinite(values[i]) || (nan == Nan::allowed && std::isnan(values[i])),
             "'{}': dataset '{}': value {} is {} (a finite number is needed here)", file.string(),
             dataset, i, values[i]);
}

}  // namespace flowslide

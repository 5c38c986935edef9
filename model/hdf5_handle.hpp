#pragma once
#include "model/field_store.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <hdf5.h>

/// What the writer and the reader of field files share of HDF5. Private to this module.
namespace flowslide {

/// Owns an HDF5 identifier.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() { release(); }
  operator hid_t() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }
  /// Closes now; negative if that failed, which for a file means that data were lost.
  herr_t release() { return valid() ? close_(std::exchange(id_, H5I_INVALID_HID)) : 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Silences HDF5's own printing and forbids its plug-ins, which would load code from the
/// environment. Called before anything else is; cheap.
void start_hdf5();

/// Innermost entry of the HDF5 error stack, or "".
std::string hdf5_error();

/// Throws FileError if the system has refused HDF5 a read or write since the last start_hdf5():
/// what HDF5 then takes for missing may well be there.
void expect_no_system_error(const std::filesystem::path& file);

/// "'file.h5': dataset 'name': <problem> (<HDF5's reason>)"
[[noreturn]] void throw_file_error(const std::filesystem::path& file, std::string_view dataset,
                                   std::string_view problem);

/// "(120, 2)"
std::string shape_text(const Shape& shape);

/// Type in memory, and on disk (little endian).
hid_t memory_type(Scalar type);
hid_t disk_type(Scalar type);

/// For calls that only fail for want of memory. Throws std::bad_alloc.
void expect_hdf5(bool done);

/// Text of a fixed length, at least 1, on disk and in memory.
Hdf5Handle text_type(std::size_t length);

/// File access with the fixed format version and without locks, which network disks often refuse.
Hdf5Handle file_access();

/// Throws InputError for the first value that is infinite, or NaN without leave.
void check_finite(const std::filesystem::path& file, std::string_view dataset, const double* values,
                  std::size_t count, Nan nan);

}  // namespace flowslide

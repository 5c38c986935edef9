#include "model/hdf5_handle.hpp"
#include "tests/fuzz/good_files.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

#include <filesystem>

/// HDF5 itself is not instrumented and guards its own structures by checksums, so bytes at random
/// end there. What a stranger can do is to write other datasets with the same library: the input is
/// a list of such changes to a good file.
namespace flowslide::fuzz {
namespace {

constexpr std::size_t kMostChanges = 8;

struct Change {
  std::uint8_t kind, dataset;
  std::uint64_t value;
};

hid_t type_of(std::uint64_t value) {
  const std::array<hid_t, 8> types{H5T_IEEE_F64LE, H5T_IEEE_F32BE, H5T_STD_I64LE,   H5T_STD_U64LE,
                                   H5T_STD_I32BE,  H5T_STD_U8LE,   H5T_STD_REF_OBJ, H5T_C_S1};
  return types[value % types.size()];
}

/// A dataset of another type and shape in place of one; nothing is written to it.
void replace(hid_t file, const std::string& name, hid_t type, const std::vector<hsize_t>& extent) {
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const Hdf5Handle space(
      extent.empty() ? H5Screate(H5S_SCALAR)
                     : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
      &H5Sclose);
  const Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  if (!extent.empty()) {
    const std::vector<hsize_t> chunk(extent.size(), 2);
    H5Pset_chunk(layout, static_cast<int>(extent.size()), chunk.data());
  }
  const Hdf5Handle made(
      H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT), &H5Dclose);
}

struct Described {
  Hdf5Handle dataset, type;
  std::vector<hsize_t> extent;
};

Described describe(hid_t file, const std::string& name) {
  Described d;
  d.dataset = Hdf5Handle(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
  if (!d.dataset.valid()) return d;
  d.type = Hdf5Handle(H5Dget_type(d.dataset), &H5Tclose);
  const Hdf5Handle space(H5Dget_space(d.dataset), &H5Sclose);
  d.extent.resize(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, d.extent.data(), nullptr);
  return d;
}

/// One value of a dataset of numbers becomes `value`, as the bits of a double or as an integer.
void set_value(const Described& d, std::uint64_t value) {
  const Hdf5Handle space(H5Dget_space(d.dataset), &H5Sclose);
  std::vector<hsize_t> at;
  std::uint64_t place = value >> 8U;
  for (const hsize_t n : d.extent) {
    if (n == 0) return;
    at.push_back(place % n);
    place /= n;
  }
  if (!at.empty() && H5Sselect_elements(space, H5S_SELECT_SET, 1, at.data()) < 0) return;
  const Hdf5Handle one(H5Screate(H5S_SCALAR), &H5Sclose);
  const bool real = H5Tget_class(d.type) == H5T_FLOAT;
  const std::array<std::int64_t, 6> whole{-1, 0, 1, 255, 2147483647, -9223372036854775807};
  const std::array<double, 6> reals{-1.0, 0.0, 1e300, -1e-300, kUnset, HUGE_VAL};
  const std::size_t which = value % whole.size();
  H5Dwrite(d.dataset, real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64, one, space, H5P_DEFAULT,
           real ? static_cast<const void*>(&reals[which]) : &whole[which]);
}

void set_attribute(hid_t file, std::uint64_t value) {
  const bool kind = value % 2 == 0;
  const char* name = kind ? "kind" : "format_version";
  H5Adelete(file, name);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  const Hdf5Handle made(
      H5Acreate2(file, name, type_of(value >> 8U), space, H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
  H5Awrite(made, type_of(value >> 8U), &value);
}

void apply(hid_t file, const std::string& name, const Change& c) {
  const Described d = describe(file, name);
  if (!d.dataset.valid()) return;
  std::vector<hsize_t> extent = d.extent;
  switch (c.kind % 8) {
    case 0:
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      break;
    case 1:
      set_value(d, c.value);
      break;
    case 2:
      extent.resize(c.value % 4);
      for (std::size_t i = 0; i < extent.size(); ++i) extent[i] = (c.value >> (8 * (i + 1))) % 32;
      replace(file, name, d.type, extent);
      break;
    case 3:
      if (!extent.empty()) extent[0] = std::uint64_t{1} << (c.value % 64);
      replace(file, name, d.type, extent);
      break;
    case 4:
      replace(file, name, type_of(c.value), extent);
      break;
    case 5:
      set_attribute(file, c.value);
      break;
    case 6:
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      if (c.value % 2 == 0)
        H5Lcreate_soft(c.value % 4 == 0 ? "/notes" : name.c_str(), file, name.c_str(), H5P_DEFAULT,
                       H5P_DEFAULT);
      else
        H5Lcreate_external("other.h5", "/x", file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    default: {
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      const Hdf5Handle group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             &H5Gclose);
    }
  }
}

}  // namespace

void store(Input input) {
  Parts parts(input);
  const GoodFile& good = good_files()[parts.number() % good_files().size()];
  const auto path = file("changed.h5", good.bytes);
  {
    const Hdf5Handle opened(H5Fopen(path.c_str(), H5F_ACC_RDWR, file_access()), &H5Fclose);
    for (std::size_t i = 0; i < kMostChanges && !parts.empty(); ++i) {
      Change c{};
      c.kind = parts.number();
      c.dataset = parts.number();
      c.value = parts.number<std::uint64_t>();
      apply(opened, good.datasets[c.dataset % good.datasets.size()], c);
    }
  }
  accepts([&] { good.read(path); });
}

}  // namespace flowslide::fuzz

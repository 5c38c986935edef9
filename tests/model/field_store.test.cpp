#include "model/field_store.hpp"

#include "tests/model/scratch.hpp"

#include <csignal>
#include <cstdlib>
#include <limits>
#include <sys/resource.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <hdf5.h>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

void write_small(const std::filesystem::path& path) {
  FieldWriter out(path, "small", 1);
  out.write("a", std::vector<double>{1.0, 2.0, 3.0}, {.unit = "m", .convention = "upwards"});
  out.write("group/b", std::vector<std::array<std::int32_t, 2>>{{1, 2}, {3, 4}}, {.unit = ""});
  out.write_texts("words", {"one", "", "drei \xc3\xa4"});
  out.append("series", std::vector<double>{1.0, 2.0}, {.unit = "s"});
  out.append("series", std::vector<double>{3.0, 4.0}, {.unit = "s"});
  out.finish();
}

/// Edits a finished file with HDF5 itself.
template <class F>
void edit(const std::filesystem::path& path, F&& f) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  REQUIRE(file >= 0);
  f(file);
  REQUIRE(H5Fclose(file) >= 0);
}

template <class T>
void put(hid_t file, const char* name, hid_t type, const std::vector<T>& values) {
  const hsize_t n = values.size();
  const hid_t space = H5Screate_simple(1, &n, nullptr);
  const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  REQUIRE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  H5Dclose(set);
  H5Sclose(space);
}

FieldReader open_small(const std::filesystem::path& path) { return FieldReader(path, "small", 1); }

}  // namespace

TEST_CASE("named arrays come back") {
  const Scratch folder;
  write_small(folder / "s.h5");
  const FieldReader in = open_small(folder / "s.h5");
  CHECK(in.read<double>("a") == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(in.read<std::array<std::int32_t, 2>>("group/b", 2)[1] == std::array<std::int32_t, 2>{3, 4});
  CHECK(in.read_texts("words") == std::vector<std::string>{"one", "", "drei \xc3\xa4"});
  CHECK(in.rows("series") == 2);
  CHECK(in.read_row<double>("series", 1, 2) == std::vector<double>{3.0, 4.0});
  CHECK(in.has("group"));
  CHECK_FALSE(in.has("group/c"));
  CHECK_FALSE(in.has("none/c"));
  CHECK(in.names("group") == std::vector<std::string>{"b"});
  CHECK(stored_kind(folder / "s.h5") == "small");
}

TEST_CASE("a file that is no field file says so in words") {
  const Scratch folder;
  const std::filesystem::path path = folder / "s.h5";
  write_small(path);
  const std::string good = bytes_of(path);
  const auto refused = [&path](const std::string& text) {
    CHECK_THROWS_AS(open_small(path), FileError);
    CHECK_THROWS_WITH(open_small(path), Contains(text) && Contains("s.h5"));
    CHECK_THROWS_WITH(stored_kind(path), Contains(text));
  };
  SECTION("missing") {
    std::filesystem::remove(path);
    refused("does not exist");
  }
  SECTION("a folder") {
    std::filesystem::remove(path);
    std::filesystem::create_directory(path);
    refused("is a folder");
  }
  SECTION("zero length") {
    put_bytes(path, "");
    refused("is empty");
  }
  SECTION("git-LFS pointer") {
    put_bytes(path, "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n");
    refused("git lfs pull");
  }
  SECTION("text") {
    put_bytes(path, "time,x\n0,1\n");
    refused("not an HDF5 file");
  }
  SECTION("cut off") {
    put_bytes(path, good.substr(0, good.size() - 100));
    refused("cut off");
  }
  SECTION("cut off inside the first block") {
    put_bytes(path, good.substr(0, 20));
    refused("damaged");
  }
}

TEST_CASE("a file of another kind or version is an input error") {
  const Scratch folder;
  write_small(folder / "s.h5");
  CHECK_THROWS_AS(FieldReader(folder / "s.h5", "zone", 1), InputError);
  CHECK_THROWS_WITH(FieldReader(folder / "s.h5", "zone", 1),
                    Contains("of the kind 'small'") && Contains("'zone' is needed"));
  FieldWriter(folder / "new.h5", "small", 3).finish();
  CHECK_THROWS_WITH(open_small(folder / "new.h5"), Contains("format version 3"));
  const hid_t foreign =
      H5Fcreate((folder / "f.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(foreign);
  CHECK_THROWS_WITH(open_small(folder / "f.h5"), Contains("not written by flowslide"));
  CHECK(stored_kind(folder / "f.h5").empty());
}

TEST_CASE("datasets that do not fit are refused by name") {
  const Scratch folder;
  const std::filesystem::path path = folder / "s.h5";
  write_small(path);
  edit(path, [&folder](hid_t file) {
    put(file, "floats", H5T_NATIVE_FLOAT, std::vector<float>{0.5f, 2.0f});
    put(file, "with_nan", H5T_NATIVE_DOUBLE, std::vector<double>{1.0, kUnset});
    put(file, "infinite", H5T_NATIVE_DOUBLE,
        std::vector<double>{std::numeric_limits<double>::infinity()});
    put(file, "large", H5T_NATIVE_INT64, std::vector<std::int64_t>{1, 3000000000});
    H5Lcreate_soft("/a", file, "soft", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external((folder / "other.h5").c_str(), "/a", file, "elsewhere", H5P_DEFAULT,
                       H5P_DEFAULT);
    const hid_t outside = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(outside, "/etc/hostname", 0, 8);
    const hsize_t one = 1;
    const hid_t space = H5Screate_simple(1, &one, nullptr);
    H5Dclose(H5Dcreate2(file, "raw", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, outside, H5P_DEFAULT));
    const hsize_t huge[] = {hsize_t(1) << 40};
    const hid_t large = H5Screate_simple(1, huge, nullptr);
    const hid_t lazy = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = 1024;
    H5Pset_chunk(lazy, 1, &chunk);
    H5Dclose(H5Dcreate2(file, "bomb", H5T_NATIVE_DOUBLE, large, H5P_DEFAULT, lazy, H5P_DEFAULT));
    H5Sclose(large);
    H5Sclose(space);
    H5Pclose(outside);
    H5Pclose(lazy);
  });
  const FieldReader in = open_small(path);
  CHECK(in.read<double>("floats") == std::vector<double>{0.5, 2.0});
  CHECK(in.read<std::int64_t>("large")[1] == 3000000000);
  CHECK_THROWS_WITH(in.read<std::int32_t>("large"), Contains("3000000000"));
  CHECK_THROWS_WITH(in.read<std::int32_t>("floats"), Contains("whole numbers"));
  CHECK_THROWS_WITH(in.read<double>("words"), Contains("does not hold numbers"));
  CHECK_THROWS_WITH(in.read_texts("a"), Contains("does not hold text"));
  CHECK_THROWS_WITH(in.read<double>("with_nan"), Contains("'with_nan': value 1 is nan"));
  CHECK(in.read<double>("with_nan", 2, Nan::allowed)[0] == 1.0);
  CHECK_THROWS_WITH(in.read<double>("infinite", 1, Nan::allowed), Contains("is inf"));
  CHECK_THROWS_WITH(in.read<double>("nowhere"), Contains("'nowhere' is missing"));
  CHECK_THROWS_AS(in.read<double>("nowhere"), InputError);
  CHECK_THROWS_WITH(in.read<double>("a", 4), Contains("(3)") && Contains("expected (4)"));
  CHECK_THROWS_WITH((in.read<std::array<double, 3>>("a")), Contains("expected (3, 3)"));
  CHECK_THROWS_WITH(in.read_row<double>("series", 2, 2), Contains("no row 2"));
  CHECK_THROWS_WITH(in.read_row<double>("series", 0, 3), Contains("expected (2, 3)"));
  CHECK_THROWS_WITH(in.read<double>("soft"), Contains("is a link"));
  CHECK_THROWS_WITH(in.read<double>("elsewhere"), Contains("is a link"));
  CHECK_THROWS_WITH(in.read<double>("raw"), Contains("other files"));
  CHECK_THROWS_WITH(in.read<double>("bomb"), Contains("more than a file"));
}

TEST_CASE("values that must not be unset are refused on writing") {
  const Scratch folder;
  FieldWriter out(folder / "s.h5", "small", 1);
  CHECK_THROWS_WITH(out.write("a", std::vector<double>{kUnset}, {.unit = "m"}),
                    Contains("'a': value 0 is nan"));
  CHECK_NOTHROW(out.write("b", std::vector<double>{kUnset}, {.unit = "m", .nan = Nan::allowed}));
  out.append("c", std::vector<double>{1.0}, {.unit = "m"});
  CHECK_THROWS_WITH(out.append("c", std::vector<double>{1.0, 2.0}, {.unit = "m"}),
                    Contains("(2)") && Contains("(1)"));
}

TEST_CASE("a place that cannot be written is a file error") {
  const Scratch folder;
  CHECK_THROWS_AS(FieldWriter(folder / "no/such/folder/s.h5", "small", 1), FileError);
}

TEST_CASE("a full disk is a file error, and the program ends in order") {
  const Scratch folder;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      std::vector<double> values(100000);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0 / (1.0 + double(i));
      FieldWriter out(folder / "s.h5", "small", 1);
      out.write("a", values, {.unit = "m"});
      out.finish();
    } catch (const FileError& error) {
      const bool said = std::string(error.what()).find("File too large") != std::string::npos;
      code = said && folder.entries() == 0 ? 0 : 2;
    }
    std::exit(code);  // runs the exit handlers, HDF5's among them
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("no flipped byte goes unnoticed") {
  const Scratch folder;
  write_small(folder / "s.h5");
  const std::string good = bytes_of(folder / "s.h5");
  const auto content = [](const std::filesystem::path& path) {
    const FieldReader in = open_small(path);
    return std::make_tuple(in.read<double>("a"), in.read<std::array<std::int32_t, 2>>("group/b"),
                           in.read_texts("words"), in.read_row<double>("series", 0, 2),
                           in.read_row<double>("series", 1, 2));
  };
  const auto expected = content(folder / "s.h5");
  int noticed = 0, harmless = 0;
  for (std::size_t i = 0; i < good.size(); i += 83) {  // a sample: all bytes take half a minute
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    put_bytes(folder / "bad.h5", bad);
    try {
      if (content(folder / "bad.h5") == expected)
        ++harmless;
      else
        FAIL("byte " << i << " changed the content");
    } catch (const Error&) {
      ++noticed;
    }
  }
  CAPTURE(noticed, harmless, good.size());
  CHECK(noticed > 10);
}

TEST_CASE("nothing in a file carries the time at which it was written") {
  const Scratch folder;
  write_small(folder / "s.h5");
  const hid_t file = H5Fopen((folder / "s.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (const char* name : {"/", "a", "group", "group/b", "words", "series"}) {
    CAPTURE(name);
    H5O_info_t info{};
    REQUIRE(H5Oget_info_by_name(file, name, &info, H5P_DEFAULT) >= 0);
    CHECK(info.btime == 0);
    CHECK(info.ctime == 0);
    CHECK(info.mtime == 0);
    CHECK(info.atime == 0);
  }
  H5Fclose(file);
}

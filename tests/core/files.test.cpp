#include "core/files.hpp"

#include "core/check.hpp"
#include "core/temporary_folder.hpp"

#include <fcntl.h>
#include <fstream>
#include <sys/stat.h>

#include <catch2/catch.hpp>

using namespace flowslide;
namespace fs = std::filesystem;

namespace {

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("A file appears when it is committed, and not before") {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.txt";
  {
    OutputFile file(path);
    file.write("lost");
    CHECK(!fs::exists(path));
  }
  CHECK(entries(path.parent_path()) == 0);
  OutputFile file(path);
  const std::string large(200000, 'x');
  file.write(large);
  file.commit();
  CHECK(read_file(path, large.size()) == large);
  CHECK_THROWS_AS(read_file(path, large.size() - 1), FileError);
  CHECK(entries(path.parent_path()) == 1);
}

TEST_CASE("A link under the name of a file is replaced and not followed") {
  const TemporaryFolder folder;
  write_file(folder / "victim", "keep");
  fs::create_symlink("victim", folder / "a.txt");
  write_file(folder / "a.txt", "new");
  CHECK(read_file(folder / "victim", 100) == "keep");
  CHECK(!fs::is_symlink(folder / "a.txt"));
}

TEST_CASE("What is no regular file is refused, whatever it is") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(write_file(folder / "missing" / "a.txt", "x"), FileError);
  CHECK_THROWS_AS(read_file("/dev/zero", 100), FileError);
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_THROWS_AS(read_file(folder / "pipe", 100), FileError);
  CHECK_THROWS_AS(read_file(folder / ".", 100), FileError);
}

TEST_CASE("Writing a file again clears away what its killed writer left, and nothing else") {
  const TemporaryFolder folder;
  const fs::path left = temporary_name(folder / "a.txt"), other = temporary_name(folder / "b.txt");
  for (const fs::path& path : {left, other}) std::ofstream(path) << "half";
  write_file(folder / "a.txt", "whole");
  CHECK(!fs::exists(left));
  CHECK(fs::exists(other));
  CHECK(read_file(folder / "a.txt", 10) == "whole");
}

TEST_CASE("Only what writers left behind is cleared away") {
  const TemporaryFolder folder;
  const fs::path left = temporary_name(folder / "a.h5");
  for (const fs::path& path :
       {left, folder / "a.h5", folder / ".a.h5.partial", folder / "b.partial"})
    std::ofstream(path) << "x";
  remove_leftovers(folder / ".");
  CHECK(!fs::exists(left));
  CHECK(entries(folder / ".") == 3);
}

TEST_CASE("A name that is none is refused and costs no other file") {
  // The folder itself, with a slash at its end, has an empty file name, and so has nothing at all.
  const TemporaryFolder folder;
  const fs::path other = folder / "other.txt";
  std::ofstream(other) << "mine";
  CHECK_THROWS_AS(OutputFile(other.parent_path() / ""), FileError);
  CHECK_THROWS_AS(OutputFile(fs::path()), FileError);
  CHECK(entries(other.parent_path()) == 1);
}

TEST_CASE("What cannot be looked at is not absent") {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.txt", link = folder / "link";
  CHECK(!is_there(path));
  CHECK(!is_there(path / "below"));
  write_file(path, "a");
  CHECK(is_there(path));
  CHECK(!is_there(path / "below"));
  fs::create_symlink(folder / "nowhere", link);
  CHECK(!is_there(link));
  CHECK(own_type_of(link) == fs::file_type::symlink);
  // The system tells neither that it is there nor that it is not.
  const fs::path long_name = path.string() + std::string(300, 'x');
  CHECK_THROWS_AS(is_there(long_name), FileError);
  CHECK_THROWS_AS(own_type_of(long_name), FileError);
}

#include "core/unreadable.hpp"

#include "tests/support/scratch.hpp"

#include <filesystem>
#include <unistd.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("Why a file cannot be read is said by what is there", "[core]") {
  const Scratch scratch;
  scratch.write("here.txt", "1");
  CHECK(why_unreadable(scratch / "here.txt").empty());  // control
  CHECK(why_unreadable(scratch / "none.txt") == "no such file");
  CHECK(why_unreadable(scratch / "heer.txt") == "no such file. Did you mean 'here.txt'?");
  CHECK_THAT(why_unreadable(scratch / "a/b/none.txt"), Contains("/a does not exist"));
  fs::create_directory(scratch / "records");
  CHECK_THAT(why_unreadable(scratch / "record/none.txt"),
             Contains("/record does not exist). Did you mean 'records'?"));
  CHECK_THAT(why_unreadable("~/none.txt"), Contains("'~' is not expanded"));
  CHECK_THAT(why_unreadable(scratch.path()), Contains("is a folder"));
  CHECK_THAT(why_unreadable("/dev/zero"), Contains("no regular file"));
  fs::create_symlink("loop", scratch / "loop");
  CHECK_THAT(why_unreadable(scratch / "loop"), Contains("cannot be reached"));
  fs::create_symlink("gone", scratch / "link");
  CHECK_THAT(why_unreadable(scratch / "link"), Contains("link to gone"));
  CHECK_THAT(why_unreadable(scratch / std::string(300, 'x')), Contains("cannot be reached"));
  if (::geteuid() == 0) return;  // root may read everything
  fs::permissions(scratch / "here.txt", fs::perms::none);
  CHECK_THAT(why_unreadable(scratch / "here.txt"), Contains("cannot be read"));
}

#pragma once
#include "core/check.hpp"
#include "tests/support/scratch.hpp"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

/// A disk that is full at any byte, without the rights of root: no file can grow beyond a limit.
namespace flowslide::test {

/// Exit code of `work` in a child process whose files have at most `limit` bytes: 0, that of an
/// Error, 99 of another exception, or 128 + the signal that ended it.
template <class F>
int with_limited_files(std::uint64_t limit, F&& work) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit files{limit, limit};
    ::setrlimit(RLIMIT_FSIZE, &files);
    int code = 0;
    try {
      work();
    } catch (const Error& e) {
      code = e.exit_code();
    } catch (...) {
      code = 99;
    }
    ::_exit(code);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Regular files below a folder by relative name, with their bytes. Folders "X.partial", in which
/// the parts of a resumable file lie, are left out.
inline std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (std::filesystem::recursive_directory_iterator it(folder), end; it != end; ++it) {
    if (it->is_directory() && it->path().extension() == ".partial") it.disable_recursion_pending();
    if (it->is_regular_file())
      files[it->path().lexically_relative(folder)] = read_text_file(it->path());
  }
  return files;
}

/// Calls write(folder) under many limits up to the size of its largest file: it ends with all files
/// or with a FileError, what is there then is whole, and the same call without a limit then gives
/// what it gives at once.
template <class F>
void check_limited_files(F&& write, int limits = 40) {
  const Scratch whole;
  write(whole.path());
  const auto good = files_below(whole.path());
  std::uint64_t largest = 0;
  for (const auto& [name, bytes] : good) largest = std::max<std::uint64_t>(largest, bytes.size());
  REQUIRE(largest > 0);
  int failed = 0;
  for (int i = 0; i <= limits; ++i) {
    // The last steps are single bytes, where only what is written at the very end is lost.
    const std::uint64_t limit =
        i + 8 > limits
            ? largest - std::min<std::uint64_t>(largest, limits - i)
            : largest * static_cast<std::uint64_t>(i) / static_cast<std::uint64_t>(limits);
    CAPTURE(limit, largest);
    const Scratch folder;
    const int code = with_limited_files(limit, [&] { write(folder.path()); });
    REQUIRE((code == 0 || code == 4));
    failed += code == 4;
    const auto found = files_below(folder.path());
    if (code == 0) REQUIRE(found.size() == good.size());
    for (const auto& [name, bytes] : found) {
      CAPTURE(name);
      REQUIRE(good.count(name) == 1);
      REQUIRE((bytes == good.at(name)));
    }
    write(folder.path());
    REQUIRE((files_below(folder.path()) == good));
  }
  CHECK(failed > limits / 2);
}

}  // namespace flowslide::test

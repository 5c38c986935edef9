#pragma once
#include "tests/support/paths.hpp"
#include "tests/support/scratch.hpp"

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

/// Runs the program as a user does, in a folder of the test's own.
namespace flowslide::cli::test {

struct Outcome {
  int code = -1;  ///< 128 + n if signal n ended it
  std::string out, err;
};

/// Root reads what is closed to it, unless it gives that power up.
inline const std::string kWithoutPower =
    ::geteuid() == 0 ? "setpriv --bounding-set=-dac_override,-dac_read_search " : "";

inline Outcome call(const Scratch& scratch, const std::string& arguments,
                    const std::string& before = "") {
  // What runs take is not learnt into the home of who tests.
  const std::string command = "cd '" + scratch.path().string() +
                              "' && export XDG_CACHE_HOME=\"$PWD/cache\" && " + before +
                              FLOWSLIDE_BINARY " " + arguments + " >out.txt 2>err.txt";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          read_text_file(scratch / "out.txt"), read_text_file(scratch / "err.txt")};
}

/// What a terminal of so many columns shows of a command.
inline std::string on_terminal(const Scratch& scratch, const std::string& arguments,
                               std::size_t columns) {
  const winsize size{
      .ws_row = 24, .ws_col = static_cast<unsigned short>(columns), .ws_xpixel = 0, .ws_ypixel = 0};
  int master = -1;
  const pid_t child = ::forkpty(&master, nullptr, nullptr, &size);
  REQUIRE(child >= 0);
  if (child == 0) {
    const std::string command =
        "cd '" + scratch.path().string() +
        "' && export XDG_CACHE_HOME=\"$PWD/cache\" && exec " FLOWSLIDE_BINARY " " + arguments;
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  std::string text;
  char block[4096];
  // A terminal whose last process ends gives an error, not an end.
  for (ssize_t n = 0; (n = ::read(master, block, sizeof block)) > 0;)
    text.append(block, static_cast<std::size_t>(n));
  ::close(master);
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  return text;
}

/// One element of 1 m x 1 m at rest: enough to import.
inline void write_model(const Scratch& scratch) {
  scratch.write("nodes.txt", "1 0 0\n2 10 0\n3 10 10\n4 0 10\n");
  scratch.write("elements.txt", "1 1 2 3 4 1\n");
  scratch.write("stress.out", "0.1 -100 -200 0\n");
  scratch.write("pressure.out", "0.1 50 50 0 0\n");
}

inline std::string shake(const std::string& units = "{length: m, time: s, stress: kPa}") {
  return "  shake:\n    uses: import.opensees\n    with:\n"
         "      mesh: {nodes: nodes.txt, elements: elements.txt}\n"
         "      materials: {sand: {tag: 1, density: 1900 kg/m3}}\n"
         "      units: " +
         units +
         "\n"
         "      gravity: {stress: stress.out, pore_pressure: pressure.out}\n"
         "      sigma_zz: {rule: mean}\n";
}

inline Outcome run(const Scratch& scratch, const std::string& stages) {
  scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + stages);
  return call(scratch, "run w.yaml --out out");
}

/// Nothing that looks like a result.
inline void check_nothing_final(const Scratch& scratch) {
  CHECK_FALSE(std::filesystem::exists(scratch / "out/result.json"));
  if (!std::filesystem::exists(scratch / "out")) return;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch / "out"))
    if (entry.is_directory() && entry.path().parent_path().parent_path().filename() == "stages")
      CHECK(entry.path().extension() == ".partial");
}

}  // namespace flowslide::cli::test

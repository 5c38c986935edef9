#include "study/batch/command.hpp"

#include "core/check.hpp"
#include "study/run/child.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace flowslide::study {

namespace {

constexpr std::chrono::minutes kPatience{5};

}  // namespace

std::optional<CommandEnd> run_command(const std::vector<std::string>& words,
                                      const std::filesystem::path& folder,
                                      const std::atomic<bool>* stop) {
  constexpr int kNoFolder = 126, kNoProgram = 127;
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  Child child([&] {
    if (::chdir(folder.c_str()) != 0) return kNoFolder;
    ::signal(SIGINT, SIG_DFL);
    ::signal(SIGTERM, SIG_DFL);
    ::signal(SIGPIPE, SIG_DFL);
    ::signal(SIGXFSZ, SIG_DFL);
    ::execvp(arguments[0], arguments.data());
    return errno == ENOENT ? kNoProgram : kNoFolder;
  });
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  CommandEnd end;
  int status = 0;
  while (!child.has_ended(status)) {
    if (stop && stop->load())
      throw Interrupted(fmt::format("stopped while '{}' was running", words[0]));
    if (Clock::now() - start > kPatience)
      throw FileError(fmt::format(
          "{}: has not answered for {} minutes, and was ended. Run the same command again when it "
          "does; it asks first what is in the queue.",
          words[0], kPatience.count()));
    end.out += child.read_output();
    (void)child.read_errors();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  end.out += child.read_output();
  end.errors = child.read_errors();
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (end.code == kNoProgram) return std::nullopt;
  return end;
}

}  // namespace flowslide::study

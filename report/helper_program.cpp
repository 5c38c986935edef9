#include "report/helper_program.hpp"

#include "core/check.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <sstream>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kNoProgram = 127;
constexpr std::chrono::milliseconds kLongestPause(20);

std::optional<std::string> find_program(const std::string& name) {
  if (name.find('/') != std::string::npos)
    return ::access(name.c_str(), X_OK) == 0 ? std::optional(fs::absolute(name).string())
                                             : std::nullopt;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    if (file.is_absolute() && ::access(file.c_str(), X_OK) == 0) return file.string();
  }
  return std::nullopt;
}

/// In the new process, where only calls that are safe in a signal handler may be made: the other
/// threads of the parent may have held any lock.
[[noreturn]] void become(char* const* argv, const char* folder, const char* log, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kNoProgram);  // died before the line above
  const int in = ::open("/dev/null", O_RDONLY);
  const int out = ::open(log, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, 0644);
  if (in < 0 || out < 0 || ::dup2(in, 0) < 0 || ::dup2(out, 1) < 0 || ::dup2(out, 2) < 0 ||
      ::chdir(folder) != 0)
    ::_exit(kNoProgram);
  ::close_range(3, ~0u, 0);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::execv(argv[0], argv);
  ::_exit(kNoProgram);
}

/// A child that does not outlive this object, nor does what it has started.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() {
    if (pid_ < 0) return;
    ::kill(-pid_, SIGKILL);
    ::kill(pid_, SIGKILL);  // it may not have come to setpgid yet
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Its exit status if it has ended.
  std::optional<int> ended() {
    siginfo_t about{};
    const int failed =
        ::waitid(P_PID, static_cast<id_t>(pid_), &about, WEXITED | WNOHANG | WNOWAIT);
    if (failed == 0 && about.si_pid == 0) return std::nullopt;
    if (failed != 0 && errno == EINTR) return std::nullopt;
    ::kill(-pid_, SIGKILL);  // what it has left behind, while the number is still its own
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0)
      if (errno != EINTR) break;
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_;
};

}  // namespace

HelperOutcome run_helper(const HelperRun& run, const Progress& progress) {
  std::vector<std::string> arguments = run.arguments;
  const auto program = find_program(arguments.front());
  if (!program) return {.status = kNoProgram, .timed_out = false};
  arguments.front() = *program;
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0)
    throw FileError(fmt::format("'{}' cannot be started ({})", *program, std::strerror(errno)));
  if (pid == 0) become(argv.data(), run.folder.c_str(), run.log.c_str(), parent);
  Child child(pid);
  const auto start = Clock::now();
  for (auto pause = std::chrono::milliseconds(1);; pause = std::min(2 * pause, kLongestPause)) {
    if (const auto status = child.ended()) return {.status = *status, .timed_out = false};
    if (progress.should_stop())
      throw Interrupted(fmt::format("interrupted while '{}' was running", *program));
    if (std::chrono::duration<double>(Clock::now() - start).count() > run.seconds)
      return {.status = 128 + SIGKILL, .timed_out = true};
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace flowslide

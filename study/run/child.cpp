#include "study/run/child.hpp"

#include "core/check.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <new>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flowslide::study {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw FileError(fmt::format("{} cannot be made ({})", what, std::strerror(errno)));
}

void take(int file, std::string& text) {
  std::array<char, 4096> block{};
  for (ssize_t n = 0; (n = ::read(file, block.data(), block.size())) > 0;)
    text.append(block.data(), static_cast<std::size_t>(n));
}

int run(const std::function<int()>& body) {
  try {
    return body();
  } catch (const Error& e) {
    fmt::print(stderr, "error: {}\n", e.what());
    return e.exit_code();
  } catch (const std::bad_alloc&) {
    std::fputs("error: out of memory\n", stderr);
    return 4;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: internal error: {}\n", e.what());
    return 3;
  }
}

}  // namespace

Child::Child(const std::function<int()>& body) {
  std::array<int, 2> out{}, err{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0) refuse("a pipe");
  if (::pipe2(err.data(), O_CLOEXEC) != 0) {
    ::close(out[0]);
    ::close(out[1]);
    refuse("a pipe");
  }
  std::fflush(stdout);
  std::fflush(stderr);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {
    // Ctrl-C on the terminal is for the parent, which tells its children.
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(4);
    ::dup2(out[1], STDOUT_FILENO);
    ::dup2(err[1], STDERR_FILENO);
    const int nothing = ::open("/dev/null", O_RDONLY);
    if (nothing >= 0) ::dup2(nothing, STDIN_FILENO);
    const int code = run(body);
    std::fflush(stdout);
    std::fflush(stderr);
    ::_exit(code);
  }
  ::close(out[1]);
  ::close(err[1]);
  out_ = out[0];
  err_ = err[0];
  if (pid_ < 0) {
    ::close(out_);
    ::close(err_);
    refuse("a process");
  }
  ::fcntl(out_, F_SETFL, O_NONBLOCK);
  ::fcntl(err_, F_SETFL, O_NONBLOCK);
}

Child::Child(Child&& other) noexcept
    : pid_(other.pid_),
      out_(other.out_),
      err_(other.err_),
      pending_(std::move(other.pending_)),
      errors_(std::move(other.errors_)) {
  other.pid_ = -1;
  other.out_ = other.err_ = -1;
}

Child::~Child() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    int status = 0;
    ::waitpid(pid_, &status, 0);
  }
  if (out_ >= 0) ::close(out_);
  if (err_ >= 0) ::close(err_);
}

std::string Child::read_output() {
  take(out_, pending_);
  const std::size_t end = pending_.rfind('\n');
  if (end == std::string::npos) return "";
  std::string lines = pending_.substr(0, end + 1);
  pending_.erase(0, end + 1);
  return lines;
}

const std::string& Child::read_errors() {
  take(err_, errors_);
  constexpr std::size_t kMost = 16384;
  if (errors_.size() > kMost) errors_.erase(kMost / 2, errors_.size() - kMost);
  return errors_;
}

void Child::signal(int number) const {
  if (pid_ > 0) ::kill(pid_, number);
}

bool Child::has_ended(int& status) {
  if (pid_ <= 0 || ::waitpid(pid_, &status, WNOHANG) != pid_) return false;
  pid_ = -1;
  return true;
}

}  // namespace flowslide::study

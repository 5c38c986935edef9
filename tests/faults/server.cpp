#include "tests/faults/faults.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/// In place of main(), a server that runs main() in a fork for each job: loading the program's
/// libraries would take longer than most runs. A job is a line of fields with tabs between them,
///   output  root  kind  action  number  clock  limit  arguments...
/// and is answered by a line
///   status  fired  count  list
/// with the wait status, and Record's letters (files) or numbers (memory), each with ":place".
namespace faults {

Plan plan;
std::atomic<bool> armed = false;
Record* record = nullptr;

void die() {
  ::kill(::getpid(), SIGKILL);
  for (;;) ::pause();
}

namespace {

int outcome(Call call, int usual) {
  switch (plan.action) {
    case Action::none:
      return 0;
    case Action::fail:
      return usual;
    case Action::dead:
      return plan.memory ? ENOMEM : EIO;
    case Action::full:
      return call == Call::write || call == Call::make || usual == EMFILE ? ENOSPC : 0;
    case Action::part:
      return call == Call::write || call == Call::read ? kHalf : 0;
    case Action::interrupt:
      return EINTR;
    case Action::kill:
      die();
    case Action::torn:
      return call == Call::write ? kTorn : 0;
    case Action::cut:
    case Action::names:
      lose_unsynced();
      die();
    case Action::stop:
      ::kill(::getpid(), SIGTERM);
      return 0;
  }
  return 0;
}

}  // namespace

int strike(Call call, int usual) {
  const unsigned n = ++record->count;
  if (call != Call::memory && n <= Record::kMost) {
    record->list[n - 1] = static_cast<unsigned>(call);
    if (plan.number == 0) record->place[n - 1] = place_of_call();
  }
  const bool goes_on = plan.action == Action::full || plan.action == Action::dead;
  if (n < plan.number || (n > plan.number && !goes_on)) return 0;
  // Whoever waits for the answer learns of it even if the next line is the process's last.
  if (plan.number > 0) record->fired = 1;
  return plan.number > 0 ? outcome(call, usual) : 0;
}

namespace {

using Main = int(int, char**, char**);
Main* program = nullptr;

constexpr int kMostFields = 64;

/// One line from standard input without its end; false at the end of the input.
bool read_line(char* line, int size) {
  int n = 0;
  for (char c = 0; ::read(STDIN_FILENO, &c, 1) == 1; line[n++] = c) {
    if (c == '\n') {
      line[n] = 0;
      return true;
    }
    if (n + 1 == size) ::_exit(1);
  }
  return false;
}

[[noreturn]] void run_job(char** field, int fields, char** environment) {
  const int out = ::open(field[0], O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const int in = ::open("/dev/null", O_RDONLY);
  if (out < 0 || in < 0) ::_exit(125);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  ::close(in);
  ::close(out);
  ::alarm(static_cast<unsigned>(std::atoi(field[6])));
  plan = {static_cast<Action>(*field[3]), std::strcmp(field[2], "memory") == 0,
          static_cast<unsigned>(std::atoi(field[4])), std::atof(field[5]), field[1]};
  armed = true;
  const int code = program(fields - 7, field + 7, environment);
  if (plan.memory) armed = false;
  if (plan.action == Action::cut ||
      plan.action == Action::names) {  // after the last call: what the program called done is kept
    record->fired = 1;
    lose_unsynced();
  }
  std::exit(code);
}

void answer(int status) {
  static char text[1u << 16];
  int n = std::snprintf(text, sizeof text, "%d\t%u\t%u\t", status, record->fired.load(),
                        record->count.load());
  const unsigned entries = plan.memory ? record->points.load() : record->count.load();
  const auto send = [&] {
    if (::write(STDOUT_FILENO, text, static_cast<std::size_t>(n)) != n) ::_exit(1);
    n = 0;
  };
  for (unsigned i = 0; i < entries && i < Record::kMost; ++i) {
    n += plan.memory ? std::snprintf(text + n, 32, "%u:", record->list[i])
                     : std::snprintf(text + n, 32, "%c:", static_cast<char>(record->list[i]));
    n += std::snprintf(text + n, 32, "%u ", record->place[i]);
    if (n > static_cast<int>(sizeof text) - 64) send();
  }
  text[n++] = '\n';
  send();
}

int serve(int, char**, char** environment) {
  static char line[1u << 14];
  ::unsetenv("LD_PRELOAD");  // not for the programs that this one starts
  record = static_cast<Record*>(
      ::mmap(nullptr, sizeof(Record), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  while (read_line(line, sizeof line)) {
    char* field[kMostFields + 1] = {};
    int fields = 0;
    for (char* at = std::strtok(line, "\t"); at && fields < kMostFields;
         at = std::strtok(nullptr, "\t"))
      field[fields++] = at;
    if (fields < 8) return 1;
    record->count = record->fired = record->points = 0;
    const pid_t child = ::fork();
    if (child == 0) run_job(field, fields, environment);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    plan.memory = std::strcmp(field[2], "memory") == 0;
    answer(status);
  }
  return 0;
}

}  // namespace
}  // namespace faults

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*fini)(), void (*rtld_fini)(), void* stack_end) {
  using Start =
      int(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
  faults::program = main;
  return faults::next<Start>("__libc_start_main")(&faults::serve, argc, argv, init, fini, rtld_fini,
                                                  stack_end);
}

/// Checkpoints are made by wall time. A clock that moves on whenever somebody looks makes them, and
/// everything else that depends on time, the same in every run.
int clock_gettime(clockid_t clock, struct timespec* time) noexcept {
  static auto* const real = faults::next<int(clockid_t, struct timespec*)>("clock_gettime");
  static std::atomic<long> looks = 0;
  if (!faults::armed || !(faults::plan.clock > 0.0) || clock != CLOCK_MONOTONIC)
    return real(clock, time);
  const double now = 1000.0 + faults::plan.clock * static_cast<double>(++looks);
  time->tv_sec = static_cast<time_t>(now);
  time->tv_nsec = static_cast<long>((now - static_cast<double>(time->tv_sec)) * 1e9);
  return 0;
}
}

#pragma once
#include <atomic>
#include <dlfcn.h>

/// A library that is loaded before all others (LD_PRELOAD) and stands between the program and the
/// system: it counts the calls of a run and lets one of them, or all from one on, go wrong.
/// server.cpp has the protocol, faults.py asks.
namespace faults {

/// Kinds of calls, by the letter under which they are counted.
enum class Call : char {
  open = 'o',
  write = 'w',
  close = 'c',
  sync = 's',
  rename = 'n',
  remove = 'u',
  make = 'm',  ///< folders and links
  read = 'r',
  look = 'l',  ///< stat, listing of folders, locks, seeking
  memory = 'a',
};

/// What happens to the chosen call. `full` and `dead` go on for all calls after it.
enum class Action : char {
  none = '-',
  fail = 'f',       ///< the call does nothing and fails
  full = 'F',       ///< no byte and no name can be added any more: a full disk
  dead = 'd',       ///< every call fails: a disk that was pulled out, or no memory at all
  part = 'p',       ///< reads or writes only half of the bytes, which is no error
  interrupt = 'i',  ///< EINTR
  kill = 'k',       ///< SIGKILL in its place
  torn = 't',       ///< SIGKILL after half of the bytes
  cut = 'c',        ///< power cut: what was not synced is gone, and the process with it
  names = 'C',      ///< the same, and renames are undone whose folder was not synced
  stop = 's',       ///< SIGTERM, the call goes well
};

/// What the calls of one run came to; lies in memory shared with the server.
struct Record {
  static constexpr unsigned kMost = 1u << 20;
  std::atomic<unsigned> count, fired, points;
  /// files: the letter of call i + 1; memory: numbers of the first call from each place.
  unsigned list[kMost];
  unsigned place[kMost];  ///< of what `list` names, in a run in which nothing is to go wrong
};

struct Plan {
  Action action = Action::none;
  bool memory = false;    ///< else files
  unsigned number = 0;    ///< from 1
  double clock = 0.0;     ///< seconds by which a look at the steady clock moves it on; 0: real time
  const char* root = "";  ///< file calls count below this folder
};

extern Plan plan;
extern std::atomic<bool> armed;
extern Record* record;

/// Called by every call that counts. 0: let it pass; kHalf: half of the bytes; kTorn: half of the
/// bytes, then die(); else the errno with which it fails. `usual` is that of its kind.
int strike(Call call, int usual);
inline constexpr int kHalf = -1, kTorn = -2;

/// A number for the place that the call comes from, the addresses of its innermost callers: the
/// same in every process. places.cpp
unsigned place_of_call();

[[noreturn]] void die();
/// Before a power cut dies: what was written and not synced since is lost. files.cpp
void lose_unsynced();

/// The function that the program would have called.
template <class F>
F* next(const char* name) {
  return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace faults

#include "tests/faults/unsynced.hpp"

#include "tests/faults/faults.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

/// Descriptors of our own keep the files in reach after they were closed and renamed.
namespace faults {
namespace {

struct Written {
  dev_t device = 0;
  ino_t node = 0;
  int copy = -1;
  bool unsynced = false;
};

constexpr int kMost = 1024;
constexpr int kFirstCopy = 2048;  ///< out of the way of the program's descriptors
Written written[kMost];
int used = 0;

Written* find(int file) {
  struct stat about {};
  if (::syscall(SYS_fstat, file, &about) != 0) return nullptr;
  for (int i = 0; i < used; ++i)
    if (written[i].device == about.st_dev && written[i].node == about.st_ino) return &written[i];
  if (used == kMost) return nullptr;
  written[used] = {about.st_dev, about.st_ino, -1, false};
  return &written[used++];
}

}  // namespace

void note_open(int file) {
  if (plan.action != Action::cut) return;
  Written* const w = find(file);
  if (!w) return;
  // A node that was used before and is free again may come back as another file.
  if (w->copy >= 0) ::syscall(SYS_close, w->copy);
  *w = {w->device, w->node, ::fcntl(file, F_DUPFD_CLOEXEC, kFirstCopy), w->unsynced};
}

void note_change(int file) {
  if (plan.action != Action::cut) return;
  if (Written* const w = find(file)) w->unsynced = true;
}

void note_sync(int file) {
  if (plan.action != Action::cut) return;
  if (Written* const w = find(file)) w->unsynced = false;
}

void lose_unsynced() {
  for (int i = 0; i < used; ++i)
    if (written[i].unsynced && written[i].copy >= 0) ::syscall(SYS_ftruncate, written[i].copy, 0);
}

}  // namespace faults

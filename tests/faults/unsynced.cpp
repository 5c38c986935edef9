#include "tests/faults/unsynced.hpp"

#include "tests/faults/faults.hpp"

#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <linux/limits.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

/// Descriptors of our own keep files and folders in reach after they were closed or moved. Calls go
/// straight to the system, past those that count.
namespace faults {
namespace {

constexpr int kFirstCopy = 2048;  ///< out of the way of the program's descriptors

struct Written {
  struct stat about {};
  int copy = -1;
  off_t synced = 0;  ///< bytes that are safe
};
Written written[1024];
int files = 0;

struct Renamed {
  int from_folder = -1, to_folder = -1;
  char from[NAME_MAX + 1] = {}, to[NAME_MAX + 1] = {};
  char old[PATH_MAX] = {};  ///< where what was replaced is kept, if there was something
};
Renamed renamed[256];
int renames = 0;

bool wanted() { return plan.action == Action::cut || plan.action == Action::names; }

bool look(int file, struct stat& about) { return ::syscall(SYS_fstat, file, &about) == 0; }

bool same(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/// The folder of a path as a descriptor, and its last name.
int folder_of(int folder, const char* path, char* name) {
  char parent[PATH_MAX];
  const char* const slash = std::strrchr(path, '/');
  const int length = slash ? static_cast<int>(slash - path) : 0;
  std::snprintf(parent, sizeof parent, "%.*s%s", length, path, slash ? "/" : ".");
  std::snprintf(name, NAME_MAX + 1, "%s", slash ? slash + 1 : path);
  const auto found = ::syscall(SYS_openat, folder, parent, O_PATH | O_DIRECTORY | O_CLOEXEC);
  const int copy = ::fcntl(static_cast<int>(found), F_DUPFD_CLOEXEC, kFirstCopy);
  ::syscall(SYS_close, found);
  return copy;
}

}  // namespace

void note_open(int file) {
  struct stat about {};
  if (!wanted() || files == 1024 || !look(file, about)) return;
  for (int i = 0; i < files; ++i)
    if (same(written[i].about, about)) return;
  written[files++] = {about, ::fcntl(file, F_DUPFD_CLOEXEC, kFirstCopy), about.st_size};
}

void note_sync(int file) {
  struct stat about {};
  if (!wanted() || !look(file, about)) return;
  for (int i = 0; i < files; ++i)
    if (same(written[i].about, about)) written[i].synced = about.st_size;
  if (!S_ISDIR(about.st_mode)) return;
  for (int i = 0; i < renames; ++i) {
    struct stat folder {};
    if (look(renamed[i].to_folder, folder) && same(folder, about)) renamed[i].to_folder = -1;
  }
}

void note_rename(int from_folder, const char* from, int to_folder, const char* to) {
  if (plan.action != Action::names || renames == 256) return;
  Renamed& r = renamed[renames++];
  r.from_folder = folder_of(from_folder, from, r.from);
  r.to_folder = folder_of(to_folder, to, r.to);
  std::snprintf(r.old, sizeof r.old, "%s/replaced.%d", plan.root, renames);
  if (::syscall(SYS_linkat, r.to_folder, r.to, AT_FDCWD, r.old, 0) != 0) r.old[0] = 0;
}

void lose_unsynced() {
  for (int i = renames; i-- > 0;) {
    Renamed& r = renamed[i];
    if (r.to_folder >= 0) {
      ::syscall(SYS_renameat, r.to_folder, r.to, r.from_folder, r.from);
      if (r.old[0]) ::syscall(SYS_renameat, AT_FDCWD, r.old, r.to_folder, r.to);
    }
  }
  for (int i = 0; i < files; ++i) {
    struct stat now {};
    if (look(written[i].copy, now) && now.st_size > written[i].synced)
      ::syscall(SYS_ftruncate, written[i].copy, written[i].synced);
  }
}

}  // namespace faults

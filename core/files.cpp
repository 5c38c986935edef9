#include "core/files.hpp"

#include "core/check.hpp"
#include "core/unreadable.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr std::string_view kEnding = ".partial";
constexpr std::size_t kRandomDigits = 16;
constexpr std::size_t kBufferBytes = 1u << 16;

[[noreturn]] void fail(const fs::path& path, std::string_view problem, int reason) {
  throw FileError(fmt::format("'{}' {} ({})", path.string(), problem, std::strerror(reason)));
}

fs::path folder_of(const fs::path& path) {
  return path.parent_path().empty() ? "." : path.parent_path();
}

/// A descriptor that is closed at the latest when it goes out of scope; close() tells whether the
/// system had something to say.
class Descriptor {
 public:
  explicit Descriptor(int file) : file_(file) {}
  ~Descriptor() {
    if (file_ >= 0) ::close(file_);
  }
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return file_; }
  int close() { return ::close(std::exchange(file_, -1)); }

 private:
  int file_;
};

/// The name for which a temporary one stands; empty if it is none.
std::string target_of(const fs::path& temporary) {
  const std::string name = temporary.filename().string();
  const std::size_t around = 2 + kRandomDigits + kEnding.size();  // both dots
  if (name.size() <= around || !name.starts_with('.') || !name.ends_with(kEnding)) return {};
  const std::size_t dot = name.size() - kEnding.size() - kRandomDigits - 1;
  const auto first = name.begin() + static_cast<std::ptrdiff_t>(dot) + 1;
  const bool made =
      name[dot] == '.' &&
      std::all_of(first, first + kRandomDigits, [](unsigned char c) { return std::isxdigit(c); });
  return made ? name.substr(1, dot - 1) : std::string();
}

/// Removes what killed writers of one file left.
void remove_leftovers(const fs::path& folder, const std::string& target) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end;
       it.increment(ignored))
    if (target_of(it->path()) == target) found.push_back(it->path());
  for (const fs::path& path : found) remove_path(path);
}

fs::file_type known(const fs::path& path, fs::file_status status, const std::error_code& error) {
  if (status.type() == fs::file_type::none) fail(path, "cannot be reached", error.value());
  return status.type();
}

Descriptor open_regular(const fs::path& path) {
  // Without O_NONBLOCK the opening of a pipe waits for a writer, for ever if there is none.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) {
    const int reason = errno;
    const std::string why = reason == ENOENT ? why_unreadable(path) : "";
    if (!why.empty()) throw FileError(fmt::format("'{}': {}", path.string(), why));
    fail(path, "cannot be read", reason);
  }
  struct stat about {};
  if (::fstat(file.get(), &about) != 0) fail(path, "cannot be read", errno);
  if (!S_ISREG(about.st_mode))
    throw FileError(fmt::format("'{}' is {} (a regular file is needed, whose end is known)",
                                path.string(),
                                S_ISDIR(about.st_mode) ? "a folder" : "a pipe or a device"));
  return file;
}

}  // namespace

fs::path temporary_name(const fs::path& path) {
  // A name that is none must not match those of other files, which are no leftovers.
  if (path.filename().empty())
    throw FileError(
        fmt::format("'{}' names no file (it is empty or ends with a slash) give the name of a file",
                    path.string()));
  // A file that is renamed takes the place of a device, for all programs of the machine.
  std::error_code unknown;
  const fs::file_type type = fs::status(path, unknown).type();
  if (type == fs::file_type::character || type == fs::file_type::block ||
      type == fs::file_type::fifo || type == fs::file_type::socket)
    throw FileError(fmt::format(
        "'{}' is a pipe or a device (a file would take its place) give the name of a file",
        path.string()));
  // Where the folder cannot be listed it may still be written.
  remove_leftovers(folder_of(path), path.filename().string());
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != sizeof number)
    fail(path, "cannot get a temporary name", errno);
  return folder_of(path) /
         fmt::format(".{}.{:0{}x}{}", path.filename().string(), number, kRandomDigits, kEnding);
}

OutputFile::OutputFile(fs::path path)
    : path_(std::move(path)),
      temporary_(temporary_name(path_)),
      file_(
          ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail(path_, "cannot be written", errno);
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(const void* bytes, std::size_t size) {
  if (buffer_.size() + size >= kBufferBytes) flush();
  if (size >= kBufferBytes)
    put(static_cast<const char*>(bytes), size);
  else
    buffer_.append(static_cast<const char*>(bytes), size);
}

void OutputFile::flush() {
  put(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void OutputFile::put(const char* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = ::write(file_, bytes + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(path_, "cannot be written; is the disk full?", n < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(n);
  }
}

void OutputFile::commit() {
  FLOWSLIDE_EXPECT(file_ >= 0);
  flush();
  if (::fsync(file_) != 0) fail(path_, "cannot be flushed to the disk", errno);
  if (::close(std::exchange(file_, -1)) != 0) fail(path_, "cannot be closed", errno);
  rename_durably(temporary_, path_);
  temporary_.clear();
}

void write_file(const fs::path& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

void expect_regular_file(const fs::path& path) { open_regular(path); }

void read_blocks(const fs::path& path, const std::function<void(std::string_view)>& take) {
  const Descriptor file = open_regular(path);
  std::vector<char> block(kBufferBytes);
  for (;;) {
    const ssize_t n = ::read(file.get(), block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, "cannot be read", errno);
    if (n == 0) return;
    take({block.data(), static_cast<std::size_t>(n)});
  }
}

std::string read_file(const fs::path& path, std::uint64_t limit) {
  std::string bytes;
  read_blocks(path, [&](std::string_view block) {
    bytes += block;
    if (bytes.size() > limit)
      throw FileError(fmt::format("'{}' has more than {} bytes (too many for what it should be)",
                                  path.string(), limit));
  });
  return bytes;
}

fs::file_type type_of(const fs::path& path) {
  std::error_code error;
  return known(path, fs::status(path, error), error);
}

fs::file_type own_type_of(const fs::path& path) {
  std::error_code error;
  return known(path, fs::symlink_status(path, error), error);
}

void sync_path(const fs::path& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) fail(path, "cannot be flushed to the disk", errno);
  // Some network disks cannot sync a folder; there the rename itself has to be enough.
  if (::fsync(file.get()) != 0 && errno != EINVAL)
    fail(path, "cannot be flushed to the disk", errno);
  if (file.close() != 0) fail(path, "cannot be closed", errno);
}

void sync_tree(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> folders{folder};
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (it->is_symlink()) continue;
    if (it->is_directory())
      folders.push_back(it->path());
    else if (it->is_regular_file())
      sync_path(it->path());
  }
  if (error) fail(folder, "cannot be listed", error.value());
  for (auto it = folders.rbegin(); it != folders.rend(); ++it) sync_path(*it);
}

void rename_durably(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0)
    fail(to, fmt::format("cannot take the place of '{}'", from.filename().string()), errno);
  sync_path(folder_of(to));
  if (folder_of(from) != folder_of(to)) sync_path(folder_of(from));
}

void make_folders(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return;
  const fs::path parent = folder.parent_path();
  if (parent != folder) make_folders(parent);
  // "a/" has the parent "a", which is the same folder.
  if (::mkdir(folder.c_str(), 0777) != 0 && !(errno == EEXIST && fs::is_directory(folder, error)))
    fail(folder, "cannot be made a folder", errno);
  sync_path(parent.empty() ? "." : parent);
}

void remove_path(const fs::path& path) {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) fail(path, "cannot be removed", error.value());
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (!target_of(it->path()).empty()) found.push_back(it->path());
  if (error) fail(folder, "cannot be listed", error.value());
  for (const fs::path& path : found) remove_path(path);
}

}  // namespace flowslide

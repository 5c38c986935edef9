#pragma once
#include <filesystem>
#include <string>

namespace flowslide::study {

/// Locks on keys of a store, held by this object until its destruction and ended with the process
/// however it ends. All are ranges of one file, DIR/.locks, so that none is left behind.
class Locks {
 public:
  /// Creates the file. Throws FileError.
  explicit Locks(const std::filesystem::path& folder);
  ~Locks();
  Locks(const Locks&) = delete;
  Locks& operator=(const Locks&) = delete;

  /// The files of a result are read: they may not go. False if they are being made or taken away.
  bool take_shared(const std::string& key);
  /// A result is made or taken away. False if another process has or reads it.
  bool take(const std::string& key);
  void release(const std::string& key);
  /// Would take() fail?
  [[nodiscard]] bool is_taken(const std::string& key) const;

 private:
  bool set(const std::string& key, short kind);
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace flowslide::study

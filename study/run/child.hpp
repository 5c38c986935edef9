#pragma once
#include <functional>
#include <string>
#include <sys/types.h>

namespace flowslide::study {

/// A process of our own that ends with this one, however that ends.
class Child {
 public:
  /// `body` runs in the new process, with what it prints going to the parent; what it returns is
  /// the exit code. Throws FileError where there is no process to be had.
  explicit Child(const std::function<int()>& body);
  ~Child();
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;
  Child(const Child&) = delete;

  [[nodiscard]] int output() const { return out_; }
  [[nodiscard]] int errors() const { return err_; }
  /// What has arrived on standard output since, in whole lines.
  std::string read_output();
  /// All that has arrived on standard error.
  const std::string& read_errors();
  void signal(int number) const;
  /// Has it ended? Then its wait status.
  bool has_ended(int& status);

 private:
  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
  std::string pending_, errors_;
};

}  // namespace flowslide::study

#pragma once
#include "study/plan/plan.hpp"
#include "workflows/engine/record.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// DIR/stages/STAGE/: what stages of a study have found, by key. Results lie there as in the folder
/// of a run (docs/adr/0014-studies.md):
///   KEY/             files of a result, while they are kept
///   KEY.partial/     where a stage works
///   KEY.json         what it found and the checksums of its outputs; stays when the files go
///   KEY.final.h5     last state of a runout whose frames have gone
///   KEY.failed.json  why it failed
namespace flowslide::study {

/// A stage that has been computed, whether or not its files are still there.
struct Finished {
  StageRecord record;
  double peak_memory = 0.0;  ///< of the process that computed it [bytes]; 0 if unknown
};

struct Failure {
  int code = 3;            ///< exit code of the stage; 128 + signal if one ended it
  std::string text;        ///< its message
  std::string program;     ///< program_version() of the program that failed
  bool permanent = false;  ///< would the same program fail again?
};

class Store {
 public:
  explicit Store(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Paths of a key: its result, and the files beside it.
  [[nodiscard]] std::filesystem::path result(const std::string& stage, const std::string& key) const;
  [[nodiscard]] std::filesystem::path beside(const std::string& stage, const std::string& key,
                                             std::string_view ending) const;

  /// Nothing if it is not there, damaged, or of another key.
  [[nodiscard]] std::optional<Finished> finished(const std::string& stage,
                                                 const std::string& key) const;
  void write(const Finished& finished) const;
  [[nodiscard]] std::optional<Failure> failure(const std::string& stage,
                                               const std::string& key) const;
  void write(const std::string& stage, const std::string& key, const Failure& failure) const;
  void forget_failure(const std::string& stage, const std::string& key) const;
  /// Are the files of a result there? Whether they are whole is looked at when they are used.
  [[nodiscard]] bool has_files(const std::string& stage, const std::string& key) const;
  /// Takes the files of a result away at once: under their name there is all or nothing.
  void drop_files(const std::string& stage, const std::string& key) const;
  /// What killed processes have begun to take away.
  void sweep() const;

 private:
  std::filesystem::path folder_;
};

/// Bytes of a file, or of all in a folder; 0 if there is none.
double bytes_of(const std::filesystem::path& path);

inline constexpr std::string_view kPlanFile = "study.json";
void write_plan(const std::filesystem::path& folder, const Plan& plan);
/// InputError if the folder is none of a study.
Plan read_plan(const std::filesystem::path& folder);

}  // namespace flowslide::study

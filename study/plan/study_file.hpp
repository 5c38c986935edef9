#pragma once
#include "study/numbers/design.hpp"
#include "study/numbers/distribution.hpp"
#include "study/plan/amount.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A study file as it is written. docs/guide/studies.md
namespace flowslide::study {

/// Settings by path, each with the text of its value.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// One value of a variable; a table or zipped lists set several settings at once.
struct Choice {
  std::string label;
  Settings set;
  std::vector<std::string>
      places;  ///< of each of `set` in a table; else empty, and as the variable's
};

struct Variable {
  std::string name;
  std::string place;  ///< "study.yaml:14:7", for messages
  std::vector<std::string> settings;
  std::optional<std::string> unit;  ///< of a number; absent for words
  std::vector<Choice> choices;
};

struct SampledInput {
  std::string name, place;
  std::vector<std::string> settings;
  std::string unit;
  Distribution distribution;
};

struct Sample {
  Sampling method = Sampling::latin_hypercube;
  std::size_t count = 0;
  std::uint64_t seed = 1;
  std::vector<SampledInput> inputs;
  std::vector<Correlated> correlations;
};

/// The same row again with a disturbance that means nothing, to see what numerics make of it.
struct Repeat {
  std::string place;
  std::size_t count = 1;  ///< realisations; the first is the undisturbed one
  double motion = 0.0;    ///< step of the relative change of every motion's amplitude
  bool grid = false;      ///< is the grid moved within a cell?
  std::vector<std::pair<std::string, double>> scale;     ///< further settings, with their steps
  std::map<std::string, std::vector<std::string>> rows;  ///< labels by variable; empty: all rows
};

/// Rows that come from one workflow.
struct Part {
  std::string variant;  ///< "base", or its name under `also`
  std::filesystem::path workflow;
  Settings set;
  std::vector<std::string> places;  ///< where each entry of `set` was written
  std::vector<Variable> vary;
  std::optional<Sample> sample;
  std::optional<Repeat> repeat;
};

/// What stays of a stage when no stage of the study needs its files any more.
enum class Keep { numbers, final, frames };
inline constexpr std::array<std::string_view, 3> kKeeps{"numbers", "final", "frames"};

struct Limits {
  double stage_seconds = 24.0 * 3600.0;  ///< of one stage in one session [s]
};

/// What tasks of a cluster ask Slurm for. What is empty or unset is left to the cluster, or follows
/// from what the stages are expected to take.
struct SlurmSettings {
  std::string partition, account;
  std::size_t cpus = 1;              ///< of a task: as many stages side by side
  double memory = kUnset;            ///< of a task [bytes]
  double time = kUnset;              ///< limit of a task [s]
  double chunk = 1800.0;             ///< that a task is expected to take at least [s]
  std::vector<std::string> options;  ///< further ones of sbatch, "--qos=low"
};

struct Analysis {
  std::vector<std::string> results;  ///< columns; empty: those that are there of the usual ones
  std::vector<std::pair<std::string, std::string>> thresholds;  ///< (x, y) columns
  std::uint64_t seed = 1;                                       ///< of the resampling
  std::map<std::string, std::string> places;                    ///< where each column was named
};

struct StudyFile {
  std::string name, description;
  std::filesystem::path file;
  std::vector<Part> parts;
  Keep keep = Keep::final;
  double disk_bytes = 2e9;
  Limits limits;
  SlurmSettings slurm;
  Analysis analysis;
};

/// Throws InputError with file, line and column; FileError.
StudyFile read_study(const std::filesystem::path& path);

}  // namespace flowslide::study

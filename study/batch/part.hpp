#pragma once
#include "study/batch/pack.hpp"
#include "study/run/pool.hpp"

#include <filesystem>
#include <string>
#include <vector>

/// What a job array has to do, as a file that its tasks read on their machines.
namespace flowslide::study {

struct ArrayRecord {
  std::size_t cpus = 1;
  double memory = 1e9;  ///< of a task [bytes]
  bool retry = false;
  std::vector<std::string> allowed_programs;
  /// By task: recipes of its nodes. They mean the same in every plan of a study.
  std::vector<std::vector<std::string>> tasks;
};

void write_array(const std::filesystem::path& file, const ArrayRecord& record);
/// FileError if it is not there, InputError if it is none.
ArrayRecord read_array(const std::filesystem::path& file);

/// By node of a plan: is it in the task? InputError if there is no such task.
std::vector<bool> nodes_of_task(const Plan& plan, const ArrayRecord& record, std::size_t task);

}  // namespace flowslide::study

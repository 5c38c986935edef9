#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace flowslide::fuzz {

/// A small file as a stage writes it, and all that its readers do.
struct GoodFile {
  std::string bytes;
  std::vector<std::string> datasets;  ///< names, in the order of the file
  void (*read)(const std::filesystem::path&);
};

/// One of each kind: mesh, motion, fem_history, zone, particles, mpm_history.
const std::vector<GoodFile>& good_files();

}  // namespace flowslide::fuzz

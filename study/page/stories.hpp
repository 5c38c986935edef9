#pragma once
#include "study/plan/plan.hpp"
#include "study/table/table.hpp"

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

/// What the pages of the runs hold that rows can be laid over one another with.
namespace flowslide::study {

struct Stories {
  bool has_section = false;          ///< of a run at least
  std::string json;                  ///< {section, fronts}; scripts/fronts.js reads it
  std::string curves;                ///< JSON of study/page/curves.hpp; empty: none
  std::string curve_arrays;          ///< their ordinates, packed
  std::vector<std::size_t> damaged;  ///< rows whose page cannot be read, from 0
};

/// Reads the pages, which are paths relative to the folder and "" for rows without one. The section
/// is that of the first row that has one; `section.other_rows` tells those that have another.
/// `fronts` are the places at which the fronts of all rows came to rest, null where none is known.
/// Throws FileError, and Interrupted when it is to stop.
Stories read_stories(const std::filesystem::path& folder, const Table& table,
                     const std::vector<std::string>& reports,
                     const std::atomic<bool>* stop = nullptr);

}  // namespace flowslide::study

#pragma once
#include <filesystem>
#include <string>

/// Where results lie in a run folder, and how a new one takes its place.
namespace flowslide {

/// DIR/stages/<stage>/<first 16 digits of the key>
std::filesystem::path result_folder(const std::filesystem::path& run_folder,
                                    const std::string& stage, const std::string& key);

/// The same with ".partial": where a stage works until it is complete.
std::filesystem::path work_folder(const std::filesystem::path& run_folder, const std::string& stage,
                                  const std::string& key);

/// An empty `work`, a work_folder of `run_folder`, or what is there if `keep`. FileError if a
/// folder between the two is a link: what is written and removed must stay in the run folder.
void make_work_folder(const std::filesystem::path& run_folder, const std::filesystem::path& work,
                      bool keep);

/// Removes a work folder for which there is a result; one behind a link stays.
void remove_work_folder(const std::filesystem::path& run_folder, const std::filesystem::path& work);

/// Syncs `work` and gives it the name `result`. A former result goes only afterwards: after a power
/// cut the old or the new is there.
void install_result(const std::filesystem::path& work, const std::filesystem::path& result);

}  // namespace flowslide

#pragma once
#include "study/run/session_record.hpp"
#include "study/table/analysis.hpp"

#include <atomic>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace flowslide::study {

struct Page {
  std::string html;                            ///< one file, opens offline
  std::map<std::string, std::string> figures;  ///< SVG by file name
};

/// What is not in the table.
struct StudyAbout {
  std::vector<SessionRecord> sessions;  ///< what it cost
  std::vector<std::string> reports;     ///< page of each row's run, beside the study's; "" for none
};

Page make_page(const Plan& plan, const Table& table, const StudyFindings& findings,
               const StudyAbout& about = {});

/// table.csv, columns.csv, table.h5, analysis.json, study.html and figures/ in the folder of the
/// study. Throws FileError, and Interrupted once `stop` is set. In figures/ only those go that an
/// earlier page, by its analysis.json, has written; a figures/ that is a link is refused.
void write_tables(const std::filesystem::path& folder, const Plan& plan, const Table& table);
void write_page(const std::filesystem::path& folder, const Plan& plan, const Table& table,
                const std::atomic<bool>* stop = nullptr);

}  // namespace flowslide::study

#pragma once
#include "study/page/embedded.hpp"
#include "study/page/stories.hpp"
#include "study/run/session_record.hpp"
#include "study/table/analysis.hpp"

#include <atomic>
#include <filesystem>
#include <map>
#include <optional>
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
  /// Page of each row's run: its path beside the study's, or its id in `embedded`; "" for none.
  std::vector<std::string> reports;
  std::optional<EmbeddedRuns> embedded = {};  ///< in the page itself
  std::optional<Stories> stories = {};        ///< what the pages of runs say
};

Page make_page(const Plan& plan, const Table& table, const StudyFindings& findings,
               const StudyAbout& about = {});

/// table.csv, columns.csv, table.h5, analysis.json, study.html and figures/ in the folder of the
/// study. Throws FileError, and Interrupted once `stop` is set. In figures/ only those go that an
/// earlier page, by its analysis.json, has written; a figures/ that is a link is refused.
void write_tables(const std::filesystem::path& folder, const Plan& plan, const Table& table);
void write_page(const std::filesystem::path& folder, const Plan& plan, const Table& table,
                const std::atomic<bool>* stop = nullptr);

/// The page with those of its runs in it.
struct WholePage {
  std::filesystem::path path;
  std::size_t bytes = 0;
  std::size_t states = 0;      ///< of the player that has most
  std::size_t all_states = 0;  ///< that it has on its own page
  std::size_t rows = 0;        ///< whose run is in it
  // Rows whose run is not, from 1.
  std::vector<std::size_t> not_done;
  std::vector<std::size_t> no_report;  ///< of a workflow without the stage
  std::vector<std::size_t> not_kept;   ///< done, but their page is not on the disk
};

/// How much of the players is in it.
struct WholeSize {
  /// At most so many states in each; 0: as many as keep the file below `bytes`, though not fewer
  /// than a dozen.
  std::size_t states = 0;
  double bytes = 60e6;  ///< what mail takes, and a browser opens without a wait
};

/// study-whole.html in the folder of the study: one file that can be sent. Throws as write_page.
WholePage write_whole_page(const std::filesystem::path& folder, const Plan& plan,
                           const Table& table, const WholeSize& size = {},
                           const std::atomic<bool>* stop = nullptr);

}  // namespace flowslide::study

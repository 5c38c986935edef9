#include "core/files.hpp"
#include "core/hash.hpp"
#include "study/page/page.hpp"
#include "workflows/engine/names.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace flowslide::study {
namespace {

constexpr std::uint64_t kLargest = 64u << 20;

/// Digests of the figures that the page before this one has written, by file name.
std::map<std::string, std::string> figures_before(const fs::path& analysis) {
  std::map<std::string, std::string> figures;
  std::string text;
  try {
    text = read_file(analysis, kLargest);
  } catch (const FileError&) {
    return figures;  // there was none, or it is not known what it wrote
  }
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("figures")) return figures;
  for (const auto& [name, digest] : json["figures"].items())
    if (digest.is_string() && name.ends_with(".svg") && stays_inside(name) &&
        name.find('/') == std::string::npos)
      figures[name] = digest.get<std::string>();
  return figures;
}

/// Figures of an earlier state of the study would look like its own. What the user has changed or
/// put there stays.
void remove_earlier(const fs::path& folder, const std::map<std::string, std::string>& earlier,
                    const std::map<std::string, std::string>& now) {
  for (const auto& [name, digest] : earlier) {
    const fs::path path = folder / name;
    if (now.contains(name) || own_type_of(path) != fs::file_type::regular) continue;
    if (sha256(read_file(path, kLargest)) == digest) remove_path(path);
  }
}

constexpr std::string_view kReportStage = "report.runout";

bool has_report(const Plan& plan, std::size_t row) {
  const std::vector<std::size_t>& nodes = plan.rows[row].nodes;
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](std::size_t n) { return plan.nodes[n].stage.type.name == kReportStage; });
}

/// The page of the run of each row, where its report is kept, relative to the folder.
std::vector<std::string> pages(const fs::path& folder, const Plan& plan, const Table& table) {
  std::vector<std::string> found(table.rows);
  for (std::size_t r = 0; r < table.rows; ++r)
    for (const std::size_t n : plan.rows[r].nodes) {
      const std::string& stage = plan.nodes[n].stage.name;
      const Column* key = table.find("key:" + stage);
      if (plan.nodes[n].stage.type.name != kReportStage || !key || key->text[r].empty()) continue;
      const std::string path = fmt::format("stages/{}/{}/report/report.html", stage, key->text[r]);
      if (type_of(folder / path) == fs::file_type::regular) found[r] = path;
    }
  return found;
}

/// A player with fewer jumps rather than runs.
constexpr std::size_t kFewestStates = 12;

/// How many states a page that is too large may have. Fewer of them lie farther apart and pack
/// worse: the size goes about with the root of their number (48 states of 134 dams 73.9 MB, 36 of
/// them 65.5 MB).
std::size_t fewer_states(const WholePage& page, double bytes) {
  const double share = 0.97 * bytes / static_cast<double>(page.bytes);
  const double fewer = share * share * static_cast<double>(page.states);
  return std::max(kFewestStates, std::min(page.states - 1, static_cast<std::size_t>(fewer)));
}

}  // namespace

void write_tables(const fs::path& folder, const Plan&, const Table& table) {
  write_file(folder / "table.csv", to_csv(table));
  write_file(folder / "columns.csv", columns_csv(table));
  write_hdf5(folder / "table.h5", table);
}

void write_page(const fs::path& folder, const Plan& plan, const Table& table,
                const std::atomic<bool>* stop) {
  const StudyFindings findings = analyse(plan, table, stop);
  StudyAbout about{read_sessions(folder), pages(folder, plan, table)};
  about.stories = read_stories(folder, table, about.reports, stop);
  const Page page = make_page(plan, table, findings, about);
  const fs::path figures = folder / "figures", analysis = folder / "analysis.json";
  if (own_type_of(figures) == fs::file_type::symlink)
    throw FileError(
        fmt::format("'{}' is a link (figures would be written outside the folder of the study). "
                    "Remove it.",
                    figures.string()));
  make_folders(figures);
  std::map<std::string, std::string> digests;
  for (const auto& [name, svg] : page.figures) digests[name] = sha256(svg);
  // What is written is listed before, and what goes is listed until it has gone: after a kill
  // nothing of the program's is left unlisted.
  remove_earlier(figures, figures_before(analysis), digests);
  write_file(analysis, to_json_text(plan, findings, digests));
  for (const auto& [name, svg] : page.figures) write_file(figures / name, svg);
  write_file(folder / "study.html", page.html);
}

WholePage write_whole_page(const fs::path& folder, const Plan& plan, const Table& table,
                           const WholeSize& size, const std::atomic<bool>* stop) {
  StudyAbout about{read_sessions(folder), pages(folder, plan, table)};
  about.stories = read_stories(folder, table, about.reports, stop);
  WholePage whole{
      .path = folder / "study-whole.html", .not_done = {}, .no_report = {}, .not_kept = {}};
  const Column* state = table.find("state");
  for (std::size_t r = 0; r < table.rows; ++r) {
    if (!about.reports[r].empty()) {
      ++whole.rows;
      continue;
    }
    const bool done = state->text[r] == "done";
    (!has_report(plan, r) ? whole.no_report
     : done               ? whole.not_kept
                          : whole.not_done)
        .push_back(plan.rows[r].number);
  }
  const StudyFindings findings = analyse(plan, table, stop);
  const std::vector<std::string> paths = about.reports;
  Page page;
  for (std::size_t most = size.states;; most = fewer_states(whole, size.bytes)) {
    about.reports = paths;
    about.embedded = embed_runs(folder, about.reports, most, stop);
    whole.states = about.embedded->states;
    whole.all_states = std::max(whole.all_states, about.embedded->all_states);
    page = make_page(plan, table, findings, about);
    whole.bytes = page.html.size();
    const bool small = static_cast<double>(whole.bytes) <= size.bytes;
    if (size.states > 0 || small || whole.states <= kFewestStates) break;
  }
  write_file(whole.path, page.html);
  return whole;
}

}  // namespace flowslide::study

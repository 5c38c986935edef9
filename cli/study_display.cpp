#include "cli/study_display.hpp"

#include "cli/terminal.hpp"
#include "study/batch/pack.hpp"
#include "study/statistics/summary.hpp"
#include "study/table/observations.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <set>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flowslide::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;
using study::State;

void print_json(const Json& json) {
  fmt::print("{}\n", json.dump(-1, ' ', false, Json::error_handler_t::replace));
  std::fflush(stdout);
}

const char* name_of_state(State state) {
  switch (state) {
    case State::done:
      return "done";
    case State::failed:
    case State::blocked:
      return "failed";
    case State::running:
      return "running";
    default:
      return "open";
  }
}

/// Names and messages come from files, which must not steer the terminal.
std::string harmless(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) && c != '\n'; }, '?');
  return text;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

Json row_json(const study::Row& row, const study::StudyState& progress) {
  return {{"row", row.number},    {"id", row.id},
          {"label", row.label()}, {"workflow", row.workflow.string()},
          {"set", row.overrides}, {"state", name_of_state(progress.row_state(row))}};
}

void tell_failure(const std::string& stage, const std::string& text) {
  const std::string first = first_line(text);
  print_wrapped(stderr, "failed: ", fmt::format("{}: {}", stage, first));
  if (text.size() > first.size())
    fmt::print(stderr, "{}\n", harmless(text.substr(first.size() + 1)));
}

}  // namespace

std::string StudyDisplay::name_of(std::size_t node) const {
  const study::Node& n = plan_.nodes[node];
  const study::Row& row = plan_.rows[n.row];
  return fmt::format("{:<7} row {} ({})", n.stage.name, row.number, row.label());
}

void StudyDisplay::begin(const std::filesystem::path& folder) {
  const std::size_t done = progress_.count(State::done);
  if (kind_ == StudyOutput::json) {
    print_json({{"event", "begin"},
                {"study", plan_.name},
                {"folder", folder.string()},
                {"rows", plan_.rows.size()},
                {"stages", plan_.nodes.size()},
                {"stages_done", done}});
  } else if (kind_ != StudyOutput::quiet) {
    fmt::print("{}: {} rows, {} stages, {} of them done\n", plan_.name, plan_.rows.size(),
               plan_.nodes.size(), done);
    std::fflush(stdout);
  }
  for (const std::string& line : failures(Failed::planning))
    print_wrapped(stderr, "cannot run: ", line);
  for (const std::string& line : failures(Failed::running))
    print_wrapped(stderr, "failed before: ", line);
}

void StudyDisplay::plan(const study::WorkCosts& costs, std::size_t jobs) const {
  struct Kind {
    std::size_t all = 0, open = 0;
    double seconds = 0.0;
  };
  std::map<std::string, Kind> kinds;
  Kind total;
  std::vector<bool> open;
  std::vector<double> seconds;
  for (std::size_t n = 0; n < plan_.nodes.size(); ++n) {
    open.push_back(progress_.node(n).state != State::done);
    seconds.push_back(costs.seconds(n));
    for (Kind* kind : {&kinds[plan_.nodes[n].stage.name], &total}) {
      ++kind->all;
      kind->open += open[n];
      if (open[n] && is_set(seconds[n])) kind->seconds += seconds[n];
    }
  }
  // All of it as one task tells how long it lasts.
  const auto one = study::pack(plan_, open, seconds, {.chunk = 1e300, .cpus = jobs});
  const double lasts = one.empty() ? 0.0 : one[0].tasks[0].seconds;
  if (kind_ == StudyOutput::json) {
    Json rows = Json::array();
    for (const study::Row& row : plan_.rows) rows.push_back(row_json(row, progress_));
    print_json({{"event", "plan"},
                {"processor_seconds", total.seconds},
                {"seconds", lasts},
                {"rows", rows}});
    return;
  }
  for (const auto& [stage, kind] : kinds)
    fmt::print("{:<8} {} to run of {}, {} of one processor\n", stage, kind.open, kind.all,
               about_seconds(kind.seconds));
  print_wrapped(stdout, "all      ",
                fmt::format("{} to run of {}, {} of one processor, {} with {} at once", total.open,
                            total.all, about_seconds(total.seconds), about_seconds(lasts), jobs));
  for (const study::Row& row : plan_.rows)
    print_wrapped(
        stdout,
        fmt::format("row {:>4}  {:<8} ", row.number, name_of_state(progress_.row_state(row))),
        harmless(row.label()));
}

study::PoolEvents StudyDisplay::events() {
  study::PoolEvents events;
  events.ended = [this](const study::StageEnd& end) { ended(end); };
  events.tick = [this](const study::PoolView& view) { tick(view); };
  events.notice = [this](std::string_view text) {
    close();
    print_wrapped(stderr, "note: ", text);
  };
  return events;
}

void StudyDisplay::ended(const study::StageEnd& end) {
  const study::Node& node = plan_.nodes[end.node];
  const bool failed = end.state == State::failed;
  const std::string text =
      failed && progress_.node(end.node).failure ? progress_.node(end.node).failure->text : "";
  ++ended_;
  close();
  if (failed) tell_failure(name_of(end.node), text);
  if (kind_ == StudyOutput::json) {
    print_json({{"event", failed ? "failed" : "done"},
                {"stage", node.stage.name},
                {"row", plan_.rows[node.row].number},
                {"key", progress_.node(end.node).key},
                {"found", end.found},
                {"seconds", end.seconds},
                {"cause", failed ? Json(text) : Json(nullptr)},
                {"stages_done", progress_.count(State::done)},
                {"stages", plan_.nodes.size()}});
  } else if (kind_ == StudyOutput::lines && !failed) {
    fmt::print("{:>5}/{} {}{}\n", progress_.count(State::done), plan_.nodes.size(),
               name_of(end.node), end.found ? ", found" : fmt::format(", {:.1f} s", end.seconds));
    std::fflush(stdout);
  }
}

std::string StudyDisplay::total(const study::PoolView& view) const {
  const double share = view.all == 0 ? 1.0
                                     : static_cast<double>(view.done + view.failed + view.blocked) /
                                           static_cast<double>(view.all);
  constexpr int kBar = 20;
  const int full = static_cast<int>(share * kBar);
  std::string text = fmt::format("all     [{:#<{}}{:-<{}}] {}/{} stages", "", full, "", kBar - full,
                                 view.done, view.all);
  if (view.failed > 0) text += fmt::format(", {} failed", view.failed);
  if (view.blocked > 0) text += fmt::format(", {} not to be had", view.blocked);
  return text + "  ETA " + (is_set(view.seconds_left) ? clock_text(view.seconds_left) : "?");
}

void StudyDisplay::tick(const study::PoolView& view) {
  if (kind_ != StudyOutput::terminal) return;
  if (Clock::now() - drawn_ < std::chrono::milliseconds(200)) return;
  drawn_ = Clock::now();
  const std::size_t columns = terminal_columns(STDOUT_FILENO) - 1;
  std::string text = drawn_lines_ > 0 ? fmt::format("\033[{}A", drawn_lines_) : "";
  std::size_t lines = 0;
  const auto put = [&](const std::string& line) {
    text += "\r\033[K" + cut_to(harmless(line), columns) + "\n";
    ++lines;
  };
  for (const auto& r : view.running)
    put(fmt::format("{:>3} %  {:>5}  {}  {}", static_cast<int>(r.fraction * 100.0),
                    clock_text(r.seconds), name_of(r.node), r.text));
  put(total(view));
  text += "\033[J";
  drawn_lines_ = lines;
  fmt::print("{}", text);
  std::fflush(stdout);
}

void StudyDisplay::close() {
  if (drawn_lines_ > 0) fmt::print("\033[{}A\r\033[J", drawn_lines_);
  drawn_lines_ = 0;
  drawn_ = {};
  std::fflush(stdout);
}

std::vector<std::string> StudyDisplay::failures(Failed which) const {
  std::vector<std::pair<std::string, std::vector<const study::Row*>>> causes;
  for (const study::Row& row : plan_.rows) {
    if (progress_.row_state(row) != State::failed) continue;
    if (which != Failed::any && row.problem.empty() != (which == Failed::running)) continue;
    const std::string cause = first_line(progress_.cause(row));
    const auto known =
        std::find_if(causes.begin(), causes.end(), [&](const auto& c) { return c.first == cause; });
    if (known == causes.end())
      causes.push_back({cause, {&row}});
    else
      known->second.push_back(&row);
  }
  std::vector<std::string> lines;
  for (const auto& [cause, rows] : causes) {
    std::vector<std::size_t> numbers;
    for (const study::Row* row : rows) numbers.push_back(row->number);
    lines.push_back(harmless(
        rows.size() == 1 ? fmt::format("row {} ({}): {}", numbers[0], rows[0]->label(), cause)
                         : fmt::format("rows {} ({} of them): {}", fmt::join(numbers, ", "),
                                       rows.size(), cause)));
  }
  return lines;
}

namespace {

/// A warning that rows share but for their numbers.
std::string told(const study::TableWarning& w) {
  return fmt::format(
      "{}: {} ({})", w.stage, w.text,
      w.rows == 1 ? "1 row" : fmt::format("{} rows, with the numbers of the first", w.rows));
}

}  // namespace

void StudyDisplay::end(const std::filesystem::path& folder, const study::Table& table) const {
  std::size_t done = 0, failed = 0;
  for (const study::Row& row : plan_.rows) {
    done += progress_.row_state(row) == State::done;
    failed += progress_.row_state(row) == State::failed;
  }
  if (kind_ == StudyOutput::json) {
    Json failures = Json::array();
    for (const study::Row& row : plan_.rows)
      if (progress_.row_state(row) == State::failed)
        failures.push_back(
            {{"row", row.number}, {"label", row.label()}, {"cause", progress_.cause(row)}});
    Json warnings = Json::array();
    for (const study::TableWarning& w : table.warnings)
      warnings.push_back({{"stage", w.stage}, {"text", w.text}, {"rows", w.rows}});
    print_json({{"event", "end"},
                {"rows", plan_.rows.size()},
                {"done", done},
                {"failed", failed},
                {"failures", failures},
                {"warnings", warnings},
                {"folder", folder.string()}});
    return;
  }
  for (const study::TableWarning& w : table.warnings) print_warning(harmless(told(w)));
  if (kind_ == StudyOutput::quiet) return;
  for (const std::string& line : failures()) print_wrapped(stdout, "failed: ", line);
  fmt::print("{:<24} {} done, {} failed\n", "rows", done, failed);
  if (const study::Column* runout = table.find("runout_m")) {
    // as on the page: of the main variant, a row that is repeated once
    const study::Observations observed(plan_, table);
    const study::Exceedance all = observed.exceedance_of(*runout);
    const bool several = std::any_of(plan_.rows.begin(), plan_.rows.end(), [&](const auto& row) {
      return row.variant != observed.variant();
    });
    if (!all.value.empty())
      fmt::print("{:<24} median {:.4g} m, {:.4g} to {:.4g} m{}\n", "runout",
                 study::weighted_quantile(all, 0.5), all.value.front(), all.value.back(),
                 several ? fmt::format(" ({})", observed.variant()) : "");
  }
  fmt::print("{:<24} {}\n{:<24} {}\n", "table", (folder / "table.csv").string(), "report",
             (folder / "study.html").string());
}

void StudyDisplay::status(const std::filesystem::path& folder, double bytes,
                          const std::optional<StudyQueue>& queue) const {
  std::map<State, std::size_t> rows;
  for (const study::Row& row : plan_.rows) ++rows[progress_.row_state(row)];
  const std::size_t done = rows[State::done], failed = rows[State::failed];
  const std::size_t open = plan_.rows.size() - done - failed;
  if (kind_ == StudyOutput::json) {
    Json list = Json::array();
    for (const study::Row& row : plan_.rows) {
      const std::string cause = progress_.cause(row);
      list.push_back(row_json(row, progress_));
      list.back()["cause"] = cause.empty() ? Json(nullptr) : Json(cause);
    }
    Json slurm = nullptr;
    if (queue)
      slurm = {{"running", queue->running}, {"ending", queue->ending}, {"waiting", queue->waiting}};
    print_json({{"study", plan_.name},
                {"folder", folder.string()},
                {"done", done},
                {"failed", failed},
                {"open", open},
                {"stages", plan_.nodes.size()},
                {"stages_done", progress_.count(State::done)},
                {"bytes", bytes},
                {"slurm", slurm},
                {"rows", list}});
    return;
  }
  for (const std::string& line : failures()) print_wrapped(stdout, "failed: ", line);
  fmt::print("{}: {} rows done, {} failed, {} open; {} of {} stages; {:.1f} MB\n", plan_.name, done,
             failed, open, progress_.count(State::done), plan_.nodes.size(), bytes / 1e6);
  if (queue) fmt::print("slurm: {}\n", queue->words);
}

}  // namespace flowslide::cli

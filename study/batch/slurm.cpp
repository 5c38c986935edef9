#include "study/batch/slurm.hpp"

#include "core/check.hpp"
#include "study/batch/command.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>
#include <unistd.h>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide::study {
namespace {

/// What neither a shell nor sbatch takes for anything but itself.
bool is_plain(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || (c != 0 && std::strchr("_-./=:,+@%", c));
  });
}

/// The warning before the limit [s]: stages write a checkpoint within seconds.
int warning_before(double limit) {
  constexpr double kShare = 0.1, kMost = 120.0;
  return static_cast<int>(std::min(kMost, kShare * limit));
}

std::string header(const Script& script, const SlurmSettings& settings) {
  std::string text;
  const auto add = [&](const std::string& option) {
    text += "#SBATCH " + sbatch_word(option) + "\n";
  };
  add(fmt::format("--job-name={}-{}", script.study, script.name));
  if (script.tasks > 1) add(fmt::format("--array=0-{}", script.tasks - 1));
  if (!settings.partition.empty()) add("--partition=" + settings.partition);
  if (!settings.account.empty()) add("--account=" + settings.account);
  add("--time=" + slurm_time(script.seconds));
  add(fmt::format("--cpus-per-task={}", script.cpus));
  constexpr double kMebi = 1024.0 * 1024.0;
  add(fmt::format("--mem={:.0f}M", std::ceil(script.memory / kMebi)));
  for (const std::string& option : settings.options) add(option);
  add(fmt::format("--output={}{}.log", script.name, script.tasks > 1 ? "-%a" : ""));
  add("--open-mode=append");
  add("--requeue");
  if (script.resumes) add(fmt::format("--signal=B:USR1@{}", warning_before(script.seconds)));
  return text;
}

/// A trap ends the waiting of a shell, not what it waits for. A task that was stopped by the
/// warning goes back into the queue, so that the jobs behind it still wait for its end.
constexpr std::string_view kWithWarning =
    R"( &
stages=$!
trap 'late=yes again=yes; kill -TERM "$stages"' USR1
trap 'again=yes' TERM # of scancel, which the stages get too
late='' again=yes
while [ "$again" ]; do
  again=''
  wait "$stages"
  code=$?
done
if [ "$late" ] && [ "$code" -eq 130 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 9 ]; then
  scontrol requeue "$SLURM_JOB_ID"
fi
exit "$code"
)";

std::string text_of(const Script& script, const SlurmSettings& settings) {
  validate(
      script.folder.string().find_first_of("%\\") == std::string::npos,
      "{}: has a '%' or a '\\' in its path (Slurm replaces these in the names of logs, and would "
      "not find the folder). Choose another --out.",
      script.folder.string());
  std::string text = fmt::format("#!/bin/bash\n# {}\n", script.about);
  if (script.resumes)
    text +=
        "#\n# Slurm warns before the time limit. The stages then write their checkpoints, and the task "
        "goes\n# back into the queue to continue; it does so too when its machine is lost.\n";
  text += header(script, settings) + "\n";
  std::vector<std::string> words;
  for (const std::string& word : script.command) words.push_back(shell_word(word));
  if (script.tasks > 1) words.emplace_back("\"$SLURM_ARRAY_TASK_ID\"");
  text += fmt::format("cd {} || exit 4\n", shell_word(script.directory.string()));
  text += script.resumes ? fmt::format("{}{}", fmt::join(words, " "), kWithWarning)
                         : fmt::format("exec {}\n", fmt::join(words, " "));
  return text;
}

std::string dependency(const std::vector<std::string>& after) {
  // Not afterok or aftercorr: a row that fails must not stop the others.
  return after.empty() ? "" : fmt::format("--dependency=afterany:{}", fmt::join(after, ":"));
}

std::string commands_of(const std::vector<Script>& scripts, std::vector<std::string> after) {
  if (scripts.empty()) return "";
  std::string text = fmt::format("cd {}\n", shell_word(scripts.front().folder.string()));
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    std::string variable = scripts[i].name;
    std::replace(variable.begin(), variable.end(), '-', '_');
    const bool last = i + 1 == scripts.size();
    std::string words = last ? "sbatch" : "sbatch --parsable";
    if (!after.empty()) words += " " + dependency(after);
    words += " " + shell_word(scripts[i].name + ".sbatch");
    text += last ? words + "\n" : fmt::format("{}=$({})\n", variable, words);
    // It waits for all before it, so that who waits for it need not.
    after = {"$" + variable};
  }
  return text;
}

/// What a command of Slurm said, on one line and without its name in front.
std::string words_of(const CommandEnd& end, const std::string& program) {
  std::string text;
  std::istringstream in(end.errors.empty() ? end.out : end.errors);
  for (std::string line; std::getline(in, line);) {
    for (const std::string& front : {program + ": ", std::string("error: ")})
      if (line.starts_with(front)) line.erase(0, front.size());
    if (!line.empty()) text += (text.empty() ? "" : "; ") + line;
  }
  return text.empty() ? fmt::format("exit code {}, without a word", end.code) : text;
}

CommandEnd call(const std::vector<std::string>& words, const fs::path& folder,
                const std::atomic<bool>* stop) {
  const auto end = run_command(words, folder, stop);
  if (!end)
    throw FileError(fmt::format(
        "{}: there is no such program (jobs are sent by the commands of Slurm, and the PATH has "
        "none). Run this where they are, on a login node, or leave out '--executor slurm'.",
        words[0]));
  return *end;
}

std::string send_script(const Script& script, const std::vector<std::string>& after,
                        const std::atomic<bool>* stop) {
  const fs::path file = script.folder / (script.name + ".sbatch");
  std::vector<std::string> words{"sbatch", "--parsable"};
  if (!after.empty()) words.push_back(dependency(after));
  words.push_back(file.string());
  const CommandEnd end = call(words, script.folder, stop);
  // "17" or "17;cluster", perhaps behind what the cluster has to say to its users.
  std::string line = end.out.substr(0, end.out.find_last_not_of('\n') + 1);
  line = line.substr(line.rfind('\n') + 1);
  const std::string id = line.substr(0, line.find(';'));
  const bool is_id = !id.empty() && std::all_of(id.begin(), id.end(),
                                                [](unsigned char c) { return std::isdigit(c); });
  if (end.code == 0 && is_id) return id;
  throw FileError(fmt::format(
      "{}: sbatch refused it ({}). Mend 'slurm' in the study file and run the same command again: it "
      "sends what is not in the queue yet.",
      file.string(), words_of(end, "sbatch")));
}

std::vector<QueuedTask> read_queue(const std::atomic<bool>* stop) {
  const CommandEnd end = call({"squeue", fmt::format("--user={}", ::getuid()), "--array",
                               "--noheader", "--format=%F|%K|%t|%o"},
                              "/", stop);
  if (end.code == 0) return queued_tasks(end.out);
  throw FileError(fmt::format(
      "squeue: does not tell which jobs wait or run ({}), and work that is under way would be sent "
      "again. Try again when Slurm answers.",
      words_of(end, "squeue")));
}

}  // namespace

std::string shell_word(const std::string& text) {
  if (is_plain(text)) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
  return result + "'";
}

std::string sbatch_word(const std::string& text) {
  if (is_plain(text)) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

std::string slurm_time(double seconds) {
  constexpr long kMinute = 60, kHour = 60, kDay = 24 * kHour;
  const long minutes =
      std::max(1L, static_cast<long>(std::ceil(seconds / static_cast<double>(kMinute))));
  const std::string days = minutes >= kDay ? fmt::format("{}-", minutes / kDay) : "";
  return fmt::format("{}{:02}:{:02}:00", days, minutes % kDay / kHour, minutes % kHour);
}

std::vector<QueuedTask> queued_tasks(std::string_view lines) {
  std::vector<QueuedTask> tasks;
  std::istringstream in{std::string(lines)};
  for (std::string line; std::getline(in, line);) {
    std::array<std::string, 3> fields;
    std::size_t at = 0;
    for (std::string& field : fields) {
      const std::size_t end = std::min(line.find('|', at), line.size());
      field = line.substr(at, end - at);
      at = std::min(end + 1, line.size());
    }
    QueuedTask task{.job = fields[0],
                    .script = line.substr(at),
                    .running = fields[2] != "PD",
                    .ending = fields[2] == "CG"};
    // A job that is no array has no number.
    std::from_chars(fields[1].data(), fields[1].data() + fields[1].size(), task.task);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

Scheduler slurm(const SlurmSettings& settings, const std::atomic<bool>* stop) {
  return {.name = "slurm",
          .ending = ".sbatch",
          .text = [settings](const Script& script) { return text_of(script, settings); },
          .commands = commands_of,
          .send =
              [stop](const Script& script, const std::vector<std::string>& after) {
                return send_script(script, after, stop);
              },
          .queue = [stop] { return read_queue(stop); },
          .follow = "squeue --me"};
}

}  // namespace flowslide::study

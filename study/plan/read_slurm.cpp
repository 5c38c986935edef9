#include "study/plan/read_parts.hpp"
#include "study/plan/yaml_read.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// Options of sbatch on which the program itself relies, and what to write instead.
const std::vector<std::pair<std::string, std::string>> kTaken{{"--partition", "partition"},
                                                              {"-p", "partition"},
                                                              {"--account", "account"},
                                                              {"-A", "account"},
                                                              {"--time", "time"},
                                                              {"-t", "time"},
                                                              {"--cpus-per-task", "cpus"},
                                                              {"-c", "cpus"},
                                                              {"--mem", "memory"},
                                                              {"--mem-per-cpu", "memory"},
                                                              {"--array", ""},
                                                              {"-a", ""},
                                                              {"--dependency", ""},
                                                              {"-d", ""},
                                                              {"--job-name", ""},
                                                              {"-J", ""},
                                                              {"--output", ""},
                                                              {"-o", ""},
                                                              {"--error", ""},
                                                              {"-e", ""},
                                                              {"--open-mode", ""},
                                                              {"--signal", ""},
                                                              {"--requeue", ""},
                                                              {"--no-requeue", ""},
                                                              {"--chdir", ""},
                                                              {"-D", ""},
                                                              {"--parsable", ""},
                                                              {"--wait", ""},
                                                              {"-W", ""},
                                                              {"--wrap", ""},
                                                              {"--ntasks", ""},
                                                              {"-n", ""},
                                                              {"--test-only", ""}};

/// Goes into a script on a line of its own: another line would be a command.
std::string read_line(const YamlNode& node) {
  const std::string& text = node.scalar();
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }))
    throw node.error("has a control character (a job script has one line for it). Leave it out.");
  return text;
}

std::string read_word(const YamlNode& node) {
  std::string text = read_line(node);
  const auto usual = [](unsigned char c) {
    return std::isalnum(c) || (c && std::strchr("_.,+@:-", c));
  };
  if (text.empty() || text[0] == '-' || !std::all_of(text.begin(), text.end(), usual))
    throw node.error(
        fmt::format("'{}' is no name of Slurm. Take one that 'sinfo' or 'sacctmgr show "
                    "assoc' lists.",
                    text));
  return text;
}

std::string read_option(const YamlNode& node) {
  std::string option = read_line(node);
  if (option.size() < 2 || option[0] != '-' || option == "--")
    throw node.error(fmt::format("'{}' is no option of sbatch. Write it as in --qos=low.", option));
  const std::string name = option.substr(0, option.starts_with("--") ? option.find('=') : 2);
  if (name.find(' ') != std::string::npos)
    throw node.error(
        fmt::format("'{}' would be taken for one word. Write it as in --qos=low.", option));
  // sbatch takes the beginning of a long name for the whole of it
  const auto means = [&](const std::string& own) {
    return name == own || (name.size() > 2 && name.starts_with("--") && own.starts_with(name));
  };
  for (const auto& [own, key] : kTaken)
    if (means(own))
      throw node.error(
          key.empty()
              ? fmt::format("'{}' is set by the program (it relies on it). Leave it out.", own)
              : fmt::format("'{}' has a key of its own. Write '{}: ...' instead.", own, key));
  return option;
}

}  // namespace

SlurmSettings read_slurm(const YamlNode& node) {
  allow_keys(node, {"partition", "account", "cpus", "memory", "time", "chunk", "options"});
  SlurmSettings s;
  if (const auto n = node.find("partition")) s.partition = read_word(*n);
  if (const auto n = node.find("account")) s.account = read_word(*n);
  constexpr std::size_t kMostCpus = 4096;
  if (const auto n = node.find("cpus")) s.cpus = read_count(*n, 1, kMostCpus);
  if (const auto n = node.find("memory")) {
    s.memory = read_bytes(*n);
    constexpr double kLeastMemory = 100e6, kMostMemory = 1e15;
    if (!(s.memory >= kLeastMemory && s.memory <= kMostMemory))
      throw n->error(
          fmt::format("'{}' is no memory of a task. Give 100 MB to 1000 TB.", n->scalar()));
  }
  if (const auto n = node.find("time")) {
    s.time = read_time(*n);
    constexpr double kLeast = 60.0;
    if (!(s.time >= kLeast)) throw n->error("is shorter than Slurm knows. Give at least 1 min.");
    constexpr double kMost = 366.0 * 86400.0;
    if (!(s.time <= kMost)) throw n->error("is more than a year. Give what the partition allows.");
    s.chunk = std::min(s.chunk, s.time / 2.0);
  }
  if (const auto n = node.find("chunk")) {
    s.chunk = read_time(*n);
    // A task may be expected to take up to two chunks.
    if (2.0 * s.chunk > s.time)
      throw n->error(
          fmt::format("'{}' is more than half of 'time' (a task that takes a little longer "
                      "than expected would be ended). Take less, or raise 'time'.",
                      n->scalar()));
  }
  const auto options = node.find("options");
  if (!options) return s;
  if (options->kind() != YamlNode::Kind::list)
    throw options->error("is no list of options. Write [--qos=low].");
  for (std::size_t i = 0; i < options->size(); ++i)
    s.options.push_back(read_option(options->item(i)));
  return s;
}

}  // namespace flowslide::study

#include "workflows/engine/cost_book.hpp"

#include "core/files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <sys/resource.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

CostTable read(const fs::path& file) noexcept {
  try {
    if (file.empty()) return {};
    const SealedJson sealed = read_sealed(file);
    return sealed.json ? costs_from(*sealed.json) : CostTable();
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

std::string machine_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "here";
  std::string text = name.data();
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c) && c != '-'; }, '_');
  return text.empty() ? "here" : text;
}

fs::path usual_cost_file() {
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value == '/' ? fs::path(value) : fs::path();
  };
  fs::path cache = folder("XDG_CACHE_HOME");
  if (cache.empty()) {
    cache = folder("HOME");
    if (cache.empty()) return {};
    cache /= ".cache";
  }
  return cache / "flowslide" / ("costs-" + machine_name() + ".json");
}

CostBook::CostBook(fs::path file) : file_(std::move(file)), table_(read(file_)) {}

void CostBook::learn(const Task& task, int threads, double seconds, double memory) {
  constexpr double kWorthIt = 1.0;  // a write waits for the disk
  const CostRecord record = record_of(task, threads, seconds, memory);
  table_.add(record);
  fresh_.push_back(record);
  if (seconds > kWorthIt) keep();
}

void CostBook::recall(const Task& task, int threads, double seconds, double memory) {
  table_.add(record_of(task, threads, seconds, memory));
}

void CostBook::keep() noexcept {
  if (file_.empty() || fresh_.empty()) return;
  try {
    CostTable table = read(file_);
    for (const CostRecord& record : fresh_) table.add(record);
    fresh_.clear();
    make_folders(file_.parent_path());
    write_file(file_, seal(to_json(table)));
  } catch (const std::exception&) {
    fresh_.clear();  // what could not be written now will not be a moment later
  }
}

double peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr double kBytesPerUnit = 1024.0;
  return static_cast<double>(usage.ru_maxrss) * kBytesPerUnit;
}

double processor_time() {
  const auto seconds_of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  double sum = 0.0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    if (::getrusage(who, &usage) == 0)
      sum += seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  }
  return sum;
}

double quiet_seconds(const Work& work, int threads, double wall, double processor) {
  const double speed_up = is_set(work.seconds) ? work.seconds / work.on(threads) : 1.0;
  return std::min(wall, processor / speed_up);
}

}  // namespace flowslide

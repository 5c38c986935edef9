#include "core/benchmark.hpp"

#include <algorithm>
#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flowslide {

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

std::vector<BenchCase> select(std::span<const BenchCase> cases, std::span<const std::string> names,
                              bool large) {
  const auto fits = [](const BenchCase& c, const std::string& name) {
    return c.name.starts_with(name) || name.starts_with(c.name + "/");
  };
  for (const std::string& name : names) {
    validate(std::any_of(cases.begin(), cases.end(), [&](const auto& c) { return fits(c, name); }),
             "there is no benchmark '{}' (nothing would be measured) 'flowslide bench --list' "
             "lists them",
             name);
  }
  std::vector<BenchCase> chosen;
  const auto asked = [&](const BenchCase& c, const std::string& name) {
    return fits(c, name) && (!c.large || large || name.starts_with(c.name));
  };
  for (const BenchCase& c : cases) {
    if ((names.empty() && (!c.large || large)) ||
        std::any_of(names.begin(), names.end(), [&](const auto& n) { return asked(c, n); }))
      chosen.push_back(c);
  }
  return chosen;
}

std::string measurements_json(std::span<const Measurement> measurements) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Measurement& m : measurements) {
    nlohmann::ordered_json entry = {{"name", m.name},
                                    {"value", m.value},
                                    {"unit", m.unit},
                                    {"better", m.better == Better::higher ? "higher" : "lower"}};
    for (const auto& [key, value] : m.numbers) entry[key] = value;
    for (const auto& [key, value] : m.texts) entry[key] = value;
    list.push_back(std::move(entry));
  }
  return list.dump(1);
}

std::string measurement_heading() {
  return fmt::format("{:<48} {:>10} {:<18}", "benchmark", "value", "unit");
}

std::string measurement_row(const Measurement& m) {
  return fmt::format("{:<48} {:>10.4g} {}", m.name, m.value, m.unit);
}

}  // namespace flowslide

#include "core/verification.hpp"

#include <algorithm>
#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flowslide {

double core_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

CheckList::CheckList(std::string_view case_name) : case_name_(case_name), last_(core_seconds()) {}

void CheckList::add(std::string_view quantity, double value, double target, double tolerance,
                    std::string_view unit, bool pass, Check::Relation relation) {
  const double now = core_seconds();
  checks_.push_back({.name = fmt::format("{}/{}", case_name_, quantity),
                     .target = target,
                     .value = value,
                     .tolerance = tolerance,
                     .unit = std::string(unit),
                     .pass = pass,
                     .core_seconds = now - last_,
                     .relation = relation});
  last_ = now;
}

void CheckList::near(std::string_view quantity, double value, double target, double tolerance,
                     std::string_view unit) {
  add(quantity, value, target, tolerance, unit, std::abs(value - target) <= tolerance,
      Check::Relation::near);
}

void CheckList::at_least(std::string_view quantity, double value, double bound,
                         std::string_view unit) {
  add(quantity, value, bound, 0.0, unit, value >= bound, Check::Relation::at_least);
}

void CheckList::at_most(std::string_view quantity, double value, double bound,
                        std::string_view unit) {
  add(quantity, value, bound, 0.0, unit, value <= bound, Check::Relation::at_most);
}

std::vector<VerificationCase> select(std::span<const VerificationCase> cases,
                                     std::span<const std::string> names, bool quick_only) {
  const auto fits = [](const VerificationCase& c, const std::string& name) {
    if (!c.name.starts_with(name)) return false;
    const std::string rest = c.name.substr(name.size());
    return rest.empty() || rest[0] == '/' || rest[0] == '_';
  };
  for (const std::string& name : names) {
    validate(std::any_of(cases.begin(), cases.end(), [&](const auto& c) { return fits(c, name); }),
             "there is no verification case '{}' (nothing would be verified) 'flowslide verify "
             "--list' lists them",
             name);
  }
  std::vector<VerificationCase> chosen;
  for (const VerificationCase& c : cases) {
    const bool asked = names.empty() || std::any_of(names.begin(), names.end(),
                                                    [&](const auto& n) { return fits(c, n); });
    if (asked && (c.quick || !quick_only)) chosen.push_back(c);
  }
  return chosen;
}

std::vector<Check> run_case(const VerificationCase& c, std::string& message) {
  const double start = core_seconds();
  try {
    return c.run(c.name);
  } catch (const Error& e) {
    message = fmt::format("{}: {}", c.name, e.what());
  }
  return {{.name = c.name + "/finished",
           .target = 1.0,
           .value = 0.0,
           .tolerance = 0.0,
           .unit = "",
           .pass = false,
           .core_seconds = core_seconds() - start}};
}

std::string checks_json(std::span<const Check> checks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Check& c : checks) {
    list.push_back({{"name", c.name},
                    {"target", c.target},
                    {"value", c.value},
                    {"tolerance", c.tolerance},
                    {"unit", c.unit},
                    {"pass", c.pass},
                    {"core_seconds", c.core_seconds}});
  }
  return list.dump(1);
}

namespace {
constexpr int kNameWidth = 30;
}

std::string check_heading() {
  return fmt::format("{:<{}} {:>15} {:>11} {:>8} {:>6} {}", "check", kNameWidth, "value", "target",
                     "within", "core-s", "");
}

std::string check_row(const Check& c) {
  const char* sign = c.relation == Check::Relation::at_least  ? ">= "
                     : c.relation == Check::Relation::at_most ? "<= "
                                                              : "";
  const std::string value = fmt::format("{:.4g}{}{}", c.value, c.unit.empty() ? "" : " ", c.unit);
  const std::string within =
      c.relation == Check::Relation::near ? fmt::format("{:.3g}", c.tolerance) : "";
  const std::string numbers =
      fmt::format("{:>15} {:>11} {:>8} {:>6.2f} {}", value, fmt::format("{}{:.4g}", sign, c.target),
                  within, c.core_seconds, c.pass ? "pass" : "FAIL");
  if (c.name.size() <= std::size_t(kNameWidth))
    return fmt::format("{:<{}} {}", c.name, kNameWidth, numbers);
  return fmt::format("{}\n{:<{}} {}", c.name, "", kNameWidth, numbers);
}

}  // namespace flowslide

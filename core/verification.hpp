#pragma once
#include "core/check.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Verification cases: the program against known answers, with the numbers shown.
/// Run by `flowslide verify`; docs/guide/verification.md
namespace flowslide {

/// One measured number against what it should be.
struct Check {
  std::string name;        ///< case/quantity, such as "mpm/v1/error_40_cells"
  double target = kUnset;  ///< in `unit`, as are value and tolerance
  double value = kUnset;
  double tolerance = 0.0;  ///< largest |value - target|; 0 where the target is a bound
  std::string unit;        ///< empty: a plain number
  bool pass = false;
  double core_seconds = 0.0;  ///< processor time since the check before, all threads
  enum class Relation { near, at_least, at_most } relation = Relation::near;
};

/// Collects the checks of a case under "case/quantity" with the processor time that each took. A
/// value that is not a number fails.
class CheckList {
 public:
  explicit CheckList(std::string_view case_name);
  void near(std::string_view quantity, double value, double target, double tolerance,
            std::string_view unit = "");
  /// An error: near zero.
  void error(std::string_view quantity, double value, double tolerance,
             std::string_view unit = "") {
    near(quantity, value, 0.0, tolerance, unit);
  }
  void at_least(std::string_view quantity, double value, double bound, std::string_view unit = "");
  void at_most(std::string_view quantity, double value, double bound, std::string_view unit = "");
  /// Something that holds or does not: value 1 or 0, target 1.
  void holds(std::string_view quantity, bool yes) { near(quantity, yes ? 1.0 : 0.0, 1.0, 0.0); }
  [[nodiscard]] std::vector<Check> take() { return std::move(checks_); }

 private:
  void add(std::string_view quantity, double value, double target, double tolerance,
           std::string_view unit, bool pass, Check::Relation relation);
  std::string case_name_;
  double last_;
  std::vector<Check> checks_;
};

struct VerificationCase {
  std::string name;  ///< group/case, such as "mpm/v1"
  std::string doc;   ///< one line: what is compared with what
  bool quick;        ///< part of the subset that is run on every change
  std::vector<Check> (*run)(std::string_view name);
};

/// Processor time of this process, all threads [s].
double core_seconds();

/// The cases that a list of names asks for, in their own order: each name is a group ("mpm"), a
/// case, or its beginning up to '/' or '_' ("mpm/v1" is mpm/v1_compaction and not mpm/v10_slope);
/// no names ask for all. Throws InputError for a name that fits nothing.
std::vector<VerificationCase> select(std::span<const VerificationCase> cases,
                                     std::span<const std::string> names, bool quick_only);

/// Runs a case. An Error inside becomes a check "case/finished" that fails; its text goes to
/// `message`.
std::vector<Check> run_case(const VerificationCase& c, std::string& message);

/// [{"name", "target", "value", "tolerance", "unit", "pass", "core_seconds"}]; numbers that are not
/// finite are null.
std::string checks_json(std::span<const Check> checks);
/// Heading and row of a table of 79 columns.
std::string check_heading();
std::string check_row(const Check& check);

}  // namespace flowslide

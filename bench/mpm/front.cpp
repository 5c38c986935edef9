#include "bench/mpm/speed.hpp"
#include "verify/mpm/dry_columns.hpp"

#include <cmath>

namespace flowslide::mpm {
namespace {

constexpr int kFine = 64;  ///< cells of the reference

struct Line {
  std::string_view name;
  Transfer transfer;
};

}  // namespace

std::vector<Measurement> front_precision() {
  const double exact = collapse(sand(1.0), kFine).front;
  std::vector<Measurement> all;
  for (const Line& line :
       {Line{"aflip", Transfer::aflip}, Line{"apic", Transfer::apic}, Line{"tpic", Transfer::tpic},
        Line{"flip_0.99", Transfer::flip}, Line{"fmpm_2", Transfer::fmpm}}) {
    for (const int cells : {8, 16, 32}) {
      DryColumn column = sand(1.0);
      column.transfer = line.transfer;
      const double start = thread_seconds();
      const Deposit d = collapse(column, cells);
      Measurement m;
      m.name = fmt::format("mpm/front/{}/{}", line.name, cells);
      m.value = std::abs(d.front / exact - 1.0);
      m.unit = "error of the front";
      m.better = Better::lower;
      m.numbers = {
          {"front", d.front}, {"height", d.height}, {"core_seconds", thread_seconds() - start}};
      all.push_back(m);
    }
  }
  return all;
}

}  // namespace flowslide::mpm

#include "bench/mpm/named_transfer.hpp"
#include "bench/mpm/speed.hpp"
#include "verify/mpm/dry_columns.hpp"

#include <cmath>

namespace flowslide::mpm {
namespace {

constexpr int kFine = 64;  ///< cells of the reference

}  // namespace

std::vector<Measurement> front_precision() {
  const double exact = collapse(sand(1.0), kFine).front;
  std::vector<Measurement> all;
  for (const NamedTransfer& line :
       {NamedTransfer{"aflip", Transfer::aflip}, NamedTransfer{"apic", Transfer::apic},
        NamedTransfer{"tpic", Transfer::tpic}, NamedTransfer{"flip_0.99", Transfer::flip},
        NamedTransfer{"fmpm_2", Transfer::fmpm}}) {
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

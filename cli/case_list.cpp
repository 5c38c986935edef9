#include "cli/case_list.hpp"

#include "bench/chain/dam.hpp"
#include "bench/fem/cases.hpp"
#include "bench/mpm/cases.hpp"
#include "verify/fem/cases.hpp"
#include "verify/mpm/cases.hpp"
#include "verify/section/cases.hpp"

namespace flowslide::cli {
namespace {

template <class T>
void append(std::vector<T>& list, std::vector<T> more) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

std::vector<VerificationCase> all_verification_cases() {
  std::vector<VerificationCase> cases;
  append(cases, fem_cases());
  append(cases, mpm_cases());
  append(cases, section_cases());
  return cases;
}

std::vector<BenchCase> all_benchmarks() {
  std::vector<BenchCase> cases;
  append(cases, fem_benchmarks());
  append(cases, dam_benchmarks());
  append(cases, mpm_benchmarks());
  return cases;
}

}  // namespace flowslide::cli

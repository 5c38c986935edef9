#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/support/paths.hpp"
#include "workflows/engine/graph.hpp"
#include "workflows/stages/stage_list.hpp"

#include <vector>

namespace flowslide::fuzz {
namespace {

const std::vector<StageType>& types() {
  static const std::vector<StageType> list = all_stages();
  return list;
}

}  // namespace

void workflow(Input input) {
  const auto path = file("case.yaml", input);
  accepts([&] { (void)load_workflow(path, {}, types()); });
}

void overrides(Input input) {
  static const std::string base = test::source("workflows/mochikoshi.yaml");
  std::vector<std::string> options;
  for (Parts parts(input); !parts.empty();) options.emplace_back(parts.section());
  accepts([&] { (void)load_workflow(base, options, types()); });
}

}  // namespace flowslide::fuzz

#include "core/check.hpp"
#include "motion/measures.hpp"
#include "motion/synthetic.hpp"
#include "workflows/engine/graph.hpp"
#include "workflows/stages/stage_list.hpp"

#include <cstdio>

/// Says the peak of a synthetic motion and the stages of a workflow.
int main(int, char** argv) {
  try {
    const auto motion = flowslide::synthesize({.pga = 3.0, .tm = 0.5, .d5_95 = 10.0});
    std::printf("peak %g m/s2\n", flowslide::pga(motion));
    for (const auto& stage : flowslide::load_workflow(argv[1], {}, flowslide::all_stages()).stages)
      std::printf("%s: %s\n", stage.name.c_str(), stage.type.name.c_str());
  } catch (const flowslide::Error& e) {
    std::printf("%s\n", e.what());
    return e.exit_code();
  }
}

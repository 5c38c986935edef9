#include "core/temporary_folder.hpp"
#include "model/history.hpp"
#include "model/motion_file.hpp"
#include "model/mpm_history.hpp"
#include "model/section_mesh.hpp"
#include "model/zone.hpp"
#include "tests/bits/digest.hpp"
#include "tests/bits/scenes.hpp"
#include "tests/support/paths.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/runner.hpp"
#include "workflows/stages/stage_list.hpp"

namespace flowslide::same_bits {
namespace {

std::string digest(const FemHistory& h) {
  Digest d;
  const auto add = [&](const FemFrame& f) {
    d.add(f.time);
    d.add(f.displacement);
    d.add(f.velocity);
    d.add(f.pore_pressure);
    d.add(f.stress);
    d.add(f.strain);
  };
  add(h.gravity());
  for (std::size_t i = 0; i < h.times().size(); ++i) add(h.frame(i));
  return d.text();
}

std::string digest(const ParticleSet& p) {
  Digest d;
  visit_fields(p, [&](auto, auto, const auto& array) { d.add(array); });
  for (const auto& [name, values] : p.history) d.add(values);
  return d.text();
}

std::string digest(const LiquefactionZone& z) {
  Digest d;
  d.add(z.transfer_time);
  d.add(z.r_u_node);
  d.add(z.sigma_v0);
  d.add(z.strength);
  d.add(z.lower_boundary);
  d.add(z.history.kinetic_energy);
  d.add(z.history.distortion_gauss);
  return d.text();
}

std::string digest(const MpmHistory& h) {
  Digest d;
  for (std::size_t i = 0; i < h.num_frames(); ++i) {
    const MpmFrame f = h.frame(i);
    d.add(f.time);
    d.add(f.position);
    d.add(f.velocity);
    d.add(f.stress);
    d.add(f.volume);
    d.add(f.plastic_strain);
    d.add(f.strength);
  }
  for (const MpmSample& r : h.samples())
    for (const double x :
         {r.time, r.runout, r.kinetic, r.gravity_work, r.strain_energy, r.plastic_work,
          r.friction_work, r.damping_work, r.energy_error, r.max_speed, r.dt})
      d.add(x);
  return d.text();
}

/// What the stages of chain.yaml leave behind.
Lines run(const std::string& name, const std::vector<std::string>& changes, int threads) {
  const TemporaryFolder folder;
  const Workflow workflow =
      load_workflow(test::source("tests/bits/chain.yaml"), changes, all_stages());
  const std::filesystem::path target = folder / "run";
  run_workflow(workflow, {.folder = target, .threads = threads}, {});
  Lines lines;
  for (const PlanLine& stage : plan_workflow(workflow, target)) {
    const auto result = result_folder(target, stage.stage, stage.decision.key);
    const auto add = [&](const std::string& text) {
      lines.push_back({"chain/" + name + "/" + stage.stage, text});
    };
    if (stage.stage == "motion") {
      Digest d;
      d.add(read_motion_file(result / "motion.h5").acceleration);
      add(d.text());
    } else if (stage.stage == "mesh") {
      Digest d;
      d.add(read_section_mesh(result / "mesh.h5").mesh.nodes);
      add(d.text());
    } else if (stage.stage == "shake") {
      add(digest(FemHistory(result / "history.h5")));
    } else if (stage.stage == "zone") {
      add(digest(read_zone(result / "zone.h5")));
    } else if (stage.stage == "map") {
      add(digest(read_particles(result / "particles.h5")));
    } else {
      add(digest(MpmHistory(result / "mpm.h5")));
    }
  }
  return lines;
}

}  // namespace

Lines chain(int threads) {
  Lines lines = run("explicit", {}, threads);
  for (const Line& line :
       run("implicit",
           {"stages.shake.with.integration={scheme: implicit, step: 5 ms}",
            "stages.flow.with.end=0.5 s", "stages.flow.with.extrude={width: 2 m}"},
           threads))
    lines.push_back(line);
  return lines;
}

}  // namespace flowslide::same_bits

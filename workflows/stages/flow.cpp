#include "mpm/run/flow.hpp"

#include "core/memory.hpp"
#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

nlohmann::ordered_json stiffness_facts(const StiffnessChoice& choice) {
  nlohmann::ordered_json materials;
  for (const StiffnessOfMaterial& m : choice.materials)
    materials[m.material] = {{"bulk_modulus_pa", m.used.bulk},
                             {"given_bulk_modulus_pa", m.given.bulk},
                             {"volume_change", m.volume_change},
                             {"mach_number", m.mach_number},
                             {"brittleness", m.brittleness}};
  return {{"fall_m", choice.fall}, {"materials", materials}};
}

/// A front at a wall, or beyond a plane where the model ends, might have gone farther.
void warn_of_wall(const FlowConfig& c, double front, std::vector<std::string>& warnings) {
  const auto look = [&](const char* what, const std::optional<double>& at) {
    if (at && front > *at - 2.0 * c.cell)
      warnings.push_back(fmt::format(
          "{}: the front has come to x = {:.6g} m, and the model ends at {:.6g} m: the runout is "
          "that of the model, and may be larger. Move it downstream.",
          what, front, *at));
  };
  look("right_roller", c.right_roller);
  look("absorbing.right", c.absorbing.right);
}

struct FlowStage {
  static constexpr std::string_view name = "mpm.run";
  static constexpr std::string_view doc = "The runout, with the material point method.";
  static constexpr int version = 9;
  static constexpr bool checkpoints = true;
  using Config = FlowConfig;
  struct Inputs {
    Artifact<ParticleSet> particles;
    void visit(auto&& port) { port("particles", particles); }
  };
  struct Outputs {
    Artifact<MpmHistory> history{"mpm.h5"};
    void visit(auto&& port) { port("history", history); }
  };
  static void check(const Config& config) { flowslide::check(config); }
  static std::any preview(const Config& config, const Previews& in, Findings& found) {
    Preview p = merged(in);
    p.flow = config;
    check_inert(config, found);
    if (!p.map) return p;
    compare_cells(config, *p.map, found);
    if (!p.section || p.materials.empty()) return p;
    const Soil soil = soil_of(*p.section, *p.map, p.materials);
    found.work = flow_work(config, *p.map, p.materials, soil);
    check_edges(config, soil, found);
    check_tractions(config, soil, found);
    check_ground(config, soil, found);
    check_scheme(config, soil, found);
    check_softening(config, *p.map, soil, found);
    check_cells(config, soil, found);
    check_points(config, *p.map, soil, found);
    check_terrain(config, soil, found);
    if (config.extrude) check_memory(*p.map, soil, config.extrude->width, machine_memory(), found);
    return p;
  }
  static StageResult run(const RunContext& context, const Config& config, const Inputs& in,
                         const Outputs& out) {
    const FlowPaths paths{out.history.path, context.folder / "checkpoint"};
    const ParticleSet particles = read_particles(in.particles.path);
    const FlowFacts f = run_flow(particles, config, paths, context.threads, context.progress);
    const double width = config.extrude ? config.extrude->width : 1.0;
    const double rate = f.step_seconds > 0.0 ? f.updates_this_call / f.step_seconds : 0.0;
    nlohmann::ordered_json facts = {{"runout_m", f.last.runout},
                                    {"front_m", f.last.front},
                                    {"front_equal_mass_m", f.last.front_equal_mass},
                                    {"front_995_m", f.last.front_995},
                                    {"front_99_m", f.last.front_99},
                                    {"front_95_m", f.last.front_95},
                                    {"height_m", f.last.height},
                                    {"toe_m", particles.toe},
                                    {"mass_error", f.last.mass_error},
                                    {"energy_error", f.last.energy_error},
                                    {"flow_end_s", f.end_time},
                                    {"flow_at_rest", f.at_rest},
                                    {"flow_steps", f.steps},
                                    {"points_left", f.last.points_left},
                                    {"mass_left_kg_per_m", f.last.mass_left / width},
                                    {"flow_point_updates", f.point_updates},
                                    {"flow_point_updates_per_s", rate}};
    if (config.absorbing.left || config.absorbing.right || config.absorbing.bottom)
      facts["absorbed_energy_j_per_m"] = f.absorbed / width;
    std::vector<std::string> warnings = snapping_soils(particles, config);
    if (f.stiffness) {
      facts["stiffness"] = stiffness_facts(*f.stiffness);
      for (std::string& text : told(*f.stiffness)) warnings.push_back(std::move(text));
    }
    warn_of_wall(config, f.last.front, warnings);
    return {.facts = facts.dump(),
            .publish = {},
            .warnings = warnings,
            .headlines = {{"runout_m", "runout", "m"},
                          {"mass_error", "mass error"},
                          {"energy_error", "energy error"}}};
  }
};

}  // namespace

StageType flow_stage() { return stage_type<FlowStage>(); }

}  // namespace flowslide

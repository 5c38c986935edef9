#include "core/units.hpp"
#include "importers/opensees.hpp"
#include "workflows/stages/cross_checks.hpp"
#include "workflows/stages/preview.hpp"
#include "workflows/stages/stage_list.hpp"
#include "workflows/stages/work.hpp"

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

struct ImportOpenSees {
  static constexpr std::string_view name = "import.opensees";
  static constexpr std::string_view doc = "Reads mesh and recorders of an OpenSees model.";
  static constexpr int version = 3;
  static constexpr bool checkpoints = false;
  using Config = OpenSeesConfig;
  struct Inputs {
    void visit(auto&&) {}
  };
  struct Outputs {
    Artifact<FemHistory> history{"history.h5"};
    void visit(auto&& port) { port("history", history); }
  };
  static void check(const Config& config) {
    flowslide::check(config);
    (void)unit_factor(config.units.length, Dim::length);
    (void)unit_factor(config.units.time, Dim::time);
    (void)unit_factor(config.units.stress, Dim::stress);
  }
  static std::any preview(const Config& config, const Previews&, Findings& found) {
    ImportPreview import = preview_opensees(config);
    SectionMesh section;
    section.mesh = std::move(import.mesh);
    Preview p;
    p.shakes = config.shaking.has_value();
    p.materials = std::move(import.materials);
    p.section = std::make_shared<const SectionMesh>(std::move(section));
    found.warnings = std::move(import.warnings);
    check_size(p.section->mesh, found);
    check_densities(p.materials, found);
    if (config.sigma_zz.k0) check_k0(*config.sigma_zz.k0, found);
    found.work = mesh_work(p.section->mesh);
    return p;
  }
  static StageResult run(const RunContext& context, const Config& config, const Inputs&,
                         const Outputs& out) {
    const ImportReport report = import_opensees(config, out.history.path, context.progress);
    const nlohmann::ordered_json facts = {{"fem_nodes", report.num_nodes},
                                          {"fem_elements", report.num_elements},
                                          {"fem_frames", report.num_frames},
                                          {"import_warnings", report.warnings}};
    return {.facts = facts.dump(), .publish = {}, .warnings = report.warnings};
  }
};

}  // namespace

StageType import_opensees_stage() { return stage_type<ImportOpenSees>(); }

}  // namespace flowslide

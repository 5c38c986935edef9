#include "report/report.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "report/figures.hpp"
#include "report/markdown.hpp"
#include "report/page.hpp"
#include "report/paraview.hpp"
#include "report/plot_data.hpp"
#include "report/tables.hpp"

namespace flowslide {
namespace {

/// Everything below indexes the zone by elements of the mesh.
void check_zone(const LiquefactionZone& zone, std::size_t elements) {
  validate(zone.r_u_element.size() == elements && zone.liquefied.size() == elements &&
               zone.strength.size() == elements && zone.sigma_v0.size() == elements,
           "the zone describes {} elements, the history has {} (they belong to different runs) "
           "give the report the files of one run",
           zone.liquefied.size(), elements);
}

}  // namespace

ReportFacts write_report(const ReportInputs& in, const ReportConfig& config,
                         const std::filesystem::path& out, const Progress& progress) {
  check_zone(in.zone, in.history.mesh().num_elements());
  const FinalState end = final_state(in.particles, in.flow, config);
  ReportFacts facts = compute_facts(in.zone, in.flow, end, config);
  facts.zone_shares = zone_shares(in.history.mesh(), in.zone);
  make_folders(out / "data");
  write_file(out / "runout.csv", runout_csv(in.flow.samples(), facts.toe));
  write_file(out / "zone.csv", zone_csv(in.zone.history));
  write_plot_data(out / "data", in.history, in.zone, in.flow, end, facts, config, in.stages);
  DrawnFigures drawn;
  if (config.figures) {
    // Drawing takes seconds on a machine that has nothing else to do.
    const double seconds = 300.0 + 1e-3 * static_cast<double>(in.particles.size());
    drawn = draw_figures(out, config.python, {progress, seconds});
    if (!drawn.problem.empty()) facts.warnings.push_back(drawn.problem);
  }
  if (config.paraview) write_paraview(out, in.history, in.zone, in.flow, progress);
  ReportFacts told = facts;
  told.warnings.insert(told.warnings.begin(), in.warnings.begin(), in.warnings.end());
  write_file(out / "facts.json", to_json(told));
  write_file(out / "report.md", report_markdown(in, config, facts, end, drawn));
  if (config.page) write_file(out / "report.html", report_page(in, config, facts, end));
  return facts;
}

}  // namespace flowslide

#include "cli/command.hpp"
#include "cli/signals.hpp"
#include "cli/usage.hpp"
#include "workflows/stages/section_view.hpp"
#include "workflows/stages/stage_list.hpp"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace flowslide::cli {
namespace {

struct PlotOptions {
  std::string file, out, python;
  std::vector<std::string> overrides;
};

int plot(const PlotOptions& options) {
  const Workflow workflow = load_workflow(options.file, options.overrides, all_stages());
  const SectionView view = view_section(workflow);
  if (!view.section)
    throw InputError(fmt::format(
        "{}: nothing can be drawn yet (its section comes from files that only a run reads) run it; "
        "the report shows the section",
        options.file));
  const std::string out = options.out.empty() ? workflow.name + "-section.png" : options.out;
  Progress progress;
  progress.stop_requested = &stop_on_signal();
  draw_workflow(view.plot, view.section->mesh, out,
                options.python.empty() ? std::nullopt : std::optional(options.python), progress);
  fmt::print("{}: {} elements, {} nodes\n", out, view.section->mesh.num_elements(),
             view.section->mesh.num_nodes());
  return 0;
}

}  // namespace

void add_plot(CLI::App& app, Command& action) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App* command = app.add_subcommand(
      "plot", "Draw section, mesh, water, windows and ground of a workflow, before it runs");
  command->add_option("file", options->file, "workflow, FILE.yaml")
      ->required()
      ->check(input_name());
  command->add_option("--out", options->out, "this file: .png, .svg or .pdf [NAME-section.png]")
      ->check(output_name());
  command->add_option("--python", options->python, "interpreter with Matplotlib [python3]")
      ->check(input_name());
  command->add_option("--set", options->overrides, "override a setting, PATH=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([options, &action] { action = [options] { return plot(*options); }; });
}

}  // namespace flowslide::cli

#include "report/figures.hpp"

#include "core/files.hpp"

#include <utility>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

void remove_old(const fs::path& folder) {
  for (const Figure& figure : kFigures)
    for (const char* ending : {".svg", ".png"})
      remove_path(folder / (std::string(figure.name) + ending));
}

}  // namespace

DrawnFigures draw_figures(const fs::path& folder, const std::optional<std::string>& python,
                          const FigureLimits& limits, const std::vector<std::string>& only) {
  remove_old(folder / "figures");
  DrawnFigures drawn;
  const std::string report = fs::absolute(folder).string();
  std::vector<std::string> arguments{report, report};
  arguments.insert(arguments.end(), only.begin(), only.end());
  drawn.problem = run_plot_script("plot.run", arguments, python, limits);
  if (!drawn.problem.empty()) return drawn;
  for (const Figure& figure : kFigures)
    if (is_there(folder / "figures" / (std::string(figure.name) + ".png")))
      drawn.figures.push_back(figure);
  return drawn;
}

}  // namespace flowslide

#include "report/workflow_plot.hpp"

#include "core/files.hpp"
#include "core/temporary_folder.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json as_json(const WorkflowPlot& plot, const QuadMesh& mesh) {
  Json soils = Json::array(), windows = Json::array();
  for (const PlottedSoil& s : plot.soils) soils.push_back({{"tag", s.tag}, {"name", s.name}});
  for (const PlottedWindow& w : plot.windows)
    windows.push_back(
        {{"name", w.name}, {"from", number_or_null(w.from)}, {"to", number_or_null(w.to)}});
  return {{"title", plot.title},
          {"nodes", mesh.nodes},
          {"elements", mesh.elements},
          {"tags", mesh.element_material},
          {"materials", soils},
          {"windows", windows},
          {"water", plot.water},
          {"ground", plot.ground},
          {"box", plot.box ? Json(*plot.box) : Json(nullptr)},
          {"toe_m", plot.toe ? number_or_null(*plot.toe) : Json(nullptr)}};
}

}  // namespace

void draw_workflow(const WorkflowPlot& plot, const QuadMesh& mesh, const fs::path& out,
                   const std::optional<std::string>& python, const Progress& progress) {
  const std::string ending = out.extension().string();
  validate(ending == ".png" || ending == ".svg" || ending == ".pdf",
           "'{}' does not say in its ending what to draw (there are .png, .svg and .pdf) name it "
           "for example section.png",
           out.string());
  const TemporaryFolder work;
  const fs::path data = work / "section.json", drawn = work / ("section" + ending).c_str();
  write_file(data, as_json(plot, mesh).dump());
  FigureLimits limits{progress};
  limits.named_by = "with --python";
  limits.again = "run the command again";
  std::string problem =
      run_plot_script("plot_workflow.run", {data.string(), drawn.string()}, python, limits);
  if (problem.empty() && !is_there(drawn))
    problem = fmt::format(
        "No figures were drawn: '{}' ran and left none (it is no Python 3) name another "
        "interpreter with --python.",
        python.value_or("python3"));
  if (!problem.empty()) throw FileError(problem);
  write_file(out, read_file(drawn, std::uint64_t{1} << 30));
}

}  // namespace flowslide

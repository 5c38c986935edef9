#include "report/figures.hpp"

#include "core/check.hpp"
#include "core/hashed_file.hpp"
#include "report/plot_data.hpp"
#include "report/tables.hpp"
#include "tests/report/dam_case.hpp"
#include "tests/support/scratch.hpp"

#include <cstdlib>
#include <sstream>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

/// What the figures are drawn from, in scratch/report.
void write_case(const Scratch& scratch, bool shaken, const dam_case::Flow& moves = {},
                const std::vector<ToldStage>& stages = {}) {
  const QuadMesh mesh = dam_case::mesh();
  const ParticleSet particles = dam_case::particles();
  dam_case::write_flow(scratch / "mpm.h5", particles, moves);
  dam_case::write_history(scratch / "history.h5", shaken);
  const MpmHistory flow(scratch / "mpm.h5");
  const LiquefactionZone zone = dam_case::zone(mesh, shaken);
  const FinalState end = final_state(particles, flow, {});
  const std::filesystem::path out = scratch / "report";
  std::filesystem::create_directories(out / "data");
  write_plot_data(out / "data", FemHistory(scratch / "history.h5"), zone, flow, end,
                  compute_facts(zone, flow, end, {}), {}, stages);
  std::ofstream(out / "runout.csv") << runout_csv(flow.samples(), flow.initial().toe);
  std::ofstream(out / "zone.csv") << zone_csv(zone.history);
}

/// What a few lines of Python print that use the scripts of the figures.
std::string answer_of(const Scratch& scratch, const std::string& lines) {
  std::filesystem::create_directories(scratch / "plot");
  write_plot_scripts(scratch / "plot");
  scratch.write("plot/ask.py", "import pathlib\n" + lines);
  const std::string command =
      "cd '" + scratch.path().string() +
      "' && { python3 plot/ask.py || /usr/bin/python3 plot/ask.py; } 2>log >out";
  const int status = std::system(command.c_str());
  INFO(read_text_file(scratch / "log"));
  REQUIRE(status == 0);
  return read_text_file(scratch / "out");
}

/// Width and height from the header of a PNG; zeros if it is none.
std::pair<unsigned, unsigned> png_size(const std::filesystem::path& path) {
  const std::string bytes = read_text_file(path);
  if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG") return {0, 0};
  const auto number = [&](std::size_t at) {
    unsigned n = 0;
    for (std::size_t k = 0; k < 4; ++k) n = 256 * n + static_cast<unsigned char>(bytes[at + k]);
    return n;
  };
  return {number(16), number(20)};
}

}  // namespace

TEST_CASE("Figures are drawn at page width and small") {
  const Scratch scratch;
  write_case(scratch, true);
  const std::filesystem::path figures = scratch / "report/figures";
  const DrawnFigures drawn = draw_figures(scratch / "report", std::nullopt, {});
  INFO(drawn.problem);
  REQUIRE(drawn.problem.empty());
  REQUIRE(drawn.figures.size() == kFigures.size());
  for (const Figure& figure : drawn.figures) {
    const std::string name(figure.name);
    CAPTURE(name);
    const auto [width, height] = png_size(figures / (name + ".png"));
    CHECK(width == 1584);
    CHECK(height > 300);
    CHECK(height < 2000);
    CHECK(std::filesystem::file_size(figures / (name + ".svg")) > 20'000);
    CHECK(std::filesystem::file_size(figures / (name + ".svg")) < 500'000);
  }
}

TEST_CASE("The same data give the same bytes") {
  const Scratch scratch;
  write_case(scratch, true);
  const std::filesystem::path figures = scratch / "report/figures";
  std::vector<std::string> sums;
  for (int round = 0; round < 2; ++round) {
    REQUIRE(
        draw_figures(scratch / "report", std::nullopt, {}, {"final_materials"}).problem.empty());
    for (const char* file : {"final_materials.svg", "final_materials.png"})
      sums.push_back(hash_file(figures / file).sha256);
  }
  CHECK(sums[0] == sums[2]);
  CHECK(sums[1] == sums[3]);
}

TEST_CASE("A static run has no history of the zone to draw") {
  const Scratch scratch;
  write_case(scratch, false);
  const DrawnFigures drawn =
      draw_figures(scratch / "report", std::nullopt, {}, {"section_before", "zone_history"});
  INFO(drawn.problem);
  REQUIRE(drawn.figures.size() == 1);
  CHECK(drawn.figures[0].name == "section_before");
}

TEST_CASE("Without Matplotlib the message names the package and old figures go") {
  const Scratch scratch;
  scratch.write("report/figures/flow_history.png", "old");
  std::filesystem::create_directories(scratch / "report/data");
  for (const char* python : {"/bin/false", "/nowhere/python3"}) {
    const DrawnFigures drawn = draw_figures(scratch / "report", python, {});
    CHECK(drawn.figures.empty());
    CHECK(drawn.problem.find("python3-matplotlib") != std::string::npos);
    CHECK(drawn.problem.find(python) != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(scratch / "report/figures/flow_history.png"));
}

TEST_CASE("A script that fails is reported with its last words") {
  const Scratch scratch;
  std::filesystem::create_directories(scratch / "report/data");
  const DrawnFigures drawn = draw_figures(scratch / "report", std::nullopt, {});
  CHECK(drawn.figures.empty());
  CHECK(drawn.problem.find("plot.json") != std::string::npos);
}

TEST_CASE("Nothing that lies in a folder is run, nor what the environment names") {
  const Scratch scratch;
  write_case(scratch, true);
  const std::string trap =
      "open('" + (scratch / "trapped").string() + "', 'w').close()\nraise SystemExit(3)\n";
  for (const char* file : {"plot.py", "plot_style.py", "data/plot.py", "data/numpy.py", "numpy.py",
                           "sitecustomize.py", "usercustomize.py", "data/matplotlib.py"})
    scratch.write("report/" + std::string(file), trap);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(scratch / "report");
  ::setenv("PYTHONPATH", (scratch / "report").c_str(), 1);
  ::setenv("PYTHONSTARTUP", (scratch / "report/plot.py").c_str(), 1);
  const DrawnFigures drawn =
      draw_figures(scratch / "report", std::nullopt, {}, {"final_materials"});
  ::unsetenv("PYTHONPATH");
  ::unsetenv("PYTHONSTARTUP");
  std::filesystem::current_path(before);
  INFO(drawn.problem);
  CHECK(drawn.figures.size() == 1);
  CHECK_FALSE(std::filesystem::exists(scratch / "trapped"));
}

TEST_CASE("The scripts draw beside themselves when a user runs them") {
  const Scratch scratch;
  write_case(scratch, false);
  std::filesystem::create_directories(scratch / "plot");
  const auto files = write_plot_scripts(scratch / "plot");
  REQUIRE(files.size() == 3);
  CHECK(files[0] == "plot/plot.py");
  // As in the guide, by the interpreter that draw_figures() finds.
  const std::string command = "cd '" + scratch.path().string() +
                              "' && { python3 plot/plot.py section_before || "
                              "/usr/bin/python3 plot/plot.py section_before; } >log 2>&1";
  const int status = std::system(command.c_str());
  INFO(read_text_file(scratch / "log"));
  CHECK(status == 0);
  CHECK(std::filesystem::exists(scratch / "plot/figures/section_before.svg"));
  CHECK_FALSE(std::filesystem::exists(scratch / "report/figures"));
}

TEST_CASE("A flow down a falling valley lies within the figures, and so does the ground under it") {
  // The valley falls 20 % beyond the toe at x = 75; the mesh ends at y = -5, x = 85.
  const std::vector<ToldStage> ground{
      {"flow", "mpm.run",
       "ground.surface = [[-140 m, -5 m], [85 m, -5 m], [85 m, -2 m], [600 m, -105 m]]\n", "{}"}};
  for (const double fall : {0.2, 0.0}) {
    CAPTURE(fall);
    const Scratch scratch;
    write_case(scratch, false, {.fall = fall}, fall > 0.0 ? ground : std::vector<ToldStage>{});
    std::istringstream out(
        answer_of(scratch,
                  "from plot_section import Section\n"
                  "s = Section(pathlib.Path('report/data'))\n"
                  "print(s.ylim[0], s.points['y'].min(), s.points['x'].max(), s.dam_ylim[0])\n"));
    double bottom = 0.0, lowest = 0.0, far = 0.0, dam_bottom = 0.0;
    out >> bottom >> lowest >> far >> dam_bottom;
    CHECK(far > 150.0);
    CHECK(dam_bottom == Approx(-5.0).margin(2.5));
    if (fall > 0.0) {
      CHECK(lowest < -10.0);
      CHECK(bottom < lowest);
      CHECK(bottom < -2.0 - 0.2 * (far - 85.0));  // the ground under the front
    } else {
      CHECK(bottom == dam_bottom);  // control: nothing is lower than the section
    }
  }
}

TEST_CASE("The label of a colour bar is not cut, however flat the section") {
  const Scratch scratch;
  // Height of a section that is 1000 m long, and the overhang of the label over the figure.
  for (const int height : {20, 60, 120, 500}) {
    CAPTURE(height);
    std::istringstream out(answer_of(
        scratch,
        fmt::format("import plot_style\nfrom matplotlib.cm import ScalarMappable\n"
                    "from plot_section import stacked, colour_bar\n"
                    "figure, axes = stacked([('Whole flow', (0, 1000))], (0, {}), bar=0.85)\n"
                    "label = 'strength / strength at transfer'\n"
                    "bar = colour_bar(figure, ScalarMappable(cmap='cividis'), axes, label)\n"
                    "figure.canvas.draw()\n"
                    "text = bar.ax.yaxis.label\n"
                    "box, edge = text.get_window_extent(), figure.bbox\n"
                    "print(min(box.y0, edge.y1 - box.y1, edge.x1 - box.x1), text.get_fontsize())\n"
                    "assert text.get_text().replace(chr(10), ' ') == label\n",
                    height)));
    double room = 0.0, size = 0.0;
    out >> room >> size;
    CHECK(room > -0.5);  // pixels of 1/100 inch
    CHECK(size > 5.0);   // it can still be read
  }
}

TEST_CASE("An interpreter that sleeps is ended") {
  const Scratch scratch;
  write_case(scratch, false);
  const auto python = scratch.write("python",
                                    "#!/bin/sh\ncase \"$*\" in *find_spec*) exit 0;; esac\n"
                                    "exec sleep 1000\n");
  std::filesystem::permissions(python, std::filesystem::perms::owner_all);
  const DrawnFigures drawn =
      draw_figures(scratch / "report", python.string(), {.progress = {}, .seconds = 0.2});
  CHECK(drawn.figures.empty());
  CHECK(drawn.problem.find("had not ended") != std::string::npos);
}

TEST_CASE("A disk that is full is no matter of the interpreter") {
  const Scratch scratch;
  write_case(scratch, false);
  const auto python =
      scratch.write("python",
                    "#!/bin/sh\ncase \"$*\" in *find_spec*) exit 0;; esac\n"
                    "echo 'OSError: [Errno 28] No space left on device'\nexit 74\n");
  std::filesystem::permissions(python, std::filesystem::perms::owner_all);
  CHECK_THROWS_WITH(draw_figures(scratch / "report", python.string(), {}),
                    Catch::Contains("No space left"));
  CHECK_THROWS_AS(draw_figures(scratch / "report", python.string(), {}), FileError);
}

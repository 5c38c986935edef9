#include "core/units.hpp"
#include "tests/support/scratch.hpp"
#include "tests/transfer/fixture_dam.hpp"
#include "transfer/sordo2024/compat_sordo2024.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>

// Against numbers that the published script wrote from the same recorders
// (fixtures/transfer/sordo2024/README.md).

using namespace flowslide;

namespace {

using Table = std::map<std::string, std::vector<double>>;

Table read_table(const std::string& name) {
  std::ifstream in(test::fixture("transfer/sordo2024/" + name));
  Table table;
  std::vector<std::string> columns;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t k = 0; std::getline(cells, cell, ','); ++k) {
      if (!table.count("id") || columns.size() <= k) {
        columns.push_back(cell);
        table[cell];
        continue;
      }
      double value = 0.0;
      std::size_t length = 0;
      REQUIRE(parse_number(cell, value, length));
      table.at(columns[k]).push_back(value);
    }
  }
  return table;
}

void import_dam(const std::filesystem::path& out) {
  OpenSeesConfig c = test::shaken_fixture_dam();
  c.gravity.strain = InputFile{test::fixture("opensees/dam-rio270/Gstrain.out")};
  import_opensees(c, out);
}

/// What the points hold under the name of a column of the script.
double value_of(const ParticleSet& p, const std::string& column, std::size_t i) {
  if (column == "id") return static_cast<double>(p.id[i]);
  if (column == "mass") return p.mass[i];
  if (column == "volume") return p.volume[i];
  if (column == "coord_x") return p.position[i][0];
  if (column == "coord_y") return p.position[i][1];
  if (column == "displacement_x") return p.displacement[i][0];
  if (column == "displacement_y") return p.displacement[i][1];
  if (column == "velocity_x") return p.velocity[i][0];
  if (column == "velocity_y") return p.velocity[i][1];
  if (column == "stress_xx") return p.stress[i][0];
  if (column == "stress_yy") return p.stress[i][1];
  if (column == "tau_xy") return p.stress[i][3];
  return p.history.at(column)[i];
}

/// Relative to the largest value of the column: geometry to round-off; what passes through the
/// dense solution to round-off times the condition of its matrix (measured: 1e-10).
double tolerance(const std::string& column) {
  if (column == "id" || column == "material_id" || column == "nstate_vars") return 0.0;
  const bool interpolated = column.find("stress") == 0 || column.find("tau") == 0 ||
                            column.find("gamma") == 0 || column.find("svars") == 0;
  return interpolated || column == "epsilon_v" ? 1e-8 : 1e-11;
}

void compare(const ParticleSet& p, const Table& table) {
  REQUIRE(p.size() == 7340);
  for (const auto& [column, expected] : table) {
    REQUIRE(expected.size() == 199);
    double largest = 0.0, deviation = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      largest = std::max(largest, std::abs(expected[k]));
      deviation = std::max(deviation, std::abs(value_of(p, column, 37 * k) - expected[k]));
    }
    CAPTURE(column, largest, deviation);
    CHECK(deviation <= tolerance(column) * largest);
  }
}

}  // namespace

TEST_CASE("the dam is transferred as the published script did it", "[case]") {
  const Scratch folder;
  import_dam(folder / "history.h5");
  const FemHistory history(folder / "history.h5");
  SordoConfig config;
  config.base_node = 1;
  compare(map_sordo2024(history, config), read_table("static.csv"));

  config.frame = 28;
  REQUIRE(history.times().at(28) == Approx(7.01));
  config.liquefied = SordoLiquefied::line;
  config.line = {{-31.0, 5.0}, {3.5, 3.0}};
  compare(map_sordo2024(history, config), read_table("t7.01s.csv"));

  config.frame = 31;
  CHECK_THROWS_WITH(map_sordo2024(history, config), Catch::Matchers::Contains("31 frames"));
}

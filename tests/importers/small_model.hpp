#pragma once
#include "importers/opensees.hpp"
#include "tests/support/data_folder.hpp"

#include <string>

#include <fmt/format.h>

namespace flowslide::test {

/// Two square elements of 1 m side, saturated to the surface, in kPa; every value of a recorder is
/// an own number, so that an exchange of columns shows.
struct SmallModel {
  DataFolder folder;
  OpenSeesConfig config;

  static double pressure(int node, int row) { return (node <= 3 ? 9.81 : 0.0) + 0.01 * row; }
  static double vertical(int element, int row) { return -4.0 - 0.1 * element + 0.01 * row; }
  static double displacement(int node, int axis, int row) {
    return 1e-3 * node + 1e-4 * axis + 1e-2 * row;
  }

  SmallModel() {
    config.mesh.nodes.path =
        folder.write("nodeinfo.dat", "1 0 0\n2 1 0\n3 2 0\n4 0 1\n5 1 1\n6 2 1\n");
    config.mesh.elements.path = folder.write("elementinfo.dat", "10 1 2 5 4 168\n20 2 3 6 5 170\n");
    config.materials = {{"tailings", {168, 1870.0, 0.5}}, {"foundation", {170, 1900.0, {}}}};
    config.units = {"m", "s", "kPa"};
    config.gravity.stress.path = folder.write("Gstress.out", stress_rows(0, 1));
    config.gravity.strain = InputFile{folder.write("Gstrain.out", strain_rows(0, 1))};
    config.gravity.pore_pressure.path = folder.write("GporePressure.out", pressure_rows(0, 1));
    OpenSeesShaking shaking;
    shaking.displacement.path = folder.write("displacement.out", node_rows(1, 4));
    shaking.velocity.path = folder.write("velocity.out", node_rows(1, 4));
    shaking.pore_pressure.path = folder.write("porePressure.out", pressure_rows(1, 4));
    shaking.stress.path = folder.write("stress.out", stress_rows(1, 4));
    shaking.strain.path = folder.write("strain.out", strain_rows(1, 4));
    config.shaking = shaking;
  }

  /// Rows [first, last); row r is at time r/4.
  template <class Value>
  static std::string rows(int first, int last, int values, Value value) {
    std::string text;
    for (int r = first; r < last; ++r) {
      text += fmt::format("{}", 0.25 * r);
      for (int i = 0; i < values; ++i) text += fmt::format(" {}", value(i, r));
      text += '\n';
    }
    return text;
  }
  static std::string node_rows(int first, int last) {
    return rows(first, last, 12, [](int i, int r) { return displacement(1 + i / 2, i % 2, r); });
  }
  static std::string pressure_rows(int first, int last) {
    return rows(first, last, 6, [](int i, int r) { return pressure(1 + i, r); });
  }
  static std::string stress_rows(int first, int last) {
    return rows(first, last, 6, [](int i, int r) {
      const double v = vertical(1 + i / 3, r);
      return i % 3 == 0 ? 0.5 * v : i % 3 == 1 ? v : 0.125 * v;
    });
  }
  static std::string strain_rows(int first, int last) {
    return rows(first, last, 6, [](int i, int r) { return 1e-4 * (i + 1) + 1e-3 * r; });
  }
  [[nodiscard]] std::filesystem::path out() const { return folder.path("history.h5"); }
  ImportReport run_import() const { return import_opensees(config, out()); }
};

}  // namespace flowslide::test

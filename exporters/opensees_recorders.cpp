#include "exporters/opensees_recorders.hpp"

#include "core/check.hpp"
#include "core/files.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr double kKiloPascal = 1e-3;

/// A row of a recorder: time, then the numbers of each node or element.
class Row {
 public:
  explicit Row(double time) { add(time); }
  void add(double value) {
    if (!std::isfinite(value)) finite_ = false;
    fmt::format_to(std::back_inserter(text_), "{}{}", text_.size() == 0 ? "" : " ", value);
  }
  [[nodiscard]] std::string line(const char* file, double time) {
    validate(finite_,
             "{}: a value at t = {} s is not set (text recorders cannot say that). The history "
             "lacks velocity or strain; convert it to .pvd instead",
             file, time);
    text_.push_back('\n');
    return fmt::to_string(text_);
  }

 private:
  fmt::memory_buffer text_;
  bool finite_ = true;
};

std::string pairs(const char* file, double time, const std::vector<Vec2>& values) {
  Row row(time);
  for (const Vec2& v : values) {
    row.add(v[0]);
    row.add(v[1]);
  }
  return row.line(file, time);
}

std::string pressures(const char* file, const FemFrame& frame) {
  Row row(frame.time);
  for (const double p : frame.pore_pressure) row.add(kKiloPascal * p);
  return row.line(file, frame.time);
}

template <class Tensors>
std::string tensors(const char* file, double time, const Tensors& values, double factor) {
  Row row(time);
  for (const auto& t : values)
    for (const int component : {0, 1, 3}) row.add(factor * t[component]);
  return row.line(file, time);
}

void write_gravity(const fs::path& folder, const FemFrame& rest) {
  const auto one = [&folder](const char* name, const std::string& row) {
    write_file(folder / name, row);
  };
  one("Gstress.out", tensors("Gstress.out", rest.time, rest.stress, kKiloPascal));
  one("Gstrain.out", tensors("Gstrain.out", rest.time, rest.strain, 1.0));
  one("GporePressure.out", pressures("GporePressure.out", rest));
}

/// Largest part of the out-of-plane stress that its mean in the plane does not give [Pa].
double lost_zz(const FemFrame& frame) {
  double lost = 0.0;
  for (const Stress<2>& s : frame.stress)
    lost = std::max(lost, std::abs(s[2] - 0.5 * (s[0] + s[1])));
  return lost;
}

}  // namespace

void write_mesh_tables(const fs::path& folder, const QuadMesh& mesh) {
  make_folders(folder);
  remove_leftovers(folder);
  OutputFile nodes(folder / "nodeinfo.dat"), elements(folder / "elementinfo.dat");
  for (std::size_t i = 0; i < mesh.num_nodes(); ++i)
    nodes.write(fmt::format("{} {} {}\n", mesh.node_tags[i], mesh.nodes[i][0], mesh.nodes[i][1]));
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const auto& n = mesh.elements[e];
    elements.write(fmt::format("{} {} {} {} {} {}\n", mesh.element_tags[e], mesh.node_tags[n[0]],
                               mesh.node_tags[n[1]], mesh.node_tags[n[2]], mesh.node_tags[n[3]],
                               mesh.element_material[e]));
  }
  nodes.commit();
  elements.commit();
}

std::vector<std::string> write_opensees_recorders(const fs::path& folder,
                                                  const FemHistory& history) {
  write_mesh_tables(folder, history.mesh());
  write_gravity(folder, history.gravity());
  double lost = lost_zz(history.gravity());
  if (!history.times().empty()) {
    OutputFile displacement(folder / "displacement.out"), velocity(folder / "velocity.out"),
        pressure(folder / "porePressure.out"), stress(folder / "stress.out"),
        strain(folder / "strain.out");
    for (std::size_t i = 0; i < history.times().size(); ++i) {
      const FemFrame f = history.frame(i);
      displacement.write(pairs("displacement.out", f.time, f.displacement));
      velocity.write(pairs("velocity.out", f.time, f.velocity));
      pressure.write(pressures("porePressure.out", f));
      stress.write(tensors("stress.out", f.time, f.stress, kKiloPascal));
      strain.write(tensors("strain.out", f.time, f.strain, 1.0));
      lost = std::max(lost, lost_zz(f));
    }
    for (OutputFile* file : {&displacement, &velocity, &pressure, &stress, &strain}) file->commit();
  }
  std::vector<std::string> notes;
  if (lost > 1.0)
    notes.push_back(fmt::format(
        "the out-of-plane stress is left out, as OpenSees does; it differs from (xx + yy)/2 by up "
        "to {:.3g} kPa",
        kKiloPascal * lost));
  return notes;
}

}  // namespace flowslide

#include "exporters/cbgeo_csv.hpp"

#include "core/check.hpp"
#include "core/files.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

namespace flowslide {
namespace {

constexpr std::string_view kUnknownCell = "18446744073709551615";

/// Python's repr of a float: like fmt's shortest form, but never without a point or an exponent.
std::string real(double x) {
  std::string text = fmt::format("{}", x);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string whole(double x) { return fmt::format("{}", static_cast<std::int64_t>(x)); }

/// A history column, or zeros without it.
class Column {
 public:
  Column(const ParticleSet& p, std::string_view name) {
    const auto it = p.history.find(std::string(name));
    if (it != p.history.end()) values_ = &it->second;
  }
  [[nodiscard]] bool given() const { return values_ != nullptr; }
  [[nodiscard]] double operator[](std::size_t i) const { return given() ? (*values_)[i] : 0.0; }

 private:
  const std::vector<double>* values_ = nullptr;
};

struct Columns {
  explicit Columns(const ParticleSet& p)
      : strain_xx(p, "strain_xx"),
        strain_yy(p, "strain_yy"),
        gamma_xy(p, "gamma_xy"),
        epsilon_v(p, "epsilon_v"),
        material_id(p, "material_id"),
        nstate_vars(p, "nstate_vars") {
    for (int k = 0; k < 20; ++k) svars.emplace_back(p, fmt::format("svars_{}", k));
  }
  Column strain_xx, strain_yy, gamma_xy, epsilon_v, material_id, nstate_vars;
  std::vector<Column> svars;
};

std::string svar_text(int k, double value, bool has_state) {
  // Python integers of the script reach the file as such: the zeros, and whole cohesions.
  const bool always_real = has_state && (k == 0 || k == 6);
  return !always_real && value == std::floor(value) && std::abs(value) < 1e15 ? whole(value)
                                                                              : real(value);
}

std::string row(const ParticleSet& p, const Columns& c, std::size_t i) {
  const std::array<double, 6>& s = p.stress[i];
  const std::string size = real(std::sqrt(p.volume[i]));
  const double material = c.material_id.given() ? c.material_id[i] : p.material[i];
  const std::string zz = s[2] == 0.0 ? "0" : real(s[2]);
  std::string text = fmt::format(
      "{},{},{},0,{},{},0,{},{},0,{},{},0,{},{},0,{},{},{},{},0,0,{},{},0,{},0,0,{},1,{},{},{}",
      p.id[i], real(p.mass[i]), real(p.volume[i]), real(p.position[i][0]), real(p.position[i][1]),
      real(p.displacement[i][0]), real(p.displacement[i][1]), size, size, real(p.velocity[i][0]),
      real(p.velocity[i][1]), real(s[0]), real(s[1]), zz, real(s[3]), real(c.strain_xx[i]),
      real(c.strain_yy[i]), real(c.gamma_xy[i]), real(c.epsilon_v[i]), kUnknownCell,
      whole(material), whole(c.nstate_vars[i]));
  for (int k = 0; k < 20; ++k) text += ',' + svar_text(k, c.svars[k][i], c.nstate_vars[i] > 0.0);
  return text + '\n';
}

}  // namespace

void write_cbgeo_csv(const std::filesystem::path& path, const ParticleSet& particles) {
  validate(particles.dim == 2,
           "{}: the points have {} dimensions (the CB-Geo table of the script is plane strain) "
           "write another format",
           path.string(), particles.dim);
  OutputFile out(path);
  out.write(fmt::format("{}\n", fmt::join(kCbgeoColumns, ",")));
  const Columns columns(particles);
  for (std::size_t i = 0; i < particles.size(); ++i) out.write(row(particles, columns, i));
  out.commit();
}

}  // namespace flowslide

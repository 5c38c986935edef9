#include "model/particle_set.hpp"

#include "core/check.hpp"
#include "model/field_store.hpp"
#include "model/particle_io.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace flowslide {
namespace {

constexpr std::string_view kParticles = "particles";
constexpr int kParticlesFormat = 2, kOldestParticles = 2;  // 1 had no toe

std::string_view convention(std::string_view field) {
  if (field == "stress") return "total, tension positive, components xx yy zz xy yz zx";
  if (field == "pore_pressure") return "compression positive";
  if (field == "displacement") return "since the undeformed section";
  if (field == "mass" || field == "volume") return "per metre of width in plane strain";
  if (field == "material") return "row of materials/name";
  return "";
}

bool finite(double x) { return std::isfinite(x); }
bool finite(std::int32_t) { return true; }
bool finite(std::int64_t) { return true; }
template <class T, std::size_t N>
bool finite(const std::array<T, N>& values) {
  return std::all_of(values.begin(), values.end(), [](T x) { return std::isfinite(x); });
}

void check_particle_materials(const ParticleSet& p) {
  std::unordered_set<std::string> names;
  for (const MaterialSpec& m : p.materials) {
    validate(!m.name.empty() && !m.law.empty(),
             "a material of the particles has the name '{}' and the law '{}' (both are needed)",
             m.name, m.law);
    validate(names.insert(m.name).second,
             "two materials of the particles are called '{}' (reports could not tell them apart)",
             m.name);
    for (const auto& [key, value] : m.parameters)
      validate(std::isfinite(value), "material '{}': parameter '{}' is {} (not finite)", m.name,
               key, value);
  }
}

/// The name becomes that of a dataset, where '/' and '.' have a meaning.
void check_history_name(const std::string& name) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  validate(plain, "history variable '{}' of the particles: use letters, digits, '_' and '-' only",
           name);
}

/// A sorted copy: a set takes some 50 bytes an id.
void check_ids(std::vector<std::int64_t> ids) {
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) throw InputError(fmt::format("particle id {} occurs twice", *twice));
}

}  // namespace

void resize(ParticleSet& p, std::size_t n) {
  visit_fields(p, [n](auto, auto, auto& array) { array.resize(n); });
  for (auto& [name, values] : p.history) values.resize(n);
}

void check(const ParticleSet& p) {
  const std::size_t n = p.size();
  validate(p.dim == 2 || p.dim == 3, "the particles have dimension {} (2 or 3 is possible)", p.dim);
  validate(n > 0, "there are no particles (nothing could move); check the zone and the seeding");
  visit_fields(p, [n](std::string_view name, auto, const auto& array) {
    validate(array.size() == n, "there are {} particles but {} values of {}", n, array.size(),
             name);
  });
  for (const auto& [name, values] : p.history) {
    check_history_name(name);
    validate(values.size() == n, "there are {} particles but {} values of {}", n, values.size(),
             name);
  }
  validate(!std::isinf(p.toe), "the toe of the particles is infinite (no runout could be counted)");
  check_particle_materials(p);
  check_ids(p.id);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t id = p.id[i];
    validate(p.mass[i] > 0.0, "particle {} has the mass {} kg (it must be positive)", id,
             p.mass[i]);
    validate(p.volume[i] > 0.0, "particle {} has the volume {} m3 (it must be positive)", id,
             p.volume[i]);
    validate(p.material[i] >= 0 && static_cast<std::size_t>(p.material[i]) < p.materials.size(),
             "particle {} has the material index {} (there are {} materials)", id, p.material[i],
             p.materials.size());
    visit_fields(p, [i, id](std::string_view name, auto, const auto& array) {
      validate(finite(array[i]), "particle {}: {} is not finite", id, name);
    });
    for (const auto& [name, values] : p.history)
      validate(!std::isinf(values[i]), "particle {}: {} is infinite", id, name);
  }
}

void write_particles(FieldWriter& out, const ParticleSet& p) {
  out.write("dim", std::vector<std::int32_t>{p.dim}, {.unit = ""});
  out.write("toe", std::vector<double>{p.toe},
            {.unit = "m", .convention = "x from which the runout counts", .nan = Nan::allowed});
  visit_fields(p, [&out](std::string_view name, std::string_view unit, const auto& array) {
    out.write("particles/" + std::string(name), array,
              {.unit = unit, .convention = convention(name)});
  });
  for (const auto& [name, values] : p.history)
    out.write("history/" + name, values,
              {.unit = "", .convention = "SI; NaN means unset", .nan = Nan::allowed});

  std::vector<std::string> names, laws, keys;
  std::vector<std::uint8_t> counts, liquefied;
  std::vector<std::int32_t> owners;
  std::vector<double> values;
  for (const MaterialSpec& m : p.materials) {
    for (const auto& [key, value] : m.parameters) {
      owners.push_back(static_cast<std::int32_t>(names.size()));
      keys.push_back(key);
      values.push_back(value);
    }
    names.push_back(m.name);
    laws.push_back(m.law);
    counts.push_back(m.counts_for_runout ? 1 : 0);
    liquefied.push_back(m.liquefied ? 1 : 0);
  }
  out.write_texts("materials/name", names);
  out.write_texts("materials/law", laws);
  out.write("materials/counts_for_runout", counts, {.unit = "", .convention = "1 yes, 0 no"});
  out.write("materials/liquefied", liquefied, {.unit = "", .convention = "1 yes, 0 no"});
  out.write("materials/parameter_material", owners,
            {.unit = "", .convention = "row of materials/name"});
  out.write_texts("materials/parameter_name", keys);
  out.write("materials/parameter_value", values, {.unit = "", .convention = "SI"});
  out.write_texts("notes", p.notes);
}

ParticleSet read_particles(const FieldReader& in) {
  ParticleSet p;
  p.dim = in.read_one<std::int32_t>("dim");
  p.toe = in.read<double>("toe", 1, Nan::allowed)[0];
  const std::size_t n = in.rows("particles/position");
  visit_fields(p, [&in, n](std::string_view name, auto, auto& array) {
    using T = typename std::decay_t<decltype(array)>::value_type;
    array = in.read<T>("particles/" + std::string(name), n);
  });
  if (in.has("history"))
    for (const std::string& name : in.names("history"))
      p.history[name] = in.read<double>("history/" + name, n, Nan::allowed);

  p.notes = in.read_texts("notes");
  const std::vector<std::string> names = in.read_texts("materials/name");
  const std::vector<std::string> laws = in.read_texts("materials/law", names.size());
  const auto counts = in.read<std::uint8_t>("materials/counts_for_runout", names.size());
  const auto liquefied = in.read<std::uint8_t>("materials/liquefied", names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    p.materials.push_back({names[i], laws[i], {}, counts[i] != 0, liquefied[i] != 0});
  const auto owners = in.read<std::int32_t>("materials/parameter_material");
  const auto keys = in.read_texts("materials/parameter_name", owners.size());
  const auto values = in.read<double>("materials/parameter_value", owners.size());
  for (std::size_t i = 0; i < owners.size(); ++i) {
    validate(owners[i] >= 0 && static_cast<std::size_t>(owners[i]) < names.size(),
             "'{}': parameter '{}' belongs to material {} (there are {})", in.path().string(),
             keys[i], owners[i], names.size());
    p.materials[owners[i]].parameters[keys[i]] = values[i];
  }
  try {
    check(p);
  } catch (const InputError& error) {
    throw InputError(fmt::format("'{}': {}", in.path().string(), error.what()));
  }
  return p;
}

void write_particles(const std::filesystem::path& path, const ParticleSet& p) {
  check(p);
  FieldWriter out(path, kParticles, kParticlesFormat);
  write_particles(out, p);
  out.finish();
}

ParticleSet read_particles(const std::filesystem::path& path) {
  return read_particles(FieldReader(path, kParticles, kParticlesFormat, kOldestParticles));
}

}  // namespace flowslide

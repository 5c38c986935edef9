#include "model/history_material.hpp"

#include "model/names_of.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace flowslide {
namespace {

/// The material with the tag that a text is; null if it is none.
const HistoryMaterial* of_tag(const std::vector<HistoryMaterial>& materials,
                              std::string_view text) {
  std::int32_t tag = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), tag);
  if (error != std::errc() || end != text.data() + text.size()) return nullptr;
  const auto at = std::find_if(materials.begin(), materials.end(),
                               [tag](const HistoryMaterial& m) { return m.tag == tag; });
  return at == materials.end() ? nullptr : &*at;
}

}  // namespace

void check(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials) {
  std::set<std::string> names;
  std::set<std::int32_t> tags;
  for (const HistoryMaterial& m : materials) {
    validate(!m.name.empty() && names.insert(m.name).second,
             "two materials are called '{}' (a name must tell one from the other) rename one",
             m.name);
    validate(tags.insert(m.tag).second,
             "material '{}' has the tag {} of another material (their elements would be one) give "
             "it its own tag",
             m.name, m.tag);
    validate(m.density > 0.0 && std::isfinite(m.density),
             "material '{}' has the density {} kg/m3 (its soil would have no mass) give its "
             "density",
             m.name, m.density);
    validate(!is_set(m.porosity) || (m.porosity > 0.0 && m.porosity < 1.0),
             "material '{}' has the porosity {} (it lies between 0 and 1) correct it", m.name,
             m.porosity);
  }
  for (std::size_t e = 0; e < mesh.num_elements(); ++e)
    validate(tags.count(mesh.element_material[e]) > 0,
             "element {} has the material tag {}, which no material has (its name and density are "
             "unknown; known: {}) add a material with that tag",
             mesh.element_tags[e], mesh.element_material[e], names_of(materials));
}

const HistoryMaterial& find_material(const std::vector<HistoryMaterial>& materials,
                                     std::string_view name, std::string_view setting) {
  for (const HistoryMaterial& m : materials)
    if (m.name == name) return m;
  const HistoryMaterial* tagged = of_tag(materials, name);
  throw InputError(tagged ? fmt::format("{}: {} is a tag (materials go by their names) write {}",
                                        setting, name, tagged->name)
                          : fmt::format("{}: the section has no material '{}' (known: {})", setting,
                                        name, names_of(materials)));
}

std::vector<double> element_densities(const QuadMesh& mesh,
                                      const std::vector<HistoryMaterial>& materials) {
  std::map<std::int32_t, double> of_tag;
  for (const HistoryMaterial& m : materials) of_tag[m.tag] = m.density;
  std::vector<double> density(mesh.num_elements());
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const auto at = of_tag.find(mesh.element_material[e]);
    validate(at != of_tag.end(),
             "element {} has the material tag {}, which no material has (its mass is unknown)",
             mesh.element_tags[e], mesh.element_material[e]);
    density[e] = at->second;
  }
  return density;
}

}  // namespace flowslide

#include "transfer/map/map_groups.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace flowslide {
namespace {

MapGroup make_group(const std::string& name, const AnyMaterial& law, const MapMaterial& material,
                    std::int32_t family, bool liquefied) {
  LawParameters p = to_parameters(law);
  return {{name, std::move(p.law), std::move(p.parameters), material.counts_for_runout, liquefied},
          law,
          family,
          liquefied};
}

bool touches(const Box& box, const std::array<Vec2, 4>& quad) {
  Polygon p;
  for (const Vec2& v : quad) p.push(v);
  return area_moment(clip(p, box)).area > 0.0;
}

struct Family {
  const std::string* name;
  const MapMaterial* material;
  bool has_liquefied = false;
  std::int32_t dry = -1, liquefied = -1;  ///< groups
};

/// Families by the tags of the section.
std::map<std::int32_t, std::int32_t> families_by_tag(const std::vector<HistoryMaterial>& materials,
                                                     const MapConfig& config) {
  std::map<std::int32_t, std::int32_t> family;
  std::int32_t k = 0;
  for (const auto& [name, material] : config.materials) {
    for (const std::string& source : sources_of(name, material))
      family[find_material(materials, source, "map: materials." + name).tag] = k;
    ++k;
  }
  return family;
}

/// The family of an element's soil, or -1 outside the box. Throws InputError for soil of the box
/// that becomes no material, and for liquefied soil without a law.
std::int32_t family_of(std::size_t e, const QuadMesh& mesh, const std::vector<Vec2>& positions,
                       const Box& box, const LiquefactionZone& zone,
                       const std::map<std::int32_t, std::int32_t>& family_of_tag,
                       const std::vector<Family>& families,
                       const std::vector<HistoryMaterial>& materials) {
  const auto found = family_of_tag.find(mesh.element_material[e]);
  if (found == family_of_tag.end()) {
    const std::int32_t tag = mesh.element_material[e];
    const auto of_tag = std::find_if(materials.begin(), materials.end(),
                                     [tag](const HistoryMaterial& m) { return m.tag == tag; });
    validate(!touches(box, corners(mesh, positions, e)),
             "map: element {} is of the material '{}', which is not among materials (its law is "
             "unknown). Add it, or leave the element outside the box",
             mesh.element_tags[e], of_tag == materials.end() ? "?" : of_tag->name);
    return -1;
  }
  const Family& f = families[static_cast<std::size_t>(found->second)];
  validate(!zone.liquefied[e] || f.material->liquefied,
           "map: element {} of material '{}' has liquefied, but the material has no law for "
           "liquefied soil (its strength would be that of intact soil). Add liquefied: "
           "{{youngs_modulus: ..., poisson_ratio: ...}} to it, or exclude it from the zone",
           mesh.element_tags[e], *f.name);
  return found->second;
}

}  // namespace

MapGroups group_elements(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                         const std::vector<Vec2>& positions, const Box& box,
                         const LiquefactionZone& zone, const MapConfig& config) {
  std::vector<Family> families;
  for (const auto& [name, material] : config.materials) families.push_back({&name, &material});
  const std::map<std::int32_t, std::int32_t> family_of_tag = families_by_tag(materials, config);

  MapGroups result;
  const std::size_t n = mesh.num_elements();
  result.group.assign(n, -1);
  result.family.assign(n, -1);
  result.density = element_densities(mesh, materials);
  for (std::size_t e = 0; e < n; ++e) {
    const std::int32_t k =
        family_of(e, mesh, positions, box, zone, family_of_tag, families, materials);
    if (k < 0) continue;
    Family& f = families[static_cast<std::size_t>(k)];
    result.family[e] = k;
    f.has_liquefied = f.has_liquefied || zone.liquefied[e];
  }

  for (std::size_t k = 0; k < families.size(); ++k) {
    Family& f = families[k];
    const auto family = static_cast<std::int32_t>(k);
    f.dry = static_cast<std::int32_t>(result.groups.size());
    result.groups.push_back(
        make_group(*f.name, make_material(f.material->law, *f.name), *f.material, family, false));
    if (!f.has_liquefied) continue;
    f.liquefied = static_cast<std::int32_t>(result.groups.size());
    result.groups.push_back(make_group("liquefied " + *f.name,
                                       Material<ResidualStrength>{*f.material->liquefied},
                                       *f.material, family, true));
  }
  for (std::size_t e = 0; e < n; ++e) {
    if (result.family[e] < 0) continue;
    const Family& f = families[static_cast<std::size_t>(result.family[e])];
    result.group[e] = zone.liquefied[e] ? f.liquefied : f.dry;
  }
  return result;
}

}  // namespace flowslide

#include "transfer/zone.hpp"

#include "core/check.hpp"
#include "transfer/distortion.hpp"
#include "transfer/energy.hpp"
#include "transfer/zone_extent.hpp"
#include "transfer/zone_r_u.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

/// What part of the mesh counts for what.
struct Parts {
  std::vector<std::int32_t> section;  ///< elements inside the box
  std::vector<std::int32_t> soil;     ///< liquefiable ones among them
  std::vector<std::uint8_t> in_soil;  ///< flag per element, the same
  std::vector<std::int32_t> base_nodes;
};

bool inside(const ZoneBox& box, Vec2 p, double tolerance) {
  return p[0] >= box.left.value_or(p[0]) - tolerance &&
         p[0] <= box.right.value_or(p[0]) + tolerance &&
         p[1] >= box.bottom.value_or(p[1]) - tolerance &&
         p[1] <= box.top.value_or(p[1]) + tolerance;
}

std::vector<std::int32_t> tagged_nodes(const QuadMesh& mesh, const std::vector<int>& tags) {
  std::vector<std::int32_t> nodes;
  for (const int tag : tags) {
    const auto found = std::ranges::find(mesh.node_tags, tag);
    validate(found != mesh.node_tags.end(),
             "base_nodes: the mesh has no node {} (the base velocity needs it) correct the list",
             tag);
    nodes.push_back(static_cast<std::int32_t>(found - mesh.node_tags.begin()));
  }
  return nodes;
}

Parts divide(const QuadMesh& mesh, const ZoneConfig& config) {
  for (const int tag : config.liquefiable) {
    validate(
        std::ranges::find(mesh.element_material, tag) != mesh.element_material.end(),
        "liquefiable: no element has material {} (nothing of it can liquefy) check the tags of "
        "the mesh",
        tag);
  }
  Parts parts;
  parts.in_soil.resize(mesh.num_elements());
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const std::array<Vec2, 4> quad = corners(mesh, mesh.nodes, e);
    // Coordinates often pass through text with six digits.
    const double tolerance = 1e-4 * std::sqrt(area(quad));
    const auto counts = [&config, tolerance](Vec2 p) { return inside(config.box, p, tolerance); };
    if (!std::ranges::all_of(quad, counts)) continue;
    parts.section.push_back(static_cast<std::int32_t>(e));
    if (std::ranges::find(config.liquefiable, mesh.element_material[e]) ==
        config.liquefiable.end()) {
      continue;
    }
    parts.soil.push_back(static_cast<std::int32_t>(e));
    parts.in_soil[e] = 1;
  }
  validate(!parts.soil.empty(),
           "the box holds no liquefiable element (nothing can liquefy) check box and liquefiable");
  parts.base_nodes = config.base_nodes.empty() ? lowest_nodes(mesh, parts.section)
                                               : tagged_nodes(mesh, config.base_nodes);
  return parts;
}

void check_windows(const QuadMesh& mesh, const Parts& parts, const DepthWindows& windows) {
  for (const auto& [name, window] : windows) {
    const bool found = std::ranges::any_of(parts.soil, [&mesh, &window](std::int32_t e) {
      return std::ranges::any_of(mesh.elements[static_cast<std::size_t>(e)], [&](std::int32_t n) {
        return window.contains(mesh.nodes[static_cast<std::size_t>(n)][0]);
      });
    });
    validate(
        found,
        "windows.{}: no node of the liquefiable soil lies in x = {} m to {} m (its depth would "
        "always be 0) choose a window that crosses the soil",
        name, window.from, window.to);
  }
}

/// Appends one frame to the history; returns the energy of the section riding on its base.
double append(ZoneHistory& h, const QuadMesh& mesh, const FemFrame& frame, const Parts& parts,
              std::span<const double> mass, const RuReference& reference,
              const ZoneConfig& config) {
  for (const std::int32_t e : parts.section) {
    for (const std::int32_t node : mesh.elements[static_cast<std::size_t>(e)]) {
      const auto n = static_cast<std::size_t>(node);
      validate(
          std::isfinite(frame.displacement[n][0]) && std::isfinite(frame.displacement[n][1]) &&
              std::isfinite(frame.velocity[n][0]) && std::isfinite(frame.velocity[n][1]),
          "node {}: displacement or velocity at {} s is not finite (energy and distortion need "
          "it) check the recorders, or end the record before",
          mesh.node_tags[n], frame.time);
    }
    validate(std::isfinite(deviatoric_strain(frame.strain[static_cast<std::size_t>(e)])),
             "element {}: the strain at {} s is not finite (the distortion needs it) check the "
             "recorder, or end the record before",
             mesh.element_tags[static_cast<std::size_t>(e)], frame.time);
  }
  std::vector<Vec2> positions = mesh.nodes;
  for (std::size_t n = 0; n < positions.size(); ++n) {
    for (std::size_t k = 0; k < 2; ++k) positions[n][k] += frame.displacement[n][k];
  }
  const std::vector<double> r_u = r_u_at_nodes(mesh, reference, frame.pore_pressure, frame.time);
  const std::vector<Vec2>& where =
      config.depth_coordinates == DepthCoordinates::original ? mesh.nodes : positions;
  h.time.push_back(frame.time);
  std::size_t w = 0;
  for (const auto& [name, window] : config.windows) {
    const double depth =
        depth_of_liquefaction(window, config.pond_surface, where, r_u, config.r_u.threshold);
    h.depth_max[w].push_back(h.depth[w].empty() ? depth : std::max(depth, h.depth_max[w].back()));
    h.depth[w].push_back(depth);
    ++w;
  }
  const KineticEnergy energy =
      kinetic_energy(mesh, parts.section, mass, frame.velocity, parts.base_nodes);
  h.kinetic_energy.push_back(energy.absolute);
  h.kinetic_energy_relative.push_back(energy.relative);
  const Distortion q = distortion(mesh, parts.section, positions, frame.strain,
                                  config.transfer.automatic.strain_threshold);
  h.distortion_gauss.push_back(q.gauss);
  h.distortion_centre.push_back(q.centre);
  return energy.base;
}

/// r_u of the frame, or the largest up to it; zero in the gravity state.
std::vector<double> r_u_of_zone(const FemHistory& history, const RuReference& reference, int frame,
                                RuOverTime over_time) {
  const QuadMesh& mesh = history.mesh();
  if (frame < 0) return r_u_at_nodes(mesh, reference, reference.u_0, 0.0);
  std::vector<double> r_u;
  for (int i = over_time == RuOverTime::maximum ? 0 : frame; i <= frame; ++i) {
    const FemFrame f = history.frame(static_cast<std::size_t>(i));
    const std::vector<double> now = r_u_at_nodes(mesh, reference, f.pore_pressure, f.time);
    if (r_u.empty()) r_u = now;
    for (std::size_t n = 0; n < r_u.size(); ++n) {
      if (now[n] > r_u[n]) r_u[n] = now[n];
    }
  }
  return r_u;
}

void flag_elements(LiquefactionZone& zone, const QuadMesh& mesh, const Parts& parts,
                   const ZoneShape& shape, const ZoneConfig& config) {
  zone.liquefied.assign(mesh.num_elements(), 0);
  zone.strength.assign(mesh.num_elements(), kUnset);
  zone.layer.assign(mesh.num_elements(), -1);
  zone.lower_boundary = shape.lower_boundary;
  std::size_t liquefied = 0;
  std::size_t clamped = 0;
  for (const std::int32_t element : parts.soil) {
    const auto e = static_cast<std::size_t>(element);
    const Vec2 centre = centroid(corners(mesh, mesh.nodes, e));
    if (config.zone != ZoneExtent::all && !contains(shape, centre)) continue;
    const LayerStrength s = strength_at(config.strength, zone.sigma_v0[e]);
    zone.liquefied[e] = 1;
    zone.strength[e] = s.strength;
    zone.layer[e] = s.layer;
    ++liquefied;
    if (s.clamped) ++clamped;
  }
  if (liquefied == 0) zone.notes.emplace_back("no element has liquefied at the transfer time");
  if (clamped > 0) {
    zone.notes.push_back(fmt::format(
        "{} of {} liquefied elements lie outside strength.table ({:g} to {:g} kPa): its "
        "end values were used",
        clamped, liquefied, config.strength.table.front()[0] * 1e-3,
        config.strength.table.back()[0] * 1e-3));
  }
}

/// Depth below the pond surface of the lowest node of the soil that lies in a zone given by the
/// user.
double depth_of_shape(const QuadMesh& mesh, const Parts& parts, const ZoneShape& shape,
                      const DepthWindow& window, const ZoneConfig& config) {
  double depth = 0.0;
  for (const std::int32_t e : parts.soil) {
    for (const std::int32_t n : mesh.elements[static_cast<std::size_t>(e)]) {
      const Vec2 p = mesh.nodes[static_cast<std::size_t>(n)];
      if (!window.contains(p[0])) continue;
      if (config.zone == ZoneExtent::all || contains(shape, p)) {
        depth = std::max(depth, config.pond_surface - p[1]);
      }
    }
  }
  return depth;
}

std::map<std::int32_t, double> density_of_material(const ZoneConfig& config) {
  std::map<std::int32_t, double> density;
  for (const std::vector<double>& row : config.densities) {
    density[static_cast<std::int32_t>(row[0])] = row[1];
  }
  return density;
}

}  // namespace

LiquefactionZone find_zone(const FemHistory& history, const ZoneConfig& config,
                           const Progress& progress) {
  check(config);
  const QuadMesh& mesh = history.mesh();
  const Parts parts = divide(mesh, config);
  check_windows(mesh, parts, config.windows);
  RuReference reference = r_u_reference(mesh, history.gravity(), parts.in_soil, config.r_u);

  LiquefactionZone zone;
  ZoneHistory& h = zone.history;
  for (const auto& [name, window] : config.windows) h.window_names.push_back(name);
  h.depth.resize(h.window_names.size());
  h.depth_max.resize(h.window_names.size());

  const std::size_t frames = history.times().size();
  const std::vector<double> mass =
      frames > 0 ? element_masses(mesh, parts.section, density_of_material(config))
                 : std::vector<double>();
  std::vector<double> base_energy;
  for (std::size_t i = 0; i < frames; ++i) {
    if (progress.should_stop()) throw Interrupted("stopped while the frames were read");
    base_energy.push_back(append(h, mesh, history.frame(i), parts, mass, reference, config));
    progress.report(static_cast<double>(i + 1) / static_cast<double>(frames),
                    fmt::format("{:.3g} s", h.time.back()));
  }

  const TransferChoice choice = choose_transfer(config.transfer, h, base_energy);
  zone.transfer_time = choice.time;
  zone.transfer_frame = choice.frame;
  zone.transfer_reason = choice.reason;
  zone.r_u_node = r_u_of_zone(history, reference, choice.frame, config.r_u.over_time);
  zone.r_u_element = element_means(mesh, zone.r_u_node);
  zone.sigma_v0 = std::move(reference.sigma_v0);
  zone.notes = std::move(reference.notes);
  const ZoneShape shape = zone_shape(config, mesh, parts.soil, zone.r_u_node);
  flag_elements(zone, mesh, parts, shape, config);

  zone.window_names = h.window_names;
  std::size_t w = 0;
  for (const auto& [name, window] : config.windows) {
    zone.window_depth_max.push_back(config.zone == ZoneExtent::automatic
                                        ? h.depth_max[w][static_cast<std::size_t>(choice.frame)]
                                        : depth_of_shape(mesh, parts, shape, window, config));
    ++w;
  }
  return zone;
}

}  // namespace flowslide

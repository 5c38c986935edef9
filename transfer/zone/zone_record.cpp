#include "transfer/zone/zone_record.hpp"

#include "core/check.hpp"
#include "transfer/zone/depth.hpp"
#include "transfer/zone/distortion.hpp"
#include "transfer/zone/energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace flowslide {
namespace {

bool inside(const SectionBox& box, Vec2 p, double tolerance) {
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

std::vector<std::int32_t> liquefiable_tags(const QuadMesh& mesh,
                                           const std::vector<HistoryMaterial>& materials,
                                           const TransferRuleConfig& config) {
  std::vector<std::int32_t> tags;
  for (const std::string& name : config.liquefiable) {
    const std::int32_t tag = find_material(materials, name, "liquefiable").tag;
    validate(
        std::ranges::find(mesh.element_material, tag) != mesh.element_material.end(),
        "liquefiable: no element is of the material '{}' (nothing of it can liquefy) check the "
        "mesh",
        name);
    tags.push_back(tag);
  }
  return tags;
}

[[noreturn]] void refuse_box(const QuadMesh& mesh, const std::vector<std::int32_t>& liquefiable) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec2 low{kFar, kFar}, high{-kFar, -kFar};
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (std::ranges::find(liquefiable, mesh.element_material[e]) == liquefiable.end()) continue;
    for (const std::int32_t n : mesh.elements[e])
      for (std::size_t d = 0; d < 2; ++d) {
        low[d] = std::min(low[d], mesh.nodes[n][d]);
        high[d] = std::max(high[d], mesh.nodes[n][d]);
      }
  }
  throw InputError(fmt::format(
      "box: no liquefiable element lies in it (nothing can liquefy) it must reach around "
      "what is liquefiable, which spans x = {:.6g} to {:.6g} m and y = {:.6g} to {:.6g} "
      "m. Are the units right?",
      low[0], high[0], low[1], high[1]));
}

ZoneParts divide(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                 const TransferRuleConfig& config) {
  const std::vector<std::int32_t> liquefiable = liquefiable_tags(mesh, materials, config);
  ZoneParts parts;
  parts.in_soil.resize(mesh.num_elements());
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const std::array<Vec2, 4> quad = corners(mesh, mesh.nodes, e);
    // Coordinates often pass through text with six digits.
    const double tolerance = 1e-4 * std::sqrt(area(quad));
    const auto counts = [&config, tolerance](Vec2 p) { return inside(config.box, p, tolerance); };
    if (!std::ranges::all_of(quad, counts)) continue;
    parts.section.push_back(static_cast<std::int32_t>(e));
    if (std::ranges::find(liquefiable, mesh.element_material[e]) == liquefiable.end()) continue;
    parts.soil.push_back(static_cast<std::int32_t>(e));
    parts.in_soil[e] = 1;
  }
  if (parts.soil.empty()) refuse_box(mesh, liquefiable);
  parts.base_nodes = config.base_nodes.empty() ? lowest_nodes(mesh, parts.section)
                                               : tagged_nodes(mesh, config.base_nodes);
  return parts;
}

void check_windows(const QuadMesh& mesh, const ZoneParts& parts, const DepthWindows& windows) {
  for (const auto& [name, window] : windows) {
    const bool found = std::ranges::any_of(parts.soil, [&mesh, &window = window](std::int32_t e) {
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

}  // namespace

ZoneParts zone_parts(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                     const TransferRuleConfig& config) {
  ZoneParts parts = divide(mesh, materials, config);
  check_windows(mesh, parts, config.windows);
  return parts;
}

ZoneRecorder::ZoneRecorder(const QuadMesh& mesh, const std::vector<HistoryMaterial>& materials,
                           const FemFrame& gravity, const TransferRuleConfig& config)
    : mesh_(mesh),
      config_(config),
      parts_(zone_parts(mesh, materials, config)),
      mass_(element_masses(mesh, parts_.section, element_densities(mesh, materials))),
      adjacent_(soil_neighbours(mesh, parts_.soil)),
      columns_(soil_columns(mesh, parts_.soil, config.columns.width)),
      section_mass_(std::accumulate(mass_.begin(), mass_.end(), 0.0)),
      strain_at_rest_(gravity.strain),
      sliding_(config.transfer.automatic.smoothing) {
  config_.windows = windows_or_all(config);
  reference_ = r_u_reference(mesh_, gravity, parts_.in_soil, config_.r_u);
  for (const auto& [name, window] : config_.windows) history_.window_names.push_back(name);
  for (auto* table :
       {&history_.depth, &history_.depth_max, &history_.depth_any, &history_.depth_interpolated})
    table->resize(history_.window_names.size());
}

void ZoneRecorder::check_finite(const FemFrame& frame) const {
  for (const std::int32_t e : parts_.section) {
    for (const std::int32_t node : mesh_.elements[static_cast<std::size_t>(e)]) {
      const auto n = static_cast<std::size_t>(node);
      validate(
          std::isfinite(frame.displacement[n][0]) && std::isfinite(frame.displacement[n][1]) &&
              std::isfinite(frame.velocity[n][0]) && std::isfinite(frame.velocity[n][1]),
          "node {}: displacement or velocity at {} s is not finite (energy and distortion need "
          "it) check the recorders, or end the record before",
          mesh_.node_tags[n], frame.time);
    }
    validate(std::isfinite(deviatoric_strain(frame.strain[static_cast<std::size_t>(e)])),
             "element {}: the strain at {} s is not finite (the distortion needs it) check the "
             "recorder, or end the record before",
             mesh_.element_tags[static_cast<std::size_t>(e)], frame.time);
  }
}

void ZoneRecorder::append_depths(std::span<const Vec2> positions, std::span<const double> r_u) {
  const double threshold = config_.r_u.threshold;
  const std::vector<std::uint8_t> counted =
      confirmed_nodes(adjacent_, r_u, threshold, config_.columns.neighbours);
  std::size_t w = 0;
  for (const auto& [name, window] : config_.windows) {
    const double depth =
        depth_of_liquefaction(window, config_.pond_surface, positions, r_u, threshold, counted);
    history_.depth_max[w].push_back(
        history_.depth[w].empty() ? depth : std::max(depth, history_.depth_max[w].back()));
    history_.depth[w].push_back(depth);
    history_.depth_any[w].push_back(
        depth_of_liquefaction(window, config_.pond_surface, positions, r_u, threshold));
    std::vector<std::uint8_t> inside = counted;
    for (std::size_t n = 0; n < inside.size(); ++n)
      if (!window.contains(positions[n][0])) inside[n] = 0;
    double between = 0.0;
    for (const SoilColumn& column : columns_)
      if (const auto y = liquefied_bottom(column, positions, r_u, inside, threshold))
        between = std::max(between, config_.pond_surface - *y);
    history_.depth_interpolated[w].push_back(between);
    ++w;
  }
}

/// Strain of the shaking alone: recorders of other programs may hold that of gravity too.
double ZoneRecorder::yielded_share(std::span<const StrainIncrement<2>> strain) const {
  double yielded = 0.0;
  for (std::size_t i = 0; i < parts_.section.size(); ++i) {
    const auto e = static_cast<std::size_t>(parts_.section[i]);
    StrainIncrement<2> since = strain[e];
    for (int k = 0; k < kVoigt<2>; ++k)
      if (std::isfinite(strain_at_rest_[e][k])) since[k] -= strain_at_rest_[e][k];
    if (deviatoric_strain(since) > kYieldStrain) yielded += mass_[i];
  }
  return yielded / section_mass_;
}

void ZoneRecorder::append(const FemFrame& frame) {
  check_finite(frame);
  std::vector<Vec2> positions = mesh_.nodes;
  for (std::size_t n = 0; n < positions.size(); ++n) {
    for (std::size_t k = 0; k < 2; ++k) positions[n][k] += frame.displacement[n][k];
  }
  const std::vector<double> r_u = r_u_at_nodes(mesh_, reference_, frame.pore_pressure, frame.time);
  history_.time.push_back(frame.time);
  append_depths(config_.depth_coordinates == DepthCoordinates::original ? mesh_.nodes : positions,
                r_u);
  const KineticEnergy energy =
      kinetic_energy(mesh_, parts_.section, mass_, frame.velocity, parts_.base_nodes);
  history_.kinetic_energy.push_back(energy.absolute);
  history_.kinetic_energy_relative.push_back(energy.relative);
  const Distortion q = distortion(mesh_, parts_.section, positions, frame.strain,
                                  config_.transfer.automatic.strain_threshold);
  history_.distortion_gauss.push_back(q.gauss);
  history_.distortion_centre.push_back(q.centre);
  const SlidingEnergy::Values sliding = sliding_.append(frame.time, mesh_, parts_.section, mass_,
                                                        frame.displacement, parts_.base_nodes);
  history_.sliding_energy.push_back(sliding.section);
  base_kinetic_.push_back(energy.base);
  const bool by_sliding = config_.transfer.automatic.energy == EnergyFrame::sliding;
  evidence_.base_energy.push_back(by_sliding ? sliding.base : energy.base);
  evidence_.yielded.push_back(yielded_share(frame.strain));
}

std::optional<std::size_t> ZoneRecorder::onset() const {
  const auto found = find_onset(config_.transfer.automatic, history_, evidence_);
  return found ? std::optional(found->begin) : std::nullopt;
}

std::vector<double> ZoneRecorder::base_motion() const {
  std::vector<double> sum(base_kinetic_.size());
  for (std::size_t i = 1; i < sum.size(); ++i)
    sum[i] = sum[i - 1] + 0.5 * (base_kinetic_[i] + base_kinetic_[i - 1]) *
                              (history_.time[i] - history_.time[i - 1]);
  return sum;
}

std::size_t ZoneRecorder::strong_shaking_end() const {
  const std::vector<double> sum = base_motion();
  std::size_t i = 0;
  while (i + 1 < sum.size() && sum[i] < 0.95 * sum.back()) ++i;
  return i;
}

double ZoneRecorder::motion_left() const {
  const std::vector<double> sum = base_motion();
  if (sum.empty() || !(sum.back() > 0.0)) return 0.0;
  const std::vector<double>& t = history_.time;
  std::size_t begin = 0;
  while (sum[begin + 1] < 0.05 * sum.back()) ++begin;
  const std::size_t end = strong_shaking_end();
  if (end + 1 >= sum.size()) return 1.0;
  const double before = (sum[end] - sum[begin]) / (t[end] - t[begin]);
  return (sum.back() - sum[end]) / (t.back() - t[end]) / before;
}

TransferChoice ZoneRecorder::choose() const {
  return choose_transfer(config_.transfer, history_, evidence_);
}

bool ZoneRecorder::is_settled() const {
  return flowslide::is_settled(config_.transfer, history_, evidence_);
}

}  // namespace flowslide

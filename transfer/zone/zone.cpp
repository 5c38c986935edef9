#include "transfer/zone/zone.hpp"

#include "core/check.hpp"
#include "core/median.hpp"
#include "transfer/zone/zone_extent.hpp"
#include "transfer/zone/zone_r_u.hpp"
#include "transfer/zone/zone_record.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace flowslide {
namespace {

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

void flag_elements(LiquefactionZone& zone, const QuadMesh& mesh, const ZoneParts& parts,
                   const std::vector<HistoryMaterial>& materials, const ZoneShape& shape,
                   const ZoneConfig& config) {
  std::map<std::int32_t, StrengthConfig> strengths;
  for (const HistoryMaterial& m : materials)
    strengths[m.tag] = strength_of(config.strength, m.name);
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
    if (config.zone == ZoneExtent::liquefied && !(zone.r_u_element[e] > config.r_u.threshold))
      continue;
    const LayerStrength s = strength_at(strengths.at(mesh.element_material[e]), zone.sigma_v0[e]);
    zone.liquefied[e] = 1;
    zone.strength[e] = s.strength;
    zone.layer[e] = s.layer;
    ++liquefied;
    if (s.clamped) ++clamped;
  }
  if (liquefied == 0) zone.notes.emplace_back("no element has liquefied at the transfer time");
  if (clamped > 0) {
    const StrengthTable& table = config.strength.table;
    const std::string ends =
        config.strength.materials.empty()
            ? fmt::format(" ({:g} to {:g} kPa)", table.front()[0] * 1e-3, table.back()[0] * 1e-3)
            : ", that of their material";
    zone.notes.push_back(fmt::format(
        "{}{} of {} liquefied elements lie outside strength.table{}: its end values decide their "
        "strength",
        2 * clamped > liquefied ? "most of the zone: " : "", clamped, liquefied, ends));
  }
}

/// Sand that has not liquefied has less than its effective stress, and what has liquefied much
/// less.
void note_strong(LiquefactionZone& zone, const QuadMesh& mesh) {
  std::size_t liquefied = 0, strong = 0, worst = 0;
  double largest = 1.0;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (zone.liquefied[e] == 0) continue;
    ++liquefied;
    const double ratio = zone.strength[e] / std::max(zone.sigma_v0[e], 0.0);
    if (!(ratio > 1.0)) continue;
    ++strong;
    if (ratio > largest) std::tie(largest, worst) = std::pair(ratio, e);
  }
  if (strong > 0)
    zone.notes.push_back(fmt::format(
        "{} of {} liquefied elements have a residual strength above their initial vertical "
        "effective stress (element {}: {:.3g} kPa at {:.3g} kPa)",
        strong, liquefied, mesh.element_tags[worst], 1e-3 * zone.strength[worst],
        1e-3 * zone.sigma_v0[worst]));
}

/// Depth below the pond surface of the lowest node of the soil that lies in a zone given by the
/// user.
double depth_of_shape(const QuadMesh& mesh, const ZoneParts& parts, const ZoneShape& shape,
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

/// The largest values of each row up to an instant.
std::vector<double> largest(const std::vector<std::vector<double>>& table, std::size_t last) {
  std::vector<double> result;
  for (const std::vector<double>& row : table)
    result.push_back(
        *std::max_element(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(last + 1)));
  return result;
}

/// Depths in the windows up to the transfer by every rule, or those of a zone given by the user;
/// onset and end of strong shaking, which any shaking has.
void add_depths(LiquefactionZone& zone, const ZoneRecorder& record, const ZoneParts& parts,
                const ZoneShape& shape, const ZoneConfig& config) {
  const ZoneHistory& h = zone.history;
  zone.window_names = h.window_names;
  zone.onset_time = kUnset;
  std::size_t transfer = 0, strong = 0, slide = 0;
  if (zone.transfer_frame >= 0) {
    transfer = static_cast<std::size_t>(zone.transfer_frame);
    strong = std::min(record.strong_shaking_end(), transfer);
    slide = std::min(record.onset().value_or(transfer), transfer);
    if (slide < transfer) zone.onset_time = h.time[slide];
    zone.strong_shaking_end = h.time[strong];
  }
  if (!found_from_r_u(config.zone)) {
    for (const auto& [name, window] : windows_or_all(config))
      zone.window_depth_max.push_back(depth_of_shape(record.mesh(), parts, shape, window, config));
    zone.window_depth_any = zone.window_depth_interpolated = zone.window_depth_strong =
        zone.window_depth_before_slide = zone.window_depth_max;
    return;
  }
  zone.window_depth_max = largest(h.depth, transfer);
  zone.window_depth_any = largest(h.depth_any, transfer);
  zone.window_depth_interpolated = largest(h.depth_interpolated, transfer);
  zone.window_depth_strong = largest(h.depth, strong);
  zone.window_depth_before_slide = largest(h.depth, slide);
}

/// Pore water carries no more than all of the weight above it, and little more in motion.
void note_large_r_u(LiquefactionZone& zone, const QuadMesh& mesh) {
  constexpr double kPossible = 1.2;
  std::size_t n = 0;
  double largest = kPossible;
  for (std::size_t i = 0; i < zone.r_u_node.size(); ++i) {
    if (!(zone.r_u_node[i] > largest)) continue;  // NaN where there is none
    largest = zone.r_u_node[i];
    n = i;
  }
  if (!(largest > kPossible)) return;
  zone.notes.push_back(fmt::format(
      "r_u reaches {:.2g} at node {} ({:.6g}, {:.6g}) m by the transfer: more than the soil above "
      "weighs, noise of the pore pressure there or too small an initial stress. What is noise counts "
      "as liquefied all the same and can make the zone too large: compare `zone: liquefied` and "
      "`columns.neighbours`, and look at r_u in the report",
      largest, mesh.node_tags[n], mesh.nodes[n][0], mesh.nodes[n][1]));
}

/// Soil without water at rest has nothing that could liquefy it.
void note_dry(LiquefactionZone& zone, const QuadMesh& mesh, const RuReference& reference,
              ZoneExtent extent) {
  if (!found_from_r_u(extent)) return;
  double all = 0.0, dry = 0.0;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    if (zone.liquefied[e] == 0) continue;
    const double a = area(corners(mesh, mesh.nodes, e));
    all += a;
    const auto& nodes = mesh.elements[e];
    if (std::all_of(nodes.begin(), nodes.end(), [&](std::int32_t n) {
          return !(reference.u_0[static_cast<std::size_t>(n)] > 0.0);
        }))
      dry += a;
  }
  constexpr double kSome = 0.05;
  if (dry > kSome * all)
    zone.notes.push_back(fmt::format(
        "dry soil: {:.0f} of the {:.0f} m2 of the zone had no pore pressure at rest, cannot liquefy, "
        "and flows with a residual strength all the same, as everything above what has liquefied "
        "does. `zone: liquefied` takes the elements alone whose r_u exceeds the threshold",
        dry, all));
}

/// Averages over less than the time between two recorded states are none.
void note_short_averages(LiquefactionZone& zone, const AutomaticTransfer& rule) {
  const std::vector<double>& t = zone.history.time;
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  const double interval = median(std::move(steps));
  const auto note = [&](std::string_view key, double length, std::string_view what) {
    zone.notes.push_back(
        fmt::format("automatic.{}: {:g} s is not above the {:g} s between recorded states: {}", key,
                    length, interval, what));
  };
  constexpr double kRounded = 1.0 + 1e-6;  // recorded times are
  if (rule.smoothing > 0.0 && rule.smoothing <= interval * kRounded)
    note("smoothing", rule.smoothing, "a mean over it holds one state, and averages nothing");
  if (rule.sustain > 0.0 && rule.sustain * kRounded < interval)
    note("sustain", rule.sustain, "the energy need not stay above its envelope for a second state");
}

/// A record that ends while the ground still moves does not say when strong shaking ends.
void note_truncated(LiquefactionZone& zone, const ZoneRecorder& record) {
  constexpr double kMoving = 0.25;
  if (zone.transfer_frame < 0 || !(record.motion_left() > kMoving)) return;
  zone.notes.push_back(fmt::format(
      "the record ends at {:.4g} s while its base still moves ({:.2g} times the mean squared "
      "velocity of before): {:.4g} s is the end of its strong shaking, and not that of the motion",
      zone.history.time.back(), record.motion_left(),
      zone.history.time[record.strong_shaking_end()]));
}

}  // namespace

LiquefactionZone find_zone(const FemHistory& history, const ZoneConfig& config,
                           const Progress& progress) {
  check(config);
  const QuadMesh& mesh = history.mesh();
  ZoneRecorder record(mesh, history.materials(), history.gravity(), config);
  const std::size_t frames = history.times().size();
  for (std::size_t i = 0; i < frames; ++i) {
    if (progress.should_stop()) throw Interrupted("stopped while the frames were read");
    record.append(history.frame(i));
    progress.report(static_cast<double>(i + 1) / static_cast<double>(frames),
                    fmt::format("{:.3g} s", history.times()[i]));
  }
  const ZoneParts& parts = record.parts();
  const RuReference& reference = record.reference();
  const TransferChoice choice = record.choose();
  LiquefactionZone zone;
  zone.history = record.history();
  zone.transfer_time = choice.time;
  zone.transfer_frame = choice.frame;
  zone.transfer_reason = choice.reason;
  zone.r_u_node = r_u_of_zone(history, reference, choice.frame, config.r_u.over_time);
  zone.r_u_element = element_means(mesh, zone.r_u_node);
  zone.sigma_v0 = reference.sigma_v0;
  zone.notes = reference.notes;
  note_large_r_u(zone, mesh);
  note_short_averages(zone, config.transfer.automatic);
  note_truncated(zone, record);
  const ZoneShape shape = zone_shape(config, mesh, parts.soil, zone.r_u_node);
  flag_elements(zone, mesh, parts, history.materials(), shape, config);
  note_strong(zone, mesh);
  note_dry(zone, mesh, reference, config.zone);
  add_depths(zone, record, parts, shape, config);
  return zone;
}

}  // namespace flowslide

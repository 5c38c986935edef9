#include "report/facts.hpp"

#include "model/outline.hpp"
#include "report/runout.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace flowslide {
namespace {

Movement movement(const std::string& name, const ParticleSet& p, const FinalState& end,
                  const std::vector<std::size_t>& points, double moved) {
  Movement m;
  m.name = name;
  m.points = points.size();
  double mass = 0.0;
  double failed = 0.0;
  for (const std::size_t i : points) {
    mass += p.mass[i];
    m.volume += p.volume[i];
    if (end.displacement[i] > moved) failed += p.mass[i];
    m.mean_displacement += p.mass[i] * end.displacement[i];
    m.max_displacement = std::max(m.max_displacement, end.displacement[i]);
  }
  if (mass > 0.0) {
    m.failed_share = failed / mass;
    m.mean_displacement /= mass;
  }
  return m;
}

/// Level below which at most `share` of the mass lies; unset without any. Reorders `points`.
double level_below(std::vector<Place>& points, double share) {
  for (Place& p : points) p.at = -p.at;
  double level = kUnset;
  places_beyond(points, {&share, 1}, {&level, 1});
  return -level;
}

void add_fronts(ReportFacts& f, const ParticleSet& p, const FinalState& end,
                const ReportConfig& config) {
  f.front = front_position(end.position, end.counts);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (end.counts[i] && !(f.front_farthest >= end.position[i][0]))
      f.front_farthest = end.position[i][0];
  if (std::find(end.failed.begin(), end.failed.end(), 1) != end.failed.end())
    f.front_mass = front_quantile(end.position, end.failed, p.mass, config.mass_quantile);
  if (!is_set(f.toe)) return;
  f.runout = runout(end.position, end.counts, f.toe);
  if (is_set(f.front_mass)) f.runout_mass = std::max(0.0, f.front_mass - f.toe);
}

void add_volumes(ReportFacts& f, const ParticleSet& p, const MpmFrame& last, const FinalState& end,
                 const ReportConfig& config) {
  double counted = 0.0;
  std::vector<Place> failed_levels;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!end.counts[i]) continue;
    counted += p.volume[i];
    if (is_set(f.toe) && end.position[i][0] > f.toe) f.volume_past_toe += last.volume[i];
    if (!end.failed[i]) continue;
    f.failed_volume += p.volume[i];
    const double y = end.undeformed[i][1];
    failed_levels.push_back({y, p.mass[i]});
    if (!(f.deepest_failed <= y)) f.deepest_failed = y;
  }
  if (counted > 0.0) f.failed_percent = 100.0 * f.failed_volume / counted;
  f.deepest_failed_mass = level_below(failed_levels, config.mass_quantile);
}

void add_movements(ReportFacts& f, const ParticleSet& p, const FinalState& end,
                   const ReportConfig& config) {
  for (std::size_t k = 0; k < p.materials.size(); ++k) {
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.material[i] == static_cast<std::int32_t>(k)) points.push_back(i);
    f.materials.push_back(movement(p.materials[k].name, p, end, points, config.moved));
  }
  for (const auto& [name, region] : config.regions) {
    validate(region.outline.size() >= 3,
             "region '{}' has {} corners (a region needs three or more) give its outline", name,
             region.outline.size());
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (inside_outline(region.outline, {end.undeformed[i][0], end.undeformed[i][1]}))
        points.push_back(i);
    f.regions.push_back(movement(name, p, end, points, config.moved));
  }
}

/// By the rule that ends a run (docs/theory/mpm.md, Rest): at rest is a front that stayed within
/// `runout_change` for the last `window`, and it is since as long before as it did.
void add_front_rest(ReportFacts& f, const std::vector<MpmSample>& samples, const RestRule& rule) {
  double low = samples.back().front, high = low;
  const auto widen = [&](const MpmSample& s) {
    low = std::min(low, s.front);
    high = std::max(high, s.front);
    return high - low;
  };
  auto s = samples.rbegin();
  for (; s != samples.rend() && s->time >= samples.back().time - rule.window; ++s)
    f.front_change = widen(*s);
  if (f.duration < rule.window || !(f.front_change <= rule.runout_change)) return;
  for (; s != samples.rend() && widen(*s) <= rule.runout_change; ++s) {
  }
  f.front_at_rest = std::prev(s)->time;
}

void add_rest(ReportFacts& f, const std::vector<MpmSample>& samples, const RestRule& rule) {
  f.rest = rule;
  f.duration = samples.back().time - samples.front().time;
  f.last_speed = samples.back().max_speed;
  double peak = 0.0;
  for (const MpmSample& s : samples) {
    peak = std::max(peak, s.kinetic);
    f.peak_speed = std::max(f.peak_speed, s.max_speed);
    f.mass_error = std::max(f.mass_error, std::abs(s.mass_error));
  }
  for (const double v : front_speed(samples)) f.peak_front_speed = std::max(f.peak_front_speed, v);
  for (auto s = samples.rbegin(); s != samples.rend(); ++s) {
    if (!(s->kinetic <= rule.kinetic_share * peak)) break;
    f.time_at_rest = s->time;
  }
  add_front_rest(f, samples, rule);
  f.points_left = samples.back().points_left;
  f.mass_left = samples.back().mass_left;
  f.energy_error = samples.back().energy_error;
  f.momentum_error = samples.back().momentum_error;
}

}  // namespace

std::vector<double> front_speed(const std::vector<MpmSample>& samples) {
  std::vector<double> speed(samples.size(), 0.0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double dt = samples[i].time - samples[i - 1].time;
    if (dt > 0.0) speed[i] = (samples[i].front - samples[i - 1].front) / dt;
  }
  return speed;
}

FinalState final_state(const ParticleSet& particles, const MpmHistory& flow,
                       const ReportConfig& config) {
  const ParticleSet& p = flow.initial();
  validate(flow.num_frames() > 0 && !flow.samples().empty(),
           "the runout history has {} frames and {} samples (there is nothing to report) run the "
           "flow stage to its end",
           flow.num_frames(), flow.samples().size());
  validate(
      p.dim == 2,
      "the runout has {} dimensions (the report draws sections) take the stage report.runout out "
      "of the workflow, and `flowslide convert` mpm.h5 for ParaView, docs/guide/valley.md",
      p.dim);
  std::vector<std::int64_t> ids = particles.id;
  std::sort(ids.begin(), ids.end());
  validate(ids == p.id,
           "the particles ({} points) are not those the flow started from ({} points) (numbers of "
           "two runs would be mixed) give the report the files of one run",
           ids.size(), p.id.size());
  const MpmFrame first = flow.frame(0);
  const MpmFrame last = flow.frame(flow.num_frames() - 1);
  validate(last.position.size() == p.size() && first.strength.size() == p.size(),
           "the last frame has {} points, the run started with {} (points were lost) look for them "
           "in the log of the flow stage",
           last.position.size(), p.size());
  FinalState end;
  end.time = last.time;
  end.position = last.position;
  end.undeformed.resize(p.size());
  end.displacement.resize(p.size());
  end.strength_ratio.assign(p.size(), kUnset);
  end.counts.resize(p.size());
  end.failed.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    double squared = 0.0;
    for (int d = 0; d < 3; ++d) {
      end.undeformed[i][d] = p.position[i][d] - p.displacement[i][d];
      const double u = end.position[i][d] - end.undeformed[i][d];
      squared += u * u;
    }
    end.displacement[i] = std::sqrt(squared);
    validate(std::isfinite(end.displacement[i]),
             "point {} has no finite position at t = {:.4g} s (the run became unstable) lower the "
             "time step factor of the flow stage",
             p.id[i], last.time);
    if (first.strength[i] > 0.0) end.strength_ratio[i] = last.strength[i] / first.strength[i];
    end.counts[i] = p.materials[p.material[i]].counts_for_runout;
    end.failed[i] = end.counts[i] && end.displacement[i] > config.moved;
  }
  return end;
}

ReportFacts compute_facts(const LiquefactionZone& zone, const MpmHistory& flow,
                          const FinalState& end, const ReportConfig& config) {
  const ParticleSet& p = flow.initial();
  const std::vector<MpmSample>& samples = flow.samples();
  ReportFacts f;
  f.toe = config.toe.value_or(p.toe);
  f.transfer_time = zone.transfer_time;
  validate(zone.window_names.size() == zone.window_depth_max.size(),
           "the zone has {} windows but {} depths (each window has one) rebuild the zone",
           zone.window_names.size(), zone.window_depth_max.size());
  for (std::size_t w = 0; w < zone.window_names.size(); ++w)
    f.liquefaction_depth.emplace_back(zone.window_names[w], zone.window_depth_max[w]);
  add_fronts(f, p, end, config);
  add_volumes(f, p, flow.frame(flow.num_frames() - 1), end, config);
  add_movements(f, p, end, config);
  add_rest(f, samples, flow.rest());
  f.composition = composition(p, end, f.toe);
  f.outcome = outcome_facts(p, end, config);
  warn_without_failure(f, zone, config);
  add_warnings(f, p, end, samples, flow.rest(), config);
  return f;
}

}  // namespace flowslide

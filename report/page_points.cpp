#include "report/page_points.hpp"

#include "core/check.hpp"
#include "core/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flowslide {
namespace {

/// Bits of a number with a zero between any two.
std::uint64_t spread(std::uint32_t x) {
  std::uint64_t v = x;
  v = (v | (v << 16)) & 0x0000ffff0000ffffu;
  v = (v | (v << 8)) & 0x00ff00ff00ff00ffu;
  v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0fu;
  v = (v | (v << 2)) & 0x3333333333333333u;
  return (v | (v << 1)) & 0x5555555555555555u;
}

/// Place on a curve that fills the plane (Morton's), so that neighbours follow each other.
std::vector<std::uint64_t> curve(const std::vector<std::array<double, 3>>& x) {
  double low[2] = {kUnset, kUnset}, high[2] = {kUnset, kUnset};
  for (const auto& p : x)
    for (int d = 0; d < 2; ++d) {
      if (!(low[d] <= p[d])) low[d] = p[d];
      if (!(high[d] >= p[d])) high[d] = p[d];
    }
  const double size = std::max({high[0] - low[0], high[1] - low[1], 1e-30});
  std::vector<std::uint64_t> place;
  for (const auto& p : x) {
    const auto cell = [&](int d) {
      return static_cast<std::uint32_t>(65535.0 * (p[d] - low[d]) / size);
    };
    place.push_back(spread(cell(0)) | (spread(cell(1)) << 1));
  }
  return place;
}

/// Of the final state, so that thinning does not cut the tip off.
std::vector<std::size_t> foremost(const ParticleSet& p, const MpmFrame& last, std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.materials[p.material[i]].counts_for_runout) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(-last.position[a][0], a) < std::pair(-last.position[b][0], b);
  });
  order.resize(std::min(order.size(), count));
  return order;
}

struct Series {
  std::vector<double> t, x, y, speed, strength;
};

void append_frame(Series& s, const MpmFrame& frame, const MpmFrame& first,
                  const std::vector<std::size_t>& points) {
  s.t.push_back(frame.time);
  for (const std::size_t i : points) {
    s.x.push_back(frame.position[i][0]);
    s.y.push_back(frame.position[i][1]);
    s.speed.push_back(std::sqrt(hypot(frame.velocity[i][0], frame.velocity[i][1])));
    s.strength.push_back(first.strength[i] > 0.0 ? frame.strength[i] / first.strength[i] : kUnset);
  }
}

}  // namespace

std::vector<std::size_t> choose_frames(const std::vector<double>& times,
                                       const std::vector<MpmSample>& samples, std::size_t most) {
  std::vector<std::size_t> chosen(times.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  if (times.size() <= most) return chosen;
  double peak = 0.0;
  for (const MpmSample& s : samples) peak = std::max(peak, s.max_speed);
  const double span = times.back() - times.front();
  // How far the run has come at each frame: travel of the fastest point and time, scaled to one.
  std::vector<double> travel(times.size(), 0.0);
  std::size_t k = 0;
  for (std::size_t f = 1; f < times.size(); ++f) {
    travel[f] = travel[f - 1];
    for (; k < samples.size() && samples[k].time <= times[f]; ++k)
      if (k > 0) travel[f] += samples[k].max_speed * (samples[k].time - samples[k - 1].time);
  }
  const auto way = [&](std::size_t f) {
    const double time = (times[f] - times.front()) / span;
    return travel.back() > 0.0 ? 0.25 * time + 0.75 * travel[f] / travel.back() : time;
  };
  std::vector<std::size_t> out;
  for (std::size_t f = 0; f < times.size(); ++f) {
    const double due = static_cast<double>(out.size()) / static_cast<double>(most - 1);
    // As many frames must be left as are still to be chosen.
    const bool last_chance = times.size() - f == most - out.size();
    if (out.size() + 1 < most && (way(f) >= due * (1.0 - 1e-12) || last_chance)) out.push_back(f);
  }
  out.push_back(times.size() - 1);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<std::size_t> choose_points(const std::vector<std::array<double, 3>>& undeformed,
                                       const std::vector<std::size_t>& always, std::size_t most) {
  const std::vector<std::uint64_t> place = curve(undeformed);
  std::vector<std::size_t> order(undeformed.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(place[a], a) < std::pair(place[b], b);
  });
  if (order.size() <= most) return order;
  std::vector<bool> wanted(order.size(), false);
  for (const std::size_t i : always) wanted[i] = true;
  const std::size_t even = most - std::min(always.size(), most);
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (k * even / order.size() != (k + 1) * even / order.size() || wanted[order[k]])
      out.push_back(order[k]);
  return out;
}

ShownPoints add_points(PageArrays& arrays, const MpmHistory& flow,
                       const std::vector<std::array<double, 3>>& undeformed,
                       std::size_t most_points, std::size_t most_frames) {
  const ParticleSet& p = flow.initial();
  const std::vector<std::size_t> frames = choose_frames(flow.times(), flow.samples(), most_frames);
  constexpr std::size_t kTip = 20;
  const std::vector<std::size_t> points =
      choose_points(undeformed, foremost(p, flow.motion(flow.num_frames() - 1), kTip), most_points);
  Series s;
  const MpmFrame first = flow.motion(0);
  for (const std::size_t f : frames) append_frame(s, flow.motion(f), first, points);
  std::vector<double> x0, y0, material;
  double area = 0.0;
  for (const std::size_t i : points) {
    x0.push_back(undeformed[i][0]);
    y0.push_back(undeformed[i][1]);
    material.push_back(p.material[i]);
  }
  for (const double v : p.volume) area += v;
  const double spacing = std::sqrt(area / static_cast<double>(points.size()));
  const double fine = std::sqrt(area / static_cast<double>(p.size())) / 64.0;
  arrays.add("points.t", s.t);
  arrays.add("points.x", s.x, frames.size(), Bits::sixteen, fine);
  arrays.add("points.y", s.y, frames.size(), Bits::sixteen, fine);
  arrays.add("points.x0", x0, 1, Bits::sixteen, fine);
  arrays.add("points.y0", y0, 1, Bits::sixteen, fine);
  arrays.add("points.material", material, 1, Bits::eight, 1.0);
  arrays.add("points.speed", s.speed, frames.size(), Bits::eight);
  arrays.add("points.strength", s.strength, frames.size(), Bits::eight);
  return {points.size(), frames.size(), spacing};
}

}  // namespace flowslide

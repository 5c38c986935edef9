#include "study/page/soil_rings.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace flowslide::study {
namespace {

constexpr double kStraight = 0.01;  ///< [m] a page shows less of it than a pixel

using Edge = std::pair<std::size_t, std::size_t>;  ///< the smaller node first

/// Edges that one element alone has of those of a soil.
std::set<Edge> boundary(const std::vector<std::array<std::size_t, 4>>& elements) {
  std::set<Edge> edges;
  for (const auto& e : elements)
    for (std::size_t k = 0; k < 4; ++k) {
      const Edge edge = std::minmax(e[k], e[(k + 1) % 4]);
      if (edge.first != edge.second && !edges.insert(edge).second) edges.erase(edge);
    }
  return edges;
}

std::vector<std::vector<std::size_t>> chains(const std::set<Edge>& edges) {
  std::map<std::size_t, std::set<std::size_t>> next;
  for (const auto& [a, b] : edges) {
    next[a].insert(b);
    next[b].insert(a);
  }
  std::vector<std::vector<std::size_t>> found;
  const auto cut = [&](std::size_t a, std::size_t b) {
    next[a].erase(b);
    next[b].erase(a);
  };
  for (auto& [start, around] : next)
    while (!around.empty()) {
      std::vector<std::size_t>& chain = found.emplace_back(1, start);
      while (!next[chain.back()].empty()) {
        const std::size_t here = chain.back(), to = *next[here].begin();
        cut(here, to);
        if (to == start) break;
        chain.push_back(to);
      }
    }
  return found;
}

double off_line(const std::array<double, 2>& a, const std::array<double, 2>& p,
                const std::array<double, 2>& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::sqrt(dx * dx + dy * dy);
  if (!(length > 0.0)) return kUnset;
  return std::abs(dx * (p[1] - a[1]) - dy * (p[0] - a[0])) / length;
}

}  // namespace

Ring without_straight(const Ring& ring) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto& before = kept.empty() ? ring.back() : kept.back();
    if (!(off_line(before, ring[i], ring[(i + 1) % ring.size()]) < kStraight))
      kept.push_back(ring[i]);
  }
  return kept;
}

std::vector<SoilArea> soil_areas(const PageRun& run) {
  const std::vector<double>&x = run.array("mesh.x"), &y = run.array("mesh.y"),
        &corners = run.array("mesh.corners"), &material = run.array("mesh.material");
  if (material.empty()) return {};
  if (corners.size() != 4 * material.size() || x.size() != y.size())
    throw InputError("a page of a run has elements without corners. Make the report again.");
  std::map<int, std::vector<std::array<std::size_t, 4>>> by_tag;
  for (std::size_t e = 0; e < material.size(); ++e) {
    if (!(std::abs(material[e]) < 1e9))
      throw InputError("a page of a run has elements without soil. Make the report again.");
    auto& element = by_tag[static_cast<int>(std::lround(material[e]))].emplace_back();
    for (std::size_t c = 0; c < 4; ++c) {
      const double node = std::round(corners[c * material.size() + e]);
      if (!(node >= 0.0 && node < static_cast<double>(x.size())))
        throw InputError("a page of a run has elements without nodes. Make the report again.");
      element[c] = static_cast<std::size_t>(node);
    }
  }
  std::vector<SoilArea> areas;
  for (const auto& [tag, elements] : by_tag) {
    const auto named = std::find_if(run.soils.begin(), run.soils.end(),
                                    [tag = tag](const auto& s) { return s.first == tag; });
    SoilArea& area = areas.emplace_back();
    area.name = named == run.soils.end() ? fmt::format("soil {}", tag) : named->second;
    for (const std::vector<std::size_t>& chain : chains(boundary(elements))) {
      Ring ring;
      for (const std::size_t n : chain) ring.push_back({x[n], y[n]});
      ring = without_straight(ring);
      if (ring.size() > 2) area.rings.push_back(std::move(ring));
    }
  }
  return areas;
}

}  // namespace flowslide::study

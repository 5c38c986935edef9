#include "transfer/seeding/seed.hpp"

#include "core/check.hpp"
#include "core/memory.hpp"
#include "model/shape_quad.hpp"
#include "transfer/seeding/gauss_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

namespace flowslide {
namespace {

constexpr double kMaxCells = 5e7;
constexpr double kMostRows = 1e9;  ///< of the lattice, counted from its origin

/// The part of one element in one lattice cell.
struct Fragment {
  std::int64_t row = 0, column = 0;
  std::int32_t group = 0;
  std::int32_t element = 0;
  AreaMoment part;
  std::array<double, 4> shape{};
  double mass = 0.0;
};

/// A lattice cell's share of one group: fragments first to last.
struct Cell {
  std::int64_t row = 0, column = 0;
  std::int32_t group = 0;
  std::size_t first = 0, last = 0;
  double area = 0.0;
  std::size_t host = 0;  ///< the cell whose point takes the fragments; itself unless a sliver
};

std::array<double, 4> shape_at(const std::array<Vec2, 4>& quad, Vec2 point) {
  if (const auto n = natural_coordinates(quad, point, 1e-6)) return shape((*n)[0], (*n)[1]);
  // A re-entrant quadrilateral has no unique inverse: linear in the nearer of its two triangles.
  int reentrant = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec2 &a = quad[(i + 3) % 4], &b = quad[i], &c = quad[(i + 1) % 4];
    if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0.0) reentrant = i;
  }
  std::array<double, 4> best{};
  double best_low = -std::numeric_limits<double>::infinity();
  for (int half = 0; half < 2; ++half) {
    const int i = reentrant, j = (reentrant + 1 + half) % 4, k = (reentrant + 2 + half) % 4;
    const double x1 = quad[j][0] - quad[i][0], y1 = quad[j][1] - quad[i][1];
    const double x2 = quad[k][0] - quad[i][0], y2 = quad[k][1] - quad[i][1];
    const double px = point[0] - quad[i][0], py = point[1] - quad[i][1];
    const double det = x1 * y2 - x2 * y1;
    const double s = (px * y2 - x2 * py) / det, t = (x1 * py - px * y1) / det;
    const double low = std::min({s, t, 1.0 - s - t});
    if (low > best_low) {
      best_low = low;
      best = {};
      best[i] = 1.0 - s - t;
      best[j] = s;
      best[k] = t;
    }
  }
  return best;
}

ConvexParts upright_parts(const SeedDomain& domain, std::size_t e) {
  ConvexParts parts = convex_parts(corners(domain.mesh, domain.positions, e));
  validate(parts.count > 0,
           "element {} is folded in the deformed mesh at transfer (its area is not positive or its "
           "edges cross, so points cannot be placed in it). Choose an earlier transfer time",
           domain.mesh.element_tags[e]);
  return parts;
}

std::int64_t cell_index(double x, double origin, double spacing) {
  return static_cast<std::int64_t>(std::floor((x - origin) / spacing));
}

void append_fragments(const SeedDomain& domain, const LatticeOptions& o, std::size_t e,
                      const Progress& progress, std::vector<Fragment>& out, int& split) {
  const std::array<Vec2, 4> quad = corners(domain.mesh, domain.positions, e);
  const double reference = area(corners(domain.mesh, domain.mesh.nodes, e));
  const ConvexParts parts = upright_parts(domain, e);
  if (parts.count > 1) ++split;
  double total = 0.0;
  for (int k = 0; k < parts.count; ++k) total += area_moment(parts.part[k]).area;
  const double density = domain.density[e] * reference / total;
  for (int k = 0; k < parts.count; ++k) {
    const Polygon whole = clip(parts.part[k], domain.box);
    if (whole.size == 0) continue;
    const Box b = bounds(whole);
    const std::int64_t row_end = cell_index(b.ymax, o.origin[1], o.spacing);
    for (std::int64_t row = cell_index(b.ymin, o.origin[1], o.spacing); row <= row_end; ++row) {
      progress.poll();
      const double y = o.origin[1] + static_cast<double>(row) * o.spacing;
      const double y_next = o.origin[1] + static_cast<double>(row + 1) * o.spacing;
      const Polygon strip = clip(clip(whole, 1, y, Side::above), 1, y_next, Side::below);
      if (strip.size == 0) continue;
      const Box s = bounds(strip);
      const std::int64_t column_end = cell_index(s.xmax, o.origin[0], o.spacing);
      for (std::int64_t column = cell_index(s.xmin, o.origin[0], o.spacing); column <= column_end;
           ++column) {
        const double x = o.origin[0] + static_cast<double>(column) * o.spacing;
        const double x_next = o.origin[0] + static_cast<double>(column + 1) * o.spacing;
        const AreaMoment part =
            area_moment(clip(clip(strip, 0, x, Side::above), 0, x_next, Side::below));
        if (!(part.area > 0.0)) continue;
        out.push_back({row, column, domain.group[e], static_cast<std::int32_t>(e), part,
                       shape_at(quad, part.centroid), density * part.area});
      }
    }
  }
}

std::vector<Cell> gather_cells(std::vector<Fragment>& fragments, const Progress& progress) {
  const auto key = [](const auto& f) { return std::tuple(f.row, f.column, f.group); };
  std::sort(fragments.begin(), fragments.end(), [&](const Fragment& a, const Fragment& b) {
    progress.poll();
    return std::tuple(key(a), -a.part.area, a.element, a.part.centroid) <
           std::tuple(key(b), -b.part.area, b.element, b.part.centroid);
  });
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const Fragment& f = fragments[i];
    if (cells.empty() || key(cells.back()) != key(f))
      cells.push_back({f.row, f.column, f.group, i, i, 0.0, cells.size()});
    cells.back().last = i + 1;
    cells.back().area += f.part.area;
  }
  return cells;
}

/// The largest neighbour of the same group that is no sliver itself; edge neighbours come first.
std::size_t find_host(const std::vector<Cell>& cells, std::size_t index, double limit) {
  const Cell& c = cells[index];
  for (const bool edge : {true, false}) {
    std::size_t best = index;
    double best_area = limit;
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        if ((std::abs(dr) + std::abs(dc) == 1) != edge || (dr == 0 && dc == 0)) continue;
        const auto wanted = std::tuple(c.row + dr, c.column + dc, c.group);
        const auto it = std::lower_bound(
            cells.begin(), cells.end(), wanted,
            [](const Cell& a, const auto& k) { return std::tuple(a.row, a.column, a.group) < k; });
        if (it == cells.end() || std::tuple(it->row, it->column, it->group) != wanted) continue;
        if (it->area > best_area) {
          best_area = it->area;
          best = static_cast<std::size_t>(it - cells.begin());
        }
      }
    }
    if (best != index) return best;
  }
  return index;
}

bool inside_any(const SeedDomain& domain, const std::vector<const Fragment*>& fragments, Vec2 p) {
  return std::any_of(fragments.begin(), fragments.end(), [&](const Fragment* f) {
    return natural_coordinates(
               corners(domain.mesh, domain.positions, static_cast<std::size_t>(f->element)), p,
               1e-9)
        .has_value();
  });
}

void append_seed(const SeedDomain& domain, std::vector<const Fragment*>& fragments, SeedSet& set) {
  std::sort(fragments.begin(), fragments.end(), [](const Fragment* a, const Fragment* b) {
    return a->part.area > b->part.area || (a->part.area == b->part.area && a < b);
  });
  Seed seed;
  seed.group = fragments.front()->group;
  seed.first_piece = static_cast<std::int32_t>(set.pieces.size());
  seed.num_pieces = static_cast<std::int32_t>(fragments.size());
  const Vec2 origin = fragments.front()->part.centroid;
  Vec2 moment{};
  for (const Fragment* f : fragments) {
    seed.volume += f->part.area;
    seed.mass += f->mass;
    for (int i = 0; i < 2; ++i) moment[i] += f->part.area * (f->part.centroid[i] - origin[i]);
    set.pieces.push_back({f->element, f->shape, f->part.area, f->mass});
  }
  for (int i = 0; i < 2; ++i) seed.position[i] = origin[i] + moment[i] / seed.volume;
  if (fragments.size() > 1 && !inside_any(domain, fragments, seed.position)) {
    seed.position = origin;
    ++set.moved_inside;
  }
  set.seeds.push_back(seed);
}

/// Refuses a lattice that does not fit in memory or whose rows cannot be numbered.
void check_lattice(const SeedDomain& domain, const LatticeOptions& options) {
  double cells_expected = 0.0;
  for (std::size_t e = 0; e < domain.mesh.num_elements(); ++e)
    if (domain.group[e] >= 0)
      cells_expected += share_inside(domain, e) * area(corners(domain.mesh, domain.positions, e)) /
                        (options.spacing * options.spacing);
  validate(cells_expected < kMaxCells,
           "a lattice of {:.3g} m would place {:.2g} points (more than {:.0g} do not fit in "
           "memory). Use a "
           "larger cell or fewer points per cell",
           options.spacing, cells_expected, kMaxCells);
  need_memory(cells_expected * kBytesPerSeededPoint,
              fmt::format("a lattice of {:.3g} m, {:.2g} points,", options.spacing, cells_expected),
              "use a larger cell or fewer points per cell");
  for (const Vec2& p : domain.positions)
    for (int i = 0; i < 2; ++i)
      validate(std::abs(p[i] - options.origin[i]) < kMostRows * options.spacing,
               "grid_origin ({:g}, {:g}) lies {:.3g} m from the soil (a lattice of {:.3g} m cannot "
               "be counted so far) move it near the section",
               options.origin[0], options.origin[1], std::abs(p[i] - options.origin[i]),
               options.spacing);
}

}  // namespace

SeedSet seed_lattice(const SeedDomain& domain, const LatticeOptions& options,
                     const Progress& progress) {
  check_lattice(domain, options);
  SeedSet set;
  std::vector<Fragment> fragments;
  for (std::size_t e = 0; e < domain.mesh.num_elements(); ++e)
    if (domain.group[e] >= 0)
      append_fragments(domain, options, e, progress, fragments, set.split_elements);

  std::vector<Cell> cells = gather_cells(fragments, progress);
  const double limit = options.sliver_fraction * options.spacing * options.spacing;
  std::vector<std::vector<std::size_t>> guests(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    progress.poll();
    if (cells[i].area > limit) continue;
    cells[i].host = find_host(cells, i, limit);
    if (cells[i].host == i) {
      ++set.slivers_kept;
    } else {
      ++set.slivers_merged;
      guests[cells[i].host].push_back(i);
    }
  }
  std::vector<const Fragment*> members;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    progress.poll();
    if (cells[i].host != i) continue;
    members.clear();
    for (std::size_t k = cells[i].first; k < cells[i].last; ++k) members.push_back(&fragments[k]);
    for (const std::size_t g : guests[i])
      for (std::size_t k = cells[g].first; k < cells[g].last; ++k) members.push_back(&fragments[k]);
    append_seed(domain, members, set);
  }
  return set;
}

SeedSet seed_gauss(const SeedDomain& domain, int order) {
  SeedSet set;
  const GaussRule rule = gauss_rule(order);
  for (std::size_t e = 0; e < domain.mesh.num_elements(); ++e) {
    const std::array<Vec2, 4> quad = corners(domain.mesh, domain.positions, e);
    if (domain.group[e] < 0 || !domain.box.contains(centroid(quad))) continue;
    upright_parts(domain, e);
    const std::array<Vec2, 4> reference = corners(domain.mesh, domain.mesh.nodes, e);
    for (int j = 0; j < order; ++j) {
      for (int i = 0; i < order; ++i) {
        const double xi = rule.point[i], eta = rule.point[j], w = rule.weight[i] * rule.weight[j];
        SeedPiece piece{static_cast<std::int32_t>(e), shape(xi, eta), w * jacobian(quad, xi, eta),
                        w * domain.density[e] * jacobian(reference, xi, eta)};
        validate(
            piece.volume > 0.0,
            "element {} is folded at a Gauss point in the deformed mesh (the volume of its point "
            "would be {:.3g} m3). Choose an earlier transfer time or seeding: lattice",
            domain.mesh.element_tags[e], piece.volume);
        set.seeds.push_back({interpolate(quad, xi, eta), piece.volume, piece.mass, domain.group[e],
                             static_cast<std::int32_t>(set.pieces.size()), 1});
        set.pieces.push_back(piece);
      }
    }
  }
  return set;
}

double share_inside(const SeedDomain& domain, std::size_t element) {
  const ConvexParts parts = upright_parts(domain, element);
  double whole = 0.0, inside = 0.0;
  for (int k = 0; k < parts.count; ++k) {
    whole += area_moment(parts.part[k]).area;
    inside += area_moment(clip(parts.part[k], domain.box)).area;
  }
  return inside / whole;
}

}  // namespace flowslide

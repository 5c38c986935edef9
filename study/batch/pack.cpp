#include "study/batch/pack.hpp"

#include "core/check.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace flowslide::study {
namespace {

/// Open stages that the same rows need: a shaking with its motion and its zone, or what is a single
/// row's own. What feeds them is needed by more rows, so that bundles never wait for each other in
/// a circle.
struct Bundle {
  std::vector<std::size_t> nodes;
  std::size_t rows = 0, first_row = 0;
  std::vector<std::size_t> before;  ///< bundles that feed it, directly or not
  double seconds = 0.0;             ///< on all cpus of a task
};

/// Bundles that one task computes.
struct Piece {
  std::vector<std::size_t> bundles;
  std::size_t level = 0;
};

class Packer {
 public:
  Packer(const Plan& plan, const std::vector<bool>& open, const std::vector<double>& seconds,
         const Packing& packing)
      : plan_(plan), open_(open), seconds_(seconds), packing_(packing) {
    make_bundles();
    cut();
    postpone();
  }

  [[nodiscard]] std::vector<JobArray> arrays() const {
    std::size_t levels = 0;
    for (const Piece& piece : pieces_) levels = std::max(levels, piece.level + 1);
    std::vector<JobArray> result;
    for (std::size_t level = 0; level < levels; ++level)
      result.push_back({name_of(level, levels), tasks_of(level)});
    return result;
  }

 private:
  [[nodiscard]] double seconds_of(std::size_t node) const {
    constexpr double kUsual = 60.0;
    return is_set(seconds_[node]) ? seconds_[node] : kUsual;
  }

  void make_bundles() {
    std::vector<std::vector<std::size_t>> rows(plan_.nodes.size());
    for (std::size_t r = 0; r < plan_.rows.size(); ++r)
      for (const std::size_t node : plan_.rows[r].nodes) rows[node].push_back(r);
    std::map<std::vector<std::size_t>, std::vector<std::size_t>> by_rows;
    for (std::size_t n = 0; n < plan_.nodes.size(); ++n)
      if (open_[n]) by_rows[rows[n]].push_back(n);
    for (auto& [needed_by, nodes] : by_rows) {
      Bundle bundle{.nodes = nodes, .rows = needed_by.size(), .before = {}};
      bundle.first_row = needed_by.empty() ? 0 : needed_by.front();
      for (const std::size_t n : nodes)
        bundle.seconds += seconds_of(n) / static_cast<double>(packing_.cpus);
      bundles_.push_back(std::move(bundle));
    }
    // What many rows need comes first; of the rest, what the first rows need.
    std::sort(bundles_.begin(), bundles_.end(), [](const Bundle& a, const Bundle& b) {
      return a.rows != b.rows ? a.rows > b.rows : a.nodes.front() < b.nodes.front();
    });
    std::vector<std::size_t> bundle_of(plan_.nodes.size(), bundles_.size());
    for (std::size_t b = 0; b < bundles_.size(); ++b)
      for (const std::size_t n : bundles_[b].nodes) bundle_of[n] = b;
    for (std::size_t b = 0; b < bundles_.size(); ++b) {
      for (const std::size_t n : bundles_[b].nodes)
        for (const std::size_t from : plan_.nodes[n].before)
          if (open_[from] && bundle_of[from] != b) bundles_[b].before.push_back(bundle_of[from]);
      auto& before = bundles_[b].before;
      std::sort(before.begin(), before.end());
      before.erase(std::unique(before.begin(), before.end()), before.end());
    }
  }

  /// A bundle, and all later ones that wait for nothing but it and what has been cut before.
  [[nodiscard]] std::vector<std::size_t> family_of(std::size_t first) const {
    std::vector<std::size_t> family{first};
    std::vector<bool> in(bundles_.size(), false);
    in[first] = true;
    for (std::size_t b = first + 1; b < bundles_.size(); ++b) {
      const std::vector<std::size_t>& before = bundles_[b].before;
      const auto is_in = [&](std::size_t from) { return in[from]; };
      if (level_[b] != kNone || std::none_of(before.begin(), before.end(), is_in) ||
          !std::all_of(before.begin(), before.end(),
                       [&](std::size_t from) { return in[from] || level_[from] != kNone; }))
        continue;
      in[b] = true;
      family.push_back(b);
    }
    return family;
  }

  /// All that hangs together with a bundle, that itself included.
  [[nodiscard]] std::vector<std::size_t> component_of(
      std::size_t first, const std::vector<std::vector<std::size_t>>& beside) const {
    std::vector<bool> in(bundles_.size(), false);
    std::vector<std::size_t> open{first}, component;
    in[first] = true;
    while (!open.empty()) {
      const std::size_t b = open.back();
      open.pop_back();
      component.push_back(b);
      for (const std::size_t next : beside[b])
        if (!in[next]) {
          in[next] = true;
          open.push_back(next);
        }
    }
    std::sort(component.begin(), component.end());
    return component;
  }

  /// What hangs together and is little is one piece.
  void take_small_components() {
    std::vector<std::vector<std::size_t>> beside(bundles_.size());
    for (std::size_t b = 0; b < bundles_.size(); ++b)
      for (const std::size_t from : bundles_[b].before) {
        beside[b].push_back(from);
        beside[from].push_back(b);
      }
    std::vector<bool> seen(bundles_.size(), false);
    for (std::size_t b = 0; b < bundles_.size(); ++b) {
      if (seen[b]) continue;
      std::vector<std::size_t> component = component_of(b, beside);
      for (const std::size_t c : component) seen[c] = true;
      if (sum_of(component) > 2.0 * packing_.chunk) continue;
      for (const std::size_t c : component) level_[c] = 0;
      pieces_.push_back({std::move(component), 0});
    }
  }

  [[nodiscard]] double sum_of(const std::vector<std::size_t>& bundles) const {
    double sum = 0.0;
    for (const std::size_t b : bundles) sum += bundles_[b].seconds;
    return sum;
  }

  /// Takes as a whole what is shared and all that follows from it, depth first, if that is not too
  /// much for one task; else what is shared becomes a piece of its own, for which the rest waits.
  void cut() {
    level_.assign(bundles_.size(), kNone);
    take_small_components();
    for (std::size_t b = 0; b < bundles_.size(); ++b) {
      if (level_[b] != kNone) continue;
      std::vector<std::size_t> family = family_of(b);
      if (sum_of(family) > 2.0 * packing_.chunk) family = {b};
      std::size_t level = 0;
      for (const std::size_t f : family)
        for (const std::size_t from : bundles_[f].before)
          if (level_[from] != kNone) level = std::max(level, level_[from] + 1);
      for (const std::size_t f : family) level_[f] = level;
      pieces_.push_back({std::move(family), level});
    }
  }

  /// As late as what waits for it allows: all waits for the whole of an array before.
  void postpone() {
    std::size_t last = 0;
    for (const Piece& piece : pieces_) last = std::max(last, piece.level);
    std::vector<std::size_t> latest(bundles_.size(), last);
    // Pieces were cut in an order in which none comes before what feeds it.
    for (auto piece = pieces_.rbegin(); piece != pieces_.rend(); ++piece) {
      piece->level = last;
      for (const std::size_t b : piece->bundles) piece->level = std::min(piece->level, latest[b]);
      for (const std::size_t b : piece->bundles)
        for (const std::size_t from : bundles_[b].before)
          if (piece->level > 0) latest[from] = std::min(latest[from], piece->level - 1);
    }
  }

  /// Pieces in the order of their rows, evenly on as many tasks as chunks.
  [[nodiscard]] std::vector<ArrayTask> tasks_of(std::size_t level) const {
    std::vector<const Piece*> pieces;
    double left = 0.0;
    for (const Piece& piece : pieces_)
      if (piece.level == level) {
        pieces.push_back(&piece);
        left += sum_of(piece.bundles);
      }
    std::stable_sort(pieces.begin(), pieces.end(), [&](const Piece* a, const Piece* b) {
      return bundles_[a->bundles.front()].first_row < bundles_[b->bundles.front()].first_row;
    });
    auto tasks_left = static_cast<double>(packing_.most_tasks);
    std::vector<ArrayTask> tasks;
    double sum = 0.0, share = 0.0;
    std::vector<std::size_t> nodes;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (nodes.empty()) {
        tasks_left = std::clamp(std::floor(left / packing_.chunk), 1.0, tasks_left);
        share = left / tasks_left;
      }
      for (const std::size_t b : pieces[p]->bundles)
        nodes.insert(nodes.end(), bundles_[b].nodes.begin(), bundles_[b].nodes.end());
      sum += sum_of(pieces[p]->bundles);
      constexpr double kNearly = 1.0 - 1e-9;
      const bool full = tasks_left > 1.5 && sum >= share * kNearly &&
                        left - sum >= packing_.chunk * kNearly;  // what is left is worth a task
      if (!full && p + 1 < pieces.size()) continue;
      tasks.push_back(task_of(std::move(nodes)));
      nodes.clear();
      left -= sum;
      tasks_left -= 1.0;
      sum = 0.0;
    }
    return tasks;
  }

  /// As long as all its stages on all its cpus, and as the longest chain of them at least.
  [[nodiscard]] ArrayTask task_of(std::vector<std::size_t> nodes) const {
    std::sort(nodes.begin(), nodes.end());
    std::map<std::size_t, double> end;  // of each stage if it need not wait for a processor
    double sum = 0.0, chain = 0.0;
    for (const std::size_t n : nodes) {
      double start = 0.0;
      for (const std::size_t from : plan_.nodes[n].before)
        if (const auto it = end.find(from); it != end.end()) start = std::max(start, it->second);
      end[n] = start + seconds_of(n);
      sum += seconds_of(n);
      chain = std::max(chain, end[n]);
    }
    return {std::move(nodes), std::max(chain, sum / static_cast<double>(packing_.cpus))};
  }

  static std::string name_of(std::size_t level, std::size_t levels) {
    if (level + 1 == levels) return "rows";
    return levels == 2 ? "shared" : fmt::format("shared-{}", level + 1);
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  const Plan& plan_;
  const std::vector<bool>& open_;
  const std::vector<double>& seconds_;
  const Packing& packing_;
  std::vector<Bundle> bundles_;  ///< those that feed others first
  std::vector<std::size_t> level_;
  std::vector<Piece> pieces_;
};

}  // namespace

std::vector<JobArray> pack(const Plan& plan, const std::vector<bool>& open,
                           const std::vector<double>& seconds, const Packing& packing) {
  return Packer(plan, open, seconds, packing).arrays();
}

}  // namespace flowslide::study

#include "study/page/stories.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/hash.hpp"
#include "report/page_read.hpp"
#include "study/page/curves.hpp"
#include "study/page/labels.hpp"
#include "study/page/soil_rings.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace flowslide::study {
namespace {

using StoryJson = nlohmann::ordered_json;

constexpr std::uint64_t kLargestStory = 256u << 20;

/// To a centimetre: what a page shows of it.
StoryJson place(double v) {
  if (!std::isfinite(v)) return nullptr;
  return std::round(100.0 * v) / 100.0;
}

template <class Rows>
StoryJson places(const Rows& rows) {
  StoryJson out = StoryJson::array();
  for (const auto& row : rows) {
    StoryJson one = StoryJson::array();
    for (const double v : row) one.push_back(place(v));
    out.push_back(std::move(one));
  }
  return out;
}

/// Water and the ground beneath it, without the rows that lie on a line of both.
std::vector<std::array<double, 3>> bends(const std::vector<std::array<double, 3>>& water) {
  std::vector<std::array<double, 3>> kept;
  const auto straight = [](const auto& a, const auto& p, const auto& b) {
    for (const std::size_t k : {1u, 2u}) {
      const double on = a[k] + (b[k] - a[k]) * (p[0] - a[0]) / (b[0] - a[0]);
      if (!(std::abs(on - p[k]) < 0.01)) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < water.size(); ++i)
    if (kept.empty() || i + 1 == water.size() || !straight(kept.back(), water[i], water[i + 1]))
      kept.push_back(water[i]);
  return kept;
}

/// The same for sections that would be drawn alike.
std::string digest_of(const std::vector<SoilArea>& areas) {
  std::string text;
  for (const SoilArea& a : areas) {
    text += a.name + ":";
    for (const Ring& ring : a.rings) text += places(ring).dump();
  }
  return sha256(text);
}

class Reader {
 public:
  explicit Reader(const Table& table)
      : front_(table.find("front_m")), fronts_(table.rows), curves_(table.rows) {
    for (std::size_t r = 0; r < table.rows; ++r)
      fronts_[r] = front_ && front_->is_number ? place(front_->number[r]) : StoryJson(nullptr);
  }

  void add(std::size_t row, const PageRun& run) {
    if (fronts_[row].is_null()) fronts_[row] = place(run.front);
    curves_.add(row, run);
    const std::vector<SoilArea> areas = soil_areas(run);
    if (areas.empty()) return;
    const std::string digest = digest_of(areas);
    if (section_.is_null()) {
      drawn_ = digest;
      section_ = section_json(row, run, areas);
    } else if (digest != drawn_) {
      others_.push_back(row);
    }
  }

  Stories take() {
    Stories s;
    s.has_section = !section_.is_null();
    if (s.has_section) section_["other_rows"] = spans_of(others_);
    s.json = StoryJson{{"section", section_}, {"fronts", fronts_}}.dump(
        -1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (!curves_.any()) return s;
    s.curves = curves_.json();
    s.curve_arrays = curves_.arrays();
    return s;
  }

 private:
  static StoryJson section_json(std::size_t row, const PageRun& run,
                                const std::vector<SoilArea>& areas) {
    StoryJson soils = StoryJson::array();
    for (const SoilArea& a : areas) {
      StoryJson rings = StoryJson::array();
      for (const Ring& ring : a.rings) rings.push_back(places(ring));
      soils.push_back({{"name", a.name}, {"rings", rings}});
    }
    return {{"row", row},
            {"toe", place(run.toe)},
            {"soils", soils},
            {"ground", places(run.ground)},
            {"water", places(bends(run.water))}};
  }

  const Column* front_;
  std::vector<StoryJson> fronts_;
  Curves curves_;
  StoryJson section_;
  std::string drawn_;
  std::vector<std::size_t> others_;  ///< rows of other sections
};

bool is_told(std::string_view name) { return name.starts_with("mesh.") || is_for_curves(name); }

}  // namespace

Stories read_stories(const std::filesystem::path& folder, const Table& table,
                     const std::vector<std::string>& reports, const std::atomic<bool>* stop) {
  Reader reader(table);
  std::vector<std::size_t> damaged;
  for (std::size_t row = 0; row < reports.size(); ++row) {
    if (stop && stop->load()) throw Interrupted("stopped; the same command writes the page.");
    if (reports[row].empty()) continue;
    try {
      if (const auto run = read_page(read_file(folder / reports[row], kLargestStory), is_told))
        reader.add(row, *run);
    } catch (const InputError&) {
      damaged.push_back(row);  // its numbers are in the table all the same
    }
  }
  Stories stories = reader.take();
  stories.damaged = std::move(damaged);
  return stories;
}

}  // namespace flowslide::study

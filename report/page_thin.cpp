#include "report/page_thin.hpp"

#include "core/check.hpp"
#include "report/page_arrays.hpp"
#include "report/page_levels.hpp"
#include "report/page_unpack.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using PageJson = nlohmann::ordered_json;

/// Of one row per state.
constexpr std::array kOfStates{"points.x", "points.y", "points.speed", "points.strength"};

/// The rows that stay.
std::vector<std::size_t> evenly(std::size_t of, std::size_t most) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < most; ++k)
    chosen.push_back((2 * k * (of - 1) + most - 1) / (2 * (most - 1)));
  return chosen;
}

class Thinning {
 public:
  Thinning(PageJson& run, StoredArrays stored, std::size_t states)
      : run_(run),
        stored_(std::move(stored)),
        chosen_(evenly(run.at("points").at("frames").get<std::size_t>(), states)) {}

  std::string write() {
    std::string out;
    for (std::size_t k = 0; k < stored_.list.size(); ++k)
      out += kept(run_["arrays"][k], stored_.list[k]);
    run_["points"]["frames"] = chosen_.size();
    return out;
  }

 private:
  std::string kept(PageJson& entry, StoredArray a) const {
    const std::string_view bytes = stored_.bytes_of(a);
    const std::string& name = a.name;
    const bool times = name == "points.t";
    if (!times && std::find(kOfStates.begin(), kOfStates.end(), name) == kOfStates.end())
      return std::string(bytes);
    const std::vector<std::uint32_t> all = decoded_levels(bytes, a.columns, a.width);
    std::vector<std::uint32_t> some;
    for (const std::size_t k : chosen_)
      if (times)
        some.push_back(all.at(k));
      else
        for (std::size_t c = 0; c < a.columns; ++c) some.push_back(all.at(k * a.columns + c));
    (times ? a.columns : a.rows) = chosen_.size();
    entry["rows"] = a.rows;
    entry["columns"] = a.columns;
    return coded_levels(some, a.columns, a.width);
  }

  PageJson& run_;
  StoredArrays stored_;
  std::vector<std::size_t> chosen_;
};

}  // namespace

std::size_t page_states(std::string_view html) {
  const auto run = find_run(html);
  if (!run) return 0;
  const auto json = nlohmann::json::parse(html.substr(run->begin, run->size()), nullptr, false);
  if (!json.is_object() || !json.contains("points")) return 0;
  const auto& points = json["points"];
  if (!points.is_object() || !points.contains("frames")) return 0;
  return points["frames"].is_number_unsigned() ? points["frames"].get<std::size_t>() : 0;
}

std::string thinned_page(const std::string& html, std::size_t states) {
  const auto run = find_run(html);
  const auto arrays = find_element(html, kPageArrays, "</script>");
  if (!run || !arrays || page_states(html) <= std::max<std::size_t>(states, 2)) return html;
  try {
    PageJson json = PageJson::parse(html.substr(run->begin, run->size()));
    const std::string bytes =
        Thinning(json, stored_arrays(html), std::max<std::size_t>(states, 2)).write();
    std::string out = html;
    // the later one first: the place of the earlier stays
    out.replace(arrays->begin, arrays->size(), packed(bytes));
    out.replace(run->begin, run->size(), in_script(json.dump()));
    return out;
  } catch (const nlohmann::json::exception& e) {
    damaged_page(e.what());
  } catch (const std::out_of_range&) {
    damaged_page("its states are not as many as it says");
  }
}

}  // namespace flowslide

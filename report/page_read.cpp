#include "report/page_read.hpp"

#include "report/page_levels.hpp"
#include "report/page_unpack.hpp"

#include <cmath>
#include <cstdint>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using PageJson = nlohmann::ordered_json;

double number_or_unset(const PageJson& json) {
  return json.is_number() ? json.get<double>() : kUnset;
}

double number_in(const PageJson& run, const char* name) {
  return run.contains(name) ? number_or_unset(run[name]) : kUnset;
}

template <std::size_t N>
std::vector<std::array<double, N>> rows_in(const PageJson& run, const char* name) {
  std::vector<std::array<double, N>> rows;
  if (!run.contains(name)) return rows;
  for (const PageJson& row : run[name]) {
    if (!row.is_array() || row.size() < N) damaged_page(fmt::format("'{}' lacks a number", name));
    std::array<double, N>& to = rows.emplace_back();
    for (std::size_t k = 0; k < N; ++k) to[k] = number_or_unset(row[k]);
  }
  return rows;
}

std::vector<double> values_of(const StoredArray& a, std::string_view bytes) {
  const std::uint32_t unset = a.width == 1 ? 0xffu : 0xffffu;
  std::vector<double> values;
  values.reserve(a.size());
  for (const std::uint32_t level : decoded_levels(bytes, a.columns, a.width))
    values.push_back(level == unset ? kUnset : a.lowest + level * a.step);
  return values;
}

PageRun run_of(const PageJson& json, const StoredArrays& stored,
               const std::function<bool(std::string_view)>& wanted) {
  PageRun run;
  run.toe = number_in(json, "toe_m");
  run.front = number_in(json, "front_m");
  run.transfer_time = number_in(json, "transfer_time_s");
  if (json.contains("soils"))
    for (const PageJson& soil : json["soils"])
      run.soils.emplace_back(soil.at("tag").get<int>(), soil.at("name").get<std::string>());
  run.ground = rows_in<2>(json, "ground");
  run.water = rows_in<3>(json, "water");
  if (json.contains("windows")) run.windows = json["windows"].get<std::vector<std::string>>();
  for (const StoredArray& a : stored.list)
    if (wanted(a.name)) run.arrays[a.name] = values_of(a, stored.bytes_of(a));
  return run;
}

}  // namespace

const std::vector<double>& PageRun::array(std::string_view name) const {
  static const std::vector<double> kNone;
  const auto found = arrays.find(name);
  return found == arrays.end() ? kNone : found->second;
}

std::optional<PageRun> read_page(std::string_view html,
                                 const std::function<bool(std::string_view)>& wanted) {
  const auto element = find_run(html);
  if (!element) return std::nullopt;
  try {
    const PageJson json = PageJson::parse(html.substr(element->begin, element->size()));
    return run_of(json, stored_arrays(html), wanted);
  } catch (const nlohmann::json::exception& e) {
    damaged_page(e.what());
  }
}

}  // namespace flowslide

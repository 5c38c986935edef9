#include "workflows/engine/headlines.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace flowslide {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kHeadlinesKey = "headlines";

Json to_json(const std::vector<Headline>& headlines) {
  Json list = Json::array();
  for (const Headline& h : headlines)
    list.push_back({{"fact", h.fact}, {"text", h.text}, {"unit", h.unit}, {"note", h.note}});
  return list;
}

}  // namespace

std::string add_headlines(const std::string& facts, const std::vector<Headline>& headlines) {
  Json json = Json::parse(facts, nullptr, false);
  if (!json.is_object() || headlines.empty()) return facts;
  json[kHeadlinesKey] = to_json(headlines);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<Headline> headlines_of(const std::string& result) {
  std::vector<Headline> headlines;
  const Json json = Json::parse(result, nullptr, false);
  if (!json.is_object() || !json.contains(kHeadlinesKey) || !json[kHeadlinesKey].is_array())
    return headlines;
  for (const Json& h : json[kHeadlinesKey]) {
    if (!h.is_object()) continue;
    const auto text = [&h](const char* key) {
      const auto at = h.find(key);
      return at != h.end() && at->is_string() ? at->get<std::string>() : std::string();
    };
    headlines.push_back({text("fact"), text("text"), text("unit"), text("note")});
  }
  return headlines;
}

std::vector<Headline> merged_headlines(const std::vector<std::string>& facts) {
  std::vector<Headline> all;
  std::vector<std::vector<Headline>> each;
  for (const std::string& text : facts)
    if (auto some = headlines_of(text); !some.empty()) each.push_back(std::move(some));
  if (each.empty()) return all;
  std::rotate(each.begin(), each.end() - 1, each.end());
  for (const std::vector<Headline>& some : each)
    for (const Headline& h : some)
      if (std::none_of(all.begin(), all.end(), [&](const Headline& o) { return o.fact == h.fact; }))
        all.push_back(h);
  return all;
}

}  // namespace flowslide

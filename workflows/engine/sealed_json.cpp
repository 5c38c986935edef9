#include "workflows/engine/sealed_json.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "core/hash.hpp"

#include <algorithm>
#include <string_view>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

constexpr std::string_view kEntry = ",\n  \"sha256\": \"";
constexpr std::string_view kEnd = "\"\n}\n";
constexpr std::size_t kDigits = 64;
constexpr std::uint64_t kLongest = 64u << 20;

bool is_sealed(const std::string& text) {
  const std::size_t tail = kEntry.size() + kDigits + kEnd.size();
  if (text.size() <= tail) return false;
  const std::string_view front = std::string_view(text).substr(0, text.size() - tail);
  return std::string_view(text).substr(front.size()) ==
         fmt::format("{}{}{}", kEntry, sha256(front), kEnd);
}

/// Brackets that are open at the same time, strings left out.
std::size_t depth(const std::string& text) {
  std::size_t open = 0, most = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') in_string = !in_string;
    if (in_string && c == '\\') ++i;
    if (in_string) continue;
    if (c == '{' || c == '[') most = std::max(most, ++open);
    if ((c == '}' || c == ']') && open > 0) --open;
  }
  return most;
}

}  // namespace

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::uint64_t whole_number(const Json& json) {
  validate(json.is_number_unsigned(), "{} is no whole number", json.dump());
  return json.get<std::uint64_t>();
}

std::optional<Json> parse_object(const std::string& text) {
  constexpr std::size_t kDeepest = 32;
  if (depth(text) > kDeepest) return std::nullopt;
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return json;
}

std::string seal(const Json& object) {
  std::string text = json_text(object);
  text.resize(text.size() - std::string_view("\n}\n").size());
  const std::string digest = sha256(text);
  return text.append(kEntry).append(digest).append(kEnd);
}

SealedJson read_sealed(const fs::path& path) {
  const std::string name = path.filename().string();
  const fs::file_type type = type_of(path);
  if (type == fs::file_type::not_found) return {};
  if (type != fs::file_type::regular) return {{}, fmt::format("{} is no file", name)};
  const std::string text = read_file(path, kLongest);
  if (!is_sealed(text)) {
    // Files of earlier programs had no checksum.
    const bool unsealed =
        text.find("\"sha256\"", text.size() - std::min<std::size_t>(text.size(), 200)) ==
        std::string::npos;
    if (unsealed && parse_object(text))
      return {{}, fmt::format("{} has no checksum (an earlier program wrote it)", name)};
    return {{}, fmt::format("{} is damaged (its checksum is that of another text)", name)};
  }
  auto json = parse_object(text);
  if (!json) return {{}, fmt::format("{} is damaged (it is no JSON object)", name)};
  json->erase("sha256");
  return {std::move(json), {}};
}

}  // namespace flowslide

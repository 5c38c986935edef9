#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

/// JSON objects whose last entry, "sha256", is the checksum of all the text before it. It finds
/// what a disk or an editor has changed; it does not say who wrote the file.
namespace flowslide {

using Json = nlohmann::ordered_json;

/// Text of a file. The object must not be empty.
std::string seal(const Json& object);

struct SealedJson {
  std::optional<Json> json;
  std::string problem;  ///< "result.json is damaged (...)"; empty too if there is no such file
};

/// FileError if the system cannot read what is there.
SealedJson read_sealed(const std::filesystem::path& path);

/// A JSON object, or nothing. Refuses nesting that no file of this program has: what handles JSON
/// calls itself at every level.
std::optional<Json> parse_object(const std::string& text);

/// A number without sign and fraction; the conversions of the library take any number for any type.
/// InputError.
std::uint64_t whole_number(const Json& json);

/// Names in a file system need not be UTF-8; JSON text must be.
std::string json_text(const Json& json);

}  // namespace flowslide

#include "exchange/inspect_record.hpp"

#include "core/check.hpp"
#include "motion/measures.hpp"
#include "motion/record.hpp"
#include "motion/record_text.hpp"

#include <array>
#include <fstream>

namespace fs = std::filesystem;

namespace flowslide {
namespace {

/// Recorders have gigabytes, so only the beginning is looked at; whole lines of it.
std::string beginning(const fs::path& path) {
  constexpr std::size_t kBytes = 16384;
  std::string text(kBytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(kBytes));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() == kBytes) text.resize(text.find_last_of('\n') + 1);
  return text;
}

}  // namespace

bool is_motion_record(const fs::path& path) {
  const std::string text = beginning(path);
  const bool packed = text.starts_with("\x1f\x8b");
  try {
    return is_record(packed ? read_record_text(path) : record_text(text, path.filename().string()));
  } catch (const InputError&) {
    return false;
  }
}

Json inspect_record(const fs::path& path) {
  Json j = {{"kind", "record"}};
  try {
    const std::optional<std::string> unit = stated_unit(read_record_text(path));
    j["unit"] = unit.value_or("not stated");
    const Record record = read_record(path, {.unit = unit.value_or("m/s2")});
    j["samples"] = record.motion.acceleration.size();
    j["dt_s"] = record.motion.dt;
    j["duration_s"] = record.motion.duration();
    if (unit)
      j["pga_m_s2"] = pga(record.motion);
    else
      j["peak"] = pga(record.motion);
    j["notes"] = record.notes;
    if (unit && !record.warnings.empty()) j["warnings"] = record.warnings;
    j["problems"] = Json::array();
  } catch (const InputError& e) {
    j["problems"] = {e.what()};
  }
  return j;
}

}  // namespace flowslide

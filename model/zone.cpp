#include "model/zone.hpp"

#include "core/check.hpp"
#include "model/field_store.hpp"

namespace flowslide {
namespace {

constexpr std::string_view kZone = "zone";
constexpr int kZoneFormat = 2;

/// Scalars over time of a zone file: f(name, unit, array).
template <class History, class F>
void visit_scalars(History& h, F&& f) {
  f("history/kinetic_energy", "J/m", h.kinetic_energy);
  f("history/kinetic_energy_relative", "J/m", h.kinetic_energy_relative);
  f("history/sliding_energy", "J/m", h.sliding_energy);
  f("history/distortion_gauss", "-", h.distortion_gauss);
  f("history/distortion_centre", "-", h.distortion_centre);
}

/// Depths of a zone file, one value per window: f(name, array).
template <class Zone, class F>
void visit_depths(Zone& z, F&& f) {
  f("window_depth_max", z.window_depth_max);
  f("window_depth_any", z.window_depth_any);
  f("window_depth_interpolated", z.window_depth_interpolated);
  f("window_depth_strong", z.window_depth_strong);
  f("window_depth_before_slide", z.window_depth_before_slide);
}

/// Depths over time, one row per window: f(name, table).
template <class History, class F>
void visit_depth_tables(History& h, F&& f) {
  f("history/depth", h.depth);
  f("history/depth_max", h.depth_max);
  f("history/depth_any", h.depth_any);
  f("history/depth_interpolated", h.depth_interpolated);
}

void check_zone_lengths(const std::filesystem::path& path, const LiquefactionZone& zone) {
  const auto same = [&path](const char* name, std::size_t found, const char* as, std::size_t n) {
    validate(found == n, "'{}': {} has {} values, {} has {} (they must be equal)", path.string(),
             name, found, as, n);
  };
  const std::size_t elements = zone.liquefied.size();
  same("r_u_element", zone.r_u_element.size(), "liquefied", elements);
  same("sigma_v0", zone.sigma_v0.size(), "liquefied", elements);
  same("strength", zone.strength.size(), "liquefied", elements);
  same("layer", zone.layer.size(), "liquefied", elements);
  visit_depths(zone, [&](const char* name, const auto& array) {
    same(name, array.size(), "window_names", zone.window_names.size());
  });
  const std::size_t windows = zone.history.window_names.size();
  visit_depth_tables(zone.history, [&](const char* name, const auto& table) {
    same(name, table.size(), "history/window_names", windows);
  });
  visit_scalars(zone.history, [&](const char* name, auto, const auto& array) {
    same(name, array.size(), "history/time", zone.history.time.size());
  });
}

}  // namespace

void write_zone(const std::filesystem::path& path, const LiquefactionZone& zone) {
  check_zone_lengths(path, zone);
  FieldWriter out(path, kZone, kZoneFormat);
  out.write("transfer_time", std::vector<double>{zone.transfer_time},
            {.unit = "s", .convention = "from the start of the motion"});
  out.write("transfer_frame", std::vector<std::int32_t>{zone.transfer_frame},
            {.unit = "", .convention = "row of frames/time of the history, -1 the gravity state"});
  out.write_texts("transfer_reason", {zone.transfer_reason});
  out.write("r_u_node", zone.r_u_node,
            {.unit = "-", .convention = "nodes; NaN below the stress floor", .nan = Nan::allowed});
  out.write(
      "r_u_element", zone.r_u_element,
      {.unit = "-", .convention = "elements; NaN below the stress floor", .nan = Nan::allowed});
  out.write("sigma_v0", zone.sigma_v0,
            {.unit = "Pa",
             .convention = "elements; initial vertical effective stress, compression positive",
             .nan = Nan::allowed});
  out.write("liquefied", zone.liquefied, {.unit = "", .convention = "elements; 1 inside the zone"});
  out.write("strength", zone.strength,
            {.unit = "Pa",
             .convention = "elements; residual strength, NaN outside the zone",
             .nan = Nan::allowed});
  out.write("layer", zone.layer,
            {.unit = "", .convention = "elements; from the surface, -1 outside the zone"});
  out.write("lower_boundary", zone.lower_boundary,
            {.unit = "m", .convention = "x y, from upstream to downstream"});
  out.write_texts("window_names", zone.window_names);
  visit_depths(zone, [&out](const char* name, const auto& array) {
    out.write(name, array, {.unit = "m", .convention = "per window", .nan = Nan::allowed});
  });
  out.write("strong_shaking_end", std::vector<double>{zone.strong_shaking_end}, {.unit = "s"});
  out.write("onset_time", std::vector<double>{zone.onset_time},
            {.unit = "s", .convention = "NaN without failure", .nan = Nan::allowed});
  out.write_texts("notes", zone.notes);

  const ZoneHistory& h = zone.history;
  out.write("history/time", h.time, {.unit = "s", .convention = "from the start of the motion"});
  out.write_texts("history/window_names", h.window_names);
  const FieldLabel depth{.unit = "m", .convention = "(window, time)", .nan = Nan::allowed};
  visit_depth_tables(h, [&](const char* name, const auto& table) {
    out.write_table(name, table, h.time.size(), depth);
  });
  visit_scalars(h, [&out](const char* name, const char* unit, const auto& array) {
    out.write(name, array, {.unit = unit, .nan = Nan::allowed});
  });
  out.finish();
}

LiquefactionZone read_zone(const std::filesystem::path& path) {
  const FieldReader in(path, kZone, kZoneFormat);
  LiquefactionZone zone;
  zone.transfer_time = in.read_one<double>("transfer_time");
  zone.transfer_frame = in.read_one<std::int32_t>("transfer_frame");
  zone.transfer_reason = in.read_texts("transfer_reason", 1)[0];
  zone.r_u_node = in.read<double>("r_u_node", kAnyRows, Nan::allowed);
  zone.liquefied = in.read<std::uint8_t>("liquefied");
  const std::size_t elements = zone.liquefied.size();
  zone.r_u_element = in.read<double>("r_u_element", elements, Nan::allowed);
  zone.sigma_v0 = in.read<double>("sigma_v0", elements, Nan::allowed);
  zone.strength = in.read<double>("strength", elements, Nan::allowed);
  zone.layer = in.read<std::int32_t>("layer", elements);
  zone.lower_boundary = in.read<Vec2>("lower_boundary");
  zone.window_names = in.read_texts("window_names");
  visit_depths(zone, [&in, &zone](const char* name, auto& array) {
    array = in.read<double>(name, zone.window_names.size(), Nan::allowed);
  });
  zone.strong_shaking_end = in.read_one<double>("strong_shaking_end");
  zone.onset_time = in.read<double>("onset_time", 1, Nan::allowed)[0];
  zone.notes = in.read_texts("notes");

  ZoneHistory& h = zone.history;
  h.time = in.read<double>("history/time");
  h.window_names = in.read_texts("history/window_names");
  const std::size_t windows = h.window_names.size();
  visit_depth_tables(h, [&](const char* name, auto& table) {
    table = in.read_table(name, windows, h.time.size(), Nan::allowed);
  });
  visit_scalars(h, [&in, &h](const char* name, auto, auto& array) {
    array = in.read<double>(name, h.time.size(), Nan::allowed);
  });
  return zone;
}

}  // namespace flowslide

#include "study/page/meanings.hpp"

#include <array>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

struct Known {
  std::string_view column, words, definition;
};
constexpr std::array kKnown{
    Known{"runout_m", "runout",
          "how far the front comes beyond the toe of the undeformed section; the front is the "
          "fifth-farthest material point of the soils that count"},
    Known{"runout_mass_quantile_m", "runout without the thin tip",
          "the same without the foremost 0.5 % of the mass that moved"},
    Known{"runout_equal_mass_m", "runout of equal mass",
          "the same of the point that has as much mass beyond it as the fifth of 7,400 points"},
    Known{"volume_past_toe_m3_per_m", "volume beyond the toe", "per metre of width, at rest"},
    Known{"transfer_time_s", "time of the transfer",
          "when the finite elements hand the section over to the material points"},
    Known{"onset_time_s", "onset of the slide",
          "when the energy of sliding leaves what shaking gave it before"},
    Known{"motion_pga_m_s2", "PGA of the motion", "its largest acceleration"},
    Known{"motion_pgv_m_s", "PGV of the motion", "its largest velocity"},
    Known{"motion_arias_m_s", "Arias intensity",
          "pi/(2 g) times the integral of the square of the acceleration"},
    Known{"motion_d5_95_s", "duration of the motion, D5-95",
          "time from 5 to 95 % of the Arias intensity"},
    Known{"motion_tm_s", "mean period of the motion",
          "of its Fourier amplitudes from 0.25 to 20 Hz"},
    Known{"motion_cav_m_s", "CAV of the motion",
          "cumulative absolute velocity, the integral of the acceleration's size"},
    Known{"motion_masi_m_s", "MASI of the motion",
          "its acceleration spectrum, 5 % damped, integrated from 0.1 to 1.5 s of period"}};

}  // namespace

std::optional<Meaning> meaning_of(std::string_view column) {
  for (const Known& k : kKnown)
    if (k.column == column) return Meaning{std::string(k.words), std::string(k.definition)};
  constexpr std::string_view kDepth = "liquefaction_depth_", kUnit = "_m",
                             kSmooth = "_interpolated";
  if (!column.starts_with(kDepth) || !column.ends_with(kUnit)) return std::nullopt;
  std::string window(column.substr(kDepth.size(), column.size() - kDepth.size() - kUnit.size()));
  const bool smooth = window.ends_with(kSmooth);
  if (smooth) window.resize(window.size() - kSmooth.size());
  for (char& c : window) c = c == '_' ? ' ' : c;
  return Meaning{
      fmt::format("depth of liquefaction, {}{}", window, smooth ? ", interpolated" : ""),
      smooth ? "where the pore-pressure ratio falls through the limit of the zone, between nodes"
             : "of the deepest node there whose pore-pressure ratio exceeds the limit of the zone, "
               "up to the transfer"};
}

}  // namespace flowslide::study

#pragma once
#include "core/check.hpp"
#include "report/config.hpp"

#include <string_view>
#include <utility>
#include <vector>

/// What became of a section, in a word and the numbers behind it. docs/theory/outcome.md
namespace flowslide {

struct ParticleSet;
struct FinalState;
struct QuadMesh;
struct LiquefactionZone;

enum class Outcome { stood, deformed, slid, flowed };
std::string_view word(Outcome outcome);

/// Displacement of the shaking, up to the transfer, of the flow, and from first to last [m].
struct Apart {
  double shaking = 0.0, flow = 0.0, both = 0.0;
};

/// The downstream edge of the highest ground, from the undeformed section [m].
struct CrestFacts {
  double x = kUnset, level = kUnset;
  Apart outward;              ///< towards larger x
  Apart settlement;           ///< downwards
  double freeboard = kUnset;  ///< level after settlement above the pond; unset without one
};

struct OutcomeFacts {
  Outcome outcome = Outcome::stood;
  double height = 0.0;  ///< of the materials that count [m]
  Apart mean;           ///< over their mass
  Apart largest;        ///< exceeded by 0.5 % of their mass
  CrestFacts crest;
};

OutcomeFacts outcome_facts(const ParticleSet& particles, const FinalState& end,
                           const ReportConfig& config);

/// Shares of the area that gets residual strength, by the pore-pressure ratio of the elements at
/// the transfer: upper end of the class [-] (infinite: the last) and share. Empty without shaking.
std::vector<std::pair<double, double>> zone_shares(const QuadMesh& mesh,
                                                   const LiquefactionZone& zone);

}  // namespace flowslide

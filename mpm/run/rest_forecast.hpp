#pragma once
#include <optional>
#include <vector>

namespace flowslide {

/// When a flow will be at rest. Friction of constant strength takes speed away at a constant rate,
/// so the root of the kinetic energy falls to zero along a straight line; the last fifth of the
/// time is fitted. For the time that a progress line shows, for no decision.
class RestForecast {
 public:
  /// Kinetic energy [J] at a time later than the last [s].
  void look(double time, double kinetic);
  /// Time at which the kinetic energy will have fallen from its peak [J] to `share` of it [s];
  /// empty before it falls.
  [[nodiscard]] std::optional<double> rest(double peak, double share) const;

 private:
  struct Seen {
    double time, root;
  };
  std::vector<Seen> seen_;
};

}  // namespace flowslide

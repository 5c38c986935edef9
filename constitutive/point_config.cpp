#include "constitutive/point_config.hpp"

#include "core/check.hpp"

#include <algorithm>

namespace flowslide {

template <>
struct Schema<PointMaterial> {
  static constexpr std::string_view doc = "Exactly one law.";
  static void describe(FieldVisitor& v, PointMaterial& c) { describe_laws(v, c.laws); }
};

template <>
struct Schema<PointStress> {
  static constexpr std::string_view doc = "Consolidated effective stress, compression positive.";
  static void describe(FieldVisitor& v, PointStress& c) {
    v.quantity("vertical", c.vertical, Dim::stress, {.above = 0.0}, "vertical stress");
    v.quantity("k0", c.k0, Dim::none, {.min = 0.0, .max = 10.0}, "horizontal over vertical");
    v.quantity("shear", c.shear, Dim::stress, {}, "shear stress at the start");
    v.flag(
        "compacts", c.compacts,
        "the elastic strain of the consolidation lowers the void ratio of pm4sand, as in OpenSees "
        "and with gravity.compacts in fem.run; off: Dr is that of the consolidated soil");
  }
};

template <>
struct Schema<PointShear> {
  static constexpr std::string_view doc =
      "Direct simple shear: cyclic with one of csr, reversal_stress and reversal_strain, else "
      "monotonic.";
  static void describe(FieldVisitor& v, PointShear& c) {
    v.flag("drained", c.drained,
           "constant vertical stress in place of constant volume (undrained)");
    v.quantity("csr", c.csr, Dim::none, {.max = 10.0, .above = 0.0},
               "shearing turns at this shear stress over the vertical stress at the start");
    v.quantity("reversal_stress", c.reversal_stress, Dim::stress, {.above = 0.0},
               "shearing turns at this shear stress");
    v.quantity("reversal_strain", c.reversal_strain, Dim::none, {.max = 1.0, .above = 0.0},
               "shearing turns at this shear strain");
    v.quantity("stop_strain", c.stop_strain, Dim::none, {.max = 10.0, .above = 0.0},
               "the test ends at this shear strain");
    v.quantity("strain_step", c.strain_step, Dim::none, {.min = 1e-8, .max = 0.01},
               "shear strain of a step");
    v.integer("max_cycles", c.max_cycles, {.min = 1, .max = 100000},
              "the test ends after so many cycles");
  }
};

template <>
struct Schema<PointLeg> {
  static constexpr std::string_view doc =
      "For each component a strain to add (extension positive) or an effective stress to reach "
      "(tension positive); a component with neither keeps its strain.";
  static void describe(FieldVisitor& v, PointLeg& c) {
    v.quantity("strain_xx", c.strain_xx, Dim::none, {.min = -1.0, .max = 1.0}, "strain to add");
    v.quantity("strain_yy", c.strain_yy, Dim::none, {.min = -1.0, .max = 1.0}, "strain to add");
    v.quantity("gamma_xy", c.gamma_xy, Dim::none, {.min = -10.0, .max = 10.0},
               "shear strain to add");
    v.quantity("stress_xx", c.stress_xx, Dim::stress, {}, "stress to reach");
    v.quantity("stress_yy", c.stress_yy, Dim::stress, {}, "stress to reach");
    v.quantity("tau_xy", c.tau_xy, Dim::stress, {}, "shear stress to reach");
    v.integer("steps", c.steps, {.min = 1, .max = 1e6}, "equal steps of the leg");
  }
};

void Schema<PointConfig>::describe(FieldVisitor& v, PointConfig& c) {
  v.group("material", c.material, "exactly one law");
  v.group("stress", c.stress, "consolidated effective stress");
  v.group("simple_shear", c.simple_shear, "direct simple shear");
  v.list("path", c.path, "legs of a path of strains and stresses, in place of simple_shear");
}

namespace {

/// What is wrong with a law, under the path at which it is written.
void check_material(const PointMaterial& material) {
  try {
    (void)make_material(material.laws, "material");
  } catch (const InputError& e) {
    const std::string text = e.what();
    const bool of_law = text.find(": ") < text.find(' ');
    throw InputError(fmt::format("material{}{}", of_law ? "." : ": ", text));
  }
}

void check_shear(const PointShear& s) {
  const int reversals = int{s.csr.has_value()} + int{s.reversal_stress.has_value()} +
                        int{s.reversal_strain.has_value()};
  validate(reversals <= 1,
           "simple_shear: {} of csr, reversal_stress and reversal_strain are given (the test could "
           "turn at one only). Keep one, or none for monotonic shear",
           reversals);
  const double largest = s.reversal_strain ? *s.reversal_strain : s.stop_strain;
  validate(s.strain_step <= largest,
           "simple_shear.strain_step: {:g} is more than {} of {:g} (the first step would go beyond "
           "it) take a hundredth of it",
           s.strain_step, s.reversal_strain ? "the reversal_strain" : "the stop_strain", largest);
  // Stress-controlled tests leave small strains only when they are about to end.
  const double steps =
      largest / s.strain_step * (s.reversal_strain.has_value() ? 4.0 * s.max_cycles : 1.0);
  validate(steps <= double{kMostPointSteps},
           "simple_shear: about {:.2g} steps (the limit is {:.0g}). Raise strain_step or lower "
           "max_cycles",
           steps, double{kMostPointSteps});
}

void check_leg(const PointLeg& leg, std::size_t index) {
  bool moves = false;
  const auto one = [&](const auto& strain, const auto& stress, const char* what) {
    moves = moves || strain || stress;
    validate(
        !(strain && stress),
        "path.{}: leg {} gives a strain and a stress for {} (only one can be prescribed). Leave "
        "one out",
        index, index + 1, what);
  };
  one(leg.strain_xx, leg.stress_xx, "xx");
  one(leg.strain_yy, leg.stress_yy, "yy");
  one(leg.gamma_xy, leg.tau_xy, "xy");
  validate(moves,
           "path.{}: leg {} gives no strain and no stress (nothing would happen in its {} steps). "
           "Say what it does, or leave it out",
           index, index + 1, leg.steps);
}

void check_path(const std::vector<PointLeg>& path) {
  double steps = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    check_leg(path[i], i);
    steps += path[i].steps;
  }
  validate(steps <= double{kMostPointSteps},
           "path: {:.2g} steps in all legs (the limit is {:.0g}). Take fewer", steps,
           double{kMostPointSteps});
}

}  // namespace

void check(const PointConfig& config) {
  check_material(config.material);
  validate(
      !config.stress.compacts || config.material.laws.of<PM4Sand>(),
      "stress.compacts with a law other than pm4sand (it has no void ratio to lower). Leave it "
      "out");
  validate(
      !config.stress.compacts || config.stress.k0 < 1.0,
      "stress.compacts with k0 = {} (elastic soil without lateral strain stays below 1). Leave "
      "it out, or give a smaller k0",
      config.stress.k0);
  validate(config.simple_shear.has_value() != !config.path.empty(),
           "{} (exactly one says what to do)",
           config.simple_shear ? "both simple_shear and path are given. Leave one out"
                               : "neither simple_shear nor path is given. Add one, such as "
                                 "simple_shear: {csr: 0.1}");
  if (config.simple_shear) check_shear(*config.simple_shear);
  check_path(config.path);
}

}  // namespace flowslide

#include "workflows/stages/cross_checks.hpp"

/// Settings that another one makes idle: whoever changes them expects them to act.
namespace flowslide {
namespace {

/// A setting that was changed, but acts only where `needed` is set.
void idle(Findings& found, bool changed, std::string_view setting, std::string_view needed) {
  if (changed) warn(found, "{}: has no effect here: for {} only.", setting, needed);
}

}  // namespace

void check_inert(const FlowConfig& flow, Findings& found) {
  using mpm::Transfer;
  const FlowConfig usual;
  idle(found, flow.transfer != Transfer::flip && flow.flip_share != usual.flip_share, "flip_share",
       "transfer: flip");
  idle(found, flow.transfer != Transfer::fmpm && flow.fmpm_order != usual.fmpm_order, "fmpm_order",
       "transfer: fmpm");
  idle(found, flow.transfer != Transfer::aflip && flow.relaxation != usual.relaxation, "relaxation",
       "transfer: aflip");
}

void check_inert(const FemConfig& fem, Findings& found) {
  const FemConfig usual;
  const bool factors = fem.damping.mass.has_value();
  idle(found, factors && fem.damping.ratio != usual.damping.ratio, "damping.ratio",
       "damping without mass and stiffness");
  idle(found, factors && fem.damping.frequencies != usual.damping.frequencies,
       "damping.frequencies", "damping without mass and stiffness");
  const bool columns = fem.sides.kind == SideKind::free_field;
  idle(found, !columns && fem.sides.width != usual.sides.width, "sides.width", "kind: free_field");
  idle(found, !columns && fem.sides.thickness != usual.sides.thickness, "sides.thickness",
       "kind: free_field");
  const IntegrationConfig &now = fem.integration, &then = usual.integration;
  const bool implicit = now.scheme == IntegrationScheme::implicit;
  idle(found,
       !implicit && (now.step != then.step || now.smallest_step != then.smallest_step ||
                     now.tolerance != then.tolerance || now.max_iterations != then.max_iterations ||
                     now.theta != then.theta),
       "integration", "scheme: implicit");
  idle(found, implicit && fem.courant != usual.courant, "courant", "integration.scheme: explicit");
}

}  // namespace flowslide

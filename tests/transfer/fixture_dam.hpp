#pragma once
#include "importers/opensees.hpp"
#include "tests/support/paths.hpp"

/// The dam of fixtures/opensees/dam-rio270, as its recorders give it.
namespace flowslide::test {

/// At rest, without strain.
inline OpenSeesConfig fixture_dam() {
  const std::filesystem::path folder = fixture("opensees/dam-rio270");
  OpenSeesConfig c;
  c.mesh.nodes = {folder / "nodeinfo.dat"};
  c.mesh.elements = {folder / "elementinfo.dat"};
  c.units = {"m", "s", "kPa"};
  c.materials = {{"embankment", {167, 1690.0, {}}},
                 {"tailings", {168, 1870.0, {}}},
                 {"foundation", {170, 1900.0, {}}}};
  c.gravity.stress = {folder / "Gstress.out"};
  c.gravity.pore_pressure = {folder / "GporePressure.out"};
  return c;
}

inline OpenSeesConfig shaken_fixture_dam() {
  const std::filesystem::path folder = fixture("opensees/dam-rio270");
  OpenSeesConfig c = fixture_dam();
  c.shaking.emplace();
  c.shaking->displacement = {folder / "displacement.out.gz"};
  c.shaking->velocity = {folder / "velocity.out.gz"};
  c.shaking->pore_pressure = {folder / "porePressure.out.gz"};
  c.shaking->stress = {folder / "stress.out.gz"};
  c.shaking->strain = {folder / "strain.out.gz"};
  return c;
}

}  // namespace flowslide::test

#include "model/zone.hpp"

#include "core/check.hpp"
#include "tests/model/scratch.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

LiquefactionZone some_zone() {
  LiquefactionZone z;
  z.transfer_time = 24.1;
  z.transfer_frame = 240;
  z.transfer_reason = "the depth at the pond stopped growing";
  z.r_u_node = {0.1, kUnset, 1.0 / 3.0};
  z.r_u_element = {0.7, kUnset};
  z.sigma_v0 = {1e5, 2e3};
  z.liquefied = {1, 0};
  z.strength = {3e3, kUnset};
  z.layer = {0, -1};
  z.lower_boundary = {{0.0, 1.0}, {2.0, 1.0 / 3.0}};
  z.window_names = {"crest", "pond"};
  z.window_depth_max = {1.0, 2.0};
  z.history.time = {0.0, 1.0, 2.0};
  z.history.window_names = {"crest", "pond"};
  z.history.depth = {{0, 1, 0.5}, {0, 2, 1}};
  z.history.depth_max = {{0, 1, 1}, {0, 2, 2}};
  z.window_depth_any = {1.5, 2.5};
  z.window_depth_interpolated = {1.25, 2.25};
  z.window_depth_strong = {0.5, 1.0};
  z.window_depth_before_slide = {0.75, 1.5};
  z.strong_shaking_end = 19.0;
  z.onset_time = kUnset;
  z.history.depth_any = {{0, 3, 0.5}, {0, 4, 1}};
  z.history.depth_interpolated = {{0, 1.2, 0.7}, {0, 2.2, 1.3}};
  z.history.sliding_energy = {0, 0.5, 1.5};
  z.history.kinetic_energy = {0, 10, 20};
  z.history.kinetic_energy_relative = {0, 1, 2};
  z.history.distortion_gauss = {1, 0.9, 0.8};
  z.history.distortion_centre = {1, 0.95, 0.9};
  z.notes = {"2 nodes skipped"};
  return z;
}

}  // namespace

TEST_CASE("a zone comes back from the file") {
  const Scratch folder;
  const LiquefactionZone z = some_zone();
  write_zone(folder / "z.h5", z);
  const LiquefactionZone r = read_zone(folder / "z.h5");
  CHECK(r.transfer_time == 24.1);
  CHECK(r.transfer_frame == 240);
  CHECK(r.transfer_reason == z.transfer_reason);
  CHECK(r.r_u_node[2] == z.r_u_node[2]);
  CHECK(std::isnan(r.r_u_node[1]));
  CHECK(r.r_u_element[0] == 0.7);
  CHECK(r.sigma_v0 == z.sigma_v0);
  CHECK(r.liquefied == z.liquefied);
  CHECK(r.strength[0] == 3e3);
  CHECK(std::isnan(r.strength[1]));
  CHECK(r.layer == z.layer);
  CHECK(r.lower_boundary == z.lower_boundary);
  CHECK(r.window_names == z.window_names);
  CHECK(r.window_depth_max == z.window_depth_max);
  CHECK(r.history.time == z.history.time);
  CHECK(r.history.window_names == z.history.window_names);
  CHECK(r.history.depth == z.history.depth);
  CHECK(r.history.depth_max == z.history.depth_max);
  CHECK(r.window_depth_any == z.window_depth_any);
  CHECK(r.window_depth_interpolated == z.window_depth_interpolated);
  CHECK(r.window_depth_strong == z.window_depth_strong);
  CHECK(r.window_depth_before_slide == z.window_depth_before_slide);
  CHECK(r.strong_shaking_end == 19.0);
  CHECK_FALSE(is_set(r.onset_time));
  CHECK(r.history.depth_any == z.history.depth_any);
  CHECK(r.history.depth_interpolated == z.history.depth_interpolated);
  CHECK(r.history.sliding_energy == z.history.sliding_energy);
  CHECK(r.history.kinetic_energy == z.history.kinetic_energy);
  CHECK(r.history.kinetic_energy_relative == z.history.kinetic_energy_relative);
  CHECK(r.history.distortion_gauss == z.history.distortion_gauss);
  CHECK(r.history.distortion_centre == z.history.distortion_centre);
  CHECK(r.notes == z.notes);
}

TEST_CASE("a zone of the gravity state has no history") {
  const Scratch folder;
  LiquefactionZone z = some_zone();
  z.transfer_frame = -1;
  z.history = {};
  z.notes.clear();
  z.lower_boundary.clear();
  write_zone(folder / "z.h5", z);
  const LiquefactionZone r = read_zone(folder / "z.h5");
  CHECK(r.transfer_frame == -1);
  CHECK(r.history.time.empty());
  CHECK(r.history.depth.empty());
  CHECK(r.lower_boundary.empty());
}

TEST_CASE("a zone whose arrays differ in length is refused") {
  const Scratch folder;
  LiquefactionZone z = some_zone();
  z.layer.pop_back();
  CHECK_THROWS_WITH(write_zone(folder / "z.h5", z), Contains("layer has 1 values"));
  z = some_zone();
  z.history.kinetic_energy.pop_back();
  CHECK_THROWS_WITH(write_zone(folder / "z.h5", z), Contains("history/kinetic_energy has 2"));
  z = some_zone();
  z.history.depth[1].pop_back();
  CHECK_THROWS_WITH(write_zone(folder / "z.h5", z), Contains("history/depth"));
}

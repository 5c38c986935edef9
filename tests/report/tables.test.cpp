#include "report/tables.hpp"

#include "core/check.hpp"
#include "report/npy.hpp"
#include "report/section_lines.hpp"
#include "tests/support/limited_files.hpp"
#include "tests/support/scratch.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;

TEST_CASE("runout.csv has a named column per quantity and the speed of the front") {
  std::vector<MpmSample> samples(2);
  samples[1].time = 0.5;
  samples[1].front = 76.25;
  samples[1].runout = 1.25;
  samples[0].front = 75.0;
  samples[1].kinetic = 1.0 / 3.0;
  samples[1].energy_error = kUnset;
  samples[1].load_work = -2.0;
  CHECK(runout_csv(samples, 75.0) ==
        "time_s,runout_m,front_m,front_speed_m_s,kinetic_J_per_m,gravity_work_J_per_m,"
        "strain_energy_J_per_m,plastic_work_J_per_m,friction_work_J_per_m,damping_work_J_per_m,"
        "energy_error,momentum_error,mass_error,max_speed_m_s,dt_s,active_particles,points_left,"
        "mass_left_kg_per_m,kinetic_left_J_per_m,strain_energy_left_J_per_m,"
        "momentum_left_x_N_s_per_m,momentum_left_y_N_s_per_m,load_work_J_per_m,"
        "front_equal_mass_m,front_995_m,front_99_m,front_95_m,height_m\n"
        "0,0,75,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n"
        "0.5,1.25,76.25,2.5,0.3333333333333333,0,0,0,0,0,nan,0,0,0,0,0,0,0,0,0,0,0,-2,0,0,0,0,0\n");
}

TEST_CASE("zone.csv has a depth and its maximum per window") {
  ZoneHistory h;
  h.window_names = {"east pond, low"};
  h.time = {0.0, 1.5};
  h.depth = {{0.0, 4.0}};
  h.depth_max = {{0.0, 6.0}};
  h.depth_any = {{0.0, 7.0}};
  h.depth_interpolated = {{0.0, 4.5}};
  h.sliding_energy = {0.0, 0.125};
  h.kinetic_energy = {1.0, 2.0};
  h.kinetic_energy_relative = {0.5, 0.25};
  h.distortion_gauss = {1.0, 0.97};
  h.distortion_centre = {1.0, 0.99};
  CHECK(zone_csv(h) ==
        "time_s,depth_east_pond__low_m,depth_max_east_pond__low_m,"
        "depth_any_node_east_pond__low_m,depth_interpolated_east_pond__low_m,"
        "kinetic_energy_J_per_m,kinetic_energy_relative_J_per_m,sliding_energy_J_per_m,"
        "distortion_gauss,distortion_centre\n"
        "0,0,0,0,0,1,0.5,0,1,1\n1.5,4,6,7,4.5,2,0.25,0.125,0.97,0.99\n");
  h.distortion_gauss.pop_back();
  CHECK_THROWS_AS(zone_csv(h), InputError);
  h.distortion_gauss.push_back(0.97);
  h.depth_max.clear();
  CHECK_THROWS_AS(zone_csv(h), InputError);
}

TEST_CASE("A table in NumPy's format has an aligned header and its numbers") {
  const Scratch scratch;
  Table table{.columns = 2, .values = {}};
  table.add({1.0, 2.0});
  table.add({-0.5, 1e300});
  write_npy(scratch / "t.npy", table);
  const std::string bytes = read_text_file(scratch / "t.npy");
  CHECK(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length =
      static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  CHECK((10 + length) % 64 == 0);
  CHECK(bytes.substr(10, length).find("'shape': (2, 2)") != std::string::npos);
  REQUIRE(bytes.size() == 10 + length + 4 * sizeof(double));
  CHECK(bytes.substr(10 + length) ==
        std::string(reinterpret_cast<const char*>(table.values.data()), 4 * sizeof(double)));
}

TEST_CASE("Lines of the section: outline and material limits") {
  QuadMesh mesh;
  mesh.nodes = {{0, 0}, {1, 0}, {1, 2}, {0, 2}, {2, 0}, {2, 2}, {3, 0}, {3, 2}};
  mesh.node_tags = {1, 2, 3, 4, 5, 6, 7, 8};
  mesh.elements = {{0, 1, 2, 3}, {1, 4, 5, 2}, {4, 6, 7, 5}};
  mesh.element_tags = {1, 2, 3};
  mesh.element_material = {1, 1, 2};
  const Table outline = outline_segments(mesh);
  REQUIRE(outline.columns == 5);
  REQUIRE(outline.rows() == 9);
  int inner = 0;
  for (std::size_t r = 0; r < outline.rows(); ++r) {
    const double* segment = &outline.values[5 * r];
    if (segment[4] == 1.0) continue;
    ++inner;
    CHECK(segment[0] == 2.0);
    CHECK(segment[2] == 2.0);
  }
  CHECK(inner == 1);
}

TEST_CASE("A table on a full disk is whole or not there") {
  Table table{.columns = 2, .values = {}};
  for (int i = 0; i < 500; ++i) table.add({double(i), 1.0 / (1.0 + i)});
  test::check_limited_files(
      [&](const std::filesystem::path& folder) { write_npy(folder / "t.npy", table); }, 20);
}

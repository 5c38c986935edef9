#include "transfer/zone/zone.hpp"

#include "core/check.hpp"
#include "tests/support/scratch.hpp"
#include "tests/transfer/zone_grid.hpp"
#include "transfer/zone/zone_record.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <catch2/catch.hpp>

using namespace flowslide;

namespace {

constexpr double kBuoyant = 10e3;  // gamma' [Pa/m]
constexpr double kWater = 9.81e3;  // gamma_w [Pa/m]

/// Column of 10 x 10 elements of 1 m, surface at y = 10, hydrostatic; lower two rows of elements
/// are material 2, the rest 1. Frame k has r_u = 0.8 at y >= levels[k] and 0.3 below.
class Column {
 public:
  explicit Column(const std::vector<double>& levels) {
    for (std::size_t e = 0; e < 20; ++e) mesh.element_material[e] = 2;
    FemHistoryWriter writer(path_, mesh, {{"sand", 1, 2000.0}, {"rock", 2, 1500.0}}, {});
    FemFrame gravity = rest();
    writer.set_gravity(gravity);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      FemFrame frame = rest();
      frame.time = 0.5 * static_cast<double>(k + 1);
      for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
        const double depth = 10.0 - mesh.nodes[n][1];
        frame.pore_pressure[n] += (mesh.nodes[n][1] >= levels[k] ? 0.8 : 0.3) * kBuoyant * depth;
        frame.velocity[n] = {2.0, 0.0};
      }
      writer.append(frame);
    }
    writer.finish();
  }
  [[nodiscard]] LiquefactionZone find(const ZoneConfig& config) const {
    return find_zone(FemHistory(path_), config);
  }

  [[nodiscard]] FemHistory history() const { return FemHistory(path_); }

  QuadMesh mesh = rectangle_mesh(10, 10, 1.0, 1.0, 1);

 private:
  [[nodiscard]] FemFrame rest() const {
    FemFrame f;
    f.displacement.resize(mesh.num_nodes());
    f.velocity.resize(mesh.num_nodes());
    for (const Vec2& x : mesh.nodes) f.pore_pressure.push_back(kWater * (10.0 - x[1]));
    f.stress.resize(mesh.num_elements());
    f.strain.resize(mesh.num_elements());
    for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
      f.stress[e][1] = -kBuoyant * (10.0 - centroid(corners(mesh, mesh.nodes, e))[1]);
    }
    return f;
  }

  Scratch folder_;
  std::filesystem::path path_ = folder_ / "history.h5";
};

ZoneConfig column_config() {
  ZoneConfig c;
  c.liquefiable = {"sand"};
  c.pond_surface = 10.0;
  c.windows = {{"left", {0.0, 4.0}}, {"right", {6.0, 10.0}}};
  c.strength.table = {{0.0, 1e3}, {100e3, 11e3}};
  c.strength.bin_width = 20e3;
  c.strength.last_bin = 60e3;
  c.transfer.when = TransferWhen::end;
  return c;
}

}  // namespace

TEST_CASE("an imposed r_u gives its exact depth, zone and strength", "[transfer]") {
  const Column column({7.0, 4.0, 6.0});
  const LiquefactionZone zone = column.find(column_config());
  const ZoneHistory& h = zone.history;
  CHECK(h.time == std::vector<double>{0.5, 1.0, 1.5});
  for (std::size_t w = 0; w < 2; ++w) {
    CHECK(h.depth[w] == std::vector<double>{3.0, 6.0, 4.0});
    CHECK(h.depth_max[w] == std::vector<double>{3.0, 6.0, 6.0});
    CHECK(zone.window_depth_max[w] == 6.0);
  }
  CHECK(zone.window_names == std::vector<std::string>{"left", "right"});
  CHECK(zone.transfer_frame == 2);
  CHECK(zone.transfer_time == 1.5);

  for (std::size_t e = 0; e < column.mesh.num_elements(); ++e) {
    const double y = centroid(corners(column.mesh, column.mesh.nodes, e))[1];
    const double sigma = kBuoyant * (10.0 - y);
    CHECK(zone.sigma_v0[e] == Approx(sigma));
    CHECK(zone.liquefied[e] == (y > 4.0));
    if (y > 4.0) {
      CHECK(zone.strength[e] == Approx(1e3 + 0.1 * sigma));
      CHECK(zone.layer[e] == static_cast<int>(sigma / 20e3));
    } else {
      CHECK_FALSE(is_set(zone.strength[e]));
      CHECK(zone.layer[e] == -1);
    }
  }
  // The surface nodes have half an element's stress, 5 kPa, below the floor of 8 kPa.
  CHECK_FALSE(is_set(zone.r_u_node[120]));
  CHECK(zone.r_u_node[5 * 11] == Approx(0.8));
  CHECK(zone.notes.front().substr(0, 8) == "11 nodes");
  // r_u falls from 0.8 to 0.3 in a metre: through 0.7 at a fifth of it.
  for (const Vec2& p : zone.lower_boundary) CHECK(p[1] == Approx(3.8));
  for (const std::vector<double>* depth : {&zone.window_depth_any, &zone.window_depth_strong})
    CHECK((*depth)[0] == 6.0);
  CHECK(zone.window_depth_interpolated[0] == Approx(6.2));
}

TEST_CASE("soil above liquefied soil can keep its strength", "[transfer]") {
  // Liquefied from y = 4 to 7, an r_u of 0.2 above.
  const Column column({4.0});
  const Scratch folder;
  const auto path = folder / "history.h5";
  {
    const FemHistory whole = column.history();
    FemHistoryWriter writer(path, column.mesh, {{"sand", 1, 2000.0}, {"rock", 2, 1500.0}}, {});
    writer.set_gravity(whole.gravity());
    FemFrame frame = whole.frame(0);
    for (std::size_t n = 0; n < column.mesh.num_nodes(); ++n)
      if (const double y = column.mesh.nodes[n][1]; y > 7.5)
        frame.pore_pressure[n] -= 0.6 * kBuoyant * (10.0 - y);
    writer.append(frame);
    writer.finish();
  }
  ZoneConfig config = column_config();
  const LiquefactionZone all = find_zone(FemHistory(path), config);
  config.zone = ZoneExtent::liquefied;
  const LiquefactionZone only = find_zone(FemHistory(path), config);
  CHECK(only.lower_boundary == all.lower_boundary);
  CHECK(only.window_depth_max == all.window_depth_max);
  for (std::size_t e = 0; e < column.mesh.num_elements(); ++e) {
    const double y = centroid(corners(column.mesh, column.mesh.nodes, e))[1];
    CAPTURE(y);
    CHECK((all.liquefied[e] == 1) == (y > 4.0));
    CHECK((only.liquefied[e] == 1) == (y > 4.0 && y < 7.0));
    CHECK(is_set(only.strength[e]) == (only.liquefied[e] == 1));
  }
}

TEST_CASE("depths and times are the same whether soil above keeps its strength or not",
          "[transfer]") {
  const Column column({7.0, 4.0, 6.0});
  ZoneConfig config = column_config();
  const LiquefactionZone all = column.find(config);
  config.zone = ZoneExtent::liquefied;
  const LiquefactionZone only = column.find(config);
  CHECK(only.window_depth_max == all.window_depth_max);
  CHECK(only.window_depth_any == all.window_depth_any);
  CHECK(only.window_depth_interpolated == all.window_depth_interpolated);
  CHECK(only.window_depth_interpolated[0] == Approx(6.2));
  CHECK(only.window_depth_strong == all.window_depth_strong);
  CHECK(only.window_depth_before_slide == all.window_depth_before_slide);
  CHECK(only.strong_shaking_end == 1.5);
  CHECK(all.strong_shaking_end == 1.5);
  // A zone that is drawn has its own depths, but the shaking is the same.
  config.zone = ZoneExtent::line;
  config.line = {{0.0, 5.0}, {10.0, 5.0}};
  const LiquefactionZone drawn = column.find(config);
  CHECK(drawn.window_depth_max == std::vector<double>{5.0, 5.0});
  CHECK(drawn.strong_shaking_end == 1.5);
}

TEST_CASE("averages over less than the recording interval are named", "[transfer]") {
  const Column column({7.0, 4.0, 6.0});  // every 0.5 s
  const auto notes = [&](double smoothing, double sustain) {
    ZoneConfig config = column_config();
    config.transfer.automatic.smoothing = smoothing;
    config.transfer.automatic.sustain = sustain;
    std::vector<std::string> found;
    for (const std::string& note : column.find(config).notes)
      if (note.starts_with("automatic.")) found.push_back(note);
    return found;
  };
  CHECK(notes(1.0, 1.0).empty());
  CHECK(notes(0.0, 0.0).empty());  // as asked for
  CHECK(notes(0.51, 0.5).empty());
  REQUIRE(notes(0.5, 0.4).size() == 2);
  CHECK_THAT(notes(0.5, 1.0)[0], Catch::StartsWith("automatic.smoothing: 0.5 s is not above"));
  CHECK_THAT(notes(1.0, 0.1)[0], Catch::StartsWith("automatic.sustain: 0.1 s"));
}

TEST_CASE("a record that ends before the motion is named", "[transfer]") {
  const auto told = [](double frequency_of_decay) {
    const Column column(std::vector<double>(20, 7.0));
    const Scratch folder;
    const auto path = folder / "history.h5";
    const FemHistory history = column.history();
    FemHistoryWriter writer(path, column.mesh, {{"sand", 1, 2000.0}, {"rock", 2, 1500.0}}, {});
    writer.set_gravity(history.gravity());
    for (std::size_t k = 0; k < 20; ++k) {
      FemFrame frame = history.frame(k);
      const double v = std::exp(-frequency_of_decay * frame.time);
      for (auto& velocity : frame.velocity) velocity = {k % 2 == 0 ? v : -v, 0.0};
      writer.append(frame);
    }
    writer.finish();
    const LiquefactionZone zone = find_zone(FemHistory(path), column_config());
    return std::ranges::count_if(
        zone.notes, [](const std::string& n) { return n.starts_with("the record ends at 10 s"); });
  };
  CHECK(told(0.0) == 1);
  CHECK(told(1.0) == 0);  // the whole motion, and its coda
}

TEST_CASE("the zone of the moment can be asked for", "[transfer]") {
  ZoneConfig config = column_config();
  config.r_u.over_time = RuOverTime::instantaneous;
  const LiquefactionZone zone = Column({7.0, 4.0, 6.0}).find(config);
  for (const Vec2& p : zone.lower_boundary) CHECK(p[1] == Approx(5.8));
  CHECK(std::ranges::count(zone.liquefied, 1) == 40);
}

TEST_CASE("only frames up to the transfer count", "[transfer]") {
  ZoneConfig config = column_config();
  config.transfer = {.when = TransferWhen::at, .at = 0.7};
  const LiquefactionZone zone = Column({7.0, 4.0, 6.0}).find(config);
  CHECK(zone.transfer_frame == 0);
  CHECK(zone.window_depth_max[0] == 3.0);
  CHECK(std::ranges::count(zone.liquefied, 1) == 30);
  CHECK(zone.history.time.size() == 3);
}

TEST_CASE("energy and distortion of a rigid translation", "[transfer]") {
  const LiquefactionZone zone = Column({7.0}).find(column_config());
  CHECK(zone.history.kinetic_energy[0] == Approx(0.5 * (80.0 * 2000.0 + 20.0 * 1500.0) * 4.0));
  CHECK(zone.history.kinetic_energy_relative[0] == Approx(0.0).margin(1e-9));
  CHECK(zone.history.distortion_gauss[0] == 1.0);
  CHECK(zone.history.distortion_centre[0] == 1.0);
}

TEST_CASE("a slide on yielded soil is found without liquefaction; strain of gravity is no yielding",
          "[transfer]") {
  const FemHistory history = Column({0.0}).history();
  ZoneConfig config = column_config();
  config.transfer.when = TransferWhen::automatic;
  FemFrame gravity = history.gravity();
  // recorders that ran through the gravity stage: 4.5 % of consolidation everywhere
  for (auto& strain : gravity.strain) strain[1] = -0.045;
  for (const bool yields : {true, false}) {
    ZoneRecorder recorder(history.mesh(), history.materials(), gravity, config);
    for (int i = 1; i <= 300; ++i) {
      FemFrame frame = gravity;
      frame.time = 0.1 * i;
      const double shaken = frame.time < 15.0 ? 0.05 * std::sin(4.0 * frame.time) : 0.0;
      const double slid = 0.05 * std::pow(std::max(0.0, frame.time - 15.0), 2);
      for (std::size_t n = 0; n < frame.displacement.size(); ++n)
        frame.displacement[n] = {shaken + (history.mesh().nodes[n][1] > 5.5 ? slid : 0.0), 0.0};
      if (yields && frame.time > 12.0)  // the row between 5 and 6 m
        for (std::size_t e = 50; e < 60; ++e) frame.strain[e][3] = 0.06;
      recorder.append(frame);
    }
    const auto onset = recorder.onset();
    CHECK(onset.has_value() == yields);
    if (onset) CHECK(recorder.history().time[*onset] == Approx(15.5).margin(0.8));
  }
}

TEST_CASE("the box leaves columns out of zone and energy", "[transfer]") {
  ZoneConfig config = column_config();
  config.box.left = 2.0;
  config.box.bottom = 2.0;
  const LiquefactionZone zone = Column({4.0}).find(config);
  CHECK(zone.history.kinetic_energy[0] == Approx(0.5 * 64.0 * 2000.0 * 4.0));
  CHECK(std::ranges::count(zone.liquefied, 1) == 6 * 8);
  CHECK(zone.liquefied[99] == 1);
  CHECK(zone.liquefied[90] == 0);
}

TEST_CASE("a gravity state is transferred with a zone given by the user", "[transfer]") {
  ZoneConfig config = column_config();
  config.transfer.when = TransferWhen::gravity;
  config.zone = ZoneExtent::all;
  const Column column({});
  const LiquefactionZone all = column.find(config);
  CHECK(all.transfer_frame == -1);
  CHECK(all.transfer_time == 0.0);
  CHECK(all.history.time.empty());
  CHECK(all.history.kinetic_energy.empty());
  CHECK(std::ranges::count(all.liquefied, 1) == 80);
  CHECK(all.window_depth_max == std::vector<double>{8.0, 8.0});
  CHECK(all.r_u_node[60] == 0.0);

  config.zone = ZoneExtent::line;
  config.line = {{0.0, 4.99}, {10.0, 2.99}};
  const LiquefactionZone line = column.find(config);
  CHECK(line.window_depth_max == std::vector<double>{5.0, 7.0});
  CHECK(line.lower_boundary == std::vector<Vec2>{{0.0, 4.99}, {10.0, 2.99}});
  // The row at 4.5 is above the line from x = 2.5 on, the row at 3.5 from x = 7.5 on.
  CHECK(std::ranges::count(line.liquefied, 1) == 50 + 8 + 3);

  config.zone = ZoneExtent::polygon;
  config.line.clear();
  config.polygon = {{0.0, 6.0}, {5.0, 6.0}, {5.0, 10.0}, {0.0, 10.0}};
  const LiquefactionZone polygon = column.find(config);
  CHECK(std::ranges::count(polygon.liquefied, 1) == 20);
  CHECK(polygon.window_depth_max == std::vector<double>{4.0, 0.0});
}

TEST_CASE("stress outside the strength table is noted", "[transfer]") {
  ZoneConfig config = column_config();
  config.strength.table = {{20e3, 1e3}, {40e3, 2e3}};
  const LiquefactionZone zone = Column({4.0}).find(config);
  // 5 and 15 kPa below, 45 and 55 kPa above.
  REQUIRE(zone.notes.size() == 2);
  CHECK_THAT(zone.notes[1],
             Catch::StartsWith("most of the zone: 40 of 60") && Catch::Contains("20 to 40 kPa"));
}

TEST_CASE("a material can have a strength table of its own", "[transfer]") {
  ZoneConfig config = column_config();
  config.liquefiable = {"sand", "rock"};
  config.zone = ZoneExtent::all;
  config.strength.materials["rock"].table = {{0.0, 2e3}, {100e3, 22e3}};
  const Column column({4.0});
  const LiquefactionZone zone = column.find(config);
  for (std::size_t e = 0; e < column.mesh.num_elements(); ++e) {
    const double common = 1e3 + 0.1 * zone.sigma_v0[e];
    CHECK(zone.strength[e] == Approx(column.mesh.element_material[e] == 2 ? 2.0 * common : common));
  }
  config.liquefiable = {"sand"};
  CHECK_THROWS_WITH(check(config), Catch::Contains("rock is not among liquefiable (sand)"));
  config.liquefiable = {"sand", "rock"};
  config.strength.materials["rock"].table.clear();
  CHECK_THROWS_WITH(check(config), Catch::Contains("strength.materials.rock.table is empty"));
}

TEST_CASE("residual strength above the effective stress of its element is noted", "[transfer]") {
  ZoneConfig config = column_config();
  config.strength.table = {{0.0, 8e3}, {100e3, 8e3}};
  const LiquefactionZone zone = Column({4.0}).find(config);
  // 5 kPa in the uppermost row only
  CHECK_THAT(zone.notes.back(), Catch::StartsWith("10 of 60 liquefied elements have a residual") &&
                                    Catch::Contains("8 kPa at 5 kPa"));
  const LiquefactionZone weak = Column({4.0}).find(column_config());
  for (const std::string& note : weak.notes) CHECK_THAT(note, !Catch::Contains("residual"));
}

TEST_CASE("nothing liquefied is a zone of nothing, and says so", "[transfer]") {
  const LiquefactionZone zone = Column({11.0}).find(column_config());
  CHECK(std::ranges::count(zone.liquefied, 1) == 0);
  CHECK(zone.window_depth_max[0] == 0.0);
  CHECK_THAT(zone.notes.back(), Catch::Contains("no element has liquefied"));
}

TEST_CASE("settings that do not fit the mesh or each other are refused", "[transfer]") {
  const Column column({4.0});
  const ZoneConfig good = column_config();
  const auto with = [&column, &good](auto change) {
    ZoneConfig c = good;
    change(c);
    return column.find(c);
  };
  CHECK_THROWS_WITH(with([](ZoneConfig& c) { c.liquefiable = {"clay"}; }),
                    Catch::Contains("no material 'clay' (known: sand, rock)"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) { c.liquefiable = {"1"}; }),
                    Catch::Contains("liquefiable: 1 is a tag") && Catch::Contains("write sand"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) {
                      c.windows = {{"pond", {-70.0, -50.0}}};
                    }),
                    Catch::Contains("windows.pond") && Catch::Contains("-70 m to -50 m"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) {
                      c.windows = {{"pond", {4.0, 1.0}}};
                    }),
                    Catch::Contains("exchange them"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) { c.box.left = 50.0; }),
                    Catch::Contains("no liquefiable element lies in it") &&
                        Catch::Contains("which spans x = 0 to"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) { c.base_nodes = {4711}; }),
                    Catch::Contains("no node 4711"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) { c.transfer.when = TransferWhen::gravity; }),
                    Catch::Contains("write zone: all"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) { c.zone = ZoneExtent::line; }),
                    Catch::Contains("at least 2 points"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) {
                      c.line = {{0, 1}, {2, 1}};
                    }),
                    Catch::Contains("write zone: line"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) { c.pond_surface = kUnset; }),
                    Catch::Contains("pond_surface"));
  CHECK_THROWS_WITH(with([](ZoneConfig& c) { c.transfer = {.when = TransferWhen::at, .at = 7.0}; }),
                    Catch::Contains("outside the record"));
}

TEST_CASE("a single node decides the depth of single nodes only, and r_u above 1.2 is named",
          "[transfer]") {
  const Column column({7.0});
  const Scratch folder;
  const auto path = folder / "history.h5";
  const FemHistory calm = column.history();
  FemHistoryWriter writer(path, column.mesh, {{"sand", 1, 2000.0}, {"rock", 2, 1500.0}}, {});
  writer.set_gravity(calm.gravity());
  FemFrame frame = calm.frame(0);
  frame.pore_pressure[3 * 11 + 1] += 1.5 * kBuoyant * 7.0;  // at (1, 3), 0.3 before
  writer.append(frame);
  writer.finish();
  const LiquefactionZone zone = find_zone(FemHistory(path), column_config());
  CHECK(zone.window_depth_any[0] == 7.0);
  CHECK(zone.window_depth_max[0] == 3.0);
  CHECK(zone.window_depth_interpolated[0] == Approx(3.2));
  CHECK(zone.window_depth_any[1] == 3.0);
  const auto named = std::ranges::find_if(
      zone.notes, [](const std::string& n) { return n.starts_with("r_u reaches 1.8 at node 35"); });
  CHECK(named != zone.notes.end());
  const auto silent = [](const LiquefactionZone& z) {
    return std::ranges::none_of(z.notes,
                                [](const std::string& n) { return n.starts_with("r_u reaches"); });
  };
  CHECK(silent(column.find(column_config())));

  // What comes after the transfer does not enlarge the zone.
  const auto later = folder / "later.h5";
  FemHistoryWriter both(later, column.mesh, {{"sand", 1, 2000.0}, {"rock", 2, 1500.0}}, {});
  both.set_gravity(calm.gravity());
  both.append(calm.frame(0));
  frame.time += 1.0;
  both.append(frame);
  both.finish();
  ZoneConfig at_first = column_config();
  at_first.transfer.when = TransferWhen::at;
  at_first.transfer.at = calm.frame(0).time;
  CHECK(silent(find_zone(FemHistory(later), at_first)));
  at_first.transfer.at = frame.time;
  CHECK_FALSE(silent(find_zone(FemHistory(later), at_first)));
}

TEST_CASE("Without windows the depth is that of the whole liquefiable soil", "[transfer]") {
  const Column column({7.0, 4.0, 6.0});
  ZoneConfig config = column_config();
  config.windows.clear();
  const LiquefactionZone zone = column.find(config);
  CHECK(zone.window_names == std::vector<std::string>{"all"});
  const LiquefactionZone two = column.find(column_config());
  CHECK(zone.window_depth_max.at(0) == std::max(two.window_depth_max[0], two.window_depth_max[1]));
  CHECK(zone.window_depth_max.at(0) > 0.0);
}

TEST_CASE("Soil without water at rest that lies in the zone is told", "[transfer]") {
  const Column column({4.0});
  const Scratch folder;
  const auto path = folder / "history.h5";
  FemFrame gravity = column.history().gravity(), frame = column.history().frame(0);
  for (std::size_t n = 0; n < column.mesh.num_nodes(); ++n)
    if (column.mesh.nodes[n][1] >= 8.0) gravity.pore_pressure[n] = frame.pore_pressure[n] = 0.0;
  FemHistoryWriter writer(path, column.mesh, {{"sand", 1, 2000.0}, {"rock", 2, 1500.0}}, {});
  writer.set_gravity(gravity);
  writer.append(frame);
  writer.finish();
  const auto told = [](const LiquefactionZone& zone, std::string_view begin) {
    return std::ranges::any_of(zone.notes,
                               [&](const std::string& n) { return n.starts_with(begin); });
  };
  ZoneConfig config = column_config();
  CHECK(told(find_zone(FemHistory(path), config), "dry soil: 20 of the 60 m2 of the zone"));
  config.zone = ZoneExtent::liquefied;
  CHECK_FALSE(told(find_zone(FemHistory(path), config), "dry soil"));
  CHECK_FALSE(told(column.find(column_config()), "dry soil"));
}

#include "workflows/stages/fem_run.hpp"

#include "model/history.hpp"
#include "model/zone.hpp"
#include "tests/support/scratch.hpp"
#include "workflows/engine/result_folder.hpp"
#include "workflows/engine/runner.hpp"
#include "workflows/stages/stage_list.hpp"

#include <cstring>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;
using Catch::Contains;

namespace {

constexpr const char* kShaking = R"(schema: 1
name: column
stages:
  motion:
    uses: motion.prepare
    with: {synthetic: {pga: 0.3 g, tm: 0.5 s, d5_95: 2 s, lead: 0 s}}
  mesh:
    uses: mesh.section
    with:
      size: 2 m
      materials: {sand: {tag: 5}}
      blocks: {sand: {outline: [[0 m, 0 m], [8 m, 0 m], [8 m, 6 m], [0 m, 6 m]], material: sand}}
  shake:
    uses: fem.run
    in: {mesh: mesh.mesh, motion: motion.motion}
    with:
      end: 2 s
      materials:
        sand:
          density: 1900 kg/m3
          void_ratio: 0.8
          permeability: [1e-5 m/s, 1e-5 m/s]
          pm4sand: {Dr: 0.35, G0: 476, hpo: 0.53}
      water: {table: [[0 m, 6 m]]}
      output_interval: 0.25 s
      base: {motion: within}
)";

constexpr const char* kImport = R"(schema: 1
name: again
stages:
  shake:
    uses: import.opensees
    with:
      mesh: {nodes: run/recorders/nodeinfo.dat, elements: run/recorders/elementinfo.dat}
      materials: {sand: {tag: 5, density: 1900 kg/m3}}
      units: {length: m, time: s, stress: kPa}
      gravity:
        stress: run/recorders/Gstress.out
        strain: run/recorders/Gstrain.out
        pore_pressure: run/recorders/GporePressure.out
      shaking:
        displacement: run/recorders/displacement.out
        velocity: run/recorders/velocity.out
        pore_pressure: run/recorders/porePressure.out
        stress: run/recorders/stress.out
        strain: run/recorders/strain.out
      sigma_zz: {rule: mean}
)";

struct Case {
  Scratch scratch;
  Workflow load(const char* text, const std::vector<std::string>& set = {}) const {
    return load_workflow(scratch.write("case.yaml", text), set, all_stages());
  }
  void run(const char* text, const std::string& folder,
           const std::vector<std::string>& set = {}) const {
    run_workflow(load(text, set), {.folder = scratch / folder}, {});
  }
  /// history.h5 of the stage `shake`.
  [[nodiscard]] std::filesystem::path history(const char* text, const std::string& folder,
                                              const std::vector<std::string>& set = {}) const {
    const auto plan = plan_workflow(load(text, set), scratch / folder);
    return result_folder(scratch / folder, "shake", plan.back().decision.key) / "history.h5";
  }
};

template <class A>
double largest_difference(const std::vector<A>& a, const std::vector<A>& b) {
  REQUIRE(a.size() == b.size());
  double d = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < sizeof(A) / sizeof(double); ++k) {
      d = std::max(d, std::abs(reinterpret_cast<const double*>(&a[i])[k] -
                               reinterpret_cast<const double*>(&b[i])[k]));
      largest = std::max(largest, std::abs(reinterpret_cast<const double*>(&a[i])[k]));
    }
  return largest > 0.0 ? d / largest : d;
}

}  // namespace

TEST_CASE("text recorders of fem.run come back through import.opensees", "[workflows]") {
  const Case c;
  const std::vector<std::string> on{"stages.shake.with.opensees_recorders=true"};
  c.run(kShaking, "run", on);
  c.run(kImport, "again");
  const FemHistory before(c.history(kShaking, "run", on)), after(c.history(kImport, "again"));
  CHECK(after.mesh().nodes == before.mesh().nodes);
  CHECK(after.mesh().elements == before.mesh().elements);
  CHECK(after.mesh().element_material == before.mesh().element_material);
  REQUIRE(after.times() == before.times());
  REQUIRE(before.times().size() == 8);
  // Pa to kPa and back may turn the last bit.
  CHECK(largest_difference(before.gravity().stress, after.gravity().stress) < 1e-15);
  for (std::size_t i = 0; i < before.times().size(); ++i) {
    const FemFrame a = before.frame(i), b = after.frame(i);
    CHECK(a.displacement == b.displacement);
    CHECK(a.velocity == b.velocity);
    CHECK(largest_difference(a.strain, b.strain) == 0.0);
    CHECK(largest_difference(a.stress, b.stress) < 1e-15);
    CHECK(largest_difference(a.pore_pressure, b.pore_pressure) < 1e-15);
  }
  CHECK(largest_difference(before.frame(7).stress, before.frame(6).stress) > 1e-3);  // control
}

TEST_CASE("fem.run writes no text recorders unless asked", "[workflows]") {
  const Case c;
  c.run(kShaking, "run", {"stages.shake.with.end=0.25 s"});
  CHECK_FALSE(std::filesystem::exists(c.scratch / "run/recorders"));
}

TEST_CASE("a shaking that ends before its motion has shaken is warned about", "[workflows]") {
  const Case c;
  const auto warnings = [&](const char* end) {
    c.run(kShaking, "run", {std::string("stages.shake.with.end=") + end});
    std::ifstream file(c.scratch / "run/result.json");
    return nlohmann::json::parse(file)["warnings"].dump();
  };
  CHECK_THAT(warnings("0.25 s"), Contains("shake: end: the shaking ends at 0.25 s, but 95 %"));
  CHECK_THAT(warnings("null"), !Contains("95 %"));
}

TEST_CASE("a shaking can end where its motion has shaken", "[workflows]") {
  // Half a second of rest, ten seconds of one g to and fro, and rest again: the Arias intensity
  // grows by a tenth each second.
  GroundMotion motion{.dt = 0.01, .acceleration = std::vector<double>(3001, 0.0), .origin = "box"};
  for (std::size_t i = 51; i <= 1050; ++i) motion.acceleration[i] = i % 2 == 0 ? 9.81 : -9.81;
  FemRunConfig config;
  config.output_interval = 0.25;
  CHECK_FALSE(end_of(config, motion));
  config.end_with_motion = EndWithMotionConfig{.arias = 0.5, .after = 0.0};
  CHECK(*end_of(config, motion) == 5.75);  // half at 5.5 s and a sample's width
  config.end_with_motion = EndWithMotionConfig{.arias = 0.2, .after = 2.7};
  CHECK(*end_of(config, motion) == 5.25);
  config.end_with_motion = EndWithMotionConfig{.arias = 0.995, .after = 60.0};
  CHECK(*end_of(config, motion) == motion.duration());
  config.end_with_motion.reset();
  config.end = 3.0;
  CHECK(*end_of(config, motion) == 3.0);
}

TEST_CASE("fem.run follows its motion as it would a time that is typed", "[workflows]") {
  const Case c;
  const std::vector<std::string> rule{
      "stages.shake.with.end=null",
      "stages.shake.with.end_with_motion={arias: 0.01, after: 0.1 s}"};
  c.run(kShaking, "run", rule);
  std::ifstream file(c.scratch / "run/result.json");
  const double end = nlohmann::json::parse(file)["fem_end_s"].get<double>();
  CHECK(end < 2.0);
  const std::vector<std::string> typed{fmt::format("stages.shake.with.end={} s", end)};
  c.run(kShaking, "typed", typed);
  const FemHistory a(c.history(kShaking, "run", rule)), b(c.history(kShaking, "typed", typed));
  REQUIRE(a.times() == b.times());
  CHECK(a.frame(a.times().size() - 1).displacement == b.frame(b.times().size() - 1).displacement);
  CHECK_THROWS_WITH(
      c.load(kShaking, {"stages.shake.with.end_with_motion={arias: 0.5, after: 0 s}"}),
      Contains("end and end_with_motion: both are given"));
}

TEST_CASE("a workflow that is interrupted in fem.run continues there", "[workflows]") {
  const Case c;
  std::atomic<bool> stop = false;
  RunEvents events;
  events.progress = [&](std::string_view stage, double fraction, std::string_view) {
    stop = stage == "shake" && fraction > 0.4;
  };
  const RunOptions options{.folder = c.scratch / "parts", .stop_requested = &stop};
  try {
    run_workflow(c.load(kShaking), options, events);
    FAIL("was not interrupted");
  } catch (const Error& e) {
    CHECK(e.exit_code() == 130);
    CHECK_THAT(e.what(), Contains("continues from there"));
  }
  stop = false;
  const auto plan = plan_workflow(c.load(kShaking), c.scratch / "parts");
  CHECK(plan.back().decision.action == Action::resume);
  run_workflow(c.load(kShaking), {.folder = c.scratch / "parts"}, {});
  c.run(kShaking, "whole");
  CHECK(read_text_file(c.history(kShaking, "parts")) ==
        read_text_file(c.history(kShaking, "whole")));
  const auto facts = [&](const char* folder) {
    auto j = nlohmann::json::parse(read_text_file(c.scratch / folder / "result.json"));
    j.erase("fem_seconds");
    nlohmann::json kept;
    for (const auto& [key, value] : j.items())
      if (key.starts_with("fem_")) kept[key] = value;
    return kept;
  };
  CHECK(facts("parts").size() > 10);
  CHECK(facts("parts") == facts("whole"));
}

namespace {

/// A steep slope of loose sand; with the settings of the zone for both stages.
std::string slope(bool stops, const char* pga) {
  const std::string rule = R"(
      liquefiable: [sand]
      pond_surface: 9 m
      windows: {all: {from: 0 m, to: 20 m}}
      r_u: {floor: 4 kPa}
      automatic: {smoothing: 0.4 s, growth: 1, sustain: 0.1 s, distortion_limit: 0.99}
)";
  const std::string nested = "      stop_at_transfer: \"${stages.zone.with}\"";
  return fmt::format(R"(schema: 1
name: slope
stages:
  motion:
    uses: motion.prepare
    with: {{synthetic: {{pga: {}, tm: 0.5 s, d5_95: 4 s, lead: 0 s}}}}
  mesh:
    uses: mesh.section
    with:
      size: 4 m
      materials: {{sand: {{tag: 5}}}}
      blocks:
        sand: {{outline: [[0 m, 0 m], [24 m, 0 m], [24 m, 1 m], [0 m, 9 m]], material: sand}}
  shake:
    uses: fem.run
    in: {{mesh: mesh.mesh, motion: motion.motion}}
    with:
      end: 5 s
      output_interval: 0.1 s
      courant: 0.9
      materials:
        sand:
          density: 1900 kg/m3
          void_ratio: 0.8
          permeability: [1e-5 m/s, 1e-5 m/s]
          pm4sand: {{Dr: 0.35, G0: 476, hpo: 0.53}}
      water: {{table: [[0 m, 9 m], [24 m, 1 m]]}}
      base: {{motion: within}}
{}
  zone:
    uses: transfer.zone
    in: {{history: shake.history}}
    with:{}
      strength: {{table: [[1 kPa, 1 kPa], [100 kPa, 9 kPa]]}}
)",
                     pga, stops ? nested : std::string(), rule);
}

std::filesystem::path zone_file(const Case& c, const std::string& text, const std::string& folder) {
  const auto plan = plan_workflow(c.load(text.c_str()), c.scratch / folder);
  return result_folder(c.scratch / folder, "zone", plan.back().decision.key) / "zone.h5";
}

std::filesystem::path shake_file(const Case& c, const std::string& text,
                                 const std::string& folder) {
  const auto plan = plan_workflow(c.load(text.c_str()), c.scratch / folder);
  return result_folder(c.scratch / folder, "shake", plan[plan.size() - 2].decision.key) /
         "history.h5";
}

}  // namespace

TEST_CASE("shaking stopped by the rule of the transfer gives the same zone", "[workflows]") {
  const Case c;
  const std::string all = slope(false, "0.4 g"), part = slope(true, "0.4 g");
  c.run(all.c_str(), "all");
  c.run(part.c_str(), "part");
  const FemHistory whole(shake_file(c, all, "all")), stopped(shake_file(c, part, "part"));
  CHECK(whole.times().size() == 50);
  REQUIRE(stopped.times().size() < 40);
  const std::size_t last = stopped.times().size() - 1;
  CHECK(stopped.frame(last).displacement == whole.frame(last).displacement);
  const LiquefactionZone a = read_zone(zone_file(c, all, "all"));
  const LiquefactionZone b = read_zone(zone_file(c, part, "part"));
  CHECK(b.transfer_time == a.transfer_time);
  CHECK(b.transfer_frame == a.transfer_frame);
  CHECK(b.transfer_frame < static_cast<int>(last));  // the rule, not the end of the record
  const auto same = [](const std::vector<double>& x, const std::vector<double>& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
  };
  CHECK(same(b.r_u_node, a.r_u_node));
  CHECK(same(b.strength, a.strength));
  CHECK(b.liquefied == a.liquefied);
  CHECK(std::ranges::count(a.liquefied, 1) > 0);
  CHECK(b.lower_boundary == a.lower_boundary);
  CHECK(b.window_depth_max == a.window_depth_max);

  // interrupted on the way, the rule goes on with what it knew
  std::atomic<bool> stop = false;
  RunEvents events;
  events.progress = [&](std::string_view stage, double fraction, std::string_view) {
    stop = stage == "shake" && fraction > 0.3;
  };
  const RunOptions options{.folder = c.scratch / "pieces", .stop_requested = &stop};
  CHECK_THROWS(run_workflow(c.load(part.c_str()), options, events));
  run_workflow(c.load(part.c_str()), {.folder = c.scratch / "pieces"}, {});
  CHECK(read_text_file(shake_file(c, part, "pieces")) ==
        read_text_file(shake_file(c, part, "part")));
}

TEST_CASE("shaking that never fails runs to its end, whatever may stop it", "[workflows]") {
  const Case c;
  const std::string all = slope(false, "0.02 g"), part = slope(true, "0.02 g");
  c.run(all.c_str(), "all");
  c.run(part.c_str(), "part");
  CHECK(read_text_file(shake_file(c, part, "part")) == read_text_file(shake_file(c, all, "all")));
  CHECK(read_text_file(zone_file(c, part, "part")) == read_text_file(zone_file(c, all, "all")));
}

namespace {

std::string refusal(const Case& c, const std::string& text,
                    const std::vector<std::string>& set = {}) {
  try {
    (void)c.load(text.c_str(), set);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a transfer after the end of the motion is refused before anything runs", "[workflows]") {
  const Case c;
  // 3.5 times the significant duration of 4 s, rounded up to a length that transforms well
  for (const bool stops : {false, true}) {
    const std::string text = slope(stops, "0.4 g");
    const auto at = [&](const char* time) {
      return refusal(c, text,
                     {"stages.shake.with.end=null", "stages.zone.with.when=at",
                      std::string("stages.zone.with.at=") + time});
    };
    const std::string error = at("100 s");
    CHECK_THAT(error, Contains("at: 100 s, but the shaking ends at 14") &&
                          Contains(stops ? "shake.with.stop_at_transfer.at" : "zone.with.at"));
    CHECK(std::count(error.begin(), error.end(), '\n') == 0);  // told once
    CHECK(at("13 s") == "no error");
  }
  // the end of fem.run goes before that of the motion
  const auto with_end = [&](const char* end) {
    return refusal(c, slope(false, "0.4 g"),
                   {std::string("stages.shake.with.end=") + end, "stages.zone.with.when=at",
                    "stages.zone.with.at=13 s"});
  };
  CHECK_THAT(with_end("5 s"), Contains("the shaking ends at 5 s"));
  CHECK(with_end("20 s") == "no error");
}

TEST_CASE("a window outside the soil is told with the line on which it stands", "[workflows]") {
  const Case c;
  for (const bool stops : {false, true}) {
    std::string text = slope(stops, "0.4 g");
    const std::size_t at = text.find("{from: 0 m, to: 20 m}");
    text.replace(at, 21, "{from: 40 m, to: 50 m}");
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
    const std::string error = refusal(c, text);
    CHECK_THAT(error, Contains(fmt::format("case.yaml:{}:", line)) &&
                          Contains(stops ? "stages.shake.with.stop_at_transfer.windows.all: no node"
                                         : "stages.zone.with.windows.all: no node"));
    if (stops)
      CHECK_THAT(error, Contains("(the value comes from ${stages.zone.with.windows.all})"));
  }
}

#include "report/facts.hpp"

#include "model/outline.hpp"
#include "report/markdown_outcome.hpp"
#include "tests/report/dam_case.hpp"
#include "tests/support/scratch.hpp"

#include <tuple>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace flowslide;

namespace {

struct Case {
  Scratch scratch;
  ParticleSet particles = dam_case::particles();
  ReportConfig config;
  FinalState end;
  ReportFacts facts;

  explicit Case(const dam_case::Flow& flow, const ReportConfig& c = {}) : config(c) {
    dam_case::write_flow(scratch / "mpm.h5", particles, flow);
    const MpmHistory history(scratch / "mpm.h5");
    end = final_state(particles, history, config);
    facts = compute_facts(dam_case::zone(dam_case::mesh(), true), history, end, config);
  }
  [[nodiscard]] bool warns_of(const std::string& text) const {
    for (const std::string& warning : facts.warnings)
      if (warning.find(text) != std::string::npos) return true;
    return false;
  }
};

}  // namespace

TEST_CASE("Facts of a known flow") {
  ReportConfig config;
  config.toe = dam_case::kToe;
  config.regions["lower dam"].outline = {{0, 0}, {75, 0}, {35.42, 11.9}, {20, 11.9}};
  const Case c({}, config);
  double volume = 0.0, counted = 0.0, deepest = 1e9, far = -1e9;
  std::vector<double> x;
  for (std::size_t i = 0; i < c.particles.size(); ++i) {
    if (c.particles.material[i] == 0) continue;
    const auto& from = c.particles.position[i];
    const auto to = dam_case::flowed(from, 200.0, 1.0);
    x.push_back(to[0]);
    far = std::max(far, to[0]);
    counted += c.particles.volume[i];
    if (std::hypot(to[0] - from[0], to[1] - from[1]) <= 1.0) continue;
    volume += c.particles.volume[i];
    deepest = std::min(deepest, from[1]);
  }
  std::sort(x.rbegin(), x.rend());
  CHECK(c.facts.front == x[4]);
  CHECK(c.facts.runout == x[4] - 75.0);
  CHECK(c.facts.runout > 50.0);
  CHECK(c.facts.front_farthest == far);
  CHECK(c.facts.front_mass <= c.facts.front_farthest);
  CHECK(c.facts.failed_volume == Approx(volume));
  CHECK(c.facts.failed_percent == Approx(100.0 * volume / counted));
  CHECK(c.facts.deepest_failed == deepest);
  CHECK(c.facts.deepest_failed_mass >= deepest);
  CHECK(c.facts.front_at_rest == 30.0);
  CHECK(c.facts.time_at_rest == 30.0);
  CHECK(c.facts.peak_speed == 12.0);
  CHECK(c.facts.energy_error == 0.01);
  CHECK(c.facts.warnings.empty());
  REQUIRE(c.facts.regions.size() == 1);
  CHECK(c.facts.regions[0].points > 200);
  CHECK(c.facts.regions[0].max_displacement == 0.0);
  CHECK(c.facts.regions[0].failed_share == 0.0);
  REQUIRE(c.facts.materials.size() == 4);
  CHECK(c.facts.materials[0].failed_share == 0.0);
  CHECK(c.facts.materials[3].name == "liquefied 1");
  CHECK(c.facts.materials[3].failed_share > 0.3);
}

TEST_CASE("Displacement before the transfer counts, strength is relative to the transfer") {
  Scratch scratch;
  ParticleSet p = dam_case::particles();
  for (auto& u : p.displacement) u = {0.3, -0.4, 0.0};
  dam_case::write_flow(scratch / "mpm.h5", p, {});
  const FinalState end = final_state(p, MpmHistory(scratch / "mpm.h5"), {});
  CHECK(end.displacement[0] == Approx(0.5));
  CHECK(end.undeformed[0][1] == Approx(p.position[0][1] + 0.4));
  CHECK(std::isnan(end.strength_ratio[0]));
  const auto liquefied = std::find(p.material.begin(), p.material.end(), 3) - p.material.begin();
  CHECK(end.strength_ratio[liquefied] == Approx(0.5));
}

TEST_CASE("The runout counts from the toe that comes with the points, or from another") {
  const Case c({});
  CHECK(c.facts.toe == 75.0);
  CHECK(c.facts.runout > 50.0);
  ReportConfig farther;
  farther.toe = 95.0;
  CHECK(Case({}, farther).facts.runout == Approx(c.facts.runout - 20.0));
}

TEST_CASE("Warns of a run that was stopped, of balances and of an unknown toe") {
  CHECK(Case({.front = 200.0, .end = 20.0}).warns_of("stopped before rest"));
  CHECK_FALSE(Case({}).warns_of("stopped before rest"));
  ReportConfig strict;
  strict.energy_warning = 0.005;
  CHECK(Case({}, strict).warns_of("energy balance"));
  CHECK_FALSE(Case({}, strict).warns_of("momentum balance"));
  const Case still({.front = 40.0, .end = 40.0});
  CHECK(still.facts.runout == 0.0);
  CHECK(still.facts.failed_volume > 0.0);
}

TEST_CASE("A flow after a shaking without failure is told to come from the residual strengths") {
  Scratch scratch;
  ParticleSet p = dam_case::particles();
  for (auto& u : p.displacement) u = {0.17, -0.03, 0.0};
  LiquefactionZone zone = dam_case::zone(dam_case::mesh(), true);
  dam_case::write_flow(scratch / "mpm.h5", p, {});
  const MpmHistory history(scratch / "mpm.h5");
  const auto warned = [&](double moved) {
    ReportConfig config;
    config.moved = moved;
    const ReportFacts f = compute_facts(zone, history, final_state(p, history, config), config);
    return f.warnings.empty() ? std::string() : f.warnings.front();
  };
  CHECK(warned(1.0).find("No failure") == std::string::npos);  // control: it failed
  zone.transfer_reason = std::string(kNoFailure) + ", so the end of the record is taken";
  CHECK_THAT(warned(1.0),
             Catch::Matchers::Contains("No failure was found in the shaking") &&
                 Catch::Matchers::Contains("which ends at t = 2 s") &&
                 Catch::Matchers::Contains("its crest moved 0.17 m outward and settled 0.03 m") &&
                 Catch::Matchers::Contains("by the residual strengths alone"));
  CHECK(warned(1e4).find("No failure") == std::string::npos);  // control: nothing flows
  zone.transfer_frame = -1;                                    // control: it was not shaken
  CHECK(warned(1.0).find("No failure") == std::string::npos);
}

TEST_CASE("Warns of soil that leaves to the left, where no runout is counted") {
  // A row of 100 points of 1 m, of which the first `left` move by `by` to the left and the others
  // by 3 m to the right.
  const auto warned = [](std::size_t left, double by) {
    ParticleSet p;
    resize(p, 100);
    p.volume.assign(100, 1.0);
    p.mass.assign(100, 2000.0);
    FinalState end;
    for (std::size_t i = 0; i < 100; ++i) {
      p.position[i] = {static_cast<double>(i), 0.0, 0.0};
      end.undeformed.push_back(p.position[i]);
      end.position.push_back(p.position[i]);
      end.position[i][0] += i < left ? -by : 3.0;
      end.displacement.push_back(i < left ? by : 3.0);
      end.counts.push_back(1);
      end.failed.push_back(end.displacement[i] > 1.0);
    }
    ReportFacts f;
    add_warnings(f, p, end, std::vector<MpmSample>(1), {}, {});
    std::string all;
    for (const std::string& w : f.warnings)
      if (w.find("to the left") != std::string::npos) all += w;
    return all;
  };
  CHECK_THAT(warned(20, 8.0), Catch::Matchers::Contains("passed 8.0 m, from x = 4.0 m to -4.0 m") &&
                                  Catch::Matchers::Contains("20 % of the mass that moved") &&
                                  Catch::Matchers::Contains("counts to the right only"));
  // Less than a tenth, but it leaves; more than a tenth that goes less than a cell.
  CHECK_THAT(warned(8, 8.0), Catch::Matchers::Contains("8 % of the mass that moved"));
  CHECK_THAT(warned(20, 1.5), Catch::Matchers::Contains("it stayed within the section there"));
  CHECK(warned(8, 1.5).empty());
  CHECK(warned(20, 0.5).empty());  // control: what moves by 1 m at most has not failed
  CHECK(warned(0, 0.0).empty());
}

TEST_CASE("Warns if the failure reaches the upstream end") {
  Case c({});
  CHECK_FALSE(c.warns_of("upstream end"));
  c.end.failed[std::find(c.particles.material.begin(), c.particles.material.end(), 3) -
               c.particles.material.begin()] = 1;
  const MpmHistory history(c.scratch / "mpm.h5");
  add_warnings(c.facts, history.initial(), c.end, history.samples(), history.rest(), c.config);
  CHECK(c.warns_of("upstream end"));
}

TEST_CASE("A front rests by the rule that ends a run, wherever samples fall in its window") {
  // Rows every 0.3 s, of which none falls 5 s before the end. The front passes at 1 m/s to x = 10
  // and creeps on at `creep`; the energy is small from 20 s on.
  const auto told = [](double creep, double still_for, double small = 1e-9) {
    const Scratch scratch;
    ParticleSet p = dam_case::particles();
    dam_case::write_flow(scratch / "flow.h5", p, {});
    const MpmHistory flow(scratch / "flow.h5");
    MpmHistoryWriter out(scratch / "mpm.h5", p,
                         {.kinetic_share = 1e-3, .runout_change = 0.2, .window = 5.0});
    for (std::size_t k = 0; k < flow.num_frames(); ++k) out.append(flow.frame(k));
    for (int k = 0; 0.3 * k <= 30.0 + still_for; ++k) {
      MpmSample s;
      s.time = 0.3 * k;
      s.front = s.time <= 30.0 ? s.time : 30.0 + creep * (s.time - 30.0);
      s.kinetic = s.time < 20.0 ? 1e6 : 1e6 * small;
      s.max_speed = 0.57;
      out.append(s);
    }
    out.finish();
    const MpmHistory history(scratch / "mpm.h5");
    const ReportFacts f = compute_facts(dam_case::zone(dam_case::mesh(), true), history,
                                        final_state(p, history, {}), {});
    std::string warned;
    for (const std::string& w : f.warnings)
      if (w.find("before rest") != std::string::npos) warned += w;
    return std::tuple(f, summary_markdown(f, {}), warned);
  };
  using Catch::Matchers::Contains;
  {  // it stood for 4.8 s and moves 0.1 m before: 0.2 m at most in the 5 s that count
    const auto [f, words, warned] = told(0.0, 5.0);
    CHECK(f.front_at_rest == Approx(30.0).margin(0.31));
    CHECK(f.time_at_rest == Approx(20.1));
    CHECK_THAT(words, Contains("The front came to rest") && Contains("within 0.2 m since") &&
                          Contains("the kinetic energy after 20.1 s (below 0.001 of its peak") &&
                          Contains("fastest point still moved at 0.57 m/s"));
    CHECK(warned.empty());
  }
  {  // creeps by 0.15 m in 5 s: at rest by the rule, and told
    const auto [f, words, warned] = told(0.03, 20.0);
    CHECK(is_set(f.front_at_rest));
    CHECK(f.front_change == Approx(0.15).margin(0.01));
    CHECK_THAT(words, Contains("the front by 0.14 m in the last 5 s"));
    CHECK(warned.empty());
  }
  {  // creeps by 0.5 m in 5 s: the energy alone does not make rest
    const auto [f, words, warned] = told(0.1, 20.0);
    CHECK_FALSE(is_set(f.front_at_rest));
    CHECK_THAT(words, Contains("**The front had not come to rest when the run ended:** it moved by "
                               "0.48 m in the last 5 s"));
    CHECK_THAT(warned, Contains("the front still moved by 0.48 m"));
  }
  {  // the front stands while soil behind it moves
    const auto [f, words, warned] = told(0.0, 20.0, 0.5);
    CHECK_FALSE(is_set(f.time_at_rest));
    CHECK_THAT(words, Contains("the kinetic energy was still above 0.001 of its peak"));
    CHECK(warned.empty());
  }
}

TEST_CASE("Refuses particles of another run") {
  Case c({});
  c.particles.id[0] = 987654;
  CHECK_THROWS_AS(final_state(c.particles, MpmHistory(c.scratch / "mpm.h5"), {}), InputError);
}

TEST_CASE("JSON has units in its keys and null for what is unset") {
  const auto json = nlohmann::json::parse(to_json(Case({.front = 200.0, .end = 20.0}).facts));
  CHECK(json["runout_m"].get<double>() > 10.0);
  CHECK(json["liquefaction_depth_pond_m"] == 18.0);
  CHECK(json["liquefaction_depth_crest_m"] == 14.0);
  CHECK(json["transfer_time_s"] == 2.0);
  CHECK(json["mass_error"] == 0.0);
  CHECK(json["energy_error"] == 0.01);
  CHECK(json["time_at_rest_s"].is_null());
  CHECK(json["materials"].size() == 4);
  // Without a toe there is no runout, not one of 0.
  CHECK(nlohmann::json::parse(to_json(ReportFacts{}))["runout_m"].is_null());
}

TEST_CASE("Points inside a concave outline") {
  const std::vector<std::vector<double>> outline{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  CHECK(inside_outline(outline, {0.5, 1.0}));
  CHECK(inside_outline(outline, {3.5, 1.0}));
  CHECK_FALSE(inside_outline(outline, {2.0, 2.0}));
  CHECK_FALSE(inside_outline(outline, {5.0, 1.0}));
}

TEST_CASE("Points that left by the outlet are told of") {
  ParticleSet p;
  resize(p, 1);
  p.mass[0] = 200.0;
  FinalState end;
  end.failed.assign(1, 0);
  end.counts.assign(1, 0);
  const std::vector<MpmSample> samples(1);
  const auto warnings = [&](double points) {
    ReportFacts f;
    f.points_left = points;
    f.mass_left = 20.0 * points;
    add_warnings(f, p, end, samples, {}, {});
    std::string all;
    for (const std::string& w : f.warnings) all += w;
    return all;
  };
  CHECK_THAT(warnings(3.0), Catch::Matchers::Contains("3 points, 30 % of the mass, left") &&
                                Catch::Matchers::Contains("lower bound"));
  CHECK(warnings(0.0).find("outlet") == std::string::npos);  // control
}

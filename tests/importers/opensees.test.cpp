#include "importers/opensees.hpp"

#include "core/check.hpp"
#include "importers/recorder_text.hpp"
#include "small_model.hpp"
#include "tests/support/paths.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;
using flowslide::test::SmallModel;

namespace {

bool has_note(const ImportReport& report, const std::string& text) {
  return std::any_of(report.origin.notes.begin(), report.origin.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("recorders become a history in SI", "[importers]") {
  const SmallModel model;
  const ImportReport report = model.run_import();
  CHECK(report.num_nodes == 6);
  CHECK(report.num_elements == 2);
  CHECK(report.num_frames == 3);
  CHECK(report.time_first == 0.25);
  CHECK(report.time_last == 0.75);
  CHECK(report.warnings.empty());
  CHECK(report.origin.sigma_zz_rule == "mean: sigma_zz = (sigma_xx + sigma_yy)/2");
  CHECK(has_note(report, "shaking: 3 rows from 0.25 to 0.75 s, steps 0.25 to 0.25 s"));

  const FemHistory history(model.out());
  CHECK(history.mesh().element_tags == std::vector<std::int64_t>{10, 20});
  CHECK(history.times() == std::vector<double>{0.25, 0.5, 0.75});
  const double v0 = SmallModel::vertical(2, 0);
  CHECK(history.gravity().stress[1][1] == 1e3 * v0);
  CHECK(history.gravity().pore_pressure[2] == 1e3 * 9.81);
  CHECK(history.gravity().displacement[5] == Vec2{0.0, 0.0});
  CHECK(history.gravity().strain[1].v == std::array<double, 4>{1e-4 * 4, 1e-4 * 5, 0.0, 1e-4 * 6});
  const FemFrame frame = history.frame(1);
  CHECK(frame.displacement[3] ==
        Vec2{SmallModel::displacement(4, 0, 2), SmallModel::displacement(4, 1, 2)});
  CHECK(frame.velocity[5][1] == SmallModel::displacement(6, 1, 2));
  CHECK(frame.pore_pressure[4] == 1e3 * SmallModel::pressure(5, 2));
  const double v = SmallModel::vertical(2, 2);
  CHECK(frame.stress[1][0] == 1e3 * (0.5 * v));
  CHECK(frame.stress[1][1] == 1e3 * v);
  CHECK(frame.stress[1][2] == Approx(1e3 * 0.75 * v).epsilon(1e-14));
  CHECK(frame.stress[1][3] == 1e3 * (0.125 * v));
  CHECK(frame.strain[0].v[2] == 0.0);
}

TEST_CASE("units of the files are converted", "[importers]") {
  SmallModel model;
  model.config.units = {"cm", "ms", "MPa"};
  model.run_import();
  const FemHistory history(model.out());
  const FemFrame frame = history.frame(0);
  const double d = SmallModel::displacement(1, 0, 1);
  CHECK(history.mesh().nodes[5] == Vec2{0.02, 0.01});
  CHECK(history.times()[0] == Approx(0.25e-3));
  CHECK(frame.displacement[0][0] == Approx(0.01 * d));
  CHECK(frame.velocity[0][0] == Approx(10.0 * d));
  CHECK(frame.stress[0][1] == Approx(1e6 * SmallModel::vertical(1, 1)));
  model.config.units.stress = "psi";
  CHECK_THROWS_WITH(model.run_import(), Contains("unknown unit 'psi'"));
}

TEST_CASE("sigma_zz follows the chosen rule", "[importers]") {
  SmallModel model;
  const double v = 1e3 * SmallModel::vertical(1, 0);
  const auto zz = [&] {
    model.run_import();
    return FemHistory(model.out()).gravity().stress[0][2];
  };
  model.config.sigma_zz = {SigmaZzRule::elastic, 0.3, {}};
  CHECK(zz() == Approx(0.3 * 1.5 * v).epsilon(1e-14));
  model.config.sigma_zz = {SigmaZzRule::k0, {}, 0.6};
  CHECK(zz() == Approx(0.6 * v).epsilon(1e-14));
  CHECK(FemHistory(model.out()).origin().sigma_zz_rule == "k0: sigma_zz = K0 sigma_yy, K0 = 0.6");
  model.config.sigma_zz = {SigmaZzRule::elastic, {}, {}};
  CHECK_THROWS_WITH(zz(), Contains("`sigma_zz.nu` belongs to `rule: elastic`"));
  model.config.sigma_zz = {SigmaZzRule::recorded, {}, {}};
  CHECK_THROWS_WITH(zz(), Contains("`columns.stress` has no 'zz'"));
}

TEST_CASE("stress of five components and of four points is read by name", "[importers]") {
  SmallModel model;
  model.config.shaking.reset();
  model.config.columns.stress = {"xx", "yy", "zz", "xy", "ratio"};
  model.config.sigma_zz.rule = SigmaZzRule::recorded;
  model.folder.write("Gstress.out", "0 -2 -4 -3 0.5 0.9 -2.5 -5 -3.5 0.25 0.8\n");
  model.run_import();
  CHECK(FemHistory(model.out()).gravity().stress[1].v ==
        std::array<double, 4>{-2500.0, -5000.0, -3500.0, 250.0});
  CHECK(FemHistory(model.out()).times().empty());

  model.config.sigma_zz.rule = SigmaZzRule::mean;
  model.config.columns.stress = {"xx", "yy", "xy", "xx", "yy", "xy",
                                 "xx", "yy", "xy", "xx", "yy", "xy"};
  std::string row = "0";
  for (int e = 0; e < 2; ++e)
    for (int g = 1; g <= 4; ++g) row += fmt::format(" {} {} {}", -2 * g, -4 * g - e, g);
  model.folder.write("Gstress.out", row + "\n");
  model.run_import();
  CHECK(FemHistory(model.out()).gravity().stress[1].v ==
        std::array<double, 4>{-5000.0, -11000.0, -8000.0, 2500.0});
}

TEST_CASE("components in another order and in shared files are found by name", "[importers]") {
  SmallModel model;
  // One file with `-dof 1 2 3 vel` holds velocity and pore pressure.
  const std::string shared = SmallModel::rows(1, 4, 18, [](int i, int r) {
    const int node = 1 + i / 3;
    return i % 3 == 2 ? SmallModel::pressure(node, r) : SmallModel::displacement(node, i % 3, r);
  });
  model.config.shaking->velocity.path = model.folder.write("vel.out", shared);
  model.config.columns.velocity = {"x", "y", "skip"};
  model.config.columns.displacement = {"y", "x"};
  model.run_import();
  const FemFrame frame = FemHistory(model.out()).frame(0);
  CHECK(frame.velocity[2][1] == SmallModel::displacement(3, 1, 1));
  CHECK(frame.displacement[2] ==
        Vec2{SmallModel::displacement(3, 1, 1), SmallModel::displacement(3, 0, 1)});
  model.config.columns.displacement = {"x", "w"};
  CHECK_THROWS_WITH(model.run_import(), Contains("`columns.displacement`: unknown component 'w'"));
  model.config.columns.displacement = {"x", "skip"};
  CHECK_THROWS_WITH(model.run_import(), Contains("`columns.displacement` lacks 'y'"));
}

TEST_CASE("CSV and gzip recorders give the same history to the bit", "[importers]") {
  const SmallModel plain;
  plain.run_import();
  SmallModel other;
  std::string csv = SmallModel::node_rows(1, 4);
  std::replace(csv.begin(), csv.end(), ' ', ',');
  other.folder.write("displacement.out", csv);
  other.config.shaking->stress.path =
      other.folder.write_gzip("stress.out.gz", SmallModel::stress_rows(1, 4));
  other.run_import();
  for (std::size_t i = 0; i < 3; ++i) {
    const FemFrame a = FemHistory(plain.out()).frame(i);
    const FemFrame b = FemHistory(other.out()).frame(i);
    CHECK(a.displacement == b.displacement);
    CHECK(a.stress == b.stress);
  }
}

TEST_CASE("files without a time column need the interval", "[importers]") {
  SmallModel model;
  model.config.columns.time = false;
  CHECK_THROWS_WITH(model.run_import(), Contains("needs `shaking.interval`"));
  model.config.shaking->interval = 0.5;
  CHECK_THROWS_WITH(model.run_import(),
                    Contains("There is a time column: set `columns.time: true`"));
  for (const char* name : {"Gstress.out", "Gstrain.out", "GporePressure.out", "displacement.out",
                           "velocity.out", "porePressure.out", "stress.out", "strain.out"}) {
    std::string text = read_text_file(model.folder.path(name));
    std::string without;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      const std::size_t blank = text.find(' ', at);
      without += text.substr(blank + 1, end - blank);
      at = end + 1;
    }
    model.folder.write(name, without);
  }
  CHECK(model.run_import().num_frames == 3);
  CHECK(FemHistory(model.out()).times() == std::vector<double>{0.5, 1.0, 1.5});
  CHECK(FemHistory(model.out()).frame(0).pore_pressure[0] == 1e3 * SmallModel::pressure(1, 1));
  model.config.columns.time = true;
  model.config.shaking->interval.reset();
  CHECK_THROWS_WITH(model.run_import(), Contains("There is no time column"));
}

TEST_CASE("a wrong number of columns is explained in both factorizations", "[importers]") {
  SmallModel model;
  model.folder.write("displacement.out", "0.25 1 2 3 4 5 6 7 8 9 10\n");
  CHECK_THROWS_AS(model.run_import(), InputError);
  CHECK_THROWS_WITH(model.run_import(),
                    Contains("displacement.out: 11 columns = 1 + 2*5 (or 2*5.5 without time), but "
                             "nodeinfo.dat has 6 nodes, which makes 13 columns"));
  model.folder.write("displacement.out", "0.25\n0.5\n");
  CHECK_THROWS_WITH(model.run_import(), Contains("has a time column only"));
  model.folder.write("displacement.out", "");
  CHECK_THROWS_WITH(model.run_import(), Contains("displacement.out: is empty"));
  model.folder.write("displacement.out", SmallModel::node_rows(1, 4));
  model.folder.write("stress.out", "0.25 1 2 3 4 5 1 2 3 4 5\n");
  CHECK_THROWS_WITH(model.run_import(),
                    Contains("It fits 5 components per element instead of [xx, yy, xy]"));
}

TEST_CASE("torn and missing rows shorten the history and are reported", "[importers]") {
  SmallModel model;
  model.folder.write("strain.out", SmallModel::strain_rows(1, 3) + "0.75 1 2");
  const ImportReport report = model.run_import();
  CHECK(report.num_frames == 2);
  CHECK(has_note(report, "strain.out: last line (row 3) is torn, dropped"));
  CHECK(has_note(report, "displacement.out: 1 of 3 rows are at times that another file lacks"));
  CHECK(FemHistory(model.out()).origin().notes == report.origin.notes);
}

TEST_CASE("rows that start later in one file are matched by time", "[importers]") {
  SmallModel model;
  model.folder.write("stress.out", SmallModel::stress_rows(2, 5));
  model.run_import();
  const FemHistory history(model.out());
  CHECK(history.times() == std::vector<double>{0.5, 0.75});
  CHECK(history.frame(0).stress[0][1] == 1e3 * SmallModel::vertical(1, 2));
  CHECK(history.frame(0).pore_pressure[3] == 1e3 * SmallModel::pressure(4, 2));
}

TEST_CASE("a recorder that ran through gravity needs a choice of stage", "[importers]") {
  SmallModel model;
  model.folder.write("stress.out", SmallModel::stress_rows(8, 12) + SmallModel::stress_rows(1, 4));
  CHECK_THROWS_WITH(model.run_import(), Contains("stress.out: time goes back, 2 stages"));
  model.config.shaking->stage = StageChoice::last;
  const ImportReport report = model.run_import();
  CHECK(has_note(report, "the last one is used"));
  CHECK(FemHistory(model.out()).frame(2).stress[0][1] == 1e3 * SmallModel::vertical(1, 3));
}

TEST_CASE("a run that diverged is refused, or cut before the first bad row", "[importers]") {
  SmallModel model;
  std::string text = SmallModel::node_rows(1, 4);
  const std::size_t last = text.rfind(' ');
  model.folder.write("velocity.out", text.substr(0, last) + " nan\n");
  CHECK_THROWS_WITH(model.run_import(),
                    Contains("velocity.out: 1 values are not finite (the run diverged?)") &&
                        Contains("velocity.out:3: column 13 (node 6 y) is nan"));
  CHECK_FALSE(std::filesystem::exists(model.out()));
  model.config.bad_rows = BadRows::stop;
  const ImportReport report = model.run_import();
  CHECK(report.num_frames == 2);
  CHECK(has_note(report, "velocity.out: only the first 2 of 3 rows are used"));
  model.folder.write("velocity.out", "x\n" + text + "0.3 1\n");
  CHECK(model.run_import().num_frames == 3);
  model.folder.write("velocity.out", "0.25 nan\n");
  CHECK_THROWS_AS(model.run_import(), InputError);
  // Where no row is left there is nothing to stop at.
  std::string first = text;
  first.replace(first.find(' '), first.find(' ', first.find(' ') + 1) - first.find(' '), " nan");
  model.folder.write("velocity.out", first);
  model.config.bad_rows = BadRows::error;
  CHECK_THROWS_WITH(model.run_import(),
                    Contains("from the first row on") && !Contains("bad_rows: stop"));
}

TEST_CASE("the gravity row is one index for all files", "[importers]") {
  SmallModel model;
  model.folder.write("Gstress.out", SmallModel::stress_rows(0, 3));
  model.folder.write("Gstrain.out", SmallModel::strain_rows(0, 3));
  model.folder.write("GporePressure.out", SmallModel::pressure_rows(0, 3));
  const auto vertical = [&] {
    model.run_import();
    return FemHistory(model.out()).gravity().stress[0][1];
  };
  CHECK(vertical() == 1e3 * SmallModel::vertical(1, 2));
  model.config.gravity.row = "first";
  CHECK(vertical() == 1e3 * SmallModel::vertical(1, 0));
  model.config.gravity.row = "2";
  CHECK(vertical() == 1e3 * SmallModel::vertical(1, 1));
  model.config.gravity.row = "4";
  CHECK_THROWS_WITH(model.run_import(), Contains("have rows 1 to 3"));
  model.config.gravity.row = "middle";
  CHECK_THROWS_WITH(model.run_import(), Contains("is not last, first or a whole number"));
  model.config.gravity.row = "last";
  model.folder.write("GporePressure.out", SmallModel::pressure_rows(0, 2));
  const ImportReport report = model.run_import();
  CHECK(FemHistory(model.out()).gravity().stress[0][1] == 1e3 * SmallModel::vertical(1, 1));
  CHECK(has_note(report, "Gstress.out: 3 rows, another gravity file has 2"));
  model.folder.write("GporePressure.out", SmallModel::pressure_rows(1, 4));
  CHECK_THROWS_WITH(model.run_import(),
                    Contains("row 3 is at time 0.5 in Gstress.out and 0.75 in"));
}

TEST_CASE("implausible states are warned of, not corrected", "[importers]") {
  SmallModel model;
  const auto warning = [&] {
    const ImportReport report = model.run_import();
    REQUIRE(report.warnings.size() >= 1);
    CHECK(has_note(report, "warning: " + report.warnings[0]));
    return report.warnings[0];
  };
  model.config.units.stress = "Pa";
  CHECK_THAT(warning(), Contains("It would fit if `units.stress` is kPa"));
  model.config.units.stress = "kPa";
  model.config.columns.stress = {"yy", "xx", "xy"};
  CHECK_THAT(warning(), Contains("horizontal effective stress exceeds the vertical one in 2 of 2"));
  model.config.columns.stress = {"xx", "yy", "xy"};
  model.folder.write("Gstress.out", "0 2 4 0.5 2 4 0.5\n");
  CHECK_THAT(warning(), Contains("vertical effective stress is positive in 2 of 2 elements"));
  model.folder.write("Gstress.out", SmallModel::stress_rows(0, 1));
  // The time integral of the pore pressure, as `-dof 3 disp` records it.
  model.folder.write("porePressure.out", SmallModel::rows(1, 4, 6, [](int i, int r) {
                       return 0.01 * r * SmallModel::pressure(1 + i, 0);
                     }));
  CHECK_THAT(warning(), Contains("pore pressure differs from gravity by 99 % on average"));
  model.folder.write("GporePressure.out", "0 0 0 0 0 0 0\n");
  CHECK_THAT(model.run_import().warnings.back(), Contains("pore pressure is nowhere 1 %"));
}

TEST_CASE("a recorder that ended early is warned about", "[importers]") {
  const auto all = [](const ImportReport& report) {
    return fmt::format("{}", fmt::join(report.warnings, "\n"));
  };
  SmallModel model;
  CHECK(all(model.run_import()).empty());
  model.folder.write("stress.out", SmallModel::stress_rows(1, 2));
  CHECK_THAT(all(model.run_import()), Contains("stress.out ends at 0.25 s, others at 0.75 s"));

  // Every second row of the others: a recorder with -dT is no fault.
  SmallModel thin;
  thin.folder.write("stress.out",
                    "0.25 -2 -4.1 -0.5 -2 -4.2 -0.5\n0.75 -2 -4.1 -0.5 -2 -4.2 -0.5\n");
  CHECK(all(thin.run_import()).empty());

  SmallModel digits;  // two rows that print the same time
  std::string text = SmallModel::stress_rows(1, 4);
  text.replace(text.find("0.5 "), 4, "0.25 ");
  digits.folder.write("stress.out", text);
  CHECK_THAT(all(digits.run_import()), Contains("-precision"));
}

TEST_CASE("displacements are held against the section", "[importers]") {
  const auto with = [](double x) {
    SmallModel model;
    model.folder.write("displacement.out", SmallModel::rows(1, 4, 12, [x](int i, int r) {
                         return i == 10 ? x * r : SmallModel::displacement(1 + i / 2, i % 2, r);
                       }));
    return fmt::format("{}", fmt::join(model.run_import().warnings, "\n"));
  };
  CHECK_THAT(with(0.1), Contains("strain: does not fit") && !Contains("has moved by"));
  CHECK_THAT(with(0.25), Contains("node 6 has moved by 0.75") && Contains("at t = 0.75 s"));
  CHECK_THROWS_WITH(with(4e9), Contains("node 6 has moved by 4e+09 m at t = 0.25 s"));

  SmallModel folded;  // the right element turned inside out
  folded.folder.write("displacement.out", SmallModel::rows(1, 4, 12, [](int i, int r) {
                        return r == 3 && (i == 4 || i == 10) ? -1.5 : 0.0 * i;
                      }));
  CHECK_THAT(fmt::format("{}", fmt::join(folded.run_import().warnings, "\n")),
             Contains("1 elements are folded from t = 0.75 s on, such as 20"));
}

TEST_CASE("one node that a recorder lacks is told from a missing time column", "[importers]") {
  SmallModel model;
  const auto five = [](int first, int last) {
    return SmallModel::rows(first, last, 5,
                            [](int i, int r) { return SmallModel::pressure(1 + i, r); });
  };
  model.folder.write("porePressure.out", five(1, 4));
  CHECK_THROWS_WITH(model.run_import(), Contains("porePressure.out: 6 columns") &&
                                            Contains("The first column is time, so one node is") &&
                                            !Contains("There is no time column"));
  // One row cannot tell; both are said.
  SmallModel one;
  one.folder.write("GporePressure.out", five(0, 1));
  CHECK_THROWS_WITH(one.run_import(),
                    Contains("There is no time column") && Contains("Or one node is missing"));
  // Control: values without a time column.
  SmallModel none;
  none.folder.write("porePressure.out",
                    "9.9 9.8 9.9 0.1 0 0.1\n9.7 9.9 9.8 0.2 0 0.1\n"
                    "9.8 9.8 9.9 0.1 0 0.2\n");
  CHECK_THROWS_WITH(none.run_import(),
                    Contains("There is no time column") && !Contains("is missing"));
}

TEST_CASE("a look at the files finds what the import would", "[importers]") {
  SmallModel model;
  CHECK(preview_opensees(model.config).mesh.num_elements() == 2);
  CHECK(preview_opensees(model.config).warnings.empty());
  model.folder.write("stress.out", SmallModel::stress_rows(1, 2));
  CHECK_THAT(preview_opensees(model.config).warnings.at(0), Contains("stress.out ends at"));
  model.folder.write("velocity.out", SmallModel::pressure_rows(1, 4));
  CHECK_THROWS_WITH(preview_opensees(model.config), Contains("velocity.out: 7 columns"));
  model.folder.write("elementinfo.dat", "10 1 2 5 4 168\n20 2 3 6 5 170\n30 5 4 1 2 168\n");
  CHECK_THROWS_WITH(preview_opensees(model.config), Contains("such as 10 and 30"));
}

TEST_CASE("nodes that are not joined are warned about", "[importers]") {
  SmallModel model;
  model.config.shaking.reset();
  model.folder.write("nodeinfo.dat", "1 0 0\n2 1 0\n3 2 0\n4 0 1\n5 1 1\n6 2 1\n7 1 0\n8 1 1\n");
  model.folder.write("elementinfo.dat", "10 1 2 5 4 168\n20 7 3 6 8 170\n");
  model.folder.write("GporePressure.out", "0 9.81 9.81 9.81 0 0 0 9.81 0\n");
  CHECK_THAT(model.run_import().warnings.at(0),
             Contains("2 nodes lie on another node") && Contains("unless the model ties them"));
}

TEST_CASE("an interrupted import leaves no history", "[importers]") {
  const SmallModel model;
  std::atomic<bool> stop = true;
  Progress progress;
  progress.stop_requested = &stop;
  CHECK_THROWS_AS(import_opensees(model.config, model.out(), progress), Interrupted);
  CHECK_FALSE(std::filesystem::exists(model.out()));
}

TEST_CASE("any recorder cut at any byte gives fewer rows or an error", "[importers][fuzz]") {
  SmallModel model;
  const std::string whole = SmallModel::stress_rows(1, 4);
  for (std::size_t size = 0; size < whole.size(); size += 3) {
    CAPTURE(size);
    model.folder.write("stress.out", whole.substr(0, size));
    const auto rows = std::count(whole.begin(), whole.begin() + static_cast<long>(size), '\n');
    if (rows == 0) {
      CHECK_THROWS_AS(model.run_import(), InputError);
    } else {
      CHECK(static_cast<long>(model.run_import().num_frames) == rows);
    }
  }
}

TEST_CASE("the dam that fails is read as OpenSees wrote it", "[importers]") {
  const test::DataFolder folder;
  const std::filesystem::path source = test::fixture("opensees/dam-rio270");
  OpenSeesConfig config;
  config.mesh.nodes.path = source / "nodeinfo.dat";
  config.mesh.elements.path = source / "elementinfo.dat";
  config.materials = {{"embankment", {167, 1690.0, {}}},
                      {"tailings", {168, 1870.0, {}}},
                      {"foundation", {170, 1900.0, {}}}};
  config.units = {"m", "s", "kPa"};
  config.gravity = {{source / "Gstress.out"},
                    InputFile{source / "Gstrain.out"},
                    {source / "GporePressure.out"},
                    "last"};
  OpenSeesShaking shaking;
  shaking.displacement.path = source / "displacement.out.gz";
  shaking.velocity.path = source / "velocity.out.gz";
  shaking.pore_pressure.path = source / "porePressure.out.gz";
  shaking.stress.path = source / "stress.out.gz";
  shaking.strain.path = source / "strain.out.gz";
  config.shaking = shaking;
  const auto out = folder.path("history.h5");
  const ImportReport report = import_opensees(config, out);
  CHECK(report.num_nodes == 2003);
  CHECK(report.num_elements == 1849);
  CHECK(report.num_frames == 31);
  CHECK(report.time_first == 0.01);
  CHECK(report.time_last == 7.51);
  CHECK(report.warnings.empty());

  const FemHistory history(out);
  const QuadMesh& mesh = history.mesh();
  // Vertical effective stress at 18 m depth in the free field of the pond (surface y = 30 m):
  // between the two elements of the edge column around y = 12 m. Buoyant unit weight 8.5 kN/m3.
  double below = 0.0;
  double above = 0.0;
  for (std::size_t e = 0; e < mesh.num_elements(); ++e) {
    const Vec2 c = centroid(corners(mesh, mesh.nodes, e));
    if (c[0] > -340.0) continue;
    if (std::abs(c[1] - 10.5) < 0.1) below = -history.gravity().stress[e][1];
    if (std::abs(c[1] - 13.5) < 0.1) above = -history.gravity().stress[e][1];
  }
  CHECK(0.5 * (below + above) == Approx(153e3).epsilon(0.03));

  // The crest, node 11, as recorded; the origin of the data states two decimals.
  const auto crest = [&](std::size_t frame) { return history.frame(frame).displacement[10]; };
  constexpr double rounding = 0.005;
  CHECK(history.times()[28] == 7.01);
  CHECK(history.mesh().node_tags[10] == 11);
  CHECK(crest(22)[0] == Approx(0.22).margin(rounding));
  CHECK(crest(22)[1] == Approx(-0.11).margin(rounding));
  CHECK(crest(28)[0] == Approx(1.07).margin(rounding));
  CHECK(crest(28)[1] == Approx(-0.46).margin(rounding));
  CHECK(crest(30)[0] == Approx(1.37).margin(rounding));
  CHECK(crest(30)[1] == Approx(-0.61).margin(rounding));
}

#include "tests/cli/program.hpp"

using namespace flowslide;
using namespace flowslide::cli::test;
using Catch::Contains;

TEST_CASE("the version is that of the project", "[cli]") {
  const Scratch scratch;
  const Outcome o = call(scratch, "--version");
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Catch::StartsWith("flowslide 0."));
}

TEST_CASE("wrong use of the command line is wrong input", "[cli]") {
  const Scratch scratch;
  for (const char* arguments : {"", "rum x.yaml", "run", "run x.yaml --threads 0", "run a b c"}) {
    CAPTURE(arguments);
    const Outcome o = call(scratch, arguments);
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Catch::StartsWith("error: "));
  }
}

TEST_CASE("wrong workflows end with the exit code and message of the contract", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  struct Case {
    const char* what;
    std::string stages;
    int code;
    const char* message;
  };
  const std::vector<Case> cases{
      {"unknown stage", "  s: {uses: import.opensee}\n", 2, "Did you mean 'import.opensees'"},
      {"unknown key", shake() + "      gravty: 1\n", 2, "gravty"},
      {"wrong unit", shake("{length: m, time: s, stress: lb}"), 2, "w.yaml:"},
      {"missing unit", shake() + "  z: {uses: mpm.run, with: {cell: 1.25}}\n", 2, "no unit"},
      {"kinds do not match",
       shake() + "  a: {uses: transfer.map, in: {history: shake.history, zone: a.particles}}\n", 2,
       "is of kind particles"},
      {"not connected", shake() + "  z: {uses: transfer.zone}\n", 2,
       "Write 'in: {history: shake.history}'"}};
  for (const Case& c : cases) {
    CAPTURE(c.what);
    const Outcome o = run(scratch, c.stages);
    CHECK(o.code == c.code);
    CHECK_THAT(o.err, Catch::StartsWith("error: w.yaml:") && Contains(c.message));
    check_nothing_final(scratch);
    CHECK(call(scratch, "check w.yaml").code == c.code);
  }
}

TEST_CASE("missing files have their own exit code", "[cli]") {
  const Scratch scratch;
  CHECK(call(scratch, "run none.yaml").code == 4);
  CHECK(call(scratch, "inspect none.h5").code == 4);
  write_model(scratch);
  std::filesystem::remove(scratch / "stress.out");
  const Outcome o = run(scratch, shake());
  CHECK(o.code == 4);
  CHECK_THAT(o.err, Contains("stress.out"));
  check_nothing_final(scratch);
}

TEST_CASE("a small import runs, is then up to date, and can be inspected", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  Outcome o = run(scratch, shake());
  INFO(o.err);
  REQUIRE(o.code == 0);
  CHECK(std::filesystem::exists(scratch / "out/result.json"));
  o = run(scratch, shake());
  CHECK_THAT(o.out, Contains("up to date"));
  CHECK_THAT(call(scratch, "inspect out").out, Contains("import.opensees"));
  CHECK_THAT(call(scratch, "inspect stress.out --json").out, Contains("\"columns\": 4"));
  o = call(scratch,
           "run w.yaml --out out --dry-run --set stages.shake.with.sigma_zz.rule=elastic "
           "--set stages.shake.with.sigma_zz.nu=0.3");
  INFO(o.err);
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("settings changed"));

  SECTION("what it took is kept beside the user's caches, and told before the next run") {
    CHECK_THAT(o.out, Contains(", about 0.") && Contains("expected: about 0."));
    CHECK(std::distance(std::filesystem::directory_iterator(scratch / "cache/flowslide"), {}) == 1);
    for (const auto& entry : std::filesystem::directory_iterator(scratch / "cache/flowslide"))
      std::ofstream(entry.path()) << "damaged";
    o = call(scratch, "run w.yaml --out out --redo shake");
    INFO(o.err);
    CHECK(o.code == 0);
    CHECK_THAT(o.out, Contains("computing time") && Contains(" expected ("));
    o = call(scratch, "run w.yaml --out out --redo shake", "unset XDG_CACHE_HOME HOME; ");
    CHECK(o.code == 0);
  }
  SECTION("a torn recorder is refused, and what was there stays") {
    scratch.write("stress.out", "0.1 -10 -20 0\n0.2 -10 nonsense 0\n");
    o = run(scratch, shake());
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Contains("stress.out:2"));
    CHECK(std::filesystem::exists(scratch / "out/result.json"));
  }
  SECTION("a command that is refused takes nothing away") {
    const std::string before = read_text_file(scratch / "out/result.json");
    CHECK(run(scratch, shake() + "  z: {uses: nothing}\n").code == 2);
    scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
    CHECK(call(scratch, "run w.yaml --out out --set stages.shake.with.untis=1").code == 2);
    CHECK(call(scratch, "run w.yaml --out out --redo shaek").code == 2);
    CHECK_THAT(call(scratch, "run w.yaml --out out --redo shaek").err,
               Contains("Did you mean 'shake'"));
    std::filesystem::remove(scratch / "stress.out");
    CHECK(run(scratch, shake()).code == 4);
    CHECK(read_text_file(scratch / "out/result.json") == before);
  }
  SECTION("a stage is run again on request") {
    o = call(scratch, "run w.yaml --out out --redo shake");
    CHECK(o.code == 0);
    CHECK_THAT(o.out, Contains("runs: asked for"));
  }
}

TEST_CASE("inspect reads all of a run folder and names what is damaged", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  REQUIRE(run(scratch, shake()).code == 0);
  CHECK_THAT(call(scratch, "inspect out --json").out, Contains("\"problems\": []"));
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch / "out")) {
    if (!entry.is_regular_file() || entry.file_size() == 0) continue;  // the guard file is empty
    CAPTURE(entry.path().string());
    const auto time = std::filesystem::last_write_time(entry.path());
    const std::string whole = read_text_file(entry.path());
    std::string bytes = whole;
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::ofstream(entry.path(), std::ios::binary) << bytes;
    std::filesystem::last_write_time(entry.path(), time);
    const Outcome o = call(scratch, "inspect out");
    CHECK(o.code == 4);
    CHECK_THAT(o.out, Contains("problems") && Contains(entry.path().filename().string()));
    std::ofstream(entry.path(), std::ios::binary) << whole;
    ++files;
  }
  CHECK(files == 5);  // run.lock, result.json, stage.json, facts.json, history.h5
  CHECK_THAT(call(scratch, "inspect out --json").out, Contains("\"problems\": []"));
}

TEST_CASE("inspect ends with 2 for a text with problems", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
  CHECK(call(scratch, "inspect w.yaml").code == 0);
  CHECK(call(scratch, "inspect stress.out").code == 0);
  scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake("{length: mile}"));
  scratch.write("stress.out", "");
  CHECK(call(scratch, "inspect w.yaml").code == 2);
  CHECK(call(scratch, "inspect stress.out").code == 2);
  // A record that is odd is no problem of its text; one that cannot be read is.
  scratch.write("odd.csv", "time (s), acc (g)\n0,10\n0.01,-20\n0.02,30\n");
  CHECK(call(scratch, "inspect odd.csv").code == 0);
  scratch.write("k.txt", "Sampling Freq(Hz) 100Hz\nScale Factor 1(gal)/2\n 1 2 3 4 5 6 7 8\n");
  CHECK(call(scratch, "inspect k.txt").code == 2);
}

TEST_CASE("what cannot be looked at is said with the system's reason", "[cli]") {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "empty");
  std::filesystem::create_symlink("loop", scratch / "loop");
  REQUIRE(std::system(("mkfifo '" + (scratch / "pipe").string() + "'").c_str()) == 0);
  scratch.write("closed/file", "x");
  std::filesystem::permissions(scratch / "closed", std::filesystem::perms::none);
  struct Case {
    std::string path;
    int code;
    const char* reason;
  };
  const std::vector<Case> cases{
      {"loop", 4, "symbolic links"},      {std::string(300, 'n'), 4, "too long"},
      {"missing/out", 4, "no such file"}, {"pipe", 4, "pipe"},
      {"/dev/zero", 4, "device"},         {"empty", 2, "no run of flowslide"}};
  for (const Case& c : cases) {
    CAPTURE(c.path);
    const Outcome o = call(scratch, "inspect " + c.path);
    CHECK(o.code == c.code);
    CHECK_THAT(o.err, Contains(c.reason) && !Contains("internal error"));
  }
  for (const char* command : {"inspect closed/file", "inspect closed", "run closed/w.yaml",
                              "report closed", "run w.yaml --out closed/out"}) {
    CAPTURE(command);
    write_model(scratch);
    scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + shake());
    const Outcome o = call(scratch, command, kWithoutPower);
    CHECK(o.code == 4);
    CHECK_THAT(o.err, Contains("ermission denied") && !Contains("internal error"));
  }
  std::filesystem::permissions(scratch / "closed", std::filesystem::perms::owner_all);
}

TEST_CASE("an interpreter that a workflow names is not run without the user's word", "[cli]") {
  const Scratch scratch;
  const std::string set = " --set stages.report.with.python=" + (scratch / "python").string();
  const auto python =
      scratch.write("python", "#!/bin/sh\ntouch '" + (scratch / "ran").string() + "'\nexit 1\n");
  std::filesystem::permissions(python, std::filesystem::perms::owner_all);
  const Outcome o =
      call(scratch, "run " + test::source("workflows/mochikoshi-static.yaml") + " --out out" + set);
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("--allow-python"));
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
  CHECK_FALSE(std::filesystem::exists(scratch / "ran"));
  const Outcome before =
      call(scratch, "check " + test::source("workflows/mochikoshi-static.yaml") + set);
  CHECK(before.code == 0);
  CHECK_THAT(before.err, Contains("note: report: would start") && Contains("--allow-python"));
}

TEST_CASE("check reads the files that the workflow names", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  const auto check = [&](const std::string& stages) {
    scratch.write("w.yaml", "schema: 1\nname: w\nstages:\n" + stages);
    return call(scratch, "check w.yaml");
  };
  CHECK(check(shake()).code == 0);
  scratch.write("stress.out", "0.1 -10 -20\n");
  Outcome o = check(shake());
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("stages.shake.with: stress.out: 3 columns"));

  const auto zone = [](const std::string& windows) {
    return "  zone:\n    uses: transfer.zone\n    in: {history: shake.history}\n    with:\n"
           "      {when: gravity, zone: all, liquefiable: [sand], pond_surface: 1 m" +
           windows + ", strength: {table: [[20 kPa, 2 kPa]]}}\n";
  };
  write_model(scratch);
  CHECK(check(shake() + zone("")).code == 0);
  o = check(shake() + zone(", windows: {far: {from: 5 m, to: 6 m}}"));
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("windows.far: no node of the liquefiable soil"));

  scratch.write("a.txt", "Sampling Freq(Hz) 100Hz\nScale Factor 1(gal)/2\n 1 2 3 4 5 6 7 8\n");
  o = check("  m: {uses: motion.prepare, with: {record: a.txt, unit: cm/s2, dt: 10 ms}}\n");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("w.yaml:4:") && Contains("K-NET"));
  scratch.write("a.AT2", "PEER\nX\nACCELERATION IN UNITS OF G\nNPTS= 3, DT= .02 SEC\n0 98 -20\n");
  o = check("  m: {uses: motion.prepare, with: {record: a.AT2}}\n");
  CHECK(o.code == 0);
  CHECK_THAT(o.err, Contains("warning: m: the peak is 98 g"));
}

TEST_CASE("windows are those of the user, or the whole soil", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  const Outcome o = run(
      scratch, shake() +
                   "  zone:\n    uses: transfer.zone\n    in: {history: shake.history}\n"
                   "    with: {when: gravity, zone: all, liquefiable: [sand], pond_surface: 1 m, "
                   "strength: {table: [[20 kPa, 2 kPa]]}}\n");
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("liquefaction depth, whole soil 1 m"));
}

TEST_CASE("records are measured as text and as JSON", "[cli]") {
  const Scratch scratch;
  scratch.write("a.AT2",
                "PEER\nSomewhere\nACCELERATION IN UNITS OF G\nNPTS= 8, DT= .02 SEC\n"
                "0 .1 -.2 .1 0 -.1 .05 0\n");
  const Outcome json = call(scratch, "motion a.AT2 --pga 0.3g --json");
  CHECK(json.code == 0);
  CHECK_THAT(json.out, Contains("\"file\": \"a.AT2\"") && Contains("\"npts\": 8") &&
                           Contains("\"dt_s\": 0.02") && Contains("\"masi_m_s\""));
  const Outcome text = call(scratch, "motion a.AT2 a.AT2");
  CHECK(text.code == 0);
  CHECK_THAT(text.out, Contains("0.2000") && Contains("D5-95"));

  CHECK(call(scratch, "motion none.AT2").code == 4);
  CHECK(call(scratch, "motion a.AT2 --pga 0.3").code == 2);
  scratch.write("b.csv", "0.1\n0.2\n");
  CHECK(call(scratch, "motion b.csv --unit g").code == 2);
  CHECK(call(scratch, "motion b.csv --unit g --dt 0.01s").code == 0);
}

TEST_CASE("verification cases and benchmarks are listed and chosen by name", "[cli]") {
  const Scratch scratch;
  const Outcome list = call(scratch, "verify mpm --list");
  CHECK(list.code == 0);
  CHECK_THAT(list.out, Contains("mpm/v1_compaction"));
  CHECK(call(scratch, "verify mpn").code == 2);
  const Outcome run = call(scratch, "verify mpm/v1_mirror --json");
  CHECK(run.code == 0);
  CHECK_THAT(run.out,
             Contains("\"name\": \"mpm/v1_mirror/error_40_cells\"") && Contains("core_seconds"));
  const Outcome benchmarks = call(scratch, "bench fem --list");
  CHECK(benchmarks.code == 0);
  CHECK_THAT(benchmarks.out, Contains("fem/pm4sand") && Contains("fem/step") && !Contains("mpm/"));
  CHECK(call(scratch, "bench no_such").code == 2);
}

TEST_CASE("the committed workflows pass the check", "[cli]") {
  const Scratch scratch;
  for (const char* name : {"mochikoshi", "mochikoshi-static", "mochikoshi-opensees"}) {
    CAPTURE(name);
    const Outcome o = call(scratch, "check " + test::source("workflows/") + name + ".yaml");
    CHECK(o.code == 0);
    CHECK(o.err.empty());
  }
}

TEST_CASE("a section is drawn before anything runs", "[cli]") {
  const Scratch scratch;
  const std::string file = test::source("workflows/mochikoshi-static.yaml");
  const Outcome drawn = call(scratch, "plot " + file + " --out section.svg");
  CHECK(drawn.code == 0);
  CHECK_THAT(drawn.out, Contains("section.svg: 1849 elements, 2003 nodes"));
  const std::string svg = read_text_file(scratch / "section.svg");
  CHECK_THAT(svg, Contains("<svg") && Contains("tailings (") && Contains("runout begins here"));
  CHECK_FALSE(std::filesystem::exists(scratch / "runs"));
  const Outcome other = call(scratch, "plot " + file + " --out section.bmp");
  CHECK(other.code == 2);
  CHECK_THAT(other.err, Contains(".png, .svg and .pdf"));
  CHECK_FALSE(std::filesystem::exists(scratch / "section.bmp"));
  const std::vector<std::pair<std::string, std::string>> no_python{
      {"/nope", "there is no program '/nope'"},
      {"/bin/false", "'/bin/false' cannot draw them (it takes Python 3"},
      {"/bin/true", "'/bin/true' ran and left none"}};
  for (const auto& [python, text] : no_python) {
    const Outcome none = call(scratch, "plot " + file + " --out s.png --python " + python);
    CHECK(none.code == 4);
    CHECK_THAT(none.err, Contains(text) && Contains("--python") && !Contains("report"));
  }
}

TEST_CASE("a point is driven from its file", "[cli]") {
  const Scratch scratch;
  const std::string file = test::source("docs/guide/cyclic-shear.yaml");
  const std::string quick = " --set simple_shear.strain_step=2e-5 --set simple_shear.csr=0.2";
  const Outcome o = call(scratch, "point " + file + quick + " --csv shear.csv");
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("cycles to 3 % strain"));
  CHECK_THAT(read_text_file(scratch / "shear.csv"), Catch::StartsWith("gamma,eps_xx"));
  const Outcome typo = call(scratch, "point " + file + " --set simple_shear.crs=0.1");
  CHECK(typo.code == 2);
  CHECK_THAT(typo.err, Contains("crs") && Contains("csr"));
  const Outcome both = call(scratch, "point " + file + " --set simple_shear.reversal_strain=0.01");
  CHECK(both.code == 2);
  CHECK_THAT(both.err, Contains("cyclic-shear.yaml:") && Contains("2 of csr"));
  scratch.write("empty.yaml", "material: {}\nstress: {vertical: 1 kPa}\nsimple_shear: {}\n");
  const Outcome none = call(scratch, "point empty.yaml");
  CHECK(none.code == 2);
  CHECK_THAT(none.err, Contains("empty.yaml:1:11: material: ") && Contains("0 constitutive laws"));
  const std::vector<std::pair<std::string, std::string>> places{
      {"material.pm4sand.emax=0.1", "cyclic-shear.yaml:6:12: material.pm4sand: emax"},
      {"simple_shear.stop_strain=1e-6", "cyclic-shear.yaml:9:3: simple_shear: strain_step: 5e-06"},
      {"stress.vertical=1e300 Pa", "cyclic-shear.yaml: simple shear: the stress is not finite"},
      {"material.pm4sand.nb=1e300", "nb: '1e300' is out of range"},
      {"material.pm4sand.tolerance=1e-300", "tolerance: '1e-300' is out of range"},
      {"material.pm4sand.P_atm=101.3 Pa", "P_atm: '101.3 Pa' is out of range"}};
  for (const auto& [set, text] : places) {
    const Outcome refused = call(scratch, "point " + file + " --set '" + set + "'");
    CHECK((refused.code == 2 || refused.code == 3));
    CHECK_THAT(refused.err, Contains(text));
  }
  const std::string find = "point " + file + quick + " --find material.pm4sand.hpo";
  const Outcome found = call(scratch, find + " --cycles 4");
  CHECK(found.code == 0);
  CHECK_THAT(found.out, Contains("3 % of shear strain after 4 cycles") &&
                            Catch::Matches("(.|\\n)*cycles to 3 % strain +4.0\\n(.|\\n)*"));
  const std::vector<std::pair<std::string, std::string>> cannot{
      {find, "--cycles"},
      {find + " --cycles 1e9", "cycles from 0.5"},
      {"point " + file + " --find material.pm4sand.hp --cycles 4", "no plain number"},
      {"point " + file + " --find stress.vertical --cycles 4", "no plain number"},
      {"point " + file + " --set simple_shear.csr=null --find material.pm4sand.hpo --cycles 4",
       "turns at a shear stress"}};
  for (const auto& [words, text] : cannot) {
    const Outcome refused = call(scratch, words);
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Contains(text));
  }
  const Outcome coarse = call(scratch, "point " + file + " --set simple_shear.csr=0.001");
  CHECK(coarse.code == 0);
  CHECK_THAT(coarse.err, Contains("warning: simple_shear: shearing turned"));
}

TEST_CASE("inspect ends with 2 for terrain that cannot be read", "[cli]") {
  const Scratch scratch;
  scratch.write("t.asc", "nrows 2\nncols 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1 2\n3 4\n");
  const Outcome o = call(scratch, "inspect t.asc");
  CHECK(o.code == 2);
  CHECK_THAT(o.out, Contains("cellsize is 0"));
}

TEST_CASE("files are converted by kind and ending", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  REQUIRE(run(scratch, shake()).code == 0);
  std::filesystem::create_directory(scratch / "tables");
  std::filesystem::copy(scratch / "nodes.txt", scratch / "tables/nodeinfo.dat");
  std::filesystem::copy(scratch / "elements.txt", scratch / "tables/elementinfo.dat");
  CHECK(call(scratch, "convert tables mesh.h5").code == 0);
  CHECK(call(scratch, "convert mesh.h5 mesh.vtu").code == 0);
  CHECK(call(scratch, "convert mesh.h5 again").code == 0);
  CHECK(read_text_file(scratch / "again/nodeinfo.dat") == "1 0 0\n2 10 0\n3 10 10\n4 0 10\n");
  const Outcome history = call(scratch, "convert out/stages/shake/*/history.h5 recorders/");
  CHECK(history.code == 0);
  CHECK(read_text_file(scratch / "recorders/GporePressure.out") == "0 50 50 0 0\n");
  scratch.write("record.txt", "0 0\n0.01 0.1\n0.02 -0.1\n0.03 0\n");
  CHECK(call(scratch, "convert record.txt motion.h5 --unit g").code == 0);
  CHECK(call(scratch, "convert motion.h5 motion.csv").code == 0);
  CHECK_THAT(read_text_file(scratch / "motion.csv"), Contains("0.01,0.98"));

  const Outcome unknown = call(scratch, "convert mesh.h5 mesh.csv");
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("'mesh'") && Contains("mesh.h5 -> NAME.vtu"));
  CHECK(call(scratch, "convert nothing.h5 x.csv").code == 4);
  const Outcome unit = call(scratch, "convert record.txt other.csv");
  CHECK(unit.code == 2);
  CHECK_THAT(unit.err, Contains("record.txt: the unit of acceleration"));
  CHECK(call(scratch, "convert mesh.h5 motion.h5").code == 2);
}

TEST_CASE("the committed manual pages are those of the program", "[cli]") {
  const Scratch scratch;
  REQUIRE(call(scratch, "docs pages").code == 0);
  int pages = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch / "pages")) {
    const std::string name = entry.path().filename().string();
    INFO("build/release/flowslide docs docs/reference writes " << name);
    CHECK(read_text_file(entry.path()) == read_text_file(test::source("docs/reference/" + name)));
    ++pages;
  }
  CHECK(pages >= 5);
}

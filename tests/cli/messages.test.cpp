#include "tests/cli/program.hpp"

#include <cmath>
#include <sstream>
#include <sys/stat.h>

using namespace flowslide;
using namespace flowslide::cli::test;
using Catch::Contains;

TEST_CASE("words that are no command or stage lead to the nearest", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  CHECK_THAT(call(scratch, "rum x.yaml").err, Contains("Did you mean 'flowslide run'?"));
  CHECK_THAT(call(scratch, "xyzzy").err, Contains("Known: run, check"));
  REQUIRE(run(scratch, shake()).code == 0);
  const Outcome o = call(scratch, "check w.yaml --set stages.shak.with.bad_rows=stop");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("no such stage") && Contains("Did you mean 'shake'?"));
}

TEST_CASE("what a command line has wrong is named with what may be meant", "[cli]") {
  const Scratch scratch;
  const std::vector<std::pair<std::string, std::string>> cases{
      {"study rum x.yaml", "no command 'rum'. Did you mean 'flowslide study run'?"},
      {"run x.yaml --sett a=1", "no option '--sett'. Did you mean '--set'?"},
      {"run x.yaml --thread=2", "no option '--thread'. Did you mean '--threads'?"},
      {"run x.yaml --set a.b=1 m", "in quotes: --set 'a.b=1 m'."},
      {"schema x y", "'x y' is not expected here"},
      {"run x.yaml --out ''", "--out: is empty"},
      {"run x.yaml --out '~/x'", "'~' is not expanded"},
      {"point x.yaml --csv='~/x'", "'~' is not expanded"},
      {"convert x.h5 ''", "is empty"},
      {"docs '~'", "'~' is not expanded"},
      {"motion x.csv --pga 0.3", "--pga: '0.3' has no unit"},
      {"motion x.csv --dt 0.01g", "--dt: "},
      {"motion x.csv --pga ''", "--pga: is empty"},
      {"motion x.csv --pga=-1g", "--pga: '-1g' is no peak"},
      {"motion x.csv --pga 1e9g", "--pga: '1e9g' is no peak"},
      {"motion x.csv --unit ' '", "--unit: is blank"},
      {"motion x.csv --unit gg", "--unit: unknown unit 'gg'"},
      {"motion x.csv --time-column=-1", "not in range 0 to 10000"},
      {"convert x.csv y.h5 --unit gg", "--unit: unknown unit 'gg'"},
      {"plot x.yaml --python ''", "--python: is empty"},
      {"run ''", "file: is empty"},
      {"check ' '", "file: is blank"},
      {"motion ''", "files: is empty"},
      {"inspect ''", "path: is empty"},
      {"bench ''", "names: is empty"},
      {"run x.yaml --out ' '", "--out: is blank"},
      {"study run ''", "file: is empty"},
      {"study part '' 0", "file: is empty"},
      {"study status ''", "folder: is empty"},
      {"study table ' '", "folder: is blank"},
      {"study report ''", "folder: is empty"},
      {"study clean ''", "folder: is empty"}};
  for (const auto& [arguments, text] : cases) {
    CAPTURE(arguments);
    const Outcome o = call(scratch, arguments);
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Contains(text));
  }
  CHECK_FALSE(std::filesystem::exists(scratch / "~"));
}

TEST_CASE("a full disk behind the standard output is a matter of files", "[cli]") {
  const Scratch scratch;
  for (const char* arguments : {"schema", "--help", "bench --list"}) {
    CAPTURE(arguments);
    const std::string command = std::string(FLOWSLIDE_BINARY " ") + arguments + " >/dev/full 2>'" +
                                (scratch / "err.txt").string() + "'";
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 4);
    CHECK_THAT(read_text_file(scratch / "err.txt"), Contains("standard output"));
  }
}

TEST_CASE("files that cannot be read are a matter of files, with the system's reason", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  std::filesystem::create_symlink("loop", scratch / "loop");
  std::filesystem::create_symlink("gone", scratch / "link");
  const std::string name(300, 'x');
  const std::vector<std::pair<std::string, std::string>> cases{
      {"loop", "cannot be reached"},
      {"link", "link to gone"},
      {name, "cannot be reached"},
      {"no/such/file", "the folder no does not exist"},
      {"/dev/zero", "no regular file"}};
  for (const auto& [path, reason] : cases)
    for (const char* command : {"inspect ", "motion --unit g ", "run ", "check "}) {
      CAPTURE(command, path);
      const Outcome o = call(scratch, command + path);
      CHECK(o.code == 4);
      if (command == std::string("inspect ")) CHECK_THAT(o.err, Contains(reason));
    }
}

TEST_CASE("a missing recorder is named with its line and its folder", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  const auto with = [&](const std::string& path) {
    std::string stages = shake();
    stages.replace(stages.find("stress.out"), 10, path);
    return run(scratch, stages);
  };
  for (const auto& [path, reason] :
       std::vector<std::pair<std::string, std::string>>{{"gone.out", "no such file"},
                                                        {"data/stress.out", "the folder"},
                                                        {"~/stress.out", "'~' is not expanded"},
                                                        {".", "is a folder"}}) {
    CAPTURE(path);
    const Outcome o = with(path);
    CHECK(o.code == 4);
    CHECK_THAT(o.err,
               Contains("w.yaml:10:") && Contains("shake.with.gravity.stress") && Contains(reason));
  }
  CHECK(with("stress.out").code == 0);
  // Where it was looked for, as which of two folders counts is not the same for --set.
  const std::string here = scratch.path().string();
  CHECK_THAT(with("strss.out").err,
             Contains("Did you mean 'stress.out'?") &&
                 Contains("looked for in " + here + ": names in w.yaml are relative"));
  CHECK_THAT(with("'data/../strss.out'").err, !Contains("data"));
  CHECK(with("stress.out").code == 0);
  CHECK_THAT(call(scratch, "check w.yaml --set stages.shake.with.gravity.stress=x.out").err,
             Contains("looked for in " + here + ": names in --set are relative"));
}

TEST_CASE("warnings of an import are on the terminal, in the result, and told again", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  scratch.write("stress.out", "0.1 -40 -80 0\n");
  Outcome o = run(scratch, shake());
  CHECK(o.code == 0);
  CHECK(o.err.empty());  // control
  scratch.write("stress.out", "0.1 -100000 -200000 0\n");
  o = run(scratch, shake());
  CHECK(o.code == 0);
  CHECK_THAT(o.err, Catch::StartsWith("warning: shake: gravity: the total vertical stress"));
  CHECK_THAT(o.out, Contains("warnings before use"));
  CHECK_THAT(read_text_file(scratch / "out/result.json"),
             Contains("\"warnings\": [\n    \"shake: g"));
  o = run(scratch, shake());
  CHECK_THAT(o.out, Contains("up to date, 2 warnings (above)"));
  CHECK_THAT(o.err, Contains("total vertical stress"));
  CHECK_THAT(call(scratch, "check w.yaml").out, Contains("1 stages, 2 warnings"));
}

TEST_CASE("lines fit the terminal", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  scratch.write("stress.out", "0.1 -100000 -200000 0\n");
  REQUIRE(run(scratch, shake()).code == 0);
  const std::string run_again =
      "run w.yaml --out out --set stages.shake.with.sigma_zz.rule=elastic --set "
      "stages.shake.with.sigma_zz.nu=0.3";
  for (const std::size_t columns : {40U, 60U, 80U, 120U}) {
    CAPTURE(columns);
    const std::string text = on_terminal(scratch, run_again + " --dry-run", columns) +
                             on_terminal(scratch, "run w.yaml --out out", columns);
    CHECK_THAT(text, Contains("warning: shake: gravity:") && Contains("settings changed"));
    std::size_t longest = 0, width = 0;
    for (const char c : text) {
      width = c == '\n' || c == '\r' ? 0 : width + 1;
      longest = std::max(longest, width);
    }
    CHECK(longest <= columns);
    if (columns > 60) CHECK(longest > columns / 2);  // the width is used
  }
}

TEST_CASE("lines are whole in a file, and errors are wrapped on a terminal", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  REQUIRE(run(scratch, shake()).code == 0);
  const std::string long_name(90, 'x');
  const std::string wrong = "check w.yaml --set stages.shake.with." + long_name + "=1 2>&1";
  const std::string changes =
      "run w.yaml --out out --dry-run --set stages.shake.with.sigma_zz.rule=elastic --set "
      "stages.shake.with.sigma_zz.nu=0.3 --set stages.shake.with.materials.sand.density='1901 "
      "kg/m3'";
  const std::string whole = call(scratch, changes).out;
  CHECK_THAT(whole, Contains("nu") && !Contains("..."));
  CHECK(whole.find('\n') > 90);
  const std::string error = call(scratch, "check w.yaml --set stages.shake.wiht=1").err;
  CHECK(std::count(error.begin(), error.end(), '\n') == 1);
  std::string shown = on_terminal(scratch, "check w.yaml --set stages.shake.wiht=1", 40);
  CHECK(std::count(shown.begin(), shown.end(), '\n') > 2);
  CHECK_THAT(on_terminal(scratch, wrong, 40), Contains(long_name));  // never cut
  std::erase(shown, '\r');
  for (std::size_t at = 0; (at = shown.find("\n       ")) != std::string::npos;)
    shown.replace(at, 8, " ");
  CHECK(shown == error);
}

TEST_CASE("what is read is not written over, and no device is replaced", "[cli]") {
  const Scratch scratch;
  const std::string text = "0.00 0.1\n0.01 0.2\n0.02 -0.1\n";
  scratch.write("a.csv", text);
  scratch.write("p.yaml", "material: {}\n");
  REQUIRE(::mkfifo((scratch / "pipe.csv").c_str(), 0600) == 0);
  for (const char* same : {"convert a.csv a.csv --unit g", "convert a.csv ./a.csv --unit g",
                           "point p.yaml --csv p.yaml"}) {
    CAPTURE(same);
    const Outcome o = call(scratch, same);
    CHECK(o.code == 2);
    CHECK_THAT(o.err, Contains("is the file that is read"));
  }
  CHECK(read_text_file(scratch / "a.csv") == text);
  const Outcome pipe = call(scratch, "convert a.csv pipe.csv --unit g");
  CHECK(pipe.code == 4);
  CHECK_THAT(pipe.err, Contains("'pipe.csv' is a pipe or a device"));
  CHECK(std::filesystem::is_fifo(scratch / "pipe.csv"));
}

TEST_CASE("what lists things fits a narrow terminal", "[cli]") {
  const Scratch scratch;
  write_model(scratch);
  REQUIRE(run(scratch, shake()).code == 0);
  std::string record =
      "PEER\nTest\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS= 200, DT= .01 SEC\n";
  for (int i = 0; i < 200; ++i) record += std::to_string(0.1 * std::sin(0.3 * i)) + "\n";
  scratch.write("a.at2", record);
  for (const std::size_t columns : {40u, 60u, 80u}) {
    for (const char* arguments : {"--help", "run --help", "study run --help", "motion --help",
                                  "bench --list", "verify --list", "inspect out", "motion a.at2"}) {
      CAPTURE(arguments, columns);
      const std::string shown = on_terminal(scratch, arguments, columns);
      std::istringstream lines(shown);
      for (std::string line; std::getline(lines, line);) {
        std::erase(line, '\r');
        CAPTURE(line);
        CHECK(line.size() <= columns);
      }
    }
  }
  CHECK_THAT(on_terminal(scratch, "motion a.at2", 60), Contains("PGA        0.1000 g"));
  // Nothing is lost by it, and whoever reads a pipe gets whole lines.
  const auto words = [](const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> all;
    for (std::string word; in >> word;) all.push_back(word);
    return all;
  };
  for (const char* arguments : {"run --help", "verify --list"}) {
    const std::string piped = call(scratch, arguments).out;
    CHECK(words(on_terminal(scratch, arguments, 40)) == words(piped));
  }
  const std::string piped = call(scratch, "verify --list").out;
  CHECK_THAT(
      piped,
      Contains("fem/f1_patch               constant states on distorted elements (quick)\n"));
  CHECK_THAT(call(scratch, "motion a.at2").out, Contains("D5-95"));
}

TEST_CASE("numbers in two pairs of quotes and odd blanks are named", "[cli]") {
  const Scratch scratch;
  const auto check = [&](const std::string& with) {
    scratch.write(
        "w.yaml",
        "schema: 1\nname: w\nstages:\n  m:\n    uses: motion.prepare\n    with:\n" + with + "\n");
    return call(scratch, "check w.yaml");
  };
  CHECK(check("      preset: corinth\n      pga: \"0.3 g\"").code == 0);
  Outcome o = check("      preset: corinth\n      pga: '\"0.3 g\"'");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("w.yaml:8:") && Contains("in quotes twice"));
  o = check("      preset: corinth\n      pga: '\"5\"'");
  CHECK_THAT(o.err, Contains("in quotes twice"));
  o = check("      preset: corinth\n     \xC2\xA0pga: 0.3 g");
  CHECK(o.code == 2);
  CHECK_THAT(o.err, Contains("w.yaml:8:6: non-breaking space where YAML needs a blank"));
  o = check("      preset: corinth\n      pga: 0.3\xC2\xA0g");
  CHECK_THAT(o.err, Contains("w.yaml:8:") && Contains("non-breaking space"));
  o = check("      preset: corinth\n      pga: 0,3 g");
  CHECK_THAT(o.err, Contains("has ',' in a number"));
}

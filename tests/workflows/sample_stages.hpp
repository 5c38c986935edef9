#pragma once
#include "core/check.hpp"
#include "workflows/engine/stage.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

/// Small stages for the tests of the engine: numbers in text files.
namespace flowslide {

struct NumberFile;
struct TextFile;
template <>
inline constexpr std::string_view kArtifactKind<NumberFile> = "number";
template <>
inline constexpr std::string_view kArtifactKind<TextFile> = "text";

namespace sample {

inline double read_number(const std::filesystem::path& path) {
  double x = kUnset;
  std::ifstream(path) >> x;
  return x;
}

struct NumberConfig {
  double value = kUnset;
  std::optional<InputFile> note;
};

/// Writes its value, rounded to an integer.
struct NumberStage {
  static constexpr std::string_view name = "sample.number";
  static constexpr std::string_view doc = "A number.";
  static constexpr int version = 1;
  static constexpr bool checkpoints = false;
  using Config = NumberConfig;
  struct Inputs {
    void visit(auto&&) {}
  };
  struct Outputs {
    Artifact<NumberFile> number{"number.txt"};
    void visit(auto&& port) { port("number", number); }
  };
  static void check(const Config& c) {
    validate(c.value != 13.0, "value 13 is refused (it is used to test relations). Take 12.");
  }
  static StageResult run(const RunContext&, const Config& c, const Inputs&, const Outputs& out) {
    std::ofstream(out.number.path) << static_cast<int>(c.value + 0.5) << '\n';
    return {.facts = R"({"runout_m": 1.5, "stages": "not allowed here"})", .publish = {}};
  }
};

struct SumConfig {
  double factor = 1.0;
  bool fail = false;
};

struct SumStage {
  static constexpr std::string_view name = "sample.sum";
  static constexpr std::string_view doc = "Sum of two numbers times a factor.";
  static constexpr int version = 1;
  static constexpr bool checkpoints = false;
  using Config = SumConfig;
  struct Inputs {
    Artifact<NumberFile> a, b;
    void visit(auto&& port) {
      port("a", a);
      port("b", b);
    }
  };
  struct Outputs {
    Artifact<NumberFile> sum{"sum.txt"};
    Artifact<TextFile> folder{"view"};
    void visit(auto&& port) {
      port("sum", sum);
      port("folder", folder);
    }
  };
  static StageResult run(const RunContext& context, const Config& c, const Inputs& in,
                         const Outputs& out) {
    const double sum = c.factor * (read_number(in.a.path) + read_number(in.b.path));
    std::ofstream(out.sum.path) << sum << '\n';
    if (c.fail) throw NumericsError("the sum did not converge");
    std::filesystem::create_directory(out.folder.path);
    std::ofstream(out.folder.path / "1.vtu") << sum;
    std::ofstream(context.folder / "sum.pvd") << R"(<DataSet file="view/1.vtu"/>)";
    std::filesystem::create_directory(context.folder / "style");
    std::ofstream(context.folder / "style/pen.txt") << "blue\n";
    return {.facts = R"({"sum": )" + std::to_string(sum) + "}",
            .publish = {"sum.pvd", "view"},
            .give = {"style/pen.txt"}};
  }
};

struct CountConfig {
  int steps = 100;
  int step_us = 0;
};

/// A chain of numbers with a checkpoint after every step, itself written so that it can be killed
/// at any moment.
struct CountStage {
  static constexpr std::string_view name = "sample.count";
  static constexpr std::string_view doc = "Many small steps.";
  static constexpr int version = 1;
  static constexpr bool checkpoints = true;
  using Config = CountConfig;
  struct Inputs {
    Artifact<NumberFile> start;
    void visit(auto&& port) { port("start", start); }
  };
  struct Outputs {
    Artifact<NumberFile> last{"last.txt"};
    void visit(auto&& port) { port("last", last); }
  };
  static StageResult run(const RunContext& context, const Config& c, const Inputs& in,
                         const Outputs& out) {
    const std::filesystem::path checkpoint = context.folder / "checkpoint";
    std::uint64_t state = 0;
    int first = 0;
    if (!(std::ifstream(checkpoint) >> first >> state))
      state = static_cast<std::uint64_t>(read_number(in.start.path));
    std::ofstream(context.folder / "sessions", std::ios::app) << first << '\n';
    for (int step = first; step < c.steps; ++step) {
      if (context.progress.should_stop()) throw Interrupted("stopped");
      state = state * 6364136223846793005u + 1442695040888963407u;
      std::this_thread::sleep_for(std::chrono::microseconds(c.step_us));
      std::ofstream(checkpoint.string() + ".partial") << step + 1 << ' ' << state << '\n';
      std::filesystem::rename(checkpoint.string() + ".partial", checkpoint);
      context.progress.report((step + 1.0) / c.steps, "counting");
    }
    std::ofstream(out.last.path) << state << '\n';
    return {};
  }
};

}  // namespace sample

template <>
struct Schema<sample::NumberConfig> {
  static constexpr std::string_view doc = "A number.";
  static void describe(FieldVisitor& v, sample::NumberConfig& c) {
    v.quantity("value", c.value, Dim::none, {.min = 0.0}, "the number");
    v.file("note", c.note, "a file that counts as input");
  }
};

template <>
struct Schema<sample::SumConfig> {
  static constexpr std::string_view doc = "A sum.";
  static void describe(FieldVisitor& v, sample::SumConfig& c) {
    v.quantity("factor", c.factor, Dim::none, {}, "applied to the sum");
    v.flag("fail", c.fail, "fail half-way");
  }
};

template <>
struct Schema<sample::CountConfig> {
  static constexpr std::string_view doc = "A count.";
  static void describe(FieldVisitor& v, sample::CountConfig& c) {
    v.integer("steps", c.steps, {.min = 1}, "number of steps");
    v.integer("step_us", c.step_us, {.min = 0}, "pause after a step [us]");
  }
};

namespace sample {
inline std::vector<StageType> stages() {
  return {stage_type<NumberStage>(), stage_type<SumStage>(), stage_type<CountStage>()};
}
}  // namespace sample

}  // namespace flowslide

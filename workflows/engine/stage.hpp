#pragma once
#include "config/canonical.hpp"
#include "config/manual.hpp"
#include "config/schema.hpp"
#include "config/yaml.hpp"
#include "core/progress.hpp"
#include "workflows/engine/artifact.hpp"
#include "workflows/engine/work.hpp"

#include <any>
#include <concepts>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flowslide {

/// A stage whose result another one builds on, directly or not.
struct EarlierStage {
  struct Output {
    std::filesystem::path path;
    std::string sha256;
  };
  std::string name, uses;
  std::string settings;                   ///< canonical text, one "path = value" a line
  std::string facts;                      ///< JSON object
  std::map<std::string, Output> outputs;  ///< by port
};

/// What a stage may use besides its settings and files.
struct RunContext {
  std::filesystem::path folder;  ///< the stage's own: outputs and checkpoints go here
  int threads = 1;
  Progress progress;
  /// What identifies the run, as (name, text): workflow, program, hashes of the inputs.
  std::vector<std::pair<std::string, std::string>> provenance;
  /// For stages with `reads_warnings`: those of all stages before it, as "stage: text".
  std::vector<std::string> warnings = {};
  /// For stages with `reads_earlier`: all that feed it, in their order.
  std::vector<EarlierStage> earlier = {};
};

/// A fact that a run prints when it ends, and what stands before and behind it.
struct Headline {
  std::string fact;  ///< its name
  std::string text;  ///< "runout"
  std::string unit = {};
  std::string note = {};  ///< what explains the number; printed behind it
};

struct StageResult {
  std::string facts = "{}";  ///< JSON object; its entries go into result.json
  /// Files and folders in the stage's folder that appear at the top of the run folder, by name.
  std::vector<std::string> publish;
  /// Files that are copied to the top of the run folder, where they are the user's to change.
  std::vector<std::string> give = {};
  /// What a user must know before using the result, one sentence each: shown on the terminal when
  /// the stage ends and whenever its result is used again, in result.json and in the report.
  std::vector<std::string> warnings = {};
  /// Facts that are printed when the run ends, in this order, before those of earlier stages.
  std::vector<Headline> headlines = {};
};

/// What is wrong and what is odd about settings and the files they name, and how much there is to
/// do, before anything runs.
struct Findings {
  std::vector<std::string> errors, warnings;
  Work work = {};
};

/// What is known of each input before anything runs, by port; empty where nothing is.
using Previews = std::map<std::string, std::any>;

struct NoSettings {};
template <>
struct Schema<NoSettings> {
  static constexpr std::string_view doc = "This stage has no settings.";
  static void describe(FieldVisitor&, NoSettings&) {}
};

/// A stage declares everything the runner needs to order, skip, resume and explain it:
///
///     struct ZoneStage {
///       static constexpr std::string_view name = "transfer.zone";  // what `uses:` says
///       static constexpr std::string_view doc = "Finds the liquefied zone.";
///       // Raised when the same input gives new results.
///       static constexpr int version = 1;
///       // True: a killed run gets its folder back.
///       static constexpr bool checkpoints = false;
///       using Config = ZoneConfig;  // has a Schema
///       struct Inputs {
///         Artifact<FemHistory> history;
///         void visit(auto&& port) { port("history", history); }
///       };
///       struct Outputs {
///         Artifact<LiquefactionZone> zone{"zone.h5"};
///         void visit(auto&& port) { port("zone", zone); }
///       };
///       static StageResult run(const RunContext&, const Config&, const Inputs&, const Outputs&);
///     };
///
/// `static void check(const Config&)` is called, if there is one, before anything runs, and then,
/// in the order of the stages, `static std::any preview(const Config&, const Previews&,
/// Findings&)`: it opens the files that the settings name, compares the settings with those of
/// other stages, and returns what later stages may compare theirs with. With `static constexpr bool
/// reads_warnings = true`, run() gets the warnings of earlier stages, and other warnings make
/// another result; with `static constexpr bool reads_earlier = true`, it gets the settings and
/// results of all stages that feed it, likewise; with `static constexpr bool dated = true`, its
/// outputs tell the day on which they were made, and are other bytes on another day. `static
/// std::vector<std::string> programs(const Config&)` names what the stage would start at the word
/// of a workflow file; the engine asks for the user's. run() must give the same bytes for the same
/// settings and inputs, whatever the number of threads. With `checkpoints`, run() looks into
/// context.folder for its own checkpoint first.
template <class S>
concept Stage = requires(const RunContext& context, const typename S::Config& config,
                         const typename S::Inputs& in, const typename S::Outputs& out) {
  { S::name } -> std::convertible_to<std::string_view>;
  { S::doc } -> std::convertible_to<std::string_view>;
  { S::version } -> std::convertible_to<int>;
  { S::checkpoints } -> std::convertible_to<bool>;
  { S::run(context, config, in, out) } -> std::same_as<StageResult>;
};

struct Port {
  std::string name;
  std::string kind;
  std::string file;  ///< outputs: name in the stage's folder
};

/// Paths of all inputs and outputs by port name.
using PortPaths = std::map<std::string, std::filesystem::path>;

/// A stage with its settings read and checked.
struct PreparedStage {
  std::string settings;               ///< canonical text
  std::vector<HashedFile> files;      ///< that the settings name, as they were when read for it
  std::vector<std::string> programs;  ///< that the settings name and the stage would start
  std::function<StageResult(const RunContext&, const PortPaths&)> run;
  /// Empty if there is none. May throw what run() throws for wrong input and missing files.
  std::function<std::any(const Previews&, Findings&)> preview;
};

/// A Stage as a value; lists of these are what a workflow may use.
struct StageType {
  std::string name;
  std::string doc;
  int version = 0;
  bool checkpoints = false;
  bool reads_warnings = false;
  bool reads_earlier = false;
  bool dated = false;
  std::vector<Port> inputs, outputs;
  /// Reads and checks the settings. `with` is absent if the user gave none; `stage` is for
  /// messages.
  std::function<PreparedStage(const std::optional<YamlNode>& with, const YamlNode& stage)> prepare;
  std::function<std::string()> json_schema;                   ///< of the settings
  std::function<std::string(std::string_view title)> manual;  ///< Markdown page of the settings
};

namespace detail {

template <class S>
inline constexpr bool kReadsWarnings = false;
template <class S>
requires requires { S::reads_warnings; }
inline constexpr bool kReadsWarnings<S> = S::reads_warnings;
template <class S>
inline constexpr bool kReadsEarlier = false;
template <class S>
requires requires { S::reads_earlier; }
inline constexpr bool kReadsEarlier<S> = S::reads_earlier;
template <class S>
inline constexpr bool kDated = false;
template <class S>
requires requires { S::dated; }
inline constexpr bool kDated<S> = S::dated;

/// A problem, "path.of.setting: why" or "path.of.setting is ...", at the place where the setting is
/// written, or at that of all settings.
InputError locate(const YamlNode& settings, std::string_view text);

/// A FileError of canonical_text, "path.of.setting: why", at the place where the file is named.
FileError locate_file(const YamlNode& settings, std::string_view text);

template <class P>
std::vector<Port> list_ports() {
  std::vector<Port> ports;
  P{}.visit([&]<class T>(std::string_view name, Artifact<T>& a) {
    ports.push_back({std::string(name), std::string(kArtifactKind<T>), a.path.string()});
  });
  return ports;
}

template <class P>
P bind_ports(const PortPaths& paths) {
  P ports;
  ports.visit([&]<class T>(std::string_view name, Artifact<T>& a) {
    a.path = paths.at(std::string(name));
  });
  return ports;
}

}  // namespace detail

template <Stage S>
StageType stage_type() {
  StageType type{.name = std::string(S::name),
                 .doc = std::string(S::doc),
                 .version = S::version,
                 .checkpoints = S::checkpoints,
                 .reads_warnings = detail::kReadsWarnings<S>,
                 .reads_earlier = detail::kReadsEarlier<S>,
                 .dated = detail::kDated<S>,
                 .inputs = detail::list_ports<typename S::Inputs>(),
                 .outputs = detail::list_ports<typename S::Outputs>(),
                 .prepare = {},
                 .json_schema = json_schema<typename S::Config>,
                 .manual = manual_page<typename S::Config>};
  type.prepare = [](const std::optional<YamlNode>& with, const YamlNode& stage) {
    using Config = typename S::Config;
    const Config config = [&] {
      if (with) return read_settings<Config>(with, stage.path() + ".with");
      try {
        return read_settings<Config>(with, "with");
      } catch (const InputError& e) {
        throw stage.error(e.what());  // nothing written, so the place is that of the stage
      }
    }();
    if constexpr (requires { S::check(config); }) {
      try {
        S::check(config);
      } catch (const InputError& e) {
        throw with ? detail::locate(*with, e.what()) : stage.error(e.what());
      }
    }
    PreparedStage prepared;
    try {
      CanonicalSettings canonical = canonical_settings(config);
      prepared.settings = std::move(canonical.text);
      prepared.files = std::move(canonical.files);
    } catch (const FileError& e) {
      throw detail::locate_file(with.value_or(stage), e.what());
    }
    if constexpr (requires { S::programs(config); }) prepared.programs = S::programs(config);
    prepared.run = [config](const RunContext& context, const PortPaths& paths) {
      return S::run(context, config, detail::bind_ports<typename S::Inputs>(paths),
                    detail::bind_ports<typename S::Outputs>(paths));
    };
    if constexpr (requires(const Previews& in, Findings& found) {
                    { S::preview(config, in, found) } -> std::same_as<std::any>;
                  })
      prepared.preview = [config](const Previews& in, Findings& found) {
        return S::preview(config, in, found);
      };
    return prepared;
  };
  return type;
}

}  // namespace flowslide

#include "study/plan/plan.hpp"

#include "core/hash.hpp"
#include "study/plan/check_results.hpp"
#include "study/plan/perturb.hpp"
#include "study/plan/rows.hpp"
#include "study/plan/yaml_read.hpp"

#include <algorithm>
#include <any>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// What the preview of a stage returned and found.
struct Seen {
  std::any value;
  Findings found;
};
using SharedSeen = std::shared_ptr<const Seen>;

using Preview = std::function<std::any(const Previews&, Findings&)>;

/// A preview that looks once at what is equal, and passes on that it did: between the stages of the
/// planner previews are SharedSeen, whose address tells whether they are the same. `settings` are
/// those of the stage.
Preview remembering(Preview preview, std::string settings,
                    const std::shared_ptr<std::map<std::string, SharedSeen>>& known) {
  if (!preview) return preview;
  return [preview = std::move(preview), settings = std::move(settings), known](
             const Previews& in, Findings& found) -> std::any {
    std::string text = settings;
    for (const auto& [port, value] : in)
      text += fmt::format("\n{} {}", port, fmt::ptr(std::any_cast<const SharedSeen&>(value).get()));
    auto it = known->find(text);
    if (it == known->end()) {
      Previews plain;
      for (const auto& [port, value] : in)
        plain[port] = std::any_cast<const SharedSeen&>(value)->value;
      const auto seen = std::make_shared<Seen>();
      seen->value = preview(plain, seen->found);
      it = known->emplace(std::move(text), seen).first;
    }
    const Findings& said = it->second->found;
    found.errors.insert(found.errors.end(), said.errors.begin(), said.errors.end());
    found.warnings.insert(found.warnings.end(), said.warnings.begin(), said.warnings.end());
    found.work = said.work;
    return it->second;
  };
}

/// The same stage types, which read equal settings once, and look once at what these say of equal
/// inputs: rows differ in few of them.
std::vector<StageType> remembering(std::span<const StageType> types) {
  std::vector<StageType> result(types.begin(), types.end());
  for (StageType& type : result) {
    const auto known = std::make_shared<std::map<std::string, PreparedStage>>();
    const auto seen = std::make_shared<std::map<std::string, SharedSeen>>();
    type.prepare = [known, seen, prepare = type.prepare](const std::optional<YamlNode>& with,
                                                         const YamlNode& stage) {
      const std::string text =
          stage.folder().string() + "\n" + (with ? flow_text(*with) : std::string());
      if (const auto it = known->find(text); it != known->end()) return it->second;
      PreparedStage prepared = prepare(with, stage);
      prepared.preview = remembering(std::move(prepared.preview), text, seen);
      return known->emplace(text, std::move(prepared)).first->second;
    };
  }
  return result;
}

std::vector<std::string> as_overrides(const Settings& set) {
  std::vector<std::string> overrides;
  for (const auto& [path, value] : set) overrides.push_back(path + "=" + value);
  return overrides;
}

/// Where the study file says what a message of the workflow complains about.
std::string located(const std::string& text, const Draft& draft) {
  std::string result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    for (std::size_t i = 0; i < draft.set.size(); ++i)
      if (!draft.places[i].empty() && line.starts_with("--set " + draft.set[i].first + "=")) {
        line = draft.places[i] + ": " + line.substr(std::string_view("--set ").size());
        break;
      }
    result += (result.empty() ? "" : "\n") + line;
  }
  return result;
}

class Planner {
 public:
  Planner(Plan& plan, std::span<const StageType> types) : plan_(plan), types_(remembering(types)) {}

  void add(const Draft& draft) {
    Row& row = plan_.rows.emplace_back();
    row.number = plan_.rows.size();
    row.variant = draft.part->variant;
    row.workflow = draft.part->workflow;
    row.values = draft.values;
    row.repeat = draft.repeat;
    row.overrides = as_overrides(draft.set);
    if (draft.repeat == 0) undisturbed_.clear();
    try {
      if (draft.repeat > 0)
        row.disturbed = perturbations(load_yaml(row.workflow, row.overrides), *draft.part->repeat,
                                      draft.repeat);
      for (const std::string& option : as_overrides(row.disturbed)) row.overrides.push_back(option);
      const Workflow workflow = load_workflow(row.workflow, row.overrides, types_);
      for (const WorkflowStage& stage : workflow.stages)
        for (const std::string& program : stage.prepared.programs)
          if (std::find(plan_.programs.begin(), plan_.programs.end(), program) ==
              plan_.programs.end())
            plan_.programs.push_back(program);
      add_nodes(row, workflow);
      expect_disturbed(row, draft);
    } catch (const Error& e) {
      row.problem = located(e.what(), draft);
      row.code = e.exit_code();
    }
    std::string text;
    for (const std::size_t node : row.nodes) text += plan_.nodes[node].recipe + "\n";
    if (!row.problem.empty())
      for (const std::string& option : row.overrides) text += option + "\n";
    row.id = sha256(text).substr(0, 12);
  }

 private:
  /// A realisation that computes what the undisturbed one does would show a scatter of zero.
  void expect_disturbed(Row& row, const Draft& draft) {
    if (draft.repeat == 0) {
      undisturbed_ = row.nodes;
      return;
    }
    if (row.nodes != undisturbed_) return;
    row.nodes.clear();
    throw InputError(
        fmt::format("{}: realisation {} is the undisturbed one again (the step is lost in the "
                    "digits of what it disturbs, and the scatter would be zero). Make it larger.",
                    draft.part->repeat->place, draft.repeat));
  }

  void add_nodes(Row& row, const Workflow& workflow) {
    for (const WorkflowStage& stage : workflow.stages) {
      Node node{.stage = {}, .before = {}, .recipe = {}, .row = row.number - 1};
      std::string text = fmt::format("stage {}\nuses {}\nversion {}\n{}", stage.name,
                                     stage.type.name, stage.type.version, stage.prepared.settings);
      std::set<std::size_t> before;
      for (const Link& link : stage.inputs) {
        const std::size_t from = row.nodes[link.from_stage];
        text +=
            fmt::format("\ninput {} {} {}", link.port, plan_.nodes[from].recipe, link.from_port);
        before.insert(from);
        before.insert(plan_.nodes[from].before.begin(), plan_.nodes[from].before.end());
      }
      for (const std::size_t earlier : row.nodes)
        if (before.contains(earlier)) node.before.push_back(earlier);
      if (stage.type.reads_warnings)
        for (const std::size_t earlier : node.before)
          for (const std::string& warning : plan_.nodes[earlier].stage.warnings)
            text += "\nwarning " + warning;
      node.recipe = sha256(text);
      const auto [it, is_new] = by_recipe_.emplace(node.recipe, plan_.nodes.size());
      if (is_new) {
        node.stage = without_code(stage);
        for (Link& link : node.stage.inputs)
          link.from_stage = static_cast<std::size_t>(
              std::find(node.before.begin(), node.before.end(), row.nodes[link.from_stage]) -
              node.before.begin());
        plan_.nodes.push_back(std::move(node));
      }
      row.nodes.push_back(it->second);
    }
  }

  static WorkflowStage without_code(const WorkflowStage& stage) {
    WorkflowStage plain = stage;
    plain.type.prepare = {};
    plain.type.json_schema = {};
    plain.type.manual = {};
    plain.prepared.run = {};
    plain.prepared.preview = {};
    plain.prepared.files.clear();
    plain.preview.reset();
    return plain;
  }

  Plan& plan_;
  std::vector<StageType> types_;
  std::map<std::string, std::size_t> by_recipe_;
  std::vector<std::size_t> undisturbed_;  ///< nodes of realisation 0 of the row at hand
};

void add_input(std::vector<Input>& inputs, Input input) {
  const auto known = std::find_if(inputs.begin(), inputs.end(),
                                  [&](const Input& i) { return i.name == input.name; });
  if (known == inputs.end()) {
    inputs.push_back(std::move(input));
    return;
  }
  for (std::string& path : input.settings)
    if (std::find(known->settings.begin(), known->settings.end(), path) == known->settings.end())
      known->settings.push_back(std::move(path));
  if (known->unit != input.unit) known->unit.reset();
}

/// Every problem once, with how many rows it stops.
std::string problems_of(const Plan& plan) {
  std::vector<std::pair<std::string, std::size_t>> problems;
  for (const Row& row : plan.rows) {
    const auto known = std::find_if(problems.begin(), problems.end(),
                                    [&](const auto& p) { return p.first == row.problem; });
    if (known == problems.end())
      problems.emplace_back(row.problem, 1);
    else
      ++known->second;
  }
  std::string text;
  constexpr std::size_t kShown = 20;
  for (std::size_t i = 0; i < std::min(kShown, problems.size()); ++i)
    text += (text.empty() ? "" : "\n") + problems[i].first;
  if (problems.size() > kShown)
    text += fmt::format("\nand {} more problems", problems.size() - kShown);
  return text;
}

}  // namespace

std::vector<std::size_t> Node::reads() const {
  if (stage.type.reads_earlier) return before;
  std::vector<std::size_t> nodes;
  for (const Link& link : stage.inputs) nodes.push_back(before[link.from_stage]);
  return nodes;
}

std::string Row::label() const {
  std::string text = variant == "base" ? "" : variant;
  for (const auto& [name, value] : values)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
  if (repeat > 0) text += fmt::format("{}repeat {}", text.empty() ? "" : ", ", repeat);
  return text.empty() ? "as it is" : text;
}

Plan make_plan(const StudyFile& study, std::span<const StageType> types) {
  Plan plan{.name = study.name,
            .description = study.description,
            .file = study.file,
            .keep = study.keep,
            .disk_bytes = study.disk_bytes,
            .limits = study.limits,
            .analysis = study.analysis,
            .inputs = {},
            .rows = {},
            .nodes = {},
            .programs = {}};
  for (const Part& part : study.parts) {
    for (const Variable& v : part.vary) add_input(plan.inputs, {v.name, v.settings, v.unit, false});
    if (!part.sample) continue;
    for (const SampledInput& i : part.sample->inputs)
      add_input(plan.inputs, {i.name, i.settings, i.unit, true});
  }
  Planner planner(plan, types);
  for (const Draft& draft : expand(study)) planner.add(draft);
  validate(!plan.rows.empty(), "{}: has no rows (there is nothing to compute). Give a value.",
           study.file.string());
  if (std::all_of(plan.rows.begin(), plan.rows.end(),
                  [](const Row& row) { return !row.problem.empty(); })) {
    const int code = plan.rows.front().code;
    throw Error(code == 0 ? 2 : code, problems_of(plan));
  }
  check_results(study, plan);
  return plan;
}

Workflow workflow_of(const Plan& plan, std::size_t node) {
  Workflow workflow;
  std::vector<std::size_t> all = plan.nodes[node].before;
  all.push_back(node);
  for (const std::size_t n : all) {
    WorkflowStage stage = plan.nodes[n].stage;
    for (Link& link : stage.inputs) {
      const std::size_t from = plan.nodes[n].before[link.from_stage];
      link.from_stage =
          static_cast<std::size_t>(std::find(all.begin(), all.end(), from) - all.begin());
    }
    workflow.stages.push_back(std::move(stage));
  }
  return workflow;
}

}  // namespace flowslide::study

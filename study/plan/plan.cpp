#include "study/plan/plan.hpp"

#include "core/hash.hpp"
#include "study/plan/perturb.hpp"
#include "study/plan/rows.hpp"
#include "study/plan/yaml_read.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <sstream>

namespace flowslide::study {
namespace {

/// The same stage types, which read equal settings once: rows differ in few of them.
std::vector<StageType> remembering(std::span<const StageType> types) {
  std::vector<StageType> result(types.begin(), types.end());
  for (StageType& type : result) {
    const auto known = std::make_shared<std::map<std::string, PreparedStage>>();
    type.prepare = [known, prepare = type.prepare](const std::optional<YamlNode>& with,
                                                   const YamlNode& stage) {
      const std::string text =
          stage.folder().string() + "\n" + (with ? flow_text(*with) : std::string());
      if (const auto it = known->find(text); it != known->end()) return it->second;
      return known->emplace(text, prepare(with, stage)).first->second;
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
  Planner(Plan& plan, std::span<const StageType> types)
      : plan_(plan), types_(remembering(types)) {}

  void add(const Draft& draft) {
    Row& row = plan_.rows.emplace_back();
    row.number = plan_.rows.size();
    row.variant = draft.part->variant;
    row.workflow = draft.part->workflow;
    row.values = draft.values;
    row.repeat = draft.repeat;
    row.overrides = as_overrides(draft.set);
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
  void add_nodes(Row& row, const Workflow& workflow) {
    for (const WorkflowStage& stage : workflow.stages) {
      Node node{.stage = {}, .before = {}, .recipe = {}, .row = row.number - 1};
      std::string text = fmt::format("stage {}\nuses {}\nversion {}\n{}", stage.name,
                                     stage.type.name, stage.type.version, stage.prepared.settings);
      std::set<std::size_t> before;
      for (const Link& link : stage.inputs) {
        const std::size_t from = row.nodes[link.from_stage];
        text += fmt::format("\ninput {} {} {}", link.port, plan_.nodes[from].recipe, link.from_port);
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
    return plain;
  }

  Plan& plan_;
  std::vector<StageType> types_;
  std::map<std::string, std::size_t> by_recipe_;
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
  if (problems.size() > kShown) text += fmt::format("\nand {} more problems", problems.size() - kShown);
  return text;
}

}  // namespace

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
  if (std::all_of(plan.rows.begin(), plan.rows.end(),
                  [](const Row& row) { return !row.problem.empty(); })) {
    const int code = plan.rows.front().code;
    throw Error(code == 0 ? 2 : code, problems_of(plan));
  }
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
      link.from_stage = static_cast<std::size_t>(std::find(all.begin(), all.end(), from) - all.begin());
    }
    workflow.stages.push_back(std::move(stage));
  }
  return workflow;
}

}  // namespace flowslide::study

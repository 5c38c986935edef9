#include "workflows/engine/graph.hpp"

#include "workflows/engine/names.hpp"
#include "workflows/engine/unknown_key.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <fmt/format.h>

namespace flowslide {
namespace {

constexpr int kSchemaVersion = 1;

/// Collects the problems of a file so that the user sees all of them at once.
class Problems {
 public:
  template <class F>
  void collect(F&& part) {
    try {
      part();
    } catch (const FileError& e) {
      lines_.emplace_back(e.what());
    } catch (const InputError& e) {
      lines_.emplace_back(e.what());
      wrong_input_ = true;
    }
  }
  void raise() const {
    if (lines_.empty()) return;
    const std::string text = fmt::format("{}", fmt::join(lines_, "\n"));
    if (wrong_input_) throw InputError(text);
    throw FileError(text);
  }

 private:
  std::vector<std::string> lines_;
  bool wrong_input_ = false;
};

std::vector<std::string> names(const std::vector<Port>& ports) {
  std::vector<std::string> out;
  for (const Port& p : ports) out.push_back(p.name);
  return out;
}

const Port* find_port(const std::vector<Port>& ports, std::string_view name) {
  const auto it =
      std::find_if(ports.begin(), ports.end(), [&](const Port& p) { return p.name == name; });
  return it == ports.end() ? nullptr : &*it;
}

/// A stage as written, before its order is known; from_stage counts in file order.
struct Draft {
  WorkflowStage stage;
  std::vector<YamlNode> link_nodes;
};

/// `others` are the names of the other stages of the file.
const StageType& find_type(const YamlNode& node, std::span<const StageType> types,
                           const std::vector<std::string>& others) {
  const auto uses = node.find("uses");
  // What --set makes has no line: the name was meant to be that of another stage.
  if (!uses && node.key_where().line == 0)
    throw node.error(
        fmt::format("the file has no such stage. {}",
                    did_you_mean(node.path().substr(node.path().rfind('.') + 1), others)));
  if (!uses) throw node.error("the stage has no 'uses' (it must say what the stage does).");
  const std::string& wanted = uses->scalar();
  std::vector<std::string> known;
  for (const StageType& type : types) {
    if (type.name == wanted) return type;
    known.push_back(type.name);
  }
  throw uses->error(fmt::format("there is no stage '{}'. {}", wanted, did_you_mean(wanted, known)));
}

/// Connects the ports of one stage; all types are known by now.
void connect(Draft& draft, const YamlNode& node, const std::vector<Draft>& drafts) {
  const StageType& type = draft.stage.type;
  const auto in = node.find("in");
  if (in) refuse_unknown_keys(*in, names(type.inputs));
  std::vector<std::string> stage_names;
  for (const Draft& d : drafts) stage_names.push_back(d.stage.name);

  for (const Port& port : type.inputs) {
    const auto source = in ? in->find(port.name) : std::nullopt;
    if (!source) {
      std::vector<std::string> candidates;
      for (const Draft& d : drafts)
        for (const Port& out : d.stage.type.outputs)
          if (out.kind == port.kind) candidates.push_back(d.stage.name + "." + out.name);
      throw in.value_or(node).error(fmt::format(
          "input '{}' of stage '{}' is not connected (kind {}). {}", port.name, draft.stage.name,
          port.kind,
          candidates.empty() ? "No stage of this file makes that kind; add one that does."
                             : fmt::format("Write 'in: {{{}: {}}}'.", port.name, candidates[0])));
    }
    const std::string& text = source->scalar();
    const auto dot = text.rfind('.');
    if (dot == std::string::npos)
      throw source->error(fmt::format(
          "'{}' names no output port (expected 'stage.port', e.g. 'shake.history').", text));
    const std::string from = text.substr(0, dot), from_port = text.substr(dot + 1);
    const auto it = std::find(stage_names.begin(), stage_names.end(), from);
    if (it == stage_names.end())
      throw source->error(fmt::format("there is no stage named '{}' in this file. {}", from,
                                      did_you_mean(from, stage_names)));
    const Draft& source_stage = drafts[static_cast<std::size_t>(it - stage_names.begin())];
    if (source_stage.stage.type.name.empty()) continue;  // its own problem is already listed
    const Port* out = find_port(source_stage.stage.type.outputs, from_port);
    if (!out)
      throw source->error(
          fmt::format("stage '{}' ({}) has no output '{}'. {}", from, source_stage.stage.type.name,
                      from_port, did_you_mean(from_port, names(source_stage.stage.type.outputs))));
    if (out->kind != port.kind)
      throw source->error(fmt::format(
          "'{}' is of kind {} (input '{}' of {} takes {}). Connect an output of that kind.", text,
          out->kind, port.name, type.name, port.kind));
    draft.stage.inputs.push_back(
        {port.name, static_cast<std::size_t>(it - stage_names.begin()), from_port});
    draft.link_nodes.push_back(*source);
  }
}

/// Depth first from `index`; appends to `order` after everything it needs. `path` is the chain of
/// stages being visited.
void visit(std::size_t index, const std::vector<Draft>& drafts, std::vector<std::size_t>& order,
           std::vector<std::size_t>& path) {
  if (std::find(order.begin(), order.end(), index) != order.end()) return;
  path.push_back(index);
  const Draft& draft = drafts[index];
  for (std::size_t i = 0; i < draft.stage.inputs.size(); ++i) {
    const std::size_t from = draft.stage.inputs[i].from_stage;
    const auto seen = std::find(path.begin(), path.end(), from);
    if (seen != path.end()) {
      std::vector<std::string> chain{drafts[from].stage.name};
      for (auto p = path.end(); p != seen;) chain.push_back(drafts[*--p].stage.name);
      std::reverse(chain.begin(), chain.end());
      throw draft.link_nodes[i].error(
          fmt::format("the stages form a cycle: {} (a stage cannot wait for its own result). "
                      "Connect this input to an earlier stage.",
                      fmt::join(chain, " -> ")));
    }
    visit(from, drafts, order, path);
  }
  path.pop_back();
  order.push_back(index);
}

/// Stages in the order in which they can run; otherwise as in the file.
std::vector<WorkflowStage> sort_stages(std::vector<Draft>& drafts) {
  std::vector<std::size_t> order, path;
  for (std::size_t i = 0; i < drafts.size(); ++i) visit(i, drafts, order, path);
  std::vector<std::size_t> position(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) position[order[k]] = k;
  std::vector<WorkflowStage> sorted;
  for (std::size_t index : order) {
    for (Link& link : drafts[index].stage.inputs) link.from_stage = position[link.from_stage];
    sorted.push_back(std::move(drafts[index].stage));
  }
  return sorted;
}

/// Every line of a text as an error of its own at the place of a node.
InputError locate(const YamlNode& node, const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(detail::locate(node, line).what());
  return InputError(fmt::format("{}", fmt::join(lines, "\n")));
}

/// Lets each stage look at its files and at what is known of its inputs.
void preview_stages(Workflow& workflow, const YamlNode& stages, Problems& problems) {
  std::vector<std::map<std::string, std::any>> known(workflow.stages.size());  // by output port
  for (std::size_t i = 0; i < workflow.stages.size(); ++i) {
    WorkflowStage& stage = workflow.stages[i];
    if (!stage.prepared.preview) continue;
    const YamlNode node = *stages.find(stage.name);
    const YamlNode place = node.find("with").value_or(node);
    Previews inputs;
    for (const Link& link : stage.inputs)
      if (const auto it = known[link.from_stage].find(link.from_port);
          it != known[link.from_stage].end())
        inputs[link.port] = it->second;
    problems.collect([&] {
      Findings found;
      try {
        const std::any preview = stage.prepared.preview(inputs, found);
        for (const Port& port : stage.type.outputs) known[i][port.name] = preview;
        stage.preview = preview;
      } catch (const InputError& e) {
        found.errors.emplace_back(e.what());
      } catch (const FileError& e) {
        throw FileError(locate(place, e.what()).what());
      }
      stage.warnings = std::move(found.warnings);
      stage.work = found.work;
      if (!found.errors.empty())
        throw locate(place, fmt::format("{}", fmt::join(found.errors, "\n")));
    });
  }
}

void check_schema(const YamlNode& document) {
  const auto schema = document.find("schema");
  if (!schema)
    throw document.error(
        fmt::format("the file has no 'schema' (the version of its format). "
                    "Write 'schema: {}' as its first line.",
                    kSchemaVersion));
  if (schema->scalar() != std::to_string(kSchemaVersion))
    throw schema->error(fmt::format("schema {} is not known to this program (it reads {}).",
                                    schema->scalar(), kSchemaVersion));
}

using Entries = std::vector<std::pair<std::string, YamlNode>>;

/// The stages of the file with their types and settings; a type without a name where it is wrong.
std::vector<Draft> draft_stages(const Entries& entries, std::span<const StageType> types,
                                Problems& problems) {
  std::vector<Draft> drafts;
  for (const auto& [name, node] : entries) {
    Draft& draft = drafts.emplace_back();
    draft.stage.name = name;
    problems.collect([&, &name = name, &node = node] {
      if (!is_name(name))
        throw node.error(
            fmt::format("'{}' cannot be a stage's name (it becomes a folder). "
                        "Use letters, digits, '-' and '_'.",
                        name));
      refuse_unknown_stage_keys(node, {"uses", "in", "with"});
      std::vector<std::string> others;
      for (const auto& [other, unused] : entries)
        if (other != name) others.push_back(other);
      draft.stage.type = find_type(node, types, others);
    });
    if (draft.stage.type.name.empty()) continue;
    problems.collect([&, &node = node] {
      draft.stage.prepared = draft.stage.type.prepare(node.find("with"), node);
    });
  }
  return drafts;
}

}  // namespace

std::string workflow_name(const YamlNode& document) {
  const auto node = document.find("name");
  if (!node) throw document.error("the workflow has no 'name' (results are kept under it).");
  const std::string& name = node->scalar();
  if (!is_name(name))
    throw node->error(fmt::format(
        "'{}' cannot be a name (it becomes a folder). Use letters, digits, '-' and '_'.", name));
  return name;
}

Workflow load_workflow(const std::filesystem::path& path, std::span<const std::string> overrides,
                       std::span<const StageType> types) {
  const YamlNode document = load_yaml(path, overrides);
  if (document.kind() == YamlNode::Kind::map && document.find("study") && !document.find("stages"))
    throw document.error(
        "is a study, which names a workflow. Run it with 'flowslide study run': "
        "docs/guide/studies.md.");
  Workflow workflow{
      .name = {}, .file = path, .overrides = {overrides.begin(), overrides.end()}, .stages = {}};
  Problems problems;
  problems.collect([&] {
    refuse_unknown_top_keys(document, {"schema", "name", "description", "stages"});
  });
  problems.collect([&] { check_schema(document); });
  problems.collect([&] { workflow.name = workflow_name(document); });

  const auto stages = document.find("stages");
  problems.collect([&] {
    if (!stages || stages->entries().empty())
      throw stages.value_or(document).error("the workflow has no 'stages' (nothing to run).");
  });
  problems.raise();

  const Entries entries = stages->entries();
  std::vector<Draft> drafts = draft_stages(entries, types, problems);
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (drafts[i].stage.type.name.empty()) continue;
    problems.collect([&] { connect(drafts[i], entries[i].second, drafts); });
  }
  problems.collect([&] { workflow.stages = sort_stages(drafts); });
  problems.raise();
  preview_stages(workflow, *stages, problems);
  problems.raise();
  return workflow;
}

}  // namespace flowslide

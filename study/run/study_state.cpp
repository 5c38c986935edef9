#include "study/run/study_state.hpp"

#include "workflows/engine/program_version.hpp"
#include "workflows/engine/stage_inputs.hpp"

#include <algorithm>

namespace flowslide::study {

namespace {

/// Would this program fail again?
bool is_permanent(const Failure& failure) {
  return failure.permanent && failure.program == program_version();
}

}  // namespace

StudyState::StudyState(const Plan& plan, const Store& store)
    : plan_(plan), store_(store), nodes_(plan.nodes.size()) {
  resolve();
}

std::string StudyState::key_of(std::size_t node) const {
  const Workflow workflow = workflow_of(plan_, node);
  std::vector<const StageRecord*> results;
  for (const std::size_t before : plan_.nodes[node].before)
    results.push_back(&nodes_[before].finished->record);
  const WorkflowStage& stage = plan_.nodes[node].stage;
  return stage_key(
      stage.type, stage.prepared.settings,
      inputs_before(workflow, workflow.stages.back(), results, store_.folder()).hashes);
}

void StudyState::reopen(Retry retry) {
  retry_ = retry;
  for (NodeState& node : nodes_)
    if (node.state == State::failed || node.state == State::blocked) node.state = State::waiting;
  resolve();
}

void StudyState::resolve() {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    NodeState& node = nodes_[n];
    if (node.state != State::waiting) continue;
    bool known = true;
    for (const std::size_t before : plan_.nodes[n].before) {
      const NodeState& b = nodes_[before];
      if (b.state == State::failed || b.state == State::blocked) {
        node.state = State::blocked;
        node.blocker = b.state == State::blocked ? b.blocker : before;
        break;
      }
      known &= b.finished.has_value();
    }
    if (!known || node.state == State::blocked) continue;
    const std::string& stage = plan_.nodes[n].stage.name;
    if (node.key.empty()) node.key = key_of(n);
    node.finished = store_.finished(stage, node.key);
    if (node.finished) {
      node.state = State::done;
      continue;
    }
    node.failure = store_.failure(stage, node.key);
    const bool again = node.failure && (retry_ == Retry::all ||
                                        (retry_ == Retry::passing && !is_permanent(*node.failure)));
    node.state = node.failure && !again ? State::failed : State::ready;
  }
}

bool StudyState::is_open(std::size_t index) {
  NodeState& node = nodes_[index];
  const std::string& stage = plan_.nodes[index].stage.name;
  if (node.state == State::done) {
    node.again = node.again && !store_.has_files(stage, node.key);
    return node.again;
  }
  if ((node.finished = store_.finished(stage, node.key))) {
    node.state = State::done;
  } else if (!node.failure) {
    node.failure = store_.failure(stage, node.key);
    if (node.failure && is_permanent(*node.failure)) node.state = State::failed;
  }
  return node.state == State::ready;
}

State StudyState::row_state(const Row& row) const {
  if (!row.problem.empty()) return State::failed;
  State state = State::done;
  for (const std::size_t n : row.nodes) {
    const State s = nodes_[n].state;
    if (s == State::failed || s == State::blocked) return State::failed;
    if (s == State::running) state = State::running;
    if (s != State::done && state == State::done) state = State::waiting;
  }
  return state;
}

std::optional<std::size_t> StudyState::failed_node(const Row& row) const {
  for (const std::size_t n : row.nodes) {
    if (nodes_[n].state == State::failed) return n;
    if (nodes_[n].state == State::blocked) return nodes_[n].blocker;
  }
  return std::nullopt;
}

std::string StudyState::cause(const Row& row) const {
  if (!row.problem.empty()) return row.problem;
  const auto node = failed_node(row);
  if (!node) return "";
  const std::string& stage = plan_.nodes[*node].stage.name;
  const std::string text = nodes_[*node].failure ? nodes_[*node].failure->text : "unknown cause";
  return text.starts_with(stage + ": ") ? text : stage + ": " + text;
}

std::size_t StudyState::count(State state) const {
  return static_cast<std::size_t>(std::count_if(
      nodes_.begin(), nodes_.end(), [&](const NodeState& n) { return n.state == state; }));
}

}  // namespace flowslide::study

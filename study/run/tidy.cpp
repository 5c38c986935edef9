#include "study/run/tidy.hpp"

#include <algorithm>

namespace flowslide::study {
namespace {

struct Candidate {
  std::size_t node = 0;
  double bytes = 0.0, seconds = 0.0;
};

/// Nodes whose files are there and read by none that is still to run.
std::vector<std::size_t> free_nodes(const Plan& plan, const Store& store,
                                    const StudyState& progress) {
  std::vector<char> needed(plan.nodes.size(), 0);
  for (std::size_t n = 0; n < plan.nodes.size(); ++n) {
    const NodeState& state = progress.node(n);
    if (state.state == State::done && !state.again) continue;
    needed[n] = 1;
    for (const Link& link : plan.nodes[n].stage.inputs)
      needed[plan.nodes[n].before[link.from_stage]] = 1;
  }
  std::vector<std::size_t> result;
  for (std::size_t n = 0; n < plan.nodes.size(); ++n)
    if (!needed[n] && store.has_files(plan.nodes[n].stage.name, progress.node(n).key))
      result.push_back(n);
  return result;
}

/// Does it hold the frames of a runout, of which the last is kept beside it?
bool has_frames(const WorkflowStage& stage) {
  return std::any_of(stage.type.outputs.begin(), stage.type.outputs.end(), [](const Port& port) {
    return port.kind == kArtifactKind<MpmHistory>;
  });
}

void drop(const Plan& plan, const Store& store, const StudyState& progress, Locks& locks,
          std::size_t node) {
  const std::string& key = progress.node(node).key;
  if (!locks.take(key)) return;
  store.drop_files(plan.nodes[node].stage.name, key);
  locks.release(key);
}

}  // namespace

double tidy(const Plan& plan, const Store& store, const StudyState& progress, Locks& locks) {
  const auto used = [&] { return bytes_of(store.folder() / "stages"); };
  if (plan.keep == Keep::frames) return used();
  std::vector<Candidate> rest;
  for (const std::size_t n : free_nodes(plan, store, progress)) {
    const WorkflowStage& stage = plan.nodes[n].stage;
    if (plan.keep == Keep::numbers || has_frames(stage))
      drop(plan, store, progress, locks, n);
    else
      rest.push_back({n, bytes_of(store.result(stage.name, progress.node(n).key)),
                      progress.node(n).finished->record.seconds});
  }
  double bytes = used();
  std::sort(rest.begin(), rest.end(), [](const Candidate& a, const Candidate& b) {
    return a.seconds * b.bytes < b.seconds * a.bytes;
  });
  for (const Candidate& c : rest) {
    if (bytes <= plan.disk_bytes) break;
    drop(plan, store, progress, locks, c.node);
    bytes = used();
  }
  return bytes;
}

}  // namespace flowslide::study

#include "study/run/tidy.hpp"

#include <algorithm>
#include <tuple>

namespace flowslide::study {
namespace {

/// Does it hold the frames of a runout, of which the last is kept beside it?
bool has_frames(const WorkflowStage& stage) {
  return std::any_of(stage.type.outputs.begin(), stage.type.outputs.end(),
                     [](const Port& port) { return port.kind == kArtifactKind<MpmHistory>; });
}

}  // namespace

Tidier::Tidier(const Plan& plan, const Store& store, Locks& locks)
    : plan_(plan), store_(store), locks_(locks) {}

std::string Tidier::name_of(const StudyState& progress, std::size_t node) const {
  // Equal settings have equal keys, whatever the stage is called.
  return plan_.nodes[node].stage.name + "/" + progress.node(node).key;
}

void Tidier::made(const StudyState& progress, std::size_t node) {
  kept_.erase(name_of(progress, node));
}

void Tidier::measure(const StudyState& progress) {
  const auto name = [&](std::size_t n) { return name_of(progress, n); };
  needed_.clear();
  for (std::size_t n = 0; n < plan_.nodes.size(); ++n) {
    const NodeState& state = progress.node(n);
    const WorkflowStage& stage = plan_.nodes[n].stage;
    if (state.state != State::done || state.again) {
      needed_.insert(name(n));
      for (const std::size_t from : plan_.nodes[n].reads()) needed_.insert(name(from));
      kept_.erase(name(n));  // measured when it is there
      continue;
    }
    const auto [it, is_new] = kept_.try_emplace(name(n));
    if (!is_new) continue;
    Kept& kept = it->second;
    kept.stage = stage.name;
    kept.key = state.key;
    kept.bytes = bytes_of(store_.result(stage.name, state.key));
    for (const std::string_view ending : {".json", ".final.h5"})
      kept.beside += bytes_of(store_.beside(stage.name, state.key, ending));
    kept.seconds = state.finished->record.seconds;
    kept.has_frames = has_frames(stage);
  }
}

void Tidier::drop(Kept& kept) {
  if (!locks_.take(kept.key)) return;
  store_.drop_files(kept.stage, kept.key);
  locks_.release(kept.key);
  kept.bytes = 0.0;
}

double Tidier::tidy(const StudyState& progress) {
  measure(progress);
  const auto used = [&] {
    double sum = rest_;
    for (const auto& [key, kept] : kept_) sum += kept.bytes + kept.beside;
    return sum;
  };
  if (first_) rest_ = std::max(0.0, bytes_of(store_.folder() / "stages") - used());
  first_ = false;
  if (plan_.keep == Keep::frames) return used();
  std::vector<Kept*> at_once, rest;
  for (auto& [name, kept] : kept_)
    if (kept.bytes > 0.0 && !needed_.contains(name))
      (plan_.keep == Keep::numbers || kept.has_frames ? at_once : rest).push_back(&kept);
  for (Kept* kept : at_once) drop(*kept);
  // The order of a hashed map is that of the library.
  std::sort(rest.begin(), rest.end(), [](const Kept* a, const Kept* b) {
    const double x = a->seconds * b->bytes, y = b->seconds * a->bytes;
    return x != y ? x < y : std::tie(a->stage, a->key) < std::tie(b->stage, b->key);
  });
  double bytes = used();
  for (Kept* kept : rest) {
    if (bytes <= plan_.disk_bytes) break;
    bytes -= kept->bytes;
    drop(*kept);
    bytes += kept->bytes;
  }
  return bytes;
}

}  // namespace flowslide::study

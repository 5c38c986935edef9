#include "fem/checkpoint.hpp"

#include "model/checkpoint_file.hpp"

#include <algorithm>

namespace flowslide::fem {
namespace {

// Changes whenever the list of fields below changes.
constexpr std::uint64_t kFields = 0x7368616b65637035;

/// One list of fields for both directions: `Archive` writes or reads each. The forces carry the
/// damping of the step that made them, so they belong to the state.
template <class Archive, class S, class Run>
void transfer_fields(Archive& a, S& s, Run& run) {
  a.value(run);
  auto& t = s.state;
  a.value(t.time);
  a.value(t.step);
  a.array(t.displacement);
  a.array(t.velocity);
  a.array(t.pressure);
  a.array(t.stress);
  a.array(t.hourglass_x);
  a.array(t.hourglass_y);
  std::apply([&](auto&... states) { (a.array(states.of), ...); }, t.laws);
  a.value(t.last_dt);
  a.value(t.energy);
  a.value(t.pending);
  a.value(t.pending_deformation);
  a.value(t.pending_viscous);
  a.value(s.dt);
  a.array(s.lambda);
  a.array(s.shear);
  a.array(s.water.mobility_x);
  a.array(s.water.mobility_y);
  a.value(s.counters);
  a.array(s.entry_force);
}

/// Gives the lengths of the arrays in the list.
struct Lengths {
  std::vector<std::size_t> found;
  void value(const auto&) {}
  void array(const auto& x) { found.push_back(x.size()); }
};

std::vector<std::size_t> array_lengths(const Solver& s, const RunState& run) {
  Lengths lengths;
  transfer_fields(lengths, s, run);
  return lengths.found;
}

/// Above what counters that are reset every few steps can reach.
constexpr int kMostCounted = 1000;

}  // namespace

std::string fingerprint(const SectionMesh& section, const GroundMotion& motion,
                        const FemConfig& config, const std::string& stop_rule) {
  Sha256 digest;
  const auto text = [&](const std::string& x) { digest.add(x.c_str(), x.size() + 1); };
  const auto array = [&](const auto& x) {
    const std::uint64_t size = x.size();
    digest.add(&size, sizeof size);
    digest.add(x.data(), x.size() * sizeof(x[0]));
  };
  text(canonical_text(config));
  text(stop_rule);
  array(section.mesh.nodes);
  array(section.mesh.elements);
  array(section.mesh.element_material);
  for (const MaterialName& m : section.materials) text(fmt::format("{} {}", m.tag, m.name));
  for (const EdgeSet& set : section.sets) {
    text(set.name);
    array(set.edges);
  }
  digest.add(&motion.dt, sizeof motion.dt);
  array(motion.acceleration);
  return digest.hex();
}

void write_checkpoint(const std::filesystem::path& path, const std::string& fingerprint,
                      const Solver& s, const RunState& run) {
  CheckpointWriter out(path, kFields);
  out.array(std::vector<char>(fingerprint.begin(), fingerprint.end()));
  transfer_fields(out, s, run);
  out.finish();
}

void read_checkpoint(const std::filesystem::path& path, const std::string& fingerprint, Solver& s,
                     RunState& run) {
  CheckpointReader in(path, kFields);
  std::vector<char> found;
  in.array(found);
  if (std::string(found.begin(), found.end()) != fingerprint)
    in.refuse("it belongs to a run with another section, motion or other settings");
  const std::vector<std::size_t> lengths = array_lengths(s, run);
  transfer_fields(in, s, run);
  in.finish();
  if (array_lengths(s, run) != lengths) in.refuse("its arrays do not fit this section");
}

void check_progress(const std::filesystem::path& path, const Solver& s, const RunState& run,
                    double end, double output_interval) {
  const double slack = 1e-6 * output_interval, recorded = static_cast<double>(run.output - 1);
  const bool in_order = run.output >= 1 && s.state.time >= recorded * output_interval - slack &&
                        s.state.time <= std::min(end, (recorded + 1.0) * output_interval) + slack &&
                        s.state.step > 0 && s.dt > 0.0 && s.dt <= end + output_interval &&
                        s.state.last_dt >= 0.0 && run.since >= 0 && run.since <= kMostCounted &&
                        run.implicit.halvings >= 0 && run.implicit.halvings <= kMostCounted &&
                        run.implicit.in_a_row >= 0 && run.implicit.in_a_row <= kMostCounted;
  if (!in_order) refuse_checkpoint(path, "its times, steps or counts cannot be those of this run");
}

}  // namespace flowslide::fem

#include "mpm/solver/checkpoint.hpp"

#include "model/checkpoint_file.hpp"
#include "mpm/solver/checkpoint_check.hpp"

namespace flowslide::mpm {
namespace {

// Changes whenever the list of fields below changes.
constexpr std::uint64_t kFields = 0x666c6f77636b7034;

/// One list of fields for both directions: `Archive` writes or reads each.
template <class Archive, class Sim, class Run>
void transfer_fields(Archive& a, Sim& s, Run& r) {
  a.value(r.frames);
  a.value(r.samples);
  a.value(r.next_frame);
  a.value(r.next_sample);
  a.value(r.peak_kinetic);
  a.value(r.mass_start);
  a.value(r.kinetic_start);
  a.value(r.potential_start);
  a.value(r.recoverable_start);
  a.value(r.momentum_start);
  a.value(r.first_dt);
  a.value(r.updates);
  a.value(r.short_steps);
  a.value(r.energy);
  a.array(r.recent);
  a.value(s.time);
  a.value(s.dt);
  a.value(s.step);
  a.value(s.drift);
  a.value(s.binned);
  a.value(s.last);
  a.value(s.balance);
  a.array(s.tiling.tiles);
  a.array(s.tiling.run_first);
  a.array(s.tiling.runs);
  a.array(s.contact.impulse);
  a.value(s.contact.absorbing.supported);
  a.array(s.contact.absorbing.dashpots);
  a.value(s.sleep.next_look);
  a.value(s.sleep.count);
  for (auto& x : s.sleep.place) a.array(x);
  a.array(s.sleep.since);
  a.array(s.sleep.asleep);
  visit_arrays(s.points, [&](auto& array) { a.array(array); });
  visit_arrays(s.gone, [&](auto& array) { a.array(array); });
}

}  // namespace

template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Simulation<Dim>& s,
                      const RunState& run) {
  CheckpointWriter out(path, kFields);
  transfer_fields(out, s, run);
  out.finish();
}

template <int Dim>
void read_checkpoint(const std::filesystem::path& path, Simulation<Dim>& s, RunState& run) {
  const std::size_t points = s.points.size();
  CheckpointReader in(path, kFields);
  transfer_fields(in, s, run);
  in.finish();
  if (const std::string misfit = find_misfit(s, run, points); !misfit.empty()) in.refuse(misfit);
}

template <int Dim>
void check_walls(const std::filesystem::path& path, const Simulation<Dim>& s) {
  if (s.contact.impulse.size() != s.contact.walls.size())
    refuse_checkpoint(path, "it has impulses of other walls than this run");
}

template void write_checkpoint<2>(const std::filesystem::path&, const Simulation<2>&,
                                  const RunState&);
template void write_checkpoint<3>(const std::filesystem::path&, const Simulation<3>&,
                                  const RunState&);
template void check_walls<2>(const std::filesystem::path&, const Simulation<2>&);
template void check_walls<3>(const std::filesystem::path&, const Simulation<3>&);
template void read_checkpoint<2>(const std::filesystem::path&, Simulation<2>&, RunState&);
template void read_checkpoint<3>(const std::filesystem::path&, Simulation<3>&, RunState&);

}  // namespace flowslide::mpm

#include "model/mpm_history.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "model/append_file.hpp"
#include "model/field_store.hpp"
#include "model/frame_row.hpp"
#include "model/particle_io.hpp"
#include "model/parts_folder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flowslide {
namespace {

constexpr std::string_view kMpmHistory = "mpm_history";
constexpr int kMpmHistoryFormat = 3,
              kOldestMpmHistory = 3;  // 2 had no toe, no rule of rest, no fronts by mass

/// The one list of the arrays of a frame: f(name, label, array).
template <class Frame, class F>
void visit_point_arrays(Frame& frame, F&& f) {
  f("position", FieldLabel{.unit = "m"}, frame.position);
  f("velocity", FieldLabel{.unit = "m/s"}, frame.velocity);
  f("stress", FieldLabel{.unit = "Pa", .convention = "total, tension positive, xx yy zz xy yz zx"},
    frame.stress);
  f("volume", FieldLabel{.unit = "m3", .convention = "per metre of width in plane strain"},
    frame.volume);
  f("plastic_strain",
    FieldLabel{.unit = "-", .convention = "accumulated eps_q", .nan = Nan::allowed},
    frame.plastic_strain);
  f("strength",
    FieldLabel{
        .unit = "Pa", .convention = "present undrained strength or cohesion", .nan = Nan::allowed},
    frame.strength);
}

/// The one list of what a rule of rest has: f(name, unit, value).
template <class Rule, class F>
void visit_rule(Rule& rule, F&& f) {
  f("kinetic_share", "-", rule.kinetic_share);
  f("runout_change", "m", rule.runout_change);
  f("window", "s", rule.window);
}

/// Doubles of one frame: time, 3 + 3 + 6 + 1 + 1 + 1 per particle.
std::size_t frame_doubles(std::size_t particles) { return 1 + 15 * particles; }

ParticleSet sorted_by_id(const ParticleSet& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&p](std::size_t a, std::size_t b) { return p.id[a] < p.id[b]; });
  ParticleSet sorted = p;
  const auto permute = [&order](auto& array) {
    auto from = array;
    for (std::size_t i = 0; i < order.size(); ++i) array[i] = from[order[i]];
  };
  visit_fields(sorted, [&permute](auto, auto, auto& array) { permute(array); });
  for (auto& [name, values] : sorted.history) permute(values);
  return sorted;
}

}  // namespace

/// While it is written, a history is a folder of append-only files: after a kill they are cut back
/// to what a checkpoint knows of. finish() makes the HDF5 file from them in one pass, so that its
/// bytes do not depend on how often the run was interrupted.
struct MpmHistoryWriter::Impl {
  std::filesystem::path path;
  ParticleSet initial;
  RestRule rest;
  PartsFolder folder;
  AppendFile frames, samples;
  std::vector<double> record;
  double last_time = -1e300;

  Impl(std::filesystem::path target, const ParticleSet& particles, const RestRule& rule,
       std::size_t keep_frames, std::size_t keep_samples)
      : path(std::move(target)),
        initial(sorted_by_id(particles)),
        rest(rule),
        folder(path, keep_frames == 0),
        frames(folder / "frames.bin", frame_doubles(initial.size()) * sizeof(double), keep_frames),
        samples(folder / "samples.bin", sizeof(MpmSample), keep_samples),
        record(frame_doubles(initial.size())) {
    if (keep_frames > 0) last_time = frame(keep_frames - 1).time;
  }

  [[nodiscard]] MpmFrame frame(std::size_t index) {
    frames.read(index, record.data());
    const double* from = record.data();
    MpmFrame frame;
    frame.time = *from++;
    visit_point_arrays(frame, [this, &from](auto, auto&&, auto& array) {
      from = take_row(from, initial.size(), array);
    });
    return frame;
  }
};

MpmHistoryWriter::MpmHistoryWriter(const std::filesystem::path& path, const ParticleSet& initial,
                                   const RestRule& rest, std::size_t frames, std::size_t samples) {
  check(initial);
  impl_ = std::make_unique<Impl>(path, initial, rest, frames, samples);
}

MpmHistoryWriter::~MpmHistoryWriter() = default;

void MpmHistoryWriter::append(const MpmFrame& frame) {
  const std::size_t n = impl_->initial.size();
  validate(frame.time > impl_->last_time,
           "frame {} is at t = {} s (times must increase, the frame before is "
           "at {} s)",
           impl_->frames.size(), frame.time, impl_->last_time);
  visit_point_arrays(
      frame, [this, n, &frame](const char* name, const FieldLabel& label, const auto& array) {
        validate(array.size() == n, "frame at t = {} s: {} has {} values (there are {} particles)",
                 frame.time, name, array.size(), n);
        const double* values = reinterpret_cast<const double*>(array.data());
        const std::size_t width = width_of(array);
        for (std::size_t i = 0; i < n * width; ++i)
          if (!(std::isfinite(values[i]) || (label.nan == Nan::allowed && std::isnan(values[i]))))
            throw NumericsError(
                fmt::format("frame at t = {} s: {} of particle {} is {} (the run has "
                            "become unstable); take a smaller time step",
                            frame.time, name, impl_->initial.id[i / width], values[i]));
      });
  double* to = impl_->record.data();
  *to++ = frame.time;
  visit_point_arrays(frame, [&to](auto, auto&&, const auto& array) { to = put_row(array, to); });
  impl_->frames.append(impl_->record.data());
  impl_->last_time = frame.time;
}

void MpmHistoryWriter::append(const MpmSample& sample) {
  for (const SampleColumn& c : kSampleColumns)
    if (!std::isfinite(sample.*c.value))
      throw NumericsError(
          fmt::format("time series at t = {} s: {} is {} (the run has become "
                      "unstable); take a smaller time step",
                      sample.time, c.name, sample.*c.value));
  impl_->samples.append(&sample);
}

void MpmHistoryWriter::flush() {
  impl_->frames.sync();
  impl_->samples.sync();
}

void MpmHistoryWriter::finish() {
  const std::filesystem::path joined = impl_->folder / "joined.h5";
  FieldWriter out(joined, kMpmHistory, kMpmHistoryFormat);
  write_particles(out, impl_->initial);
  visit_rule(impl_->rest, [&out](const char* name, const char* unit, double value) {
    out.write(std::string("rest/") + name, std::vector<double>{value}, {.unit = unit});
  });
  std::vector<double> times;
  for (std::size_t i = 0; i < impl_->frames.size(); ++i) {
    const MpmFrame frame = impl_->frame(i);
    times.push_back(frame.time);
    visit_point_arrays(frame, [&out](const char* name, const FieldLabel& label, const auto& array) {
      out.append(std::string("frames/") + name, array, label);
    });
  }
  out.write("frames/time", times, {.unit = "s", .convention = "since transfer"});
  std::vector<MpmSample> samples(impl_->samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) impl_->samples.read(i, &samples[i]);
  for (const SampleColumn& c : kSampleColumns) {
    std::vector<double> column;
    for (const MpmSample& s : samples) column.push_back(s.*c.value);
    out.write(std::string("samples/") + c.name, column, {.unit = c.unit});
  }
  out.finish();
  rename_durably(joined, impl_->path);
}

void MpmHistoryWriter::remove_parts() { impl_->folder.remove(); }

struct MpmHistory::Impl {
  FieldReader in;
  ParticleSet initial;
  RestRule rest;
  std::vector<double> times;
  std::vector<MpmSample> samples;
};

MpmHistory::MpmHistory(const std::filesystem::path& path)
    : impl_(new Impl{.in = FieldReader(path, kMpmHistory, kMpmHistoryFormat, kOldestMpmHistory),
                     .initial = {},
                     .rest = {},
                     .times = {},
                     .samples = {}}) {
  const FieldReader& in = impl_->in;
  impl_->initial = read_particles(in);
  visit_rule(impl_->rest, [&in](const char* name, const char*, double& value) {
    value = in.read_one<double>(std::string("rest/") + name);
  });
  impl_->times = in.read<double>("frames/time");
  impl_->samples.resize(in.rows("samples/time"));
  for (const SampleColumn& c : kSampleColumns) {
    const auto column = in.read<double>(std::string("samples/") + c.name, impl_->samples.size());
    for (std::size_t i = 0; i < column.size(); ++i) impl_->samples[i].*c.value = column[i];
  }
}

MpmHistory::~MpmHistory() = default;
MpmHistory::MpmHistory(MpmHistory&&) noexcept = default;
MpmHistory& MpmHistory::operator=(MpmHistory&&) noexcept = default;

const ParticleSet& MpmHistory::initial() const { return impl_->initial; }
const RestRule& MpmHistory::rest() const { return impl_->rest; }
std::size_t MpmHistory::num_frames() const { return impl_->times.size(); }
const std::vector<double>& MpmHistory::times() const { return impl_->times; }
const std::vector<MpmSample>& MpmHistory::samples() const { return impl_->samples; }

MpmFrame MpmHistory::frame(std::size_t index) const { return read(index, false); }
MpmFrame MpmHistory::motion(std::size_t index) const { return read(index, true); }

MpmFrame MpmHistory::read(std::size_t index, bool motion_only) const {
  validate(index < num_frames(), "'{}' has no frame {} (it has {})", impl_->in.path().string(),
           index, num_frames());
  MpmFrame frame;
  frame.time = impl_->times[index];
  visit_point_arrays(frame, [&](const char* name, const FieldLabel& label, auto& array) {
    using T = typename std::decay_t<decltype(array)>::value_type;
    const std::string_view field = name;
    if (motion_only && field != "position" && field != "velocity" && field != "strength") return;
    array = impl_->in.read_row<T>(std::string("frames/") + name, index, impl_->initial.size(),
                                  label.nan);
  });
  return frame;
}

}  // namespace flowslide

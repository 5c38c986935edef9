#include "importers/opensees.hpp"

#include "core/check.hpp"
#include "core/units.hpp"
#include "importers/mesh_faults.hpp"
#include "importers/mesh_overlap.hpp"
#include "importers/plausibility.hpp"
#include "importers/recorder_columns.hpp"
#include "importers/recorder_rows.hpp"
#include "importers/recorder_text.hpp"
#include "importers/row_warnings.hpp"
#include "model/mirror.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace flowslide {
namespace {

struct Factors {
  double length;
  double time;
  double stress;
};

struct Context {
  const OpenSeesConfig& config;
  const QuadMesh& mesh;
  Factors factors;
  std::vector<std::string>* notes;
  std::vector<std::string>* warnings;

  [[nodiscard]] ColumnLayout nodal(const std::vector<std::string>& components) const {
    return {config.columns.time, components, "node", &mesh.node_tags,
            config.mesh.nodes.path.filename().string()};
  }
  [[nodiscard]] ColumnLayout elemental(const std::vector<std::string>& components) const {
    return {config.columns.time, components, "element", &mesh.element_tags,
            config.mesh.elements.path.filename().string()};
  }
};

void append(std::vector<std::string>& all, std::vector<std::string> more) {
  all.insert(all.end(), more.begin(), more.end());
}

// Problems of rows are an error, or the end of the usable rows.
void apply_bad_rows(const RecorderScan& scan, BadRows policy, std::vector<std::string>& warnings) {
  if (scan.problems.empty()) return;
  const bool may_stop = policy == BadRows::stop && scan.good_rows > 0;
  if (may_stop) {
    warnings.push_back(fmt::format("{}: only the first {} of {} rows are used: {}", scan.file,
                                   scan.good_rows, scan.rows, scan.problems.front()));
    return;
  }
  std::string text = fmt::format("{}", fmt::join(scan.problems, "\n  "));
  if (scan.non_finite > 0 && scan.good_rows == 0)
    text = fmt::format(
        "{}: {} values are not finite, from the first row on (the run diverged?) compute it again. "
        "First positions:\n  {}",
        scan.file, scan.non_finite, text);
  else if (scan.non_finite > 0)
    text = fmt::format(
        "{}: {} values are not finite (the run diverged?) set `bad_rows: stop` to use the {} rows "
        "before them. First positions:\n  {}",
        scan.file, scan.non_finite, scan.good_rows, text);
  throw InputError(text);
}

Recorder scan_one(const Context& context, const InputFile& file, ColumnLayout layout,
                  const std::function<void(double)>& tick) {
  Recorder recorder{file.path, std::move(layout), {}};
  recorder.scan = scan_recorder(file.path, column_label(recorder.layout), tick);
  if (recorder.scan.columns > 0)
    check_columns(recorder.scan.file, recorder.scan.columns, recorder.layout,
                  recorder.scan.first_column);
  apply_bad_rows(recorder.scan, context.config.bad_rows, *context.warnings);
  context.notes->insert(context.notes->end(), recorder.scan.notes.begin(),
                        recorder.scan.notes.end());
  return recorder;
}

FemFrame empty_frame(const QuadMesh& mesh) {
  FemFrame frame;
  frame.displacement.assign(mesh.num_nodes(), {0.0, 0.0});
  frame.velocity.assign(mesh.num_nodes(), {0.0, 0.0});
  frame.pore_pressure.assign(mesh.num_nodes(), 0.0);
  frame.stress.assign(mesh.num_elements(), {});
  frame.strain.assign(mesh.num_elements(), {});
  return frame;
}

std::size_t gravity_row(const std::string& setting, std::size_t rows) {
  if (setting == "last") return rows - 1;
  if (setting == "first") return 0;
  double value = 0.0;
  std::size_t used = 0;
  const bool number = parse_number(setting, value, used) && used == setting.size();
  validate(number && value == std::nearbyint(value),
           "`gravity.row: {}` is not last, first or a whole number from 1", setting);
  validate(value >= 1.0 && value <= static_cast<double>(rows),
           "`gravity.row: {}`, but the gravity recorders have rows 1 to {}", setting, rows);
  return static_cast<std::size_t>(value) - 1;
}

FemFrame read_gravity(const Context& context, const std::function<void(double)>& tick) {
  const OpenSeesGravity& files = context.config.gravity;
  const OpenSeesColumns& columns = context.config.columns;
  const Recorder stress = scan_one(context, files.stress, context.elemental(columns.stress), tick);
  const Recorder pressure =
      scan_one(context, files.pore_pressure, context.nodal(columns.pore_pressure), tick);
  std::optional<Recorder> strain;
  if (files.strain)
    strain = scan_one(context, *files.strain, context.elemental(columns.strain), tick);

  std::vector<const Recorder*> all = {&stress, &pressure};
  if (strain) all.push_back(&*strain);
  std::int64_t rows = stress.scan.good_rows;
  for (const Recorder* r : all) rows = std::min(rows, r->scan.good_rows);
  const std::size_t row = gravity_row(files.row, static_cast<std::size_t>(rows));
  for (const Recorder* r : all) {
    if (r->scan.good_rows > rows)
      context.notes->push_back(fmt::format("{}: {} rows, another gravity file has {}", r->scan.file,
                                           r->scan.good_rows, rows));
    const double a = stress.scan.first_column[row];
    const double b = r->scan.first_column[row];
    validate(!columns.time || std::abs(a - b) <= 1e-5 * std::max(std::abs(a), std::abs(b)),
             "gravity: row {} is at time {} in {} and {} in {} (rows of different runs or stages) "
             "record them together, or choose another `gravity.row`",
             row + 1, a, stress.scan.file, b, r->scan.file);
  }

  FemFrame frame = empty_frame(context.mesh);
  const double factor = context.factors.stress;
  read_stress(stress.layout, RowCursor(stress).seek(row), factor, context.config.sigma_zz,
              frame.stress);
  read_pressure(pressure.layout, RowCursor(pressure).seek(row), factor, frame.pore_pressure);
  if (strain) {
    read_strain(strain->layout, RowCursor(*strain).seek(row), frame.strain);
  } else {
    context.notes->push_back("gravity: no strain recorder, strain at rest is taken as zero");
  }
  if (context.config.mirror) mirror(frame);
  return frame;
}

/// The five recorders of the motion, in the order of `files`.
struct Shaking {
  std::vector<Recorder> recorders;
  AlignedRows aligned;
};

Shaking scan_shaking(const Context& context, const OpenSeesShaking& files,
                     const std::function<void(double)>& tick) {
  const OpenSeesColumns& columns = context.config.columns;
  Shaking shaking;
  const auto add = [&](const InputFile& file, ColumnLayout layout) {
    shaking.recorders.push_back(scan_one(context, file, std::move(layout), tick));
  };
  add(files.displacement, context.nodal(columns.displacement));
  add(files.velocity, context.nodal(columns.velocity));
  add(files.pore_pressure, context.nodal(columns.pore_pressure));
  add(files.stress, context.elemental(columns.stress));
  add(files.strain, context.elemental(columns.strain));

  std::vector<FileTimes> times;
  for (const Recorder& r : shaking.recorders) {
    FileTimes t{r.scan.file, r.scan.first_column};
    for (std::size_t i = 0; i < t.times.size(); ++i)
      t.times[i] = columns.time ? context.factors.time * t.times[i]
                                : *files.interval * static_cast<double>(i + 1);
    times.push_back(std::move(t));
  }
  shaking.aligned = align_rows(times, files.stage);
  append(*context.warnings, row_warnings(times, shaking.aligned));
  const std::vector<double>& common = shaking.aligned.times;
  auto& notes = *context.notes;
  notes.insert(notes.end(), shaking.aligned.notes.begin(), shaking.aligned.notes.end());
  const StepRange steps = step_range(common);
  notes.push_back(
      fmt::format("shaking: {} rows from {:.6g} to {:.6g} s, steps {:.4g} to {:.4g} s{}",
                  common.size(), common.front(), common.back(), steps.min, steps.max,
                  steps.max > 1.01 * steps.min ? " (not uniform)" : ""));
  notes.push_back("displacement: as recorded");
  return shaking;
}

class FrameSource {
 public:
  FrameSource(const Context& context, const Shaking& shaking)
      : context_(context), shaking_(shaking), frame_(empty_frame(context.mesh)) {
    for (const Recorder& r : shaking.recorders) cursors_.emplace_back(r);
  }

  const FemFrame& read(std::size_t instant) {
    const Factors& f = context_.factors;
    const auto row = [&](std::size_t file) -> const std::vector<double>& {
      return cursors_[file].seek(shaking_.aligned.rows[file][instant]);
    };
    const auto layout = [&](std::size_t file) -> const ColumnLayout& {
      return shaking_.recorders[file].layout;
    };
    frame_.time = shaking_.aligned.times[instant];
    read_vectors(layout(0), row(0), f.length, frame_.displacement);
    read_vectors(layout(1), row(1), f.length / f.time, frame_.velocity);
    read_pressure(layout(2), row(2), f.stress, frame_.pore_pressure);
    read_stress(layout(3), row(3), f.stress, context_.config.sigma_zz, frame_.stress);
    read_strain(layout(4), row(4), frame_.strain);
    if (context_.config.mirror) mirror(frame_);
    return frame_;
  }

 private:
  const Context& context_;
  const Shaking& shaking_;
  FemFrame frame_;
  std::vector<RowCursor> cursors_;
};

std::string rule_in_words(const SigmaZz& zz) {
  switch (zz.rule) {
    case SigmaZzRule::mean:
      return "mean: sigma_zz = (sigma_xx + sigma_yy)/2";
    case SigmaZzRule::elastic:
      return fmt::format("elastic: sigma_zz = nu (sigma_xx + sigma_yy), nu = {}", *zz.nu);
    case SigmaZzRule::k0:
      return fmt::format("k0: sigma_zz = K0 sigma_yy, K0 = {}", *zz.k0);
    case SigmaZzRule::recorded:
      break;
  }
  return "recorded";
}

// Reports each new percent of the work.
class Percent {
 public:
  explicit Percent(const Progress& progress) : progress_(progress) {}
  void report(double fraction, std::string_view text) {
    if (progress_.should_stop()) throw Interrupted("import interrupted (nothing was written)");
    const int now = static_cast<int>(100.0 * fraction);
    if (now <= reported_) return;
    reported_ = now;
    progress_.report(fraction, text);
  }

 private:
  const Progress& progress_;
  int reported_ = -1;
};

// First half of the work: one pass over each file; a share that falls is the next file's.
std::function<void(double)> scan_progress(Percent& percent, std::size_t files) {
  return [&percent, files, done = 0.0, last = 0.0](double fraction) mutable {
    if (fraction < last) done += 1.0;
    last = fraction;
    percent.report(0.5 * std::min(1.0, (done + fraction) / static_cast<double>(files)),
                   "reading recorders");
  };
}

constexpr std::uintmax_t kSmallFile = 1 << 20;

/// Programs may tie nodes at one place, and the sides of a seam, to each other; this one does not
/// know. Soil that is there twice no program makes one.
std::vector<std::string> mesh_warnings(const OpenSeesConfig& config, const QuadMesh& mesh) {
  const std::string twice = soil_on_soil(mesh);
  validate(twice.empty(), "{}: {} leave out of the table what is no soil of the section",
           config.mesh.elements.path.filename().string(), twice);
  std::string problem = unjoined(mesh);
  if (problem.empty()) problem = overlap(mesh);
  if (problem.empty()) return {};
  return {fmt::format("{}: {} unless the model ties them.",
                      config.mesh.nodes.path.filename().string(), problem)};
}

MeshText mesh_as_used(const OpenSeesConfig& config, double length) {
  MeshText text = read_mesh_text(config.mesh, length);
  if (!config.mirror) return text;
  mirror(text.mesh);
  text.notes.push_back(
      "mirrored: x, horizontal motion and shear have the other sign than in the files");
  return text;
}

std::vector<HistoryMaterial> named_materials(const OpenSeesConfig& config, const QuadMesh& mesh) {
  std::vector<HistoryMaterial> materials;
  for (const auto& [name, m] : config.materials)
    materials.push_back({name, m.tag, m.density, m.porosity.value_or(kUnset)});
  try {
    check(mesh, materials);
  } catch (const InputError& e) {
    throw InputError(fmt::format("`materials`: {}", e.what()));
  }
  return materials;
}

}  // namespace

ImportReport import_opensees(const OpenSeesConfig& config, const std::filesystem::path& out,
                             const Progress& progress) {
  check(config);
  const Factors factors{unit_factor(config.units.length, Dim::length),
                        unit_factor(config.units.time, Dim::time),
                        unit_factor(config.units.stress, Dim::stress)};
  const MeshText text = mesh_as_used(config, factors.length);
  const std::vector<HistoryMaterial> materials = named_materials(config, text.mesh);
  ImportReport report;
  report.origin = {"OpenSees text recorders", rule_in_words(config.sigma_zz), text.notes};
  report.num_nodes = text.mesh.num_nodes();
  report.num_elements = text.mesh.num_elements();

  const Context context{config, text.mesh, factors, &report.origin.notes, &report.warnings};
  report.warnings = mesh_warnings(config, text.mesh);
  Percent percent(progress);
  const auto tick = scan_progress(percent, config.shaking ? 8 : 3);
  const FemFrame gravity = read_gravity(context, tick);
  append(report.warnings, gravity_warnings(text.mesh, materials, gravity, factors.stress));

  std::optional<Shaking> shaking;
  std::optional<FrameSource> source;
  const FemFrame* frame = nullptr;
  if (config.shaking) {
    shaking = scan_shaking(context, *config.shaking, tick);
    source.emplace(context, *shaking);
    frame = &source->read(0);
    report.num_frames = shaking->aligned.times.size();
    report.time_first = shaking->aligned.times.front();
    report.time_last = shaking->aligned.times.back();
    append(report.warnings, start_warnings(gravity, *frame));
  }
  for (const std::string& warning : report.warnings)
    report.origin.notes.push_back("warning: " + warning);

  MotionWatch watch(text.mesh);
  FemHistoryWriter writer(out, text.mesh, materials, report.origin);
  writer.set_gravity(gravity);
  for (std::size_t i = 0; i < report.num_frames; ++i) {
    if (i > 0) frame = &source->read(i);
    writer.append(*frame);
    watch.look_at(*frame);
    const double share = static_cast<double>(i + 1) / static_cast<double>(report.num_frames);
    percent.report(0.5 + 0.5 * share, fmt::format("t = {:.6g} s", frame->time));
  }
  append(report.warnings, watch.warnings());
  writer.finish();
  return report;
}

ImportPreview preview_opensees(const OpenSeesConfig& config) {
  check(config);
  const Factors factors{unit_factor(config.units.length, Dim::length),
                        unit_factor(config.units.time, Dim::time),
                        unit_factor(config.units.stress, Dim::stress)};
  ImportPreview preview{mesh_as_used(config, factors.length).mesh, {}, {}};
  preview.materials = named_materials(config, preview.mesh);
  std::vector<std::string> notes;
  const Context context{config, preview.mesh, factors, &notes, &preview.warnings};
  preview.warnings = mesh_warnings(config, preview.mesh);
  bool small = true;
  const auto look = [&](const InputFile& file, const ColumnLayout& layout) {
    small = small && std::filesystem::file_size(file.path) < kSmallFile;
    RecorderReader reader(file.path);
    std::vector<double> row;
    if (reader.next(row)) check_columns(reader.name(), row.size(), layout, {});
  };
  const OpenSeesColumns& c = config.columns;
  look(config.gravity.stress, context.elemental(c.stress));
  look(config.gravity.pore_pressure, context.nodal(c.pore_pressure));
  if (config.gravity.strain) look(*config.gravity.strain, context.elemental(c.strain));
  std::optional<FemFrame> gravity;
  if (small) {
    gravity = read_gravity(context, {});
    append(preview.warnings,
           gravity_warnings(preview.mesh, preview.materials, *gravity, factors.stress));
  }
  if (!config.shaking) return preview;
  look(config.shaking->displacement, context.nodal(c.displacement));
  look(config.shaking->velocity, context.nodal(c.velocity));
  look(config.shaking->pore_pressure, context.nodal(c.pore_pressure));
  look(config.shaking->stress, context.elemental(c.stress));
  look(config.shaking->strain, context.elemental(c.strain));
  if (!small) return preview;
  const Shaking shaking = scan_shaking(context, *config.shaking, {});
  FrameSource source(context, shaking);
  MotionWatch watch(preview.mesh);
  for (std::size_t i = 0; i < shaking.aligned.times.size(); ++i) {
    const FemFrame& frame = source.read(i);
    if (i == 0) append(preview.warnings, start_warnings(*gravity, frame));
    watch.look_at(frame);
  }
  append(preview.warnings, watch.warnings());
  return preview;
}

}  // namespace flowslide

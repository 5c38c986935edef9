#include "model/resumable_history.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "model/append_file.hpp"
#include "model/frame_row.hpp"
#include "model/history_arrays.hpp"
#include "model/parts_folder.hpp"

#include <algorithm>
#include <cmath>

namespace flowslide {
namespace {

std::size_t record_doubles(const QuadMesh& mesh) {
  std::size_t doubles = 1;
  const FemFrame widths;
  visit_frame(widths, [&](auto, auto&&, const auto& array, bool nodal) {
    doubles += (nodal ? mesh.num_nodes() : mesh.num_elements()) * width_of(array);
  });
  return doubles;
}

}  // namespace

struct ResumableHistoryWriter::Impl {
  std::filesystem::path path;
  PartsFolder folder;
  QuadMesh mesh;
  std::vector<HistoryMaterial> materials;
  HistoryOrigin origin;
  FemFrame gravity;
  AppendFile frames;
  std::vector<double> record;

  [[nodiscard]] std::size_t rows(bool nodal) const {
    return nodal ? mesh.num_nodes() : mesh.num_elements();
  }
};

ResumableHistoryWriter::ResumableHistoryWriter(const std::filesystem::path& path,
                                               const QuadMesh& mesh,
                                               const std::vector<HistoryMaterial>& materials,
                                               const HistoryOrigin& origin, const FemFrame& gravity,
                                               std::size_t frames) {
  check(mesh, materials);
  PartsFolder folder(path, frames == 0);
  const std::size_t doubles = record_doubles(mesh);
  impl_.reset(
      new Impl{.path = path,
               .folder = folder,
               .mesh = mesh,
               .materials = materials,
               .origin = origin,
               .gravity = gravity,
               .frames = AppendFile(folder / "frames.bin", doubles * sizeof(double), frames),
               .record = std::vector<double>(doubles)});
}

ResumableHistoryWriter::~ResumableHistoryWriter() = default;

void ResumableHistoryWriter::append(const FemFrame& frame) {
  visit_frame(frame, [&](const char* name, auto&&, const auto& array, bool nodal) {
    validate(array.size() == impl_->rows(nodal),
             "frame at t = {} s: {} has {} values (expected {})", frame.time, name, array.size(),
             impl_->rows(nodal));
    const auto* values = reinterpret_cast<const double*>(array.data());
    const std::size_t width = width_of(array);
    for (std::size_t i = 0; i < array.size() * width; ++i)
      if (!std::isfinite(values[i]))
        throw NumericsError(fmt::format(
            "frame at t = {} s: {} of {} {} is {} (the run has become unstable) look at the frames "
            "before",
            frame.time, name, nodal ? "node" : "element",
            nodal ? impl_->mesh.node_tags[i / width] : impl_->mesh.element_tags[i / width],
            values[i]));
  });
  double* to = impl_->record.data();
  *to++ = frame.time;
  visit_frame(frame, [&](auto, auto&&, const auto& array, bool) { to = put_row(array, to); });
  impl_->frames.append(impl_->record.data());
}

FemFrame ResumableHistoryWriter::frame(std::size_t index) {
  impl_->frames.read(index, impl_->record.data());
  const double* from = impl_->record.data();
  FemFrame frame;
  frame.time = *from++;
  visit_frame(frame, [&](auto, auto&&, auto& array, bool nodal) {
    from = take_row(from, impl_->rows(nodal), array);
  });
  return frame;
}

void ResumableHistoryWriter::flush() { impl_->frames.sync(); }

void ResumableHistoryWriter::finish() {
  const std::filesystem::path joined = impl_->folder / "joined.h5";
  FemHistoryWriter out(joined, impl_->mesh, impl_->materials, impl_->origin);
  out.set_gravity(impl_->gravity);
  for (std::size_t i = 0; i < impl_->frames.size(); ++i) out.append(frame(i));
  out.finish();
  rename_durably(joined, impl_->path);
}

void ResumableHistoryWriter::remove_parts() { impl_->folder.remove(); }

}  // namespace flowslide

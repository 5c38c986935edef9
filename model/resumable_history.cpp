#include "model/resumable_history.hpp"

#include "core/check.hpp"
#include "model/append_file.hpp"

#include <cmath>

namespace flowslide {
namespace {

/// The one list of what a record of a frame holds after its time: f(name, array, is_nodal).
template <class Frame, class F>
void visit_arrays(Frame& frame, F&& f) {
  f("displacement", frame.displacement, true);
  f("velocity", frame.velocity, true);
  f("pore_pressure", frame.pore_pressure, true);
  f("stress", frame.stress, false);
  f("strain", frame.strain, false);
}

template <class Array>
constexpr std::size_t width_of(const Array&) {
  return sizeof(typename Array::value_type) / sizeof(double);
}

std::size_t record_bytes(const QuadMesh& mesh) {
  std::size_t doubles = 1;
  const FemFrame widths;
  visit_arrays(widths, [&](const char*, const auto& array, bool nodal) {
    doubles += (nodal ? mesh.num_nodes() : mesh.num_elements()) * width_of(array);
  });
  return doubles * sizeof(double);
}

std::filesystem::path folder_of(std::filesystem::path path, bool anew) {
  path += ".partial";
  std::error_code error;
  if (anew) std::filesystem::remove_all(path, error);
  if (!error) std::filesystem::create_directory(path, error);
  if (error)
    throw FileError(
        fmt::format("the folder '{}' cannot be made ({})", path.string(), error.message()));
  return path;
}

}  // namespace

struct ResumableHistoryWriter::Impl {
  std::filesystem::path path, folder;
  QuadMesh mesh;
  HistoryOrigin origin;
  FemFrame gravity;
  std::size_t num_frames;
  AppendFile frames;
  bool finished = false;

  [[nodiscard]] std::size_t rows(bool nodal) const {
    return nodal ? mesh.num_nodes() : mesh.num_elements();
  }
};

ResumableHistoryWriter::ResumableHistoryWriter(const std::filesystem::path& path,
                                               const QuadMesh& mesh, const HistoryOrigin& origin,
                                               const FemFrame& gravity, std::size_t frames) {
  const std::filesystem::path folder = folder_of(path, frames == 0);
  impl_.reset(new Impl{.path = path,
                       .folder = folder,
                       .mesh = mesh,
                       .origin = origin,
                       .gravity = gravity,
                       .num_frames = frames,
                       .frames = AppendFile(folder / "frames.bin", record_bytes(mesh), frames)});
}

ResumableHistoryWriter::~ResumableHistoryWriter() {
  std::error_code ignored;
  if (impl_->finished) std::filesystem::remove_all(impl_->folder, ignored);
}

void ResumableHistoryWriter::append(const FemFrame& frame) {
  visit_arrays(frame, [&](const char* name, const auto& array, bool nodal) {
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
  impl_->frames.append(&frame.time, sizeof frame.time);
  visit_arrays(frame, [&](const char*, const auto& array, bool) {
    impl_->frames.append(array.data(), array.size() * sizeof(array[0]));
  });
  ++impl_->num_frames;
}

FemFrame ResumableHistoryWriter::frame(std::size_t index) {
  FLOWSLIDE_EXPECT(index < impl_->num_frames);
  FemFrame frame;
  std::size_t offset = index * record_bytes(impl_->mesh);
  const auto read = [&](void* to, std::size_t bytes) {
    impl_->frames.read(offset, to, bytes);
    offset += bytes;
  };
  read(&frame.time, sizeof frame.time);
  visit_arrays(frame, [&](const char*, auto& array, bool nodal) {
    array.resize(impl_->rows(nodal));
    read(array.data(), array.size() * sizeof(array[0]));
  });
  return frame;
}

void ResumableHistoryWriter::flush() { impl_->frames.sync(); }

void ResumableHistoryWriter::finish() {
  const std::filesystem::path joined = impl_->folder / "joined.h5";
  FemHistoryWriter out(joined, impl_->mesh, impl_->origin);
  out.set_gravity(impl_->gravity);
  for (std::size_t i = 0; i < impl_->num_frames; ++i) out.append(frame(i));
  out.finish();
  std::error_code error;
  std::filesystem::rename(joined, impl_->path, error);
  if (error)
    throw FileError(fmt::format("'{}' cannot be renamed to '{}' ({})", joined.string(),
                                impl_->path.string(), error.message()));
  impl_->finished = true;
}

}  // namespace flowslide

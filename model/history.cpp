#include "model/history.hpp"

#include "core/check.hpp"
#include "model/field_store.hpp"
#include "model/history_arrays.hpp"
#include "model/mesh_store.hpp"

#include <algorithm>

namespace flowslide {
namespace {

constexpr std::string_view kFemHistory = "fem_history";
constexpr int kFemHistoryFormat = 2, kOldestFemHistory = 2;  // 1 had no materials

constexpr FieldLabel kTime{.unit = "s", .convention = "from the start of the motion"};
void write_materials(FieldWriter& out, std::vector<HistoryMaterial> materials) {
  std::sort(materials.begin(), materials.end(),
            [](const auto& a, const auto& b) { return a.tag < b.tag; });
  std::vector<std::string> names, laws;
  std::vector<std::int32_t> tags;
  std::vector<double> density, porosity;
  for (const HistoryMaterial& m : materials) {
    names.push_back(m.name);
    laws.push_back(m.law);
    tags.push_back(m.tag);
    density.push_back(m.density);
    porosity.push_back(m.porosity);
  }
  out.write_texts("materials/name", names);
  out.write_texts("materials/law", laws);
  out.write("materials/tag", tags, {.unit = "", .convention = "as in mesh/element_material"});
  out.write("materials/density", density,
            {.unit = "kg/m3", .convention = "before deformation, grains and water"});
  out.write("materials/porosity", porosity, {.unit = "-", .convention = "", .nan = Nan::allowed});
}

std::vector<HistoryMaterial> read_materials(const FieldReader& in, const QuadMesh& mesh) {
  const std::vector<std::string> names = in.read_texts("materials/name");
  const std::size_t n = names.size();
  const std::vector<std::string> laws = in.read_texts("materials/law", n);
  const auto tags = in.read<std::int32_t>("materials/tag", n);
  const auto density = in.read<double>("materials/density", n);
  const auto porosity = in.read<double>("materials/porosity", n, Nan::allowed);
  std::vector<HistoryMaterial> materials;
  for (std::size_t i = 0; i < n; ++i)
    materials.push_back({names[i], tags[i], density[i], porosity[i], laws[i]});
  try {
    check(mesh, materials);
  } catch (const InputError& error) {
    throw InputError(fmt::format("'{}': {}", in.path().string(), error.what()));
  }
  return materials;
}

}  // namespace

struct FemHistoryWriter::Impl {
  FieldWriter out;
  std::filesystem::path path;
  std::size_t num_nodes = 0, num_elements = 0;
  std::vector<double> times;
  bool has_gravity = false;

  void check_sizes(const FemFrame& frame) const {
    visit_frame(
        frame, [this, &frame](const char* name, const FieldLabel&, const auto& array, bool nodal) {
          validate(array.size() == (nodal ? num_nodes : num_elements),
                   "frame at t = {} s: {} has {} values (the mesh has {} {})", frame.time, name,
                   array.size(), nodal ? num_nodes : num_elements, nodal ? "nodes" : "elements");
        });
  }
};

FemHistoryWriter::FemHistoryWriter(const std::filesystem::path& path, const QuadMesh& mesh,
                                   const std::vector<HistoryMaterial>& materials,
                                   const HistoryOrigin& origin) {
  check(mesh);
  check(mesh, materials);
  impl_.reset(new Impl{.out = FieldWriter(path, kFemHistory, kFemHistoryFormat),
                       .path = path,
                       .num_nodes = mesh.num_nodes(),
                       .num_elements = mesh.num_elements(),
                       .times = {}});
  write_mesh(impl_->out, mesh);
  write_materials(impl_->out, materials);
  impl_->out.write_texts("origin/program", {origin.program});
  impl_->out.write_texts("origin/sigma_zz_rule", {origin.sigma_zz_rule});
  impl_->out.write_texts("origin/notes", origin.notes);
}

FemHistoryWriter::~FemHistoryWriter() = default;

void FemHistoryWriter::set_gravity(const FemFrame& frame) {
  validate(!impl_->has_gravity && impl_->times.empty(),
           "'{}': the gravity frame is set once, before the first frame", impl_->path.string());
  impl_->check_sizes(frame);
  impl_->out.write("gravity/time", std::vector<double>{frame.time}, kTime);
  visit_frame(frame, [this](const char* name, const FieldLabel& label, const auto& array, bool) {
    impl_->out.write(std::string("gravity/") + name, array, label);
  });
  impl_->has_gravity = true;
}

void FemHistoryWriter::append(const FemFrame& frame) {
  validate(impl_->has_gravity,
           "'{}': the gravity frame must come before the first frame (r_u refers to it)",
           impl_->path.string());
  validate(frame.time > (impl_->times.empty() ? -1e300 : impl_->times.back()),
           "frame {} is at t = {} s (times must increase, the frame before is at {} s)",
           impl_->times.size(), frame.time, impl_->times.empty() ? kUnset : impl_->times.back());
  impl_->check_sizes(frame);
  visit_frame(frame, [this](const char* name, const FieldLabel& label, const auto& array, bool) {
    impl_->out.append(std::string("frames/") + name, array, label);
  });
  impl_->times.push_back(frame.time);
}

void FemHistoryWriter::finish() {
  validate(impl_->has_gravity, "'{}': the gravity frame is missing (r_u refers to it)",
           impl_->path.string());
  impl_->out.write("frames/time", impl_->times, kTime);
  impl_->out.finish();
}

struct FemHistory::Impl {
  FieldReader in;
  QuadMesh mesh;
  std::vector<HistoryMaterial> materials;
  HistoryOrigin origin;
  FemFrame gravity;
  std::vector<double> times;
};

FemHistory::FemHistory(const std::filesystem::path& path)
    : impl_(new Impl{.in = FieldReader(path, kFemHistory, kFemHistoryFormat, kOldestFemHistory),
                     .mesh = {},
                     .materials = {},
                     .origin = {},
                     .gravity = {},
                     .times = {}}) {
  const FieldReader& in = impl_->in;
  impl_->mesh = read_mesh(in);
  impl_->materials = read_materials(in, impl_->mesh);
  impl_->origin.program = in.read_texts("origin/program", 1)[0];
  impl_->origin.sigma_zz_rule = in.read_texts("origin/sigma_zz_rule", 1)[0];
  impl_->origin.notes = in.read_texts("origin/notes");
  impl_->gravity.time = in.read_one<double>("gravity/time");
  visit_frame(impl_->gravity, [this, &in](const char* name, const FieldLabel& label, auto& array,
                                          bool nodal) {
    using T = typename std::decay_t<decltype(array)>::value_type;
    array = in.read<T>(std::string("gravity/") + name,
                       nodal ? impl_->mesh.num_nodes() : impl_->mesh.num_elements(), label.nan);
  });
  impl_->times = in.read<double>("frames/time");
  for (std::size_t i = 1; i < impl_->times.size(); ++i)
    validate(impl_->times[i] > impl_->times[i - 1],
             "'{}': frame {} is at t = {} s, after {} s (times must increase)", path.string(), i,
             impl_->times[i], impl_->times[i - 1]);
  if (impl_->times.empty()) return;
  visit_frame(impl_->gravity, [this, &in](const char* name, auto&, auto&, bool) {
    const std::size_t rows = in.rows(std::string("frames/") + name);
    validate(rows == impl_->times.size(), "'{}': dataset 'frames/{}' has {} frames (expected {})",
             in.path().string(), name, rows, impl_->times.size());
  });
}

FemHistory::~FemHistory() = default;
FemHistory::FemHistory(FemHistory&&) noexcept = default;
FemHistory& FemHistory::operator=(FemHistory&&) noexcept = default;

const QuadMesh& FemHistory::mesh() const { return impl_->mesh; }
const std::vector<HistoryMaterial>& FemHistory::materials() const { return impl_->materials; }
const HistoryOrigin& FemHistory::origin() const { return impl_->origin; }
const FemFrame& FemHistory::gravity() const { return impl_->gravity; }
const std::vector<double>& FemHistory::times() const { return impl_->times; }

FemFrame FemHistory::frame(std::size_t index) const {
  validate(index < impl_->times.size(), "'{}' has no frame {} (it has {})",
           impl_->in.path().string(), index, impl_->times.size());
  FemFrame frame;
  frame.time = impl_->times[index];
  visit_frame(
      frame, [this, index](const char* name, const FieldLabel& label, auto& array, bool nodal) {
        using T = typename std::decay_t<decltype(array)>::value_type;
        array = impl_->in.read_row<T>(std::string("frames/") + name, index,
                                      nodal ? impl_->mesh.num_nodes() : impl_->mesh.num_elements(),
                                      label.nan);
      });
  return frame;
}

}  // namespace flowslide

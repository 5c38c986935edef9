#include "model/mesh_store.hpp"

#include "core/check.hpp"

namespace flowslide {

void write_mesh(FieldWriter& out, const QuadMesh& mesh) {
  out.write("mesh/nodes", mesh.nodes, {.unit = "m", .convention = "x y, y points up"});
  out.write("mesh/node_tags", mesh.node_tags, {.unit = "", .convention = "of the source program"});
  out.write("mesh/elements", mesh.elements,
            {.unit = "", .convention = "rows of mesh/nodes, counter-clockwise"});
  out.write("mesh/element_tags", mesh.element_tags,
            {.unit = "", .convention = "of the source program"});
  out.write("mesh/element_material", mesh.element_material,
            {.unit = "", .convention = "material tag of the source program"});
}

QuadMesh read_mesh(const FieldReader& in) {
  QuadMesh mesh;
  mesh.nodes = in.read<Vec2>("mesh/nodes");
  mesh.node_tags = in.read<std::int64_t>("mesh/node_tags", mesh.num_nodes());
  mesh.elements = in.read<std::array<std::int32_t, 4>>("mesh/elements");
  mesh.element_tags = in.read<std::int64_t>("mesh/element_tags", mesh.num_elements());
  mesh.element_material = in.read<std::int32_t>("mesh/element_material", mesh.num_elements());
  try {
    check(mesh);
  } catch (const InputError& error) {
    throw InputError(fmt::format("'{}': {}", in.path().string(), error.what()));
  }
  return mesh;
}

}  // namespace flowslide

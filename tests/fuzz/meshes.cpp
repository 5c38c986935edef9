#include "importers/mesh_import.hpp"
#include "section/boundary.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace flowslide::fuzz {
namespace {

void import(const MeshImportConfig& config) {
  const auto out = folder() / "mesh.h5";
  const bool written = accepts([&] {
    SectionMesh section = import_mesh(config);
    add_outer_sets(section);
    write_section_mesh(out, section);
  });
  if (written) (void)read_section_mesh(out);
}

}  // namespace

void gmsh(Input input) {
  MeshImportConfig config;
  config.gmsh = InputFile{file("dam.msh", input)};
  import(config);
}

void mesh_tables(Input input) {
  Parts parts(input);
  Switches choose(parts.section());
  MeshImportConfig config;
  MeshTextConfig& tables = config.tables.emplace();
  tables.recorder_order = choose.flag() ? RecorderOrder::tag : RecorderOrder::file;
  tables.reverse_clockwise = choose.flag();
  if (choose.flag()) tables.node_columns = {"skip", "tag", "x", "y"};
  if (choose.flag()) tables.element_columns = {"tag", "n1", "n2", "n3", "n4"};
  tables.nodes = {file("nodeinfo.dat", parts.section())};
  tables.elements = {file("elementinfo.dat", parts.section())};
  import(config);
}

}  // namespace flowslide::fuzz

#include "core/xml_text.hpp"
#include "model/vtk_data.hpp"

#include <algorithm>
#include <bit>
#include <new>
#include <string_view>
#include <zlib.h>

#include <fmt/format.h>

namespace flowslide {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say that they are");

constexpr std::size_t kBlock = 1 << 15;  // bytes compressed at a time, as VTK has it
constexpr int kBlockLevel = 5;           // of zlib's 9, as VTK has it

void add_number(std::string& to, std::uint64_t number) {
  to.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Number of blocks, size of a block, size of a shorter last one (0: there is none), compressed
/// sizes; then the blocks.
void add_compressed(std::string& to, const void* bytes, std::size_t size) {
  const std::size_t blocks = (size + kBlock - 1) / kBlock;
  add_number(to, blocks);
  add_number(to, kBlock);
  add_number(to, size % kBlock);
  std::string sizes, content;
  std::vector<Bytef> block(compressBound(kBlock));
  for (std::size_t begin = 0; begin < size; begin += kBlock) {
    uLongf length = block.size();
    const auto* from = static_cast<const Bytef*>(bytes) + begin;
    if (compress2(block.data(), &length, from, std::min(kBlock, size - begin), kBlockLevel) != Z_OK)
      throw std::bad_alloc();  // the only cause that zlib leaves with a buffer of this size
    add_number(sizes, length);
    content.append(reinterpret_cast<const char*>(block.data()), length);
  }
  to += sizes + content;
}

constexpr const char* type_name(double) { return "Float64"; }
constexpr const char* type_name(std::int32_t) { return "Int32"; }
constexpr const char* type_name(std::int64_t) { return "Int64"; }
constexpr const char* type_name(std::uint8_t) { return "UInt8"; }

/// The elements of the file, and apart from them the data that they refer to.
class Writer {
 public:
  void line(std::string_view text) { (xml_ += text) += '\n'; }

  template <class T>
  void array(std::string_view name, const std::vector<T>& values, int components = 1) {
    std::string names;
    for (int c = 0; c < components; ++c)
      if (const char* component = vtk_component_name(components, c))
        names += fmt::format(" ComponentName{}=\"{}\"", c, component);
    element(type_name(T{}), name, fmt::format("NumberOfComponents=\"{}\"{}", components, names));
    add_compressed(data_, values.data(), values.size() * sizeof(T));
  }

  void arrays(const std::vector<VtkArray>& all) {
    for (const VtkArray& a : all)
      std::visit([&](const auto& values) { array(a.name, values, a.components); }, a.values);
  }

  void texts(std::string_view name, const std::vector<std::string>& texts) {
    std::string joined;
    for (const std::string& text : texts) (joined += text) += '\0';
    element("String", name, fmt::format("NumberOfTuples=\"{}\"", texts.size()));
    add_compressed(data_, joined.data(), joined.size());
  }

  /// An element such as Points around what `content` writes.
  template <class F>
  void section(std::string_view name, std::string_view attributes, F&& content) {
    line(fmt::format("<{}{}>", name, attributes));
    content();
    line(fmt::format("</{}>", name));
  }

  [[nodiscard]] std::string finish(std::string_view type) const {
    return fmt::format(
               "<?xml version=\"1.0\"?>\n"
               "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n{}"
               "<AppendedData encoding=\"raw\">\n_",
               type, xml_) +
           data_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string xml_, data_;

  void element(std::string_view type, std::string_view name, std::string_view attributes) {
    line(fmt::format("<DataArray type=\"{}\" Name=\"{}\" {} format=\"appended\" offset=\"{}\"/>",
                     type, xml_text(name), attributes, data_.size()));
  }
};

void write_cells(Writer& w, const VtkData& data) {
  const bool quads = data.kind == VtkData::Kind::quads;
  w.section(quads ? "Cells" : "Verts", "", [&] {
    const std::size_t each = quads ? 4 : 1;
    std::vector<std::int64_t> ends;
    for (std::size_t end = each; end <= data.cells.size(); end += each)
      ends.push_back(static_cast<std::int64_t>(end));
    w.array("connectivity", data.cells);
    w.array("offsets", ends);
    constexpr std::uint8_t kQuad = 9;  // VTK_QUAD
    if (quads) w.array("types", std::vector<std::uint8_t>(ends.size(), kQuad));
  });
}

}  // namespace

const char* vtk_component_name(int components, int component) {
  constexpr const char* names[] = {"XX", "YY", "ZZ", "XY", "YZ", "ZX"};
  return components == 4 || components == 6 ? names[component] : nullptr;
}

std::string vtk_xml(const VtkData& data) {
  const bool quads = data.kind == VtkData::Kind::quads;
  const std::string type = quads ? "UnstructuredGrid" : "PolyData";
  const std::string counts =
      fmt::format(" NumberOfPoints=\"{}\" {}=\"{}\"", data.points.size() / 3,
                  quads ? "NumberOfCells" : "NumberOfVerts", data.cells.size() / (quads ? 4 : 1));
  Writer w;
  w.section(type, "", [&] {
    if (!data.texts.empty())
      w.section("FieldData", "", [&] {
        for (const auto& [name, texts] : data.texts) w.texts(name, texts);
      });
    w.section("Piece", counts, [&] {
      w.section("PointData", "", [&] { w.arrays(data.at_points); });
      w.section("CellData", "", [&] { w.arrays(data.at_cells); });
      w.section("Points", "", [&] { w.array("Points", data.points, 3); });
      write_cells(w, data);
    });
  });
  return w.finish(type);
}

}  // namespace flowslide

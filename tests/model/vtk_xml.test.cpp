#include "core/check.hpp"
#include "model/vtk_data.hpp"
#include "model/vtk_writer.hpp"
#include "tests/model/scratch.hpp"
#include "tests/model/two_particles.hpp"

#include <cstring>
#include <zlib.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

std::uint64_t number(const std::string& file, std::size_t at) {
  std::uint64_t value = 0;
  std::memcpy(&value, file.data() + at, sizeof value);
  return value;
}

/// The numbers of an array, found and unpacked by the description of the format alone:
/// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
std::vector<double> numbers(const std::string& file, const std::string& name) {
  const std::size_t element = file.find("Name=\"" + name + "\"");
  REQUIRE(element != std::string::npos);
  const std::size_t offset = std::stoul(file.substr(file.find("offset=\"", element) + 8));
  const std::string before = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t at = file.find(before) + before.size() + offset;
  const std::size_t blocks = number(file, at), size = number(file, at + 8);
  std::string bytes;
  std::size_t from = at + 24 + 8 * blocks;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t packed = number(file, at + 24 + 8 * b), rest = number(file, at + 16);
    std::string block(size, '\0');
    uLongf length = size;
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(block.data()), &length,
                       reinterpret_cast<const Bytef*>(file.data()) + from, packed) == Z_OK);
    REQUIRE(length == (b + 1 == blocks && rest > 0 ? rest : size));
    bytes.append(block, 0, length);
    from += packed;
  }
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace

TEST_CASE("the built-in files for ParaView hold every bit, in blocks") {
  for (const std::size_t count : {0U, 1U, 4096U, 9000U}) {  // 4096 numbers fill a block
    CAPTURE(count);
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(1.0 / static_cast<double>(i + 3));
    VtkData data;
    data.at_points = {{"first", 1, values}, {"stress [Pa]", 4, values}};
    const std::string file = vtk_xml(data);
    CHECK(numbers(file, "first") == values);
    CHECK(numbers(file, "stress [Pa]") == values);
    CHECK_THAT(file, Contains("ComponentName3=\"XY\""));
  }
}

TEST_CASE("a series names its files relative to itself, with their times") {
  const Scratch folder;
  const std::vector<std::pair<double, std::filesystem::path>> files{
      {0.0, folder / "frames/a.vtp"}, {0.1, folder / "frames/b&c.vtp"}};
  write_pvd(folder / "run.pvd", files);
  const std::string text = bytes_of(folder / "run.pvd");
  CHECK_THAT(text, Contains("timestep=\"0.1\" part=\"0\" file=\"frames/b&amp;c.vtp\""));
  CHECK_THAT(text, Contains("file=\"frames/a.vtp\""));
  CHECK_THROWS_AS(write_pvd(folder / "no/run.pvd", files), FileError);
}

TEST_CASE("equal particles give equal pictures, and a bad place an error") {
  const Scratch folder;
  write_vtp(folder / "a.vtp", two_particles());
  write_vtp(folder / "b.vtp", two_particles());
  CHECK(bytes_of(folder / "a.vtp") == bytes_of(folder / "b.vtp"));
  CHECK_THROWS_AS(write_vtp(folder / "no/a.vtp", two_particles()), FileError);
}

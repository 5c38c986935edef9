#include "model/resumable_history.hpp"

#include "core/check.hpp"
#include "tests/model/scratch.hpp"
#include "tests/support/materials.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

QuadMesh one_quad() {
  QuadMesh m;
  m.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1.0 / 3.0}};
  m.node_tags = {4, 3, 2, 10};
  m.elements = {{0, 1, 2, 3}};
  m.element_tags = {77};
  m.element_material = {5};
  return m;
}

FemFrame frame_at(double time) {
  FemFrame f;
  f.time = time;
  f.displacement.assign(4, {time / 3.0, -time / 7.0});
  f.velocity.assign(4, {0.5 * time, 1.0});
  f.pore_pressure.assign(4, 1e4 + time);
  f.stress = {{{-1.0, -2.0, -1.5, time}}};
  f.strain = {{{1e-3, -1e-3, 0.0, 2e-3 * time}}};
  return f;
}

const HistoryOrigin kOrigin{"a test", "K0 of 0.5", {"note"}};

void write(const std::filesystem::path& path, int from, int to, bool finish) {
  ResumableHistoryWriter out(path, one_quad(), test::materials_of(one_quad()), kOrigin,
                             frame_at(0.0), static_cast<std::size_t>(from));
  for (int i = from; i < to; ++i) out.append(frame_at(0.1 * (i + 1)));
  out.flush();
  if (!finish) return;
  out.finish();
  out.remove_parts();
}

}  // namespace

TEST_CASE("a history written in parts has the bytes of one written at once") {
  const Scratch folder;
  {
    FemHistoryWriter out(folder / "once.h5", one_quad(), test::materials_of(one_quad()), kOrigin);
    out.set_gravity(frame_at(0.0));
    for (int i = 0; i < 5; ++i) out.append(frame_at(0.1 * (i + 1)));
    out.finish();
  }
  write(folder / "parts.h5", 0, 2, false);
  CHECK_FALSE(std::filesystem::exists(folder / "parts.h5"));
  write(folder / "parts.h5", 2, 4, false);  // two frames after the checkpoint: they go
  write(folder / "parts.h5", 2, 5, true);
  CHECK(bytes_of(folder / "parts.h5") == bytes_of(folder / "once.h5"));
  CHECK_FALSE(std::filesystem::exists(folder / "parts.h5.partial"));
  write(folder / "other.h5", 0, 4, true);  // control
  CHECK(bytes_of(folder / "other.h5") != bytes_of(folder / "once.h5"));
}

TEST_CASE("a changed byte in the frames of an interrupted shaking is noticed") {
  const Scratch folder;
  write(folder / "h.h5", 0, 3, false);
  const std::filesystem::path path = folder / "h.h5.partial/frames.bin";
  const std::string good = bytes_of(path);
  for (std::size_t i = 0; i < good.size(); i += 7) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x20);
    put_bytes(path, bad);
    REQUIRE_THROWS_WITH(write(folder / "h.h5", 3, 5, true),
                        Contains("frames.bin") && Contains("delete the checkpoint"));
  }
  put_bytes(path, good);
  CHECK_NOTHROW(write(folder / "h.h5", 3, 5, true));  // control
}

TEST_CASE("a history that lost frames is not continued") {
  const Scratch folder;
  write(folder / "h.h5", 0, 2, false);
  CHECK_THROWS_WITH(write(folder / "h.h5", 3, 4, true),
                    Contains("frames.bin") && Contains("start the stage again"));
  write(folder / "h.h5", 0, 1, true);  // from its beginning
  CHECK(FemHistory(folder / "h.h5").times().size() == 1);
}

TEST_CASE("frames that are not finite end the run") {
  const Scratch folder;
  ResumableHistoryWriter out(folder / "h.h5", one_quad(), test::materials_of(one_quad()), kOrigin,
                             frame_at(0.0), 0);
  FemFrame f = frame_at(1.0);
  f.velocity[2][1] = kUnset;
  try {
    out.append(f);
    FAIL("accepted");
  } catch (const NumericsError& e) {
    CHECK_THAT(e.what(), Contains("velocity of node 2"));
  }
  f = frame_at(1.0);
  f.strain.emplace_back();
  CHECK_THROWS_AS(out.append(f), InputError);
}

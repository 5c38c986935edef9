#include "model/mpm_history.hpp"

#include "core/check.hpp"
#include "core/hashed_file.hpp"
#include "model/field_store.hpp"
#include "tests/model/scratch.hpp"

#include <csignal>
#include <cstring>
#include <sys/wait.h>

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Matchers::Contains;

namespace {

constexpr std::size_t kParticles = 40;

ParticleSet start() {
  ParticleSet p;
  p.history["r_u"] = {};
  resize(p, kParticles);
  p.toe = 12.5;
  p.materials = {{"dam", "mohr_coulomb", {{"cohesion", 1e3}}, true}};
  for (std::size_t i = 0; i < kParticles; ++i) {
    p.position[i] = {0.1 * static_cast<double>(i), 0.0, 0.0};
    p.mass[i] = 1.0;
    p.volume[i] = 1.0;
    p.id[i] = static_cast<std::int64_t>((i * 7) % kParticles);
    p.history["r_u"][i] = static_cast<double>(p.id[i]);
  }
  return p;
}

constexpr RestRule kRest{0.001, 0.2, 4.0};

MpmFrame frame_at(int k) {
  MpmFrame f;
  f.time = 0.5 * k;
  for (std::size_t i = 0; i < kParticles; ++i) {
    const double x = static_cast<double>(i) + k / 3.0;
    f.position.push_back({x, -x, 0.0});
    f.velocity.push_back({x / 7.0, 0.0, 0.0});
    f.stress.push_back({-x, -x, -x, 0.1 * x, 0.0, 0.0});
    f.volume.push_back(1.0 + 0.01 * x);
    f.plastic_strain.push_back(x);
    f.strength.push_back(i % 2 ? kUnset : 100.0 * x);
  }
  return f;
}

MpmSample sample_at(int k) {
  MpmSample s;
  s.time = 0.1 * k;
  s.runout = k / 9.0;
  s.active_particles = 1.0;
  s.dt = 1e-3;
  return s;
}

/// Frame k and five samples.
void advance(MpmHistoryWriter& out, int k) {
  out.append(frame_at(k));
  for (int j = 0; j < 5; ++j) out.append(sample_at(5 * k + j));
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

}  // namespace

TEST_CASE("a runout comes back from the file to the bit, in order of id") {
  const Scratch folder;
  {
    MpmHistoryWriter out(folder / "m.h5", start(), kRest);
    for (int k = 0; k < 3; ++k) advance(out, k);
    CHECK_FALSE(std::filesystem::exists(folder / "m.h5"));
    out.finish();
    CHECK(std::filesystem::exists(folder / "m.h5.partial"));
    out.remove_parts();
  }
  CHECK_FALSE(std::filesystem::exists(folder / "m.h5.partial"));
  const MpmHistory h(folder / "m.h5");
  CHECK(stored_kind(folder / "m.h5") == "mpm_history");
  REQUIRE(h.initial().size() == kParticles);
  for (std::size_t i = 0; i < kParticles; ++i) {
    CHECK(h.initial().id[i] == static_cast<std::int64_t>(i));
    CHECK(h.initial().history.at("r_u")[i] == static_cast<double>(i));
  }
  CHECK(h.initial().position[7][0] == 0.1);
  CHECK(h.initial().toe == 12.5);
  CHECK(h.rest().kinetic_share == kRest.kinetic_share);
  CHECK(h.rest().runout_change == kRest.runout_change);
  CHECK(h.rest().window == kRest.window);
  CHECK(h.initial().materials[0].parameters.at("cohesion") == 1e3);
  REQUIRE(h.num_frames() == 3);
  const MpmFrame expected = frame_at(2);
  const MpmFrame found = h.frame(2);
  CHECK(found.time == expected.time);
  CHECK(same_bits(found.position, expected.position));
  CHECK(same_bits(found.velocity, expected.velocity));
  CHECK(same_bits(found.stress, expected.stress));
  CHECK(same_bits(found.volume, expected.volume));
  CHECK(same_bits(found.plastic_strain, expected.plastic_strain));
  CHECK(same_bits(found.strength, expected.strength));
  CHECK(h.times().size() == 3);
  CHECK(h.times()[2] == expected.time);
  const MpmFrame motion = h.motion(2);
  CHECK(same_bits(motion.position, expected.position));
  CHECK(same_bits(motion.velocity, expected.velocity));
  CHECK(same_bits(motion.strength, expected.strength));
  CHECK(motion.stress.empty());
  REQUIRE(h.samples().size() == 15);
  const MpmSample last = sample_at(14);
  CHECK(std::memcmp(&h.samples()[14], &last, sizeof last) == 0);
  CHECK_THROWS_AS(h.frame(3), InputError);
}

TEST_CASE("a killed run that is resumed gives the bytes of an uninterrupted one") {
  const Scratch folder;
  {
    MpmHistoryWriter out(folder / "whole.h5", start(), kRest);
    for (int k = 0; k < 6; ++k) advance(out, k);
    out.finish();
  }
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    MpmHistoryWriter out(folder / "killed.h5", start(), kRest);
    for (int k = 0; k < 3; ++k) advance(out, k);
    out.flush();
    advance(out, 3);  // written after the checkpoint: must vanish
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  // The kill may also hit in the middle of a write.
  const std::filesystem::path frames = folder / "killed.h5.partial/frames.bin";
  std::filesystem::resize_file(frames, std::filesystem::file_size(frames) - 100);
  {
    MpmHistoryWriter out(folder / "killed.h5", start(), kRest, 3, 15);
    for (int k = 3; k < 6; ++k) advance(out, k);
    out.finish();
  }
  CHECK(hash_file(folder / "killed.h5").sha256 == hash_file(folder / "whole.h5").sha256);
}

TEST_CASE("a resume that asks for more than there is fails") {
  const Scratch folder;
  {
    MpmHistoryWriter out(folder / "m.h5", start(), kRest);
    advance(out, 0);
  }
  CHECK_THROWS_AS(MpmHistoryWriter(folder / "m.h5", start(), kRest, 2, 5), FileError);
  CHECK_THROWS_WITH(MpmHistoryWriter(folder / "m.h5", start(), kRest, 1, 6),
                    Contains("samples.bin"));
  CHECK_NOTHROW(MpmHistoryWriter(folder / "m.h5", start(), kRest, 1, 5));
  CHECK_THROWS_AS(MpmHistoryWriter(folder / "none.h5", start(), kRest, 1, 0), FileError);
}

TEST_CASE("a changed byte in the parts of an interrupted runout is noticed") {
  const Scratch folder;
  {
    MpmHistoryWriter out(folder / "m.h5", start(), kRest);
    for (int k = 0; k < 3; ++k) advance(out, k);
    out.flush();
  }
  const auto again = [&] { MpmHistoryWriter(folder / "m.h5", start(), kRest, 3, 15).finish(); };
  for (const char* part : {"frames.bin", "samples.bin"}) {
    const std::filesystem::path path = folder / (std::string("m.h5.partial/") + part);
    const std::string good = bytes_of(path);
    for (std::size_t i = 0; i < good.size(); i += 1 + good.size() / 199) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ 0x20);
      put_bytes(path, bad);
      REQUIRE_THROWS_AS(again(), FileError);
      REQUIRE_THROWS_WITH(again(), Contains(part) && Contains("delete the checkpoint"));
    }
    REQUIRE_FALSE(std::filesystem::exists(folder / "m.h5"));
    put_bytes(path, good);
  }
  CHECK_NOTHROW(again());  // control
}

TEST_CASE("a run without output is a file without frames") {
  const Scratch folder;
  MpmHistoryWriter(folder / "m.h5", start(), kRest).finish();
  const MpmHistory h(folder / "m.h5");
  CHECK(h.num_frames() == 0);
  CHECK(h.samples().empty());
}

TEST_CASE("frames that are wrong are refused and leave no trace") {
  const Scratch folder;
  MpmHistoryWriter out(folder / "m.h5", start(), kRest);
  advance(out, 1);
  CHECK_THROWS_WITH(out.append(frame_at(1)), Contains("times must increase"));
  MpmFrame f = frame_at(2);
  f.velocity[3][1] = kUnset;
  CHECK_THROWS_AS(out.append(f), NumericsError);
  CHECK_THROWS_WITH(out.append(f), Contains("velocity of particle 3"));
  f = frame_at(2);
  f.volume.pop_back();
  CHECK_THROWS_WITH(out.append(f), Contains("39 values"));
  MpmSample s = sample_at(9);
  s.kinetic = kUnset;
  CHECK_THROWS_WITH(out.append(s), Contains("kinetic is nan"));
  out.finish();
  CHECK(MpmHistory(folder / "m.h5").num_frames() == 1);
}

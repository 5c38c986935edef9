#include "fem/checkpoint.hpp"

#include "core/hash.hpp"
#include "model/checkpoint_file.hpp"
#include "mpm/solver/checkpoint.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/mpm/solid.hpp"
#include "verify/fem/scene.hpp"

/// Nobody's bytes at random carry the right checksum, so the input is a list of changes to a good
/// checkpoint, and the checksum is made anew, as somebody who forges one would.
namespace flowslide::fuzz {
namespace {

constexpr std::size_t kChecksum = 64, kMostChanges = 8;

/// Bytes of the file that write(path) makes, without the checksum.
template <class Write>
std::string bytes_of(Write&& write) {
  const auto path = folder() / "good.checkpoint";
  write(path);
  std::string bytes = read_text_file(path);
  bytes.resize(bytes.size() - kChecksum);
  return bytes;
}

std::filesystem::path forge(std::string bytes, Parts parts) {
  for (std::size_t i = 0; i < kMostChanges && !parts.empty(); ++i) {
    const auto kind = parts.number();
    const std::size_t at = parts.number<std::uint32_t>() % (bytes.size() + 1);
    const auto value = parts.number<std::uint64_t>();
    const std::string text(reinterpret_cast<const char*>(&value), sizeof value);
    if (kind % 4 == 0) bytes.replace(at, std::min(text.size(), bytes.size() - at), text);
    if (kind % 4 == 1) bytes.replace(at, std::min<std::size_t>(1, bytes.size() - at), 1, text[0]);
    if (kind % 4 == 2) bytes.insert(at, text);
    if (kind % 4 == 3) bytes.resize(at);
  }
  return file("forged.checkpoint", bytes + sha256(bytes));
}

ParticleSet points(int dim) {
  ParticleSet p;
  p.materials = {mpm::liquefied(1e6, 4e3), mpm::elastic(5e6, 0.3)};
  if (dim == 3)
    mpm::add_block(p, {{0.0, 0.0, 0.0}, {1.0, 0.5, 1.0}}, 0.25, 1800.0);
  else
    mpm::add_lattice(p, {0.0, 0.0, 2.0, 1.0}, 0.25, 1800.0);
  return p;
}

FlowConfig settings() {
  FlowConfig c = mpm::free_space(0.5);
  c.gravity = 9.81;
  c.ground.surface = {{0.0, 0.0}};
  c.absorbing.left = 0.0;
  c.outlet.right = 50.0;
  c.sleep.emplace();
  return c;
}

template <int Dim>
mpm::Simulation<Dim> start() {
  return mpm::make_simulation<Dim>(points(Dim), settings());
}

template <int Dim>
void runout(Parts parts) {
  static const std::string good = bytes_of([](const std::filesystem::path& path) {
    mpm::Simulation<Dim> s = start<Dim>();
    mpm::StepScratch<Dim> scratch(1);
    prepare(s, scratch, true);
    for (int i = 0; i < 3; ++i) advance(s, scratch);
    write_checkpoint(path, s, {});
  });
  const auto path = forge(good, parts);
  accepts([&] {
    mpm::Simulation<Dim> s = start<Dim>();
    mpm::RunState run;
    read_checkpoint(path, s, run);
    mpm::StepScratch<Dim> scratch(1);
    prepare(s, scratch, false);
    check_walls(path, s);
    advance(s, scratch);
  });
}

void shaking(Parts parts) {
  static const fem::Solver rest =
      fem::at_rest(fem::section({.columns = 2, .rows = 2}), fem::config(fem::sand(), 2.0));
  static const std::string good = bytes_of([](const std::filesystem::path& path) {
    fem::Solver s = rest;
    advance(s, {});
    write_checkpoint(path, "fingerprint", s, {});
  });
  const auto path = forge(good, parts);
  accepts([&] {
    fem::Solver s = rest;
    fem::RunState run;
    read_checkpoint(path, "fingerprint", s, run);
    advance(s, {});
  });
}

/// The layer below: arrays of a length that the file says.
void plain(Parts parts) {
  static const std::string good = bytes_of([](const std::filesystem::path& path) {
    CheckpointWriter out(path, 7);
    out.value(1.0);
    out.array(std::vector<double>{1.0, 2.0});
    out.array(std::vector<char>{'a'});
    out.finish();
  });
  const auto path = forge(good, parts);
  accepts([&] {
    CheckpointReader in(path, 7);
    double value = 0.0;
    std::vector<double> array;
    std::vector<char> text;
    in.value(value);
    in.array(array);
    in.array(text);
    in.finish();
  });
}

}  // namespace

void checkpoint(Input input) {
  Parts parts(input);
  switch (parts.number() % 4) {
    case 0:
      return runout<2>(parts);
    case 1:
      return runout<3>(parts);
    case 2:
      return shaking(parts);
    default:
      return plain(parts);
  }
}

}  // namespace flowslide::fuzz

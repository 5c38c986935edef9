#include "importers/opensees.hpp"
#include "importers/recorder_text.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace flowslide::fuzz {

void recorder(Input input) {
  const auto path = file("displacement.out", input);
  accepts([&] { (void)summarize_recorder(path); });
  accepts([&] {
    RecorderReader reader(path);
    std::vector<double> values;
    while (reader.next(values))
      if (!reader.skip()) break;
  });
}

void opensees(Input input) {
  Parts parts(input);
  Switches choose(parts.section());
  OpenSeesConfig c;
  const auto next = [&](const char* name) { return InputFile{file(name, parts.section())}; };
  c.mesh.nodes = next("nodeinfo.dat");
  c.mesh.elements = next("elementinfo.dat");
  c.mesh.recorder_order = choose.flag() ? RecorderOrder::tag : RecorderOrder::file;
  c.mesh.reverse_clockwise = choose.flag();
  for (int tag = 1; tag < 200; ++tag) c.materials[std::to_string(tag)] = {tag, 1900.0, {}};
  c.units = {"m", "s", "kPa"};
  c.columns.time = !choose.flag();
  c.bad_rows = choose.flag() ? BadRows::stop : BadRows::error;
  c.gravity.row = std::array{"last", "first", "2"}[choose.choose(3)];
  c.sigma_zz.rule = SigmaZzRule(choose.choose(3));
  if (c.sigma_zz.rule == SigmaZzRule::elastic) c.sigma_zz.nu = 0.3;
  if (c.sigma_zz.rule == SigmaZzRule::k0) c.sigma_zz.k0 = 0.5;
  c.gravity.stress = next("Gstress.out");
  c.gravity.pore_pressure = next("GporePressure.out");
  if (choose.flag()) c.gravity.strain = next("Gstrain.out");
  if (choose.flag()) {
    c.shaking.emplace();
    c.shaking->stage = StageChoice(choose.choose(3));
    if (!c.columns.time) c.shaking->interval = 0.1;
    c.shaking->displacement = next("displacement.out");
    c.shaking->velocity = next("velocity.out");
    c.shaking->pore_pressure = next("porePressure.out");
    c.shaking->stress = next("stress.out");
    c.shaking->strain = next("strain.out");
  }
  const auto out = folder() / "history.h5";
  // What an import writes, the next stage reads.
  if (accepts([&] { (void)import_opensees(c, out); })) {
    const FemHistory history(out);
    for (std::size_t i = 0; i < history.times().size(); ++i) (void)history.frame(i);
  }
}

}  // namespace flowslide::fuzz

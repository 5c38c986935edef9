#include "report/audit_table.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"
#include "workflows/engine/record.hpp"
#include "workflows/engine/run_folder.hpp"
#include "workflows/engine/runner.hpp"

namespace flowslide::fuzz {

void run_lock(Input input) {
  file("run.lock", input);
  accepts([&] {
    const auto lock = read_lock(folder().path());
    if (!lock) return;
    std::vector<StageRecord> records;
    for (const auto& [name, record] : lock->stages) records.push_back(record);
    (void)publications(records);
    // What was read can be written, and is then read as the same.
    write_lock(folder().path(), *lock);
    const auto again = read_lock(folder().path());
    if (!again || again->published != lock->published || again->stages.size() != records.size())
      std::abort();
  });
}

void stage_record(Input input) {
  Parts parts(input);
  file("stage.json", parts.section());
  file("facts.json", parts.section());
  accepts([&] {
    const auto record = read_record(folder().path());
    if (!record) return;
    write_record(folder().path(), *record);
    if (!read_record(folder().path())) std::abort();
    Decision decision;
    (void)result_json({}, {{*record, decision}}, 0.0);
  });
  const auto audit = file("audit.json", parts.section());
  accepts([&] { (void)audit_tables(audit); });
}

}  // namespace flowslide::fuzz

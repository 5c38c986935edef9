#include "core/hash.hpp"
#include "report/audit_table.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"
#include "workflows/engine/lock.hpp"
#include "workflows/engine/publish.hpp"
#include "workflows/engine/record.hpp"
#include "workflows/engine/runner.hpp"

/// Nobody's bytes at random carry the right checksum, so the inputs are the text before it, and the
/// checksum is made anew, as somebody who forges one would.
namespace flowslide::fuzz {
namespace {

/// A JSON object whose last brace the input leaves out.
std::string sealed(const std::string& text) {
  const std::string digest = sha256(text);
  return text + ",\n  \"sha256\": \"" + digest + "\"\n}\n";
}

}  // namespace

void run_lock(Input input) {
  file("run.lock", sealed(std::string(input)));
  accepts([&] {
    const auto lock = read_lock(folder().path()).lock;
    if (!lock) return;
    std::vector<StageRecord> records;
    for (const auto& [name, record] : lock->stages) records.push_back(record);
    (void)publications(records);
    (void)problems_at_top(folder().path(), *lock);
    // What was read can be written, and is then read as the same.
    write_lock(folder().path(), *lock);
    const auto again = read_lock(folder().path()).lock;
    if (!again || again->published != lock->published || again->stages.size() != records.size())
      std::abort();
  });
}

void stage_record(Input input) {
  Parts parts(input);
  const std::string facts(parts.section());
  file("facts.json", facts);
  std::string record_text(parts.section());
  const std::string place = "FACTS";  // the checksum of facts.json
  if (const auto at = record_text.find(place); at != std::string::npos)
    record_text.replace(at, place.size(), sha256(facts));
  if (record_text.ends_with('\n')) record_text.pop_back();  // that of the line before the section
  file("stage.json", sealed(record_text));
  accepts([&] {
    auto record = read_stage_record(folder().path()).record;
    if (!record) return;
    record->files.clear();  // write_record adds facts.json
    write_record(folder().path(), *record);
    if (!read_stage_record(folder().path()).record) std::abort();
    Decision decision;
    (void)result_json({}, {{*record, decision}}, 0.0);
  });
  const auto audit = file("audit.json", parts.section());
  accepts([&] { (void)audit_tables(audit); });
}

}  // namespace flowslide::fuzz

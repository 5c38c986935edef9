#include "core/hash.hpp"
#include "study/batch/part.hpp"
#include "study/batch/slurm.hpp"
#include "study/page/page.hpp"
#include "study/plan/rows.hpp"
#include "study/run/study_state.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace flowslide::fuzz {

void study(Input input) {
  Parts parts(input);
  const auto path = file("study.yaml", parts.section());
  file("cases.csv", parts.section());
  // They are there; what is in them is for the planner.
  file("w.yaml", "schema: 1\n");
  file("v.yaml", "schema: 1\n");
  accepts([&] { (void)study::expand(study::read_study(path)); });
}

/// As in records.cpp: the checksum is made anew.
void study_plan(Input input) {
  std::string text(input);
  const std::string digest = sha256(text);
  file("study.json", text + ",\n  \"sha256\": \"" + digest + "\"\n}\n");
  accepts([&] {
    const study::Plan plan = study::read_plan(folder().path());
    const study::Store store(folder().path());
    const study::StudyState state(plan, store);
    for (const study::Row& row : plan.rows) {
      (void)state.cause(row);
      (void)row.label();
    }
    try {
      const study::Table table = study::make_table(plan, state);
      (void)study::to_csv(table);
      (void)study::make_page(plan, table, study::analyse(plan, table));
    } catch (const InputError&) {
      // a column that is not there
    }
    // What was read can be written, and is then read as the same.
    study::write_plan(folder().path(), plan);
    if (to_json(study::read_plan(folder().path())) != to_json(plan)) std::abort();
  });
}

void job_array(Input input) {
  Parts parts(input);
  const std::string text(parts.section());
  const auto path = file("rows.json", text + ",\n  \"sha256\": \"" + sha256(text) + "\"\n}\n");
  accepts([&] {
    const study::ArrayRecord record = study::read_array(path);
    const study::Plan plan;
    for (std::size_t task = 0; task < record.tasks.size(); ++task)
      (void)study::nodes_of_task(plan, record, task);
    study::write_array(path, record);
    if (study::read_array(path).tasks != record.tasks) std::abort();
  });
  (void)study::queued_tasks(parts.rest());
}

}  // namespace flowslide::fuzz

#include "core/files.hpp"
#include "study/page/page.hpp"
#include "workflows/engine/result_folder.hpp"

namespace fs = std::filesystem;

namespace flowslide::study {

void write_tables(const fs::path& folder, const Plan&, const Table& table) {
  write_file(folder / "table.csv", to_csv(table));
  write_file(folder / "columns.csv", columns_csv(table));
  write_hdf5(folder / "table.h5", table);
}

void write_page(const fs::path& folder, const Plan& plan, const Table& table) {
  const StudyFindings findings = analyse(plan, table);
  write_file(folder / "analysis.json", to_json_text(plan, findings));
  const Page page = make_page(plan, table, findings);
  make_folders(folder / "figures");
  for (const auto& [name, svg] : page.figures) write_file(folder / "figures" / name, svg);
  write_file(folder / "study.html", page.html);
}

}  // namespace flowslide::study

#include "model/field_store.hpp"
#include "study/table/table.hpp"

#include <algorithm>

namespace flowslide::study {
namespace {

std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string heading(const Column& c) {
  const bool told = c.unit.empty() || !unit_in_name(c.name).empty();
  return cell(told ? c.name : fmt::format("{} [{}]", c.name, c.unit));
}

constexpr std::array<std::string_view, 6> kRoles{"row",   "input", "disturbance",
                                                 "state", "found", "key"};

}  // namespace

std::string to_csv(const Table& table) {
  std::string out;
  for (const Column& c : table.columns) out += (out.empty() ? "" : ",") + heading(c);
  out += '\n';
  for (std::size_t r = 0; r < table.rows; ++r)
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      out += cell(table.columns[i].text[r]) + (i + 1 < table.columns.size() ? "," : "\n");
  return out;
}

std::string columns_csv(const Table& table) {
  std::string out = "column,unit,role,source\n";
  for (const Column& c : table.columns)
    out += fmt::format("{},{},{},{}\n", cell(c.name), c.unit,
                       kRoles[static_cast<std::size_t>(c.role)], cell(c.source));
  return out;
}

void write_hdf5(const std::filesystem::path& path, const Table& table) {
  FieldWriter writer(path, "study_table", 1);
  for (const Column& c : table.columns) {
    std::string name = c.name;
    std::replace(name.begin(), name.end(), '/', '_');
    if (c.is_number)
      writer.write(name, c.number, {c.unit.empty() ? "-" : c.unit, c.source, Nan::allowed});
    else
      writer.write_texts(name, c.text, c.source);
  }
  writer.finish();
}

}  // namespace flowslide::study

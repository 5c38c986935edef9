#include "study/page/page_tables.hpp"

#include "core/xml_text.hpp"
#include "study/page/labels.hpp"
#include "study/page/words.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

/// "Larger with it", as far as the rows tell.
std::string tendency(const Relation& r) {
  const Estimate& e = is_set(r.within.value) ? r.within : r.spearman;
  if (!is_set(e.value)) return "";
  if (is_set(e.low) && e.low < 0.0 && e.high > 0.0) return "no tendency that these rows show";
  return e.value > 0.0 ? "larger with it" : "smaller with it";
}

std::string relation_item(const Table& table, const Relation& r) {
  std::string text = fmt::format("<li><b>{}</b>: {}, rank correlation ",
                                 xml_text(readable(table, r.x)), tendency(r));
  text += is_set(r.within.value)
              ? fmt::format("{} among rows of one {}, {} among all", interval(r.within),
                            xml_text(r.by), short_number(r.spearman.value))
              : interval(r.spearman);
  return text + ".</li>";
}

std::string relation_rows(const Table& table, const std::vector<const Relation*>& relations) {
  std::string html =
      "<div class='wide'><table><tr><th class='word'>against</th><th>rank correlation</th>"
      "<th>among rows of one</th><th>slope</th><th>R&sup2;</th><th>rows</th></tr>";
  for (const Relation* r : relations)
    html += fmt::format(
        "<tr><td class='word'>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
        xml_text(readable(table, r->x)), interval(r->spearman),
        is_set(r->within.value) ? xml_text(r->by) + ": " + interval(r->within) : "-",
        interval(r->line.slope), short_number(r->line.r2), r->spearman.rows);
  return html + "</table></div>";
}

std::string run_links(const StudyAbout& about, const Row& row) {
  const std::size_t r = row.number - 1;
  const std::string to = r < about.reports.size() ? about.reports[r] : "";
  if (to.empty()) return "<td class='word'></td>";
  // what is in this file has no address: the scripts open it
  const std::string page = about.embedded ? "#side-by-side" : xml_text(to);
  const std::string flow = about.embedded ? page : page + "#the-flow";
  const std::string title = xml_text(row_title(row));
  return fmt::format(
      "<td class='word'><a href='{0}' target='_blank' data-row='{2}' title='{3}'>page</a> <a "
      "href='{1}' target='left' data-row='{2}' title='{3}, on the left'>left</a> <a href='{1}' "
      "target='right' data-row='{2}' title='{3}, on the right'>right</a></td>",
      page, flow, r, title);
}

bool says_one_thing(const Column& c) {
  return std::all_of(c.text.begin(), c.text.end(),
                     [&](const std::string& text) { return text == c.text.front(); });
}

std::vector<const Column*> shown_columns(const Table& table, const StudyFindings& f) {
  std::vector<const Column*> columns;
  for (const Column& c : table.columns) {
    const bool told = c.name == "variant" || c.name == "repeat" || c.name == "state" ||
                      c.name == "cause" || c.name == "outcome";
    const bool result = std::find(f.results.begin(), f.results.end(), c.name) != f.results.end();
    if (c.name == "row" || c.role == Role::input || result || (told && !says_one_thing(c)))
      columns.push_back(&c);
  }
  return columns;
}

}  // namespace

std::vector<const Relation*> strongest(const StudyFindings& f, const std::string& result) {
  std::vector<const Relation*> found;
  for (const Relation& r : f.relations)
    if (r.y == result) found.push_back(&r);
  std::stable_sort(found.begin(), found.end(), [](const Relation* a, const Relation* b) {
    return strength(*a) > strength(*b);
  });
  return found;
}

std::string relations_list(const Table& table, const StudyFindings& f) {
  constexpr std::size_t kShown = 5;
  std::string html, folded;
  for (const std::string& result : f.results) {
    const std::vector<const Relation*> found = strongest(f, result);
    if (found.empty()) continue;
    if (result == f.results.front()) {
      html += fmt::format("<p>{}, the strongest first:</p><ol>", xml_text(readable(table, result)));
      for (std::size_t k = 0; k < std::min(kShown, found.size()); ++k)
        html += relation_item(table, *found[k]);
      html += "</ol>";
    }
    folded +=
        fmt::format("<details><summary>{} against all {} of them</summary>{}</details>",
                    xml_text(readable(table, result)), found.size(), relation_rows(table, found));
  }
  return html + folded +
         "<p class='note'>In brackets: 95 % interval, from resampling the rows. A rank correlation "
         "of 1 means that more of the one is always more of the other.</p>";
}

bool any_report(const StudyAbout& about) {
  return std::any_of(about.reports.begin(), about.reports.end(),
                     [](const std::string& r) { return !r.empty(); });
}

std::string rows_table(const Plan& plan, const Table& table, const StudyFindings& f,
                       const StudyAbout& about) {
  std::string html = "<div class='wide'><table><tr>";
  const std::vector<const Column*> columns = shown_columns(table, f);
  const bool runs = any_report(about);
  const std::string links_head = runs ? "<th class='word'>run</th>" : "";
  for (const Column* c : columns) {
    html += fmt::format("<th{}>{}</th>", c->is_number ? "" : " class='word'",
                        xml_text(readable(table, c->name)));
    if (c == columns.front()) html += links_head;
  }
  html += "</tr>";
  for (std::size_t r = 0; r < table.rows; ++r) {
    html += fmt::format("<tr data-row='{}'>", r);
    for (const Column* c : columns) {
      const bool failed = c->name == "state" && c->text[r] == "failed";
      html += fmt::format(
          "<td{}>{}</td>",
          failed         ? " class='word failed'"
          : c->is_number ? ""
                         : " class='word'",
          xml_text(is_set(c->number[r]) ? fmt::format("{:.4g}", c->number[r]) : c->text[r]));
      if (runs && c == columns.front()) html += run_links(about, plan.rows[r]);
    }
    html += "</tr>";
  }
  return html + "</table></div>";
}

std::string finer(const Table& table, const std::string& column) {
  if (!column.starts_with("liquefaction_depth_") || !column.ends_with("_m")) return column;
  const std::string other = column.substr(0, column.size() - 2) + "_interpolated_m";
  const Column *nodes = table.find(column), *between = table.find(other);
  if (!nodes || !between || !between->is_number) return column;
  for (std::size_t r = 0; r < table.rows; ++r)
    if (is_set(nodes->number[r]) && !is_set(between->number[r])) return column;
  return other;
}

}  // namespace flowslide::study

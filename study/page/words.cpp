#include "study/page/words.hpp"

#include "core/xml_text.hpp"
#include "study/page/consequences.hpp"
#include "study/page/labels.hpp"
#include "study/page/meanings.hpp"
#include "study/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

std::string item(const std::string& text) { return "<li>" + text + "</li>"; }

std::string with_unit(const Table& table, const std::string& column, double v) {
  const Column* c = table.find(column);
  return xml_text(short_number(v) + (c && !c->unit.empty() ? " " + c->unit : ""));
}

/// The name of a column without its unit.
std::string plain(const Table& table, const std::string& column) {
  const std::string name = readable(table, column);
  return xml_text(name.substr(0, name.find(" [")));
}

/// "7 flowed, 4 slid, 1 stood": of the rows of the variant, each repeated row once.
std::string outcomes(const Table& table, const StudyFindings& f) {
  const Column* c = table.find("outcome");
  if (!c || c->is_number) return "";
  std::map<std::string, std::size_t> count;
  for (const std::size_t g : f.groups)
    if (const std::string& word = c->text[f.repeats.groups[g][0]]; !word.empty()) ++count[word];
  std::vector<std::pair<std::string, std::size_t>> words(count.begin(), count.end());
  std::stable_sort(words.begin(), words.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [word, n] : words)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, xml_text(word));
  return text.empty() ? "" : item("What became of the section: " + text + ".");
}

std::string how_far(const Plan& plan, const Table& table, const StudyFindings& f) {
  const std::string& result = f.results[0];
  const Exceedance& all = f.exceedance[0];
  const std::string name = plain(table, result);
  if (all.value.empty()) return item("No row has told yet.");
  const auto known = meaning_of(result);
  std::string text =
      known ? item(fmt::format("The {}: {}.", name, xml_text(known->definition))) : "";
  text +=
      item(fmt::format("Half of the rows have a {} above <b>{}</b>, one in twenty above <b>{}</b>.",
                       name, with_unit(table, result, weighted_quantile(all, 0.5)),
                       with_unit(table, result, weighted_quantile(all, 0.95))));
  const bool sampled =
      std::any_of(plan.inputs.begin(), plan.inputs.end(), [](const Input& i) { return i.sampled; });
  if (!sampled && !plan.inputs.empty())
    text += item(
        "Rows are combinations of the inputs, none likelier than another: their shares are "
        "no probabilities.");
  const std::vector<double>& number = table.find(result)->number;
  std::size_t largest = plan.rows.size();
  for (const std::size_t g : f.groups)
    for (const std::size_t row : f.repeats.groups[g])
      if (is_set(number[row]) && (largest == plan.rows.size() || number[row] > number[largest]))
        largest = row;
  if (largest < plan.rows.size())
    text += item(fmt::format("The largest is {}, in {}.", with_unit(table, result, number[largest]),
                             xml_text(row_title(plan.rows[largest]))));
  return text + outcomes(table, f);
}

std::string how_sure(const Table& table, const StudyFindings& f) {
  const std::string& result = f.results[0];
  const Scatter& s = f.scatter[0];
  std::string text;
  if (is_set(s.numerical))
    text += item(fmt::format(
        "Numerics alone move one row by &plusmn; {} (standard deviation; {} rows were computed "
        "again with disturbances that mean nothing to the dam). Two rows that differ by less than "
        "{} do not differ.",
        with_unit(table, result, s.numerical), s.repeated,
        with_unit(table, result, 2.0 * s.numerical)));
  else
    text += item("No row was computed twice: what numerics alone do to a row is not known.");
  if (is_set(s.of_inputs))
    text += item(fmt::format("The inputs that the study varies move it by &plusmn; {}.",
                             with_unit(table, result, s.of_inputs)));
  return text + item(
                    "Both describe the model. What the model leaves out, and inputs that the study "
                    "keeps fixed, come on top.");
}

/// "at 0.5"; "up to 0.5" stays.
std::string at(const std::string& label) {
  return label.starts_with("up to ") || label.starts_with("from ") ? label : "at " + label;
}

std::string why(const Table& table, const StudyFindings& f) {
  const std::string& result = f.results[0];
  std::vector<const Relation*> found;
  for (const Relation& r : f.relations) {
    const Column* x = table.find(r.x);
    if (r.y == result && x && x->role == Role::found && is_set(r.spearman.value))
      found.push_back(&r);
  }
  std::stable_sort(found.begin(), found.end(), [](const Relation* a, const Relation* b) {
    return strength(*a) > strength(*b);
  });
  std::string text;
  constexpr std::size_t kMost = 3;
  for (std::size_t i = 0; i < std::min(found.size(), kMost); ++i) {
    const Relation& r = *found[i];
    text +=
        item(is_set(r.within.value)
                 ? fmt::format(
                       "It goes with {}: rank correlation {} among rows of one {}, {} among all.",
                       plain(table, r.x), interval(r.within), xml_text(r.by),
                       short_number(r.spearman.value))
                 : fmt::format("It goes with {}: rank correlation {}.", plain(table, r.x),
                               interval(r.spearman)));
  }
  for (const Threshold& t : f.thresholds)
    if (t.y == result) text += threshold_sentence(table, t);
  return text.empty() ? item("The study has found nothing that it goes with.") : text;
}

std::string what_would_change_it(const Table& table, const StudyFindings& f) {
  const std::string& result = f.results[0];
  std::vector<const Swing*> swings;
  for (const Swing& s : f.swings)
    if (s.result == result && is_set(s.effect.swing.value)) swings.push_back(&s);
  std::stable_sort(swings.begin(), swings.end(), [](const Swing* a, const Swing* b) {
    return std::abs(a->effect.swing.value) > std::abs(b->effect.swing.value);
  });
  std::string text;
  for (const Swing* s : swings) {
    const Effect& e = s->effect;
    const bool noise = std::abs(e.swing.value) < 2.0 * f.scatter[0].numerical;
    const Column* input = table.find(s->input);
    const std::string unit =
        input && input->is_number && !input->unit.empty() ? " " + input->unit : "";
    text += item(fmt::format("<b>{}</b>: {} on average {}, {} {}: {}{}{}.", xml_text(s->input),
                             with_unit(table, result, e.low), xml_text(at(e.low_label) + unit),
                             with_unit(table, result, e.high), xml_text(at(e.high_label) + unit),
                             e.swing.value > 0.0 ? "+" : "", interval(e.swing),
                             noise ? "; no more than numerics do" : ""));
  }
  for (const Comparison& c : f.comparisons)
    if (c.result == result && c.where.empty())
      text += item(fmt::format("<b>variant</b>: the mean of {} is {} times that of {}.",
                               xml_text(f.variant), interval(c.ratio), xml_text(c.variant)));
  return text.empty() ? item("The study varies nothing that it hangs on.") : text;
}

std::string block(const char* heading, const std::string& items) {
  return fmt::format("<div class='block'><h3>{}</h3><ul>{}</ul></div>", heading, items);
}

}  // namespace

double strength(const Relation& r) {
  const double v = is_set(r.within.value) ? r.within.value : r.spearman.value;
  return is_set(v) ? std::abs(v) : -1.0;
}

std::string threshold_sentence(const Table& table, const Threshold& t) {
  if (!is_set(t.ramp.breach.value)) return "";
  const std::string x = xml_text(readable(table, t.x)), y = xml_text(readable(table, t.y));
  const bool begins = t.ramp.begins(), ends = t.ramp.ends();
  std::string text =
      fmt::format("<li>{} against {}{}: ", y, x, t.where.empty() ? "" : ", " + xml_text(t.where));
  if (begins) text += fmt::format("none below {}; ", interval(t.ramp.breach));
  if (ends)
    text += fmt::format("no growth beyond {}, at {}", interval(t.ramp.saturation),
                        interval(t.ramp.plateau));
  if (!begins || !ends)
    text += fmt::format("{}these rows do not show where it {}", ends ? "; " : "",
                        begins ? "stops to grow"
                        : ends ? "begins"
                               : "begins, nor where it stops to grow");
  text += ". ";
  return text + fmt::format("(ramp R&sup2; {}, straight line {})</li>", short_number(t.ramp.r2),
                            short_number(t.ramp.line_r2));
}

std::string judgement(const Plan& plan, const Table& table, const StudyFindings& f) {
  if (f.results.empty()) return "";
  std::string name = plain(table, f.results[0]);
  // Names begin with a letter of ASCII, or stay as they are.
  if (name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return "<section class='judgement' id='judgement'><h2>" + name +
         ": how far, how sure, why, and what would change it</h2>" +
         block("How far", how_far(plan, table, f)) + block("How sure", how_sure(table, f)) +
         block("Why", why(table, f)) +
         block("What would change it", what_would_change_it(table, f)) +
         "<p class='note'>In brackets: 95 % interval, from resampling the rows; those that share "
         "a stage, such as a shaking, come and go together.</p></section>";
}

std::string cards(const Plan& plan, const Table& table, const StudyFindings& f) {
  std::string out = "<div class='cards'>";
  const auto card = [&](const std::string& name, const std::string& value, const std::string& unit,
                        const std::string& note) {
    out += fmt::format(
        "<div class='card'><span class='name'>{}</span><span class='value'>{}<small> {}</small>"
        "</span><span class='note'>{}</span></div>",
        name, value, unit, note);
  };
  std::size_t done = 0;
  for (const std::string& s : table.find("state")->text) done += s == "done";
  if (!f.results.empty() && !f.exceedance[0].value.empty()) {
    const std::string name = plain(table, f.results[0]);
    const std::string unit = xml_text(table.find(f.results[0])->unit);
    const Exceedance& all = f.exceedance[0];
    card(name, short_number(weighted_quantile(all, 0.5)), unit, "median of the rows");
    card(name, short_number(weighted_quantile(all, 0.95)), unit, "exceeded by one row in twenty");
    const Scatter& s = f.scatter[0];
    card("numerics alone",
         is_set(s.numerical) ? "&plusmn; " + short_number(s.numerical) : "not known",
         is_set(s.numerical) ? unit : "", fmt::format("{} rows repeated", s.repeated));
    card("inputs", is_set(s.of_inputs) ? "&plusmn; " + short_number(s.of_inputs) : "-", unit,
         "standard deviation");
  }
  card("rows", fmt::format("{}", done), "", fmt::format("done of {}", plan.rows.size()));
  return out + "</div>";
}

std::string warnings(const Table& table) {
  if (table.warnings.empty())
    return "<p class='quiet'>No stage of this study warned of anything.</p>";
  std::string text =
      "<section class='warnings' id='warnings'><h2>Read this before using the numbers</h2><ul>";
  for (const TableWarning& w : table.warnings) {
    const std::string_view meaning = consequence_of(w.text);
    text += fmt::format("<li><b>In {} of {} rows</b>, {}: {}", w.in.size(), table.rows,
                        xml_text(w.stage), xml_text(w.text));
    if (!meaning.empty()) text += fmt::format(" <span class='means'>{}</span>", xml_text(meaning));
    text += fmt::format(" <span class='note'>Row{} {}.</span></li>", w.in.size() == 1 ? "" : "s",
                        spans_of(w.in));
  }
  return text + "</ul></section>";
}

}  // namespace flowslide::study

#include "study/page/page.hpp"

#include "core/xml_text.hpp"
#include "study/page/chart.hpp"
#include "study/statistics/summary.hpp"
#include "workflows/engine/program_version.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

constexpr std::string_view kStyle = R"(
:root{--paper:#fff;--ink:#1f2328;--soft:#57606a;--line:#d8dee4;--grid:#eceff2;--a:#1d4ed8;--b:#c2410c;
--c:#15803d;--d:#7e22ce;--e:#a16207;--f:#0e7490}
@media(prefers-color-scheme:dark){:root{--paper:#0d1117;--ink:#e6edf3;--soft:#9aa4af;--line:#30363d;
--grid:#1d232b;--a:#7aa2ff;--b:#ff9a5c;--c:#5fd38a;--d:#c99bff;--e:#e2b93b;--f:#4cc9d8}}
*{box-sizing:border-box}body{margin:0 auto;max-width:72rem;padding:1.5rem;background:var(--paper);
color:var(--ink);font:16px/1.5 system-ui,sans-serif}h1{font-size:1.7rem;margin:0 0 .3rem}
h2{font-size:1.25rem;margin:2.2rem 0 .6rem}p,li{max-width:46rem}.soft{color:var(--soft)}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,26rem),1fr));gap:1rem}
figure{margin:0;border:1px solid var(--line);border-radius:8px;padding:.6rem}
figcaption{font-size:.86rem;color:var(--soft);padding:.3rem .2rem 0}svg{width:100%;height:auto;display:block}
svg text{font:12px system-ui,sans-serif;fill:var(--soft)}svg .head{font-weight:600;fill:var(--ink)}
.axis,.bar{stroke:var(--soft)}.grid{stroke:var(--grid)}.fit{stroke:var(--b);fill:none;stroke-width:2}
.curve{stroke:var(--a);fill:none;stroke-width:2}.band{fill:var(--a);fill-opacity:.13}
.s0{fill:var(--a)}.s1{fill:var(--b)}.s2{fill:var(--c)}.s3{fill:var(--d)}.s4{fill:var(--e)}.s5{fill:var(--f)}
circle{fill-opacity:.75}.low{fill:var(--f)}.high{fill:var(--b)}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.86rem;font-variant-numeric:tabular-nums}
th,td{padding:.25rem .6rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}
th{text-align:right;font-weight:600;position:sticky;top:0;background:var(--paper)}
td.word,th.word{text-align:left}.failed{color:var(--b)}
@media print{body{max-width:none;padding:0}figure{break-inside:avoid}})";

std::string short_number(double v) { return is_set(v) ? fmt::format("{:.3g}", v) : "-"; }

std::string interval(const Estimate& e) {
  if (!is_set(e.value)) return "-";
  if (!is_set(e.low)) return short_number(e.value);
  return fmt::format("{} ({} to {})", short_number(e.value), short_number(e.low),
                     short_number(e.high));
}

std::string readable(const Table& table, const std::string& name) {
  std::string text = name;
  const Column* c = table.find(name);
  const std::string unit = c ? c->unit : unit_in_name(name);
  if (c && c->role == Role::found) text = without_unit(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

class Writer {
 public:
  Writer(const Plan& plan, const Table& table, const StudyFindings& f,
         const std::vector<SessionRecord>& sessions)
      : plan_(plan), table_(table), f_(f), sessions_(sessions) {}

  Page write() {
    head();
    answer();
    figures();
    relations();
    comparisons();
    rows();
    end();
    page_.html = std::move(html_);
    return std::move(page_);
  }

 private:
  void head() {
    html_ += fmt::format(
        "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
        "content='width=device-width,initial-scale=1'><title>{0}</title><style>{1}</style></head>"
        "<body><h1>{0}</h1>",
        xml_text(plan_.name), kStyle);
    if (!plan_.description.empty()) html_ += fmt::format("<p>{}</p>", xml_text(plan_.description));
    std::size_t failed = 0, open = 0;
    for (const std::string& s : table_.find("state")->text) {
      failed += s == "failed";
      open += s == "open";
    }
    html_ += fmt::format("<p class='soft'>{} rows", plan_.rows.size());
    if (failed > 0) html_ += fmt::format(", <span class='failed'>{} failed</span>", failed);
    if (open > 0) html_ += fmt::format(", {} still to be computed", open);
    html_ += fmt::format(". Written by {}.</p>", xml_text(program_version()));
  }

  void answer() {
    html_ +=
        "<h2>What comes out</h2><div class='wide'><table><tr><th class='word'>result</th>"
        "<th>median</th><th>5 to 95 % of the rows</th><th>spread from the inputs</th>"
        "<th>numerical scatter</th><th>repeated</th></tr>";
    for (std::size_t i = 0; i < f_.results.size(); ++i) {
      const Exceedance& v = f_.exceedance[i];
      const Scatter& s = f_.scatter[i];
      html_ += fmt::format(
          "<tr><td class='word'>{}</td><td>{}</td><td>{} to {}</td><td>&plusmn; {}</td>"
          "<td>{}</td><td>{}</td></tr>",
          xml_text(readable(table_, f_.results[i])), short_number(weighted_quantile(v, 0.5)),
          short_number(weighted_quantile(v, 0.05)), short_number(weighted_quantile(v, 0.95)),
          short_number(s.of_inputs),
          is_set(s.numerical) ? "&plusmn; " + short_number(s.numerical) : "not repeated",
          s.repeated);
    }
    html_ +=
        "</table></div><p class='soft'>Spread and scatter are standard deviations. The scatter "
        "is what disturbances leave that mean nothing to the dam: a difference between two rows "
        "that is not larger is none.</p><ul>";
    for (const Threshold& t : f_.thresholds) threshold(t);
    html_ += "</ul>";
  }

  void threshold(const Threshold& t) {
    if (!is_set(t.ramp.breach.value)) return;
    const std::string x = xml_text(readable(table_, t.x)), y = xml_text(readable(table_, t.y));
    const bool begins = t.ramp.no_breach <= kMostWithout,
               ends = t.ramp.no_saturation <= kMostWithout;
    html_ += fmt::format("<li>{} against {}: ", y, x);
    html_ += begins ? fmt::format("nothing below {}; ", interval(t.ramp.breach))
                    : "no value of it below which there is nothing; ";
    html_ += ends ? fmt::format("no growth beyond {}, at {}. ", interval(t.ramp.saturation),
                                interval(t.ramp.plateau))
                  : "no value of it beyond which the growth stops. ";
    html_ += fmt::format("(ramp R&sup2; {}, straight line {})</li>", short_number(t.ramp.r2),
                         short_number(t.ramp.line_r2));
  }

  /// The input by which dots are coloured: few values, and not what the chart is drawn over.
  [[nodiscard]] const Column* colour(const std::string& x) const {
    constexpr std::size_t kMost = 6;
    for (const Input& input : plan_.inputs) {
      const Column* c = table_.find(input.name);
      std::set<std::string> values;
      for (const std::size_t g : f_.groups) values.insert(c->text[f_.repeats.groups[g][0]]);
      if (input.name != x && values.size() > 1 && values.size() <= kMost) return c;
    }
    return nullptr;
  }

  void add_figure(const std::string& file, const Svg& svg, const std::string& caption) {
    page_.figures[file + ".svg"] = svg.alone(caption);
    html_ += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>", svg.inside_page(caption),
                         xml_text(caption));
  }

  void scatter_figure(const Relation& r, std::size_t result) {
    ScatterChart chart{.x_label = readable(table_, r.x),
                       .y_label = readable(table_, r.y),
                       .dots = {},
                       .series = {},
                       .series_label = {},
                       .ramp = {}};
    const Column &x = *table_.find(r.x), *by = colour(r.x);
    for (const std::size_t g : f_.groups) {
      const auto& rows = f_.repeats.groups[g];
      const std::size_t row = rows[0];
      std::vector<double> here;
      for (const std::size_t other : rows)
        if (is_set(x.number[other])) here.push_back(x.number[other]);
      Dot dot{.x = mean(here),
              .y = f_.scatter[result].mean[g],
              .scatter = f_.scatter[result].deviation[g],
              .series = 0,
              .title = plan_.rows[row].label()};
      if (!is_set(dot.x) || !is_set(dot.y)) continue;
      if (by) {
        const auto at = std::find(chart.series.begin(), chart.series.end(), by->text[row]);
        dot.series = static_cast<std::size_t>(at - chart.series.begin());
        if (at == chart.series.end()) chart.series.push_back(by->text[row]);
      }
      chart.dots.push_back(std::move(dot));
    }
    if (by) chart.series_label = by->name;
    chart.usual_scatter = f_.scatter[result].numerical;
    for (const Threshold& t : f_.thresholds)
      if (t.x == r.x && t.y == r.y) chart.ramp = t.ramp;
    add_figure(fmt::format("{}-{}", r.y, r.x), draw(chart),
               fmt::format("{} against {}. Rank correlation {}.", readable(table_, r.y),
                           readable(table_, r.x), interval(r.spearman)));
  }

  void figures() {
    for (std::size_t i = 0; i < f_.results.size(); ++i) {
      const std::string& result = f_.results[i];
      const std::string label = readable(table_, result);
      html_ += fmt::format("<h2>{}</h2><div class='figures'>", xml_text(label));
      std::vector<Swing> swings;
      for (const Swing& s : f_.swings)
        if (s.result == result) swings.push_back(s);
      if (!swings.empty())
        add_figure(result + "-tornado", draw_tornado(swings, f_.scatter[i].numerical, label),
                   "Mean result at the low and the high end of each input, the others as in the "
                   "study.");
      if (f_.exceedance[i].value.size() > 2)
        add_figure(result + "-exceedance", draw_exceedance(f_.exceedance[i], label),
                   "Share of the rows above a value, with the band that holds the whole curve in "
                   "95 % of studies. Rows are not equally likely unless they were sampled.");
      for (const Relation& r : f_.relations)
        if (r.y == result) scatter_figure(r, i);
      html_ += "</div>";
    }
  }

  void relations() {
    if (f_.relations.empty()) return;
    html_ +=
        "<h2>What it hangs on</h2><div class='wide'><table><tr><th class='word'>result</th>"
        "<th class='word'>against</th><th>rank correlation</th><th>slope</th><th>R&sup2;</th>"
        "<th>rows</th></tr>";
    for (const Relation& r : f_.relations)
      html_ += fmt::format(
          "<tr><td class='word'>{}</td><td class='word'>{}</td><td>{}</td>"
          "<td>{}</td><td>{}</td><td>{}</td></tr>",
          xml_text(readable(table_, r.y)), xml_text(readable(table_, r.x)), interval(r.spearman),
          interval(r.line.slope), short_number(r.line.r2), r.spearman.rows);
    html_ +=
        "</table></div><p class='soft'>In brackets: 95 % interval, from resampling the rows."
        "</p>";
  }

  void comparisons() {
    if (f_.comparisons.empty() && f_.not_compared.empty()) return;
    html_ +=
        "<h2>Variants</h2><div class='wide'><table><tr><th class='word'>result</th>"
        "<th class='word'>ratio of means</th><th class='word'>where</th><th>ratio</th></tr>";
    for (const Comparison& c : f_.comparisons)
      html_ += fmt::format(
          "<tr><td class='word'>{}</td><td class='word'>{} / {}</td>"
          "<td class='word'>{}</td><td>{}</td></tr>",
          xml_text(readable(table_, c.result)), xml_text(f_.variant), xml_text(c.variant),
          xml_text(c.where.empty() ? "all" : c.where), interval(c.ratio));
    for (const NotCompared& n : f_.not_compared)
      html_ += fmt::format(
          "<tr><td class='word'>{}</td><td class='word'>{} / {}</td>"
          "<td class='word' colspan='2'>not compared: {}</td></tr>",
          xml_text(readable(table_, n.result)), xml_text(f_.variant), xml_text(n.variant),
          xml_text(n.why));
    html_ += "</table></div>";
  }

  void rows() {
    html_ += "<h2>All rows</h2><div class='wide'><table><tr>";
    std::vector<const Column*> columns;
    for (const Column& c : table_.columns) {
      const bool result =
          std::find(f_.results.begin(), f_.results.end(), c.name) != f_.results.end();
      if (c.name == "row" || c.name == "variant" || c.name == "repeat" || c.role == Role::input ||
          c.name == "state" || c.name == "cause" || result)
        columns.push_back(&c);
    }
    for (const Column* c : columns)
      html_ += fmt::format("<th{}>{}</th>", c->is_number ? "" : " class='word'",
                           xml_text(readable(table_, c->name)));
    html_ += "</tr>";
    for (std::size_t r = 0; r < table_.rows; ++r) {
      html_ += "<tr>";
      for (const Column* c : columns) {
        const bool failed = c->name == "state" && c->text[r] == "failed";
        html_ += fmt::format(
            "<td{}>{}</td>",
            failed         ? " class='word failed'"
            : c->is_number ? ""
                           : " class='word'",
            xml_text(is_set(c->number[r]) ? fmt::format("{:.4g}", c->number[r]) : c->text[r]));
      }
      html_ += "</tr>";
    }
    html_ +=
        "</table></div><p class='soft'>Everything that the stages found: table.csv, table.h5, "
        "columns.csv. The numbers of this page: analysis.json.</p>";
  }

  void end() {
    html_ += fmt::format(
        "<h2>How it was computed</h2><p class='soft'>{} stages, each once for all rows that share "
        "it. Study file: {}. How the statistics are defined: docs/theory/study-statistics.md."
        "</p>",
        plan_.nodes.size(), xml_text(plan_.file.filename().string()));
    if (!sessions_.empty()) cost();
    html_ += "</body></html>\n";
  }

  void cost() {
    html_ +=
        "<div class='wide'><table><tr><th class='word'>computed from</th><th class='word'>by</th>"
        "<th class='word'>on</th><th>processors used</th><th>stages</th><th>time [min]</th>"
        "<th>processor time [min]</th></tr>";
    for (const SessionRecord& s : sessions_)
      html_ += fmt::format(
          "<tr><td class='word'>{}</td><td class='word'>{}</td><td class='word'>{}</td><td>{}</td>"
          "<td>{}</td><td>{:.1f}</td><td>{:.1f}</td></tr>",
          xml_text(s.began), xml_text(s.program), xml_text(s.processor), s.threads, s.stages,
          s.wall_seconds / 60.0, s.processor_seconds / 60.0);
    html_ += "</table></div>";
  }

  const Plan& plan_;
  const Table& table_;
  const StudyFindings& f_;
  const std::vector<SessionRecord>& sessions_;
  Page page_;
  std::string html_;
};

}  // namespace

Page make_page(const Plan& plan, const Table& table, const StudyFindings& findings,
               const std::vector<SessionRecord>& sessions) {
  return Writer(plan, table, findings, sessions).write();
}

}  // namespace flowslide::study

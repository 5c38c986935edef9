#include "study/page/page.hpp"

#include "core/xml_text.hpp"
#include "report/page.hpp"
#include "study/page/chart.hpp"
#include "study/page/explorer_data.hpp"
#include "study/page/labels.hpp"
#include "study/page/page_tables.hpp"
#include "study/page/varied.hpp"
#include "study/page/words.hpp"
#include "study/statistics/summary.hpp"
#include "study_bundle.hpp"
#include "workflows/engine/program_version.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

class Writer {
 public:
  Writer(const Plan& plan, const Table& table, const StudyFindings& f, const StudyAbout& about)
      : plan_(plan), table_(table), f_(f), about_(about) {}

  Page write() {
    head();
    html_ += warnings(table_) + judgement(plan_, table_, f_);
    section();
    html_ += what_was_varied(plan_, table_, f_);
    answer();
    explorer();
    side_by_side();
    overlay();
    figures();
    relations();
    comparisons();
    rows();
    end();
    page_.html = std::move(html_);
    return std::move(page_);
  }

 private:
  void open(const std::string& id, const std::string& heading) {
    html_ += fmt::format("<section id='{}'><h2>{}</h2>", id, xml_text(heading));
  }
  void close() { html_ += "</section>"; }

  void head() {
    const std::string style = std::string(page_style()) + std::string(kStudyStyle);
    // A page that is opened from memory is under the policy of this one too.
    std::string scripts = policy_hash(kStudyScript), styles = policy_hash(style);
    if (about_.embedded) {
      for (const std::string& hash : about_.embedded->scripts) scripts += " " + hash;
      for (const std::string& hash : about_.embedded->styles) styles += " " + hash;
    }
    html_ += fmt::format(
        "<!doctype html><html lang='en'><head><meta charset='utf-8'>"
        "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; script-src {}; "
        "style-src {}; img-src data: blob:; frame-src 'self' file: blob:; base-uri 'none'; "
        "form-action 'none'\"><meta name='viewport' "
        "content='width=device-width,initial-scale=1'><meta name='color-scheme' content='light "
        "dark'>",
        scripts, styles);
    html_ += fmt::format(
        "<title>{0}</title><style>{1}</style>"
        "</head><body><a class='skip' href='#judgement'>To the answer</a><header><h1>{0}</h1>",
        xml_text(plan_.name), style);
    std::string meta = xml_text(program_version());
    if (!about_.sessions.empty())
      meta = fmt::format("{} &middot; {}", xml_text(about_.sessions.back().began.substr(0, 10)),
                         xml_text(about_.sessions.back().program));
    html_ += fmt::format("<p class='meta'>{}</p>", meta);
    std::size_t failed = 0, open = 0;
    for (const std::string& s : table_.find("state")->text) {
      failed += s == "failed";
      open += s == "open";
    }
    html_ += fmt::format("<div class='lead'><p>{}</p><p>{} rows", xml_text(plan_.description),
                         plan_.rows.size());
    if (failed > 0) html_ += fmt::format(", <span class='failed'>{} failed</span>", failed);
    if (open > 0) html_ += fmt::format(", {} still to be computed", open);
    html_ += counted_rows(plan_) + ".</p></div>" + cards(plan_, table_, f_) + "</header><nav>";
    for (const auto& [id, name] :
         {std::pair{"judgement", "The answer"}, std::pair{"section", "The section"},
          std::pair{"varied", "What was varied"}, std::pair{"results", "Results"},
          std::pair{"explore", "Explore"}, std::pair{"side-by-side", "Two runs"},
          std::pair{"overlay", "Histories"}, std::pair{"charts", "Charts"},
          std::pair{"relations", "What it hangs on"}, std::pair{"rows", "All rows"},
          std::pair{"cost", "How it was computed"}})
      if ((id != std::string_view("side-by-side") || has_reports()) &&
          (id != std::string_view("section") || has_section()) &&
          (id != std::string_view("overlay") || has_curves()))
        html_ += fmt::format("<a href='#{}'>{}</a>", id, name);
    html_ += "<span id='tools'></span></nav><main>";
  }

  [[nodiscard]] bool has_section() const { return about_.stories && about_.stories->has_section; }

  void section() {
    if (!has_section()) return;
    open("section", "The section, and how far its runs come");
    html_ +=
        "<div id='fronts'><p>The drawing of the section needs JavaScript; the charts below do "
        "not.</p></div>";
    close();
  }

  void answer() {
    open("results", "What comes out");
    html_ +=
        "<div class='wide'><table><tr><th class='word'>result</th>"
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
        "</table></div><p class='note'>Spread and scatter are standard deviations. The scatter "
        "is what disturbances leave that mean nothing to the dam: a difference between two rows "
        "of less than twice as much is none.</p>" +
        levels_table(table_, f_);
    std::string others;
    for (const Threshold& t : f_.thresholds)
      if (f_.results.empty() || t.y != f_.results.front()) others += threshold_sentence(table_, t);
    if (!others.empty()) html_ += "<ul>" + others + "</ul>";
    close();
  }

  /// The input by which dots are coloured: that which parts the thresholds, or one of few values
  /// that is not what the chart is drawn over.
  [[nodiscard]] const Column* colour(const std::string& x, const std::string& y) const {
    constexpr std::size_t kMost = 6;
    for (const Threshold& t : f_.thresholds)
      if (t.x == x && t.y == y && !t.by.empty()) return table_.find(t.by);
    for (const Input& input : plan_.inputs) {
      const Column* c = table_.find(input.name);
      std::set<std::string> values;
      for (const std::size_t g : f_.groups) values.insert(c->text[f_.repeats.groups[g][0]]);
      const bool acts = std::any_of(f_.swings.begin(), f_.swings.end(), [&](const Swing& s) {
        return s.input == input.name && s.result == y;
      });
      if (input.name != x && acts && values.size() > 1 && values.size() <= kMost) return c;
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
                       .ramps = {}};
    const Column &x = *table_.find(r.x), *by = colour(r.x, r.y);
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
              .title = row_title(plan_.rows[row])};
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
    for (const Threshold& t : f_.thresholds) {
      if (t.x != r.x || t.y != r.y) continue;
      chart.ramps.push_back({t.ramp, {}});
      if (t.by.empty()) continue;
      const auto at = std::find(chart.series.begin(), chart.series.end(), by->text[t.row]);
      chart.ramps.back().series = static_cast<std::size_t>(at - chart.series.begin());
    }
    add_figure(fmt::format("{}-{}", r.y, r.x), draw(chart),
               fmt::format("{} against {}. Rank correlation {}{}.", readable(table_, r.y),
                           readable(table_, r.x), interval(r.spearman),
                           is_set(r.within.value)
                               ? fmt::format("; among rows of one {} {}", r.by, interval(r.within))
                               : ""));
  }

  void main_figures(std::size_t i, const std::string& label) {
    const std::string& result = f_.results[i];
    std::vector<Swing> swings;
    for (const Swing& s : f_.swings)
      if (s.result == result) swings.push_back(s);
    if (!swings.empty())
      add_figure(result + "-tornado", draw_tornado(swings, f_.scatter[i].numerical, label),
                 "Mean result at the low and the high end of each input, the others as in the "
                 "study.");
    if (f_.exceedance[i].value.size() > 2)
      add_figure(result + "-exceedance",
                 draw_exceedance(f_.exceedance[i], f_.scatter[i].numerical, label),
                 "Share of the rows above a value, with the band that holds the whole curve in "
                 "95 % of studies. Rows are not equally likely unless they were sampled.");
  }

  /// What decides stands open, the rest can be opened.
  void figures() {
    constexpr std::size_t kShown = 4;
    open("charts", "Charts");
    for (std::size_t i = 0; i < f_.results.size(); ++i) {
      const std::string label = readable(table_, f_.results[i]);
      html_ += i == 0 ? fmt::format("<h3>{}</h3>", xml_text(label))
                      : fmt::format("<details><summary>{}</summary>", xml_text(label));
      html_ += "<div class='figures'>";
      main_figures(i, label);
      const std::vector<const Relation*> related = strongest(f_, f_.results[i]);
      for (std::size_t k = 0; k < related.size(); ++k) {
        if (i == 0 && k == kShown)
          html_ +=
              fmt::format("</div><details><summary>{} weaker ones</summary><div class='figures'>",
                          related.size() - kShown);
        scatter_figure(*related[k], i);
      }
      html_ += "</div>";
      if (i > 0 || related.size() > kShown) html_ += "</details>";
    }
    close();
  }

  void relations() {
    if (f_.relations.empty()) return;
    open("relations", "What it hangs on");
    html_ += relations_list(table_, f_);
    close();
  }

  void comparisons() {
    if (f_.comparisons.empty() && f_.not_compared.empty()) return;
    open("variants", "Variants");
    html_ +=
        "<div class='wide'><table><tr><th class='word'>result</th>"
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
    close();
  }

  [[nodiscard]] bool has_reports() const { return any_report(about_); }

  [[nodiscard]] bool has_curves() const {
    return about_.stories && !about_.stories->curves.empty();
  }

  void overlay() {
    if (!has_curves()) return;
    open("overlay", "Runs over one another");
    html_ +=
        "<div id='strands'><p>Histories and spectra of all runs in one chart need JavaScript.</p>"
        "</div>";
    close();
  }

  void side_by_side() {
    if (!has_reports()) return;
    open("side-by-side", "Two runs side by side");
    html_ +=
        "<p>Click a point of the chart above, with Shift for the right, or choose <b>left</b> and "
        "<b>right</b> in <a href='#rows'>the table of all rows</a>: the pages of two runs stand "
        "here, each with its player. ";
    html_ += about_.embedded ? "They are in this file"
                             : "They lie beside this file, in <code>stages</code>";
    html_ += fmt::format("{}.</p><div class='two' id='two'>", without_page());
    for (const char* side : {"left", "right"})
      html_ += fmt::format(
          "<div><p class='which' data-side='{0}'></p><iframe name='{0}' title='run on the {0}'>"
          "</iframe></div>",
          side);
    html_ += "</div>";
    close();
  }

  /// ", but for 2 of 134 rows, of which no page was kept"; empty where every row has one.
  [[nodiscard]] std::string without_page() const {
    const auto without = std::count(about_.reports.begin(), about_.reports.end(), "");
    return without == 0 ? ""
                        : fmt::format(", but for {} of {} rows, which have none", without,
                                      about_.reports.size());
  }

  /// A chart of the reader's own: the scripts draw it. It starts with what a figure shows as well.
  void explorer() {
    open("explore", "Explore");
    html_ +=
        "<div id='explorer'><p>The chart of any number against any other needs JavaScript; the "
        "charts below do not.</p></div>";
    close();
  }

  [[nodiscard]] ExplorerStart explorer_start() const {
    ExplorerStart start;
    if (f_.results.empty()) return start;
    start.y = start.x = f_.results.front();
    if (const auto related = strongest(f_, start.y); !related.empty()) start.x = related.front()->x;
    if (const Column* by = colour(start.x, start.y)) start.colour = by->name;
    start.x = finer(table_, start.x);
    return start;
  }

  void rows() {
    open("rows", "All rows");
    html_ += rows_table(plan_, table_, f_, about_) +
             "<p class='note'>Everything that the stages found: table.csv, table.h5, columns.csv. "
             "The numbers of this page: analysis.json.</p>";
    if (about_.stories && !about_.stories->damaged.empty())
      html_ += fmt::format(
          "<p class='problem'>The pages of these rows are damaged, so that their curves are not "
          "shown: {}. Make their reports again.</p>",
          spans_of(about_.stories->damaged));
    close();
  }

  void end() {
    open("cost", "How it was computed");
    html_ += fmt::format(
        "<p>{} stages, each once for all rows that share "
        "it. Study file: {}. How the statistics are defined: docs/theory/study-statistics.md."
        "</p>",
        plan_.nodes.size(), xml_text(plan_.file.filename().string()));
    if (!about_.sessions.empty()) cost();
    close();
    html_ += fmt::format(
        "</main><script type='application/json' id='study'>{}</script>{}<script>{}</script>\n{}"
        "</body></html>\n",
        in_script(explorer_json(plan_, table_, f_, about_, explorer_start())),
        about_.stories ? "<script type='application/json' id='stories'>" +
                             in_script(about_.stories->json) + "</script>" + curves_text()
                       : "",
        kStudyScript, about_.embedded ? about_.embedded->elements : "");
  }

  /// What scripts/strands.js reads.
  [[nodiscard]] std::string curves_text() const {
    if (!has_curves()) return "";
    return "<script type='application/json' id='curves'>" + in_script(about_.stories->curves) +
           "</script><script type='text/plain' id='curve-arrays'>" + about_.stories->curve_arrays +
           "</script>";
  }

  void cost() {
    html_ +=
        "<div class='wide'><table><tr><th class='word'>computed from</th><th class='word'>by</th>"
        "<th class='word'>on</th><th>processors used</th><th>stages</th><th>time [min]</th>"
        "<th>processor time [min]</th></tr>";
    for (const SessionRecord& s : about_.sessions)
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
  const StudyAbout& about_;
  Page page_;
  std::string html_;
};

}  // namespace

Page make_page(const Plan& plan, const Table& table, const StudyFindings& findings,
               const StudyAbout& about) {
  return Writer(plan, table, findings, about).write();
}

}  // namespace flowslide::study

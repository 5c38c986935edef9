#include "report/page.hpp"

#include "core/hash.hpp"
#include "core/xml_text.hpp"
#include "page_bundle.hpp"
#include "report/audit_table.hpp"
#include "report/markdown.hpp"
#include "report/markdown_html.hpp"
#include "report/page_data.hpp"
#include "report/told_run.hpp"

#include <algorithm>
#include <charconv>

namespace flowslide {
namespace {

std::string anchor(std::string_view title) {
  std::string out;
  for (const char c : title)
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  return out;
}

std::string section(std::string_view title, const std::string& html, std::string_view kind = "") {
  return fmt::format("<section id=\"{0}\"{2}><h2>{1}</h2>\n{3}</section>\n", anchor(title),
                     xml_text(title), kind.empty() ? "" : fmt::format(" class=\"{}\"", kind), html);
}

std::string head(const ReportConfig& config) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {}; "
      "style-src {}; img-src data: blob:; base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n",
      policy_hash(kPageScript), policy_hash(kPageStyle), xml_text(config.title), kPageStyle);
}

struct Card {
  std::string name, value, unit, note;
};

std::string number(double value, int decimals) {
  return is_set(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string cards(const ReportInputs& in, const ReportFacts& f) {
  std::vector<Card> list;
  if (is_set(f.toe))
    list.push_back({"runout", number(f.runout, 1), "m",
                    f.runout > 0.0
                        ? fmt::format("{:.1f} m by mass", f.runout_mass)
                        : fmt::format("front {:.1f} m short of the toe", f.toe - f.front)});
  for (const auto& [window, depth] : f.liquefaction_depth)
    list.push_back({"liquefied, " + window_label(window), number(depth, 1), "m",
                    in.zone.is_assumed() ? "assumed, not shaken" : "largest depth"});
  list.push_back({"failed volume", number(f.failed_volume, 0), "m³/m",
                  fmt::format("{:.0f} % of what counts", f.failed_percent)});
  list.push_back({"fastest point", number(f.peak_speed, 1), "m/s", ""});
  const bool rests = is_set(f.front_at_rest);
  list.push_back({"front at rest", rests ? number(f.front_at_rest, 0) : "never", rests ? "s" : "",
                  fmt::format("of {:.0f} s computed", f.duration)});
  if (const ToldStage* flow = find_stage(in.stages, "mpm.run"))
    list.push_back({"cell size", find_setting(flow->settings, "cell"), "",
                    fmt::format("{} points", in.flow.initial().size())});
  std::string out = "<div class=\"cards\">";
  for (const Card& c : list)
    out += fmt::format(
        "<div class=\"card\"><span class=\"name\">{}</span><span class=\"value\">{}<small> "
        "{}</small>"
        "</span><span class=\"note\">{}</span></div>",
        xml_text(c.name), xml_text(c.value), xml_text(c.unit), xml_text(c.note));
  return out + "</div>\n";
}

std::string warnings_html(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return "<p class=\"quiet\">No stage of this run warned of anything.</p>\n";
  std::string text;
  for (const std::string& warning : warnings) text += "- " + cell(warning) + "\n";
  return section("Read this before using the numbers", markdown_html(text), "warnings");
}

std::string meta_line(const ReportInputs& in) {
  std::string out = xml_text(in.date);
  for (const auto& [name, value] : in.provenance)
    if (name == "program") out += (out.empty() ? "" : " &middot; ") + xml_text(value);
  return "<p class=\"meta\">" + out + "</p>\n";
}

/// Places that the scripts fill; what they say is for readers without scripts.
constexpr std::string_view kPlayer =
    "<section id=\"the-flow\" class=\"wide\"><h2>The flow</h2>\n<div id=\"player\"><p>The player "
    "and "
    "the charts of this page need JavaScript; the figures of the report do "
    "not.</p></div></section>\n"
    "<section id=\"before-the-flow\" class=\"wide\"><h2>Section before the flow</h2>\n"
    "<div id=\"section\"></div></section>\n"
    "<section id=\"histories\" class=\"wide\"><h2>Histories</h2>\n<div "
    "id=\"charts\"></div></section>\n";

std::string navigation(const std::vector<ReportSection>& sections, bool settings) {
  std::string out =
      "<nav><a href=\"#the-flow\">The flow</a><a href=\"#before-the-flow\">Section</a>"
      "<a href=\"#histories\">Histories</a>";
  for (const ReportSection& s : sections)
    out += fmt::format("<a href=\"#{}\">{}</a>", anchor(s.title), xml_text(s.title));
  if (settings) out += "<a href=\"#every-setting\">Every setting</a>";
  return out + "<span id=\"tools\"></span></nav>\n";
}

std::string settings_html(const std::vector<ToldStage>& stages) {
  std::string out;
  for (const ToldStage& stage : stages)
    out += fmt::format("<details><summary>{} <code>{}</code></summary>\n{}</details>\n",
                       xml_text(stage.name), xml_text(stage.uses),
                       markdown_html(told_settings(stage)));
  return section("Every setting", out);
}

}  // namespace

std::string_view page_style() { return kPageStyle; }

std::optional<PageElement> find_element(std::string_view html, std::string_view open,
                                        std::string_view close, std::size_t from) {
  const std::size_t at = html.find(open, from);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t begin = at + open.size(), end = html.find(close, begin);
  if (end == std::string_view::npos) return std::nullopt;
  return PageElement{begin, end};
}

std::string in_script(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

std::string policy_hash(std::string_view text) {
  const std::string hex = sha256(text);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    unsigned value = 0;
    std::from_chars(hex.data() + i, hex.data() + i + 2, value, 16);
    bytes += static_cast<char>(value);
  }
  return "'sha256-" + base64(bytes) + "'";
}

std::string report_page(const ReportInputs& in, const ReportConfig& config,
                        const ReportFacts& facts, const FinalState& end) {
  const PageData data = page_data(in, config, facts, end);
  const std::vector<ReportSection> sections = report_sections(in, config, facts, end);
  std::string out = head(config) + "<body>\n<a class=\"skip\" href=\"#the-flow\">To the flow</a>\n";
  out += "<header><h1>" + xml_text(config.title) + "</h1>\n" + meta_line(in) +
         "<div class=\"lead\">" + markdown_html(report_summary(facts, config)) + "</div>\n" +
         cards(in, facts) + "</header>\n";
  out += navigation(sections, !in.stages.empty());
  out += "<main>\n" + warnings_html(all_warnings(in, facts));
  // The words of the judgement stand before the pictures, the tables after them.
  out += section(sections.front().title, markdown_html(sections.front().text), "judgement");
  out += kPlayer;
  for (std::size_t k = 1; k < sections.size(); ++k)
    out += section(sections[k].title, markdown_html(sections[k].text));
  if (!in.stages.empty()) out += settings_html(in.stages);
  out +=
      "</main>\n<footer>Written by flowslide. This file is complete: it loads nothing.</footer>\n";
  out += std::string(kPageRun) + in_script(data.json) + "</script>\n";
  out += std::string(kPageArrays) + data.arrays.text() + "</script>\n";
  out += "<script>" + std::string(kPageScript) + "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace flowslide

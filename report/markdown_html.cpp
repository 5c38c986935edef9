#include "report/markdown_html.hpp"

#include "core/xml_text.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace flowslide {
namespace {

/// Replaces pairs of a mark by a tag; a mark without its like stays what it is.
std::string paired(const std::string& text, std::string_view mark, std::string_view tag) {
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t open = text.find(mark, at);
    const std::size_t close =
        open == std::string::npos ? open : text.find(mark, open + mark.size());
    if (close == std::string::npos) return out + text.substr(at);
    out += text.substr(at, open - at);
    out += "<" + std::string(tag) + ">";
    out += text.substr(open + mark.size(), close - open - mark.size());
    out += "</" + std::string(tag) + ">";
    at = close + mark.size();
  }
}

std::string inline_html(std::string_view text) {
  return paired(paired(xml_text(text), "`", "code"), "**", "strong");
}

/// Cells of "| a | b\| c |".
std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> out;
  std::string one;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '|') {
      one += line[++i];
    } else if (line[i] == '|') {
      const std::size_t first = one.find_first_not_of(' ');
      const std::size_t last = one.find_last_not_of(' ');
      out.push_back(first == std::string::npos ? "" : one.substr(first, last - first + 1));
      one.clear();
    } else {
      one += line[i];
    }
  }
  return out;
}

bool is_number(std::string_view text) {
  return !text.empty() && text.size() < 24 &&
         std::string_view("0123456789-+.").find(text[0]) != std::string_view::npos &&
         text.find_first_of("0123456789") != std::string_view::npos;
}

std::string row(std::string_view line, std::string_view tag) {
  std::string out = "<tr>";
  bool first = true;
  for (const std::string& text : cells(line)) {
    const bool number = tag == "td" && !first && (is_number(text) || text == "-");
    out += "<" + std::string(tag) + (number ? " class=\"n\">" : ">") + inline_html(text) + "</" +
           std::string(tag) + ">";
    first = false;
  }
  return out + "</tr>\n";
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

}  // namespace

std::string markdown_html(std::string_view markdown) {
  const std::vector<std::string_view> lines = lines_of(markdown);
  std::string out;
  const auto starts = [&](std::size_t i, std::string_view mark) {
    return i < lines.size() && lines[i].starts_with(mark);
  };
  for (std::size_t i = 0; i < lines.size();) {
    if (lines[i].empty() || starts(i, "![")) {
      ++i;
    } else if (starts(i, "#")) {
      const std::size_t level = std::min(lines[i].find_first_not_of('#'), lines[i].size());
      const std::string tag = "h" + std::to_string(std::min<std::size_t>(level + 1, 6));
      out += "<" + tag + ">" + inline_html(lines[i].substr(std::min(level + 1, lines[i].size()))) +
             "</" + tag + ">\n";
      ++i;
    } else if (starts(i, "|") && starts(i + 1, "|--")) {
      out += "<div class=\"scroll\"><table><thead>" + row(lines[i], "th") + "</thead><tbody>\n";
      for (i += 2; starts(i, "|"); ++i) out += row(lines[i], "td");
      out += "</tbody></table></div>\n";
    } else if (starts(i, "- ")) {
      out += "<ul>\n";
      for (; starts(i, "- "); ++i) out += "<li>" + inline_html(lines[i].substr(2)) + "</li>\n";
      out += "</ul>\n";
    } else {
      out += "<p>" + inline_html(lines[i]);
      for (++i; i < lines.size() && !lines[i].empty() && !starts(i, "|") && !starts(i, "- "); ++i)
        out += "\n" + inline_html(lines[i]);
      out += "</p>\n";
    }
  }
  return out;
}

}  // namespace flowslide

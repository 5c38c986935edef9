#pragma once
#include <string>
#include <string_view>

namespace flowslide {

/// Text safe between tags and in quoted attributes of HTML.
std::string html_text(std::string_view text);

/// The Markdown that reports are written in, as HTML: headings (one level lower), tables, lists,
/// paragraphs, **bold**, `code`, "\|" for "|". Pictures are left out. Everything else is text: no
/// tag, attribute or script of the input reaches the page.
std::string markdown_html(std::string_view markdown);

}  // namespace flowslide

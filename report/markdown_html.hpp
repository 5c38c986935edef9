#pragma once
#include <string>
#include <string_view>

namespace flowslide {

/// The Markdown that reports are written in, as HTML: headings (one level lower), tables, lists,
/// paragraphs, **bold**, `code`, "\|" for "|". Pictures are left out. Everything else is text: no
/// tag, attribute or script of the input reaches the page.
std::string markdown_html(std::string_view markdown);

}  // namespace flowslide

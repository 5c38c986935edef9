#include "core/check.hpp"
#include "report/page_read.hpp"
#include "report/page_thin.hpp"
#include "tests/fuzz/targets.hpp"

namespace flowslide::fuzz {

void run_page(Input text) {
  const std::string html(text);
  if (page_states(html) == 0 && thinned_page(html, 2) != html)
    throw std::logic_error("a page without a player was changed");
  try {
    const std::string thin = thinned_page(html, 2);
    if (page_states(thin) > 2 && thin != html)
      throw std::logic_error("a player has more states than were asked for");
    const auto run = read_page(html, [](std::string_view) { return true; });
    if (page_states(html) > 0 && !run) throw std::logic_error("a page with a player was not read");
  } catch (const Error&) {
  }
}

}  // namespace flowslide::fuzz

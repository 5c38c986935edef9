#pragma once
#include "report/report.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace flowslide {

/// report.html: one file that holds text, numbers, scripts and style, and loads nothing else. Text
/// is there without scripts; charts and the player need them. Every text of a workflow is escaped,
/// and the page allows no script but its own, by hash.
/// Throws FileError, InputError, NumericsError.
std::string report_page(const ReportInputs& inputs, const ReportConfig& config,
                        const ReportFacts& facts, const FinalState& end);

/// Its style sheet, for other pages of the same look.
std::string_view page_style();

/// Begins of the elements of the page that hold what its player reads.
inline constexpr std::string_view kPageRun = "<script type=\"application/json\" id=\"run\">",
                                  kPageArrays = "<script type=\"text/plain\" id=\"arrays\">";

/// Where the text of an element begins and ends.
struct PageElement {
  std::size_t begin = 0, end = 0;
  [[nodiscard]] std::size_t size() const { return end - begin; }
};
/// The first element from a place on that `open` begins; none if it has no end.
std::optional<PageElement> find_element(std::string_view html, std::string_view open,
                                        std::string_view close, std::size_t from = 0);

/// JSON that no browser takes for the end of the element it stands in.
std::string in_script(const std::string& json);

/// Source expression of a content security policy that allows a script or a style, by its text.
std::string policy_hash(std::string_view text);

}  // namespace flowslide

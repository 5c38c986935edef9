#include "study/page/embedded.hpp"

#include "core/check.hpp"
#include "core/files.hpp"
#include "report/page.hpp"
#include "report/page_arrays.hpp"
#include "report/page_thin.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include <fmt/format.h>

namespace flowslide::study {
namespace {

constexpr std::uint64_t kLargestRunPage = 256u << 20;
class Embedder {
 public:
  std::string add(std::string html, std::size_t states) {
    runs_.all_states = std::max(runs_.all_states, page_states(html));
    if (states > 0) html = thinned_page(html, states);
    runs_.states = std::max(runs_.states, page_states(html));
    const std::string id = fmt::format("run-{}", ++pages_);
    // what parts are put together at must not stand in them
    std::replace(html.begin(), html.end(), '\0', ' ');
    const auto style = find_element(html, "<style>", "</style>");
    const auto arrays =
        style ? find_element(html, kPageArrays, "</script>", style->end) : std::nullopt;
    const auto script =
        arrays ? find_element(html, "<script>", "</script>", arrays->end) : std::nullopt;
    if (!script) {
      runs_.elements +=
          fmt::format("<script type='text/plain' id='{}'>{}.</script>\n", id, packed(html));
      return id;
    }
    const auto cut = [&](std::size_t begin, std::size_t end) {
      return html.substr(begin, end - begin);
    };
    std::string words = cut(0, style->begin);
    for (const auto& [begin, end] :
         {std::pair{style->end, arrays->begin}, std::pair{arrays->end, script->begin},
          std::pair{script->end, html.size()}})
      words += '\0' + cut(begin, end);
    const std::string style_id = shared(cut(style->begin, style->end), runs_.styles);
    const std::string script_id = shared(cut(script->begin, script->end), runs_.scripts);
    runs_.elements += fmt::format(
        "<script type='text/plain' id='{}' data-style='{}' data-script='{}'>{}.{}</script>\n", id,
        style_id, script_id, packed(words),
        std::string_view(html).substr(arrays->begin, arrays->size()));
    return id;
  }

  EmbeddedRuns take() { return std::move(runs_); }

 private:
  /// The id of a text that many pages have; its digest goes into the policy.
  std::string shared(const std::string& text, std::vector<std::string>& policy) {
    const auto [at, is_new] = shared_.try_emplace(text, fmt::format("part-{}", shared_.size() + 1));
    if (!is_new) return at->second;
    policy.push_back(policy_hash(text));
    runs_.elements +=
        fmt::format("<script type='text/plain' id='{}'>{}</script>\n", at->second, packed(text));
    return at->second;
  }

  EmbeddedRuns runs_;
  std::map<std::string, std::string> shared_;
  std::size_t pages_ = 0;
};

}  // namespace

EmbeddedRuns embed_runs(const std::filesystem::path& folder, std::vector<std::string>& reports,
                        std::size_t states, const std::atomic<bool>* stop) {
  Embedder embedder;
  std::map<std::string, std::string> ids;
  for (std::string& report : reports) {
    if (stop && stop->load()) throw Interrupted("stopped; the same command writes the whole page.");
    if (report.empty()) continue;
    const auto [at, is_new] = ids.try_emplace(report);
    if (is_new) at->second = embedder.add(read_file(folder / report, kLargestRunPage), states);
    report = at->second;
  }
  return embedder.take();
}

}  // namespace flowslide::study

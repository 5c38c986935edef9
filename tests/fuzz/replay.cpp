#include "tests/fuzz/targets.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scratch.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

/// replay TARGET: feeds it what the fuzzer has kept. Any compiler can build it.
int main(int argc, char** argv) {
  using namespace flowslide;
  const std::string_view name = argc == 2 ? argv[1] : "";
  const auto target = std::find_if(fuzz::kTargets.begin(), fuzz::kTargets.end(),
                                   [&](const fuzz::Target& t) { return t.name == name; });
  if (target == fuzz::kTargets.end()) {
    std::fprintf(stderr, "usage: replay TARGET\n");
    return 2;
  }
  const std::string corpus = test::source("tests/fuzz/corpus/").append(name);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(corpus))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    std::printf("%s\n", file.filename().c_str());
    std::fflush(stdout);
    target->run(read_text_file(file));
  }
  std::printf("%zu inputs\n", files.size());
  return files.empty() ? 1 : 0;
}

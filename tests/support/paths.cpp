#include "tests/support/paths.hpp"

namespace flowslide::test {

std::string source(std::string_view name) { return std::string(FLOWSLIDE_SOURCE "/").append(name); }

std::string fixture(std::string_view name) { return source("fixtures/").append(name); }

}  // namespace flowslide::test

#include "config/yaml.hpp"

#include <catch2/catch.hpp>
using namespace flowslide;
TEST_CASE("nearest") { CHECK(nearest("spacng", std::vector<std::string>{"spacing"}) == "spacing"); }

#include "core/odd_characters.hpp"

#include <catch2/catch.hpp>

using namespace flowslide;
using Catch::Contains;

TEST_CASE("Characters that only look right are named", "[core]") {
  CHECK_THAT(odd_characters("1,5"), Contains("decimal comma"));
  CHECK_THAT(odd_characters("-0,25"), Contains("decimal comma"));
  CHECK_THAT(odd_characters("12\xC2\xA0m"), Contains("non-breaking space"));
  CHECK_THAT(odd_characters("1\xA0"
                            "234"),
             Contains("non-breaking space"));  // Latin-1
  CHECK_THAT(odd_characters("\xE2\x88\x92"
                            "5"),
             Contains("long minus"));
  CHECK_THAT(odd_characters("\xEF\xBB\xBF"
                            "5"),
             Contains("byte-order mark"));
  CHECK_THAT(odd_characters("\xEF\xBC\x95"), Contains("full-width"));
}

TEST_CASE("Plain numbers and words are not suspected", "[core]") {
  for (const char* text : {"", "1.5", "-2e-3", "abc", "1,000.5", "a,b",
                           "gr\xC3\xA0"
                           "n",
                           "1,", ",x"})
    CHECK(odd_characters(text).empty());
}

#include "core/xml_text.hpp"

#include <catch2/catch.hpp>

using flowslide::xml_text;

TEST_CASE("Text can end no tag, attribute or entity") {
  CHECK(xml_text("a < b & \"c\" > 'd'") == "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  CHECK(xml_text(std::string_view("\0\x1b\n\xc3\xbc", 5)) == "  \n\xc3\xbc");
}

#include "core/hash.hpp"

#include <catch2/catch.hpp>

TEST_CASE("sha256 gives the published digest of 'abc'", "[core]") {
  // FIPS 180-2, appendix B.1.
  CHECK(flowslide::sha256("abc") ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("a digest does not depend on the pieces", "[core]") {
  flowslide::Sha256 digest;
  digest.add("a", 1);
  digest.add("", 0);
  digest.add("bc", 2);
  CHECK(digest.hex() == flowslide::sha256("abc"));
}

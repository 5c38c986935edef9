#pragma once
#include <string>

/// Two elements beside each other, of the materials 168 and 170, as tables.
namespace flowslide::test {

inline const std::string kTwoNodes = "1 0 0\n2 1 0\n3 2 0\n4 0 1\n5 1 1\n6 2 1\n";
inline const std::string kTwoElements = "10 1 2 5 4 168\n20 2 3 6 5 170\n";

}  // namespace flowslide::test

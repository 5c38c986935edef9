#pragma once
#include <string>
#include <string_view>

/// Files of the checkout that tests read. The paths are compiled into one object only, so that the
/// compiler's cache serves every checkout.
namespace flowslide::test {

/// "fixtures/NAME" as a full path.
std::string fixture(std::string_view name);

/// The same of a name from the root of the checkout.
std::string source(std::string_view name);

}  // namespace flowslide::test

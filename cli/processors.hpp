#pragma once

namespace flowslide::cli {

/// Processors that this process may use.
int processors();

}  // namespace flowslide::cli

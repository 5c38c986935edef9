#pragma once

namespace flowslide::cli {

/// Lets threads that wait for each other spin only briefly before they sleep. On a machine that is
/// shared with other programs, the default of libgomp (about a millisecond of spinning) makes a
/// run on two threads several times slower than on one (docs/adr/0007-openmp-waits.md). libgomp
/// reads its settings before main(), so the program sets them and starts itself again; what the
/// user has set is left alone.
void prefer_short_waits(char** argv);

}  // namespace flowslide::cli

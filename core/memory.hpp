#pragma once
#include <string_view>

/// What this machine has left, so that what cannot fit is refused and not begun: a system that runs
/// out of memory ends programs without a word.
namespace flowslide {

/// Memory that this process may still take [bytes], limits of its container included; infinity
/// where the system does not say.
double available_memory();

/// All the memory that this machine has, or that its container is given [bytes]; infinity where the
/// system does not say.
double machine_memory();

/// Throws InputError if `bytes` are more than nine tenths of what is available; `what` begins the
/// message ("a lattice of 0.01 m: 3e8 points") and `advice` ends it.
void need_memory(double bytes, std::string_view what, std::string_view advice);

}  // namespace flowslide

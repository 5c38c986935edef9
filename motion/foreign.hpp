#pragma once
#include "motion/record_text.hpp"

namespace flowslide {

/// Refuses, by their header, formats of acceleration records that are not read, with their name and
/// what to do: K-NET and KiK-net, COSMOS, CSMIP, SMC, ESM. As columns of numbers they would be read
/// wrongly or refused with a message that does not help. Throws InputError.
void refuse_foreign_format(const RecordText& text);

/// A record whose peak cannot be that of an earthquake, or is too small to matter, as one sentence;
/// empty otherwise.
std::string implausible_peak(const std::string& name, double peak);

}  // namespace flowslide

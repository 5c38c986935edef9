#pragma once
#include "model/ground_motion.hpp"
#include "motion/record_text.hpp"

#include <string>
#include <vector>

namespace flowslide {

/// Refuses, by their header, formats of acceleration records that are not read, with their name and
/// what to do: K-NET and KiK-net, COSMOS, CSMIP, SMC, ESM. As columns of numbers they would be read
/// wrongly or refused with a message that does not help. Throws InputError.
void refuse_foreign_format(const RecordText& text);

/// A peak that cannot be that of an earthquake or is too small to matter, and a time step in which
/// no recorder records (not looked at if unset), as sentences; they start with the name, if it is
/// not empty.
std::vector<std::string> implausible(const std::string& name, double peak, double step);

/// A velocity that no ground has, as a sentence, or nothing: acceleration that does not come back
/// to zero, or peaks of another unit that last.
std::string implausible_velocity(const std::string& name, const GroundMotion& motion);

}  // namespace flowslide

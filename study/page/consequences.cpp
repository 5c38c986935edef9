#include "study/page/consequences.hpp"

#include <array>

namespace flowslide::study {
namespace {

constexpr std::array kConsequences{
    Consequence{"r_u reaches",
                "What is noise there counts as liquefied all the same: it can make the zone, and "
                "with it the runout, too large."},
    Consequence{"dry soil:",
                "Soil above the water flows as if it had liquefied: the runout may be too large."},
    Consequence{"no element has liquefied at the transfer",
                "Nothing was weakened: the runout is what the dam does with the strength of its "
                "soils, and a little more shaking may change it at once."},
    Consequence{"have a residual strength above their initial",
                "Liquefied soil that is stronger than sand can be holds the flow back: the runout "
                "is too small."},
    Consequence{"lie outside strength.table",
                "The runout hangs on the end values of the table: vary them to see by how much."},
    Consequence{"what it would still liquefy is left out",
                "What liquefies later keeps its strength: the runout is a lower bound."},
    Consequence{"the shaking that passes is not that",
                "The mesh holds back the high frequencies of the motion: less may liquefy than "
                "would, and the runout may be too small."},
    Consequence{"the audit was not enforced and would have refused this transfer",
                "The flow begins out of balance: a part of the runout may come from the transfer "
                "and not from the soil."},
    Consequence{"its softening runs on without deformation",
                "The runout hangs on elastic constants and on the cells: compare it with smaller "
                "cells before using it."},
    Consequence{"that of the model, and may be larger", "The runout is a lower bound."},
    Consequence{"No failure was found in the shaking",
                "The runout is what the residual strengths let flow: the shaking by itself moved "
                "the dam no farther than its crest says, and the strengths decide."},
    Consequence{"The run was stopped before rest", "The runout is a lower bound."},
    Consequence{"Do not use the runout before the cause", "The runout says nothing yet."},
    Consequence{"left the model through its outlet",
                "If they left downstream, the runout is a lower bound."},
    Consequence{"A thin or detached tip leads the flow",
                "The runout is that of a few points; nearly all of the mass stays behind it: judge "
                "by the runout without the thin tip."},
    Consequence{"The failure reaches the upstream end of the model",
                "More soil may flow than the model has: the runout may be too small."},
    Consequence{"The runout counts to the right only",
                "What ran out to the left is not in it: a run of the mirrored section has that."},
    Consequence{"This report uses the frame",
                "The runout is uncertain by the difference between the two."},
    Consequence{"No soil that counts has a downstream end", "These rows have no runout."},
};

}  // namespace

std::span<const Consequence> known_consequences() { return kConsequences; }

std::string_view consequence_of(std::string_view warning) {
  for (const Consequence& c : kConsequences)
    if (warning.find(c.words) != std::string_view::npos) return c.meaning;
  return "";
}

}  // namespace flowslide::study

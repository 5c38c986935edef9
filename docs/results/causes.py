"""Why a claim is not reproduced, as far as known; shown only where it is not."""

DAM = "[theory](../theory/mochikoshi.md#which-damping)"
MOTIONS = "[theory](../theory/mochikoshi.md#which-motion)"
WEAK = ("what slides at so little depth slides late, in the coda, by progressive failure, and damping "
        f"decides whether it does ({DAM}).")
LATE = ("pulses of the record that its measures do not tell: of 14 motions that have all of them the dam "
        "begins to slide at 18.7 to 26.6 s at 0.3 g and at 18.1 to 23.1 s at 0.4 g, and hands over at "
        f"21.5 to 28.5 s and at 20.2 to 24.7 s ({MOTIONS}).")
PULSES = ("within what motions with the same measures do: of 14 for Ridgecrest depths under the pond "
          "at one peak spread by 7.5 to 15 m, with a standard deviation of 2 to 4 m "
          f"({MOTIONS}).")
TOTAL = "([theory](../theory/mochikoshi.md#friction-on-effective-or-on-total-stress))"
SCRIPT = ("the published script's friction acts on total stress; with that it is 90 ± 6 m, but soil under water "
          f"does not have that strength {TOTAL}.")
LOWER = ("the published script's friction acts on total stress, which holds the lower dam: with that it stays "
         f"in 110 of 110 rows {TOTAL}.")
LET_GO = ("the dam stands; its liquefied tailings are let go all the same at the end of the motion, with half "
          "their residual strength after large strain, and a few points come past the toe. "
          f"With friction on total stress, as in the published script, none does {TOTAL}.")
STAND_IN = ("single depths hang on the record; PGV and MASI of seven of the ten are not known, and "
            "their stand-ins have the median energy of records "
            "([theory](../theory/ground-motion.md#4-synthetic-motions)).")
KNOWN = ("not by the record's PGV or MASI, which the stand-in has to 3 %; by its pulses, or by the model. "
         "Motions with the measures of one record differ by 7.5 to 15 m of depth at one peak, with a "
         f"standard deviation of 2 to 4 m ({MOTIONS}).")
DEEP = ("the deepest soil that moved a metre is that of the dam's face near its toe, which the flow pushes "
        "along. Under the pond what moved 5 m reaches down to y = 9.4 and 6.9 m at 0.3 and 0.4 g, and "
        f"with friction on total stress, as in the published script, to 15.6 and 8.1 m {TOTAL}.")
STATIC = (f"not known, and not by the stress that friction acts on {TOTAL}. The static model takes all tailings below the water as liquefied, the shakings "
          "compared here 18 m of them and more; momentum and displacement of the shaking are carried "
          "over.")
SOFT = ("at c_soft 1 the embankment alone decides, and nobody has measured what is left of its "
        "strength: with the published script's 20 degrees it runs far, without softening not at all "
        "([theory](../theory/mochikoshi.md#residual-strength-of-the-embankment)).")
SMALL = ("at 0.5 nothing tried gives the paper's runouts together with those at 1; its cells, "
         "damping and elastic constants are not published "
         "([theory](../theory/mochikoshi.md#what-the-runout-depends-on)).")
SURFACES = "see [limit equilibrium](../theory/limit-equilibrium.md)."

CAUSES = {
    **dict.fromkeys(["F9", "F12", "N10", "N11"], WEAK),
    "N3": LET_GO,
    **dict.fromkeys(["F1", "F2", "F6", "F7", "F8", "F11", "F19"], LATE),
    **dict.fromkeys(["N6", "N12", "N15"], SOFT),
    **dict.fromkeys(["N5", "N8", "N9", "N13"], SMALL),
    **dict.fromkeys(["F18", "F20", "F25"], STAND_IN),
    **dict.fromkeys(["F3", "F4", "F5"], PULSES),
    **dict.fromkeys(["F16", "F17"], KNOWN),
    **dict.fromkeys(["N17", "N18"], DEEP),
    "N4": SCRIPT,
    "N16": STATIC,
    "N19": LOWER,
    "F28": SURFACES,
}

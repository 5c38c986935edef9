"""Why a claim is not reproduced, as far as known; shown only where it is not."""

DAM = "[theory](../theory/mochikoshi.md#the-dam-from-section-and-motion-alone)"
WEAK = ("what slides at so little depth slides late, in the coda, by progressive failure, and damping "
        f"decides whether it does ({DAM}).")
LATE = ("with the damping that lets the dam stand at 0.2 g slides begin five seconds later than with "
        f"the soil's own, with which they come within 1 to 4 s of the paper's ({DAM}).")
STAND_IN = ("single depths hang on the record; PGV and MASI of seven of the ten are not known, and "
            "their stand-ins have the median energy of records "
            "([theory](../theory/ground-motion.md#4-synthetic-motions)).")
KNOWN = ("not by the record's PGV or MASI, which the stand-in has to 3 %: by what a record has besides "
         "them, or by the model. With the soil's own damping 5 m more liquefy at 0.4 g, and no more "
         f"at 0.3 g ({DAM}).")
DEEP = ("not known. A late onset explains no depth: here nearly all that has liquefied flows in the end, and "
        "soil above the foundation with it.")
STATIC = ("not known. The static model takes all tailings below the water as liquefied, the shakings "
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
    **dict.fromkeys(["F3", "F9", "F12", "N3", "N10", "N11"], WEAK),
    **dict.fromkeys(["F1", "F2", "F6", "F7", "F8", "F11", "F19", "N5"], LATE),
    **dict.fromkeys(["N6", "N12", "N15"], SOFT),
    **dict.fromkeys(["N4", "N8", "N9", "N13"], SMALL),
    **dict.fromkeys(["F18", "F20", "F25"], STAND_IN),
    **dict.fromkeys(["F4", "F5", "F16", "F17"], KNOWN),
    **dict.fromkeys(["N17", "N18"], DEEP),
    "N16": STATIC,
    "F28": SURFACES,
}

"""Why a claim is not reproduced, as far as known; shown only where it is not."""

DAM = "[theory](../theory/mochikoshi.md#the-dam-from-section-and-motion-alone)"
WEAK = ("the dam slides late, by creep after the strong phase; the case is marginal in our model, "
        f"and size and bending of its elements decide ({DAM}).")
EARLY = ("the slide distorts the mesh before the shaking is over, and the transfer comes with it; "
         f"the motion's phase is not that of the record ({DAM}).")
SOFT = ("at c_soft 1 the embankment alone decides, and nobody has measured what is left of its "
        "strength: with the published script's 20 degrees it runs far, without softening not at all "
        "([theory](../theory/mochikoshi.md#residual-strength-of-the-embankment)).")
SMALL = ("at 0.5 nothing tried gives the paper's runouts together with those at 1; its cells, "
         "damping and elastic constants are not published "
         "([theory](../theory/mochikoshi.md#what-the-runout-depends-on)).")
CRITERION = ("the paper's rule for the time is partly by eye; ours is stated "
             "([theory](../theory/liquefaction-zone.md#5-transfer-time)).")
RECORD = ("single depths hang on the record, whose phase a synthetic motion does not have; rows of "
          "elements are 2.5 m high.")
SURFACES = "see [limit equilibrium](../theory/limit-equilibrium.md)."

CAUSES = {
    **dict.fromkeys(["F3", "F9", "F12", "F16", "F20", "N3", "N10", "N11"], WEAK),
    **dict.fromkeys(["F1", "F2", "F5", "F8", "F19", "N5", "N17", "N18"], EARLY),
    **dict.fromkeys(["N6", "N12", "N15"], SOFT),
    **dict.fromkeys(["N4", "N8", "N9", "N13", "N16"], SMALL),
    **dict.fromkeys(["F6", "F7", "F11"], CRITERION),
    **dict.fromkeys(["F4", "F17", "F18", "F25"], RECORD),
    "F28": SURFACES,
}

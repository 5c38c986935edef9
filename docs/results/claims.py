"""What Sordo, Rathje & Kumar (2025) state of the response (F) and the runout (N) of their dam, and
which rows of our study each claim is judged by. Words are ours; the numbers of the paper stand
here, ours nowhere.
"""
import dataclasses
import math
import statistics

from judging import Judged, every, not_comparable, positive, share, together, value, within
from study_rows import interval, spearman

DEPTH = "liquefaction_depth_pond_m"
BEFORE_SLIDE = "liquefaction_depth_pond_before_slide_m"
DEEPEST_FAILED = "deepest_failed_mass_quantile_y_m"
NONE = 0.5  # a runout below is none [m]
TEN = 10  # motions


@dataclasses.dataclass
class Claim:
    name: str
    words: str
    paper: str
    judge: object


def no_onset(s, motion, pga):
    number = s.number("onset_time_s", motion=motion, pga=pga)
    if number is None:
        return Judged()
    turns = 0 < len(number.values) < number.runs
    if not number.values:
        return Judged(True, "no rise", f"{number.runs} runs" if number.runs > 1 else "1 run")
    return Judged(False, f"rise at {number.mean:.3g} s",
                  f"{len(number.values)} of {number.runs} runs", turns)


def f1(s):
    return together(*[within(s.number("depth_pond_at_17_s_m", motion="ridgecrest", pga=p), 0, 5, 0)
                      for p in (0.2, 0.3, 0.4)])


def f2(s):
    return together(*[within(s.number("deepest_at_s", motion="ridgecrest", pga=p), 17, 20, 0.5, "s")
                      for p in (0.2, 0.3, 0.4)])


def f12(s):
    rows = s.select("ridgecrest", 0.2)
    return share(s.distinct(rows, DEPTH), lambda r: r["transfer_time_s"] >= r["fem_end_s"] - 1e-6,
                 1.0, "shakings") if rows else Judged()


def f19(s):
    return together(*[value(BEFORE_SLIDE, 16, 99, 1, motion=m, pga=0.3)(s)
                      for m in ("hector-mine", "landers")])


def f20(s):
    rows = s.shakings(pga=0.2)
    if len(rows) < TEN:
        return Judged()
    depths = [r["depth"] for r in rows]
    low, high = min(depths), max(depths)
    return Judged(2 <= low and high <= 15, f"{low:.3g} to {high:.3g} m",
                  f"± {s.scatter(DEPTH):.2g} m each")


def f21(s):
    rows = s.shakings(pga=0.3) + s.shakings(pga=0.4)
    if len(rows) < 2 * TEN:
        return Judged()
    return share(rows, lambda r: r["depth"] > 15, 0.5, "shakings")


def f22(s):
    """Long periods less short ones, mean depth at each peak."""
    if len(s.shakings()) < 3 * TEN:
        return Judged()

    def gap(rows):
        long = [r["depth"] for r in rows if r["motion_tm_s"] > 0.5]
        short = [r["depth"] for r in rows if r["motion_tm_s"] < 0.4]
        return statistics.mean(long) - statistics.mean(short)

    return together(*[positive(s.shakings(pga=p), gap, f"{p} g:") for p in (0.2, 0.3, 0.4)])


def by_measures(pgv, masi, holds):
    def judge(s):
        rows = s.shakings()
        if len(rows) < 3 * TEN:
            return Judged()
        inside = [r for r in rows if pgv[0] <= 100 * r["motion_pgv_m_s"] <= pgv[1]
                  and masi[0] <= r["motion_masi_m_s"] <= masi[1]]
        return share(inside, lambda r: holds(r["depth"]), of="shakings")
    return judge


def f26(s):
    rows = s.shakings()
    if len(rows) < 3 * TEN:
        return Judged()

    def better(name):
        def gain(some):
            depth = [r["depth"] for r in some]
            return (spearman([r[name] for r in some], depth)
                    - spearman([r["pga [g]"] for r in some], depth))
        return gain

    return together(positive(rows, better("motion_pgv_m_s"), "rank correlation, PGV less PGA"),
                    positive(rows, better("motion_masi_m_s"), "MASI less PGA"))


def f28(s):
    if not {12.0, 18.5} <= s.section.keys():
        return Judged()
    a, b = s.section[12.0], s.section[18.5]
    return Judged(abs(a - 1.0) <= 0.05 + 0.05 and abs(b - 0.5) <= 0.05 + 0.05,
                  f"{a:.2f} at 12 m, {b:.2f} at 18.5 m", "search of surfaces ± 0.05")


def n6(s):
    return within(s.number("runout_m", motion="ridgecrest", pga=0.3, c_soft=1.0), 0, 0, NONE)


def n7(s):
    parts = []
    for c in (0.25, 0.5, 0.75):
        n = [s.number("runout_m", motion=m, pga=0.3, c_soft=c)
             for m in ("ridgecrest", "hector-mine", "landers")]
        if None in n:
            return Judged()
        least = min(n[1].mean, n[2].mean)
        error = math.hypot(n[0].error, max(n[1].error, n[2].error))
        parts.append(Judged(NONE < n[0].mean < least, f"{c:g}: {n[0].mean:.3g} of {least:.3g} m",
                            f"± {n[0].scatter:.2g} m", abs(least - n[0].mean) < error))
    return together(*parts)


def n9(s):
    parts = [value("runout_m", 220, 220, 10, motion="landers", pga=0.3, c_soft=0.5)(s)]
    for c in (0.25, 0.5, 0.75, 1.0):
        n = [s.number("runout_m", motion=m, pga=0.3, c_soft=c) for m in ("landers", "hector-mine")]
        if None in n:
            return Judged()
        gap, error = n[0].mean - n[1].mean, math.hypot(n[0].error, n[1].error)
        parts.append(Judged(abs(gap) <= 10, f"less Hector Mine at {c:g}: {gap:+.2g} m", "",
                            10 - error < abs(gap) < 10 + error))
    return together(*parts)


def n10(s):
    rows = s.flows(motion="loma-prieta", pga=0.3)
    return share(rows, lambda r: r["runout"] <= NONE, 1.0) if len(rows) == 4 else Judged()


def deep(s, low, *strengths):
    """Flows of dams that have liquefied deeper than `low`."""
    return [r for c in strengths for r in s.flows(c_soft=c) if r["depth"] > low]


def whole(s):
    return len(s.shakings()) == 3 * TEN


def n11(s):
    rows = [r for r in s.flows() if r["depth"] < 10]
    return share(rows, lambda r: r["runout"] <= NONE, 1.0) if whole(s) else Judged()


def mean_runout(low, high, *strengths):
    def judge(s):
        rows = deep(s, 18, *strengths)
        if not whole(s):
            return Judged()
        if not rows:
            return Judged(comparable=False, remark="no dam has liquefied so deep")
        mean, below, above = interval([r["runout"] for r in rows], statistics.mean)
        holds = low <= mean <= high
        return Judged(holds, f"mean {mean:.3g} m of {len(rows)} rows",
                      f"{below:.3g} to {above:.3g} m",
                      (not low <= below <= high or not low <= above <= high) if holds
                      else above >= low and below <= high)
    return judge


def n14(s):
    if not whole(s):
        return Judged()
    parts = []
    for c in (0.25, 0.5, 0.75, 1.0):
        rows = [r for r in s.flows(c_soft=c) if 10 <= r["depth"] <= 18]
        if len(rows) < 4:
            return Judged(comparable=False, remark="fewer than 4 shakings lie between 10 and 18 m")
        correlation = lambda some: spearman([r["depth"] for r in some], [r["runout"] for r in some])
        parts.append(positive(rows, correlation, f"{c:g}:"))
    return together(*parts)


def n16(s):
    if not whole(s):
        return Judged()
    parts = []
    for c in (0.25, 0.5, 0.75):
        static = s.number("runout_m", variant="static", c_soft=c)
        dynamic = [r["runout"] for r in deep(s, 18, c)]
        if static is None or not dynamic:
            return Judged()
        ratio, low, high = interval(dynamic, lambda d: static.mean / statistics.mean(d))
        reaches = low <= 0.875 and high >= 0.775
        holds = 0.775 <= ratio <= 0.875
        parts.append(Judged(holds, f"{c:g}: {ratio:.2f}", f"{low:.2f} to {high:.2f}",
                            (low < 0.775 or high > 0.875) if holds else reaches))
    return together(*parts)


def n19(s):
    rows = [r for r in s.select() if isinstance(r["runout_m"], float) and r["runout_m"] > NONE
            and isinstance(r["regions.upper dam.failed_share"], float)]
    fails = lambda r: (r["regions.upper dam.failed_share"] > 0.5
                       and r["regions.lower dam.failed_share"] < 0.5)
    return share(rows, fails) if whole(s) else Judged()


def n20(s):
    base = len({(r["motion"], r["pga [g]"], r["c_soft"]) for r in s.select()})
    static = len({r["c_soft"] for r in s.select(variant="static")})
    return Judged((base, static) == (120, 4), f"{base} and {static}") if base == 120 else Judged()


RIDGECREST = {"motion": "ridgecrest"}
RESPONSE = [
    Claim("F1", "Ridgecrest, before 17 s: only shallow soil has liquefied", "shallow (here: 5 m)",
          f1),
    Claim("F2", "Ridgecrest: the depth grows from 17 s on and is there by 20 s", "17 to 20 s",
          f2),
    Claim("F3", "Ridgecrest 0.2 g: largest depth", "5 to 8 m",
          value(DEPTH, 5, 8, 1, pga=0.2, **RIDGECREST)),
    Claim("F4", "Ridgecrest 0.3 g: largest depth", "16 to 18 m",
          value(DEPTH, 16, 18, 1, pga=0.3, **RIDGECREST)),
    Claim("F5", "Ridgecrest 0.4 g: largest depth", "23 to 28 m",
          value(DEPTH, 23, 28, 1, pga=0.4, **RIDGECREST)),
    Claim("F6", "Ridgecrest 0.3 g: kinetic energy rises", "19.5 s",
          value("onset_time_s", 19.5, 20, 0.5, "s", pga=0.3, **RIDGECREST)),
    Claim("F7", "Ridgecrest 0.4 g: kinetic energy rises", "17.5 s",
          value("onset_time_s", 17.5, 17.5, 0.5, "s", pga=0.4, **RIDGECREST)),
    Claim("F8", "Ridgecrest: depth when it rises", "16 to 18 m",
          every(*[value(BEFORE_SLIDE, 16, 18, 1, pga=p, **RIDGECREST) for p in (0.3, 0.4)])),
    Claim("F9", "Ridgecrest 0.2 g: it does not rise", "no rise",
          lambda s: no_onset(s, "ridgecrest", 0.2)),
    Claim("F10", "Ridgecrest 0.3 g: it levels off", "levels off",
          not_comparable("our shaking ends once the transfer is known")),
    Claim("F11", "Ridgecrest: transfer at 0.3 and 0.4 g", "23 and 20.5 s",
          every(*[value("transfer_time_s", t, t, 0.5, "s", pga=p, **RIDGECREST)
                  for p, t in ((0.3, 23), (0.4, 20.5))])),
    Claim("F12", "Ridgecrest 0.2 g: transfer when the record ends", "end", f12),
    Claim("F13", "Ridgecrest 0.3 g: shear surface under the pond", "7 m",
          not_comparable("the study keeps no surface; see N17")),
    Claim("F14", "Ridgecrest 0.4 g: the same", "11 m",
          not_comparable("the study keeps no surface; see N18")),
    Claim("F15", "Ridgecrest: the first surface lies under the dam", "x > -30 m",
          not_comparable("the study keeps no surface")),
    Claim("F16", "Loma Prieta 0.3 g: depth, and no rise of energy", "5 m, no rise",
          every(value(DEPTH, 5, 5, 1, motion="loma-prieta", pga=0.3),
                lambda s: no_onset(s, "loma-prieta", 0.3))),
    Claim("F17", "Hector Mine 0.3 g: depth", "26 m",
          value(DEPTH, 26, 26, 1, motion="hector-mine", pga=0.3)),
    Claim("F18", "Landers 0.3 g: depth (the paper has both)", "22 and 24 m",
          value(DEPTH, 22, 24, 1, motion="landers", pga=0.3)),
    Claim("F19", "Hector Mine, Landers: energy rises at depths above", "16 to 18 m", f19),
    Claim("F20", "All motions at 0.2 g: depth under the pond", "3 to 14 m", f20),
    Claim("F21", "All motions at 0.3 and 0.4 g: most deeper than", "15 m", f21),
    Claim("F22", "Depth of mean periods above 0.5 s less that below 0.4 s, m", "above 0", f22),
    Claim("F23", "PGV below 20 cm/s and MASI below 4 m/s: generally less than", "10 m",
          by_measures((0, 20), (0, 4), lambda d: d < 10)),
    Claim("F24", "PGV above 40 cm/s and MASI above 8 m/s: generally more than", "20 m",
          by_measures((40, math.inf), (8, math.inf), lambda d: d > 20)),
    Claim("F25", "PGV about 30 cm/s (± 5), MASI about 6 m/s (± 1)", "5 to 20 m",
          by_measures((25, 35), (5, 7), lambda d: 4 <= d <= 21)),
    Claim("F26", "PGV and MASI predict the depth better than PGA", "clearly", f26),
    Claim("F27", "San Fernando, earlier work: two surfaces at 17 s", "two",
          not_comparable("the peak of that run is not given")),
    Claim("F28", "Factor of safety, liquefied to 12 m and to 18.5 m", "1.0 and 0.5", f28),
]
RUNOUT = [
    Claim("N1", "San Fernando, earlier work, c_soft 1", "35 m",
          not_comparable("the peak of that run is not given")),
    Claim("N2", "San Fernando, earlier work, 0.5", "215 m",
          not_comparable("the peak of that run is not given")),
    Claim("N3", "Ridgecrest 0.2 g, 0.5", "0",
          value("runout_m", 0, 0, NONE, pga=0.2, c_soft=0.5, **RIDGECREST)),
    Claim("N4", "Ridgecrest 0.3 g, 0.5", "90 m",
          value("runout_m", 90, 90, 10, pga=0.3, c_soft=0.5, **RIDGECREST)),
    Claim("N5", "Ridgecrest 0.4 g, 0.5", "220 m",
          value("runout_m", 220, 220, 10, pga=0.4, c_soft=0.5, **RIDGECREST)),
    Claim("N6", "Ridgecrest 0.3 g, 1: stops on the face of the dam", "0", n6),
    Claim("N7", "Ridgecrest 0.3 g, up to 0.75: some, and less than Hector Mine and Landers", "less",
          n7),
    Claim("N8", "Hector Mine 0.3 g, 0.5", "220 m",
          value("runout_m", 220, 220, 10, motion="hector-mine", pga=0.3, c_soft=0.5)),
    Claim("N9", "Landers 0.3 g, 0.5, and as Hector Mine at every c_soft", "220 m, ± 10", n9),
    Claim("N10", "Loma Prieta 0.3 g, any c_soft", "0", n10),
    Claim("N11", "Liquefied to less than 10 m, any c_soft: no runout", "0", n11),
    Claim("N12", "Deeper than 18 m, 1 and 0.75", "50 to 75 m", mean_runout(40, 85, 1.0, 0.75)),
    Claim("N13", "Deeper than 18 m, 0.5 and 0.25", "hundreds (here: 180 m)",
          mean_runout(180, math.inf, 0.5, 0.25)),
    Claim("N14", "From 10 to 18 m the runout grows with the depth: rank correlation", "grows",
          n14),
    Claim("N15", "Static model, 1", "40 m",
          value("runout_m", 40, 40, 5, variant="static", c_soft=1.0)),
    Claim("N16", "Static over the mean of dynamic runs deeper than 18 m", "0.80 to 0.85", n16),
    Claim("N17", "Ridgecrest 0.3 g, 0.5: deepest soil that moved, y", "20 m",
          value(DEEPEST_FAILED, 20, 20, 1, pga=0.3, c_soft=0.5, **RIDGECREST)),
    Claim("N18", "Ridgecrest 0.4 g, 0.5: the same", "13 m",
          value(DEEPEST_FAILED, 13, 13, 1, pga=0.4, c_soft=0.5, **RIDGECREST)),
    Claim("N19", "Dams that run out: the upper dam fails, the lower stays", "all", n19),
    Claim("N20", "Rows: dynamic and static", "120 and 4", n20),
]

"""The tendencies of the study with their intervals, from its analysis.json."""
import json

DEPTH, RUNOUT = "liquefaction_depth_pond_m", "runout_m"
CAUSES = (("pga", "PGA"), ("motion_tm_s", "mean period"), ("motion_pgv_m_s", "PGV"),
          ("motion_masi_m_s", "MASI"))
HEAD = """## Tendencies

Numbers of `analysis.json`, in brackets their 95 % intervals from resampling the shakings ([how](../theory/study-statistics.md)).

| tendency | here | holds |
|---|---|---|"""

WHY = ("What does not hold: dams that have liquefied to little depth slide in the coda, which damping "
       "and the pulses of the motion decide ([theory](../theory/mochikoshi.md#which-damping)); and all shakings "
       "stand against the static model here, where the paper compares those deeper than 18 m (N16).")


def keep(analysis):
    """What the table needs of a study's analysis."""
    return {
        "relations": [r for r in analysis["relations"]
                      if (r["x"], r["y"]) == (DEPTH, RUNOUT)
                      or r["y"] == DEPTH and r["x"] in dict(CAUSES)],
        "tornado": [s for s in analysis["tornado"] if (s["input"], s["result"]) == ("c_soft", RUNOUT)],
        "thresholds": [t for t in analysis["thresholds"] if (t["x"], t["y"]) == (DEPTH, RUNOUT)],
        "comparisons": [c for c in analysis["comparisons"] if c["result"] == RUNOUT and c["where"]],
    }


def text(estimate, digits=3):
    if estimate["value"] is None:
        return "-"
    number = lambda v: f"{v:.{digits}g}"
    if estimate["low"] is None:
        return number(estimate["value"])
    return f"{number(estimate['value'])} ({number(estimate['low'])} to {number(estimate['high'])})"


def above(ratio):
    """Is it more than 1?"""
    if ratio["low"] is None:
        return "not told"
    return "yes" if ratio["low"] > 1 else "no" if ratio["high"] < 1 else "not told apart from 1"


def negative(estimate):
    minus = lambda v: None if v is None else -v
    return {"value": minus(estimate["value"]), "low": minus(estimate["high"]),
            "high": minus(estimate["low"])}


def sign(estimate, wanted=1):
    if estimate["low"] is None:
        return "not told"
    low, high = sorted((wanted * estimate["low"], wanted * estimate["high"]))
    return "yes" if low > 0 else "no" if high < 0 else "not told apart from none"


def rows(kept):
    for name, words in CAUSES:
        for r in kept["relations"]:
            if r["x"] == name:
                yield (f"depth grows with {words}: rank correlation of the shakings",
                       text(r["spearman"]), sign(r["spearman"]))
    for r in kept["relations"]:
        if r["y"] == RUNOUT:
            yield ("runout grows with the depth: rank correlation at one c_soft",
                   text(r["spearman_within"]), sign(r["spearman_within"]))
    for s in kept["tornado"]:
        yield (f"runout grows as c_soft falls: mean {s['from']} less that {s['to']}, m",
               text(negative(s["swing"])), sign(s["swing"], -1))
    for t in kept["thresholds"]:
        seen = t["breach_seen"]
        yield (f"no runout below a depth near 10 m, {t['where']}: depth where it begins, m",
               text(t["breach"]) if seen else "not shown by the rows",
               "yes" if seen and t["breach"]["low"] <= 10 <= t["breach"]["high"] else "no")
    for t in kept["thresholds"]:
        seen = t["saturation_seen"]
        yield (f"no growth beyond a depth near 18 m, {t['where']}: depth and runout there, m",
               f"{text(t['saturation'])}, {text(t['plateau'])}" if seen else "not shown by the rows",
               "yes" if seen and t["saturation"]["low"] <= 18 <= t["saturation"]["high"] else "no")
    for c in kept["comparisons"]:
        yield (f"dynamic above static, {c['where']}: mean runout of all shakings over static",
               text(c["ratio"]),
               above(c["ratio"]))


def section(path):
    if not path.is_file():
        return ""
    kept = json.loads(path.read_text(encoding="utf-8"))
    lines = [f"| {what} | {here} | {holds} |" for what, here, holds in rows(kept)]
    return "\n".join([HEAD, *lines, "", WHY]) + "\n"

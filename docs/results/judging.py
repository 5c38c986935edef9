"""How a claim is judged: a number against a range, the share of rows that do it, the sign of a
statistic. The rules are told to the reader in docs/results/mochikoshi.md.

A number is reproduced if our mean lies in the paper's range, widened by what can be read from its
text (`slack`). A verdict that the scatter of our repeats could turn is marked.
"""
import dataclasses
import math
import statistics

from study_rows import interval

MOST = 2 / 3  # "generally", "most"


@dataclasses.dataclass
class Judged:
    holds: bool | None = None  # None: not run
    here: str = ""
    scatter: str = ""
    turns: bool = False  # within its scatter it could be the other way
    comparable: bool = True
    remark: str = ""


def within(number, low, high, slack, unit="m"):
    """Is the mean of the repeats in the paper's range?"""
    if number is None:
        return Judged()
    if not number.values:
        return Judged(False, "none")
    low, high = low - slack, high + slack
    holds = low <= number.mean <= high
    reach = [number.mean - number.error, number.mean + number.error]
    others = any(not low <= r <= high for r in reach) if holds else (reach[1] >= low
                                                                     and reach[0] <= high)
    runs = f"{len(number.values)} of {number.runs} runs" if len(number.values) < number.runs \
        else f"{number.runs} run{'s' if number.runs > 1 else ''}"
    scatter = f"± {number.scatter:.2g} {unit}, {runs}" if number.scatter else runs
    turns = (others and number.scatter > 0) or len(number.values) < number.runs
    return Judged(holds, f"{number.mean:.3g} {unit}", scatter, turns)


def value(column, low, high, slack, unit="m", **where):
    return lambda s: within(s.number(column, **where), low, high, slack, unit)


def together(*parts):
    """All parts have to hold."""
    if any(p.holds is None for p in parts):
        return Judged()
    # A part that fails for sure decides, whatever the others might be.
    turns = any(p.turns for p in parts if p.holds is False or all(q.holds for q in parts))
    if any(p.holds is False and not p.turns for p in parts):
        turns = False
    return Judged(all(p.holds for p in parts), "; ".join(p.here for p in parts),
                  "; ".join(dict.fromkeys(p.scatter for p in parts if p.scatter)), turns)


def every(*judges):
    return lambda s: together(*[judge(s) for judge in judges])


def not_comparable(why):
    return lambda s: Judged(comparable=False, remark=why)


def share(rows, holds, least=MOST, of="rows"):
    """Do most of the rows do it?"""
    if not rows:
        return Judged(comparable=False, remark="no row lies there")
    found = [1.0 if holds(r) else 0.0 for r in rows]
    mean, low, high = interval(found, statistics.mean)
    scatter = "" if math.isnan(low) else f"{100 * low:.0f} to {100 * high:.0f} %"
    return Judged(mean >= least, f"{sum(found):.0f} of {len(found)} {of}", scatter,
                  not math.isnan(low) and (low < least) != (high < least))


def positive(items, statistic, name):
    """Is a statistic of the rows above zero?"""
    mean, low, high = interval(items, statistic)
    if math.isnan(mean):
        return Judged(False, f"{name} cannot be told")
    return Judged(mean > 0, f"{name} {mean:+.2f}", f"{low:+.2f} to {high:+.2f}",
                  math.isnan(low) or (low <= 0 < high))

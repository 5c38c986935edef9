"""Rows of a study, and what they say together: means over repeats, scatter, intervals.

What a stage has found once counts once: four strengths on one shaking give one depth.
"""
import csv
import itertools
import json
import math
import pathlib
import random
import statistics

SEED, RESAMPLES = 1, 1000
COLUMNS = [
    "row", "variant", "motion", "pga [g]", "c_soft", "repeat", "state", "outcome", "runout_m",
    "liquefaction_depth_pond_m", "liquefaction_depth_pond_interpolated_m",
    "liquefaction_depth_pond_before_slide_m", "liquefaction_depth_crest_m", "onset_time_s",
    "transfer_time_s", "fem_end_s", "fem_stopped_at_transfer", "motion_pgv_m_s",
    "motion_masi_m_s", "motion_tm_s", "deepest_failed_mass_quantile_y_m",
    "regions.lower dam.failed_share", "regions.upper dam.failed_share", "key:shake", "key:flow",
]
CURVE_COLUMNS = ["depth_pond_at_17_s_m", "deepest_at_s"]
CELL = "flow_cell"  # a setting, as the workflow has it
FLOW = ("runout", "deepest_failed", "regions.", "outcome")  # what the flow finds, not the shaking


def gather(study):
    """Table of a study's folder cut to the columns above, and what its curves of depth say."""
    with open(study / "table.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    kept = []
    for row in rows:
        out = {name: row.get(name, "") for name in COLUMNS}
        curve = study / "stages/report" / row.get("key:report", "") / "report/zone.csv"
        out |= curve_facts(curve) if curve.is_file() else dict.fromkeys(CURVE_COLUMNS, "")
        out[CELL] = cell_of(study / "stages/flow" / (row.get("key:flow", "") + ".json"))
        kept.append(out)
    return kept


def cell_of(record):
    """Cell size of a flow, from what is kept of its settings."""
    if not record.is_file():
        return ""
    settings = json.loads(record.read_text(encoding="utf-8"))["record"]["settings"]
    return next((s.split("= ", 1)[1] for s in settings if s.startswith("cell = ")), "")


def curve_facts(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows or "depth_max_pond_m" not in rows[0]:
        return dict.fromkeys(CURVE_COLUMNS, "")
    curve = [(float(r["time_s"]), float(r["depth_max_pond_m"])) for r in rows]
    early = [depth for time, depth in curve if time <= 17.0 + 1e-9]
    deepest = next(time for time, depth in curve if depth >= curve[-1][1])
    return {"depth_pond_at_17_s_m": early[-1] if early else 0.0, "deepest_at_s": deepest}


def cost(study):
    """Machines, programs and times of the sessions that computed a study."""
    paths = sorted((study / "sessions").glob("*.json"))
    sessions = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    distinct = lambda key: sorted({str(s[key]) for s in sessions})
    return {
        "began": min((s["began"] for s in sessions), default=""),
        "sessions": len(sessions),
        "programs": distinct("program"),
        "machines": distinct("processor"),
        "threads": distinct("threads"),
        "wall_seconds": sum(s["wall_seconds"] for s in sessions),
        "processor_seconds": sum(s["processor_seconds"] for s in sessions),
    }


class Number:
    """Mean of the repeats of a row, or of one run, with the scatter of a single run."""

    def __init__(self, values, runs, scatter):
        self.values, self.runs, self.scatter = values, runs, scatter
        self.mean = statistics.mean(values) if values else math.nan

    @property
    def error(self):
        """Of the mean: two standard errors; 0 where no row was repeated."""
        return 2.0 * self.scatter / math.sqrt(len(self.values)) if self.values else 0.0


class Study:
    def __init__(self, rows):
        self.all = rows
        self.rows = [r for r in rows if r["state"] == "done"]
        for row in self.rows:
            for name, text in row.items():
                try:
                    row[name] = round(float(text), 9)  # rows of nodes lie at 10 m, not beside it
                except ValueError:
                    pass

    def select(self, motion=None, pga=None, c_soft=None, variant="base"):
        same = lambda a, b: b is None or (isinstance(a, float) and abs(a - b) < 1e-9)
        return [
            r for r in self.rows
            if r["variant"] == variant and motion in (None, r["motion"])
            and same(r["pga [g]"], pga) and same(r["c_soft"], c_soft)
        ]

    @staticmethod
    def distinct(rows, column):
        """Rows that have found the number by a computation of their own."""
        key = "key:flow" if column.startswith(FLOW) else "key:shake"
        return list({r[key] or r["row"]: r for r in reversed(rows)}.values())[::-1]

    def number(self, column, **where):
        rows = self.distinct(self.select(**where), column)
        values = [r[column] for r in rows if isinstance(r[column], float)]
        if not rows:
            return None
        own = statistics.stdev(values) if len(values) > 2 else math.nan
        return Number(values, len(rows), own if own == own else self.scatter(column))

    def groups(self, column, **where):
        """Mean of the repeats of each row that has the number: (row, mean)."""
        names = ["variant", "motion", "pga [g]"] + (["c_soft"] if column.startswith(FLOW) else [])
        key = lambda r: tuple(str(r[n]) for n in names)
        found = [r for r in self.select(**where) if isinstance(r[column], float)]
        for _, rows in itertools.groupby(sorted(found, key=key), key):
            rows = self.distinct(list(rows), column)
            yield rows[0], [r[column] for r in rows]

    def scatter(self, column):
        """Pooled deviation of repeats, over all rows that were repeated."""
        squares, freedom = 0.0, 0
        for variant in sorted({r["variant"] for r in self.rows}):
            for _, values in self.groups(column, variant=variant):
                if len(values) > 1:
                    squares += (len(values) - 1) * statistics.variance(values)
                    freedom += len(values) - 1
        return math.sqrt(squares / freedom) if freedom else 0.0

    def shakings(self, **where):
        """One row per motion and peak, with its mean depth as `depth`."""
        column = "liquefaction_depth_pond_m"
        return [row | {"depth": statistics.mean(v)} for row, v in self.groups(column, **where)]

    def flows(self, **where):
        """One row per motion, peak and strength, with mean runout and depth."""
        found = []
        for row, values in self.groups("runout_m", **where):
            depth = self.number("liquefaction_depth_pond_m", motion=row["motion"] or None,
                                pga=row["pga [g]"] if row["motion"] else None,
                                variant=row["variant"])
            found.append(row | {"runout": statistics.mean(values), "depth": depth.mean,
                                "runs": len(values)})
        return found


def ranks(values):
    order = sorted(values)
    return [order.index(v) + (order.count(v) + 1) / 2 for v in values]


def spearman(x, y):
    a, b = ranks(x), ranks(y)
    try:
        return statistics.correlation(a, b)
    except statistics.StatisticsError:
        return math.nan


def interval(items, statistic):
    """Statistic of the items, with its 95 % interval from resampling them."""
    dice, found = random.Random(SEED), []
    for _ in range(RESAMPLES):
        try:
            value = statistic(dice.choices(items, k=len(items)))
        except (statistics.StatisticsError, ZeroDivisionError):
            continue
        if value == value:
            found.append(value)
    found.sort()
    if len(found) < RESAMPLES // 2:
        return statistic(items), math.nan, math.nan
    return statistic(items), found[int(0.025 * len(found))], found[int(0.975 * len(found)) - 1]


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write_rows(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, [*COLUMNS, *CURVE_COLUMNS, CELL], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_section(path):
    """Factors of safety of `flowslide verify section --json`, by depth of liquefaction [m]."""
    if not pathlib.Path(path).is_file():
        return {}
    found = {}
    for case in json.loads(pathlib.Path(path).read_text(encoding="utf-8")):
        name = case["name"].rsplit("/", 1)[-1]
        if case["name"].startswith("section/mochikoshi") and name.startswith("factor_depth_"):
            found[float(name.removeprefix("factor_depth_"))] = case["value"]
    return found

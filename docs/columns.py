"""Writes the table of dry columns in docs/theory/verification-mpm.md and docs/images/columns.png.

    flowslide verify mpm/columns --json > columns.json
    python3 docs/columns.py columns.json

Needs Matplotlib. Text outside the marked table is left alone.
"""
import csv
import json
import pathlib
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

DOCS = pathlib.Path(__file__).resolve().parent
EXPERIMENTS = DOCS.parent / "fixtures/columns/experiments.csv"
PAGE = DOCS / "theory/verification-mpm.md"


def table(rows):
    lines = ["| case | quantity | experiment | here | off | within 10 % |", "|---|---|---|---|---|---|"]
    for r in rows:
        case, quantity = r["name"].removeprefix("mpm/columns_").split("/", 1)
        if r["target"] == 0:  # change at the last halving
            lines.append(f"| {case} | {quantity} | | | {100 * r['value']:+.1f} % | |")
            continue
        off = 100 * (r["value"] / r["target"] - 1)
        within = "control" if "control" in quantity else "yes" if r["pass"] else "no"
        lines.append(
            f"| {case} | {quantity} | {r['target']:.2f} | {r['value']:.2f} | {off:+.0f} % | {within} |"
        )
    return "\n".join(lines)


def points(rows, case, quantity):
    found = []
    for r in rows:
        match = re.fullmatch(rf"mpm/columns_{case}/a([0-9.]+)_{quantity}", r["name"])
        if match:
            found.append((float(match[1]), r["value"]))
    return sorted(found)


def draw(rows):
    figure, axes = plt.subplots(1, 2, figsize=(7.2, 3.2))
    fits = list(csv.DictReader(EXPERIMENTS.open()))
    for axis, quantity in zip(axes, ("front", "height")):
        for name, colour in (("Lube 2005", "C0"), ("Lajeunesse 2005", "C1"), ("Lube 2004", "C2")):
            label = f"{name} (measured)"
            for fit in (f for f in fits if f["experiment"] == name and f["quantity"] == quantity):
                a0, a1 = max(0.4, float(fit["a_from"])), min(6.0, float(fit["a_to"]))
                if a0 >= a1:
                    continue
                a = [a0 + (a1 - a0) * i / 40 for i in range(41)]
                y = [float(fit["factor"]) * x ** float(fit["exponent"]) for x in a]
                axis.plot(a, y, color=colour, lw=1, ls="--" if "Laj" in name else "-", label=label)
                label = None
        for case, marker, label in (
            ("plane", "o", "plane, mu(I)"),
            ("channel", "s", "channel, beads, mu(I)"),
            ("round", "^", "round, mu(I)"),
        ):
            found = points(rows, case, quantity)
            if found:
                axis.plot(*zip(*found), marker, color="k", mfc="none", ms=5, label=label)
        found = points(rows, "plane", "coulomb_plane_" + quantity)
        if found:
            axis.plot(*zip(*found), "x", color="0.5", label="plane, Coulomb, asin(tan)")
        axis.set(xscale="log", yscale="log", xlabel="height / length", title=quantity)
        axis.set_xticks([0.5, 1, 2, 5], ["0.5", "1", "2", "5"])
    axes[0].set_ylabel("over the first length")
    axes[0].legend(fontsize=6, frameon=False)
    figure.tight_layout()
    figure.savefig(DOCS / "images/columns.png", dpi=150, metadata={"Software": None})


def main():
    rows = json.loads(pathlib.Path(sys.argv[1]).read_text())
    draw(rows)
    text = PAGE.read_text()
    block = f"<!-- columns -->\n{table(rows)}\n<!-- end columns -->"
    PAGE.write_text(re.sub(r"<!-- columns -->.*<!-- end columns -->", lambda _: block, text, flags=re.S))


main()

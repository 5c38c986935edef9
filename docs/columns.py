"""Writes the tables of columns in docs/theory/verification-mpm.md and docs/images/columns.png.

    flowslide verify mpm/columns mpm/bui mpm/undrained --json > columns.json
    python3 docs/columns.py columns.json

The rows of cases that were run replace what the tables hold of these cases; those of others stay,
since some take long. The figure needs Matplotlib. Text outside the marked tables is left alone.
"""
import csv
import json
import pathlib
import re
import sys

DOCS = pathlib.Path(__file__).resolve().parent
EXPERIMENTS = DOCS.parent / "fixtures/columns/experiments.csv"
PAGE = DOCS / "theory/verification-mpm.md"


DRY = ("columns", r"mpm/columns_(?P<case>[a-z]+)/(?P<quantity>.*)", "experiment")
SLUMPS = ("slumps", r"mpm/(?P<case>bui|undrained)_column/(?P<quantity>.*)", "target")


def line(case, quantity, row):
    seconds = f"{row['core_seconds']:.0f} |"
    if "halving" in quantity and row["target"] == 0:  # change at a halving of the cell
        within = "yes" if row["pass"] else "no"
        return f"| {case} | {quantity} | | | {100 * row['value']:+.1f} % | {within} | {seconds}"
    if row["target"] == 0:  # an error
        within = "yes" if row["pass"] else "no"
        return f"| {case} | {quantity} | | {row['value']:.2g} | | {within} | {seconds}"
    digits = 3 if row["unit"] == "m" else 2
    off = 100 * (row["value"] / row["target"] - 1)
    within = "control" if "control" in quantity else "yes" if row["pass"] else "no"
    numbers = f"{row['target']:.{digits}f} | {row['value']:.{digits}f} | {off:+.0f} %"
    return f"| {case} | {quantity} | {numbers} | {within} | {seconds}"


def block(text, kind):
    name = kind[0]
    return re.search(rf"<!-- {name} -->\n(.*)<!-- end {name} -->", text, re.S)


def update(text, rows, kind):
    name, pattern, known = kind
    matches = [(re.fullmatch(pattern, r["name"]), r) for r in rows]
    new, seconds = [], 0.0
    for m, r in matches:
        if not m:
            continue
        seconds += r["core_seconds"]
        if m["quantity"].endswith("motion_left"):  # its time is the run's, which the next row shows
            continue
        new.append((m["case"], line(m["case"], m["quantity"], {**r, "core_seconds": seconds})))
        seconds = 0.0
    found = block(text, kind)
    cases = {c for c, _ in new}
    kept = [n for n in found[1].splitlines()[2:] if n.split("|")[1].strip() not in cases]
    order = ("short", "plane", "round", "channel", "bui", "undrained")
    lines = [(n.split("|")[1].strip(), n) for n in kept] + new
    lines.sort(key=lambda entry: order.index(entry[0]))
    head = [f"| case | quantity | {known} | here | off | holds | core s |", "|---|---|---|---|---|---|---|"]
    body = "\n".join(head + [n for _, n in lines])
    return f"{text[:found.start()]}<!-- {name} -->\n{body}\n<!-- end {name} -->{text[found.end():]}"


def points(text, case, pattern):
    found = []
    for row in block(text, DRY)[1].splitlines()[2:]:
        cells = [c.strip() for c in row.split("|")]
        match = re.fullmatch(pattern, cells[2])
        if cells[1] == case and match:
            found.append((float(match[1]), float(cells[4])))
    return sorted(found)


def draw(text):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

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
            measure = "edge" if quantity == "front" else quantity
            found = points(text, case, rf"a([0-9.]+)_{measure}")
            if found:
                axis.plot(*zip(*found), marker, color="k", mfc="none", ms=5, label=label)
        found = points(text, "plane", r"control_a([0-9.]+)_coulomb_plane")
        if found and quantity == "front":
            axis.plot(*zip(*found), "x", color="0.5", label="plane, Coulomb, asin(tan)")
        axis.set(xscale="log", yscale="log", xlabel="height / length", title=quantity)
        axis.set_xticks([0.5, 1, 2, 5], ["0.5", "1", "2", "5"])
    axes[0].set_ylabel("over the first length")
    axes[0].legend(fontsize=6, frameon=False)
    figure.tight_layout()
    figure.savefig(DOCS / "images/columns.png", dpi=150, metadata={"Software": None})


def main():
    rows = json.loads(pathlib.Path(sys.argv[1]).read_text())
    text = PAGE.read_text()
    for kind in (DRY, SLUMPS):
        text = update(text, rows, kind)
    PAGE.write_text(text)
    draw(text)


main()

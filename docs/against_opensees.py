"""Prints runs of against-opensees.yaml beside the OpenSees run of fixtures/opensees/dam-rio270.

    python3 docs/against_opensees.py RUN... [--flowslide build/release/flowslide]

Displacement of the crest against the base [m], interpolated to the times that OpenSees recorded, and
the depths of liquefaction [m] that transfer.zone finds in either history: by nodes with a liquefied
neighbour, and interpolated between nodes.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import tempfile

CREST = (-20.0, 30.0)
BASE = (-340.0, -5.0)
FROM = 4.5  # s; before, nothing has moved by more than the shaking itself


def stage_file(run, stage, name):
    key = json.loads((run / "result.json").read_text())["stages"][stage]["key"]
    return run / "stages" / stage / key[:16] / name


def convert(program, source, target):
    subprocess.run([program, "convert", source, target], check=True, stdout=subprocess.DEVNULL)


def crest(recorders):
    """Times, and (x, y) of the crest without that of the base."""
    nodes = [line.split() for line in (recorders / "nodeinfo.dat").open()]
    at = {
        place: min(
            range(len(nodes)),
            key=lambda i: (float(nodes[i][1]) - place[0]) ** 2 + (float(nodes[i][2]) - place[1]) ** 2,
        )
        for place in (CREST, BASE)
    }
    rows = [[float(v) for v in line.split()] for line in (recorders / "displacement.out").open()]
    value = lambda row, place, d: row[1 + 2 * at[place] + d]
    return [r[0] for r in rows], [
        tuple(value(r, CREST, d) - value(r, BASE, d) - (value(rows[0], CREST, d) - value(rows[0], BASE, d))
              for d in (0, 1))
        for r in rows
    ]


def between(times, values, t):
    for i in range(1, len(times)):
        if times[i] >= t - 1e-9:
            share = (t - times[i - 1]) / (times[i] - times[i - 1])
            return tuple(a + share * (b - a) for a, b in zip(values[i - 1], values[i]))
    return values[-1]


def nearest(rows, t):
    return min(rows, key=lambda r: abs(float(r["time_s"]) - t))


def read(program, run, history, zone):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        convert(program, stage_file(run, history, "history.h5"), folder / "recorders/")
        convert(program, stage_file(run, zone, "zone.h5"), folder / "zone.csv")
        return crest(folder / "recorders"), list(csv.DictReader((folder / "zone.csv").open()))


def depth(rows, t, window, rule):
    return float(nearest(rows, t)[f"depth_{rule}{window}_m"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", type=pathlib.Path)
    parser.add_argument("--flowslide", default="build/release/flowslide")
    options = parser.parse_args()
    theirs = read(options.flowslide, options.runs[0], "opensees", "zone_opensees")
    ours = [read(options.flowslide, run, "shake", "zone") for run in options.runs]
    times = [t for t in theirs[0][0] if t >= FROM]
    names = ["OpenSees"] + [run.name for run in options.runs]
    print("| t, s | " + " | ".join(names) + " |\n" + "|---" * (1 + len(names)) + "|")
    print("| *displacement, x and y; off in x* |" + " |" * len(names))
    for t in times:
        x, y = between(*theirs[0], t)
        cells = [f"{x:.3f}, {y:.3f}"]
        for motion, _ in ours:
            a, b = between(*motion, t)
            cells.append(f"{a:.3f}, {b:.3f}; {100 * (a / x - 1):+.0f} %")
        print(f"| {t:.2f} | " + " | ".join(cells) + " |")
    for window in ("crest", "pond"):
        print(f"| *depth, {window}: by nodes, interpolated* |" + " |" * len(names))
        for t in times:
            cells = [
                ", ".join(f"{depth(rows, t, window, rule):.1f}" for rule in ("", "interpolated_"))
                for _, rows in [theirs] + ours
            ]
            print(f"| {t:.2f} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()

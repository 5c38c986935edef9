"""Writes the tables of docs/performance.md and docs/images/work-precision.png from measurements.

    flowslide bench --large --json > docs/performance.json
    flowslide study run docs/performance-dam.yaml --out DIR && cp DIR/table.csv docs/performance-dam.csv
    flowslide study run docs/performance-chain.yaml --out DIR --jobs 1 --threads 1
    python3 docs/performance.py [DIR]

DIR: that of the chain, whose rows go to docs/performance-chain.csv with the seconds of their stages.

Needs Matplotlib. Text outside the marked tables is left alone,
the line on machines among it, and so are tables of what was not measured.
"""
import csv
import json
import pathlib
import re
import statistics
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

DOCS = pathlib.Path(__file__).resolve().parent
TARGETS = {"2d/linear": 20, "2d/quadratic": 12, "3d/linear": 12, "3d/quadratic": 6}


def speed_table(rows):
    """One row per basis and number of points, laws beside each other."""
    laws = list(dict.fromkeys(r["name"].split("/")[3] for r in rows))
    lines = [
        "| M updates/s/core | points | " + " | ".join(law.replace("_", " ") for law in laws)
        + " | target | bytes | % of roofline | efficiency of 2 threads, % |",
        "|---|---" + "|---" * len(laws) + "|---|---|---|---|",
    ]
    by_scene = {}
    for r in rows:
        _, dim, basis, law, points = r["name"].split("/")
        by_scene.setdefault((dim, basis, int(points)), {})[law] = r
    for (dim, basis, points), by_law in by_scene.items():
        values = " | ".join(f"{by_law[law]['value']:.1f}" for law in laws)
        spans = (
            span([r[key] for r in by_law.values()])
            for key in ("bytes_per_update", "roofline_percent", "efficiency_2_threads_percent")
        )
        lines.append(
            f"| {dim} {basis} | {points:,} | {values} | {TARGETS[f'{dim}/{basis}']} "
            f"| {' | '.join(spans)} |"
        )
    return "\n".join(lines)


def span(values):
    low, high = f"{min(values):.0f}", f"{max(values):.0f}"
    return low if low == high else f"{low}-{high}"


def mean_and_scatter(values, digits=1):
    values = [float(v) for v in values]
    return f"{statistics.mean(values):.{digits}f} +- {statistics.stdev(values):.{digits}f}"


def static_table(rows):
    lines = [
        "| cell, m | `c_soft_ratio` | runs | points | runout, m | without 0.5 % of the mass, m "
        "| beyond the toe, t/m | at rest after, s | largest energy error |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    groups = {}
    for row in rows:
        if row["state"] == "done":
            groups.setdefault((row["cell [m]"], row["c_soft"]), []).append(row)
    for (cell, ratio), repeats in groups.items():
        column = lambda name: [row[name] for row in repeats]
        tonnes = [float(v) / 1000 for v in column("mass_past_toe_kg_per_m")]
        lines.append(
            f"| {float(cell):g} | {float(ratio):g} | {len(repeats)} | {int(float(repeats[0]['particles'])):,} "
            f"| {mean_and_scatter(column('runout_m'))} "
            f"| {mean_and_scatter(column('runout_mass_quantile_m'))} "
            f"| {mean_and_scatter(tonnes, 0)} | {mean_and_scatter(column('time_at_rest_s'), 0)} "
            f"| {max(map(float, column('energy_error'))):.0e} |"
        )
    return "\n".join(lines)


def with_seconds(folder):
    """The rows of a study with the processor time of each: the wall time of its stages, whose sum is
    scaled to the processor time of the study."""
    folder = pathlib.Path(folder)
    with (folder / "table.csv").open(newline="") as lines:
        rows = list(csv.DictReader(lines))
    sessions = [json.loads(path.read_text()) for path in (folder / "sessions").glob("*.json")]
    took = {}
    for path in (folder / "stages").glob("*/*.json"):
        record = json.loads(path.read_text())["record"]
        took[record["stage"], record["key"][:16]] = record["seconds"]
    scale = sum(s["processor_seconds"] for s in sessions) / sum(took.values())
    stages = [name for name in rows[0] if name.startswith("key:")]
    for row in rows:
        wall = sum(took[s[4:], row[s][:16]] for s in stages if row[s])
        row["core_seconds"] = f"{scale * wall:.1f}"
    return rows


CHAIN = (
    "size [m]", "repeat", "state", "mesh_elements", "particles", "core_seconds", "transfer_time_s",
    "liquefaction_depth_pond_interpolated_m", "runout_m", "runout_995_m", "mass_past_toe_kg_per_m",
)


def keep_chain(folder, path):
    with path.open("w", newline="") as out:
        table = csv.DictWriter(out, CHAIN, extrasaction="ignore")
        table.writeheader()
        table.writerows(with_seconds(folder))


def chain_table(rows):
    """Means of five runs; the error is that of the mean against the finest size, with the standard
    deviation of the difference of two such means."""
    groups = {}
    for row in rows:
        if row["state"] == "done":
            groups.setdefault(row["size [m]"], []).append(row)
    finest = list(groups.values())[-1]
    def cells(repeats, name, scale=1.0, digits=1):
        values = [scale * float(r[name]) for r in repeats]
        best = [scale * float(r[name]) for r in finest]
        text = mean_and_scatter(values, digits)
        if repeats is finest:
            return f"{text} | "
        error = statistics.mean(values) - statistics.mean(best)
        spread = (
            statistics.variance(values) / len(values) + statistics.variance(best) / len(best)
        ) ** 0.5
        return f"{text} | {error:+.{digits}f} +- {spread:.{digits}f}"
    lines = [
        "| elements | number | points | runs | core seconds | transfer, s | depth under the pond, m "
        "| error | runout, m | error | beyond the toe, t/m | error |",
        "|---" * 12 + "|",
    ]
    for size, repeats in groups.items():
        column = lambda name: [float(r[name]) for r in repeats]
        lines.append(
            f"| {float(size):g} m | {column('mesh_elements')[0]:,.0f} | {column('particles')[0]:,.0f} "
            f"| {len(repeats)} | {statistics.mean(column('core_seconds')):.0f} "
            f"| {mean_and_scatter(column('transfer_time_s'))} "
            f"| {cells(repeats, 'liquefaction_depth_pond_interpolated_m')} "
            f"| {cells(repeats, 'runout_m')} "
            f"| {cells(repeats, 'mass_past_toe_kg_per_m', 1e-3, 0)} |"
        )
    return "\n".join(lines)


def large_table(rows):
    laws = list(dict.fromkeys(r["name"].split("/")[3] for r in rows))
    lines = [
        "| M updates/s/core (of that with) | " + " | ".join(law.replace("_", " ") for law in laws)
        + " | peak memory, bytes per point |",
        "|---" * (len(laws) + 2) + "|",
    ]
    by_scene = {}
    for r in rows:
        _, _, dim, law, points = r["name"].split("/")
        by_scene.setdefault((dim, int(points)), {})[law] = r
    for (dim, points), by_law in by_scene.items():
        usual = next(iter(by_law.values()))["usual_points"]
        values = " | ".join(
            f"{by_law[law]['value']:.1f} ({by_law[law]['percent_of_usual']:.0f} %)" for law in laws
        )
        memory = max(r["peak_bytes_per_point"] for r in by_law.values())
        lines.append(f"| {dim} quadratic, {points:,} ({usual:,.0f}) | {values} | {memory:.0f} |")
    return "\n".join(lines)


def valley_table(rows):
    lines = [
        "| points | threads | M updates/s | s per step | step, ms | peak memory, GiB |",
        "|---|---|---|---|---|---|",
    ]
    for r in rows:
        lines.append(
            f"| {int(r['name'].split('/')[-1]):,} | {r['threads']:.0f} | {r['value']:.1f} "
            f"| {r['seconds_per_step']:.2f} | {1e3 * r['step_s']:.2f} "
            f"| {r['peak_memory_gib']:.2f} |"
        )
    return "\n".join(lines)


def pm4sand_table(rows):
    lines = [
        "| `max_strain_increment` | `tolerance` | stress error | sub-steps per call "
        "| rejected, % | M sub-steps/s/core | ns per call |",
        "|---|---|---|---|---|---|---|",
    ]
    for r in rows:
        lines.append(
            f"| {r['max_strain_increment']:g} | {r['tolerance']:g} | {r['stress_error']:.1g} "
            f"| {r['sub_steps_per_call']:.2f} | {r['rejected_percent']:.0f} "
            f"| {r['value']:.2f} | {r['ns_per_call']:.0f} |"
        )
    return "\n".join(lines)


def step_table(rows):
    lines = [
        "| soil | elements | M elements/s/core | ns per element | sub-steps per element "
        "| step, ms |",
        "|---|---|---|---|---|---|",
    ]
    for r in rows:
        _, _, soil, elements = r["name"].split("/")
        lines.append(
            f"| {soil.replace('_', ' ')} | {int(elements):,} | {r['value']:.1f} "
            f"| {r['ns_per_element']:.0f} | {r['sub_steps_per_element']:.2f} "
            f"| {1e3 * r['step_s']:.2f} |"
        )
    return "\n".join(lines)


def dam_table(rows):
    lines = [
        "| run | elements | steps | crest, m | error | mean r_u under the pond | error "
        "| r_u > 0.7, m | M sub-steps | core seconds |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for r in rows:
        _, _, kind, name = r["name"].split("/", 3)
        lines.append(
            f"| {name + ' m' if kind == 'size' else name} | {r['elements']:,.0f} "
            f"| {r['steps']:,.0f} | {r['crest_m']:.3f} | {100 * r['value']:.1f} % "
            f"| {r['pond_r_u']:.3f} | {r['pond_r_u_error']:.3f} | {r['liquefied_m']:.1f} "
            f"| {1e-6 * r['sub_steps']:.1f} | {r['core_seconds']:.1f} |"
        )
    return "\n".join(lines)


def implicit_table(rows):
    lines = [
        "| run | steps | iterations per step, most | steps cut | crest, m | error "
        "| mean r_u under the pond | M sub-steps | energy error | core seconds |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for r in rows:
        lines.append(
            f"| {r['name'].split('/', 3)[3]} | {r['steps']:,.0f} "
            f"| {r['iterations'] / r['steps']:.1f}, {r['most_iterations']:.0f} "
            f"| {r['cut_steps']:.0f} | {r['crest_m']:.3f} | {100 * r['value']:.1f} % "
            f"| {r['pond_r_u']:.3f} | {1e-6 * r['sub_steps']:.1f} | {r['energy_error']:.0e} "
            f"| {r['core_seconds']:.1f} |"
        )
    return "\n".join(lines)


def curve_table(lines_of):
    cells = sorted({p["cell_m"] for line in lines_of.values() for p in line}, reverse=True)
    head = "| basis / transfer | " + " | ".join(f"{c:g} m" for c in cells) + " |"
    rows = [head, "|---" * (len(cells) + 1) + "|"]
    for name, line in lines_of.items():
        if name.endswith("/pic"):  # wrong by 0.07 to 0.5; in the figure
            continue
        by_cell = {p["cell_m"]: p for p in line}
        entries = [
            f"{by_cell[c]['value']:.2g} / {by_cell[c]['core_seconds']:.2g} s" if c in by_cell else "fails"
            for c in cells
        ]
        rows.append(f"| {name} | " + " | ".join(entries) + " |")
    return "\n".join(rows)


def front_table(rows):
    lines_of = {}
    for r in rows:
        _, _, transfer, cells = r["name"].split("/")
        lines_of.setdefault(transfer, {})[int(cells)] = r
    cells = sorted(next(iter(lines_of.values())))
    lines = ["| transfer | " + " | ".join(f"1/{c}" for c in cells) + " |", "|---" * (len(cells) + 1) + "|"]
    for transfer, by_cell in lines_of.items():
        entries = [
            f"{100 * by_cell[c]['value']:.0f} % / {by_cell[c]['core_seconds']:.2g} s" for c in cells
        ]
        lines.append(f"| {transfer} | " + " | ".join(entries) + " |")
    return "\n".join(lines)


def draw(lines_of, path):
    bases = list(dict.fromkeys(name.split("/")[0] for name in lines_of))
    figure, axes = plt.subplots(1, len(bases), figsize=(3.2 * len(bases), 3.4), sharey=True)
    for axis, basis in zip(axes, bases):
        for name, line in lines_of.items():
            if name.startswith(basis + "/"):
                axis.loglog(
                    [p["core_seconds"] for p in line],
                    [min(p["value"], 10.0) for p in line],
                    "o-",
                    ms=3,
                    lw=1,
                    label=name.split("/")[1],
                )
        axis.set_title(basis, fontsize=9)
        axis.set_xlabel("core seconds")
        axis.grid(True, which="both", lw=0.2)
    axes[0].set_ylabel("rms error of velocity")
    axes[-1].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=110, metadata={"Software": None})


def replace(text, mark, table):
    pattern = re.compile(f"(<!-- {mark} -->).*?(\n<!-- end {mark} -->)", re.DOTALL)
    assert pattern.search(text), f"docs/performance.md has no marks for {mark}"
    return pattern.sub(lambda m: m.group(1) + "\n" + table + m.group(2), text)


def main():
    measurements = json.loads((DOCS / "performance.json").read_text())
    mpm = [m for m in measurements if m["name"].startswith("mpm/")]
    large = [m for m in mpm if m["name"].startswith("mpm/large/")]
    speed = [m for m in mpm if m["unit"] == "Mupdates/s/core" and m not in large]
    curves = {}
    for m in mpm:
        if m["name"].startswith("mpm/curve/"):
            _, _, basis, transfer, _ = m["name"].split("/")
            curves.setdefault(f"{basis}/{transfer}", []).append(m)
    page = DOCS / "performance.md"
    text = page.read_text()
    if speed:
        text = replace(text, "speed", speed_table(speed))
    dam = DOCS / "performance-dam.csv"
    if dam.exists():
        with dam.open(newline="") as lines:
            text = replace(text, "static", static_table(list(csv.DictReader(lines))))
    chain = DOCS / "performance-chain.csv"
    if len(sys.argv) > 1:
        keep_chain(sys.argv[1], chain)
    if chain.exists():
        with chain.open(newline="") as lines:
            text = replace(text, "chain", chain_table(list(csv.DictReader(lines))))
    if large:
        text = replace(text, "large", large_table(large))
    if curves:
        text = replace(text, "curves", curve_table(curves))
        draw(curves, DOCS / "images" / "work-precision.png")
    front = [m for m in mpm if m["name"].startswith("mpm/front/")]
    if front:
        text = replace(text, "front", front_table(front))
    valley = [m for m in mpm if m["name"].startswith("mpm/3d/valley/")]
    if valley:
        text = replace(text, "valley", valley_table(valley))
    for mark, table in (
        ("pm4sand", pm4sand_table),
        ("step", step_table),
        ("dam/size", dam_table),
        ("dam/implicit", implicit_table),
        ("dam/saving", dam_table),
    ):
        rows = [m for m in measurements if m["name"].startswith(f"fem/{mark}/")]
        if rows:
            text = replace(text, f"fem {mark}", table(rows))
    page.write_text(text)


if __name__ == "__main__":
    main()

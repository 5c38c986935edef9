#!/usr/bin/env python3
"""Draws the figures of a flowslide report.

In the folder of a run, `python3 plot/plot.py` reads report/data, report/runout.csv and
report/zone.csv and writes plot/figures/NAME.svg and .png; names draw only those. Change what you
like here, in plot_section.py and in plot_style.py: the program keeps a script that was changed.
"""
import argparse
import concurrent.futures
import ctypes
import errno
import pathlib
import signal
import sys

from plot_style import BLUE, GREEN, INK, ORANGE, PURPLE, RED, WIDTH  # first: selects the backend

import matplotlib.pyplot as plt
import numpy as np
import plot_section


def histories(titles, xlabel):
    rows = len(titles)
    figure, axes = plt.subplots(rows, 1, figsize=(WIDTH, 1.5 * rows + 0.35), sharex=True,
                                constrained_layout=True)
    for letter, title, ax in zip("abcd", titles, axes):
        ax.set_title(f"({letter}) {title}")
        ax.spines[["top", "right"]].set_visible(False)
        ax.grid(color="0.9", lw=0.5)
        ax.margins(x=0.01)
    axes[-1].set_xlabel(xlabel)
    figure.align_ylabels()
    return figure, axes


def legend(ax, **options):
    """Beside the panel, where no curve can run through it."""
    ax.legend(loc="upper left", bbox_to_anchor=(1, 1.03), alignment="left", **options)


def zone_history(section, table):
    if table.size < 2:
        return None
    figure, (depth, energy, shape) = histories(
        ("Depth of liquefaction", "Kinetic energy of the section", "Distortion of the mesh"),
        "time from the start of the motion (s)")
    t = table["time_s"]
    for window, colour in zip(section.info["windows"], (BLUE, ORANGE, GREEN, PURPLE) * 9):
        depth.plot(t, table[f"depth_max_{window['column']}_m"], color=colour, label=window["name"])
        depth.plot(t, table[f"depth_{window['column']}_m"], color=colour, lw=0.7, ls=":")
    depth.set_ylabel("depth (m)")
    depth.invert_yaxis()
    legend(depth, title="dotted: present,\nfull: maximum so far", title_fontsize=7.5)
    energy.plot(t, table["kinetic_energy_relative_J_per_m"] / 1e6, color=BLUE,
                label="relative to the base")
    energy.plot(t, table["kinetic_energy_J_per_m"] / 1e6, color=ORANGE, lw=0.8, label="absolute")
    energy.set_ylabel("energy (MJ/m)")
    legend(energy)
    shape.plot(t, table["distortion_gauss"], color=BLUE, label="smallest Gauss-point Jacobian")
    shape.plot(t, table["distortion_centre"], color=ORANGE, ls="--", label="area ratio")
    shape.set_ylabel("quality Q (-)")
    legend(shape)
    for ax in (depth, energy, shape):
        ax.axvline(section.info["transfer_time_s"], color=RED, lw=1)
    depth.text(section.info["transfer_time_s"], 1.02, "transfer", color=RED, ha="center",
               va="bottom", transform=depth.get_xaxis_transform())
    return figure


def flow_history(table):
    if table.size < 2:
        return None
    figure, (front, speed, energy, error) = histories(
        ("Runout", "Speed", "Energy", "Residual of the balances"), "time since transfer (s)")
    t = table["time_s"]
    front.plot(t, table["runout_m"], color=BLUE)
    front.set_ylabel("runout (m)")
    front.set_ylim(0, max(1.0, 1.05 * np.nanmax(table["runout_m"])))
    speed.plot(t, table["max_speed_m_s"], color=ORANGE, lw=0.9, label="fastest point")
    # Between two rows the front is the noise of single points.
    before, after = np.maximum(t - 0.5, t[0]), np.minimum(t + 0.5, t[-1])
    way = np.interp(after, t, table["front_m"]) - np.interp(before, t, table["front_m"])
    speed.plot(t, way / (after - before), color=BLUE, label="front, over 1 s")
    speed.set_ylabel("speed (m/s)")
    legend(speed)
    energy.plot(t, table["gravity_work_J_per_m"] / 1e6, color=INK, lw=1.6, label="work of gravity")
    for name, label, style in (
            ("plastic_work", "plastic work", (BLUE, "-")),
            ("friction_work", "base friction", (ORANGE, "-")),
            ("damping_work", "damping and transfer", (GREEN, "--")),
            ("kinetic", "kinetic", (RED, "-")),
            ("strain_energy", "elastic", (PURPLE, "--"))):
        energy.plot(t, table[f"{name}_J_per_m"] / 1e6, color=style[0], ls=style[1], label=label)
    energy.set_ylabel("energy (MJ/m)")
    legend(energy)
    # Relative to the work of gravity: without meaning while that is next to nothing.
    flowing = table["gravity_work_J_per_m"] > 0.01 * table["gravity_work_J_per_m"].max()
    t, table = t[flowing], table[flowing]
    error.plot(t, 100 * table["energy_error"], color=BLUE, label="energy")
    error.plot(t, 100 * table["momentum_error"], color=ORANGE, ls="--", label="momentum")
    error.set_ylabel("residual (%)")
    legend(error)
    return figure


def save(figure, path, kind, metadata):
    """Without a date, so that the same data give the same bytes; complete or absent."""
    partial = path.with_name(path.name + ".partial")
    figure.savefig(partial, format=kind, metadata=metadata)
    partial.rename(path)


def figures(folder):
    """How to draw each figure; nothing is read before one is called."""
    section = lambda: plot_section.Section(folder / "data")
    read = lambda name: np.atleast_1d(np.genfromtxt(folder / name, delimiter=",", names=True))
    return {
        "final_displacement": lambda: plot_section.final_displacement(section()),
        "section_before": lambda: plot_section.section_before(section()),
        "flow_history": lambda: flow_history(read("runout.csv")),
        "zone_history": lambda: zone_history(section(), read("zone.csv")),
        "final_materials": lambda: plot_section.final_materials(section()),
        "final_strength": lambda: plot_section.final_strength(section())}


def draw(folder, out, name):
    figure = figures(folder)[name]()
    if figure is not None:
        save(figure, out / "figures" / f"{name}.svg", "svg", {"Date": None})
        save(figure, out / "figures" / f"{name}.png", "png", {"Software": None})


def die_with_parent():
    """A killed program must not leave processes behind that wait for work for ever."""
    if sys.platform == "linux":
        pr_set_pdeathsig = 1
        ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)


def main(folder, out, names):
    (out / "figures").mkdir(exist_ok=True)
    with concurrent.futures.ProcessPoolExecutor(initializer=die_with_parent) as pool:
        for drawing in [pool.submit(draw, folder, out, name) for name in names or figures(folder)]:
            drawing.result()


def guarded(action):
    """Disk and memory that do not suffice have an exit status of their own, for then nothing is
    wrong with the data."""
    try:
        action()
    except (OSError, MemoryError) as error:
        full = (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EROFS, errno.ENOMEM, errno.EAGAIN,
                errno.EMFILE, errno.ENFILE, errno.EFBIG)
        if isinstance(error, OSError) and error.errno not in full:
            raise
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
        sys.exit(74)


def run(folder, out, *names):
    """What the program calls."""
    guarded(lambda: main(pathlib.Path(folder), pathlib.Path(out), names))


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--report", type=pathlib.Path, default=here.parent / "report",
                        help="report folder [beside the folder of this script]")
    parser.add_argument("--out", type=pathlib.Path, default=here,
                        help="where figures/ goes [beside this script]")
    parser.add_argument("names", nargs="*", help="figures to draw [all]")
    arguments = parser.parse_args()
    main(arguments.report, arguments.out, arguments.names)

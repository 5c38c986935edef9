"""Figure of a section as a workflow describes it, before anything runs."""
import json
import pathlib

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from plot import guarded
from plot_section import BOTTOM, LEFT, RIGHT, SOILS, TOP
from plot_style import BLUE, GREEN, INK, ORANGE, PURPLE, RED, SKY, WIDTH

LINE = 0.16  # inches of a line of the legend
BANDS = [ORANGE, PURPLE, SKY, GREEN]


def frame(nodes, data):
    """Limits of the picture [m]: the section, and what lies near it."""
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    height = high[1] - low[1]
    left, right = low[0], high[0]
    if data["toe_m"] is not None:
        left, right = min(left, data["toe_m"]), max(right, data["toe_m"])
    edge = 0.02 * (right - left)
    return (left - edge, right + edge), (low[1] - 0.12 * height, high[1] + 0.25 * height)


def draw_soils(ax, data, nodes):
    elements, tags = np.array(data["elements"]), np.array(data["tags"])
    legend = []
    line = 0.25 if len(elements) < 5000 else 0.08
    for k, soil in enumerate(data["materials"]):
        colour = SOILS[k % len(SOILS)]
        chosen = elements[tags == soil["tag"]]
        ax.add_collection(PolyCollection(nodes[chosen], facecolors=colour, edgecolors="white",
                                         linewidths=line))
        legend.append(Patch(facecolor=colour, label=f"{soil['name']} ({len(chosen)} elements)"))
    return legend


def draw_lines(ax, data, xlim, ylim):
    """Water, ground of the flow, toe and box; returns their part of the legend."""
    legend = []
    for key, colour, style, words in (("water", BLUE, "-", "water table and pond"),
                                      ("ground", INK, "-", "ground of the flow")):
        line = np.array(data[key])
        if len(line) == 0:
            continue
        # Both go on level beyond their ends.
        line = np.vstack([[xlim[0], line[0, 1]], line, [xlim[1], line[-1, 1]]])
        ax.plot(line[:, 0], line[:, 1], color=colour, linestyle=style, linewidth=1.0, zorder=4)
        legend.append(Line2D([], [], color=colour, linestyle=style, linewidth=1.0, label=words))
    if data["box"] is not None:
        left, right, bottom, top = data["box"]
        ax.add_patch(Rectangle((left, bottom), right - left, top - bottom, fill=False,
                               edgecolor=RED, linestyle=":", linewidth=0.9, zorder=5))
        legend.append(Line2D([], [], color=RED, linestyle=":", linewidth=0.9,
                             label="becomes material points"))
    if data["toe_m"] is not None:
        ax.plot([data["toe_m"]], [ylim[0]], marker="^", color=RED, clip_on=False, zorder=6)
        legend.append(Line2D([], [], color=RED, marker="^", linestyle="none",
                             label=f"toe, x = {data['toe_m']:g} m: runout begins here"))
    return legend


def draw_windows(ax, data, xlim):
    legend = []
    for k, window in enumerate(data["windows"]):
        left = xlim[0] if window["from"] is None else window["from"]
        right = xlim[1] if window["to"] is None else window["to"]
        colour = BANDS[k % len(BANDS)]
        ax.axvspan(left, right, facecolor=colour, alpha=0.22, linewidth=0, zorder=3)
        legend.append(Patch(facecolor=colour, alpha=0.35, label=f"window {window['name']}"))
    return legend


def draw(data, out):
    nodes = np.array(data["nodes"])
    xlim, ylim = frame(nodes, data)
    high = (WIDTH - LEFT - RIGHT) * (ylim[1] - ylim[0]) / (xlim[1] - xlim[0])
    figure = plt.figure()
    ax = figure.add_axes((0, 0, 1, 1))
    legend = draw_soils(ax, data, nodes) + draw_windows(ax, data, xlim)
    legend += draw_lines(ax, data, xlim, ylim)
    footer = LINE * ((len(legend) + 2) // 3) + 0.1
    total = TOP + high + BOTTOM + footer
    figure.set_size_inches(WIDTH, total)
    ax.set_position((LEFT / WIDTH, (BOTTOM + footer) / total, (WIDTH - LEFT - RIGHT) / WIDTH,
                     high / total))
    ax.set(xlim=xlim, ylim=ylim, xlabel="x (m)", ylabel="y (m)", title=data["title"])
    ax.spines[["top", "right"]].set_visible(False)
    ax.locator_params(axis="y", nbins=4 if high < 1 else 6)
    figure.legend(handles=legend, loc="lower left", ncol=3,
                  bbox_to_anchor=(LEFT / WIDTH - 0.01, 0.0))
    ending = pathlib.Path(out).suffix[1:]
    figure.savefig(out, format=ending, metadata={"Date": None} if ending == "svg" else None)


def run(source, out):
    """What the program calls."""
    guarded(lambda: draw(json.loads(pathlib.Path(source).read_text()), out))

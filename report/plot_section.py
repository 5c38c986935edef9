"""Figures of the section before and after the flow."""
import json

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize, to_rgba_array
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from plot_style import INK, RED, SKY, WIDTH

LEFT, RIGHT, TOP, GAP, BOTTOM = 0.55, 0.12, 0.24, 0.26, 0.42  # inches around the panels
STILL = "0.86"  # what did not move
GROUND = "#EFEBE3"  # rigid
SOILS = ["#C9B18B", "#8C6D46", "#B5723A", "#BDBDBD", "#6B6B6B", "#E5D9C5"]


class Section:
    """The data of the section and the windows in which it is drawn."""

    def __init__(self, data):
        self.info = json.loads((data / "plot.json").read_text())
        columns = "x y x0 y0 displacement material strength_ratio size strength".split()
        self.points = dict(zip(columns, np.load(data / "final.npy").T))
        elements = np.load(data / "elements.npy")
        self.quads = elements[:, :8].reshape(-1, 4, 2)
        names = "r_u liquefied strength material sigma_v0".split()
        self.elements = dict(zip(names, elements[:, 8:].T))
        self.outline = np.load(data / "outline.npy")
        self.water = np.load(data / "water.npy").reshape(-1, 3)
        self.ground = np.array(self.info["ground"]).reshape(-1, 2)
        material = self.points["material"].astype(int)
        counts = np.array([m["counts"] for m in self.info["materials"]])
        self.liquefied = np.array([m["liquefied"] for m in self.info["materials"]])[material]
        self.failed = counts[material] & (self.points["displacement"] > self.info["moved_m"])
        self._choose_windows()

    def _choose_windows(self):
        p, failed = self.points, self.failed
        left, right = p["x0"].min(), p["x0"].max()
        top = max(p["y0"].max(), p["y"].max())
        height = top - p["y0"].min()
        if failed.any():
            left = max(left, p["x0"][failed].min() - height)
        flow_end = max(right, p["x"].max() + 0.3 * height)
        high = top + 0.28 * height
        self.ylim = (self._lowest() - 0.05 * height, high)
        self.dam_ylim = (p["y0"].min() - 0.05 * height, high)
        self.windows = [("Whole flow", (left, flow_end))]
        toe = self.info["toe_m"]
        if toe is not None and toe - 5 * height > left + 0.2 * (flow_end - left):
            self.windows.append(("Dam and runout", (toe - 5 * height, flow_end)))
        self.dam = (left if toe is None else max(left, toe - 5 * height), right)

    def _lowest(self):
        """Of the section, of the flow, and of the ground under it: a valley may fall."""
        p, ground = self.points, self.ground
        low = min(p["y0"].min(), p["y"].min())
        if len(ground) == 0:
            return low
        left, right = p["x"].min(), p["x"].max()
        between = ground[(ground[:, 0] > left) & (ground[:, 0] < right), 1]
        ends = np.interp([left, right], *ground.T)
        return min([low, *ends, *between])


def inches_high(xlim, ylim, bar):
    return (WIDTH - LEFT - RIGHT - bar) * (ylim[1] - ylim[0]) / (xlim[1] - xlim[0])


def stacked(windows, ylim, bar=0.0, footer=0.0, title=""):
    """A figure of panels with equal axes, exactly as high as they need; returns figure and axes."""
    heights = [inches_high(xlim, ylim, bar) for _, xlim in windows]
    total = sum(heights) + len(windows) * (TOP + GAP) - GAP + BOTTOM + footer
    figure = plt.figure(figsize=(WIDTH, total))
    axes, top = [], total
    for k, ((name, xlim), height) in enumerate(zip(windows, heights)):
        top -= TOP + height
        box = (LEFT / WIDTH, top / total, (WIDTH - LEFT - RIGHT - bar) / WIDTH, height / total)
        ax = figure.add_axes(box)
        letter = f"({'abcd'[k]}) " if len(windows) > 1 else ""
        ax.set(xlim=xlim, ylim=ylim, ylabel="y (m)", title=f"{letter}{name}{title}")
        ax.spines[["top", "right"]].set_visible(False)
        ax.locator_params(axis="y", nbins=4 if height < 1 else 6)
        axes.append(ax)
        top -= GAP
    axes[-1].set_xlabel("x (m)")
    return figure, axes


def colour_bar(figure, mappable, axes, label, **options):
    """One bar beside all panels."""
    low, high = axes[-1].get_position().y0, axes[0].get_position().y1
    middle, size = 0.5 * (low + high), min(high - low, 2.2 / figure.get_figheight())
    box = ((WIDTH - 0.72) / WIDTH, middle - 0.5 * size, 0.11 / WIDTH, size)
    bar = figure.colorbar(mappable, cax=figure.add_axes(box), label=label, **options)
    bar.outline.set_linewidth(0.4)
    fit_label(figure, bar.ax)
    return bar


def fit_label(figure, ax):
    """Breaks the label of the bar of a flat section, moves it, and makes it smaller if it must, so
    that the edge of the figure cuts nothing off."""
    label, renderer = ax.yaxis.label, figure.canvas.get_renderer()

    def overhang():
        """Of its lower, upper and right end [pixels]; the label gets its place with the ticks."""
        ax.yaxis.get_tightbbox(renderer)
        box = label.get_window_extent(renderer)
        return -box.y0, box.y1 - figure.bbox.y1, box.x1 - figure.bbox.x1

    below, above, _ = overhang()
    text = label.get_text()
    if below + above > 0 and " " in text:
        spaces = [k for k, character in enumerate(text) if character == " "]
        middle = min(spaces, key=lambda k: abs(k - len(text) / 2))
        label.set_text(text[:middle] + "\n" + text[middle + 1:])
    while sum(overhang()[:2]) > 0 or overhang()[2] > 0:
        if label.get_fontsize() <= 4:
            break
        label.set_fontsize(label.get_fontsize() - 0.5)
    below, above, _ = overhang()
    label.set_y(label.get_position()[1] + (max(below, 0) - max(above, 0)) / ax.bbox.height)


def draw_points(ax, section, chosen, **colour):
    """Squares as large as the material they stand for."""
    p = section.points
    inches = ax.get_position().width * WIDTH
    size = 1.25 * p["size"][chosen] * 72 * inches / np.diff(ax.get_xlim())[0]
    return ax.scatter(p["x"][chosen], p["y"][chosen], s=size**2, marker="s", linewidths=0,
                      rasterized=True, **colour)


def draw_ground(ax, section):
    """The rigid ground; it goes on level beyond its ends."""
    if len(section.ground) == 0:
        return
    (left, right), low = ax.get_xlim(), ax.get_ylim()[0]
    line = np.vstack([[min(left, section.ground[0, 0]), section.ground[0, 1]], section.ground,
                      [max(right, section.ground[-1, 0]), section.ground[-1, 1]]])
    ax.fill_between(line[:, 0], line[:, 1], low, color=GROUND, lw=0, zorder=0)
    ax.plot(*line.T, color="0.45", lw=0.6, zorder=0.5)


def draw_water(ax, section):
    """Surface of the water at rest, and the pond where it stands above or at the ground."""
    x, water, ground = section.water.T
    ax.plot(x, water, color=SKY, lw=1.4)
    pond = water > ground - 0.25
    if pond.any():  # the highest water, not a water table that comes out at the toe
        pond &= water > water[pond].max() - 1.0
    ax.fill_between(x, ground, water, where=water > ground, color=SKY, alpha=0.4, lw=0)
    shown = np.flatnonzero(pond & (x > ax.get_xlim()[0]) & (x < ax.get_xlim()[1]))
    if len(shown) > 2:
        k = shown[len(shown) // 2]
        ax.plot(x[k], water[k], marker=7, color=SKY, markersize=5, clip_on=False)
        ax.text(x[k], water[k], "    pond", color=INK, fontsize=7, va="bottom")


def draw_outline(ax, section, inside=True):
    """Section before the flow; material limits thinner than the surface."""
    for boundary, width in ((1, 0.8), (0, 0.5)):
        chosen = section.outline[section.outline[:, 4] == boundary, :4].reshape(-1, 2, 2)
        if boundary or inside:
            ax.add_collection(LineCollection(joined(chosen), colors=INK, linewidths=width))


def joined(segments):
    """Segments chained to polylines where exactly two of them meet (fewer, cleaner paths)."""
    ends = {}
    for k, (a, b) in enumerate(segments):
        ends.setdefault(tuple(a), []).append(k)
        ends.setdefault(tuple(b), []).append(k)
    used, lines = np.zeros(len(segments), bool), []

    def walk(point, k):
        line = [point]
        while k is not None:
            used[k] = True
            a, b = map(tuple, segments[k])
            point = b if point == a else a
            line.append(point)
            meeting = ends[point]
            k = next((m for m in meeting if not used[m]), None) if len(meeting) == 2 else None
        return line

    nodes = sorted(ends, key=lambda n: (len(ends[n]) == 2, n))
    for node in nodes:
        for k in ends[node]:
            if not used[k]:
                lines.append(walk(node, k))
    return lines


def annotate_runout(ax, section):
    toe, front, runout = (section.info[k] for k in ("toe_m", "front_m", "runout_m"))
    if toe is None:
        return
    low, high = section.ylim
    level, mark = (low + share * (high - low) for share in (0.66, 0.74))
    text = dict(fontsize=7.5, color=INK, va="bottom", y=level + 0.05 * (high - low))
    ax.plot([toe, toe], [low, mark], color=INK, lw=0.7, ls=(0, (4, 2)))
    if runout <= 0 or front > ax.get_xlim()[1]:
        ax.text(x=toe, s=f"toe, x = {toe:g} m ", ha="right", **text)
        return
    ax.plot([front, front], [low, mark], color=INK, lw=0.7)
    ax.annotate("", (front, level), (toe, level),
                arrowprops=dict(arrowstyle="<->", lw=0.8, color=INK, shrinkA=0, shrinkB=0))
    if runout > 0.25 * np.diff(ax.get_xlim())[0]:
        ax.text(x=0.5 * (toe + front), s=f"runout {runout:.1f} m", ha="center", **text)
        ax.text(x=toe, s=f"toe, x = {toe:g} m ", ha="right", **text)
    else:
        ax.text(x=toe, s=f"runout {runout:.1f} m ", ha="right", **text)


def final_displacement(section):
    figure, axes = stacked(section.windows, section.ylim, bar=0.85,
                           title=f", {section.info['time_s']:.4g} s after transfer")
    d = section.points["displacement"]
    moved = d > section.info["moved_m"]
    norm = Normalize(0, max(d.max(), section.info["moved_m"]))
    for ax in axes:
        draw_ground(ax, section)
        draw_points(ax, section, ~moved, color=STILL)
        shown = draw_points(ax, section, moved, c=d[moved], cmap="viridis", norm=norm)
        draw_outline(ax, section, inside=False)
        annotate_runout(ax, section)
    colour_bar(figure, shown, axes, "displacement (m)")
    axes[-1].text(1, 1.02, f"grey: moved less than {section.info['moved_m']:g} m; line: undeformed "
                  "section", transform=axes[-1].transAxes, ha="right", fontsize=7)
    return figure


def material_colours(info):
    names = info["materials"]
    layers = [k for k, m in enumerate(names) if m["liquefied"]]
    shades = plt.get_cmap("viridis")(np.linspace(0.08, 0.92, max(len(layers), 1)))
    soils = iter(SOILS * len(names))
    colours = {k: next(soils) for k in range(len(names)) if k not in layers}
    colours.update(zip(layers, shades))
    return [colours[k] for k in range(len(names))]


def final_materials(section):
    colours = material_colours(section.info)
    material = section.points["material"].astype(int)
    present = [k for k in range(len(colours)) if (material == k).any()]
    columns = min(4, len(present))
    rows = -(-len(present) // columns)
    figure, axes = stacked(section.windows, section.ylim, footer=0.18 * rows + 0.05)
    for ax in axes:
        draw_ground(ax, section)
        draw_points(ax, section, slice(None), color=to_rgba_array(colours)[material])
        draw_outline(ax, section, inside=False)
    handles = [Patch(color=colours[k], label=section.info["materials"][k]["name"])
               for k in present]
    figure.legend(handles=handles, loc="lower center", ncol=columns, handlelength=1.2,
                  borderpad=0.1)
    return figure


def final_strength(section):
    ratio = section.points["strength_ratio"]
    shown = section.liquefied & np.isfinite(ratio)
    if not shown.any():
        return None
    values, label, note = ratio, "strength / strength at transfer", "grey: not liquefied"
    norm = Normalize(min(0.9, np.floor(10 * ratio[shown].min()) / 10), 1)
    if ratio[shown].min() > 0.995:  # a scale from 0.99 to 1 would show one colour, or rounding
        values, label = section.points["strength"] / 1e3, "strength (kPa)"
        norm = Normalize(0, values[shown].max())
        note += "; nothing softened, so the strength itself is shown"
    figure, axes = stacked(section.windows, section.ylim, bar=0.85)
    for ax in axes:
        draw_ground(ax, section)
        draw_points(ax, section, ~shown, color=STILL)
        drawn = draw_points(ax, section, shown, c=values[shown], cmap="cividis", norm=norm)
        draw_outline(ax, section, inside=False)
    colour_bar(figure, drawn, axes, label)
    axes[-1].text(1, 1.02, note, transform=axes[-1].transAxes, ha="right", fontsize=7)
    return figure


def draw_elements(ax, section, values, **colour):
    faces = PolyCollection(section.quads, array=values, linewidths=0.2, edgecolors="face",
                           rasterized=True, **colour)
    ax.add_collection(faces)
    return faces


def section_before(section):
    e, info = section.elements, section.info
    panels = [("Liquefied zone and its strength", section.dam)]
    with_r_u = np.isfinite(e["r_u"]).any() and info["transfer_frame"] >= 0
    if with_r_u:
        panels.insert(0, ("Pore-pressure ratio at transfer, "
                          f"t = {info['transfer_time_s']:.4g} s", section.dam))
    strengths = np.unique(np.round(e["strength"][e["liquefied"] > 0] / 1e3, 2))
    tags, soils = np.unique(e["material"], return_inverse=True)
    names = {s["tag"]: s["name"] for s in info["soils"]}
    footer = 0.22 + 0.16 * (1 + len(tags) // 4)
    figure, axes = stacked(panels, section.dam_ylim, bar=0.85, footer=footer)
    greys = ListedColormap(["0.93", "0.84", "0.75", "0.88", "0.79"])
    bars = []
    for ax in axes:
        draw_ground(ax, section)
        draw_elements(ax, section, soils % greys.N, cmap=greys, clim=(-0.5, greys.N - 0.5))
        if with_r_u and ax is axes[0]:
            values = np.ma.masked_invalid(e["r_u"])
            bars.append((draw_elements(ax, section, values, cmap="viridis", clim=(0, 1)),
                         ax, "$r_u$", {"extend": "both"}))
        elif len(strengths):
            values = np.ma.masked_where(e["liquefied"] == 0, e["strength"] / 1e3)
            steps, options = Normalize(0.9 * strengths[0], 1.1 * strengths[-1]), {}
            if 1 < len(strengths) <= 12:
                middles = 0.5 * (strengths[1:] + strengths[:-1])
                steps = BoundaryNorm([2 * strengths[0] - middles[0], *middles,
                                      2 * strengths[-1] - middles[-1]], 256)
                options = {"ticks": strengths, "spacing": "uniform", "format": "%g"}
            drawn = draw_elements(ax, section, values, cmap="cividis", norm=steps)
            bars.append((drawn, ax, "$S_r$ (kPa)", options))
        draw_outline(ax, section)
        draw_water(ax, section)
        if info["lower_boundary"]:
            ax.plot(*np.array(info["lower_boundary"]).T, color=RED, lw=1.4)
    for drawn, ax, label, options in bars:
        colour_bar(figure, drawn, [ax], label, **options)
    handles = [Line2D([], [], color=SKY, lw=1.4, label="water table at rest"),
               Line2D([], [], color=RED, lw=1.4, label="lower boundary of the liquefied zone"),
               Line2D([], [], color=INK, lw=0.8, label="section and material limits")]
    handles += [Patch(color=greys(k % greys.N), label=names.get(int(tag), f"soil {tag:g}"))
                for k, tag in enumerate(tags)]
    figure.legend(handles=handles, loc="lower center", ncol=3, borderpad=0.1)
    return figure

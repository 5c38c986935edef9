"""The figures of docs/results/mochikoshi.md."""
import math

import claims
import drawing
import study_rows

# Depth, runout at c_soft 0.5 [m]
PAPER_RUNS = [("Loma Prieta 0.3 g", 5, 0), ("Ridgecrest 0.3 g", 16, 90),
              ("Ridgecrest 0.4 g", 23, 220), ("Landers 0.3 g", 23, 220),
              ("Hector Mine 0.3 g", 26, 220)]


def upper(values, least=1.0):
    return 1.08 * max([*values, least])


def depth_figure(study):
    rows, scatter = study.shakings(), study.scatter(claims.DEPTH)
    panels = []
    measures = [("pga [g]", "PGA, g", 1), ("motion_pgv_m_s", "PGV, cm/s", 100),
                ("motion_masi_m_s", "MASI, m/s", 1)]
    for i, (name, label, factor) in enumerate(measures):
        x = [factor * r[name] for r in rows]
        rho, low, high = study_rows.interval(rows, lambda some, name=name: study_rows.spearman(
            [r[name] for r in some], [r["depth"] for r in some])) if rows else (math.nan,) * 3
        title = f"rank correlation {rho:.2f} ({low:.2f} to {high:.2f})" if rows else ""
        panel = drawing.Panel(i, (0, upper(x, 0.1)), (0, 32), label, "depth, m", title)
        for r, at in zip(rows, x):
            panel.dot(at, r["depth"], drawing.COLOURS[0], f"{r['motion']} {r['pga [g]']:g} g: "
                      f"{r['depth']:.3g} m")
        panel.scatter_bar(scatter)
        panels.append(panel)
    return drawing.svg(panels, "Depth against PGA, PGV and MASI")


def runout_depth_figure(study):
    rows = study.flows(c_soft=0.5)
    top = upper([r["runout"] for r in rows] + [220])
    panel = drawing.Panel(0, (0, 32), (0, top), "depth of liquefaction, m", "runout, m")
    for r in rows:
        panel.dot(r["depth"], r["runout"], drawing.COLOURS[0],
                  f"{r['motion']} {r['pga [g]']:g} g: {r['runout']:.3g} m")
    for name, depth, runout in PAPER_RUNS:
        panel.diamond(depth, runout, f"paper, {name}: {runout} m")
    panel.scatter_bar(study.scatter("runout_m"))
    return drawing.svg([panel], "Runout against depth")


def c_soft_figure(study):
    rows, static = study.flows(pga=0.3), study.flows(variant="static")
    panel = drawing.Panel(0, (0.15, 1.1), (0, upper([r["runout"] for r in rows + static])),
                          "c_soft / residual strength", "runout, m")
    for some, colour, shift in ((rows, 0, 0.0), (static, 1, 0.02)):
        for r in some:
            panel.dot(r["c_soft"] + shift, r["runout"], drawing.COLOURS[colour],
                      f"{r['motion'] or 'static'}: {r['runout']:.3g} m")
    panel.legend(["dynamic, 0.3 g", "static"])
    panel.scatter_bar(study.scatter("runout_m"))
    return drawing.svg([panel], "Runout against c_soft")


def static_figure(study):
    points = []
    for r in study.flows(variant="static"):
        for d in claims.deep(study, 18, r["c_soft"]):
            if d["runout"] > claims.NONE:
                name = f"{d['motion']} {d['pga [g]']:g} g"
                points.append((r["c_soft"], r["runout"] / d["runout"], name))
    panel = drawing.Panel(0, (0.15, 1.1), (0, upper([p[1] for p in points])),
                          "c_soft / residual strength", "static over dynamic runout")
    for ratio in (0.80, 0.85):
        panel.line(panel.x(0.15), panel.y(ratio), panel.x(1.1), panel.y(ratio), "e")
    for c, ratio, name in points:
        panel.dot(c, ratio, drawing.COLOURS[1], f"{name}: {ratio:.2f}")
    return drawing.svg([panel], "Static over dynamic runout")


FIGURES = {
    "depth.svg": (depth_figure, "Depth of liquefaction under the pond against PGA, PGV and MASI; "
                  "one point per motion and peak."),
    "runout-depth.svg": (runout_depth_figure, "Runout against depth of liquefaction, c_soft 0.5. "
                         "Diamonds: what the paper states of five runs."),
    "runout-c_soft.svg": (c_soft_figure, "Runout against c_soft, motions at 0.3 g, and the static "
                          "model; means of the repeats."),
    "static-dynamic.svg": (static_figure, "Static model over each dynamic run deeper than 18 m "
                           "that runs out, by c_soft. Between the lines: the paper's mean."),
}

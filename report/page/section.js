/* The section as it was handed over: elements coloured by what liquefied, and how far. */

class Section {
  constructor({ run, array, frames }) {
    this.run = run;
    const get = (name) => array(`mesh.${name}`)?.values;
    [this.x, this.y, this.material, this.liquefied] = ["x", "y", "material", "liquefied"].map(get);
    const corners = array("mesh.corners");
    this.count = corners.columns;
    this.corners = [0, 1, 2, 3].map((c) =>
      corners.values.subarray(c * this.count, (c + 1) * this.count),
    );
    this.fields = this.findFields(get);
    this.mode = Object.keys(this.fields)[0];
    this.picked = -1;
    this.view = new View({
      run,
      windows: frames.dam,
      range: frames.damRange,
      label: "Elements of the section before the flow. Plus and minus zoom.",
      paint: (view, c) => this.paint(view, c),
      find: (view, x, y) => this.find(x, y),
    });
    this.key = make("div", { class: "keyrow" }, this.colourKey());
    this.element = make(
      "div",
      {},
      make(
        "div",
        { class: "row" },
        choice("Colour of the elements", Object.keys(this.fields), this.mode, (mode) => {
          this.mode = mode;
          this.key.replaceChildren(this.colourKey());
          this.view.redraw();
        }),
        this.view.controls(),
      ),
      this.key,
      this.view.plot,
      this.lines(),
    );
  }

  findFields(get) {
    const fields = {},
      scaled = (values, factor) => values && values.map((v) => v * factor);
    const top = (values) => extent(values)[1];
    const add = (name, values, low, high, scale, label, unit) => {
      if (values) fields[name] = { values, low, high, scale, label, unit };
    };
    add("pore pressure", get("r_u"), 0, 1, "viridis", "r_u at transfer", "");
    const strain = scaled(get("strain"), 100);
    if (strain)
      add(
        "shear strain",
        strain,
        0,
        Math.max(1, quantile(strain, 0.99)),
        "plasma",
        "shear strain at transfer",
        "%",
      );
    const strength = scaled(get("strength"), 1e-3);
    if (strength.some(isFinite)) {
      const [low, high] = extent(strength);
      add("residual strength", strength, high > low ? low : 0, high || 1, "cividis", "S_r", "kPa");
    }
    const sigma = scaled(get("sigma_v0"), 1e-3);
    add(
      "vertical stress",
      sigma,
      0,
      top(sigma),
      "viridis",
      "initial effective vertical stress",
      "kPa",
    );
    fields.soils = null;
    return fields;
  }

  soilColours() {
    const tags = [...new Set(this.material)].sort((a, b) => a - b);
    return new Map(
      tags.map((tag, k) => [
        tag,
        {
          colour: cssOf(SOILS[k % SOILS.length]),
          name: this.run.soils.find((s) => s.tag === tag)?.name || `soil ${tag}`,
        },
      ]),
    );
  }

  colourKey() {
    const field = this.fields[this.mode];
    if (!field) return colourKey({ list: [...this.soilColours().values()] });
    return colourKey({
      label: field.label,
      low: number(field.low),
      high: number(field.high, field.unit),
      gradient: gradientOf(field.scale),
      note: "grey: not defined there",
    });
  }

  lines() {
    const entry = (colour, text, wide) => {
      const line = draw(
        "svg",
        { width: 22, height: 8 },
        draw("line", {
          x1: 1,
          x2: 21,
          y1: 4,
          y2: 4,
          stroke: `var(--${colour})`,
          "stroke-width": wide,
        }),
      );
      return make("span", { class: "entry" }, line, text);
    };
    return make(
      "p",
      { class: "note" },
      entry("sky", "water at rest, with the pond where it stands above the ground", 2),
      entry("red", "lower boundary of what liquefied", 2),
      entry("ink", "limits of section and soils", 1),
    );
  }

  quad(view, e) {
    const c = view.context;
    c.beginPath();
    this.corners.forEach((corner, k) => {
      const n = corner[e];
      c[k ? "lineTo" : "moveTo"](view.px(this.x[n]), view.py(this.y[n]));
    });
    c.closePath();
  }

  paint(view, c) {
    const field = this.fields[this.mode],
      soils = this.soilColours();
    const still = cssVariable("--still"),
      stops = field && stopsOf(field.scale);
    c.lineWidth = 0.6;
    for (let e = 0; e < this.count; ++e) {
      this.quad(view, e);
      const value = field?.values[e];
      c.fillStyle = c.strokeStyle = !field
        ? soils.get(this.material[e]).colour
        : isFinite(value)
          ? cssOf(mixed(stops, (value - field.low) / (field.high - field.low)))
          : still;
      c.fill();
      c.stroke();
    }
    this.paintPond(view, c);
    view.drawOutline(true);
    const { run } = this,
      sky = cssVariable("--sky");
    view.line(
      run.water.map(([x, y]) => [x, y]),
      { colour: sky, width: 2 },
    );
    view.line(run.lower_boundary, { colour: cssVariable("--red"), width: 1.8 });
    if (run.toe_m !== null) view.upright(run.toe_m, "toe", cssVariable("--ink"), 0);
    if (this.picked < 0) return;
    this.quad(view, this.picked);
    c.strokeStyle = cssVariable("--ink");
    c.lineWidth = 2;
    c.stroke();
  }

  /** Water above the ground; where it stands level with the ground, only its mark. */
  paintPond(view, c) {
    const pond = this.run.water.filter(([, y, ground]) => y !== null && y > ground - 0.25);
    if (!pond.length) return;
    c.fillStyle = cssVariable("--sky");
    c.globalAlpha = 0.45;
    const half = Math.abs(this.run.water[1][0] - this.run.water[0][0]) / 2;
    for (const [x, y, ground] of pond)
      if (y > ground)
        c.fillRect(
          view.px(x - half),
          view.py(y),
          2 * half * view.sx + 0.5,
          view.py(ground) - view.py(y),
        );
    c.globalAlpha = 1;
    // The highest water is the pond, not a water table that comes out at the toe.
    const level = Math.max(...pond.map(([, y]) => y));
    const inside = pond.filter(
      ([x, y]) => y > level - 1 && view.px(x) > VIEW.left && view.px(x) < VIEW.left + view.wide,
    );
    if (inside.length < 3) return;
    const [x, y] = inside[inside.length >> 1],
      px = view.px(x),
      py = view.py(y);
    c.beginPath();
    c.moveTo(px - 6, py - 10);
    c.lineTo(px + 6, py - 10);
    c.lineTo(px, py - 1);
    c.closePath();
    c.fill();
    c.font = `11px ${cssVariable("--sans")}`;
    c.fillStyle = cssVariable("--ink");
    c.textAlign = "left";
    c.fillText("pond", px + 10, py - 3);
  }

  find(x, y) {
    this.picked = -1;
    if (!isFinite(x)) return null;
    const inside = (e) => {
      let within = false;
      for (let k = 0, j = 3; k < 4; j = k++) {
        const a = this.corners[k][e],
          b = this.corners[j][e];
        if (
          this.y[a] > y !== this.y[b] > y &&
          x < ((this.x[b] - this.x[a]) * (y - this.y[a])) / (this.y[b] - this.y[a]) + this.x[a]
        )
          within = !within;
      }
      return within;
    };
    for (let e = 0; e < this.count; ++e)
      if (inside(e)) {
        this.picked = e;
        const rows = Object.values(this.fields)
          .filter(Boolean)
          .map((f) => [f.label, number(f.values[e], f.unit)]);
        rows.push(["x, y", `${number(x)}, ${number(y, "m")}`]);
        return {
          head: `${this.soilColours().get(this.material[e]).name}, ${this.liquefied[e] ? "liquefied" : "not liquefied"}`,
          rows,
        };
      }
    return null;
  }
}

function quantile(values, share) {
  const sorted = values.filter(isFinite).sort();
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 0;
}

/* Histories and spectra of all runs over one another: one curve per run, those that were chosen in
   front. Runs that share a shaking share its curves. */

const PLOT = { left: 58, right: 14, top: 8, bottom: 44 };

class Strands {
  /** curves: the JSON of study/page/curves.hpp; array(name): the ordinates of a chart. */
  constructor({ rows, curves, array, by }) {
    Object.assign(this, { rows, curves, array, at: null, chosen: new Set() });
    this.chart = curves.charts[0];
    this.column = by ? rows.find(by) : null;
    this.svg = draw("svg", { class: "chart strands", tabindex: 0, role: "group" });
    this.tip = make("div", { class: "tip", role: "status", hidden: true });
    this.plot = make("div", { class: "plot" }, this.svg, this.tip);
    this.list = make("p", { class: "picked" });
    this.note = make("p", { class: "note" });
    this.element = make("div", {}, this.choices(), this.plot, this.list, this.note);
    this.listen();
    onWidth(this.plot, () => this.render());
    this.show(this.chart.name);
  }

  choices() {
    const select = (label, options, chosen, action) => {
      const box = make("select", { onchange: () => action(box.value) });
      for (const [value, text] of options)
        box.append(make("option", { value, selected: value === chosen }, text));
      return make("label", { class: "choose" }, make("span", {}, label), box);
    };
    const charts = this.curves.charts.map((c) => [c.name, c.title]);
    const colours = this.rows.colouring.map((c) => [c.name, titleOf(c)]);
    return make(
      "div",
      { class: "row choices" },
      select("show", charts, this.chart.name, (name) => this.show(name)),
      select("colour", [["", "one colour"], ...colours], this.column?.name ?? "", (name) => {
        this.column = name ? this.rows.find(name) : null;
        this.show(this.chart.name);
      }),
      make(
        "span",
        { class: "buttons" },
        ...saveButtons(
          () => this.chart.title,
          () => {
            this.pointAt(null);
            return this.svg;
          },
        ),
      ),
    );
  }

  show(name) {
    this.chart = this.curves.charts.find((c) => c.name === name);
    const { columns, values } = this.array(name),
      { from, to, of, x } = this.chart;
    this.strands = from.map((start, k) => ({
      rows: of.flatMap((curve, row) => (curve === k ? [row] : [])),
      y: values.subarray(k * columns, (k + 1) * columns),
      x: Array.from({ length: columns }, (_, i) => {
        const share = i / (columns - 1);
        return x.log ? start * (to[k] / start) ** share : start + share * (to[k] - start);
      }),
    }));
    for (const s of this.strands) s.value = this.valueOf(s.rows);
    this.shades = new Shades(this.rows, this.column, this.strands);
    const without = of.filter((k) => k < 0).length;
    this.without = without ? ` ${without} of ${of.length} rows have none.` : "";
    this.svg.setAttribute(
      "aria-label",
      `${this.chart.title}, ${this.strands.length} curves. Arrow keys go from curve to curve, ` +
        "Enter chooses one, Escape lets all go.",
    );
    this.pointAt(null);
    this.tellChosen();
    this.render();
  }

  /** Of rows that do not agree in the colour's column there is no value. */
  valueOf(rows) {
    if (!this.column) return NaN;
    const values = new Set(rows.map((row) => this.rows.value(this.column, row)));
    return values.size === 1 ? [...values][0] : NaN;
  }

  isOn(strand) {
    return !this.chosen.size || strand.rows.some((row) => this.chosen.has(row));
  }

  toggle(rows) {
    const all = rows.every((row) => this.chosen.has(row));
    for (const row of rows) all ? this.chosen.delete(row) : this.chosen.add(row);
    this.tellChosen();
    this.render();
  }

  letGo() {
    this.chosen.clear();
    this.tellChosen();
    this.render();
  }

  scale(value, log, [low, high]) {
    const f = log ? Math.log10 : (v) => v;
    return (f(value) - f(low)) / (f(high) - f(low) || 1);
  }
  px(v) {
    return PLOT.left + this.scale(v, this.chart.x.log, this.across) * this.wide;
  }
  py(v) {
    const share = this.scale(v, this.chart.y.log, this.upward);
    return this.top + (this.chart.y.invert ? share : 1 - share) * this.high;
  }

  findRanges() {
    const { y } = this.chart;
    this.across = extent(this.strands.flatMap((s) => [s.x[0], s.x[s.x.length - 1]]));
    const all = this.strands.map((s) => extent([...s.y].filter((v) => isFinite(v) && (!y.log || v > 0))));
    const [low, high] = extent(all.flat()),
      room = 0.04 * (high - low || 1);
    this.upward = y.log
      ? [low / 1.3, high * 1.3]
      : [low < 0 ? low - room : 0, high > 0 ? high + room : 0.1];
  }

  render() {
    const width = this.plot.clientWidth;
    if (width < 120 || !this.strands) return;
    this.findRanges();
    this.wide = width - PLOT.left - PLOT.right;
    const key = this.shades.key(this.wide);
    this.top = PLOT.top + key.height;
    this.high = Math.min(Math.max(0.36 * width, 230), 400);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.top + this.high + PLOT.bottom}`);
    const ordered = [...this.strands].sort((a, b) => this.isOn(a) - this.isOn(b));
    this.mark = draw("g");
    this.svg.replaceChildren(
      draw("g", { transform: `translate(${PLOT.left} 0)` }, ...key.parts),
      ...this.axes(),
      ...ordered.map((s) =>
        draw("path", {
          class: this.isOn(s) ? "strand" : "strand off",
          d: this.path(s),
          stroke: this.isOn(s) ? this.shades.of(s.value) : "var(--still)",
        }),
      ),
      this.mark,
    );
    this.tip.hidden = true;
  }

  path(s) {
    let d = "";
    s.x.forEach((x, i) => {
      if (isFinite(s.y[i])) d += `${d ? "L" : "M"}${this.px(x).toFixed(1)} ${this.py(s.y[i]).toFixed(1)}`;
    });
    return d;
  }

  axes() {
    const { x, y } = this.chart,
      bottom = this.top + this.high,
      out = [];
    const places = (axis, range, count) => (axis.log ? decadesIn(range) : ticks(...range, count));
    const put = (text, attributes) => out.push(draw("text", attributes, text));
    const xs = places(x, this.across, Math.max(3, this.wide / 80)),
      ys = places(y, this.upward, 6);
    const words = (v, axis, list) =>
      axis.log ? String(+v.toPrecision(1)) : tickText(v, list[1] - list[0] || 1);
    for (const v of xs) {
      const at = this.px(v);
      out.push(draw("line", { class: "grid", x1: at, x2: at, y1: this.top, y2: bottom }));
      put(words(v, x, xs), { class: "tick", x: at, y: bottom + 15, "text-anchor": "middle" });
    }
    for (const v of ys) {
      const at = this.py(v),
        right = PLOT.left + this.wide;
      out.push(draw("line", { class: "grid", x1: PLOT.left, x2: right, y1: at, y2: at }));
      put(words(v, y, ys), { class: "tick", x: PLOT.left - 6, y: at + 3.5, "text-anchor": "end" });
    }
    const middle = PLOT.left + this.wide / 2;
    put(titleOf(x), { class: "label", x: middle, y: bottom + 35, "text-anchor": "middle" });
    const turned = `translate(12 ${this.top + this.high / 2}) rotate(-90)`;
    put(titleOf(y), { class: "label", "text-anchor": "middle", transform: turned });
    return out;
  }
}

/** 1, 2 and 5 of each power of ten in a range. */
function decadesIn([low, high]) {
  const list = [];
  for (let p = Math.floor(Math.log10(low)); p <= Math.log10(high); ++p)
    for (const m of [1, 2, 5]) {
      const v = m * 10 ** p;
      if (v >= 0.999 * low && v <= 1.001 * high) list.push(v);
    }
  return list;
}

/* Line charts in SVG: read values by pointer or arrow keys, zoom by dragging or + and -. */

const CHART = { left: 56, right: 14, top: 10, bottom: 38, height: 230 };
const groups = new Map(); // charts that share an abscissa, by its name

class Chart {
  /** axes: {label, unit, log, invert, zero, span}; series: {name, x, y, colour, dash, hidden}. */
  constructor({ title, x, y, series, marks = [], note = "", group = "", pick = null }) {
    Object.assign(this, { title, x, y, marks, pick, group });
    this.series = series.filter((s) => s.y && s.y.length > 1);
    if (!groups.has(group)) groups.set(group, []);
    if (group) groups.get(group).push(this);
    const [low, high] = extent(this.series.flatMap((s) => [s.x[0], s.x[s.x.length - 1]]));
    this.full = this.range = [x.from ?? low, high];
    this.time = NaN;
    this.svg = draw("svg", {
      class: "chart",
      tabindex: 0,
      role: "img",
      "aria-label": `${title}: ${this.series.map((s) => s.name).join(", ")}. Arrow keys read values.`,
    });
    this.tip = make("div", { class: "tip", role: "status" });
    this.plot = make("div", { class: "plot" }, this.svg, this.tip);
    this.element = make(
      "figure",
      { class: "panel" },
      make("figcaption", {}, make("b", {}, title), this.buttons()),
      this.legend(),
      this.plot,
      ...(note ? [make("p", { class: "note" }, note)] : []),
    );
    this.listen();
    onWidth(this.plot, () => this.render());
    new IntersectionObserver(() => this.stale && this.render()).observe(this.plot);
  }

  buttons() {
    const button = (text, help, action) =>
      make("button", { type: "button", title: help, "aria-label": help, onclick: action }, text);
    return make(
      "span",
      { class: "buttons" },
      (this.reset = button("whole", "Show the whole range again", () => this.zoom(...this.full))),
      ...saveButtons(
        () => this.title,
        () => this.svg,
      ),
    );
  }

  legend() {
    const items = this.series.map((s) => {
      const key = draw(
        "svg",
        { width: 22, height: 8, "aria-hidden": "true" },
        draw("line", {
          x1: 1,
          x2: 21,
          y1: 4,
          y2: 4,
          class: "line",
          stroke: s.colour,
          "stroke-dasharray": s.dash || "none",
        }),
      );
      const item = make(
        "button",
        {
          type: "button",
          class: "key",
          "aria-pressed": String(!s.hidden),
          onclick: () => {
            s.hidden = !s.hidden;
            item.setAttribute("aria-pressed", String(!s.hidden));
            this.render();
          },
        },
        key,
        s.name,
      );
      return item;
    });
    return make("div", { class: "legend" }, ...items);
  }

  scaleX(value) {
    const f = this.x.log ? Math.log10 : (v) => v;
    const [a, b] = this.range.map(f);
    return CHART.left + ((f(value) - a) / (b - a || 1)) * this.wide;
  }
  valueX(pixel) {
    const share = (pixel - CHART.left) / this.wide,
      [a, b] = this.range;
    return this.x.log ? a * (b / a) ** share : a + share * (b - a);
  }
  scaleY(value) {
    const f = this.y.log ? Math.log10 : (v) => v;
    const [a, b] = this.rangeY.map(f);
    const share = (f(value) - a) / (b - a || 1);
    return CHART.top + (this.y.invert ? share : 1 - share) * this.high;
  }

  findRangeY() {
    let low = Infinity,
      high = -Infinity;
    for (const s of this.series) {
      if (s.hidden) continue;
      for (let i = 0; i < s.x.length; ++i)
        if (s.x[i] >= this.range[0] && s.x[i] <= this.range[1] && isFinite(s.y[i])) {
          low = Math.min(low, s.y[i]);
          high = Math.max(high, s.y[i]);
        }
    }
    if (!(low <= high)) [low, high] = [0, 1];
    if (this.y.log) return [low / 1.3, high * 1.3];
    if (this.y.zero) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
    const span = Math.max(high - low, this.y.span || 1e-12),
      spare = 0.06 * span;
    if (high - low < span) high = low + span;
    return [
      this.y.zero && low === 0 ? 0 : low - spare,
      this.y.zero && high === 0 ? 0 : high + spare,
    ];
  }

  axes() {
    const out = [],
      { left, top } = CHART,
      bottom = top + this.high,
      right = left + this.wide;
    const text = (content, attributes) => draw("text", attributes, content);
    const decades = ([a, b]) => {
      const list = [];
      for (let p = Math.floor(Math.log10(a)); p <= Math.log10(b) + 1; ++p)
        for (const m of [1, 2, 5])
          if (m * 10 ** p >= a * 0.999 && m * 10 ** p <= b * 1.001) list.push(m * 10 ** p);
      return list;
    };
    const xs = this.x.log ? decades(this.range) : ticks(...this.range, Math.max(3, this.wide / 80));
    const ys = this.y.log ? decades(this.rangeY) : ticks(...this.rangeY, 5);
    for (const v of xs) {
      const at = this.scaleX(v);
      out.push(draw("line", { class: "grid", x1: at, x2: at, y1: top, y2: bottom }));
      out.push(
        text(this.x.log ? String(+v.toPrecision(1)) : tickText(v, xs[1] - xs[0] || 1), {
          class: "tick",
          x: at,
          y: bottom + 15,
          "text-anchor": "middle",
        }),
      );
    }
    for (const v of ys) {
      const at = this.scaleY(v);
      out.push(
        draw("line", { class: v === 0 ? "zero" : "grid", x1: left, x2: right, y1: at, y2: at }),
      );
      out.push(
        text(this.y.log ? String(+v.toPrecision(1)) : tickText(v, ys[1] - ys[0] || 1), {
          class: "tick",
          x: left - 6,
          y: at + 3.5,
          "text-anchor": "end",
        }),
      );
    }
    out.push(draw("path", { class: "axis", d: `M${left} ${top}V${bottom}H${right}` }));
    out.push(
      text(`${this.x.label}${this.x.unit ? ` (${this.x.unit})` : ""}`, {
        class: "label",
        x: left + this.wide / 2,
        y: bottom + 32,
        "text-anchor": "middle",
      }),
    );
    out.push(
      text(`${this.y.label}${this.y.unit ? ` (${this.y.unit})` : ""}`, {
        class: "label",
        x: 0,
        y: 0,
        "text-anchor": "middle",
        transform: `translate(12 ${top + this.high / 2}) rotate(-90)`,
      }),
    );
    return out;
  }

  /** Highest and lowest value of each column of pixels: nothing that shows is left out. */
  path(s) {
    let d = "",
      open = false,
      column = -1,
      low = 0,
      high = 0,
      last = 0;
    const flush = () => {
      if (column < 0) return;
      d += `${open ? "L" : "M"}${column} ${low.toFixed(1)}`;
      if (high !== low) d += `V${high.toFixed(1)}`;
      if (last !== high) d += `V${last.toFixed(1)}`;
      open = true;
    };
    const dense = s.x.length > 2 * this.wide;
    for (let i = 0; i < s.x.length; ++i) {
      if (!isFinite(s.y[i])) {
        flush();
        column = -1;
        open = false;
        continue;
      }
      const px = this.scaleX(s.x[i]),
        py = this.scaleY(s.y[i]);
      if (!dense) {
        d += `${open ? "L" : "M"}${px.toFixed(1)} ${py.toFixed(1)}`;
        open = true;
        continue;
      }
      const at = Math.round(px);
      if (at !== column) {
        flush();
        column = at;
        low = high = py;
      }
      low = Math.min(low, py);
      high = Math.max(high, py);
      last = py;
    }
    if (dense) flush();
    return d;
  }

  render() {
    const width = this.plot.clientWidth;
    if (width < 40) return;
    this.stale = false;
    this.wide = width - CHART.left - CHART.right;
    this.high = CHART.height - CHART.top - CHART.bottom;
    this.rangeY = this.findRangeY();
    const id = `clip${(Chart.count = (Chart.count || 0) + 1)}`;
    const box = { x: CHART.left, y: CHART.top - 2, width: this.wide, height: this.high + 4 };
    const lines = draw("g", { "clip-path": `url(#${id})` });
    for (const mark of this.marks) {
      const at = this.scaleX(mark.x),
        late = at > CHART.left + this.wide - 60;
      lines.append(
        draw("line", { class: "mark", x1: at, x2: at, y1: CHART.top, y2: CHART.top + this.high }),
        draw(
          "text",
          {
            class: "marktext",
            x: at + (late ? -4 : 4),
            y: CHART.top + 10,
            "text-anchor": late ? "end" : "start",
          },
          mark.text,
        ),
      );
    }
    for (const s of this.series)
      if (!s.hidden)
        lines.append(
          draw("path", {
            class: "line",
            d: this.path(s),
            stroke: s.colour,
            "stroke-dasharray": s.dash || "none",
          }),
        );
    this.now = draw("line", { class: "now", y1: CHART.top, y2: CHART.top + this.high });
    this.cursor = draw("g", { class: "cursor" });
    this.brush = draw("rect", { class: "brush", y: CHART.top, height: this.high, width: 0 });
    lines.append(this.now, this.brush);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${CHART.height}`);
    this.svg.replaceChildren(
      draw("clipPath", { id }, draw("rect", box)),
      ...this.axes(),
      lines,
      this.cursor,
    );
    this.reset.hidden = this.range === this.full;
    this.showTime(this.time);
  }

  /** Draws again when the page is drawn next, if it can be seen. */
  refresh() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      const box = this.plot.getBoundingClientRect();
      if (box.bottom > 0 && box.top < innerHeight) this.render();
      else this.stale = true;
    });
  }

  zoom(low, high) {
    const smallest = 1e-4 * (this.full[1] - this.full[0]);
    if (high - low < smallest) return;
    const range =
      low <= this.full[0] && high >= this.full[1]
        ? this.full
        : [Math.max(low, this.full[0]), Math.min(high, this.full[1])];
    for (const chart of this.group ? groups.get(this.group) : [this]) {
      chart.range = range === this.full ? chart.full : range;
      chart.render();
    }
  }

  /** The instant that the player shows. */
  showTime(time) {
    this.time = time;
    if (!this.now) return;
    const at = this.scaleX(time),
      inside = time >= this.range[0] && time <= this.range[1];
    this.now.setAttribute("x1", inside ? at : -9);
    this.now.setAttribute("x2", inside ? at : -9);
  }

  point(at, own) {
    if (!this.cursor) return;
    const shown = at >= this.range[0] && at <= this.range[1];
    this.cursor.replaceChildren();
    this.tip.hidden = !(own && shown);
    if (!shown) return;
    const px = this.scaleX(at),
      rows = [];
    this.cursor.append(draw("line", { x1: px, x2: px, y1: CHART.top, y2: CHART.top + this.high }));
    for (const s of this.series) {
      if (s.hidden || at < s.x[0] || at > s.x[s.x.length - 1]) continue;
      const value = interpolated(s.x, s.y, at);
      if (!isFinite(value)) continue;
      this.cursor.append(draw("circle", { cx: px, cy: this.scaleY(value), r: 3, fill: s.colour }));
      const dot = draw(
        "svg",
        { width: 10, height: 10 },
        draw("circle", { cx: 5, cy: 5, r: 4, fill: s.colour }),
      );
      rows.push(
        make("div", {}, dot, make("span", {}, s.name), make("b", {}, number(value, this.y.unit))),
      );
    }
    this.at = at;
    if (!own) return;
    this.tip.replaceChildren(make("div", { class: "head" }, number(at, this.x.unit)), ...rows);
    putTip(this.tip, this.plot.clientWidth, px);
  }
  pointAll(at) {
    for (const chart of this.group ? groups.get(this.group) : [this])
      chart.point(at, chart === this);
  }
  leave() {
    for (const chart of this.group ? groups.get(this.group) : [this]) {
      chart.cursor?.replaceChildren();
      chart.tip.hidden = true;
    }
  }

  listen() {
    let from = null;
    const place = (event) => placeIn(this.svg, event)[0];
    this.tip.hidden = true;
    this.svg.addEventListener("pointerdown", (event) => {
      if (event.pointerType === "mouse" && event.button === 0) from = place(event);
    });
    this.svg.addEventListener("pointermove", (event) => {
      const at = place(event);
      this.pointAll(this.valueX(at));
      if (from === null || Math.abs(at - from) < 4) return;
      this.brush.setAttribute("x", Math.min(from, at));
      this.brush.setAttribute("width", Math.abs(at - from));
    });
    window.addEventListener("pointerup", (event) => {
      if (from === null) return;
      const start = from,
        at = place(event);
      from = null;
      this.brush.setAttribute("width", 0);
      if (Math.abs(at - start) >= 8)
        this.zoom(...[this.valueX(start), this.valueX(at)].sort((a, b) => a - b));
      else if (this.pick && event.target instanceof Node && this.svg.contains(event.target))
        this.pick(this.valueX(at));
    });
    this.svg.addEventListener("pointerleave", () => this.leave());
    this.svg.addEventListener("blur", () => this.leave());
    this.svg.addEventListener("dblclick", () => this.zoom(...this.full));
    this.svg.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const [low, high] = this.range,
      middle = this.at ?? (low + high) / 2;
    const moves = { ArrowLeft: -1, ArrowRight: 1 };
    if (event.key in moves) {
      const pixel = this.scaleX(middle) + moves[event.key] * (event.shiftKey ? 40 : 6);
      this.pointAll(Math.min(Math.max(this.valueX(pixel), low), high));
    } else if (event.key === "+" || event.key === "=")
      this.zoom(middle - (middle - low) / 1.5, middle + (high - middle) / 1.5);
    else if (event.key === "-")
      this.zoom(middle - (middle - low) * 1.5, middle + (high - middle) * 1.5);
    else if (event.key === "0" || event.key === "Escape") this.zoom(...this.full);
    else if (event.key === "Enter" && this.pick) this.pick(middle);
    else return;
    event.preventDefault();
  }
}

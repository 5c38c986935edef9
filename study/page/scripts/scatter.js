/* A chart of points in SVG that can be zoomed into, and whose points can be pointed at. */

const SPACE = { left: 62, right: 16, top: 10, bottom: 46 };

class Scatter {
  /** onPoint(point or null): one is pointed at; onPick(point, side): it is to be opened. */
  constructor({ onPoint, onPick }) {
    Object.assign(this, { onPoint, onPick, points: [], at: null, opened: {} });
    this.svg = draw("svg", { class: "chart", tabindex: 0, role: "group" });
    this.tip = make("div", { class: "tip", role: "status", hidden: true });
    this.plot = make("div", { class: "plot scatter" }, this.svg, this.tip);
    onWidth(this.plot, () => this.render());
  }

  /** x and y: columns. tell(point): what stands in the tip, as {head, rows}. */
  show({ points, x, y, shades, tell }) {
    Object.assign(this, { points, x, y, shades, tell, at: null });
    this.full = this.range = [
      this.around(points, (p) => [p.x, p.aside]),
      this.around(points, (p) => [p.y, p.above]),
    ];
    this.svg.setAttribute(
      "aria-label",
      `${titleOf(y)} against ${titleOf(x)}, ${points.length} points. Arrow keys go from point to ` +
        "point, Enter opens its run on the left, Shift and Enter on the right, plus and minus zoom, " +
        "0 shows all.",
    );
    this.render();
  }

  /** What holds all values with their bars, and some room. */
  around(points, valueOf) {
    const [low, high] = extent(
      points.map(valueOf).flatMap(([v, d]) => (isFinite(d) ? [v - d, v + d] : [v])),
    );
    const single = high - low <= 1e-9 * Math.max(Math.abs(low), Math.abs(high));
    const room = single ? Math.max(0.05 * Math.abs(low), 0.5) : 0.05 * (high - low);
    // Of one value that may be no less than 0, as a runout, nothing below 0 is shown.
    return [single && low >= 0 ? Math.max(0, low - room) : low - room, high + room];
  }

  px(x) {
    const [a, b] = this.range[0];
    return SPACE.left + ((x - a) / (b - a)) * this.wide;
  }
  py(y) {
    const [a, b] = this.range[1];
    return this.top + (1 - (y - a) / (b - a)) * this.high;
  }
  valueX(px) {
    const [a, b] = this.range[0];
    return a + ((px - SPACE.left) / this.wide) * (b - a);
  }
  valueY(py) {
    const [a, b] = this.range[1];
    return a + (1 - (py - this.top) / this.high) * (b - a);
  }
  get zoomed() {
    return this.range !== this.full;
  }
  inside(point) {
    return [point.x, point.y].every((v, k) => v >= this.range[k][0] && v <= this.range[k][1]);
  }

  /** Ranges of x and y; one no larger than the whole, nor so small that numbers end. */
  zoom(x, y) {
    const next = [x, y].map(([a, b], k) => {
      const [low, high] = this.full[k],
        whole = high - low,
        size = Math.min(Math.max(b - a, 1e-4 * whole), whole);
      const from = Math.min(Math.max(size === b - a ? a : (a + b - size) / 2, low), high - size);
      return [from, from + size];
    });
    const all = next.every(([a, b], k) => b - a >= 0.999 * (this.full[k][1] - this.full[k][0]));
    this.range = all ? this.full : next;
    this.render();
  }
  /** Around a place in pixels; a factor above 1 comes closer. */
  scale(factor, px, py) {
    const x = this.valueX(px),
      y = this.valueY(py),
      [[a, b], [c, d]] = this.range;
    this.zoom(
      [x - (x - a) / factor, x + (b - x) / factor],
      [y - (y - c) / factor, y + (d - y) / factor],
    );
  }
  /** By shares of what is seen. */
  move(right, up) {
    const [[a, b], [c, d]] = this.range;
    this.zoom(
      [a + right * (b - a), b + right * (b - a)],
      [c + up * (d - c), d + up * (d - c)],
    );
  }
  /** Around the point that is pointed at, or the middle. */
  closer(factor) {
    const at = this.at && this.inside(this.at);
    this.scale(
      factor,
      at ? this.px(this.at.x) : SPACE.left + this.wide / 2,
      at ? this.py(this.at.y) : this.top + this.high / 2,
    );
  }
  whole() {
    this.range = this.full;
    this.render();
  }

  nearest(px, py, within) {
    let best = null,
      least = within * within;
    for (const p of this.points) {
      if (!this.inside(p)) continue;
      const far = (this.px(p.x) - px) ** 2 + (this.py(p.y) - py) ** 2;
      if (far > least) continue;
      least = far;
      best = p;
    }
    return best;
  }

  /** The next point in view to the right (1) or left (-1), or up and down. */
  next(direction, upwards) {
    const key = upwards ? (p) => [p.y, p.x] : (p) => [p.x, p.y];
    const list = this.points
      .filter((p) => this.inside(p))
      .sort((p, q) => key(p)[0] - key(q)[0] || key(p)[1] - key(q)[1]);
    if (!list.length) return null;
    const k = list.indexOf(this.at);
    if (k < 0) return list[direction > 0 ? 0 : list.length - 1];
    return list[Math.min(Math.max(k + direction, 0), list.length - 1)];
  }

  pointAt(point, tip = true) {
    if (point === this.at && this.tip.hidden !== tip) return;
    this.at = point;
    this.drawMarks();
    this.tip.hidden = !(point && tip);
    if (!this.tip.hidden) this.fillTip(point);
    this.onPoint(point);
  }

  fillTip(point) {
    const { head, rows } = this.tell(point);
    this.tip.replaceChildren(
      make("div", { class: "head" }, head),
      ...rows.map(([name, value]) =>
        make("div", {}, make("span", {}, name), make("b", {}, value)),
      ),
    );
    putTip(this.tip, this.plot.clientWidth, this.px(point.x), this.py(point.y) - 40, 14);
  }

  /** Points whose runs are open, by side: {left: point, right: point}. */
  mark(opened) {
    this.opened = opened;
    this.drawMarks();
  }

  drawMarks() {
    if (!this.marks) return;
    const parts = [];
    for (const [side, point] of Object.entries(this.opened)) {
      if (!point || !this.inside(point)) continue;
      const x = this.px(point.x),
        y = this.py(point.y),
        left = side === "left";
      parts.push(
        draw("circle", { class: "open", cx: x, cy: y, r: 9 }),
        draw(
          "text",
          { class: "opentext", x: x + (left ? -12 : 12), y: y + 4, "text-anchor": left ? "end" : "start" },
          side,
        ),
      );
    }
    if (this.at && this.inside(this.at))
      parts.push(
        draw("circle", { class: "here", cx: this.px(this.at.x), cy: this.py(this.at.y), r: 7 }),
      );
    this.marks.replaceChildren(...parts);
  }
}

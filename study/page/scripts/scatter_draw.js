/* How the chart of points is drawn. */

Object.assign(Scatter.prototype, {
  render() {
    const width = this.plot.clientWidth;
    if (width < 120 || !this.shades) return;
    this.wide = width - SPACE.left - SPACE.right;
    const key = this.shades.key(width - SPACE.left - SPACE.right);
    this.top = SPACE.top + key.height;
    this.high = Math.min(Math.max(0.5 * width, 260), 470);
    const height = this.top + this.high + SPACE.bottom;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.tip.hidden = true;
    const box = { x: SPACE.left, y: this.top, width: this.wide, height: this.high };
    this.brush = draw("rect", { class: "brush", width: 0, height: 0 });
    this.marks = draw("g");
    this.svg.replaceChildren(
      draw("clipPath", { id: "explorer-clip" }, draw("rect", box)),
      draw("g", { transform: `translate(${SPACE.left} 0)` }, ...key.parts),
      ...this.axes(),
      draw(
        "g",
        { "clip-path": "url(#explorer-clip)" },
        ...this.points.flatMap((p) => this.bars(p)),
        ...this.points.map((p) => this.dot(p)),
      ),
      this.marks,
      this.brush,
    );
    this.plot.classList.toggle("zoomed", this.zoomed);
    this.drawMarks();
    this.onRender?.();
  },

  dot(p) {
    const [cx, cy] = [this.px(p.x).toFixed(1), this.py(p.y).toFixed(1)];
    return draw("circle", { class: "dot", cx, cy, r: 4.5, fill: this.shades.of(p.value) });
  },

  bars(p) {
    const parts = [];
    const bar = (x1, y1, x2, y2) => parts.push(draw("line", { class: "bar", x1, y1, x2, y2 }));
    const [x, y] = [this.px(p.x), this.py(p.y)];
    if (p.above > 0) bar(x, this.py(p.y - p.above), x, this.py(p.y + p.above));
    if (p.aside > 0) bar(this.px(p.x - p.aside), y, this.px(p.x + p.aside), y);
    return parts;
  },

  axes() {
    const out = [],
      { left } = SPACE,
      bottom = this.top + this.high,
      right = left + this.wide;
    const line = (kind, x1, y1, x2, y2) => out.push(draw("line", { class: kind, x1, y1, x2, y2 }));
    const text = (words, attributes) => out.push(draw("text", attributes, words));
    const xs = ticks(...this.range[0], Math.max(3, this.wide / 62)),
      ys = ticks(...this.range[1], Math.max(4, this.high / 50));
    for (const v of xs) {
      line(v === 0 ? "zero" : "grid", this.px(v), this.top, this.px(v), bottom);
      const place = { class: "tick", x: this.px(v), y: bottom + 16, "text-anchor": "middle" };
      text(tickText(v, xs[1] - xs[0] || v || 1), place);
    }
    for (const v of ys) {
      line(v === 0 ? "zero" : "grid", left, this.py(v), right, this.py(v));
      const place = { class: "tick", x: left - 6, y: this.py(v) + 3.5, "text-anchor": "end" };
      text(tickText(v, ys[1] - ys[0] || v || 1), place);
    }
    out.push(draw("path", { class: "axis", d: `M${left} ${this.top}V${bottom}H${right}` }));
    text(titleOf(this.x), {
      class: "label",
      x: left + this.wide / 2,
      y: bottom + 36,
      "text-anchor": "middle",
    });
    text(titleOf(this.y), {
      class: "label",
      x: 0,
      y: 0,
      "text-anchor": "middle",
      transform: `translate(13 ${this.top + this.high / 2}) rotate(-90)`,
    });
    return out;
  },
});

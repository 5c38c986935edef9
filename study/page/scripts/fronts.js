/* Where the runout is counted from and how far the runs come: the section, and beneath it, on the
   same scale of length, the place at which the front of each run came to rest. */

const STRIP = { high: 30, head: 40, foot: 44, side: 12 };

class Fronts {
  /** stories: {section, fronts} of study/page/stories.cpp; onPick(row, side): opens a run,
      and tells whether there is one. */
  constructor({ rows, stories, by, onPick }) {
    Object.assign(this, { rows, onPick, at: null });
    this.toe = stories.section.toe;
    this.fronts = stories.fronts.map((v) => v ?? NaN);
    this.column = by ? rows.find(by) : null;
    const farthest = extent(this.fronts.filter(isFinite))[1];
    this.drawing = new SectionDrawing(stories.section, farthest + 0.03 * Math.abs(farthest));
    this.strips = this.split();
    this.svg = draw("svg", { class: "chart fronts", tabindex: 0, role: "group" });
    this.svg.setAttribute("aria-label", this.words());
    this.tip = make("div", { class: "tip", role: "status", hidden: true });
    this.plot = make("div", { class: "plot" }, this.svg, this.tip);
    const buttons = saveButtons(
      () => "section and runouts",
      () => {
        this.pointAt(null);
        return this.svg;
      },
    );
    this.note = make("p", { class: "note" });
    this.chosenLine = make("p", { class: "picked", role: "status" });
    this.element = make(
      "figure",
      {},
      make("div", { class: "row" }, this.key(), make("span", { class: "buttons" }, ...buttons)),
      this.plot,
      this.chosenLine,
      this.note,
    );
    this.listen();
    onWidth(this.plot, () => this.render());
  }

  words() {
    const all = this.strips.map((s) => `${s.name}: median ${number(this.beyond(s.median))} m`);
    return `The section and the fronts of the runs. ${all.join("; ")}. Arrow keys go from run to run, Enter opens one.`;
  }

  beyond(x) {
    return x - (this.toe ?? 0);
  }

  /** One strip for each value of the input that acts most, one for each other variant. */
  split() {
    const { rows } = this,
      variant = rows.find("variant"),
      main = variant ? rows.value(variant, 0) : 0;
    const strips = new Map();
    this.fronts.forEach((front, row) => {
      if (!isFinite(front)) return;
      const v = variant ? rows.value(variant, row) : 0,
        of = v === main && this.column ? rows.value(this.column, row) : NaN;
      const name =
        v !== main
          ? told(variant, v)
          : isFinite(of)
            ? `${this.column.label} ${told(this.column, of)}`
            : "all runs";
      if (!strips.has(name)) strips.set(name, { name, value: of, other: v !== main, runs: [] });
      strips.get(name).runs.push({ row, front });
    });
    const list = [...strips.values()].sort((a, b) => a.other - b.other || a.value - b.value);
    for (const s of list) {
      s.runs.sort((a, b) => a.front - b.front);
      const places = s.runs.map((r) => r.front);
      [s.low, s.first, s.median, s.third, s.high] = [0.05, 0.25, 0.5, 0.75, 0.95].map((q) =>
        shareOf(places, q),
      );
    }
    return list;
  }

  key() {
    return make(
      "div",
      { class: "soilkey" },
      ...this.drawing.key().map(([colour, name]) => {
        const swatch = draw("rect", { width: 14, height: 10, fill: colour });
        return make(
          "span",
          { class: "key" },
          draw("svg", { width: 14, height: 10, "aria-hidden": "true" }, swatch),
          name,
        );
      }),
    );
  }

  render() {
    const width = this.plot.clientWidth;
    if (width < 120) return;
    const wide = width - 2 * STRIP.side;
    this.top = STRIP.head + this.drawing.fit(STRIP.side, wide, STRIP.head) + 8;
    const values = this.strips.filter((s) => !s.other).map((s) => ({ value: s.value }));
    this.shades = new Shades(this.rows, this.column, values);
    const bottom = this.top + STRIP.high * this.strips.length;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${bottom + STRIP.foot}`);
    this.mark = draw("g");
    this.svg.replaceChildren(
      ...this.axis(bottom, width),
      ...this.drawing.parts(),
      ...this.measure(bottom, width),
      ...this.strips.flatMap((s, k) => this.strip(s, this.top + STRIP.high * k, wide)),
      this.mark,
    );
    this.tip.hidden = true;
    const { larger, section } = this.drawing,
      others = section.other_rows;
    this.note.textContent =
      `The section before the shaking, of row ${section.row + 1}${larger > 1 ? `, heights drawn ${larger} times as large` : ""}. ` +
      (this.toe === null
        ? ""
        : "Runout is how far the front, the fifth-farthest point of the soils that count, comes beyond the toe; a front that stays behind it has a runout of 0. ") +
      "Each stroke is a run, which a click opens on the left, with Shift on the right; boxes hold the middle half of them, whiskers 90 %, the thick stroke is the median." +
      (others ? ` Another section, which is not drawn, have rows: ${others}.` : "");
  }

  axis(bottom, width) {
    const { px, range } = this.drawing,
      out = [];
    const list = ticks(this.beyond(range[0]), this.beyond(range[1]), Math.max(4, width / 90));
    for (const v of list) {
      const x = px(v + (this.toe ?? 0));
      out.push(
        draw("line", { class: "grid", x1: x, x2: x, y1: this.top, y2: bottom }),
        draw(
          "text",
          { class: "tick", x, y: bottom + 15, "text-anchor": "middle" },
          tickText(v, list[1] - list[0] || 1),
        ),
      );
    }
    const [left, right] = this.drawing.sides;
    out.push(
      draw("path", { class: "axis", d: `M${left} ${bottom}H${right}` }),
      draw(
        "text",
        { class: "label", x: (left + right) / 2, y: bottom + 34, "text-anchor": "middle" },
        this.toe === null ? "place of the front, x [m]" : "front at rest, from the toe [m]",
      ),
    );
    return out;
  }

  /** The toe, and an arrow from it to the median of all runs: what a runout is. */
  measure(bottom) {
    if (this.toe === null) return [];
    const { px } = this.drawing,
      x = px(this.toe),
      [left, right] = this.drawing.sides;
    const middle = this.middle(),
      to = px(middle),
      y = STRIP.head - 8;
    const out = [draw("line", { class: "mark", x1: x, x2: x, y1: y - 14, y2: bottom })];
    const put = (text, at, level, anchor, kind = "marktext") =>
      out.push(draw("text", { class: kind, x: at, y: level, "text-anchor": anchor }, text));
    put("toe", x - 5, y - 4, "end");
    if (!(middle > this.toe)) return out;
    const text = `runout: half of the runs above ${number(this.beyond(middle))} m`,
      head = Math.min(6, (to - x) / 2);
    out.push(
      draw("path", {
        class: "reach",
        d: `M${x} ${y}H${to}M${to - head} ${y - 4}L${to} ${y}L${to - head} ${y + 4}`,
      }),
    );
    if (x + 4 + widthOf(text) < right) put(text, x + 4, y - 6, "start", "label");
    else put(text, right, y - 20, "end", "label");
    return out;
  }

  /** Median of the fronts, each repeated row once. */
  middle() {
    const main = new Set(this.strips.filter((s) => !s.other).flatMap((s) => s.runs.map((r) => r.row)));
    const means = this.rows.groups
      .map((group) => group.filter((row) => main.has(row)).map((row) => this.fronts[row]))
      .filter((fronts) => fronts.length)
      .map((fronts) => fronts.reduce((a, b) => a + b, 0) / fronts.length);
    return shareOf(means.sort((a, b) => a - b), 0.5);
  }

  strip(s, top, wide) {
    const { px } = this.drawing,
      colour = s.other ? "var(--ink)" : this.shades.of(s.value),
      y = top + STRIP.high / 2,
      out = [];
    const line = (kind, x1, y1, x2, y2, more = {}) =>
      out.push(draw("line", { class: kind, x1, y1, x2, y2, ...more }));
    const [low, first, median, third, high] = [s.low, s.first, s.median, s.third, s.high].map(px);
    if (s.runs.length > 4) {
      line("whisker", low, y, high, y);
      out.push(
        draw("rect", {
          class: "quartiles",
          x: first,
          y: y - 8,
          width: Math.max(third - first, 1),
          height: 16,
          fill: colour,
        }),
      );
      line("median", median, y - 11, median, y + 11);
    }
    for (const r of s.runs)
      line("rug", px(r.front), y - 8, px(r.front), y + 8, { stroke: colour });
    const name = `${s.name} (${s.runs.length})`;
    const room = px(s.runs[0].front) - this.drawing.sides[0] - 8;
    out.push(
      draw(
        "text",
        { class: "label", x: this.drawing.sides[0], y: y + 4 },
        widthOf(name) < room || wide > 600 ? name : s.name,
      ),
    );
    return out;
  }

  /** The run whose stroke is nearest to a place in pixels; null where none is near. */
  nearest(x, y) {
    const s = this.strips[Math.floor((y - this.top) / STRIP.high)];
    if (!s) return null;
    let best = null,
      least = 14;
    for (const r of s.runs) {
      const far = Math.abs(this.drawing.px(r.front) - x);
      if (far >= least) continue;
      least = far;
      best = { ...r, strip: s };
    }
    return best;
  }

  pointAt(run) {
    this.at = run;
    this.mark?.replaceChildren();
    this.tip.hidden = !run;
    if (!run) return;
    const x = this.drawing.px(run.front),
      y = this.top + STRIP.high * this.strips.findIndex((s) => s.name === run.strip.name);
    this.mark.append(
      draw("line", { class: "here", x1: x, x2: x, y1: y + 2, y2: y + STRIP.high - 2 }),
    );
    const runout = Math.max(0, this.beyond(run.front));
    this.tip.replaceChildren(
      make("div", { class: "head" }, this.rows.labels[run.row]),
      make(
        "div",
        {},
        make("span", {}, this.toe === null ? "front at x" : "runout"),
        make("b", {}, number(runout, "m")),
      ),
    );
    putTip(this.tip, this.plot.clientWidth, x, y - 46);
  }

  listen() {
    const place = (event) => placeIn(this.svg, event);
    this.svg.addEventListener("pointermove", (event) => this.pointAt(this.nearest(...place(event))));
    this.svg.addEventListener("pointerleave", () => this.pointAt(null));
    this.svg.addEventListener("blur", () => this.pointAt(null));
    this.svg.addEventListener("click", (event) => {
      const run = this.nearest(...place(event));
      if (run) this.open(run.row, event.shiftKey ? "right" : "left");
    });
    this.svg.addEventListener("keydown", (event) => this.onKey(event));
  }

  open(row, side) {
    const opened = this.onPick(row, side);
    this.chosenLine.replaceChildren(
      make("b", {}, this.rows.labels[row]),
      opened ? ": " : ": the page of this run was not kept.",
      ...(opened ? [make("a", { href: "#side-by-side" }, `open on the ${side}, below.`)] : []),
    );
  }

  onKey(event) {
    const list = this.strips.flatMap((strip) => strip.runs.map((r) => ({ ...r, strip })));
    const k = this.at ? list.findIndex((r) => r.row === this.at.row) : -1;
    if (event.key === "ArrowRight" || event.key === "ArrowDown")
      this.pointAt(list[Math.min(k + 1, list.length - 1)]);
    else if (event.key === "ArrowLeft" || event.key === "ArrowUp")
      this.pointAt(list[Math.max(k - 1, 0)]);
    else if (event.key === "Enter" && this.at)
      this.open(this.at.row, event.shiftKey ? "right" : "left");
    else return;
    event.preventDefault();
  }
}

/** The value below which a share of sorted ones lies, between neighbours. */
function shareOf(sorted, share) {
  const at = share * (sorted.length - 1),
    k = Math.min(Math.floor(at), sorted.length - 2);
  return sorted.length < 2 ? sorted[0] : sorted[k] + (at - k) * (sorted[k + 1] - sorted[k]);
}

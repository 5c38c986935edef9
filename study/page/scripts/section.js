/* The undeformed section of a study in SVG: soils, water, ground, toe. */

/** Heights are drawn larger where the section would be a line. */
const HEIGHTS = [1, 2, 3, 5, 7, 10];

class SectionDrawing {
  /** section: of study/page/stories.cpp; the drawing reaches from the section to `right` [m]. */
  constructor(section, right) {
    this.section = section;
    const all = section.soils.flatMap((s) => s.rings.flat());
    const [left, end] = extent(all.map(([x]) => x));
    this.range = [left, Math.max(right, end)];
    const levels = section.water.map(([, y]) => y).filter((y) => y !== null);
    [this.low, this.high] = extent([...all.map(([, y]) => y), ...levels]);
  }

  /** Sets the scale of a drawing of that width [px], whose top is at `top`; gives its height. */
  fit(left, wide, top) {
    const [a, b] = this.range,
      scale = wide / (b - a),
      tall = this.high - this.low;
    this.larger = HEIGHTS.find((f) => f * scale * tall >= 70) ?? HEIGHTS[HEIGHTS.length - 1];
    this.px = (x) => left + (x - a) * scale;
    this.py = (y) => top + (this.high - y) * scale * this.larger;
    this.bottom = this.py(this.low) + 8;
    this.sides = [left, left + wide];
    return this.bottom - top;
  }

  path(points) {
    return points
      .map(([x, y], k) => `${k ? "L" : "M"}${this.px(x).toFixed(1)} ${this.py(y).toFixed(1)}`)
      .join("");
  }

  get colours() {
    return materialColours(this.section.soils.map(() => ({ liquefied: false })));
  }

  parts() {
    const { soils } = this.section,
      colours = this.colours;
    return [
      ...this.ground(),
      ...soils.map(({ rings }, k) =>
        draw("path", {
          class: "soil",
          d: rings.map((ring) => `${this.path(ring)}Z`).join(""),
          fill: cssOf(colours[k]),
          "fill-rule": "evenodd",
        }),
      ),
      ...this.water(),
    ];
  }

  /** Rigid ground, which goes on level beyond its ends. */
  ground() {
    const line = this.section.ground;
    if (!line.length) return [];
    const [a, b] = this.range;
    const inside = [
      [a, this.groundAt(a)],
      ...line.filter(([x]) => x > a && x < b),
      [b, this.groundAt(b)],
    ];
    const edge = this.path(inside),
      [left, right] = this.sides;
    return [
      draw("path", { class: "rigid", d: `${edge}L${right} ${this.bottom}L${left} ${this.bottom}Z` }),
      draw("path", { class: "rigidline", d: edge }),
    ];
  }

  groundAt(at) {
    const line = this.section.ground,
      k = line.findIndex(([x]) => x >= at);
    if (k <= 0) return (k ? line[line.length - 1] : line[0])[1];
    const [[x0, y0], [x1, y1]] = [line[k - 1], line[k]];
    return y0 + ((y1 - y0) * (at - x0)) / (x1 - x0);
  }

  /** The pond, and the water table as a line: each where there is water. */
  water() {
    const rows = this.section.water.filter(([, y]) => y !== null);
    const out = [];
    for (let k = 0; k + 1 < rows.length; ++k) {
      const [[x0, y0, g0], [x1, y1, g1]] = [rows[k], rows[k + 1]];
      if (y0 <= g0 + 0.05 && y1 <= g1 + 0.05) continue;
      const tops = this.path([
        [x0, Math.max(y0, g0)],
        [x1, Math.max(y1, g1)],
        [x1, g1],
        [x0, g0],
      ]);
      out.push(draw("path", { class: "pond", d: `${tops}Z` }));
    }
    out.push(draw("path", { class: "watertable", d: this.path(rows) }));
    return out;
  }

  /** [colour, name] of all that is drawn. */
  key() {
    const soils = this.section.soils.map(({ name }, k) => [cssOf(this.colours[k]), name]);
    const out = [...soils];
    if (this.section.water.length) out.push(["var(--sky)", "water before the shaking"]);
    if (this.section.ground.length) out.push(["var(--ground)", "rigid ground"]);
    return out;
  }
}

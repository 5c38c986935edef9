/* The chart that readers make themselves: any number of the table against any other. */

class Explorer {
  /** start: {x, y, colour} as names of columns; runs: where the pages of runs are opened. */
  constructor({ rows, start, runs }) {
    Object.assign(this, { rows, runs, chosen: { ...start }, together: rows.repeated });
    this.chart = new Scatter({
      onPoint: (point) => point && this.choose(point),
      onPick: (point, side) => this.open(point, side),
    });
    this.chart.onRender = () => this.tellView();
    this.words = make("p", { class: "note view", role: "status" });
    this.chosenLine = make("p", { class: "chosen" });
    this.missing = make("div", { class: "missing" });
    this.element = make(
      "div",
      { class: "explorer" },
      this.choices(),
      this.chart.plot,
      this.chosenLine,
      this.words,
      this.missing,
    );
    this.chart.listen();
    runs.onOpen = () => this.markOpen();
    this.update();
  }

  choices() {
    const { rows } = this;
    this.selects = {
      y: this.select("y", rows.measured, "y"),
      x: this.select("x", rows.measured, "x"),
      colour: this.select("colour", rows.colouring, "colour"),
    };
    const button = (text, help, action) =>
      make("button", { type: "button", title: help, "aria-label": help, onclick: action }, text);
    const { chart } = this;
    this.wholeButton = button("whole", "Show all points again", () => chart.whole());
    const buttons = make(
      "span",
      { class: "buttons" },
      button("+", "Come closer", () => chart.closer(1.5)),
      button("\u2212", "Go farther", () => chart.closer(1 / 1.5)),
      this.wholeButton,
      ...saveButtons(
        () => `${this.y.label} against ${this.x.label}`,
        () => {
          chart.pointAt(null);
          return chart.svg;
        },
      ),
    );
    const pool = make("input", {
      type: "checkbox",
      checked: this.together,
      onchange: () => {
        this.together = pool.checked;
        this.update();
      },
    });
    return make(
      "div",
      { class: "row choices" },
      ...Object.values(this.selects),
      ...(rows.repeated
        ? [make("label", { class: "tick" }, pool, "repeats as one point, with a bar of \u00b1 one deviation")]
        : []),
      buttons,
    );
  }

  /** A list of columns under the headings of where they are from. */
  select(name, columns, label) {
    const select = make("select", {
      onchange: () => {
        this.chosen[name] = select.value;
        this.update();
      },
    });
    if (name === "colour") select.append(make("option", { value: "" }, "one colour"));
    const headings = new Map();
    for (const c of columns) {
      const option = make(
        "option",
        { value: c.name, selected: c.name === this.chosen[name] },
        titleOf(c),
      );
      if (!headings.has(c.group)) headings.set(c.group, []);
      headings.get(c.group).push(option);
    }
    for (const [heading, options] of headings)
      select.append(make("optgroup", { label: heading }, ...options));
    return make("label", { class: "choose" }, make("span", {}, label), select);
  }

  update() {
    const { rows, chosen } = this;
    this.x = rows.find(chosen.x);
    this.y = rows.find(chosen.y);
    this.colour = chosen.colour ? rows.find(chosen.colour) : null;
    const { points, missing } = rows.points(this.x, this.y, this.colour, this.together);
    const shades = new Shades(rows, this.colour, points);
    this.chosenLine.replaceChildren();
    this.chart.show({
      points,
      x: this.x,
      y: this.y,
      shades,
      tell: (point) => this.tell(point),
    });
    this.tellMissing(missing);
    this.markOpen();
  }

  /** Columns that the chart shows, each once. */
  get shown() {
    return [...new Set([this.y, this.x, this.colour].filter((c) => c))];
  }

  tell(point) {
    const lines = this.shown.map((c) => {
      const { mean, deviation } = this.rows.mean(c, point.rows);
      const spread = deviation > 0 ? ` \u00b1 ${short(deviation)}` : "";
      return [c.label, told(c, mean) + spread];
    });
    if (point.rows.length > 1) lines.push(["repeats", `mean of ${point.rows.length}`]);
    const row = this.rows.rowWithPage(point);
    if (row < 0) lines.push(["its run has no page", ""]);
    return { head: point.label, rows: lines };
  }

  /** What a finger or a key has chosen, with what can be done with it. */
  choose(point) {
    const row = this.rows.rowWithPage(point),
      said = this.shown.map((c) => `${c.label} ${told(c, this.rows.mean(c, point.rows).mean)}`);
    const parts = [make("b", {}, point.label), `: ${said.join(", ")}. `];
    if (row >= 0)
      for (const side of SIDES)
        parts.push(
          make("button", { type: "button", onclick: () => this.open(point, side) }, side),
          " ",
        );
    else if (this.runs.any) parts.push("The page of this run was not kept.");
    this.chosenLine.replaceChildren(...parts);
  }

  open(point, side) {
    this.choose(point);
    const row = this.rows.rowWithPage(point);
    if (row < 0) return;
    this.runs.open(row, side);
    // it may lie below the window
    this.chosenLine.append(make("a", { href: "#side-by-side" }, `Open on the ${side}, below.`));
  }

  markOpen() {
    const { points } = this.chart;
    const of = (row) => points.find((p) => p.rows.includes(row));
    this.chart.mark(Object.fromEntries(SIDES.map((s) => [s, of(this.runs.rows[s])])));
  }

  /** Which of the points are seen. */
  tellView() {
    const { chart } = this,
      seen = chart.points.filter((p) => chart.inside(p)).length;
    this.wholeButton.disabled = !chart.zoomed;
    const parts = chart.zoomed ? [`${seen} of ${chart.points.length} points are in view.`] : [];
    const finger = matchMedia("(pointer: coarse)").matches;
    if (finger) parts.push("Tap a point for its values, and for its run where there is one.");
    else {
      if (this.runs.any)
        parts.push("A click opens the run of a point on the left, with Shift on the right.");
      parts.push(
        "Drag a box, + and \u2212, or the wheel in a chart that was clicked, come closer; a double " +
          "click or 0 shows all. Arrow keys go from point to point.",
      );
    }
    this.words.textContent = parts.join(" ");
  }

  tellMissing(missing) {
    const { rows } = this;
    if (!missing.length) return this.missing.replaceChildren();
    const names = missing.map((row) => make("li", {}, rows.labels[row]));
    this.missing.replaceChildren(
      make(
        "details",
        {},
        make("summary", {}, `${missing.length} of ${rows.count} rows have no value here`),
        make("ul", {}, ...names),
      ),
    );
  }
}

/* Pointing at curves, and choosing them there or in the table of all rows. */

Object.assign(Strands.prototype, {
  /** The curve nearest to a place in pixels, with its value there; those in front first. */
  nearest(px, py) {
    let best = null,
      least = 22;
    for (const strand of this.strands) {
      if (!this.isOn(strand)) continue;
      const [first, last] = [strand.x[0], strand.x[strand.x.length - 1]].map((v) => this.px(v));
      if (px < first - 2 || px > last + 2) continue;
      const share = Math.min(Math.max((px - first) / (last - first), 0), 1),
        k = Math.round(share * (strand.x.length - 1));
      const far = Math.abs(this.py(strand.y[k]) - py);
      if (!(far < least)) continue;
      least = far;
      best = { strand, k };
    }
    return best;
  },

  pointAt(place) {
    this.at = place;
    this.mark?.replaceChildren();
    this.tip.hidden = !place;
    if (!place) return;
    const { strand, k } = place,
      { x, y } = this.chart,
      [px, py] = [this.px(strand.x[k]), this.py(strand.y[k])];
    this.mark.append(
      draw("path", { class: "strand front", d: this.path(strand) }),
      draw("circle", { cx: px, cy: py, r: 4, fill: "var(--red)" }),
    );
    const [first, ...others] = strand.rows;
    const line = (name, value) => make("div", {}, make("span", {}, name), make("b", {}, value));
    this.tip.replaceChildren(
      make("div", { class: "head" }, this.rows.labels[first]),
      ...(others.length ? [line(`and ${others.length} more with the same`, "")] : []),
      line(y.label, number(strand.y[k], y.unit)),
      line(x.label, number(strand.x[k], x.unit)),
    );
    putTip(this.tip, this.plot.clientWidth, px, py - 60);
  },

  listen() {
    const place = (event) => this.nearest(...placeIn(this.svg, event));
    this.svg.addEventListener("pointermove", (event) => this.pointAt(place(event)));
    this.svg.addEventListener("pointerleave", () => this.pointAt(null));
    this.svg.addEventListener("blur", () => this.pointAt(null));
    this.svg.addEventListener("click", (event) => {
      const found = place(event);
      if (found) this.toggle(found.strand.rows);
    });
    this.svg.addEventListener("keydown", (event) => this.onKey(event));
    this.lines = [...document.querySelectorAll("#rows tr[data-row]")];
    for (const line of this.lines) {
      line.title = "Click: its curves stand out above";
      line.addEventListener("click", (event) => {
        if (!event.target.closest("a")) this.toggle([+line.dataset.row]);
      });
    }
    this.tellChosen();
  },

  onKey(event) {
    const order = [...this.strands].sort((a, b) => a.y[a.y.length - 1] - b.y[b.y.length - 1]);
    const at = order.indexOf(this.at?.strand),
      steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };
    if (event.key in steps) {
      const next = order[Math.min(Math.max(at + steps[event.key], 0), order.length - 1)];
      this.pointAt({ strand: next, k: next.y.length - 1 });
    } else if (event.key === "Enter" && this.at) this.toggle(this.at.strand.rows);
    else if (event.key === "Escape") this.letGo();
    else return;
    event.preventDefault();
  },

  /** Under the chart, and in the table. */
  tellChosen() {
    for (const line of this.lines) line.classList.toggle("on", this.chosen.has(+line.dataset.row));
    this.svg.classList.toggle("chosenones", this.chosen.size > 0);
    const rows = [...this.chosen].sort((a, b) => a - b),
      button = (text, help, onclick) => make("button", { type: "button", title: help, onclick }, text);
    const shown = rows.slice(0, 12).map((row) =>
      button(`${this.rows.labels[row]} \u00d7`, "Let it go", () => this.toggle([row])),
    );
    this.list.replaceChildren(
      ...shown.flatMap((b) => [b, " "]),
      ...(rows.length > 12 ? [`and ${rows.length - 12} more `] : []),
      ...(rows.length ? [button("all runs", "Let all go", () => this.letGo())] : []),
    );
    this.note.textContent =
      (rows.length
        ? "The other runs are grey."
        : "Click curves here, or rows in the table of all rows: those stand out.") +
      (this.without ?? "");
  },
});

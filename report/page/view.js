/* A section drawn in a canvas: axes, ground, outline; wheel, drag, pinch and keys move it. */

const VIEW = { left: 44, right: 10, top: 12, bottom: 34 };

class View {
  /** run: the JSON of the page. windows: {name: [left, right]} in m. range: [bottom, top] in m. */
  constructor({ run, windows, range, label, paint, find }) {
    Object.assign(this, { run, windows, range, paint, find });
    this.canvas = make("canvas", { tabindex: 0, role: "img", "aria-label": label });
    this.tip = make("div", { class: "tip", role: "status", hidden: true });
    this.plot = make("div", { class: "plot" }, this.canvas, this.tip);
    this.context = this.canvas.getContext("2d");
    this.stretch = 0; // of heights; 0: as the width suggests
    this.window = windows[Object.keys(windows).pop()];
    this.listen();
    onWidth(this.plot, () => this.fit());
  }

  /** Buttons for the windows and the stretch of heights. */
  controls() {
    const buttons = Object.entries(this.windows).map(([name, window]) =>
      make("button", { type: "button", onclick: () => this.show(window) }, name),
    );
    this.stretchButton = make(
      "button",
      {
        type: "button",
        title: "Stretch heights",
        onclick: () => {
          this.stretch = this.heights === 1 ? 2 : this.heights === 2 ? 4 : 1;
          this.fit();
        },
      },
      "",
    );
    return make("span", { class: "buttons" }, ...buttons, this.stretchButton);
  }

  show(window) {
    this.window = window;
    this.fit();
  }

  fit() {
    const width = this.plot.clientWidth;
    if (width < 60) return;
    const [left, right] = this.window;
    this.heights = this.stretch || (width < 640 ? 2 : 1);
    if (this.stretchButton) this.stretchButton.textContent = `heights \u00d7${this.heights}`;
    this.wide = width - VIEW.left - VIEW.right;
    this.sx = this.wide / (right - left);
    this.sy = this.sx * this.heights;
    this.high = Math.min(Math.max(this.sy * (this.range[1] - this.range[0]), 110), 460);
    this.x0 = left;
    this.y0 = this.range[0];
    this.resize(width, this.high + VIEW.top + VIEW.bottom);
  }

  resize(width, height) {
    this.dense = Math.min(window.devicePixelRatio || 1, 2);
    this.width = width;
    this.height = height;
    this.canvas.width = Math.round(width * this.dense);
    this.canvas.height = Math.round(height * this.dense);
    this.canvas.style.height = `${height}px`;
    this.redraw();
  }

  px(x) {
    return VIEW.left + (x - this.x0) * this.sx;
  }
  py(y) {
    return VIEW.top + this.high - (y - this.y0) * this.sy;
  }
  x(px) {
    return this.x0 + (px - VIEW.left) / this.sx;
  }
  y(py) {
    return this.y0 + (VIEW.top + this.high - py) / this.sy;
  }

  redraw() {
    if (!this.width) return;
    const c = this.context;
    c.setTransform(this.dense, 0, 0, this.dense, 0, 0);
    c.clearRect(0, 0, this.width, this.height);
    c.save();
    c.beginPath();
    c.rect(VIEW.left, VIEW.top - 8, this.wide, this.high + 8);
    c.clip();
    this.drawGround();
    this.paint(this, c);
    c.restore();
    this.drawAxes();
  }

  /** Rigid ground, which goes on level beyond its ends. */
  drawGround() {
    const c = this.context,
      line = this.run.ground;
    if (!line.length) return;
    // All of its corners: one beyond the window gives the ground at the edge its height.
    const path = [
      [Math.min(this.x0, line[0][0]), line[0][1]],
      ...line,
      [Math.max(this.x(VIEW.left + this.wide), line[line.length - 1][0]), line[line.length - 1][1]],
    ];
    c.beginPath();
    path.forEach(([x, y], i) => c[i ? "lineTo" : "moveTo"](this.px(x), this.py(y)));
    c.lineTo(this.px(path[path.length - 1][0]), VIEW.top + this.high + 2);
    c.lineTo(this.px(path[0][0]), VIEW.top + this.high + 2);
    c.closePath();
    c.fillStyle = cssVariable("--ground");
    c.fill();
    c.beginPath();
    path.forEach(([x, y], i) => c[i ? "lineTo" : "moveTo"](this.px(x), this.py(y)));
    c.strokeStyle = cssVariable("--soft");
    c.lineWidth = 1.2;
    c.stroke();
  }

  drawAxes() {
    const c = this.context,
      bottom = VIEW.top + this.high,
      right = VIEW.left + this.wide;
    c.strokeStyle = c.fillStyle = cssVariable("--soft");
    c.lineWidth = 1;
    c.font = `11px ${cssVariable("--sans")}`;
    c.beginPath();
    c.moveTo(VIEW.left - 0.5, VIEW.top);
    c.lineTo(VIEW.left - 0.5, bottom + 0.5);
    c.lineTo(right, bottom + 0.5);
    c.stroke();
    const xs = ticks(this.x0, this.x(right), this.wide / 90);
    const ys = ticks(this.y0, this.y(VIEW.top), this.high / 34);
    c.textAlign = "center";
    for (const v of xs) {
      c.fillRect(this.px(v), bottom, 1, 4);
      c.fillText(tickText(v, xs[1] - xs[0] || 1), this.px(v), bottom + 16);
    }
    c.fillText("x (m)", VIEW.left + this.wide / 2, bottom + 30);
    c.textAlign = "right";
    for (const v of ys) {
      c.fillRect(VIEW.left - 5, this.py(v), 4, 1);
      c.fillText(tickText(v, ys[1] - ys[0] || 1), VIEW.left - 7, this.py(v) + 4);
    }
    c.save();
    c.translate(11, VIEW.top + this.high / 2);
    c.rotate(-Math.PI / 2);
    c.textAlign = "center";
    c.fillText("y (m)", 0, 0);
    c.restore();
  }

  line(points, { colour, width = 1, dash = [] }) {
    const c = this.context;
    c.beginPath();
    let open = false;
    for (const [x, y] of points) {
      if (y === null || !isFinite(y)) {
        open = false;
        continue;
      }
      c[open ? "lineTo" : "moveTo"](this.px(x), this.py(y));
      open = true;
    }
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.setLineDash(dash);
    c.stroke();
    c.setLineDash([]);
  }

  drawOutline(inside) {
    const c = this.context;
    for (const boundary of inside ? [0, 1] : [1]) {
      c.beginPath();
      for (const [x1, y1, x2, y2, kind] of this.run.outline)
        if (kind === boundary) {
          c.moveTo(this.px(x1), this.py(y1));
          c.lineTo(this.px(x2), this.py(y2));
        }
      c.strokeStyle = cssVariable("--ink");
      c.globalAlpha = boundary ? 0.75 : 0.4;
      c.lineWidth = boundary ? 1 : 0.7;
      c.stroke();
      c.globalAlpha = 1;
    }
  }

  /** Dashed upright with words at its foot or head. */
  upright(x, text, colour, level = 0) {
    const c = this.context,
      at = this.px(x),
      end = at > VIEW.left + this.wide - 110;
    c.strokeStyle = c.fillStyle = colour;
    c.setLineDash([4, 3]);
    c.beginPath();
    c.moveTo(at, VIEW.top - 4);
    c.lineTo(at, VIEW.top + this.high);
    c.stroke();
    c.setLineDash([]);
    c.textAlign = end ? "right" : "left";
    c.font = `11px ${cssVariable("--sans")}`;
    c.fillText(text, at + (end ? -5 : 5), VIEW.top + 8 + 14 * level);
  }

  scaleAt(factor, px, py) {
    const x = this.x(px),
      y = this.y(py);
    const most = (400 / (this.range[1] - this.range[0])) * 20;
    factor = Math.min(Math.max(factor, 0.2), 5);
    const sx = Math.min(Math.max(this.sx * factor, this.wide / 4000), most);
    this.sy *= sx / this.sx;
    this.sx = sx;
    this.x0 = x - (px - VIEW.left) / this.sx;
    this.y0 = y - (VIEW.top + this.high - py) / this.sy;
    this.redraw();
  }

  listen() {
    const place = (event) => placeIn(this.canvas, event);
    let last = null;
    this.canvas.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey && !event.metaKey && document.activeElement !== this.canvas) return;
        event.preventDefault();
        this.scaleAt(Math.exp(-0.0015 * event.deltaY), ...place(event));
      },
      { passive: false },
    );
    this.canvas.addEventListener("pointerdown", (event) => {
      if (event.pointerType !== "mouse" || event.button !== 0) return;
      last = place(event);
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (last) {
        this.x0 -= (at[0] - last[0]) / this.sx;
        this.y0 += (at[1] - last[1]) / this.sy;
        last = at;
        this.tip.hidden = true;
        this.redraw();
      } else this.hover(...at);
    });
    for (const name of ["pointerup", "pointercancel"])
      this.canvas.addEventListener(name, () => {
        last = null;
      });
    this.canvas.addEventListener("pointerleave", () => this.unhover());
    this.canvas.addEventListener("dblclick", () => this.fit());
    this.canvas.addEventListener("keydown", (event) => {
      const middle = [VIEW.left + this.wide / 2, VIEW.top + this.high / 2];
      if (event.key === "+" || event.key === "=") this.scaleAt(1.3, ...middle);
      else if (event.key === "-") this.scaleAt(1 / 1.3, ...middle);
      else if (event.key === "0") this.fit();
      else if (event.shiftKey && event.key.startsWith("Arrow")) {
        const step = 40,
          { key } = event;
        if (key === "ArrowLeft") this.x0 -= step / this.sx;
        if (key === "ArrowRight") this.x0 += step / this.sx;
        if (key === "ArrowUp") this.y0 += step / this.sy;
        if (key === "ArrowDown") this.y0 -= step / this.sy;
        this.redraw();
      } else return;
      event.preventDefault();
      event.stopPropagation();
    });
  }

  hover(px, py) {
    const inside =
      px > VIEW.left && px < VIEW.left + this.wide && py > VIEW.top && py < VIEW.top + this.high;
    const found = inside ? this.find(this, this.x(px), this.y(py)) : null;
    this.tip.hidden = !found;
    if (found) {
      this.tip.replaceChildren(
        make("div", { class: "head" }, found.head),
        ...found.rows.map(([name, value]) =>
          make("div", {}, make("span", {}, name), make("b", {}, value)),
        ),
      );
      putTip(this.tip, this.width, px, py - 30, 14);
    }
    this.redraw();
  }
  unhover() {
    this.tip.hidden = true;
    this.find(this, NaN, NaN);
    this.redraw();
  }
}

/** Bar with its ends, or one swatch per entry of a list [{name, colour}]. */
function colourKey(scale) {
  if (scale.list)
    return make(
      "div",
      { class: "scale list" },
      ...scale.list.map(({ name, colour }) => {
        const swatch = make("i", {});
        swatch.style.background = colour;
        return make("span", {}, swatch, name);
      }),
      ...(scale.note ? [make("em", {}, scale.note)] : []),
    );
  const bar = make("i", { class: "bar" });
  bar.style.background = scale.gradient;
  return make(
    "div",
    { class: "scale" },
    make("b", {}, scale.label),
    make("span", {}, scale.low),
    bar,
    make("span", {}, scale.high),
    ...(scale.note ? [make("em", {}, scale.note)] : []),
  );
}

/** A row of buttons of which one is on. */
function choice(label, names, chosen, pick) {
  const buttons = names.map((name) =>
    make(
      "button",
      {
        type: "button",
        "aria-pressed": String(name === chosen),
        onclick: (event) => {
          for (const b of buttons)
            b.setAttribute("aria-pressed", String(b === event.currentTarget));
          pick(name);
        },
      },
      name,
    ),
  );
  return make("span", { class: "choice", role: "group", "aria-label": label }, ...buttons);
}

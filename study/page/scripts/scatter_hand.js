/* Mouse, touch and keys on the chart of points. */

const NEAR = { mouse: 22, touch: 40 }; // how far a point may be from what points at it [px]

Object.assign(Scatter.prototype, {
  listen() {
    this.from = null;
    const place = (event) => placeIn(this.svg, event);
    const near = (event) => NEAR[event.pointerType === "mouse" ? "mouse" : "touch"];
    this.svg.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault(); // a click with the shift key would mark text
      this.svg.focus({ preventScroll: true });
      this.from = this.last = place(event);
      this.moved = false;
    });
    this.svg.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (this.from) this.drag(at, event.pointerType);
      else if (event.pointerType === "mouse") this.pointAt(this.nearest(...at, near(event)));
    });
    window.addEventListener("pointerup", (event) => {
      if (!this.from) return;
      const point = this.nearest(...this.from, near(event));
      if (this.moved) this.drop(place(event), event.pointerType);
      else if (event.pointerType === "mouse") {
        if (point) this.onPick(point, event.shiftKey ? "right" : "left");
      } else this.pointAt(point, false); // a tip would lie under the finger
      this.from = null;
    });
    window.addEventListener("pointercancel", () => this.letGo());
    this.svg.addEventListener("pointerleave", (event) => {
      if (event.pointerType === "mouse") this.pointAt(null);
    });
    this.svg.addEventListener("blur", () => (this.tip.hidden = true));
    this.svg.addEventListener("dblclick", () => this.whole());
    this.svg.addEventListener("keydown", (event) => this.key(event));
    this.svg.addEventListener(
      "wheel",
      (event) => {
        // the page goes on scrolling under a chart that nobody has clicked
        if (!event.ctrlKey && !event.metaKey && document.activeElement !== this.svg) return;
        event.preventDefault();
        this.scale(Math.exp(-0.0015 * event.deltaY), ...place(event));
      },
      { passive: false },
    );
  },

  /** A mouse draws a box, a finger moves what is seen of a chart that is zoomed into. */
  drag(at, pointer) {
    const [x, y] = this.from;
    if (Math.hypot(at[0] - x, at[1] - y) > 5) this.moved = true;
    if (!this.moved) return;
    this.tip.hidden = true;
    if (pointer !== "mouse") {
      this.move((this.last[0] - at[0]) / this.wide, (at[1] - this.last[1]) / this.high);
      this.last = at;
      return;
    }
    const [left, right] = [x, at[0]].sort((a, b) => a - b),
      [top, bottom] = [y, at[1]].sort((a, b) => a - b);
    const box = { x: left, y: top, width: right - left, height: bottom - top };
    for (const [name, value] of Object.entries(box)) this.brush.setAttribute(name, value);
  },

  drop(at, pointer) {
    const [x, y] = this.from,
      up = (a, b) => a - b;
    this.letGo();
    if (pointer !== "mouse" || Math.abs(at[0] - x) < 8 || Math.abs(at[1] - y) < 8) return;
    this.zoom(
      [this.valueX(x), this.valueX(at[0])].sort(up),
      [this.valueY(y), this.valueY(at[1])].sort(up),
    );
  },

  letGo() {
    this.from = null;
    this.brush?.setAttribute("width", 0);
  },

  key(event) {
    const arrows = {
      ArrowLeft: [-1, false],
      ArrowRight: [1, false],
      ArrowDown: [-1, true],
      ArrowUp: [1, true],
    };
    const { key } = event;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (key in arrows) {
      const [step, upwards] = arrows[key];
      if (event.shiftKey) this.move(upwards ? 0 : 0.2 * step, upwards ? 0.2 * step : 0);
      else this.pointAt(this.next(step, upwards));
    } else if (key === "Home" || key === "End") {
      this.at = null;
      this.pointAt(this.next(key === "Home" ? 1 : -1, false));
    } else if (key === "+" || key === "=") this.closer(1.5);
    else if (key === "-") this.closer(1 / 1.5);
    else if (key === "0" || key === "Escape") this.whole();
    else if ((key === "Enter" || key === " ") && this.at)
      this.onPick(this.at, event.shiftKey ? "right" : "left");
    else return;
    event.preventDefault();
  },
});

/* The flow as a film: points over time, with values under the pointer. */

const RATES = [0.25, 0.5, 1, 2, 5, 10, 20, 50];

class Player {
  /** onTime(t) is called whenever another instant is shown, onAct after all that a hand, or the
      film itself, has done. */
  constructor({ run, points, frames, flow, onTime }) {
    Object.assign(this, { run, points, flow, onTime, mode: "displacement", picked: -1 });
    this.onAct = () => {};
    this.films = 0;
    this.start = points.times[0];
    this.end = points.times[points.times.length - 1];
    this.time = this.end;
    const wanted = (this.end - this.start) / 15;
    this.rate = RATES.find((r) => r >= wanted) || RATES[RATES.length - 1];
    this.view = new View({
      run,
      windows: frames.flow,
      range: frames.range,
      label: "Material points of the flow. Space plays, left and right step, plus and minus zoom.",
      paint: (view, c) => this.paint(view, c),
      find: (view, x, y) => this.find(x, y),
    });
    this.key = make("div", { class: "keyrow" }, points.key(this.mode));
    this.strip = make("div", { class: "strip" });
    this.element = make(
      "div",
      { class: "player" },
      this.top(),
      this.key,
      this.view.plot,
      this.bar(),
      this.strip,
      make("p", { class: "note" }, this.words()),
    );
    this.element.addEventListener("keydown", (event) => this.keydown(event));
    points.move(this.time);
    this.show(this.time);
  }

  words() {
    const p = this.run.points,
      s = [];
    s.push(
      p.shown < p.of
        ? `${p.shown} of ${p.of} points are in this page, spread evenly; their squares are larger for it.`
        : `All ${p.of} points.`,
    );
    s.push(
      p.frames < p.frames_of
        ? `${p.frames} of ${p.frames_of} stored instants, chosen so that the fastest point comes equally far between two.`
        : `All ${p.frames_of} stored instants.`,
    );
    const gaps = Array.from(this.points.times).map((t, i, all) => (i ? t - all[i - 1] : 0));
    s.push(`Between two, at most ${number(Math.max(...gaps), "s")} apart, points move straight.`);
    s.push(
      "Drag moves the section, Ctrl and wheel or + and \u2212 zoom, a double click shows all.",
    );
    return s.join(" ");
  }

  top() {
    const modes = Object.keys(this.points.scales).filter(
      (m) => m !== "strength" || this.points.strengths.some((v) => isFinite(v)),
    );
    return make(
      "div",
      { class: "row" },
      choice("Colour of the points", modes, this.mode, (mode) => {
        this.mode = mode;
        this.key.replaceChildren(this.points.key(mode));
        this.view.redraw();
        this.fillStrip();
      }),
      this.view.controls(),
    );
  }

  bar() {
    this.button = make("button", { type: "button", class: "play", onclick: () => this.toggle() });
    this.slider = make("input", {
      type: "range",
      min: this.start,
      max: this.end,
      step: (this.end - this.start) / 2000 || 1,
      "aria-label": "Time since transfer",
      oninput: () => {
        this.pause();
        this.show(+this.slider.value);
      },
    });
    this.readout = make("output", { class: "readout" });
    const rate = (this.rateChoice = make(
      "select",
      {
        "aria-label": "Speed of the film",
        onchange: () => {
          this.rate = +rate.value;
          this.onAct();
        },
      },
      ...RATES.map((r) => make("option", { value: r, selected: r === this.rate }, `\u00d7${r}`)),
    ));
    this.pause();
    return make("div", { class: "row bar" }, this.button, this.slider, rate, this.readout);
  }

  /** Five instants beside each other: for paper, and to jump to. */
  fillStrip() {
    const { times } = this.points,
      { frames } = this.points;
    const chosen = [...new Set([0, 0.25, 0.5, 0.75, 1].map((s) => Math.round(s * (frames - 1))))];
    const present = this.time;
    this.strip.replaceChildren(
      ...chosen.map((k) => {
        const canvas = make("canvas", { width: 10, height: 10 });
        const small = Object.create(View.prototype);
        Object.assign(small, { run: this.run, canvas, context: canvas.getContext("2d"), dense: 2 });
        const [left, right] = this.view.window;
        small.wide = 232;
        small.x0 = left;
        small.y0 = this.view.range[0];
        small.sx = small.wide / (right - left);
        small.sy = small.sx * Math.max(2, this.view.heights || 1);
        small.high = Math.min(small.sy * (this.view.range[1] - this.view.range[0]), 120);
        canvas.width = 2 * small.wide;
        canvas.height = 2 * (small.high + 8);
        small.context.setTransform(2, 0, 0, 2, -2 * VIEW.left, -2 * (VIEW.top - 8));
        this.points.move(times[k]);
        small.drawGround();
        this.points.paint(small, small.context, this.mode);
        return make(
          "button",
          {
            type: "button",
            title: `Show ${number(times[k], "s")}`,
            onclick: () => {
              this.pause();
              this.show(times[k]);
            },
          },
          canvas,
          make("span", {}, number(times[k], "s")),
        );
      }),
    );
    this.points.move(present);
  }

  paint(view, c) {
    this.points.paint(view, c, this.mode);
    view.drawOutline(false);
    const { run } = this,
      red = cssVariable("--red"),
      ink = cssVariable("--ink");
    if (run.toe_m !== null) view.upright(run.toe_m, `toe, ${number(run.toe_m, "m")}`, ink, 0);
    const front = interpolated(this.flow.t, this.flow.front, this.time);
    if (isFinite(front))
      view.upright(
        front,
        run.toe_m !== null && front > run.toe_m
          ? `front, runout ${number(front - run.toe_m, "m")}`
          : `front, ${number(front, "m")}`,
        red,
        1,
      );
    if (this.picked < 0) return;
    view.line(this.points.track(this.picked), { colour: ink, width: 1, dash: [2, 2] });
    c.beginPath();
    c.arc(view.px(this.points.x[this.picked]), view.py(this.points.y[this.picked]), 5, 0, 7);
    c.strokeStyle = red;
    c.lineWidth = 2;
    c.stroke();
  }

  find(x, y) {
    const p = this.points,
      i = (this.picked = isFinite(x) ? p.nearest(x, y) : -1);
    if (i < 0) return null;
    const rows = [
      ["x, y", `${number(p.x[i])}, ${number(p.y[i], "m")}`],
      ["came from", `${number(p.x0[i])}, ${number(p.y0[i], "m")}`],
      ["displacement", number(p.displacement(i), "m")],
      ["speed", number(p.between(p.speeds, i), "m/s")],
    ];
    const strength = p.between(p.strengths, i);
    if (isFinite(strength)) rows.push(["strength left", number(strength)]);
    return { head: this.run.materials[p.material[i]].name, rows };
  }

  show(time) {
    this.time = Math.min(Math.max(time, this.start), this.end);
    this.points.move(this.time);
    this.slider.value = this.time;
    const { flow, run } = this,
      front = interpolated(flow.t, flow.front, this.time);
    const parts = [`t = ${number(this.time, "s")}`];
    if (run.toe_m !== null) parts.push(`runout ${number(Math.max(0, front - run.toe_m), "m")}`);
    parts.push(`fastest ${number(interpolated(flow.t, flow.max_speed, this.time), "m/s")}`);
    this.readout.textContent = parts.join("   ");
    this.view.redraw();
    this.onTime(this.time);
    this.onAct();
  }

  toggle() {
    this.playing ? this.pause() : this.play();
  }
  /** What the button says; a film that runs in another player is told of as well. */
  setPlaying(playing) {
    this.playing = playing;
    ++this.films; // ends the film that runs
    this.button.textContent = playing ? "\u275a\u275a" : "\u25b6";
    this.button.setAttribute("aria-label", playing ? "Pause" : "Play");
  }
  pause() {
    this.setPlaying(false);
    this.leads = false;
    this.onAct();
  }
  play() {
    this.setPlaying(true);
    this.leads = true;
    if (this.time >= this.end) this.show(this.start);
    this.onAct();
    let last = performance.now();
    const film = this.films;
    const step = (now) => {
      if (film !== this.films) return;
      // A tab that was asleep goes on where it was.
      this.show(this.time + (this.rate * Math.min(now - last, 100)) / 1000);
      last = now;
      if (this.time >= this.end) this.pause();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  /** Shows what another player shows, or runs the film for both if it leads; tells nobody. */
  obey({ time, playing, rate, lead }) {
    const { onAct } = this;
    this.onAct = () => {};
    this.rate = rate;
    this.rateChoice.value = rate;
    this.show(time);
    if (!playing) this.pause();
    else if (lead && !(this.playing && this.leads)) this.play();
    else if (!lead && (this.leads || !this.playing)) {
      this.setPlaying(true);
      this.leads = false;
    }
    this.onAct = onAct;
  }

  keydown(event) {
    if (event.target.tagName === "SELECT" || event.shiftKey) return;
    const { times } = this.points;
    const k = indexBefore(times, this.time + 1e-4),
      onButton = event.target.tagName === "BUTTON";
    if (event.key === " " && !onButton) this.toggle();
    else if (event.key === "ArrowRight") {
      this.pause();
      this.show(times[Math.min(k + 1, times.length - 1)]);
    } else if (event.key === "ArrowLeft") {
      this.pause();
      this.show(times[times[k] < this.time - 1e-4 ? k : Math.max(k - 1, 0)]);
    } else if (event.key === "Home") {
      this.pause();
      this.show(this.start);
    } else if (event.key === "End") {
      this.pause();
      this.show(this.end);
    } else return;
    event.preventDefault();
  }
}

/* Two players that show the same time: the one that a hand was on last is followed by the other. */

const LINK = "flowslide-player"; // as in report/page/linked.js

const SHORTER = {
  wait: "the shorter run waits at its end",
  stop: "both stop where the shorter run ends",
  stretch: "both take equally long",
};

/** What a player tells of itself, or null: anyone can send anything. */
function stateOf(data) {
  if (data === null || typeof data !== "object" || data.kind !== LINK) return null;
  const { time, playing, rate, start, end, began } = data;
  const whole =
    [time, rate, start, end].every(Number.isFinite) &&
    rate > 0 &&
    end > start &&
    typeof playing === "boolean" &&
    typeof began === "boolean";
  return whole ? { time, playing, rate, start, end, began } : null;
}

class Together {
  constructor(runs) {
    this.runs = runs;
    this.states = { left: null, right: null };
    this.rule = "wait";
    this.on = false;
    this.tick = make("input", {
      type: "checkbox",
      disabled: true,
      onchange: () => this.set(this.tick.checked),
    });
    const rule = make(
      "select",
      {
        "aria-label": "When one run is shorter",
        onchange: () => {
          this.rule = rule.value;
          if (this.on) this.pass("left");
        },
      },
      ...Object.entries(SHORTER).map(([value, text]) => make("option", { value }, text)),
    );
    this.element = make(
      "div",
      { class: "row together" },
      make("label", { class: "tick" }, this.tick, "play together"),
      rule,
      make("span", { class: "note" }, "Time counts from each run's transfer, where its flow begins."),
    );
    window.addEventListener("message", (event) => this.hear(event));
  }

  hear(event) {
    const side = SIDES.find((s) => event.source === this.runs.frame(s).contentWindow);
    const state = side && event.source ? stateOf(event.data) : null;
    if (!state) return;
    this.states[side] = state;
    this.tick.disabled = !SIDES.every((s) => this.states[s]);
    if (!this.on) return;
    if (state.began) this.welcome(side);
    else this.pass(side);
  }

  /** Another page was opened on one side: what is there already stays, and both stand. */
  welcome(side) {
    const other = this.other(side);
    if (!this.states[other]) return;
    this.states[other].playing = false;
    this.order(other, this.states[other]);
    this.pass(other);
  }

  /** Nothing is heard of a page that goes. */
  forget(side) {
    this.states[side] = null;
    this.tick.disabled = true;
  }

  set(on) {
    this.on = on;
    if (on) this.pass("left");
    else
      for (const side of SIDES)
        if (this.states[side]) this.order(side, { ...this.states[side], playing: false });
  }

  other(side) {
    return SIDES[1 - SIDES.indexOf(side)];
  }

  /** Whose film runs when both play. */
  get leader() {
    const { left, right } = this.states;
    if (this.rule === "stretch" || left.end === right.end) return "left";
    const longer = left.end > right.end ? "left" : "right";
    return this.rule === "wait" ? longer : this.other(longer);
  }

  /** The time of the other side that goes with one of this side. */
  matching(side, time) {
    if (this.rule !== "stretch") return time;
    const from = this.states[side],
      to = this.states[this.other(side)];
    return to.start + ((time - from.start) / (from.end - from.start)) * (to.end - to.start);
  }

  /** Lets the other side do as this one does. */
  pass(side) {
    const other = this.other(side),
      state = this.states[side];
    if (!state || !this.states[other]) return;
    const { playing, rate } = state,
      time = this.matching(side, state.time);
    const leads = this.leader;
    this.order(other, { time, playing, rate }, leads === other);
    // the film of this side goes on in the other
    if (playing && leads === other) this.order(side, state);
  }

  order(side, { time, playing, rate }, lead = false) {
    Object.assign(this.states[side], { time, playing, rate });
    this.runs.frame(side).contentWindow.postMessage({ kind: LINK, time, playing, rate, lead }, "*");
  }
}

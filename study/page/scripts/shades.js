/* Colours of the points of a study, and their key. */

const KINDS = ["--blue", "--red", "--green", "--purple", "--orange", "--sky", "--soft"];

class Shades {
  /** Of the points of one choice of axes; column: null for one colour. */
  constructor(rows, column, points) {
    this.column = column;
    this.none = points.some((p) => !isFinite(p.value));
    const values = [...new Set(points.map((p) => p.value).filter(isFinite))].sort((a, b) => a - b);
    [this.low, this.high] = extent(values);
    // an input of few numbers is read from a list, in the order of the scale
    this.steps = column && (column.words || values.length <= 6) ? values : null;
    this.stops = stopsOf("viridis");
  }

  /** The darkest and the lightest end would not show on a dark and on a white page. */
  onScale(share) {
    return cssOf(mixed(this.stops, 0.08 + 0.84 * share));
  }

  of(value) {
    if (!this.column) return "var(--blue)";
    if (!isFinite(value)) return "var(--still)";
    if (this.column.words) return `var(${KINDS[value % KINDS.length]})`;
    if (this.steps)
      return this.onScale(this.steps.indexOf(value) / Math.max(this.steps.length - 1, 1));
    return this.onScale((value - this.low) / (this.high - this.low || 1));
  }

  /** The key as drawings, no wider than `width`, and how high it is. */
  key(width) {
    if (!this.column) return { parts: [], height: 0 };
    return this.steps ? this.list(width) : this.bar(width);
  }

  list(width) {
    const entries = this.steps.map((v) => [this.of(v), told(this.column, v)]);
    if (this.none) entries.push(["var(--still)", "no value"]);
    const row = 18,
      title = `${this.column.label}:`,
      indent = Math.min(widthOf(title) + 12, width / 2);
    const parts = [draw("text", { class: "label", x: 0, y: 12 }, title)];
    let x = indent,
      y = 0;
    for (const [colour, text] of entries) {
      const wide = widthOf(text) + 26;
      if (x + wide > width && x > indent) {
        x = indent;
        y += row;
      }
      parts.push(
        draw("circle", { class: "dot", cx: x + 5, cy: y + 8, r: 5, fill: colour }),
        draw("text", { class: "tick", x: x + 14, y: y + 12 }, text),
      );
      x += wide;
    }
    return { parts, height: y + row + 6 };
  }

  bar(width) {
    const id = "explorer-scale",
      wide = Math.min(180, width / 3);
    const stops = Array.from({ length: 9 }, (_, k) =>
      draw("stop", { offset: k / 8, "stop-color": this.onScale(k / 8) }),
    );
    const title = titleOf(this.column),
      low = short(this.low),
      at = Math.min(widthOf(title) + 14 + widthOf(low), width - wide - widthOf(short(this.high)) - 6);
    return {
      parts: [
        draw("linearGradient", { id }, ...stops),
        draw("text", { class: "label", x: 0, y: 12 }, title),
        draw("text", { class: "tick", x: at - 5, y: 12, "text-anchor": "end" }, low),
        draw("rect", { x: at, y: 3, width: wide, height: 10, fill: `url(#${id})` }),
        draw("text", { class: "tick", x: at + wide + 5, y: 12 }, short(this.high)),
        ...(this.none && at + wide + 130 < width
          ? [
              draw("circle", {
                class: "dot",
                cx: at + wide + 70,
                cy: 8,
                r: 5,
                fill: "var(--still)",
              }),
              draw("text", { class: "tick", x: at + wide + 79, y: 12 }, "no value"),
            ]
          : []),
      ],
      height: 24,
    };
  }
}

/** Width of a text in the chart [px]. */
function widthOf(text) {
  widthOf.context ||= document.createElement("canvas").getContext("2d");
  widthOf.context.font = `11px ${cssVariable("--sans")}`;
  return widthOf.context.measureText(text).width;
}

(() => {
"use strict";
function make(tag, attributes = {}, ...children) {
const element = document.createElement(tag);
for (const [name, value] of Object.entries(attributes))
if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
else if (value === true) element.setAttribute(name, "");
else if (value !== false && value !== null) element.setAttribute(name, value);
element.append(...children);
return element;
}
function draw(tag, attributes = {}, ...children) {
const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
element.append(...children);
return element;
}
function ticks(low, high, count) {
const raw = (high - low) / Math.max(count, 1);
if (!(raw > 0) || !isFinite(raw)) return [low];
const power = 10 ** Math.floor(Math.log10(raw));
const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
const out = [];
for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
out.push(k * step);
return out;
}
function tickText(value, step) {
if (Math.abs(value) < 1e-12 * Math.abs(step) || value === 0) return "0";
const size = Math.max(Math.abs(value), Math.abs(step));
if (size >= 1e5 || size < 1e-3)
return value.toExponential(1).replace("e+", "e").replace("-", "\u2212");
const digits = Math.max(0, Math.min(6, -Math.floor(Math.log10(Math.abs(step)) + 1e-9)));
return value.toFixed(digits).replace("-", "\u2212");
}
function number(value, unit = "") {
if (!isFinite(value)) return "\u2013";
const size = Math.abs(value);
const text =
size !== 0 && (size < 1e-3 || size >= 1e6)
? value.toExponential(2)
: size >= 100
? value.toFixed(0)
: size >= 10
? value.toFixed(1)
: value.toFixed(2);
return text.replace("-", "\u2212") + (unit ? "\u202f" + unit : "");
}
function indexBefore(x, value) {
let low = 0,
high = x.length - 1;
while (high - low > 1) {
const middle = (low + high) >> 1;
if (x[middle] <= value) low = middle;
else high = middle;
}
return low;
}
function interpolated(x, y, at) {
if (x.length < 2) return y[0];
const k = indexBefore(x, at);
const share = Math.min(Math.max((at - x[k]) / (x[k + 1] - x[k] || 1), 0), 1);
return y[k] + share * (y[k + 1] - y[k]);
}
function extent(values) {
let low = Infinity,
high = -Infinity;
for (const v of values) {
if (v < low) low = v;
if (v > high) high = v;
}
return low <= high ? [low, high] : [0, 1];
}
function save(name, blob) {
const link = make("a", { href: URL.createObjectURL(blob), download: name });
link.click();
setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
const cssVariable = (name) =>
getComputedStyle(document.documentElement).getPropertyValue(name).trim();
function onWidth(element, redraw) {
let width = 0;
new ResizeObserver(() => {
if (Math.abs(element.clientWidth - width) < 1) return;
width = element.clientWidth;
redraw();
}).observe(element);
}
async function inflate(base64) {
if (typeof DecompressionStream === "undefined")
throw new Error(
"This browser cannot unpack the numbers of this page (it lacks " +
"DecompressionStream). Open the file with Chrome 103, Firefox 113, Safari 16.4 or newer.",
);
const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
return new Uint8Array(await new Response(stream).arrayBuffer());
}
function unpackArray(bytes, at, { bits, rows, columns, lowest, step }) {
const size = rows * columns,
wide = bits === 16;
const unset = wide ? 0xffff : 0xff;
const values = new Float32Array(size);
let before = new Uint16Array(columns),
row = new Uint16Array(columns);
for (let r = 0, i = 0; r < rows; ++r) {
let left = 0,
leftBefore = 0;
for (let c = 0; c < columns; ++c, ++i) {
const z = wide ? bytes[at + i] | (bytes[at + size + i] << 8) : bytes[at + i];
const difference = (z >>> 1) ^ -(z & 1);
left = (before[c] + left - leftBefore + difference) & unset;
leftBefore = before[c];
row[c] = left;
values[i] = left === unset ? NaN : lowest + left * step;
}
[before, row] = [row, before];
}
return { rows, columns, values };
}
function unpack(bytes, index) {
const arrays = new Map();
let at = 0;
for (const entry of index) {
arrays.set(entry.name, unpackArray(bytes, at, entry));
at += entry.rows * entry.columns * (entry.bits / 8);
}
if (at !== bytes.length) throw new Error("The numbers of this page are cut off: copy it again.");
return (name) => arrays.get(name) || null;
}
const STOPS = {
viridis:
"440154481a6c472f7d41448739568c31688e2a788e23888e1f988b22a88435b77954c5687ad151a5db36d2e21bfde725",
cividis:
"00224e002e6c1e3a6f35456c47516c575d6d666970757575848279948e77a59c74b7a96ec8b866dbc75aeed649fee838",
plasma:
"0d08873305975002a26a00a88405a79c179eb12a90c33d80d35171e16462ed7953f68f44fca636fec029f9dc24f0f921",
};
const rgbOf = (hex) => [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));
const pixelOf = ([r, g, b]) => (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;
const cssOf = ([r, g, b]) => `rgb(${r} ${g} ${b})`;
function stopsOf(name) {
return STOPS[name].match(/.{6}/g).map(rgbOf);
}
function mixed(stops, share) {
const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
const k = Math.min(Math.floor(at), stops.length - 2);
return stops[k].map((low, d) => Math.round(low + (at - k) * (stops[k + 1][d] - low)));
}
const SCALES = Object.fromEntries(
Object.keys(STOPS).map((name) => {
const stops = stopsOf(name);
return [name, Uint32Array.from({ length: 256 }, (_, i) => pixelOf(mixed(stops, i / 255)))];
}),
);
const gradientOf = (name) => `linear-gradient(to right, ${stopsOf(name).map(cssOf).join(", ")})`;
const LINE = {
blue: "var(--blue)",
orange: "var(--orange)",
green: "var(--green)",
red: "var(--red)",
purple: "var(--purple)",
ink: "var(--ink)",
};
const SOILS = ["c9b18b", "8c6d46", "b5723a", "bdbdbd", "6b6b6b", "e5d9c5"].map(rgbOf);
function materialColours(materials) {
const layers = materials.filter((m) => m.liquefied).length,
stops = stopsOf("viridis");
let soil = 0,
layer = 0;
return materials.map((m) =>
m.liquefied
? mixed(stops, layers > 1 ? 0.08 + (0.84 * layer++) / (layers - 1) : 0.35)
: SOILS[soil++ % SOILS.length],
);
}
const CHART = { left: 56, right: 14, top: 10, bottom: 38, height: 230 };
const groups = new Map(); // charts that share an abscissa, by its name
class Chart {
constructor({ title, x, y, series, marks = [], note = "", group = "", pick = null }) {
Object.assign(this, { title, x, y, marks, pick, group });
this.series = series.filter((s) => s.y && s.y.length > 1);
if (!groups.has(group)) groups.set(group, []);
if (group) groups.get(group).push(this);
const [low, high] = extent(this.series.flatMap((s) => [s.x[0], s.x[s.x.length - 1]]));
this.full = this.range = [x.from ?? low, high];
this.time = NaN;
this.svg = draw("svg", {
class: "chart",
tabindex: 0,
role: "img",
"aria-label": `${title}: ${this.series.map((s) => s.name).join(", ")}. Arrow keys read values.`,
});
this.tip = make("div", { class: "tip", role: "status" });
this.plot = make("div", { class: "plot" }, this.svg, this.tip);
this.element = make(
"figure",
{ class: "panel" },
make("figcaption", {}, make("b", {}, title), this.buttons()),
this.legend(),
this.plot,
...(note ? [make("p", { class: "note" }, note)] : []),
);
this.listen();
onWidth(this.plot, () => this.render());
new IntersectionObserver(() => this.stale && this.render()).observe(this.plot);
}
buttons() {
const button = (text, help, action) =>
make("button", { type: "button", title: help, "aria-label": help, onclick: action }, text);
return make(
"span",
{ class: "buttons" },
(this.reset = button("whole", "Show the whole range again", () => this.zoom(...this.full))),
button("SVG", "Save this chart as SVG", () => this.save()),
);
}
legend() {
const items = this.series.map((s) => {
const key = draw(
"svg",
{ width: 22, height: 8, "aria-hidden": "true" },
draw("line", {
x1: 1,
x2: 21,
y1: 4,
y2: 4,
class: "line",
stroke: s.colour,
"stroke-dasharray": s.dash || "none",
}),
);
const item = make(
"button",
{
type: "button",
class: "key",
"aria-pressed": String(!s.hidden),
onclick: () => {
s.hidden = !s.hidden;
item.setAttribute("aria-pressed", String(!s.hidden));
this.render();
},
},
key,
s.name,
);
return item;
});
return make("div", { class: "legend" }, ...items);
}
scaleX(value) {
const f = this.x.log ? Math.log10 : (v) => v;
const [a, b] = this.range.map(f);
return CHART.left + ((f(value) - a) / (b - a || 1)) * this.wide;
}
valueX(pixel) {
const share = (pixel - CHART.left) / this.wide,
[a, b] = this.range;
return this.x.log ? a * (b / a) ** share : a + share * (b - a);
}
scaleY(value) {
const f = this.y.log ? Math.log10 : (v) => v;
const [a, b] = this.rangeY.map(f);
const share = (f(value) - a) / (b - a || 1);
return CHART.top + (this.y.invert ? share : 1 - share) * this.high;
}
findRangeY() {
let low = Infinity,
high = -Infinity;
for (const s of this.series) {
if (s.hidden) continue;
for (let i = 0; i < s.x.length; ++i)
if (s.x[i] >= this.range[0] && s.x[i] <= this.range[1] && isFinite(s.y[i])) {
low = Math.min(low, s.y[i]);
high = Math.max(high, s.y[i]);
}
}
if (!(low <= high)) [low, high] = [0, 1];
if (this.y.log) return [low / 1.3, high * 1.3];
if (this.y.zero) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
const span = Math.max(high - low, this.y.span || 1e-12),
spare = 0.06 * span;
if (high - low < span) high = low + span;
return [
this.y.zero && low === 0 ? 0 : low - spare,
this.y.zero && high === 0 ? 0 : high + spare,
];
}
axes() {
const out = [],
{ left, top } = CHART,
bottom = top + this.high,
right = left + this.wide;
const text = (content, attributes) => draw("text", attributes, content);
const decades = ([a, b]) => {
const list = [];
for (let p = Math.floor(Math.log10(a)); p <= Math.log10(b) + 1; ++p)
for (const m of [1, 2, 5])
if (m * 10 ** p >= a * 0.999 && m * 10 ** p <= b * 1.001) list.push(m * 10 ** p);
return list;
};
const xs = this.x.log ? decades(this.range) : ticks(...this.range, Math.max(3, this.wide / 80));
const ys = this.y.log ? decades(this.rangeY) : ticks(...this.rangeY, 5);
for (const v of xs) {
const at = this.scaleX(v);
out.push(draw("line", { class: "grid", x1: at, x2: at, y1: top, y2: bottom }));
out.push(
text(this.x.log ? String(+v.toPrecision(1)) : tickText(v, xs[1] - xs[0] || 1), {
class: "tick",
x: at,
y: bottom + 15,
"text-anchor": "middle",
}),
);
}
for (const v of ys) {
const at = this.scaleY(v);
out.push(
draw("line", { class: v === 0 ? "zero" : "grid", x1: left, x2: right, y1: at, y2: at }),
);
out.push(
text(this.y.log ? String(+v.toPrecision(1)) : tickText(v, ys[1] - ys[0] || 1), {
class: "tick",
x: left - 6,
y: at + 3.5,
"text-anchor": "end",
}),
);
}
out.push(draw("path", { class: "axis", d: `M${left} ${top}V${bottom}H${right}` }));
out.push(
text(`${this.x.label}${this.x.unit ? ` (${this.x.unit})` : ""}`, {
class: "label",
x: left + this.wide / 2,
y: bottom + 32,
"text-anchor": "middle",
}),
);
out.push(
text(`${this.y.label}${this.y.unit ? ` (${this.y.unit})` : ""}`, {
class: "label",
x: 0,
y: 0,
"text-anchor": "middle",
transform: `translate(12 ${top + this.high / 2}) rotate(-90)`,
}),
);
return out;
}
path(s) {
let d = "",
open = false,
column = -1,
low = 0,
high = 0,
last = 0;
const flush = () => {
if (column < 0) return;
d += `${open ? "L" : "M"}${column} ${low.toFixed(1)}`;
if (high !== low) d += `V${high.toFixed(1)}`;
if (last !== high) d += `V${last.toFixed(1)}`;
open = true;
};
const dense = s.x.length > 2 * this.wide;
for (let i = 0; i < s.x.length; ++i) {
if (!isFinite(s.y[i])) {
flush();
column = -1;
open = false;
continue;
}
const px = this.scaleX(s.x[i]),
py = this.scaleY(s.y[i]);
if (!dense) {
d += `${open ? "L" : "M"}${px.toFixed(1)} ${py.toFixed(1)}`;
open = true;
continue;
}
const at = Math.round(px);
if (at !== column) {
flush();
column = at;
low = high = py;
}
low = Math.min(low, py);
high = Math.max(high, py);
last = py;
}
if (dense) flush();
return d;
}
render() {
const width = this.plot.clientWidth;
if (width < 40) return;
this.stale = false;
this.wide = width - CHART.left - CHART.right;
this.high = CHART.height - CHART.top - CHART.bottom;
this.rangeY = this.findRangeY();
const id = `clip${(Chart.count = (Chart.count || 0) + 1)}`;
const box = { x: CHART.left, y: CHART.top - 2, width: this.wide, height: this.high + 4 };
const lines = draw("g", { "clip-path": `url(#${id})` });
for (const mark of this.marks) {
const at = this.scaleX(mark.x),
late = at > CHART.left + this.wide - 60;
lines.append(
draw("line", { class: "mark", x1: at, x2: at, y1: CHART.top, y2: CHART.top + this.high }),
draw(
"text",
{
class: "marktext",
x: at + (late ? -4 : 4),
y: CHART.top + 10,
"text-anchor": late ? "end" : "start",
},
mark.text,
),
);
}
for (const s of this.series)
if (!s.hidden)
lines.append(
draw("path", {
class: "line",
d: this.path(s),
stroke: s.colour,
"stroke-dasharray": s.dash || "none",
}),
);
this.now = draw("line", { class: "now", y1: CHART.top, y2: CHART.top + this.high });
this.cursor = draw("g", { class: "cursor" });
this.brush = draw("rect", { class: "brush", y: CHART.top, height: this.high, width: 0 });
lines.append(this.now, this.brush);
this.svg.setAttribute("viewBox", `0 0 ${width} ${CHART.height}`);
this.svg.replaceChildren(
draw("clipPath", { id }, draw("rect", box)),
...this.axes(),
lines,
this.cursor,
);
this.reset.hidden = this.range === this.full;
this.showTime(this.time);
}
refresh() {
if (this.waiting) return;
this.waiting = true;
requestAnimationFrame(() => {
this.waiting = false;
const box = this.plot.getBoundingClientRect();
if (box.bottom > 0 && box.top < innerHeight) this.render();
else this.stale = true;
});
}
zoom(low, high) {
const smallest = 1e-4 * (this.full[1] - this.full[0]);
if (high - low < smallest) return;
const range =
low <= this.full[0] && high >= this.full[1]
? this.full
: [Math.max(low, this.full[0]), Math.min(high, this.full[1])];
for (const chart of this.group ? groups.get(this.group) : [this]) {
chart.range = range === this.full ? chart.full : range;
chart.render();
}
}
showTime(time) {
this.time = time;
if (!this.now) return;
const at = this.scaleX(time),
inside = time >= this.range[0] && time <= this.range[1];
this.now.setAttribute("x1", inside ? at : -9);
this.now.setAttribute("x2", inside ? at : -9);
}
point(at, own) {
if (!this.cursor) return;
const shown = at >= this.range[0] && at <= this.range[1];
this.cursor.replaceChildren();
this.tip.hidden = !(own && shown);
if (!shown) return;
const px = this.scaleX(at),
rows = [];
this.cursor.append(draw("line", { x1: px, x2: px, y1: CHART.top, y2: CHART.top + this.high }));
for (const s of this.series) {
if (s.hidden || at < s.x[0] || at > s.x[s.x.length - 1]) continue;
const value = interpolated(s.x, s.y, at);
if (!isFinite(value)) continue;
this.cursor.append(draw("circle", { cx: px, cy: this.scaleY(value), r: 3, fill: s.colour }));
const dot = draw(
"svg",
{ width: 10, height: 10 },
draw("circle", { cx: 5, cy: 5, r: 4, fill: s.colour }),
);
rows.push(
make("div", {}, dot, make("span", {}, s.name), make("b", {}, number(value, this.y.unit))),
);
}
this.at = at;
if (!own) return;
this.tip.replaceChildren(make("div", { class: "head" }, number(at, this.x.unit)), ...rows);
const width = this.plot.clientWidth,
right = px > width / 2;
this.tip.style.left = right ? "" : `${px + 12}px`;
this.tip.style.right = right ? `${width - px + 12}px` : "";
}
pointAll(at) {
for (const chart of this.group ? groups.get(this.group) : [this])
chart.point(at, chart === this);
}
leave() {
for (const chart of this.group ? groups.get(this.group) : [this]) {
chart.cursor?.replaceChildren();
chart.tip.hidden = true;
}
}
listen() {
let from = null;
const place = (event) => event.clientX - this.svg.getBoundingClientRect().left;
this.tip.hidden = true;
this.svg.addEventListener("pointerdown", (event) => {
if (event.pointerType === "mouse" && event.button === 0) from = place(event);
});
this.svg.addEventListener("pointermove", (event) => {
const at = place(event);
this.pointAll(this.valueX(at));
if (from === null || Math.abs(at - from) < 4) return;
this.brush.setAttribute("x", Math.min(from, at));
this.brush.setAttribute("width", Math.abs(at - from));
});
window.addEventListener("pointerup", (event) => {
if (from === null) return;
const start = from,
at = place(event);
from = null;
this.brush.setAttribute("width", 0);
if (Math.abs(at - start) >= 8)
this.zoom(...[this.valueX(start), this.valueX(at)].sort((a, b) => a - b));
else if (this.pick && event.target instanceof Node && this.svg.contains(event.target))
this.pick(this.valueX(at));
});
this.svg.addEventListener("pointerleave", () => this.leave());
this.svg.addEventListener("blur", () => this.leave());
this.svg.addEventListener("dblclick", () => this.zoom(...this.full));
this.svg.addEventListener("keydown", (event) => this.key(event));
}
key(event) {
const [low, high] = this.range,
middle = this.at ?? (low + high) / 2;
const moves = { ArrowLeft: -1, ArrowRight: 1 };
if (event.key in moves) {
const pixel = this.scaleX(middle) + moves[event.key] * (event.shiftKey ? 40 : 6);
this.pointAll(Math.min(Math.max(this.valueX(pixel), low), high));
} else if (event.key === "+" || event.key === "=")
this.zoom(middle - (middle - low) / 1.5, middle + (high - middle) / 1.5);
else if (event.key === "-")
this.zoom(middle - (middle - low) * 1.5, middle + (high - middle) * 1.5);
else if (event.key === "0" || event.key === "Escape") this.zoom(...this.full);
else if (event.key === "Enter" && this.pick) this.pick(middle);
else return;
event.preventDefault();
}
save() {
const copy = this.svg.cloneNode(true);
const root = document.documentElement,
theme = root.dataset.theme;
root.dataset.theme = "light";
const styled = ["fill", "stroke", "stroke-width", "font-size", "font-family", "opacity"];
const from = this.svg.querySelectorAll("*"),
to = copy.querySelectorAll("*");
from.forEach((element, i) => {
const style = getComputedStyle(element);
for (const name of styled) to[i].setAttribute(name, style.getPropertyValue(name));
});
if (theme) root.dataset.theme = theme;
else delete root.dataset.theme;
copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
copy.setAttribute("width", this.plot.clientWidth);
copy.setAttribute("height", CHART.height);
const name = this.title.toLowerCase().replace(/[^a-z0-9]+/g, "-");
save(`${name}.svg`, new Blob([copy.outerHTML], { type: "image/svg+xml" }));
}
}
const VIEW = { left: 44, right: 10, top: 12, bottom: 34 };
class View {
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
drawGround() {
const c = this.context,
line = this.run.ground;
if (!line.length) return;
const ends = [
[this.x0, line[0][1]],
...line,
[this.x(VIEW.left + this.wide), line[line.length - 1][1]],
];
const path = ends.filter(([x]) => x >= this.x0 || x === line[0][0]);
c.beginPath();
path.forEach(([x, y], i) => c[i ? "lineTo" : "moveTo"](this.px(x), this.py(y)));
c.lineTo(VIEW.left + this.wide, VIEW.top + this.high + 2);
c.lineTo(VIEW.left, VIEW.top + this.high + 2);
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
const place = (event) => {
const box = this.canvas.getBoundingClientRect();
return [event.clientX - box.left, event.clientY - box.top];
};
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
const right = px > this.width / 2;
this.tip.style.left = right ? "" : `${px + 14}px`;
this.tip.style.right = right ? `${this.width - px + 14}px` : "";
this.tip.style.top = `${Math.max(0, py - 30)}px`;
}
this.redraw();
}
unhover() {
this.tip.hidden = true;
this.find(this, NaN, NaN);
this.redraw();
}
}
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
const isNear = 1e-9;
class Points {
constructor(run, array) {
const get = (name) => array(`points.${name}`).values;
this.times = get("t");
this.frames = this.times.length;
this.count = array("points.x").columns;
[this.xs, this.ys, this.x0, this.y0] = ["x", "y", "x0", "y0"].map(get);
[this.speeds, this.strengths, this.material] = ["speed", "strength", "material"].map(get);
for (let i = 0; i < this.speeds.length; ++i) this.speeds[i] *= this.speeds[i];
this.spacing = run.points.spacing_m;
this.moved = run.moved_m;
this.x = new Float32Array(this.count);
this.y = new Float32Array(this.count);
this.scales = this.findScales(run);
this.value = new Float32Array(this.count);
}
findScales(run) {
const colours = materialColours(run.materials);
const counts = run.materials.map((m) => m.counts);
let far = this.moved,
fast = 0,
weak = 1,
softened = false;
for (let i = 0; i < this.count; ++i) {
const k = (this.frames - 1) * this.count + i;
if (counts[this.material[i]])
far = Math.max(far, Math.hypot(this.xs[k] - this.x0[i], this.ys[k] - this.y0[i]));
}
for (let i = 0; i < this.speeds.length; ++i) fast = Math.max(fast, this.speeds[i] || 0);
for (const s of this.strengths) if (isFinite(s)) weak = Math.min(weak, s);
for (const s of this.strengths)
if (s < 0.995) {
softened = true;
break;
}
weak = Math.min(Math.floor(weak * 10 + isNear) / 10, 0.9);
const present = run.materials
.map((m, k) => ({ name: m.name, colour: cssOf(colours[k]), k }))
.filter(({ k }) => this.material.includes(k));
return {
displacement: {
table: "viridis",
low: 0,
high: far,
label: "displacement",
text: ["0", number(far, "m")],
note: `grey: moved less than ${this.moved} m`,
},
material: { pixels: Uint32Array.from(colours, pixelOf), list: present },
strength: {
table: "cividis",
low: weak,
high: 1,
label: "strength / strength at transfer",
text: [weak.toFixed(1), "1"],
note: softened ? "grey: no such strength" : "grey: no such strength; nothing softened",
},
speed: {
table: "plasma",
low: 0,
high: Math.sqrt(fast) || 1,
root: true,
label: "speed",
text: ["0", number(fast, "m/s")],
note: "scale by its root; grey: slower than 0.05 m/s",
},
};
}
key(mode) {
const s = this.scales[mode];
return s.list
? colourKey(s)
: colourKey({
label: s.label,
low: s.text[0],
high: s.text[1],
gradient: gradientOf(s.table),
note: s.note,
});
}
move(time) {
const k = this.frames > 1 ? indexBefore(this.times, time) : 0,
next = Math.min(k + 1, this.frames - 1);
const share = Math.min(
Math.max((time - this.times[k]) / (this.times[next] - this.times[k] || 1), 0),
1,
);
const a = k * this.count,
b = next * this.count;
for (let i = 0; i < this.count; ++i) {
this.x[i] = this.xs[a + i] + share * (this.xs[b + i] - this.xs[a + i]);
this.y[i] = this.ys[a + i] + share * (this.ys[b + i] - this.ys[a + i]);
}
Object.assign(this, { a, b, share, time });
}
between(values, i) {
return values[this.a + i] + this.share * (values[this.b + i] - values[this.a + i]);
}
displacement(i) {
return Math.hypot(this.x[i] - this.x0[i], this.y[i] - this.y0[i]);
}
colours(mode, still) {
const s = this.scales[mode],
out = (this.pixels ||= new Uint32Array(this.count));
if (s.pixels) for (let i = 0; i < this.count; ++i) out[i] = s.pixels[this.material[i]];
else {
const table = SCALES[s.table],
factor = 255 / (s.high - s.low);
for (let i = 0; i < this.count; ++i) {
let v =
mode === "displacement"
? this.displacement(i)
: this.between(mode === "speed" ? this.speeds : this.strengths, i);
const grey =
mode === "displacement" ? v < this.moved : mode === "speed" ? v < 0.05 : !isFinite(v);
if (s.root) v = Math.sqrt(v);
out[i] = grey ? still : table[Math.min(Math.max((v - s.low) * factor, 0), 255) | 0];
}
}
return out;
}
paint(view, c, mode) {
const d = view.dense,
width = Math.round(view.wide * d),
height = Math.round((view.high + 8) * d);
if (width < 1 || height < 1) return;
if (!view.image || view.image.width !== width || view.image.height !== height) {
view.image = new ImageData(width, height);
view.layer = make("canvas", { width, height });
}
const out = new Uint32Array(view.image.data.buffer);
out.fill(0);
const pixels = this.colours(mode, pixelOf(rgbOf(cssVariable("--still").replace("#", ""))));
const sx = view.sx * d,
sy = view.sy * d;
const halfX = 0.62 * this.spacing * sx,
halfY = 0.62 * this.spacing * sy;
const bottom = (view.high + 8) * d;
for (let i = 0; i < this.count; ++i) {
const x = (this.x[i] - view.x0) * sx,
y = bottom - (this.y[i] - view.y0) * sy;
const left = Math.max(Math.round(x - halfX), 0),
right = Math.min(Math.max(Math.round(x + halfX), left + 1), width);
const top = Math.max(Math.round(y - halfY), 0),
end = Math.min(Math.max(Math.round(y + halfY), top + 1), height);
const pixel = pixels[i];
for (let row = top; row < end; ++row)
if (right > left) out.fill(pixel, row * width + left, row * width + right);
}
view.layer.getContext("2d").putImageData(view.image, 0, 0);
c.drawImage(view.layer, VIEW.left, VIEW.top - 8, view.wide, view.high + 8);
}
nearest(x, y) {
let best = -1,
least = (1.2 * this.spacing) ** 2;
for (let i = 0; i < this.count; ++i) {
const r = (this.x[i] - x) ** 2 + (this.y[i] - y) ** 2;
if (r < least) {
least = r;
best = i;
}
}
return best;
}
track(i) {
return Array.from({ length: this.frames }, (_, k) => [
this.xs[k * this.count + i],
this.ys[k * this.count + i],
]);
}
}
function sectionWindows(run, points) {
let left = Infinity,
right = -Infinity,
low = Infinity,
top = -Infinity,
failed = Infinity,
far = -Infinity;
for (let i = 0; i < points.count; ++i) {
const k = (points.frames - 1) * points.count + i,
x0 = points.x0[i],
y0 = points.y0[i];
left = Math.min(left, x0);
right = Math.max(right, x0);
low = Math.min(low, y0);
top = Math.max(top, y0, points.ys[k]);
far = Math.max(far, points.xs[k]);
if (
run.materials[points.material[i]].counts &&
Math.hypot(points.xs[k] - x0, points.ys[k] - points.y0[i]) > run.moved_m
)
failed = Math.min(failed, x0);
}
const height = top - low,
end = Math.max(right, far) + 0.6 * height,
toe = run.toe_m;
const windows = { "whole section": [left - 0.2 * height, end] };
const near = toe === null ? failed - height : toe - 5 * height;
if (near > left + 0.1 * (end - left)) windows["dam and runout"] = [near, end];
const dam = { "whole section": [left - 0.2 * height, right + 0.3 * height] };
if (toe !== null && toe - 5 * height > left) dam.dam = [toe - 5 * height, right + 0.3 * height];
return { flow: windows, dam, range: [low - 0.08 * height, top + 0.35 * height] };
}
class Profile {
constructor(run, points, [left, right]) {
const wide = Math.max(5 * points.spacing, (right - left) / 200),
bins = Math.ceil((right - left) / wide);
Object.assign(this, { points, left, wide, bins });
const counts = run.materials.map((m) => m.counts);
this.depth = Array.from({ length: points.frames }, () => new Float32Array(bins));
this.speed = Array.from({ length: points.frames }, () => new Float32Array(bins));
for (let f = 0; f < points.frames; ++f) this.fill(f, counts);
this.x = Array.from({ length: bins }, (_, b) => left + (b + 0.5) * wide);
const largest = (rows) => this.x.map((_, b) => Math.max(...rows.map((row) => row[b])));
const x = { label: "x", unit: "m" };
this.charts = [
["Depth along the section", "depth of what moved", "m", this.depth, LINE.blue],
["Speed along the section", "mean speed of what moved", "m/s", this.speed, LINE.orange],
].map(
([title, label, unit, rows, colour]) =>
new Chart({
title,
x,
group: "along",
y: { label, unit, zero: true, span: 0.1 },
series: [
{ name: "at this instant", x: this.x, y: rows[points.frames - 1], colour },
{ name: "largest of all", x: this.x, y: largest(rows), colour: LINE.ink, dash: "2 3" },
],
marks: run.toe_m === null ? [] : [{ x: run.toe_m, text: "toe" }],
}),
);
}
fill(f, counts) {
const p = this.points,
depth = this.depth[f],
speed = this.speed[f],
a = f * p.count;
const number = new Uint32Array(this.bins);
for (let i = 0; i < p.count; ++i) {
const x = p.xs[a + i],
b = Math.floor((x - this.left) / this.wide);
if (b < 0 || b >= this.bins || !counts[p.material[i]]) continue;
if (Math.hypot(x - p.x0[i], p.ys[a + i] - p.y0[i]) < p.moved) continue;
++number[b];
speed[b] += p.speeds[a + i];
}
for (let b = 0; b < this.bins; ++b) {
if (number[b]) speed[b] /= number[b];
depth[b] = (number[b] * p.spacing ** 2) / this.wide;
}
}
show(time) {
const { times } = this.points,
k = indexBefore(times, time);
const frame = k + 1 < times.length && times[k + 1] - time < time - times[k] ? k + 1 : k;
if (frame === this.frame) return;
this.frame = frame;
[this.depth, this.speed].forEach((rows, c) => {
this.charts[c].series[0].y = rows[frame];
this.charts[c].refresh();
});
}
}
const RATES = [0.25, 0.5, 1, 2, 5, 10, 20, 50];
class Player {
constructor({ run, points, frames, flow, onTime }) {
Object.assign(this, { run, points, flow, onTime, mode: "displacement", picked: -1 });
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
const rate = make(
"select",
{
"aria-label": "Speed of the film",
onchange: () => {
this.rate = +rate.value;
},
},
...RATES.map((r) => make("option", { value: r, selected: r === this.rate }, `\u00d7${r}`)),
);
this.pause();
return make("div", { class: "row bar" }, this.button, this.slider, rate, this.readout);
}
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
}
toggle() {
this.playing ? this.pause() : this.play();
}
pause() {
this.playing = false;
this.button.textContent = "\u25b6";
this.button.setAttribute("aria-label", "Play");
}
play() {
this.playing = true;
this.button.textContent = "\u275a\u275a";
this.button.setAttribute("aria-label", "Pause");
if (this.time >= this.end) this.show(this.start);
let last = performance.now();
const step = (now) => {
if (!this.playing) return;
this.show(this.time + (this.rate * Math.min(now - last, 100)) / 1000);
last = now;
if (this.time >= this.end) this.pause();
else requestAnimationFrame(step);
};
requestAnimationFrame(step);
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
class Section {
constructor({ run, array, frames }) {
this.run = run;
const get = (name) => array(`mesh.${name}`)?.values;
[this.x, this.y, this.material, this.liquefied] = ["x", "y", "material", "liquefied"].map(get);
const corners = array("mesh.corners");
this.count = corners.columns;
this.corners = [0, 1, 2, 3].map((c) =>
corners.values.subarray(c * this.count, (c + 1) * this.count),
);
this.fields = this.findFields(get);
this.mode = Object.keys(this.fields)[0];
this.picked = -1;
this.view = new View({
run,
windows: frames.dam,
range: frames.range,
label: "Elements of the section before the flow. Plus and minus zoom.",
paint: (view, c) => this.paint(view, c),
find: (view, x, y) => this.find(x, y),
});
this.key = make("div", { class: "keyrow" }, this.colourKey());
this.element = make(
"div",
{},
make(
"div",
{ class: "row" },
choice("Colour of the elements", Object.keys(this.fields), this.mode, (mode) => {
this.mode = mode;
this.key.replaceChildren(this.colourKey());
this.view.redraw();
}),
this.view.controls(),
),
this.key,
this.view.plot,
this.lines(),
);
}
findFields(get) {
const fields = {},
scaled = (values, factor) => values && values.map((v) => v * factor);
const top = (values) => extent(values)[1];
const add = (name, values, low, high, scale, label, unit) => {
if (values) fields[name] = { values, low, high, scale, label, unit };
};
add("pore pressure", get("r_u"), 0, 1, "viridis", "r_u at transfer", "");
const strain = scaled(get("strain"), 100);
if (strain)
add(
"shear strain",
strain,
0,
Math.max(1, quantile(strain, 0.99)),
"plasma",
"shear strain at transfer",
"%",
);
const strength = scaled(get("strength"), 1e-3);
if (strength.some(isFinite)) {
const [low, high] = extent(strength);
add("residual strength", strength, high > low ? low : 0, high || 1, "cividis", "S_r", "kPa");
}
const sigma = scaled(get("sigma_v0"), 1e-3);
add(
"vertical stress",
sigma,
0,
top(sigma),
"viridis",
"initial effective vertical stress",
"kPa",
);
fields.soils = null;
return fields;
}
soilColours() {
const tags = [...new Set(this.material)].sort((a, b) => a - b);
return new Map(
tags.map((tag, k) => [
tag,
{
colour: cssOf(SOILS[k % SOILS.length]),
name: this.run.soils.find((s) => s.tag === tag)?.name || `soil ${tag}`,
},
]),
);
}
colourKey() {
const field = this.fields[this.mode];
if (!field) return colourKey({ list: [...this.soilColours().values()] });
return colourKey({
label: field.label,
low: number(field.low),
high: number(field.high, field.unit),
gradient: gradientOf(field.scale),
note: "grey: not defined there",
});
}
lines() {
const entry = (colour, text, wide) => {
const line = draw(
"svg",
{ width: 22, height: 8 },
draw("line", {
x1: 1,
x2: 21,
y1: 4,
y2: 4,
stroke: `var(--${colour})`,
"stroke-width": wide,
}),
);
return make("span", { class: "entry" }, line, text);
};
return make(
"p",
{ class: "note" },
entry("sky", "water at rest, with the pond where it stands above the ground", 2),
entry("red", "lower boundary of what liquefied", 2),
entry("ink", "limits of section and soils", 1),
);
}
quad(view, e) {
const c = view.context;
c.beginPath();
this.corners.forEach((corner, k) => {
const n = corner[e];
c[k ? "lineTo" : "moveTo"](view.px(this.x[n]), view.py(this.y[n]));
});
c.closePath();
}
paint(view, c) {
const field = this.fields[this.mode],
soils = this.soilColours();
const still = cssVariable("--still"),
stops = field && stopsOf(field.scale);
c.lineWidth = 0.6;
for (let e = 0; e < this.count; ++e) {
this.quad(view, e);
const value = field?.values[e];
c.fillStyle = c.strokeStyle = !field
? soils.get(this.material[e]).colour
: isFinite(value)
? cssOf(mixed(stops, (value - field.low) / (field.high - field.low)))
: still;
c.fill();
c.stroke();
}
this.paintPond(view, c);
view.drawOutline(true);
const { run } = this,
sky = cssVariable("--sky");
view.line(
run.water.map(([x, y]) => [x, y]),
{ colour: sky, width: 2 },
);
view.line(run.lower_boundary, { colour: cssVariable("--red"), width: 1.8 });
if (run.toe_m !== null) view.upright(run.toe_m, "toe", cssVariable("--ink"), 0);
if (this.picked < 0) return;
this.quad(view, this.picked);
c.strokeStyle = cssVariable("--ink");
c.lineWidth = 2;
c.stroke();
}
paintPond(view, c) {
const pond = this.run.water.filter(([, y, ground]) => y !== null && y > ground - 0.25);
if (!pond.length) return;
c.fillStyle = cssVariable("--sky");
c.globalAlpha = 0.45;
const half = Math.abs(this.run.water[1][0] - this.run.water[0][0]) / 2;
for (const [x, y, ground] of pond)
if (y > ground)
c.fillRect(
view.px(x - half),
view.py(y),
2 * half * view.sx + 0.5,
view.py(ground) - view.py(y),
);
c.globalAlpha = 1;
const inside = pond.filter(
([x]) => view.px(x) > VIEW.left && view.px(x) < VIEW.left + view.wide,
);
if (inside.length < 3) return;
const [x, y] = inside[inside.length >> 1],
px = view.px(x),
py = view.py(y);
c.beginPath();
c.moveTo(px - 6, py - 10);
c.lineTo(px + 6, py - 10);
c.lineTo(px, py - 1);
c.closePath();
c.fill();
c.font = `11px ${cssVariable("--sans")}`;
c.fillStyle = cssVariable("--ink");
c.textAlign = "left";
c.fillText("pond", px + 10, py - 3);
}
find(x, y) {
this.picked = -1;
if (!isFinite(x)) return null;
const inside = (e) => {
let within = false;
for (let k = 0, j = 3; k < 4; j = k++) {
const a = this.corners[k][e],
b = this.corners[j][e];
if (
this.y[a] > y !== this.y[b] > y &&
x < ((this.x[b] - this.x[a]) * (y - this.y[a])) / (this.y[b] - this.y[a]) + this.x[a]
)
within = !within;
}
return within;
};
for (let e = 0; e < this.count; ++e)
if (inside(e)) {
this.picked = e;
const rows = Object.values(this.fields)
.filter(Boolean)
.map((f) => [f.label, number(f.values[e], f.unit)]);
rows.push(["x, y", `${number(x)}, ${number(y, "m")}`]);
return {
head: `${this.soilColours().get(this.material[e]).name}, ${this.liquefied[e] ? "liquefied" : "not liquefied"}`,
rows,
};
}
return null;
}
}
function quantile(values, share) {
const sorted = values.filter(isFinite).sort();
return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 0;
}
function frontSpeed(t, front) {
return t.map((now) => {
const a = Math.max(now - 0.5, t[0]),
b = Math.min(now + 0.5, t[t.length - 1]);
return b > a ? (interpolated(t, front, b) - interpolated(t, front, a)) / (b - a) : 0;
});
}
function flowCharts(run, flow, pick) {
const mega = (name) => flow[name].map((v) => v / 1e6),
per = (name) => flow[name].map((v) => 100 * v);
const x = { label: "time since transfer", unit: "s", from: 0 },
group = "flow",
t = flow.t;
const most = extent(flow.gravity)[1];
const errors = (name) => per(name).map((v, i) => (flow.gravity[i] > 0.01 * most ? v : NaN));
const line = (name, y, colour, dash) => ({ name, x: t, y, colour, dash });
const far =
run.toe_m === null
? line("front", flow.front, LINE.blue)
: line("runout", flow.runout, LINE.blue);
return [
new Chart({
title: run.toe_m === null ? "Front" : "Runout",
x,
group,
pick,
series: [far],
y: {
label: run.toe_m === null ? "x of the front" : "runout",
unit: "m",
zero: run.toe_m !== null,
span: 1,
},
}),
new Chart({
title: "Speed",
x,
group,
pick,
y: { label: "speed", unit: "m/s", zero: true, span: 0.1 },
series: [
line("fastest point", flow.max_speed, LINE.orange),
line("front, mean over 1 s", frontSpeed(t, flow.front), LINE.blue),
],
}),
new Chart({
title: "Energies",
x,
group,
pick,
y: { label: "energy", unit: "MJ/m", zero: true, span: 1e-6 },
series: [
line("work of gravity", mega("gravity"), LINE.ink),
line("into the soil", mega("plastic"), LINE.blue),
line("ground friction", mega("friction"), LINE.orange),
line("damping and transfer", mega("damping"), LINE.green, "5 3"),
line("kinetic", mega("kinetic"), LINE.red),
line("elastic", mega("strain"), LINE.purple, "5 3"),
],
}),
new Chart({
title: "Residuals of the balances",
x,
group,
pick,
y: { label: "residual", unit: "%", zero: true, span: 0.01 },
series: [
line("energy / work of gravity", errors("energy_error"), LINE.blue),
line("momentum / impulse of gravity", errors("momentum_error"), LINE.orange, "5 3"),
],
note: "Left out while gravity has done less than a hundredth of its work.",
}),
];
}
function motionCharts(run, array, marks) {
const motion = array("motion.a"),
charts = [];
if (!motion) return charts;
const a = motion.values.map((v) => v / 9.81),
t = a.map((_, i) => i * run.motion_dt_s);
const x = { label: "time from the start of the motion", unit: "s" };
charts.push(
new Chart({
title: "Motion",
x,
group: "shaking",
marks,
y: { label: "acceleration", unit: "g", zero: true },
series: [{ name: "acceleration of the base motion", x: t, y: a, colour: LINE.blue }],
}),
);
charts.push(
new Chart({
title: "Response spectrum",
x: { label: "period", unit: "s", log: true },
y: { label: "PSA, 5 % damping", unit: "g", log: true },
series: [
{
name: "pseudo-acceleration",
x: array("spectrum.logT").values.map((v) => 10 ** v),
y: array("spectrum.psa").values.map((v) => v / 9.81),
colour: LINE.blue,
},
],
}),
);
return charts;
}
function shakingCharts(run, array, marks) {
const charts = [],
x = { label: "time from the start of the motion", unit: "s" },
group = "shaking";
const get = (name) => array(name)?.values;
const zone = get("zone.t"),
palette = [LINE.blue, LINE.orange, LINE.green, LINE.purple];
if (zone && run.windows.length)
charts.push(
new Chart({
title: "Depth of liquefaction",
x,
group,
marks,
y: { label: "depth", unit: "m", zero: true, invert: true, span: 1 },
series: run.windows.flatMap((name, w) => [
{ name: `${name}, so far`, x: zone, y: get(`zone.deepest${w}`), colour: palette[w % 4] },
{
name: `${name}, at present`,
x: zone,
y: get(`zone.depth${w}`),
colour: palette[w % 4],
dash: "2 3",
},
]),
}),
);
const crest = get("crest.t");
if (crest)
charts.push(
new Chart({
title: "Crest",
x,
group,
marks,
y: { label: "movement", unit: "m", zero: true, span: 0.01 },
series: [
{ name: "down", x: crest, y: get("crest.down"), colour: LINE.red },
{ name: "downstream", x: crest, y: get("crest.across"), colour: LINE.blue },
],
note: `Node at x = ${number(run.crest[0])}, y = ${number(run.crest[1], "m")}, against the base of the section.`,
}),
);
if (zone)
charts.push(
new Chart({
title: "Kinetic energy of the section",
x,
group,
marks,
y: { label: "energy", unit: "MJ/m", zero: true },
series: [
{
name: "relative to the base",
x: zone,
y: get("zone.kinetic").map((v) => v / 1e6),
colour: LINE.red,
},
],
}),
new Chart({
title: "Quality of the mesh",
x,
group,
marks,
y: { label: "Q", span: 0.01 },
series: [
{
name: "smallest Jacobian of a Gauss point",
x: zone,
y: get("zone.quality"),
colour: LINE.green,
},
],
}),
);
return charts;
}
function themeButton(redraw) {
const root = document.documentElement,
names = ["auto", "light", "dark"];
let stored = null;
try {
stored = localStorage.getItem("flowslide-theme");
} catch {
}
let at = Math.max(0, names.indexOf(stored));
const button = make("button", { type: "button", onclick: () => set((at + 1) % 3) });
const set = (next) => {
at = next;
if (at) root.dataset.theme = names[at];
else delete root.dataset.theme;
button.textContent = `theme: ${names[at]}`;
try {
localStorage.setItem("flowslide-theme", names[at]);
} catch {
}
redraw();
};
set(at);
return button;
}
function printLight(redraw) {
const root = document.documentElement;
let before;
window.addEventListener("beforeprint", () => {
before = root.dataset.theme;
root.dataset.theme = "light";
redraw();
});
window.addEventListener("afterprint", () => {
if (before) root.dataset.theme = before;
else delete root.dataset.theme;
redraw();
});
}
async function start() {
const run = JSON.parse(document.getElementById("run").textContent);
const array = unpack(await inflate(document.getElementById("arrays").textContent), run.arrays);
const flow = Object.fromEntries(
run.arrays
.filter(({ name }) => name.startsWith("flow."))
.map(({ name }) => [name.slice(5), Array.from(array(name).values)]),
);
const points = new Points(run, array),
frames = sectionWindows(run, points);
const marks = run.shaken ? [{ x: run.transfer_time_s, text: "transfer" }] : [];
let player = null;
const charts = flowCharts(run, flow, (t) => {
player.pause();
player.show(t);
});
const windows = Object.values(frames.flow),
profile = new Profile(run, points, windows[windows.length - 1]);
player = new Player({
run,
points,
frames,
flow,
onTime: (t) => {
charts.forEach((c) => c.showTime(t));
profile.show(t);
},
});
document.getElementById("player").replaceChildren(player.element);
player.fillStrip();
const section = run.section ? new Section({ run, array, frames }) : null;
document
.getElementById("section")
.replaceChildren(
section
? section.element
: make("p", {}, "The mesh has too many nodes for this page; zone.pvd shows it."),
);
const shaking = [...motionCharts(run, array, marks), ...shakingCharts(run, array, marks)];
const grid = (title, list) =>
list.length
? [make("h3", {}, title), make("div", { class: "grid" }, ...list.map((c) => c.element))]
: [];
document
.getElementById("charts")
.replaceChildren(
...grid("The flow", [...charts, ...profile.charts]),
...grid("The shaking", shaking),
);
const redraw = () => {
player.view.redraw();
player.fillStrip();
section?.view.redraw();
};
document
.getElementById("tools")
.replaceChildren(
themeButton(redraw),
make("button", { type: "button", onclick: () => window.print() }, "print"),
);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
printLight(redraw);
document.documentElement.dataset.ready = "yes";
}
start().catch((error) => {
document.documentElement.dataset.ready = "no";
document.getElementById("player").replaceChildren(make("p", { class: "problem" }, error.message));
document.getElementById("before-the-flow").hidden = document.getElementById("histories").hidden =
true;
console.error(error);
});
})();

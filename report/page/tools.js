/* Small things that every part uses. */

/** An element with attributes, handlers ("onclick") and children; text never becomes markup. */
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

/** Steps of 1, 2 or 5 between which about `count` fit. */
function ticks(low, high, count) {
  const raw = (high - low) / Math.max(count, 1);
  // of a range of rounding alone no step can be counted through
  if (!(raw > 1e-10 * Math.max(Math.abs(low), Math.abs(high))) || !isFinite(raw)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    out.push(k * step);
  return out;
}

/** As many digits as tell neighbouring ticks apart. */
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

/** Index k with x[k] <= value < x[k + 1], kept inside. */
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

/** Where an event is in an element [px]. */
function placeIn(element, event) {
  const box = element.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** Puts a tip beside the place x of something `width` wide, on the side that has room. */
function putTip(tip, width, x, top, gap = 12) {
  const right = x > width / 2;
  tip.style.left = right ? "" : `${x + gap}px`;
  tip.style.right = right ? `${width - x + gap}px` : "";
  if (top !== undefined) tip.style.top = `${Math.max(0, top)}px`;
}

function save(name, blob) {
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Says over the title of a page of a run of which row of a study it is. */
function tellRow(page, words) {
  const heading = page.querySelector("h1");
  if (!heading || !words) return;
  page.querySelector(".of-row")?.remove();
  const line = page.createElement("p");
  line.className = "of-row";
  line.textContent = words;
  heading.before(line);
  page.title = `${words} \u2013 ${heading.textContent}`;
}

const cssVariable = (name) =>
  getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Calls back when an element has got another width, once now. */
function onWidth(element, redraw) {
  let width = 0;
  new ResizeObserver(() => {
    if (Math.abs(element.clientWidth - width) < 1) return;
    width = element.clientWidth;
    redraw();
  }).observe(element);
}

/** A drawing as text, with the styles that the page gives it, for a paper: always light. */
function drawingAlone(svg) {
  const copy = svg.cloneNode(true);
  const root = document.documentElement,
    theme = root.dataset.theme;
  root.dataset.theme = "light";
  const styled = ["fill", "stroke", "stroke-width", "font-size", "font-family", "opacity"];
  const from = svg.querySelectorAll("*"),
    to = copy.querySelectorAll("*");
  from.forEach((element, i) => {
    const style = getComputedStyle(element);
    for (const name of styled) to[i].setAttribute(name, style.getPropertyValue(name));
  });
  if (theme) root.dataset.theme = theme;
  else delete root.dataset.theme;
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  const [, , width, height] = svg.getAttribute("viewBox").split(" ");
  copy.setAttribute("width", width);
  copy.setAttribute("height", height);
  return { text: copy.outerHTML, width: +width, height: +height };
}

const fileName = (title) => title.toLowerCase().replace(/[^a-z0-9]+/g, "-");
const svgBlob = (text) => new Blob([text], { type: "image/svg+xml" });

function saveDrawing(title, svg) {
  save(`${fileName(title)}.svg`, svgBlob(drawingAlone(svg).text));
}

/** The same as a picture of points, for programs that take no drawings: white behind, four points
    for each of the screen's. */
async function savePicture(title, svg) {
  const { text, width, height } = drawingAlone(svg),
    image = new Image();
  image.src = URL.createObjectURL(svgBlob(text));
  await image.decode();
  const canvas = make("canvas", { width: Math.round(4 * width), height: Math.round(4 * height) }),
    pen = canvas.getContext("2d");
  pen.fillStyle = "#fff";
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(image.src);
  const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
  save(`${fileName(title)}.png`, blob);
}

/** Buttons that save a drawing; `svg` gives it as it is then. */
function saveButtons(title, svg) {
  return Object.entries({ SVG: saveDrawing, PNG: savePicture }).map(([kind, action]) => {
    const help = `Save this chart as ${kind}`;
    const onclick = () => void action(title(), svg());
    return make("button", { type: "button", title: help, "aria-label": help, onclick }, kind);
  });
}

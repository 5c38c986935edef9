/* Puts the parts into the page. */

function themeButton(redraw) {
  const root = document.documentElement,
    names = ["auto", "light", "dark"];
  let stored = null;
  try {
    stored = localStorage.getItem("flowslide-theme");
  } catch {
    /* files may not store */
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
      /* as above */
    }
    redraw();
  };
  set(at);
  return button;
}

/** Paper is white whatever the screen is. */
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

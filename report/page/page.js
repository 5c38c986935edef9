/* Puts the parts into the page. */

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
  linkPlayer(player);
  tellRow(document, new URLSearchParams(location.search).get("row"));
  document.documentElement.dataset.ready = "yes";
}

start().catch((error) => {
  document.documentElement.dataset.ready = "no";
  document.getElementById("player").replaceChildren(make("p", { class: "problem" }, error.message));
  document.getElementById("before-the-flow").hidden = document.getElementById("histories").hidden =
    true;
  console.error(error);
});

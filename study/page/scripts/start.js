/* Puts the parts into the page of a study. */

function start() {
  const data = JSON.parse(document.getElementById("study").textContent);
  const rows = new Rows(data),
    runs = new Runs(rows, data.embedded);
  const place = document.getElementById("explorer");
  let explorer = null;
  if (rows.find(data.start.x) && rows.find(data.start.y)) {
    explorer = new Explorer({ rows, start: data.start, runs });
    place.replaceChildren(explorer.element);
  } else place.replaceChildren(make("p", {}, "No row has told a number yet."));
  const fronts = startFronts(data, rows, runs);
  for (const figure of document.querySelectorAll("#charts figure")) {
    const words = figure.querySelector("figcaption"),
      svg = figure.querySelector("svg");
    words.append(
      make("span", { class: "buttons" }, ...saveButtons(() => words.firstChild.textContent, () => svg)),
    );
  }
  let strands = null;
  startStrands(data, rows).then((s) => (strands = s));
  const redraw = () => {
    explorer?.chart.render();
    fronts?.render();
    strands?.render();
  };
  document
    .getElementById("tools")
    .replaceChildren(
      themeButton(redraw),
      make("button", { type: "button", onclick: () => window.print() }, "print"),
    );
  printLight(redraw);
  document.documentElement.dataset.ready = "yes";
}

function startFronts(data, rows, runs) {
  const place = document.getElementById("fronts");
  if (!place) return null;
  const stories = JSON.parse(document.getElementById("stories").textContent);
  const onPick = (row, side) => {
    if (!rows.pages[row]) return false;
    runs.open(row, side);
    return true;
  };
  const fronts = new Fronts({ rows, stories, by: data.start.colour, onPick });
  place.replaceChildren(fronts.element);
  return fronts;
}

/** Their numbers are packed, and unpacking takes its time: the page is ready without them. */
async function startStrands(data, rows) {
  const place = document.getElementById("strands");
  if (!place) return null;
  try {
    const curves = JSON.parse(document.getElementById("curves").textContent);
    const bytes = await inflate(document.getElementById("curve-arrays").textContent);
    const strands = new Strands({
      rows,
      curves,
      array: unpack(bytes, curves.arrays),
      by: data.start.colour,
    });
    place.replaceChildren(strands.element);
    return strands;
  } catch (error) {
    place.replaceChildren(make("p", { class: "problem" }, error.message));
    console.error(error);
    return null;
  }
}

try {
  start();
} catch (error) {
  document.documentElement.dataset.ready = "no";
  document
    .getElementById("explorer")
    .replaceChildren(make("p", { class: "problem" }, error.message));
  console.error(error);
}

/* Colour scales as tables of 256 pixels, and colours of lines and soils. */

/* Sixteen stops of Matplotlib's maps (van der Walt, Smith and Firing; Nunez et al. 2018), CC0. */
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

/* Okabe and Ito's palette, distinguishable with any colour vision; those of the figures. */
const LINE = {
  blue: "var(--blue)",
  orange: "var(--orange)",
  green: "var(--green)",
  red: "var(--red)",
  purple: "var(--purple)",
  ink: "var(--ink)",
};
const SOILS = ["c9b18b", "8c6d46", "b5723a", "bdbdbd", "6b6b6b", "e5d9c5"].map(rgbOf);

/** Earth tones for soils, a scale for the layers that liquefied; as in the figures. */
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

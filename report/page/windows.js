/* What part of the section to show: as in the figures of the report. */

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
  const above = top + 0.35 * height,
    below = lowest(run, points, low) - 0.08 * height;
  return { flow: windows, dam, range: [below, above], damRange: [low - 0.08 * height, above] };
}

/** Of the section, of the flow at any time, and of the ground under it. */
function lowest(run, points, low) {
  let [left, right] = [Infinity, -Infinity];
  for (let k = 0; k < points.ys.length; ++k) {
    low = Math.min(low, points.ys[k]);
    left = Math.min(left, points.xs[k]);
    right = Math.max(right, points.xs[k]);
  }
  for (const y of groundBetween(run.ground, left, right)) low = Math.min(low, y);
  return low;
}

/** Heights of the ground at two places, and of its corners between them. */
function groundBetween(line, left, right) {
  if (!line.length) return [];
  const between = line.filter(([x]) => x > left && x < right).map(([, y]) => y);
  return [groundAt(line, left), ...between, groundAt(line, right)];
}

/** The ground goes on level beyond its ends. */
function groundAt(line, at) {
  const k = line.findIndex(([x]) => x >= at);
  if (k <= 0) return (k ? line[line.length - 1] : line[0])[1];
  const [[x0, y0], [x1, y1]] = [line[k - 1], line[k]];
  return y0 + ((y1 - y0) * (at - x0)) / (x1 - x0);
}

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
  return { flow: windows, dam, range: [low - 0.08 * height, top + 0.35 * height] };
}

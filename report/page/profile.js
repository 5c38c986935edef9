/* Depth and speed of what moved, against distance: at the instant of the player, and the largest. */

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

  /** The stored state nearest to a time. */
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

/* Points of a flow, painted pixel by pixel: tens of thousands at sixty frames per second without
   a graphics processor. */

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

  /** Positions at a time, straight between stored states. */
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

  /** Pixel of every point; 0 for grey. */
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

  /** Paints into the canvas of a view; squares as large as the soil they stand for. */
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

  /** The nearest point, if the pointer is on its square; -1 if none is. */
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

  /** Places of a point in all stored states. */
  track(i) {
    return Array.from({ length: this.frames }, (_, k) => [
      this.xs[k * this.count + i],
      this.ys[k * this.count + i],
    ]);
  }
}

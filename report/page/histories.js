/* The charts of a run: what happened over time, in the ground and in the flow. */

/** Mean speed of the front over a second: between two rows it is the noise of single points. */
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

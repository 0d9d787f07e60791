"use strict";
// What all figures share: data, theme, axes.
//
// A view is a part of the page with data of its own: all of it, or one bearing of many at one speed.
// It inherits from `report` and has `root`, its element, and `data`. Later files put their part into
// `report.parts`; each part is run for each view and adds to `drawings`, by kind, functions that take
// the element and return traces and layout.
((report) => {
  report.parts = [];
  report.view = (root, data) => {
    const view = Object.assign(Object.create(report), { root, data, drawings: {} });
    for (const part of report.parts) { part(view); }
    return view;
  };
  // The element of a view that plays a part in it.
  report.find = function find(part) { return this.root.querySelector(`[data-part="${part}"]`); };

  // Colours come from the style sheet, so that light, dark and print agree with the page.
  const theme = (report.theme = {});
  report.readTheme = (printing) => {
    const style = getComputedStyle(document.documentElement);
    const names = ["paper", "ink", "soft", "line", "first", "second", "third", "faint", "bad", "text", "wash"];
    Object.assign(theme, Object.fromEntries(names.map((name) => [name, style.getPropertyValue("--" + name).trim()])));
    theme.size = printing ? 10 : 12;
    if (printing) {
      Object.assign(theme, { paper: "#ffffff", ink: "#171c21", soft: "#58626c", line: "#e0e3e1", wash: "#f1f4f6",
        first: "#0b6aa8", second: "#c8550a", third: "#00795c", faint: "#98a2ab", bad: "#a8230f" });
    }
  };

  report.withUnit = (name, unit) => (unit ? `${name} [${unit}]` : name);

  report.axis = (title, extra) => Object.assign({
    title: { text: title, standoff: 8 }, gridcolor: theme.line, zerolinecolor: theme.line,
    linecolor: theme.faint, tickcolor: theme.faint, ticks: "outside", ticklen: 4, showline: true,
    automargin: true, separatethousands: false, exponentformat: "power", minexponent: 6,
  }, extra);

  report.layout = (xaxis, yaxis, extra) => Object.assign({
    font: { family: theme.text, size: theme.size, color: theme.soft },
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    margin: { l: 58, r: 18, t: 12, b: 46 }, xaxis, yaxis, showlegend: false,
    legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom", font: { color: theme.ink } },
    hoverlabel: { bgcolor: theme.paper, bordercolor: theme.line, font: { color: theme.ink, family: theme.text } },
    shapes: [], annotations: [],
    modebar: { bgcolor: "rgba(0,0,0,0)", color: theme.faint, activecolor: theme.first },
  }, extra);

  // Colour maps that are even to the eye, beside those of the library (Viridis, Cividis).
  const even = (...colours) => colours.map((colour, i) => [i / (colours.length - 1), colour]);
  report.scales = {
    plasma: even("#0d0887", "#46039f", "#7201a8", "#9c179e", "#bd3786", "#d8576b", "#ed7953", "#fb9f3a", "#fdca26", "#f0f921"),
    inferno: even("#000004", "#1b0c41", "#4a0c6b", "#781c6d", "#a52c60", "#cf4446", "#ed6925", "#fb9b06", "#f7d13d", "#fcffa4"),
  };

  // Where the unrolled surface is cut open: at 0°, or at 180° if the pressure peaks within 60° of 0°, so that
  // a peak is not cut. Angles past the cut are drawn a turn further on and named as they are.
  report.seamFor = (peak) => (peak > 60 && peak < 300 ? 0 : 180);
  report.unrolled = (angle, seam) => (angle < seam ? angle + 360 : angle);
  report.angleTicks = (seam, step) => {
    const places = Array.from({ length: 360 / step + 1 }, (_, i) => seam + i * step);
    return { range: [seam, seam + 360], tickvals: places, ticktext: places.map((place) => String(place === 360 && seam === 0 ? 360 : place % 360)) };
  };
  // Columns of a row in the order in which they are drawn.
  report.cut = (angles, seam) => {
    const first = Math.max(angles.findIndex((angle) => angle >= seam), 0);
    const turn = (row) => [...row.slice(first), ...row.slice(0, first)];
    return { angles: turn(angles).map((angle) => report.unrolled(angle, seam)), turn };
  };

  report.parts.push((view) => {
    const { film, position, cycle } = view.data;
    const peak = film ? film.frames[film.jumps.length > 0 ? film.jumps[0].frame : 0].highest.angle : position ? 0 : 180;
    view.seam = view.seamFor(peak ?? 180);
    view.bearingAxis = () => view.axis("Bearing angle [°]", view.angleTicks(view.seam, 45));
    if (cycle) { report.complete(cycle); }
  });

  // A packed field as numbers: whole steps from the lowest value; the highest code is a gap.
  report.unpacked = (packed) => {
    const text = atob(packed.data);
    const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
    const missing = packed.bytes === 1 ? 255 : 65535;
    const values = new Float64Array(bytes.length / packed.bytes);
    for (let i = 0; i < values.length; i += 1) {
      const code = packed.bytes === 1 ? bytes[i] : bytes[2 * i] + 256 * bytes[2 * i + 1];
      values[i] = code === missing ? NaN : packed.low + packed.step * code;
    }
    return values;
  };

  // A curve as a list, however it is written.
  report.numbers = (curve) => {
    if (!curve || Array.isArray(curve)) { return curve; }
    if (curve.data === undefined) {
      return Array.from({ length: curve.count }, (_, i) => (curve.step === undefined ? curve.even : curve.first + i * curve.step));
    }
    return Array.from(report.unpacked(curve), (value) => (Number.isNaN(value) ? null : value));
  };

  // The curves of a cycle as lists, with those that follow from others.
  report.complete = (cycle) => {
    for (const [name, curve] of Object.entries(cycle)) {
      if (curve?.count !== undefined || curve?.data !== undefined) { cycle[name] = report.numbers(curve); }
    }
    const join = (names, value) => cycle[names[0]].map((first, i) => (first === null ? null : value(first, cycle[names[1]][i], cycle.journal_angle[i] * Math.PI / 180)));
    cycle.load ??= join(["load_x", "load_y"], (x, y) => Math.hypot(x, y));
    cycle.eccentricity ??= join(["x", "y"], (x, y) => Math.hypot(x, y));
    cycle.power ??= join(["friction_power", "squeeze_power"], (friction, squeeze) => friction + squeeze);
    cycle.journal_load_x ??= join(["load_x", "load_y"], (x, y, a) => Math.cos(a) * x + Math.sin(a) * y);
    cycle.journal_load_y ??= join(["load_x", "load_y"], (x, y, a) => Math.cos(a) * y - Math.sin(a) * x);
  };

  // Rows along the axis, each around, of one frame.
  report.rows = (values, around, along, frame) => Array.from({ length: along }, (_, j) => {
    const start = (frame * along + j) * around;
    return Array.from(values.subarray(start, start + around), (value) => (Number.isNaN(value) ? null : value));
  });

  // Whether the browser draws bodies; asked once, because it gives few places to draw them.
  let solids = null;
  report.hasSolids = () => {
    if (solids === null) {
      const canvas = document.createElement("canvas");
      solids = Boolean(canvas.getContext("webgl2") ?? canvas.getContext("webgl"));
    }
    return solids;
  };

  report.largest = (values) => {
    let largest = -Infinity;
    for (const value of values) { if (value > largest) { largest = value; } }
    return largest;
  };

  report.smallest = (values) => {
    let smallest = Infinity;
    for (const value of values) { if (value < smallest) { smallest = value; } }
    return smallest;
  };
})(globalThis.sommerfeld ??= {});

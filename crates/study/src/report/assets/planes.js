"use strict";
// Planes with equal scales: load, orbit, position of the journal.
globalThis.sommerfeld.parts.push((report) => {
  const { theme, axis, layout, withUnit, drawings } = report;
  const { cycle, position, units } = report.data;

  // Equal scales on both axes: a circle is a circle.
  function plane(element, box, titles, unit, traces, extra) {
    const xaxis = axis(withUnit(titles[0], unit), { range: box.x, constrain: "domain", zeroline: true, zerolinecolor: theme.faint });
    const yaxis = axis(withUnit(titles[1], unit), { range: box.y, constrain: "domain", zeroline: true,
      zerolinecolor: theme.faint, scaleanchor: "x", scaleratio: 1 });
    return { traces, layout: layout(xaxis, yaxis, Object.assign({ hovermode: "closest" }, extra)) };
  }

  function squareBox(xs, ys) {
    const finite = (values) => values.filter((value) => value !== null);
    const [x0, x1] = [Math.min(0, ...finite(xs)), Math.max(0, ...finite(xs))];
    const [y0, y1] = [Math.min(0, ...finite(ys)), Math.max(0, ...finite(ys))];
    const half = 0.66 * Math.max(x1 - x0, y1 - y0, 1e-12);
    const [cx, cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
    return { x: [cx - half, cx + half], y: [cy - half, cy + half] };
  }

  // Marks that lie on each other share one label.
  function joined(marks, pixel) {
    const groups = [];
    for (const mark of marks) {
      const [x, y] = pixel(mark.x, mark.y);
      const near = groups.find((group) => Math.hypot(group.px - x, group.py - y) < 9);
      if (near) { near.label += ", " + mark.label; } else { groups.push({ ...mark, px: x, py: y }); }
    }
    return groups;
  }

  // Points every 4 pixels along a path.
  function walked(points) {
    const walk = [];
    for (let i = 1; i < points.length; i += 1) {
      const [a, b] = [points[i - 1], points[i]];
      const pieces = Math.max(1, Math.ceil(Math.hypot(b[0] - a[0], b[1] - a[1]) / 4));
      for (let k = 0; k < pieces; k += 1) {
        walk.push([a[0] + (b[0] - a[0]) * k / pieces, a[1] + (b[1] - a[1]) * k / pieces]);
      }
    }
    return walk;
  }

  // Labels of the crank-angle marks: each takes the free place nearest to its mark, so that labels
  // cover neither each other nor the curve. Sizes in pixels; the plot area is square.
  function markLabels(element, box, single, paths) {
    const side = Math.max(120, Math.min(element.clientWidth - 76, element.clientHeight - 58));
    const scale = side / (box.x[1] - box.x[0]);
    const pixel = (x, y) => [(x - box.x[0]) * scale, (box.y[1] - y) * scale];
    const taken = [];
    const marks = joined(single, pixel);
    const dots = marks.map((mark) => pixel(mark.x, mark.y));
    const curve = paths.flatMap(([xs, ys]) => walked(xs.map((x, i) => pixel(x, ys[i]))));
    return marks.map((mark, index) => {
      const [px, py] = dots[index];
      const half = [4 + 3.6 * mark.label.length, 9];
      let best = null;
      for (const reach of [10, 20, 34, 50, 70]) {
        for (let k = 0; k < 16; k += 1) {
          const turn = k * Math.PI / 8;
          const dx = Math.cos(turn) * (reach + half[0] * Math.abs(Math.cos(turn)));
          const dy = Math.sin(turn) * (reach + half[1]);
          const [cx, cy] = [px + dx, py + dy];
          const inside = ([x, y]) => Math.abs(x - cx) < half[0] + 1 && Math.abs(y - cy) < half[1] + 1;
          const outside = cx - half[0] < 0 || cx + half[0] > side || cy - half[1] < 0 || cy + half[1] > side;
          const meets = taken.filter((t) => Math.abs(t.cx - cx) < t.half[0] + half[0] && Math.abs(t.cy - cy) < t.half[1] + half[1]).length;
          const leader = [0.3, 0.5, 0.7, 0.9].map((share) => [px + share * dx, py + share * dy]);
          const hidden = dots.filter((dot, other) => other !== index && leader.some(([x, y]) => Math.hypot(x - dot[0], y - dot[1]) < 8)).length;
          const cost = 100 * meets + 60 * hidden + 1.5 * curve.filter(inside).length + 40 * dots.filter(inside).length + (outside ? 100 : 0) + 0.6 * reach;
          if (!best || cost < best.cost) { best = { cost, dx, dy, cx, cy, half }; }
        }
      }
      taken.push(best);
      return { x: mark.x, y: mark.y, text: mark.label, showarrow: true, arrowhead: 0, arrowwidth: 0.7,
        arrowcolor: theme.soft, standoff: 5, ax: best.dx, ay: best.dy, xanchor: "center", yanchor: "middle",
        font: { color: theme.ink, size: 11 }, borderpad: 1 };
    });
  }

  function markDots(marks) {
    return { x: marks.map((mark) => mark.x), y: marks.map((mark) => mark.y), mode: "markers", showlegend: false, hoverinfo: "skip",
      marker: { color: theme.paper, size: 8, line: { color: theme.second, width: 2 } } };
  }

  const whole = "crank angle %{customdata:.1f}°<br>x %{x:.4~g}, y %{y:.4~g}<extra></extra>";

  function path(xs, ys, color) {
    return { x: xs, y: ys, mode: "lines", line: { color: color ?? theme.first, width: 1.6, simplify: false }, showlegend: false, customdata: cycle.angle,
      hovertemplate: whole };
  }

  // Rows nearest to every tenth degree.
  function tenths() {
    const kept = [];
    let next = Math.ceil(cycle.angle[0] / 10) * 10;
    cycle.angle.forEach((angle, index) => {
      if (angle >= next - 1e-6) {
        kept.push(index);
        next = (Math.floor(angle / 10 + 1e-6) + 1) * 10;
      }
    });
    return kept;
  }

  // Dots along a path every ten degrees, coloured by journal speed where that varies.
  function tenthDots(xs, ys, coloured) {
    const kept = tenths();
    const pick = (values) => kept.map((index) => values[index]);
    const speed = pick(cycle.journal_speed);
    const [low, high] = [report.smallest(speed), report.largest(speed)];
    const varies = coloured && high - low > 1e-6 * Math.abs(high);
    const bar = { title: { text: "Journal speed [rad/s]", side: "right" }, thickness: 11, outlinewidth: 0, len: 0.72, ticks: "outside", ticklen: 3, nticks: 5 };
    return { x: pick(xs), y: pick(ys), mode: "markers", showlegend: false, customdata: kept.map((index) => [cycle.angle[index], cycle.journal_speed[index]]),
      hovertemplate: "crank angle %{customdata[0]:.1f}°<br>x %{x:.4~g}, y %{y:.4~g}<br>journal speed %{customdata[1]:.4~g} rad/s<extra></extra>",
      marker: varies ? { color: speed, colorscale: "Viridis", size: 6, showscale: true, colorbar: bar, line: { color: theme.paper, width: 0.5 } }
        : { color: theme.first, size: 4.5 } };
  }

  function loadPolar(element, xs, ys, key, besides) {
    const box = squareBox([...xs, ...besides.flatMap((one) => one.x)], [...ys, ...besides.flatMap((one) => one.y)]);
    const marks = cycle.marks.map((mark) => ({ label: mark.label, x: mark[key][0], y: mark[key][1] }));
    return plane(element, box, ["Load x", "Load y"], units.force,
      [...besides, path(xs, ys, theme.faint), tenthDots(xs, ys, true), markDots(marks)],
      { annotations: markLabels(element, box, marks, [[xs, ys]]), margin: { l: 58, r: 8, t: besides.length ? 34 : 12, b: 46 }, showlegend: besides.length > 0 });
  }

  // The load that hinges at the mains would give, where the run had an elastic shaft.
  function hinged() {
    if (!cycle.hinged) { return []; }
    return [{ x: cycle.hinged_x, y: cycle.hinged_y, mode: "lines", name: "hinges at the mains (determinate)", customdata: cycle.angle, hovertemplate: whole,
      line: { color: theme.second, width: 1.3, dash: "dot", simplify: false } }];
  }

  const circle = (radius, style) => ({ type: "circle", x0: -radius, x1: radius, y0: -radius, y1: radius, layer: "between", line: style });

  function clearanceCircle() {
    return [circle(1, { color: theme.ink, width: 1.6 }), circle(0.5, { color: theme.line, width: 1, dash: "dot" })];
  }

  function touching() {
    const turns = Array.from({ length: 181 }, (_, i) => i * Math.PI / 90);
    return [turns.map(Math.cos), turns.map(Math.sin)];
  }

  const eccentricityTitles = ["Relative eccentricity x", "Relative eccentricity y"];

  function orbit(element) {
    const reach = Math.max(1.08, 1.05 * report.largest(cycle.eccentricity));
    const box = { x: [-reach, reach], y: [-reach, reach] };
    const marks = cycle.marks.map((mark) => ({ label: mark.label, x: mark.position[0], y: mark.position[1] }));
    return plane(element, box, eccentricityTitles, "–",
      [path(cycle.x, cycle.y), tenthDots(cycle.x, cycle.y, false), markDots(marks), ...failedPlaces()],
      { shapes: clearanceCircle(), annotations: markLabels(element, box, marks, [[cycle.x, cycle.y], touching()]) });
  }

  function failedPlaces() {
    const places = cycle.angle.map((_, index) => index)
      .filter((index) => cycle.failed.some(([angle]) => Math.abs(angle - cycle.angle[index]) < 1e-3));
    if (places.length === 0) { return []; }
    return [{ x: places.map((i) => cycle.x[i]), y: places.map((i) => cycle.y[i]), mode: "markers",
      hovertemplate: "not converged<extra></extra>", marker: { symbol: "x-thin", size: 9, line: { color: theme.bad, width: 2 } } }];
  }

  function journalPosition(element) {
    const vectors = [[position.load, "load", "second"], [position.force, "film force", "third"]].filter(([vector]) => vector);
    const largest = Math.max(...vectors.map(([vector]) => Math.hypot(vector.x, vector.y)), 1e-300);
    // Room for the heads of the arrows: a label whose place is outside is not drawn at all.
    const heads = vectors.flatMap(([vector]) => [position.x + 0.42 * vector.x / largest, position.y + 0.42 * vector.y / largest]);
    const reach = Math.max(1.3, ...heads.map((head) => Math.abs(head) + 0.08));
    const box = { x: [-reach, reach], y: [-reach, reach] };
    const annotations = vectors.flatMap(([vector, name, color]) => {
      const [dx, dy] = [0.42 * vector.x / largest, 0.42 * vector.y / largest];
      const size = Math.hypot(dx, dy);
      if (!(size > 0.02)) { return []; }
      const [x, y] = [position.x + dx, position.y + dy];
      // Labels stay within the length of their arrows: above the load and below the force where
      // the arrows are flat, beside their heads where they are steep.
      const flat = Math.abs(dx) > Math.abs(dy);
      const above = name === "load" ? 1 : -1;
      return [
        { x, y, ax: position.x, ay: position.y, axref: "x", ayref: "y", text: "", showarrow: true, arrowhead: 2,
          arrowsize: 1.1, arrowwidth: 2.4, arrowcolor: theme[color] },
        { x, y, text: `${name} ${vector.label}`, showarrow: false, font: { color: theme[color] },
          xanchor: flat && dx > 0 ? "right" : "left", yanchor: flat ? (above > 0 ? "bottom" : "top") : "middle",
          xshift: flat ? 0 : 10, yshift: flat ? 7 * above : 0 },
      ];
    });
    const traces = [
      { x: [0, position.x], y: [0, position.y], mode: "lines", hoverinfo: "skip", line: { color: theme.faint, width: 1.2, dash: "dash" } },
      { x: [position.x], y: [position.y], mode: "markers", hovertemplate: "x %{x:.4f}, y %{y:.4f}<extra></extra>",
        marker: { color: theme.first, size: 11, line: { color: theme.paper, width: 1.5 } } },
    ];
    return plane(element, box, eccentricityTitles, "–", traces, { shapes: clearanceCircle(), annotations });
  }

  if (cycle) {
    drawings["load-polar"] = (element) => loadPolar(element, cycle.load_x, cycle.load_y, "load", hinged());
    drawings["load-polar-journal"] = (element) => loadPolar(element, cycle.journal_load_x, cycle.journal_load_y, "journal_load", []);
    drawings.orbit = orbit;
  }
  if (position) { drawings.position = journalPosition; }
});

"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const { cycle, field, position, units } = data;

  // Colours come from the style sheet, so that light, dark and print agree with the page.
  let theme = {};
  function readTheme(printing) {
    const style = getComputedStyle(document.documentElement);
    const names = ["paper", "ink", "soft", "line", "first", "second", "third", "faint", "bad", "text"];
    theme = { size: printing ? 10 : 12 };
    Object.assign(theme, Object.fromEntries(names.map((name) => [name, style.getPropertyValue("--" + name).trim()])));
    if (printing) {
      Object.assign(theme, { paper: "#ffffff", ink: "#1c2126", soft: "#5b646d", line: "#dfe1de",
        first: "#0072b2", second: "#c8550a", third: "#00795c", faint: "#9aa3ab", bad: "#a3210f" });
    }
  }

  const withUnit = (name, unit) => (unit ? `${name} [${unit}]` : name);

  function axis(title, extra) {
    return Object.assign({
      title: { text: title, standoff: 8 }, gridcolor: theme.line, zerolinecolor: theme.line,
      linecolor: theme.faint, tickcolor: theme.faint, ticks: "outside", ticklen: 4, showline: true,
      automargin: true, separatethousands: false, exponentformat: "power",
    }, extra);
  }

  function layout(xaxis, yaxis, extra) {
    return Object.assign({
      font: { family: theme.text, size: theme.size, color: theme.soft },
      paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
      margin: { l: 58, r: 18, t: 12, b: 46 }, xaxis, yaxis, showlegend: false,
      legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom", font: { color: theme.ink } },
      hoverlabel: { bgcolor: theme.paper, bordercolor: theme.line, font: { color: theme.ink } },
      shapes: [], annotations: [],
      modebar: { bgcolor: "rgba(0,0,0,0)", color: theme.faint, activecolor: theme.first },
    }, extra);
  }

  // ---- curves over an angle ------------------------------------------------------------------

  function crankAxis() {
    const [first, last] = [cycle.angle[0], cycle.angle[cycle.angle.length - 1]];
    return axis("Crank angle [°]", { range: [first, last], tick0: 0, dtick: last - first > 400 ? 90 : 45 });
  }

  const bearingAxis = () => axis("Bearing angle [°]", { range: [0, 360], tick0: 0, dtick: 45 });

  function line(x, y, name, color, extra) {
    return Object.assign({ x, y, name, mode: "lines", line: { color: theme[color], width: 1.8, simplify: false },
      hovertemplate: "%{y:.4~g}" }, extra);
  }

  function curves(traces, title, xaxis, extra) {
    const legend = traces.filter((trace) => trace.showlegend !== false).length > 1;
    return { traces, layout: layout(xaxis, axis(title, { rangemode: "tozero" }), Object.assign({
      hovermode: "x unified", showlegend: legend, margin: { l: 58, r: 18, t: legend ? 34 : 12, b: 46 },
    }, extra)) };
  }

  // A mark on the extreme of a curve with its value, on the side that has room.
  function extremeMark(element, mark, rise) {
    if (!mark || mark.value === null) { return { traces: [], annotations: [] }; }
    const [first, last] = [cycle.angle[0], cycle.angle[cycle.angle.length - 1]];
    const reach = element.clientWidth < 400 ? 20 : 40;
    const right = (1 - (mark.angle - first) / (last - first)) * (element.clientWidth - 76) > reach + 9.5 * theme.size;
    return {
      traces: [{ x: [mark.angle], y: [mark.value], mode: "markers", hoverinfo: "skip", showlegend: false,
        marker: { color: theme.second, size: 9, line: { color: theme.paper, width: 1.5 } } }],
      annotations: [{ x: mark.angle, y: mark.value, text: mark.label, showarrow: true, arrowhead: 0,
        arrowwidth: 1, arrowcolor: theme.second, standoff: 6, ax: right ? reach : -reach, ay: -rise,
        xanchor: right ? "left" : "right", font: { color: theme.ink }, bgcolor: theme.paper, borderpad: 2 }],
    };
  }

  function limitLines(limits) {
    return {
      shapes: limits.map((limit) => ({ type: "line", xref: "paper", x0: 0, x1: 1, y0: limit.value, y1: limit.value,
        line: { color: theme.bad, width: 1.2, dash: "dash" } })),
      annotations: limits.map((limit) => ({ xref: "paper", x: 1, xanchor: "right", y: limit.value, yanchor: "bottom",
        text: limit.label, showarrow: false, font: { color: theme.bad } })),
    };
  }

  function failedMarks(column) {
    if (cycle.failed.length === 0) { return []; }
    return [{ x: cycle.failed.map((row) => row[0]), y: cycle.failed.map((row) => row[column]), mode: "markers",
      name: "not converged", showlegend: false, hovertemplate: "not converged",
      marker: { symbol: "x-thin", size: 9, line: { color: theme.bad, width: 2 } } }];
  }

  function judged(element, values, title, mark, rise, limits, failedColumn) {
    const extreme = extremeMark(element, mark, rise);
    const lines = limitLines(limits);
    const traces = [line(cycle.angle, values, title, "first", { showlegend: false }), ...extreme.traces,
      ...(failedColumn ? failedMarks(failedColumn) : [])];
    return curves(traces, title, crankAxis(), {
      shapes: lines.shapes, annotations: [...lines.annotations, ...extreme.annotations] });
  }

  // ---- planes: load, orbit, position ---------------------------------------------------------

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
    return { x: marks.map((mark) => mark.x), y: marks.map((mark) => mark.y), mode: "markers", hoverinfo: "skip",
      marker: { color: theme.paper, size: 7, line: { color: theme.second, width: 2 } } };
  }

  function path(xs, ys) {
    return { x: xs, y: ys, mode: "lines", line: { color: theme.first, width: 1.8, simplify: false }, customdata: cycle.angle,
      hovertemplate: "crank angle %{customdata:.1f}°<br>x %{x:.4~g}, y %{y:.4~g}<extra></extra>" };
  }

  function loadPolar(element) {
    const box = squareBox(cycle.load_x, cycle.load_y);
    const marks = cycle.marks.map((mark) => ({ label: mark.label, x: mark.load[0], y: mark.load[1] }));
    return plane(element, box, ["Load x", "Load y"], units.force, [path(cycle.load_x, cycle.load_y), markDots(marks)],
      { annotations: markLabels(element, box, marks, [[cycle.load_x, cycle.load_y]]) });
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
    const reach = Math.max(1.08, ...cycle.eccentricity.map((value) => 1.05 * value));
    const box = { x: [-reach, reach], y: [-reach, reach] };
    const marks = cycle.marks.map((mark) => ({ label: mark.label, x: mark.position[0], y: mark.position[1] }));
    const failed = failedPlaces();
    return plane(element, box, eccentricityTitles, "–", [path(cycle.x, cycle.y), markDots(marks), ...failed],
      { shapes: clearanceCircle(), annotations: markLabels(element, box, marks, [[cycle.x, cycle.y], touching()]) });
  }

  function failedPlaces() {
    const angles = new Set(cycle.failed.map((row) => row[0]));
    const places = cycle.angle.map((_, index) => index).filter((index) => angles.has(cycle.angle[index]));
    if (places.length === 0) { return []; }
    return [{ x: places.map((i) => cycle.x[i]), y: places.map((i) => cycle.y[i]), mode: "markers",
      hovertemplate: "not converged<extra></extra>", marker: { symbol: "x-thin", size: 9, line: { color: theme.bad, width: 2 } } }];
  }

  function journalPosition(element) {
    const box = { x: [-1.3, 1.3], y: [-1.3, 1.3] };
    const vectors = [[position.load, "load", "second"], [position.force, "film force", "third"]].filter(([vector]) => vector);
    const largest = Math.max(...vectors.map(([vector]) => Math.hypot(vector.x, vector.y)), 1e-300);
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

  // ---- maps ----------------------------------------------------------------------------------

  // A dark line under a light one is seen on every colour of a map.
  const onMap = [{ color: "#101418", extra: 2.2 }, { color: "#ffffff", extra: 0 }];

  function placeMark(mark, symbol, size) {
    return onMap.map(({ color, extra }) => ({ x: [mark.angle], y: [mark.axial], mode: "markers", showlegend: false, cliponaxis: false,
      hovertemplate: mark.label + "<extra></extra>",
      marker: { symbol, size: size + extra, color, line: { color, width: 1.8 + extra } } }));
  }

  function feedOutlines() {
    // An outline that crosses 0° shows at both ends of the map.
    const shifts = [-360, 0, 360];
    return field.feeds.flatMap((feed) => shifts
      .filter((shift) => feed.half_length < 180 ? true : shift === 0)
      .map((shift) => ({ centre: feed.half_length < 180 ? feed.angle + shift : 180, feed }))
      .filter(({ centre }) => centre + feed.half_length > 0 && centre - feed.half_length < 360)
      .flatMap(({ centre }) => onMap.map(({ color, extra }) => ({ type: feed.round ? "circle" : "rect",
        x0: centre - feed.half_length, x1: centre + feed.half_length,
        y0: feed.axial - feed.half_width, y1: feed.axial + feed.half_width, line: { color, width: 1.4 + extra } }))));
  }

  function map(values, scale, unit, name, marks, range) {
    const traces = [Object.assign({ type: "heatmap", x: field.angle, y: field.axial, z: values, colorscale: scale,
      hovertemplate: `angle %{x:.1f}°, axial %{y:.2f} mm<br>${name} %{z:.4~g} ${unit}<extra></extra>`,
      colorbar: { title: { text: unit || name, side: "right" }, thickness: 14, outlinewidth: 0, len: 1.0, ticks: "outside",
        ticklen: 3, tickcolor: theme.faint } }, range), ...marks];
    const half = field.half_width;
    return { traces, layout: layout(bearingAxis(), axis("Axial position [mm]", { range: [-half, half], showgrid: false }),
      { hovermode: "closest", shapes: feedOutlines() }) };
  }

  function pressureMap() {
    const isPositive = field.pressure.every((row) => row.every((value) => value === null || value >= 0));
    return map(field.pressure, "Viridis", units.pressure, "film pressure",
      [...placeMark(field.thinnest, "x-thin", 8), ...placeMark(field.highest, "circle-open", 12)], isPositive ? { zmin: 0 } : {});
  }

  function fractionMap() {
    return map(field.fraction, "Cividis", "", "film fraction", placeMark(field.thinnest, "x-thin", 8), { zmin: 0, zmax: 1 });
  }

  // ---- sweeps --------------------------------------------------------------------------------

  // Cases over what varies: along one key a line, of a second key a line for each of its values, of
  // more keys marks over the one that the reader chooses.
  function sweepCurves(figure) {
    const { inputs, status, labels, joined: style } = data.sweep;
    const [along, second] = inputs;
    const isNumber = (input) => input.values.every((value) => typeof value === "number");
    const lines = new Map();
    figure.values.forEach((value, i) => {
      const name = style === "second" ? `${second.label} ${second.values[i]}` : figure.label;
      if (!lines.has(name)) { lines.set(name, []); }
      lines.get(name).push(i);
    });
    const traces = [...lines].map(([name, cases], at) => {
      if (isNumber(along) && style !== "none") { cases.sort((a, b) => along.values[a] - along.values[b]); }
      const of = (list) => cases.map((i) => list[i]);
      const color = theme[["first", "second", "third"][at % 3]];
      return { x: of(along.values), y: of(figure.values), text: of(labels), name, mode: style === "none" ? "markers" : "lines+markers",
        hovertemplate: "%{y:.4~g}<br>%{text}<extra></extra>",
        line: { color, width: 1.8, dash: ["solid", "dash", "dot", "dashdot"][Math.floor(at / 3) % 4] },
        marker: { size: 7, color: of(status).map((word) => (word === "converged" ? color : theme.bad)),
          symbol: of(status).map((word) => (word === "converged" ? "circle" : "x")) },
        error_y: figure.errors ? { type: "data", array: of(figure.errors), color, thickness: 1.2, width: 4 } : { visible: false } };
    });
    const legend = traces.length > 1;
    const limits = limitLines(figure.limits);
    // Lines of limits do not count for the range of an axis; points that are not seen do.
    traces.push({ x: figure.limits.map(() => along.values[0]), y: figure.limits.map((limit) => limit.value), mode: "markers",
      marker: { opacity: 0 }, hoverinfo: "skip", showlegend: false });
    const failed = figure.values.map((value, i) => i).filter((i) => figure.values[i] === null && status[i] !== "not-run");
    const crosses = style === "none" ? [] : failed.slice(0, 60).map((i) => ({ x: along.values[i], y: 0, yref: "paper", yanchor: "bottom",
      text: "✕", hovertext: labels[i], showarrow: false, font: { color: theme.bad } }));
    const menus = style !== "none" ? [] : [{ x: 1, xanchor: "right", y: 1.02, yanchor: "bottom", bgcolor: theme.paper,
      buttons: inputs.map((input) => ({ label: input.label, method: "update", args: [{ x: [input.values] },
        { "xaxis.title.text": input.label, "xaxis.type": isNumber(input) ? "linear" : "category" }, [0]] })) }];
    return { traces, layout: layout(axis(along.label, { type: isNumber(along) ? "linear" : "category" }), axis(figure.label), {
      hovermode: "closest", showlegend: legend, updatemenus: menus, shapes: limits.shapes, annotations: [...limits.annotations, ...crosses],
      margin: { l: 58, r: 18, t: legend || menus.length ? 40 : 12, b: 46 } }) };
  }

  // ---- all figures ---------------------------------------------------------------------------

  const drawings = {
    "load-polar": loadPolar,
    orbit,
    position: journalPosition,
    "pressure-map": pressureMap,
    "fraction-map": fractionMap,
    thickness: (element) => judged(element, cycle.thickness, "Film thickness [µm]", cycle.thinnest, 30, cycle.thickness_limits, 1),
    pressure: (element) => judged(element, cycle.pressure, withUnit("Film pressure", units.pressure), cycle.highest, 4, cycle.pressure_limits),
    power: () => curves([
      line(cycle.angle, cycle.power, "total", "first"),
      line(cycle.angle, cycle.friction_power, "friction", "second", { line: { color: theme.second, width: 1.5, dash: "dash" } }),
      line(cycle.angle, cycle.squeeze_power, "squeeze", "third", { line: { color: theme.third, width: 1.5, dash: "dot" } }),
    ], withUnit("Power", units.power), crankAxis()),
    flow: () => curves([
      line(cycle.angle, cycle.side_flow, "side", "first"),
      line(cycle.angle, cycle.feed_flow, "feed", "second", { line: { color: theme.second, width: 1.5, dash: "dash" } }),
      line(cycle.angle, cycle.storage, "storage", "third", { line: { color: theme.third, width: 1.5, dash: "dot" } }),
    ], withUnit("Flow", units.flow), crankAxis()),
    eccentricity: () => curves([line(cycle.angle, cycle.eccentricity, "relative eccentricity", "first", { showlegend: false }),
      ...failedMarks(2)], "Eccentricity [–]", crankAxis()),
    load: () => curves([
      line(cycle.angle, cycle.load, "magnitude", "first"),
      line(cycle.angle, cycle.load_x, "x", "second", { line: { color: theme.second, width: 1.5, dash: "dash" } }),
      line(cycle.angle, cycle.load_y, "y", "third", { line: { color: theme.third, width: 1.5, dash: "dot" } }),
    ], withUnit("Load", units.force), crankAxis()),
    tilt: () => curves([line(cycle.angle, cycle.tilt_x, "about x", "first"),
      line(cycle.angle, cycle.tilt_y, "about y", "second", { line: { color: theme.second, width: 1.5, dash: "dash" } })],
    "Tilt [mrad]", crankAxis()),
    "middle-pressure": () => curves([line(field.angle, field.middle_pressure, "film pressure", "first")],
      withUnit("Film pressure", units.pressure), bearingAxis()),
    "middle-thickness": () => curves([
      line(field.angle, field.middle_thickness, "gap", "first"),
      line(field.angle, field.middle_thickness.map((h, i) => h * field.middle_fraction[i]), "oil in the gap", "second",
        { line: { color: theme.second, width: 1.5, dash: "dash" } }),
    ], "Film thickness [µm]", bearingAxis()),
  };

  for (const [kind, figure] of Object.entries(data.sweep ? data.sweep.figures : {})) {
    drawings[kind] = () => sweepCurves(figure);
  }

  // The tool bar needs a pointer that hovers; on paper and on touch screens it would only cover curves.
  const config = { displaylogo: false, displayModeBar: matchMedia("(hover: hover)").matches ? "hover" : false, responsive: true, plotlyServerURL: "",
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"] };

  function drawAll(printing) {
    readTheme(printing);
    for (const element of document.querySelectorAll("[data-kind]")) {
      const figure = drawings[element.dataset.kind](element);
      const named = Object.assign({}, config, { toImageButtonOptions: { format: "svg", filename: element.dataset.kind } });
      // Paper does not tell its size by events: the size is that of the style sheet for print.
      const size = printing ? { autosize: false, width: element.clientWidth, height: element.clientHeight }
        : { autosize: true };
      Plotly.react(element, figure.traces, Object.assign(figure.layout, size), named);
    }
  }

  drawAll(false);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawAll(false));
  addEventListener("beforeprint", () => {
    document.documentElement.classList.add("printing");
    drawAll(true);
  });
  addEventListener("afterprint", () => {
    document.documentElement.classList.remove("printing");
    drawAll(false);
    document.querySelectorAll("[data-kind]").forEach((element) => Plotly.Plots.resize(element));
  });
})();

"use strict";
// Curves over crank angle or bearing angle.
globalThis.sommerfeld.parts.push((report) => {
  const { theme, axis, layout, withUnit, bearingAxis, drawings } = report;
  const { cycle, middle, units, charts, stability } = report.data;

  const dashes = ["solid", "dash", "dot", "dashdot", "11px,3px"];
  const colours = ["first", "second", "third", "soft", "bad"];

  function crankAxis(angles) {
    const [first, last] = [angles[0], angles[angles.length - 1]];
    return axis("Crank angle [°]", { range: [first, last], tick0: 0, dtick: last - first > 400 ? 90 : 45 });
  }

  function line(x, y, name, order, extra) {
    return Object.assign({ x, y, name, mode: "lines",
      line: { color: theme[colours[order % 5]], width: order === 0 ? 1.9 : 1.5, dash: dashes[(order + Math.floor(order / 5)) % 5], simplify: false },
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

  const limitLines = report.limitLines = (limits) => {
    return {
      shapes: limits.map((limit) => ({ type: "line", xref: "paper", x0: 0, x1: 1, y0: limit.value, y1: limit.value,
        line: { color: theme.bad, width: 1.2, dash: "dash" } })),
      annotations: limits.map((limit) => ({ xref: "paper", x: 1, xanchor: "right", y: limit.value, yanchor: "bottom",
        text: limit.label, showarrow: false, font: { color: theme.bad } })),
    };
  };

  function failedMarks(column) {
    if (cycle.failed.length === 0) { return []; }
    return [{ x: cycle.failed.map((row) => row[0]), y: cycle.failed.map((row) => row[column]), mode: "markers",
      name: "not converged", showlegend: false, hovertemplate: "not converged",
      marker: { symbol: "x-thin", size: 9, line: { color: theme.bad, width: 2 } } }];
  }

  function judged(element, values, title, mark, rise, limits, failedColumn) {
    const extreme = extremeMark(element, mark, rise);
    const lines = limitLines(limits);
    const traces = [line(cycle.angle, values, title, 0, { showlegend: false }), ...extreme.traces,
      ...(failedColumn ? failedMarks(failedColumn) : [])];
    return curves(traces, title, crankAxis(cycle.angle), {
      shapes: lines.shapes, annotations: [...lines.annotations, ...extreme.annotations] });
  }

  // Dots of several series over each other keep their shapes: filled, then open.
  function dots(series, order) {
    return { x: series.x, y: series.y, name: series.name, mode: "markers", customdata: series.names ?? series.y,
      hovertemplate: "%{customdata:.4~g}", cliponaxis: false,
      marker: { color: theme[colours[order % 5]], size: order === 0 ? 4.5 : 2.5 } };
  }

  const bars = (series, order) => ({ type: "bar", x: series.x, y: series.y, name: series.name, hovertemplate: "%{y:.4~g}",
    marker: { color: theme[colours[order % 5]] } });
  const draw = { dots, bars, line: (one, order) => line(one.x, one.y, one.name, order) };

  function chart(name) {
    if (charts[name].nothing) { return charts[name]; }
    const { x_title: xTitle, y_title: yTitle, y_range: range } = charts[name];
    const series = charts[name].series.map((one) => Object.assign({}, one, { x: report.numbers(one.x) ?? cycle.angle, y: report.numbers(one.y) }));
    const isAngle = yTitle.startsWith("Bearing angle");
    const places = (one) => (isAngle ? Object.assign({}, one, { y: one.y.map((angle) => (angle === null ? null : report.unrolled(angle, report.seam))),
      names: one.y }) : one);
    const traces = series.map(places).map((one, order) => draw[one.mark](one, order));
    const isCrank = xTitle.startsWith("Crank angle");
    const figure = curves(traces, yTitle, isCrank ? crankAxis(cycle ? cycle.angle : series[0].x) : axis(xTitle));
    // A loop goes back over its own places: the nearest point is meant, not the column.
    if (xTitle.startsWith("Displaced")) { figure.layout.hovermode = "closest"; }
    if (xTitle.startsWith("Eccentricity x")) {
      figure.layout.hovermode = "closest";
      Object.assign(figure.layout.yaxis, { rangemode: "normal", scaleanchor: "x" });
    }
    if (charts[name].y_log) { Object.assign(figure.layout.yaxis, { type: "log", rangemode: "normal", exponentformat: "power", dtick: 1 }); }
    if (range) { figure.layout.yaxis.range = range; }
    if (isAngle) { Object.assign(figure.layout.yaxis, report.angleTicks(report.seam, 90)); }
    return figure;
  }

  for (const name of Object.keys(charts ?? {})) { drawings[name] = () => chart(name); }

  const over = (...series) => series.map(([name, values], order) => line(cycle.angle, values, name, order));

  if (cycle) {
    Object.assign(drawings, {
      thickness: (element) => judged(element, cycle.thickness, "Film thickness [µm]", cycle.thinnest, 30, cycle.thickness_limits, 1),
      pressure: (element) => judged(element, cycle.pressure, withUnit("Film pressure", units.pressure), cycle.highest, 4, cycle.pressure_limits),
      power: () => curves(over(["total", cycle.power], ["friction", cycle.friction_power], ["squeeze", cycle.squeeze_power]),
        withUnit("Power", units.power), crankAxis(cycle.angle)),
      flow: () => curves(over(["feed", cycle.feed_flow], ["side front", cycle.side_front], ["side rear", cycle.side_rear],
        ["storage", cycle.storage]), withUnit("Flow", units.flow), crankAxis(cycle.angle)),
      eccentricity: () => curves([line(cycle.angle, cycle.eccentricity, "relative eccentricity", 0, { showlegend: false }),
        ...failedMarks(2)], "Relative eccentricity [–]", crankAxis(cycle.angle)),
      load: () => curves(over(["magnitude", cycle.load], ["x", cycle.load_x], ["y", cycle.load_y]),
        withUnit("Load", units.force), crankAxis(cycle.angle)),
      tilt: () => curves(over(["about x", cycle.tilt_x], ["about y", cycle.tilt_y]), "Tilt [mrad]", crankAxis(cycle.angle)),
    });
  }
  if (stability) {
    drawings.stability = () => {
      const rotor = limitLines(stability.rotor === null ? [] : [{ value: stability.rotor, label: "rotor" }]);
      const onsets = stability.onsets.map((onset) => ({ type: "line", yref: "paper", y0: 0, y1: 1, x0: onset.speed,
        x1: onset.speed, line: { color: theme.second, width: 1.2, dash: "dot" } }));
      const labels = stability.onsets.map((onset) => ({ yref: "paper", y: 1, yanchor: "top", x: onset.speed,
        xanchor: "left", text: onset.label, showarrow: false, font: { color: theme.second } }));
      const figure = curves([line(stability.speed, stability.mass, "threshold mass", 0, { mode: "lines+markers" })],
        "Threshold mass [kg]", axis("Journal speed [rpm]"),
        { shapes: [...rotor.shapes, ...onsets], annotations: [...rotor.annotations, ...labels] });
      // The threshold falls by decades over speed; on an even scale it would meet the rotor unseen.
      const masses = [...stability.mass, stability.rotor].filter((mass) => mass > 0);
      if (Math.max(...masses) > 20 * Math.min(...masses)) {
        Object.assign(figure.layout.yaxis, { type: "log", dtick: "D2", minexponent: 9 });
        // Annotations, unlike shapes, give the logarithm on such an axis.
        for (const label of rotor.annotations) { label.y = Math.log10(label.y); }
      }
      return figure;
    };
  }
  if (middle) {
    const { angles, turn } = report.cut(middle.angle, report.seam);
    Object.assign(middle, { angle: angles, pressure: turn(middle.pressure), fraction: turn(middle.fraction), thickness: turn(middle.thickness) });
    Object.assign(drawings, {
      "middle-pressure": () => curves([line(middle.angle, middle.pressure, "film pressure", 0)],
        withUnit("Film pressure", units.pressure), bearingAxis()),
      "middle-thickness": () => curves([
        line(middle.angle, middle.thickness, "gap", 0),
        line(middle.angle, middle.thickness.map((h, i) => h * middle.fraction[i]), "oil in the gap", 1),
      ], "Film thickness [µm]", bearingAxis()),
    });
  }
});

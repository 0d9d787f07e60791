"use strict";
// The cases of a sweep over what varies.
globalThis.sommerfeld.parts.push((report) => {
  const { theme, axis, layout, drawings, data } = report;
  if (!data.sweep) { return; }

  // Cases over what varies: along one key a line, of a second key a line for each of its values, of
  // more keys marks over the one that the reader chooses.
  const { inputs, status, labels, joined: style } = data.sweep;
  const [along, second] = inputs;
  const isNumber = (input) => input.values.every((value) => typeof value === "number");
  // A scale of decades with its numbers written out.
  const decades = (low, high) => {
    const [first, last] = [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high))];
    const steps = last - first > 4 ? [1] : [1, 2, 5];
    const places = Array.from({ length: last - first + 1 }, (_, i) => first + i).flatMap((power) => steps.map((step) => Number(`${step}e${power}`)));
    return { type: "log", tickvals: places, ticktext: places.map((place) => (place < 1e-4 || place >= 1e6 ? place.toExponential() : String(place))) };
  };
  // Values over decades stand on such a scale.
  const scaleOf = (input) => {
    if (!isNumber(input)) { return { type: "category" }; }
    const [low, high] = [Math.min(...input.values), Math.max(...input.values)];
    return low > 0 && high > 20 * low ? decades(low, high) : { type: "linear" };
  };

  function linesOf(figure) {
    const lines = new Map();
    figure.values.forEach((value, i) => {
      const name = style === "second" ? `${second.label} ${second.values[i]}` : figure.label;
      if (!lines.has(name)) { lines.set(name, []); }
      lines.get(name).push(i);
    });
    return [...lines].map(([name, cases], at) => {
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
  }

  function sweepCurves(figure) {
    const traces = linesOf(figure);
    const legend = traces.length > 1;
    const limits = report.limitLines(figure.limits);
    // Lines of limits do not count for the range of an axis; points that are not seen do.
    traces.push({ x: figure.limits.map(() => along.values[0]), y: figure.limits.map((limit) => limit.value), mode: "markers",
      marker: { opacity: 0 }, hoverinfo: "skip", showlegend: false });
    const failed = figure.values.map((value, i) => i).filter((i) => figure.values[i] === null && status[i] !== "not-run");
    // Annotations give the logarithm of a place on a scale of decades.
    const place = scaleOf(along).type === "log" ? Math.log10 : (value) => value;
    const crosses = style === "none" ? [] : failed.slice(0, 60).map((i) => ({ x: place(along.values[i]), y: 0, yref: "paper", yanchor: "bottom",
      text: "✕", hovertext: labels[i], showarrow: false, font: { color: theme.bad } }));
    const menus = style !== "none" ? [] : [{ x: 1, xanchor: "right", y: 1.02, yanchor: "bottom", bgcolor: theme.paper,
      buttons: inputs.map((input) => ({ label: input.label, method: "update", args: [{ x: [input.values] },
        { "xaxis.title.text": input.label, "xaxis.type": scaleOf(input).type, "xaxis.tickvals": scaleOf(input).tickvals ?? null,
          "xaxis.ticktext": scaleOf(input).ticktext ?? null }, [0]] })) }];
    return { traces, layout: layout(axis(along.label, scaleOf(along)), axis(figure.label), {
      hovermode: "closest", showlegend: legend, updatemenus: menus, shapes: limits.shapes, annotations: [...limits.annotations, ...crosses],
      margin: { l: 58, r: 18, t: legend || menus.length ? 40 : 12, b: 46 } }) };
  }

  // Where each line of friction is least, with a ring around the point.
  function least(figure, lines, unit) {
    return lines.flatMap((line) => {
      const found = line.y.filter((value) => value !== null);
      const at = line.y.indexOf(Math.min(...found));
      // A least value at an end of the speeds is none of the curve.
      if (!(at > 0 && at < line.y.length - 1)) { return []; }
      const logarithm = scaleOf(along).type === "log" ? Math.log10 : (value) => value;
      return [{ at: logarithm(line.x[at]), value: line.y[at],
        text: `least ${Number(line.y[at].toPrecision(3))} at ${Number(line.x[at].toPrecision(6))}${unit}`,
        ring: { x: [line.x[at]], y: [line.y[at]], mode: "markers", hoverinfo: "skip", showlegend: false,
          marker: { size: 13, symbol: "circle-open", color: line.line.color, line: { width: 1.8 } } } }];
    });
  }

  // Friction, film and contact over one speed, one below the other.
  function stribeck() {
    const panels = [["y", [0.56, 1]], ["y2", [0.25, 0.51]], ["y3", [0, 0.2]]];
    const titles = ["Friction<br>coefficient [–]", "Film over<br>roughness [–]", "Contact<br>share [%]"];
    const traces = [];
    const axes = {};
    const annotations = [];
    const unit = (along.label.match(/\[(.*)\]/) ?? ["", ""])[1];
    data.sweep.stribeck.forEach((key, at) => {
      const figure = data.sweep.figures[key];
      const [name, domain] = panels[at];
      const color = theme[["first", "second", "third"][at]];
      const lines = linesOf(figure);
      for (const trace of lines) {
        // Along one speed each panel has its colour; of several loads each load has its own.
        const own = style === "second" ? {} : { line: Object.assign({}, trace.line, { color }),
          marker: Object.assign({}, trace.marker, { color: trace.marker.color.map((it) => (it === theme.bad ? it : color)) }) };
        traces.push(Object.assign(trace, own, { yaxis: name, legendgroup: trace.name, showlegend: at === 0 && style === "second" }));
      }
      // Nominal gaps below zero, where asperities carry, have no place on a scale of decades.
      const found = figure.values.filter((value) => value !== null);
      const isWide = at < 2 && Math.min(...found) > 0 && Math.max(...found) > 10 * Math.min(...found);
      const scale = isWide ? decades(Math.min(...found), Math.max(...found)) : { rangemode: "tozero" };
      axes[name.replace("y", "yaxis")] = axis("", Object.assign({ domain, anchor: "x" }, scale));
      // All titles at one place, however wide the numbers of their scales are.
      annotations.push({ text: titles[at], textangle: -90, xref: "paper", yref: "paper", x: 0, xshift: -64, xanchor: "center",
        y: 0.5 * (domain[0] + domain[1]), yanchor: "middle", showarrow: false, font: { color: theme.soft, size: theme.size + 1 } });
      if (at > 0) { return; }
      for (const { at: x, value, text, ring } of least(figure, lines, unit ? ` ${unit}` : "")) {
        traces.push(Object.assign(ring, { yaxis: name }));
        annotations.push({ text, x, y: isWide ? Math.log10(value) : value, xref: "x", yref: name, showarrow: false,
          yanchor: "middle", xanchor: "right", xshift: -12, font: { color: theme.ink, size: theme.size } });
      }
    });
    const xaxis = axis(along.label.replace("operation.speed", "Speed"), Object.assign(scaleOf(along), { anchor: "y3" }));
    return { traces, layout: layout(xaxis, axes.yaxis, Object.assign(axes, { hovermode: "closest", annotations,
      showlegend: style === "second", margin: { l: 84, r: 18, t: style === "second" ? 40 : 12, b: 46 } })) };
  }
  if (data.sweep.stribeck) { drawings.stribeck = stribeck; }

  for (const [kind, figure] of Object.entries(data.sweep.figures)) {
    drawings[kind] = () => sweepCurves(figure);
  }
});

"use strict";
// The cases of a sweep over what varies.
globalThis.sommerfeld.parts.push((report) => {
  const { theme, axis, layout, drawings, data } = report;
  if (!data.sweep) { return; }

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
    const limits = report.limitLines(figure.limits);
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

  for (const [kind, figure] of Object.entries(data.sweep.figures)) {
    drawings[kind] = () => sweepCurves(figure);
  }
});

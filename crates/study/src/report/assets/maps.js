"use strict";
// Maps over the unrolled surface, and what shell and journal have seen.
globalThis.sommerfeld.parts.push((report) => {
  const { theme, axis, layout, drawings, unpacked, rows, scales } = report;
  const { surfaces, units } = report.data;

  // A dark line under a light one is seen on every colour of a map.
  const onMap = [{ color: "#101418", extra: 2.2 }, { color: "#ffffff", extra: 0 }];

  report.placeMark = (mark, symbol, size) => onMap.map(({ color, extra }) => ({ x: [report.unrolled(mark.angle, report.seam)], y: [mark.axial],
    mode: "markers", showlegend: false, cliponaxis: false, hovertemplate: mark.label + "<extra></extra>",
    marker: { symbol, size: size + extra, color, line: { color, width: 1.8 + extra } } }));

  // Outlines on a map; one that crosses the cut shows at both ends. `turned` in degrees.
  report.outlines = (feeds, turned, seam, dash) => feeds.flatMap((feed) => {
    const isRing = feed.half_length >= 180;
    const middle = isRing ? seam + 180 : (((feed.angle + turned(feed)) % 360) + 360) % 360;
    return (isRing ? [0] : [0, 360, 720, 1080])
      .map((shift) => middle + shift - (isRing ? 0 : 360))
      .filter((centre) => centre + feed.half_length > seam && centre - feed.half_length < seam + 360)
      .flatMap((centre) => onMap.map(({ color, extra }) => ({ type: feed.round ? "circle" : "rect",
        x0: centre - feed.half_length, x1: centre + feed.half_length,
        y0: feed.axial - feed.half_width, y1: feed.axial + feed.half_width,
        line: { color, width: 1.4 + extra, dash: extra ? "solid" : dash ?? "solid" } })));
  });

  report.colourBar = (title) => ({ title: { text: title, side: "right" }, thickness: 12, outlinewidth: 0, len: 1.0,
    ticks: "outside", ticklen: 3, tickcolor: theme.faint, xpad: 6 });

  // A map: places, values row by row, colours, the words of hover and colour bar, and marks on it.
  report.map = ({ angle, axial, half, values, scale, range, name, unit, marks, shapes, surface, seam, reversed }) => {
    const { angles, turn } = report.cut(angle, seam);
    const traces = [Object.assign({ type: "heatmap", x: angles, y: axial, z: values.map(turn), customdata: values.map(() => turn(angle)), colorscale: scale, reversescale: reversed ?? false,
      hovertemplate: `angle %{customdata:.1f}°, axial %{y:.2f} mm<br>${name} %{z:.4~g} ${unit}<extra></extra>`,
      colorbar: report.colourBar(report.withUnit(name.replace("film ", ""), unit || "–")) }, range), ...(marks ?? [])];
    const around = axis(surface === "journal" ? "Journal angle [°]" : "Bearing angle [°]", report.angleTicks(seam, 45));
    return { traces, layout: layout(around, axis("Axial position [mm]", { range: [-half, half], showgrid: false }),
      { hovermode: "closest", shapes: shapes ?? [], margin: { l: 54, r: 10, t: 10, b: 44 } }) };
  };

  if (!surfaces) { return; }
  const kinds = {
    pressure: { scale: "Viridis", name: "largest pressure", unit: units.pressure, zero: true },
    thickness: { scale: scales.plasma, name: "thinnest film", unit: "µm", reversed: true },
    amplitude: { scale: scales.inferno, name: "pressure amplitude", unit: units.pressure, zero: true },
    share: { scale: "Cividis", name: "share with full film", unit: "", whole: true },
    wear: { scale: scales.inferno, name: "wear depth", unit: "nm/h", zero: true },
    worn: { scale: scales.inferno, name: "worn depth", unit: "µm", zero: true },
    energy: { scale: scales.inferno, name: "friction energy", unit: "J/m²", zero: true },
    pv: { scale: "Viridis", name: "pressure times speed", unit: "MW/m²", zero: true },
  };
  // Each surface is cut open away from its own peak.
  const seams = Object.fromEntries(["shell", "journal"].map((surface) => {
    const { angle, pressure } = surfaces[surface];
    const values = unpacked(pressure);
    return [surface, report.seamFor(angle[values.indexOf(report.largest(values)) % angle.length])];
  }));
  // Both surfaces carry one scale of colours, so that they compare at a glance.
  for (const [key, kind] of Object.entries(kinds)) {
    if (!surfaces.shell[key]) { continue; }
    const seen = ["shell", "journal"].filter((surface) => surfaces[surface][key])
      .map((surface) => [surface, unpacked(surfaces[surface][key])]);
    const low = Math.min(...seen.map(([, field]) => report.smallest(field)));
    const high = Math.max(...seen.map(([, field]) => report.largest(field)));
    const range = { zmin: kind.whole || kind.zero ? Math.min(0, low) : low, zmax: kind.whole ? 1 : high };
    for (const [surface, field] of seen) {
      drawings[`${surface}-${key}`] = () => {
        const { angle, axial, feeds } = surfaces[surface];
        const seam = seams[surface];
        const shapes = report.outlines(feeds, () => 0, seam);
        const marks = [];
        if (surface === "journal" && key === "pressure" && surfaces.quiet) {
          shapes.push(...report.outlines([{ ...surfaces.quiet, round: true }], () => 0, seam, "dot"));
          marks.push({ x: [report.unrolled(surfaces.quiet.angle, seam)], y: [0], mode: "markers", hovertemplate: surfaces.quiet.label + "<extra></extra>",
            marker: { size: 5, color: "#ffffff", line: { color: "#101418", width: 1 } } });
        }
        return report.map({ angle, axial, half: surfaces.half_width, values: rows(field, angle.length, axial.length, 0),
          scale: kind.scale, reversed: kind.reversed, range, name: kind.name, unit: kind.unit, shapes, marks, surface, seam });
      };
    }
  }
});

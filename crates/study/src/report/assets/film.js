"use strict";
// The film at an instant: body and maps, driven together by one slider.
globalThis.sommerfeld.parts.push((report) => {
  const { theme, axis, layout, drawings, unpacked, rows, withUnit } = report;
  const { film, units } = report.data;
  if (!film) { return; }

  const [around, along] = [film.angle.length, film.axial.length];
  const fields = {
    pressure: { values: unpacked(film.pressure), scale: "Viridis", name: "film pressure", unit: units.pressure },
    fraction: { values: unpacked(film.fraction), scale: "Cividis", name: "film fraction", unit: "" },
    thickness: { values: unpacked(film.thickness), scale: report.scales.plasma, name: "film thickness", unit: "µm", reversed: true },
  };
  if (film.contact) { fields.contact = { values: unpacked(film.contact), scale: report.scales.inferno, name: "contact pressure", unit: units.pressure, zero: true }; }
  // One field for all frames.
  if (film.temperature) { fields.temperature = { values: unpacked(film.temperature), scale: report.scales.inferno, name: "temperature", unit: "°C", still: true }; }
  for (const field of Object.values(fields)) {
    field.low = report.smallest(field.values);
    field.high = report.largest(field.values);
  }
  const choice = { shape: "bush", colour: "pressure", scale: "cycle" };
  let shown = film.jumps.length > 0 ? film.jumps[0].frame : 0;

  report.frameOfPeak = film.frames[shown];
  const frame = () => film.frames[shown];
  const rowsOf = (name) => rows(fields[name].values, around, along, fields[name].still ? 0 : shown);

  // Range of colours: of pressure over the cycle or this instant, of the others over the cycle.
  function range(name) {
    if (name === "fraction") { return [0, 1]; }
    const { low, high } = fields[name];
    if (name === "thickness") { return [low, high]; }
    // An even temperature is one colour, in the middle of its bar.
    if (name === "temperature") { return high > low ? [low, high] : [low - 1, high + 1]; }
    const top = choice.scale === "cycle" ? high : report.largest(fields[name].values.subarray(shown * around * along, (shown + 1) * around * along));
    return [Math.min(0, low), Math.max(top, 1e-12)];
  }

  const turned = (feed) => (feed.on_journal ? frame().journal_angle : frame().shell_angle);

  function map(name, marks) {
    const field = fields[name];
    const [zmin, zmax] = range(name);
    return report.map({ angle: film.angle, axial: film.axial, half: film.half_width, values: rowsOf(name), scale: field.scale,
      range: { zmin, zmax }, name: field.name, unit: field.unit, marks, seam: report.seam,
      shapes: report.outlines(film.feeds, turned, report.seam) });
  }

  drawings["film-pressure"] = () => map("pressure", [...report.placeMark(frame().thinnest, "x-thin", 8),
    ...report.placeMark(frame().highest, "circle-open", 12)]);
  if (fields.contact) {
    drawings["film-contact"] = () => map("contact", [...report.placeMark(frame().thinnest, "x-thin", 8),
      ...(frame().hardest ? report.placeMark(frame().hardest, "circle-open", 12) : [])]);
  }
  if (fields.temperature) { drawings["film-temperature"] = () => map("temperature"); }
  drawings["film-fraction"] = () => map("fraction", report.placeMark(frame().thinnest, "x-thin", 8));

  // ---- the body of the film ------------------------------------------------------------------

  // Height of the highest pressure above the rings, in bearing radii.
  const exaggeration = 0.75;

  // A finer body looks no different and takes longer to draw: every n-th place around, and along
  // the axis every n-th and the last.
  const every = (count, most) => {
    const stride = Math.ceil(count / most);
    return Array.from({ length: Math.ceil(count / stride) }, (_, i) => i * stride);
  };
  const isCycle = film.frames.length > 1;
  const columns = every(around, isCycle ? 96 : 360);
  const lines = [...new Set([...every(along, isCycle ? 16 : 96), along - 1])];
  const bodyOf = (name) => { const all = rowsOf(name); return lines.map((j) => columns.map((i) => all[j][i])); };
  const bodyAngle = columns.map((i) => film.angle[i]);
  const bodyAxial = lines.map((j) => film.axial[j]);

  const closed = (row) => [...row, row[0]];
  const turns = closed(bodyAngle).map((angle, i) => (angle + (i === columns.length ? 360 : 0)) * Math.PI / 180);

  function surface(x, y, z, wanted) {
    // A speed without that field shows the pressure.
    const colour = wanted in fields ? wanted : "pressure";
    const field = fields[colour];
    const [cmin, cmax] = range(colour);
    return { type: "surface", x, y, z, surfacecolor: bodyOf(colour).map(choice.shape === "bush" ? closed : (row) => row),
      colorscale: field.scale, reversescale: field.reversed ?? false, cmin, cmax, hoverinfo: "skip", showlegend: false,
      lighting: { ambient: 0.72, diffuse: 0.55, specular: 0.08, roughness: 0.9, fresnel: 0.05 },
      lightposition: { x: 2000, y: 6000, z: 9000 },
      colorbar: Object.assign(report.colourBar(withUnit(field.name.replace("film ", ""), field.unit || "–")), { len: 0.55, thickness: 12, x: 0.0, xanchor: "left", y: 0.5 }) };
  }

  const wire = (x, y, z, color, width) => ({ type: "scatter3d", mode: "lines", x, y, z, hoverinfo: "skip", showlegend: false,
    line: { color, width } });
  const words = (x, y, z, text, color) => ({ type: "scatter3d", mode: "text", x, y, z, text, hoverinfo: "skip", showlegend: false,
    textfont: { color, size: theme.size, family: theme.text } });

  function loadArrow(half) {
    const [x, y] = frame().load;
    const size = Math.hypot(x ?? 0, y ?? 0);
    if (!(size > 0)) { return []; }
    const [ux, uy] = [x / size, y / size];
    const tip = 0.78;
    const head = [-1, 1].flatMap((side) => [tip * ux, (tip - 0.15) * ux - side * 0.08 * uy, null]);
    const headY = [-1, 1].flatMap((side) => [tip * uy, (tip - 0.15) * uy + side * 0.08 * ux, null]);
    const shaft = { x: [0, tip * ux, null, ...head], y: [0, tip * uy, null, ...headY] };
    return [wire(shaft.x, shaft.y, shaft.x.map((value) => (value === null ? null : half)), theme.second, 7),
      words([-0.17 * ux], [-0.17 * uy], [half], [frame().load_text], theme.second)];
  }

  function bush() {
    const scale = film.radius;
    const top = range("pressure")[1];
    const half = film.half_width / scale;
    const pressure = bodyOf("pressure").map(closed);
    const radius = pressure.map((row) => row.map((value) => 1 + exaggeration * Math.max(0, value ?? 0) / top));
    const x = radius.map((row) => row.map((r, i) => r * Math.cos(turns[i])));
    const y = radius.map((row) => row.map((r, i) => r * Math.sin(turns[i])));
    const z = radius.map((row, j) => row.map(() => bodyAxial[j] / scale));
    const ring = Array.from({ length: 121 }, (_, i) => i * Math.PI / 60);
    const rings = [-half, half].map((end) => wire(ring.map(Math.cos), ring.map(Math.sin), ring.map(() => end), theme.faint, 3));
    const named = [0, 90, 180, 270];
    const place = (reach, of) => named.map((angle) => reach * of(angle * Math.PI / 180));
    const spokes = named.flatMap((angle) => [0.9, 1, null].map((r) => [r, angle * Math.PI / 180]));
    const along3d = (of) => spokes.map(([r, a]) => (r === null ? null : r * of(a)));
    const ticks = wire(along3d(Math.cos), along3d(Math.sin), spokes.map(([r]) => (r === null ? null : half)), theme.soft, 3);
    const labels = words(place(0.77, Math.cos), place(0.77, Math.sin), named.map(() => half), named.map((angle) => `${angle}°`), theme.soft);
    const { x: xs, y: ys } = reach(top);
    const plain = (range) => ({ visible: false, range });
    const size = 1.12 / Math.max(xs[1] - xs[0], ys[1] - ys[0], 3.2 * half);
    return { traces: [surface(x, y, z, choice.colour), ...rings, ticks, labels, ...axialScale(half), ...loadArrow(half)],
      scene: { domain: { x: [0.08, 1], y: [0, 1] }, xaxis: plain(xs), yaxis: plain(ys), zaxis: plain([-1.6 * half, 1.6 * half]), aspectmode: "manual",
        aspectratio: { x: size * (xs[1] - xs[0]), y: size * (ys[1] - ys[0]), z: size * 3.2 * half },
        camera: { up: { x: 0, y: 1, z: 0 }, eye: { x: 0.66, y: 0.4, z: 1.35 }, center: { x: 0, y: 0, z: 0 } } } };
  }

  // The room that the body takes: over the whole cycle where its scale is that of the cycle, so that
  // the picture stands still while frames pass.
  function reach(top) {
    const box = { x: [-1.18, 1.18], y: [-1.18, 1.18] };
    const highest = film.angle.map(() => 0);
    fields.pressure.values.forEach((value, cell) => {
      const column = cell % around;
      if (value > highest[column]) { highest[column] = value; }
    });
    highest.forEach((value, column) => {
      const tall = choice.scale === "cycle" ? Math.max(0, value) / top : 1;
      const r = 1.03 + exaggeration * tall;
      for (const [key, of] of [["x", Math.cos], ["y", Math.sin]]) {
        const place = r * of(film.angle[column] * Math.PI / 180);
        box[key] = [Math.min(box[key][0], place), Math.max(box[key][1], place)];
      }
    });
    return box;
  }

  // A scale along the axis, on the side of the bearing that is away from the peak.
  function axialScale(half) {
    const side = Math.cos((report.frameOfPeak.highest.angle - 225) * Math.PI / 180) > 0 ? 315 : 225;
    const at = (r) => [r * Math.cos(side * Math.PI / 180), r * Math.sin(side * Math.PI / 180)];
    const [x, y] = at(1.17);
    return [wire([x, x], [y, y], [-half, half], theme.soft, 3),
      words([1.2 * x], [1.2 * y], [1.2 * half], [`z = ±${film.half_width} mm`], theme.soft)];
  }

  function plate() {
    const pressure = bodyOf("pressure");
    const line3d = (title, extra) => Object.assign(axis(title, { gridcolor: theme.line, backgroundcolor: "rgba(0,0,0,0)", showbackground: false,
      color: theme.soft, titlefont: undefined }), extra);
    const scene = { domain: { x: [0.08, 1], y: [0, 1] }, xaxis: line3d("Bearing angle [°]", report.angleTicks(report.seam, 90)),
      yaxis: line3d("Axial position [mm]", { range: [-film.half_width, film.half_width] }),
      zaxis: line3d(withUnit("Film pressure", units.pressure), { range: range("pressure") }),
      aspectmode: "manual", aspectratio: { x: 1.5, y: 0.8, z: 0.75 },
      camera: { up: { x: 0, y: 0, z: 1 }, eye: { x: -0.9, y: -1.95, z: 1.0 }, center: { x: 0.05, y: 0, z: -0.18 } } };
    for (const name of ["xaxis", "yaxis", "zaxis"]) {
      for (const unknown of ["automargin", "titlefont", "standoff", "ticklen"]) { delete scene[name][unknown]; }
      scene[name].title = { text: scene[name].title.text };
    }
    const { angles, turn } = report.cut(bodyAngle, report.seam);
    const sheet = surface(angles, bodyAxial, pressure.map(turn), choice.colour);
    sheet.surfacecolor = sheet.surfacecolor.map(turn);
    return { traces: [sheet], scene };
  }

  const hasSolids = report.hasSolids();

  drawings["film-solid"] = (element) => {
    if (!hasSolids) {
      element.innerHTML = "<p class=\"nothing\">This browser draws no bodies (WebGL is off). The maps beside show the same film.</p>";
      return null;
    }
    const { traces, scene } = choice.shape === "bush" ? bush() : plate();
    // The view opens upwards by an angle of its own: a narrow picture needs a step back.
    const back = Math.max(1, 1.08 * element.clientHeight / Math.max(element.clientWidth, 1));
    scene.camera.eye = Object.fromEntries(Object.entries(scene.camera.eye).map(([key, value]) => [key, back * value]));
    // The camera stays where the reader put it while frames pass, and starts anew with another shape.
    return { traces, layout: layout({}, {}, { scene: Object.assign(scene, { uirevision: choice.shape, bgcolor: "rgba(0,0,0,0)", dragmode: "orbit" }),
      margin: { l: 0, r: 0, t: 0, b: 0 }, uirevision: choice.shape }) };
  };

  // ---- slider, buttons, read-outs ------------------------------------------------------------

  const slider = report.find("frame");
  const play = report.find("play");
  const jumps = report.find("jumps");

  function readOut() {
    const now = frame();
    const values = { crank: [now.crank_text, `instant ${shown + 1} of ${film.frames.length}`], load: [now.load_text, now.load_place], thickness: [now.thickness_text, now.thickness_place],
      pressure: [now.pressure_text, now.pressure_place], contact: [now.contact_text, now.contact_place], eccentricity: [now.eccentricity_text, now.eccentricity_place] };
    for (const element of report.root.querySelectorAll("[data-read]")) {
      const [value, place] = values[element.dataset.read];
      const small = document.createElement("small");
      small.textContent = place;
      element.replaceChildren(value, small);
    }
    if (slider) {
      slider.value = shown;
      slider.setAttribute("aria-valuetext", `${now.crank_text}, film ${now.thickness_text}, pressure ${now.pressure_text}`);
    }
  }

  // The maps follow at once. The body takes longer where the machine draws it without a graphics
  // card, so it waits until nothing newer is asked for; while the film plays it comes along.
  const rest = 90;
  async function drawPictures() {
    const drawn = shown;
    await report.draw(["film-pressure", "film-contact", "film-fraction"]);
    if (!playing) { await new Promise((done) => { setTimeout(done, rest); }); }
    if (isStale || report.isLeft) { return; }
    await report.draw(["film-solid"]);
    // The page tells which instant its pictures show, once they do.
    report.find("film").dataset.shown = drawn;
  }

  function show(index) {
    shown = index;
    readOut();
    return refresh();
  }

  // One drawing at a time: what is asked for meanwhile is drawn once, as it stands then.
  let drawing = null;
  let isStale = false;
  function refresh() {
    isStale = true;
    drawing ??= (async () => {
      while (isStale) {
        isStale = false;
        await new Promise((done) => { setTimeout(done); });
        await drawPictures();
      }
      drawing = null;
    })();
    return drawing;
  }

  let playing = null;
  function stop() {
    playing = null;
    play.classList.remove("playing");
    play.setAttribute("aria-label", "Play");
  }

  // The next frame waits for the last one to be drawn, so that a slow machine plays slower and
  // never falls behind.
  async function run(token) {
    while (playing === token) {
      const start = performance.now();
      await show((shown + 1) % film.frames.length);
      const left = 110 - (performance.now() - start);
      await new Promise((done) => { setTimeout(done, Math.max(left, 16)); });
    }
  }

  // Called when the reader leaves the page on which the film plays.
  report.stop = () => { if (playing) { stop(); } };

  if (slider) {
    slider.max = film.frames.length - 1;
    slider.oninput = () => {
      if (playing) { stop(); }
      show(Number(slider.value));
    };
    play.onclick = () => {
      if (playing) { stop(); return; }
      playing = {};
      play.classList.add("playing");
      play.setAttribute("aria-label", "Pause");
      run(playing);
    };
    jumps.replaceChildren();
    for (const { name, frame: target } of film.jumps) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = `${name} ${film.frames[target].crank_text}`;
      button.onclick = () => { stop(); show(target); };
      jumps.append(button);
    }
  }
  for (const button of report.root.querySelectorAll("[data-choice]")) {
    button.onclick = () => {
      choice[button.dataset.choice] = button.dataset.value;
      for (const other of button.parentElement.children) { other.setAttribute("aria-pressed", String(other === button)); }
      refresh();
    };
    // A view that takes over a place of the page keeps what the reader chose there.
    if (button.getAttribute("aria-pressed") === "true") { choice[button.dataset.choice] = button.dataset.value; }
  }
  readOut();
  report.find("film").dataset.shown = shown;
});

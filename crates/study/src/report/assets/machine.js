"use strict";
// The pages of an engine or shaft: one is shown at a time, at the speed that the reader chose.
((report) => {
  const solids = ["film-solid"];

  report.openMachine = (data) => {
    const { machine, overall, cycles } = data;
    const pages = [...document.querySelectorAll(".page")];
    const links = [...document.querySelectorAll(".pages a")];
    const select = document.getElementById("speed");
    let speed = 0;
    let open = null;
    // The view that fills each page, with the speed it is of and whether it is drawn.
    const views = new Map();

    const overview = () => ({ machine, overview: { speed, go }, cycles: cycles.map((one) => one[speed]?.cycle),
      charts: Object.assign({}, machine.charts, overall[speed]?.charts) });
    const dataOf = (page) => (page === pages[0] ? overview() : cycles[pages.indexOf(page) - 1][speed] ?? {});

    function leave(page) {
      const one = views.get(page);
      if (!one) { return; }
      one.view.isLeft = true;
      one.view.stop?.();
    }

    function viewOf(page) {
      const known = views.get(page);
      if (known && known.speed === speed && !known.view.isLeft) { return known; }
      leave(page);
      const one = { view: report.view(page, dataOf(page)), speed, drawn: false };
      views.set(page, one);
      return one;
    }

    async function redraw() {
      const one = viewOf(open);
      one.drawn = await one.view.drawAll();
    }

    function mark() {
      for (const page of pages) { page.classList.toggle("open", page === open); }
      for (const link of links) {
        if (link.dataset.page === open.id) { link.setAttribute("aria-current", "page"); } else { link.removeAttribute("aria-current"); }
      }
      for (const block of document.querySelectorAll(".at")) { block.classList.toggle("chosen", Number(block.dataset.speed) === speed); }
      if (select) { select.value = String(speed); }
      document.querySelector(".pages [aria-current]")?.scrollIntoView({ block: "nearest", inline: "nearest" });
    }

    // Shows a page at a speed and draws it, unless it still stands as it was left.
    async function show(page, at) {
      const isSame = page === open && at === speed;
      if (open && page !== open) {
        // A browser gives few bodies at a time: those of a closed page make room.
        for (const element of open.querySelectorAll(".plot.film-solid")) { if (element.data) { Plotly.purge(element); } }
        views.get(open)?.view.stop?.();
      }
      open = page;
      speed = at;
      mark();
      if (isSame) { return; }
      const one = viewOf(page);
      document.documentElement.dataset.drawn = "false";
      if (one.drawn) { await one.view.draw(solids); } else { one.drawn = await one.view.drawAll(); }
      if (open === page && speed === at) { document.documentElement.dataset.drawn = "true"; }
    }

    // The place an address names, and the page it stands on.
    function target() {
      const id = decodeURIComponent(location.hash.slice(1));
      const element = id ? document.getElementById(id) : null;
      return { element, page: element?.closest(".page") ?? pages[0] };
    }

    function follow() {
      const { element, page } = target();
      show(page, speed);
      if (element && element !== page) { element.scrollIntoView(); } else if (element) {
        // A new page starts at its top, and the row of pages stays where it is if it can.
        const row = document.querySelector(".chooser");
        scrollTo({ top: Math.min(scrollY, row.previousElementSibling.getBoundingClientRect().bottom + scrollY + 14), behavior: "instant" });
      }
    }

    function go(bearing, at) {
      speed = at;
      const { id } = machine.bearings[bearing];
      if (location.hash === `#${id}`) { follow(); } else { location.hash = id; }
    }

    document.documentElement.classList.add("paged");
    open = target().page;
    mark();
    addEventListener("hashchange", follow);
    select?.addEventListener("change", () => show(open, Number(select.value)));

    return {
      async redraw() {
        // Colours have changed: what is drawn on closed pages is no longer right.
        for (const one of views.values()) { one.drawn = false; }
        await redraw();
      },
      print() { for (const page of pages) { viewOf(page).view.drawForPaper(solids); } },
      printed() {
        for (const one of views.values()) { one.drawn = false; }
        redraw();
      },
    };
  };

  // ---- figures of the machine as a whole -----------------------------------------------------

  report.parts.push((view) => {
    const { machine, overview } = view.data;
    if (!machine) { return; }
    const { theme, axis, layout, withUnit, drawings, scales } = view;
    const names = machine.bearings.map((one) => one.name);
    const many = machine.speeds.length > 1;
    const roleColours = { main: "first", "big-end": "second", "small-end": "third", "piston-boss": "soft", bearing: "first" };

    // Bearings as rows, speeds as columns, a number in each field.
    function heatMap(found, name, scale, reversed) {
      const rows = found.rows.map((row) => row.map((cell) => cell.value));
      const text = found.rows.map((row) => row.map((cell) => cell.text.split(" ")[0] + (cell.bad ? " !" : "")));
      return { traces: [{ type: "heatmap", x: machine.speeds.map((_, i) => i), y: names, z: rows, text, texttemplate: "%{text}", textfont: { size: theme.size - 1 },
        colorscale: scale, reversescale: reversed, xgap: 1, ygap: 1, customdata: found.rows.map((row) => row.map((cell, at) => [machine.speeds[at], cell.text + (cell.bad ? ", limit exceeded" : "")])),
        hovertemplate: "%{y} at %{customdata[0]}<br>%{customdata[1]}<extra></extra>", colorbar: view.colourBar(withUnit(name, found.unit)) }],
      layout: layout(axis("Speed [rpm]", { tickvals: machine.speeds.map((_, i) => i), ticktext: machine.speeds.map((label) => label.replace(" rpm", "")), showgrid: false }),
        axis("", { autorange: "reversed", showgrid: false, ticks: "", type: "category", dtick: 1 }), { hovermode: "closest", margin: { l: 70, r: 10, t: 10, b: 46 } }),
      open: (point) => overview.go(names.indexOf(point.y), point.x) };
    }

    // One speed: a bar for each bearing, and the limits.
    function bars(found, name) {
      const cells = found.rows.map((row) => row[overview.speed]);
      const limits = view.limitLines(found.limits ?? []);
      return { traces: [{ type: "bar", x: names, y: cells.map((cell) => cell?.value), customdata: cells.map((cell) => cell.text), hovertemplate: "%{x}: %{customdata}<extra></extra>",
        marker: { color: machine.bearings.map((one) => theme[roleColours[one.role]]) } }],
      layout: layout(axis("", { type: "category", tickangle: -60, ticks: "", dtick: 1 }), axis(withUnit(name, found.unit), { rangemode: "tozero" }),
        { hovermode: "closest", bargap: 0.35, shapes: limits.shapes, annotations: limits.annotations.map((one) => ({ ...one, bgcolor: theme.paper })), margin: { l: 58, r: 18, t: 22, b: 60 } }),
      open: (point) => overview.go(names.indexOf(point.x), overview.speed) };
    }

    // Bars of all bearings on each other at every speed; a colour for each kind of bearing.
    function stacked(found, name) {
      const seen = new Set();
      const count = {};
      const traces = machine.bearings.map(({ name: bearing, role }, number) => {
        const first = !seen.has(role);
        seen.add(role);
        count[role] = (count[role] ?? -1) + 1;
        return { type: "bar", x: machine.speeds.map((_, i) => i), y: found.rows[number].map((cell) => cell.value), name: role.replace("-", " "), legendgroup: role, showlegend: first,
          customdata: found.rows[number].map((cell, at) => [bearing, machine.speeds[at], cell.text]), hovertemplate: "%{customdata[0]} at %{customdata[1]}: %{customdata[2]}<extra></extra>",
          marker: { color: theme[roleColours[role]], opacity: count[role] % 2 ? 0.72 : 1, line: { color: theme.paper, width: 0.8 } } };
      });
      return { traces, layout: layout(axis("Speed [rpm]", { tickvals: machine.speeds.map((_, i) => i), ticktext: machine.speeds.map((label) => label.replace(" rpm", "")), showgrid: false }),
        axis(withUnit(name, found.unit), { rangemode: "tozero" }), { barmode: "stack", bargap: 0.3, hovermode: "closest", showlegend: seen.size > 1, margin: { l: 58, r: 18, t: 34, b: 46 } }) };
    }

    Object.assign(drawings, {
      "overview-thickness": () => (many ? heatMap(machine.thickness, "Film thickness", scales.plasma, false) : bars(machine.thickness, "Film thickness")),
      "overview-pressure": () => (many ? heatMap(machine.pressure, "Film pressure", "Viridis", false) : bars(machine.pressure, "Film pressure")),
      "overview-friction": () => (many ? stacked(machine.friction, "Power") : bars(machine.friction, "Power")),
      polars: (element) => polars(element),
    });

    // ---- loads of all bearings side by side ----------------------------------------------------

    function polars(element) {
      const cycles = view.data.cycles.map((cycle) => {
        if (!cycle) { return null; }
        const [x, y, angle] = [cycle.load_x, cycle.load_y, cycle.angle].map(view.numbers);
        return { x, y, thinnest: angle.findIndex((place) => place >= (cycle.thinnest?.angle ?? Infinity) - 1e-6) };
      });
      const reach = 1.08 * Math.max(1e-12, ...cycles.flatMap((one) => (one ? one.x.map((x, i) => Math.hypot(x ?? 0, one.y[i] ?? 0)) : [])));
      const step = 10 ** Math.floor(Math.log10(reach));
      const ring = [5, 2, 1, 0.5].map((share) => share * step).find((radius) => radius <= 0.95 * reach);
      const tiles = cycles.map((one, number) => {
        const link = document.createElement("a");
        link.href = `#${machine.bearings[number].id}`;
        const name = document.createElement("b");
        name.textContent = names[number];
        link.append(name);
        if (!one) { return link; }
        // Numbers and names of styles only: nothing here is text that a user wrote.
        const scaled = 98 / reach;
        const rings = [ring, 0.5 * ring].map((radius) => `<circle r="${radius * scaled}" class="ring"/>`).join("");
        const points = one.x.map((x, i) => (x === null ? null : `${(x * scaled).toFixed(1)} ${(-one.y[i] * scaled).toFixed(1)}`)).filter(Boolean);
        const curve = `<path d="M${points.join("L")}" class="curve ${roleColours[machine.bearings[number].role]}"/>`;
        const dot = one.thinnest < 0 ? "" : `<circle cx="${one.x[one.thinnest] * scaled}" cy="${-one.y[one.thinnest] * scaled}" r="4.5" class="thinnest"/>`;
        link.insertAdjacentHTML("beforeend", `<svg viewBox="-100 -100 200 200" aria-hidden="true">${rings}<path d="M-98 0H98M0-98V98" class="ring"/>${curve}${dot}</svg>`);
        return link;
      });
      const scale = document.createElement("p");
      scale.className = "note";
      scale.textContent = `Outer ring: ${Number(ring.toPrecision(3))} ${machine.force}; inner ring: ${Number((0.5 * ring).toPrecision(3))} ${machine.force}.`;
      const list = document.createElement("div");
      list.className = "tiles";
      list.append(...tiles);
      element.replaceChildren(list, scale);
      return null;
    }
  });
})(globalThis.sommerfeld);

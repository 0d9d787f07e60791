"use strict";
// Draws every figure of the page, or of the page that is open, now, when the theme changes and for paper.
((report) => {
  // The tool bar needs a pointer that hovers; on paper and on touch screens it would only cover curves.
  const config = { displaylogo: false, displayModeBar: matchMedia("(hover: hover)").matches ? "hover" : false, responsive: true, plotlyServerURL: "",
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d", "resetCameraLastSave3d", "tableRotation"] };
  let isPrinting = false;

  // Says why there is no picture; a drawing that returns nothing has filled its place itself.
  function empty(element, words) {
    if (element.data) { Plotly.purge(element); }
    const text = document.createElement("p");
    text.className = "nothing";
    text.textContent = words;
    element.replaceChildren(text);
    return null;
  }

  function draw(view, element) {
    const drawing = view.drawings[element.dataset.kind];
    const figure = drawing ? drawing(element) : { nothing: "Nothing to show at this speed." };
    if (!figure) { return null; }
    if (figure.nothing) { return empty(element, figure.nothing); }
    if (!element.data) { element.replaceChildren(); }
    const named = Object.assign({}, config, { staticPlot: isPrinting, toImageButtonOptions: { format: "svg", filename: element.dataset.kind } });
    // Paper does not tell its size by events: the size is that of the style sheet for print.
    const size = isPrinting ? { autosize: false, width: element.clientWidth, height: element.clientHeight } : { autosize: true };
    const drawn = Plotly.react(element, figure.traces, Object.assign(figure.layout, size), named);
    if (figure.open) {
      element.removeAllListeners("plotly_click");
      element.on("plotly_click", (event) => figure.open(event.points[0]));
    }
    return drawn;
  }

  const elements = (view, kinds) => [...view.root.querySelectorAll("[data-kind]")]
    .filter((element) => !kinds || kinds.includes(element.dataset.kind));

  // Figures of a view that the reader has left are not drawn any more: another may have their places.
  report.draw = function drawKinds(kinds) {
    return this.isLeft ? Promise.resolve([]) : Promise.all(elements(this, kinds).map((element) => draw(this, element)));
  };

  // One after the other, so that the page answers meanwhile.
  report.drawAll = async function drawAll() {
    report.readTheme(false);
    for (const element of elements(this)) {
      if (this.isLeft) { return false; }
      await draw(this, element);
      await new Promise((done) => { setTimeout(done); });
    }
    return !this.isLeft;
  };

  // What paper shows is drawn at once: it does not wait.
  report.drawForPaper = function drawForPaper(skipped) {
    report.readTheme(true);
    isPrinting = true;
    for (const element of elements(this)) { if (!skipped?.includes(element.dataset.kind)) { draw(this, element); } }
    isPrinting = false;
  };

  const data = JSON.parse(document.getElementById("data").textContent);
  report.readTheme(false);
  const whole = data.machine ? report.openMachine(data) : (() => {
    const view = report.view(document.body, data);
    const redraw = () => view.drawAll();
    return { redraw, print: () => view.drawForPaper(), printed: redraw };
  })();
  whole.redraw().then(() => { document.documentElement.dataset.drawn = "true"; });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => whole.redraw());
  addEventListener("beforeprint", () => {
    document.documentElement.classList.add("printing");
    whole.print();
  });
  addEventListener("afterprint", () => {
    document.documentElement.classList.remove("printing");
    whole.printed();
    for (const element of document.querySelectorAll("[data-kind]")) {
      if (element.data && element.clientWidth > 0) { Plotly.Plots.resize(element); }
    }
  });
})(globalThis.sommerfeld);

"use strict";
// Draws every figure of the page, now, when the theme changes and for paper.
((report) => {
  const { drawings } = report;

  // The tool bar needs a pointer that hovers; on paper and on touch screens it would only cover curves.
  const config = { displaylogo: false, displayModeBar: matchMedia("(hover: hover)").matches ? "hover" : false, responsive: true, plotlyServerURL: "",
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d", "resetCameraLastSave3d", "tableRotation"] };
  let isPrinting = false;

  function draw(element) {
    const figure = drawings[element.dataset.kind](element);
    if (!figure) { return null; }
    const named = Object.assign({}, config, { toImageButtonOptions: { format: "svg", filename: element.dataset.kind } });
    // Paper does not tell its size by events: the size is that of the style sheet for print.
    const size = isPrinting ? { autosize: false, width: element.clientWidth, height: element.clientHeight } : { autosize: true };
    return Plotly.react(element, figure.traces, Object.assign(figure.layout, size), named);
  }

  const elements = (kinds) => [...document.querySelectorAll("[data-kind]")]
    .filter((element) => !kinds || kinds.includes(element.dataset.kind));

  report.draw = (kinds) => Promise.all(elements(kinds).map(draw));

  // One after the other, so that the page answers meanwhile; paper does not wait.
  async function drawAll(printing) {
    isPrinting = printing;
    report.readTheme(printing);
    if (printing) {
      await report.draw();
      return;
    }
    for (const element of elements()) {
      await draw(element);
      await new Promise((done) => { setTimeout(done); });
    }
  }

  drawAll(false).then(() => { document.documentElement.dataset.drawn = "true"; });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => drawAll(false));
  addEventListener("beforeprint", () => {
    document.documentElement.classList.add("printing");
    drawAll(true);
  });
  addEventListener("afterprint", () => {
    document.documentElement.classList.remove("printing");
    drawAll(false);
    elements().forEach((element) => { if (element.data) { Plotly.Plots.resize(element); } });
  });
})(globalThis.sommerfeld);

"use strict";
(() => {
  const { seriesColour, addPlot, axis, options } = charting;
  const sections = JSON.parse(document.getElementById("sections").textContent);
  const holders = [...document.querySelectorAll(".plots")];
  const charts = [];

  const dataset = ({ name, colour, dashed, points }) => ({
    label: name,
    data: points.map(([x, y]) => ({ x, y })),
    showLine: true,
    borderColor: seriesColour(colour), borderDash: dashed ? [5, 4] : [],
    backgroundColor: dashed ? "transparent" : seriesColour(colour),
    pointRadius: 3,
  });

  const draw = (holder, { title, x, y, logarithmic, series }) => {
    const scale = logarithmic ? { type: "logarithmic" } : { beginAtZero: true };
    const settings = options({ x: axis(x, { beginAtZero: true }), y: axis(y, scale) }, true);
    settings.interaction = { mode: "nearest", intersect: false };
    charts.push(new Chart(addPlot(holder, title), {
      type: "scatter", data: { datasets: series.map(dataset) }, options: settings,
    }));
  };

  charting.drawWith(() => {
    while (charts.length > 0) charts.pop().destroy();
    holders.forEach((holder, i) => {
      holder.replaceChildren();
      sections[i].forEach((plot) => draw(holder, plot));
    });
  });
})();

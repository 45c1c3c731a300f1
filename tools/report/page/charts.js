"use strict";
// How a report's charts look, in the page's own colours.
const charting = (() => {
  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const seriesColour = (index) => style(`--series-${index + 1}`);

  // A card with a heading and a canvas, put at the end of the holder.
  const addPlot = (holder, title) => {
    const plot = document.createElement("div");
    plot.className = "plot";
    const heading = plot.appendChild(document.createElement("h3"));
    heading.textContent = title;
    const frame = plot.appendChild(document.createElement("div"));
    frame.className = "canvas";
    const canvas = frame.appendChild(document.createElement("canvas"));
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", title);
    holder.appendChild(plot);
    return canvas;
  };

  const axis = (title, more = {}) => ({
    type: "linear",
    title: { display: Boolean(title), text: title, color: style("--quiet") },
    grid: { color: style("--line"), borderColor: style("--line") },
    ticks: { color: style("--quiet"), maxTicksLimit: 7, includeBounds: false },
    ...more,
  });

  const options = (scales, legend) => ({
    animation: false, responsive: true, maintainAspectRatio: false, parsing: false, normalized: true, spanGaps: true,
    interaction: { mode: "index", intersect: false },
    elements: { point: { radius: 0, hitRadius: 8 }, line: { borderWidth: 1.4, tension: 0 } },
    scales,
    plugins: { legend: { display: legend, align: "start", labels: { color: style("--ink"), boxWidth: 14, boxHeight: 2 } } },
  });

  // Now, and anew when the page's colours change.
  const drawWith = (drawAll) => {
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    drawAll();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
  };

  return { style, seriesColour, addPlot, axis, options, drawWith };
})();

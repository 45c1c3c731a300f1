"use strict";
(() => {
  const { style, seriesColour, axis, options } = charting;
  const columns = JSON.parse(document.getElementById("columns").textContent);
  const first = columns.time_s ? columns.time_s[0] : 0;
  const time = columns.time_s ? columns.time_s.map((t) => (t === null ? null : t - first)) : columns.frame;
  const timeTitle = columns.time_s ? "time, s" : "frame";

  // key, label, and for the second of two scales: right.
  const plots = [
    { title: "Frame time, ms", series: [["frame_ms", "frame"]] },
    { title: "CPU and GPU, ms", series: [["cpu_ms", "CPU"], ["gpu_ms", "GPU"], ["selection_ms", "LOD selection"],
      ["still_cpu_ms", "CPU as a static mesh"]] },
    { title: "CPU over that of the same triangles as a static mesh", series: [["price_of_lod", "price of LOD"]] },
    { title: "Frame thread outside GL, ms", series: [["outside_gl_ms", "outside GL"], ["allocations", "allocations", "right"]] },
    { title: "Triangles and draw calls", series: [["triangles", "triangles"], ["draws", "draw calls", "right"]] },
    { title: "Blocks", series: [["blocks_drawn", "drawn"], ["blocks_tested", "tested"], ["blocks_evaluated", "evaluated"]] },
    { title: "Loading", series: [["loads_pending", "loads waiting"], ["blocks_uploaded", "blocks uploaded"],
      ["bytes_uploaded", "bytes uploaded", "right"]] },
    { title: "Transport delay: packet to picture, ms", series: [["transport_delay_ms", "packet to picture"]] },
    { title: "Tolerance, px", series: [["tau_px", "tau"]] },
    { title: "Eye height above the ellipsoid, m", series: [["ellipsoidal_height_m", "height"]], fromZero: false },
  ];

  const has = ([key]) => columns[key] && columns[key].some((value) => value !== null);
  const charts = [];
  const addPlot = (title) => charting.addPlot(document.getElementById("plots"), title);

  const dataset = ([key, label, side], index) => ({
    label,
    data: columns[key].map((y, i) => ({ x: time[i], y: y === null ? NaN : y })),
    borderColor: seriesColour(index), backgroundColor: seriesColour(index),
    yAxisID: side === "right" ? "right" : "y",
  });

  const drawOverTime = ({ title, series, fromZero = true }) => {
    const shown = series.filter(has);
    if (shown.length === 0) return;
    const right = shown.find((one) => one[2] === "right");
    const scales = { x: axis(timeTitle, { max: time[time.length - 1] }), y: axis("", { beginAtZero: fromZero }) };
    if (right) {
      scales.right = axis(right[1], { position: "right", beginAtZero: true });
      scales.right.grid = { drawOnChartArea: false, borderColor: style("--line") };
    }
    charts.push(new Chart(addPlot(title), {
      type: "line", data: { datasets: shown.map(dataset) }, options: options(scales, shown.length > 1),
    }));
  };

  // Longitude is drawn east of the first point without a jump at the antimeridian, and shrunk by the cosine of the
  // latitude, so that the track has its true shape: kilometres on both axes.
  const trackPoints = () => {
    const lat = columns.latitude_deg, lon = columns.longitude_deg;
    const start = lat.findIndex((value, i) => value !== null && lon[i] !== null);
    const kmPerDegree = 111.2;
    const shrink = Math.cos(lat[start] * Math.PI / 180);
    const turn = (degrees) => ((degrees + 540) % 360 + 360) % 360 - 180;
    return lat.flatMap((value, i) => value === null || lon[i] === null ? [] :
      [{ x: turn(lon[i] - lon[start]) * shrink * kmPerDegree, y: (value - lat[start]) * kmPerDegree }]);
  };

  // Ranges of equal scale on both axes for the plot area's shape, which is known once it is laid out.
  const squareScales = (points) => ({
    id: "squareScales",
    afterLayout(chart) {
      const range = (key) => points.reduce(([low, high], p) => [Math.min(low, p[key]), Math.max(high, p[key])],
        [Infinity, -Infinity]);
      const [west, east] = range("x"), [south, north] = range("y");
      const { width, height } = chart.chartArea;
      const perPixel = Math.max((east - west) / width, (north - south) / height, 1e-6) * 1.1;
      const fit = (scale, low, high, pixels) => {
        scale.options.min = (low + high - perPixel * pixels) / 2;
        scale.options.max = (low + high + perPixel * pixels) / 2;
      };
      const key = `${width}x${height}`;
      if (chart.squaredFor === key) return;
      chart.squaredFor = key;
      fit(chart.scales.x, west, east, width);
      fit(chart.scales.y, south, north, height);
      queueMicrotask(() => chart.update("none"));
    },
  });

  const drawTrack = () => {
    if (!has(["latitude_deg"]) || !has(["longitude_deg"])) return;
    const points = trackPoints();
    const place = (value, positive, negative) => `${Math.abs(value).toFixed(4)}° ${value < 0 ? negative : positive}`;
    const from = `${place(columns.latitude_deg[0], "N", "S")}, ${place(columns.longitude_deg[0], "E", "W")}`;
    const km = { callback: (value) => Number(value.toPrecision(3)) };
    const scales = { x: axis("east, km"), y: axis("north, km") };
    for (const scale of Object.values(scales)) scale.ticks = { ...scale.ticks, ...km };
    const track = { label: "track", data: points, showLine: true, borderColor: seriesColour(0), backgroundColor: seriesColour(0) };
    const ends = [["start", points[0], 2], ["end", points[points.length - 1], 1]].map(([label, point, colour]) => ({
      label, data: [point], borderColor: seriesColour(colour), backgroundColor: seriesColour(colour), pointRadius: 4,
    }));
    const settings = options(scales, true);
    settings.interaction = { mode: "nearest", intersect: false };
    charts.push(new Chart(addPlot(`Ground track from ${from}`), {
      type: "scatter", data: { datasets: [...ends, track] }, options: settings, plugins: [squareScales(points)],
    }));
  };

  const drawAll = () => {
    while (charts.length > 0) charts.pop().destroy();
    document.getElementById("plots").replaceChildren();
    plots.forEach(drawOverTime);
    drawTrack();
  };

  charting.drawWith(drawAll);
})();

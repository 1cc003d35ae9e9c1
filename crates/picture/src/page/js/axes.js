"use strict";
// What all plots share: axes, ranges, swatches of curves.
(() => {
  const { units, svg, colour } = linkdyn;
  const FONT = "12px system-ui, sans-serif";
  const TURNS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720, 1800, 3600, 7200, 18000, 36000];

  // An axis without its own words; ticks as short as can be, those of angles are parts of a turn.
  const axis = (label, rest = {}) => {
    const [stroke, grid] = [colour("muted"), { stroke: colour("grid"), width: 1 }];
    const values = (u, splits) => splits.map((value) => value === null ? null : units.number(value, 6));
    return { stroke, grid, ticks: { ...grid, size: 5 }, font: FONT, labelFont: FONT, values, ...(label === "°" ? { incrs: TURNS } : {}), ...rest };
  };
  // What every plot asks of uPlot: no legend, no cursor of its own, a part to zoom in on where it can be dragged.
  const options = (drag, unzoom) => ({
    pxAlign: 0, legend: { show: false },
    cursor: { x: false, y: false, points: { show: false }, drag: { x: drag, y: false, setScale: false }, ...(unzoom ? { bind: { dblclick: () => () => { unzoom(); return null; } } } : {}) },
  });
  // The part of the axis over which the pointer was dragged; null for a click.
  const dragged = (u) => {
    if (u.select.width < 4) return null;
    const ends = [u.select.left, u.select.left + u.select.width].map((left) => u.posToVal(left, "x"));
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    return ends;
  };

  // A little more than what is there; something to see where all is one value.
  const padded = (low, high) => {
    if (!(low <= high) || !Number.isFinite(high - low)) return [-1, 1];
    const most = Math.max(Math.abs(low), Math.abs(high));
    const room = high - low > 1e-9 * most ? (high - low) * 0.07 : most > 0 ? most * 0.1 : 1;
    return [low - room, high + room];
  };
  // Lowest and highest value of curves in some rows, but for peaks beyond the cuts of each.
  const span = (curves, rows) => {
    let [least, most] = [Infinity, -Infinity];
    for (const { values, cut } of curves) {
      const [low, high] = [cut[0] ?? -Infinity, cut[1] ?? Infinity];
      let [a, b, out, count, lowest, highest] = [Infinity, -Infinity, 0, 0, Infinity, -Infinity];
      for (const row of rows()) {
        const value = values[row];
        if (!Number.isFinite(value)) continue;
        count++;
        lowest = Math.min(lowest, value); highest = Math.max(highest, value);
        if (value < low || value > high) out++;
        a = Math.min(a, Math.max(value, low)); b = Math.max(b, Math.min(value, high));
      }
      // Where most of what is in view is beyond the cuts, the reader looks at the peak itself.
      if (out > 0.3 * count) [a, b] = [lowest, highest];
      [least, most] = [Math.min(least, a), Math.max(most, b)];
    }
    return [least, most];
  };
  // The ends of a cut, in the unit that is shown.
  const scaled = (ends, factor) => ends.map((end) => end === null ? null : end * factor);

  // A piece of a curve next to its name.
  const swatch = (stroke, { wide = 24, width = 2.4, dash = [], ...rest } = {}) => svg("svg", { width: wide, height: 10, "aria-hidden": "true", ...rest },
    svg("line", { x1: 0, x2: wide, y1: 5, y2: 5, "stroke-width": width, stroke, "stroke-dasharray": dash.join(" ") }));

  linkdyn.axes = { FONT, axis, options, dragged, padded, span, scaled, swatch };
})();

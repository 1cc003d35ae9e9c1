"use strict";
// What stands in the band besides its curves: the certified area, hatches where there is none, limits.
(() => {
  const { file, colour } = linkdyn, { clipped, write } = linkdyn.marks;
  const STEP = 9;

  // Runs of rows that are certified, or are not: [from, to, certified].
  const runs = ({ band, rows }) => {
    const found = [];
    for (let row = 0; row < rows; row++) {
      const certified = Number.isFinite(band.certified_low[row]);
      const last = found[found.length - 1];
      if (last && last[2] === certified) last[1] = row; else found.push([row, row, certified]);
    }
    return found;
  };

  const certified = (u, output, values, size, tone) => clipped(u, (pen, { top, height }, ratio) => {
    const { band } = output;
    const x = (row) => u.valToPos(values[row], "x", true), y = (value) => u.valToPos(value / size, "y", true);
    for (const [from, to, is] of runs(output)) {
      if (is) {
        pen.beginPath();
        for (let row = from; row <= to; row++) pen.lineTo(x(row), y(band.certified_high[row]));
        for (let row = to; row >= from; row--) pen.lineTo(x(row), y(band.certified_low[row]));
        pen.closePath();
        pen.fillStyle = tone; pen.globalAlpha = 0.22; pen.fill();
        pen.globalAlpha = 1; pen.strokeStyle = tone; pen.lineWidth = ratio; pen.stroke();
        continue;
      }
      // From the last certified pose to the next one nothing is known.
      const [a, b] = [x(Math.max(from - 1, 0)), x(Math.min(to + 1, output.rows - 1))];
      const [low, high] = [Math.min(a, b), Math.max(a, b, Math.min(a, b) + 2 * ratio)];
      pen.save();
      pen.beginPath(); pen.rect(low, top, high - low, height); pen.clip();
      pen.strokeStyle = colour("warn"); pen.globalAlpha = 0.5; pen.lineWidth = ratio;
      pen.beginPath();
      const step = STEP * ratio;
      for (let at = Math.floor((low - height) / step) * step; at < high; at += step) { pen.moveTo(at, top + height); pen.lineTo(at + height, top); }
      pen.stroke();
      pen.restore();
    }
  });

  const limits = (u, output, size) => {
    if (!output.limits) return;
    clipped(u, (pen, { left, top, width, height }, ratio) => {
      const ink = colour("bad");
      const { min, max } = u.scales.y;
      for (const [k, limit] of output.limits.entries()) {
        const value = limit / size, text = `limit ${file.signed(limit, output.unit)}`;
        if (value <= max && value >= min) {
          const y = u.valToPos(value, "y", true);
          pen.beginPath(); pen.moveTo(left, y); pen.lineTo(left + width, y); pen.strokeStyle = ink; pen.lineWidth = 1.6 * ratio; pen.stroke();
          pen.textBaseline = k ? "bottom" : "top";
          write(pen, ratio, text, left + 6 * ratio, y + (k ? -2 : 2) * ratio, ink);
        } else {
          pen.textBaseline = value > max ? "top" : "bottom";
          write(pen, ratio, `${text} is beyond the axis`, left + 6 * ratio, value > max ? top + 3 * ratio : top + height - 3 * ratio, ink);
        }
      }
    });
  };

  linkdyn.bands = { certified, limits, runs };
})();

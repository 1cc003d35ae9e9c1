"use strict";
// What stands in the band besides its curves: the certified area, hatches where there is none, limits, and peaks beyond the axis.
(() => {
  const { drawing, file } = linkdyn;
  const FONT = 11, EDGE = 5, STEP = 9;

  const clipped = (u, draw) => {
    const { left, top, width, height } = u.bbox, pen = u.ctx;
    pen.save();
    pen.beginPath(); pen.rect(left, top, width, height); pen.clip();
    pen.setLineDash([]);
    pen.font = `${FONT * devicePixelRatio}px system-ui, sans-serif`;
    draw(pen, u.bbox, devicePixelRatio);
    pen.restore();
  };

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

  const certified = (u, output, size, tone) => clipped(u, (pen, { left, top, width, height }, ratio) => {
    const { values } = output.x, { band } = output;
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
      pen.strokeStyle = drawing.colour("warn"); pen.globalAlpha = 0.5; pen.lineWidth = ratio;
      pen.beginPath();
      const step = STEP * ratio;
      for (let at = Math.floor((low - height) / step) * step; at < high; at += step) { pen.moveTo(at, top + height); pen.lineTo(at + height, top); }
      pen.stroke();
      pen.restore();
    }
  });

  // A text that is told apart from what lies behind it.
  const told = (pen, text, x, y, ink) => {
    pen.lineWidth = 4 * devicePixelRatio; pen.lineJoin = "round"; pen.strokeStyle = drawing.colour("card"); pen.fillStyle = ink;
    pen.strokeText(text, x, y); pen.fillText(text, x, y);
  };

  const limits = (u, output, size) => {
    if (!output.limits) return;
    clipped(u, (pen, { left, top, width, height }, ratio) => {
      const ink = drawing.colour("bad");
      pen.textAlign = "left";
      const { min, max } = u.scales.y;
      for (const [k, limit] of output.limits.entries()) {
        const value = limit / size, text = `limit ${file.signed(limit, output.unit)}`;
        if (value <= max && value >= min) {
          const y = u.valToPos(value, "y", true);
          pen.beginPath(); pen.moveTo(left, y); pen.lineTo(left + width, y); pen.strokeStyle = ink; pen.lineWidth = 1.6 * ratio; pen.stroke();
          pen.textBaseline = k ? "bottom" : "top";
          told(pen, text, left + 6 * ratio, y + (k ? -2 : 2) * ratio, ink);
        } else {
          pen.textBaseline = value > max ? "top" : "bottom";
          told(pen, `${text} is beyond the axis`, left + 6 * ratio, value > max ? top + 3 * ratio : top + height - 3 * ratio, ink);
        }
      }
    });
  };

  // Per kind of curve and end of the axis the farthest value in view that lies beyond, as a triangle and in words.
  const peaks = (u, output, symbol, size, kinds) => {
    const found = [];
    clipped(u, (pen, { left, top, width, height }, ratio) => {
      const { x: { min: from, max: to }, y: { min, max } } = u.scales, { values } = output.x;
      for (const [end, sign] of [[0, -1], [1, 1]]) {
        let lines = 0;
        for (const { name, ink, values: both } of kinds) {
          let best = -1;
          const of = both[end], edge = sign > 0 ? max : min;
          for (let row = 0; row < output.rows; row++) if (values[row] >= from && values[row] <= to && sign * (of[row] / size - edge) > 0 && (best < 0 || sign * (of[row] - of[best]) > 0)) best = row;
          if (best < 0) continue;
          const x = u.valToPos(values[best], "x", true), y = sign > 0 ? top : top + height, s = EDGE * ratio;
          pen.fillStyle = ink;
          pen.beginPath(); pen.moveTo(x, y); pen.lineTo(x - s, y + sign * s * 1.4); pen.lineTo(x + s, y + sign * s * 1.4); pen.fill();
          const text = `${name} ${file.signed(of[best], output.unit)} at ${file.number(values[best], 5)}${symbol === "°" ? symbol : ` ${symbol}`}`;
          const wide = pen.measureText(text).width, gap = 12 * ratio, right = x + gap + wide < left + width - 4 * ratio;
          pen.textAlign = "left"; pen.textBaseline = sign > 0 ? "top" : "bottom";
          const at = Math.max(left + 4 * ratio, Math.min(right ? x + gap : x - gap - wide, left + width - wide - 4 * ratio));
          told(pen, text, at, y + sign * (2 + lines * (FONT + 3)) * ratio, ink);
          lines++;
          found.push({ name, value: of[best] });
        }
      }
    });
    return found;
  };

  linkdyn.marks = { certified, limits, peaks, runs };
})();

"use strict";
// What stands in a plot besides its curves. No text covers another.
(() => {
  const { colour } = linkdyn;
  const FONT = 11, EDGE = 4, SIZE = 5;

  // Draws inside of the frame.
  const clipped = (u, draw, ratio = devicePixelRatio) => {
    const { left, top, width, height } = u.bbox, pen = u.ctx;
    pen.save();
    pen.beginPath(); pen.rect(left, top, width, height); pen.clip();
    pen.setLineDash([]);
    pen.font = `${FONT * ratio}px system-ui, sans-serif`;
    pen.textAlign = "left"; pen.textBaseline = "top"; pen.lineJoin = "round";
    draw(pen, u.bbox, ratio);
    pen.restore();
  };

  // A text that can be read in front of anything.
  const write = (pen, ratio, text, x, y, ink) => {
    pen.lineWidth = 4 * ratio; pen.strokeStyle = colour("card"); pen.fillStyle = ink;
    pen.strokeText(text, x, y); pen.fillText(text, x, y);
  };
  // The same inside the frame where nothing stands yet; nothing where there is no room. Places are tried from `x`, `y` on.
  const placed = (pen, { left, top, width, height }, ratio, labels, text, x, y, down, ink) => {
    const wide = pen.measureText(text).width, tall = (FONT + 3) * ratio, gap = 8 * ratio, edge = EDGE * ratio;
    for (let line = 0; line < 6; line++) for (const at of [x + gap, x - gap - wide, ...(line ? [Math.min(Math.max(x - wide / 2, left + edge), left + width - wide - edge)] : [])]) {
      const box = { x: at, y: y + (down ? line : -line) * tall - (down ? 0 : tall), wide, tall, text };
      if (box.x < left + edge || box.x + wide > left + width - edge || box.y < top || box.y + tall > top + height) continue;
      if (labels.some((other) => box.x < other.x + other.wide + 2 * ratio && other.x < box.x + wide + 2 * ratio && box.y < other.y + other.tall && other.y < box.y + tall)) continue;
      labels.push(box);
      write(pen, ratio, text, box.x, box.y + ratio, ink);
      return;
    }
  };

  // Per curve and end of its axis the farthest value in view that lies beyond, as a triangle and in words. A curve has values, an ink,
  // a scale, words for a row, and perhaps one end alone; above `foot` pixels. Tells the peaks and the labels that found a place.
  const peaks = (u, curves, rows, { ratio = devicePixelRatio, foot = 0 } = {}) => {
    const labels = [], found = [];
    clipped(u, (pen, { left, top, width, height }) => {
      const frame = { left, top, width, height: height - foot * ratio };
      for (const curve of curves) for (const sign of curve.sign ? [curve.sign] : [1, -1]) {
        const { values, scale = "y", ink, words } = curve, { min, max } = u.scales[scale], end = sign > 0 ? max : min;
        let best = -1;
        for (const row of rows()) {
          const value = values[row];
          if (Number.isFinite(value) && sign * (value - end) > 0 && (best < 0 || sign * (value - values[best]) > 0)) best = row;
        }
        if (best < 0) continue;
        found.push({ curve, sign, at: best });
        const x = u.valToPos(u.data[0][best], "x", true), y = sign > 0 ? top : top + frame.height, size = SIZE * ratio;
        pen.fillStyle = ink;
        pen.beginPath(); pen.moveTo(x, y); pen.lineTo(x - size, y + sign * size * 1.4); pen.lineTo(x + size, y + sign * size * 1.4); pen.fill();
        placed(pen, frame, ratio, labels, words(best), x, y, sign > 0, ink);
      }
    }, ratio);
    return { labels, found };
  };

  linkdyn.marks = { clipped, write, placed, peaks };
})();

"use strict";
// What stands in a plot besides its curves. No text covers another, or a curve.
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
  // Whether a straight line goes through a box.
  const crosses = ({ x, y, wide, tall }, from, to) => {
    let [first, last] = [0, 1];
    for (const [start, end, low, high] of [[from[0], to[0], x, x + wide], [from[1], to[1], y, y + tall]]) {
      if (start === end) { if (start < low || start > high) return false; continue; }
      const [a, b] = [(low - start) / (end - start), (high - start) / (end - start)];
      [first, last] = [Math.max(first, Math.min(a, b)), Math.min(last, Math.max(a, b))];
    }
    return first < last;
  };
  // Whether one of the curves of a plot goes through a box. A line goes on over rows that a curve does not have, not over those without value.
  const isOn = (u, xs, curves, box) => curves.some(({ values, scale = "y" }) => {
    const place = (row) => [xs[row], u.valToPos(values[row], scale, true)];
    let before = -1;
    for (let row = 0; row < xs.length; row++) {
      if (values[row] === undefined) continue;
      const known = Number.isFinite(values[row]), [a, b] = [xs[before], xs[row]];
      if (known && before >= 0 && Math.max(a, b) >= box.x && Math.min(a, b) <= box.x + box.wide && crosses(box, place(before), place(row))) return true;
      before = known ? row : -1;
    }
    return false;
  });
  // A text inside the frame where nothing stands yet, not even a curve; nothing where there is no room. Places are tried from `x`, `y` on.
  const placed = (pen, u, curves, { left, top, width, height }, ratio, labels, text, x, y, down, ink) => {
    const wide = pen.measureText(text).width, tall = (FONT + 3) * ratio, gap = 8 * ratio, edge = EDGE * ratio;
    const xs = u.data[0].map((value) => u.valToPos(value, "x", true));
    for (let line = 0; line < 12; line++) for (const at of [x + gap, x - gap - wide, ...(line ? [Math.min(Math.max(x - wide / 2, left + edge), left + width - wide - edge)] : []), x + 3 * gap, x - 3 * gap - wide]) {
      const box = { x: at, y: y + (down ? line : -line) * tall - (down ? 0 : tall), wide, tall, text };
      if (box.x < left + edge || box.x + wide > left + width - edge || box.y < top || box.y + tall > top + height) continue;
      if (labels.some((other) => box.x < other.x + other.wide + 2 * ratio && other.x < box.x + wide + 2 * ratio && box.y < other.y + other.tall && other.y < box.y + tall)) continue;
      if (isOn(u, xs, curves, box)) continue;
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
        placed(pen, u, curves, frame, ratio, labels, words(best), x, y, sign > 0, ink);
      }
    }, ratio);
    return { labels, found };
  };

  linkdyn.marks = { clipped, write, placed, peaks };
})();

"use strict";
// What stands in a plot besides its curves: contacts and other events at the foot, a row for each run, and peaks beyond the axis.
(() => {
  const { units, colour, models } = linkdyn;
  const FOOT = 5, FONT = 11, EDGE = 5;

  const withEvents = (runs) => runs.filter(({ events }) => events.length);

  // Height of the rows of events [px].
  const foot = (runs) => { const rows = withEvents(runs).length; return rows ? rows * (FOOT + 1) + 3 : 0; };

  const events = (runs, u) => {
    const { left, top, width, height } = u.bbox, pen = u.ctx, ratio = devicePixelRatio;
    const rows = withEvents(runs);
    pen.save();
    pen.beginPath(); pen.rect(left, top, width, height); pen.clip();
    rows.forEach((run, k) => {
      pen.fillStyle = models.stroke(run);
      for (const [, from, to] of run.events) {
        const [a, b] = [from, to].map((instant) => u.valToPos(instant, "x", true));
        pen.fillRect(a, top + height - (k + 1) * (FOOT + 1) * ratio, Math.max(b - a, 1.5 * ratio), FOOT * ratio);
      }
    });
    pen.restore();
  };

  // A text inside the frame where nothing stands yet; none where there is no room.
  const placed = (labels, { left, top, width, height }, pen, text, x, y, down, ink) => {
    const ratio = devicePixelRatio;
    const wide = pen.measureText(text).width, tall = (FONT + 3) * ratio, gap = 7 * ratio;
    for (let line = 0; line < 5; line++) for (const at of [x + gap, x - gap - wide, ...(line ? [Math.min(Math.max(x - wide / 2, left + EDGE * ratio), left + width - wide - EDGE * ratio)] : [])]) {
      const box = { x: at, y: y + (down ? line : -line) * tall - (down ? 0 : tall), wide, tall, text };
      if (box.x < left + EDGE * ratio || box.x + wide > left + width - EDGE * ratio || box.y < top || box.y + tall > top + height) continue;
      if (labels.some((other) => box.x < other.x + other.wide + 2 * ratio && other.x < box.x + wide + 2 * ratio && box.y < other.y + other.tall && other.y < box.y + tall)) continue;
      labels.push(box);
      pen.strokeStyle = colour("card"); pen.fillStyle = ink;
      pen.strokeText(text, box.x, box.y + ratio); pen.fillText(text, box.x, box.y + ratio);
      return;
    }
  };

  // Per run and end of the axis the farthest value beyond it, as a triangle and in words; the labels that found a place.
  const peaks = (card, u, list, foot) => {
    const { left, top, width } = u.bbox, pen = u.ctx, ratio = devicePixelRatio;
    // Above the rows of events.
    const height = u.bbox.height - foot * ratio;
    const { min, max } = u.scales.y, labels = [], found = [];
    pen.save();
    pen.beginPath(); pen.rect(left, top, width, height); pen.clip();
    pen.font = `${FONT * ratio}px system-ui, sans-serif`;
    pen.textBaseline = "top"; pen.textAlign = "left"; pen.lineWidth = 4 * ratio; pen.lineJoin = "round";
    for (const { run, values } of list) for (const [sign, end] of [[1, max], [-1, min]]) {
      let best = -1;
      for (const row of card.inView()) {
        const value = values[row];
        if (Number.isFinite(value) && sign * (value - end) > 0 && (best < 0 || sign * (value - values[best]) > 0)) best = row;
      }
      if (best < 0) continue;
      const x = u.valToPos(linkdyn.times[best], "x", true), edge = sign > 0 ? top : top + height, size = EDGE * ratio;
      pen.fillStyle = models.stroke(run);
      pen.beginPath(); pen.moveTo(x, edge); pen.lineTo(x - size, edge + sign * size * 1.4); pen.lineTo(x + size, edge + sign * size * 1.4); pen.fill();
      const told = `${units.quantity(values[best] / card.factor, card.column.unit, 4)} at ${units.number(linkdyn.times[best], 4)} s`;
      found.push({ run: run.name, told });
      placed(labels, { left, top, width, height }, pen, told, x, edge, sign > 0, models.stroke(run));
    }
    pen.restore();
    return { labels, found };
  };

  linkdyn.marks = { events, foot, peaks };
})();

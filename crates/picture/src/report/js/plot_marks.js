"use strict";
// What stands in a plot besides its curves: events, and the values of peaks that are cut off. No text covers another.
(() => {
  const { units, time, drawing } = linkdyn;
  const FOOT = 7, FONT = 11, MOST_EVENTS = 4, EDGE = 4;

  // Events as dashed lines, intervals shaded; those of contacts, which may be many, as marks at the foot.
  const events = (plot, u, ratio = devicePixelRatio) => {
    if (plot.across) return;
    const { left, top, height, width } = u.bbox, pen = u.ctx;
    const colour = drawing.colour("warn");
    pen.save();
    pen.beginPath(); pen.rect(left, top, width, height); pen.clip();
    for (const event of plot.plots.events) {
      const [from, to] = [event.from, event.to].map((value) => u.valToPos(value * units.of(plot.abscissa.unit).factor, "x", true));
      if (!Number.isFinite(from)) continue;
      pen.strokeStyle = pen.fillStyle = colour;
      pen.lineWidth = 1.2 * ratio;
      if (event.low) {
        pen.globalAlpha = event.interval ? 0.5 : 1;
        pen.fillRect(Math.min(from, to), top + height - FOOT * ratio, Math.max(Math.abs(to - from), ratio), FOOT * ratio);
      } else if (event.interval) {
        pen.globalAlpha = 0.16; pen.fillRect(Math.min(from, to), top, Math.max(Math.abs(to - from), 2), height);
      } else {
        pen.setLineDash([5 * ratio, 4 * ratio]);
        pen.beginPath(); pen.moveTo(from, top); pen.lineTo(from, top + height); pen.stroke();
        pen.setLineDash([]);
      }
      pen.globalAlpha = 1;
    }
    pen.restore();
  };

  // A text inside the frame where nothing stands yet; none where there is no room. Places are tried from `x`, `y` on.
  const placed = (plot, u, pen, ratio, text, x, y, down, colour) => {
    const { left, top, width, height } = u.bbox;
    const wide = pen.measureText(text).width, tall = (FONT + 3) * ratio, gap = 8 * ratio;
    for (let line = 0; line < 6; line++) for (const at of [x + gap, x - gap - wide]) {
      const box = { x: at, y: y + (down ? line : -line) * tall - (down ? 0 : tall), wide, tall };
      if (box.x < left + EDGE * ratio || box.x + wide > left + width - EDGE * ratio || box.y < top || box.y + tall > top + height) continue;
      if (plot.labels.some((other) => box.x < other.x + other.wide + 2 * ratio && other.x < box.x + wide + 2 * ratio && box.y < other.y + other.tall && other.y < box.y + tall)) continue;
      plot.labels.push({ ...box, text });
      pen.strokeStyle = drawing.colour("card"); pen.fillStyle = colour;
      pen.strokeText(text, box.x, box.y + ratio); pen.fillText(text, box.x, box.y + ratio);
      return true;
    }
    return false;
  };

  // The farthest value beyond each end of a curve's axis.
  const peaks = (plot, u) => plot.columns.flatMap((column, k) => {
    const { min, max } = u.scales[plot.scale(column)], found = [];
    for (const [sign, end] of [[1, max], [-1, min]]) {
      let best = -1;
      for (const row of plot.inView(u.data)) {
        const value = u.data[k + 1][row];
        if (value !== null && sign * (value - end) > 0 && (best < 0 || sign * (value - u.data[k + 1][best]) > 0)) best = row;
      }
      // Rows of an axis that runs backwards are counted from the end.
      if (best >= 0) found.push({ k, column, sign, at: best, row: plot.order.reversed ? u.data[0].length - 1 - best : best });
    }
    return found;
  });

  const told = (plot, { column, row }) => {
    const { abscissa } = plot;
    const where = plot.across ? `${units.number(time[row], 4)} s` : units.quantity(abscissa.values[row], abscissa.unit, 4);
    if (linkdyn.headline.unbounded(column) !== undefined) return `no bound near ${where}`;
    return `${units.quantity(column.values[row], column.unit, 4)} at ${where}`;
  };

  const words = (plot, u, ratio = devicePixelRatio) => {
    const { left, top, width, height } = u.bbox, pen = u.ctx;
    plot.labels = [];
    plot.peaks = peaks(plot, u);
    pen.save();
    pen.beginPath(); pen.rect(left, top, width, height); pen.clip();
    pen.font = `${FONT * ratio}px system-ui, sans-serif`;
    pen.textBaseline = "top"; pen.textAlign = "left";
    pen.lineWidth = 4 * ratio; pen.lineJoin = "round";
    for (const peak of plot.peaks) {
      const x = u.valToPos(u.data[0][peak.at], "x", true), up = peak.sign > 0, edge = up ? top : top + height, size = 5 * ratio;
      const colour = linkdyn.curve.stroke(peak.k);
      pen.fillStyle = colour;
      pen.beginPath(); pen.moveTo(x, edge); pen.lineTo(x - size, edge + peak.sign * size * 1.4); pen.lineTo(x + size, edge + peak.sign * size * 1.4); pen.fill();
      placed(plot, u, pen, ratio, told(plot, peak), x, edge, up, colour);
    }
    const few = plot.across ? [] : plot.plots.events.filter(({ low }) => !low);
    if (few.length <= MOST_EVENTS) for (const event of few) {
      const from = u.valToPos(event.from * units.of(plot.abscissa.unit).factor, "x", true);
      if (Number.isFinite(from)) placed(plot, u, pen, ratio, event.word, from, top, true, drawing.colour("warn"));
    }
    pen.restore();
  };

  linkdyn.plotMarks = { events, words };
})();

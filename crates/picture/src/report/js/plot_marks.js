"use strict";
// What stands in a plot besides its curves: events, and the values of peaks that are cut off.
(() => {
  const { units, marks, tone, colour } = linkdyn;
  const FOOT = 7, MOST_EVENTS = 4;
  const place = (plot, u, value) => u.valToPos(value * units.of(plot.abscissa.unit).factor, "x", true);

  // Events as dashed lines, intervals shaded; those of contacts, which may be many, as marks at the foot.
  const events = (plot, u, ratio = devicePixelRatio) => {
    if (!plot.across) marks.clipped(u, (pen, { top, height }) => {
      for (const event of plot.plots.events) {
        const [from, to] = [event.from, event.to].map((value) => place(plot, u, value));
        if (!Number.isFinite(from)) continue;
        pen.strokeStyle = pen.fillStyle = colour("warn");
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
    }, ratio);
  };

  const peakWords = (plot, column, row) => {
    const { abscissa } = plot;
    const where = plot.across ? `${units.number(linkdyn.time[row], 4)} s` : units.quantity(abscissa.values[row], abscissa.unit, 4);
    if (linkdyn.headline.unbounded(column) !== undefined) return `no bound near ${where}`;
    return `${units.quantity(column.values[row], column.unit, 4, true)} at ${where}`;
  };

  // The peaks beyond the axes, then the names of few events; returns the labels.
  const words = (plot, u, ratio = devicePixelRatio) => {
    const { data } = u;
    const curves = plot.columns.map((column, k) => ({
      values: data[k + 1], scale: plot.scale(column), ink: tone(k),
      // Rows of an axis that runs backwards are counted from the end.
      words: (at) => peakWords(plot, column, plot.order.reversed ? data[0].length - 1 - at : at),
    }));
    const { labels } = marks.peaks(u, curves, () => plot.inView(data), { ratio });
    const few = plot.across ? [] : plot.plots.events.filter(({ low }) => !low);
    if (few.length <= MOST_EVENTS) marks.clipped(u, (pen, frame) => {
      for (const event of few) {
        const from = place(plot, u, event.from);
        if (Number.isFinite(from)) marks.placed(pen, u, curves, frame, ratio, labels, event.word, from, frame.top, true, colour("warn"));
      }
    }, ratio);
    return labels;
  };

  linkdyn.plotMarks = { events, words };
})();

"use strict";
// Contacts and other events at the foot of a plot, a row for each run.
(() => {
  const { marks, models } = linkdyn;
  const TALL = 5;
  const withEvents = (runs) => runs.filter(({ events }) => events.length);

  // Height of the rows of events [px].
  const footOf = (runs) => { const rows = withEvents(runs).length; return rows ? rows * (TALL + 1) + 3 : 0; };

  const drawEvents = (runs, u) => marks.clipped(u, (pen, { top, height }, ratio) => withEvents(runs).forEach((run, k) => {
    pen.fillStyle = models.stroke(run);
    for (const [, from, to] of run.events) {
      const [a, b] = [from, to].map((instant) => u.valToPos(instant, "x", true));
      pen.fillRect(a, top + height - (k + 1) * (TALL + 1) * ratio, Math.max(b - a, 1.5 * ratio), TALL * ratio);
    }
  }));

  Object.assign(linkdyn, { footOf, drawEvents });
})();

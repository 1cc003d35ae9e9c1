"use strict";
// Parallel coordinates: an axis for each variable, a line for each variant; a range is drawn along an axis.
(() => {
  const { variants, choice, colour, plotting, units, Frame, id } = linkdyn;
  // More lines are one blot.
  const MOST = 1500;
  const step = Math.max(1, Math.ceil(variants / MOST)), rows = [];
  for (let row = 0; row < variants; row += step) rows.push(row);

  const draw = (pen, width, height) => {
    const list = linkdyn.shown(), n = list.length, [top, tall] = [38, height - 38 - 22];
    const xs = list.map((_, k) => n > 1 ? 46 + (width - 92) * k / (n - 1) : width / 2);
    const ranges = list.map(({ from, to }) => to > from ? [from, to] : plotting.widened([from, to]));
    const y = (k, value) => top + tall * (ranges[k][1] - value) / (ranges[k][1] - ranges[k][0]);
    const along = (row) => {
      let down = false;
      list.forEach(({ values }, k) => {
        const place = y(k, values[row]);
        if (!Number.isFinite(place)) { down = false; return; }
        if (down) pen.lineTo(xs[k], place); else pen.moveTo(xs[k], place);
        down = true;
      });
    };
    const lines = (which, tone, alpha) => {
      pen.strokeStyle = tone; pen.globalAlpha = alpha; pen.lineWidth = 1;
      for (const row of which) { pen.beginPath(); along(row); pen.stroke(); }
      pen.globalAlpha = 1;
    };
    const { mask } = choice, alpha = Math.min(0.7, Math.max(0.08, 60 / rows.length));
    if (mask) {
      lines(rows.filter((row) => !mask[row]), colour("muted"), alpha * 0.5);
      // Of few selected ones all.
      const some = [];
      const every = Math.max(1, Math.ceil(choice.count / MOST));
      for (let row = 0, k = 0; row < variants; row++) if (mask[row] && k++ % every === 0) some.push(row);
      lines(some, colour("accent"), Math.min(0.8, Math.max(0.12, 120 / some.length)));
    } else lines(rows, colour("accent"), alpha);
    if (choice.row >= 0) { pen.strokeStyle = colour("force"); pen.lineWidth = 2.4; pen.beginPath(); along(choice.row); pen.stroke(); }
    const plots = list.map((own, k) => {
      pen.lineWidth = 1.2; pen.strokeStyle = colour("steel"); plotting.line(pen, [xs[k], top], [xs[k], top + tall]);
      own.limits?.forEach((limit) => { const place = limit === null ? NaN : y(k, limit); if (place >= top && place <= top + tall) { pen.strokeStyle = colour("bad"); pen.lineWidth = 2; plotting.line(pen, [xs[k] - 7, place], [xs[k] + 7, place]); } });
      const range = choice.ranges.get(own);
      if (range) {
        const [a, b] = range.map((value) => Math.min(Math.max(y(k, value), top), top + tall));
        pen.fillStyle = pen.strokeStyle = colour("accent"); pen.globalAlpha = 0.25; pen.fillRect(xs[k] - 8, b, 16, Math.max(a - b, 2));
        pen.globalAlpha = 1; pen.strokeRect(xs[k] - 8, b, 16, Math.max(a - b, 2));
      }
      pen.font = "11.5px system-ui, sans-serif"; pen.fillStyle = colour("muted"); pen.textAlign = "center"; pen.textBaseline = "alphabetic";
      const room = n > 1 ? (width - 92) / (n - 1) - 8 : width;
      pen.fillText(units.number(own.to, 4), xs[k], top - 6, room); pen.fillText(units.number(own.from, 4), xs[k], top + tall + 16, room);
      pen.fillStyle = colour("ink"); pen.font = "600 12px system-ui, sans-serif"; pen.fillText(room < 80 ? own.name : own.label, xs[k], 14, Math.max(room, 30));
      const at = plotting.scales({ left: xs[k] - 16, top, wide: 32, tall }, [0, 1], ranges[k]);
      const brush = (from, to) => choice.narrow(own, [at.valueY(from[1]), at.valueY(to[1])].sort((a, b) => a - b));
      // A click on a range takes it away, else it finds the variant whose line is there.
      const pick = (px, py) => {
        if (choice.ranges.has(own)) { choice.narrow(own, null); return null; }
        let [best, least] = [-1, 10];
        for (const row of rows) { const far = Math.abs(y(k, own.values[row]) - py); if (far < least) [best, least] = [row, far]; }
        return best;
      };
      return { at, y: own, brush, pick };
    });
    return plots;
  };
  id("parallel_note").textContent = step > 1 ? `${linkdyn.count(rows.length)} of ${linkdyn.count(variants)} variants have a line here, and of the selected ones up to ${MOST}. Drag along an axis to select, click the range to remove it.` : "Drag along an axis to select, click the range to remove it.";
  new Frame(id("parallel_plot"), draw);
})();

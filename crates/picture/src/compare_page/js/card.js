"use strict";
// One column: the curves of the runs that are switched on, and below them their differences to the reference.
(() => {
  const { units, element, colour, models, marks, ran, reference, times, columns } = linkdyn;
  const TALL = 216, LOW = 132;
  const FONT = "12px system-ui, sans-serif";
  const tick = (u, splits) => splits.map((value) => value === null ? null : units.number(value, 6));
  const TURNS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720, 1800, 3600, 7200, 18000, 36000];

  // A little more than what is there; something to see where all is one value.
  const padded = (low, high) => {
    if (!(low <= high)) return [-1, 1];
    const most = Math.max(Math.abs(low), Math.abs(high));
    const room = high - low > 1e-9 * most ? (high - low) * 0.07 : most > 0 ? most * 0.1 : 1;
    return [low - room, high + room];
  };

  class Card {
    constructor(cards, k) {
      this.cards = cards;
      this.k = k;
      this.column = columns[k];
      this.unit = element("span", { className: "muted" });
      this.values = element("div", { className: "values" });
      this.what = element("span", { className: "muted what" });
      this.upper = element("div", { className: "canvas values_plot" });
      this.caption = element("p", { className: "caption text" });
      this.lower = element("div", { className: "canvas apart_plot" });
      this.root = element("section", { className: "card", "aria-label": `Plot of ${linkdyn.plain(this.column.name)}` },
        element("h2", {}, element("span", { text: this.column.name, className: "text" }), this.unit, this.what), this.values, this.upper, this.caption, this.lower);
      this.plots = [];
      this.width = 0;
      new ResizeObserver(() => setTimeout(() => { if (!models.paper) this.fit(); }, 0)).observe(this.upper);
    }

    get factor() { return units.of(this.column.unit).factor; }
    get shown() { return ran.filter((run) => run.on); }

    // Values of a run at all instants: undefined where it has no row, null where the row has no value.
    curve(run) {
      const of = run.values[this.k], { factor } = this;
      return run.row.map((row) => row < 0 ? undefined : Number.isFinite(of[row]) ? of[row] * factor : null);
    }

    fit(wide) {
      const width = wide || Math.floor(this.upper.clientWidth);
      if (width < 40 || (width === this.width && this.plots.length)) return;
      this.width = width;
      this.build();
    }

    build() {
      this.plots.forEach(({ u }) => u.destroy());
      this.plots = [];
      const { label } = units.of(this.column.unit);
      this.unit.textContent = label === "–" ? "" : `[${label}]`;
      if (this.width < 40 || !reference) return;
      const cuts = (run, found) => this.cards.cut ? found.map((end) => end === null ? null : end * this.factor) : [null, null];
      const first = this.curve(reference);
      const list = this.shown.map((run) => ({ run, values: run === reference ? first : this.curve(run), cut: cuts(run, run.cuts[this.k]) }));
      const others = list.filter(({ run }) => run !== reference);
      const apart = ({ run, values }) => ({ run, values: values.map((value, row) => value === undefined || first[row] === undefined ? undefined : value === null || first[row] === null ? null : value - first[row]) });
      const differences = this.cards.differences ? others.map((found) => ({ ...apart(found), cut: cuts(found.run, found.run.apart_cuts[this.k]) })) : [];
      // Without curves to compare no room is taken for them.
      const both = differences.length > 0;
      this.caption.hidden = this.lower.hidden = !both;
      this.caption.textContent = both ? `difference to ${linkdyn.plain(reference.name)}${label === "–" ? "" : ` [${label}]`}` : "";
      this.draw(this.upper, list, TALL, { foot: marks.foot(this.shown), last: !both, events: true });
      if (both) this.draw(this.lower, differences, LOW, { foot: 0, last: true, events: false });
      this.mark();
    }

    draw(holder, list, height, { foot, last, events }) {
      const [ink, grid] = [colour("muted"), colour("grid")];
      const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1, size: 5 }, font: FONT, labelFont: FONT };
      const angle = units.of(this.column.unit).label === "°" ? { incrs: TURNS } : {};
      const inner = height - (last ? 44 : 16) - 8;
      const range = () => { const [low, high] = padded(...this.span(list)); return [low - (high - low) * foot / Math.max(inner - foot, 1), high]; };
      const plot = { list, labels: [], found: [] };
      plot.u = new uPlot({
        width: this.width, height, pxAlign: 0, legend: { show: false }, padding: [8, 14, 0, 0],
        scales: { x: { time: false, range: () => this.cards.zoom || this.cards.whole }, y: { range } },
        axes: [
          { ...axis, values: last ? tick : (u, splits) => splits.map(() => ""), ...(last ? { label: "time [s]", labelSize: 16, size: 28 } : { size: 8 }) },
          { ...axis, ...angle, values: tick, size: 72, space: last && !events ? 26 : 34 },
        ],
        series: [{}, ...list.map(({ run }) => ({ scale: "y", label: run.name, stroke: models.stroke(run), width: models.width(run), dash: models.dash(run), spanGaps: false, points: { show: run.rows === 1 } }))],
        cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: false, setScale: false }, bind: { dblclick: () => () => { this.cards.setZoom(null); return null; } } },
        hooks: {
          drawClear: [(u) => { if (events) marks.events(this.shown, u); }],
          draw: [(u) => Object.assign(plot, marks.peaks(this, u, list, foot)), () => this.mark()],
          setSelect: [(u) => this.select(u)],
        },
      }, [times, ...list.map(({ values }) => values)], holder);
      plot.line = element("div", { className: "now-line", hidden: "" });
      plot.u.over.append(plot.line);
      this.plots.push(plot);
      const point = (event) => this.cards.point(plot.u.posToVal(event.clientX - plot.u.over.getBoundingClientRect().left, "x"));
      plot.u.over.addEventListener("pointermove", (event) => { if (event.buttons === 0 || event.pointerType !== "mouse") point(event); });
      plot.u.over.addEventListener("pointerdown", (event) => { if (event.pointerType !== "mouse") point(event); });
      plot.u.over.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") this.cards.point(null); });
    }

    // Rows in view.
    *inView() {
      const { zoom } = this.cards;
      for (let row = 0; row < times.length; row++) if (!zoom || (times[row] >= zoom[0] && times[row] <= zoom[1])) yield row;
    }

    // Lowest and highest value to show: all in view, but for peaks that are cut off.
    span(list) {
      let [least, most] = [Infinity, -Infinity];
      for (const { values, cut } of list) {
        const [low, high] = [cut[0] === null ? -Infinity : cut[0], cut[1] === null ? Infinity : cut[1]];
        let [a, b, out, count, lowest, highest] = [Infinity, -Infinity, 0, 0, Infinity, -Infinity];
        for (const row of this.inView()) {
          const value = values[row];
          if (!Number.isFinite(value)) continue;
          count++;
          lowest = Math.min(lowest, value); highest = Math.max(highest, value);
          if (value < low || value > high) out++;
          a = Math.min(a, Math.max(value, low)); b = Math.max(b, Math.min(value, high));
        }
        // Who looks at the peak itself sees it.
        if (out > 0.3 * count) [a, b] = [lowest, highest];
        [least, most] = [Math.min(least, a), Math.max(most, b)];
      }
      return [least, most];
    }

    select(u) {
      if (u.select.width < 4) return;
      const ends = [u.select.left, u.select.left + u.select.width].map((left) => u.posToVal(left, "x"));
      u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      this.cards.setZoom(ends);
    }

    // Values at the instant under the cursor; without one the peaks.
    mark() {
      const { row } = this.cards;
      for (const { u, line } of this.plots) {
        if (!line) continue;
        const left = row === null ? NaN : u.valToPos(times[row], "x");
        line.hidden = !(left >= -1 && left <= u.over.clientWidth + 1);
        if (!line.hidden) line.style.left = `${left}px`;
      }
      this.what.textContent = row === null ? "peaks" : `at ${units.number(times[row], 6)} s`;
      this.values.replaceChildren(...this.shown.map((run) => {
        const number = element("span", { className: "number", text: row === null ? this.peak(run) : units.quantity(this.at(run, row), this.column.unit, 5) });
        return element("span", { className: "value" }, models.swatch(run, 16), element("span", { className: "muted text", text: run.name }), number);
      }));
    }

    // The value of a run at an instant, or at its last one before.
    at(run, row) {
      while (row >= 0 && run.row[row] < 0) row--;
      return row < 0 ? NaN : run.values[this.k][run.row[row]];
    }

    peak(run) {
      const found = run.extremes[this.k];
      if (!found) return "–";
      return units.quantity(Math.abs(found[0]) > Math.abs(found[2]) ? found[0] : found[2], this.column.unit, 4);
    }
  }

  linkdyn.Card = Card;
})();

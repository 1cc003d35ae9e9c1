"use strict";
// One column: the curves of the runs that are switched on, and below them their differences to the reference.
(() => {
  const { units, element, axes, models, marks, ran, reference, times, columns } = linkdyn;
  const TALL = 216, LOW = 132, PAPER = 135;

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
      const cut = (ends) => this.cards.cut ? axes.scaled(ends, this.factor) : [null, null];
      const first = this.curve(reference);
      const list = this.shown.map((run) => ({ run, values: run === reference ? first : this.curve(run), cut: cut(run.cuts[this.k]) }));
      const others = list.filter(({ run }) => run !== reference);
      const apart = ({ run, values }) => ({ run, values: values.map((value, row) => value === undefined || first[row] === undefined ? undefined : value === null || first[row] === null ? null : value - first[row]) });
      // On paper there is room for the curves themselves.
      const differences = this.cards.differences && !models.paper ? others.map((found) => ({ ...apart(found), cut: cut(found.run.apart_cuts[this.k]) })) : [];
      // Without curves to compare no room is taken for them.
      const both = differences.length > 0;
      this.caption.hidden = this.lower.hidden = !both;
      this.caption.textContent = both ? `difference to ${linkdyn.plain(reference.name)}${label === "–" ? "" : ` [${label}]`}` : "";
      this.draw(this.upper, list, models.paper ? PAPER : TALL, { foot: linkdyn.footOf(this.shown), last: !both, events: true });
      if (both) this.draw(this.lower, differences, LOW, { foot: 0, last: true, events: false });
      this.mark();
    }

    draw(holder, list, height, { foot, last, events }) {
      const { label } = units.of(this.column.unit), inner = height - (last ? 44 : 16) - 8, rows = () => this.inView();
      const sound = list.filter(({ run }) => run.sets_scale), scaling = this.cards.cut && sound.length ? sound : list;
      const range = () => { const [low, high] = axes.padded(...axes.span(scaling, rows)); return [low - (high - low) * foot / Math.max(inner - foot, 1), high]; };
      const plot = { list, labels: [], found: [] };
      const peaks = (u) => {
        const words = (values) => (row) => `${units.quantity(values[row] / this.factor, this.column.unit, 4, true)} at ${units.number(times[row], 4)} s`;
        const curves = list.map(({ run, values }) => ({ run, values, ink: models.stroke(run), words: words(values) }));
        const { labels, found } = marks.peaks(u, curves, rows, { foot });
        Object.assign(plot, { labels, found: found.map(({ curve, at }) => ({ run: curve.run.name, words: curve.words(at) })) });
      };
      plot.u = new uPlot({
        ...axes.options(true, () => this.cards.setZoom(null)),
        width: this.width, height, padding: [8, 22, 0, 0],
        scales: { x: { time: false, range: () => this.cards.zoom || this.cards.whole }, y: { range } },
        axes: [
          axes.axis("s", last ? { label: "time [s]", labelSize: 16, size: 28 } : { size: 8, values: (u, splits) => splits.map(() => "") }),
          axes.axis(label, { size: 72, space: last && !events ? 26 : 34 }),
        ],
        series: [{}, ...list.map(({ run }) => ({ scale: "y", label: run.name, stroke: models.stroke(run), width: models.width(run), dash: models.dash(run), spanGaps: false, points: { show: run.rows === 1 } }))],
        hooks: {
          drawClear: [(u) => { if (events) linkdyn.drawEvents(this.shown, u); }], draw: [peaks, () => this.mark()],
          setSelect: [(u) => { const zoom = axes.dragged(u); if (zoom) this.cards.setZoom(zoom); }],
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
        const number = element("span", { className: "number", text: row === null ? this.peak(run) : units.quantity(this.at(run, row), this.column.unit, 5, true) });
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
      return units.quantity(Math.abs(found[0]) > Math.abs(found[2]) ? found[0] : found[2], this.column.unit, 4, true);
    }
  }

  linkdyn.Card = Card;
})();

"use strict";
// One plot: curves of columns with at most two units, over what all plots share (time, a driver's value) or a column of its own.
(() => {
  const { player, units, element, icon, axes, tone, plotMarks } = linkdyn;
  const HEIGHT = 210;
  const DASHES = [[], [8, 4], [2, 3], [12, 3, 2, 3], [5, 5], [1, 4]];
  const dashes = (k) => DASHES[k % DASHES.length];
  const times = (values, factor) => Array.from(values, (value) => Number.isFinite(value) ? value * factor : null);

  // A curve over values that go to and fro, which uPlot's own paths are not made for.
  const wandering = (u, k) => {
    const drawn = new Path2D();
    let down = false;
    const scale = u.series[k].scale, [xs, ys] = [u.data[0], u.data[k]];
    for (let row = 0; row < xs.length; row++) {
      if (xs[row] === null || ys[row] === null) { down = false; continue; }
      const x = u.valToPos(xs[row], "x", true), y = u.valToPos(ys[row], scale, true);
      if (down) drawn.lineTo(x, y); else drawn.moveTo(x, y);
      down = true;
    }
    return { stroke: drawn, fill: null, clip: null, band: null, gaps: null, flags: 1 };
  };

  const tickSize = (u, values) => 26 + 6.4 * Math.max(0, ...(values || []).map((text) => (text || "").length));

  // The end of a long name says more than its beginning.
  const short = (name) => { const text = linkdyn.plain(name); return text.length > 26 ? `…${text.slice(-25)}` : text; };

  class Plot {
    // `across`: a column of its own to be over, and whether a length has the same size both ways.
    constructor(plots, columns, { across = null, equal = false } = {}) {
      this.plots = plots;
      this.columns = columns;
      this.across = across;
      this.equal = equal;
      this.apart = false;
      this.chips = element("div", { className: "chips" });
      this.holder = element("div", { className: "canvas" });
      this.root = element("section", { className: "card", "aria-label": "Plot" }, this.chips, this.holder);
      this.u = null;
      this.width = 0;
      this.height = HEIGHT;
      this.labels = [];
      // What is out of sight need not follow, nor be drawn before there is time.
      this.seen = true;
      this.awake = false;
      this.stale = false;
      new IntersectionObserver(([entry]) => { this.seen = entry.isIntersecting; if (this.seen) { this.wake(); if (this.stale) this.renew(); this.mark(); } }).observe(this.root);
      // Not at once: a new height is a change of its own.
      new ResizeObserver(() => setTimeout(() => { if (this.awake) this.fit(); }, 0)).observe(this.holder);
    }

    // The axis of a curve: that of its unit, or one of its own.
    scale(column) { return this.apart && column === this.columns[1] ? `${column.unit}, right` : column.unit; }
    get scales() { return [...new Set(this.columns.map((column) => this.scale(column)))]; }
    get units() { return [...new Set(this.columns.map((column) => column.unit))]; }
    get abscissa() { return this.across ? { name: this.across.name, unit: this.across.unit, values: this.across.values, label: short(this.across.name) } : this.plots.abscissa; }
    get order() { return this.across ? { monotone: false, reversed: false } : this.plots.order; }
    get zoom() { return this.across ? null : this.plots.zoom; }
    takes(column) { return !this.columns.includes(column) && !this.across && (this.units.includes(column.unit) || this.units.length < 2); }
    add(...columns) { this.columns.push(...columns); this.build(); }

    wake() { if (!this.awake) { this.awake = true; this.fit(); } }
    fit(wide) {
      const width = wide || Math.floor(this.holder.clientWidth);
      const height = this.equal ? Math.min(Math.max(Math.round(width * 0.5), HEIGHT), 300) : HEIGHT;
      if (width < 40 || (width === this.width && height === this.height && this.u)) return;
      [this.width, this.height] = [width, height];
      if (this.u) { this.u.setSize({ width, height }); this.u.setData(this.u.data, true); this.settle(); this.mark(); } else this.build();
    }
    // A length is as long both ways only once uPlot knows how much room its axes leave: after it has laid itself out.
    settle() {
      const { u } = this;
      if (this.equal) queueMicrotask(() => { if (this.u === u) u.setData(u.data, true); });
    }

    build() {
      if (this.u) { this.u.destroy(); this.u = null; }
      this.head();
      if (!this.columns.length || this.width < 40) return;
      this.apart = !this.across && linkdyn.choices.apart(this.columns);
      const { abscissa, order } = this, across = units.of(abscissa.unit), columns = [...this.columns];
      this.gather();
      const scales = { x: { time: false, range: (u) => this.zoom || (this.equal ? this.even(u, this.data)[0] : this.whole) } };
      const axis = [axes.axis(across.label, { label: `${abscissa.label}${across.label === "–" ? "" : ` [${across.label}]`}`, labelSize: 16, size: 28 })];
      this.scales.forEach((scale, k) => {
        const own = columns.filter((column) => this.scale(column) === scale), { label, factor } = units.of(own[0].unit);
        const cut = (column) => this.plots.cut ? axes.scaled(linkdyn.cutOf(column), factor) : [null, null];
        const curves = () => own.map((column) => ({ values: this.data[columns.indexOf(column) + 1], cut: cut(column) }));
        scales[scale] = { range: (u) => this.equal ? this.even(u, this.data)[1] : axes.padded(...axes.span(curves(), () => this.inView(this.data))) };
        const made = axes.axis(label, { scale, side: k ? 1 : 3, stroke: this.ink(scale), size: tickSize, label: `${this.axisName(own)}[${label}]`, labelSize: 18 });
        axis.push({ ...made, grid: { ...made.grid, show: k === 0 } });
      });
      const series = [{}, ...this.columns.map((column, k) => ({
        scale: this.scale(column), stroke: tone(k), width: 1.7, dash: dashes(k), spanGaps: false,
        points: { show: linkdyn.rows === 1 || undefined }, ...(order.monotone ? {} : { paths: wandering, points: { show: false } }),
      }))];
      // uPlot draws later: a plot that was rebuilt meanwhile has nothing to say.
      const alive = (act) => (u) => { if (this.u === u) act(u); };
      this.u = new uPlot({
        ...axes.options(!this.across, () => this.plots.setZoom(null)),
        width: this.width, height: this.height, scales, axes: axis, series, padding: [8, this.scales.length > 1 ? 4 : 14, 0, 4],
        hooks: { drawClear: [alive((u) => plotMarks.events(this, u))], draw: [alive((u) => { this.labels = plotMarks.words(this, u); }), alive(() => this.mark())], setSelect: [alive((u) => { const zoom = axes.dragged(u); if (zoom) this.plots.setZoom(zoom); })] },
      }, this.data, this.holder);
      this.monotone = order.monotone;
      this.line = element("div", { className: "now-line" });
      this.dots = this.columns.map((column, k) => { const dot = element("div", { className: "now-dot" }); dot.style.background = tone(k); return dot; });
      this.u.over.append(this.line, ...this.dots);
      this.settle();
      this.listen();
      this.mark();
    }

    // What is drawn, in the units that are shown.
    gather() {
      const { abscissa, order } = this, arrange = (values) => order.reversed ? values.reverse() : values;
      const xs = arrange(times(abscissa.values, units.of(abscissa.unit).factor));
      this.data = [xs, ...this.columns.map((column) => arrange(times(column.values, units.of(column.unit).factor)))];
      this.whole = this.across ? axes.padded(...this.plots.range(xs)) : this.plots.range(xs);
    }
    // The same curves of another run; what is out of sight waits until it is seen.
    renew() {
      this.stale = !this.seen;
      if (this.stale || !this.u) return;
      if (this.monotone !== this.order.monotone) { this.build(); return; }
      this.gather();
      this.u.setData(this.data, true);
      this.settle();
      this.mark();
    }

    listen() {
      const { over } = this.u;
      over.addEventListener("pointermove", (event) => {
        if (player.playing || (event.buttons !== 0 && event.pointerType === "mouse")) return;
        this.point(event);
        this.plots.hover(this, event);
      });
      over.addEventListener("pointerleave", () => this.plots.leave());
      over.addEventListener("pointerdown", (event) => { if (event.pointerType !== "mouse") { player.pause(); this.point(event); } });
      over.addEventListener("click", (event) => this.point(event));
    }

    // Rows in view.
    *inView(data) {
      const { zoom } = this;
      for (let row = 0; row < data[0].length; row++) {
        const x = data[0][row];
        if (x !== null && !(zoom && (x < zoom[0] || x > zoom[1]))) yield row;
      }
    }

    // Of two axes, one that has a single curve has its colour.
    ink(scale) {
      const own = this.columns.filter((column) => this.scale(column) === scale);
      return this.scales.length > 1 && own.length === 1 ? tone(this.columns.indexOf(own[0])) : linkdyn.colour("muted");
    }

    // What an axis says before its unit: the name of its only curve where the legend is not enough.
    axisName(own) {
      if (this.across) return `${short(own[0].name)} `;
      return this.apart ? `${short(own[0].name.split(".").at(-1))} ` : "";
    }

    // Ranges in which a length is as long across as upright.
    even(u, data) {
      const [[left, right], [low, high]] = [this.plots.range(data[0]), this.plots.range(data[1])].map((range) => axes.padded(...range));
      const [wide, tall] = [u.over ? u.over.clientWidth : 0, u.over ? u.over.clientHeight : 0];
      if (!(wide > 0 && tall > 0)) return [[left, right], [low, high]];
      const scale = Math.max((right - left) / wide, (high - low) / tall);
      const around = (a, b, size) => [(a + b - scale * size) / 2, (a + b + scale * size) / 2];
      return [around(left, right, wide), around(low, high, tall)];
    }

    // To the instant under the cursor.
    point(event) {
      const box = this.u.over.getBoundingClientRect();
      const x = this.u.posToVal(event.clientX - box.left, "x") / units.of(this.abscissa.unit).factor;
      if (!this.across) { player.seek(this.plots.nearest(x)); return; }
      const [column] = this.columns, y = this.u.posToVal(event.clientY - box.top, column.unit) / units.of(column.unit).factor;
      const scale = (axis) => Math.abs(this.u.scales[axis].max - this.u.scales[axis].min) || 1;
      player.seek(this.plots.closest([this.across.values, x, scale("x")], [column.values, y, scale(column.unit)]));
    }

    // The instant that is shown.
    mark() {
      const row = player.row;
      this.values.forEach((node, k) => { node.textContent = linkdyn.textOf(this.columns[k], row, 5, true); });
      if (!this.u) return;
      const across = units.of(this.abscissa.unit).factor;
      const left = this.u.valToPos(this.abscissa.values[row] * across, "x");
      // Sizes that uPlot keeps: to ask the page for them would make it lay itself out for every plot anew.
      const [wide, tall] = [this.u.bbox.width, this.u.bbox.height].map((size) => size / devicePixelRatio);
      const inside = Number.isFinite(left) && left >= -1 && left <= wide + 1;
      this.line.hidden = !inside || this.across !== null;
      if (inside) this.line.style.transform = `translateX(${left}px)`;
      this.columns.forEach((column, k) => {
        const top = this.u.valToPos(column.values[row] * units.of(column.unit).factor, this.scale(column));
        this.dots[k].hidden = !inside || !Number.isFinite(top) || top < -5 || top > tall + 5;
        if (!this.dots[k].hidden) this.dots[k].style.transform = `translate(${left}px, ${top}px)`;
      });
    }

    head() {
      this.values = [];
      const chips = this.columns.map((column, k) => {
        const value = element("span", { className: "number" });
        this.values.push(value);
        const drop = () => { this.columns.splice(k, 1); if (this.columns.length) this.build(); else this.plots.remove(this); };
        return element("span", { className: "chip" }, axes.swatch(tone(k), { dash: dashes(k) }), element("span", { text: column.name, className: "text" }), value,
          element("button", { type: "button", text: "×", "aria-label": `Remove ${linkdyn.plain(column.name)}`, on: { click: drop } }));
      });
      const tools = element("div", { className: "tools" });
      const tool = (name, title, click) => tools.append(element("button", { type: "button", title, "aria-label": title, on: { click } }, icon(name)));
      if (this.plots.tools) tools.append(this.plots.tools(this));
      tool("close", "Remove this plot", () => this.plots.remove(this));
      this.chips.replaceChildren(...chips, ...(this.across ? [] : [this.adder()]), tools);
      this.mark();
    }

    // A name, a part of one, or a pattern such as joint.*.f.
    adder() {
      const input = element("input", { type: "text", list: "names", placeholder: "+ column", title: "A name, a part of one, or a pattern such as joint.*.f", "aria-label": "Add columns to this plot" });
      input.addEventListener("input", () => this.plots.suggest(input.value));
      input.addEventListener("focus", () => this.plots.suggest(input.value));
      input.addEventListener("change", () => { const text = input.value; input.value = ""; this.plots.addAll(this.plots.match(text), this); });
      return input;
    }
  }

  Object.assign(linkdyn, { Plot, dashes });
})();

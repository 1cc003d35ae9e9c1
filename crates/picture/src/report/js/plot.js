"use strict";
// One plot: curves of columns with at most two units, over time or a driver's value.
(() => {
  const { player, units, element, rows, summary, drawing } = linkdyn;
  const FOOT = 7;
  const DASHES = [[], [8, 4], [2, 3], [12, 3, 2, 3], [5, 5], [1, 4]];
  const { curves } = linkdyn.palette;
  const stroke = (k) => curves[k % curves.length][linkdyn.theme.dark ? "dark" : "light"];
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

  // Ticks as short as can be.
  const tick = (u, splits) => splits.map((value) => value === null ? null : units.number(value, 6));
  const tickSize = (u, values) => 26 + 6.4 * Math.max(0, ...(values || []).map((text) => (text || "").length));

  class Plot {
    constructor(plots, columns) {
      this.plots = plots;
      this.columns = columns;
      this.chips = element("div", { className: "chips" });
      this.holder = element("div", { className: "canvas" });
      this.root = element("section", { className: "card", "aria-label": "Plot" }, this.chips, this.holder);
      this.u = null;
      this.width = 0;
      new ResizeObserver(() => this.fit()).observe(this.holder);
    }

    get units() { return [...new Set(this.columns.map((column) => column.unit))]; }
    takes(column) { return !this.columns.includes(column) && (this.units.includes(column.unit) || this.units.length < 2); }
    add(column) { this.columns.push(column); this.build(); }

    fit(wide) {
      const width = wide || Math.floor(this.holder.clientWidth);
      if (width < 40 || width === this.width) return;
      this.width = width;
      if (this.u) { this.u.setSize({ width, height: 230 }); this.mark(); } else this.build();
    }

    build() {
      if (this.u) { this.u.destroy(); this.u = null; }
      this.head();
      if (!this.columns.length || this.width < 40) return;
      const { abscissa } = this.plots, across = units.of(abscissa.unit), order = this.plots.order;
      const arrange = (values) => order.reversed ? values.reverse() : values;
      const xs = arrange(times(abscissa.values, across.factor));
      const data = [xs, ...this.columns.map((column) => arrange(times(column.values, units.of(column.unit).factor)))];
      const [ink, grid] = [drawing.colour("muted"), drawing.colour("grid")];
      const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1, size: 5 }, font: "11.5px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif" };
      const whole = this.plots.range(xs);
      const scales = { x: { time: false, range: (u, low, high) => this.plots.zoom ? this.plots.zoom : whole } };
      const axes = [{ ...axis, values: tick, label: `${abscissa.label}${across.label === "–" ? "" : ` [${across.label}]`}`, labelSize: 18, size: 30 }];
      this.units.forEach((unit, k) => {
        const label = units.of(unit).label;
        scales[unit] = { range: () => padded(...this.span(unit, data)) };
        axes.push({ ...axis, scale: unit, side: k ? 1 : 3, values: tick, size: tickSize, label: `[${label}]`, labelSize: 18, grid: { ...axis.grid, show: k === 0 } });
      });
      const series = [{}, ...this.columns.map((column, k) => ({
        scale: column.unit, stroke: stroke(k), width: 1.7, dash: DASHES[k % DASHES.length], spanGaps: false,
        points: { show: rows === 1 || undefined }, ...(order.monotone ? {} : { paths: wandering, points: { show: false } }),
      }))];
      this.u = new uPlot({
        width: this.width, height: 230, scales, axes, series, legend: { show: false }, pxAlign: 0,
        padding: [10, this.units.length > 1 ? 4 : 14, 0, 4],
        cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: false, setScale: false }, bind: { dblclick: () => () => { this.plots.setZoom(null); return null; } } },
        hooks: { drawClear: [(u) => this.events(u)], draw: [(u) => this.eventWords(u), () => this.mark()], setSelect: [(u) => this.select(u)] },
      }, data, this.holder);
      this.line = element("div", { className: "now-line" });
      this.dots = this.columns.map((column, k) => { const dot = element("div", { className: "now-dot" }); dot.style.background = stroke(k); return dot; });
      this.u.over.append(this.line, ...this.dots);
      this.u.over.addEventListener("pointermove", (event) => { if (!player.playing && (event.buttons === 0 || event.pointerType !== "mouse")) this.point(event); });
      this.u.over.addEventListener("pointerdown", (event) => { if (event.pointerType !== "mouse") { player.pause(); this.point(event); } });
      this.u.over.addEventListener("click", (event) => this.point(event));
      this.mark();
    }

    // Smallest and largest value in view of a unit's curves; without peaks where these would flatten all else.
    span(unit, data) {
      const zoom = this.plots.zoom, values = [];
      this.columns.forEach((column, k) => {
        if (column.unit === unit) data[k + 1].forEach((value, row) => {
          const x = data[0][row];
          if (value !== null && x !== null && !(zoom && (x < zoom[0] || x > zoom[1]))) values.push(value);
        });
      });
      if (!values.length) return [NaN, NaN];
      const sorted = Float64Array.from(values).sort(), last = sorted.length - 1;
      const [low, high] = [sorted[0], sorted[last]];
      if (!this.plots.cut) return [low, high];
      const [a, b] = [sorted[Math.floor(last * 0.05)], sorted[Math.ceil(last * 0.95)]], room = 4 * (b - a);
      return [a - low > room ? a - (b - a) * 0.5 : low, high - b > room ? b + (b - a) * 0.5 : high];
    }

    select(u) {
      if (u.select.width < 4) return;
      const [low, high] = [u.select.left, u.select.left + u.select.width].map((left) => u.posToVal(left, "x"));
      u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      this.plots.setZoom([low, high]);
    }

    point(event) {
      const left = event.clientX - this.u.over.getBoundingClientRect().left;
      player.seek(this.plots.nearest(this.u.posToVal(left, "x") / units.of(this.plots.abscissa.unit).factor));
    }

    // Events as dashed lines, intervals shaded; those of contacts, which may be many, as marks at the foot.
    events(u) {
      const { left, top, height, width } = u.bbox, pen = u.ctx;
      const colour = drawing.colour("warn");
      pen.save();
      pen.beginPath(); pen.rect(left, top, width, height); pen.clip();
      for (const event of this.plots.events) {
        const [from, to] = [event.from, event.to].map((value) => u.valToPos(value * units.of(this.plots.abscissa.unit).factor, "x", true));
        if (!Number.isFinite(from)) continue;
        pen.strokeStyle = pen.fillStyle = colour;
        pen.lineWidth = 1.2 * devicePixelRatio;
        if (event.low) {
          pen.globalAlpha = event.interval ? 0.5 : 1;
          pen.fillRect(Math.min(from, to), top + height - FOOT * devicePixelRatio, Math.max(Math.abs(to - from), devicePixelRatio), FOOT * devicePixelRatio);
          pen.globalAlpha = 1;
        } else if (event.interval) { pen.globalAlpha = 0.16; pen.fillRect(Math.min(from, to), top, Math.max(Math.abs(to - from), 2), height); pen.globalAlpha = 1; } else {
          pen.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
          pen.beginPath(); pen.moveTo(from, top); pen.lineTo(from, top + height); pen.stroke();
        }
      }
      pen.restore();
    }

    // Their words where they are few, in front of grid and curves.
    eventWords(u) {
      const { left, top, width } = u.bbox, pen = u.ctx, ratio = devicePixelRatio;
      if (this.plots.events.length > 4) return;
      pen.save();
      pen.beginPath(); pen.rect(left, top, width, u.bbox.height); pen.clip();
      pen.font = `${11 * ratio}px system-ui, sans-serif`;
      pen.textBaseline = "top"; pen.textAlign = "left";
      pen.lineWidth = 4 * ratio; pen.lineJoin = "round";
      pen.strokeStyle = drawing.colour("card"); pen.fillStyle = drawing.colour("warn");
      for (const [number, event] of this.plots.events.entries()) {
        const from = u.valToPos(event.from * units.of(this.plots.abscissa.unit).factor, "x", true);
        if (!Number.isFinite(from) || event.low) continue;
        const wide = pen.measureText(event.word).width, gap = 4 * ratio;
        const at = [from + gap + wide > left + width ? from - gap - wide : from + gap, top + (2 + 14 * number) * ratio];
        pen.strokeText(event.word, ...at); pen.fillText(event.word, ...at);
      }
      pen.restore();
    }

    // The instant that is shown.
    mark() {
      const row = player.row;
      this.values.forEach((node, k) => { node.textContent = units.quantity(this.columns[k].values[row], this.columns[k].unit); });
      if (!this.u) return;
      const across = units.of(this.plots.abscissa.unit).factor;
      const left = this.u.valToPos(this.plots.abscissa.values[row] * across, "x");
      const inside = Number.isFinite(left) && left >= -1 && left <= this.u.over.clientWidth + 1;
      this.line.hidden = !inside;
      if (inside) this.line.style.left = `${left}px`;
      this.columns.forEach((column, k) => {
        const top = this.u.valToPos(column.values[row] * units.of(column.unit).factor, column.unit);
        this.dots[k].hidden = !inside || !Number.isFinite(top) || top < -5 || top > this.u.over.clientHeight + 5;
        if (!this.dots[k].hidden) { this.dots[k].style.left = `${left}px`; this.dots[k].style.top = `${top}px`; }
      });
    }

    head() {
      const swatch = (k) => {
        const made = document.createElementNS("http://www.w3.org/2000/svg", "svg");
        const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
        for (const [key, value] of Object.entries({ width: 24, height: 10 })) made.setAttribute(key, value);
        for (const [key, value] of Object.entries({ x1: 0, x2: 24, y1: 5, y2: 5, "stroke-width": 2.4, stroke: stroke(k), "stroke-dasharray": DASHES[k % DASHES.length].join(" ") })) line.setAttribute(key, value);
        made.append(line);
        return made;
      };
      this.values = [];
      const chips = this.columns.map((column, k) => {
        const value = element("span", { className: "number" });
        this.values.push(value);
        const drop = () => { this.columns.splice(k, 1); if (this.columns.length) this.build(); else this.plots.remove(this); };
        return element("span", { className: "chip" }, swatch(k), element("span", { text: column.name, className: "text" }), value,
          element("button", { type: "button", text: "×", "aria-label": `Take ${linkdyn.plain(column.name)} off`, on: { click: drop } }));
      });
      const input = element("input", { type: "text", list: "names", placeholder: "+ column", "aria-label": "Add a column to this plot" });
      input.addEventListener("input", () => this.plots.suggest(input.value));
      input.addEventListener("focus", () => this.plots.suggest(input.value));
      input.addEventListener("change", () => { const found = this.plots.find(input.value); input.value = ""; if (found) this.plots.add(found, this); });
      const remove = element("button", { type: "button", className: "remove", text: "✕", title: "Remove this plot", "aria-label": "Remove this plot", on: { click: () => this.plots.remove(this) } });
      this.chips.replaceChildren(...chips, input, remove);
      this.mark();
    }
  }

  // A little more than what is there; something to see where all is one value.
  const padded = (low, high) => {
    if (!Number.isFinite(low) || !Number.isFinite(high)) return [-1, 1];
    const most = Math.max(Math.abs(low), Math.abs(high));
    const room = high - low > 1e-9 * most ? (high - low) * 0.07 : most > 0 ? most * 0.1 : 1;
    return [low - room, high + room];
  };

  linkdyn.Plot = Plot;
})();

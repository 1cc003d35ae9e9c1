"use strict";
// A canvas with scales: axes, clouds of points, boxes that are drawn with the pointer, and which point is near.
(() => {
  const { choice, units, colour, variants } = linkdyn;
  const { FONT } = linkdyn.axes, NEAR = 14, MOVED = 4;
  // Fewer points are discs, more are counted pixel by pixel.
  const DISCS = 2500, ON_PAPER = 300;

  const ticks = (from, to, most) => {
    const rough = (to - from) / Math.max(most, 1), power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((k) => k * power).find((step) => step >= rough * 0.999);
    const found = [];
    for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; k++) found.push(k * step);
    const digits = Math.min(12, Math.max(3, Math.ceil(Math.log10(Math.max(Math.abs(from), Math.abs(to)) / step)) + 1));
    return found.map((value) => [value, units.number(Math.abs(value) < 1e-9 * step ? 0 : value, digits)]);
  };
  // With room about, and of some width where all values are the same.
  const widened = ([from, to], room = 0.05) => {
    if (!(from <= to)) return [0, 1];
    const by = to > from ? room * (to - from) : Math.abs(from) * 0.01 || 1;
    return [from - by, to + by];
  };

  // Places of values in pixels, whatever lies between.
  const scales = ({ left, top, wide, tall }, [x0, x1], [y0, y1]) => ({
    box: { left, top, wide, tall },
    x: (value) => left + wide * (value - x0) / (x1 - x0), y: (value) => top + tall * (y1 - value) / (y1 - y0),
    valueX: (place) => x0 + (x1 - x0) * (place - left) / wide, valueY: (place) => y1 - (y1 - y0) * (place - top) / tall,
    holds: (x, y) => x >= left - 3 && x <= left + wide + 3 && y >= top - 3 && y <= top + tall + 3,
    rangeX: [x0, x1], rangeY: [y0, y1],
  });

  const rgb = (text) => text.match(/[\d.]+/g).slice(0, 3).map(Number);
  const scratch = document.createElement("canvas");
  // All variants as points, the selected ones on top.
  const cloud = (pen, at, xs, ys) => {
    const { box } = at, { mask } = choice, ratio = linkdyn.plotting.paper ? 3 : devicePixelRatio || 1;
    const [plain, strong] = [mask ? colour("muted") : colour("accent"), colour("accent")];
    pen.save();
    if (variants <= (linkdyn.plotting.paper ? ON_PAPER : DISCS)) {
      const radius = variants > 1000 ? 1.7 : variants > 300 ? 2.2 : 3;
      for (const pass of mask ? [0, 1] : [0]) {
        pen.fillStyle = pass ? strong : plain;
        pen.globalAlpha = pass ? 0.9 : mask ? 0.25 : 0.6;
        for (let k = 0; k < variants; k++) {
          if (mask && mask[k] !== pass) continue;
          const [x, y] = [at.x(xs[k]), at.y(ys[k])];
          if (Number.isFinite(x + y)) { pen.beginPath(); pen.arc(x, y, radius, 0, 7); pen.fill(); }
        }
      }
      pen.restore();
      return;
    }
    const wide = Math.max(1, Math.round(box.wide * ratio)), tall = Math.max(1, Math.round(box.tall * ratio));
    const dot = Math.max(2, Math.round(1.3 * ratio)), counts = [new Uint16Array(wide * tall), new Uint16Array(wide * tall)];
    for (let k = 0; k < variants; k++) {
      const i = Math.floor((at.x(xs[k]) - box.left) * ratio), j = Math.floor((at.y(ys[k]) - box.top) * ratio);
      if (!(i >= 0 && i < wide && j >= 0 && j < tall)) continue;
      const layer = counts[mask ? mask[k] : 1];
      for (let b = j; b < Math.min(j + dot, tall); b++) for (let a = i; a < Math.min(i + dot, wide); a++) layer[b * wide + a]++;
    }
    // Where most of them are it is full, and a single one can still be seen.
    const most = Math.sqrt(counts[1].reduce((a, b) => Math.max(a, b), 1)), image = new ImageData(wide, tall), pale = rgb(colour("muted")), full = rgb(strong);
    for (let k = 0; k < wide * tall; k++) {
      const number = counts[1][k], isFull = number > 0;
      if (!isFull && !counts[0][k]) continue;
      const [r, g, b] = isFull ? full : pale;
      image.data.set([r, g, b, isFull ? 255 * (0.3 + 0.7 * Math.sqrt(number) / most) : 90], 4 * k);
    }
    [scratch.width, scratch.height] = [wide, tall];
    scratch.getContext("2d").putImageData(image, 0, 0);
    pen.drawImage(scratch, box.left, box.top, box.wide, box.tall);
    pen.restore();
  };

  const line = (pen, ...points) => { pen.beginPath(); points.forEach(([x, y], k) => k ? pen.lineTo(x, y) : pen.moveTo(x, y)); pen.stroke(); };
  const axes = (pen, at, { x, y, xTicks, yTicks }) => {
    const { left, top, wide, tall } = at.box;
    pen.font = FONT; pen.lineWidth = 1; pen.fillStyle = colour("muted"); pen.strokeStyle = colour("grid");
    pen.textAlign = "center"; pen.textBaseline = "top";
    for (const [value, text] of xTicks || ticks(...at.rangeX, wide / 75)) { line(pen, [at.x(value), top], [at.x(value), top + tall + 4]); pen.fillText(text, at.x(value), top + tall + 6); }
    pen.textAlign = "right"; pen.textBaseline = "middle";
    for (const [value, text] of yTicks || ticks(...at.rangeY, tall / 38)) { line(pen, [left - 4, at.y(value)], [left + wide, at.y(value)]); pen.fillText(text, left - 7, at.y(value)); }
    pen.strokeStyle = colour("line"); pen.strokeRect(left, top, wide, tall);
    pen.fillStyle = colour("ink");
    if (x) { pen.textAlign = "center"; pen.textBaseline = "alphabetic"; pen.fillText(x, left + wide / 2, top + tall + 34, wide); }
    if (y) { pen.textAlign = "left"; pen.textBaseline = "alphabetic"; pen.fillText(y, Math.max(left - 50, 2), top - 12, wide + 40); }
  };
  // Lines that go on from one area to the next.
  const hatch = (pen, x, y, wide, tall) => {
    pen.save();
    pen.beginPath(); pen.rect(x, y, wide, tall); pen.clip();
    pen.strokeStyle = colour("muted"); pen.lineWidth = 1;
    for (let sum = Math.ceil((x + y) / 7) * 7; sum < x + y + wide + tall; sum += 7) line(pen, [sum - y - tall, y + tall], [sum - y, y]);
    pen.restore();
  };
  // A limit: a line, and its word.
  const limits = (pen, at, own, isUpright) => own.limits?.forEach((limit, side) => {
    const { left, top, wide, tall } = at.box, place = limit === null ? NaN : isUpright ? at.x(limit) : at.y(limit);
    if (!(isUpright ? place >= left - 1 && place <= left + wide + 1 : place >= top - 1 && place <= top + tall + 1)) return;
    pen.strokeStyle = pen.fillStyle = colour("bad"); pen.lineWidth = 1.5; pen.font = FONT;
    if (isUpright) line(pen, [place, top], [place, top + tall]); else line(pen, [left, place], [left + wide, place]);
    // Below the lower limit and above the upper one, where there is room for a word.
    const isLeft = isUpright && (side ? place > left + wide - 74 : place > left + 74), isAbove = side ? place > top + 18 : place > top + tall - 18;
    pen.textAlign = isUpright && !isLeft ? "left" : "right"; pen.textBaseline = !isUpright && isAbove ? "bottom" : "top";
    pen.fillText(side ? "upper limit" : "lower limit", isUpright ? place + (isLeft ? -4 : 4) : left + wide - 4, isUpright ? top + 4 + 14 * side : place + (isAbove ? -2 : 3));
  });
  const ring = (pen, x, y, tone = "force") => {
    if (!Number.isFinite(x + y)) return;
    pen.lineWidth = 4; pen.strokeStyle = colour("card"); pen.beginPath(); pen.arc(x, y, 6, 0, 7); pen.stroke();
    pen.lineWidth = 2.2; pen.strokeStyle = colour(tone); pen.stroke();
  };
  // Ranges that are chosen of both variables, or of one.
  const box = (pen, at, own, other) => {
    const [a, b] = [choice.ranges.get(own), other && choice.ranges.get(other)];
    if (!a && !b) return;
    const { left, top, wide, tall } = at.box, inside = (value, from, to) => Math.min(Math.max(value, from), to);
    const [x0, x1] = a ? a.map((value) => inside(at.x(value), left, left + wide)) : [left, left + wide];
    const [y0, y1] = b ? b.map((value) => inside(at.y(value), top, top + tall)) : [top + tall, top];
    pen.save();
    pen.fillStyle = pen.strokeStyle = colour("accent"); pen.lineWidth = 1;
    pen.globalAlpha = 0.1; pen.fillRect(x0, y1, x1 - x0, y0 - y1);
    pen.globalAlpha = 0.8; pen.strokeRect(x0, y1, x1 - x0, y0 - y1);
    pen.restore();
  };

  const frames = [];
  // A canvas: `draw(pen, width, height)` draws it and returns its plots, { at, x, y }: variables whose values are across and up.
  class Frame {
    constructor(canvas, draw) {
      Object.assign(this, { canvas, draw, plots: [] });
      frames.push(this);
      choice.onPaint(() => this.paint());
      new ResizeObserver(() => choice.repaint()).observe(canvas);
      this.listen();
    }
    paint() {
      const { canvas } = this, width = canvas.clientWidth, height = canvas.clientHeight, ratio = devicePixelRatio || 1;
      if (!width || !height) return;
      if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) { canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio); }
      const pen = canvas.getContext("2d");
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.clearRect(0, 0, width, height);
      this.plots = this.draw(pen, width, height) || [];
    }
    // The variant nearest to a place of a plot.
    nearest({ at, x, y }, px, py) {
      let best = -1, least = NEAR ** 2;
      for (let k = 0; k < variants; k++) {
        const far = (at.x(x.values[k]) - px) ** 2 + (at.y(y.values[k]) - py) ** 2;
        if (far < least) [best, least] = [k, far];
      }
      return best;
    }
    listen() {
      const { canvas } = this;
      let from = null, plot = null, moved = false;
      const place = (event) => { const { left, top } = canvas.getBoundingClientRect(); return [event.clientX - left, event.clientY - top]; };
      canvas.addEventListener("pointerdown", (event) => {
        if (event.button) return;
        from = place(event); moved = false;
        plot = this.plots.find(({ at }) => at.holds(...from)) || null;
        if (plot && event.isTrusted) canvas.setPointerCapture(event.pointerId);
      });
      canvas.addEventListener("pointermove", (event) => {
        if (!from || !plot) return;
        const to = place(event);
        moved ||= Math.hypot(to[0] - from[0], to[1] - from[1]) > MOVED;
        if (!moved) return;
        const sorted = (a, b) => a < b ? [a, b] : [b, a], { at } = plot;
        if (plot.brush) plot.brush(from, to);
        else choice.select([...(plot.x ? [[plot.x, sorted(at.valueX(from[0]), at.valueX(to[0]))]] : []), ...(plot.y ? [[plot.y, sorted(at.valueY(from[1]), at.valueY(to[1]))]] : [])]);
      });
      canvas.addEventListener("pointerup", (event) => {
        if (from && plot && !moved) {
          const [px, py] = place(event);
          const row = plot.pick ? plot.pick(px, py) : plot.x && plot.y ? this.nearest(plot, px, py) : -1;
          if (row >= 0) choice.choose(row); else if (row !== null) choice.clear();
        }
        from = plot = null;
      });
      canvas.addEventListener("pointercancel", () => { from = plot = null; });
    }
  }

  Object.assign(linkdyn, { Frame, frames, plotting: { FONT, ticks, widened, scales, cloud, line, axes, hatch, limits, ring, box, paper: false } });
})();

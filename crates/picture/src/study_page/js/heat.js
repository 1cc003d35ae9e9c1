"use strict";
// A response over two parameters: cells of a grid, a scale of colours, contours, and limits; where it is least and greatest.
(() => {
  const { inputs, numbers, variants, given, choice, colour, plotting, units } = linkdyn;
  // Dark to bright: clear with all kinds of colour vision, and in grey print.
  const STOPS = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  const tone = (part) => {
    const at = Math.min(Math.max(part, 0), 1) * (STOPS.length - 1), k = Math.min(Math.floor(at), STOPS.length - 2);
    return `rgb(${STOPS[k].map((channel, c) => Math.round(channel + (at - k) * (STOPS[k + 1][c] - channel))).join(" ")})`;
  };

  // An axis of a grid: values along it are evenly apart, or stand one by one.
  const axis = (own) => {
    const { linear, listed } = own.facts;
    const count = linear ? linear.count : listed.length, [from, to] = linear ? [linear.from / own.size, linear.to / own.size] : [0, count - 1];
    const step = count > 1 ? (to - from) / (count - 1) : 1;
    const [low, high] = [from - step / 2, to + step / 2].sort((a, b) => a - b), every = listed && Math.ceil(count / 8);
    const named = listed && listed.map((value, k) => [k, units.number(value / own.size, 4)]).filter((_, k) => k % every === 0);
    return { own, count, from, step, range: [low, high], ticks: named };
  };

  // Cells with the mean of the variants that are drawn; of fewer variants than points of the grid, larger cells.
  const cells = (axes, own) => {
    const most = Math.max(4, given.variants > variants ? variants / 4 : Infinity), all = axes[0].count * axes[1].count;
    const part = Math.min(1, Math.sqrt(most / all)), [wide, tall] = axes.map(({ count }) => Math.max(1, Math.floor(count * part)));
    const sums = new Float64Array(wide * tall), counts = new Uint32Array(wide * tall), failed = new Uint32Array(wide * tall);
    const place = new Uint32Array(variants);
    for (let row = 0; row < variants; row++) {
      const [i, j] = [Math.floor(numbers[row] / axes[1].count), numbers[row] % axes[1].count];
      const cell = Math.floor(i * wide / axes[0].count) + wide * Math.floor(j * tall / axes[1].count), value = own.values[row];
      place[row] = cell;
      if (Number.isFinite(value)) { sums[cell] += value; counts[cell]++; } else failed[cell]++;
    }
    const means = sums.map((sum, k) => counts[k] ? sum / counts[k] : NaN);
    // A cell in which no variant is drawn has the value of a neighbour.
    for (let k = 0; k < wide * tall; k++) {
      const other = [k - wide, k + wide, k - 1, k + 1].find((own) => counts[own] || failed[own]);
      if (!counts[k] && !failed[k] && other !== undefined) [means[k], failed[k]] = [means[other], failed[other]];
    }
    return { wide, tall, means, failed, place };
  };

  // Where the means cross a level: pieces of line between the middles of cells.
  const contour = ({ wide, tall, means }, level) => {
    const pieces = [];
    for (let j = 0; j + 1 < tall; j++) for (let i = 0; i + 1 < wide; i++) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]], values = corners.map(([a, b]) => means[a + wide * b] - level);
      if (!values.every(Number.isFinite)) continue;
      const found = [];
      for (let k = 0; k < 4; k++) {
        const [a, b] = [values[k], values[(k + 1) % 4]];
        if (a < 0 === b < 0) continue;
        const part = a / (a - b), [p, q] = [corners[k], corners[(k + 1) % 4]];
        found.push([p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1])]);
      }
      for (let k = 0; k + 1 < found.length; k += 2) pieces.push([found[k], found[k + 1]]);
    }
    return pieces;
  };

  linkdyn.heat = (own) => {
    const axes = inputs.map(axis), grid = cells(axes, own), { wide, tall, means } = grid;
    const pieces = own.limits.map((limit) => limit === null ? [] : contour(grid, limit));
    const levels = own.to > own.from ? plotting.ticks(own.from, own.to, 9).map(([value, text]) => [text, contour(grid, value)]) : [];
    const ends = own.to > own.from ? [["min", Math.min], ["max", Math.max]].map(([word, end]) => [word, own.values.indexOf(own.values.reduce((a, b) => Number.isFinite(b) ? end(a, b) : a, word === "min" ? Infinity : -Infinity))]) : [];
    return (pen, width, height) => {
      const { scales, FONT } = plotting, box = { left: 64, top: 28, wide: width - 64 - 92, tall: height - 28 - 42 };
      const at = scales(box, axes[0].range, axes[1].range), { from, to } = own, span = to - from || 1;
      const [dx, dy] = [box.wide / wide, box.tall / tall];
      const [flipX, flipY] = axes.map(({ step }) => step < 0);
      const corner = (i, j) => [box.left + dx * (flipX ? wide - 1 - i : i), box.top + box.tall - dy * ((flipY ? tall - 1 - j : j) + 1)];
      const chosen = new Uint8Array(wide * tall);
      if (choice.mask) for (let row = 0; row < variants; row++) if (choice.mask[row]) chosen[grid.place[row]] = 1;
      plotting.axes(pen, at, { x: axes[0].own.label, y: axes[1].own.label, xTicks: axes[0].ticks, yTicks: axes[1].ticks });
      pen.fillStyle = colour("card"); pen.fillRect(box.left, box.top, box.wide, box.tall);
      for (let j = 0; j < tall; j++) for (let i = 0; i < wide; i++) {
        const k = i + wide * j, [left, top] = corner(i, j), [x, y] = [Math.round(left), Math.round(top)], [w, h] = [Math.round(left + dx) - x, Math.round(top + dy) - y], known = Number.isFinite(means[k]);
        if (known) { pen.globalAlpha = choice.mask && !chosen[k] ? 0.25 : 1; pen.fillStyle = tone((means[k] - from) / span); pen.fillRect(x, y, w, h); }
        else if (grid.failed[k]) { pen.globalAlpha = choice.mask && !chosen[k] ? 0.25 : 1; plotting.hatch(pen, x, y, w, h); }
      }
      pen.globalAlpha = 1;
      const middle = ([i, j]) => { const [x, y] = corner(0, 0); return [x + dx * (0.5 + (flipX ? -i : i)), y + dy * (0.5 - (flipY ? -j : j))]; };
      pen.lineCap = "butt"; pen.lineWidth = 1; pen.strokeStyle = "#ffffff";
      for (const [, found] of levels) found.forEach((piece) => plotting.line(pen, ...piece.map(middle)));
      const written = [];
      const write = (text, x, y) => {
        const wide = pen.measureText(text).width / 2 + 2, tall = 8;
        if (x - wide < box.left || x + wide > box.left + box.wide || y - tall < box.top || y + tall > box.top + box.tall || written.some(([a, b, w]) => Math.abs(a - x) < wide + w && Math.abs(b - y) < 2 * tall)) return false;
        written.push([x, y, wide]);
        pen.lineWidth = 3; pen.lineJoin = "round"; pen.strokeStyle = colour("card"); pen.strokeText(text, x, y); pen.fillStyle = colour("ink"); pen.fillText(text, x, y);
        return true;
      };
      pen.font = FONT; pen.textAlign = "center"; pen.textBaseline = "middle";
      // The ends first, each with a ring at its cell and its value beside it.
      for (const [word, row] of ends) {
        const [x, y] = middle([grid.place[row] % wide, Math.floor(grid.place[row] / wide)]), text = `${word} ${own.text(own.values[row], 4)}`, half = pen.measureText(text).width / 2 + 10;
        plotting.ring(pen, x, y, "ink");
        for (const [dx, dy] of [[half, 0], [-half, 0], [0, -16], [0, 16], [half, 16], [half, -16], [-half, 16], [-half, -16]]) if (write(text, x + dx, y + dy)) break;
      }
      for (const [text, found] of levels) for (const k of [0.5, 0.3, 0.7, 0.15, 0.85]) {
        const piece = found[Math.floor(k * found.length)];
        if (piece && write(text, ...middle(piece[0]))) break;
      }
      for (const [colourOf, thick] of [["card", 4.5], ["bad", 2]]) { pen.strokeStyle = colour(colourOf); pen.lineWidth = thick; pen.lineCap = "round"; pieces.flat().forEach((piece) => plotting.line(pen, ...piece.map(middle))); }
      if (choice.row >= 0) {
        const k = grid.place[choice.row], [x, y] = corner(k % wide, Math.floor(k / wide));
        pen.lineWidth = 4; pen.strokeStyle = colour("card"); pen.strokeRect(x, y, dx, dy);
        pen.lineWidth = 2; pen.strokeStyle = colour("force"); pen.strokeRect(x, y, dx, dy);
      }
      // The scale.
      const left = width - 78, steps = 60;
      for (let k = 0; k < steps; k++) { pen.fillStyle = tone((k + 0.5) / steps); pen.fillRect(left, box.top + box.tall * (1 - (k + 1) / steps), 14, box.tall / steps + 0.6); }
      pen.font = FONT; pen.fillStyle = colour("muted"); pen.textAlign = "left"; pen.textBaseline = "middle";
      const y = (value) => box.top + box.tall * (1 - (value - from) / span);
      (to > from ? plotting.ticks(from, to, box.tall / 38) : [[from, own.text(from)]]).forEach(([value, text]) => pen.fillText(text, left + 19, y(value), 58));
      pen.strokeStyle = colour("bad"); pen.lineWidth = 2;
      own.limits.forEach((limit) => { if (limit !== null && limit >= from && limit <= to) plotting.line(pen, [left - 3, y(limit)], [left + 17, y(limit)]); });
      pen.fillStyle = colour("ink"); pen.textAlign = "right"; pen.textBaseline = "alphabetic";
      pen.fillText(own.symbol ? `[${own.symbol}]` : "", width - 4, box.top - 12);
      const pick = (px, py) => grid.place.indexOf(cellAt(px, py));
      const cellAt = (px, py) => {
        const [i, j] = [Math.floor((px - box.left) / dx), Math.floor((box.top + box.tall - py) / dy)];
        return (flipX ? wide - 1 - i : i) + wide * (flipY ? tall - 1 - j : j);
      };
      // A listed value stands at its number.
      const brush = (from, to) => choice.select(axes.map((axis, k) => {
        const ends = [from, to].map((place) => k ? at.valueY(place[1]) : at.valueX(place[0])).sort((a, b) => a - b);
        if (!axis.ticks) return [axis.own, ends];
        const inside = axis.own.facts.listed.filter((_, number) => number >= ends[0] && number <= ends[1]).map((value) => value / axis.own.size);
        const slack = 1e-6 * (axis.own.to - axis.own.from);
        return [axis.own, [Math.min(...inside) - slack, Math.max(...inside) + slack]];
      }));
      return [{ at, x: axes[0].own, y: axes[1].own, pick, brush }];
    };
  };
})();

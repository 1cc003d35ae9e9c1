"use strict";
// A card for each response: over one parameter a curve, over two a heat map, of samples a histogram and a cloud over an input.
(() => {
  const { inputs, responses, given, variants, choice, element, colour, plotting, Frame, id } = linkdyn;
  // More cards can't be looked at.
  const MOST = 12;
  const { widened, scales, cloud, axes, limits, ring, box, line } = plotting;
  const isGrid = inputs.every(({ facts }) => !facts.scattered), isCurve = isGrid && inputs.length === 1, isHeat = isGrid && inputs.length === 2;
  let over = inputs[0];

  // Room for the labels of both axes.
  const frameOf = (width, height) => ({ left: 64, top: 28, wide: width - 64 - 14, tall: height - 28 - 42 });
  // The range of a response, with limits that are near.
  const rangeOf = (own) => {
    let [from, to] = [own.from, own.to];
    const span = to - from || Math.abs(from) || 1;
    for (const limit of own.limits) if (limit !== null && limit > from - span && limit < to + span) [from, to] = [Math.min(from, limit), Math.max(to, limit)];
    return widened([from, to], 0.06);
  };

  const curve = (own) => {
    const [x] = inputs, order = Array.from(x.values, (_, row) => row).sort((a, b) => x.values[a] - x.values[b]);
    return (pen, width, height) => {
      const at = scales(frameOf(width, height), widened([x.from, x.to], 0.03), rangeOf(own)), { top, tall } = at.box;
      axes(pen, at, { x: x.label, y: own.symbol ? `[${own.symbol}]` : "" });
      // Where there is no value, hatched as wide as a step.
      pen.save();
      pen.globalAlpha = 0.55;
      order.forEach((row, k) => {
        if (Number.isFinite(own.values[row])) return;
        const [a, b] = [order[k - 1] ?? row, order[k + 1] ?? row].map((other) => (at.x(x.values[row]) + at.x(x.values[other])) / 2);
        plotting.hatch(pen, a, top, Math.max(b - a, 1), tall);
      });
      pen.restore();
      limits(pen, at, own, false);
      pen.strokeStyle = colour("accent"); pen.lineWidth = 2; pen.lineJoin = "round"; pen.globalAlpha = choice.mask ? 0.35 : 1;
      let down = false;
      pen.beginPath();
      for (const row of order) {
        const y = own.values[row];
        if (!Number.isFinite(y)) { down = false; continue; }
        if (down) pen.lineTo(at.x(x.values[row]), at.y(y)); else pen.moveTo(at.x(x.values[row]), at.y(y));
        down = true;
      }
      pen.stroke();
      pen.globalAlpha = 1;
      if (variants <= 200 || choice.mask) cloud(pen, at, x.values, own.values);
      box(pen, at, x, own);
      if (choice.row >= 0) {
        const px = at.x(x.values[choice.row]);
        pen.strokeStyle = colour("force"); pen.lineWidth = 1; pen.setLineDash([4, 3]); line(pen, [px, top], [px, top + tall]); pen.setLineDash([]);
        ring(pen, px, at.y(own.values[choice.row]));
      }
      // A click finds the parameter, whether there is a value or not.
      const pick = (px) => order.reduce((best, row) => Math.abs(at.x(x.values[row]) - px) < Math.abs(at.x(x.values[best]) - px) ? row : best, order[0]);
      return [{ at, x, pick, y: null }];
    };
  };

  // All variants are counted, the selected ones as far as they are drawn.
  const histogram = (own) => (pen, width, height) => {
    const { histogram: bins, quantiles } = own.summary;
    if (!bins) return [];
    const [from, to] = [bins.from / own.size, bins.to / own.size], most = Math.max(...bins.counts), step = (to - from) / bins.counts.length;
    const at = scales(frameOf(width, height), rangeOf(own), [0, most * 1.08]), { left, top, wide, tall } = at.box;
    axes(pen, at, { x: own.label, y: "variants" });
    const bar = (k, count, tone) => { pen.fillStyle = tone; const x = at.x(from + k * step); pen.fillRect(x, at.y(count), Math.max(at.x(from + (k + 1) * step) - x - (step ? 0.6 : 0), 2), top + tall - at.y(count)); };
    pen.globalAlpha = choice.mask ? 0.3 : 0.75;
    bins.counts.forEach((count, k) => bar(k, count, colour(choice.mask ? "muted" : "accent")));
    pen.globalAlpha = 0.9;
    if (choice.mask) {
      const found = new Float64Array(bins.counts.length), each = given.variants / variants;
      for (let row = 0; row < variants; row++) if (choice.mask[row] && Number.isFinite(own.values[row])) found[Math.min(found.length - 1, Math.max(0, Math.floor((own.values[row] - from) / (step || 1))))] += each;
      found.forEach((count, k) => { if (count) bar(k, Math.min(count, most * 1.08), colour("accent")); });
    }
    pen.globalAlpha = 1;
    pen.strokeStyle = pen.fillStyle = colour("muted"); pen.lineWidth = 1.2; pen.font = "11px system-ui, sans-serif"; pen.textBaseline = "bottom"; pen.textAlign = "center";
    let taken = -Infinity;
    (isGrid ? [] : quantiles || []).forEach((value, k) => {
      const x = at.x(value / own.size);
      pen.setLineDash([4, 3]); line(pen, [x, top], [x, top + tall]); pen.setLineDash([]);
      const middle = Math.min(Math.max(x, left + 64), left + wide - 22);
      if (middle - taken < 50) return;
      taken = middle;
      pen.fillText(["0.135 %", "median", "99.865 %"][k], middle, top - 3);
    });
    limits(pen, at, own, true);
    if (choice.row >= 0 && Number.isFinite(own.values[choice.row])) { const x = at.x(own.values[choice.row]); pen.strokeStyle = colour("force"); pen.lineWidth = 2; line(pen, [x, top + tall * 0.6], [x, top + tall]); }
    box(pen, at, own, null);
    return [{ at, x: own, y: null }];
  };

  const scatter = (own) => (pen, width, height) => {
    const at = scales(frameOf(width, height), widened([over.from, over.to]), rangeOf(own));
    axes(pen, at, { x: over.label, y: own.symbol ? `[${own.symbol}]` : "" });
    cloud(pen, at, over.values, own.values);
    limits(pen, at, own, false);
    box(pen, at, over, own);
    if (choice.row >= 0) ring(pen, at.x(over.values[choice.row]), at.y(own.values[choice.row]));
    return [{ at, x: over, y: own }];
  };

  const canvas = (what, own) => element("canvas", { className: "plot", role: "img", "aria-label": `${what} of ${own.name}` });
  responses.slice(0, MOST).forEach((own) => {
    const { summary } = own, card = element("section", { className: "card" });
    const place = (row) => inputs.map((input) => `${input.name} ${input.text(input.values[row], 4)}`).join(", ");
    const end = (word, pick) => { const best = own.values.reduce((found, value, row) => Number.isFinite(value) && (found < 0 || pick(value, own.values[found])) ? row : found, -1); return best < 0 ? [] : [`${word} ${own.text(own.values[best], 4)} at ${place(best)}`]; };
    const ends = isHeat ? [...end("least", (a, b) => a < b), ...end("greatest", (a, b) => a > b)].join("; ") : "";
    const side = summary.below + summary.above ? `${linkdyn.count(summary.below + summary.above)} outside the limits` : "";
    const select = !isCurve && !isHeat && inputs.length > 1 && element("select", { "aria-label": "Input", className: "over", on: { change: (event) => { over = inputs[event.target.value]; document.querySelectorAll(".over").forEach((other) => { other.value = event.target.value; }); choice.repaint(); } } }, ...inputs.map(({ name }, k) => element("option", { value: k, text: `over ${name}` })));
    card.append(element("h2", {}, element("span", { className: "text", text: own.name }), element("span", { className: "muted text", text: ends }), element("span", { className: "side muted", text: side }), ...(select ? [select] : [])));
    const plots = isCurve ? [["Curve", curve]] : isHeat ? [["Heat map", linkdyn.heat]] : [["Histogram", histogram], ["Cloud", scatter]];
    const both = card.appendChild(element("div", { className: "plots" }));
    for (const [what, make] of plots) { const own_canvas = both.appendChild(canvas(what, own)); new Frame(own_canvas, make(own)); }
    id("cards").append(card);
  });
  if (responses.length > MOST) id("cards").append(element("p", { className: "caption", text: `The first ${MOST} of ${responses.length} responses are shown here.` }));
  Object.assign(linkdyn, { isGrid, isHeat, isCurve });
})();

"use strict";
// Variables against each other: clouds below, how they go together above, and which variables these are.
(() => {
  const { variables, inputs, responses, variants, choice, element, colour, plotting, units, Frame, id } = linkdyn;
  const MOST = 6, GAP = 6, LEFT = 8, FOOT = 8;
  const { scales, widened, cloud, ring, box } = plotting;
  // At first as many of both as there is room for.
  const kept = Math.max(MOST - Math.min(inputs.length, 3), MOST - inputs.length);
  const first = new Set([...inputs.slice(0, MOST - Math.min(responses.length, kept)), ...responses.slice(0, kept)]);
  const shown = () => variables.filter((own) => first.has(own));

  // Correlation of the variants that are drawn and selected.
  const together = ({ values: x }, { values: y }) => {
    let [n, sx, sy, xx, yy, xy] = [0, 0, 0, 0, 0, 0];
    const [x0, y0] = [x.find(Number.isFinite) ?? 0, y.find(Number.isFinite) ?? 0];
    for (let k = 0; k < variants; k++) {
      const [a, b] = [x[k] - x0, y[k] - y0];
      if (!Number.isFinite(a + b) || choice.mask && !choice.mask[k]) continue;
      n++; sx += a; sy += b; xx += a * a; yy += b * b; xy += a * b;
    }
    const [u, v] = [n * xx - sx * sx, n * yy - sy * sy];
    return n > 2 && u > 0 && v > 0 ? (n * xy - sx * sy) / Math.sqrt(u * v) : NaN;
  };

  const draw = (pen, width, height) => {
    const list = shown(), n = list.length, plots = [];
    const [wide, tall] = [(width - LEFT - GAP * (n - 1)) / n, (height - FOOT - GAP * (n - 1)) / n];
    const ranges = list.map((own) => widened([own.from, own.to]));
    list.forEach((y, j) => list.forEach((x, i) => {
      const cell = { left: LEFT / 2 + i * (wide + GAP), top: FOOT / 2 + j * (tall + GAP), wide, tall };
      const { left, top } = cell, middle = [left + wide / 2, top + tall / 2];
      pen.strokeStyle = colour(i === j ? "line" : "grid"); pen.lineWidth = 1;
      if (i <= j) pen.strokeRect(left, top, wide, tall);
      pen.textAlign = "center"; pen.textBaseline = "middle";
      if (i === j) {
        pen.fillStyle = colour("ink"); pen.font = "600 12.5px system-ui, sans-serif"; pen.fillText(x.name, middle[0], middle[1] - 9, wide - 6);
        pen.fillStyle = colour("muted"); pen.font = "11.5px system-ui, sans-serif"; pen.fillText(x.symbol ? `[${x.symbol}]` : "", middle[0], middle[1] + 8, wide - 6);
        if (wide < 80) return;
        pen.textAlign = "left"; pen.textBaseline = "bottom"; pen.fillText(units.number(x.from, 4), left + 4, top + tall - 3, wide / 2 - 4);
        pen.textAlign = "right"; pen.fillText(units.number(x.to, 4), left + wide - 4, top + tall - 3, wide / 2 - 4);
        return;
      }
      if (i > j) {
        const r = together(x, y);
        pen.fillStyle = colour(Math.abs(r) > 0.5 ? "ink" : "muted"); pen.font = `${11 + 5 * Math.abs(r || 0)}px system-ui, sans-serif`;
        pen.fillText(Number.isFinite(r) ? r.toFixed(2).replace("-", "−") : "–", ...middle);
        return;
      }
      const at = scales(cell, ranges[i], ranges[j]);
      cloud(pen, at, x.values, y.values);
      box(pen, at, choice.ranges.has(y) ? x : null, choice.ranges.has(x) ? y : null);
      if (choice.row >= 0) ring(pen, at.x(x.values[choice.row]), at.y(y.values[choice.row]));
      plots.push({ at, x, y });
    }));
    return plots;
  };

  const canvas = id("matrix_plot");
  const settle = () => { canvas.style.height = `${Math.min(Math.max(shown().length * 92, 180), 560)}px`; choice.repaint(); };
  variables.forEach((own) => {
    const mark = element("input", { type: "checkbox", on: { change: (event) => { if (event.target.checked) first.add(own); else first.delete(own); settle(); } } });
    mark.checked = first.has(own);
    id("shown").append(element("label", {}, mark, element("span", { className: "text", text: own.name })));
  });
  id("shown").hidden = variables.length < 3;
  settle();
  new Frame(canvas, draw);
  linkdyn.shown = shown;
})();

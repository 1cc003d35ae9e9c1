"use strict";
// The configuration with the largest deviation of the output, its displacements enlarged, over the nominal one in grey.
(() => {
  if (!linkdyn.outputs.length) return;
  const { given, choice, element, file, drawing, shapes, mechanism, theme, id } = linkdyn;
  const canvas = id("canvas"), stage = id("stage");
  // The largest displacement as a part of the mechanism's size, and the largest turn, where the factor is not chosen.
  const FAR = 0.06, TURN = 0.25, GHOST = -1;
  // Displacements below this part of the size, and turns, are round-off.
  const ROUND_OFF = 1e-11;
  let chosen = null, factor = 1, width = 0, height = 0;

  // Points of the enlarged configuration go straight, so that gaps at pins are enlarged as all else.
  const { place, pose } = shapes;
  const frame = (values, body) => [values[3 * body - 3], values[3 * body - 2], values[3 * body - 1]];
  const pair = (body) => [frame(choice.detail.position, body), frame(choice.detail.displaced[choice.side], body)];
  shapes.pose = (body, row) => {
    if (row !== GHOST || body === 0) return pose(body, row);
    const [from, to] = pair(body);
    return from.map((value, k) => value + factor * (to[k] - value));
  };
  shapes.place = ([body, point], row) => {
    if (row !== GHOST || body === 0) return place([body, point], Math.max(row, 0));
    const [, x, y] = mechanism.bodies[body].points[point];
    const [a, b] = pair(body).map((found) => shapes.carry(found, x, y));
    return a.map((value, k) => value + factor * (b[k] - value));
  };

  const { box: all } = given.drawing, size = Math.hypot(all[1] - all[0], all[3] - all[2]);
  // A round factor that shows the displacements.
  const fitting = () => {
    if (!choice.detail.displaced[choice.side]) return 1;
    let [far, turn] = [0, 0];
    mechanism.bodies.forEach(({ points }, body) => {
      if (body === 0) return;
      const [from, to] = pair(body);
      turn = Math.max(turn, Math.abs(to[2] - from[2]));
      points.forEach(([, x, y]) => { const [a, b] = [from, to].map((found) => shapes.carry(found, x, y)); far = Math.max(far, Math.hypot(b[0] - a[0], b[1] - a[1])); });
    });
    if (far < ROUND_OFF * size && turn < ROUND_OFF) return 1;
    const most = Math.min(far > 0 ? FAR * size / far : Infinity, turn > 0 ? TURN / turn : Infinity);
    const power = 10 ** Math.floor(Math.log10(Math.max(most, 1)));
    return Math.max(1, [5, 2, 1].map((k) => k * power).find((round) => round <= most * 1.001) || 1);
  };

  // What is drawn, nominal and enlarged; pins of the ground included.
  const box = () => {
    const { detail } = choice, rows = detail.displaced[choice.side] ? [detail.frame, GHOST] : [detail.frame];
    let found = null;
    const add = (point, margin = 0) => {
      if (!point) return;
      found ??= [point[0], point[0], point[1], point[1]];
      found = [Math.min(found[0], point[0] - margin), Math.max(found[1], point[0] + margin), Math.min(found[2], point[1] - margin), Math.max(found[3], point[1] + margin)];
    };
    for (const row of rows) {
      mechanism.bodies.forEach(({ points }, body) => { if (body > 0) points.forEach((_, k) => add(shapes.place([body, k], row))); });
      for (const { between, gear } of mechanism.joints) between.forEach((end, k) => add(shapes.place(end, row), gear ? Math.min(gear.radii[k], 1e6) : 0));
    }
    if (!found) return all;
    const least = 1e-6 + 0.15 * Math.max(found[1] - found[0], found[3] - found[2]);
    const widen = (low, high) => high - low < least ? [(low + high - least) / 2, (low + high + least) / 2] : [low, high];
    return [...widen(found[0], found[1]), ...widen(found[2], found[3])];
  };

  const draw = () => {
    const pen = drawing.prepare(canvas, width, height), bar = drawing.barOf(width, height), { detail } = choice, colours = drawing.palette();
    const grey = { ...colours, steel: colours.muted, force: colours.muted, ink: colours.muted, body: () => ({ fill: colours.line, line: colours.muted }) };
    const view = { ...drawing.fitted(box(), width, height, 4.7 * bar), bar, show: {} };
    pen.globalAlpha = 0.7;
    // Bearings belong to the enlarged configuration.
    drawing.draw(pen, { ...view, row: detail.frame, colours: grey, gaps: 0 });
    if (detail.displaced[choice.side]) {
      pen.globalAlpha = 0.85;
      drawing.draw(pen, { ...view, row: GHOST, colours, gaps: factor });
    }
  };

  id("worst").hidden = !linkdyn.level;
  const fill = () => {
    if (!linkdyn.level) return;
    const { output, detail } = choice, names = ["found_low", "found_high"];
    id("sides").replaceChildren(...["lowest", "highest"].map((word, side) => {
      const by = choice.at(names[side]);
      return element("button", { type: "button", className: side === choice.side ? "on" : "", "aria-pressed": side === choice.side, text: `${word}: ${Number.isFinite(by) ? file.signed(by, output.unit) : "not found"}`, on: { click: () => { choice.side = side; } } });
    }));
    const drawn = shapes.known && mechanism.bodies.length > 1;
    canvas.hidden = !drawn;
    id("undrawn").hidden = drawn;
    id("undrawn").textContent = "The drawing of this model is not in this page.";
    const fit = fitting();
    factor = chosen ?? fit;
    const most = Math.log10(Math.max(fit, 1)) + 1;
    id("factor").value = Math.round(1000 * Math.log10(factor) / most);
    id("factor").dataset.most = most;
    id("factor_is").textContent = `× ${file.number(factor, 3)}`;
    id("fit").disabled = chosen === null;
    id("enlarging").hidden = !drawn || !detail.displaced[choice.side];
    id("worst_note").textContent = detail.displaced[choice.side]
      ? `Grey: nominal. In colour: ${linkdyn.plain(output.name)} at its ${choice.side ? "largest" : "smallest"}, displacements × ${file.number(factor, 3)}. Gaps at pins are clearances and deviations of lengths, enlarged alike.${choice.isMoved && choice.corner === null ? " The sliders below move the value, not this drawing, until all are at their worst." : ""}`
      : "Grey: nominal. No worst configuration was found on this side at this pose.";
    if (drawn) draw();
  };

  id("factor").addEventListener("input", () => {
    const most = Number(id("factor").dataset.most);
    chosen = Number((10 ** (most * Number(id("factor").value) / 1000)).toPrecision(2));
    fill();
  });
  id("fit").addEventListener("click", () => { chosen = null; fill(); });
  const measure = () => { [width, height] = [stage.clientWidth, stage.clientHeight]; if (width > 0) fill(); };
  new ResizeObserver(() => setTimeout(measure, 0)).observe(stage);
  choice.onChange(fill);
  theme.onChange(fill);
  measure();
  linkdyn.worst = { get factor() { return factor; }, GHOST, draw };
})();

"use strict";
// Elastic links as they bend: the page has this script where there are some. Deflections are enlarged as the reader chooses, bars
// coloured by how much they are bent; points of their axes stand where they are. Where amplitudes are missing a link stays straight.
(() => {
  const { given, mechanism, shapes, drawing, forces, units, byName, element, id } = linkdyn;
  const SHARE = 0.1, MOST_ROWS = 2000, OFF = 1e-3, FAINT = 0.3;
  const links = mechanism.bodies.flatMap((own, body) => {
    if (!own.bending) return [];
    const amplitudes = own.bending.moves[0].map((_, k) => byName.get(`${own.name}.q${k + 1}`));
    // Of a chain the parts behind the first have places of their own.
    const nodes = amplitudes.length ? [] : own.bending.places.slice(1).map((_, k) => ["x", "y"].map((axis) => byName.get(`${own.name}.node${k + 1}.${axis}`)));
    return [...amplitudes, ...nodes.flat()].every(Boolean) ? [{ own, body, amplitudes, nodes }] : [];
  });
  if (!links.length) return;
  const ofBody = new Map(links.map((link) => [link.body, link]));

  // Deflections and curvatures along a link; nothing in a gap.
  const bent = ({ own: { bending }, body, amplitudes, nodes }, row) => {
    if (nodes.length) {
      const pose = shapes.pose(body, row), places = pose && nodes.map(([x, y]) => shapes.turn([0, 0, -pose[2]], x.values[row] - pose[0], y.values[row] - pose[1]));
      return places?.flat().every(Number.isFinite) ? { deflections: [[0, 0], ...places.map(([x, y], k) => [x - bending.places[k + 1][0], y - bending.places[k + 1][1]])], curvatures: [] } : null;
    }
    const q = amplitudes.map(({ values }) => values[row]), sum = (by, of) => by.reduce((sum, part, k) => sum + of(part) * q[k], 0);
    return q.every(Number.isFinite) ? {
      deflections: bending.moves.map((by) => [sum(by, ([x]) => x), sum(by, ([, y]) => y)]),
      curvatures: bending.curvatures.map((by) => Math.abs(sum(by, (part) => part))),
    } : null;
  };
  // Along the axis from 0 to 1, and how far off it, as a part of its length.
  const seat = ({ own: { bending: { places } } }, x, y) => {
    const [[ax, ay], [bx, by]] = [places[0], places.at(-1)], [u, v] = [bx - ax, by - ay], square = u * u + v * v;
    return { length: Math.sqrt(square), part: ((x - ax) * u + (y - ay) * v) / square, off: Math.abs((x - ax) * v - (y - ay) * u) / square };
  };

  // The largest of the run: how much deflections are enlarged, to a part of the length of their link, and what has the warmest colour.
  let found = null, enlarged = true;
  const largest = () => {
    if (found) return found;
    let share = 0, curvature = 0;
    const step = Math.ceil(linkdyn.rows / MOST_ROWS) || 1;
    // Chains are for large deflections: these are as they are.
    for (const link of links.filter(({ nodes }) => !nodes.length)) for (let row = 0; row < linkdyn.rows; row += step) {
      const { deflections, curvatures } = bent(link, row) || { deflections: [], curvatures: [] }, { length } = seat(link, 0, 0);
      for (const far of deflections) share = Math.max(share, Math.hypot(...far) / length);
      curvature = Math.max(curvature, ...curvatures);
    }
    const about = SHARE / share, power = 10 ** Math.floor(Math.log10(about));
    found = { factor: about > 1 && Number.isFinite(about) ? [5, 2, 1].map((n) => n * power).find((n) => n <= about) || power : 1, curvature };
    options[0].textContent = `enlarged × ${units.number(found.factor)}`;
    chosen.hidden = found.factor === 1;
    return found;
  };
  const factor = () => enlarged ? largest().factor : 1;
  const options = ["", "true to scale"].map((text, k) => element("option", { value: String(k), text }));
  const choice = element("select", { "aria-label": "Scale of deflections", on: { change: () => { enlarged = choice.value === "0"; linkdyn.stage.draw(); } } }, ...options);
  const chosen = element("fieldset", {}, element("legend", { text: "Deflections" }), choice);
  id("forces").after(chosen);

  // Points of the axis, where they are.
  const settle = () => {
    const { place } = shapes;
    shapes.place = ([body, number], row) => {
      const link = shapes.posed ? null : ofBody.get(body), pose = link && shapes.pose(body, row), now = pose && bent(link, row);
      const [, x, y] = now && link.own.points[number] || [], { part, off } = now ? seat(link, x, y) : {};
      if (!(off < OFF && part > -OFF && part < 1 + OFF)) return place([body, number], row);
      const all = now.deflections, parts = link.own.bending.places.map(([x, y]) => seat(link, x, y).part);
      const k = Math.min(Math.max(parts.findLastIndex((own) => own <= part), 0), all.length - 2), beyond = (part - parts[k]) / (parts[k + 1] - parts[k]);
      const [dx, dy] = [0, 1].map((axis) => all[k][axis] + beyond * (all[k + 1][axis] - all[k][axis]));
      return shapes.carry(pose, x + dx, y + dy);
    };
  };
  linkdyn.onData(() => { found = null; settle(); });
  settle();
  largest();

  const tint = (part, { line, force }) => {
    const [from, to] = [line, force].map((colour) => colour.match(/[\d.]+/g).map(Number));
    return `rgb(${[0, 1, 2].map((k) => Math.round(from[k] + Math.min(part, 1) * (to[k] - from[k]))).join(", ")})`;
  };
  const bar = (pen, link, now, { to, row, bar, colours }, width) => {
    const { places } = link.own.bending, pose = shapes.pose(link.body, row), { fill, line } = colours.body(link.body), most = largest().curvature, by = link.nodes.length ? 1 : factor();
    const stroke = (points, wide, colour) => { drawing.path(pen, points); pen.lineWidth = wide; pen.strokeStyle = colour; pen.stroke(); };
    const along = (by) => places.map(([x, y], k) => to(shapes.carry(pose, x + by * now.deflections[k][0], y + by * now.deflections[k][1])));
    const all = pen.globalAlpha, points = along(by);
    // Pins, paths and what else joins it are where it is.
    if (by > 1) { pen.globalAlpha = all * FAINT; stroke(along(1), 2 * bar, fill); pen.globalAlpha = all; }
    stroke(points, 2 * bar + width, line);
    if (!(most > 0) || !now.curvatures.length) stroke(points, 2 * bar - width, fill);
    else now.curvatures.slice(1).forEach((end, k) => stroke(points.slice(k, k + 2), 2 * bar - width, tint((now.curvatures[k] + end) / 2 / most, colours)));
  };

  // In the places of the straight bars, behind pins; the mechanism as it is saved, and one that a hand moves, has these.
  const { draw } = drawing;
  drawing.draw = (pen, state) => {
    const { parts, signs } = given.drawing, quiet = { ...state, show: { ...state.show, points: false, joints: false } };
    let next = 0;
    const upTo = (end, show) => { given.drawing.parts = parts.slice(next, end); next = end; const names = draw(pen, show); given.drawing.parts = parts; return names; };
    if (linkdyn.shapes === shapes && !shapes.posed) parts.forEach(([sign, , turn], k) => {
      const own = signs[sign].find(({ body }) => body), link = own && ofBody.get(turn), now = link && shapes.pose(turn, state.row) && bent(link, state.row);
      if (!now) return;
      // A plate about the axis stays behind it.
      const isBar = link.own.points.every(([, x, y]) => seat(link, x, y).off < OFF);
      upTo(isBar ? k : k + 1, quiet);
      next = k + 1;
      bar(pen, link, now, state, Math.max(own.width * state.bar, 1.1));
    });
    return upTo(parts.length, state);
  };

  // How much is enlarged, and what the colours mean, before the scales of forces.
  const { legend } = forces;
  forces.legend = (pen, list, x, y, width) => {
    const colours = drawing.palette(), boxes = [], LONG = 40, WIDE = 2;
    const put = (text, long) => {
      const wide = pen.measureText(text).width + 6;
      if (x + wide + long > width) return;
      pen.fillStyle = colours.muted;
      pen.fillText(text, x, y - 4);
      for (let k = 0; k < long; k += WIDE) { pen.fillStyle = tint(k / (long - WIDE), colours); pen.fillRect(x + wide + k, y - 14, WIDE, 6); }
      boxes.push({ x, y: y - 18, wide: wide + long, tall: 18, text });
      x += wide + long + 12;
    };
    pen.font = "12px system-ui, sans-serif"; pen.textBaseline = "bottom";
    if (!chosen.hidden) put(`deflection × ${units.number(factor())}`, 0);
    if (largest().curvature > 0) put("bending", LONG);
    return [...boxes, ...legend(pen, list, x, y, width)];
  };
})();

"use strict";
// The mechanism on a canvas: parts that were made beforehand (`mechanism/drawing.rs`) are put where their points are at a row. `to` turns
// metres into pixels, `scale` is pixels per metre, `bar` half the width of a body in pixels.
(() => {
  const { given, mechanism, theme, colour } = linkdyn;
  const { bodies } = given.palette;

  // Colours by name, kept until the theme changes: to ask for a colour takes longer than to draw with it.
  const NAMES = ["card", "ink", "muted", "steel", "ground", "pin", "force", "load", "accent", "line"];
  const kept = new Map();
  const palette = () => {
    const { dark } = theme;
    if (!kept.has(dark)) {
      const found = Object.fromEntries(NAMES.map((name) => [name, colour(name)])), tone = dark ? "dark" : "light";
      const body = (k) => {
        if (k === 0) return { fill: found.card, line: found.ground };
        const { fill, line } = bodies[(k - 1) % bodies.length];
        return { fill: fill[tone], line: line[tone] };
      };
      kept.set(dark, { ...found, body });
    }
    return kept.get(dark);
  };

  // Where a part stands: a point, a place in a body, or its origin.
  const stands = ([body, ...of], row) => {
    if (of.length === 1) return linkdyn.shapes.place([body, of[0]], row);
    const pose = linkdyn.shapes.pose(body, row);
    return pose && linkdyn.shapes.carry(pose, ...(of.length ? of : [0, 0]));
  };
  // Its origin, direction and length on the canvas.
  const seat = ([, at, turn, { axis = [1, 0], to: end } = {}], { to, row, scale, bar }) => {
    const { shapes } = linkdyn, from = stands(at, row), pose = shapes.pose(turn, row), far = end && shapes.place(end, row);
    if (!from || !pose || (end && !far)) return null;
    const [x, y] = to(from);
    if (far) return between([x, y], to(far), { scale, bar });
    const [u, v] = shapes.turn(pose, ...axis);
    return { x, y, u, v: -v, length: 0, scale, bar };
  };
  const between = ([x, y], [a, b], { scale = 0, bar }) => {
    const length = Math.hypot(a - x, b - y);
    return length > 0 ? { x, y, u: (a - x) / length, v: (b - y) / length, length, scale, bar } : null;
  };

  // Corners lie so far along the sign, so many metres and so many bars from its origin.
  const corners = ({ along, metres, bars }, { x, y, u, v, length, scale, bar }) => {
    const count = along ? along.length : (metres || bars || [0, 0]).length / 2, found = new Array(count);
    for (let k = 0; k < count; k++) {
      let far = metres ? metres[2 * k] * scale : 0, left = metres ? metres[2 * k + 1] * scale : 0;
      // What counts from the end does not go back behind the beginning.
      if (along && along[k] > 0) far = Math.max(far + along[k] * length, 0);
      if (bars) { far += bars[2 * k] * bar; left += bars[2 * k + 1] * bar; }
      found[k] = [x + far * u + left * v, y + far * v - left * u];
    }
    return found;
  };
  const path = (pen, points, closed) => {
    pen.beginPath();
    points.forEach(([x, y], k) => k ? pen.lineTo(x, y) : pen.moveTo(x, y));
    if (closed) pen.closePath();
  };
  // What lies within a radius of a convex polygon, its corners to the left around it.
  const rounded = (pen, points, radius) => {
    pen.beginPath();
    points.forEach(([x, y], k) => {
      const [before, after] = [points[(k + points.length - 1) % points.length], points[(k + 1) % points.length]];
      const normal = ([ax, ay], [bx, by]) => Math.atan2(bx - ax, ay - by);
      if (points.length > 1) pen.arc(x, y, radius, normal(before, [x, y]), normal([x, y], after), true);
      else pen.arc(x, y, radius, 0, 2 * Math.PI);
    });
    pen.closePath();
  };
  // A line that winds up with the angle between two bodies.
  const coil = (pen, [[low, high], ends], { x, y, bar }, row) => {
    const [from, to] = ends.map((body) => linkdyn.shapes.pose(body, row)[2]);
    const sweep = 4 * Math.PI + Math.atan2(Math.sin(to - from), Math.cos(to - from)), points = [];
    for (let k = 0; k <= 60; k++) {
      const radius = bar * (low + (high - low) * k / 60), angle = from + sweep * k / 60;
      points.push([x + radius * Math.cos(angle), y - radius * Math.sin(angle)]);
    }
    path(pen, points);
  };

  // Ground: short strokes on the right side of a line.
  const hatch = (pen, [[ax, ay], [bx, by]], strokes, bar) => {
    const [x, y] = [bx - ax, by - ay], length = Math.hypot(x, y), [u, v] = [x, y].map((part) => 0.7 * bar * part / (length || 1));
    pen.beginPath();
    for (let k = 0; k < strokes; k++) {
      const part = (k + 0.7) / strokes, [px, py] = [ax + part * x, ay + part * y];
      pen.moveTo(px, py); pen.lineTo(px - u - v, py - v + u);
    }
  };

  // The outline of a stroke; whether there is one.
  const outline = (pen, stroke, at, { to, row, gaps = 1 }, body) => {
    if (stroke.radius) {
      const [[x, y]] = corners(stroke, at), [metres, bars] = stroke.radius;
      // Clearances may be enlarged, or left out.
      if (stroke.gap && !gaps) return false;
      pen.beginPath(); pen.arc(x, y, Math.max(metres * at.scale * (stroke.gap ? gaps : 1), bars * at.bar), 0, 2 * Math.PI);
    } else if (stroke.hull) rounded(pen, corners(stroke, at), stroke.hull * at.bar);
    else if (stroke.body) {
      const places = linkdyn.shapes.hull(body, row);
      if (!places.length || !places.every(Boolean)) return false;
      rounded(pen, places.map(to), stroke.body * at.bar);
    } else if (stroke.coil) {
      if (!stroke.coil[1].every((body) => linkdyn.shapes.pose(body, row))) return false;
      coil(pen, stroke.coil, at, row);
    } else path(pen, corners(stroke, at), stroke.closed);
    return true;
  };
  // The thinnest line that is seen well [px].
  const THIN = 1.1;
  const drawSign = (pen, sign, at, state, body, tint) => {
    const all = pen.globalAlpha;
    for (const stroke of given.drawing.signs[sign]) {
      if (!outline(pen, stroke, at, state, body)) continue;
      if (stroke.fill) {
        pen.globalAlpha = all * (stroke.cover ?? 1); pen.fillStyle = tint(stroke.fill); pen.fill();
      }
      if (stroke.edge) {
        pen.lineWidth = Math.max(stroke.width * state.bar, THIN); pen.strokeStyle = tint(stroke.edge); pen.globalAlpha = all * (stroke.pale ?? 1);
        if (stroke.dash) pen.setLineDash(stroke.dash.map((part) => part * pen.lineWidth));
        if (stroke.ground) {
          const { lineWidth } = pen;
          pen.lineWidth = 1.4 * lineWidth; pen.stroke();
          pen.lineWidth = 0.8 * lineWidth; hatch(pen, corners(stroke, at), stroke.ground, at.bar);
        }
        pen.stroke();
        if (stroke.dash) pen.setLineDash([]);
      }
      pen.globalAlpha = all;
    }
  };

  // An arrow of a force from one place to another; one that is cut has a second head, a short one small heads.
  const HEAD = 1.7;
  const arrow = (pen, from, to, bar, ink, isCut = false) => {
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]), at = length >= 2 && between(from, to, { bar: Math.min(bar, length / HEAD) });
    if (at) drawSign(pen, given.drawing.arrows[isCut ? 1 : 0], at, { bar }, 0, () => ink);
  };
  const round = (pen, [x, y], bar, left, ink) => drawSign(pen, given.drawing.arrows[left ? 2 : 3], { x, y, u: 1, v: 0, length: 0, scale: 0, bar }, { bar }, 0, () => ink);

  const middle = (points) => points.reduce(([x, y], p) => [x + p[0] / points.length, y + p[1] / points.length], [0, 0]);
  // Where names may go, and the points of bodies.
  const names = (pen, { to, row, bar, colours, show }) => {
    const { shapes } = linkdyn, found = [];
    const at = (end) => { const place = shapes.place(end, row); return place && to(place); };
    const put = (text, place, key, rest) => { if (place) found.push({ text, at: place, key, colour: colours.ink, ...rest }); };
    mechanism.bodies.forEach(({ name, points }, k) => {
      const hull = shapes.hull(k, row), colour = colours.body(k).line;
      if (k === 0 || !hull.length || !hull.every(Boolean)) return;
      put(name, middle(hull.map(to)), `body ${k}`, { colour, strong: true });
      if (show.points) points.forEach(([point], number) => {
        const place = at([k, number]);
        put(point, place, `point ${k},${number}`, { colour: colours.muted });
        pen.fillStyle = colour; pen.beginPath(); pen.arc(...place, 2.4, 0, 7); pen.fill();
      });
    });
    if (!show.joints) return found;
    mechanism.joints.forEach(({ name, rims, between: [, second] }, k) => { if (!rims) put(name, at(second), `joint ${k}`, { beside: 1.5 * bar }); });
    mechanism.springs.forEach(({ name, between: ends }, k) => {
      const places = ends.map(at);
      if (places.every(Boolean)) put(name, middle(places), `spring ${k}`, { beside: 1.5 * bar });
    });
    mechanism.torsion_springs.forEach(({ name, bodies, pin }, k) => put(name, at(pin === undefined ? [bodies.find((body) => body > 0), 0] : mechanism.joints[pin].between[1]), `torsion ${k}`, { beside: 2.4 * bar }));
    return found;
  };

  // Everything at a row; returns where names may go.
  const draw = (pen, state) => {
    const { colours, show } = state;
    pen.lineJoin = pen.lineCap = "round";
    for (const part of given.drawing.parts) {
      const [sign, , turn, { show: kind, of = turn } = {}] = part, at = kind && !show[kind] ? null : seat(part, state);
      const tint = (name) => name === "body-fill" ? colours.body(of).fill : name === "body-edge" ? colours.body(of).line : colours[name];
      if (at) drawSign(pen, sign, at, state, of, tint);
    }
    return names(pen, state);
  };

  // A canvas of a size, at the sharpness of the screen; and the view that shows a box with room about it.
  const prepare = (canvas, width, height) => {
    const ratio = devicePixelRatio || 1, pen = canvas.getContext("2d");
    [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    return pen;
  };
  const fitted = ([left, right, bottom, top], width, height, room) => {
    const scale = Math.min((width - 2 * room) / (right - left), (height - 2 * room) / (top - bottom));
    return { scale, to: ([x, y]) => [width / 2 + (x - (left + right) / 2) * scale, height / 2 - (y - (bottom + top) / 2) * scale] };
  };
  // Half the width of a body in a drawing of that size.
  const barOf = (width, height) => Math.min(Math.max(Math.min(width, height) * 0.0177, 4.4), 8.8);

  // The height of a stage that suits what is drawn at its width, for the style sheet.
  const suit = (stage, [left, right, bottom, top]) => stage.style.setProperty("--fit", `${Math.round((stage.clientWidth - 60) * (top - bottom) / (right - left) + 90)}px`);

  linkdyn.drawing = { palette, draw, arrow, round, path, prepare, fitted, suit, barOf };
})();

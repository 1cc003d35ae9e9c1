"use strict";
// The mechanism on a canvas at one instant, layer by layer. `to` turns metres into pixels, `px` is the size of a detail in pixels.
(() => {
  const { mechanism, shapes, symbols } = linkdyn;
  const { path, hatch, disc, support, arrow, round, spring, coil, roundDashpot, strip, wheel, rack, pulley, belt, cylinder } = symbols;

  // Colours of the style sheet, as the canvas needs them.
  const probe = document.createElement("span");
  probe.hidden = true;
  document.body.append(probe);
  const colour = (name) => { probe.style.color = `var(--${name})`; return getComputedStyle(probe).color; };
  const { bodies } = linkdyn.palette;
  const body = (k, theme) => {
    const { fill, line } = bodies[(k - 1) % bodies.length];
    return { fill: fill[theme], line: line[theme] };
  };
  // Kept until the theme changes: to ask for a colour takes longer than to draw with it.
  const kept = new Map();
  const palette = () => {
    const dark = linkdyn.theme.dark;
    if (!kept.has(dark)) kept.set(dark, colours(dark));
    return kept.get(dark);
  };
  const colours = (dark) => {
    const names = ["card", "ink", "muted", "steel", "ground", "pin", "force", "load", "accent", "line"];
    const found = Object.fromEntries(names.map((name) => [name, colour(name)]));
    return { ...found, dark, body: (k) => k === 0 ? { fill: found.card, line: found.ground } : body(k, dark ? "dark" : "light") };
  };

  // Behind all: wheels.
  const wheels = ({ pen, at, direction, scale, px, row, colours }) => {
    for (const [k, { between, gear, rack: line, belt: pulleys }] of mechanism.joints.entries()) {
      if (pulleys) {
        const centres = between.map(at), poses = between.map(([number]) => shapes.pose(number, row)), radii = pulleys.radii.map((r) => r * scale);
        if (!centres.every(Boolean) || !poses.every(Boolean)) continue;
        between.forEach(([number], end) => pulley(pen, colours.body(number), centres[end], poses[end][2], radii[end], px));
        pen.strokeStyle = colours.steel;
        belt(pen, centres, radii, pulleys.crossed, px);
      }
      if (line) {
        const pose = shapes.pose(between[0][0], row), [c, b] = between.map(at), a = direction(between[1][0], line.axis), stroke = shapes.strokes[k];
        if (!pose || !c || !b || !a || !stroke) continue;
        const long = Math.hypot(...a), u = [a[0] / long, a[1] / long], side = Math.sign(line.radius), radius = Math.abs(line.radius);
        const here = (c[0] - b[0]) * u[0] + (c[1] - b[1]) * u[1], n = [u[1] * side, -u[0] * side];
        const ends = [stroke[0] - 0.6 * radius, stroke[1] + 0.6 * radius].map((far) => far * scale - here);
        rack(pen, colours.body(between[1][0]), c, pose[2], radius * scale, u, n, ends, px);
        wheel(pen, colours.body(between[0][0]), c, pose[2], radius * scale, px, false);
      }
      if (!gear) continue;
      const bigger = gear.radii[0] > gear.radii[1] ? 0 : 1;
      between.forEach((end, k) => {
        const pose = shapes.pose(end[0], row), centre = at(end);
        if (pose && centre) wheel(pen, colours.body(end[0]), centre, pose[2], gear.radii[k] * scale, px, gear.internal && k === bigger);
      });
    }
  };

  // Profiles of cams, behind the bodies.
  const cams = ({ pen, at, scale, row, colours }) => {
    for (const { type, between: [[number, point]], outline } of mechanism.joints) {
      if (type !== "cam" || !outline.length) continue;
      const pose = shapes.pose(number, row), centre = at([number, point]);
      if (!pose || !centre) continue;
      const [sin, cos] = [Math.sin(pose[2]), Math.cos(pose[2])], { fill, line } = colours.body(number);
      path(pen, outline.map(([x, y]) => [centre[0] + scale * (cos * x - sin * y), centre[1] - scale * (sin * x + cos * y)]), true);
      pen.globalAlpha = 0.55; pen.fillStyle = fill; pen.fill(); pen.globalAlpha = 1;
      pen.strokeStyle = line; pen.lineWidth = 1.8; pen.stroke();
    }
  };

  // Rollers and faces that touch them.
  const followers = ({ pen, at, scale, px, row, colours }) => {
    for (const { type, between: [, second], roller, face, reach } of mechanism.joints) {
      if (type !== "cam") continue;
      const centre = at(second), pose = shapes.pose(second[0], row);
      if (!centre || !pose) continue;
      const { fill, line } = colours.body(second[0]);
      pen.strokeStyle = line;
      if (roller) {
        pen.beginPath(); pen.arc(...centre, roller * scale, 0, 7);
        pen.globalAlpha = 0.55; pen.fillStyle = fill; pen.fill(); pen.globalAlpha = 1;
        pen.lineWidth = 1.8; pen.stroke();
        pen.strokeStyle = colours.steel; pen.fillStyle = colours.pin; disc(pen, centre, Math.min(px * 0.36, roller * scale / 2));
      }
      if (face) {
        const angle = pose[2] + Math.atan2(face[1], face[0]), far = (reach || 0) * scale + px;
        const end = (s) => [centre[0] + s * far * Math.cos(angle), centre[1] - s * far * Math.sin(angle)];
        pen.lineWidth = px * 0.45; path(pen, [end(-1), end(1)]); pen.stroke();
      }
    }
  };

  // The ends of a joint's way that are near enough to its stroke to be drawn.
  const ends = (joint, k) => {
    const [low, high] = shapes.strokes[k], far = 0.5 * (high - low), near = (end, from) => end !== null && Math.abs(end - from) <= far;
    const [lower, upper] = joint.limits || [null, null];
    return [near(lower, low) ? lower : null, near(upper, high) ? upper : null];
  };
  // How far a guide goes: a slot to its ends.
  const reach = (joint, k) => {
    const [low, high] = shapes.strokes[k], [lower, upper] = ends(joint, k), slot = joint.type === "slot";
    return [lower === null ? low : slot ? lower : Math.min(low, lower), upper === null ? high : slot ? upper : Math.max(high, upper)];
  };

  // Stops: bars where a block comes to its ends, and pegs about a pin with an arc between them.
  const stops = ({ pen, at, direction, scale, px, row, colours }) => mechanism.joints.forEach((joint, k) => {
    if (!joint.limits || joint.type === "slot") return;
    const [first, second] = joint.between, a = at(first);
    if (!a) return;
    pen.strokeStyle = colours.steel;
    const bar = (from, to) => { pen.lineWidth = px * 0.6; path(pen, [from, to]); pen.stroke(); };
    if (joint.type === "prismatic") {
      const u = direction(first[0], joint.axis);
      if (u) ends(joint, k).forEach((end, side) => {
        if (end === null) return;
        const far = end * scale + (side ? 1 : -1) * px * 1.9, end2 = (d) => [a[0] + u[0] * far - u[1] * d, a[1] + u[1] * far + u[0] * d];
        bar(end2(-1.7 * px), end2(1.7 * px));
      });
      return;
    }
    const points = mechanism.bodies[second[0]].points, [, x, y] = points[second[1]], pose = shapes.pose(first[0], row);
    if (!pose) return;
    const [sx, sy] = points.reduce(([u, v], p) => [u + p[1] - x, v + p[2] - y], [0, 0]);
    const base = pose[2] + (sx || sy ? Math.atan2(sy, sx) : 0);
    const peg = (angle, radius) => [a[0] + radius * px * Math.cos(base + angle), a[1] - radius * px * Math.sin(base + angle)];
    for (const end of joint.limits) if (end !== null) bar(peg(end, 2.4), peg(end, 3.8));
    const [low, high] = joint.limits;
    if (low !== null && high !== null) {
      pen.lineWidth = 1;
      pen.beginPath(); pen.arc(...a, 3.1 * px, -(base + low), -(base + Math.min(high, low + 2 * Math.PI)), true); pen.stroke();
    }
  });

  // An arrow about a pin, the way in which its one-way clutch turns.
  const clutches = ({ pen, at, px, row, colours }) => mechanism.joints.forEach(({ between: [first], one_way: way }) => {
    const a = way && at(first), pose = a && shapes.pose(first[0], row);
    if (!pose) return;
    const sign = way === "forward" ? 1 : -1, turn = 4.5;
    const place = (angle, radius) => [a[0] + radius * px * Math.cos(pose[2] + sign * angle), a[1] - radius * px * Math.sin(pose[2] + sign * angle)];
    pen.strokeStyle = colours.steel; pen.lineWidth = 1.5;
    // Within the arrows of torques.
    path(pen, Array.from({ length: 46 }, (_, k) => place(turn * k / 45, 1.6))); pen.stroke();
    path(pen, [place(turn - 0.5, 1.0), place(turn, 1.6), place(turn - 0.5, 2.2)]); pen.stroke();
  });

  // Outlines that may be touched: plates where they are closed, else lines, hatched on the ground; and the tips.
  const outlines = ({ pen, at, to, scale, px, row, colours }) => mechanism.joints.forEach(({ type, between, outlines, radius, arc }) => {
    if (type !== "contact") return;
    const [first, second] = between.map(([number]) => shapes.pose(number, row)), centre = at(between[1]);
    if (!first || !second || !centre) return;
    const show = (number, fills) => {
      const { fill, line } = colours.body(number);
      pen.fillStyle = fill; pen.strokeStyle = line; pen.lineWidth = 1.5;
      if (fills) pen.fill();
      pen.stroke();
    };
    for (const outline of outlines) {
      const corners = outline.map((corner) => to(shapes.carry(first, ...corner)));
      const [start, end] = [outline[0], outline[outline.length - 1]], closed = start[0] === end[0] && start[1] === end[1];
      if (!closed && between[0][0] === 0) {
        pen.strokeStyle = colours.ground; pen.lineWidth = 1.5;
        corners.slice(1).forEach((corner, k) => hatch(pen, corners[k], corner, -1, px * 0.8));
      } else {
        path(pen, corners, closed);
        show(between[0][0], closed);
      }
    }
    pen.beginPath();
    if (arc) pen.arc(...centre, radius * scale, -(second[2] + arc[0]), -(second[2] + arc[1]), true);
    else pen.arc(...centre, radius * scale, 0, 7);
    pen.closePath();
    show(between[1][0], true);
  });

  // Guides of blocks, and slots.
  const guides = ({ pen, at, direction, scale, px, colours }) => mechanism.joints.forEach((joint, k) => {
    if (!joint.axis || shapes.cylinders[k]) return;
    const [first, second] = joint.between, a = at(first), b = at(second), u = direction(first[0], joint.axis);
    if (!a || !b || !u) return;
    const [low, high] = reach(joint, k).map((s) => s * scale), middle = (low + high) / 2;
    const centre = [a[0] + u[0] * middle, a[1] + u[1] * middle];
    const half = (high - low) / 2 + px * (joint.type === "slot" ? 0.5 : 2.4), wide = px * 0.95;
    const { fill, line } = colours.body(first[0]);
    pen.strokeStyle = line;
    pen.lineWidth = 1.5;
    if (joint.type === "slot") {
      strip(pen, centre, u, half, px * 1.25, true); pen.fillStyle = fill; pen.fill(); pen.stroke();
      strip(pen, centre, u, half, px * 0.72, true); pen.fillStyle = colours.card; pen.fill(); pen.stroke();
      return;
    }
    const n = [-u[1], u[0]], ends = (d) => [-half, half].map((s) => [centre[0] + u[0] * s + n[0] * d, centre[1] + u[1] * s + n[1] * d]);
    if (first[0] === 0) {
      hatch(pen, ...ends(wide + 1.5), 1, px * 0.8);
      hatch(pen, ...ends(-wide - 1.5), -1, px * 0.8);
    } else {
      pen.lineWidth = px * 0.5;
      path(pen, ends(0)); pen.stroke();
    }
  });

  // Bodies: a link of two points is a bar, of more a plate.
  const bodiesOf = ({ pen, at, px, colours, show, names }) => mechanism.bodies.forEach(({ name, points }, k) => {
    const outline = shapes.outlines[k];
    if (k === 0 || outline.length === 0) return;
    const corners = outline.map((number) => at([k, number]));
    if (!corners.every(Boolean)) return;
    const { fill, line } = colours.body(k);
    const closed = corners.length > 2;
    if (!shapes.inCylinder[k]) {
      path(pen, corners.length > 1 ? corners : [corners[0], corners[0]], closed);
      pen.strokeStyle = line; pen.lineWidth = px * 1.1 + 2.6; pen.stroke();
      pen.strokeStyle = fill; pen.lineWidth = px * 1.1; pen.stroke();
      if (closed) { pen.fillStyle = fill; pen.fill(); }
    }
    const middle = corners.reduce(([x, y], c) => [x + c[0] / corners.length, y + c[1] / corners.length], [0, 0]);
    names.push({ text: name, at: middle, colour: line, strong: true, key: `body ${k}` });
    if (show.points) for (let number = 0; number < points.length; number++) {
      const p = at([k, number]);
      names.push({ text: points[number][0], at: p, colour: colours.muted, key: `point ${k},${number}` });
      pen.fillStyle = line; pen.beginPath(); pen.arc(...p, 2.4, 0, 7); pen.fill();
    }
  });

  // Blocks on guides; cylinders with their rods.
  const blocks = ({ pen, at, direction, scale, px, colours }) => mechanism.joints.forEach((joint, k) => {
    if (joint.type !== "prismatic" || !joint.axis) return;
    const [first, second] = joint.between, a = at(first), b = at(second), u = direction(first[0], joint.axis);
    if (!a || !b || !u) return;
    const found = shapes.cylinders[k];
    if (found) {
      const slide = u[0] * (b[0] - a[0]) + u[1] * (b[1] - a[1]);
      const lengths = { base: found.base * scale, end: found.end * scale, piston: slide + found.piston * scale, tip: slide + found.tip * scale };
      cylinder(pen, { first: colours.body(first[0]), second: colours.body(second[0]) }, a, u, lengths, px);
      return;
    }
    const { fill, line } = colours.body(second[0]);
    strip(pen, b, u, px * 1.7, px * 0.95, false);
    pen.fillStyle = fill; pen.fill();
    pen.strokeStyle = line; pen.lineWidth = 1.8; pen.stroke();
    if (second[0] === 0) { const n = [-u[1], u[0]], d = px * 0.95; hatch(pen, [b[0] - u[0] * d * 1.8 + n[0] * d, b[1] - u[1] * d * 1.8 + n[1] * d], [b[0] + u[0] * d * 1.8 + n[0] * d, b[1] + u[1] * d * 1.8 + n[1] * d], 1, px * 0.8); }
  });

  // Pivots on the ground, pins, welds.
  const pins = ({ pen, at, scale, px, colours, show, names }) => mechanism.joints.forEach((joint, k) => {
    const [a, b] = joint.between.map(at);
    if (!a || !b) return;
    const grounded = joint.between.some(([number]) => number === 0), pin = joint.between[0][0] === 0 ? a : b;
    pen.strokeStyle = colours.ground; pen.lineWidth = 1.5;
    if (grounded && ["revolute", "bushing", "fixed"].includes(joint.type)) support(pen, colours, pin, px);
    pen.strokeStyle = colours.steel; pen.fillStyle = colours.pin; pen.lineWidth = 1.8;
    if (joint.type === "revolute" || joint.type === "slot") {
      // A clearance that can be seen is seen.
      if (joint.type === "revolute" && Math.hypot(a[0] - b[0], a[1] - b[1]) > 0.2 * px) disc(pen, a, px * 0.46);
      disc(pen, b, px * 0.46);
      if (joint.clearance) {
        pen.strokeStyle = colours.force; pen.setLineDash([3, 2.5]);
        pen.beginPath(); pen.arc(...a, Math.max(joint.clearance.radius * scale, px * 0.85), 0, 7); pen.stroke();
        pen.setLineDash([]);
      }
    } else if (joint.type === "bushing") {
      // Rubber in its sleeve, around a pin.
      pen.fillStyle = colours.muted; disc(pen, a, px * 0.85);
      pen.fillStyle = colours.pin; disc(pen, b, px * 0.46);
    } else if (joint.type === "fixed") {
      pen.fillStyle = colours.steel; pen.fillRect(b[0] - px * 0.45, b[1] - px * 0.45, px * 0.9, px * 0.9);
    }
    if (show.joints && !["gear", "rack", "belt"].includes(joint.type)) names.push({ text: joint.name, at: b, colour: colours.ink, beside: px, key: `joint ${k}` });
  });

  // Where something turns: around a pin, else at a body.
  const around = (at, pin, number) => pin === undefined ? at([number, 0]) : at(mechanism.joints[pin].between[1]);

  // Barrel, piston and rod of an actuator, with an eye at either end.
  const actuator = (pen, colours, a, b, { end, rod }, scale, px) => {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (length > 0) {
      const u = [(b[0] - a[0]) / length, (b[1] - a[1]) / length], tone = (fill) => ({ fill, line: colours.ink });
      const lengths = { base: 0, end: end * scale, piston: Math.max(length - rod * scale, 0), tip: length };
      cylinder(pen, { first: tone(colours.card), second: tone(colours.muted) }, a, u, lengths, px);
    }
    pen.strokeStyle = colours.ink; pen.lineWidth = 1.5; pen.fillStyle = colours.card;
    for (const eye of [a, b]) disc(pen, eye, px * 0.62);
  };

  const springs = ({ pen, at, scale, px, row, colours, show, names }) => {
    pen.strokeStyle = colours.ink; pen.lineWidth = 1.5;
    mechanism.springs.forEach(({ between, damper, damped, cable, name, limits }, number) => {
      const [a, b] = between.map(at);
      if (!a || !b) return;
      const cylinder = shapes.actuators[number];
      if (cylinder) actuator(pen, colours, a, b, cylinder, scale, px);
      for (const [k, end] of [a, b].entries()) {
        pen.beginPath(); pen.arc(...end, 2.6, 0, 7); pen.fillStyle = colours.ink; pen.fill();
        const onGround = between[k][0] === 0 && !mechanism.joints.some((joint) => joint.between.some(([body, number]) => body === 0 && number === between[k][1]));
        if (onGround) hatch(pen, [end[0] + px, end[1] + 3], [end[0] - px, end[1] + 3], -1, px * 0.6);
      }
      // Where the stroke ends, but for what is far beyond.
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]), u = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
      for (const far of (limits || []).filter((limit) => limit !== null).map((limit) => limit * scale)) {
        if (!(far <= 1.6 * length)) continue;
        const at = (d) => [a[0] + u[0] * far - u[1] * d, a[1] + u[1] * far + u[0] * d];
        pen.strokeStyle = colours.steel; pen.lineWidth = px * 0.6; path(pen, [at(-2.4 * px), at(2.4 * px)]); pen.stroke();
        pen.strokeStyle = colours.ink; pen.lineWidth = 1.5;
      }
      if (cable) { pen.beginPath(); pen.moveTo(...a); pen.lineTo(...b); pen.stroke(); }
      else if (!cylinder) spring(pen, a, b, px, damper, damped);
      if (show.joints) names.push({ text: name, at: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], colour: colours.ink, beside: px, key: `spring ${number}` });
    });
    mechanism.torsion_springs.forEach(({ bodies, pin, damper, name }, number) => {
      const where = around(at, pin, bodies.find((number) => number > 0));
      const [first, second] = bodies.map((number) => shapes.pose(number, row));
      if (!where || !first || !second) return;
      if (damper) roundDashpot(pen, where, second[2], px); else coil(pen, where, first[2], second[2], px);
      if (show.joints) names.push({ text: name, at: where, colour: colours.ink, beside: 1.6 * px, key: `torsion ${number}` });
    });
  };

  // Centres of mass: a quartered disc.
  const centres = ({ pen, to, px, row, colours, show }) => {
    if (show.centres) mechanism.bodies.forEach(({ com }, k) => {
      const pose = shapes.pose(k, row);
      if (k === 0 || !com || !pose) return;
      const c = to(shapes.carry(pose, ...com)), r = px * 0.42;
      pen.fillStyle = colours.card; pen.strokeStyle = colours.ink; pen.lineWidth = 1.2;
      pen.beginPath(); pen.arc(...c, r, 0, 7); pen.fill(); pen.stroke();
      pen.fillStyle = colours.ink;
      for (const start of [0, Math.PI]) { pen.beginPath(); pen.moveTo(...c); pen.arc(...c, r, start, start + Math.PI / 2); pen.fill(); }
    });
  };

  // Drivers: an arrow round the pin, or along the guide.
  const drivers = ({ pen, at, direction, px, colours, show }) => {
    if (show.drivers) for (const driver of mechanism.drivers) {
      if (driver.type === "length") continue;
      pen.strokeStyle = pen.fillStyle = colours.accent;
      if (driver.type === "translation") {
        const { between, axis } = mechanism.joints[driver.joint], b = at(between[1]), u = direction(between[0][0], axis);
        if (b && u) arrow(pen, ...[-2, 2].map((far) => [b[0] + (u[0] * far + u[1] * 1.9) * px, b[1] + (u[1] * far - u[0] * 1.9) * px]), 2, px);
        continue;
      }
      const centre = around(at, driver.pin, driver.body);
      if (centre) round(pen, centre, px * 1.8, true, 2);
    }
  };

  const LAYERS = [wheels, cams, guides, outlines, bodiesOf, blocks, followers, stops, clutches, pins, springs, centres, drivers];

  // Everything at `row`; returns where names may go.
  const draw = (pen, { to, scale, px, row, colours, show }) => {
    const names = [];
    const at = (end) => { const place = shapes.place(end, row); return place && to(place); };
    const direction = (bodyNumber, vector) => {
      const pose = shapes.pose(bodyNumber, row);
      if (!pose || !vector) return null;
      const [x, y] = shapes.turn(pose, ...vector);
      return [x, -y];
    };
    pen.lineJoin = pen.lineCap = "round";
    for (const layer of LAYERS) layer({ pen, to, at, direction, scale, px, row, colours, show, names });
    return names;
  };

  linkdyn.drawing = { palette, draw, colour };
})();

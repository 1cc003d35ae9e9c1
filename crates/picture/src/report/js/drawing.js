"use strict";
// The mechanism on a canvas at one instant. `to` turns metres into pixels, `px` is the size of a detail in pixels.
(() => {
  const { mechanism, shapes } = linkdyn;

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
  const palette = () => {
    const dark = linkdyn.theme.dark;
    const names = ["card", "ink", "muted", "steel", "ground", "pin", "force", "load", "accent", "line"];
    const found = Object.fromEntries(names.map((name) => [name, colour(name)]));
    return { ...found, dark, body: (k) => k === 0 ? { fill: found.card, line: found.ground } : body(k, dark ? "dark" : "light") };
  };

  const path = (pen, points, closed) => {
    pen.beginPath();
    points.forEach(([x, y], k) => k ? pen.lineTo(x, y) : pen.moveTo(x, y));
    if (closed) pen.closePath();
  };

  // Short lines below a line from a to b: what does not move.
  const hatch = (pen, a, b, side, px) => {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (!(length > 0)) return;
    const u = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    const n = [-u[1] * side, u[0] * side];
    const count = Math.min(Math.max(Math.round(length / (px * 0.9)), 2), 200);
    pen.beginPath();
    pen.moveTo(...a); pen.lineTo(...b);
    for (let k = 0; k < count; k++) {
      const s = (k + 0.75) * length / count;
      pen.moveTo(a[0] + u[0] * s, a[1] + u[1] * s);
      pen.lineTo(a[0] + u[0] * (s - px * 0.7) + n[0] * px * 0.8, a[1] + u[1] * (s - px * 0.7) + n[1] * px * 0.8);
    }
    pen.stroke();
  };

  const disc = (pen, centre, radius) => { pen.beginPath(); pen.arc(...centre, radius, 0, 7); pen.fill(); pen.stroke(); };

  // The support of a pin.
  const support = (pen, colours, pin, px) => {
    const wide = px * 1.25, low = px * 1.9;
    path(pen, [pin, [pin[0] - wide, pin[1] + low], [pin[0] + wide, pin[1] + low]], true);
    pen.fillStyle = colours.card; pen.fill(); pen.stroke();
    hatch(pen, [pin[0] + wide * 1.6, pin[1] + low], [pin[0] - wide * 1.6, pin[1] + low], -1, px * 0.7);
  };

  const arrow = (pen, from, to, width, head) => {
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (length < 2) return;
    const u = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    const tip = Math.min(head, length);
    const neck = [to[0] - u[0] * tip, to[1] - u[1] * tip];
    pen.lineWidth = width;
    path(pen, [from, [to[0] - u[0] * tip * 0.8, to[1] - u[1] * tip * 0.8]]);
    pen.stroke();
    path(pen, [to, [neck[0] - u[1] * tip * 0.45, neck[1] + u[0] * tip * 0.45], [neck[0] + u[1] * tip * 0.45, neck[1] - u[0] * tip * 0.45]], true);
    pen.fill();
  };

  // An arrow round a point, turning left or right.
  const round = (pen, [x, y], radius, left, width) => {
    const end = -0.4, start = end - (left ? -1 : 1) * 4.2;
    pen.lineWidth = width;
    pen.beginPath();
    pen.arc(x, y, radius, start, end, left);
    pen.stroke();
    const at = [x + radius * Math.cos(end), y + radius * Math.sin(end)];
    const on = left ? 1 : -1;
    const u = [Math.sin(end) * on, -Math.cos(end) * on];
    arrow(pen, [at[0] - u[0], at[1] - u[1]], [at[0] + u[0] * radius * 0.55, at[1] + u[1] * radius * 0.55], width, radius * 0.65);
  };

  // The strokes of a damper between 0 and 1 along and -1 and 1 across: rod, cup, piston, rod.
  const DASHPOT = [[[0, 0], [0.4, 0]], [[0.7, 1], [0.4, 1], [0.4, -1], [0.7, -1]], [[0.58, 0.7], [0.58, -0.7]], [[0.58, 0], [1, 0]]];

  const spring = (pen, a, b, px, damper) => {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (length < 1) return;
    const u = [(b[0] - a[0]) / length, (b[1] - a[1]) / length], n = [-u[1], u[0]];
    const at = (s, d) => [a[0] + u[0] * s + n[0] * d, a[1] + u[1] * s + n[1] * d];
    const start = length * 0.15, rest = length * 0.7, wide = px * 0.8;
    if (damper) {
      for (const stroke of DASHPOT) { path(pen, stroke.map(([s, d]) => at(s * length, d * wide))); pen.stroke(); }
      return;
    }
    const points = [a, at(start, 0)];
    for (let k = 0; k < 14; k++) points.push(at(start + rest * (k + 0.5) / 14, (k % 2 ? -1 : 1) * wide));
    path(pen, [...points, at(start + rest, 0), b]);
    pen.stroke();
  };

  // Least and greatest radius of what is drawn around a pin, in details.
  const COIL = [0.75, 1.4];

  // A coil round a pin, which winds up with the angle between the bodies.
  const coil = (pen, [x, y], from, to, px) => {
    const sweep = 4 * Math.PI + Math.atan2(Math.sin(to - from), Math.cos(to - from));
    pen.beginPath();
    for (let k = 0; k <= 60; k++) {
      const radius = px * (COIL[0] + (COIL[1] - COIL[0]) * k / 60), angle = -from - sweep * k / 60;
      pen.lineTo(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
    }
    pen.stroke();
  };

  // A damper bent round a pin, from the angle of a body on.
  const roundDashpot = (pen, [x, y], from, px) => {
    const bent = (s, d) => {
      const radius = px * ((COIL[0] + COIL[1]) / 2 + d * (COIL[1] - COIL[0]) / 2), angle = -from - s * 1.6 * Math.PI;
      return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
    };
    for (const stroke of DASHPOT) {
      const points = [bent(...stroke[0])];
      for (let k = 1; k < stroke.length; k++) for (let part = 1; part <= 16; part++) {
        points.push(bent(...[0, 1].map((i) => stroke[k - 1][i] + part / 16 * (stroke[k][i] - stroke[k - 1][i]))));
      }
      path(pen, points); pen.stroke();
    }
  };

  // A strip of length along an axis, round or square at its ends.
  const strip = (pen, centre, u, half, high, rounded) => {
    const n = [-u[1], u[0]];
    pen.beginPath();
    if (rounded) {
      const angle = Math.atan2(u[1], u[0]);
      pen.arc(centre[0] + u[0] * half, centre[1] + u[1] * half, high, angle - Math.PI / 2, angle + Math.PI / 2);
      pen.arc(centre[0] - u[0] * half, centre[1] - u[1] * half, high, angle + Math.PI / 2, angle + 1.5 * Math.PI);
    } else {
      for (const [s, d] of [[half, high], [half, -high], [-half, -high], [-half, high]]) {
        pen.lineTo(centre[0] + u[0] * s + n[0] * d, centre[1] + u[1] * s + n[1] * d);
      }
    }
    pen.closePath();
  };

  const wheel = (pen, colours, centre, angle, radius, px, internal) => {
    const teeth = Math.min(Math.max(Math.round(2 * Math.PI * radius / (px * 1.3)), 8), 240), deep = px * 0.28;
    pen.beginPath();
    for (let k = 0; k < teeth; k++) {
      for (const [part, out] of [[0, -1], [0.3, -1], [0.45, 1], [0.85, 1]]) {
        const turned = -angle + 2 * Math.PI * (k + part) / teeth;
        const r = radius + out * deep;
        pen.lineTo(centre[0] + r * Math.cos(turned), centre[1] + r * Math.sin(turned));
      }
    }
    pen.closePath();
    if (internal) pen.arc(...centre, radius + px, 0, 2 * Math.PI, true);
    pen.globalAlpha = 0.45;
    pen.fillStyle = colours.fill;
    pen.fill("evenodd");
    pen.globalAlpha = 1;
    pen.lineWidth = 1.3;
    pen.strokeStyle = colours.line;
    pen.stroke();
    if (internal) return;
    // Spokes show how it turns.
    pen.setLineDash([px * 0.6, px * 0.4]);
    pen.globalAlpha = 0.6;
    for (let k = 0; k < 2; k++) {
      const turned = -angle + k * Math.PI / 2, [c, s] = [Math.cos(turned), Math.sin(turned)].map((v) => v * (radius - 2 * deep));
      path(pen, [[centre[0] - c, centre[1] - s], [centre[0] + c, centre[1] + s]]);
      pen.stroke();
    }
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  };

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

    // Behind all: wheels, guides.
    for (const { between, gear } of mechanism.joints) {
      if (!gear) continue;
      const bigger = gear.radii[0] > gear.radii[1] ? 0 : 1;
      between.forEach((end, k) => {
        const pose = shapes.pose(end[0], row), centre = at(end);
        if (pose && centre) wheel(pen, colours.body(end[0]), centre, pose[2], gear.radii[k] * scale, px, gear.internal && k === bigger);
      });
    }
    mechanism.joints.forEach((joint, k) => {
      if (!joint.axis) return;
      const [first, second] = joint.between, a = at(first), b = at(second), u = direction(first[0], joint.axis);
      if (!a || !b || !u) return;
      const [low, high] = shapes.strokes[k].map((s) => s * scale), middle = (low + high) / 2;
      const centre = [a[0] + u[0] * middle, a[1] + u[1] * middle];
      const half = (high - low) / 2 + px * (joint.type === "slot" ? 0.5 : 2.4), wide = px * 0.95;
      const colours1 = colours.body(first[0]);
      pen.strokeStyle = colours1.line;
      pen.lineWidth = 1.5;
      if (joint.type === "slot") {
        strip(pen, centre, u, half, px * 1.25, true); pen.fillStyle = colours1.fill; pen.fill(); pen.stroke();
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
    mechanism.bodies.forEach(({ name, points }, k) => {
      const outline = shapes.outlines[k];
      if (k === 0 || outline.length === 0) return;
      const corners = outline.map((number) => at([k, number]));
      if (!corners.every(Boolean)) return;
      const { fill, line } = colours.body(k);
      const closed = corners.length > 2;
      path(pen, corners.length > 1 ? corners : [corners[0], corners[0]], closed);
      pen.strokeStyle = line; pen.lineWidth = px * 1.1 + 2.6; pen.stroke();
      pen.strokeStyle = fill; pen.lineWidth = px * 1.1; pen.stroke();
      if (closed) { pen.fillStyle = fill; pen.fill(); }
      const middle = corners.reduce(([x, y], c) => [x + c[0] / corners.length, y + c[1] / corners.length], [0, 0]);
      names.push({ text: name, at: middle, colour: line, strong: true });
      if (show.points) for (let number = 0; number < points.length; number++) {
        const p = at([k, number]);
        names.push({ text: points[number][0], at: p, colour: colours.muted });
        pen.fillStyle = line; pen.beginPath(); pen.arc(...p, 2.4, 0, 7); pen.fill();
      }
    });

    // Blocks on guides.
    for (const joint of mechanism.joints) {
      if (joint.type !== "prismatic" || !joint.axis) continue;
      const [first, second] = joint.between, b = at(second), u = direction(first[0], joint.axis);
      if (!b || !u) continue;
      const { fill, line } = colours.body(second[0]);
      strip(pen, b, u, px * 1.7, px * 0.95, false);
      pen.fillStyle = fill; pen.fill();
      pen.strokeStyle = line; pen.lineWidth = 1.8; pen.stroke();
      if (second[0] === 0) { const n = [-u[1], u[0]], d = px * 0.95; hatch(pen, [b[0] - u[0] * d * 1.8 + n[0] * d, b[1] - u[1] * d * 1.8 + n[1] * d], [b[0] + u[0] * d * 1.8 + n[0] * d, b[1] + u[1] * d * 1.8 + n[1] * d], 1, px * 0.8); }
    }

    // Pivots on the ground, pins, welds.
    for (const joint of mechanism.joints) {
      const [a, b] = joint.between.map(at);
      if (!a || !b) continue;
      const grounded = joint.between.some(([number]) => number === 0), pin = joint.between[0][0] === 0 ? a : b;
      pen.strokeStyle = colours.ground; pen.lineWidth = 1.5;
      if (grounded && (joint.type === "revolute" || joint.type === "fixed")) support(pen, colours, pin, px);
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
      } else if (joint.type === "fixed") {
        pen.fillStyle = colours.steel; pen.fillRect(b[0] - px * 0.45, b[1] - px * 0.45, px * 0.9, px * 0.9);
      }
      if (show.joints && joint.type !== "gear") names.push({ text: joint.name, at: b, colour: colours.ink, beside: px });
    }

    // Springs.
    pen.strokeStyle = colours.ink; pen.lineWidth = 1.5;
    for (const { between, damper, name } of mechanism.springs) {
      const [a, b] = between.map(at);
      if (!a || !b) continue;
      for (const [k, end] of [a, b].entries()) {
        pen.beginPath(); pen.arc(...end, 2.6, 0, 7); pen.fillStyle = colours.ink; pen.fill();
        const onGround = between[k][0] === 0 && !mechanism.joints.some((joint) => joint.between.some(([body, number]) => body === 0 && number === between[k][1]));
        if (onGround) hatch(pen, [end[0] + px, end[1] + 3], [end[0] - px, end[1] + 3], -1, px * 0.6);
      }
      spring(pen, a, b, px, damper);
      if (show.joints) names.push({ text: name, at: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], colour: colours.ink, beside: px });
    }
    // Where something turns: around a pin, else at a body.
    const around = (pin, number) => pin === undefined ? at([number, 0]) : at(mechanism.joints[pin].between[1]);
    for (const { bodies, pin, damper } of mechanism.torsion_springs) {
      const where = around(pin, bodies.find((number) => number > 0));
      const [first, second] = bodies.map((number) => shapes.pose(number, row));
      if (!where || !first || !second) continue;
      if (damper) roundDashpot(pen, where, second[2], px); else coil(pen, where, first[2], second[2], px);
    }

    // Centres of mass: a quartered disc.
    if (show.centres) mechanism.bodies.forEach(({ com }, k) => {
      const pose = shapes.pose(k, row);
      if (k === 0 || !com || !pose) return;
      const c = to(shapes.carry(pose, ...com)), r = px * 0.42;
      pen.fillStyle = colours.card; pen.strokeStyle = colours.ink; pen.lineWidth = 1.2;
      pen.beginPath(); pen.arc(...c, r, 0, 7); pen.fill(); pen.stroke();
      pen.fillStyle = colours.ink;
      for (const start of [0, Math.PI]) { pen.beginPath(); pen.moveTo(...c); pen.arc(...c, r, start, start + Math.PI / 2); pen.fill(); }
    });

    // Drivers: an arrow round the pin, or along the guide.
    if (show.drivers) for (const driver of mechanism.drivers) {
      pen.strokeStyle = pen.fillStyle = colours.accent;
      if (driver.type === "translation") {
        const { between, axis } = mechanism.joints[driver.joint], b = at(between[1]), u = direction(between[0][0], axis);
        if (b && u) arrow(pen, ...[-2, 2].map((far) => [b[0] + (u[0] * far + u[1] * 1.9) * px, b[1] + (u[1] * far - u[0] * 1.9) * px]), 2, px);
        continue;
      }
      const centre = around(driver.pin, driver.body);
      if (centre) round(pen, centre, px * 1.8, true, 2);
    }
    return names;
  };

  linkdyn.drawing = { palette, draw, arrow, round, path, colour };
})();

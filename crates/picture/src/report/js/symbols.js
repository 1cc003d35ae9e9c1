"use strict";
// The signs of joints, springs, drivers and loads, as engineers draw them. Places in pixels; `px` is the size of a detail.
(() => {
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

  // A zigzag, a dashpot, or both side by side between two bars.
  const spring = (pen, a, b, px, damper, damped) => {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (length < 1) return;
    const u = [(b[0] - a[0]) / length, (b[1] - a[1]) / length], n = [-u[1], u[0]];
    const at = (s, d) => [a[0] + u[0] * s + n[0] * d, a[1] + u[1] * s + n[1] * d];
    const [start, end] = [length * 0.15, length * 0.85], wide = px * 0.8, aside = damped ? px * 1.15 : 0;
    const dashpot = (from, to, d) => { for (const stroke of DASHPOT) { path(pen, stroke.map(([s, across]) => at(from + s * (to - from), d + across * wide))); pen.stroke(); } };
    if (damper) { dashpot(0, length, 0); return; }
    const points = [at(start, -aside)];
    for (let k = 0; k < 14; k++) points.push(at(start + (end - start) * (k + 0.5) / 14, -aside + (k % 2 ? -1 : 1) * wide));
    points.push(at(end, -aside));
    if (!damped) { path(pen, [a, ...points, b]); pen.stroke(); return; }
    path(pen, points); pen.stroke();
    dashpot(start, end, aside);
    for (const [foot, bar] of [[a, start], [b, end]]) { path(pen, [foot, at(bar, 0)]); pen.stroke(); path(pen, [at(bar, -aside), at(bar, aside)]); pen.stroke(); }
  };

  // A cylinder from its base on: barrel, piston, rod. Distances along the axis `u` in pixels.
  const cylinder = (pen, colours, origin, u, { base, end, piston, tip }, px) => {
    const n = [-u[1], u[0]], at = (s, d) => [origin[0] + u[0] * s + n[0] * d, origin[1] + u[1] * s + n[1] * d];
    const box = (from, to, high) => path(pen, [at(from, high), at(to, high), at(to, -high), at(from, -high)], true);
    const wide = px * 1.15, rod = px * 0.38;
    box(piston, tip, rod); pen.fillStyle = colours.second.fill; pen.fill(); pen.strokeStyle = colours.second.line; pen.lineWidth = 1.3; pen.stroke();
    box(base, end, wide); pen.globalAlpha = 0.55; pen.fillStyle = colours.first.fill; pen.fill(); pen.globalAlpha = 1;
    pen.strokeStyle = colours.first.line; pen.lineWidth = 1.6; pen.stroke();
    box(piston - px * 0.35, piston + px * 0.35, wide - 1.5); pen.fillStyle = colours.second.line; pen.fill();
  };

  // Least and greatest radius of what is drawn around a pin, and how far the legs of a coil reach, in details.
  const COIL = [0.8, 1.6], LEGS = 2.7;

  // A coil round a pin, which winds up with the angle between the bodies, with a leg along each of them.
  const coil = (pen, [x, y], from, to, px) => {
    const sweep = 4 * Math.PI + Math.atan2(Math.sin(to - from), Math.cos(to - from));
    pen.beginPath();
    for (let k = 0; k <= 60; k++) {
      const radius = px * (COIL[0] + (COIL[1] - COIL[0]) * k / 60), angle = -from - sweep * k / 60;
      pen.lineTo(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
    }
    pen.stroke();
    for (const [k, angle] of [-from, -from - sweep].entries()) {
      path(pen, [COIL[k], LEGS].map((radius) => [x + px * radius * Math.cos(angle), y + px * radius * Math.sin(angle)]));
      pen.stroke();
    }
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

  const toothCount = (radius, px) => Math.min(Math.max(Math.round(2 * Math.PI * radius / (px * 1.3)), 8), 240);
  const wheel = (pen, colours, centre, angle, radius, px, internal) => {
    const teeth = toothCount(radius, px), deep = px * 0.28;
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

  // A pulley, and the belt around two of them; strands touch both circles.
  const pulley = (pen, colours, centre, angle, radius, px) => {
    pen.beginPath(); pen.arc(...centre, radius, 0, 2 * Math.PI);
    pen.globalAlpha = 0.45; pen.fillStyle = colours.fill; pen.fill(); pen.globalAlpha = 1;
    pen.lineWidth = 1.3; pen.strokeStyle = colours.line; pen.stroke();
    pen.setLineDash([px * 0.6, px * 0.4]);
    pen.globalAlpha = 0.6;
    for (let k = 0; k < 2; k++) {
      const turned = -angle + k * Math.PI / 2, [c, s] = [Math.cos(turned), Math.sin(turned)].map((v) => v * radius);
      path(pen, [[centre[0] - c, centre[1] - s], [centre[0] + c, centre[1] + s]]);
      pen.stroke();
    }
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  };
  const belt = (pen, [first, second], [one, two], crossed, px) => {
    const [x, y] = [second[0] - first[0], second[1] - first[1]], sin = (one + (crossed ? two : -two)) / Math.hypot(x, y);
    if (!(Math.abs(sin) < 1)) return;
    const line = Math.atan2(y, x), leave = Math.PI / 2 - Math.asin(sin), meet = crossed ? Math.PI - leave : leave;
    pen.beginPath();
    pen.arc(...first, one, line + leave, line - leave + 2 * Math.PI);
    pen.arc(...second, two, line + (crossed ? meet : -meet), line + (crossed ? -meet : meet), crossed);
    pen.closePath();
    pen.lineWidth = px * 0.3; pen.stroke();
  };
  // Teeth of a rack along `u` from `back` to `forth` of the point where its wheel rolls, `n` towards the wheel's centre: a tip where the
  // wheel has its root.
  const rack = (pen, colours, centre, angle, radius, u, n, [back, forth], px) => {
    const teeth = toothCount(radius, px), pitch = 2 * Math.PI * radius / teeth, deep = px * 0.28;
    const part = (Math.atan2(-n[1], -n[0]) + angle) * teeth / (2 * Math.PI), side = Math.sign(-n[0] * u[1] + n[1] * u[0]);
    const ends = [back, forth].map((far) => part + side * far / pitch), first = Math.floor(Math.min(...ends));
    const last = Math.min(Math.ceil(Math.max(...ends)), first + 500);
    const at = (along, across) => [0, 1].map((k) => centre[k] + along * u[k] + (across - radius) * n[k]);
    const outline = [];
    for (let k = first; k < last; k++) {
      for (const [of, out] of [[0, 1], [0.3, 1], [0.45, -1], [0.85, -1]]) outline.push(at(side * (k + of - part) * pitch, out * deep));
    }
    if (outline.length === 0) return;
    outline.push(at(side * (last - 0.15 - part) * pitch, -px), at(side * (first - part) * pitch, -px));
    path(pen, outline, true);
    pen.globalAlpha = 0.45; pen.fillStyle = colours.fill; pen.fill(); pen.globalAlpha = 1;
    pen.lineWidth = 1.3; pen.strokeStyle = colours.line; pen.stroke();
  };

  linkdyn.symbols = { path, hatch, disc, support, arrow, round, spring, coil, roundDashpot, strip, wheel, rack, pulley, belt, cylinder };
})();

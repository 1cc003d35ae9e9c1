"use strict";
// Where things are: bodies, points, guides, in metres and global axes.
// Measured again where another mechanism is shown.
linkdyn.measureShapes = () => {
  const { mechanism, rows, column } = linkdyn;

  // Directions of guides have length one here.
  for (const joint of mechanism.joints) {
    const long = joint.axis ? Math.hypot(...joint.axis) : 0;
    joint.axis = long > 0 ? joint.axis.map((part) => part / long) : undefined;
  }

  const poses = mechanism.bodies.map(({ name }, k) => {
    if (k === 0) return null;
    const found = ["x", "y", "angle"].map((quantity) => column(`${name}.${quantity}`));
    return found.every(Boolean) ? found.map((found) => found.values) : undefined;
  });
  // Whether the poses are in the page at all.
  const known = mechanism.bodies.length > 1 && poses.slice(1).every(Boolean);

  // Pose of a body in a row; none where the cells are empty.
  const pose = (body, row) => {
    if (body === 0) return [0, 0, 0];
    const of = poses[body];
    if (!of || row >= rows) return null;
    const found = [of[0][row], of[1][row], of[2][row]];
    return found.every(Number.isFinite) ? found : null;
  };

  const carry = ([x, y, angle], px, py) => {
    const c = Math.cos(angle), s = Math.sin(angle);
    return [x + c * px - s * py, y + s * px + c * py];
  };
  const turn = ([, , angle], vx, vy) => carry([0, 0, angle], vx, vy);

  // A point (body, number) in a row.
  const place = ([body, number], row) => {
    const at = pose(body, row);
    const point = mechanism.bodies[body].points[number];
    return at && point ? carry(at, point[1], point[2]) : null;
  };

  // Corners of the convex hull, numbers of points; one or two where there is no more.
  const hull = (points) => {
    const order = points.map((_, k) => k).sort((a, b) => points[a][0] - points[b][0] || points[a][1] - points[b][1]);
    const cross = (o, a, b) => (points[a][0] - points[o][0]) * (points[b][1] - points[o][1])
      - (points[a][1] - points[o][1]) * (points[b][0] - points[o][0]);
    const half = (line) => {
      const chain = [];
      for (const k of line) {
        while (chain.length > 1 && cross(chain[chain.length - 2], chain[chain.length - 1], k) <= 0) chain.pop();
        chain.push(k);
      }
      return chain.slice(0, -1);
    };
    const same = order.every((k) => points[k][0] === points[order[0]][0] && points[k][1] === points[order[0]][1]);
    return points.length < 2 || same ? order.slice(0, 1) : [...half(order), ...half([...order].reverse())];
  };
  const outlines = mechanism.bodies.map(({ points }) => hull(points.map(([, x, y]) => [x, y])));

  // Some rows, enough to know how far things go.
  const sampled = [];
  const most = Math.max(5, Math.min(400, Math.floor(2e5 / mechanism.bodies.length)));
  for (let k = 0, step = Math.max(1, Math.ceil(rows / most)); k < rows; k += step) sampled.push(k);
  if (rows > 0 && sampled[sampled.length - 1] !== rows - 1) sampled.push(rows - 1);

  // Least and greatest place of the second point of a guide along its axis, of these and the ones that are there.
  const slides = (joint, low = Infinity, high = -Infinity) => {
    for (const row of sampled) {
      const [a, b] = joint.between.map((end) => place(end, row));
      const at = pose(joint.between[0][0], row);
      if (!a || !b || !at) continue;
      const u = turn(at, joint.axis[0], joint.axis[1]);
      const slide = u[0] * (b[0] - a[0]) + u[1] * (b[1] - a[1]);
      [low, high] = [Math.min(low, slide), Math.max(high, slide)];
    }
    return low > high ? [0, 0] : [low, high];
  };
  // How far guides reach; one on a body reaches to the body's point.
  // The way of a wheel along its rack is measured from the rack.
  const onRack = ({ between, rack }) => slides({ between: [between[1], between[0]], axis: rack.axis }, 0, 0);
  const strokes = mechanism.joints.map((joint) => joint.rack ? onRack(joint) : !joint.axis ? null : joint.between[0][0] === 0 ? slides(joint) : slides(joint, 0, 0));

  // A driven slide between moving bodies is a cylinder: where barrel and piston are along its axis, from the first and the second
  // point of the joint \[m\]. Bodies of which all points lie on the axis are drawn as part of it.
  const inCylinder = mechanism.bodies.map(() => false);
  const cylinders = mechanism.joints.map((joint, k) => {
    const driven = mechanism.drivers.some((driver) => driver.type === "translation" && driver.joint === k);
    const [[first, one], [second, other]] = joint.between;
    if (!driven || joint.type !== "prismatic" || !joint.axis || first === 0 || second === 0 || !rows) return null;
    // Along the axis, in the frame of the first body; both bodies keep their angle to each other.
    const poses = sampled.map((row) => [pose(first, row), pose(second, row)]).find(([a, b]) => a && b);
    if (!poses) return null;
    const u = turn(poses[0], ...joint.axis);
    const along = (body, origin, held) => mechanism.bodies[body].points.map(([, x, y]) => {
      const from = mechanism.bodies[body].points[origin], [dx, dy] = turn(held, x - from[1], y - from[2]);
      return [dx * u[0] + dy * u[1], Math.abs(dy * u[0] - dx * u[1])];
    });
    const [barrel, rod] = [along(first, one, poses[0]), along(second, other, poses[1])];
    const ends = (list) => [Math.min(...list.map(([s]) => s)), Math.max(...list.map(([s]) => s))];
    const [low, high] = slides(joint);
    const [base] = ends(barrel);
    let [piston, tip] = ends(rod);
    const stroke = Math.max(high - low, 1e-9), thick = 0.06 * stroke + 0.02 * Math.abs(low - base);
    // A rod of which only the tip is a point reaches so far back that the piston stays in a barrel that the tip stays out of.
    if (tip - piston < 0.5 * stroke) piston = tip - stroke - 3 * thick;
    const start = Math.min(base, low + piston - thick), end = high + piston + thick;
    const slim = (list) => list.every(([, off]) => off < 1e-6 * (1 + Math.abs(high)));
    if (slim(barrel)) inCylinder[first] = true;
    if (slim(rod)) inCylinder[second] = true;
    return { base: start, end, piston, tip };
  });

  // An actuator is a cylinder from its first point to its second: where its barrel ends, and how far the piston is from the tip \[m\].
  const actuators = mechanism.springs.map(({ between, actuator }) => {
    if (!actuator) return null;
    let [low, high] = [Infinity, 0];
    for (const row of sampled) {
      const [a, b] = between.map((end) => place(end, row));
      if (!a || !b) continue;
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      [low, high] = [Math.min(low, length), Math.max(high, length)];
    }
    if (!(low <= high)) return null;
    const stroke = high - low, end = Math.min(Math.max(stroke + 0.24 * low, 0.55 * low), 0.92 * low);
    return { end, rod: low - (end - stroke) / 2 };
  });

  // The box in which everything stays.
  const box = (() => {
    let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
    const add = (point, margin = 0) => {
      if (!point) return;
      left = Math.min(left, point[0] - margin); right = Math.max(right, point[0] + margin);
      bottom = Math.min(bottom, point[1] - margin); top = Math.max(top, point[1] + margin);
    };
    mechanism.bodies.forEach(({ points }, body) => {
      const used = body === 0 ? [0] : sampled;
      for (const row of used) points.forEach((_, k) => add(place([body, k], row)));
      if (points.length === 0 && body > 0) for (const row of sampled) { const at = pose(body, row); if (at) add(at); }
    });
    // Outlines of what moves, and tips; lines on the ground may be as long as they like.
    for (const { between, outlines, radius } of mechanism.joints) {
      if (outlines) for (const row of sampled) {
        const at = pose(between[0][0], row);
        if (at && between[0][0] > 0) for (const outline of outlines) outline.forEach((corner) => add(carry(at, ...corner)));
        add(place(between[1], row), radius);
      }
    }
    for (const { between, gear, outline, roller, reach, rack, belt } of mechanism.joints) {
      if (outline) for (const row of sampled) add(place(between[0], row), Math.min(Math.max(0, ...outline.map(([x, y]) => Math.hypot(x, y))), 1e6));
      if (outline) for (const row of sampled) add(place(between[1], row), Math.min(roller || reach || 0, 1e6));
      if (belt) for (const row of sampled) between.forEach((end, k) => add(place(end, row), Math.min(belt.radii[k], 1e6)));
      if (rack) for (const row of sampled) add(place(between[0], row), Math.min(Math.abs(rack.radius), 1e6));
      if (gear) for (const row of sampled) between.forEach((end, k) => add(place(end, row), Math.min(gear.radii[k], 1e6)));
    }
    if (!Number.isFinite(left)) return [-0.1, 0.1, -0.1, 0.1];
    const least = 1e-6 + 0.15 * Math.max(right - left, top - bottom);
    const widen = (low, high) => high - low < least ? [(low + high - least) / 2, (low + high + least) / 2] : [low, high];
    return [...widen(left, right), ...widen(bottom, top)];
  })();

  return { known, pose, place, carry, turn, outlines, strokes, cylinders, inCylinder, actuators, box };
};
linkdyn.shapes = linkdyn.measureShapes();

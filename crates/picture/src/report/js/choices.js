"use strict";
// Which columns are worth a plot, and which come first: declared points, then driving torques and forces, the largest forces, speeds.
(() => {
  const { columns, byName, mechanism, summary, endsOf } = linkdyn;
  const MOST = 4;
  const shown = columns.filter((column) => column.wanted && column.name !== "time");
  const ending = (pattern, filter = () => true) => shown.filter((column) => pattern.test(column.name) && filter(column));

  // The largest size of a column, and of all columns of its unit: what is tiny compared with them is round-off.
  const size = (column) => Math.max(0, ...endsOf(column).filter(Number.isFinite).map(Math.abs));
  const ofUnit = new Map();
  const weigh = () => { ofUnit.clear(); for (const column of columns) ofUnit.set(column.unit, Math.max(ofUnit.get(column.unit) || 0, size(column))); };
  linkdyn.onData(weigh);
  weigh();
  const nothing = (value, unit) => Math.abs(value) <= 1e-11 * (ofUnit.get(unit) || 0);
  const lives = (column) => size(column) > 0 && !nothing(size(column), column.unit);
  // Round-off about zero varies by much of its own size, so it is compared with all columns of its unit, too.
  const varies = (column) => { const [low, high] = endsOf(column); return high - low > 1e-9 * size(column) && !nothing(high - low, column.unit) && high > low; };
  // Whether two curves of one unit need an axis each: on a common one the travel of one would be a line to the eye. That holds for
  // places and angles, whose zero is arbitrary; sizes of forces and speeds are compared on one axis.
  const LEAST_SHARE = 1 / 8, PLACES = ["m", "rad"];
  const apart = (columns) => {
    if (columns.length !== 2 || columns[0].unit !== columns[1].unit || !PLACES.includes(columns[0].unit) || !columns.every(varies)) return false;
    const [[a, b], [c, d]] = columns.map(endsOf);
    return Math.min(b - a, d - c) < LEAST_SHARE * (Math.max(b, d) - Math.min(a, c));
  };
  const largest = (list, most = MOST) => [...list].sort((a, b) => size(b) - size(a)).slice(0, most);

  // Of at most two units, at most six.
  const oneScale = (list) => {
    const alive = list.filter(lives), some = alive.length ? alive : list.filter(({ values }) => values.some(Number.isFinite));
    const kinds = [...new Set(some.map(({ unit }) => unit))].slice(0, 2);
    return some.filter(({ unit }) => kinds.includes(unit)).slice(0, 6);
  };

  const bodies = new Set(mechanism.bodies.map(({ name }) => name));
  const ofBody = (column) => bodies.has(column.name.split(".")[0]) && column.name.split(".").length === 2;
  const points = mechanism.points.map(([body, number]) => `${mechanism.bodies[body].name}.${mechanism.bodies[body].points[number][0]}`);
  const both = (name) => ["x", "y"].map((part) => byName.get(`${name}.${part}`)).filter((column) => column && column.wanted);

  const presets = [];
  const add = (title, list, first, across) => {
    const usable = across ? list.filter((column) => column && across) : oneScale(list);
    if (usable.length) presets.push({ title, list: usable, first, ...(across || {}) });
  };
  const dynamics = (summary.settings || {}).type === "dynamics", free = dynamics && !mechanism.drivers.length;

  // A laptop shows two plots at once: where the point goes that the mechanism is built for, and what the motor has to give for it.
  // How well the motion is passed on and what the joints carry follow; paths stand in the drawing already, and come last.
  const positions = (list) => list.forEach((name, k) => add(`Position of ${name}`, both(name).filter(varies), k < 1));
  positions(points.slice(0, 1));
  // Beside a body that goes round and round those that swing would be flat lines.
  const angles = (first = true) => {
    const found = ending(/\.angle$/, ofBody).filter(varies), round = found.filter((column) => { const [low, high] = endsOf(column); return high - low > 2.1 * Math.PI; });
    const swing = found.filter((column) => !round.includes(column));
    add("Angles of bodies", largest(swing), first);
    add("Angles of bodies that rotate", largest(round), first && !swing.length);
  };
  add("Driving torques and forces", ending(/^driver\..*\.effort$/), true);
  add("Outputs", ending(/^output\./), true);
  add("Velocity ratio, mechanical advantage", ending(/^transmission\.(ratio|advantage)$/), true);
  add("Transmission angles", ending(/^transmission\..*\.angle$/), true);
  // Angles describe best what moves by itself; where forces drive it, the forces in joints do.
  const isDriven = mechanism.loads.length > 0;
  if (free && !isDriven) angles();
  add("Largest joint forces", largest(ending(/^joint\..*\.f$/)), true);
  if (free && isDriven) angles();
  add("Largest stresses in links", largest(ending(/^section\..*\.stress$/)), true);
  add("Largest bending moments in links", largest(ending(/^section\..*\.bending_moment$/)), false);
  add("Contact forces", ending(/^joint\..*\.normal_force$/), dynamics);
  add("Lengths of springs and actuators", ending(/^force\..*\.length$/), true);
  positions(points.slice(1));
  points.forEach((name, k) => { const [x, y] = both(name); if (x && y && varies(x) && varies(y)) add(`Path of ${name}`, [y], k < 1, { across: x, equal: true }); });
  add("Angular velocities", largest(ending(/\.omega$/, ofBody).filter(varies)), true);
  if (free) for (const angle of ending(/\.angle$/, ofBody).filter(varies).slice(0, 2)) {
    const omega = byName.get(angle.name.replace(/angle$/, "omega"));
    if (omega && omega.wanted) add(`Phase plane of ${angle.name.slice(0, -6)}`, [omega], presets.every(({ title }) => !title.startsWith("Phase")), { across: angle });
  }
  add("Energies", ending(/^energy\./), dynamics);
  add("Eccentricities", ending(/^joint\..*\.eccentricity$/), dynamics);
  add("Shaking force", ending(/^shaking\.(fx|fy|f)$/), !dynamics);
  add("Applied forces", ending(/^force\..*\.(f|torque)$/).filter(varies), !dynamics);
  if (!free) angles(!ending(/^driver\..*\.effort$|^joint\..*\.f$/).length);
  add("Angular accelerations", largest(ending(/\.alpha$/, ofBody)), false);
  add("Slides and angles of joints", ending(/^joint\..*\.(slide|angle)$/), false);
  add("Powers of forces", ending(/^force\..*\.power$/), false);
  add("Shaking moment", ending(/^shaking\.moment$/), false);
  for (const ex of ending(/^joint\..*\.ex$/).slice(0, 8)) {
    const ey = byName.get(ex.name.replace(/x$/, "y"));
    if (ey && ey.wanted && (lives(ex) || lives(ey))) add(`Orbit in ${ex.name.slice(6, -3)}`, [ey], false, { across: ex, equal: true });
  }
  add("Penetrations", ending(/^joint\..*\.penetration$/), false);
  add("Friction in contacts", ending(/^joint\..*\.tangential_force$/), false);

  const MOST_FIRST = 8;
  const first = presets.filter(({ first }) => first).slice(0, MOST_FIRST);
  // A value as text; what is round-off compared with others of its unit is zero.
  const textOf = (column, row, digits, isBesideAxis) => {
    const value = column.values[row];
    return linkdyn.units.quantity(nothing(value, column.unit) ? 0 : value, column.unit, digits, isBesideAxis);
  };
  linkdyn.textOf = textOf;
  linkdyn.choices = { shown, presets, first, oneScale, largest, size, nothing, lives, varies, apart };
})();

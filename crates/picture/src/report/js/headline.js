"use strict";
// The numbers that a reader looks for first: effort, largest forces, strokes, speeds, contacts.
(() => {
  const { mechanism, summary, columns, shapes, units, column, choices, plain, endRows, endsOf } = linkdyn;
  const bodies = new Set(mechanism.bodies.map(({ name }) => name));
  const MOST = 4;

  // When a column has no bound, where it has none: it has no largest value then, whatever its rows show.
  const bounds = new Map();
  const bound = () => {
    for (const { columns: names, times } of summary.unbounded || []) for (const name of names) if (!bounds.has(name)) bounds.set(name, Math.min(...times));
  };
  const unbounded = ({ name }) => {
    const size = /^(joint\..*)\.f$/.exec(name), of = size ? [`${size[1]}.fx`, `${size[1]}.fy`] : [name];
    const found = of.filter((part) => bounds.has(part)).map((part) => bounds.get(part));
    return found.length ? Math.min(...found) : undefined;
  };
  // The row of the value of largest size.
  const peak = (column) => {
    const [low, high] = endRows(column);
    return low >= 0 && Math.abs(column.values[low]) > Math.abs(column.values[high]) ? low : high;
  };
  const range = (column) => { const [low, high] = endsOf(column); return high - low; };

  // Root of the mean square over time.
  const rms = ({ values }) => {
    let [sum, span] = [0, 0];
    for (let k = 1; k < linkdyn.rows; k++) {
      const step = linkdyn.time[k] - linkdyn.time[k - 1], mean = (values[k] ** 2 + values[k - 1] ** 2) / 2;
      if (Number.isFinite(mean)) { sum += mean * step; span += step; }
    }
    return span > 0 ? Math.sqrt(sum / span) : NaN;
  };

  // How far a block or pin goes along its guide.
  const stroke = ({ between, axis }) => {
    let [low, high] = [Infinity, -Infinity];
    for (let row = 0, step = Math.max(1, Math.ceil(linkdyn.rows / 2000)); row < linkdyn.rows; row += step) {
      const pose = shapes.pose(between[0][0], row), [a, b] = between.map((end) => shapes.place(end, row));
      if (!pose || !a || !b) continue;
      const u = shapes.turn(pose, ...axis), slide = u[0] * (b[0] - a[0]) + u[1] * (b[1] - a[1]);
      low = Math.min(low, slide); high = Math.max(high, slide);
    }
    return high - low;
  };

  // [what, of what, SI value, unit, row], or when it has no bound instead of a value.
  const list = [];
  const put = (what, name, value, unit, row, column) => { if (Number.isFinite(value)) list.push({ what, name: plain(name), value: choices.nothing(value, unit) ? 0 : value, unit, row, column }); };
  const at = (what, name, found, row = peak(found)) => { if (row >= 0) put(what, name, found.values[row], found.unit, row, found); };
  const largest = (what, name, found) => { const time = unbounded(found); if (time === undefined) at(what, name, found); else list.push({ what, name: plain(name), unbounded: time, column: found }); };
  const wanted = (name) => { const found = column(name); return found && found.wanted ? found : undefined; };
  const speed = (vx, vy) => {
    let best = -1, most = -1;
    for (let k = 0; k < linkdyn.rows; k++) { const v = Math.hypot(vx.values[k], vy.values[k]); if (v > most) [best, most] = [k, v]; }
    return [most, best];
  };

  const collect = () => {
    for (const { name } of mechanism.drivers.slice(0, MOST)) {
      const effort = wanted(`driver.${name}.effort`);
      if (!effort) continue;
      const kind = effort.unit === "N" ? "driving force" : "driving torque";
      largest(`Peak ${kind} of`, name, effort);
      if (linkdyn.rows > 2) put(`RMS ${kind} of`, name, rms(effort), effort.unit);
    }
    const forces = columns.filter(({ name, wanted }) => wanted && /^joint\..*\.f$/.test(name));
    // Those without bound would leave no room for those that have a largest value.
    const [bounded, others] = [true, false].map((has) => forces.filter((found) => (unbounded(found) === undefined) === has));
    for (const found of [others, bounded].flatMap((some) => choices.largest(some, MOST)).filter(choices.lives)) largest("Largest force in", found.name.slice(6, -2), found);
    for (const key of ["ratio", "advantage"]) {
      const found = wanted(`transmission.${key}`), word = key === "ratio" ? "Velocity ratio" : "Mechanical advantage";
      if (found && endRows(found)[0] >= 0) for (const [k, size] of ["smallest", "largest"].entries()) at(`${word}, ${size}`, "", found, endRows(found)[k]);
    }
    for (const found of columns.filter(({ name, wanted }) => wanted && /^transmission\..*\.angle$/.test(name)).slice(0, MOST)) at("Smallest transmission angle at", found.name.slice(13, -6), found, endRows(found)[0]);
    if (linkdyn.rows < 2) return;
    for (const joint of mechanism.joints.filter(({ axis }) => axis).slice(0, MOST)) put("Stroke of", joint.name, stroke(joint), "m");
    const angles = columns.filter(({ name, wanted }) => wanted && name.endsWith(".angle") && bodies.has(name.slice(0, -6)) && name.split(".").length === 2);
    for (const found of angles.filter((found) => choices.varies(found) && range(found) < 2 * Math.PI).slice(0, MOST)) put("Swing of", found.name.slice(0, -6), range(found), "rad");
    for (const [body, number] of mechanism.points.slice(0, MOST)) {
      const name = `${mechanism.bodies[body].name}.${mechanism.bodies[body].points[number][0]}`;
      const [x, y, vx, vy] = ["x", "y", "vx", "vy"].map((key) => wanted(`${name}.${key}`));
      if (x) put("Horizontal travel of", name, range(x), "m");
      if (y) put("Vertical travel of", name, range(y), "m");
      if (vx && vy) { const [most, row] = speed(vx, vy); put("Highest speed of", name, most, vx.unit, row, vx); }
    }
    const omegas = columns.filter(({ name, wanted }) => wanted && name.endsWith(".omega") && bodies.has(name.slice(0, -6)));
    for (const found of choices.largest(omegas, 2).filter(choices.lives)) at("Highest angular velocity of", found.name.slice(0, -6), found);
    for (const [joint, sums] of Object.entries(summary.clearances || {}).slice(0, MOST)) {
      const depth = wanted(`joint.${joint}.penetration`);
      if (depth) at("Deepest penetration in", joint, depth, endRows(depth)[1]);
      put("Energy lost in contacts of", joint, sums.energy_lost, "J");
    }
  };
  const begin = () => { list.length = 0; if (linkdyn.rows) collect(); };
  linkdyn.onData(() => { bounds.clear(); bound(); });
  linkdyn.afterData(begin);
  bound();
  begin();
  linkdyn.headline = { list, unbounded };
})();

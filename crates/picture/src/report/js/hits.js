"use strict";
// What the cursor is on, in the drawing and in plots: a tip with its name and values; a click plots them.
(() => {
  const { mechanism, shapes, stage, plots, player, units, element, column, textOf, choices } = linkdyn;
  const tip = document.getElementById("tip"), { canvas } = stage;
  const NEAR = 11;

  const list = (owner, names) => names.map((name) => column(`${owner}.${name}`)).filter((found) => found && found.wanted);
  const length = (between, row) => { const [a, b] = between.map((end) => shapes.place(end, row)); return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : NaN; };

  // Things with a place: title, kind, columns to show, and those to plot.
  const joints = mechanism.joints.map(({ name, type, between, clearance, rims }) => ({
    name, kind: clearance ? `${type} with clearance` : type, at: (row) => shapes.place(between[1], row),
    columns: list(`joint.${name}`, ["angle", "omega", "slide", "rate", "f", "fx", "fy", "torque", "eccentricity", "penetration", "normal_force", "sliding_speed", "pressure_angle", "curvature"]),
    plot: clearance ? ["f", "eccentricity"] : ["f", "torque"], owner: `joint.${name}`, rims,
  })).filter(({ rims }) => !rims);
  const drivers = mechanism.drivers.map(({ name }) => ({ name, columns: list(`driver.${name}`, ["value", "effort"]), owner: `driver.${name}`, plot: ["effort"] }));
  const points = mechanism.points.map(([body, number]) => {
    const name = `${mechanism.bodies[body].name}.${mechanism.bodies[body].points[number][0]}`;
    return { name, kind: "point", at: (row) => shapes.place([body, number], row), columns: list(name, ["x", "y", "vx", "vy", "ax", "ay"]), owner: name, plot: ["x", "y"] };
  });
  const loads = mechanism.loads.map(({ name, at, body }) => ({
    name, kind: "load", at: (row) => shapes.place(at || [body, 0], row), columns: list(`force.${name}`, ["f", "fx", "fy", "torque", "power"]), owner: `force.${name}`, plot: ["f", "torque"],
  }));
  const springs = mechanism.springs.map(({ name, between, damper, damped, actuator, driven, cable }) => driven ? { name, kind: "driven length", between, ...drivers.find((driver) => driver.name === name) } : ({
    name, kind: cable ? "cable" : actuator ? "actuator" : damper ? "damper" : damped ? "spring and damper" : "spring", between,
    columns: list(`force.${name}`, ["length", "rate", "f", "fx", "fy", "power"]), plot: ["f", "length"], owner: `force.${name}`,
  }));
  const bodies = mechanism.bodies.map(({ name }, k) => ({ name, kind: "body", body: k, columns: k ? list(name, ["x", "y", "angle", "omega", "alpha"]) : [], owner: name, plot: ["angle", "omega"] }));
  // The tip of a joint shows the driver that turns or pushes it.
  mechanism.drivers.forEach((driver, k) => {
    if (driver.type === "length") return;
    const number = driver.type === "translation" ? driver.joint : driver.pin;
    const owner = number === undefined ? bodies[driver.body] : joints.find(({ name }) => name === mechanism.joints[number].name) || bodies[driver.body];
    if (owner) owner.driver = drivers[k];
  });

  const away = ([x, y], [ax, ay], [bx, by]) => {
    const [dx, dy] = [bx - ax, by - ay], long = dx * dx + dy * dy;
    const s = long > 0 ? Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / long, 0), 1) : 0;
    return Math.hypot(x - ax - s * dx, y - ay - s * dy);
  };
  const inside = ([x, y], corners) => {
    let odd = false;
    corners.forEach(([ax, ay], k) => {
      const [bx, by] = corners[(k + 1) % corners.length];
      if ((ay > y) !== (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) odd = !odd;
    });
    return odd;
  };

  // The thing at a place of the canvas: pins before loads and points, springs, bodies; of bodies the one on top.
  const find = (place) => {
    const { row } = player;
    let [best, least] = [null, NEAR];
    for (const thing of [...joints, ...points, ...loads]) {
      const at = thing.at(row);
      if (!at) continue;
      const [x, y] = stage.to(at), far = Math.hypot(x - place[0], y - place[1]);
      if (far < least - 0.5) [best, least] = [thing, far];
    }
    if (best) return best;
    for (const thing of springs) {
      const [a, b] = thing.between.map((end) => shapes.place(end, row));
      if (a && b && away(place, stage.to(a), stage.to(b)) < NEAR) return thing;
    }
    for (let k = bodies.length - 1; k > 0; k--) {
      const corners = shapes.hull(k, row);
      if (!corners.length || !corners.every(Boolean)) continue;
      const drawn = corners.map(stage.to);
      if (drawn.length > 2 && inside(place, drawn)) return bodies[k];
      if (drawn.some((corner, number) => away(place, corner, drawn[(number + 1) % drawn.length]) < 8)) return bodies[k];
    }
    return null;
  };

  const lines = (thing) => {
    // What is zero all along, as the torque of an ideal pin, is left out.
    const of = (owner, found) => found.filter((column) => !column.name.startsWith("joint.") || choices.lives(column)).map((column) => [column.name.slice(owner.length + 1), textOf(column, player.row)]);
    const all = of(thing.owner, thing.columns);
    if (thing.between) all.push(["length", units.quantity(length(thing.between, player.row), "m")]);
    if (thing.driver) all.push(...of(thing.driver.owner, thing.driver.columns).map(([name, value]) => [`${linkdyn.plain(thing.driver.name)} ${name}`, value]));
    return all;
  };
  const plotted = (thing) => [...list(thing.owner, thing.plot), ...(thing.driver ? list(thing.driver.owner, thing.driver.plot) : [])].filter(Boolean);

  // The tip stays inside the window, and beside what it is about: below it, or above.
  const show = (title, kind, rows, hint, x, y) => {
    tip.replaceChildren(element("p", {}, element("strong", { text: title, className: "text" }), " ", element("span", { text: kind, className: "muted" })),
      ...(rows.length ? [element("table", {}, element("tbody", {}, ...rows.map(([name, value]) => element("tr", {}, element("th", { text: name, scope: "row" }), element("td", { text: value, className: "number" })))))] : []),
      ...(hint ? [element("p", { text: hint, className: "hint" })] : []));
    tip.hidden = false;
    const { offsetWidth: wide, offsetHeight: tall } = tip;
    tip.style.left = `${Math.max(4, x + 16 + wide > innerWidth - 4 ? x - 16 - wide : x + 16)}px`;
    tip.style.top = `${Math.max(4, y + 14 + tall > innerHeight - 4 ? y - 14 - tall : y + 14)}px`;
  };
  const hide = () => { tip.hidden = true; };

  // Drawing.
  let over = null;
  const halo = (thing) => ({ pen, to, row, bar, colours }) => {
    const ring = (at, radius) => { pen.beginPath(); pen.arc(...to(at), radius, 0, 7); pen.stroke(); };
    pen.save();
    pen.strokeStyle = colours.accent; pen.lineWidth = 2.2;
    const at = thing.at && thing.at(row);
    if (at) ring(at, bar * 1.4);
    const corners = thing.between ? thing.between.map((end) => shapes.place(end, row)) : thing.body ? shapes.hull(thing.body, row) : [];
    if (corners.length && corners.every(Boolean)) { linkdyn.drawing.path(pen, corners.map(to), true); pen.stroke(); }
    pen.restore();
  };
  const set = (thing, event) => {
    if (thing !== over) { over = thing; canvas.classList.toggle("found", Boolean(thing)); stage.halo = thing ? halo(thing) : null; }
    if (thing) show(thing.name, thing.kind, lines(thing), [...(plotted(thing).length ? ["Click: plot"] : []), ...(path(thing) ? ["drag: move"] : [])].join(", "), event.clientX, event.clientY); else hide();
  };
  // Where a thing goes, of a body the point at a place; none where it stays.
  const path = (thing, place = null) => {
    let { at } = thing;
    if (thing.body) {
      const pose = shapes.pose(thing.body, player.row), [x, y] = place ? stage.from(place) : pose ?? [0, 0];
      if (!pose) return null;
      const own = shapes.turn([0, 0, -pose[2]], x - pose[0], y - pose[1]);
      at = (row) => { const now = shapes.pose(thing.body, row); return now && shapes.carry(now, ...own); };
    }
    const from = at?.(player.row), step = Math.max(1, Math.floor(linkdyn.rows / 50));
    if (!from) return null;
    for (let row = 0; row < linkdyn.rows; row += step) { const to = at(row); if (to && far(stage.to(to), stage.to(from)) > 2) return at; }
    return null;
  };
  const far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
  // The row from which on neither way leads nearer to the pointer: the motion is followed, so that where a path crosses itself it
  // stays on its branch. It goes on over what is as near, as where a point rests.
  const SLACK = 1.5;
  const nearest = (at, place) => {
    const away = (row) => { const to = at(row); return to ? far(stage.to(to), place) : Infinity; };
    let [best, least] = [player.row, away(player.row)];
    for (const by of [1, -1]) for (let row = player.row + by; row >= 0 && row < linkdyn.rows; row += by) {
      const now = away(row);
      if (now < least) [best, least] = [row, now]; else if (now > least + SLACK) break;
    }
    return best;
  };
  const lead = (place) => {
    const thing = linkdyn.rows && shapes.known ? find(place) : null, at = thing && path(thing, place);
    return at && ((to) => { hide(); player.pause(); player.seek(nearest(at, to)); });
  };
  stage.hold = lead;
  Object.assign(linkdyn, { find, lead });
  if (linkdyn.rows && shapes.known) {
    canvas.addEventListener("pointermove", (event) => { if (event.buttons === 0 || event.pointerType !== "mouse") set(stage.moving() ? null : find([event.offsetX, event.offsetY]), event); });
    canvas.addEventListener("pointerleave", (event) => set(null, event));
    canvas.addEventListener("click", (event) => {
      if (stage.moved) return;
      const thing = find([event.offsetX, event.offsetY]);
      if (thing) plot(thing);
      set(thing, event);
    });
  }

  // Its columns in a plot of their own, or the plot that has them.
  const plot = (thing) => {
    const wanted = choices.oneScale(plotted(thing));
    if (!wanted.length) return;
    const has = plots.list.find((other) => !other.across && wanted.every((column) => other.columns.includes(column)));
    plots.point(has || plots.open(wanted));
  };

  // Plots: the curve next to the cursor.
  plots.hover = (shown, event) => {
    const box = shown.u.over.getBoundingClientRect(), y = event.clientY - box.top, { row } = player;
    let [best, least] = [null, 40];
    shown.columns.forEach((column) => {
      const far = Math.abs(shown.u.valToPos(column.values[row] * units.of(column.unit).factor, shown.scale(column)) - y);
      if (far < least) [best, least] = [column, far];
    });
    const where = [["t", `${units.number(linkdyn.time[row], 5)} s`]];
    const { abscissa } = shown;
    if (abscissa.name !== "time") where.push([abscissa.label, units.quantity(abscissa.values[row], abscissa.unit)]);
    if (best) show(best.name, "", [["value", textOf(best, row, 5, true)], ...where], "", event.clientX, event.clientY); else hide();
  };
  plots.leave = hide;
  addEventListener("scroll", hide, { passive: true });
  player.onState(hide);
})();

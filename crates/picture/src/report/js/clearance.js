"use strict";
// Joints with clearance, magnified: bearing, journal, the orbit of its centre, the force on it, and where the bearing wears. The
// journal is drawn so that the radial clearance is a part of the bearing that can be seen.
(() => {
  const { mechanism, shapes, player, units, column, element, drawing, summary, textOf } = linkdyn;
  const SIZE = 250, BEARING = 88, GAP = 34, RIM = 9, WEAR = 18;
  const sums = summary.clearances || {};
  const insets = mechanism.joints
    .filter(({ clearance }) => clearance && clearance.radius > 0)
    .map(({ name, clearance, between }) => ({
      name, radius: clearance.radius, bearing: between[0][0],
      ...Object.fromEntries(["ex", "ey", "fx", "fy", "f", "eccentricity"].map((key) => [key, column(`joint.${name}.${key}`)])),
      wear: Object.hasOwn(sums, name) ? sums[name].wear : undefined,
      most: 0,
    }))
    .filter(({ ex, ey }) => ex && ey)
    .slice(0, 24);

  for (const inset of insets) {
    const fact = () => element("span", { className: "number" });
    inset.canvas = element("canvas", { role: "img", "aria-label": `Journal in the bearing of joint ${linkdyn.plain(inset.name)}` });
    inset.pen = drawing.prepare(inset.canvas, SIZE, SIZE);
    inset.value = element("span", { className: "number" });
    const total = (inset.wear || []).reduce((sum, part) => sum + part, 0);
    const lines = [["eccentricity", inset.value]];
    inset.force = element("span", { className: "number" });
    if (inset.f) lines.push(["force on the journal", inset.force], ["largest", inset.largest = fact()]);
    lines.push(["radial clearance", inset.gap = fact()]);
    if (total > 0) lines.push(["sliding work under load, for wear", inset.work = fact()]);
    const legend = element("div", { className: "legend" }, element("h2", { text: inset.name, className: "text" }),
      ...lines.map(([word, value]) => element("p", {}, element("span", { text: word, className: "muted" }), " ", value)));
    // What follows from the run.
    inset.read = () => {
      const joint = mechanism.joints.find((own) => own.name === inset.name);
      inset.radius = joint.clearance.radius;
      inset.orbit = null;
      inset.wear = Object.hasOwn(sums, inset.name) ? sums[inset.name].wear : undefined;
      inset.gap.textContent = units.length(inset.radius);
      if (inset.f) { inset.most = linkdyn.endsOf(inset.f)[1] || 0; inset.largest.textContent = units.quantity(inset.most, "N", 4); }
      if (inset.work) inset.work.textContent = units.quantity((inset.wear || []).reduce((sum, part) => sum + part, 0), "J", 4);
    };
    inset.read();
    document.getElementById("insets").append(element("figure", { className: "inset" }, inset.canvas, legend));
  }
  document.getElementById("clearance").hidden = insets.length === 0;

  // Sliding work by angle of the bearing, as bars outside the rim; they turn with the bearing.
  const wears = (pen, { wear, bearing }, row, colours) => {
    const pose = shapes.pose(bearing, row), most = wear && Math.max(...wear);
    if (!pose || !(most > 0)) return;
    const turn = 2 * Math.PI / wear.length;
    pen.fillStyle = colours.load;
    wear.forEach((part, k) => {
      const from = -(pose[2] + k * turn), to = -(pose[2] + (k + 1) * turn), inner = BEARING + RIM;
      pen.beginPath(); pen.arc(SIZE / 2, SIZE / 2, inner, from, to, true); pen.arc(SIZE / 2, SIZE / 2, inner + WEAR * part / most, to, from); pen.fill();
    });
  };

  const orbit = (inset, at) => {
    if (inset.orbit) return inset.orbit;
    const path = inset.orbit = new Path2D();
    let down = false;
    for (let k = 0; k < linkdyn.rows; k++) {
      const p = at(k);
      if (!p.every(Number.isFinite)) { down = false; continue; }
      if (down) path.lineTo(...p); else path.moveTo(...p);
      down = true;
    }
    return path;
  };

  const one = (inset, row, colours) => {
    const { pen, radius, ex, ey, fx, fy, most } = inset, middle = SIZE / 2;
    const at = (k) => [middle + ex.values[k] / radius * GAP, middle - ey.values[k] / radius * GAP];
    pen.clearRect(0, 0, SIZE, SIZE);
    pen.lineCap = pen.lineJoin = "round";
    wears(pen, inset, row, colours);
    pen.fillStyle = colours.line;
    pen.beginPath(); pen.arc(middle, middle, BEARING + RIM, 0, 2 * Math.PI); pen.arc(middle, middle, BEARING, 0, 2 * Math.PI, true); pen.fill("evenodd");
    pen.strokeStyle = colours.steel; pen.lineWidth = 1.4;
    pen.beginPath(); pen.arc(middle, middle, BEARING, 0, 7); pen.stroke();
    const e = Math.hypot(ex.values[row], ey.values[row]);
    if (Number.isFinite(e)) {
      // On the bearing, to the eye: contact.
      const touches = e > radius * (1 - 1e-6), colour = touches ? colours.force : colours.accent;
      pen.fillStyle = colour; pen.globalAlpha = 0.2;
      pen.beginPath(); pen.arc(...at(row), BEARING - GAP, 0, 7); pen.fill();
      pen.globalAlpha = 1; pen.strokeStyle = colour; pen.lineWidth = 1.6; pen.stroke();
    }
    // The circle on which the centre is while the journal touches.
    pen.strokeStyle = colours.muted; pen.lineWidth = 0.8; pen.setLineDash([2, 3]);
    pen.beginPath(); pen.arc(middle, middle, GAP, 0, 7); pen.stroke(); pen.setLineDash([]);
    pen.strokeStyle = colours.muted; pen.lineWidth = 1; pen.stroke(orbit(inset, at));
    const f = fx && fy ? [fx.values[row], fy.values[row]] : [0, 0], size = Math.hypot(...f);
    if (Number.isFinite(e) && size > 0 && most > 0) {
      // By the square root, so that small forces are visible next to impacts.
      const long = 24 + 60 * Math.sqrt(size / most), from = at(row);
      drawing.arrow(pen, from, [from[0] + f[0] / size * long, from[1] - f[1] / size * long], 7, colours.force);
    }
    if (Number.isFinite(e)) { pen.fillStyle = colours.ink; pen.beginPath(); pen.arc(...at(row), 3.2, 0, 7); pen.fill(); }
    inset.value.textContent = inset.eccentricity ? textOf(inset.eccentricity, row, 4) : units.quantity(e, "m", 4);
    if (inset.f) inset.force.textContent = textOf(inset.f, row, 4);
  };

  const draw = () => {
    if (!insets.length) return;
    const colours = drawing.palette(), { row } = player;
    for (const inset of insets) one(inset, row, colours);
  };

  // Beside the plots there is room below the mechanism; else they stand behind the plots.
  const wide = matchMedia("(min-width: 1100px), (min-width: 900px) and (orientation: landscape)"), section = document.getElementById("clearance");
  const settle = () => {
    if (wide.matches) document.getElementById("motion").append(section);
    else document.getElementById("cards").insertAdjacentElement("afterend", section);
  };
  wide.addEventListener("change", settle);
  settle();
  player.onRow(draw);
  units.onChange(draw);
  linkdyn.onData(() => { insets.forEach((inset) => inset.read()); draw(); });
  linkdyn.clearance = { draw };
})();

"use strict";
// Force arrows: all to one scale, which a legend shows; the longest are cut and have a double head; values stand at the heads.
(() => {
  const { mechanism, shapes, drawing, units, column } = linkdyn;
  const pairs = (prefix, things) => things.map(({ name }) => ["fx", "fy"].map((q) => column(`${prefix}.${name}.${q}`)));
  const joints = pairs("joint", mechanism.joints), loads = pairs("force", mechanism.loads);
  const torques = mechanism.loads.map(({ name }) => column(`force.${name}.torque`));
  const MOST_ROWS = 500, MOST_VALUES = 24;

  // A large one of some forces over the run: not the largest, since peaks at singular positions would shrink all others.
  const typical = (list) => {
    const sizes = [], step = Math.max(1, Math.ceil(linkdyn.rows / MOST_ROWS));
    for (const [fx, fy] of list) if (fx && fy) for (let k = 0; k < linkdyn.rows; k += step) {
      const f = Math.hypot(fx.values[k], fy.values[k]);
      if (f > 0) sizes.push(f);
    }
    return sizes.length ? Float64Array.from(sizes).sort()[Math.floor((sizes.length - 1) * 0.85)] : 0;
  };
  const found = {};
  linkdyn.onData(() => { found.joints = found.loads = undefined; });
  const sizes = { get joints() { return found.joints ??= typical(joints); }, get loads() { return found.loads ??= typical(loads); } };

  const one = (state, from, [fx, fy], { unit, long, most, colour, name, into }) => {
    const { pen, bar, names } = state, f = Math.hypot(fx, fy), full = f / unit * long, shown = Math.min(full, most);
    if (!(f > 0) || !Number.isFinite(full) || shown < 2) return;
    const [dx, dy] = [fx / f * shown, -fy / f * shown];
    let [tail, head] = into ? [[from[0] - dx, from[1] - dy], from] : [from, [from[0] + dx, from[1] + dy]];
    // Where there is no room for the tail the arrow begins at the point.
    const { width, height } = state;
    if (into && (tail[0] < 0 || tail[0] > width || tail[1] < 0 || tail[1] > height)) [tail, head] = [from, [from[0] + dx, from[1] + dy]];
    drawing.arrow(pen, tail, head, bar, colour, full > most);
    if (full > most) state.cut.set(colour, most / long * unit);
    const free = into && tail !== from ? tail : head;
    if (state.values++ < MOST_VALUES) names.push({ text: units.quantity(f, "N", 3), at: free, colour, beside: 2, key: `force ${name}` });
  };

  // All arrows at a row; the values go among the names.
  const draw = (state, options) => {
    const { row, to, bar, pen, width, height, colours } = state, unit = sizes;
    const long = Math.min(width, height) * 0.22 * 10 ** (options.arrowScale / 2), most = Math.max(long * 1.6, Math.min(width, height) * 0.3);
    state.values = 0;
    state.cut = new Map();
    const legend = [];
    if (options.arrows && unit.joints > 0) {
      legend.push({ unit: unit.joints, long, colour: colours.force });
      mechanism.joints.forEach(({ between }, k) => {
        const [fx, fy] = joints[k], place = shapes.place(between[1], row);
        if (fx && fy && place) one(state, to(place), [fx.values[row], fy.values[row]], { unit: unit.joints, long, most, colour: colours.force, name: `j${k}` });
      });
    }
    if (options.loads) mechanism.loads.forEach(({ at, body }, k) => {
      const [fx, fy] = loads[k];
      const place = shapes.place(at || [body, 0], row);
      if (!place) return;
      // Loads push on their point: the head is there.
      if (fx && fy && unit.loads > 0) {
        one(state, to(place), [fx.values[row], fy.values[row]], { unit: unit.loads, long: long * 0.6, most: most * 0.7, colour: colours.load, name: `l${k}`, into: true });
        if (!legend.some(({ colour }) => colour === colours.load)) legend.push({ unit: unit.loads, long: long * 0.6, colour: colours.load });
      } else if (torques[k] && torques[k].values[row] !== 0) {
        drawing.round(pen, to(place), bar, torques[k].values[row] > 0, colours.load);
        state.names.push({ text: units.quantity(torques[k].values[row], "N*m", 3), at: to(place), colour: colours.load, beside: bar * 3.8, key: `torque ${k}` });
      }
    });
    return legend.map((own) => ({ ...own, cut: state.cut.get(own.colour) }));
  };

  // How long a round force is, from `x` on, and beyond which force arrows are cut, where there is room; returns what it takes.
  const legend = (pen, list, x, y, width) => {
    const boxes = [];
    pen.font = "12px system-ui, sans-serif"; pen.textBaseline = "bottom";
    const put = (text, wide, colour, isCut) => {
      const taken = Math.max(wide, pen.measureText(text).width) + 14;
      if (isCut && x + taken > width) return;
      drawing.arrow(pen, [x, y - 4], [x + wide, y - 4], 6, colour, isCut);
      pen.fillStyle = colour;
      pen.fillText(text, x, y - 9);
      boxes.push({ x, y: y - 26, wide: taken - 8, tall: 26, text });
      x += taken;
    };
    for (const { unit, long, colour, cut } of list) {
      const about = unit * 50 / long, power = 10 ** Math.floor(Math.log10(about));
      const nice = [5, 2, 1].map((n) => n * power).find((n) => n <= about) || power, wide = nice / unit * long;
      put(units.quantity(nice, "N", 3), wide, colour, false);
      if (cut) put(`> ${units.quantity(cut, "N", 2)}`, 30, colour, true);
    }
    return boxes;
  };

  linkdyn.forces = { draw, legend, hasJoints: joints.some(([fx]) => fx) };
})();

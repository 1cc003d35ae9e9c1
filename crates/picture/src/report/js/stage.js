"use strict";
// The canvas: what part of the plane it shows, paths of points, arrows, names.
(() => {
  const { mechanism, shapes, drawing, player, units, column, rows } = linkdyn;
  const canvas = document.getElementById("canvas");
  const pen = canvas.getContext("2d");
  const small = mechanism.bodies.length <= 14;
  const show = { bodies: small, joints: small && mechanism.joints.length <= 14, points: false, centres: false, drivers: true };
  const options = { show, arrows: false, loads: true, arrowScale: 0, follow: null, traces: new Set(mechanism.points.map(String)) };
  const TRACE_DASHES = [[], [7, 4], [2, 3], [10, 3, 2, 3]];
  let width = 0, height = 0, colours = null, wanted = false;
  const view = { x: 0, y: 0, scale: 1 };

  const whole = () => {
    const [left, right, bottom, top] = shapes.box;
    const margin = Math.min(64, width * 0.12);
    view.x = (left + right) / 2; view.y = (bottom + top) / 2;
    view.scale = Math.min(Math.max(width - 2 * margin, 40) / (right - left), Math.max(height - 1.7 * margin, 40) / (top - bottom));
  };

  // A large one of some forces over the run: it gets a fixed length.
  const pairs = (prefix, things) => things.map(({ name }) => ["fx", "fy"].map((q) => column(`${prefix}.${name}.${q}`)));
  const jointForces = pairs("joint", mechanism.joints), loadForces = pairs("force", mechanism.loads);
  const torques = mechanism.loads.map(({ name }) => column(`force.${name}.torque`));
  const typical = (list) => {
    const sizes = [];
    for (const [fx, fy] of list) if (fx && fy) for (let k = 0; k < rows; k++) {
      const f = Math.hypot(fx.values[k], fy.values[k]);
      if (f > 0) sizes.push(f);
    }
    // Not the largest: poles at singular positions would shrink all others.
    return sizes.length ? Float64Array.from(sizes).sort()[Math.floor((sizes.length - 1) * 0.85)] : 0;
  };
  let unit = null;
  const forceUnit = () => unit ??= { joints: typical(jointForces), loads: typical(loadForces) };

  const trace = (end, number) => {
    pen.beginPath();
    let down = false;
    for (let k = 0; k < rows; k++) {
      const place = shapes.place(end, k);
      if (!place) { down = false; continue; }
      if (down) pen.lineTo(...to(place)); else pen.moveTo(...to(place));
      down = true;
    }
    pen.setLineDash(TRACE_DASHES[number % TRACE_DASHES.length]);
    pen.stroke();
    pen.setLineDash([]);
  };

  const to = ([x, y]) => [width / 2 + (x - view.x) * view.scale, height / 2 - (y - view.y) * view.scale];

  const names = (list) => {
    const taken = [];
    // No name of a body covers a joint that is named.
    const pins = list.filter(({ at, strong }) => at && !strong).map(({ at }) => at);
    const covers = (x, y, wide) => pins.some((pin) => x - 6 < pin[0] && pin[0] < x + wide + 6 && Math.abs(y - pin[1]) < 13);
    pen.font = "12px system-ui, sans-serif";
    pen.textBaseline = "middle";
    for (const { text, at, colour, strong, beside } of list) {
      if (!at) continue;
      const label = linkdyn.plain(text).slice(0, 40), wide = pen.measureText(label).width;
      const gap = (beside || 6) + 5;
      const places = strong ? [[-wide / 2, -14], [-wide / 2, 14], [10, -12], [-wide - 10, -12], [10, 14], [-wide - 10, 14], [-wide / 2, -27], [-wide / 2, 27]]
        : [[gap, -gap], [-gap - wide, -gap], [gap, gap], [-gap - wide, gap], [gap, 0]];
      const free = places.map(([dx, dy]) => [at[0] + dx, at[1] + dy])
        .find(([x, y]) => x > 2 && x + wide < width - 46 && y > 9 && y < height - 9 && !(strong && covers(x, y, wide))
          && !taken.some((t) => x < t[0] + t[2] + 4 && t[0] < x + wide + 4 && Math.abs(y - t[1]) < 14));
      if (!free) continue;
      taken.push([...free, wide]);
      pen.lineWidth = 3.5; pen.strokeStyle = colours.card; pen.strokeText(label, ...free);
      pen.fillStyle = colour; pen.fillText(label, ...free);
    }
  };

  // A length that is easy to read, as a bar.
  const ruler = () => {
    const { factor } = units.of("m");
    const about = Math.min(140, width * 0.25) / view.scale * factor;
    const power = 10 ** Math.floor(Math.log10(about));
    const nice = [5, 2, 1].map((n) => n * power).find((n) => n <= about) || power;
    const long = nice / factor * view.scale;
    pen.strokeStyle = pen.fillStyle = colours.muted; pen.lineWidth = 1.4;
    drawing.path(pen, [[14, height - 20], [14, height - 14], [14 + long, height - 14], [14 + long, height - 20]]);
    pen.stroke();
    pen.font = "12px system-ui, sans-serif"; pen.textBaseline = "bottom";
    pen.fillText(units.length(nice / factor), 20, height - 17);
  };

  const arrows = (row, px) => {
    const unit = forceUnit(), long = Math.min(width, height) * 0.25 * 10 ** (options.arrowScale / 2);
    if (options.arrows && unit.joints > 0) {
      pen.strokeStyle = pen.fillStyle = colours.force;
      mechanism.joints.forEach(({ between }, k) => {
        const [fx, fy] = jointForces[k], place = shapes.place(between[1], row);
        if (!fx || !fy || !place) return;
        const f = [fx.values[row], fy.values[row]].map((f) => f / unit.joints * long), from = to(place);
        if (f.every(Number.isFinite)) drawing.arrow(pen, from, [from[0] + f[0], from[1] - f[1]], 2.4, px * 1.1);
      });
    }
    if (options.loads) mechanism.loads.forEach(({ at, body }, k) => {
      pen.strokeStyle = pen.fillStyle = colours.load;
      const [fx, fy] = loadForces[k];
      const place = at ? shapes.place(at, row) : shapes.place([body, 0], row);
      if (!place) return;
      const end = to(place);
      if (fx && fy && unit.loads > 0) {
        // Loads push on their point: the head is there.
        const f = [fx.values[row], fy.values[row]].map((f) => f / unit.loads * long * 0.6);
        if (!f.every(Number.isFinite)) return;
        const tail = [end[0] - f[0], end[1] + f[1]];
        // Where there is no room for the tail the arrow begins at the point.
        if (tail[0] > 0 && tail[0] < width && tail[1] > 0 && tail[1] < height) drawing.arrow(pen, tail, end, 2.6, px);
        else drawing.arrow(pen, end, [end[0] + f[0], end[1] - f[1]], 2.6, px);
      } else if (torques[k] && torques[k].values[row] !== 0) {
        drawing.round(pen, end, px * 2.4, torques[k].values[row] > 0, 2.6);
      }
    });
  };

  const paint = () => {
    wanted = false;
    if (!(width > 0)) return;
    colours ??= drawing.palette();
    const row = player.row;
    if (options.follow) { const at = shapes.place(options.follow, row); if (at) [view.x, view.y] = at; }
    pen.clearRect(0, 0, width, height);
    if (!shapes.known && mechanism.bodies.length > 1) return;
    const px = Math.min(Math.max(Math.min(width, height) * 0.024, 7), 13) * (mechanism.bodies.length > 60 ? 0.5 : 1);
    pen.strokeStyle = colours.accent; pen.lineWidth = 1.4;
    [...options.traces].forEach((key, k) => trace(key.split(",").map(Number), k));
    const list = drawing.draw(pen, { to, scale: view.scale, px, row, colours, show });
    [...options.traces].forEach((key) => {
      const at = shapes.place(key.split(",").map(Number), row);
      if (!at) return;
      pen.fillStyle = colours.accent; pen.beginPath(); pen.arc(...to(at), 4, 0, 7); pen.fill();
    });
    arrows(row, px);
    names(list.filter(({ strong }) => !strong || show.bodies));
    if (rows) ruler();
  };
  const draw = () => { if (!wanted) { wanted = true; requestAnimationFrame(paint); } };

  const resize = (paper) => {
    const box = paper || canvas.parentElement.getBoundingClientRect();
    const before = width;
    const ratio = window.devicePixelRatio || 1;
    [width, height] = [box.width, box.height];
    canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    if (before !== width) whole();
    paint();
  };

  const zoom = (by, [x, y] = [width / 2, height / 2]) => {
    const [dx, dy] = [(x - width / 2) / view.scale, (height / 2 - y) / view.scale];
    view.x += dx * (1 - 1 / by); view.y += dy * (1 - 1 / by);
    view.scale *= by;
    draw();
  };

  // Drag to move, wheel with a key or pinch to zoom: the wheel alone scrolls the page.
  const fingers = new Map();
  canvas.addEventListener("pointerdown", (event) => { fingers.set(event.pointerId, [event.clientX, event.clientY]); canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const other = [...fingers].find(([id]) => id !== event.pointerId);
    if (other) {
      const far = (p) => Math.hypot(p[0] - other[1][0], p[1] - other[1][1]);
      if (far(before) > 10) zoom(far(now) / far(before));
    } else if (!options.follow) {
      view.x -= (now[0] - before[0]) / view.scale; view.y += (now[1] - before[1]) / view.scale;
      draw();
    }
    fingers.set(event.pointerId, now);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.shiftKey && !event.metaKey) return;
    event.preventDefault();
    zoom(Math.exp(-(event.deltaY || event.deltaX) * 0.002), [event.offsetX, event.offsetY]);
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { whole(); draw(); });

  player.onRow(draw);
  units.onChange(draw);
  linkdyn.stage = {
    options, draw, paint, zoom, resize, whole: () => { whole(); draw(); },
    recolour: () => { colours = null; paint(); },
    hasForces: jointForces.some(([fx]) => fx),
  };
})();

"use strict";
// The canvas: what part of the plane it shows, paths of points, forces, names.
(() => {
  const { given, mechanism, shapes, drawing, ghost, labels, forces, moments, player, units } = linkdyn;
  const canvas = document.getElementById("canvas");
  const pen = canvas.getContext("2d");
  const small = mechanism.bodies.length <= 14;
  const show = { bodies: small, joints: small && mechanism.joints.length <= 14, points: false, centres: false, drivers: true };
  const options = { show, arrows: false, loads: true, moments: true, arrowScale: 0, follow: null, traces: new Set(mechanism.points.map(String)) };
  const TRACE_DASHES = [[], [7, 4], [2, 3], [10, 3, 2, 3]];
  let width = 0, height = 0, colours = null, wanted = false, own = false;
  const view = { x: 0, y: 0, scale: 1 };

  // Half the width of a body [px].
  const barOf = (width, height) => drawing.barOf(width, height) * (mechanism.bodies.length > 60 ? 0.5 : 1);
  // Room around the mechanism \[px\]: names, buttons above, the ruler below.
  const ROOM = { left: 46, right: 46, top: 56, bottom: 50 };
  // What the ruler and the legends of arrows take, and in bars how far the sign of the ground reaches below its pin.
  const FOOT = 38, SUPPORT = 3.6;
  const whole = () => {
    own = false;
    const [left, right, bottom, top] = given.drawing.box, part = Math.min(1, width / 420, height / 260);
    const room = Object.fromEntries(Object.entries(ROOM).map(([side, size]) => [side, size * part]));
    room.bottom = Math.max(room.bottom, FOOT + SUPPORT * barOf(width, height));
    view.scale = Math.min(Math.max(width - room.left - room.right, 40) / (right - left), Math.max(height - room.top - room.bottom, 40) / (top - bottom));
    view.x = (left + right) / 2 + (room.right - room.left) / 2 / view.scale;
    view.y = (bottom + top) / 2 + (room.top - room.bottom) / 2 / view.scale;
  };

  // The height that suits the mechanism at this width; the style sheet keeps it within the window.
  const fit = () => {
    const [left, right, bottom, top] = given.drawing.box, wide = canvas.parentElement.clientWidth - ROOM.left - ROOM.right;
    const tall = Math.max(wide, 40) * (top - bottom) / (right - left) + ROOM.top + ROOM.bottom;
    canvas.parentElement.style.setProperty("--fit", `${Math.round(Math.min(Math.max(tall, 220), 900))}px`);
  };

  // The path of a point, on any pen that draws lines.
  const along = (pen, to, end, shapes, rows) => {
    let down = false;
    for (let k = 0; k < rows; k++) {
      const place = shapes.place(end, k);
      if (!place) { down = false; continue; }
      if (down) pen.lineTo(...to(place)); else pen.moveTo(...to(place));
      down = true;
    }
  };
  // Kept as long as the view stays: it would take most of the time of a frame.
  const kept = { view: "", paths: new Map() };
  const trace = (pen, to, key, number, of = linkdyn) => {
    const end = key.split(",").map(Number), name = of === linkdyn ? key : `before ${key}`;
    pen.setLineDash(TRACE_DASHES[number % TRACE_DASHES.length]);
    if (pen.canvas === canvas) {
      const now = [view.x, view.y, view.scale, width, height].join(" ");
      if (kept.view !== now) { kept.view = now; kept.paths.clear(); }
      if (!kept.paths.has(name)) { const path = new Path2D(); along(path, to, end, of.shapes, of.rows); kept.paths.set(name, path); }
      pen.stroke(kept.paths.get(name));
    } else {
      pen.beginPath();
      along(pen, to, end, of.shapes, of.rows);
      pen.stroke();
    }
    pen.setLineDash([]);
  };

  const to = ([x, y]) => [width / 2 + (x - view.x) * view.scale, height / 2 - (y - view.y) * view.scale];

  // A length that is easy to read, as a bar.
  const ruler = (pen, { width, height }, scale, colours) => {
    const { factor } = units.of("m");
    const about = Math.min(140, width * 0.25) / scale * factor;
    const power = 10 ** Math.floor(Math.log10(about));
    const nice = [5, 2, 1].map((n) => n * power).find((n) => n <= about) || power;
    const long = nice / factor * scale;
    const text = units.length(nice / factor), tall = 26;
    pen.strokeStyle = pen.fillStyle = colours.muted; pen.lineWidth = 1.4;
    drawing.path(pen, [[14, height - 15], [14, height - 9], [14 + long, height - 9], [14 + long, height - 15]]);
    pen.stroke();
    pen.font = "12px system-ui, sans-serif"; pen.textBaseline = "bottom";
    pen.fillText(text, 20, height - 12);
    return { x: 14, y: height - 9 - tall, wide: Math.max(long, pen.measureText(text).width + 8), tall, text };
  };

  // What a cursor is on has a halo; a page around this one may draw below and above the mechanism.
  let halo = null;
  const layers = { under: null, over: null };
  let placed = null;
  const buttons = () => placed ??= [...document.querySelectorAll("#view")].map((node) => ({ x: node.offsetLeft, y: node.offsetTop, wide: node.offsetWidth, tall: node.offsetHeight }));
  let drawn = [];

  // Everything, on any pen; returns the boxes of all texts.
  const picture = (pen, size, to, scale, row, background, taken, colours) => {
    const { width, height } = size;
    const bar = barOf(width, height);
    layers.under?.({ pen, to, scale, row, bar, colours, width, height });
    ghost.draw(pen, { to, scale, bar, row, colours, show: { drivers: show.drivers } }, (before) => {
      pen.strokeStyle = colours.accent; pen.lineWidth = 1.4;
      [...options.traces].forEach((key, k) => trace(pen, to, key, k, before));
    });
    const names = drawing.draw(pen, { to, scale, bar, row, colours, show });
    pen.strokeStyle = colours.accent; pen.lineWidth = 1.4;
    [...options.traces].forEach((key, k) => trace(pen, to, key, k));
    [...options.traces].forEach((key) => {
      const at = shapes.place(key.split(",").map(Number), row);
      if (!at) return;
      pen.fillStyle = colours.accent; pen.beginPath(); pen.arc(...to(at), 4, 0, 7); pen.fill();
    });
    const list = names.filter(({ strong }) => !strong || show.bodies);
    if (options.moments) moments.draw({ pen, to, row, width, height, colours, names: list });
    const scales = forces.draw({ pen, to, bar, row, width, height, colours, names: list }, options);
    if (halo) halo({ pen, to, row, bar, colours });
    layers.over?.({ pen, to, scale, row, bar, colours, width, height });
    const foot = linkdyn.rows ? [ruler(pen, size, scale, colours)] : [];
    foot.push(...forces.legend(pen, scales, foot.length ? foot[0].x + foot[0].wide + 18 : 14, height - 8, width));
    // Values and pins before bodies, which their colours identify as well.
    list.sort((a, b) => Number(Boolean(a.strong)) - Number(Boolean(b.strong)));
    return [...foot, ...labels.draw(pen, list, { width, height, taken: [...taken, ...foot], background })];
  };

  const paint = () => {
    wanted = false;
    if (!(width > 0)) return;
    colours ??= drawing.palette();
    const row = player.row;
    if (options.follow) { const at = shapes.place(options.follow, row); if (at) [view.x, view.y] = at; }
    pen.clearRect(0, 0, width, height);
    if (!shapes.known && mechanism.bodies.length > 1) return;
    drawn = picture(pen, { width, height }, to, view.scale, row, colours.card, paper ? [] : buttons(), colours);
  };
  const draw = () => { if (!wanted) { wanted = true; requestAnimationFrame(paint); } };

  let paper = false, size = "";
  const resize = (sheet) => {
    paper = Boolean(sheet);
    if (!paper) fit();
    placed = null;
    const box = sheet || canvas.parentElement.getBoundingClientRect();
    const ratio = window.devicePixelRatio || 1;
    const before = size;
    [width, height] = [box.width, box.height];
    size = [width, height, ratio, paper].join(" ");
    if (size === before) return;
    drawing.prepare(canvas, width, height);
    // The part that the reader has chosen stays.
    if (paper || !own) whole();
    paint();
  };

  const zoom = (by, [x, y] = [width / 2, height / 2]) => {
    const [dx, dy] = [(x - width / 2) / view.scale, (height / 2 - y) / view.scale];
    view.x += dx * (1 - 1 / by); view.y += dy * (1 - 1 / by);
    view.scale *= by;
    own = true;
    draw();
  };

  // Drag to move the view, or the mechanism where it is taken hold of; wheel with a key or pinch to zoom: the wheel alone scrolls the page.
  const fingers = new Map();
  let moved = false, hold = () => null, lead = null;
  canvas.addEventListener("pointerdown", (event) => {
    moved = false;
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    lead = fingers.size === 1 ? hold([event.offsetX, event.offsetY]) : null;
    if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("touchmove", (event) => { if (lead) event.preventDefault(); }, { passive: false });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    if (lead && !moved && Math.hypot(now[0] - before[0], now[1] - before[1]) <= 3) return;
    moved ||= Math.hypot(now[0] - before[0], now[1] - before[1]) > 3;
    const other = [...fingers].find(([id]) => id !== event.pointerId);
    if (other) {
      const far = (p) => Math.hypot(p[0] - other[1][0], p[1] - other[1][1]);
      if (far(before) > 10) zoom(far(now) / far(before));
    } else if (lead) lead([event.offsetX, event.offsetY]);
    else if (!options.follow) {
      view.x -= (now[0] - before[0]) / view.scale; view.y += (now[1] - before[1]) / view.scale;
      own = true;
      draw();
    }
    fingers.set(event.pointerId, now);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => { fingers.delete(event.pointerId); lead = null; });
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.shiftKey && !event.metaKey) return;
    event.preventDefault();
    zoom(Math.exp(-(event.deltaY || event.deltaX) * 0.002), [event.offsetX, event.offsetY]);
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { whole(); draw(); });

  linkdyn.onData((trying) => {
    kept.view = "";
    // While a value is tried the view stays, so that what changes is the mechanism.
    if (!own && !trying && width > 0) whole();
    paint();
  });
  player.onRow(draw);
  units.onChange(draw);
  linkdyn.stage = {
    options, draw, paint, zoom, resize, picture, whole: () => { whole(); draw(); },
    recolour: () => { colours = null; paint(); },
    hasForces: forces.hasJoints,
    // The part of the plane that the reader has chosen, if so: its middle, and pixels per metre.
    get view() { return own ? [view.x, view.y, view.scale] : null; },
    set view([x, y, scale]) { Object.assign(view, { x, y, scale }); own = true; draw(); },
    // The same, whoever has chosen it.
    get shown() { return [view.x, view.y, view.scale]; },
    get labels() { return drawn; },
    get size() { return { width, height }; },
    get bar() { return barOf(width, height); },
    set halo(draws) { halo = draws; draw(); },
    layers,
    to: (place) => to(place),
    from: ([x, y]) => [view.x + (x - width / 2) / view.scale, view.y + (height / 2 - y) / view.scale],
    // What takes hold of a place of the canvas, if something moves there: it follows the pointer.
    set hold(take) { hold = take; },
    // What is shown, on another pen.
    pose: (pen) => picture(pen, { width, height }, to, view.scale, player.row, "#ffffff", [], drawing.palette()),
    canvas, moving: () => fingers.size > 0 && moved, get moved() { return moved; },
  };
})();

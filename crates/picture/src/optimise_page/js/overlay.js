"use strict";
// Before and after over each other, at the same instant: grey, and in colour; the path of the point with the points it should pass.
(() => {
  const { given, motions, player, drawing, units, element, theme, colour, axes, id } = linkdyn;
  const canvas = id("canvas"), stage = id("stage"), { wanted } = given;
  const [AXES, PATHS] = [["x", "y", "angle"], { before: [5, 4], after: [] }];

  // The scripts that draw know one mechanism: each is put in its place before it is drawn.
  const with_ = ({ mechanism, drawing: parts, shapes }, act) => { given.drawing = parts; Object.assign(linkdyn, { mechanism, shapes }); return act(shapes); };
  for (const motion of motions) {
    const { mechanism, rows, values } = motion;
    const column = (name) => { const at = name.lastIndexOf("."), body = mechanism.bodies.findIndex((own) => own.name === name.slice(0, at)); return { values: values(3 * body - 2 + AXES.indexOf(name.slice(at + 1))) }; };
    const kept = { mechanism: linkdyn.mechanism, rows: linkdyn.rows, column: linkdyn.column };
    Object.assign(linkdyn, { mechanism, rows, column });
    motion.shapes = linkdyn.measureShapes();
    Object.assign(linkdyn, kept);
    motion.path = wanted ? Array.from({ length: rows }, (_, row) => motion.shapes.place(wanted.point, row)).filter(Boolean) : [];
  }

  // All that is drawn.
  const box = motions.map((motion) => motion.drawing.box).concat((wanted ? wanted.through : []).map(([x, y]) => [x, x, y, y]))
    .reduce((all, own) => all.map((end, k) => k % 2 ? Math.max(end, own[k]) : Math.min(end, own[k])), [Infinity, -Infinity, Infinity, -Infinity]);

  const along = (pen, points, to) => { drawing.path(pen, points.map(to)); pen.stroke(); };
  const draw = () => {
    const width = stage.clientWidth, height = stage.clientHeight;
    if (!motions.length || !width) return;
    const pen = drawing.prepare(canvas, width, height), bar = drawing.barOf(width, height), colours = drawing.palette();
    const grey = { ...colours, steel: colours.muted, force: colours.muted, ink: colours.muted, body: () => ({ fill: colours.line, line: colours.muted }) };
    const view = { ...drawing.fitted(box, width, height, 4.7 * bar), bar, show: { drivers: true } };
    motions.forEach((motion, k) => {
      const after = k === motions.length - 1, row = after ? player.row : player.rowAt(linkdyn.time[player.row], motion.time);
      pen.globalAlpha = after ? 1 : 0.6;
      with_(motion, () => drawing.draw(pen, { ...view, row: Math.min(row, motion.rows - 1), colours: after ? colours : grey }));
      pen.globalAlpha = 1;
      if (!motion.path.length) return;
      pen.lineWidth = after ? 2 : 1.4; pen.strokeStyle = after ? colours.accent : colours.muted; pen.setLineDash(PATHS[motion.name]);
      along(pen, motion.path, view.to);
      pen.setLineDash([]);
    });
    for (const at of wanted ? wanted.through : []) {
      pen.beginPath(); pen.arc(...view.to(at), 4, 0, 7);
      pen.fillStyle = colours.card; pen.fill(); pen.strokeStyle = colours.force; pen.lineWidth = 2; pen.stroke();
    }
  };
  const show = () => { id("now").textContent = linkdyn.rows ? `t = ${units.number(linkdyn.time[player.row], 4)} s` : ""; draw(); };

  const legend = () => {
    const tone = (after) => colour(after ? "accent" : "muted");
    const marks = motions.map(({ name }, k) => element("span", {}, axes.swatch(tone(k === motions.length - 1), { dash: PATHS[name] }), name));
    if (wanted) marks.push(element("span", { text: `○ points that ${wanted.name} should pass` }));
    id("legend").replaceChildren(...marks);
  };

  id("scrub").max = Math.max(linkdyn.rows - 1, 0);
  id("transport").hidden = linkdyn.rows < 2;
  canvas.hidden = !motions.length;
  id("undrawn").hidden = motions.length > 0;
  id("undrawn").textContent = "There is no motion to draw.";
  if (!motions.length) id("motion").classList.add("empty");
  player.onRow(show);
  new ResizeObserver(() => setTimeout(() => { if (motions.length) drawing.suit(stage, box); draw(); }, 0)).observe(stage);
  theme.onChange(() => { legend(); draw(); });
  legend();
  show();
  linkdyn.overlay = { draw, box };
})();

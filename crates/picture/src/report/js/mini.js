"use strict";
// A small picture of the mechanism where the large one has scrolled out of sight; a click goes back to it.
(() => {
  const { given, shapes, drawing, player, mechanism } = linkdyn;
  const canvas = document.getElementById("mini");
  const WIDE = 136, TALL = 104, ROOM = 14;
  const usable = shapes.known && linkdyn.rows > 0;

  const draw = () => {
    if (canvas.hidden) return;
    const pen = drawing.prepare(canvas, WIDE, TALL), bar = mechanism.bodies.length > 20 ? 1.7 : 2.7;
    drawing.draw(pen, { ...drawing.fitted(given.drawing.box, WIDE, TALL, ROOM), bar, row: player.row, colours: drawing.palette(), show: {} });
  };

  const show = (on) => { canvas.hidden = !on; draw(); };
  if (usable) {
    const large = document.getElementById("stage");
    const settle = () => { const out = large.getBoundingClientRect().bottom < 60; if (out === canvas.hidden) show(out); };
    addEventListener("scroll", settle, { passive: true });
    addEventListener("resize", settle);
    settle();
    canvas.addEventListener("click", () => document.getElementById("motion").scrollIntoView({ block: "start" }));
  }
  player.onRow(draw);
  linkdyn.onData(draw);
  linkdyn.theme.onChange(draw);
})();

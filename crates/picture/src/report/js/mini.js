"use strict";
// A small picture of the mechanism where the large one has scrolled out of sight; a click goes back to it.
(() => {
  const { shapes, drawing, player, mechanism } = linkdyn;
  const canvas = document.getElementById("mini"), pen = canvas.getContext("2d");
  const WIDE = 136, TALL = 104, ROOM = 14;
  const usable = shapes.known && linkdyn.rows > 0;

  const draw = () => {
    if (canvas.hidden) return;
    const ratio = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(WIDE * ratio)) [canvas.width, canvas.height] = [Math.round(WIDE * ratio), Math.round(TALL * ratio)];
    const [left, right, bottom, top] = shapes.box;
    const scale = Math.min((WIDE - 2 * ROOM) / (right - left), (TALL - 2 * ROOM) / (top - bottom));
    const to = ([x, y]) => [WIDE / 2 + (x - (left + right) / 2) * scale, TALL / 2 - (y - (bottom + top) / 2) * scale];
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, WIDE, TALL);
    const px = mechanism.bodies.length > 20 ? 2.5 : 4;
    drawing.draw(pen, { to, scale, px, row: player.row, colours: drawing.palette(), show: {} });
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
  linkdyn.theme.onChange(draw);
})();

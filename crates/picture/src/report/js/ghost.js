"use strict";
// The mechanism as it is saved, faint behind what is tried.
(() => {
  const { given, drawing } = linkdyn, FAINT = 0.3;
  let before = null;

  // Keeps what is shown, where nothing is kept yet.
  const take = () => {
    if (before || !linkdyn.rows || !linkdyn.shapes.known) return;
    const { rows, time } = linkdyn, [mechanism, drawn] = [given.mechanism, given.drawing].map((part) => structuredClone(part));
    const values = new Map(linkdyn.columns.map(({ name, values }) => [name, { values }]));
    const scene = { mechanism, rows, given: { drawing: drawn }, column: (name) => values.get(name) };
    before = { rows, time, drawing: drawn, shapes: linkdyn.measureShapes(scene) };
  };
  // The row of the same instant.
  const rowOf = (row) => {
    const { time } = before, instant = linkdyn.time[row], at = linkdyn.player.rowAt(instant, time, before.rows);
    return at + 1 < before.rows && Math.abs(time[at + 1] - instant) < Math.abs(time[at] - instant) ? at + 1 : at;
  };
  const draw = (pen, state, paths) => {
    if (!before) return;
    const now = [given.drawing, linkdyn.shapes];
    pen.save();
    pen.globalAlpha = FAINT;
    [given.drawing, linkdyn.shapes] = [before.drawing, before.shapes];
    drawing.draw(pen, { ...state, row: rowOf(state.row) });
    [given.drawing, linkdyn.shapes] = now;
    paths(before);
    pen.restore();
  };
  linkdyn.ghost = { take, draw, leave: () => { before = null; }, get row() { return before && rowOf(linkdyn.player.row); }, get shapes() { return before?.shapes; } };
})();

// Drags a point along its path, which it passes several times, then empty space.
(async () => {
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  await wait(300);
  while (linkdyn.plots.list.some(({ u }) => !u)) await wait(50);
  const { stage, player, shapes, mechanism, plots, rows } = linkdyn, box = stage.canvas.getBoundingClientRect();
  const send = (type, [x, y]) => stage.canvas.dispatchEvent(new (type === "click" ? MouseEvent : PointerEvent)(type, { clientX: box.left + x, clientY: box.top + y, pointerType: "mouse", buttons: type === "pointermove" ? 1 : 0, bubbles: true }));
  const at = (row) => stage.to(shapes.place(mechanism.points[0], row));
  const told = { rows, far: 0, plots: plots.list.length };
  player.play();
  player.seek(0);
  send("pointerdown", at(0));
  for (let row = 2; row < rows; row += 2) {
    const [x, y] = at(row);
    send("pointermove", [x + 4, y - 3]);
    told.far = Math.max(told.far, Math.abs(player.row - row));
  }
  send("pointerup", at(rows - 1));
  send("click", at(rows - 1));
  Object.assign(told, { last: player.row, playing: player.playing, opened: plots.list.length - told.plots, moved: stage.view });
  // Back by the way on which it came.
  send("pointerdown", at(player.row));
  for (let row = rows - 1; row >= rows / 2; row -= 2) send("pointermove", at(row));
  told.back = player.row;
  send("pointerup", at(player.row));
  const before = player.row;
  send("pointerdown", [30, 60]); send("pointermove", [50, 70]); send("pointerup", [50, 70]);
  answer({ ...told, kept: player.row === before, view: stage.view });
})();

// A plot at its largest value, and tips at the top and at the foot of the window.
(async () => {
  const id = (name) => document.getElementById(name), wait = (time) => new Promise((done) => setTimeout(done, time));
  await wait(300);
  const { stage, plots, player, shapes, mechanism, textOf, endRows } = linkdyn;
  const plot = plots.list.find(({ columns }) => columns.some(({ name }) => name === "joint.g.f")), k = plot.columns.findIndex(({ name }) => name === "joint.g.f");
  const column = plot.columns[k], row = endRows(column)[1];
  player.seek(row);
  plot.mark();
  const told = { chip: plot.values[k].textContent, largest: column.values[row], table: textOf(column, row), shown: [], covered: [] };
  player.seek(0);
  await wait(50);
  const joint = mechanism.joints.findIndex(({ name }) => name === "d");
  for (const far of [0.1, 0.98]) {
    const [x, y] = stage.to(shapes.place(mechanism.joints[joint].between[1], player.row));
    // The pin is put at a place of the window: the drawing is moved for it.
    stage.canvas.parentElement.style.cssText += `; position: fixed; left: 0; top: ${far * innerHeight - y}px; z-index: 9`;
    const box = stage.canvas.getBoundingClientRect(), at = [box.left + x, box.top + y];
    stage.canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: at[0], clientY: at[1], pointerType: "mouse", bubbles: true }));
    const tip = id("tip").getBoundingClientRect();
    told.shown.push(!id("tip").hidden && tip.width > 20);
    told.covered.push(tip.left <= at[0] && at[0] <= tip.right && tip.top <= at[1] && at[1] <= tip.bottom);
  }
  answer(told);
})();

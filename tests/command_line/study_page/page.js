// Uses the page of a study of samples.
(async () => {
  // Frames do not come by themselves under virtual time.
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  const id = (name) => document.getElementById(name);
  const { choice, frames, motions, inputs, mechanism, player, variables } = linkdyn;
  await wait(400);
  const cell = (node) => node.textContent;
  const sum = (canvas) => {
    const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height }), pen = copy.getContext("2d", { willReadFrequently: true });
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height);
    let found = 0;
    for (let k = 0; k < data.length; k++) found = (found * 31 + data[k]) % 1000000007;
    return found;
  };
  const told = {
    asked: id("line").textContent,
    tiles: Object.fromEntries([...document.querySelectorAll(".tile")].map((tile) => [cell(tile.children[0]), cell(tile.children[2] ?? tile)])),
    responses: [...document.querySelectorAll("#of_responses tbody tr")].map((row) => [...row.children].map(cell).join("|")),
    plots: frames.length, blank: frames.filter(({ plots }) => !plots.length).map(({ canvas }) => canvas.getAttribute("aria-label")),
  };

  const point = (canvas, type, [x, y]) => { const box = canvas.getBoundingClientRect(); canvas.dispatchEvent(new PointerEvent(type, { clientX: box.left + x, clientY: box.top + y, bubbles: true })); };
  const drag = (canvas, from, to) => { point(canvas, "pointerdown", from); point(canvas, "pointermove", to); point(canvas, "pointerup", to); };
  const inside = (...ranges) => linkdyn.numbers.filter((_, row) => ranges.every(([{ values }, from, to]) => values[row] >= from && values[row] <= to)).length;
  const matrix = frames.find(({ canvas }) => canvas.id === "matrix_plot"), parallel = frames.find(({ canvas }) => canvas.id === "parallel_plot");

  // A box in the first cell of the matrix selects in all plots.
  const before = frames.map(({ canvas }) => sum(canvas)), { at, x, y } = matrix.plots[0], { box } = at;
  drag(matrix.canvas, [box.left + 0.1 * box.wide, box.top + 0.1 * box.tall], [box.left + 0.55 * box.wide, box.top + 0.9 * box.tall]);
  await wait(200);
  const across = [x, ...choice.ranges.get(x)], up = [y, ...choice.ranges.get(y)];
  told.boxed = { count: choice.count, expected: inside(across, up), told: id("selected_count").textContent.replaceAll("\u202f", ""), unchanged: frames.filter(({ canvas }, k) => sum(canvas) === before[k]).map(({ canvas }) => canvas.getAttribute("aria-label")) };
  // A range along an axis of the parallel coordinates narrows it down.
  const axis = parallel.plots[variables.length - 1];
  drag(parallel.canvas, [axis.at.box.left + 16, axis.at.box.top + 0.5 * axis.at.box.tall], [axis.at.box.left + 16, axis.at.box.top + axis.at.box.tall]);
  await wait(100);
  told.along = { count: choice.count, expected: inside(across, up, [axis.y, ...choice.ranges.get(axis.y)]) };
  document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "Escape", bubbles: true }));
  await wait(100);
  told.escaped = { hidden: id("selected").hidden, count: choice.count };

  // A click chooses the nearest variant, which moves.
  const cloud = frames[1], [plot] = cloud.plots;
  point(cloud.canvas, "pointerdown", [plot.at.x(plot.x.values[7]), plot.at.y(plot.y.values[7])]);
  point(cloud.canvas, "pointerup", [plot.at.x(plot.x.values[7]), plot.at.y(plot.y.values[7])]);
  await wait(100);
  const drawn = sum(id("canvas"));
  await wait(700);
  told.clicked = { row: choice.row, title: id("which").textContent, note: id("motion_note").textContent, moves: player.playing && player.row > 0 && sum(id("canvas")) !== drawn };

  // The crank of each motion is as long as its variant says, and the pins stay together.
  told.lengths = 0;
  const crank = inputs.findIndex(({ name }) => name === "crank");
  for (const own of motions.filter(({ row }) => row >= 0).slice(0, 20)) {
    choice.choose(own.row);
    const [, ax] = mechanism.bodies.find(({ name }) => name === "crank").points.find(([name]) => name === "A");
    told.lengths = Math.max(told.lengths, Math.abs(ax - inputs[crank].values[own.row] * inputs[crank].size));
    for (const { between: [a, b], type } of mechanism.joints) {
      if (type !== "revolute") continue;
      for (const row of [0, 9]) { const [p, q] = [linkdyn.shapes.place(a, row), linkdyn.shapes.place(b, row)]; told.lengths = Math.max(told.lengths, Math.hypot(p[0] - q[0], p[1] - q[1])); }
    }
  }

  // Sorted by a response, down to its largest value; a click on a row chooses it.
  document.querySelectorAll("#rows_head button")[2].click();
  const shown = () => [...document.querySelectorAll("#rows_body tr[data-row]")];
  const values = shown().map((row) => variables[0].values[row.dataset.row]);
  const rows = document.querySelectorAll("#rows_body tr").length;
  id("rows").scrollTop = 1e6;
  id("rows").dispatchEvent(new Event("scroll"));
  await wait(200);
  const last = shown().at(-1);
  last.firstChild.click();
  await wait(100);
  told.table = { rows, ascending: values.every((value, k) => k === 0 || values[k - 1] <= value), last: variables[0].values[last.dataset.row] === variables[0].to, chosen: choice.row === Number(last.dataset.row) && Boolean(document.querySelector("#rows_body tr.chosen")) };
  answer(told);
})();

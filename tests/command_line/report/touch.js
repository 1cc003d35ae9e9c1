// Points at things and clicks them as a reader does, adds columns by parts of names, takes things away.
(async () => {
  const id = (name) => document.getElementById(name);
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  await wait(300);
  // Plots below the first screen come when there is time.
  while (linkdyn.plots.list.some(({ u }) => !u)) await wait(50);
  const { stage, plots, player, shapes, mechanism, exports, units } = linkdyn;
  const told = { first: plots.list.map((plot) => plot.columns.map(({ name }) => name)), over: plots.abscissa.name };
  told.peaks = plots.list.flatMap(({ labels }) => labels.map(({ text }) => text));
  id("abscissa").value = "0"; id("abscissa").dispatchEvent(new Event("change"));
  await wait(100);
  told.peaks_in_time = plots.list.flatMap(({ labels }) => labels.map(({ text }) => text));
  id("cut").click();
  await wait(100);
  told.uncut = plots.list[0].u.scales["N*m"].max;
  id("cut").click();

  // Pins, bodies, curves.
  const send = (type, place) => {
    const box = stage.canvas.getBoundingClientRect();
    const event = { clientX: box.left + place[0], clientY: box.top + place[1], pointerType: "mouse", bubbles: true };
    stage.canvas.dispatchEvent(type === "click" ? new MouseEvent(type, event) : new PointerEvent(type, event));
  };
  const g = mechanism.joints.findIndex(({ name }) => name === "d"), pin = stage.to(shapes.place(mechanism.joints[g].between[1], player.row));
  send("pointermove", pin);
  told.pin = id("tip").hidden ? null : id("tip").textContent;
  const before = plots.list.length;
  send("click", pin);
  told.opened = plots.list.slice(before).map((plot) => plot.columns.map(({ name }) => name));
  send("click", pin);
  told.opened_twice = plots.list.length - before;
  const [a, b] = [0, 1].map((number) => stage.to(shapes.place([5, number], player.row)));
  send("pointermove", [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
  told.body = id("tip").textContent;
  stage.canvas.dispatchEvent(new PointerEvent("pointerleave", { bubbles: true }));
  told.left = id("tip").hidden;
  const plot = plots.list[0], box = plot.u.over.getBoundingClientRect(), factor = units.of("N*m").factor;
  const y = plot.u.valToPos(plot.columns[0].values[600] * factor, "N*m"), x = plot.u.valToPos(linkdyn.time[600], "x");
  plot.u.over.dispatchEvent(new PointerEvent("pointermove", { clientX: box.left + x, clientY: box.top + y, pointerType: "mouse", bubbles: true }));
  told.curve = [player.row, id("tip").textContent];

  // Columns by a part of a name, and by a pattern.
  const add = (text) => { const input = plots.list[0].chips.querySelector("input"); input.value = text; input.dispatchEvent(new Event("change")); return plots.list.map((plot) => plot.columns.length); };
  told.part = add("SHAKING.mom") && plots.list[0].columns.map(({ name }) => name);
  add("joint.*.eccentricity");
  told.pattern = new Set(plots.list.flatMap(({ columns }) => columns.map(({ name }) => name)).filter((name) => name.endsWith(".eccentricity"))).size;

  // What is taken away.
  const parsed = (text) => { const made = new DOMParser().parseFromString(text, "image/svg+xml"); return { sound: !made.querySelector("parsererror"), paths: made.querySelectorAll("path").length, texts: [...made.querySelectorAll("text")].map((node) => node.textContent) }; };
  told.plot_svg = parsed(exports.plotSvg(plots.list[0]));
  told.pose_svg = parsed(exports.poseSvg());
  told.csv = exports.csv(plots.list[0]).split("\n").length;
  told.png = (await exports.plotPng(plots.list[0])).size;

  // An instant in the address, and round-off.
  location.hash = "#t=1.2";
  await wait(200);
  told.instant = linkdyn.time[player.row];
  const extremes = [...document.querySelectorAll("summary")].find((node) => node.textContent.startsWith("Extremes")).parentElement;
  extremes.open = true;
  await wait(200);
  const cells = [...extremes.querySelectorAll("tbody tr")].map((row) => [...row.cells].map((cell) => cell.textContent));
  told.extremes = [cells[0][0], cells.find(([name]) => name === "joint.a.tangential_force")];
  told.short = [...document.querySelectorAll("#short tbody tr")].map((row) => [...row.cells].map((cell) => cell.textContent).slice(0, 2));
  told.requests = performance.getEntriesByType("resource").length;
  answer(told);
})();

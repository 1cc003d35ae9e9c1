// Uses the page as a reader does: scrub bar, buttons, keys, plots; tells what it shows.
(async () => {
  const id = (name) => document.getElementById(name);
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  const { player, plots, stage } = linkdyn;
  // A browser that draws to no screen gives frames as it likes, under load none: here they come with the virtual time.
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  const told = { rows: linkdyn.rows, poses: {} };
  const scrub = (row) => { id("scrub").value = row; id("scrub").dispatchEvent(new Event("input")); };
  const picture = () => {
    stage.paint();
    return id("canvas").toDataURL();
  };

  await wait(300);
  // Plots below the first screen come when there is time.
  while (linkdyn.plots.list.some(({ u }) => !u)) await wait(50);
  told.plots = plots.list.map((plot) => ({ built: plot.u !== null, columns: plot.columns.map((column) => column.name) }));
  for (const row of [0, 90, linkdyn.rows - 1]) {
    scrub(row);
    told.poses[row] = [...document.querySelectorAll("#poses tbody tr")].map((line) => [line.cells[0].textContent, ...[...line.cells].slice(1).map((cell) => Number(cell.dataset.si))]);
  }
  scrub(0);
  const still = picture();
  told.inked = still.length;
  told.same = picture() === still;
  scrub(90);
  told.moves = picture() !== still;

  // Play, pause.
  scrub(0);
  id("play").click();
  await wait(1000);
  told.played = player.row;
  id("play").click();
  told.stopped = player.row;
  await wait(400);
  told.later = player.row;

  // Keys.
  const key = (name, more = {}) => document.body.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true, ...more }));
  scrub(10); key("ArrowRight"); told.right = player.row;
  key("ArrowLeft", { shiftKey: true }); told.left = player.row;
  key("End"); told.end = player.row;
  key("u"); told.units = id("units").value; told.si = document.querySelector("#poses td.number").textContent; key("u");
  key("d"); told.dark = document.documentElement.dataset.theme;
  await wait(200);

  // A cursor on a plot moves the mechanism, the mechanism moves the line on all plots.
  const over = plots.list[0].u.over, box = over.getBoundingClientRect();
  over.dispatchEvent(new PointerEvent("pointermove", { clientX: box.left + box.width / 2, clientY: box.top + 20, pointerType: "mouse", bubbles: true }));
  told.hovered = player.row;
  scrub(linkdyn.rows - 1);
  told.lines = plots.list.filter((plot) => !plot.across).map((plot) => parseFloat(/translateX\((.*)px/.exec(plot.line.style.transform)[1]) / plot.u.over.clientWidth);

  // Zoom, and time and the driver's value as abscissa. The path of a point has an axis of its own.
  const shared = plots.list.filter((plot) => !plot.across);
  told.over = id("abscissa").selectedOptions[0].textContent;
  id("abscissa").value = "0"; id("abscissa").dispatchEvent(new Event("change"));
  plots.setZoom([0.2, 0.4]);
  await wait(100);
  told.zoomed = shared.map((plot) => [plot.u.scales.x.min, plot.u.scales.x.max]);
  id("unzoom").click();
  id("abscissa").value = "1"; id("abscissa").dispatchEvent(new Event("change"));
  await wait(200);
  told.across = [plots.list[0].u.scales.x.min, plots.list[0].u.scales.x.max];
  const bare = picture();
  id("arrows").click();
  told.arrows = picture() !== bare;
  answer(told);
})();

"use strict";
// Keys, light and dark, paper; starts the page.
(() => {
  const { element, player, stage, clearance, plots, theme, drawer, page, id } = linkdyn;
  theme.onChange(() => { stage.recolour(); clearance.draw(); });

  const press = (name) => () => id(name).click();
  const speed = (by) => () => { const at = linkdyn.speeds.indexOf(player.speed) + by; if (at >= 0 && at < linkdyn.speeds.length) { id("speed").value = player.speed = linkdyn.speeds[at]; } };
  page.listen(
    ["Space", "play or pause", [" "], () => player.toggle()],
    ["← →", "previous or next instant; with Shift ten instants", ["ArrowLeft", "ArrowRight"], (event) => player.step((event.key === "ArrowLeft" ? -1 : 1) * (event.shiftKey ? 10 : 1))],
    ["Home End", "first or last instant", ["Home", "End"], (event) => player.step(event.key === "Home" ? -linkdyn.rows : linkdyn.rows)],
    ["↑ ↓", "faster or slower", ["ArrowUp", "ArrowDown"], (event) => speed(event.key === "ArrowUp" ? 1 : -1)()],
    ["+ − 0", "zoom in, zoom out, fit the whole mechanism", ["+", "=", "-", "0"], (event) => event.key === "0" ? stage.whole() : stage.zoom(event.key === "-" ? 0.8 : 1.25)],
    ["f", "force arrows of joints", ["f"], press("arrows")],
    ["l", "names of bodies", ["l"], () => id("show").querySelector("input").click()],
    ["z", "full range of the plots", ["z"], press("unzoom")],
    ["o", "display and export", ["o"], press("options")],
    ["Esc", "close display and export", ["Escape"], () => { drawer.open = false; }],
    page.withUnits(),
  );
  id("keys").append(element("div", {}, element("kbd", { text: "drag" }), " moves the drawing; the wheel with Ctrl or Shift, or two fingers, zoom it"));

  // Paper is as wide as paper is.
  const PAPER = { width: 684, height: 300, plot: 312 };
  let printing = false;

  // The drawing takes the height that is left of the window below what stands above it.
  const resize = () => {
    document.documentElement.style.setProperty("--above", `${Math.round(id("motion").getBoundingClientRect().top + scrollY)}px`);
    stage.resize();
  };
  resize();
  page.paper((on) => {
    printing = on;
    plots.list.forEach((plot) => plot.fit(on ? PAPER.plot : undefined));
    stage.resize(on ? PAPER : undefined);
  });
  new ResizeObserver(() => setTimeout(() => { if (!printing) resize(); }, 0)).observe(id("stage"));
  clearance.draw();
  plots.start();
  page.ready();
})();

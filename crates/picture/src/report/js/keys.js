"use strict";
// Keys, light and dark, paper; starts the page.
(() => {
  const { element, player, stage, clearance, plots, units, theme, drawer, rows } = linkdyn;
  const id = (name) => document.getElementById(name);
  const scrub = id("scrub");

  // Units, light and dark.
  id("units").addEventListener("change", () => { units.system = id("units").value; });
  id("theme").addEventListener("click", theme.toggle);
  const lit = () => { stage.recolour(); clearance.draw(); };
  theme.onChange(lit);

  const press = (name) => () => id(name).click();
  const speed = (by) => () => { const at = linkdyn.speeds.indexOf(player.speed) + by; if (at >= 0 && at < linkdyn.speeds.length) { id("speed").value = player.speed = linkdyn.speeds[at]; } };
  const keys = [
    ["Space", "play or pause", [" "], () => player.toggle()],
    ["← →", "one instant back or on; with Shift ten", ["ArrowLeft", "ArrowRight"], (event) => player.step((event.key === "ArrowLeft" ? -1 : 1) * (event.shiftKey ? 10 : 1))],
    ["Home End", "first or last instant", ["Home", "End"], (event) => player.step(event.key === "Home" ? -rows : rows)],
    ["↑ ↓", "faster or slower", ["ArrowUp", "ArrowDown"], (event) => speed(event.key === "ArrowUp" ? 1 : -1)()],
    ["+ − 0", "closer, farther, whole mechanism", ["+", "=", "-", "0"], (event) => event.key === "0" ? stage.whole() : stage.zoom(event.key === "-" ? 0.8 : 1.25)],
    ["f", "force arrows of joints", ["f"], press("arrows")],
    ["l", "names of bodies", ["l"], () => id("show").querySelector("input").click()],
    ["u", "units", ["u"], () => { units.system = id("units").value = units.system === "si" ? "engineering" : "si"; }],
    ["z", "whole range of the plots", ["z"], press("unzoom")],
    ["d", "light or dark", ["d"], () => theme.toggle()],
    ["o", "what is drawn", ["o"], press("options")],
    ["?", "these keys", ["?"], press("help")],
  ];
  keys.forEach(([shown, does]) => id("keys").append(element("div", {}, element("kbd", { text: shown }), ` ${does}`)));
  id("keys").append(element("div", {}, element("kbd", { text: "drag" }), " moves the drawing; wheel with Ctrl or Shift, or two fingers, zoom it"));
  id("help").addEventListener("click", () => { id("keys").hidden = !id("keys").hidden; id("help").setAttribute("aria-expanded", !id("keys").hidden); });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { target } = event;
    if (event.key === "Escape") { drawer.open = false; return; }
    const writes = target.matches("input[type=text], select");
    const slides = target.matches("input[type=range]") && target !== scrub;
    const presses = event.key === " " && target.matches("button, input[type=checkbox]") && target !== id("play");
    if (writes || presses || (slides && event.key.startsWith("Arrow"))) return;
    const found = keys.find(([, , names]) => names.includes(event.key));
    if (!found) return;
    event.preventDefault();
    found[3](event);
  });

  // Paper is light, and as wide as paper is.
  const PAPER = { width: 684, height: 300, plot: 312 };
  let printing = false;
  const paper = (on) => {
    printing = on;
    theme.paper = on;
    plots.list.forEach((plot) => plot.fit(on ? PAPER.plot : undefined));
    stage.resize(on ? PAPER : undefined);
  };
  window.addEventListener("beforeprint", () => paper(true));
  window.addEventListener("afterprint", () => paper(false));

  // The drawing takes the height that is left of the window below what stands above it.
  const resize = () => {
    document.documentElement.style.setProperty("--above", `${Math.round(id("motion").getBoundingClientRect().top + scrollY)}px`);
    stage.resize();
  };
  if (matchMedia("print").matches) paper(true); else resize();
  new ResizeObserver(() => setTimeout(() => { if (!printing) resize(); }, 0)).observe(id("stage"));
  clearance.draw();
  plots.start();
  document.documentElement.dataset.ready = "true";
})();

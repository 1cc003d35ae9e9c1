"use strict";
// Buttons, keys, light and dark, printing; starts the page.
(() => {
  const { element, plain, player, stage, clearance, plots, units, theme, summary, rows, time, mechanism, shapes, column } = linkdyn;
  const id = (name) => document.getElementById(name);
  const words = (text) => String(text).replaceAll("_", " ");

  // Head.
  const title = plain(summary.model.name);
  document.title = `${title} – linkdyn`;
  const put = (name, text) => { const node = id(name); node.textContent = text ? plain(text) : ""; node.classList.add("text"); node.hidden = !text; };
  put("name", summary.model.name);
  put("about", linkdyn.about);
  put("origin", linkdyn.source);
  const ok = summary.status === "completed";
  put("status", words(summary.status));
  id("status").classList.add(ok ? "good" : summary.status === "completed_with_gaps" ? "warn" : "bad");
  const kind = words((summary.settings || {}).type || "");
  const range = rows > 1 ? `, ${units.number(time[0], 4)} … ${units.number(time[rows - 1], 6)} s` : "";
  put("analysis", `${kind}: ${rows === 1 ? "1 instant" : `${rows} instants`}${range}, ${linkdyn.width} columns`);
  const notes = [...(summary.message ? [summary.message] : []), ...summary.warnings.slice(0, 5), ...linkdyn.notes];
  notes.forEach((text) => id("notes").append(element("p", { text, className: "text" })));
  id("notes").hidden = !notes.length;
  put("foot", `linkdyn ${summary.engine}. All numbers are in results.csv beside this file, in SI units.`);
  if (rows === 0) put("undrawn", `There is no result to show: ${words(summary.status)}${summary.message ? ", for the reason given above" : ""}.`);
  else if (mechanism.bodies.length < 2) put("undrawn", "The drawing of this model is not in this page.");
  else if (!shapes.known) put("undrawn", "The poses of the bodies are not in this page, so that there is nothing to draw.");

  if (rows === 0) {
    for (const name of ["side", "view", "canvas"]) id(name).hidden = true;
    id("motion").classList.add("empty");
  }

  // Transport.
  const scrub = id("scrub");
  id("transport").hidden = rows < 2;
  scrub.max = Math.max(rows - 1, 0);
  for (const name of ["first", "back", "play", "next", "last", "scrub"]) id(name).disabled = rows < 2;
  scrub.addEventListener("input", () => { player.pause(); player.seek(Number(scrub.value)); });
  id("play").addEventListener("click", player.toggle);
  id("back").addEventListener("click", () => player.step(-1));
  id("next").addEventListener("click", () => player.step(1));
  id("first").addEventListener("click", () => player.step(-rows));
  id("last").addEventListener("click", () => player.step(rows));
  id("loop").addEventListener("change", () => { player.repeat = id("loop").checked; });
  const SPEEDS = [0.125, 0.25, 0.5, 1, 2, 4];
  const rateOf = (speed) => { const before = player.speed; player.speed = speed; const rate = player.rate(); player.speed = before; return rate; };
  id("speed").append(...SPEEDS.map((speed) => element("option", { value: speed, text: `${units.number(rateOf(speed), 2)} ×` })), element("option", { value: "real", text: "real time" }));
  id("speed").value = "1";
  id("speed").addEventListener("change", () => { player.speed = id("speed").value === "real" ? "real" : Number(id("speed").value); });
  player.onState(() => { id("play").textContent = player.playing ? "⏸ Pause" : "▶ Play"; id("play").setAttribute("aria-pressed", player.playing); });
  const drivers = mechanism.drivers.map(({ name }) => [name, column(`driver.${name}.value`)]).filter(([, found]) => found).slice(0, 2);
  const tell = () => {
    const { row } = player;
    scrub.value = row;
    const parts = rows ? [`t = ${units.number(time[row], 5)} s`, ...drivers.map(([name, found]) => `${plain(name)} ${units.quantity(found.values[row], found.unit)}`)] : [];
    id("now").textContent = parts.join("   ");
    scrub.setAttribute("aria-valuetext", parts.join(", "));
  };

  // Events on the scrub bar.
  if (rows > 1) for (const event of summary.events.slice(0, 300)) {
    const [from, to] = [event.time, linkdyn.eventEnd(event)].map((instant) => 100 * player.rowAt(instant) / (rows - 1));
    const told = `${linkdyn.eventWord(event)} at ${units.number(event.time, 6)} s${event.joint === undefined ? "" : ` (joint ${plain(event.joint)})`}`;
    const mark = element("button", { type: "button", className: to > from ? "span" : "", title: told, "aria-label": told, tabindex: "-1", on: { click: () => { player.pause(); player.seek(player.rowAt(event.time)); } } });
    mark.style.left = `${from}%`;
    if (to > from) mark.style.width = `${to - from}%`;
    id("marks").append(mark);
  }

  // What is drawn.
  const { options } = stage;
  const box = (text, on, change) => {
    const input = element("input", { type: "checkbox", on: { change: () => { change(input.checked); stage.draw(); } } });
    input.checked = on;
    return element("label", {}, input, element("span", { text, className: "text" }));
  };
  const kinds = { bodies: "Bodies' names", joints: "Joints' names", points: "Points", centres: "Centres of mass", drivers: "Drivers" };
  for (const [key, text] of Object.entries(kinds)) id("show").append(box(text, options.show[key], (on) => { options.show[key] = on; }));
  id("arrows").disabled = !stage.hasForces;
  if (!stage.hasForces && !mechanism.loads.length) id("forces").hidden = true;
  id("arrows").addEventListener("change", () => { options.arrows = id("arrows").checked; stage.draw(); });
  id("loads").addEventListener("change", () => { options.loads = id("loads").checked; stage.draw(); });
  id("arrow_scale").addEventListener("input", () => { options.arrowScale = Number(id("arrow_scale").value); stage.draw(); });
  const points = mechanism.bodies.flatMap(({ name, points }, body) => body ? points.map(([point], number) => [`${name}.${point}`, `${body},${number}`]) : []).slice(0, 300);
  id("follow").append(element("option", { value: "", text: "nothing" }), ...points.map(([text, value]) => element("option", { value, text })));
  id("follow").addEventListener("change", () => { options.follow = id("follow").value ? id("follow").value.split(",").map(Number) : null; if (options.follow) stage.draw(); else stage.whole(); });
  const order = [...points].sort((a, b) => options.traces.has(b[1]) - options.traces.has(a[1]));
  id("traces").append(...order.map(([text, key]) => box(text, options.traces.has(key), (on) => on ? options.traces.add(key) : options.traces.delete(key))));
  id("closer").addEventListener("click", () => stage.zoom(1.25));
  id("farther").addEventListener("click", () => stage.zoom(0.8));
  id("whole").addEventListener("click", stage.whole);

  // Units, light and dark.
  id("units").addEventListener("change", () => { units.system = id("units").value; });
  id("theme").addEventListener("click", theme.toggle);
  const lit = () => { id("theme").textContent = theme.dark ? "Light" : "Dark"; stage.recolour(); clearance.draw(); };
  theme.onChange(lit);
  units.onChange(tell);
  player.onRow(tell);

  // Keys.
  const press = (name) => () => id(name).click();
  const speed = (by) => () => { const at = SPEEDS.indexOf(player.speed) + by; if (at >= 0 && at < SPEEDS.length) { id("speed").value = player.speed = SPEEDS[at]; } };
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
    ["?", "these keys", ["?"], press("help")],
  ];
  keys.forEach(([shown, does]) => id("keys").append(element("div", {}, element("kbd", { text: shown }), ` ${does}`)));
  id("keys").append(element("div", {}, element("kbd", { text: "drag" }), " moves the drawing; wheel with Ctrl or Shift, or two fingers, zoom it"));
  id("help").addEventListener("click", () => { id("keys").hidden = !id("keys").hidden; id("help").setAttribute("aria-expanded", !id("keys").hidden); });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { target } = event;
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
  const paper = (on) => {
    theme.paper = on;
    plots.list.forEach((plot) => plot.fit(on ? PAPER.plot : undefined));
    stage.resize(on ? PAPER : undefined);
  };
  window.addEventListener("beforeprint", () => paper(true));
  window.addEventListener("afterprint", () => paper(false));

  new ResizeObserver(() => stage.resize()).observe(id("stage"));
  lit();
  tell();
  document.documentElement.dataset.ready = "true";
})();

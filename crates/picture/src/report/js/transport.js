"use strict";
// Playing: the scrub bar with the events of the run, buttons, speed.
(() => {
  const { element, plain, player, units, summary, mechanism, column, id } = linkdyn;
  const scrub = id("scrub");
  id("transport").hidden = linkdyn.rows < 2;
  const extend = () => { scrub.max = Math.max(linkdyn.rows - 1, 0); scrub.value = player.row; };
  extend();
  for (const name of ["first", "back", "play", "next", "last", "scrub"]) id(name).disabled = linkdyn.rows < 2;
  id("back").addEventListener("click", () => player.step(-1));
  id("next").addEventListener("click", () => player.step(1));
  id("first").addEventListener("click", () => player.step(-linkdyn.rows));
  id("last").addEventListener("click", () => player.step(linkdyn.rows));
  const SPEEDS = [0.125, 0.25, 0.5, 1, 2, 4];
  const rateOf = (speed) => { const before = player.speed; player.speed = speed; const rate = player.rate(); player.speed = before; return rate; };
  id("speed").append(...SPEEDS.map((speed) => element("option", { value: speed, text: `${units.number(rateOf(speed), 2)} ×` })), element("option", { value: "real", text: "real time" }));
  id("speed").value = "1";
  id("speed").addEventListener("change", () => { player.speed = id("speed").value === "real" ? "real" : Number(id("speed").value); });
  const drivers = mechanism.drivers.map(({ name }) => [name, column(`driver.${name}.value`)]).filter(([, found]) => found).slice(0, 2);
  const tell = () => {
    const { row } = player;
    const parts = linkdyn.rows ? [`t = ${units.number(linkdyn.time[row], 5)} s`, ...drivers.map(([name, found]) => `${plain(name)} ${units.quantity(found.values[row], found.unit)}`)] : [];
    id("now").textContent = parts.join("  ");
    scrub.setAttribute("aria-valuetext", parts.join(", "));
  };

  // Events on the scrub bar.
  const flag = () => { id("marks").replaceChildren(); if (linkdyn.rows > 1) for (const event of summary.events.slice(0, 300)) {
    const [from, to] = [event.time, linkdyn.eventEnd(event)].map((instant) => 100 * player.rowAt(instant) / (linkdyn.rows - 1));
    const words = `${linkdyn.eventWord(event)} at ${units.number(event.time, 6)} s${event.joint === undefined ? "" : ` (joint ${plain(event.joint)})`}`;
    const mark = element("button", { type: "button", className: `${to > from ? "span " : ""}${event.type}`, title: words, "aria-label": words, tabindex: "-1", on: { click: () => { player.pause(); player.seek(player.rowAt(event.time)); } } });
    mark.style.left = `${from}%`;
    if (to > from) mark.style.width = `${to - from}%`;
    id("marks").append(mark);
  } };
  flag();

  units.onChange(tell);
  linkdyn.onData(() => { extend(); flag(); tell(); });
  player.onRow(tell);
  tell();
  linkdyn.speeds = SPEEDS;
})();

"use strict";
// The runs: a colour and a dash for each, the reference grey; switches that take their curves off.
(() => {
  const { given, runs, ran, reference, element, axes, colour, theme, id } = linkdyn;
  // On paper, which may be grey; on a screen dashes hide what is narrow.
  const DASHES = [[], [9, 4], [2, 2], [12, 3, 3, 3], []];
  const listeners = [];
  // Black is too near to the grey of the reference.
  const hues = given.palette.curves.slice(1);
  const stroke = (run) => run === reference ? colour("ground") : hues[(ran.indexOf(run) - 1) % hues.length][theme.dark ? "dark" : "light"];
  const dash = (run) => run === reference || !models.paper ? [] : DASHES[ran.indexOf(run) % DASHES.length];
  const width = (run) => run === reference ? 2.6 : 1.5;

  const swatch = (run, wide = 24) => axes.swatch(stroke(run), { wide, width: width(run) + 0.7, dash: dash(run), className: "swatch" });

  const models = { paper: false, stroke, dash, width, swatch, onChange: (listen) => listeners.push(listen) };
  linkdyn.models = models;

  const box = id("runs");
  const fill = () => box.replaceChildren(...runs.map((run) => {
    const badge = run.sort === "good" ? [] : [element("span", { className: `badge ${run.sort}`, text: run.ended })];
    if (!run.rows) return element("span", { className: "run none", title: linkdyn.plain(run.facts) }, element("span", { text: run.name, className: "text" }), " ", ...badge);
    const tick = element("input", { type: "checkbox", on: { change: () => { run.on = tick.checked; label.classList.toggle("off", !run.on); listeners.forEach((listen) => listen()); } } });
    tick.checked = run.on;
    const label = element("label", { className: run.on ? "run" : "run off", title: linkdyn.plain(run.facts) }, tick, swatch(run), element("span", { text: run.name, className: "text" }), ...badge);
    return label;
  }));
  fill();
  theme.onChange(fill);
})();

"use strict";
// The head, what the reader should know, keys, paper.
(() => {
  const { given, element, plain, theme, choice } = linkdyn;
  const id = (name) => document.getElementById(name);
  document.title = `${plain(given.model)} – accuracy – linkdyn`;
  id("name").textContent = plain(given.model);
  id("name").classList.add("text");
  id("assumed").textContent = plain(given.assumed);
  given.warnings.forEach((text) => id("notes").append(element("p", { text, className: "text" })));
  id("notes").hidden = !given.warnings.length;
  const words = ["First order: all sources at their limits, linearly.", "Worst found: the farthest that was found with full kinematics.", "Certified: nothing goes beyond, by interval arithmetic."];
  const unasked = ["Worst found and certified bound were not asked for.", "The certified bound was not asked for."][given.level];
  const levels = [...words.slice(0, given.level + 1), "±3σ: spread to first order.", ...(unasked ? [unasked] : [])].join(" ");
  const files = `linkdyn ${given.engine}. All numbers are in accuracy.csv, contributions.csv and accuracy.json beside this file, in SI units.`;
  for (const text of [...(given.about ? [given.about] : []), levels, ...given.notes, files]) id("foot").append(element("p", { text, className: "text" }));

  id("results").hidden = !linkdyn.outputs.length;
  id("theme").addEventListener("click", () => theme.toggle());
  const keys = { d: () => theme.toggle(), ...(choice ? { ArrowLeft: () => choice.seek(choice.number - 1), ArrowRight: () => choice.seek(choice.number + 1), z: () => linkdyn.bandPlot.look() } : {}) };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT)$/.test(event.target.tagName) || !Object.hasOwn(keys, event.key)) return;
    keys[event.key]();
    event.preventDefault();
  });
  addEventListener("beforeprint", () => { theme.paper = true; });
  addEventListener("afterprint", () => { theme.paper = false; });
  document.documentElement.dataset.ready = "true";
})();

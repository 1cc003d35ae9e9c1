"use strict";
// The head, what the reader should know, keys, paper.
(() => {
  const { given, choice, page, id } = linkdyn;
  const words = ["First order: all sources at their limits, linearly.", "Worst found: the largest deviation that was found with full kinematics.", "Certified: no deviation is larger, proved by interval arithmetic."];
  const missing = ["The worst found and the certified bound were not requested.", "The certified bound was not requested."][given.level];
  const levels = [...words.slice(0, given.level + 1), "±3σ: spread to first order.", ...(missing ? [missing] : [])].join(" ");
  page.head({
    kind: "accuracy", name: given.model, line: `accuracy, ${given.assumed}`, notes: given.warnings,
    foot: [...(given.about ? [given.about] : []), levels, ...given.notes], files: "accuracy.csv, contributions.csv and accuracy.json beside this file",
  });

  id("results").hidden = !linkdyn.outputs.length;
  page.listen(...(choice ? [
    ["← →", "previous or next position", ["ArrowLeft", "ArrowRight"], ({ key }) => choice.seek(choice.number + (key === "ArrowLeft" ? -1 : 1))],
    ["z", "zoom in", ["z"], () => linkdyn.bandPlot.look()],
  ] : []));
  page.paper();
  page.ready();
})();

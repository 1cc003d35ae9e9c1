"use strict";
// The head, what the reader should know, keys, paper.
(() => {
  const { given, runs, ran, cards, models, page, words } = linkdyn;

  // What went wrong stands on top.
  const notes = runs.filter(({ sort }) => sort === "warn" || sort === "bad").flatMap((run) => run.notes.slice(0, 2).map((note) => `${run.name}: ${note}`));
  if (ran.length === 1) notes.push(`There is nothing to compare ${ran[0].name} with: no other model was run.`);
  else if (!given.columns.length) notes.push("The results have none of the columns that are compared.");
  const more = runs.filter(({ sort }) => sort === "good").flatMap((run) => run.notes.map((note) => `${run.name}: ${note}`));
  const kinds = [...new Set(runs.flatMap(({ events }) => events.map(([kind]) => words(kind))))];
  const contacts = kinds.length ? [`Marks at the bottom of the plots, in the colour of the model: ${kinds.join(", ")}.`] : [];
  page.head({
    kind: "comparison", name: given.model, line: given.changes, notes, foot: [...(given.about ? [given.about] : []), ...contacts, ...more, ...given.notes],
    files: "compare.csv and compare.json beside this file, and in the folder of each model",
  });
  page.listen(["z", "full range", ["z"], () => cards.setZoom(null)], page.withUnits());

  // On paper two plots stand in a row.
  const PAPER = 330;
  page.paper((on) => { models.paper = on; cards.list.forEach((card) => card.fit(on ? PAPER : undefined)); });
  page.ready();
})();

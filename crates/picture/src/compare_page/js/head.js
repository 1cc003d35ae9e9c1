"use strict";
// The head, what the reader should know, keys, paper.
(() => {
  const { given, runs, ran, element, plain, units, theme, cards, models } = linkdyn;
  const id = (name) => document.getElementById(name);
  document.title = `${plain(given.model)} – comparison – linkdyn`;
  id("name").textContent = plain(given.model);
  id("name").classList.add("text");
  id("changes").textContent = plain(given.changes);

  // What went wrong stands on top.
  const notes = runs.filter(({ sort }) => sort === "warn" || sort === "bad").flatMap((run) => run.notes.slice(0, 2).map((note) => `${run.name}: ${note}`));
  if (ran.length === 1) notes.push(`There is nothing to compare ${ran[0].name} with: no other model was run.`);
  else if (!given.columns.length) notes.push("The results have none of the columns that are compared.");
  notes.forEach((text) => id("notes").append(element("p", { text, className: "text" })));
  id("notes").hidden = !notes.length;
  const more = runs.filter(({ sort }) => sort === "good").flatMap((run) => run.notes.map((note) => `${run.name}: ${note}`));
  const kinds = [...new Set(runs.flatMap(({ events }) => events.map(([kind]) => kind.replaceAll("_", " "))))];
  const contacts = kinds.length ? [`Marks at the foot of the plots, in the colour of the model: ${kinds.join(", ")}.`] : [];
  const files = `linkdyn ${given.engine}. All numbers are in compare.csv and compare.json beside this file, and in the folder of each model, in SI units.`;
  for (const text of [...(given.about ? [given.about] : []), ...contacts, ...more, ...given.notes, files]) id("foot").append(element("p", { text, className: "text" }));

  const choose = (system) => { units.system = system; id("units").value = system; };
  id("units").addEventListener("change", () => choose(id("units").value));
  id("theme").addEventListener("click", () => theme.toggle());
  const keys = { u: () => choose(units.system === "si" ? "engineering" : "si"), d: () => theme.toggle(), z: () => cards.setZoom(null) };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT)$/.test(event.target.tagName) || !Object.hasOwn(keys, event.key)) return;
    keys[event.key]();
    event.preventDefault();
  });

  // Paper: light, two plots in a row.
  const PAPER = 330;
  const paper = (on) => { models.paper = on; theme.paper = on; cards.list.forEach((card) => card.fit(on ? PAPER : undefined)); };
  addEventListener("beforeprint", () => paper(true));
  addEventListener("afterprint", () => paper(false));
  if (matchMedia("print").matches) paper(true);
  document.documentElement.dataset.ready = "true";
})();

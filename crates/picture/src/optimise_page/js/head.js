"use strict";
// The head, the tables, keys.
(() => {
  const { given, element, page, player, overlay, id } = linkdyn;
  const { name, row, heads, scroll, folded } = linkdyn.tables;
  const [word, found] = given.status;
  id("status").textContent = linkdyn.words(word);
  id("status").classList.add(found ? "good" : "bad");
  page.head({ kind: "optimum", name: given.model, line: given.verdict, notes: given.warnings, foot: given.about ? [given.about] : [], files: "optimise.json and evaluations.csv beside this file" });

  // Marks stand with the name, where they are seen at any width; columns without any word are left out.
  const isText = (text) => typeof text === "string" && text !== "";
  const named = ([text, ...rest]) => element("td", {}, name(text), ...rest.filter(Array.isArray).flatMap(([word, sort]) => [" ", element("span", { text: word, className: `badge ${sort}` })]));
  for (const { title, heads: titles, rows } of given.tables) {
    const has = titles.map((_, k) => rows.some((cells) => isText(cells[k]))), only = (list) => list.filter((_, k) => k && has[k]);
    const body = element("tbody", {}, ...rows.map((cells) => row(named(cells), ...only(cells).map((text) => element("td", { text, className: "number" })))));
    id("tables").append(folded(title, {}, scroll({}, heads(titles[0], ...only(titles).map((text) => [text])), body)).root);
  }
  page.listen(
    ["Space", "play or pause", [" "], () => player.toggle()],
    ["← →", "previous or next instant", ["ArrowLeft", "ArrowRight"], (event) => player.step(event.key === "ArrowLeft" ? -1 : 1)],
  );
  page.paper(() => overlay.draw());
  page.ready();
})();

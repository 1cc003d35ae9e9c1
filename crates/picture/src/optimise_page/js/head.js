"use strict";
// The head, the tables, keys.
(() => {
  const { given, element, page, player, overlay, id } = linkdyn;
  const { name, row, heads, scroll, folded } = linkdyn.tables;
  const [word, found] = given.status;
  id("status").textContent = linkdyn.words(word);
  id("status").classList.add(found ? "good" : "bad");
  page.head({ kind: "optimum", name: given.model, line: given.verdict, notes: given.warnings, foot: given.about ? [given.about] : [], files: "optimise.json and evaluations.csv beside this file" });

  const cell = (text, k) => Array.isArray(text) ? element("td", {}, element("span", { text: text[0], className: `badge ${text[1]}` }))
    : k ? element("td", { text, className: "number" }) : element("td", {}, name(text));
  for (const { title, heads: titles, rows } of given.tables) {
    // Columns without any word are left out.
    const has = titles.map((_, k) => rows.some((cells) => cells[k] !== "")), only = (list) => list.filter((_, k) => has[k]);
    const body = element("tbody", {}, ...rows.map((cells) => row(...only(cells.map(cell)))));
    id("tables").append(folded(title, {}, scroll({}, heads(...only(titles.map((text, k) => k ? [text] : text))), body)).root);
  }
  page.listen(
    ["Space", "play or pause", [" "], () => player.toggle()],
    ["← →", "previous or next instant", ["ArrowLeft", "ArrowRight"], (event) => player.step(event.key === "ArrowLeft" ? -1 : 1)],
  );
  page.paper(() => overlay.draw());
  page.ready();
})();

"use strict";
// All plots: they share the part in view, the instant under the cursor and what is switched on.
(() => {
  const { Card, units, theme, models, columns, ran, times, runs, id } = linkdyn;
  const [first, last] = [times[0], times[times.length - 1]];

  const cards = {
    list: [], zoom: null, row: null, cut: true, differences: true,
    whole: last > first ? [first, last] : [first - 0.5, first + 0.5],
    setZoom(zoom) {
      cards.zoom = zoom;
      id("unzoom").hidden = !zoom;
      cards.build();
    },
    // The row nearest to an instant.
    point(instant) {
      cards.row = instant === null ? null : nearest(instant);
      cards.mark();
    },
    build() { cards.list.forEach((card) => card.build()); },
    mark() { cards.list.forEach((card) => card.mark()); },
  };
  const nearest = (instant) => {
    let [a, b] = [0, times.length - 1];
    while (a < b) { const middle = Math.ceil((a + b) / 2); if (times[middle] <= instant) a = middle; else b = middle - 1; }
    return a + 1 < times.length && times[a + 1] - instant < instant - times[a] ? a + 1 : a;
  };

  if (ran.length) columns.forEach((column, k) => { const card = new Card(cards, k); cards.list.push(card); id("cards").append(card.root); });
  cards.list.forEach((card) => card.fit());
  const isCut = ran.some(({ sets_scale }) => !sets_scale) || runs.some(({ cuts }) => cuts.some((found) => found.some((end) => end !== null)));
  id("cutting").hidden = !isCut;
  id("apart").hidden = ran.length < 2;
  for (const name of ["cut", "differences"]) id(name).addEventListener("change", () => { cards[name] = id(name).checked; cards.build(); });
  id("unzoom").addEventListener("click", () => cards.setZoom(null));
  models.onChange(() => cards.build());
  units.onChange(() => cards.build());
  theme.onChange(() => cards.build());
  linkdyn.cards = cards;
})();

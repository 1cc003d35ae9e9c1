// Where things are in the window, and which labels cover each other.
(async () => {
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  const box = (node) => node.getBoundingClientRect();
  const id = (name) => document.getElementById(name);
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  await wait(300);
  const { plots } = linkdyn;
  const first = box(plots.list[0].u.over), stage = box(id("stage"));
  const told = {
    width: innerWidth, height: innerHeight, scroll_width: document.documentElement.scrollWidth,
    first_bottom: first.bottom, first_tall: first.height, stage_tall: stage.height, stage_bottom: stage.bottom,
    beside: box(id("motion")).right <= box(id("results")).left,
  };
  scrollTo(0, document.documentElement.scrollHeight);
  // Told at once, since a browser without a screen gives frames as it likes.
  dispatchEvent(new Event("scroll"));
  await wait(200);
  const seen = (node) => { const { top, bottom, width } = box(node); return width > 60 && Math.min(bottom, innerHeight) - Math.max(top, 0) > 0.9 * (bottom - top); };
  told.in_sight_below = seen(id("stage")) || (!id("mini").hidden && seen(id("mini")));
  answer(told);
})();

"use strict";
// What is chosen: ranges of variables, the variants within all of them, and one variant.
(() => {
  const { variables, variants, theme, id } = linkdyn;
  const ranges = new Map(), painters = [], followers = [];
  let mask = null, count = 0, row = -1, wanted = false;

  // All plots are drawn at once, in the next frame.
  const paint = () => { wanted = false; painters.forEach((draw) => draw()); };
  const repaint = () => { if (!wanted) { wanted = true; requestAnimationFrame(paint); } };

  const sift = () => {
    mask = ranges.size ? new Uint8Array(variants).fill(1) : null;
    count = variants;
    if (mask) {
      for (const [{ values }, [from, to]] of ranges) for (let k = 0; k < variants; k++) if (!(values[k] >= from && values[k] <= to)) mask[k] = 0;
      count = mask.reduce((sum, one) => sum + one, 0);
    }
    id("selected").hidden = !mask;
    if (mask) {
      const what = [...ranges].map(([own, [from, to]]) => `${own.name} ${own.text(from, 4)} to ${own.text(to, 4)}`);
      id("selected_count").textContent = `${linkdyn.count(count)} of ${linkdyn.count(variants)}${linkdyn.sampled ? " drawn" : ""} variants selected`;
      id("selected_what").textContent = what.join(", ");
    }
    repaint();
  };

  linkdyn.choice = {
    ranges, repaint, paint,
    get mask() { return mask; },
    get count() { return count; },
    get row() { return row; },
    // These ranges and no others; or one more.
    select(list) { ranges.clear(); list.forEach(([own, range]) => ranges.set(own, range)); sift(); },
    narrow(own, range) { if (range) ranges.set(own, range); else ranges.delete(own); sift(); },
    clear() { if (ranges.size) { ranges.clear(); sift(); } },
    choose(chosen) { row = chosen; followers.forEach((follow) => follow(row)); repaint(); },
    onPaint: (draw) => painters.push(draw),
    onChoose: (follow) => followers.push(follow),
    variables,
  };
  id("unselect").addEventListener("click", () => linkdyn.choice.clear());
  theme.onChange(paint);
})();

// All labels of drawing and plots at some instants: how many there are, which cover another one or stand outside.
(async () => {
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  await wait(300);
  // Plots below the first screen come when there is time.
  while (linkdyn.plots.list.some(({ u }) => !u)) await wait(50);
  const { stage, plots, player, rows, mechanism, shapes } = linkdyn;
  if (stage.hasForces) document.getElementById("arrows").click();
  const meet = (a, b) => a.x < b.x + b.wide - 0.5 && b.x < a.x + a.wide - 0.5 && a.y < b.y + b.tall - 0.5 && b.y < a.y + a.tall - 0.5;
  const covering = (boxes) => boxes.flatMap((a, k) => boxes.slice(k + 1).filter((b) => meet(a, b)).map((b) => `${a.text} / ${b.text}`));
  const told = { drawn: 0, covering: [], outside: [], plots: 0, cut: [] };
  for (let k = 0; k <= 12; k++) {
    player.seek(Math.round(k * (rows - 1) / 12));
    stage.paint();
    const { width, height } = stage.size;
    told.drawn += stage.labels.length;
    told.cut.push(...stage.labels.filter(({ text }) => text.startsWith("> ")).map(({ text }) => text));
    told.covering.push(...covering(stage.labels));
    told.outside.push(...stage.labels.filter(({ x, y, wide, tall }) => x < 0 || y < 0 || x + wide > width || y + tall > height).map(({ text }) => text));
  }
  // The signs of pivots on the ground, and what stands at the foot of the drawing: ruler, legends of arrows.
  const { bar } = stage, grounded = mechanism.joints.filter(({ type, between }) => type === "revolute" && between.some(([body]) => body === 0));
  const signs = grounded.map(({ name, between }) => {
    const [x, y] = stage.to(shapes.place(between[between[0][0] === 0 ? 0 : 1], 0));
    return { x: x - 2.4 * bar, y, wide: 4.8 * bar, tall: 3.3 * bar, text: `ground of ${name}` };
  });
  told.signs = signs.length;
  const feet = stage.labels.filter(({ y, tall }) => y + tall > stage.size.height - 10 && tall > 20);
  told.feet = feet.length;
  told.covering.push(...signs.flatMap((sign) => feet.filter((foot) => meet(sign, foot)).map((foot) => `${sign.text} / ${foot.text}`)));
  for (const { labels, u } of plots.list) {
    told.plots += labels.length;
    told.covering.push(...covering(labels));
    const { left, top, width, height } = u.bbox;
    told.outside.push(...labels.filter(({ x, y, wide, tall }) => x < left || y < top || x + wide > left + width || y + tall > top + height).map(({ text }) => text));
  }
  // Text of the page itself: parts of the head, and of each plot's head.
  const boxes = (nodes) => [...nodes].map((node) => [node, node.getBoundingClientRect()]).filter(([, box]) => box.width > 0)
    .map(([node, box]) => ({ x: box.x, y: box.y, wide: box.width, tall: box.height, text: node.id || node.textContent }));
  told.covering.push(...covering(boxes(document.querySelectorAll("#headline > *, #switches > *, #about, #more, #stage, #transport > *, #plotbar > *"))));
  for (const { chips } of plots.list) told.covering.push(...covering(boxes(chips.querySelectorAll(":scope > .chip, :scope > input, .tools"))));
  answer(told);
})();

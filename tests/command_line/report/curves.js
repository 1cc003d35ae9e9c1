// How the plots of a page are laid out: which come first, and how much of its axis each curve of a place goes through.
(async () => {
  const wait = (time) => new Promise((done) => setTimeout(done, time));
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  await wait(300);
  // Plots below the first screen come when there is time.
  while (linkdyn.plots.list.some(({ u }) => !u)) await wait(50);
  const { plots } = linkdyn;
  const told = { order: plots.list.map(({ columns }) => columns.map(({ name }) => name)), bottoms: plots.list.map(({ u }) => u.over.getBoundingClientRect().bottom), height: innerHeight, shares: [], uneven: [], axes: [] };
  for (const plot of plots.list) {
    const { u } = plot;
    if (plot.equal) {
      const long = (scale, size) => size / (u.scales[scale].max - u.scales[scale].min);
      told.uneven.push(long("x", u.over.clientWidth) / long(plot.columns[0].unit, u.over.clientHeight));
      continue;
    }
    told.axes.push(u.axes.slice(1).map(({ label }) => label));
    if (plot.columns.length > 2 || !plot.columns.every(({ unit }) => unit === "m")) continue;
    plot.columns.forEach((column, k) => {
      const heights = u.data[k + 1].filter((value) => value !== null).map((value) => u.valToPos(value, plot.scale(column)));
      told.shares.push([column.name, (Math.max(...heights) - Math.min(...heights)) / u.over.clientHeight]);
    });
  }
  answer(told);
})();

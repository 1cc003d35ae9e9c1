// What the page of an optimum shows, at two instants.
setTimeout(() => {
  const { motions, history, overlay, player } = linkdyn, id = (name) => document.getElementById(name);
  const pixels = () => id("canvas").toDataURL();
  const first = pixels();
  player.seek(20);
  overlay.draw();
  const cells = (row) => [...row.cells].map((cell) => cell.textContent);
  answer({
    names: motions.map(({ name }) => name), rows: motions.map(({ rows }) => rows), path: motions.map(({ path }) => path.length),
    status: id("status").textContent, moves: first !== pixels(), box: overlay.box, curves: history.data.length - 1,
    last: history.data[1].filter((own) => own !== null).at(-1),
    tables: [...document.querySelectorAll("#tables section")].map((table) => [...table.querySelectorAll("tr")].map(cells)),
    wide: Math.max(document.documentElement.scrollWidth - innerWidth, 0),
  });
}, 500);

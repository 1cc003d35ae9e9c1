"use strict";
// Tables that fold: the first numbers, values at the instant shown, extremes.
(() => {
  const { element, units, player, columns, mechanism, column, choices, headline, id } = linkdyn;
  const { name, number, row, heads, scroll } = linkdyn.tables;
  const MOST = 400;
  const table = (title, options) => { const { box, root } = linkdyn.tables.folded(title, options); id("tables").append(root); return box; };
  const button = (text, title, click) => element("button", { type: "button", className: "text", text, title, on: { click } });
  const jump = (instant) => button(`${units.number(instant, 6)} s`, "Show this instant", () => { player.pause(); player.seek(player.nearest(instant)); });
  const plotting = (column, text = column.name) => button(text, `Plot ${column.name}`, () => linkdyn.plots.point(linkdyn.plots.add(column)));
  const instant = (...nodes) => element("td", { className: "number" }, ...nodes);

  // In short.
  const first = element("tbody");
  const short = () => first.replaceChildren(...headline.list.map(({ what, name: of, value, unit, row: at, column, unbounded }) => {
    const label = element("td", {}, what, ...(of ? [" ", column ? plotting(column, of) : name(of)] : []));
    return row(label, number(unbounded === undefined ? units.quantity(value, unit, 4) : "no bound"), instant(...(at === undefined && unbounded === undefined ? [] : [jump(unbounded ?? linkdyn.time[at])])));
  }));
  if (headline.list.length) table("In short").append(scroll({ id: "short" }, heads("quantity", ["value"], ["at"]), first));

  // Poses at the instant shown.
  const poses = mechanism.bodies.slice(1, 41).map((body) => ({ name: body.name, of: ["x", "y", "angle"].map((q) => column(`${body.name}.${q}`)) })).filter(({ of }) => of.every((found) => found && found.wanted));
  const cells = [];
  if (poses.length && linkdyn.rows) {
    const body = element("tbody");
    for (const pose of poses) {
      const tds = pose.of.map((column) => { const td = number(""); cells.push([td, column]); return td; });
      body.append(row(element("td", {}, name(pose.name)), ...tds));
    }
    table("Bodies at this instant").append(scroll({ id: "poses" }, heads("body", ["x"], ["y"], ["angle"]), body));
  }
  const values = () => cells.forEach(([td, column]) => {
    const value = column.values[player.row];
    td.textContent = linkdyn.textOf(column, player.row, 6);
    td.dataset.si = Number.isFinite(value) ? value : "";
  });

  // Smallest and largest value of each column, the interesting ones first: driving torques, forces in joints, outputs.
  const INTEREST = [/^driver\..*\.effort$/, /^joint\..*\.f$/, /^(transmission|output)\./, /^joint\..*\.(torque|normal_force|penetration|eccentricity)$/, /^shaking\.(f|moment)$/,
    /^[^.]+\.[^.]+\.[xy]$/, /\.(angle|omega)$/, /^energy\./, /^force\./, /\.(x|y|vx|vy|alpha)$/];
  const interest = ({ name }) => { const found = INTEREST.findIndex((pattern) => pattern.test(name)); return found < 0 ? INTEREST.length : found; };
  const shown = columns.filter((column) => column.wanted && column.name !== "time");
  const order = new Map();
  const ordered = () => {
    if (!order.size) for (const column of shown) order.set(column, choices.lives(column) ? interest(column) : INTEREST.length + 1);
    return [...shown].sort((a, b) => order.get(a) - order.get(b) || (order.get(a) === 1 ? choices.size(b) - choices.size(a) : 0));
  };
  const body = element("tbody"), more = element("p", { className: "hint" });
  const filter = element("input", { type: "text", id: "filter", placeholder: "only names with …", "aria-label": "Filter columns by name" });
  const fill = () => {
    const part = filter.value.trim().toLowerCase();
    const found = ordered().filter((column) => column.name.toLowerCase().includes(part));
    body.replaceChildren(...found.slice(0, MOST).map((column) => {
      const [low, high] = linkdyn.endRows(column);
      const known = (row) => row < 0 ? [number("–"), number("–")] : [number(linkdyn.textOf(column, row)), instant(jump(linkdyn.time[row]))];
      // A size has no bound above alone, its parts have none to both sides.
      const bound = headline.unbounded(column), none = () => [number("no bound"), instant(jump(bound))];
      const isSize = column.name.endsWith(".f");
      return row(element("td", {}, plotting(column)), ...(bound === undefined || isSize ? known(low) : none()), ...(bound === undefined ? known(high) : none()));
    }));
    more.textContent = found.length > MOST ? `${found.length - MOST} more: filter by name.` : "";
  };
  filter.addEventListener("input", fill);
  let filled = false;
  if (shown.length && linkdyn.rows) {
    const extremes = table("Extremes", { wide: true, open: false, note: `of ${shown.length} columns` });
    extremes.append(filter, scroll({}, heads("column", ["smallest"], ["at"], ["largest"], ["at"]), body), more);
    // Not before anybody looks: there may be thousands.
    extremes.addEventListener("toggle", () => { if (extremes.open && !filled) { filled = true; fill(); } });
  }

  let seen = true;
  if (cells.length) new IntersectionObserver(([entry]) => { seen = entry.isIntersecting; if (seen) values(); }).observe(id("poses"));
  player.onRow(() => { if (seen || !player.playing) values(); });
  units.onChange(() => { short(); values(); if (filled) fill(); });
  linkdyn.afterData(() => { order.clear(); short(); values(); if (filled) fill(); });
  short();
  values();
  Object.assign(linkdyn.tables, { table, jump });
})();

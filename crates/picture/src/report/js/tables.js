"use strict";
// Tables that fold: the first numbers, values at the instant shown, extremes.
(() => {
  const { element, units, player, columns, time, rows, mechanism, column, choices, headline } = linkdyn;
  const MOST = 400;
  const holder = document.getElementById("tables");
  const table = (title, { wide = false, open = true, note = "" } = {}) => {
    const box = element("details", {}, element("summary", {}, element("h2", { text: title }), ...(note ? [element("span", { text: note, className: "muted" })] : [])));
    box.open = open;
    holder.append(element("section", { className: wide ? "table wide" : "table" }, box));
    return box;
  };
  const name = (text) => element("span", { text, className: "text" });
  const number = (text) => element("td", { text, className: "number" });
  const nearest = (instant) => {
    const row = player.rowAt(instant);
    return row + 1 < rows && Math.abs(time[row + 1] - instant) < Math.abs(time[row] - instant) ? row + 1 : row;
  };
  const jump = (instant) => element("button", { type: "button", text: `${units.number(instant, 6)} s`, title: "Show this instant", on: { click: () => { player.pause(); player.seek(nearest(instant)); } } });
  const heads = (...texts) => element("thead", {}, element("tr", {}, ...texts.map(([text, right]) => element("th", { text, scope: "col", className: right ? "number" : "" }))));
  const scroll = (...parts) => element("div", { className: "scroll" }, element("table", {}, ...parts));
  const plotting = (column) => element("button", { type: "button", className: "text", text: column.name, title: "Plot", on: { click: () => linkdyn.plots.point(linkdyn.plots.add(column)) } });

  // In short.
  const first = element("tbody");
  const short = () => first.replaceChildren(...headline.list.map(({ what, name: of, value, unit, row, column, unbounded }) => {
    const label = element("td", {}, what, ...(of ? [" ", column ? element("button", { type: "button", className: "text", text: of, title: `Plot ${column.name}`, on: { click: () => linkdyn.plots.point(linkdyn.plots.add(column)) } }) : name(of)] : []));
    return element("tr", {}, label, number(unbounded === undefined ? units.quantity(value, unit, 4) : "no bound"), element("td", { className: "number" }, ...(row === undefined && unbounded === undefined ? [] : [jump(unbounded ?? time[row])])));
  }));
  if (headline.list.length) {
    const made = table("In short");
    made.append(scroll(heads(["quantity"], ["value", 1], ["at", 1]), first));
    made.querySelector("table").id = "short";
  }

  // Named numbers that the model asks for.
  const answers = Object.entries(linkdyn.summary.responses || {});
  const answered = element("tbody");
  const respond = () => answered.replaceChildren(...answers.map(([of, { value, unit, limits, reason }]) => {
    const told = value === null ? `none, ${reason}` : units.quantity(value, unit || "1", 6);
    const within = limits ? `${value === null ? "" : value < limits[0] || value > limits[1] ? "outside of " : "within "}${limits.map((limit) => units.quantity(limit, unit || "1", 4)).join(" … ")}` : "";
    return element("tr", {}, element("td", {}, name(of)), number(told), number(within));
  }));
  if (answers.length) {
    const made = table("Responses");
    made.append(scroll(heads(["response"], ["value", 1], ["limits", 1]), answered));
    made.querySelector("table").id = "responses";
  }

  // Poses at the instant shown.
  const poses = mechanism.bodies.slice(1, 41).map((body) => ({ name: body.name, of: ["x", "y", "angle"].map((q) => column(`${body.name}.${q}`)) })).filter(({ of }) => of.every((found) => found && found.wanted));
  const cells = [];
  if (poses.length && rows) {
    const body = element("tbody");
    for (const pose of poses) {
      const tds = pose.of.map((column) => { const td = number(""); cells.push([td, column]); return td; });
      body.append(element("tr", {}, element("td", {}, name(pose.name)), ...tds));
    }
    const made = table("Bodies at this instant");
    made.append(scroll(heads(["body"], ["x", 1], ["y", 1], ["angle", 1]), body));
    made.querySelector("table").id = "poses";
  }
  const values = () => cells.forEach(([td, column]) => {
    const value = column.values[player.row];
    td.textContent = linkdyn.told(column, player.row, 6);
    td.dataset.si = Number.isFinite(value) ? value : "";
  });

  // Smallest and largest value of each column, the interesting ones first: what drives, what carries, what the model asks for.
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
      const [low, high] = headline.ends(column);
      const instant = (text) => element("td", { className: "number" }, text);
      const known = (row) => row < 0 ? [number("–"), number("–")] : [number(linkdyn.told(column, row)), instant(jump(time[row]))];
      // A size has no bound above alone, its parts have none to both sides.
      const bound = headline.unbounded(column), none = () => [number("no bound"), instant(jump(bound))];
      const isSize = column.name.endsWith(".f");
      return element("tr", {}, element("td", {}, plotting(column)), ...(bound === undefined || isSize ? known(low) : none()), ...(bound === undefined ? known(high) : none()));
    }));
    more.textContent = found.length > MOST ? `${found.length - MOST} more: filter by name.` : "";
  };
  filter.addEventListener("input", fill);
  let filled = false;
  if (shown.length && rows) {
    const extremes = table("Extremes", { wide: true, open: false, note: ` of ${shown.length} columns` });
    extremes.append(filter, scroll(heads(["column"], ["smallest", 1], ["at", 1], ["largest", 1], ["at", 1]), body), more);
    // Not before anybody looks: there may be thousands.
    extremes.addEventListener("toggle", () => { if (extremes.open && !filled) { filled = true; fill(); } });
  }

  let seen = true;
  if (cells.length) new IntersectionObserver(([entry]) => { seen = entry.isIntersecting; if (seen) values(); }).observe(document.getElementById("poses"));
  player.onRow(() => { if (seen || !player.playing) values(); });
  units.onChange(() => { short(); respond(); values(); if (filled) fill(); });
  short();
  respond();
  values();
  linkdyn.tables = { holder, table, name, number, jump, heads, scroll };
})();

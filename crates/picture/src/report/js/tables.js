"use strict";
// Tables: values at the instant shown, extremes, how the run went.
(() => {
  const { element, units, player, summary, columns, time, rows, mechanism, column } = linkdyn;
  const MOST = 400;
  const holder = document.getElementById("tables");
  const words = (text) => String(text).replaceAll("_", " ");
  const table = (title, wide) => {
    const made = element("section", { className: wide ? "table wide" : "table" }, element("h2", { text: title }));
    holder.append(made);
    return made;
  };
  const name = (text) => element("span", { text, className: "text" });
  const number = (text) => element("td", { text, className: "number" });
  const jump = (instant) => element("button", { type: "button", text: `${units.number(instant, 6)} s`, title: "Show this instant", on: { click: () => { player.pause(); player.seek(nearest(instant)); } } });
  const nearest = (instant) => {
    const row = player.rowAt(instant);
    return row + 1 < rows && Math.abs(time[row + 1] - instant) < Math.abs(time[row] - instant) ? row + 1 : row;
  };
  const heads = (...texts) => element("thead", {}, element("tr", {}, ...texts.map(([text, right]) => element("th", { text, scope: "col", className: right ? "number" : "" }))));

  // Label and text, one below the other.
  const pairs = (title, list) => {
    const known = list.filter(([, value]) => value !== undefined && value !== null && value !== "");
    if (!known.length) return;
    const body = element("tbody", {}, ...known.map(([label, value]) => element("tr", {}, element("th", { text: label, scope: "row" }),
      value instanceof Node ? element("td", {}, value) : element("td", {}, name(value)))));
    table(title).append(element("div", { className: "scroll" }, element("table", {}, body)));
  };

  // Poses at the instant shown.
  const poses = mechanism.bodies.slice(1, 41).map((body) => ({ name: body.name, of: ["x", "y", "angle"].map((q) => column(`${body.name}.${q}`)) })).filter(({ of }) => of.every((found) => found && found.wanted));
  const cells = [];
  if (poses.length && rows) {
    const body = element("tbody");
    for (const pose of poses) {
      const tds = pose.of.map((column) => { const td = number(""); cells.push([td, column]); return td; });
      body.append(element("tr", {}, element("td", {}, name(pose.name)), ...tds));
    }
    table("Bodies at this instant").append(element("div", { className: "scroll" },
      element("table", { id: "poses" }, heads(["body"], ["x", 1], ["y", 1], ["angle", 1]), body)));
  }
  const values = () => cells.forEach(([td, { values, unit }]) => {
    td.textContent = units.quantity(values[player.row], unit, 6);
    td.dataset.si = Number.isFinite(values[player.row]) ? values[player.row] : "";
  });

  const event = (event) => {
    const what = element("span", {}, `${linkdyn.eventWord(event)} `, jump(event.time));
    const end = linkdyn.eventEnd(event);
    if (end > event.time) what.append(" … ", jump(end));
    const unit = event.driver === undefined ? undefined : column(`driver.${event.driver}.value`)?.unit;
    if (event.driver !== undefined && event.value !== undefined) what.append(", ", name(event.driver), ` = ${unit ? units.quantity(event.value, unit, 8) : units.number(event.value, 8)}`);
    if (event.joint !== undefined) what.append(", joint ", name(event.joint));
    if (event.note) what.append(": ", name(event.note));
    return what;
  };
  const list = (nodes) => { const box = element("div", { className: "scroll" }); nodes.forEach((node) => box.append(element("p", {}, node))); return box; };

  const { mobility, quality, statistics, timing, settings, equilibrium } = summary;
  // A sample is in the unit of its driver, the rest that has one is time.
  const settingUnit = ([key, inner]) => {
    if (key === "sample") return mechanism.drivers.find(({ name }) => name === settings.sample.driver)?.type === "translation" ? "m" : "rad";
    return key === "end" || ["max_step", "initial_step", "max_wall_time"].includes(inner) ? "s" : undefined;
  };
  const small = (value) => value === null || value === undefined ? undefined : units.number(value, 3);
  let facts = null;
  const diagnosis = () => {
    if (facts) facts.forEach((made) => made.remove());
    const before = holder.children.length;
    pairs("Diagnostics", [
      ["status", words(summary.status)], ["why", summary.message],
      ["mobility", `${mobility.grubler} by Grübler, ${mobility.rank} by rank, drivers: ${mobility.drivers}`],
      ["redundant", mobility.redundant.join(", ")], ["reactions not unique", mobility.reactions_not_unique.join(", ")],
      ["constraint residual", small(quality.constraint_residual)], ["power imbalance", small(quality.power_imbalance)], ["energy drift", small(quality.energy_drift)], ["energy imbalance", small(quality.energy_imbalance)],
      ["contacts", summary.clearances && list(Object.entries(summary.clearances).map(([joint, sums]) => name(`${joint}: ${sums.contacts}, ${units.number(sums.time_in_contact, 4)} s in all, ${units.number(sums.energy_lost, 4)} J lost`)))],
      ["equilibrium", equilibrium && `${equilibrium.stability}; stiffness ${equilibrium.stiffness.map((k) => units.number(k, 4)).join(", ") || "–"}${equilibrium.coordinates.length ? ` by ${equilibrium.coordinates.join(", ")}` : ""}`],
      ["warnings", summary.warnings.length ? list(summary.warnings.map(name)) : "none"],
      ["events", summary.events.length ? list(summary.events.map(event)) : "none"],
    ]);
    const flat = (value, path) => value !== null && typeof value === "object" && !Array.isArray(value)
      ? Object.entries(value).flatMap(([key, inner]) => flat(inner, [...path, key])) : [[words(path.join(" ")), setting(value, path)]];
    const setting = (value, path) => {
      if (typeof value === "number" && settingUnit(path)) return units.quantity(value, settingUnit(path), 10);
      return Array.isArray(value) ? value.join(", ") : value === null ? undefined : String(value);
    };
    pairs("Settings and work", [
      ["engine", `linkdyn ${summary.engine}`], ["model file, SHA-256", summary.model.sha256], ...flat(settings || {}, []),
      ...Object.entries(statistics).filter(([, count]) => count).map(([key, count]) => [words(key), String(count)]),
      ...Object.entries(timing).map(([key, stage]) => [`time to ${key}`, `${units.number(stage.wall * 1e3, 3)} ms, CPU ${units.number(stage.cpu * 1e3, 3)} ms`]),
    ]);
    facts = [...holder.children].slice(before);
    // Behind the poses, before the long tables.
    if (extremes) facts.forEach((made) => holder.insertBefore(made, extremes));
  };

  // Smallest and largest value of each column.
  let extremes = null;
  const ends = ({ values }) => {
    let [low, high] = [-1, -1];
    for (let k = 0; k < values.length; k++) {
      if (!Number.isFinite(values[k])) continue;
      if (low < 0 || values[k] < values[low]) low = k;
      if (high < 0 || values[k] > values[high]) high = k;
    }
    return [low, high];
  };
  const known = new Map();
  const body = element("tbody"), more = element("p", { className: "hint" });
  const filter = element("input", { type: "text", id: "filter", placeholder: "only names with …", "aria-label": "Filter columns by name" });
  const shown = columns.filter((column) => column.wanted && column.name !== "time");
  const fill = () => {
    const part = filter.value.trim().toLowerCase();
    const found = shown.filter((column) => column.name.toLowerCase().includes(part));
    body.replaceChildren(...found.slice(0, MOST).map((column) => {
      if (!known.has(column)) known.set(column, ends(column));
      const [low, high] = known.get(column);
      const at = (row) => row < 0 ? number("–") : element("td", { className: "number" }, jump(time[row]));
      const plot = element("button", { type: "button", className: "text", text: column.name, title: "Plot", on: { click: () => linkdyn.plots.add(column) } });
      return element("tr", {}, element("td", {}, plot), number(low < 0 ? "–" : units.quantity(column.values[low], column.unit)), at(low), number(high < 0 ? "–" : units.quantity(column.values[high], column.unit)), at(high));
    }));
    more.textContent = found.length > MOST ? `${found.length - MOST} more: filter by name.` : "";
  };
  filter.addEventListener("input", fill);

  if (shown.length && rows) {
    extremes = table("Extremes", true);
    extremes.append(filter, element("div", { className: "scroll" }, element("table", {}, heads(["column"], ["smallest", 1], ["at", 1], ["largest", 1], ["at", 1]), body)), more);
    fill();
  }
  diagnosis();

  const has = (prefix) => columns.some((column) => column.name.startsWith(prefix));
  const meanings = [];
  if (has("joint.")) meanings.push("joint.NAME.fx, fy, torque: what the joint's first body exerts on the second, global axes, at the second body's point; f is the magnitude.");
  if (has("shaking.")) meanings.push("Shaking force and moment: what the mechanism exerts on the ground through joints, drivers, springs, dampers and torques between the two, weights included; applied forces come from outside and are not counted. The moment is about the ground's origin.");
  if (has("transmission.")) meanings.push("Ratio: change of the output (angle, or slide where a prismatic joint holds it to ground) by the driver's value, other drivers held. Mechanical advantage: its reciprocal, output load per driver effort without mass and friction. Transmission angle: between the force that a unit load on the output puts into the joint and the normal of the velocity of the output's point there, 0 to 90°; with one coupler the angle between coupler and output link.");
  if (has("force.")) meanings.push("force.NAME: the applied force in global axes, or torque.");
  if (meanings.length) {
    const made = table("What the quantities mean", true);
    meanings.forEach((text) => made.append(element("p", { text })));
  }

  player.onRow(values);
  units.onChange(() => { values(); fill(); diagnosis(); });
  values();
})();

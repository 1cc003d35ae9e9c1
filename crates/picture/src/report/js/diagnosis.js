"use strict";
// How the run went: events, diagnostics, settings and work; what the quantities mean.
(() => {
  const { element, units, summary, columns, mechanism, column, tables, words } = linkdyn;
  const { table, name, jump, row, scroll } = tables;
  const MANY = 12;

  // Labels with their texts.
  const pairs = (box, list) => {
    const known = list.filter(([, value]) => value !== undefined && value !== null && value !== "");
    const body = element("tbody", {}, ...known.map(([label, value]) => row(element("th", { text: label, scope: "row" }), element("td", {}, value instanceof Node ? value : name(value)))));
    box.querySelector(".scroll")?.remove();
    box.append(scroll({}, body));
  };
  const list = (nodes) => { const box = element("div"); nodes.forEach((node) => box.append(element("p", {}, node))); return box; };

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
  const { settings } = summary;
  // A sample is in the unit of its driver, the rest that has one is time.
  const settingUnit = ([key, inner]) => {
    if (key === "sample") return mechanism.drivers.find(({ name }) => name === settings.sample.driver)?.type === "rotation" ? "rad" : "m";
    return key === "end" || ["max_step", "initial_step", "max_wall_time"].includes(inner) ? "s" : undefined;
  };
  const small = (value) => value === null || value === undefined ? undefined : units.number(value, 3);
  const setting = (value, path) => {
    if (typeof value === "number" && settingUnit(path)) return units.quantity(value, settingUnit(path), 10);
    return Array.isArray(value) ? value.join(", ") : value === null ? undefined : String(value);
  };
  const flat = (value, path) => value !== null && typeof value === "object" && !Array.isArray(value)
    ? Object.entries(value).flatMap(([key, inner]) => flat(inner, [...path, key])) : [[words(path.join(" ")), setting(value, path)]];

  const happened = table("Events", { open: summary.events.length <= MANY, note: "0" });
  const note = (box, text) => { box.querySelector("summary .muted").textContent = ` ${text}`; };
  const diagnostics = table("How the run went", { open: summary.status !== "completed" || summary.warnings.length > 0, note: "–" });
  const work = table("Settings and work", { open: false });

  const fill = () => {
    const { mobility, quality, statistics, timing, equilibrium } = summary, warned = summary.warnings.length;
    happened.parentElement.hidden = !summary.events.length;
    note(happened, String(summary.events.length));
    note(diagnostics, `${words(summary.status)}${warned ? `, ${warned} warning${warned > 1 ? "s" : ""}` : ""}`);
    happened.querySelector(".scroll")?.remove();
    happened.append(element("div", { className: "scroll" }, list(summary.events.map(event))));
    pairs(diagnostics, [
      ["status", words(summary.status)], ["why", summary.message],
      ["mobility", `${mobility.grubler} by Grübler, ${mobility.rank} by rank, drivers: ${mobility.drivers}`],
      ["redundant", mobility.redundant.join(", ")], ["reactions not unique", mobility.reactions_not_unique.join(", ")],
      ["constraint residual", small(quality.constraint_residual)], ["power imbalance", small(quality.power_imbalance)], ["energy drift", small(quality.energy_drift)], ["energy imbalance", small(quality.energy_imbalance)],
      ["stops", summary.stops && list(Object.entries(summary.stops).flatMap(([joint, ends]) => Object.entries(ends).map(([stop, sums]) => name(`${joint}, ${stop}: ${sums.contacts}, ${units.number(sums.time_in_contact, 4)} s in all, ${units.number(sums.energy_lost, 4)} J lost`))))],
      ["contacts", summary.clearances && list(Object.entries(summary.clearances).map(([joint, sums]) => name(`${joint}: ${sums.contacts}, ${units.number(sums.time_in_contact, 4)} s in all, ${units.number(sums.energy_lost, 4)} J lost`)))],
      ["equilibrium", equilibrium && `${equilibrium.stability}; stiffness ${equilibrium.stiffness.map((k) => units.number(k, 4)).join(", ") || "–"}${equilibrium.coordinates.length ? ` by ${equilibrium.coordinates.join(", ")}` : ""}`],
      ["warnings", warned ? list(summary.warnings.map(name)) : "none"],
    ]);
    pairs(work, [
      ["engine", `linkdyn ${summary.engine}`], ["model file, SHA-256", summary.model.sha256], ...flat(settings || {}, []),
      ...Object.entries(statistics).filter(([, count]) => count).map(([key, count]) => [words(key), String(count)]),
      ...Object.entries(timing).map(([key, stage]) => [`time to ${key}`, `${units.number(stage.wall * 1e3, 3)} ms, CPU ${units.number(stage.cpu * 1e3, 3)} ms`]),
    ]);
  };

  const has = (prefix) => columns.some((column) => column.name.startsWith(prefix));
  const meanings = [];
  if (has("joint.")) meanings.push("joint.NAME.fx, fy, torque: what the joint's first body exerts on the second, global axes, at the second body's point; f is the magnitude.");
  if (has("shaking.")) meanings.push("Shaking force and moment: what the mechanism exerts on the ground through joints, drivers, springs, dampers and torques between the two, weights included; applied forces come from outside and are not counted. The moment is about the ground's origin.");
  if (has("transmission.")) meanings.push("Ratio: change of the output (angle, or slide where a prismatic joint holds it to ground) by the driver's value, other drivers held. Mechanical advantage: its reciprocal, output load per driver effort without mass and friction. Transmission angle: between the force that a unit load on the output puts into the joint and the normal of the velocity of the output's point there, 0 to 90°; with one coupler the angle between coupler and output link.");
  if (has("force.")) meanings.push("force.NAME: the applied force in global axes, or torque; of springs and actuators what acts on the second point or body, f along the line of the points, positive where it pushes them apart. power is the work by time that it does on the mechanism.");
  if (has("output.")) meanings.push("output.NAME: the ratio of two velocities, of the motion that the joints allow. It does not depend on how fast that is.");
  if (meanings.length) {
    const made = table("What the quantities mean", { wide: true, open: false });
    meanings.forEach((text) => made.append(element("p", { text })));
  }

  units.onChange(fill);
  linkdyn.afterData(fill);
  fill();
})();

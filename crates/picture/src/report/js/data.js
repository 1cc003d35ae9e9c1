"use strict";
// The one global: every file adds its part. What the page shows comes from two script elements, JSON and base64.
const linkdyn = {};
(() => {
  const text = (id) => document.getElementById(id).textContent;
  const given = JSON.parse(text("data"));

  // Little-endian floats, one column after the other; an empty cell is NaN.
  const binary = atob(text("values").trim());
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) bytes[k] = binary.charCodeAt(k);
  const Floats = given.bytes === 8 ? Float64Array : Float32Array;
  const all = new Floats(bytes.buffer);

  const rows = given.rows;
  const columns = given.columns.map(([name, unit, wanted], k) =>
    ({ name, unit, wanted: wanted === 1, values: all.subarray(k * rows, (k + 1) * rows) }));
  const byName = new Map(columns.map((column) => [column.name, column]));

  // Magnitudes of forces, from their components.
  for (const column of [...columns]) {
    if (!/^(joint|shaking|force)\b/.test(column.name) || !column.name.endsWith(".fx")) continue;
    const owner = column.name.slice(0, -3);
    const across = byName.get(owner + ".fy");
    if (!across || byName.has(owner + ".f")) continue;
    const values = Float64Array.from(column.values, (fx, row) => Math.hypot(fx, across.values[row]));
    const sum = { name: owner + ".f", unit: column.unit, wanted: column.wanted && across.wanted, computed: true, values };
    columns.splice(columns.indexOf(across) + 1, 0, sum);
    byName.set(sum.name, sum);
  }

  // Control characters and those that change the direction of writing, spelt out.
  const plain = (any) => String(any).replace(/[\u0000-\u001f\u007f-\u009f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]/g,
    (c) => "\\u{" + c.codePointAt(0).toString(16) + "}");

  // An element with text; names come into the page nowhere else.
  const element = (tag, options = {}, ...children) => {
    const made = document.createElement(tag);
    const { text, className, on, ...rest } = options;
    if (text !== undefined) made.textContent = plain(text);
    if (className) made.className = className;
    for (const [event, act] of Object.entries(on || {})) made.addEventListener(event, act);
    for (const [key, value] of Object.entries(rest)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };

  const time = byName.has("time") ? byName.get("time").values : new Float64Array(rows);
  // Contacts: one that takes no time is an impact, one without end goes on when the run ends.
  const ofContact = ({ type }) => ["contact", "stick", "slip", "following"].includes(type);
  const eventWord = (event) => event.type === "contact" && event.duration === 0 ? "impact" : event.type.replaceAll("_", " ");
  const eventEnd = (event) => event.end_time ?? (event.type === "contact" && rows ? Math.max(event.time, time[rows - 1]) : event.time);

  // Where axes are cut, as the engine's rule for all pictures has it: [low, high] by the name of a column.
  const uncut = [null, null];
  const cutOf = (column) => Object.hasOwn(given.cuts, column.name) ? given.cuts[column.name] : uncut;

  // The part of an icon that the page defines.
  const icon = (name) => {
    const [svg, use] = ["svg", "use"].map((tag) => document.createElementNS("http://www.w3.org/2000/svg", tag));
    svg.setAttribute("class", "icon");
    use.setAttribute("href", `#i-${name}`);
    svg.append(use);
    return svg;
  };

  Object.assign(linkdyn, {
    plain, element, icon, cutOf, ofContact, eventWord, eventEnd,
    summary: given.summary, about: given.about, source: given.source, mechanism: given.mechanism, palette: given.palette, notes: given.notes,
    rows, columns, byName, width: given.width,
    column: (name) => byName.get(name),
    time,
  });
})();

"use strict";
// The columns of the run, one after the other among the numbers of the page, and what is said of it.
(() => {
  const { given, floats } = linkdyn;
  const rows = given.rows;
  const columns = given.columns.map(([name, unit, wanted], k) =>
    ({ name, unit, wanted: wanted === 1, values: floats.subarray(k * rows, (k + 1) * rows) }));
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

  // Rows of the smallest and the largest value of a column, and both values; -1 and no number where it has none.
  const ends = new Map();
  const endRows = (column) => {
    if (!ends.has(column)) {
      let [low, high] = [-1, -1];
      const { values } = column;
      for (let row = 0; row < values.length; row++) {
        if (!Number.isFinite(values[row])) continue;
        if (low < 0 || values[row] < values[low]) low = row;
        if (high < 0 || values[row] > values[high]) high = row;
      }
      ends.set(column, [low, high]);
    }
    return ends.get(column);
  };
  const endsOf = (column) => endRows(column).map((row) => row < 0 ? NaN : column.values[row]);

  const time = byName.has("time") ? byName.get("time").values : new Float64Array(rows);
  // Contacts: one that takes no time is an impact, one without end goes on when the run ends.
  const ofContact = ({ type }) => ["contact", "stick", "slip", "following"].includes(type);
  const eventWord = (event) => event.type === "contact" && event.duration === 0 ? "impact" : linkdyn.words(event.type);
  const eventEnd = (event) => event.end_time ?? (event.type === "contact" && rows ? Math.max(event.time, time[rows - 1]) : event.time);

  // Where axes are cut, as the engine's rule for all pictures has it: [low, high] by the name of a column.
  const uncut = [null, null];
  const cutOf = (column) => Object.hasOwn(given.cuts, column.name) ? given.cuts[column.name] : uncut;

  Object.assign(linkdyn, {
    cutOf, endRows, endsOf, ofContact, eventWord, eventEnd,
    summary: given.summary, about: given.about, source: given.source, notes: given.notes,
    rows, columns, byName, width: given.width,
    column: (name) => byName.get(name),
    time,
  });
})();

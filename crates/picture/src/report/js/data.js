"use strict";
// The columns of the run, one after the other among the numbers of the page, and what is said of it. The page that shows each run
// may give it another run of the same mechanism: columns and words stay the same objects with other values, and who has made something
// of them hears of it: pictures at once (`onData`), tables when there is time (`afterData`).
(() => {
  const { given } = linkdyn, listeners = [], lateListeners = [], LATE = 80;
  const columns = given.columns.map(([name, unit, wanted]) => ({ name, unit, wanted: wanted === 1, values: null }));
  const byName = new Map(columns.map((column) => [column.name, column]));

  // Magnitudes of forces, from their components.
  for (const column of [...columns]) {
    if (!/^(joint|shaking|force)\b/.test(column.name) || !column.name.endsWith(".fx")) continue;
    const owner = column.name.slice(0, -3);
    const across = byName.get(owner + ".fy");
    if (!across || byName.has(owner + ".f")) continue;
    const sum = { name: owner + ".f", unit: column.unit, wanted: column.wanted && across.wanted, computed: [column, across], values: null };
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

  // Puts the numbers into the columns.
  const fill = (floats) => {
    const { rows, width, about, source, notes } = given;
    let k = 0;
    for (const column of columns) if (!column.computed) { column.values = floats.subarray(k * rows, (k + 1) * rows); k++; }
    for (const column of columns) if (column.computed) {
      const [fx, fy] = column.computed.map(({ values }) => values);
      column.values = Float64Array.from(fx, (value, row) => Math.hypot(value, fy[row]));
    }
    ends.clear();
    const time = byName.has("time") ? byName.get("time").values : new Float64Array(rows);
    Object.assign(linkdyn, { rows, width, about, source, notes, time });
  };

  // Contacts: one that takes no time is an impact, one without end goes on when the run ends.
  const ofContact = ({ type }) => ["contact", "stick", "slip", "following"].includes(type);
  const eventWord = (event) => event.type === "contact" && event.duration === 0 ? "impact" : linkdyn.words(event.type);
  const eventEnd = (event) => event.end_time ?? (event.type === "contact" && linkdyn.rows ? Math.max(event.time, linkdyn.time[linkdyn.rows - 1]) : event.time);

  // Where axes are cut, as the engine's rule for all pictures has it: [low, high] by the name of a column.
  const uncut = [null, null];
  const cutOf = (column) => Object.hasOwn(given.cuts, column.name) ? given.cuts[column.name] : uncut;

  // What a page is laid out by: of another mechanism, or with other columns, it has to be made anew.
  const layout = ({ columns, rows, mechanism, summary }) => JSON.stringify([columns, Math.min(rows, 2), Object.keys(summary.responses || {}), summary.settings?.type,
    Object.entries(mechanism).map(([key, list]) => Array.isArray(list) ? [key, list.map((own) => Array.isArray(own) ? own : [own.name, own.type, own.between, own.body, own.bodies, own.pin, Boolean(own.clearance), (own.points || []).map(([name]) => name)])] : key)]);
  let shape = null, late = 0;
  // New values in old objects, so that whoever holds one has the new values.
  const whole = (value) => value !== null && typeof value === "object";
  const put = (old, made) => {
    if (Array.isArray(old)) old.length = made.length;
    for (const key of Object.keys(old)) if (!Object.hasOwn(made, key)) delete old[key];
    for (const key of Object.keys(made)) {
      const [before, value] = [Object.hasOwn(old, key) ? old[key] : null, made[key]];
      if (whole(before) && whole(value) && Array.isArray(before) === Array.isArray(value)) put(before, value);
      else Object.defineProperty(old, key, { value, writable: true, enumerable: true, configurable: true });
    }
  };
  // Shows another run; false where the page has to be made anew for it. `trying`: of values that are not in the file.
  const renew = (text, trying) => {
    const cut = text.indexOf("\n"), made = JSON.parse(text.slice(0, cut));
    return take(made, linkdyn.floatsOf(made, text.slice(cut + 1)), trying);
  };
  const take = (made, floats, trying) => {
    shape ??= layout(given);
    if (layout(made) !== shape) return false;
    const { player } = linkdyn, instant = linkdyn.rows ? linkdyn.time[player.row] : 0;
    if (trying) linkdyn.ghost.take(); else linkdyn.ghost.leave();
    put(given, made);
    fill(floats);
    Object.assign(linkdyn.shapes, linkdyn.measureShapes());
    player.renew(instant);
    listeners.forEach((listen) => listen(trying));
    clearTimeout(late);
    late = setTimeout(() => lateListeners.forEach((listen) => listen()), LATE);
    return true;
  };

  Object.assign(linkdyn, {
    cutOf, endRows, endsOf, ofContact, eventWord, eventEnd, renew, take, summary: given.summary, columns, byName,
    column: (name) => byName.get(name), onData: (listen) => listeners.push(listen), afterData: (listen) => lateListeners.push(listen),
  });
  fill(linkdyn.floats);
})();

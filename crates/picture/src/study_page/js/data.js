"use strict";
// The variants: columns of inputs and responses, in the units in which they are shown.
(() => {
  const { given, floats, units, plain } = linkdyn;
  const { rows } = given;
  let next = 0;
  const take = (count) => floats.subarray(next, next += count);
  const [high, low, status] = [take(rows), take(rows), take(rows)];
  const numbers = Float64Array.from(low, (part, row) => high[row] * 2 ** 20 + part);

  const variable = (own, isInput) => {
    const [symbol, size] = own.shown || given.units[own.unit] || [own.unit.replaceAll("*", "·").replaceAll("^2", "²"), 1];
    const values = Float64Array.from(take(rows), (value) => (value + own.middle) / size);
    let [from, to] = [Infinity, -Infinity];
    for (const value of values) if (Number.isFinite(value)) { from = Math.min(from, value); to = Math.max(to, value); }
    const gap = symbol === "°" || symbol === "" ? symbol : ` ${symbol}`;
    const name = plain(own.name).replace(/^parameters\./, "");
    const found = { ...own, name, symbol, size, values, from, to, isInput, label: symbol ? `${name} [${symbol}]` : name };
    // Of a number in SI.
    found.si = (value, digits = 6) => Number.isFinite(value) ? units.number(value / size, digits) + gap : "–";
    found.text = (value, digits = 6) => Number.isFinite(value) ? units.number(value, digits) + gap : "–";
    if (!isInput) {
      const { limits } = own.facts;
      found.limits = [limits.lower, limits.upper].map((limit) => limit === null ? null : limit / size);
      found.summary = given.summary.responses[own.name];
    }
    return found;
  };
  const inputs = given.inputs.map((own) => variable(own, true));
  const responses = given.responses.map((own) => variable(own, false));
  const reason = (row) => status[row] ? given.reasons[status[row] - 1] ?? "another reason" : null;
  // Thousands apart.
  const count = (number) => String(number).replace(/\B(?=(\d{3})+$)/g, "\u202f");

  // Motions: what of the mechanism is another one, and instants with the frames of all bodies.
  const motions = (given.played?.list || []).map(([number, instants, changes]) => {
    const wide = 1 + 3 * given.played.bodies;
    return { number, instants, changes: changes.map(([path, value]) => [given.played.paths[path], value]), frames: take(instants * wide), wide };
  });
  const rowOf = new Map(Array.from(numbers, (number, row) => [number, row]));
  motions.forEach((motion) => { motion.row = motion.number === null ? -1 : rowOf.get(motion.number) ?? -2; });

  Object.assign(linkdyn, {
    inputs, responses, variables: [...inputs, ...responses], numbers, variants: rows, status, reason, count, motions,
    sampled: given.variants > rows, rows: 0, time: [], column: () => undefined,
  });
})();

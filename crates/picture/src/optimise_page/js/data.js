"use strict";
// The mechanism as it was and as it was found: of each its own parts, and where its bodies are.
(() => {
  const { given, floats } = linkdyn;
  let next = 0;
  const take = (count) => floats.subarray(next, next += count);
  const played = given.played || { list: [], paths: [], bodies: 0 }, wide = 1 + 3 * played.bodies;

  // What is another one in a motion is put into a copy.
  const changed = (changes) => {
    const own = structuredClone({ mechanism: given.mechanism, drawing: given.drawing });
    for (const [path, value] of changes) {
      const keys = played.paths[path].split("/").slice(1), final = keys.pop();
      keys.reduce((part, key) => part[key], own)[final] = value;
    }
    return own;
  };
  const motions = played.list.map(([, rows, changes], k) => {
    const frames = take(rows * wide);
    const values = (place) => Float64Array.from({ length: rows }, (_, row) => frames[row * wide + place]);
    return { name: given.names[k], rows, time: values(0), values, ...changed(changes) };
  });

  // What is played is the last one: after.
  const last = motions[motions.length - 1];
  Object.assign(linkdyn, { motions, rows: last ? last.rows : 0, time: last ? last.time : [], column: () => undefined });
})();

"use strict";
// The outputs: columns over the poses of the band, and at some poses what the sources do and where the bodies stand.
(() => {
  const { given, floats } = linkdyn;
  const { sources, drivers, bodies } = given;
  const COLUMNS = ["time", ...drivers.map((_, k) => k), "nominal", "first_low", "first_high", "found_low", "found_high",
    "certified_low", "certified_high", "mean", "sigma", "pressed", "within", "cp", "cpk"];
  // What the output may reach: the worst found, or the first order if only that was requested.
  const reach = given.level ? { name: "worst found", column: "found" } : { name: "first order", column: "first" };
  let next = 0;
  const take = (count) => floats.subarray(next, next += count);

  // Poses that can be chosen; their bodies are drawn from one table of all of them.
  const frames = [];
  const outputs = given.outputs.map((output) => {
    const band = {};
    for (const name of COLUMNS) band[name] = take(output.rows);
    for (const end of ["low", "high"]) band[`reach_${end}`] = band[`${reach.column}_${end}`];
    const details = output.details.map((row, k) => {
      const by = take(4 * sources.length);
      const [position, low, high] = [take(3 * bodies), take(3 * bodies), take(3 * bodies)];
      frames.push(position);
      const known = (found) => bodies > 0 && found.every(Number.isFinite) ? found : null;
      return {
        row, by, contributes: output.contributes[k], needed: output.needed[k], frame: frames.length - 1, position, displaced: [known(low), known(high)],
        sensitivity: (source) => by[4 * source], reach: (source) => [by[4 * source + 1], by[4 * source + 2]], variance: (source) => by[4 * source + 3],
      };
    });
    // Poses on an axis: the driver's value if each pose has another one.
    const [driver] = drivers;
    const x = output.along_driver ? { label: driver[0], unit: driver[1], values: band[0] } : { label: "time", unit: "s", values: band.time };
    return { ...output, band, details, x, alone: output.poses === 1 };
  });

  // The drawing needs columns of the poses of bodies.
  const names = new Map();
  given.mechanism.bodies.slice(1).forEach(({ name }, body) => ["x", "y", "angle"].forEach((quantity, k) =>
    names.set(`${name}.${quantity}`, { values: Float64Array.from(frames, (frame) => frame[3 * body + k]) })));

  Object.assign(linkdyn, { outputs, level: given.level, reach: reach.name, sources, drivers, rows: frames.length, column: (name) => names.get(name) });
})();

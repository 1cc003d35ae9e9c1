"use strict";
// What is chosen: an output, a pose of it, a side, and how far the parameters are moved.
(() => {
  if (!linkdyn.outputs.length) return;
  const { outputs, sources, file } = linkdyn;
  const listeners = [];
  let output = outputs[0], side = 1;
  const poses = outputs.map(({ worst }) => worst);
  const delta = new Float64Array(sources.length);
  const tell = (what) => listeners.forEach((listen) => listen(what));

  const choice = {
    delta,
    get output() { return output; },
    get number() { return poses[outputs.indexOf(output)]; },
    get detail() { return output.details[choice.number]; },
    // A number of the band at the chosen pose.
    at: (name) => output.band[name][choice.detail.row],
    get side() { return side; },
    set side(chosen) { side = chosen; tell("side"); },
    open(chosen) { output = chosen; tell("output"); },
    seek(wanted) {
      const number = Math.min(Math.max(Math.round(wanted), 0), output.details.length - 1);
      if (number === choice.number) return;
      poses[outputs.indexOf(output)] = number;
      tell("pose");
    },
    move(source, by) { delta[source] = by; side = choice.corner ?? side; tell("moved"); },
    reset() { delta.fill(0); tell("moved"); },
    // Deviations of the parameters that carry the output farthest to a side at the chosen pose; null where none is known to.
    worst(side) {
      const { detail } = choice, found = new Float64Array(sources.length);
      if (!detail.contributes || !detail.displaced[side]) return null;
      sources.forEach(({ slider }, source) => {
        const slope = detail.sensitivity(source);
        if (slider?.is_tolerance && slope !== 0) found[source] = slider.range[(slope > 0) === (side === 1) ? 1 : 0];
      });
      return found.some((by) => by !== 0) ? found : null;
    },
    // The side to which all parameters are at their worst; null in between.
    get corner() { return [0, 1].find((side) => choice.isMoved && choice.worst(side)?.every((by, source) => by === delta[source])) ?? null; },
    toWorst(chosen) {
      const wanted = choice.worst(chosen);
      if (!wanted) return;
      delta.set(wanted);
      side = chosen;
      tell("moved");
    },
    get isMoved() { return delta.some((by) => by !== 0); },
    // Deviation of the output by the sliders, to first order; not a number where there is none.
    shift(detail) {
      if (!choice.isMoved) return 0;
      if (!detail.contributes) return NaN;
      let sum = 0;
      delta.forEach((by, source) => { if (by !== 0) sum += by * detail.sensitivity(source); });
      return sum;
    },
    // Where the drivers stand, or the time.
    where(row = choice.detail.row) {
      const { x, band } = output, { drivers } = linkdyn;
      const stands = drivers.map(([name, unit], k) => `${name} = ${file.value(band[k][row], unit, 5)}`);
      return x.unit === "s" && !output.alone ? [`${file.number(band.time[row], 5)} s`, ...stands].join(", ") : stands.join(", ");
    },
    onChange: (listen) => listeners.push(listen),
  };
  linkdyn.choice = choice;
})();

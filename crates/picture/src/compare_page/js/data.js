"use strict";
// The runs. Their rows come as one block of floats, run after run.
(() => {
  const { given, floats } = linkdyn;
  const columns = given.columns.map(([name, unit]) => ({ name, unit }));

  // Each run with its times and values; the first that ran is what the others are compared with.
  let next = 0;
  const take = (rows) => floats.subarray(next, next += rows);
  const runs = given.runs.map((run) => run.rows ? { ...run, on: true, time: take(run.rows), values: columns.map(() => take(run.rows)) } : { ...run, on: false });
  const ran = runs.filter((run) => run.rows);
  // What a run computes near where it does not converge may be anything: it does not set the scale of a plot.
  const FAILED = ["not_converged", "no_solution"];
  ran.forEach((run) => { run.sets_scale = run.sort === "good" && !run.events.some(([kind]) => FAILED.includes(kind)); });
  const reference = ran[0];

  // All instants of all runs in order, and which row of each run is there (-1: none). Two rows of one run at one instant stay two.
  const times = [], rows = ran.map(() => []);
  const at = ran.map(() => 0);
  for (;;) {
    let least = Infinity;
    ran.forEach((run, k) => { if (at[k] < run.rows) least = Math.min(least, run.time[at[k]]); });
    if (least === Infinity) break;
    times.push(least);
    ran.forEach((run, k) => rows[k].push(at[k] < run.rows && run.time[at[k]] === least ? at[k]++ : -1));
  }
  ran.forEach((run, k) => { run.row = rows[k]; });

  Object.assign(linkdyn, { columns, runs, ran, reference, times });
})();

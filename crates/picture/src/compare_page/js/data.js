"use strict";
// The one global: every file adds its part. Rows of all runs come as one block of floats, run after run.
const linkdyn = {};
(() => {
  const text = (id) => document.getElementById(id).textContent;
  const given = JSON.parse(text("data"));
  const binary = atob(text("values").trim());
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) bytes[k] = binary.charCodeAt(k);
  const all = given.bytes === 8 ? new Float64Array(bytes.buffer) : new Float32Array(bytes.buffer);
  const columns = given.columns.map(([name, unit]) => ({ name, unit }));

  // Each run with its times and values; the first that ran is what the others are compared with.
  let next = 0;
  const take = (rows) => all.subarray(next, next += rows);
  const runs = given.runs.map((run) => run.rows ? { ...run, on: true, time: take(run.rows), values: columns.map(() => take(run.rows)) } : { ...run, on: false });
  const ran = runs.filter((run) => run.rows);
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

  // A colour of the style sheet as it is now.
  const probe = document.body.appendChild(element("span", { hidden: "" }));
  const colour = (name) => { probe.style.color = `var(--${name})`; return getComputedStyle(probe).color; };

  Object.assign(linkdyn, { given, columns, runs, ran, reference, times, plain, element, colour });
})();

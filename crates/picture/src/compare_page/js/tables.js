"use strict";
// Tables: how the runs went, how far they are from the reference, smallest and largest values.
(() => {
  const { columns, runs, ran, reference, element, units, models, plain, id } = linkdyn;
  const { name, number, row, heads, scroll, folded } = linkdyn.tables;
  const named = (run) => element("td", {}, ...(run.rows ? [models.swatch(run)] : []), name(run.name));
  const at = (time) => number(`${units.number(time, 4)} s`);
  const table = (id, title, note, ...parts) => folded(title, { note }, scroll({ id }, ...parts)).root;

  // A group of rows per column, headed by its name.
  const groups = (of, span) => columns.map((column, k) => {
    const lines = of(column, k);
    return element("tbody", {}, row(element("th", { className: "of", colspan: span, scope: "rowgroup" }, name(column.name))), ...lines);
  });
  const size = ([low, , high]) => Math.max(Math.abs(low), Math.abs(high));

  const fill = () => {
    const made = [];
    const ends = (column, k) => ran.map((run) => {
      const found = run.extremes[k], own = reference.extremes[k], { unit } = column;
      const ratio = found && own && size(own) > 0 ? size(found) / size(own) : NaN;
      const cells = found ? [number(units.quantity(found[0], unit, 4)), at(found[1]), number(units.quantity(found[2], unit, 4)), at(found[3])] : ["–", "–", "–", "–"].map(number);
      return row(named(run), ...cells, number(run === reference || !Number.isFinite(ratio) ? "" : units.number(ratio, 3)));
    });
    const apart = (column, k) => ran.filter((run) => run !== reference).map((run) => {
      const found = run.differences[k], own = reference.extremes[k], { unit } = column;
      if (!found) return row(named(run), ...["–", "–", "–", "–", ""].map(number));
      const [most, time, mean, rms] = found, range = own ? own[2] - own[0] : 0;
      const part = range > 1e-9 * size(own || [0, 0, 0]) ? `${units.number(100 * rms / range, 3)} %` : "";
      return row(named(run), number(units.quantity(most, unit, 4)), at(time), number(units.quantity(mean, unit, 4)), number(units.quantity(rms, unit, 4)), number(part));
    });
    if (reference && columns.length) {
      made.push(table("extremes", "Smallest and largest values", "peaks between the outputs included",
        heads("model", ["smallest"], ["at"], ["largest"], ["at"], [`peak × ${reference.name}`]), ...groups(ends, 6)));
      if (ran.length > 1) made.push(table("apart_table", `Differences to ${plain(reference.name)}`, `at the outputs that both have; range of ${plain(reference.name)}`,
        heads("model", ["largest"], ["at"], ["mean"], ["RMS"], ["RMS of range"]), ...groups(apart, 6)));
    }
    const lines = runs.map((run) => row(named(run), element("td", {}, element("span", { className: run.sort === "none" ? "muted" : run.sort, text: run.ended })),
      element("td", { className: "text", text: run.facts }),
      element("td", {}, ...(run.rows ? [element("a", { href: `${encodeURIComponent(run.name)}/report.html`, text: "report" })] : []))));
    made.push(table("ran", "Runs", "", heads("model", "end", "", ""), element("tbody", {}, ...lines)));
    id("tables").replaceChildren(...made);
  };
  fill();
  units.onChange(fill);
  linkdyn.theme.onChange(fill);
})();

"use strict";
// Tables: how the runs went, how far they are from the reference, smallest and largest values.
(() => {
  const { columns, runs, ran, reference, element, units, models } = linkdyn;
  const holder = document.getElementById("tables");
  const number = (text) => element("td", { text, className: "number" });
  const heads = (...texts) => element("thead", {}, element("tr", {}, ...texts.map(([text, right]) => element("th", { text, scope: "col", className: right ? "number" : "" }))));
  const named = (run) => element("td", {}, ...(run.rows ? [models.swatch(run)] : []), element("span", { text: run.name, className: "text" }));
  const at = (time) => number(`${units.number(time, 4)} s`);

  const table = (id, title, note, head, ...bodies) => {
    const box = element("details", { open: "" }, element("summary", {}, element("h2", { text: title }), element("span", { className: "muted text", text: note ? ` ${note}` : "" })),
      element("div", { className: "scroll" }, element("table", { id }, head, ...bodies)));
    return element("section", { className: "table" }, box);
  };

  // A group of rows per column, headed by its name.
  const groups = (of, span) => columns.map((column, k) => {
    const lines = of(column, k);
    return element("tbody", {}, element("tr", {}, element("th", { className: "of", colspan: span, scope: "rowgroup" }, element("span", { className: "text", text: column.name }))), ...lines);
  });
  const size = ([low, , high]) => Math.max(Math.abs(low), Math.abs(high));

  const fill = () => {
    const made = [];
    const ends = (column, k) => ran.map((run) => {
      const found = run.extremes[k], own = reference.extremes[k], { unit } = column;
      const ratio = found && own && size(own) > 0 ? size(found) / size(own) : NaN;
      const cells = found ? [number(units.quantity(found[0], unit, 4)), at(found[1]), number(units.quantity(found[2], unit, 4)), at(found[3])] : ["–", "–", "–", "–"].map(number);
      return element("tr", {}, named(run), ...cells, number(run === reference || !Number.isFinite(ratio) ? "" : units.number(ratio, 3)));
    });
    const apart = (column, k) => ran.filter((run) => run !== reference).map((run) => {
      const found = run.differences[k], own = reference.extremes[k], { unit } = column;
      if (!found) return element("tr", {}, named(run), ...["–", "–", "–", "–", ""].map(number));
      const [most, time, mean, rms] = found, range = own ? own[2] - own[0] : 0;
      const part = range > 1e-9 * size(own || [0, 0, 0]) ? `${units.number(100 * rms / range, 3)} %` : "";
      return element("tr", {}, named(run), number(units.quantity(most, unit, 4)), at(time), number(units.quantity(mean, unit, 4)), number(units.quantity(rms, unit, 4)), number(part));
    });
    if (reference && columns.length) {
      made.push(table("extremes", "Smallest and largest values", "peaks between the outputs included",
        heads(["model"], ["smallest", 1], ["at", 1], ["largest", 1], ["at", 1], [`peak × ${reference.name}`, 1]), ...groups(ends, 6)));
      if (ran.length > 1) made.push(table("apart_table", `Differences to ${linkdyn.plain(reference.name)}`, `at the outputs that both have; range of ${linkdyn.plain(reference.name)}`,
        heads(["model"], ["largest", 1], ["at", 1], ["mean", 1], ["RMS", 1], ["RMS of range", 1]), ...groups(apart, 6)));
    }
    const lines = runs.map((run) => element("tr", {}, named(run), element("td", {}, element("span", { className: run.sort === "none" ? "muted" : run.sort, text: run.ended })),
      element("td", { className: "text", text: run.facts }),
      element("td", {}, ...(run.rows ? [element("a", { href: `${encodeURIComponent(run.name)}/report.html`, text: "report" })] : []))));
    made.push(table("ran", "Runs", "", heads(["model"], ["end"], [""], [""]), element("tbody", {}, ...lines)));
    holder.replaceChildren(...made);
  };
  fill();
  units.onChange(fill);
  linkdyn.theme.onChange(fill);
})();

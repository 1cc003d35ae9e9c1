"use strict";
// The head, what came of the study, keys, paper.
(() => {
  const { given, inputs, responses, variants, element, plain, theme, units, choice, table, motion, count } = linkdyn;
  const id = (name) => document.getElementById(name);
  const { summary } = given;
  document.title = `${plain(given.model)} – study – linkdyn`;
  id("name").textContent = plain(given.model);
  id("asked").textContent = `study of ${count(given.variants)} variants (${plain(given.method)})`;

  // What was varied, and what became of the variants.
  const tile = (title, ...lines) => id("tiles").appendChild(element("div", { className: "tile" }, element("span", { className: "muted", text: title }), ...lines));
  const how = ({ facts, si, size, name }) => {
    if (facts.linear) return `${si(facts.linear.from)} to ${si(facts.linear.to)}, ${facts.linear.count} values`;
    if (facts.listed) return facts.listed.length > 5 ? `${si(facts.listed[0])} … ${si(facts.listed.at(-1))}, ${facts.listed.length} values` : facts.listed.map((value) => si(value)).join(", ");
    const { lower, upper, distribution } = facts.scattered;
    return `${-lower === upper ? `±${si(upper)}` : `${si(lower)} / +${si(upper)}`}, ${distribution}`;
  };
  const FEW = 6;
  const varied = inputs.slice(0, FEW).map((own) => element("div", { className: "line" }, element("strong", { className: "text", text: own.name }), element("span", { text: how(own) })));
  if (inputs.length > FEW) varied.push(element("span", { className: "muted", text: `and ${inputs.length - FEW} more` }));
  tile("varied", ...varied);
  const percent = (share) => units.number(100 * share, share > 0.99 ? 5 : 4);
  const shared = (title, share) => { if (share) tile(title, element("strong", { className: `large ${share.within === share.total ? "good" : ""}`, text: `${percent(share.share)} %` }), element("span", { className: "small", text: `${count(share.within)} of ${count(share.total)}` }), element("span", { className: "muted small", text: share.lower === null ? "no interval: the points of a grid are no sample" : `95 % sure: ${percent(share.lower)} to ${percent(share.upper)} %` })); };
  shared("completed", summary.completed);
  shared("within limits", summary.within_limits);
  const failures = Object.entries(summary.failures), MOST = 4;
  if (failures.length) tile("failures", ...failures.slice(0, MOST).map(([why, number]) => element("div", { className: "line" }, element("strong", { className: "bad", text: count(number) }), element("span", { className: "text", text: why }))), ...(failures.length > MOST ? [element("span", { className: "muted", text: `and ${failures.length - MOST} reasons more, in study.json` })] : []));

  // Each response in a row.
  const hasLimits = responses.some(({ limits }) => limits.some((limit) => limit !== null)), hasQuantiles = given.method !== "grid", none = responses.some(({ summary }) => summary.none);
  const heads = ["response", "mean", "σ", "min", "max", ...(hasQuantiles ? ["0.135 %", "median", "99.865 %"] : []), ...(hasLimits ? ["limits", ...(hasQuantiles ? ["Cpk"] : []), "outside"] : []), ...(none ? ["no value"] : [])];
  id("of_responses").append(element("thead", {}, element("tr", {}, ...heads.map((text, k) => element("th", { text, className: k ? "number" : "", scope: "col" })))));
  const digits = 6;
  id("of_responses").append(element("tbody", {}, ...responses.map((own) => {
    const found = own.summary, bound = ([lower, upper]) => lower === null && upper === null ? "–" : lower === null ? `≤ ${own.text(upper)}` : upper === null ? `≥ ${own.text(lower)}` : `${units.number(lower, digits)} … ${own.text(upper)}`;
    const cells = [own.si(found.mean ?? NaN, digits), own.si(found.deviation ?? NaN, 4), own.si(found.min ?? NaN, digits), own.si(found.max ?? NaN, digits),
      ...(hasQuantiles ? [0, 1, 2].map((k) => own.si(found.quantiles?.[k] ?? NaN, digits)) : []),
      ...(hasLimits ? [bound(own.limits), ...(hasQuantiles ? [units.number(found.cpk, 4)] : []), own.limits.every((limit) => limit === null) ? "–" : count(found.below + found.above)] : []),
      ...(none ? [count(found.none)] : [])];
    const row = element("tr", {}, element("th", { className: "text", scope: "row", text: own.name, title: own.facts.value }));
    row.append(...cells.map((text, k) => element("td", { text, className: `number${heads[k + 1] === "Cpk" && found.cpk !== null && found.cpk < 1 || heads[k + 1] === "outside" && found.below + found.above ? " bad" : ""}` })));
    return row;
  })));

  const notes = [];
  if (linkdyn.sampled) notes.push(`${count(variants)} of ${count(given.variants)} variants are drawn and listed, spread evenly, with those of the smallest and largest responses; the numbers above and the histograms are of all. variants.csv has all.`);
  notes.forEach((text) => id("notes").append(element("p", { text })));
  id("notes").hidden = !notes.length;
  const files = `linkdyn ${given.engine}. All numbers are in variants.csv and study.json beside this file, in SI units.`;
  const words = responses.map((own) => `${own.name} = ${own.facts.value}`);
  for (const text of [...words.slice(0, 12), files]) id("foot").append(element("p", { text, className: "text" }));
  id("matrix").hidden = linkdyn.variables.length < 3 && linkdyn.isGrid;
  id("parallel").hidden = linkdyn.variables.length < 3;

  id("theme").addEventListener("click", () => theme.toggle());
  const keys = { Escape: () => choice.clear(), d: () => theme.toggle(), " ": () => motion.toggle() };
  addEventListener("keydown", (event) => {
    const { tagName } = event.target;
    if (event.ctrlKey || event.metaKey || event.altKey || event.key === " " && tagName === "BUTTON" || event.key !== "Escape" && /^(INPUT|SELECT)$/.test(tagName) || !Object.hasOwn(keys, event.key)) return;
    keys[event.key]();
    event.preventDefault();
  });
  const paper = (on) => { linkdyn.plotting.paper = on; theme.paper = on; table.paper = on; motion.play(false); choice.paint(); };
  addEventListener("beforeprint", () => paper(true));
  addEventListener("afterprint", () => paper(false));
  choice.paint();
  document.documentElement.dataset.ready = "true";
})();

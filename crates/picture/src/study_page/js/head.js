"use strict";
// The head, what came of the study, keys, paper.
(() => {
  const { given, inputs, responses, variants, element, units, choice, table, player, count, page, id } = linkdyn;
  const { heads, row } = linkdyn.tables;
  const { summary } = given;

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
  const titles = ["response", "mean", "σ", "min", "max", ...(hasQuantiles ? ["0.135 %", "median", "99.865 %"] : []), ...(hasLimits ? ["limits", ...(hasQuantiles ? ["Cpk"] : []), "outside"] : []), ...(none ? ["no value"] : [])];
  id("of_responses").append(heads(...titles.map((text, k) => k ? [text] : text)));
  const digits = 6;
  id("of_responses").append(element("tbody", {}, ...responses.map((own) => {
    const found = own.summary, bound = ([lower, upper]) => lower === null && upper === null ? "–" : lower === null ? `≤ ${own.text(upper)}` : upper === null ? `≥ ${own.text(lower)}` : `${units.number(lower, digits)} … ${own.text(upper)}`;
    const cells = [own.si(found.mean ?? NaN, digits), own.si(found.deviation ?? NaN, 4), own.si(found.min ?? NaN, digits), own.si(found.max ?? NaN, digits),
      ...(hasQuantiles ? [0, 1, 2].map((k) => own.si(found.quantiles?.[k] ?? NaN, digits)) : []),
      ...(hasLimits ? [bound(own.limits), ...(hasQuantiles ? [units.number(found.cpk, 4)] : []), own.limits.every((limit) => limit === null) ? "–" : count(found.below + found.above)] : []),
      ...(none ? [count(found.none)] : [])];
    return row(element("th", { className: "text", scope: "row", text: own.name, title: own.facts.value }), ...cells.map((text, k) => element("td", { text, className: `number${titles[k + 1] === "Cpk" && found.cpk !== null && found.cpk < 1 || titles[k + 1] === "outside" && found.below + found.above ? " bad" : ""}` })));
  })));

  const notes = [];
  if (linkdyn.sampled) notes.push(`${count(variants)} of ${count(given.variants)} variants are drawn and listed, spread evenly, with those of the smallest and largest responses; the numbers above and the histograms are of all. variants.csv has all.`);
  page.head({
    kind: "study", name: given.model, line: `study of ${count(given.variants)} variants (${given.method})`, notes,
    foot: responses.map((own) => `${own.name} = ${own.facts.value}`).slice(0, 12), files: "variants.csv and study.json beside this file",
  });
  id("matrix").hidden = linkdyn.variables.length < 3 && linkdyn.isGrid;
  id("parallel").hidden = linkdyn.variables.length < 3;

  page.listen(["Esc", "clear the selection", ["Escape"], () => choice.clear()], ["Space", "play or pause", [" "], player.toggle]);
  page.paper((on) => { linkdyn.plotting.paper = on; table.paper = on; player.pause(); choice.paint(); });
  choice.paint();
  page.ready();
})();

"use strict";
// The numbers that the model asks for, before all others. Those that miss their limits are hard to overlook.
(() => {
  const { element, units, summary, id } = linkdyn;
  const answers = () => Object.entries(summary.responses || {});
  const WORDS = { missed: ["missed", "badge bad"], kept: ["kept", "badge good"] };

  // In the unit that the model declares; the choice of SI is for those without one.
  const one = ([name, { value, unit, limits, reason, words }]) => {
    const text = (si, said) => units.system === "si" && !words.declared ? units.quantity(si, unit || "1", 6) : said;
    const state = words.missed ? "missed" : limits ? "kept" : "";
    const parts = [element("span", { text: name, className: "text" })];
    parts.push(value === null ? element("span", { text: `none, ${reason}`, className: "text" }) : element("strong", { text: text(value, words.value), className: "number" }));
    if (limits) parts.push(element("span", { text: limits.map((limit, end) => text(limit, words.limits[end])).join(" … "), className: "muted number" }));
    if (state) parts.push(element("span", { text: WORDS[state][0], className: WORDS[state][1] }));
    return element("p", { className: `answer ${state}` }, ...parts);
  };
  const show = () => id("answers").replaceChildren(...answers().map(one));
  id("answers").hidden = !answers().length;
  // Before what the run warns of.
  id("notes").before(id("answers"));
  units.onChange(show);
  linkdyn.onData(show);
  show();
})();

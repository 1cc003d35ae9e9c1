"use strict";
// How much each source changes the output at the chosen pose, the largest first.
(() => {
  if (!linkdyn.outputs.length) return;
  const { choice, sources, element, file, id } = linkdyn;
  const MOST = 12;
  let all = false;

  const fill = () => {
    const { output, detail } = choice, holder = id("tornado");
    id("shares_at").textContent = linkdyn.plain(`at ${choice.where()}`);
    if (!detail.contributes) {
      holder.replaceChildren(element("p", { className: "warn", text: "No first order exists here: at a change point the deviation is proportional to the square root of the clearance. Choose a pose next to it." }));
      return;
    }
    const list = sources.map(({ name }, k) => { const [low, high] = detail.reach(k); return { name, low, high, variance: detail.variance(k) }; })
      .filter(({ low, high }) => high > low).sort((a, b) => (b.high - b.low) - (a.high - a.low));
    const total = list.reduce((sum, { low, high }) => sum + high - low, 0), spread = list.reduce((sum, { variance }) => sum + variance, 0);
    const most = list.reduce((far, { low, high }) => Math.max(far, -low, high), 0);
    const share = (part, whole) => whole > 0 ? `${(100 * part / whole).toFixed(2)} %` : "–";
    const shown = all ? list : list.slice(0, MOST);
    const heads = ["source", "", "deviation", "worst case", "variance"].map((text, k) => element("span", { text, className: k > 1 ? "heading number" : "heading" }));
    const rows = shown.flatMap(({ name, low, high, variance }) => {
      const bar = element("i"), place = (value) => 50 + 50 * value / most;
      bar.style.left = `${place(low)}%`;
      bar.style.width = `${place(high) - place(low)}%`;
      return [element("span", { className: "text" }, ...linkdyn.dotted(name)), element("span", { className: "bar", "aria-hidden": "true" }, bar),
        ...[file.both(low, high, output.unit), share(high - low, total), share(variance, spread)].map((text) => element("span", { text, className: "number" }))];
    });
    const more = list.length > MOST ? [element("button", { type: "button", text: all ? "The largest only" : `All ${list.length}`, on: { click: () => { all = !all; fill(); } } })] : [];
    holder.replaceChildren(list.length ? element("div", { className: "shares" }, ...heads, ...rows) : element("p", { className: "muted", text: "No source changes the output here." }), ...more);
  };
  choice.onChange((what) => { if (what === "output" || what === "pose") fill(); });
  fill();
})();

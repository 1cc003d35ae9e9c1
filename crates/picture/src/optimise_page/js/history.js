"use strict";
// How the search went: the best value so far, start by start, over the evaluations of the start.
(() => {
  const { given, axes, units, theme, colour, tone, element, id } = linkdyn;
  const { label, unit: [symbol, size], is_rest, starts } = given.history;
  const holder = id("history_plot"), HEIGHT = 220;
  id("history_title").textContent = linkdyn.plain(label);

  // Steps: a value holds until there is a better one. A rest is shown by its size, as far as numbers go.
  const LEAST = 1e-18;
  const value = (found) => is_rest ? Math.max(found / size, LEAST) : found / size;
  const known = starts.map((own, k) => [k, own]).filter(([, own]) => own.length);
  const xs = [...new Set(known.flatMap(([, own]) => own.map(([at]) => at + 1)))].sort((a, b) => a - b);
  const curve = (own) => xs.map((x) => { const until = own.filter(([at]) => at + 1 <= x); return until.length && x <= own[own.length - 1][0] + 1 ? value(until[until.length - 1][1]) : null; });
  const data = [xs, ...known.map(([, own]) => curve(own))];

  let plot = null;
  const build = () => {
    const width = holder.clientWidth;
    if (plot) plot.destroy();
    plot = null;
    if (!known.length || width < 60) return;
    const all = data.slice(1).flat().filter((found) => found !== null), [low, high] = [Math.min(...all), Math.max(...all)];
    const range = is_rest ? [low / 2, high * 2] : axes.padded(low, high);
    const unit = symbol ? ` [${symbol}]` : "";
    plot = new uPlot({
      ...axes.options(false), width, height: HEIGHT, padding: [8, 14, 0, 4],
      scales: { x: { time: false, range: () => xs.length > 1 ? [xs[0], xs[xs.length - 1]] : [xs[0] - 1, xs[0] + 1] }, y: { distr: is_rest ? 3 : 1, range: () => range } },
      axes: [axes.axis("", { label: "evaluation", labelSize: 16, size: 28 }),
        axes.axis(symbol, { label: `${is_rest ? "rest" : "objective"}${unit}`, labelSize: 18, size: (u, values) => 26 + 6.4 * Math.max(0, ...(values || []).map((text) => (text || "").length)) })],
      // The first curve, of the best start, is on top and strong.
      series: [{}, ...known.map(([k]) => ({ stroke: k === 0 ? colour("accent") : tone(1 + (k - 1) % 6), width: k === 0 ? 2.4 : 1.1, alpha: k === 0 ? 1 : 0.55, paths: uPlot.paths.stepped({ align: 1 }), points: { show: xs.length === 1 } }))],
    }, data, holder);
  };
  id("history_note").textContent = known.length ? `${known.length === 1 ? "" : "Strong: the start that found the best. "}Values count that keep all constraints, to a thousandth of their sides.` : "No evaluation keeps all constraints.";
  holder.hidden = !known.length;
  new ResizeObserver(() => setTimeout(() => { if (plot?.width !== holder.clientWidth) build(); }, 0)).observe(holder);
  theme.onChange(build);
  build();
  linkdyn.history = { data, get plot() { return plot; } };
})();

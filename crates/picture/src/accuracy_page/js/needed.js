"use strict";
// What share of all clearances and tolerances a deviation needs at the chosen pose, where nothing is certified.
(() => {
  if (!linkdyn.outputs.length) return;
  const { choice, file, plain, svg, id } = linkdyn;
  const plot = id("needed_plot"), TALL = 190, LEFT = 46, RIGHT = 14, TOP = 10, BOTTOM = 34;
  const SHARES = [0, 0.25, 0.5, 0.75, 1];
  const make = (tag, { class: className, ...rest }, text) => svg(tag, { className, text, ...rest });
  // A share at a deviation: its square root is linear between two points, as near a change point.
  const share = (points, by) => {
    let [from, to] = [[0, 0], points[0]];
    for (let k = 1; k < points.length && Math.abs(to[0]) < Math.abs(by); k++) [from, to] = [points[k - 1], points[k]];
    const part = (by - from[0]) / (to[0] - from[0]), root = Math.sqrt(from[1]) + part * (Math.sqrt(to[1]) - Math.sqrt(from[1]));
    return root * root;
  };
  // Steps of 1, 2 or 5, so that about five are in a range.
  const ticks = (low, high) => {
    const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough)), step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= rough);
    const found = [];
    for (let k = Math.ceil(low / step); k * step <= high; k++) found.push(k * step);
    return found;
  };

  const draw = (width) => {
    const { output, detail } = choice, sides = detail.needed.filter((points) => points.length);
    const { symbol, size } = file.of(output.unit);
    const ends = [0, ...sides.map((points) => points[points.length - 1][0])], inView = (output.limits || []).filter((limit) => ends.some((end) => end / limit > 0.2));
    const [low, high] = [Math.min(...ends, ...inView.filter((limit) => limit > 3 * Math.min(...ends))), Math.max(...ends, ...inView.filter((limit) => limit < 3 * Math.max(...ends)))];
    const room = 0.03 * (high - low), [from, to] = [low - room, high + room];
    const x = (by) => LEFT + (width - LEFT - RIGHT) * (by - from) / (to - from), y = (part) => TALL - BOTTOM - (TALL - TOP - BOTTOM) * part;
    const parts = [];
    for (const part of SHARES) parts.push(make("line", { class: "grid", x1: LEFT, x2: width - RIGHT, y1: y(part), y2: y(part) }), make("text", { x: LEFT - 6, y: y(part) + 4, "text-anchor": "end" }, `${100 * part} %`));
    for (const tick of ticks(from / size, to / size)) {
      const at = x(tick * size);
      parts.push(make("line", { class: tick === 0 ? "zero" : "grid", x1: at, x2: at, y1: TOP, y2: TALL - BOTTOM }));
      if (at > LEFT + 8 && at < width - RIGHT - 8) parts.push(make("text", { x: at, y: TALL - BOTTOM + 14, "text-anchor": "middle" }, file.number(tick, 5)));
    }
    parts.push(make("text", { x: (LEFT + width - RIGHT) / 2, y: TALL - 4, "text-anchor": "middle" }, `deviation of ${plain(output.name)} [${symbol}]`));
    for (const limit of output.limits || []) if (limit >= from && limit <= to) parts.push(make("line", { class: "limit", x1: x(limit), x2: x(limit), y1: TOP, y2: TALL - BOTTOM }));
    for (const points of sides) {
      const end = points[points.length - 1][0], line = [];
      for (let k = 0; k <= 60; k++) { const by = end * k / 60; line.push(`${x(by).toFixed(2)},${y(k ? share(points, by) : 0).toFixed(2)}`); }
      parts.push(make("polyline", { class: "needs", points: line.join(" ") }));
      parts.push(make("circle", { cx: x(end), cy: y(1), r: 3.5 }));
    }
    plot.setAttribute("viewBox", `0 0 ${width} ${TALL}`);
    plot.replaceChildren(...parts);
  };

  const fill = () => {
    const { output, detail } = choice;
    id("needed").hidden = !detail.needed;
    if (!detail.needed) return;
    id("needed_at").textContent = plain(`at ${choice.where()}`);
    const at = (part) => {
      const [low, high] = detail.needed.map((points) => points.find(([, share]) => share === part)?.[0] ?? NaN);
      const by = file.both(low, high, output.unit);
      return by && `${100 * part} % of them: ${by}`;
    };
    const shares = [0.1, 0.5, 1].map(at).filter(Boolean).join("; ");
    id("needed_note").textContent = `The share of all clearances and tolerances that a deviation needs; a dot is the worst found.${(output.limits || []).length ? " Red: limits." : ""} ${shares}.`;
    plot.setAttribute("aria-label", id("needed_note").textContent);
    const width = Math.floor(plot.getBoundingClientRect().width);
    if (width > 120) draw(width);
  };
  new ResizeObserver(() => setTimeout(fill, 0)).observe(id("needed"));
  choice.onChange((what) => { if (what === "output" || what === "pose") fill(); });
  fill();
})();

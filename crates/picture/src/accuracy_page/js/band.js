"use strict";
// The deviation over the stroke, and the pose that is chosen on it.
(() => {
  if (!linkdyn.outputs.length) return;
  const { choice, element, svg, file, bands, marks, axes, colour, tone, theme, plain, id } = linkdyn;
  const holder = id("plot"), TALL = 250;
  // Limits that are farther than this many heights of the curves do not widen the axis.
  const FAR = 8;
  const TONES = { certified: 1, found: 2, sigma: 3, moved: 4 };
  // What is shown about the chosen pose, as a part of the stroke.
  const NEAR = 0.06;
  let u = null, width = 0, line = null, peaks = [], isNear = false;

  const curve = (output, values, size) => Array.from(values.subarray(0, output.rows), (value) => Number.isFinite(value) ? value / size : null);

  // First and last place on the axis to show, in SI.
  const ends = ({ x, rows }) => {
    const [a, b] = [x.values[0], x.values[rows - 1]].sort((a, b) => a - b);
    if (!isNear) return [a, b];
    const middle = x.values[choice.detail.row], half = (b - a) * NEAR / 2;
    return [Math.max(a, middle - half), Math.min(b, middle + half)];
  };

  // Least and greatest deviation to show, in SI: all that is in view, but for peaks where the whole stroke is.
  const span = (output) => {
    const { band, x, limits } = output, range = isNear ? null : output.range, [from, to] = ends(output);
    let [low, high] = range || [0, 0];
    const add = (value) => { if (Number.isFinite(value)) [low, high] = [Math.min(low, value), Math.max(high, value)]; };
    for (let row = 0; !range && row < output.rows; row++) {
      if (x.values[row] < from || x.values[row] > to) continue;
      for (const name of ["reach_low", "reach_high", "certified_low", "certified_high"]) add(band[name][row]);
      // Beside a change point the spread to first order grows without bound, and would hide the rest.
      for (const sign of isNear ? [] : [-3, 3]) add(band.mean[row] + sign * band.sigma[row]);
    }
    if (choice.isMoved) for (const detail of output.details) {
      const { row } = detail, by = choice.shift(detail), at = x.values[row];
      if (at >= from && at <= to) for (const value of [by, by + band.reach_low[row], by + band.reach_high[row]]) if (!range || Math.abs(value) < FAR * (range[1] - range[0])) add(value);
    }
    const tall = high - low;
    for (const limit of limits || []) if (limit - high < FAR * tall && low - limit < FAR * tall) add(limit);
    const room = (high - low || 1e-9) * 0.08;
    return [low - room, high + room];
  };

  const swatch = (kind, ink) => {
    if (kind === "area") return svg("svg", { width: 20, height: 10, "aria-hidden": "true" }, svg("rect", { width: 20, height: 10, fill: ink, "fill-opacity": 0.3, stroke: ink }));
    if (kind === "hatch") return svg("svg", { width: 20, height: 10, "aria-hidden": "true" }, ...[-4, 2, 8, 14].map((x) => svg("line", { x1: x, y1: 10, x2: x + 10, y2: 0, stroke: ink })));
    return axes.swatch(ink, { wide: 20, width: 2, dash: kind === "dash" ? [6, 3] : [] });
  };
  const legend = (output) => {
    const part = (kind, ink, text) => element("span", {}, swatch(kind, ink), element("span", { text }));
    const open = linkdyn.level === 2 && output.certified < output.poses;
    id("legend").replaceChildren(
      ...(output.certified ? [part("area", tone(TONES.certified), "certified")] : []), part("line", tone(TONES.found), linkdyn.reach), part("dash", tone(TONES.sigma), "±3σ"),
      ...(output.limits ? [part("line", colour("bad"), "limits")] : []),
      ...(open ? [part("hatch", colour("warn"), "nothing certified")] : []),
      ...(choice.isMoved ? [part("line", tone(TONES.moved), "what if, and the worst along with it")] : []));
  };

  // The change by the sliders, and the worst that moves along with it, at the poses that can be chosen.
  const moved = (output, size) => {
    const lines = [0, 1, 2].map(() => new Array(output.rows).fill(undefined));
    if (!choice.isMoved) return lines;
    for (const detail of output.details) {
      const by = choice.shift(detail), { row } = detail;
      [by, by + output.band.reach_low[row], by + output.band.reach_high[row]].forEach((value, k) => { lines[k][row] = Number.isFinite(value) ? value / size : null; });
    }
    return lines;
  };

  const data = (output, size) => {
    const { band, x } = output, xs = file.of(x.unit).size;
    const sigma = (sign) => Array.from(band.sigma, (value, row) => Number.isFinite(value) ? (band.mean[row] + sign * 3 * value) / size : null);
    const list = [curve(output, x.values, xs), curve(output, band.reach_low, size), curve(output, band.reach_high, size), sigma(-1), sigma(1), ...moved(output, size)];
    // The plot wants its axis ascending.
    return turned(output) ? list.map((values) => values.reverse()) : list;
  };
  const turned = ({ x, rows }) => x.values[rows - 1] < x.values[0];

  const build = () => {
    const output = choice.output;
    const { symbol, size } = file.of(output.unit), x = file.of(output.x.unit);
    id("band_title").textContent = `Deviation of ${plain(output.name)} over the stroke`;
    id("band_unit").textContent = `[${symbol}]`;
    id("band").hidden = output.alone;
    document.documentElement.dataset.alone = output.alone;
    if (u) { u.destroy(); u = null; }
    if (output.alone || width < 40) return;
    legend(output);
    const [first, last] = ends(output).map((value) => value / x.size);
    const series = (stroke, rest) => ({ scale: "y", stroke, width: 1.5, spanGaps: false, points: { show: false }, ...rest });
    const [found, sigma, moving] = [TONES.found, TONES.sigma, TONES.moved].map(tone);
    const xs = Array.from(output.x.values, (value) => value / x.size), all = data(output, size);
    // Values as the plot has them, on an axis that ascends.
    const inOrder = (values) => { const shown = Array.from(values, (value) => value / size); return turned(output) ? shown.reverse() : shown; };
    const peaksOf = (name, ink, both) => both.map((values, end) => {
      const shown = inOrder(values);
      const words = (row) => `${name} ${file.signed(shown[row] * size, output.unit)} at ${file.number(all[0][row], 5)}${x.symbol === "°" ? x.symbol : ` ${x.symbol}`}`;
      return { name, ink, values: shown, sign: end ? 1 : -1, words };
    });
    const { band } = output, spread = (sign) => band.mean.map((mean, row) => mean + sign * 3 * band.sigma[row]);
    const curves = [...peaksOf(linkdyn.reach, found, [band.reach_low, band.reach_high]), ...peaksOf("certified", tone(TONES.certified), [band.certified_low, band.certified_high]), ...peaksOf("±3σ", sigma, [spread(-1), spread(1)])];
    function* inView() { for (let row = 0; row < output.rows; row++) if (all[0][row] >= first && all[0][row] <= last) yield row; }
    u = new uPlot({
      ...axes.options(false), width, height: TALL, padding: [8, 14, 0, 0],
      scales: { x: { time: false, range: [first, last] }, y: { range: () => span(output).map((value) => value / size) } },
      axes: [axes.axis(x.symbol, { label: `${plain(output.x.label)} [${x.symbol}]`, labelSize: 16, size: 28 }), axes.axis("", { size: 72, space: 34 })],
      series: [{}, series(found), series(found), series(sigma, { dash: [7, 4] }), series(sigma, { dash: [7, 4] }),
        series(moving, { width: 2.2, spanGaps: true }), series(moving, { dash: [3, 3], spanGaps: true }), series(moving, { dash: [3, 3], spanGaps: true })],
      hooks: {
        drawClear: [(u) => { if (linkdyn.level === 2) bands.certified(u, output, xs, size, tone(TONES.certified)); }],
        draw: [(u) => { bands.limits(u, output, size); peaks = marks.peaks(u, curves, inView).found.map(({ curve, at }) => ({ name: curve.name, value: curve.values[at] * size })); mark(); }],
      },
    }, all, holder);
    line = element("div", { className: "now-line" });
    u.over.append(line);
    const seek = (event) => nearest(u.posToVal(event.clientX - u.over.getBoundingClientRect().left, "x") * x.size);
    u.over.addEventListener("pointerdown", (event) => { seek(event); if (event.pointerType === "mouse") u.over.setPointerCapture(event.pointerId); });
    u.over.addEventListener("pointermove", (event) => { if (event.buttons & 1) seek(event); });
    mark();
  };

  // The pose that can be chosen nearest to a place on the axis.
  const nearest = (value) => {
    const { details, x } = choice.output;
    let best = 0;
    details.forEach(({ row }, k) => { if (Math.abs(x.values[row] - value) < Math.abs(x.values[details[best].row] - value)) best = k; });
    choice.seek(best);
  };

  const mark = () => {
    const { output, detail } = choice, x = file.of(output.x.unit);
    if (u && line) line.style.left = `${u.valToPos(output.x.values[detail.row] / x.size, "x")}px`;
    id("pose").max = output.details.length - 1;
    id("pose").value = choice.number;
    id("pose_at").textContent = plain(choice.where());
    id("pose").setAttribute("aria-valuetext", plain(choice.where()));
    const open = linkdyn.level === 2 ? output.poses - output.certified : 0;
    const cut = peaks.length ? " Peaks are cut off; triangles show their values." : "";
    id("band_note").textContent = (open ? `Nothing is certified at ${open} of ${output.poses} poses: no bound could be proved there, for instance near a change point or a dead centre.` : "") + cut;
  };

  new ResizeObserver(() => setTimeout(() => { const now = Math.floor(holder.clientWidth); if (now !== width) { width = now; build(); } }, 0)).observe(holder);
  width = Math.floor(holder.clientWidth);
  id("pose").addEventListener("input", () => choice.seek(Number(id("pose").value)));
  const look = () => { isNear = !isNear; id("zoom").setAttribute("aria-pressed", isNear); build(); };
  id("zoom").addEventListener("click", look);
  id("largest").addEventListener("click", () => choice.seek(choice.output.worst));
  choice.onChange((what) => {
    if (what === "output") { build(); mark(); }
    else if (what === "pose") { if (isNear) build(); else mark(); }
    else if (what === "moved" && u) { legend(choice.output); u.setData(data(choice.output, file.of(choice.output.unit).size)); }
  });
  theme.onChange(build);
  build();
  mark();
  linkdyn.bandPlot = { get u() { return u; }, get peaks() { return peaks; }, look, build };
})();

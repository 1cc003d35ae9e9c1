"use strict";
// The mechanism of the chosen variant in motion, or of the nearest one that can be played.
(() => {
  const { given, motions, mechanism, inputs, responses, variants, numbers, reason, rowOf, choice, element, units, colour, theme } = linkdyn;
  const id = (name) => document.getElementById(name);
  const canvas = id("canvas"), stage = id("stage");
  // A whole motion in a time in which one can see something [s].
  const LASTS = 4;
  let motion = null, instant = 0, playing = false, last = 0, clock = 0, shapes = null;

  const time = (k) => motion.frames[k * motion.wide];
  // Numbers of the mechanism that vary are put where they belong.
  const put = (path, value) => {
    const keys = path.split("/").slice(1), final = keys.pop();
    keys.reduce((part, key) => part[key], mechanism)[final] = value;
  };
  const take = (wanted) => {
    motion = wanted;
    given.played.varying.forEach((path, k) => put(path, motion.shape[k]));
    const body = (name) => mechanism.bodies.findIndex((own) => own.name === name) - 1;
    linkdyn.rows = motion.instants;
    linkdyn.column = (name) => {
      const at = name.lastIndexOf("."), k = 1 + 3 * body(name.slice(0, at)) + ["x", "y", "angle"].indexOf(name.slice(at + 1));
      return { values: Float64Array.from({ length: motion.instants }, (_, row) => motion.frames[row * motion.wide + k]) };
    };
    Object.assign(linkdyn.shapes, linkdyn.measureShapes());
    ({ shapes } = linkdyn);
    instant = Math.min(instant, motion.instants - 1);
    id("scrub").max = motion.instants - 1;
  };

  const draw = () => {
    const width = stage.clientWidth, height = stage.clientHeight, ratio = devicePixelRatio || 1;
    if (!motion || !width) return;
    canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const [left, right, bottom, top] = shapes.box, px = Math.max(4.5, Math.min(width, height) * 0.026), room = 3.2 * px;
    const scale = Math.min((width - 2 * room) / (right - left), (height - 2 * room) / (top - bottom));
    const to = ([x, y]) => [width / 2 + (x - (left + right) / 2) * scale, height / 2 - (y - (bottom + top) / 2) * scale];
    linkdyn.drawing.draw(pen, { to, scale, px, row: instant, colours: linkdyn.drawing.palette(), show: { drivers: true } });
  };
  const show = () => {
    if (!motion) return;
    id("scrub").value = instant;
    id("now").textContent = `t = ${units.number(time(instant), 4)} s`;
    draw();
  };
  const frame = () => {
    if (!playing) return;
    const now = performance.now(), span = time(motion.instants - 1) - time(0);
    clock = (clock + Math.min(now - last, 100) / 1000 / LASTS) % 1;
    last = now;
    while (instant + 1 < motion.instants && time(instant + 1) - time(0) <= clock * span) instant++;
    while (instant > 0 && time(instant) - time(0) > clock * span) instant--;
    show();
    requestAnimationFrame(frame);
  };
  const play = (on) => {
    playing = on && Boolean(motion) && motion.instants > 1;
    id("play").querySelector("use").setAttribute("href", playing ? "#i-pause" : "#i-play");
    id("play").setAttribute("aria-label", playing ? "Pause" : "Play");
    if (!playing) return;
    const span = time(motion.instants - 1) - time(0);
    clock = span > 0 ? (time(instant) - time(0)) / span : 0;
    if (instant === motion.instants - 1) clock = 0;
    last = performance.now();
    requestAnimationFrame(frame);
  };

  // By the inputs, each against its range.
  const nearest = (row) => {
    let [best, least] = [null, Infinity];
    for (const other of motions) {
      if (other.row < 0) continue;
      let far = 0;
      for (const { values, from, to } of inputs) far += to > from ? ((values[other.row] - values[row]) / (to - from)) ** 2 : 0;
      if (far < least) [best, least] = [other, far];
    }
    return best;
  };

  const facts = (row) => {
    const why = row >= 0 ? reason(row) : null;
    const lines = row < 0 ? [] : [...inputs, ...responses].map((own) => [own.name, own.text(own.values[row], 7), !own.isInput && own.limits.some((limit, side) => limit !== null && (side ? own.values[row] > limit : own.values[row] < limit))]);
    id("which").textContent = row < 0 ? motion ? "nominal mechanism" : "none chosen" : `variant ${numbers[row]}`;
    id("ended").textContent = row < 0 ? "" : why ?? "completed";
    id("ended").className = `badge ${why ? "bad" : "good"}`;
    id("ended").hidden = row < 0;
    id("facts").replaceChildren(...lines.map(([name, text, isOut]) => element("div", {}, element("span", { className: "muted text", text: name }), element("span", { className: isOut ? "number bad" : "number", text: isOut ? `${text} (outside the limits)` : text }))));
    id("pick").hidden = row >= 0;
  };
  const known = motions.filter(({ row }) => row >= 0).length;
  const follow = (row) => {
    const wanted = row < 0 ? motions.find(({ number }) => number === null) ?? motions[0] : motions.find((own) => own.row === row) ?? nearest(row);
    if (wanted && wanted !== motion) take(wanted);
    facts(row);
    const other = row >= 0 && motion && motion.row !== row;
    id("motion_note").textContent = !motion ? given.not_played
      : other ? motion.row < 0 ? "No variant can be played; this is the nominal mechanism." : `Variant ${numbers[row]} is not in this page as a motion; played is the nearest one that is, variant ${motion.number}.`
      : known < given.variants ? `${linkdyn.count(known)} of ${linkdyn.count(given.variants)} variants can be played${motions.length > known ? ", and the nominal mechanism" : ""}.` : "";
    id("played").hidden = !other || !motion || motion.row < 0;
    if (motion) show();
    if (row >= 0) play(true);
  };

  id("stage").hidden = id("transport").hidden = !motions.length;
  id("nominal").hidden = !motions.some(({ number }) => number === null);
  id("nominal").addEventListener("click", () => choice.choose(-1));
  id("played").addEventListener("click", () => choice.choose(motion.row));
  id("play").addEventListener("click", () => play(!playing));
  id("scrub").addEventListener("input", () => { play(false); instant = Number(id("scrub").value); show(); });
  new ResizeObserver(() => setTimeout(draw, 0)).observe(stage);
  choice.onChoose(follow);
  theme.onChange(draw);
  follow(-1);
  linkdyn.motion = { get motion() { return motion; }, get playing() { return playing; }, get instant() { return instant; }, play, toggle: () => play(!playing), rowOf };
})();

"use strict";
// The mechanism of the chosen variant in motion, or of the nearest one that can be played.
(() => {
  const { given, motions, inputs, responses, variants, numbers, reason, choice, player, element, units, colour, theme, id } = linkdyn;
  const canvas = id("canvas"), stage = id("stage");
  let motion = null;

  // What of the mechanism and its drawing is another one in a motion is put where it belongs, after that of the motion before.
  const put = ([path, value]) => {
    const keys = path.split("/").slice(1), final = keys.pop(), owner = keys.reduce((part, key) => part[key], given);
    const before = [path, owner[final]];
    owner[final] = value;
    return before;
  };
  let undo = [];
  const take = (wanted) => {
    motion = wanted;
    undo.forEach(put);
    undo = motion.changes.map(put);
    const { mechanism } = given;
    const body = (name) => mechanism.bodies.findIndex((own) => own.name === name) - 1;
    linkdyn.rows = motion.instants;
    linkdyn.time = Float64Array.from({ length: motion.instants }, (_, row) => motion.frames[row * motion.wide]);
    linkdyn.column = (name) => {
      const at = name.lastIndexOf("."), k = 1 + 3 * body(name.slice(0, at)) + ["x", "y", "angle"].indexOf(name.slice(at + 1));
      return { values: Float64Array.from({ length: motion.instants }, (_, row) => motion.frames[row * motion.wide + k]) };
    };
    linkdyn.shapes = linkdyn.measureShapes();
    id("scrub").max = motion.instants - 1;
    player.seek(player.row);
  };

  const draw = () => {
    const width = stage.clientWidth, height = stage.clientHeight;
    if (!motion || !width) return;
    const { drawing } = linkdyn, bar = drawing.barOf(width, height);
    drawing.draw(drawing.prepare(canvas, width, height), { ...drawing.fitted(given.drawing.box, width, height, 4.7 * bar), bar, row: player.row, colours: drawing.palette(), show: { drivers: true } });
  };
  const show = () => {
    if (!motion) return;
    id("now").textContent = `t = ${units.number(linkdyn.time[player.row], 4)} s`;
    draw();
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
      : other ? motion.row < 0 ? "No variant can be played; this is the nominal mechanism." : `Variant ${numbers[row]} has no motion in this page; the nearest variant that has one is played, variant ${motion.number}.`
      : known < given.variants ? `${linkdyn.count(known)} of ${linkdyn.count(given.variants)} variants can be played${motions.length > known ? ", and the nominal mechanism" : ""}.` : "";
    id("played").hidden = !other || !motion || motion.row < 0;
    if (motion) show();
    if (row >= 0) player.play();
  };

  id("stage").hidden = id("transport").hidden = !motions.length;
  id("nominal").hidden = !motions.some(({ number }) => number === null);
  id("nominal").addEventListener("click", () => choice.choose(-1));
  id("played").addEventListener("click", () => choice.choose(motion.row));
  player.onRow(show);
  // The height is that of the first mechanism: it would jump from variant to variant.
  const first = given.drawing?.box;
  new ResizeObserver(() => setTimeout(() => { if (first) linkdyn.drawing.suit(stage, first); draw(); }, 0)).observe(stage);
  choice.onChoose(follow);
  theme.onChange(draw);
  follow(-1);
})();

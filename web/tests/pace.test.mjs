// How fast a mechanism follows a hand: moves at every frame, motion and forces computed again.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, model, open } from "./browser.mjs";

after(close);

/** A drag of a point for some frames; what frames and answers took [ms]. */
const dragged = (it, name) => it.editor(async (name) => {
  const { canvas, frame } = window.editor, [body, point] = name.split("."), w = frame.window, target = frame.report.stage.canvas;
  const k = canvas.mechanism.bodies.findIndex((own) => own.name === body), [x, y] = canvas.pixel([k, canvas.mechanism.bodies[k].points.findIndex(([own]) => own === point)]);
  const box = target.getBoundingClientRect();
  const send = (type, dx, dy) => target.dispatchEvent(new w.PointerEvent(type, { bubbles: true, clientX: box.x + x + dx, clientY: box.y + y + dy, pointerId: 1, button: 0, buttons: 1 }));
  const report = frame.report, take = report.take, frames = [], answers = [], late = [];
  let asked = 0;
  report.take = (...given) => { const done = take(...given), now = performance.now(); answers.push(now); late.push(now - asked); return done; };
  const next = () => new Promise((done) => w.requestAnimationFrame(done));
  // The compiler of the browser needs some runs until its code is fast.
  for (const count of [30, 60]) {
    await new Promise((done) => setTimeout(done, 400));
    frames.length = answers.length = late.length = 0;
    send("pointerdown", 0, 0);
    let last = performance.now();
    for (let n = 1; n <= count; n++) {
      asked = performance.now();
      send("pointermove", 10 * Math.sin(n / 11), 8 * Math.sin(n / 7));
      await next();
      const now = performance.now();
      frames.push(now - last);
      last = now;
    }
    send("pointerup", 0, 0);
    await new Promise((done) => setTimeout(done, 600));
  }
  report.take = take;
  const part = (list, share) => [...list].sort((a, b) => a - b)[Math.floor((list.length - 1) * share)];
  const gaps = answers.slice(1).map((at, k) => at - answers[k]);
  return { frame: [part(frames, 0.5), part(frames, 0.95)], between: [part(gaps, 0.5), part(gaps, 0.95)], pictures: answers.length };
}, name);

test("pictures follow the hand", async () => {
  const few = (text, outputs) => { const made = JSON.parse(text); made.analysis.outputs = outputs; return JSON.stringify(made, null, 1); };
  for (const [name, text, point] of [["four-bar", few(model("four-bar"), 361), "coupler.B"], ["jansen-leg", model("jansen-leg"), "upper_rod.A"], ["andrews-squeezer", model("andrews-squeezer"), "BDE.E"], ["watt-i-lock", model("watt-i-lock"), "link2.B"]]) {
    const it = await open();
    await it.load(text);
    await it.key("d");
    const known = await it.editor((name) => { const [body, point] = name.split("."), own = window.editor.canvas.mechanism.bodies.find((own) => own.name === body); return own?.points.some(([own]) => own === point) ? name : null; }, point);
    const at = known ?? await it.editor(() => { const { bodies, joints } = window.editor.canvas.mechanism, { between: [, [body, point]] } = joints.find(({ between: [[a], [b]] }) => a > 0 && b > 0); return `${bodies[body].name}.${bodies[body].points[point][0]}`; });
    const { frame, between, pictures } = await dragged(it, at), round = (list) => list.map((own) => own?.toFixed(1)).join(" and ");
    console.log(`${name}, ${at}: frames ${round(frame)} ms (median and p95), from picture to picture ${round(between)} ms, ${pictures} pictures of 60 frames`);
    assert.ok(pictures > 5 && frame[1] < 500, name);
    assert.deepEqual(it.faults, []);
    await it.context.close();
  }
});

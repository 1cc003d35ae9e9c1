// Two hands: one moves the mechanism, the other its dimensions.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, model, names, open } from "./browser.mjs";

after(close);

const PENDULUM = `{ "format": "linkdyn/1", "units": { "length": "mm", "angle": "deg" },
  "bodies": { "ground": { "points": { "O": [0, 0] } }, "bar": { "points": { "O": [0, 0], "A": [100, 0] } }, "arm": { "points": { "A": [0, 0], "B": [80, 0] }, "pose": { "position": [100, 0], "angle": -40 } } },
  "joints": { "o": { "type": "revolute", "between": ["ground.O", "bar.O"] }, "a": { "type": "revolute", "between": ["bar.A", "arm.A"] } } }
`;

test("dragging a pin changes the parameters behind it while the hand moves", async () => {
  const it = await open(), text = model("four-bar");
  await it.load(text);
  await it.key("d");
  const from = await it.pixel("coupler.B"), to = [from[0] + 25, from[1] - 18];
  await it.drag(from, to, 12);
  const made = await it.text(), [before, after] = [text, made].map((own) => JSON.parse(own).parameters);
  assert.notEqual(after.coupler, before.coupler);
  assert.notEqual(after.rocker, before.rocker);
  assert.equal(after.crank, before.crank);
  const changed = made.split("\n").filter((line, k) => line !== text.split("\n")[k]);
  assert.equal(changed.length, 1, "one line has the parameters");
  const there = await it.pixel("coupler.B");
  assert.ok(Math.hypot(there[0] - to[0], there[1] - to[1]) < 4, `the pin is under the hand: ${there}, ${to}`);
  await it.key("Control+z");
  await it.idle();
  assert.equal(await it.text(), text, "one step back");
  assert.deepEqual(it.faults, []);
});

test("a free mechanism follows the hand, and starts where it is put", async () => {
  const it = await open();
  await it.load(PENDULUM);
  await it.key("h");
  const from = await it.pixel("arm.B");
  await it.drag(from, [from[0] - 60, from[1] - 60], 10);
  const there = await it.pixel("arm.B");
  assert.ok(Math.hypot(there[0] - from[0] + 60, there[1] - from[1] + 60) < 2, `${there}`);
  assert.equal(await it.text(), PENDULUM, "posing is no edit");
  await it.page.getByRole("button", { name: "Start from here" }).click();
  await it.idle();
  const { arm } = JSON.parse(await it.text()).bodies;
  assert.notEqual(arm.pose.angle, -40);
  const again = await it.pixel("arm.B");
  assert.ok(Math.hypot(there[0] - again[0], there[1] - again[1]) < 2, "it starts there");
  assert.deepEqual(it.faults, []);
});

test("random drags: no fault, undo to the first byte, text and drawing agree", async () => {
  const it = await open();
  let state = 11, drags = 0;
  const random = () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
  for (const name of names.filter((own) => !["nfourbar", "walking-strandbeest"].includes(own))) {
    const text = model(name);
    await it.load(text);
    await it.key("d");
    for (let k = 0; k < 4; k++) {
      const ends = await it.editor(() => window.editor.canvas.mechanism.bodies.flatMap(({ name, points }) => points.map(([point]) => `${name}.${point}`)));
      const at = ends.length ? await it.pixel(ends[Math.floor(random() * ends.length)]) : null;
      if (!at || at[0] < 5 || at[1] < 5) continue;
      await it.drag(at, [at[0] + 40 * random() - 20, at[1] + 40 * random() - 20], 3);
      drags++;
      const { shown, written } = await it.editor(() => ({ shown: window.editor.shownText, written: window.editor.doc.text }));
      if (await it.editor(() => window.editor.last.ok)) assert.equal(shown, written, `${name}: what is drawn is what is written`);
    }
    await it.editor(() => { while (window.editor.doc.canUndo) window.editor.doc.undo(); });
    await it.idle();
    assert.equal(await it.text(), text, name);
  }
  console.log(`${drags} drags on ${names.length} models`);
  assert.deepEqual(it.faults, []);
});

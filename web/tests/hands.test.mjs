// Two hands: one moves the mechanism, the other its dimensions.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, model, names, open, randoms } from "./browser.mjs";

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

// How often each model is changed; for longer: LINKDYN_CHANGES=350 node --test tests/hands.test.mjs
const CHANGES = Number(process.env.LINKDYN_CHANGES ?? 4), DRAWN = ["bar", "point", "ground", "pin", "slide", "slot", "gear", "motor", "spring", "damper", "force", "torque", "trace", "remove"];

test("random drags and edits: no fault, no silent flip, undo to the first byte, text and drawing agree", async () => {
  const it = await open();
  let drags = 0, edits = 0, told = 0;
  const random = randoms(11), one = (list) => list[Math.floor(random() * list.length)];
  // Angles of the bodies that move, at the instant that is shown; nothing where drivers leave freedom, which goes where it wants.
  const angles = () => it.editor(() => {
    const { report } = window.editor.frame, { mobility } = report.summary, { row } = report.player;
    return mobility && mobility.rank === mobility.drivers ? { time: report.time[row], turned: Object.fromEntries(report.mechanism.bodies.slice(1).map(({ name }, k) => [name, report.shapes.pose(k + 1, row)?.[2] ?? null])) } : null;
  });
  const silent = [];
  for (const name of names.filter((own) => !["nfourbar", "walking-strandbeest"].includes(own))) {
    const text = model(name), many = CHANGES > 20 ? [4, 4, 8, 16] : [4];
    await it.load(text);
    for (let k = 0, since = 0, run = 4; k < CHANGES; k++, since++) {
      // Changes pile up; then all is undone, and the next series begins.
      if (since === run) { await undone(); [since, run] = [0, one(many)]; }
      if (CHANGES > 4 && random() < 0.15) await it.editor((row) => { const { player } = window.editor.frame.report; player.pause(); player.seek(Math.floor(row * window.editor.frame.report.rows)); }, random());
      const ends = await it.editor(() => window.editor.canvas.mechanism.bodies.flatMap(({ name, points }) => points.map(([point]) => `${name}.${point}`)));
      const [end, draws] = [one(ends), k >= 4 && random() < 0.25], at = end ? await it.pixel(end) : null, to = at && [at[0] + 40 * random() - 20, at[1] + 40 * random() - 20];
      if (!at || Math.min(at[0], at[1]) < 5) continue;
      const tool = draws ? one(DRAWN) : "shape", before = draws ? null : await angles();
      await it.editor((tool) => window.editor.choose(tool), tool);
      await it.drag(at, to, 3);
      if (draws) { edits++; await it.key("Escape"); await it.idle(); } else drags++;
      const { shown, written, isSound, row } = await it.editor(() => ({ shown: window.editor.shownText, written: window.editor.doc.text, isSound: window.editor.last.ok, row: window.editor.frame.report.player.row }));
      if (isSound) assert.equal(shown, written, `${name}: what is drawn is what is written`);
      // A short drag turns no body by half a turn, unless the loop closes the other way; the page says so.
      const after = before && isSound ? await angles() : null;
      if (after?.time === before?.time && after) {
        const says = await it.says(), jumps = Object.entries(before.turned).filter(([own, was]) => was !== null && after.turned[own] !== null && Math.abs(Math.sin((after.turned[own] - was) / 2)) > 0.7).map(([own]) => own);
        if (says.includes("another branch")) told++;
        else if (jumps.length && !says) silent.push(`${name}: ${end} by ${to.map((own, k) => (own - at[k]).toFixed(1))} at row ${row}: ${jumps} jump`);
      }
    }
    await undone();
    async function undone() {
      await it.editor(() => { while (window.editor.doc.canUndo) window.editor.doc.undo(); });
      await it.idle();
      assert.equal(await it.text(), text, name);
    }
  }
  console.log(`${drags} drags and ${edits} edits on ${names.length} models, ${told} said to lead to another branch, ${silent.length} silent`);
  for (const one of silent) console.log(one);
  assert.deepEqual(it.faults, []);
  assert.deepEqual(silent, []);
});

// Drawing by hand: what is drawn stands in the text, and moves.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open } from "./browser.mjs";

after(close);

/** A crank-rocker with a coupler point, by the tools; the number of actions. */
const fourBar = async ({ key, drag, click, middle }) => {
  await key("b");
  await drag([300, 450], [340, 380]);
  await drag([340, 380], [560, 250]);
  await drag([560, 250], [620, 450]);
  await key("g");
  await click([300, 450]);
  await click([620, 450]);
  await key("m");
  await click(await middle("bar1.A", "bar1.B"));
  await key("t");
  await click(await middle("bar2.B", "bar2.C"));
  return 11;
};

test("a four-bar is drawn, moves and is traced within a minute and fifteen actions", async () => {
  const it = await open(), began = performance.now(), actions = await fourBar(it);
  const text = await it.text(), seconds = (performance.now() - began) / 1000;
  const model = JSON.parse(text);
  assert.deepEqual(Object.keys(model.bodies), ["ground", "bar1", "bar2", "bar3"]);
  assert.equal(Object.keys(model.joints).length, 4);
  assert.equal(model.points.length, 1);
  const { status, rows } = await it.editor(() => ({ status: window.editor.frame.report.summary.status, rows: window.editor.frame.report.rows }));
  assert.equal(status, "completed");
  assert.equal(rows, 361);
  console.log(`page ready in ${Math.round(it.ready)} ms; a motion drawn in ${seconds.toFixed(1)} s, ${actions} actions`);
  assert.ok(actions <= 15 && seconds < 60);
  assert.deepEqual(it.faults, []);
  // Undo, step by step, to the first byte; redo to the last.
  const first = await it.editor(() => { while (window.editor.doc.canUndo) window.editor.doc.undo(); return window.editor.doc.text; });
  assert.match(first, /"ground": \{ "points": \{\} \}/);
  assert.equal(await it.editor(() => { while (window.editor.doc.canRedo) window.editor.doc.redo(); return window.editor.doc.text; }), text);
});

test("all tools write what the engine takes", async () => {
  const it = await open();
  await fourBar(it);
  const { key, drag, click, pixel, middle } = it, by = ([x, y], dx, dy) => [x + dx, y + dy];
  const [b, c] = [await pixel("bar1.B"), await pixel("bar2.C")];
  await key("k"); await drag(b, by(b, -80, -60));
  await key("c"); await drag(c, by(c, 60, -60));
  await key("f"); await drag(c, by(c, 0, 60));
  await key("q"); await click(await middle("bar3.C", "bar3.D"));
  await key("p"); await click(await middle("bar3.C", "bar3.D"));
  await it.editor(() => { window.editor.doc.undo(); window.editor.doc.undo(); window.editor.doc.redo(); });
  await key("s"); await drag(await middle("bar2.B", "bar2.C"), by(c, 20, -100));
  await it.editor(() => window.editor.doc.undo());
  await it.idle();
  const text = await it.text(), model = JSON.parse(text);
  assert.ok(Object.keys(model.forces).length >= 3, text);
  const faults = await it.editor(() => window.editor.last.faults);
  assert.deepEqual(faults, [], text);
  assert.deepEqual(it.faults, []);
});

test("deleting takes along what hangs on it, and nothing else", async () => {
  const it = await open();
  await fourBar(it);
  const before = await it.text();
  await it.key("x");
  await it.click(await it.middle("bar3.C", "bar3.D"));
  const model = JSON.parse(await it.text());
  assert.deepEqual(Object.keys(model.bodies), ["ground", "bar1", "bar2"]);
  assert.equal(Object.keys(model.joints).length, 2);
  await it.key("Control+z");
  await it.idle();
  assert.equal(await it.text(), before);
  assert.deepEqual(it.faults, []);
});

test("lengths and angles are typed while a bar is drawn", async () => {
  const it = await open();
  await it.key("b");
  await it.click([300, 400]);
  await it.page.locator("#typing input").fill("120 30");
  await it.key("Enter");
  await it.idle();
  const { bar1 } = JSON.parse(await it.text()).bodies, [[ax, ay], [bx, by]] = Object.values(bar1.points);
  assert.ok(Math.abs(Math.hypot(bx - ax, by - ay) - 120) < 0.5, JSON.stringify(bar1));
  assert.ok(Math.abs(Math.atan2(by - ay, bx - ax) * 180 / Math.PI - 30) < 0.4);
  assert.deepEqual(it.faults, []);
});

test("a picture lies below, scaled by two of its points", async () => {
  const it = await open();
  await it.load(JSON.stringify({ format: "linkdyn/1", units: { length: "mm" }, bodies: { ground: { points: { O: [0, 0] } }, bar: { points: { A: [0, 0], B: [50, 0] } } }, joints: {} }));
  const dots = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR4nGP4zwAE/wEHAAH/4iOeWQAAAABJRU5ErkJggg==', "base64");
  await it.page.locator("input[accept='image/*']").setInputFiles({ name: "p.png", mimeType: "image/png", buffer: dots });
  await it.page.waitForFunction(() => document.getElementById("says").textContent.includes("distance"));
  await it.drag([300, 300], [400, 300]);
  await it.page.locator("#typing input").fill("25");
  await it.key("Enter");
  await it.idle();
  await it.page.waitForTimeout(200);
  // It says nothing to the model, and goes when it is told to.
  assert.equal(await it.editor(() => window.editor.doc.canUndo), false);
  await it.page.getByRole("button", { name: "Remove the picture" }).click();
  assert.deepEqual(it.faults, []);
});

test("a bar is drawn, pinned and turned by keys alone", async () => {
  const it = await open(), { key, page } = it;
  await page.keyboard.press("b");
  for (let k = 0; k < 3; k++) await key("Shift+ArrowRight");
  await key("Enter");
  // The field for lengths has the keys after the first end.
  await page.keyboard.type("90 45");
  await key("Enter");
  await it.idle();
  const { points } = JSON.parse(await it.text()).bodies.bar1;
  assert.equal(Object.keys(points).length, 2);
  await key("g");
  await key("Enter");
  await it.idle();
  await key("m");
  await key("Enter");
  await it.idle();
  const model = JSON.parse(await it.text());
  assert.equal(Object.keys(model.joints).length, 1, JSON.stringify(model));
  assert.equal(Object.keys(model.drivers).length, 1);
  assert.equal(await it.editor(() => window.editor.frame.report.summary.status), "completed");
  assert.deepEqual(it.faults, []);
});

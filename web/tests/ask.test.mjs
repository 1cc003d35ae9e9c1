// Parameters: sliders, goals, sweeps; words of the engine.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, model, open } from "./browser.mjs";

after(close);

test("a slider changes its number in the text, as one step", async () => {
  const it = await open(), text = model("four-bar");
  await it.load(text);
  await it.page.getByRole("tab", { name: "Parameters" }).click();
  const slider = it.page.getByLabel("rocker", { exact: true });
  await slider.focus();
  for (let k = 0; k < 4; k++) await it.key("ArrowRight");
  await it.idle();
  await it.page.waitForTimeout(400);
  const { rocker } = JSON.parse(await it.text()).parameters;
  assert.match(rocker, /^20[1-9].* mm$/);
  const field = it.page.getByLabel("base, value with or without a unit");
  await field.fill("31 cm");
  await field.press("Enter");
  await it.idle();
  await it.page.waitForTimeout(300);
  assert.equal(JSON.parse(await it.text()).parameters.base, "310 mm");
  await it.editor(() => { while (window.editor.doc.canUndo) window.editor.doc.undo(); });
  assert.equal(await it.text(), text);
  assert.deepEqual(it.faults, []);
});

test("a goal is reached, and one that can't be is told with its range", async () => {
  const it = await open();
  await it.load(model("slider-crank"));
  await it.page.getByRole("tab", { name: "Ask" }).click();
  const column = (await it.editor(() => window.editor.frame.report.columns.map(({ name }) => name))).find((name) => /^piston\.x$/.test(name)) ?? "piston.x";
  await it.page.getByLabel("column", { exact: true }).selectOption(column);
  await it.page.getByLabel("parameter", { exact: true }).selectOption("crank");
  await it.page.getByLabel("of it", { exact: true }).selectOption("range");
  const seek = it.page.getByRole("button", { name: "Find the value" }), answer = it.page.locator("#ask pre");
  await it.page.getByLabel("is to be", { exact: true }).fill("80");
  await seek.click();
  await it.page.waitForFunction(() => document.querySelector("#ask pre").textContent.startsWith("crank"));
  // The stroke of a slider-crank in line is twice its crank.
  assert.match(await answer.textContent(), /crank = (40(\.0+\d*)?|39\.9+\d*) mm/);
  await it.page.getByLabel("is to be", { exact: true }).fill("9000");
  await seek.click();
  await it.page.waitForFunction(() => document.querySelector("#ask pre").textContent.includes("is from"));
  await it.page.getByRole("button", { name: "Sweep the parameter" }).click();
  await it.page.waitForFunction(() => document.querySelectorAll("#ask svg path").length === 7);
  await it.page.getByRole("button", { name: "Mobility and loops" }).click();
  await it.page.waitForFunction(() => document.querySelector("#ask pre").textContent.includes("mobility"));
  assert.deepEqual(it.faults, []);
});

test("every lesson of the gallery runs, and its link holds it", async () => {
  const it = await open();
  await it.page.getByRole("button", { name: "Gallery" }).click();
  await it.page.waitForFunction(() => document.querySelectorAll("#gallery a").length > 0);
  const lessons = await it.editor(() => [...document.querySelectorAll("#gallery a")].map((own) => [own.querySelector("strong").textContent, own.getAttribute("href")]));
  // No bundled model is missing.
  const bundled = await it.editor(() => window.editor.engine.ask("models"));
  assert.ok(lessons.length >= bundled.length, `${lessons.length} lessons, ${bundled.length} models`);
  const slow = ["Walking", "Strandbeest"];
  for (const [title, href] of lessons.filter(([title]) => !slow.some((own) => title.includes(own)))) {
    const { read, failure } = await it.editor(async (href) => {
      const { read, picture } = await window.editor.engine.ask("show", [await window.editor.unpacked(href), 20]);
      return { read, failure: picture?.failure ?? "no picture" };
    }, href);
    assert.ok(read.ok && failure === "", `${title}: ${failure} ${JSON.stringify(read.faults)}`);
  }
  assert.deepEqual(it.faults, []);
});

test("all assemblies are drawn, and one that is chosen is put into the text", async () => {
  const it = await open(), text = model("four-bar");
  await it.load(text);
  await it.page.getByRole("tab", { name: "Ask" }).click();
  await it.page.getByRole("button", { name: "All assemblies" }).click();
  const row = it.page.locator("#ask .assemblies button");
  await it.page.waitForFunction(() => document.querySelectorAll("#ask .assemblies svg").length === 2);
  assert.match(await it.page.locator("#ask pre").textContent(), /2 assemblies/);
  assert.deepEqual(await row.evaluateAll((all) => all.map((own) => own.getAttribute("aria-pressed"))), ["true", "false"]);
  const rocker = () => it.editor(() => window.editor.frame.report.column("rocker.angle").values[0]);
  const before = await rocker();
  // With the keyboard.
  await row.nth(1).focus();
  await it.key("Enter");
  await it.idle();
  await it.page.waitForFunction(() => document.querySelectorAll("#ask .assemblies svg").length === 2);
  const after = await rocker(), made = JSON.parse(await it.text());
  assert.ok(Math.abs(Math.sin((after - before) / 2)) > 0.2, `${before} ${after}`);
  // Lengths, masses and all else stay as they were written.
  const old = JSON.parse(text);
  assert.deepEqual(Object.keys(made.bodies), Object.keys(old.bodies));
  for (const [name, { pose, ...rest }] of Object.entries(made.bodies)) { const { pose: own, ...others } = old.bodies[name]; assert.deepEqual(rest, others); void pose; void own; }
  // The first one is always what is drawn.
  assert.deepEqual(await row.evaluateAll((all) => all.map((own) => own.getAttribute("aria-pressed"))), ["true", "false"]);
  await it.editor(() => window.editor.doc.undo());
  await it.idle();
  assert.equal(await it.text(), text);
  assert.ok(Math.abs(await rocker() - before) < 1e-12);
  assert.equal(await row.count(), 0);
  assert.deepEqual(it.faults, []);
});

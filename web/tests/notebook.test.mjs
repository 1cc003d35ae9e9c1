// The page in a notebook: the widget of the Python package around it, with a stand-in for the notebook's own model.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { close, html, model, root, window as opened } from "./browser.mjs";

after(close);

test("text goes to the page and back, and the browser's store is left alone", async () => {
  const { page, faults, context } = await opened(), text = model("four-bar");
  await page.goto("data:text/html,<div id=cell></div>");
  await page.evaluate(async ([widget, html, text]) => {
    const state = { _page: html, text, height: 640 }, heard = {};
    window.model = { get: (name) => state[name], set: (name, value) => { state[name] = value; heard[`change:${name}`]?.(); }, save_changes() { window.saved = (window.saved ?? 0) + 1; }, on: (name, act) => { heard[name] = act; }, off: (name) => { delete heard[name]; } };
    const { default: made } = await import(`data:text/javascript,${encodeURIComponent(widget)}`);
    window.gone = made.render({ model: window.model, el: document.getElementById("cell") });
  }, [readFileSync(join(root, "python/linkdyn/editor.js"), "utf8"), html, text]);
  const inside = async () => { const frame = page.frames().find((own) => own.parentFrame() === page.mainFrame()); await frame.waitForFunction((text) => window.editor?.doc.text === text && window.editor.isIdle, await page.evaluate(() => window.model.get("text"))); return frame; };
  let frame = await inside();
  assert.equal(await page.evaluate(() => window.saved), undefined, "what the notebook gave it does not get back");
  await frame.evaluate((text) => window.editor.doc.write(text), text.replace("Four-bar", "Another"));
  await page.waitForFunction(() => window.saved === 1);
  assert.equal(await page.evaluate(() => window.model.get("text")), text.replace("Four-bar", "Another"));
  await page.evaluate(() => window.model.set("text", window.model.get("text").replace("Another", "Third")));
  frame = await inside();
  assert.equal(await page.evaluate(() => window.saved), 1);
  await page.evaluate(() => window.gone());
  assert.deepEqual(faults, []);
  await context.close();
});

// What a machine can tell of access (axe-core: WCAG 2.1 A and AA): names, roles, contrast, in light and dark, with each panel.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, test } from "node:test";
import { close, model, open } from "./browser.mjs";

after(close);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

for (const colorScheme of ["light", "dark"]) test(`the page has no fault of access in ${colorScheme}`, async () => {
  const it = await open({ colorScheme });
  await it.load(model("four-bar"));
  const looked = async (frame) => {
    await frame.evaluate(axe);
    const { violations } = await frame.evaluate(() => window.axe.run(document, { iframes: false, runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"] }));
    // The text's own window is scrolled by the text in it, which takes the keys.
    const faults = violations.filter(({ id, nodes }) => id !== "scrollable-region-focusable" || nodes.some(({ html }) => !html.includes("cm-scroller")));
    return faults.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 4).map(({ html, any }) => `${html.slice(0, 120)} ${any[0]?.message ?? ""}`).join(" | ")}`);
  };
  const found = {};
  for (const name of ["text", "parameters", "selected", "findings", "ask"]) {
    await it.page.click(`#tab-${name}`);
    found[name] = await looked(it.page.mainFrame());
  }
  found.drawing = await looked(it.page.frames().find((own) => own.parentFrame()));
  await it.page.getByRole("button", { name: "Gallery" }).click();
  await it.page.waitForSelector("#gallery a");
  found.gallery = await looked(it.page.mainFrame());
  assert.deepEqual(Object.entries(found).filter(([, own]) => own.length), []);
  await it.context.close();
});

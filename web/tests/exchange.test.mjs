// Files of other programs, and links of PMKS+.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { close, open } from "./browser.mjs";

after(close);
const FILES = new URL("../../crates/exchange/tests/linkages/", import.meta.url);
const links = new Map(readFileSync(new URL("pmks-links.txt", FILES), "utf8").split("\n").map((line) => line.split("\t")));
const lacks = (it) => it.editor(() => { const box = document.getElementById("lacks"); return box.open ? [...box.querySelectorAll("li")].map((item) => item.textContent) : []; });
const model = async (it) => JSON.parse(await it.text());

test("files of other programs are opened as models, and what they lack is listed", async () => {
  const it = await open({ acceptDownloads: true }), directory = mkdtempSync(join(tmpdir(), "editor-"));
  writeFileSync(join(directory, "engine.json"), readFileSync(new URL("pylinkage-stroke-engine.json", FILES)));
  writeFileSync(join(directory, "clamp.csv"), "joint,x [mm],y [mm],bodies\nA,0,0,ground handle\nB,40,30,handle link\nC,100,55,link ground\n");
  writeFileSync(join(directory, "bad.csv"), "a,b\n");
  await it.page.setInputFiles("#chosen", join(directory, "engine.json"));
  await it.idle();
  assert.equal((await model(it)).name, "Simple four-stroke engine");
  assert.deepEqual((await lacks(it))[0], "file: a unit of length: m is taken; --length mm says another");
  await it.page.click("#lacks button");
  await it.page.setInputFiles("#chosen", join(directory, "clamp.csv"));
  await it.idle();
  assert.deepEqual(Object.keys((await model(it)).bodies), ["ground", "handle", "link"]);
  assert.deepEqual(await lacks(it), []);
  const before = await it.text();
  await it.page.setInputFiles("#chosen", join(directory, "bad.csv"));
  await it.idle();
  assert.match(await it.says(), /"a,b" is no header of a table of points/);
  assert.equal(await it.text(), before);
  assert.deepEqual(it.faults, []);
});

test("a link of PMKS+ is pasted or dropped", async () => {
  const it = await open(), link = `https://app.pmksplus.com/?${links.get("four-bar")}`;
  const given = (kind, text, where) => it.editor(([kind, text, where]) => {
    const data = new DataTransfer();
    data.setData("text/plain", text);
    const event = kind === "paste" ? new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }) : new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true });
    (where ? document.querySelector(where) : document.body).dispatchEvent(event);
  }, [kind, text, where]);
  for (const kind of ["paste", "drop"]) {
    await it.editor(() => window.editor.open("{}"));
    await given(kind, link);
    await it.idle();
    assert.deepEqual(Object.keys((await model(it)).bodies), ["ground", "AB", "BC", "CD"], kind);
    assert.deepEqual(await lacks(it), ["page: colours, grid, labels, scale and what is selected"]);
    assert.equal(await it.editor(() => window.editor.frame.report.stage.shown.length > 0), true);
    await it.page.click("#lacks button");
  }
  const before = await it.text();
  await given("paste", "https://example.com/?pages");
  await given("paste", link, "#typing input");
  await it.idle();
  assert.equal(await it.text(), before);
  await given("paste", link.slice(0, -9));
  await it.idle();
  assert.match(await it.says(), /the link is damaged: its length is/);
  assert.deepEqual(it.faults, []);
});

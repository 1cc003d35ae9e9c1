// Files, links and what comes from strangers.
import assert from "node:assert/strict";
import { writeFileSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { close, model, names, open, randoms } from "./browser.mjs";

after(close);
const link = (bytes) => `#m=${deflateRawSync(bytes, { level: 9 }).toString("base64url")}`;

test("a file that is opened and saved without an edit has the same bytes", async () => {
  const it = await open({ acceptDownloads: true });
  const odd = [model("four-bar").replaceAll("\n", "\r\n"), `\ufeff${model("pendulum")}`, model("geneva").replace("\n", "\r"), `${model("hoeken")}\n\n  `];
  const directory = mkdtempSync(join(tmpdir(), "editor-"));
  for (const [k, text] of odd.entries()) {
    writeFileSync(join(directory, `${k}.json`), text);
    const before = await it.text();
    await it.page.setInputFiles("#chosen", join(directory, `${k}.json`));
    // The browser reads the file when it likes.
    await it.page.waitForFunction((before) => window.editor.doc.text !== before, before);
    await it.idle();
    assert.equal(await it.text(), text);
  }
  assert.deepEqual(it.faults, []);
});

test("a link holds the whole model and little else", async () => {
  for (const name of ["andrews-squeezer", "four-bar", "geneva", "watt-i-lock", "engine"]) {
    const text = model(name), it = await open({ hash: link(text) });
    assert.equal(await it.text(), text, name);
    assert.deepEqual(it.faults, []);
    assert.deepEqual(it.requests.filter((url) => !url.startsWith("file:")), []);
    const made = await it.editor(() => window.editor.packed(window.editor.doc.text));
    console.log(`${name}: ${text.length} bytes, a link of ${made.length}`);
    assert.ok(made.length <= 2048 * Math.max(text.length / 5000, 1), `${name}: ${made.length}`);
    await it.context.close();
  }
});

test("nothing hostile acts, hangs or breaks the page", async () => {
  const script = "<img src=x onerror='window.hit=1'></script><script>window.hit=1</script>";
  const evil = JSON.parse(model("four-bar"));
  evil.name = script; evil.about = script; evil.joints[script.replaceAll(/[.=,*?[\]]/g, "")] = evil.joints.a; delete evil.joints.a;
  const cases = [link(JSON.stringify(evil)), link("x".repeat(20_000_000)), "#m=!!!!", "#m=AAAA", link("\u0000\ud800"), link("[".repeat(100000)), link(`{"a":${"1".repeat(5000)}}`), `#m=${"A".repeat(100000)}`];
  for (const hash of cases) {
    const began = performance.now(), it = await open({ hash });
    await it.idle();
    assert.equal(await it.editor(() => window.hit), undefined);
    assert.ok(performance.now() - began < 8000, hash.slice(0, 40));
    assert.deepEqual(it.faults, []);
    await it.context.close();
  }
});

// How many of each model; for longer: LINKDYN_MUTANTS=350 node --test tests/keep.test.mjs
const MUTANTS = Number(process.env.LINKDYN_MUTANTS ?? 30);

test("mutants of files are answered in time, by the engine without a trap", async () => {
  const it = await open();
  const number = randoms(5), random = (below) => Math.floor(number() * below);
  const pieces = ["\"", "{", "}", "[", "]", ",", ":", "0", "-1e308", "null", "\"=x\"", "1e999", "\\u0000", "\"mm\"", " ", "true"];
  const mutants = names.filter((name) => !["walking-strandbeest", "nfourbar"].includes(name)).flatMap((name) => Array.from({ length: MUTANTS }, () => {
    let text = model(name);
    for (let k = 1 + random(3); k > 0; k--) { const at = random(text.length), cut = random(4) ? random(3) : random(80); text = text.slice(0, at) + pieces[random(pieces.length)] + text.slice(at + cut); }
    return text;
  }));
  const { slowest, legal } = await it.editor(async (mutants) => {
    let [slowest, legal] = [0, 0];
    for (const text of mutants) {
      const began = performance.now(), { read } = await window.editor.engine.ask("show", [text, 1]);
      slowest = Math.max(slowest, performance.now() - began);
      legal += read.ok;
    }
    return { slowest, legal };
  }, mutants);
  console.log(`${mutants.length} mutants, ${legal} legal, the slowest took ${Math.round(slowest)} ms`);
  assert.ok(slowest < 2000, `${slowest}`);
  assert.deepEqual(it.faults, []);
});

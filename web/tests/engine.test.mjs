// The engine of the page against the command: the numbers of all bundled models, without a browser.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = dirname(fileURLToPath(import.meta.url)), root = join(here, "../.."), engine = join(here, "../build/engine");
const command = process.env.LINKDYN_BIN ?? join(process.env.CARGO_TARGET_DIR ?? join(root, "target"), "release/linkdyn");
const { initSync, Desk, lastPanic } = await import(pathToFileURL(join(engine, "linkdyn.js")).href);
initSync({ module: new WebAssembly.Module(readFileSync(join(engine, "linkdyn_bg.wasm"))) });
const directory = mkdtempSync(join(tmpdir(), "engine-"));
after(() => rmSync(directory, { recursive: true }));

// Free motions multiply the last bit of a sine until nothing of it is left: a double pendulum, impacts, a clutch.
// What is zero but for round-off is compared with this [SI].
const LEAST = 1e-3;
const FREE = ["dynamics", "quasi_statics"];
const names = readdirSync(join(root, "models")).map((name) => name.slice(0, -5)).filter((name) => name !== "nfourbar");
const KINDS = ["own", "kinematics", "inverse_dynamics", "statics"];

const table = (text) => text.trim().split("\n").map((line) => line.split(","));

/** The text with another analysis; nothing where the model has none of that kind. */
const asked = (text, kind) => {
  if (kind === "own") return text;
  const model = JSON.parse(text);
  if (!model.analysis || model.analysis.type === kind) return null;
  if (kind !== "statics" && !Object.keys(model.drivers ?? {}).length) return null;
  const { end = 1, outputs = 51 } = model.analysis;
  return JSON.stringify({ ...model, responses: undefined, study: undefined, optimise: undefined, accuracy: undefined, analysis: kind === "statics" ? { type: kind } : { type: kind, end, outputs: Math.min(outputs, 101) } });
};

test("numbers are those of the command", { skip: existsSync(command) ? false : `there is no ${command}` }, () => {
  const told = [], sums = { same: 0, near: 0, all: 0 };
  for (const name of names) for (const kind of KINDS) {
    const text = asked(readFileSync(join(root, "models", `${name}.json`), "utf8"), kind);
    if (text === null) continue;
    const file = join(directory, `${name}.json`), out = join(directory, `${name}-${kind}`);
    writeFileSync(file, text);
    let ours = null;
    try { execFileSync(command, ["run", file, "-o", out, "--no-report"], { stdio: "ignore" }); } catch { /* it says why in its summary, or refuses */ }
    if (existsSync(join(out, "results.csv"))) ours = readFileSync(join(out, "results.csv"), "utf8");
    const desk = new Desk(), read = JSON.parse(desk.read(text, name));
    if (ours === null) { desk.free(); continue; }
    assert.ok(read.ok, `${name} ${kind}: ${JSON.stringify(read.faults)}`);
    const picture = desk.run(60, 4e9), csv = desk.csv();
    picture.free(); desk.free();
    sums.all++;
    if (csv === ours) { sums.same++; continue; }
    const [a, b] = [table(ours), table(csv)];
    assert.deepEqual(b[0], a[0], `${name} ${kind}: columns`);
    assert.equal(b.length, a.length, `${name} ${kind}: rows`);
    // The largest difference, in parts of the largest size of a column of its unit: beside that, what is zero but for round-off is zero.
    const units = a[0].map((name) => /\[(.*)\]/.exec(name)?.[1]), sizes = {};
    for (const row of a.slice(1)) row.forEach((cell, k) => { sizes[units[k]] = Math.max(sizes[units[k]] ?? 0, Math.abs(Number(cell))); });
    let [worst, where] = [0, ""];
    for (let row = 1; row < a.length; row++) a[0].forEach((name, k) => {
      const off = Math.abs(Number(a[row][k]) - Number(b[row][k])) / Math.max(sizes[units[k]], LEAST);
      if (off > worst) [worst, where] = [off, name];
    });
    const type = JSON.parse(text).analysis.type, isFree = FREE.includes(type) || /"model": *"(contact|two_state|three_state)"/.test(text);
    told.push(`${name}, ${type}: ${worst.toExponential(1)} of ${where}`);
    assert.ok(isFree || worst < 1e-9, told.at(-1));
    sums.near++;
  }
  console.log(`${sums.all} runs: ${sums.same} the same bytes, ${sums.near} differ in last digits\n${told.join("\n")}`);
  assert.equal(lastPanic(), "");
  assert.ok(sums.same + sums.near === sums.all && sums.all > 60);
});

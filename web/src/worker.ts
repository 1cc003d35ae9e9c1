// The engine's side: each message is a question, each answer one message. A trap is told as a bug; the page then starts anew.
import { initSync, Desk, imported, lastPanic, models, modelText, schema, version } from "../build/engine/linkdyn.js";

let desk: Desk, base: Desk | null = null, baseText = "";

// Instants that are enough to draw while a hand moves.
const FEW = 361, ALL = 4e9;
const pictured = (own: Desk, seconds: number, outputs = ALL) => {
  const picture = own.run(seconds, outputs);
  const { facts, values, failure } = picture;
  picture.free();
  return { facts, values, failure };
};
let known = "";
const shown = (text: string, seconds: number, outputs = ALL) => {
  known = text;
  const began = performance.now(), read = JSON.parse(desk.read(text, "sketch"));
  const picture = read.ok ? pictured(desk, seconds, outputs) : null;
  return { text, read, picture, milliseconds: performance.now() - began };
};

// The model that a hand found when it took hold.
const based = (text: string): Desk => {
  if (!base || baseText !== text) {
    base?.free();
    [base, baseText] = [new Desk(), text];
    base.read(text, "sketch");
  }
  return base;
};

const answers: Record<string, (...args: any[]) => unknown> = {
  show: (text: string, seconds: number) => shown(text, seconds),
  // A hand takes hold of the model of a text, at poses.
  hold: (text: string, poses: number[]) => JSON.parse(based(text).hold(new Float64Array(poses))),
  pull: (text: string, body: number, local: number[], target: number[]) => JSON.parse(based(text).pull(body, new Float64Array(local), new Float64Array(target))),
  // Moves points of bodies that stay; then the model of the new text is shown.
  move: (text: string, poses: number[], start: number[], time: number, ends: [string, string][], target: number[], grain: number, seconds: number, isLast: boolean) => {
    const moved = JSON.parse(based(text).moved(new Float64Array(poses), JSON.stringify(ends), new Float64Array(target), grain));
    if (moved.faults) return moved;
    const made = shown(moved.text, seconds, isLast ? ALL : FEW);
    // The assemblies that continue what stood there, at that time and at the start.
    const [near, begin] = made.picture ? [[moved.poses, time], [start, 0]].map(([own, at]) => JSON.parse(desk.beside(new Float64Array(own), at))) : [null, null];
    return { ...moved, ...made, near, begin };
  },
  // Parameters with other values; then the model of the new text is shown.
  tune: (text: string, values: object, seconds: number) => {
    if (text !== known) desk.read(text, "sketch");
    const set = JSON.parse(desk.set(JSON.stringify(values))); return set.text === undefined ? set : shown(set.text, seconds, FEW);
  },
  typed: (name: string, text: string) => JSON.parse(desk.typed(name, text)),
  // A column over another, for values of a parameter.
  sample: (text: string, name: string, list: number[], column: string, across: string, seconds: number) => list.map((value) => {
    const own = new Desk(), empty = new Float64Array();
    own.read(text, "sketch");
    const set = JSON.parse(own.set(JSON.stringify({ [name]: value })));
    if (set.text === undefined || !JSON.parse(own.read(set.text, "sketch")).ok) { own.free(); return { value, across: empty, values: empty, failure: set.faults?.[0]?.text ?? "faults" }; }
    const { facts, values, failure } = pictured(own, seconds), { columns, rows } = JSON.parse(facts || "{\"columns\":[],\"rows\":0}");
    own.free();
    const of = (wanted: string) => {
      const at = (own: string) => columns.findIndex(([head]: [string]) => head === own), k = at(wanted), cut = (k: number) => values.slice(k * rows, (k + 1) * rows);
      if (k >= 0) return cut(k);
      // Sizes of forces are made of their components.
      const [fx, fy] = ["fx", "fy"].map((part) => at(wanted.replace(/f$/, part)));
      return fx! >= 0 && fy! >= 0 ? cut(fx!).map((x, row) => Math.hypot(x, values[fy! * rows + row]!)) : empty;
    };
    return { value, across: of(across), values: of(column), failure };
  }),
  words: (text: string, name: string) => based(text).words(name),
  assemblies: (text: string) => JSON.parse(based(text).assemblies()),
  zones: (text: string) => JSON.parse(based(text).zones()),
  summary: () => desk.summary(),
  csv: () => desk.csv(),
  page: () => desk.reportPage(),
  frame: () => JSON.parse(Desk.frame()),
  models: () => JSON.parse(models()),
  model: (name: string) => modelText(name),
  imported: (name: string, bytes: Uint8Array) => JSON.parse(imported(name, bytes)),
  schema: () => JSON.parse(schema()),
  version: () => version(),
};

const buffers = (value: any): ArrayBuffer[] => value?.values instanceof Float64Array ? [value.values.buffer] : value?.picture ? buffers(value.picture) : [];
self.onmessage = ({ data }) => {
  if (data.module) { initSync({ module: data.module }); desk = new Desk(); return; }
  try {
    const answer = answers[data.name]!(...data.args);
    self.postMessage({ answer }, { transfer: buffers(answer) });
  } catch (why) {
    let said = "";
    try { said = lastPanic(); } catch { /* the instance is gone */ }
    self.postMessage({ bug: said || (why as Error).message });
  }
};

// What stands beside the drawing: parameters, what is selected, what the engine finds, what can be asked of it.
import type { Thing } from "./canvas";
import { at, drop, put, read, type Json } from "./edit";
import { element, id } from "./element";
import type { Knob, Read } from "./linkdyn";
import { words } from "./words";

export type Shop = {
  text(): string;
  write(text: string): void;
  /** Parameters while a hand moves, and when it lets go. */
  tune(values: Record<string, number>): void;
  tuned(): void;
  typed(name: string, text: string): Promise<number | { faults: { text: string }[] }>;
  show(from: number, to: number): void;
  remove(thing: Thing): void;
  seek(time: number): void;
};

// Sliders of parameters.
const STEPS = 200;
const step = ({ least, most }: Knob): number => {
  const rough = (most - least) / STEPS, power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5, 10].find((part) => part * power >= rough * (1 - 1e-9)) ?? 10);
};
type Slider = { knob: Knob; slider: HTMLInputElement; field: HTMLInputElement; why: HTMLElement };
export class Parameters {
  #sliders = new Map<string, Slider>();
  #shop: Shop;
  #root = id("parameters");
  constructor(shop: Shop) { this.#shop = shop; }

  show(knobs: Knob[]): void {
    const known = [...this.#sliders.values()];
    if (known.length !== knobs.length || knobs.some(({ name, unit }, k) => known[k]!.knob.name !== name || known[k]!.knob.unit !== unit)) {
      this.#sliders.clear();
      this.#root.replaceChildren(...(knobs.length ? knobs.map((knob) => this.#make(knob)) : [element("p", { text: words.noParameters, className: "muted" })]));
    }
    for (const knob of knobs) {
      const own = this.#sliders.get(knob.name)!, { slider } = own;
      // The ends stay while the hand is on the slider.
      if (document.activeElement !== slider) own.knob = { ...knob };
      own.knob.value = knob.value;
      this.#write(own);
    }
  }
  #write({ knob, slider, field }: Slider): void {
    const size = step(knob);
    Object.assign(slider, { min: Math.floor(knob.least / size), max: Math.ceil(knob.most / size) });
    slider.value = String(Math.round(knob.value / size));
    slider.setAttribute("aria-valuetext", `${Number(knob.value.toPrecision(12))} ${knob.unit}`);
    if (document.activeElement !== field) field.value = String(Number(knob.value.toPrecision(12)));
  }
  #make(knob: Knob): HTMLElement {
    const number = this.#sliders.size, { name, unit } = knob;
    const slider = element("input", { type: "range", step: 1, id: `knob${number}` });
    const field = element("input", { type: "text", autocomplete: "off", spellcheck: "false", "aria-label": `${name}, value with or without a unit` });
    const why = element("span", { className: "why" }), own: Slider = { knob: { ...knob }, slider, field, why };
    this.#sliders.set(name, own);
    slider.addEventListener("input", () => {
      own.knob.value = Number(Math.min(Math.max(Number(slider.value) * step(own.knob), own.knob.least), own.knob.most).toPrecision(10));
      field.value = String(own.knob.value);
      this.#shop.tune({ [name]: own.knob.value });
    });
    slider.addEventListener("change", () => this.#shop.tuned());
    field.addEventListener("change", async () => {
      const told = await this.#shop.typed(name, field.value);
      why.textContent = typeof told === "number" ? "" : told.faults.map(({ text }) => text).join("\n");
      if (typeof told !== "number") return;
      this.#shop.tune({ [name]: told });
      this.#shop.tuned();
    });
    return element("div", { className: "knob" }, element("label", { for: `knob${number}`, text: name, title: name }),
      element("span", { className: "value" }, field, element("span", { text: unit.replaceAll("*", "·").replaceAll("^2", "²"), className: "muted" })), slider, why);
  }
}

// The keys of what is selected, as fields.
const MOST_DEPTH = 2;
type Field = { path: (string | number)[]; label: string; value: Json };
const fields = (value: any, path: (string | number)[], depth = 0): Field[] => Object.entries(value ?? {}).flatMap(([key, own]): Field[] => {
  const next = [...path, key], label = next.slice(2).join(" ");
  if (own !== null && typeof own === "object" && !Array.isArray(own)) return depth < MOST_DEPTH ? fields(own, next, depth + 1) : [];
  if (Array.isArray(own) && own.some((part) => part !== null && typeof part === "object")) return [];
  return [{ path: next, label, value: own as Json }];
});
// A list as it is typed: `1, "=l"` without its brackets.
const shown = (value: Json): string => Array.isArray(value) ? value.map((own) => typeof own === "string" ? own : JSON.stringify(own)).join(", ") : typeof value === "string" ? value : JSON.stringify(value);
const one = (text: string): Json => { const word = text.trim(); if (/^(true|false|null|-?(0|[1-9]\d*)(\.\d+)?([eE][-+]?\d+)?)$/.test(word)) return JSON.parse(word) as Json; return word; };
const typed = (text: string, before: Json): Json => {
  if (!Array.isArray(before)) return one(text);
  let depth = 0;
  const parts = [""];
  for (const c of text) { if (c === "(") depth++; if (c === ")") depth--; if (c === "," && depth === 0) parts.push(""); else parts[parts.length - 1] += c; }
  return parts.map(one);
};

export class Selected {
  #shop: Shop;
  #root = id("selected");
  thing: Thing | null = null;
  constructor(shop: Shop) { this.#shop = shop; this.show(null); }

  show(thing: Thing | null = this.thing): void {
    this.thing = thing;
    const model = read(this.#shop.text()), path = thing && this.path(thing), value = path?.reduce<any>((own, key) => own?.[key], model);
    if (!thing || !path || value === undefined) { this.#root.replaceChildren(element("p", { text: words.nothingSelected, className: "muted" })); return; }
    // The field in which somebody types stays.
    if (this.#root.contains(document.activeElement) && this.#root.dataset.path === path.join("/")) return;
    this.#root.dataset.path = path.join("/");
    const list = Array.isArray(value) ? [{ path, label: "position", value }] : fields(value, path), kind = { bodies: "body", joints: "joint", drivers: "driver", forces: "force", point: "point" }[thing.kind];
    const inText = () => { const node = at(this.#shop.text(), path); if (node) this.#shop.show(node.offset, node.offset + node.length); };
    this.#root.replaceChildren(
      element("div", { className: "row" }, element("h2", { text: thing.name, className: "text" }), element("span", { text: kind, className: "muted" })),
      element("div", { className: "row" }, element("button", { type: "button", text: "Show in the text", on: { click: inText } }), element("button", { type: "button", text: words.tools.remove![0], on: { click: () => this.#shop.remove(thing) } })),
      ...(thing.kind === "point" ? [] : [this.#name(thing)]), ...this.#bar(thing, value), ...list.map((field, k) => this.#field(field, k)));
  }
  path(thing: Thing): (string | number)[] {
    if (thing.kind !== "point") return [thing.kind, thing.name];
    const [body, ...point] = thing.name.split(".");
    return ["bodies", body!, "points", point.join(".")];
  }
  #line(label: string, value: string, change: (text: string) => void): HTMLElement {
    const number = this.#root.childElementCount + Math.floor(Math.random() * 1e6);
    const input = element("input", { type: "text", id: `field${number}`, spellcheck: "false", autocomplete: "off" });
    input.value = value;
    input.addEventListener("change", () => change(input.value));
    return element("div", { className: "field" }, element("label", { for: `field${number}`, text: label }), input);
  }
  #field({ path, label, value }: Field, _: number): HTMLElement {
    return this.#line(label, shown(value), (text) => this.#shop.write(text.trim() === "" ? drop(this.#shop.text(), path) : put(this.#shop.text(), path, typed(text, value))));
  }
  #name(thing: Thing): HTMLElement {
    return this.#line("name", thing.name, (name) => {
      const made = renamed(this.#shop.text(), thing.kind, thing.name, name.trim());
      if (made === null) { this.show(); return; }
      this.thing = { ...thing, name: name.trim() };
      this.#shop.write(made);
    });
  }
  // A body of two points has a length and an angle: those of the second point from the first.
  #bar(thing: Thing, value: any): HTMLElement[] {
    if (thing.kind !== "bodies") return [];
    const points = Object.entries<any>(value.points ?? {});
    if (points.length !== 2 || !points.every(([, own]) => Array.isArray(own) && own.every((x: unknown) => typeof x === "number"))) return [];
    const [[, [ax, ay]], [name, [bx, by]]] = points as [[string, number[]], [string, number[]]] as any, path = ["bodies", thing.name, "points", name];
    const [length, angle] = [Math.hypot(bx - ax, by - ay), Math.atan2(by - ay, bx - ax) * 180 / Math.PI], round = (own: number) => Number(own.toPrecision(7));
    const set = (length: number, degrees: number) => this.#shop.write(put(this.#shop.text(), path, [round(ax + length * Math.cos(degrees * Math.PI / 180)), round(ay + length * Math.sin(degrees * Math.PI / 180))]));
    return [this.#line("length", String(round(length)), (text) => { if (Number(text) > 0) set(Number(text), angle); }),
      this.#line("angle as drawn, °", String(round(angle)), (text) => { if (Number.isFinite(Number(text))) set(length, Number(text)); })];
  }
}

/** The text with another name for a part, wherever it is named; nothing where the name is taken or can't be one. */
export const renamed = (text: string, kind: string, old: string, name: string): string | null => {
  const model = read(text), parts = model?.[kind];
  if (!name || name === old || /[.[\],=*?\u0000-\u001f]/.test(name) || !parts || name in parts || old === "ground") return null;
  const node = at(text, [kind, old]);
  const key = node?.parent?.children?.[0];
  if (!key) return null;
  const prefix = kind === "bodies" ? "" : `${{ joints: "joint", drivers: "driver", forces: "force" }[kind]}.`, quoted = (own: string) => own.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
  // As the whole of a string, and before a point inside one.
  const inside = new RegExp(`(^|[^\\w.])${quoted(prefix + old)}(?=\\.)`, "g"), whole = kind === "bodies" || kind === "joints";
  const head = text.slice(0, key.offset) + JSON.stringify(name), rest = text.slice(key.offset + key.length), LITERAL = /"(?:[^"\\]|\\.)*"(?!\s*:)/g;
  const replaced = (part: string) => part.replace(LITERAL, (literal) => {
    const own = JSON.parse(literal) as string, made = whole && own === old ? name : own.replace(inside, `$1${prefix}${name}`);
    return made === own ? literal : JSON.stringify(made);
  });
  return replaced(head.slice(0, key.offset)) + JSON.stringify(name) + replaced(rest);
};

// What the engine says of the model.
export class Findings {
  #root = id("findings");
  #shop: Shop;
  constructor(shop: Shop) { this.#shop = shop; }
  show({ faults, warnings }: Read, summary: { message?: string; warnings: string[]; events: { type: string; time: number; note?: string }[] } | null): { faults: number; warnings: number } {
    const say = (text: string, bad: boolean, click?: () => void) => element("button", { type: "button", text, className: bad ? "finding bad text" : "finding text", disabled: !click, ...(click ? { on: { click } } : {}) });
    const said = new Set<string>();
    const once = (list: string[]) => list.filter((text) => !said.has(text) && said.add(text));
    const lines = once([...warnings, ...(summary?.warnings ?? [])]);
    const place = (text: string) => { const node = placed(this.#shop.text(), text); return node && (() => this.#shop.show(node.from, node.to)); };
    this.#root.replaceChildren(
      ...faults.map(({ text, from, to }) => say(text, true, () => this.#shop.show(from, to))),
      ...(summary?.message ? [say(summary.message, true)] : []),
      ...lines.map((text) => say(text, false, place(text) ?? undefined)),
      ...(summary?.events ?? []).slice(0, 40).map((event) => say(`${event.type.replaceAll("_", " ")} at ${Number(event.time.toPrecision(6))} s${event.note ? `: ${event.note}` : ""}`, false, () => this.#shop.seek(event.time))),
      ...(faults.length || lines.length || summary?.message ? [] : [element("p", { text: words.sound })]));
    return { faults: faults.length + (summary?.message ? 1 : 0), warnings: lines.length };
  }
}
/** The place of the text that a warning names by its path. */
const placed = (text: string, warning: string): { from: number; to: number } | null => {
  const path = /^(?:line \d+, column \d+: )?([\w]+(?:\.[^\s:,()]+|\[\d+\])*)/.exec(warning)?.[1]?.split(/[.[\]]+/).filter(Boolean).map((key) => /^\d+$/.test(key) ? Number(key) : key);
  for (let k = path?.length ?? 0; k > 1; k--) { const node = at(text, path!.slice(0, k)); if (node) return { from: node.offset, to: node.offset + node.length }; }
  return null;
};

// Questions about a parameter: which value reaches a goal, and what a sweep of it does to a curve.
import { element, id } from "./element";
import type { Knob, Place, Report } from "./linkdyn";
import { words } from "./words";

export type Curve = { value: number; across: Float64Array; values: Float64Array; failure: string };
export type Asking = {
  report(): Report | null;
  knobs(): Knob[];
  /** A column over time or the driver, for values of a parameter. */
  sample(name: string, values: number[], column: string, across: string): Promise<Curve[]>;
  set(values: Record<string, number>): Promise<void>;
  words(name: string): Promise<string>;
  /** All ways in which the mechanism closes. */
  assemblies(): Promise<Assemblies>;
  /** Draws the bodies at poses. */
  assemble(poses: (readonly [string, number[]])[]): void;
};
export type Assemblies = { words: string; bodies: string[]; found: { poses: number[][]; drawn: boolean }[]; faults?: { text: string }[] };

const SIGN = "http://www.w3.org/2000/svg", CURVES = 7, SCAN = 9, MOST = 60;
const MEASURES: Record<string, (values: Float64Array) => number> = {
  greatest: (values) => values.reduce((a, b) => b > a || Number.isNaN(a) ? b : a, NaN),
  least: (values) => values.reduce((a, b) => b < a || Number.isNaN(a) ? b : a, NaN),
  range: (values) => MEASURES.greatest!(values) - MEASURES.least!(values),
  "at the end": (values) => values[values.length - 1] ?? NaN,
  "at the start": (values) => values[0] ?? NaN,
};

export class Ask {
  #asking: Asking;
  #root = id("ask");
  #answer = element("pre", { "aria-live": "polite" });
  #chart = element("div", {});
  #column = element("select", { id: "ask-column" });
  #parameter = element("select", { id: "ask-parameter" });
  #measure = element("select", { id: "ask-measure" }, ...Object.keys(MEASURES).map((text) => element("option", { text })));
  #again = false;
  #goal = element("input", { type: "text", id: "ask-goal", autocomplete: "off" });

  constructor(asking: Asking) {
    this.#asking = asking;
    const QUESTIONS = Object.entries(words.ask.questions);
    const row = (text: string, control: HTMLElement) => element("div", { className: "field" }, element("label", { for: control.id, text }), control);
    const button = (text: string, act: () => Promise<void>) => element("button", { type: "button", text, on: { click: () => {
      this.#answer.textContent = words.computing;
      act().catch((why) => { this.#answer.textContent = (why as Error).message; });
    } } });
    for (const select of [this.#column, this.#parameter]) select.addEventListener("change", () => { select.dataset.chosen = "true"; });
    this.#root.replaceChildren(
      element("div", { className: "row" }, ...QUESTIONS.map(([name, text]) => button(text, async () => { this.#chart.replaceChildren(); this.#answer.textContent = await asking.words(name); })),
        button(words.ask.assemblies, () => this.#assemblies())),
      row(words.ask.column, this.#column), row(words.ask.parameter, this.#parameter), row(words.ask.measure, this.#measure), row(words.ask.goal, this.#goal),
      element("div", { className: "row" }, button(words.ask.seek, () => this.#seek()), button(words.ask.sweep, () => this.#sweep())),
      this.#chart, this.#answer);
  }

  // Each of them drawn; the one that is chosen is put into the text, and all are asked for again.
  async #assemblies(): Promise<void> {
    this.#chart.replaceChildren();
    const { words: told, bodies, found, faults } = await this.#asking.assemblies();
    if (faults) throw new Error(faults[0]!.text);
    this.#answer.textContent = told;
    this.#chart.replaceChildren(element("div", { className: "assemblies" }, ...found.map(({ poses, drawn }, k) => {
      const made = element("button", { type: "button", "aria-label": words.ask.assembly(k + 1, drawn), "aria-pressed": drawn ? "true" : "false", on: { click: () => {
        this.#again = true;
        this.#asking.assemble(bodies.map((name, body) => [name, poses[body]!] as const));
      } } });
      made.append(small(this.#asking.report()!, bodies, poses));
      return made;
    })));
  }

  /** What there is to ask about. */
  show(): void {
    // Those of another text are others.
    const asked = this.#chart.querySelector(".assemblies");
    if (asked && this.#again) this.#assemblies().catch((why) => { this.#answer.textContent = (why as Error).message; });
    else if (asked) { this.#chart.replaceChildren(); this.#answer.textContent = ""; }
    this.#again = false;
    const fill = (select: HTMLSelectElement, names: string[]) => {
      if (names.join("\n") === [...select.options].map(({ value }) => value).join("\n")) return;
      const before = select.value;
      select.replaceChildren(...names.map((name) => element("option", { text: name, value: name })));
      // What the reader chose stays.
      if (select.dataset.chosen && names.includes(before)) select.value = before;
    };
    const report = this.#asking.report(), rank = ({ name }: { name: string }) => [/\.effort$/, /^[^.]+\.[^.]+\.[xy]$/, /\.angle$/, /^joint\..*\.f$/].findIndex((own) => own.test(name)) >>> 0;
    const columns = (report?.columns ?? []).filter(({ wanted, name }) => wanted && name !== "time");
    fill(this.#column, [...columns].sort((a, b) => rank(a) - rank(b)).map(({ name }) => name));
    fill(this.#parameter, this.#asking.knobs().map(({ name }) => name));
  }

  get #chosen(): { report: Report; knob: Knob; column: string; unit: string; factor: number; label: string; across: string } {
    const report = this.#asking.report(), knob = this.#asking.knobs().find(({ name }) => name === this.#parameter.value), column = report?.column(this.#column.value);
    if (!report || !knob || !column) throw new Error(words.ask.nothing);
    const { factor, label } = report.units.of(column.unit), driver = report.mechanism.drivers.length === 1 ? `driver.${report.mechanism.drivers[0]!.name}.value` : "time";
    return { report, knob, column: column.name, unit: column.unit, factor, label, across: report.column(driver) ? driver : "time" };
  }

  // A bracket on a scan of the parameter's range, the one nearest to its value; then the secant within it, halved where it is slow.
  async #seek(): Promise<void> {
    const { knob, column, factor, label, across } = this.#chosen, how = MEASURES[this.#measure.value]!, wanted = Number(this.#goal.value.replace(",", ".")) / factor;
    if (!this.#goal.value.trim() || !Number.isFinite(wanted)) throw new Error(words.ask.number(label));
    const off = async (values: number[]) => (await this.#asking.sample(knob.name, values, column, across)).map(({ value, values: own, failure }) => [value, failure ? NaN : how(own) - wanted] as [number, number]);
    const scan = await off([...Array.from({ length: SCAN }, (_, k) => knob.least + (knob.most - knob.least) * k / (SCAN - 1)), knob.value]);
    const known = scan.filter(([, own]) => Number.isFinite(own)).sort((a, b) => a[0] - b[0]);
    const pairs = known.slice(1).map((own, k) => [known[k]!, own] as const).filter(([a, b]) => a[1] * b[1] <= 0);
    const away = ([a, b]: readonly [[number, number], [number, number]]) => Math.max(a[0] - knob.value, knob.value - b[0]);
    const say = (value: number) => `${Number((value * factor).toPrecision(6))} ${label}`;
    const pair = pairs.sort((a, b) => away(a) - away(b))[0];
    if (!pair) {
      const all = known.map(([, own]) => own + wanted);
      throw new Error(known.length ? words.ask.unreached(`${column}, ${this.#measure.value}`, say(Math.min(...all)), say(Math.max(...all)), knob.name, knob.least, knob.most, knob.unit) : words.ask.none(knob.name));
    }
    let [[a, fa], [b, fb]] = pair, size = Math.abs(b - a);
    for (let k = 0; k < MOST && fa !== 0 && fb !== 0 && Math.abs(b - a) > 1e-12 * Math.max(Math.abs(a), Math.abs(b)); k++) {
      const secant = b - fb * (b - a) / (fb - fa), next = k % 3 === 2 || !(secant > Math.min(a, b) && secant < Math.max(a, b)) ? (a + b) / 2 : secant;
      const [[, own]] = await off([next]) as [[number, number]];
      if (!Number.isFinite(own)) throw new Error(words.ask.none(knob.name));
      if (own * fa <= 0) [b, fb] = [next, own]; else [a, fa] = [next, own];
      size = Math.abs(b - a);
      if (Math.abs(own) <= 1e-12 * Math.abs(wanted)) break;
    }
    void size;
    const found = Number((Math.abs(fa) < Math.abs(fb) ? a : b).toPrecision(12));
    await this.#asking.set({ [knob.name]: found });
    this.#answer.textContent = words.ask.found(knob.name, found, knob.unit, `${column}, ${this.#measure.value}`, say(wanted + Math.min(Math.abs(fa), Math.abs(fb))));
  }

  async #sweep(): Promise<void> {
    const { report, knob, column, factor, label, across } = this.#chosen;
    const values = Array.from({ length: CURVES }, (_, k) => Number((knob.least + (knob.most - knob.least) * k / (CURVES - 1)).toPrecision(8)));
    const curves = (await this.#asking.sample(knob.name, values, column, across)).filter(({ values }) => values.length > 1);
    const lost = CURVES - curves.length, over = report.units.of(report.column(across)!.unit);
    this.#chart.replaceChildren(chart(curves, [over.factor, `${across} [${over.label}]`], [factor, `${column} [${label}]`], `${knob.name} [${knob.unit || "–"}]`));
    this.#answer.textContent = lost ? words.ask.lost(lost, CURVES) : "";
  }
}

const svg = (tag: string, options: Record<string, string | number>, ...children: (Node | string)[]): SVGElement => {
  const made = document.createElementNS(SIGN, tag);
  for (const [key, value] of Object.entries(options)) made.setAttribute(key, String(value));
  made.append(...children);
  return made as SVGElement;
};
// A mechanism at poses: each body as the outline of its points.
const small = ({ mechanism }: Report, names: string[], poses: number[][]): SVGElement => {
  const places = mechanism.bodies.map(({ name, points }) => {
    const [x, y, angle] = poses[names.indexOf(name)] ?? [0, 0, 0], [c, s] = [Math.cos(angle!), Math.sin(angle!)];
    return points.map(([, u, v]) => [x! + c * u - s * v, -(y! + s * u + c * v)] as Place);
  });
  const all = places.flat(), ends = [0, 1].map((axis) => [Math.min, Math.max].map((of) => of(...all.map((place) => place[axis]!)))) as [Place, Place];
  const [[left, right], [top, bottom]] = ends, size = Math.max(right - left, bottom - top) || 1, room = 0.08 * size, dot = 0.02 * size;
  return svg("svg", { viewBox: [left - room, top - room, right - left + 2 * room, bottom - top + 2 * room].join(" "), "aria-hidden": "true" },
    ...places.slice(1).map((own) => svg("polygon", { points: own.map((place) => place.join(",")).join(" "), fill: "var(--accent)", "fill-opacity": 0.15, stroke: "var(--accent)", "stroke-width": dot, "stroke-linejoin": "round" })),
    ...places.flatMap((own, body) => own.map(([x, y]) => svg("circle", { cx: x, cy: y, r: body ? dot : 1.6 * dot, fill: body ? "var(--ink)" : "var(--muted)" }))));
};
const ticks = (low: number, high: number): number[] => {
  const rough = (high - low) / 4 || 1, power = 10 ** Math.floor(Math.log10(rough)), step = [1, 2, 5, 10].map((n) => n * power).find((n) => n >= rough)!;
  return Array.from({ length: 12 }, (_, k) => (Math.ceil(low / step) + k) * step).filter((value) => value <= high + step * 1e-9).map((value) => Number(value.toPrecision(10)));
};
// A family of curves, from pale to strong, each with its value at its end.
const chart = (curves: Curve[], [fx, across]: [number, string], [fy, up]: [number, string], of: string): SVGElement => {
  const [width, height, left, right, top, bottom] = [360, 240, 52, 44, 24, 36];
  // Curves that end early have peaks that would flatten all others.
  const whole = curves.filter(({ failure }) => !failure), scale = whole.length ? whole : curves;
  const xs = curves.flatMap(({ across: own }) => Array.from(own, (x) => x * fx)).filter(Number.isFinite), ys = scale.flatMap(({ values }) => Array.from(values, (y) => y * fy)).filter(Number.isFinite);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const x = (value: number) => left + (value - x0) / (x1 - x0 || 1) * (width - left - right), y = (value: number) => Math.min(Math.max(height - bottom - (value - y0) / (y1 - y0 || 1) * (height - top - bottom), top), height - bottom);
  const end = ({ values }: Curve) => y(values[values.length - 1]! * fy);
  const text = (at: number, up: number, words: string, anchor: string) => svg("text", { x: at, y: up, "text-anchor": anchor, "font-size": 11, fill: "var(--muted)" }, words);
  const path = ({ across: own, values }: Curve) => Array.from(own, (value, k) => Number.isFinite(values[k]!) ? `${k && Number.isFinite(values[k - 1]!) ? "L" : "M"}${x(value * fx).toFixed(1)} ${y(values[k]! * fy).toFixed(1)}` : "").join("");
  return svg("svg", { viewBox: `0 0 ${width} ${height}`, width: "100%", role: "img", "aria-label": `${up} over ${across}, for values of ${of}` },
    ...ticks(x0, x1).flatMap((value) => [svg("line", { x1: x(value), x2: x(value), y1: top, y2: height - bottom, stroke: "var(--grid)" }), text(x(value), height - bottom + 14, String(value), "middle")]),
    ...ticks(y0, y1).flatMap((value) => [svg("line", { x1: left, x2: width - right, y1: y(value), y2: y(value), stroke: "var(--grid)" }), text(left - 5, y(value) + 4, String(value), "end")]),
    ...curves.map((curve, k) => svg("path", { d: path(curve), fill: "none", stroke: "var(--accent)", "stroke-width": 1.8, "stroke-opacity": 0.25 + 0.75 * (k + 1) / curves.length })),
    ...curves.filter((curve, k) => curves.slice(0, k).every((other) => Math.abs(end(other) - end(curve)) > 11)).map((curve) => text(width - right + 4, end(curve) + 4, String(Number(curve.value.toPrecision(4))), "start")),
    text(left, 14, up, "start"), text(width - 2, 14, of, "end"), text((left + width - right) / 2, height - 5, across, "middle"));
};

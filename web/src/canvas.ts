// The hand on the drawing: what it is on, what it drags, and what the tools draw. Works on the canvas of the report in the frame.
import type { End, Layer, Mechanism, Place, Report } from "./linkdyn";
import type { Target } from "./sketch";

const NEAR = 12, FAR = 4;

export type Thing = { kind: "bodies" | "joints" | "drivers" | "forces" | "point"; name: string; end?: End; body?: number };

/** A way to use the hand; what is drawn while it is used. */
export type Gesture = { move(at: Place, event: PointerEvent): void; end(at: Place, event: PointerEvent): void; cancel(): void };
export type Tool = {
  cursor: string;
  /** Takes hold of a place; nothing where the drawing is to be moved instead. */
  down(at: Place, event: PointerEvent): Gesture | null;
  click?(at: Place, event: PointerEvent): void;
  hover?(at: Place, event: PointerEvent): void;
  over?: Layer;
  /** Forgets what is half drawn; false where nothing was. */
  leave?(): boolean;
};

export class Canvas {
  report: Report | null = null;
  tool: Tool | null = null;
  selected: Thing | null = null;
  pointer: Place | null = null;
  /** Pixels of the screen per pixel of the drawing's own size don't matter: all places are in pixels of the page. */
  #gesture: { own: Gesture; id: number; from: Place; moved: boolean } | null = null;
  #background: Layer | null = null;
  /** What tolerances do, below the drawing. */
  #zones: Layer | null = null;
  onSelect: (thing: Thing | null) => void = () => {};

  attach(report: Report): void {
    this.report = report;
    this.#gesture = null;
    const { canvas, layers } = report.stage, stage = canvas.parentElement!;
    layers.over = (state) => { this.#mark(state); this.tool?.over?.(state); };
    layers.under = (state) => { this.#background?.(state); this.#zones?.(state); };
    // Before the report hears of them: what the tool takes, the report does not get.
    const on = <K extends keyof HTMLElementEventMap>(name: K, act: (event: HTMLElementEventMap[K], at: Place) => void) =>
      stage.addEventListener(name, (event) => { if (event.target === canvas) act(event, [(event as MouseEvent).offsetX, (event as MouseEvent).offsetY]); }, { capture: true });
    const took = (event: Event) => { event.stopPropagation(); };
    on("pointerdown", (event, at) => {
      if (event.button !== 0 || this.#gesture) return;
      // What is drawn is drawn at the start of the motion.
      if (this.tool?.cursor === "crosshair" && report.player.row !== 0) { report.player.pause(); report.player.seek(0); }
      const own = this.tool?.down(at, event) ?? null;
      if (!own) { this.#gesture = null; return; }
      took(event); event.preventDefault();
      canvas.focus({ preventScroll: true });
      if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
      canvas.ownerDocument.body.classList.add("held");
      this.#gesture = { own, id: event.pointerId, from: at, moved: false };
    });
    on("pointermove", (event, at) => {
      this.pointer = at;
      const held = this.#gesture;
      if (!held) { this.tool?.hover?.(at, event); canvas.style.cursor = this.#cursor(at); return; }
      if (event.pointerId !== held.id) return;
      took(event);
      held.moved ||= Math.hypot(at[0] - held.from[0], at[1] - held.from[1]) > FAR;
      if (held.moved) held.own.move(at, event);
    });
    const end = (event: PointerEvent, at: Place, isDone: boolean) => {
      const held = this.#gesture;
      if (!held || event.pointerId !== held.id) return;
      took(event);
      this.#gesture = null;
      canvas.ownerDocument.body.classList.remove("held");
      if (isDone) held.own.end(at, event); else held.own.cancel();
    };
    on("pointerup", (event, at) => end(event, at, true));
    on("pointercancel", (event, at) => end(event, at, false));
    on("pointerleave", () => { this.pointer = null; report.stage.draw(); });
    on("click", (event) => took(event));
    on("dblclick", (event) => took(event));
    // A pen or a finger draws; it does not scroll the page.
    canvas.addEventListener("touchmove", (event) => { if (this.#gesture) event.preventDefault(); }, { passive: false });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault(); event.stopPropagation();
      report.stage.zoom(Math.exp(-(event.deltaY || event.deltaX) * 0.0015), [event.offsetX, event.offsetY]);
    }, { passive: false, capture: true });
  }
  set zones(layer: Layer | null) { if (layer !== this.#zones) { this.#zones = layer; this.draw(); } }
  set background(layer: Layer | null) { this.#background = layer; this.draw(); }
  draw(): void { this.report?.stage.draw(); }
  /** Ends what the hand does, as if it had not begun. */
  cancel(): boolean {
    const held = this.#gesture;
    this.#gesture = null;
    held?.own.cancel();
    return this.leave() || Boolean(held);
  }
  leave(): boolean { return this.tool?.leave?.() ?? false; }
  get isHeld(): boolean { return this.#gesture !== null; }
  #cursor(at: Place): string { return this.tool?.cursor === "pick" ? (this.thing(at) ? "pointer" : "") : this.tool?.cursor ?? ""; }

  get #row(): number { return this.report!.player.row; }
  place(end: End): Place | null { return this.report!.shapes.place(end, this.#row); }
  pixel(end: End): Place | null { const at = this.place(end); return at && this.report!.stage.to(at); }
  get mechanism(): Mechanism { return this.report!.mechanism; }

  /** The point next to a place of the canvas: that of a moving body before that of the ground. */
  point(at: Place, near = NEAR, is: (end: End) => boolean = () => true): End | null {
    let [best, least]: [End | null, number] = [null, near];
    this.mechanism.bodies.forEach(({ points }, body) => points.forEach((_, k) => {
      const end: End = [body, k], there = is(end) ? this.pixel(end) : null;
      if (!there) return;
      const far = Math.hypot(there[0] - at[0], there[1] - at[1]) - (body ? 1 : 0);
      if (far < least) [best, least] = [end, far];
    }));
    return best;
  }
  /** All points that lie where a point is, and move with it: a pin with its bodies. */
  together(end: End): End[] {
    const here = this.place(end), found: End[] = [end];
    if (!here) return found;
    const size = 1e-6 / Math.max(this.report!.stage.shown[2] ?? 1, 1e-12) * 1000;
    const joined = (a: End, b: End) => this.mechanism.joints.some(({ type, between: [p, q] }) => ["revolute", "fixed"].includes(type)
      && ((same(p, a) && same(q, b)) || (same(p, b) && same(q, a))));
    for (let k = 0; k < found.length; k++) this.mechanism.bodies.forEach(({ points }, body) => points.forEach((_, point) => {
      const other: End = [body, point], there = this.place(other);
      if (there && !found.some((own) => same(own, other)) && Math.hypot(there[0] - here[0], there[1] - here[1]) < size && joined(found[k]!, other)) found.push(other);
    }));
    return found;
  }
  /** The moving body at a place of the canvas. */
  body(at: Place): number {
    const found = this.report!.find(at);
    if (found?.body) return found.body;
    const near = this.point(at, NEAR, ([body]) => body > 0);
    return near ? near[0] : 0;
  }
  /** What a click selects: a point of a joint, a load, a spring, a body. */
  thing(at: Place): Thing | null {
    const found = this.report!.find(at);
    if (found) {
      const [kind, ...rest] = found.owner.split("."), name = rest.join(".");
      if (kind === "joint") return { kind: "joints", name, ...this.#pinned(name) };
      if (kind === "force") return { kind: "forces", name };
      if (kind === "driver") return { kind: "drivers", name };
      if (found.kind === "point") { const end = this.point(at); if (end) return { kind: "point", name: found.name, end }; }
      if (found.body) return { kind: "bodies", name: found.name, body: found.body };
    }
    const end = this.point(at);
    return end && { kind: "point", name: `${this.mechanism.bodies[end[0]]!.name}.${this.mechanism.bodies[end[0]]!.points[end[1]]![0]}`, end };
  }
  #pinned(name: string): { end?: End } { const joint = this.mechanism.joints.find((own) => own.name === name); return joint ? { end: joint.between[1] } : {}; }

  /** Where a tool means to be: on a point, in line with the point it comes from, or on the grid. */
  snap(at: Place, from: Place | null = null, isFree = false): Target {
    const end = this.point(at);
    if (end) return { at: this.place(end)!, end };
    const { stage } = this.report!;
    if (isFree) return { at: stage.from(at), end: null };
    let [x, y] = at;
    if (from) {
      const [px, py] = stage.to(from);
      if (Math.abs(y - py) < 6) y = py; else if (Math.abs(x - px) < 6) x = px;
    }
    const grain = this.grain, [mx, my] = stage.from([x, y]), round = (value: number) => Math.round(value / grain) * grain;
    const aligned: Place = from && y === stage.to(from)[1] ? [round(mx), from[1]] : from && x === stage.to(from)[0] ? [from[0], round(my)] : [round(mx), round(my)];
    return { at: aligned, end: null };
  }
  /** What a hand can mean [m]: a round length of a few pixels. */
  get grain(): number {
    const about = 4 / (this.report?.stage.shown[2] ?? 1000), power = 10 ** Math.floor(Math.log10(about));
    return [1, 2, 5, 10].map((n) => n * power).find((n) => n >= about * 0.7) ?? power;
  }

  /** Moves the pointer by keys, so many grains right and up; where it is then, and on what. */
  nudge(right: number, up: number, event: PointerEvent): string {
    const { stage, units } = this.report!, { width, height } = stage.size, step = this.grain * stage.shown[2]!, [x, y] = this.pointer ?? [width / 2, height / 2];
    this.pointer = [Math.min(Math.max(x + right * step, 0), width), Math.min(Math.max(y - up * step, 0), height)];
    this.tool?.hover?.(this.pointer, event);
    this.draw();
    const { at, end } = this.snap(this.pointer), own = end && this.mechanism.bodies[end[0]]!;
    return [at.map((own) => units.quantity(own, "m", 4)).join(", "), ...(own ? [`${own.name}.${own.points[end[1]]![0]}`] : [])].join(": ");
  }
  /** Presses and lets go where the pointer is. */
  press(event: PointerEvent): void { const at = this.pointer; if (at) this.tool?.down(at, event)?.end(at, event); }
  /** Drags the selected point by keys. */
  push(right: number, up: number, event: PointerEvent): void {
    const end = this.selected?.end, at = end && this.pixel(end), step = this.grain * this.report!.stage.shown[2]!;
    if (!at) return;
    const own = this.tool?.down(at, event), to: Place = [at[0] + right * step, at[1] - up * step];
    own?.move(to, event);
    own?.end(to, event);
  }

  select(thing: Thing | null): void { this.selected = thing; this.onSelect(thing); this.draw(); }
  #mark(state: Parameters<Layer>[0]): void {
    const { pen, to, bar, colours } = state, thing = this.selected;
    if (!thing) return;
    pen.save();
    pen.strokeStyle = colours.accent; pen.lineWidth = 2.2; pen.setLineDash([5, 3]);
    const ring = (end: End) => { const at = this.place(end); if (at) { pen.beginPath(); pen.arc(...to(at), bar * 1.7, 0, 7); pen.stroke(); } };
    const body = thing.kind === "bodies" ? this.mechanism.bodies.findIndex(({ name }) => name === thing.name) : -1;
    if (thing.end) ring(thing.end);
    else if (body > 0) this.mechanism.bodies[body]!.points.forEach((_, k) => ring([body, k]));
    else {
      const load = this.mechanism.loads.find(({ name }) => name === thing.name), spring = this.mechanism.springs.find(({ name }) => name === thing.name);
      if (load?.at) ring(load.at);
      spring?.between.forEach(ring);
    }
    pen.restore();
  }
}

export const same = (a: End, b: End): boolean => a[0] === b[0] && a[1] === b[1];

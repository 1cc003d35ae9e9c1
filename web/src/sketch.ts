// What the tools write: bodies, points, joints, drivers and forces, as changes of the text. Lengths come in metres, global axes, and are
// written in the units of the file.
import { drop, plain, put, read, type Json } from "./edit";
import type { End, Mechanism, Place } from "./linkdyn";

export type Target = { at: Place; end: End | null };

export class Sketch {
  text: string;
  #mechanism: Mechanism;
  /** Sizes of the file's units of length [m] and angle [rad]. */
  #length: number;
  #angle: number;
  /** Rounds places to what the hand can mean [m]. */
  #grain: number;
  /** Poses of the bodies in the drawing. */
  #pose: (body: number) => number[] | null;

  constructor(text: string, mechanism: Mechanism, { length, angle }: { length: number; angle: number }, grain: number, pose: (body: number) => number[] | null) {
    [this.text, this.#mechanism, this.#length, this.#angle, this.#grain, this.#pose] = [text, mechanism, length, angle, grain, pose];
  }

  get #model(): Record<string, any> { return read(this.text) ?? {}; }
  /** A length in the file's unit, rounded to the grain. */
  length(metres: number): number { return plain(Math.round(metres / this.#grain) * this.#grain / this.#length); }
  /** An angle in the file's unit, to a hundredth of a degree. */
  angle(radians: number): number { return plain(Math.round(radians * 18000 / Math.PI) / 18000 * Math.PI / this.#angle); }
  #local(body: number, [x, y]: Place): [number, number] {
    const [px, py, angle] = (body === 0 ? [0, 0, 0] : this.#pose(body)) ?? [0, 0, 0], [dx, dy] = [x - px!, y - py!], [c, s] = [Math.cos(angle!), Math.sin(angle!)];
    return [this.length(c * dx + s * dy), this.length(c * dy - s * dx)];
  }

  #free(taken: Iterable<string>, stem: string, first = 1): string {
    const names = new Set(taken);
    for (let k = first; ; k++) if (!names.has(`${stem}${k}`)) return `${stem}${k}`;
  }
  /** A letter for a pin: one that no other pin has. */
  #letter(): string {
    const taken = new Set(Object.values<any>(this.#model.bodies ?? {}).flatMap((body) => Object.keys(body.points ?? {})));
    for (let k = 0; ; k++) { const name = String.fromCharCode(65 + k % 26) + (k >= 26 ? Math.floor(k / 26) : ""); if (!taken.has(name)) return name; }
  }
  name([body, point]: End): string { const own = this.#mechanism.bodies[body]!; return `${own.name}.${own.points[point]![0]}`; }
  body(number: number): string { return this.#mechanism.bodies[number]!.name; }

  /** A point of a body at a place, with a name like the one it meets. */
  point(body: string, at: [number, number], like: string | null = null): string {
    const taken = Object.keys(this.#model.bodies?.[body]?.points ?? {});
    const name = like && !taken.includes(like) ? like : this.#letter();
    this.text = put(this.text, ["bodies", body, "points", name], at);
    return `${body}.${name}`;
  }
  pointOn(body: number, at: Place, like: string | null = null): string { return this.point(this.body(body), this.#local(body, at), like); }
  joint(value: { [key: string]: Json }, stem: string): string {
    const name = this.#free(Object.keys(this.#model.joints ?? {}), stem);
    this.text = put(this.text, ["joints", name], value);
    return name;
  }
  pin(first: string, second: string): string { return this.joint({ type: "revolute", between: [first, second] }, "pin"); }

  /** A body with points at some places, pinned to the points that it meets. */
  bar(targets: Target[], kind = "bar"): string {
    const name = this.#free(Object.keys(this.#model.bodies ?? {}), kind);
    this.text = put(this.text, ["bodies", name], { points: {} });
    for (const { at, end } of targets) {
      const made = this.point(name, this.#local(0, at), end && this.#mechanism.bodies[end[0]]!.points[end[1]]![0]);
      if (end) this.pin(this.name(end), made);
    }
    return name;
  }
  /** Pins a point to the ground; a place without a point gets one of the ground. */
  ground({ at, end }: Target): void {
    const own = this.pointOn(0, at, end && this.#mechanism.bodies[end[0]]!.points[end[1]]![0]);
    if (end) this.pin(own, this.name(end));
  }
  /** The point where it is, or a new one on a body. */
  ensure({ at, end }: Target, body: number): string { return end && end[0] === body ? this.name(end) : this.pointOn(body, at); }

  /** A block that carries a point along a line of the ground. */
  slide({ at, end }: Target, axis: Place): void {
    const block = this.bar([{ at, end }], "block"), point = Object.keys(this.#model.bodies[block].points)[0]!;
    this.joint({ type: "prismatic", between: [this.pointOn(0, at), `${block}.${point}`], axis: direction(axis) }, "slide");
  }
  slot(target: Target, carrier: number, axis: Place): void {
    const angle = carrier === 0 ? 0 : this.#pose(carrier)?.[2] ?? 0, [c, s] = [Math.cos(angle), Math.sin(angle)];
    const own = this.pointOn(carrier, target.at);
    this.joint({ type: "slot", between: [own, this.name(target.end!)], axis: direction([c * axis[0] + s * axis[1], c * axis[1] - s * axis[0]]) }, "slot");
  }
  gear(first: End, second: End): void { this.joint({ type: "gear", between: [this.name(first), this.name(second)], ratio: -1 }, "mesh"); }

  #force(stem: string, value: { [key: string]: Json }): void {
    this.text = put(this.text, ["forces", this.#free(Object.keys(this.#model.forces ?? {}), stem)], value);
    this.#loaded();
  }
  spring(first: string, second: string, length: number, damper: boolean): void {
    this.#force(damper ? "damper" : "spring", { type: "spring", between: [first, second], ...(damper ? { stiffness: 0, damping: "100 N*s/m" } : { stiffness: "1 N/mm" }), free_length: this.length(length) });
  }
  force(point: string, [fx, fy]: Place): void { this.#force("force", { type: "force", at: point, vector: [`${fx} N`, `${fy} N`] }); }
  torque(body: string): void { this.#force("torque", { type: "torque", body, value: "1 N*m" }); }
  /** Forces need masses, and an analysis that has forces: without masses the bodies have none. */
  #loaded(): void {
    for (const [name, body] of Object.entries<any>(this.#model.bodies ?? {})) if (name !== "ground" && body.mass === undefined) {
      this.text = put(this.text, ["bodies", name, "mass"], 0);
      if (body.inertia === undefined) this.text = put(this.text, ["bodies", name, "inertia"], 0);
    }
    if (this.#model.analysis?.type === "kinematics") this.text = put(this.text, ["analysis", "type"], "inverse_dynamics");
  }
  /** Turns a body once, and asks for its motion. */
  motor(body: string, slide: string | null): void {
    const constant = { type: "constant_velocity", velocity: slide ? "100 mm/s" : "60 rpm" };
    const name = this.#free(Object.keys(this.#model.drivers ?? {}), "motor");
    this.text = put(this.text, ["drivers", name], slide ? { type: "translation", joint: slide, motion: constant } : { type: "rotation", body, motion: constant });
    if (!this.#model.analysis) this.text = put(this.text, ["analysis"], { type: Object.keys(this.#model.forces ?? {}).length ? "inverse_dynamics" : "kinematics", end: slide ? 0.5 : 1, outputs: 361 });
  }
  trace(point: string): void {
    const traced: string[] = this.#model.points ?? [], k = traced.indexOf(point);
    this.text = k < 0 ? put(this.text, ["points", traced.length], point) : traced.length === 1 ? drop(this.text, ["points"]) : drop(this.text, ["points", k]);
  }

  /** The text with poses as the guesses of the assembly; bodies that are drawn in place need none. */
  posed(poses: (readonly [string, number[]])[]): string {
    for (const [name, [x, y, angle]] of poses) {
      const position = [this.length(x!), this.length(y!)], turned = this.angle(angle!), path = ["bodies", name, "pose"];
      if (!position[0] && !position[1] && !turned) { this.text = drop(this.text, path); continue; }
      if (this.#model.bodies?.[name]?.pose) { this.text = put(this.text, [...path, "position"], position); this.text = put(this.text, [...path, "angle"], turned); }
      else this.text = put(this.text, path, { position, angle: turned });
    }
    return this.text;
  }

  /** Takes something away with all that hangs on it. */
  remove(kind: "bodies" | "joints" | "drivers" | "forces", name: string): void {
    if (kind === "bodies" && name === "ground") return;
    this.text = drop(this.text, [kind, name]);
    const model = this.#model, names = (value: unknown): boolean => typeof value === "string" ? (kind === "bodies" ? value === name || value.startsWith(`${name}.`) : value === name)
      : Array.isArray(value) ? value.some(names) : false;
    const hangs = (own: any) => kind === "bodies" ? ["between", "body", "relative_to", "through", "at", "point", "carrier"].some((key) => names(own[key])) : kind === "joints" && names(own.joint);
    for (const list of ["joints", "drivers", "forces"] as const) for (const [other, own] of Object.entries<any>(model[list] ?? {})) if (own && typeof own === "object" && hangs(own)) this.remove(list, other);
    if (kind === "bodies") this.#untrace((point) => point.startsWith(`${name}.`));
  }
  removePoint(end: End): void {
    const name = this.name(end), [body, point] = [this.body(end[0]), this.#mechanism.bodies[end[0]]!.points[end[1]]![0]];
    for (const list of ["joints", "forces"] as const) for (const [other, own] of Object.entries<any>(this.#model[list] ?? {})) if ([own?.between, own?.at, own?.point, own?.through].flat().includes(name)) this.remove(list, other);
    this.#untrace((traced) => traced === name);
    this.text = drop(this.text, ["bodies", body, "points", point]);
  }
  #untrace(is: (point: string) => boolean): void {
    for (const point of ((this.#model.points ?? []) as string[]).filter(is)) this.trace(point);
  }
}

/** A direction as short as can be: along an axis where it nearly is. */
const direction = ([x, y]: Place): [number, number] => {
  const long = Math.hypot(x, y) || 1, [u, v] = [x / long, y / long];
  if (Math.abs(v) < 0.03) return [Math.sign(u) || 1, 0];
  if (Math.abs(u) < 0.03) return [0, Math.sign(v)];
  return [Number(u.toFixed(4)), Number(v.toFixed(4))];
};

// The gallery as a course: the bundled models in an order in which one can learn from them, some with other dimensions.
import { put, type Json } from "./edit";

export type Lesson = {
  /** The bundled model. */
  model: string;
  /** Where these say more than the model itself. */
  title?: string; text?: string;
  /** What is put into it, by path. */
  changes?: [(string | number)[], Json][];
};
export type Chapter = { title: string; lessons: Lesson[] };

const bars = (base: number, crank: number, coupler: number, rocker: number): [(string | number)[], Json][] =>
  Object.entries({ base, crank, coupler, rocker }).map(([name, length]) => [["parameters", name], `${length} mm`]);
const swing = (offset: number, amplitude: number): [(string | number)[], Json] => [["drivers", "motor", "motion"], { type: "harmonic", offset, amplitude, frequency: 1 }];

export const course: Chapter[] = [
  { title: "Four bars, by Grashof's rule", lessons: [
    { model: "four-bar", title: "Crank and rocker", text: "The shortest bar is the crank, and shortest and longest together are less than the other two: the crank turns round, the rocker swings" },
    { model: "four-bar", title: "Two cranks", text: "The shortest bar is the ground: both bars that turn about it go round", changes: [[["name"], "Four-bar with two cranks"], ...bars(100, 250, 200, 300)] },
    { model: "four-bar", title: "Two rockers", text: "The shortest bar is the coupler: it could go round, the bars on the ground only swing", changes: [[["name"], "Four-bar with two rockers"], ...bars(300, 250, 100, 220), swing(47, 20)] },
    { model: "four-bar", title: "Three rockers", text: "Shortest and longest together are more than the other two: no bar goes round another", changes: [[["name"], "Four-bar with three rockers"], ...bars(300, 150, 200, 180), swing(60, 40)] },
    { model: "four-bar", title: "Parallelogram", text: "Opposite bars are equal. Where all lie in line the motion can branch: linkdyn names this change point, and goes straight through", changes: [[["name"], "Parallelogram"], ...bars(250, 100, 250, 100)] },
    { model: "parallel-crank" }, { model: "four-bar-spring" },
  ] },
  { title: "Cranks and slides", lessons: [{ model: "slider-crank" }, { model: "engine" }, { model: "scotch-yoke" }, { model: "quick-return" }, { model: "whitworth" }, { model: "wiper" }] },
  { title: "Straight lines", lessons: [{ model: "hoeken" }, { model: "chebyshev" }, { model: "watt-straight-line" }, { model: "peaucellier" }, { model: "geared-five-bar" }] },
  { title: "Six bars and more", lessons: [{ model: "stephenson-iii" }, { model: "klann-leg" }, { model: "jansen-leg" }, { model: "walking-strandbeest" }, { model: "nfourbar" }] },
  { title: "Cams, stops and contacts", lessons: [{ model: "cam-roller" }, { model: "geneva" }, { model: "toggle-clamp" }, { model: "solar-array" }] },
  { title: "Vehicles and machines", lessons: [{ model: "double-wishbone" }, { model: "bicycle-suspension" }, { model: "excavator" }] },
  { title: "Free motion", lessons: [{ model: "pendulum" }, { model: "double-pendulum" }, { model: "andrews-squeezer" }] },
  { title: "Clearance", lessons: [
    { model: "slider-crank-clearance" }, { model: "watt-i-lock" },
    { model: "watt-i-lock", title: "The lock with clearance in a pin", text: "The same lock, its first pin with 5 µm of clearance as a massless link: change the word `massless_link` to `ideal` and compare", changes: [[["joints", "a", "clearance"], { model: "massless_link", radius: "5 um" }]] },
  ] },
];

/** The text of a lesson, from that of its model. */
export const textOf = (text: string, { changes = [] }: Lesson): string => changes.reduce((made, [path, value]) => put(made, path, value), text);

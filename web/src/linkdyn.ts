// What the report and the engine hand over, as far as the editor asks for it.
export type Place = [number, number];
export type End = [body: number, point: number];

export type Mechanism = {
  bodies: { name: string; points: [string, number, number][] }[];
  joints: { name: string; type: string; between: [End, End] }[];
  drivers: { name: string; type: string; body?: number; joint?: number; pin?: number }[];
  springs: { name: string; between: [End, End] }[];
  loads: { name: string; at?: End; body?: number }[];
  points: End[];
};
export type Summary = { status: string; message?: string; warnings: string[]; settings?: { type?: string }; mobility?: { grubler: number; rank: number; drivers: number; redundant: string[] };
  events: { type: string; time: number; driver?: string; joint?: string; note?: string }[]; responses?: Record<string, { value: number | null; unit?: string }> };
export type Column = { name: string; unit: string; wanted: boolean; values: Float64Array };
export type Layer = (state: { pen: CanvasRenderingContext2D; to: (place: Place) => Place; scale: number; row: number; bar: number; colours: Record<string, any>; width: number; height: number }) => void;

/** The scripts of a report, in its frame. */
export type Report = {
  mechanism: Mechanism; summary: Summary; columns: Column[]; rows: number; time: Float64Array;
  column(name: string): Column | undefined;
  take(made: object, floats: Float64Array, trying: boolean): boolean;
  shapes: { known: boolean; posed: (number[] | null)[] | null; pose(body: number, row: number): number[] | null; place(end: End, row: number): Place | null };
  player: { row: number; playing: boolean; seek(row: number): void; rowAt(instant: number): number; pause(): void; toggle(): void; onRow(listen: () => void): void };
  stage: { canvas: HTMLCanvasElement; layers: { under: Layer | null; over: Layer | null }; draw(): void; paint(): void; zoom(by: number, at?: Place): void; whole(): void;
    to(place: Place): Place; from(at: Place): Place; shown: number[]; view: number[] | null; size: { width: number; height: number } };
  ghost: { take(): void; leave(): void };
  kept: { state(): object; restore(kept: object): void };
  find(at: Place): { name: string; kind?: string; owner: string; body?: number; between?: unknown } | null;
  lead(at: Place): ((at: Place) => void) | null;
  theme: { dark: boolean; chosen: string | null; onChange(listen: () => void): void };
  units: { of(unit: string): { factor: number; label: string }; quantity(value: number, unit: string, digits?: number): string; length(metres: number): string };
};

export type Fault = { path: string; text: string; from: number; to: number; line: number; column: number };
export type Knob = { name: string; value: number; unit: string; least: number; most: number };
/** What reading a text says. */
export type Read = { ok: boolean; faults: Fault[]; warnings: string[]; parameters: Knob[]; name: string; analysis: string | null; length: number; angle: number };
/** A run, or the mechanism at its start: the data of a report, and its numbers column after column. */
export type Picture = { facts: string; values: Float64Array; failure: string };
export type Shown = { text: string; read: Read; picture: Picture | null; milliseconds: number };
export type Faulty = { faults?: { text: string }[] };
export type Pulled = Faulty & { poses: number[]; distance: number; singular: string | null; stopped: string | null };
export type Moved = Shown & Faulty & { changed: string[]; place: Place; poses: number[]; near: number[] | null; begin: number[] | null };
/** A model that was read from a file of another program, or why it was not. */
export type Foreign = { text?: string; left_out?: string[]; fault?: string };
export type Bundled = { name: string; title: string; about: string };

// What the parts of the page share.
import type { Canvas } from "./canvas";
import type { Document } from "./document";
import type { Engine } from "./engine";
import type { Frame } from "./frame";
import type { Read, Shown } from "./linkdyn";
import type { Sketch } from "./sketch";

/** A word about what goes on, with what can be done about it. */
export type Say = (text: string, how?: { bad?: boolean; stays?: boolean; act?: [string, () => void][] }) => void;

export type App = {
  engine: Engine; frame: Frame; canvas: Canvas; doc: Document;
  say: Say;
  failed(why: unknown): void;
  /** What the engine said of the last text. */
  read(): Read | null;
  /** Takes what the engine made of a text; `trying` while a hand moves. */
  took(shown: Shown, trying: boolean): Promise<void>;
  /** Has the text shown as it is. */
  show(): Promise<void>;
  /** Another text, by drawing: one step to undo. */
  write(text: string): void;
  /** The model as the tools change it, with the bodies as they are shown. */
  sketch(): Sketch;
  /** Chooses a tool. */
  choose(name: string): void;
};

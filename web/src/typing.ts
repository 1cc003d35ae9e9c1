// What is typed while the hand draws: lengths, angles, distances.
import type { App } from "./app";
import { read } from "./edit";
import { id } from "./element";

export type Typing = {
  /** Asks for numbers under a label; `take` gets what is typed. */
  ask(label: string, take: (numbers: number[]) => void): void;
  end(): void;
  /** The unit of lengths in the file, and its size [m]. */
  readonly unit: string;
  readonly size: number;
};

// Numbers with a decimal point or comma; a blank or a semicolon parts them.
const numbers = (text: string): number[] => text.trim().split(/[;\s]+/).map((own) => Number(own.replace(/,$/, "").replace(",", ".")));

export const typing = ({ canvas, doc, read: told, choose }: Pick<App, "canvas" | "doc" | "read" | "choose">): Typing => {
  const box = id("typing"), field = box.querySelector("input")!;
  let taken: ((numbers: number[]) => void) | null = null;
  const end = (): void => {
    if (box.hidden) return;
    [box.hidden, taken] = [true, null];
    canvas.report?.stage.canvas.focus({ preventScroll: true });
  };
  field.addEventListener("keydown", ({ key }) => {
    if (key === "Escape") { end(); canvas.cancel(); choose("pose"); }
    if (key === "Enter" && taken && field.value.trim()) { const take = taken; end(); take(numbers(field.value)); }
  });
  return {
    end,
    ask: (label, take) => {
      box.querySelector("span")!.textContent = label;
      [box.hidden, field.value, taken] = [false, "", take];
      field.focus();
    },
    get unit() { return (read(doc.text)?.units as { length?: string } | undefined)?.length ?? "m"; },
    get size() { return told()?.length ?? 1; },
  };
};

// Keys of the page; those of the report in its frame are heard after these.
import type { App } from "./app";
import type { Thing, Tool } from "./canvas";
import type { Menu } from "./menu";
import { words } from "./words";

const WRITES = "input:not([type=range]):not([type=checkbox]), select, textarea, .cm-editor, dialog";

const ARROWS: Record<string, [right: number, up: number]> = { arrowright: [1, 0], arrowleft: [-1, 0], arrowup: [0, 1], arrowdown: [0, -1] };

export const keys = ({ canvas, doc, say, choose }: App, { save, open, help }: Menu, tools: Record<string, Tool>, unpose: () => void, remove: (thing: Thing) => void) => (event: KeyboardEvent): void => {
  const at = event.target as HTMLElement, control = event.ctrlKey || event.metaKey, key = event.key.toLowerCase();
  const act = (does: () => void) => { event.preventDefault(); event.stopPropagation(); does(); };
  // Files and steps back from everywhere; a field keeps its own steps, the text has those of the model.
  if (control && key === "s") { act(save); return; }
  if (control && key === "o") { act(open); return; }
  const writes = at.closest?.(WRITES);
  if (writes && !(control && at.closest(".cm-editor"))) return;
  if (control && (key === "y" || (key === "z" && event.shiftKey))) { act(() => doc.redo()); return; }
  if (control && key === "z") { act(() => doc.undo()); return; }
  if (writes || control || event.altKey) return;
  const thing = canvas.selected, tool = Object.entries(words.tools).find(([, [, own]]) => own === key);
  // The hand by keys: arrows move the pointer of a tool that draws, or the selected point by the hand for dimensions; Enter presses.
  const [right, up] = ARROWS[key] ?? [0, 0], far = event.shiftKey ? 10 : 1, hand = new PointerEvent("pointermove", { altKey: true });
  if ((right || up) && canvas.tool?.cursor === "crosshair") { act(() => say(canvas.nudge(right * far, up * far, hand))); return; }
  if ((right || up) && canvas.tool === tools.shape && canvas.selected?.end) { act(() => canvas.push(right * far, up * far, hand)); return; }
  if (key === "enter" && canvas.tool?.cursor === "crosshair" && !at.closest?.("button, a, [role=tab]")) { act(() => canvas.press(new PointerEvent("pointerup", { shiftKey: event.shiftKey }))); return; }
  if (key === "escape") act(() => { if (!canvas.cancel()) { unpose(); canvas.select(null); choose("pose"); } });
  else if ((key === "delete" || key === "backspace") && thing) act(() => remove(thing));
  else if (tool) act(() => choose(tool[0]));
  else if (key === "?") act(help);
};

// The text of the model, which is the model: what is drawn is written here, what is typed here is drawn. One history for both.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, indentWithTab } from "@codemirror/commands";
import { json } from "@codemirror/lang-json";
import { bracketMatching, defaultHighlightStyle, foldGutter, foldKeymap, HighlightStyle, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Compartment, EditorState, type Extension } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { between } from "./edit";
import type { Fault } from "./linkdyn";
import { completions, type Schema } from "./schema";

// Milliseconds between keys that are typed in one go; steps that can be undone.
const TOGETHER = 700, MOST_STEPS = 2000;

const colours = HighlightStyle.define([
  { tag: tags.propertyName, color: "var(--accent)" }, { tag: tags.string, color: "var(--good)" }, { tag: tags.number, color: "var(--load)" },
  { tag: [tags.bool, tags.null], color: "var(--force)" },
]);
const look = EditorView.theme({
  "&": { height: "100%", fontSize: "12.5px", color: "var(--ink)", backgroundColor: "var(--card)" },
  ".cm-gutters": { backgroundColor: "var(--card)", color: "var(--muted)", border: "none" },
  ".cm-content": { fontFamily: "ui-monospace, Consolas, monospace", caretColor: "var(--ink)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "color-mix(in srgb, var(--accent) 7%, transparent)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "color-mix(in srgb, var(--accent) 24%, transparent) !important" },
  ".cm-tooltip, .cm-panels": { backgroundColor: "var(--card)", color: "var(--ink)", border: "1px solid var(--line)" },
  ".cm-diagnostic": { whiteSpace: "pre-wrap", maxWidth: "420px" },
});

export class Document {
  readonly view: EditorView;
  /** What the hand that holds the text found. */
  #held: string | null = null;
  // Whole texts: what a hand does in between leaves no trace, and the first byte is always found again.
  #past: string[] = [];
  #future: string[] = [];
  #last: string;
  #typed = -Infinity;
  /** Told of every change but those of a hand that still moves. */
  onChange: (why: "typed" | "written" | "history") => void = () => {};
  #schema = new Compartment();
  #quiet = false;
  #extensions: Extension[];

  constructor(parent: HTMLElement, text: string) {
    this.#last = text;
    const heard = EditorView.updateListener.of((update) => {
      if (!update.docChanged || this.#quiet) return;
      const now = performance.now();
      // What is typed in one go is one step.
      if (now - this.#typed > TOGETHER) this.#keep();
      this.#typed = now;
      this.#last = this.text;
      this.onChange("typed");
    });
    this.#extensions = [
      lineNumbers(), foldGutter(), lintGutter(), drawSelection(), indentOnInput(), bracketMatching(), closeBrackets(), highlightActiveLine(), highlightActiveLineGutter(),
      highlightSelectionMatches(), json(), syntaxHighlighting(colours), syntaxHighlighting(defaultHighlightStyle, { fallback: true }), look,
      // Tab leaves the text where Escape was pressed before, so that the keyboard is not caught.
      keymap.of([...closeBracketsKeymap, ...completionKeymap, ...defaultKeymap, ...searchKeymap, ...foldKeymap, indentWithTab]),
      this.#schema.of([]), heard, EditorView.contentAttributes.of({ "aria-label": "Text of the model" }),
      // Whatever a file's lines end with stays as it is.
      EditorState.lineSeparator.of("\n"),
    ];
    this.view = new EditorView({ parent, state: this.#state(text) });
  }

  #state(text: string): EditorState { return EditorState.create({ doc: text, extensions: this.#extensions }); }
  /** Another model, with a history of its own. */
  open(text: string): void {
    [this.#held, this.#past, this.#future, this.#last, this.#typed] = [null, [], [], text, -Infinity];
    this.view.setState(this.#state(text));
    if (this.#known) this.learn(this.#known);
  }
  #known: Schema | null = null;

  get text(): string { return this.view.state.sliceDoc(); }
  get canUndo(): boolean { return this.#past.length > 0; }
  get canRedo(): boolean { return this.#future.length > 0; }
  undo(): void { this.#turn(this.#past, this.#future); }
  redo(): void { this.#turn(this.#future, this.#past); }
  #turn(from: string[], to: string[]): void {
    if (this.#held !== null) return;
    const text = from.pop();
    if (text === undefined) return;
    to.push(this.#last);
    this.#set(text, "history");
  }
  // Another text is one more step.
  #keep(): void {
    this.#past.push(this.#last);
    if (this.#past.length > MOST_STEPS) this.#past.shift();
    this.#future = [];
  }
  #set(text: string, why: "written" | "history"): void {
    this.#show(text);
    [this.#last, this.#typed] = [text, -Infinity];
    this.onChange(why);
  }
  #show(text: string): void {
    const edit = between(this.text, text);
    this.#quiet = true;
    if (edit) this.view.dispatch({ changes: edit, scrollIntoView: false });
    this.#quiet = false;
  }
  /** A change that is made by drawing: one step to undo. */
  write(text: string): void {
    if (text === this.#last) { this.#show(text); return; }
    this.#keep();
    this.#set(text, "written");
  }

  /** Changes while a hand moves are one step when it lets go. */
  hold(): void { this.#held ??= this.text; }
  get held(): string | null { return this.#held; }
  live(text: string): void { this.#show(text); }
  release(): void {
    if (this.#held === null) return;
    this.#held = null;
    this.write(this.text);
  }

  /** Marks what the engine complains of. */
  mark(faults: Fault[], warnings: { text: string; from: number; to: number }[] = []): void {
    const size = this.view.state.doc.length, clip = (offset: number) => Math.min(Math.max(offset, 0), size);
    const all = [...faults.map((own) => ({ ...own, severity: "error" as const })), ...warnings.map((own) => ({ ...own, severity: "warning" as const }))];
    const made = all.map(({ from, to, text, severity }) => ({ from: clip(from), to: clip(Math.max(to, from)), message: text, severity }));
    this.view.dispatch(setDiagnostics(this.view.state, made.sort((a, b) => a.from - b.from)));
  }
  learn(schema: Schema): void { this.#known = schema; this.view.dispatch({ effects: this.#schema.reconfigure(autocompletion({ override: [completions(schema)] })) }); }
  /** Shows a place of the text. */
  show(from: number, to = from, focus = true): void {
    const size = this.view.state.doc.length;
    this.view.dispatch({ selection: { anchor: Math.min(from, size), head: Math.min(to, size) }, effects: EditorView.scrollIntoView(Math.min(from, size), { y: "center" }) });
    if (focus) this.view.focus();
  }
}

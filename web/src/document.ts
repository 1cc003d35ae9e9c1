// The text of the model, which is the model: what is drawn is written here, what is typed here is drawn. One history for both.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, isolateHistory, redo, redoDepth, undo, undoDepth } from "@codemirror/commands";
import { json } from "@codemirror/lang-json";
import { bracketMatching, defaultHighlightStyle, foldGutter, foldKeymap, HighlightStyle, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Compartment, EditorState, Transaction, type Extension } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { between } from "./edit";
import type { Fault } from "./linkdyn";
import { completions, type Schema } from "./schema";

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
  /** The text while a hand holds it; what was there before. */
  #held: string | null = null;
  /** Told of every change but those of a hand. */
  onChange: (why: "typed" | "written" | "history") => void = () => {};
  #schema = new Compartment();
  #quiet = false;
  #extensions: Extension[];

  constructor(parent: HTMLElement, text: string) {
    const heard = EditorView.updateListener.of((update) => {
      if (!update.docChanged || this.#quiet) return;
      const undone = update.transactions.some((own) => own.isUserEvent("undo") || own.isUserEvent("redo"));
      this.onChange(undone ? "history" : update.transactions.some((own) => own.isUserEvent("drawn")) ? "written" : "typed");
    });
    this.#extensions = [
      lineNumbers(), foldGutter(), lintGutter(), history(), drawSelection(), indentOnInput(), bracketMatching(), closeBrackets(), highlightActiveLine(), highlightActiveLineGutter(),
      highlightSelectionMatches(), json(), syntaxHighlighting(colours), syntaxHighlighting(defaultHighlightStyle, { fallback: true }), look,
      // Tab leaves the text where Escape was pressed before, so that the keyboard is not caught.
      keymap.of([...closeBracketsKeymap, ...completionKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...foldKeymap, indentWithTab]),
      this.#schema.of([]), heard, EditorView.contentAttributes.of({ "aria-label": "Text of the model" }),
      // Whatever a file's lines end with stays as it is.
      EditorState.lineSeparator.of("\n"),
    ];
    this.view = new EditorView({ parent, state: this.#state(text) });
  }

  #state(text: string): EditorState { return EditorState.create({ doc: text, extensions: this.#extensions }); }
  /** Another model, with a history of its own. */
  open(text: string): void {
    this.#held = null;
    this.view.setState(this.#state(text));
    if (this.#known) this.learn(this.#known);
  }
  #known: Schema | null = null;

  get text(): string { return this.view.state.sliceDoc(); }
  get canUndo(): boolean { return undoDepth(this.view.state) > 0; }
  get canRedo(): boolean { return redoDepth(this.view.state) > 0; }
  undo(): void { undo(this.view); }
  redo(): void { redo(this.view); }

  #dispatch(text: string, annotations: any[]): void {
    const edit = between(this.text, text);
    if (edit) this.view.dispatch({ changes: edit, annotations, scrollIntoView: false });
  }
  /** A change that is made by drawing: one step to undo. */
  write(text: string): void { this.#dispatch(text, [Transaction.userEvent.of("drawn"), isolateHistory.of("full")]); }

  /** Changes while a hand moves are one step when it lets go. */
  hold(): void { this.#held ??= this.text; }
  get held(): string | null { return this.#held; }
  live(text: string): void {
    this.#quiet = true;
    this.#dispatch(text, [Transaction.addToHistory.of(false)]);
    this.#quiet = false;
  }
  release(): void {
    const [before, now] = [this.#held, this.text];
    this.#held = null;
    if (before === null || before === now) return;
    this.#held = before;
    this.live(before);
    this.#held = null;
    this.write(now);
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

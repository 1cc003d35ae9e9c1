// The bar above: files, links, exports, the picture below, light and dark, keys.
import type { App } from "./app";
import { course, textOf, type Lesson } from "./course";
import { element, id } from "./element";
import { gif } from "./gif";
import type { Bundled, Foreign } from "./linkdyn";
import { Files, give, isForeign, packed, type Handle, type Served } from "./share";
import type { Typing } from "./typing";
import { Underlay } from "./underlay";
import { words } from "./words";

export type Menu = {
  /** Another model in the place of this one. */
  opened(text: string, name?: string): void;
  save(): void; open(): void; help(): void;
  /** What can be undone may have changed. */
  tell(): void;
  underlay: Underlay;
  files: Files;
};

const { file, close } = words;
const button = (text: string, title: string, act: () => void): HTMLButtonElement => element("button", { type: "button", text, title, "aria-label": text.length > 1 ? undefined : title, on: { click: act } });
const dialog = (name: string, title: string, ...parts: Node[]): HTMLDialogElement => {
  const made = id<HTMLDialogElement>(name);
  made.replaceChildren(element("header", {}, element("h2", { text: title }), button("×", close, () => made.close())), ...parts);
  made.showModal();
  return made;
};

export const menu = ({ engine, frame, canvas, doc, say, failed, show, write, choose }: App, typing: Typing, served: Served | null, fresh: string): Menu => {
  const files = new Files(), guarded = (act: () => Promise<void>) => () => void act().catch(failed);
  const opened = (text: string, name?: string): void => {
    if (name) files.forget(name);
    say("");
    canvas.cancel();
    canvas.select(null);
    frame.fits = true;
    doc.open(text);
    void show();
  };

  // Each card is a link that holds its model: it can be sent.
  const gallery = guarded(async () => {
    const all = new Map((await engine.ask<Bundled[]>("models")).map((own) => [own.name, own]));
    const card = async (lesson: Lesson): Promise<HTMLElement> => {
      const { title = all.get(lesson.model)?.title ?? lesson.model, text = all.get(lesson.model)?.about ?? "" } = lesson, model = textOf(await engine.ask<string>("model", [lesson.model]), lesson);
      const taken = (event: Event): void => { event.preventDefault(); made.close(); opened(model, `${lesson.model}.json`); };
      return element("a", { href: await packed(model), on: { click: taken } }, element("strong", { text: title, className: "text" }), element("span", { text, className: "text" }));
    };
    const chapters = await Promise.all(course.map(async ({ title, lessons }) => element("section", {}, element("h3", { text: title }), element("div", { className: "models" }, ...await Promise.all(lessons.map(card))))));
    const made = dialog("gallery", file.gallery, element("p", { text: file.galleryText, className: "muted" }), ...chapters);
  });
  const link = guarded(async () => {
    history.replaceState(null, "", await packed(doc.text));
    try { await navigator.clipboard.writeText(location.href); say(words.copied); } catch { say(words.inAddress); }
  });

  // The file that is served: what it holds, and what another program makes of it.
  let known = "";
  const saving = async (): Promise<void> => {
    if (!served) { await files.save(doc.text); return; }
    if (await served.save(doc.text)) { known = doc.text; say(words.saved(served.name)); } else clash(await served.read());
  };
  const save = guarded(saving);
  // Two texts of one file: the reader says which.
  const clash = (other: string | null): void => say(words.changedOnDisk(served!.name), { stays: true, act: [[words.overwrite, save], ...(other === null ? [] : [[words.takeIt, () => write(other)] as [string, () => void]])] });
  if (served) {
    files.forget(served.name);
    known = served.saved;
    void served.watch((text) => {
      if (doc.text === text) return;
      const isClean = doc.text === known;
      known = text;
      if (isClean) write(text); else clash(text);
    }, () => say(words.ended, { bad: true, stays: true }));
  }
  const input = id<HTMLInputElement>("chosen");
  // What another program wrote becomes a model of that name; what it lacks is listed.
  const foreign = async (name: string, bytes: Uint8Array): Promise<void> => {
    const { text, left_out: lacks = [], fault = "" } = await engine.ask<Foreign>("imported", [name, bytes]);
    if (text === undefined) { say(fault, { bad: true, stays: true }); return; }
    opened(text, `${name.replace(/\.[^.]*$/, "") || "model"}.json`);
    if (lacks.length) dialog("lacks", words.lacks, element("p", { text: words.lacksText, className: "muted" }), element("ul", {}, ...lacks.map((what) => element("li", { text: what, className: "text" }))));
  };
  const take = async (chosen: File | undefined, handle: Handle | null = null): Promise<void> => {
    if (!chosen) return;
    const bytes = await files.bytes(chosen);
    if (isForeign(chosen.name, bytes)) await foreign(chosen.name, bytes); else opened(files.take(chosen.name, bytes, handle));
  };
  const pasted = (link: string | undefined): boolean => {
    const found = /^\s*(https?:\/\/[^\s?]*pmks[^\s?]*\?.+)$/im.exec(link ?? "");
    if (found) void foreign("", new TextEncoder().encode(found[1])).catch(failed);
    return found !== null;
  };
  input.addEventListener("change", guarded(async () => { const [chosen] = input.files ?? []; input.value = ""; await take(chosen); }) as () => void);
  const open = guarded(() => files.open(input, take));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => { event.preventDefault(); if (!pasted(event.dataTransfer?.getData("text/plain"))) take(event.dataTransfer?.files[0]).catch(failed); });
  // A link of PMKS+ is read wherever it is pasted but in a text that is typed.
  addEventListener("paste", (event) => { if (!(event.target as Element).closest("input, textarea, [contenteditable]") && pasted(event.clipboardData?.getData("text/plain"))) event.preventDefault(); });

  const asked = (question: string, type: string) => async (): Promise<Blob> => new Blob([await engine.ask<string>(question)], { type });
  const EXPORTS: [string, () => Promise<Blob>][] = [["results.csv", asked("csv", "text/csv")], ["summary.json", asked("summary", "application/json")], ["report.html", asked("page", "text/html")], ["motion.gif", () => gif(frame.report!)]];
  const exported = element("select", { "aria-label": file.export, title: file.export }, element("option", { value: "", text: file.export }), ...EXPORTS.map(([name], k) => element("option", { value: k, text: name })));
  exported.addEventListener("change", guarded(async () => {
    const [name, made] = EXPORTS[Number(exported.value)]!;
    exported.value = "";
    give(name, await made());
  }));

  const underlay = new Underlay(canvas), picture = element("input", { type: "file", accept: "image/*", hidden: "", "aria-label": words.underlay.hint });
  const below = button(words.underlay.open, words.underlay.hint, () => { if (underlay.isThere) { underlay.remove(); below.textContent = words.underlay.open; } else picture.click(); });
  picture.addEventListener("change", guarded(async () => {
    const chosen = picture.files?.[0];
    picture.value = "";
    if (!chosen) return;
    await underlay.take(chosen);
    below.textContent = words.underlay.remove;
    say(words.underlay.scale(typing.unit), { stays: true });
    choose("pose");
    canvas.tool = underlay.tool((take) => typing.ask(words.underlay.distance(typing.unit), ([length]) => { if (length! > 0) take(length! * typing.size); }), () => { say(""); choose("pose"); });
  }));

  const undo = button("↶", `${file.undo} (Ctrl+Z)`, () => doc.undo()), redo = button("↷", `${file.redo} (Ctrl+Y)`, () => doc.redo());
  const tell = (): void => { undo.disabled = !doc.canUndo; redo.disabled = !doc.canRedo; };
  id("files").append(button(file.new, file.newHint, () => opened(fresh, "model.json")), button(file.gallery, file.galleryHint, gallery), button(file.open, `${file.openHint} (Ctrl+O)`, open),
    button(file.save, `${file.saveHint} (Ctrl+S)`, save), undo, redo, button(file.link, file.linkHint, link), exported, below, picture);

  const system = matchMedia("(prefers-color-scheme: dark)"), { dataset } = document.documentElement;
  const theme = (): void => {
    dataset.theme = (dataset.theme ? dataset.theme === "dark" : system.matches) ? "light" : "dark";
    if (frame.report) frame.report.theme.chosen = dataset.theme;
  };
  const help = (): void => {
    const own = Object.values(words.tools).map(([name, key, hint]) => [key, `${name}: ${hint}`]);
    dialog("help", words.keys, element("div", {}, ...[...own, ...words.otherKeys].map(([key, text]) => element("p", {}, element("kbd", { text: key! }), ` ${text}`))));
  };
  id("switches").append(button("◐", words.theme, theme), button("?", words.keys, help));
  return { opened, save, open, help, tell, underlay, files };
};

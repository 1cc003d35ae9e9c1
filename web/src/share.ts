// The model in the address, in the browser's store and in files. Nothing is sent to a server.

import type { Picture } from "./linkdyn";

const LONGEST = 4_000_000;

const through = async (bytes: Uint8Array, stream: GenericTransformStream, longest = Infinity): Promise<Uint8Array> => {
  const reader = new Blob([bytes as BlobPart]).stream().pipeThrough(stream as unknown as ReadableWritablePair<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>).getReader(), parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > longest) { await reader.cancel(); throw new Error("too long"); }
    parts.push(value);
  }
  const whole = new Uint8Array(size);
  let k = 0;
  for (const part of parts) { whole.set(part, k); k += part.length; }
  return whole;
};
const base64 = (bytes: Uint8Array): string => {
  let binary = "";
  for (let k = 0; k < bytes.length; k += 8192) binary += String.fromCharCode(...bytes.subarray(k, k + 8192));
  return btoa(binary);
};
export const bytesOf = (text: string): Uint8Array => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** The model as the part of an address behind `#`. */
export const packed = async (text: string): Promise<string> => {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  return `#m=${base64(bytes).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
};
/** The model of an address; nothing where it has none, an error where it can't be read. */
export const unpacked = async (hash: string): Promise<string | null> => {
  const found = /^#m=(.*)$/.exec(hash);
  if (!found) return null;
  const bytes = bytesOf(found[1]!.replaceAll("-", "+").replaceAll("_", "/"));
  return decoded(await through(bytes, new DecompressionStream("deflate-raw"), LONGEST) as BufferSource);
};
/** The text of a file, each byte of it. */
export const decoded = (bytes: BufferSource): string => new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(bytes);
export const gunzipped = (bytes: Uint8Array): Promise<Uint8Array> => through(bytes, new DecompressionStream("gzip"));

const KEY = "linkdyn.editor";
export const remember = (text: string): void => { try { localStorage.setItem(KEY, text); } catch { /* there is no store, or no room in it */ } };
export const remembered = (): string | null => { try { return localStorage.getItem(KEY); } catch { return null; } };

/** Gives the reader a file. */
export const give = (name: string, blob: Blob): void => {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
};

export type Handle = { name: string; getFile(): Promise<File>; createWritable(): Promise<{ write(text: string): Promise<void>; close(): Promise<void> }> };
type Pickers = { showOpenFilePicker?(options: object): Promise<Handle[]>; showSaveFilePicker?(options: object): Promise<Handle> };
const KINDS = { types: [{ description: "linkdyn model", accept: { "application/json": [".json"] } }] };
const ALL = { types: [...KINDS.types, { description: "Files of other programs", accept: { "text/csv": [".csv"], "text/xml": [".urdf", ".sdf", ".xml", ".svg"], "text/plain": [".dxf", ".pmks", ".url"] } }] };

/** Whether a file is one of another program: by its name, or lists where a model has objects. */
export const isForeign = (name: string, bytes: Uint8Array): boolean => /\.(csv|urdf|sdf|xml|svg|dxf|pmks|url)$/i.test(name) || /"(joints|nodes)"\s*:\s*\[/.test(new TextDecoder().decode(bytes));

/** The file that is edited, where the browser may keep hold of it. */
export class Files {
  #handle: Handle | null = null;
  name = "model.json";

  /** Takes the file that the reader chooses; where the browser has no such window, the input tells of it. */
  async open(input: HTMLInputElement, take: (file: File, handle: Handle) => Promise<void>): Promise<void> {
    const pickers = window as unknown as Pickers;
    if (!pickers.showOpenFilePicker) { input.click(); return; }
    try {
      const [handle] = await pickers.showOpenFilePicker(ALL);
      if (handle) await take(await handle.getFile(), handle);
    } catch (why) { if ((why as Error).name !== "AbortError") throw why; }
  }
  /** What is in a file, each byte of it. */
  async bytes(file: File): Promise<Uint8Array> {
    if (file.size > LONGEST) throw new Error(`${file.name} has more than ${LONGEST / 1e6} MB`);
    return new Uint8Array(await file.arrayBuffer());
  }
  /** The text of a model's file, which is edited from here on. */
  take(name: string, bytes: Uint8Array, handle: Handle | null = null): string {
    const text = decoded(bytes as BufferSource);
    [this.#handle, this.name] = [handle, name];
    return text;
  }
  forget(name = "model.json"): void { [this.#handle, this.name] = [null, name]; }
  async save(text: string): Promise<void> {
    const pickers = window as unknown as Pickers;
    try {
      if (!this.#handle && pickers.showSaveFilePicker) {
        this.#handle = await pickers.showSaveFilePicker({ ...KINDS, suggestedName: this.name });
        this.name = this.#handle.name;
      }
    } catch (why) { if ((why as Error).name === "AbortError") return; throw why; }
    if (!this.#handle) { give(this.name, new Blob([text], { type: "application/json" })); return; }
    const file = await this.#handle.createWritable();
    await file.write(text);
    await file.close();
  }
}

/** The file that `linkdyn edit` serves beside the page. */
export class Served {
  #version = "";
  /** What was read or saved last. */
  saved = "";
  readonly name: string;
  constructor(name: string) { this.name = name; }
  static get found(): Served | null {
    const name = document.querySelector<HTMLMetaElement>("meta[name='linkdyn-file']")?.content;
    return name ? new Served(name) : null;
  }
  async #ask(path: string, options?: RequestInit): Promise<Response> { return fetch(path, { cache: "no-store", ...options }); }
  /** The text of the file; nothing where there is none yet. */
  async read(): Promise<string | null> {
    this.#version = await (await this.#ask("state?")).text();
    const answer = await this.#ask("model");
    return answer.ok ? this.saved = decoded(await answer.arrayBuffer()) : null;
  }
  /** Saves; false where another program has saved meanwhile. */
  async save(text: string): Promise<boolean> {
    const answer = await this.#ask(`save?${this.#version}`, { method: "POST", body: text });
    if (answer.status === 409) return false;
    if (!answer.ok) throw new Error(await answer.text());
    [this.#version, this.saved] = [await answer.text(), text];
    return true;
  }
  /** The answer to a question in words, by the command. */
  async words(name: string, text: string): Promise<string> { return (await this.#ask(`ask?${name}`, { method: "POST", body: text })).text(); }
  /** What a run comes to, by the command: a line of what is drawn, then the numbers. */
  async run(text: string): Promise<Picture> {
    const answer = await this.#ask("run", { method: "POST", body: text });
    if (!answer.ok) throw new Error(await answer.text());
    const bytes = await answer.arrayBuffer(), end = new Uint8Array(bytes).indexOf(10);
    return { facts: new TextDecoder().decode(bytes.slice(0, end)), values: new Float64Array(bytes.slice(end + 1)), failure: "" };
  }
  /** Tells of each text that another program saves; ends with the command. */
  async watch(take: (text: string) => void, ended: () => void): Promise<void> {
    try {
      for (;;) {
        const version = await (await this.#ask(`state?${this.#version}`)).text();
        if (version === this.#version || version === "none") continue;
        const text = await this.read();
        if (text !== null) take(text);
      }
    } catch { ended(); }
  }
}

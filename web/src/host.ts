// A page around this one, such as a notebook: it gives a text, and hears of each that is made here. A page elsewhere is given nothing that
// it did not bring: where there is one around, the browser's store is left alone.

type Said = { linkdyn?: { text?: string } };

export class Host {
  #around: Window;
  /** What was exchanged last. */
  #text: string | null = null;
  constructor(around: Window) { this.#around = around; }
  static get found(): Host | null { return parent === window ? null : new Host(parent); }

  /** Hears of texts, from now on; the first one is asked for. */
  listen(take: (text: string) => void): void {
    addEventListener("message", ({ source, data }: MessageEvent<Said>) => {
      const text = source === this.#around ? data?.linkdyn?.text : undefined;
      if (typeof text !== "string" || text === this.#text) return;
      this.#text = text;
      take(text);
    });
    this.#around.postMessage({ linkdyn: { ready: true } }, "*");
  }
  /** Tells of a text; of what it gave itself it knows. */
  tell(text: string): void {
    if (this.#text === null || text === this.#text) return;
    this.#text = text;
    this.#around.postMessage({ linkdyn: { text } }, "*");
  }
}

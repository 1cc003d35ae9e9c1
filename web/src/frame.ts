// The report of the model in a frame: it takes the data of the next run in place, or is made anew behind the one that is shown.
import type { Picture, Report } from "./linkdyn";

export class Frame {
  #holder: HTMLElement;
  #parts: [string, string, string];
  #style: string;
  #frame: HTMLIFrameElement | null = null;
  #coming: Promise<void> = Promise.resolve();
  #waits = 0;
  report: Report | null = null;
  /** Whether the next picture is shown whole; else the view stays where it is, under the hand. */
  fits = true;
  /** Called for each report that is made anew. */
  onMade: (report: Report, frame: Window) => void = () => {};

  constructor(holder: HTMLElement, parts: [string, string, string], style: string) { [this.#holder, this.#parts, this.#style] = [holder, parts, style]; }

  /** Whether what was given last is on the page. */
  get isShown(): boolean { return this.#waits === 0; }
  get window(): Window | null { return this.#frame?.contentWindow ?? null; }

  /** Shows a picture; `trying`: while a hand moves, the state before stays as a ghost. */
  show(picture: Picture, trying: boolean): Promise<void> {
    // Pictures are shown in their order.
    this.#waits++;
    return this.#coming = this.#coming.then(() => this.#take(picture, trying)).finally(() => { this.#waits--; });
  }
  async #take(picture: Picture, trying: boolean): Promise<void> {
    const { report } = this;
    if (!report?.take(JSON.parse(picture.facts), picture.values, trying)) {
      // The canvas stays under the hand that holds it: what is another page is shown when it lets go.
      if (trying && report) { this.window?.document.body.classList.add("old"); return; }
      await this.#make(picture);
    } else if (this.fits) report.stage.whole();
    if (this.fits) setTimeout(() => this.stay(), 0);
    this.fits = false;
  }
  stay(): void { if (this.report) this.report.stage.view = this.report.stage.shown; }
  #make({ facts, values }: Picture): Promise<void> {
    return new Promise((done) => {
      const made = document.createElement("iframe"), before = this.#frame;
      made.title = "Mechanism";
      Object.assign(made, { handed: values });
      made.srcdoc = this.#parts[0] + facts + this.#parts[1] + this.#parts[2];
      made.onload = () => {
        const frame = made.contentWindow!, report = (frame as unknown as { linkdyn: Report }).linkdyn;
        const kept = this.report?.kept.state(), view = this.report?.stage.shown;
        const style = new (frame as unknown as typeof globalThis).CSSStyleSheet();
        style.replaceSync(this.#style);
        frame.document.adoptedStyleSheets = [style];
        [this.#frame, this.report] = [made, report];
        if (kept && !this.fits) report.kept.restore(kept);
        if (view && !this.fits) report.stage.view = view;
        this.onMade(report, frame);
        before?.remove();
        made.classList.remove("coming");
        done();
      };
      made.className = "coming";
      this.#holder.prepend(made);
    });
  }
}

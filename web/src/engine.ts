// The engine in its worker. Questions are answered in order, but of live ones only the newest is asked; one that takes too long is
// ended with the worker, and the next one gets a new worker.
import { words } from "./words";

type Question = { name: string; args: unknown[]; done: (answer: any) => void; fail: (why: Error) => void; seconds: number };

/** How long a run may take, and one while a hand moves [s]. */
export const SECONDS = 8, LIVE_SECONDS = 2;

export class Interrupted extends Error {}

export class Engine {
  #source: string;
  #module: WebAssembly.Module;
  #worker: Worker | null = null;
  #queue: Question[] = [];
  #live: Question | null = null;
  #asked: Question | null = null;
  #clock = 0;
  /** Told while an answer is late. */
  onBusy: (busy: boolean) => void = () => {};

  constructor(source: string, module: WebAssembly.Module) {
    [this.#source, this.#module] = [source, module];
    this.#start();
  }

  #start(): Worker {
    const address = URL.createObjectURL(new Blob([this.#source], { type: "text/javascript" }));
    const worker = new Worker(address);
    URL.revokeObjectURL(address);
    worker.postMessage({ module: this.#module });
    worker.onmessage = ({ data }) => this.#answered(data);
    worker.onerror = ({ message }) => this.#broken(new Error(words.bug(message)));
    return this.#worker = worker;
  }

  ask<T>(name: string, args: unknown[] = [], seconds = 30): Promise<T> {
    return new Promise((done, fail) => { this.#queue.push({ name, args, done, fail, seconds }); this.#next(); });
  }
  /** Of questions that wait the newest only is asked; the others end without an answer. */
  live<T>(name: string, args: unknown[], seconds = 5): Promise<T | null> {
    return new Promise((done, fail) => {
      this.#live?.done(null);
      this.#live = { name, args, done, fail, seconds };
      this.#next();
    });
  }
  get idle(): boolean { return !this.#asked && !this.#live && !this.#queue.length; }
  /** Ends what is computed now. */
  interrupt(): void { if (this.#asked) this.#broken(new Interrupted()); }

  #next(): void {
    if (this.#asked) return;
    const question = this.#queue.shift() ?? this.#live;
    if (!question) return;
    if (question === this.#live) this.#live = null;
    this.#asked = question;
    const { name, args, seconds } = question;
    this.#clock = window.setTimeout(() => {
      this.onBusy(true);
      this.#clock = window.setTimeout(() => this.#broken(new Error(words.tooLong(seconds))), seconds * 1000 - 300);
    }, 300);
    (this.#worker ?? this.#start()).postMessage({ name, args });
  }
  #settle(): Question | null {
    clearTimeout(this.#clock);
    this.onBusy(false);
    const asked = this.#asked;
    this.#asked = null;
    return asked;
  }
  #answered({ answer, bug }: { answer?: unknown; bug?: string }): void {
    // After a trap the instance can't be trusted.
    if (bug !== undefined) { this.#broken(new Error(words.bug(bug))); return; }
    this.#settle()?.done(answer);
    this.#next();
  }
  #broken(why: Error): void {
    this.#worker?.terminate();
    this.#worker = null;
    this.#settle()?.fail(why);
    this.#next();
  }
}

// A picture to draw over, scaled by two of its points. It stays on the page: the model knows nothing of it.
import type { Canvas, Tool } from "./canvas";
import type { Place } from "./linkdyn";

export class Underlay {
  #picture: ImageBitmap | null = null;
  /** Of its lower left corner [m], and the size of a pixel [m]. */
  #at: Place = [0, 0];
  #pixel = 1;
  #canvas: Canvas;
  constructor(canvas: Canvas) { this.#canvas = canvas; }

  get isThere(): boolean { return this.#picture !== null; }
  /** Takes a picture, as wide as half of what is shown. */
  async take(file: Blob): Promise<void> {
    const picture = await createImageBitmap(file), { stage } = this.#canvas.report!, { width, height } = stage.size;
    const wide = width * 0.7 / stage.shown[2]!, [x, y] = stage.from([width / 2, height / 2]);
    this.#picture?.close();
    [this.#picture, this.#pixel] = [picture, wide / picture.width];
    this.#at = [x - wide / 2, y - wide * picture.height / picture.width / 2];
    this.show();
  }
  remove(): void { this.#picture?.close(); this.#picture = null; this.show(); }
  show(): void {
    this.#canvas.background = this.#picture && (({ pen, to }) => {
      const picture = this.#picture!, [x, y] = to(this.#at), [right] = to([this.#at[0] + picture.width * this.#pixel, this.#at[1]]), wide = right - x, tall = wide * picture.height / picture.width;
      pen.save();
      pen.globalAlpha = 0.45;
      pen.drawImage(picture, x, y - tall, wide, tall);
      pen.restore();
    });
  }
  /** Makes the distance of two places so long; the first stays. */
  #scale([ax, ay]: Place, [bx, by]: Place, length: number): void {
    const by1 = length / Math.hypot(bx - ax, by - ay);
    if (!Number.isFinite(by1) || by1 <= 0) return;
    this.#pixel *= by1;
    this.#at = [ax + (this.#at[0] - ax) * by1, ay + (this.#at[1] - ay) * by1];
    this.show();
  }
  /** The tool with which a known distance is drawn; `ask` has it typed. */
  tool(ask: (take: (length: number) => void) => void, done: () => void): Tool {
    let ends: [Place, Place] | null = null;
    const canvas = this.#canvas;
    return {
      cursor: "crosshair",
      over: ({ pen, to, colours }) => {
        if (!ends) return;
        pen.save(); pen.strokeStyle = colours.force; pen.lineWidth = 2;
        pen.beginPath(); pen.moveTo(...to(ends[0])); pen.lineTo(...to(ends[1])); pen.stroke(); pen.restore();
      },
      down: (at) => {
        const from = canvas.report!.stage.from(at);
        return {
          move: (to) => { ends = [from, canvas.report!.stage.from(to)]; canvas.draw(); },
          cancel: () => { ends = null; canvas.draw(); },
          end: (to) => {
            const chosen: [Place, Place] = [from, canvas.report!.stage.from(to)];
            ends = chosen;
            ask((length) => { this.#scale(...chosen, length); ends = null; done(); });
          },
        };
      },
    };
  }
}

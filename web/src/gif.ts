// The motion as a moving picture (GIF), for slides: the drawing as it is shown, one turn of it.
import { applyPalette, GIFEncoder, quantize } from "gifenc";
import type { Report } from "./linkdyn";

/** Frames of a picture, the time between two of them [ms], the widest picture [pixels], its colours. */
const FRAMES = 100, LAST = 40, WIDEST = 720, COLOURS = 64;

export const gif = async (report: Report): Promise<Blob> => {
  const { stage, player } = report, { canvas } = stage, before = player.row;
  const shrink = Math.min(1, WIDEST / canvas.width), copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height].map((own) => Math.max(1, Math.round(own * shrink))) as [number, number];
  const pen = copy.getContext("2d", { willReadFrequently: true })!, ground = getComputedStyle(canvas.closest("#motion")!).backgroundColor;
  const rows = Math.min(FRAMES, report.rows), taken = (k: number): Uint8ClampedArray => {
    player.seek(rows > 1 ? Math.round(k * (report.rows - 1) / rows) : 0);
    stage.paint();
    pen.fillStyle = ground;
    pen.fillRect(0, 0, copy.width, copy.height);
    pen.drawImage(canvas, 0, 0, copy.width, copy.height);
    return pen.getImageData(0, 0, copy.width, copy.height).data;
  };
  player.pause();
  try {
    // One palette for all frames, of three of them: colours don't flicker.
    const some = [0, Math.floor(rows / 3), Math.floor(2 * rows / 3)].map((k) => taken(k).slice()), all = new Uint8ClampedArray(some.reduce((sum, own) => sum + own.length, 0));
    some.reduce((at, own) => { all.set(own, at); return at + own.length; }, 0);
    const palette = quantize(all, COLOURS), made = GIFEncoder();
    for (let k = 0; k < rows; k++) {
      made.writeFrame(applyPalette(taken(k), palette), copy.width, copy.height, { palette: k ? undefined : palette, delay: LAST });
      // The page stays alive.
      if (k % 8 === 7) await new Promise((done) => setTimeout(done, 0));
    }
    made.finish();
    return new Blob([made.bytes() as BlobPart], { type: "image/gif" });
  } finally { player.seek(before); }
};

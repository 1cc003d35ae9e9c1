// Where tolerances and clearances can carry the traced points: a band along the path, as many times as large as one can see.
import type { End, Layer, Place, Report } from "./linkdyn";
import { words } from "./words";

/** Deviations of a point at some instants: corners of its zone [m]; none where it has none. */
export type Zone = { point: string; times: number[]; corners: Place[][] };

/** How far the largest zone goes on the page [pixels]. */
const FAR = 26;

const cross = ([ox, oy]: Place, [ax, ay]: Place, [bx, by]: Place): number => (ax - ox) * (by - oy) - (ay - oy) * (bx - ox);
// The convex hull, counterclockwise (Andrew's monotone chain).
const hull = (points: Place[]): Place[] => {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]), half = (list: Place[]): Place[] => {
    const made: Place[] = [];
    for (const own of list) { while (made.length > 1 && cross(made[made.length - 2]!, made[made.length - 1]!, own) <= 0) made.pop(); made.push(own); }
    return made.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
};
/** The largest of 1, 2, 5, 10, … that is no more. */
const round = (most: number): number => { const power = 10 ** Math.floor(Math.log10(most)); return Math.max(1, [5, 2, 1].map((own) => own * power).find((own) => own <= most * (1 + 1e-9)) ?? 1); };

/** What is drawn of zones, for the run that a report shows. */
export const zoned = (zones: Zone[], report: Report): Layer | null => {
  const { bodies } = report.mechanism, largest = Math.max(0, ...zones.flatMap(({ corners }) => corners.flat().map(([x, y]) => Math.hypot(x, y))));
  if (!(largest > 0)) return null;
  const end = (name: string): End => { const [body, point] = name.split("."), k = bodies.findIndex((own) => own.name === body); return [k, bodies[k]?.points.findIndex(([own]) => own === point) ?? -1]; };
  const bands = zones.map(({ point, times, corners }) => { const at = end(point); return { rows: times.map((time) => report.player.rowAt(time)), at, corners }; }).filter(({ at }) => at[1] >= 0);
  return ({ pen, to, scale, row, colours, height }) => {
    const factor = round(FAR / (largest * scale));
    const placed = (corners: Place[], at: Place | null): Place[] => at ? corners.map(([x, y]) => to([at[0] + factor * x, at[1] + factor * y])) : [];
    const path = (corners: Place[]): void => { corners.forEach((own, k) => k ? pen.lineTo(...own) : pen.moveTo(...own)); if (corners.length) pen.closePath(); };
    pen.save();
    pen.fillStyle = pen.strokeStyle = colours.accent;
    for (const { rows, at, corners } of bands) {
      const all = corners.map((own, k) => placed(own, report.shapes.place(at, rows[k]!)));
      // Of one path overlaps count once.
      pen.beginPath();
      all.slice(1).forEach((own, k) => path(hull([...all[k]!, ...own])));
      pen.globalAlpha = 0.22;
      pen.fill();
      // The one at the instant that is shown.
      let near = 0;
      rows.forEach((own, k) => { if (Math.abs(own - row) < Math.abs(rows[near]! - row)) near = k; });
      pen.beginPath();
      path(placed(corners[near] ?? [], report.shapes.place(at, row)));
      pen.globalAlpha = 0.9;
      pen.lineWidth = 1.4;
      pen.stroke();
    }
    pen.globalAlpha = 1;
    pen.font = "12px system-ui, sans-serif";
    pen.textBaseline = "bottom";
    pen.fillStyle = colours.muted;
    pen.fillText(words.zones(factor), 14, height - 36);
    pen.restore();
  };
};

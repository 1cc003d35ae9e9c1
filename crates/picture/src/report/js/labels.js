"use strict";
// Labels next to what they name: none covers another one, a pin or a button, and while the mechanism moves they keep their side.
(() => {
  const TALL = 14, GAP = 3;
  // Directions of places around a thing: left and right first, then above and below, nearer ones first.
  const AROUND = [[1, -1], [-1, -1], [1, 1], [-1, 1], [1, 0], [-1, 0], [0, -1], [0, 1]];
  const FAR = [1, 1.9, 3];
  const held = new Map();

  const meets = (a, b, gap) => a.x < b.x + b.wide + gap && b.x < a.x + a.wide + gap && a.y < b.y + b.tall + gap / 2 && b.y < a.y + a.tall + gap / 2;

  // Boxes in which a label can stand. The label of a body may lie on it.
  const places = ({ at, beside, strong }, wide) => {
    const list = strong ? [{ x: at[0] - wide / 2, y: at[1] - TALL / 2 - 14 }, { x: at[0] - wide / 2, y: at[1] - TALL / 2 + 14 }, { x: at[0] - wide / 2, y: at[1] - TALL / 2 }] : [];
    const gap = (beside || 6) + 4;
    for (const far of FAR) for (const [dx, dy] of AROUND) {
      const x = dx > 0 ? at[0] + gap * far : dx < 0 ? at[0] - gap * far - wide : at[0] - wide / 2;
      list.push({ x, y: at[1] - TALL / 2 + dy * gap * far * (dx === 0 ? 1.25 : 1), far });
    }
    return list.map((place) => ({ ...place, wide, tall: TALL }));
  };

  // Draws what finds a place and returns the boxes; `taken` are boxes that are in use already.
  const draw = (pen, list, { width, height, taken, background }) => {
    const boxes = [...taken], drawn = [];
    const pins = list.filter(({ at, strong }) => at && !strong).map(({ at }) => ({ x: at[0] - 6, y: at[1] - 6, wide: 12, tall: 12, of: at }));
    pen.font = "12px system-ui, sans-serif";
    pen.textBaseline = "middle";
    for (const label of list) {
      const { text, at, colour, key } = label;
      if (!at || at[0] < 0 || at[0] > width || at[1] < 0 || at[1] > height) continue;
      const shown = linkdyn.plain(text).slice(0, 40), wide = pen.measureText(shown).width;
      const free = (box) => box.x > 2 && box.x + wide < width - 2 && box.y > 2 && box.y + TALL < height - 2
        && !boxes.some((other) => meets(box, other, GAP)) && !pins.some((pin) => pin.of !== at && meets(box, pin, 0));
      const found = places(label, wide), last = found[held.get(key)];
      const number = last && free(last) ? held.get(key) : found.findIndex(free);
      if (number < 0) { held.delete(key); continue; }
      held.set(key, number);
      const box = { ...found[number], text: shown };
      boxes.push(box); drawn.push(box);
      if (box.far > 1.5) {
        pen.strokeStyle = colour; pen.lineWidth = 0.8;
        pen.beginPath(); pen.moveTo(...at); pen.lineTo(Math.min(Math.max(at[0], box.x), box.x + wide), box.y + TALL / 2); pen.stroke();
      }
      pen.lineWidth = 3.5; pen.strokeStyle = background; pen.strokeText(shown, box.x, box.y + TALL / 2);
      pen.fillStyle = colour; pen.fillText(shown, box.x, box.y + TALL / 2);
    }
    return drawn;
  };

  linkdyn.labels = { draw };
})();

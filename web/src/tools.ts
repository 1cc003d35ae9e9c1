// The tools of the toolbar: each turns a gesture into a change of the text.
import type { Canvas, Gesture, Tool } from "./canvas";
import type { Layer, Place } from "./linkdyn";
import { Sketch, type Target } from "./sketch";
import { words } from "./words";

export type Desk = {
  canvas: Canvas;
  /** Asks for a length and an angle while a line is drawn; what is typed ends it. */
  typed(take: (length: number, angle: number | null) => void): void;
  untyped(): void;
  /** The model as a sketch, at the start of its motion. */
  sketch(): Sketch;
  write(text: string): void;
  say(text: string): void;
  /** Hands that change what is there. */
  pose(at: Place): Gesture | null;
  shape(at: Place): Gesture | null;
  removeAt(at: Place): void;
};

const line = (state: Parameters<Layer>[0], from: Place, end: Place, text = ""): void => {
  const { pen, to, colours } = state, [a, b] = [to(from), to(end)];
  pen.save();
  pen.strokeStyle = pen.fillStyle = colours.accent; pen.lineWidth = 2; pen.setLineDash([6, 4]);
  pen.beginPath(); pen.moveTo(...a); pen.lineTo(...b); pen.stroke();
  pen.setLineDash([]);
  for (const place of [a, b]) { pen.beginPath(); pen.arc(...place, 4, 0, 7); pen.fill(); }
  if (text) {
    pen.font = "600 12px system-ui, sans-serif"; pen.textBaseline = "bottom";
    const [x, y] = [(a[0] + b[0]) / 2 + 8, (a[1] + b[1]) / 2 - 6];
    pen.lineWidth = 4; pen.strokeStyle = colours.card; pen.strokeText(text, x, y); pen.fillText(text, x, y);
  }
  pen.restore();
};

export const tools = (desk: Desk): Record<string, Tool> => {
  const { canvas } = desk;
  let drawn: Layer | undefined;
  const over: Layer = (state) => {
    drawn?.(state);
    // What the next click would meet.
    if (!drawn && canvas.pointer && canvas.tool?.cursor === "crosshair") {
      const { at } = canvas.snap(canvas.pointer), [x, y] = state.to(at);
      state.pen.save(); state.pen.strokeStyle = state.colours.accent; state.pen.lineWidth = 1.6;
      state.pen.beginPath(); state.pen.arc(x, y, 6, 0, 7); state.pen.stroke(); state.pen.restore();
    }
  };
  const done = () => { drawn = undefined; canvas.draw(); };
  const words2 = (a: Place, b: Place) => { const { units } = canvas.report!, turned = Math.atan2(b[1] - a[1], b[0] - a[0]); return `${units.quantity(Math.hypot(b[0] - a[0], b[1] - a[1]), "m", 4)}  ${units.quantity(turned, "rad", 4)}`; };
  const hover = () => canvas.draw();

  // From one place to another: by a drag, or by two clicks.
  const stroke = (act: (from: Target, to: Target, event: PointerEvent) => void, text = words2): Tool => {
    let first: Target | null = null;
    const show = (from: Target, to: Target) => { drawn = (state) => line(state, from.at, to.at, text(from.at, to.at)); canvas.draw(); };
    const ended = (from: Target, to: Target, event: PointerEvent) => { first = null; desk.untyped(); done(); act(from, to, event); };
    // Begun by a click, its length and angle may be typed instead of the second one; without an angle it goes towards the pointer.
    const begun = (from: Target, event: PointerEvent) => {
      first = from;
      show(from, from);
      desk.typed((length, angle) => {
        const [x, y] = canvas.pointer ? canvas.report!.stage.from(canvas.pointer) : [from.at[0] + 1, from.at[1]], turned = angle ?? Math.atan2(y - from.at[1], x - from.at[0]);
        ended(from, { at: [from.at[0] + length * Math.cos(turned), from.at[1] + length * Math.sin(turned)], end: null }, event);
      });
    };
    const leave = (): boolean => { const was = first !== null; first = null; if (was) { desk.untyped(); done(); } return was; };
    return {
      cursor: "crosshair", over, leave,
      hover: (at, event) => { if (first) show(first, canvas.snap(at, first.at, event.altKey)); else canvas.draw(); },
      down: (at, event) => {
        if (first) {
          const from = first;
          return { move: (to) => show(from, canvas.snap(to, from.at)), end: (to, last) => ended(from, canvas.snap(to, from.at, last.altKey), last), cancel: leave };
        }
        const from = canvas.snap(at, null, event.altKey);
        let moved = false;
        return {
          move: (to) => { moved = true; show(from, canvas.snap(to, from.at)); },
          end: (to, last) => { if (moved) ended(from, canvas.snap(to, from.at, last.altKey), last); else begun(from, last); },
          cancel: () => { first = from; leave(); },
        };
      },
    };
  };
  const press = (act: (at: Place, event: PointerEvent) => void, cursor = "crosshair"): Tool => ({ cursor, over, hover, down: () => ({ move() {}, cancel() {}, end: (at, event) => act(at, event) }) });
  const write = (change: (sketch: Sketch) => void): void => { const sketch = desk.sketch(); change(sketch); desk.write(sketch.text); };
  const apart = (a: Target, b: Target) => Math.hypot(a.at[0] - b.at[0], a.at[1] - b.at[1]) > canvas.grain / 2;

  // A bar; with Shift the body goes on with another point.
  let corners: Target[] = [];
  const bar = stroke((from, to, event) => {
    if (!corners.length) corners = [from];
    if (apart(corners[corners.length - 1]!, to)) corners.push(to);
    if (event.shiftKey) { drawn = (state) => corners.slice(1).forEach((own, k) => line(state, corners[k]!.at, own.at)); canvas.draw(); return; }
    const all = corners;
    corners = [];
    if (all.length > 1) write((sketch) => sketch.bar(all, all.length > 2 ? "plate" : "bar"));
  });

  return {
    pose: { cursor: "pick", over, down: (at) => desk.pose(at) },
    shape: { cursor: "pick", over, down: (at) => desk.shape(at) },
    bar: { ...bar, leave: () => { const was = corners.length > 0; corners = []; return bar.leave!() || (was && (done(), true)); }, down: (at, event) => (corners.length ? { move() {}, cancel: () => { corners = []; done(); }, end: (to, last) => {
      const next = canvas.snap(to, corners[corners.length - 1]!.at, last.altKey);
      if (apart(corners[corners.length - 1]!, next)) corners.push(next);
      if (last.shiftKey) { canvas.draw(); return; }
      const all = corners;
      corners = []; done();
      write((sketch) => sketch.bar(all, all.length > 2 ? "plate" : "bar"));
    } } : bar.down(at, event)) },
    point: press((at) => { const body = canvas.body(at); if (!body) desk.say(words.needsBody); else write((sketch) => sketch.pointOn(body, canvas.snap(at).at)); }),
    ground: press((at, event) => write((sketch) => sketch.ground(canvas.snap(at, null, event.altKey)))),
    pin: press((at) => {
      const target = canvas.snap(at), first = target.end ? target.end[0] : canvas.body(at);
      const others = canvas.mechanism.bodies.map((_, k) => k).filter((k) => k > 0 && k !== first && inside(canvas, k, at));
      if (!first || !others.length) { desk.say(words.needsTwo); return; }
      write((sketch) => sketch.pin(sketch.ensure(target, first), sketch.pointOn(others[0]!, target.at)));
    }),
    slide: stroke((from, to) => { if (!from.end) desk.say(words.needsPoint); else write((sketch) => sketch.slide(from, [to.at[0] - from.at[0], to.at[1] - from.at[1]])); }),
    slot: stroke((from, to) => {
      if (!from.end) { desk.say(words.needsPoint); return; }
      const under = canvas.mechanism.bodies.map((_, k) => k).find((k) => k > 0 && k !== from.end![0] && inside(canvas, k, canvas.report!.stage.to(from.at))) ?? 0;
      write((sketch) => sketch.slot(from, under, [to.at[0] - from.at[0], to.at[1] - from.at[1]]));
    }),
    gear: stroke((from, to) => {
      const wheels = [from, to].map(({ end }) => end && canvas.together(end).find(([body]) => body > 0)) as (Target["end"] | undefined)[];
      if (!wheels[0] || !wheels[1] || wheels[0][0] === wheels[1][0]) { desk.say(words.needsTwo); return; }
      write((sketch) => sketch.gear(wheels[0]!, wheels[1]!));
    }),
    spring: stroke((from, to) => between(desk, from, to, false)),
    damper: stroke((from, to) => between(desk, from, to, true)),
    motor: press((at) => {
      const body = canvas.body(at);
      if (!body) { desk.say(words.needsBody); return; }
      const slide = canvas.mechanism.joints.find(({ type, between: ends }) => type === "prismatic" && ends[1][0] === body && ends[0][0] === 0);
      write((sketch) => sketch.motor(sketch.body(body), slide ? slide.name : null));
    }),
    force: stroke((from, to) => {
      const end = from.end && canvas.together(from.end).find(([body]) => body > 0);
      if (!end || !apart(from, to)) { desk.say(words.needsPoint); return; }
      const scale = newtons(canvas), round = (value: number) => Number((value * scale).toPrecision(2));
      write((sketch) => sketch.force(sketch.name(end), [round(to.at[0] - from.at[0]), round(to.at[1] - from.at[1])]));
    }, (a, b) => `${Number((Math.hypot(b[0] - a[0], b[1] - a[1]) * newtons(canvas)).toPrecision(2))} N`),
    torque: press((at) => { const body = canvas.body(at); if (!body) desk.say(words.needsBody); else write((sketch) => sketch.torque(sketch.body(body))); }),
    trace: press((at) => {
      const { end } = canvas.snap(at), body = canvas.body(at);
      if (end && end[0] > 0) write((sketch) => sketch.trace(sketch.name(end)));
      else if (body) write((sketch) => sketch.trace(sketch.pointOn(body, canvas.snap(at).at)));
      else desk.say(words.needsBody);
    }),
    remove: press((at) => desk.removeAt(at), "pick"),
  };
};

// A drag of a quarter of the drawing is 100 N.
const newtons = (canvas: Canvas): number => { const { stage } = canvas.report!; return 100 / (Math.min(stage.size.width, stage.size.height) / 4 / stage.shown[2]!); };

const between = (desk: Desk, from: Target, to: Target, damper: boolean): void => {
  const own = ({ end }: Target) => end ? desk.canvas.together(end).find(([body]) => body > 0) ?? end : null, [a, b] = [own(from), own(to)];
  if ((a?.[0] ?? 0) === (b?.[0] ?? 0)) { desk.say(words.needsTwo); return; }
  const sketch = desk.sketch(), point = (end: Target["end"], target: Target) => end ? sketch.name(end) : sketch.pointOn(0, target.at);
  const [first, second] = [point(a, from), point(b, to)];
  sketch.spring(first, second, Math.hypot(to.at[0] - from.at[0], to.at[1] - from.at[1]), damper);
  desk.write(sketch.text);
};

/** Whether a place of the canvas is on a body: near the lines between its points. */
const inside = (canvas: Canvas, body: number, at: Place): boolean => {
  const places = canvas.mechanism.bodies[body]!.points.map((_, k) => canvas.pixel([body, k])).filter((place) => place !== null);
  return places.some((a, k) => places.slice(k).some((b) => {
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]], long = dx * dx + dy * dy;
    const s = long > 0 ? Math.min(Math.max(((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / long, 0), 1) : 0;
    return Math.hypot(at[0] - a[0] - s * dx, at[1] - a[1] - s * dy) < 9;
  }));
};

// The two hands: one moves the mechanism through its freedom, the other changes its dimensions.
import type { App } from "./app";
import type { Gesture } from "./canvas";
import { LIVE_SECONDS, SECONDS } from "./engine";
import type { End, Faulty, Moved, Place, Pulled, Report } from "./linkdyn";
import { words } from "./words";

export type Hands = { pose(at: Place): Gesture | null; shape(at: Place): Gesture | null; unpose(): void };

const turn = (angle: number): number => Math.abs(angle - 2 * Math.PI * Math.round(angle / 2 / Math.PI));
const moving = (report: Report): { name: string }[] => report.mechanism.bodies.slice(1);
/** Poses of all moving bodies at a row, one after the other; nothing where one is not known. */
const posesAt = (report: Report, row: number): number[] | null => {
  const all = moving(report).map((_, k) => report.shapes.pose(k + 1, row));
  return all.every((pose) => pose !== null) ? (all as number[][]).flat() : null;
};

export const hands = ({ engine, frame, canvas, doc, say, failed, read, took, show, write, sketch }: App): Hands => {
  // Where a hand has put the mechanism, until the text or the time changes.
  const unpose = (): void => { if (frame.report?.shapes.posed) { frame.report.shapes.posed = null; canvas.draw(); say(""); } };
  const put = (report: Report, list: number[]): void => {
    report.shapes.posed = moving(report).map((_, k) => list.slice(3 * k, 3 * k + 3));
    report.stage.draw();
  };
  // Poses become the guesses from which the mechanism is assembled.
  const guess = (report: Report, list: number[]): void => write(sketch().posed(moving(report).map(({ name }, k) => [name, list.slice(3 * k, 3 * k + 3)] as const)));
  const startHere = (): void => { const { report } = frame, list = report && posesAt(report, report.player.row); if (report && list) guess(report, list); };

  const selecting = (at: Place): Gesture => ({ move() {}, cancel() {}, end: () => canvas.select(canvas.thing(at)) });
  // The place of a pin that is held, or where the body is held.
  const grabbed = (at: Place): Place => { const end = canvas.point(at); return (end && canvas.place(end)) ?? canvas.report!.stage.from(at); };

  // Along the motion that drivers give.
  const led = (report: Report, at: Place, click: Gesture): Gesture => {
    const lead = report.lead(at);
    let moved = false;
    return { move: (to) => { moved = true; lead?.(to); }, cancel() {}, end: (to, event) => { if (!moved) click.end(to, event); } };
  };
  // Freely: the point is pulled, drivers let go.
  const pulled = (report: Report, at: Place, click: Gesture): Gesture => {
    const body = canvas.body(at), own = body ? report.shapes.pose(body, report.player.row) : null, list = posesAt(report, report.player.row);
    if (!own || !list) return click;
    const [x, y] = grabbed(at), [dx, dy] = [x - own[0]!, y - own[1]!], [c, s] = [Math.cos(own[2]!), Math.sin(own[2]!)];
    const local = [c * dx + s * dy, c * dy - s * dx], before = report.shapes.posed, text = doc.text;
    let moved = false;
    engine.ask<Faulty>("hold", [text, list]).then(({ faults }) => { if (faults) say(faults[0]!.text, { bad: true }); }).catch(failed);
    return {
      move: async (to) => {
        moved = true;
        try {
          const answer = await engine.live<Pulled>("pull", [text, body, local, report.stage.from(to)]);
          if (!answer || answer.faults || report !== frame.report) return;
          put(report, answer.poses);
          const why = answer.singular ?? answer.stopped;
          say(why ?? words.posed, { stays: true, bad: Boolean(why), act: [[words.startHere, startHere], [words.back, unpose]] });
        } catch (why) { failed(why); }
      },
      cancel: () => { report.shapes.posed = before; report.stage.draw(); },
      end: (to, event) => { if (!moved) click.end(to, event); },
    };
  };
  const pose = (at: Place): Gesture | null => {
    const report = frame.report!;
    if (!canvas.thing(at)) { if (canvas.selected) canvas.select(null); return null; }
    report.player.pause();
    const isLed = report.mechanism.drivers.length > 0 && report.rows > 1 && !report.shapes.posed;
    return (isLed ? led : pulled)(report, at, selecting(at));
  };

  // The point goes with the hand in all bodies of its pin, and the motion is computed again.
  const shape = (at: Place): Gesture | null => {
    const report = frame.report!, end = canvas.point(at);
    if (!end) return pose(at);
    const click = selecting(at), { row } = report.player, list = posesAt(report, row), before = doc.text;
    if (!list || !read()?.ok || report.shapes.posed) return click;
    const name = ([body, point]: End) => [report.mechanism.bodies[body]!.name, report.mechanism.bodies[body]!.points[point]![0]];
    const ends = canvas.together(end).map(name), time = report.time[row] ?? 0, begin = posesAt(report, 0) ?? list;
    report.player.pause();
    frame.stay();
    let moved = false, isFlipped = false, asked: Promise<unknown> = Promise.resolve();
    const go = (place: Place, { altKey }: PointerEvent, isLast: boolean): Promise<void> => {
      const { grain } = canvas, target = report.stage.from(place).map((own) => altKey ? own : Math.round(own / grain) * grain), seconds = isLast ? SECONDS : LIVE_SECONDS;
      const question = [before, list, begin, time, ends, target, grain, seconds, isLast];
      return (isLast ? engine.ask<Moved>("move", question, seconds + 4) : engine.live<Moved>("move", question, seconds + 4)).then(async (answer) => {
        if (!answer || doc.held === null) return;
        if (answer.faults) { say(answer.faults[0]!.text, { bad: true }); return; }
        doc.live(answer.text);
        await took(answer, true);
        // Where the text alone leads to another branch, that is said, until it does not.
        const was = isFlipped;
        isFlipped = answer.picture !== null && flipped(time, answer);
        if (was && !isFlipped) say("");
      }).catch(failed);
    };
    return {
      move: (place, event) => {
        if (!moved) { moved = true; doc.hold(); }
        asked = go(place, event, false);
      },
      cancel: () => { if (doc.held !== null) { doc.live(doc.held); doc.release(); } void show(); },
      end: async (place, event) => {
        if (!moved) { click.end(place, event); return; }
        await asked;
        await go(place, event, true);
        doc.release();
        if (doc.text === before) void show();
      },
    };
  };

  // Whether the bodies at a time are on another branch than the one that continues what stood there; that is said, and can be mended.
  const flipped = (time: number, { near, begin }: Moved): boolean => {
    const report = frame.report!, row = report.time.indexOf(time), { mobility } = report.summary;
    // Where freedom is left, the start is wherever the text has it.
    if (!near || row < 0 || !mobility || mobility.rank !== mobility.drivers) return false;
    const size = Math.max(...near.map((own, k) => k % 3 === 2 ? 0 : Math.abs(own)), 1e-9);
    const off = moving(report).map((_, k) => {
      const pose = report.shapes.pose(k + 1, row);
      return pose ? Math.max(Math.hypot(pose[0]! - near[3 * k]!, pose[1]! - near[3 * k + 1]!) / size, turn(pose[2]! - near[3 * k + 2]!)) : 0;
    });
    if (Math.max(...off) < 1e-4) return false;
    say(words.flipped, { bad: true, stays: true, act: begin ? [[words.keepBranch, () => guess(report, begin)]] : [] });
    return true;
  };

  return { pose, shape, unpose };
};

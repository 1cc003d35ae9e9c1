// The editor: the text is the model; the drawing shows it and changes it.
import { Ask, type Curve } from "./ask";
import { Canvas, type Gesture, type Thing } from "./canvas";
import { Document } from "./document";
import { read } from "./edit";
import { drawn, element, id } from "./element";
import { Engine, Interrupted } from "./engine";
import { Frame } from "./frame";
import { icons } from "./icons";
import type { Bundled, End, Faulty, Moved, Place, Pulled, Read, Report, Shown } from "./linkdyn";
import { Findings, Parameters, Selected, type Shop } from "./panels";
import { bytesOf, Files, give, gunzipped, packed, remember, remembered, Served, unpacked } from "./share";
import { Sketch } from "./sketch";
import { tools as makeTools, type Desk } from "./tools";
import { Underlay } from "./underlay";
import { words } from "./words";
import frameStyle from "./frame.css";

const SECONDS = 8, LIVE_SECONDS = 2, REST = 140;
const NEW = `{
  "format": "linkdyn/1",
  "name": "Sketch",
  "units": { "length": "mm", "angle": "deg" },
  "bodies": {
    "ground": { "points": {} }
  },
  "joints": {}
}
`;

const start = async (): Promise<void> => {
  const given = (name: string) => id(name).textContent!.trim();
  const module = await WebAssembly.compile(await gunzipped(bytesOf(given("engine"))) as BufferSource);
  const engine = new Engine(JSON.parse(given("worker")) as string, module);
  const parts = await engine.ask<[string, string, string]>("frame");

  const served = Served.found;
  const frame = new Frame(id("view"), parts, frameStyle), canvas = new Canvas(), files = new Files();
  const doc = new Document(id("text"), NEW);
  let last: Read | null = null, generation = 0;

  // Words about what goes on.
  let saying = 0;
  const say = (text: string, { bad = false, stays = false, act = [] as [string, () => void][] } = {}): void => {
    clearTimeout(saying);
    const box = id("says");
    box.className = bad ? "bad" : "";
    box.replaceChildren(element("span", { text, className: "text" }), ...act.map(([name, click]) => element("button", { type: "button", text: name, on: { click: () => { box.hidden = true; click(); } } })));
    box.hidden = !text;
    if (text && !stays) saying = window.setTimeout(() => { box.hidden = true; }, 6000);
  };
  const failed = (why: unknown): void => { if (!(why instanceof Interrupted)) say((why as Error).message, { bad: true }); };
  engine.onBusy = (busy) => { id("busy").textContent = busy ? words.computing : ""; };

  // What the engine made of a text.
  let shownText = "";
  const took = async ({ text, read: told, picture }: Shown, trying: boolean): Promise<void> => {
    last = told;
    shownText = text;
    frame.window?.document.body.classList.toggle("old", !told.ok);
    if (picture) await frame.show(picture, trying);
    if (trying) return;
    tell();
  };
  const tell = (): void => {
    if (!last) return;
    doc.mark(last.faults);
    const counts = findings.show(last, last.ok ? frame.report?.summary ?? null : null);
    count("findings", counts.faults || counts.warnings, counts.faults > 0);
    parameters.show(last.parameters);
    selected.show();
    ask.show();
    id<HTMLInputElement>("title").value = last.name;
    document.title = `${last.name} – ${words.title}`;
    id("hint").hidden = !last.ok || (frame.report?.mechanism.bodies.length ?? 0) > 1;
    buttons();
  };
  id("hint").textContent = words.empty;
  const show = async (): Promise<void> => {
    const own = ++generation, text = doc.text;
    if (!served) remember(text);
    try {
      const shown = await engine.live<Shown>("show", [text, SECONDS], SECONDS + 4);
      if (shown && own === generation) await took(shown, false);
    } catch (why) { failed(why); }
  };
  let resting = 0;
  doc.onChange = (why) => {
    clearTimeout(resting);
    generation++;
    unpose();
    buttons();
    resting = window.setTimeout(() => { resting = 0; void show(); }, why === "typed" ? REST : 0);
  };
  const write = (text: string): void => doc.write(text);

  // Where a hand has put the mechanism, until the text or the time changes.
  const unpose = (): void => { if (frame.report?.shapes.posed) { frame.report.shapes.posed = null; canvas.draw(); say(""); } };
  const poses = (report: Report): number[] | null => {
    const all = report.mechanism.bodies.slice(1).map((_, k) => report.shapes.pose(k + 1, report.player.row));
    return all.every((pose) => pose !== null) ? (all as number[][]).flat() : null;
  };
  const posed = (report: Report, list: number[]): void => {
    report.shapes.posed = report.mechanism.bodies.slice(1).map((_, k) => list.slice(3 * k, 3 * k + 3));
    report.stage.draw();
  };
  // The poses that are shown become the guesses from which the mechanism is assembled.
  const startHere = (): void => {
    const report = frame.report;
    if (report) write(sketch().posed(report.mechanism.bodies.slice(1).map(({ name }, k) => [name, report.shapes.pose(k + 1, report.player.row)!] as const)));
  };

  const held = async (list: number[]): Promise<void> => { const { faults } = await engine.ask<Faulty>("hold", [doc.text, list]); if (faults) say(faults[0]!.text, { bad: true }); };
  const selecting = (at: Place): Gesture => ({ move() {}, cancel() {}, end: () => canvas.select(canvas.thing(at)) });
  // Moves the mechanism: along its motion where drivers give one, else freely through its freedom.
  const pose = (at: Place): Gesture | null => {
    const report = frame.report!, thing = canvas.thing(at);
    if (!thing) { if (canvas.selected) canvas.select(null); return null; }
    const click = selecting(at);
    report.player.pause();
    if (report.mechanism.drivers.length && report.rows > 1 && !report.shapes.posed) {
      const lead = report.lead(at);
      let moved = false;
      return { move: (to) => { moved = true; lead?.(to); }, cancel() {}, end: (to, event) => { if (!moved) click.end(to, event); } };
    }
    const body = canvas.body(at), own = body ? report.shapes.pose(body, report.player.row) : null, list = poses(report);
    if (!own || !list) return click;
    const [dx, dy] = ((place: Place) => [place[0] - own[0]!, place[1] - own[1]!])(grabbed(at)), [c, s] = [Math.cos(own[2]!), Math.sin(own[2]!)];
    const local = [c * dx! + s * dy!, c * dy! - s * dx!];
    let moved = false, before = report.shapes.posed;
    held(list).catch(failed);
    return {
      move: async (to) => {
        moved = true;
        try {
          const pulled = await engine.live<Pulled>("pull", [doc.text, body, local, report.stage.from(to)]);
          if (!pulled || pulled.faults || report !== frame.report) return;
          posed(report, pulled.poses);
          const why = pulled.singular ?? pulled.stopped;
          say(why ?? words.posed, { stays: true, bad: Boolean(why), act: [[words.startHere, startHere], [words.back, unpose]] });
        } catch (why) { failed(why); }
      },
      cancel: () => { report.shapes.posed = before; report.stage.draw(); },
      end: (to, event) => { if (!moved) click.end(to, event); },
    };
  };
  // The place of a pin that is held, or where the body is held.
  const grabbed = (at: Place): Place => { const end = canvas.point(at); return (end && canvas.place(end)) ?? canvas.report!.stage.from(at); };

  // Changes dimensions: the point goes with the hand in all bodies of its pin, and the motion is computed again.
  const shape = (at: Place): Gesture | null => {
    const report = frame.report!, end = canvas.point(at);
    if (!end) return pose(at);
    const click = selecting(at), list = poses(report), before = doc.text, name = (own: End) => [report.mechanism.bodies[own[0]]!.name, report.mechanism.bodies[own[0]]!.points[own[1]]![0]];
    if (!list || !last?.ok || report.shapes.posed) return click;
    const ends = canvas.together(end).map(name);
    report.player.pause();
    report.stage.view = report.stage.shown;
    const time = report.time[report.player.row] ?? 0, begin = report.mechanism.bodies.slice(1).flatMap((_, k) => report.shapes.pose(k + 1, 0) ?? [0, 0, 0]);
    let isFlipped = false;
    let asked: Promise<unknown> = Promise.resolve(), moved = false;
    const to = (place: Place, event: PointerEvent): Place => { const grain = canvas.grain, [x, y] = report.stage.from(place); return event.altKey ? [x, y] : [Math.round(x / grain) * grain, Math.round(y / grain) * grain]; };
    const go = (target: Place, isLast: boolean) => {
      const question = [before, list, begin, time, ends, target, canvas.grain, isLast ? SECONDS : LIVE_SECONDS, isLast];
      return (isLast ? engine.ask<Moved>("move", question) : engine.live<Moved>("move", question)).then(async (answer) => {
        if (!answer || doc.held === null) return;
        if (answer.faults) { say(answer.faults[0]!.text, { bad: true }); return; }
        doc.live(answer.text);
        await took(answer, true);
        // Where the text alone leads to another branch, that is said.
        if (answer.picture) isFlipped = flipped(time, answer) || (isFlipped && (say(""), false));
      }).catch(failed);
    };
    return {
      move: (place, event) => {
        if (!moved) { moved = true; doc.hold(); }
        asked = go(to(place, event), false);
      },
      cancel: () => { if (doc.held !== null) { doc.live(doc.held); doc.release(); } void show(); },
      end: async (place, event) => {
        if (!moved) { click.end(place, event); return; }
        await asked;
        await go(to(place, event), true);
        doc.release();
        if (doc.text === before) void show();
      },
    };
  };

  // Whether the bodies at a row are on another branch than the one that continues what stood there; that is said, and can be mended.
  const flipped = (time: number, { near, begin }: Moved): boolean => {
    const report = frame.report!, row = report.time.indexOf(time), turn = (angle: number) => Math.abs(angle - 2 * Math.PI * Math.round(angle / 2 / Math.PI));
    const { mobility } = report.summary;
    // Where freedom is left, the start is wherever the text has it.
    if (!near || row < 0 || row >= report.rows || !mobility || mobility.rank !== mobility.drivers) return false;
    const size = Math.max(...near.map((own, k) => k % 3 === 2 ? 0 : Math.abs(own)), 1e-9);
    const off = report.mechanism.bodies.slice(1).map((_, k) => {
      const pose = report.shapes.pose(k + 1, row);
      return pose ? Math.max(Math.hypot(pose[0]! - near[3 * k]!, pose[1]! - near[3 * k + 1]!) / size, turn(pose[2]! - near[3 * k + 2]!)) : 0;
    });
    if (Math.max(...off) < 1e-4) return false;
    const keep = (): void => { if (begin) write(sketch().posed(report.mechanism.bodies.slice(1).map(({ name }, k) => [name, begin.slice(3 * k, 3 * k + 3)] as const))); };
    say(words.flipped, { bad: true, stays: true, act: begin ? [[words.keepBranch, keep]] : [] });
    return true;
  };

  // The tools draw at the start of the motion.
  const sketch = (): Sketch => {
    const report = frame.report!;
    return new Sketch(doc.text, report.mechanism, last ?? { length: 1, angle: 1 }, canvas.grain, (body) => report.shapes.pose(body, report.player.row));
  };
  const remove = (thing: Thing): void => {
    const own = sketch();
    if (thing.kind === "point") { const end = thing.end ?? canvas.mechanism.bodies.flatMap(({ name, points }, body) => points.map(([point], k) => [`${name}.${point}`, [body, k] as End] as const)).find(([name]) => name === thing.name)?.[1]; if (end) own.removePoint(end); }
    else own.remove(thing.kind, thing.name);
    canvas.select(null);
    write(own.text);
  };
  // Lengths and angles that are typed while a line is drawn.
  const typing = id("typing"), typingField = typing.querySelector("input")!;
  let taken: ((text: string) => void) | null = null;
  const askFor = (label: string, take: (text: string) => void): void => {
    typing.querySelector("span")!.textContent = label;
    typing.hidden = false;
    typingField.value = "";
    taken = take;
    typingField.focus();
  };
  const untyped = (): void => { if (!typing.hidden) { typing.hidden = true; taken = null; canvas.report?.stage.canvas.focus({ preventScroll: true }); } };
  typingField.addEventListener("keydown", ({ key }) => {
    if (key === "Escape") { untyped(); canvas.cancel(); choose("pose"); }
    if (key === "Enter" && taken && typingField.value.trim()) { const take = taken; untyped(); take(typingField.value); }
  });
  const lengthName = (): string => (read(doc.text)?.units as { length?: string } | undefined)?.length ?? "m";
  // Numbers with a decimal point or comma, apart by a comma and a blank, a semicolon or a blank.
  const numbers = (text: string): number[] => text.trim().split(/[;\s]+/).map((own) => Number(own.replace(/,$/, "").replace(",", ".")));
  const desk: Desk = {
    typed: (take) => askFor(words.typeLength(lengthName()), (text) => {
      const [length, angle] = numbers(text);
      if (length! > 0 && (angle === undefined || Number.isFinite(angle))) take(length! * (last?.length ?? 1), angle === undefined ? null : angle * Math.PI / 180);
    }),
    untyped,
    canvas, sketch, write, say, pose, shape,
    removeAt: (at) => { const thing = canvas.thing(at); if (thing) remove(thing); },
  };
  const tools = makeTools(desk);
  const choose = (name: string): void => {
    canvas.cancel();
    canvas.tool = tools[name]!;
    for (const button of id("tools").querySelectorAll<HTMLElement>(".tool")) button.setAttribute("aria-pressed", String(button.dataset.tool === name));
    const report = frame.report;
    if (report && !["pose", "shape"].includes(name)) { report.player.pause(); unpose(); if (report.player.row !== 0) report.player.seek(0); }
    canvas.draw();
  };

  // Parameters.
  let tuning = 0;
  const shop: Shop = {
    text: () => doc.text, write, remove,
    tune: (values) => {
      const own = ++tuning;
      doc.hold();
      frame.report && (frame.report.stage.view = frame.report.stage.shown);
      engine.live<Shown & { faults?: { text: string }[] }>("tune", [doc.text, values, LIVE_SECONDS]).then(async (answer) => {
        if (!answer || doc.held === null) return;
        if (answer.text === undefined) { say(answer.faults?.[0]?.text ?? "", { bad: true }); return; }
        doc.live(answer.text);
        await took(answer, own === tuning);
      }).catch(failed);
    },
    tuned: async () => {
      // What was asked last is shown first.
      await engine.ask("version").catch(failed);
      doc.release();
    },
    typed: (name, text) => engine.ask("typed", [name, text]),
    show: (from, to) => { choosePanel("text"); doc.show(from, to); },
    seek: (time) => { const report = frame.report; if (report) { report.player.pause(); let row = 0; while (row + 1 < report.rows && report.time[row + 1]! <= time) row++; report.player.seek(row); } },
  };
  const parameters = new Parameters(shop), selected = new Selected(shop), findings = new Findings(shop);
  const ask = new Ask({
    report: () => frame.report, knobs: () => last?.parameters ?? [],
    sample: (name, values, column, across) => engine.ask<Curve[]>("sample", [doc.text, name, values, column, across, LIVE_SECONDS], 60),
    set: async (values) => { shop.tune(values); await shop.tuned(); },
    words: (name) => engine.ask(name, [doc.text], 60),
  });
  canvas.onSelect = (thing) => { selected.show(thing); if (thing) choosePanel("selected"); };

  // Panels.
  const PANELS = ["text", "parameters", "selected", "findings", "ask"] as const;
  const tabs = PANELS.map((name) => element("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": name, text: words.panels[name], on: { click: () => choosePanel(name) } }));
  const choosePanel = (name: string): void => PANELS.forEach((own, k) => { id(own).hidden = own !== name; tabs[k]!.setAttribute("aria-selected", String(own === name)); tabs[k]!.tabIndex = own === name ? 0 : -1; });
  id("tabs").append(...tabs);
  id("tabs").addEventListener("keydown", (event) => {
    const k = tabs.findIndex((tab) => tab === document.activeElement), next = { ArrowRight: k + 1, ArrowLeft: k - 1 }[event.key];
    if (next !== undefined && tabs[next]) { tabs[next].click(); tabs[next].focus(); event.preventDefault(); }
  });
  const count = (name: (typeof PANELS)[number], number: number, bad: boolean): void => {
    const tab = tabs[PANELS.indexOf(name)]!;
    tab.querySelector(".count")?.remove();
    if (number) tab.append(element("span", { text: String(number), className: bad ? "count bad" : "count" }));
  };
  choosePanel("text");

  // Toolbar.
  const SETS: [string, string[]][] = [[words.groups.hands, ["pose", "shape"]], [words.groups.draw, ["bar", "point"]], [words.groups.joints, ["ground", "pin", "slide", "slot", "gear"]],
    [words.groups.drive, ["motor", "spring", "damper", "force", "torque", "trace"]], ["", ["remove"]]];
  id("tools").append(...SETS.map(([label, names]) => element("div", { className: "set", role: "group", "aria-label": label || words.tools.remove![0] }, ...names.map((name) => {
    const [text, key, hint] = words.tools[name]!;
    return element("button", { type: "button", className: "tool", "data-tool": name, title: `${text} (${key}): ${hint}`, "aria-label": text, "aria-keyshortcuts": key, on: { click: () => choose(name) } },
      drawn(icons[name]!), element("span", { text }));
  }))));

  // Files.
  const opened = (text: string): void => { say(""); canvas.cancel(); canvas.select(null); frame.fits = true; doc.open(text); void show(); };
  const guarded = (act: () => Promise<void>) => () => void act().catch((why) => say((why as Error).message, { bad: true }));
  const gallery = async (): Promise<void> => {
    const list = await engine.ask<Bundled[]>("models"), dialog = id<HTMLDialogElement>("gallery");
    const choice = list.map(({ name, title, about }) => element("button", { type: "button", on: { click: guarded(async () => { files.forget(`${name}.json`); opened(await engine.ask<string>("model", [name])); dialog.close(); }) } }, element("strong", { text: title || name, className: "text" }), element("span", { text: about, className: "text" })));
    dialog.replaceChildren(element("header", {}, element("h2", { text: words.file.gallery }), element("button", { type: "button", text: "×", "aria-label": "Close", on: { click: () => dialog.close() } })), element("div", { className: "models" }, ...choice));
    dialog.showModal();
  };
  const link = async (): Promise<void> => {
    history.replaceState(null, "", await packed(doc.text));
    try { await navigator.clipboard.writeText(location.href); say(words.copied); } catch { say(words.inAddress); }
  };
  // What the file holds.
  let known = "";
  const save = async (): Promise<void> => {
    if (!served) { await files.save(doc.text); return; }
    if (await served.save(doc.text)) { known = doc.text; say(words.saved(served.name)); }
    else clash(await served.read());
  };
  // Two texts of one file: the reader says which.
  const clash = (other: string | null): void => say(words.changedOnDisk(served!.name), { stays: true, act: [[words.overwrite, guarded(save)], ...(other === null ? [] : [[words.takeIt, () => write(other)] as [string, () => void]])] });
  const open = async (): Promise<void> => { const text = await files.open(input); if (text !== null) opened(text); };
  const input = id<HTMLInputElement>("chosen");
  input.addEventListener("change", () => { const file = input.files?.[0]; if (file) files.take(file).then(opened, failed); input.value = ""; });
  const EXPORTS: [string, string, string][] = [["results.csv", "csv", "text/csv"], ["summary.json", "summary", "application/json"], ["report.html", "page", "text/html"]];
  const exported = element("select", { "aria-label": words.file.export, title: words.file.export }, element("option", { value: "", text: words.file.export }), ...EXPORTS.map(([name], k) => element("option", { value: k, text: name })));
  exported.addEventListener("change", guarded(async () => {
    const [name, question, type] = EXPORTS[Number(exported.value)]!;
    exported.value = "";
    give(name, new Blob([await engine.ask<string>(question)], { type }));
  }));
  const button = (text: string, title: string, act: () => void) => element("button", { type: "button", text, title, on: { click: act } });
  const undo = button("↶", `${words.file.undo} (Ctrl+Z)`, () => doc.undo()), redo = button("↷", `${words.file.redo} (Ctrl+Y)`, () => doc.redo());
  undo.setAttribute("aria-label", words.file.undo); redo.setAttribute("aria-label", words.file.redo);
  const buttons = (): void => { undo.disabled = !doc.canUndo; redo.disabled = !doc.canRedo; };
  id("files").append(button(words.file.new, words.file.new, () => { files.forget(); opened(NEW); }), button(words.file.gallery, "Bundled mechanisms", guarded(gallery)), button(words.file.open, "Open a file (Ctrl+O)", guarded(open)),
    button(words.file.save, "Save the file (Ctrl+S)", guarded(save)), undo, redo, button(words.file.link, "A link with the whole model in it", guarded(link)), exported);

  // A picture below.
  const underlay = new Underlay(canvas), picture = element("input", { type: "file", accept: "image/*", hidden: "", "aria-label": words.underlay.hint });
  const below = button(words.underlay.open, words.underlay.hint, () => { if (underlay.isThere) { underlay.remove(); below.textContent = words.underlay.open; } else picture.click(); });
  picture.addEventListener("change", guarded(async () => {
    const file = picture.files?.[0];
    picture.value = "";
    if (!file) return;
    await underlay.take(file);
    below.textContent = words.underlay.remove;
    say(words.underlay.scale(lengthName()), { stays: true });
    choose("pose");
    canvas.tool = underlay.tool((take) => askFor(words.underlay.distance(lengthName()), (text) => { const [length] = numbers(text); if (length! > 0) take(length! * (last?.length ?? 1)); }), () => { say(""); choose("pose"); });
  }));
  id("files").append(below, picture);

  // Light or dark, keys.
  const system = matchMedia("(prefers-color-scheme: dark)");
  const dark = () => { const { theme } = document.documentElement.dataset; return theme ? theme === "dark" : system.matches; };
  const theme = (): void => {
    document.documentElement.dataset.theme = dark() ? "light" : "dark";
    if (frame.report) frame.report.theme.chosen = document.documentElement.dataset.theme;
  };
  const help = (): void => {
    const dialog = id<HTMLDialogElement>("help"), own = Object.values(words.tools).map(([name, key, hint]) => [key, `${name}: ${hint}`]);
    const rest = [["Ctrl+Z", words.file.undo], ["Ctrl+Y", words.file.redo], ["Ctrl+S", words.file.save], ["Ctrl+O", words.file.open], ["Del", "Delete what is selected"], ["Esc", "Let go"], ["Space", "Play or pause"], ["← →", "Previous or next instant"], ["+ − 0", "Zoom, fit"], ["Alt", "Without the grid"]];
    dialog.replaceChildren(element("header", {}, element("h2", { text: words.keys }), element("button", { type: "button", text: "×", "aria-label": "Close", on: { click: () => dialog.close() } })), element("div", {}, ...[...own, ...rest].map(([key, text]) => element("p", {}, element("kbd", { text: key! }), ` ${text}`))));
    dialog.showModal();
  };
  id("switches").append(button("◐", "Light or dark", theme), button("?", words.keys, help));
  const pressed = (event: KeyboardEvent): void => {
    const writes = (event.target as HTMLElement).closest?.("input:not([type=range]):not([type=checkbox]), select, textarea, .cm-editor, dialog");
    const control = event.ctrlKey || event.metaKey, key = event.key.toLowerCase();
    const act = (does: () => void) => { event.preventDefault(); event.stopPropagation(); does(); };
    if (control && key === "s") { act(guarded(save)); return; }
    if (control && key === "o") { act(guarded(open)); return; }
    const isText = (event.target as HTMLElement).closest?.(".cm-editor");
    if (writes && !(control && isText)) return;
    if (control && (key === "y" || (key === "z" && event.shiftKey))) { act(() => doc.redo()); return; }
    if (control && key === "z") { act(() => doc.undo()); return; }
    if (writes || control || event.altKey) return;
    if (key === "escape") { act(() => { if (!canvas.cancel()) { unpose(); canvas.select(null); choose("pose"); } }); return; }
    if ((key === "delete" || key === "backspace") && canvas.selected) { const thing = canvas.selected; act(() => remove(thing)); return; }
    const tool = Object.entries(words.tools).find(([, [, own]]) => own === key);
    if (tool) { act(() => choose(tool[0])); return; }
    if (key === "?") act(help);
  };
  addEventListener("keydown", pressed, { capture: true });
  frame.onMade = (report, window) => {
    canvas.attach(report, window);
    underlay.show();
    window.addEventListener("keydown", pressed, { capture: true });
    const { theme } = document.documentElement.dataset;
    if (theme) report.theme.chosen = theme;
    report.player.onRow(unpose);
  };
  // Files that are dropped on the page.
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => { event.preventDefault(); const file = event.dataTransfer?.files[0]; if (file) files.take(file).then(opened, failed); });

  engine.ask("schema").then((schema) => doc.learn(schema as object), failed);
  choose("pose");
  const fromAddress = async (): Promise<string | null> => { try { return await unpacked(location.hash); } catch { say(words.badLink, { bad: true }); return null; } };
  addEventListener("hashchange", async () => { const text = await fromAddress(); if (text !== null && text !== doc.text) opened(text); });
  const file = await served?.read().catch(() => null), linked = served ? null : await fromAddress(), before = served || linked !== null ? null : remembered();
  known = file ?? "";
  if (served) {
    files.forget(served.name);
    void served.watch((text) => {
      if (doc.text === text) return;
      const isClean = doc.text === known;
      known = text;
      if (isClean) write(text); else clash(text);
    }, () => say(words.ended, { bad: true, stays: true }));
  }
  doc.open(file ?? linked ?? before ?? NEW);
  await show();
  if (before !== null && before !== NEW) say(words.restored, { act: [[words.startOver, () => { files.forget(); opened(NEW); }]] });
  document.documentElement.dataset.ready = "true";
  // What tests look at.
  Object.assign(window, { editor: { doc, engine, frame, canvas, choose, open: opened, packed, get last() { return last; }, get shownText() { return shownText; }, get isIdle() { return engine.idle && frame.isShown && !resting && doc.held === null; } } });
};

start().catch((why) => { id("says").hidden = false; id("says").className = "bad"; id("says").textContent = `${(why as Error).message}`; });

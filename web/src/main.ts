// The editor: the text is the model; the drawing shows it and changes it.
import type { App, Say } from "./app";
import { Ask, type Curve } from "./ask";
import { Canvas, type Thing } from "./canvas";
import { Document } from "./document";
import { drawn, element, id } from "./element";
import { Engine, Interrupted, LIVE_SECONDS, SECONDS } from "./engine";
import { Frame } from "./frame";
import frameStyle from "./frame.css";
import { hands as makeHands } from "./hands";
import { Host } from "./host";
import { icons } from "./icons";
import { keys } from "./keys";
import type { End, Faulty, Read, Shown } from "./linkdyn";
import { menu as makeMenu } from "./menu";
import { Findings, Parameters, Selected, type Shop } from "./panels";
import { bytesOf, gunzipped, packed, remember, remembered, Served, unpacked } from "./share";
import { Sketch } from "./sketch";
import { tools as makeTools } from "./tools";
import { typing as makeTyping } from "./typing";
import { words } from "./words";
import { zoned, type Zone } from "./zones";

// How long the keyboard rests before what was typed is run [ms].
const REST = 140;
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
const PANELS = ["text", "parameters", "selected", "findings", "ask"] as const;
const { groups } = words;
const SETS: [string, string[]][] = [[groups.hands, ["pose", "shape"]], [groups.draw, ["bar", "point"]], [groups.joints, ["ground", "pin", "slide", "slot", "gear"]],
  [groups.drive, ["motor", "spring", "damper", "force", "torque", "trace"]], [groups.remove, ["remove"]]];

// Tabs of the panel beside the drawing.
const panels = (): { choose(name: string): void; count(name: string, number: number, bad: boolean): void } => {
  const choose = (name: string): void => PANELS.forEach((own, k) => { id(own).hidden = own !== name; tabs[k]!.setAttribute("aria-selected", String(own === name)); tabs[k]!.tabIndex = own === name ? 0 : -1; });
  const tabs = PANELS.map((name) => element("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": name, text: words.panels[name], on: { click: () => choose(name) } }));
  PANELS.forEach((name) => id(name).setAttribute("aria-labelledby", `tab-${name}`));
  id("tabs").append(...tabs);
  id("tabs").addEventListener("keydown", (event) => {
    const k = tabs.findIndex((tab) => tab === document.activeElement), next = { ArrowRight: k + 1, ArrowLeft: k - 1 }[event.key];
    if (next !== undefined && tabs[next]) { tabs[next].click(); tabs[next].focus(); event.preventDefault(); }
  });
  choose("text");
  return {
    choose,
    count: (name, number, bad) => {
      const tab = id(`tab-${name}`);
      tab.querySelector(".count")?.remove();
      if (number) tab.append(element("span", { text: String(number), className: bad ? "count bad" : "count" }));
    },
  };
};

let saying = 0;
const say: Say = (text, { bad = false, stays = false, act = [] } = {}) => {
  clearTimeout(saying);
  const box = id("says");
  box.className = bad ? "bad" : "";
  box.replaceChildren(element("span", { text, className: "text" }), ...act.map(([name, click]) => element("button", { type: "button", text: name, on: { click: () => { box.hidden = true; click(); } } })));
  box.hidden = !text;
  if (text && !stays) saying = window.setTimeout(() => { box.hidden = true; }, 6000);
};
const failed = (why: unknown): void => { if (!(why instanceof Interrupted)) say((why as Error).message, { bad: true }); };

const start = async (): Promise<void> => {
  const given = (name: string) => id(name).textContent!.trim();
  const module = await WebAssembly.compile(await gunzipped(bytesOf(given("engine"))) as BufferSource);
  const engine = new Engine(JSON.parse(given("worker")) as string, module), served = Served.found, host = Host.found;
  const [parts, file] = await Promise.all([engine.ask<[string, string, string]>("frame"), served?.read().catch(() => null)]);
  const frame = new Frame(id("view"), parts, frameStyle), canvas = new Canvas(), doc = new Document(id("text"), NEW), tabs = panels();
  let last: Read | null = null, shownText = "", generation = 0, resting = 0;
  engine.onBusy = (busy) => { id("busy").textContent = busy ? words.computing : ""; };
  id("hint").textContent = words.empty;

  const took = async ({ text, read, picture }: Shown, trying: boolean): Promise<void> => {
    [last, shownText] = [read, text];
    frame.window?.document.body.classList.toggle("old", !read.ok);
    // Bands are those of the dimensions before.
    if (trying) canvas.zones = null;
    if (picture) await frame.show(picture, trying);
    if (!trying) tell(read);
  };
  const tell = (read: Read): void => {
    doc.mark(read.faults);
    const counts = findings.show(read, read.ok ? frame.report?.summary ?? null : null);
    tabs.count("findings", counts.faults || counts.warnings, counts.faults > 0);
    parameters.show(read.parameters);
    selected.show();
    ask.show();
    id<HTMLInputElement>("title").value = read.name;
    document.title = `${read.name} – ${words.title}`;
    id("hint").hidden = !read.ok || (frame.report?.mechanism.bodies.length ?? 0) > 1;
    menu.tell();
  };
  const show = async (): Promise<void> => {
    const own = ++generation, { text } = doc;
    if (host) host.tell(text); else if (!served) remember(text);
    try {
      const shown = await engine.live<Shown>("show", [text, SECONDS], SECONDS + 4);
      if (!shown || own !== generation) return;
      await took(shown, false);
      // What takes long is for the command, where it serves the page.
      if (served && frame.report?.summary.status === "time_limit") {
        id("busy").textContent = words.byCommand;
        const picture = await served.run(text).finally(() => { id("busy").textContent = ""; });
        if (own === generation) await took({ ...shown, picture }, false);
      }
      clearTimeout(zoning);
      if (shown.read.ok && frame.report?.mechanism.points.length) zoning = window.setTimeout(() => { if (own === generation) void band(text).catch(failed); }, REST);
    } catch (why) { failed(why); }
  };
  // What tolerances do to the traced points, once the hand rests.
  let zoning = 0;
  const band = async (text: string): Promise<void> => {
    const zones = await engine.ask<Zone[]>("zones", [text]), { report } = frame;
    if (report && text === doc.text) canvas.zones = zoned(zones, report);
  };
  doc.onChange = (why) => {
    clearTimeout(resting);
    generation++;
    // Points of another text may be others.
    canvas.leave();
    canvas.zones = null;
    hands.unpose();
    menu.tell();
    resting = window.setTimeout(() => { resting = 0; void show(); }, why === "typed" ? REST : 0);
  };
  const choose = (name: string): void => {
    canvas.cancel();
    canvas.tool = tools[name]!;
    for (const button of id("tools").querySelectorAll<HTMLElement>(".tool")) button.setAttribute("aria-pressed", String(button.dataset.tool === name));
    if (canvas.tool.cursor === "crosshair") { frame.report?.player.pause(); hands.unpose(); }
    canvas.draw();
  };
  const app: App = {
    engine, frame, canvas, doc, say, failed, took, show, choose, read: () => last, write: (text) => doc.write(text),
    sketch: () => { const report = frame.report!; return new Sketch(doc.text, report.mechanism, last ?? { length: 1, angle: 1 }, canvas.grain, (body) => report.shapes.pose(body, report.player.row)); },
  };
  const hands = makeHands(app), typing = makeTyping(app), menu = makeMenu(app, typing, served, NEW);

  const remove = (thing: Thing): void => {
    const own = app.sketch(), { bodies } = canvas.mechanism;
    const named = () => bodies.flatMap(({ name, points }, body) => points.map(([point], k) => [`${name}.${point}`, [body, k] as End] as const)).find(([name]) => name === thing.name)?.[1];
    if (thing.kind !== "point") own.remove(thing.kind, thing.name);
    else { const end = thing.end ?? named(); if (end) own.removePoint(end); }
    canvas.select(null);
    app.write(own.text);
  };
  const tools = makeTools({
    canvas, say, sketch: app.sketch, write: app.write, pose: hands.pose, shape: hands.shape, untyped: typing.end,
    typed: (take) => typing.ask(words.typeLength(typing.unit), ([length, angle]) => {
      if (length! > 0 && (angle === undefined || Number.isFinite(angle))) take(length! * typing.size, angle === undefined ? null : angle * Math.PI / 180);
    }),
    removeAt: (at) => { const thing = canvas.thing(at); if (thing) remove(thing); },
  });
  id("tools").append(...SETS.map(([label, names]) => element("div", { className: "set", role: "group", "aria-label": label }, ...names.map((name) => {
    const [text, key, hint] = words.tools[name]!;
    return element("button", { type: "button", className: "tool", "data-tool": name, title: `${text} (${key}): ${hint}`, "aria-label": text, "aria-keyshortcuts": key, on: { click: () => choose(name) } }, drawn(icons[name]!), element("span", { text }));
  }))));

  // Parameters while a hand moves; of several answers the last one is shown as the new state.
  let tuning = 0;
  const shop: Shop = {
    text: () => doc.text, write: app.write, remove,
    tune: (values) => {
      const own = ++tuning;
      doc.hold();
      frame.stay();
      engine.live<Shown & Faulty>("tune", [doc.text, values, LIVE_SECONDS]).then(async (answer) => {
        if (!answer || doc.held === null) return;
        if (answer.faults) { say(answer.faults[0]!.text, { bad: true }); return; }
        doc.live(answer.text);
        await took(answer, own === tuning);
      }).catch(failed);
    },
    // What was asked last is shown first.
    tuned: async () => { await engine.ask("version").catch(failed); doc.release(); },
    typed: (name, text) => engine.ask("typed", [name, text]),
    show: (from, to) => { tabs.choose("text"); doc.show(from, to); },
    seek: (time) => { const report = frame.report; if (report) { report.player.pause(); report.player.seek(report.player.rowAt(time)); } },
  };
  const parameters = new Parameters(shop), selected = new Selected(shop), findings = new Findings(shop);
  const ask = new Ask({
    report: () => frame.report, knobs: () => last?.parameters ?? [],
    sample: (name, values, column, across) => engine.ask<Curve[]>("sample", [doc.text, name, values, column, across, LIVE_SECONDS], 60),
    set: async (values) => { shop.tune(values); await shop.tuned(); },
    assemblies: () => engine.ask("assemblies", [doc.text], 8),
    assemble: (poses) => {
      if (!last?.ok || !frame.report) { say(words.ask.unaided, { bad: true }); return; }
      const own = app.sketch(), known = canvas.mechanism.bodies.map(({ name }) => name);
      app.write(own.posed(poses.filter(([name]) => known.includes(name))));
    },
    words: (name) => served ? served.words(name, doc.text) : engine.ask("words", [doc.text, name], 60),
  });
  canvas.onSelect = (thing) => { selected.show(thing); if (thing) tabs.choose("selected"); };

  const pressed = keys(app, menu, tools, hands.unpose, remove);
  addEventListener("keydown", pressed, { capture: true });
  frame.onMade = (report, window) => {
    canvas.attach(report);
    menu.underlay.show();
    window.addEventListener("keydown", pressed, { capture: true });
    const { theme } = document.documentElement.dataset;
    if (theme) report.theme.chosen = theme;
    report.player.onRow(hands.unpose);
  };

  engine.ask("schema").then((schema) => doc.learn(schema as object), failed);
  choose("pose");
  const fromAddress = async (): Promise<string | null> => { try { return await unpacked(location.hash); } catch { say(words.badLink, { bad: true }); return null; } };
  addEventListener("hashchange", async () => { const text = await fromAddress(); if (text !== null && text !== doc.text) menu.opened(text); });
  const linked = served ? null : await fromAddress(), before = served || host || linked !== null ? null : remembered();
  doc.open(file ?? linked ?? before ?? NEW);
  await show();
  if (before !== null && before !== NEW) say(words.restored, { act: [[words.startOver, () => menu.opened(NEW, "model.json")]] });
  document.documentElement.dataset.ready = "true";
  host?.listen((text) => { if (text !== doc.text) menu.opened(text); });
  // What tests look at.
  Object.assign(window, { editor: {
    doc, engine, frame, canvas, choose, open: menu.opened, packed, unpacked,
    get last() { return last; }, get shownText() { return shownText; }, get isIdle() { return engine.idle && frame.isShown && !resting && doc.held === null; },
  } });
};

start().catch(failed);

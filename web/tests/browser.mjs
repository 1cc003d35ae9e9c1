// The editor in headless Chromium, for tests: the page from the disk, as a reader opens it.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const here = dirname(fileURLToPath(import.meta.url));
export const root = join(here, "../..");
const PAGE = join(here, "../dist/editor.html");
const found = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);

/** Names of the bundled models that have a file. */
export const names = readdirSync(join(root, "models")).filter((name) => name.endsWith(".json")).map((name) => name.slice(0, -5));
export const model = (name) => readFileSync(join(root, "models", `${name}.json`), "utf8");

/** Numbers from 0 to 1 that repeat with the seed (a hash of a counter). */
export const randoms = (seed) => () => {
  seed = seed + 0x9e3779b9 | 0;
  let mixed = Math.imul(seed ^ seed >>> 16, 0x21f0aaad);
  mixed = Math.imul(mixed ^ mixed >>> 15, 0x735a2d97);
  return ((mixed ^ mixed >>> 15) >>> 0) / 2 ** 32;
};

let browser = null;
export const close = async () => { await browser?.close(); browser = null; };

/** The page itself. */
export const html = readFileSync(PAGE, "utf8");
/** A window; what goes wrong in it is collected in `faults`, what it asks the network for in `requests`. */
export const window = async ({ width = 1440, height = 900, ...options } = {}) => {
  if (!found) throw new Error("Chromium is needed: apt-get install chromium");
  browser ??= await chromium.launch({ executablePath: found, args: ["--no-sandbox"] });
  const context = await browser.newContext({ viewport: { width, height }, ...options });
  const page = await context.newPage(), faults = [], requests = [];
  page.on("pageerror", (why) => faults.push(why.stack ?? why.message));
  page.on("console", (line) => { if (["error", "warning"].includes(line.type())) faults.push(line.text()); });
  page.on("request", (request) => { if (!/^(data|blob|about):/.test(request.url())) requests.push(request.url()); });
  return { context, page, faults, requests };
};

/** The editor in a window, ready. */
export const open = async ({ hash = "", ...options } = {}) => {
  const { context, page, faults, requests } = await window(options);
  const began = performance.now();
  await page.goto(pathToFileURL(PAGE).href + hash);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
  return { page, faults, requests, context, ready: performance.now() - began, ...hands(page) };
};

const hands = (page) => {
  const editor = (act, ...given) => page.evaluate(act, ...given);
  // Nothing is computed, and the drawing stands where it stood a while ago: under load a click would come too early.
  const idle = async () => {
    await page.waitForTimeout(60);
    await page.waitForFunction(() => {
      const { editor } = window, frame = document.querySelector("#view iframe:not(.coming)"), canvas = editor.frame.report?.stage?.canvas;
      const boxes = [frame, canvas].map((own) => own && JSON.stringify(own.getBoundingClientRect()));
      let place = "";
      try { place = String(editor.canvas.pixel([1, 0])); } catch { /* Nothing is drawn. */ }
      const now = [...boxes, place].join(" "), before = window.stoodAt;
      window.stoodAt = now;
      return editor.isIdle && now === before;
    }, undefined, { polling: 40 });
  };
  // The place of the canvas on the page.
  const corner = () => editor(() => {
    const [frame, canvas] = [document.querySelector("#view iframe:not(.coming)"), window.editor.frame.report.stage.canvas].map((own) => own.getBoundingClientRect());
    return [frame.x + canvas.x, frame.y + canvas.y];
  });
  const at = async ([x, y]) => { const [left, top] = await corner(); return [left + x, top + y]; };
  return {
    editor, idle,
    text: () => editor(() => window.editor.doc.text),
    says: () => editor(() => { const box = document.getElementById("says"); return box.hidden ? "" : box.textContent; }),
    key: (name) => page.keyboard.press(name),
    click: async (place) => { await page.mouse.click(...await at(place)); await idle(); },
    drag: async (from, to, steps = 6) => {
      await page.mouse.move(...await at(from));
      await page.mouse.down();
      await page.mouse.move(...await at(to), { steps });
      await page.mouse.up();
      await idle();
    },
    /** Where a point of a body is on the canvas. */
    pixel: (name) => editor((name) => {
      const { canvas } = window.editor, [body, point] = name.split(".");
      const k = canvas.mechanism.bodies.findIndex((own) => own.name === body);
      return canvas.pixel([k, canvas.mechanism.bodies[k].points.findIndex(([own]) => own === point)]);
    }, name),
    middle: async (...points) => {
      const all = await editor((points) => points.map((name) => {
        const { canvas } = window.editor, [body, point] = name.split("."), k = canvas.mechanism.bodies.findIndex((own) => own.name === body);
        return canvas.pixel([k, canvas.mechanism.bodies[k].points.findIndex(([own]) => own === point)]);
      }), points);
      return [0, 1].map((axis) => (all[0][axis] + all[1][axis]) / 2);
    },
    load: async (text) => { await editor((text) => window.editor.open(text), text); await idle(); },
  };
};

// Looks at the report as readers do: pictures of it at six sizes, dark and printed, the times of its frames while it plays, and how
// long it takes to open.
//
//   node benches/report.mjs DIR [LINKDYN]      pictures into DIR
//   node benches/report.mjs --frames [LINKDYN] times of frames while the lock plays
//   node benches/report.mjs --open [LINKDYN]   times from opening a page of 2000 rows to its first pose and plots
//   node benches/report.mjs --page FILE DIR    pictures of a page that is there
//
// LINKDYN is the command, else target/debug/linkdyn. Needs Node 18 and Chromium, which it drives through a pipe.
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";

const MODELS = ["watt-i-lock", "four-bar", "slider-crank-clearance", "double-pendulum", "double-wishbone", "jansen-leg", "andrews-squeezer", "geared-five-bar"];
const SIZES = [[1920, 1080], [1440, 900], [1280, 720], [1024, 768], [820, 1180], [390, 844]];
const LAPTOP = [1280, 720];
const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--disable-sync", "--hide-scrollbars", "--remote-debugging-pipe"];

// Names that wrap, and names that would do harm if they were not text.
const ODD = {
  format: "linkdyn/1", name: "<script>alert(1)</script> with a name that is a good deal longer than any line of a telephone", units: "SI",
  about: "<img src=x onerror=alert(1)> & a sentence about a model that does not end before the page does, since whoever wrote it had much to say about it.",
  bodies: {
    ground: { points: { O: [0, 0], Q: [0.4, 0] } },
    "</script><b>crank": { points: { O: [0, 0], "outer_ball_joint_front_left": [0.1, 0] }, pose: { angle: 0.5 } },
    left_upper_control_arm_of_the_front_axle: { points: { A: [0, 0], B: [0.35, 0] }, pose: { position: [0.1, 0.05] } },
    "\u202erocker": { points: { B: [0, 0], Q: [0.25, 0] }, pose: { position: [0.4, 0.2], angle: -1.5 } },
  },
  joints: {
    "joint_with_a_long_name_at_the_ground": { type: "revolute", between: ["ground.O", "</script><b>crank.O"] },
    "<svg onload>": { type: "revolute", between: ["</script><b>crank.outer_ball_joint_front_left", "left_upper_control_arm_of_the_front_axle.A"] },
    "🔒": { type: "revolute", between: ["left_upper_control_arm_of_the_front_axle.B", "\u202erocker.B"] },
    d: { type: "revolute", between: ["\u202erocker.Q", "ground.Q"] },
  },
  drivers: { "a\"b": { type: "rotation", body: "</script><b>crank", motion: { type: "constant_velocity", velocity: 6 } } },
  points: ["left_upper_control_arm_of_the_front_axle.B"],
  analysis: { type: "kinematics", end: 1, outputs: 101 },
};

// A browser with one page; the protocol of its developer tools, as JSON that ends with a zero.
async function open() {
  const profile = mkdtempSync(join(tmpdir(), "report-"));
  const browser = spawn("chromium", [...FLAGS, `--user-data-dir=${profile}`, "about:blank"], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const waiting = new Map(), listeners = [], console = [];
  let number = 0, rest = "";
  browser.stdio[4].setEncoding("utf8").on("data", (text) => {
    const parts = (rest + text).split("\0");
    rest = parts.pop();
    for (const message of parts.map((part) => JSON.parse(part))) {
      if (message.id) {
        const [done, failed] = waiting.get(message.id);
        if (message.error) failed(new Error(message.error.message)); else done(message.result);
      } else listeners.forEach((listen) => listen(message));
    }
  });
  const send = (method, params = {}, sessionId = undefined) => new Promise((...ends) => {
    waiting.set(++number, ends);
    browser.stdio[3].write(`${JSON.stringify({ id: number, method, params, sessionId })}\0`);
  });
  const { targetId } = await send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const say = (method, params) => send(method, params, sessionId);
  for (const domain of ["Page", "Runtime", "Log"]) await say(`${domain}.enable`);
  listeners.push(({ method, params }) => { if (["Runtime.exceptionThrown", "Log.entryAdded", "Runtime.consoleAPICalled"].includes(method)) console.push(params.exceptionDetails?.exception?.description || JSON.stringify(params.entry || params.args)); });
  return {
    say, console,
    async go(file) {
      const loaded = new Promise((done) => listeners.push(({ method }) => { if (method === "Page.loadEventFired") done(); }));
      await say("Page.navigate", { url: `file://${resolve(file)}` });
      await loaded;
      await new Promise((done) => setTimeout(done, 500));
    },
    async ask(expression) {
      const { result, exceptionDetails } = await say("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
      return result.value;
    },
    size: ([width, height], dark = false) => Promise.all([
      say("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: width < 600 ? 2 : 1, mobile: width < 600 }),
      say("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }] }),
    ]),
    close: () => new Promise((done) => {
      browser.on("exit", () => setTimeout(() => { rmSync(profile, { recursive: true, force: true, maxRetries: 5 }); done(); }, 200));
      browser.kill();
    }),
  };
}

const save = (file, base64) => writeFileSync(file, Buffer.from(base64, "base64"));

// Pictures of a page at all sizes, from its top and from its end, dark, and printed.
async function shoot(browser, page, folder, name) {
  for (const size of SIZES) {
    await browser.size(size);
    await browser.go(page);
    const shot = async (what) => save(join(folder, `${name}-${size.join("x")}${what}.png`), (await browser.say("Page.captureScreenshot", { format: "png" })).data);
    await shot("");
    await browser.ask("scrollTo(0, document.documentElement.scrollHeight); new Promise((done) => setTimeout(done, 300))");
    await shot("-end");
  }
  await browser.size(LAPTOP, true);
  await browser.go(page);
  save(join(folder, `${name}-dark.png`), (await browser.say("Page.captureScreenshot", { format: "png" })).data);
  save(join(folder, `${name}.pdf`), (await browser.say("Page.printToPDF", { preferCSSPageSize: true })).data);
  // Each complaint once.
  for (const said of new Set(browser.console.splice(0))) console.log(`${name}: ${said}`);
}

const run = (command, model, folder, ...more) => execFileSync(command, ["run", model, "-o", folder, ...more], { stdio: ["ignore", "ignore", "inherit"] });

const [mode, ...more] = process.argv.slice(2);
if (!mode || (mode === "--page" && more.length < 2)) {
  console.error("usage: node benches/report.mjs DIR [LINKDYN] | --frames [LINKDYN] | --open [LINKDYN] | --page FILE DIR");
  process.exit(2);
}
const work = mkdtempSync(join(tmpdir(), "report-runs-"));
const browser = await open();
try {
  if (mode === "--frames") {
    run(more[0] || "target/debug/linkdyn", "watt-i-lock", work);
    await browser.size(LAPTOP);
    await browser.go(join(work, "report.html"));
    const script = "new Promise((done) => { const times = []; let last = performance.now(); document.getElementById('arrows').click(); linkdyn.player.play(); "
      + "const tick = () => { const now = performance.now(); times.push(now - last); last = now; times.length < 400 ? requestAnimationFrame(tick) : done(times.slice(20)); }; requestAnimationFrame(tick); })";
    const times = (await browser.ask(script)).sort((a, b) => a - b), at = (part) => times[Math.floor(part * (times.length - 1))].toFixed(1);
    console.log(`frames of the lock with arrows, 1280 × 720: median ${at(0.5)} ms, p95 ${at(0.95)} ms, longest ${at(1)} ms`);
    // What of it is the page's own work: a machine that has more to do misses frames all the same.
    const own = (await browser.ask("linkdyn.player.pause(); Array.from({ length: 300 }, (_, k) => { const from = performance.now(); linkdyn.player.seek(5 * k + 1); linkdyn.stage.paint(); return performance.now() - from; })")).sort((a, b) => a - b);
    console.log(`its script takes ${own[150].toFixed(1)} ms of a frame, p95 ${own[285].toFixed(1)} ms`);
  } else if (mode === "--open") {
    // About as large as reports get: 113 columns, those among them that the page adds.
    run(more[0] || "target/debug/linkdyn", "andrews-squeezer", work, "--set", "analysis.outputs=2000");
    await browser.size(LAPTOP);
    const times = [];
    for (let visit = 0; visit < 9; visit++) {
      await browser.go(join(work, "report.html"));
      times.push(await browser.ask("performance.getEntriesByType('navigation')[0].domContentLoadedEventEnd"));
    }
    times.sort((a, b) => a - b);
    const size = await browser.ask("`${linkdyn.rows} rows, ${linkdyn.columns.length} columns`");
    console.log(`a page of ${size} has its first pose and plots after ${times[0].toFixed(0)} … ${times[4].toFixed(0)} … ${times[8].toFixed(0)} ms (fastest, median, slowest of ${times.length} visits)`);
  } else if (mode === "--page") {
    mkdirSync(more[1], { recursive: true });
    await shoot(browser, more[0], more[1], basename(more[0], ".html"));
  } else {
    mkdirSync(mode, { recursive: true });
    const odd = join(work, "odd-names.json");
    writeFileSync(odd, JSON.stringify(ODD));
    for (const model of [...MODELS, odd]) {
      const name = basename(model, ".json"), folder = join(work, `run-${name}`);
      run(more[0] || "target/debug/linkdyn", model, folder);
      await shoot(browser, join(folder, "report.html"), mode, name);
      console.log(name);
    }
  }
} finally {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
}

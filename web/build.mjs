// Builds the editor: `dist/editor.html`, one file that needs nothing else and asks the network for nothing.
//
//   node build.mjs              the engine (cargo), then the page
//   node build.mjs --page       the page alone, with the engine that is built
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

// The engine as a browser gets it [bytes].
const MOST = 2_300_000;

const here = dirname(fileURLToPath(import.meta.url)), root = join(here, ".."), engine = join(here, "build/engine");
const run = (command, args) => {
  const { status, error } = spawnSync(command, args, { cwd: root, stdio: ["ignore", "inherit", "inherit"] });
  if (status !== 0) throw new Error(`${command} ${args.join(" ")} failed${error ? `: ${error.message}` : ""}`);
};

if (!process.argv.includes("--page")) {
  const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");
  run("cargo", ["build", "--locked", "--profile", "web", "--target", "wasm32-unknown-unknown", "-p", "linkdyn-web"]);
  run("cargo", ["run", "--locked", "--profile", "tool", "-q", "-p", "linkdyn-web-bind", "--", join(target, "wasm32-unknown-unknown/web/linkdyn_web.wasm"), engine]);
}

const bundled = async (entry) => {
  const { outputFiles: [file] } = await build({ entryPoints: [join(here, "src", entry)], bundle: true, minify: true, format: "iife", target: "es2022", write: false, legalComments: "none",
    loader: { ".css": "text", ".html": "text" }, logOverride: { "empty-import-meta": "silent" }, logLevel: "warning" });
  return file.text;
};
const wasm = readFileSync(join(engine, "linkdyn_bg.wasm")), packed = gzipSync(wasm, { level: 9 });
if (packed.length > MOST) throw new Error(`the engine takes ${packed.length} bytes gzipped, more than ${MOST}`);

// The page of a report, in which the mechanism is shown: from the engine itself.
const { initSync, Desk } = await import(pathToFileURL(join(engine, "linkdyn.js")).href);
initSync({ module: new WebAssembly.Module(wasm) });
const frame = JSON.parse(Desk.frame()), policy = /Content-Security-Policy" content="([^"]*)"/.exec(frame[0])[1];
const hashes = (kind) => new RegExp(`${kind}-src ([^;]*)`).exec(policy)[1];
const palette = /<style>([\s\S]*?)\n:root \{ color-scheme/.exec(frame[0])[1];

const [main, worker] = await Promise.all([bundled("main.ts"), bundled("worker.ts")]);
const read = (name) => readFileSync(join(here, "src", name), "utf8");
const style = [palette, readFileSync(join(root, "crates/picture/src/page/page.css"), "utf8").split("/* The mechanism beside its results")[0], read("page.css")].join("\n");
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
// Data in script elements, which no text in them can end.
const data = (json) => json.replaceAll("<", "\\u003c");
const safe = (script) => script.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const [script, workerText] = [safe(main), data(JSON.stringify(worker))];
const allowed = [
  "default-src 'none'", `script-src ${hash(script)} ${hashes("script")} 'wasm-unsafe-eval' blob:`, "worker-src blob:", `style-src 'unsafe-inline'`, "img-src data: blob:", "connect-src 'none'", "frame-src 'self'",
  "base-uri 'none'", "form-action 'none'",
].join("; ");
const page = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${allowed}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="referrer" content="no-referrer">
<title>linkdyn</title>
<link rel="icon" href="data:,">
<style>${style}</style>
</head>
<body>
${read("page.html")}<script type="application/octet-stream" id="engine">${packed.toString("base64")}</script>
<script type="application/json" id="worker">${workerText}</script>
<script>${script}</script>
</body>
</html>
`;
mkdirSync(join(here, "dist"), { recursive: true });
writeFileSync(join(here, "dist/editor.html"), page);
console.log(`dist/editor.html: ${page.length} bytes; engine ${wasm.length}, gzipped ${packed.length}; scripts ${main.length} and ${worker.length}`);

"use strict";
// Runs as they come: the command tells of them while it watches. The report that is shown takes the data of the next run where it is
// one of the same mechanism; else the next report is made ready below it, and takes its place with what the reader has chosen.
const [faults, frames, words] = ["faults", "frames", "words"].map((id) => document.getElementById(id));
const PATIENCE = 200, LONGEST = 10000, AGAIN = 500;
let shown = null, coming = null, last = 0, kept = "", asked = 0, version = -1;
// The last run whose picture is on the screen.
let pictured = 0;
const whole = { number: 0, waits: null };

// What is wrong with the file, then with the values that are tried.
const wrong = { file: [], values: [] };
const say = (of, lines) => {
  wrong[of] = lines;
  const all = [...wrong.file, ...wrong.values];
  const told = all.length && last ? [...all, "Below is the last run."] : all;
  if (told.join("\n") === [...faults.children].map(({ textContent }) => textContent).join("\n")) return;
  faults.replaceChildren(...told.map((text, k) => {
    const line = document.createElement("p");
    line.textContent = text;
    if (k >= all.length) line.className = "old";
    return line;
  }));
  // What is said of a value comes and goes while a hand moves: it must not push the report about.
  faults.classList.toggle("over", !wrong.file.length);
  dim(all.length > 0);
};
const dim = (on) => { if (shown) shown.contentWindow.postMessage({ dim: on }, "*"); };

// Gives a run to the report; whether it could take it. A report that does not answer could not.
const give = (run, trying) => new Promise((done) => {
  const number = ++whole.number;
  whole.waits = (told) => { if (told === null || told.number === number) { whole.waits = null; clearTimeout(late); done(Boolean(told && told.taken)); } };
  const { waits } = whole, late = setTimeout(() => { if (whole.waits === waits) waits(null); }, LONGEST);
  shown.contentWindow.postMessage({ run, trying, number }, "*");
});

addEventListener("message", ({ source, data }) => {
  if (!shown || source !== shown.contentWindow) return;
  if (typeof data?.chosen === "string") { clearTimeout(asked); kept = data.chosen; load(); }
  if (typeof data?.taken === "boolean" && whole.waits) whole.waits(data);
  if (typeof data?.dark === "boolean") document.documentElement.dataset.theme = data.dark ? "dark" : "light";
});

// A report that does not answer is shown as it was chosen before.
const reload = () => {
  if (!shown) { load(); return; }
  clearTimeout(asked);
  asked = setTimeout(load, PATIENCE);
  shown.contentWindow.postMessage("linkdyn: what is chosen?", "*");
};
function load() {
  if (coming) coming.remove();
  const frame = document.createElement("iframe"), number = last;
  frame.title = "Report";
  coming = frame;
  frame.onload = () => {
    if (frame !== coming) return;
    const focused = !shown || document.activeElement === shown;
    if (shown) shown.remove();
    shown = frame;
    coming = null;
    pictured = number;
    dim(wrong.file.length + wrong.values.length > 0);
    // Keys are for the report.
    if (focused) frame.contentWindow.focus();
  };
  frame.src = "report.html?" + last + (kept ? "#kept=" + encodeURIComponent(kept) : "");
  frames.prepend(frame);
}

const show = async (number) => {
  if (!shown || coming) { reload(); return; }
  const answer = await fetch("data");
  const run = await answer.text();
  if (number !== last) return;
  if (answer.ok && await give(run, false)) pictured = number;
  else if (number === last) reload();
};
const look = async () => {
  try {
    const answer = await fetch(`state?${version}`);
    if (!answer.ok) throw new Error(answer.statusText);
    const told = await answer.json();
    words.textContent = "";
    version = told.version;
    if (told.run !== last) wrong.values = [];
    say("file", told.faults);
    document.title = (told.faults.length ? "\u26a0 " : "") + "linkdyn --watch";
    if (told.run !== last) {
      last = told.run;
      knobs.saved(told.knobs);
      await show(last);
    }
    setTimeout(look, 0);
  } catch {
    words.textContent = "linkdyn does not watch any more";
    setTimeout(look, AGAIN);
  }
};

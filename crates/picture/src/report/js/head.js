"use strict";
// The head: what this is about, how it ended, what the reader should know.
(() => {
  const { plain, units, summary, mechanism, shapes, words, id } = linkdyn;

  const put = (name, text) => { const node = id(name); node.textContent = text ? plain(text) : ""; node.classList.add("text"); node.hidden = !text; };
  id("words").hidden = false;
  const DONE = ["completed", "completed_with_gaps"], LOOKS = ["good", "warn", "bad"];
  const tell = () => {
    const { rows, time } = linkdyn;
    put("about", linkdyn.about);
    put("origin", linkdyn.source);
    put("status", words(summary.status));
    const look = DONE.indexOf(summary.status);
    LOOKS.forEach((name, k) => id("status").classList.toggle(name, k === (look < 0 ? 2 : look)));
    const kind = words((summary.settings || {}).type || "");
    const range = rows > 1 ? `, ${units.number(time[0], 4)} … ${units.number(time[rows - 1], 6)} s` : "";
    // A run that ended early is opened where it is stuck, but not under the hand that edits its model.
    if (!DONE.includes(summary.status) && !frameElement?.handed) linkdyn.player.seek(rows - 1);
    // What went wrong stands on top, what the page itself leaves out at its foot.
    linkdyn.page.head({
      name: summary.model.name, line: `${kind}: ${rows === 1 ? "1 instant" : `${rows} instants`}${range}, ${linkdyn.width} columns`,
      notes: [...(summary.message ? [summary.message] : []), ...summary.warnings.slice(0, 5)], foot: linkdyn.notes, files: "results.csv beside this file",
    });
  };
  linkdyn.onData(tell);
  tell();
  const { rows } = linkdyn;
  if (rows === 0) put("undrawn", `There is no result to show: ${words(summary.status)}${summary.message ? ", for the reason given above" : ""}.`);
  else if (mechanism.bodies.length < 2) put("undrawn", "The drawing of this model is not in this page.");
  else if (!shapes.known) put("undrawn", "The poses of the bodies are not in this page, so that there is nothing to draw.");

  // A long description takes one line until it is opened.
  const about = id("about"), more = id("more");
  const open = (on) => { id("head").classList.toggle("open", on); more.textContent = on ? "less" : "more"; more.setAttribute("aria-expanded", on); };
  const measure = () => { more.hidden = !(linkdyn.source || about.scrollWidth > about.clientWidth + 1 || id("name").scrollHeight > id("name").clientHeight + 4 || id("head").classList.contains("open")); };
  more.addEventListener("click", () => open(!id("head").classList.contains("open")));
  open(false);
  measure();
  addEventListener("resize", measure);

  if (rows === 0) {
    for (const name of ["view", "canvas"]) id(name).hidden = true;
    id("motion").classList.add("empty");
  }
})();

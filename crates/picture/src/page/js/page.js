"use strict";
// What every page has: a head, notes, a foot, units, light and dark, keys, paper.
(() => {
  const { given, element, plain, theme, units, id } = linkdyn;

  // What the page is about; what went wrong stands on top, what the page leaves out at its foot.
  const head = ({ kind, name, line, notes = [], foot = [], files }) => {
    document.title = [plain(name), ...(kind ? [kind] : []), "linkdyn"].join(" – ");
    id("name").textContent = plain(name);
    if (line) id("line").textContent = plain(line);
    const paragraph = (text) => element("p", { text, className: "text" });
    id("notes").replaceChildren(...notes.map(paragraph));
    id("notes").hidden = !notes.length;
    const engine = given.engine || given.summary.engine;
    id("foot").replaceChildren(...[...foot, `linkdyn ${engine}. All numbers are in ${files}, in SI units.`].map(paragraph));
  };

  id("theme").addEventListener("click", theme.toggle);
  id("help").addEventListener("click", () => { id("keys").hidden = !id("keys").hidden; id("help").setAttribute("aria-expanded", !id("keys").hidden); });

  // Both systems of units, where the page has them.
  const choose = (system) => { units.system = system; id("units").value = system; };
  const withUnits = () => {
    id("units").hidden = false;
    id("units").addEventListener("change", () => choose(id("units").value));
    return ["u", "units", ["u"], () => choose(units.system === "si" ? "engineering" : "si")];
  };

  // Keys, each with what it does, its names, and an act; what can be typed into or slid keeps its own keys.
  const listen = (...own) => {
    const list = [...own, ["d", "light or dark", ["d"], theme.toggle], ["?", "keyboard shortcuts", ["?"], () => id("help").click()]];
    list.forEach(([shown, does]) => id("keys").append(element("div", {}, element("kbd", { text: shown }), ` ${does}`)));
    document.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const { target, key } = event, found = list.find(([, , names]) => names.includes(key));
      const writes = target.matches("input[type=text], select") && key !== "Escape";
      const slides = target.matches("input[type=range]:not(#scrub)") && key.startsWith("Arrow");
      const presses = key === " " && target.matches("button:not(#play), input[type=checkbox]");
      if (!found || writes || slides || presses) return;
      event.preventDefault();
      found[3](event);
    });
  };

  // Paper is light; a page may be laid out for it.
  const paper = (change = () => {}) => {
    const turn = (on) => { theme.paper = on; change(on); };
    addEventListener("beforeprint", () => turn(true));
    addEventListener("afterprint", () => turn(false));
    if (matchMedia("print").matches) turn(true);
  };
  const ready = () => { document.documentElement.dataset.ready = "true"; };

  linkdyn.page = { head, withUnits, listen, paper, ready };
})();

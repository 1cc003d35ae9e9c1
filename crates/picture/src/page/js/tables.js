"use strict";
// Tables that fold.
(() => {
  const { element } = linkdyn;
  const name = (text) => element("span", { text, className: "text" });
  const number = (text) => element("td", { text, className: "number" });
  const row = (...cells) => element("tr", {}, ...cells);
  // Heads of columns, those of numbers as [text].
  const heads = (...texts) => element("thead", {}, row(...texts.map((text) => Array.isArray(text)
    ? element("th", { text: text[0], scope: "col", className: "number" }) : element("th", { text, scope: "col" }))));
  const scroll = (options, ...parts) => element("div", { className: "scroll" }, element("table", options, ...parts));
  // A card with a title and a note.
  const folded = (title, { wide = false, open = true, note = "" } = {}, ...parts) => {
    const box = element("details", {}, element("summary", {}, element("h2", { text: title }), ...(note ? [element("span", { text: ` ${note}`, className: "muted text" })] : [])), ...parts);
    box.open = open;
    return { box, root: element("section", { className: wide ? "table wide" : "table" }, box) };
  };
  linkdyn.tables = { name, number, row, heads, scroll, folded };
})();

"use strict";
// The levels of each output, at the chosen pose or at the largest deviation, and whether its limits are kept.
(() => {
  if (!linkdyn.outputs.length) return;
  const { outputs, choice, element, file } = linkdyn;
  const box = document.getElementById("outputs");

  const verdict = ({ limits, poses, kept, exceeded, certified }) => {
    if (!limits) return null;
    const of = poses > 1 ? ` at ${exceeded} of ${poses} poses` : "";
    if (kept === poses) return ["good", poses > 1 ? "limits always kept (certified)" : "limits kept (certified)"];
    if (exceeded) return ["bad", `limits exceeded${linkdyn.level ? "" : " to first order"}${of}`];
    if (linkdyn.level < 2) return ["warn", linkdyn.level ? "limits kept by the worst found" : "limits kept to first order"];
    return ["warn", poses > 1 ? `limits kept by the worst found, not certified at ${poses - kept} of ${poses} poses` : certified ? "limits kept by the worst found, certified is wider" : "limits kept by the worst found, not certified"];
  };

  const tile = (label, text, none) => element("span", { className: "tile" }, element("span", { className: "muted", text: label }),
    element("span", { className: text === null ? "none" : "number", text: text === null ? none : text }));

  const levels = (output, row) => {
    const { band, unit, limits } = output, at = (name) => band[name][row];
    const pair = (name) => file.both(at(`${name}_low`), at(`${name}_high`), unit);
    const capable = Number.isFinite(at("within"));
    const tiles = [
      tile("nominal", file.value(at("nominal"), unit, 6)),
      tile("first order", pair("first"), "none: change point"),
      ...(linkdyn.level > 0 ? [tile("worst found", pair("found"), "not found")] : []),
      ...(linkdyn.level > 1 ? [tile("certified", pair("certified"), "not certified")] : []),
      tile("±3σ", Number.isFinite(at("sigma")) ? `±${file.value(3 * at("sigma"), unit, 4)}` : null, "none: change point"),
    ];
    if (at("mean")) tiles.push(tile("mean", file.signed(at("mean"), unit)));
    if (at("pressed")) tiles.push(tile("lost motion", file.value(2 * Math.abs(at("pressed")), unit, 4)));
    if (limits) {
      tiles.push(tile("limits", file.both(...limits, unit)));
      const least = output.least_within;
      if (least && !output.alone) tiles.push(tile("least yield", `${file.number(100 * least[0], 6)} %`));
      if (capable) tiles.push(tile("yield", `${file.number(100 * at("within"), 6)} %`), tile("Cp", file.number(at("cp"), 4)), tile("Cpk", file.number(at("cpk"), 4)));
    }
    return tiles;
  };

  const card = (output) => {
    const chosen = output === choice.output, found = verdict(output);
    const row = chosen ? choice.detail.row : output.details[output.worst].row;
    const at = chosen ? choice.where() : output.farthest_at.map(([name, value, unit]) => `${name} = ${file.value(value, unit, 5)}`).join(", ");
    const where = output.alone ? `at ${at}` : chosen && choice.number !== output.worst ? `${output.poses} poses, here at ${at}` : `${output.poses} poses, largest deviation at ${at}`;
    const title = element("span", { className: "title" }, element("strong", { text: output.name, className: "text" }),
      ...(output.of === output.name ? [] : [element("span", { text: output.of, className: "muted text" })]), element("span", { text: where, className: "muted text" }),
      ...(found ? [element("span", { className: `badge ${found[0]}`, text: found[1] })] : []));
    if (outputs.length === 1) return element("div", { className: "output" }, title, ...levels(output, row));
    return element("button", { type: "button", className: chosen ? "output on" : "output", "aria-pressed": chosen, on: { click: () => { if (output !== choice.output) choice.open(output); } } }, title, ...levels(output, row));
  };

  // Only what changed is made anew: a button keeps the focus.
  const cards = outputs.map(card);
  box.append(...cards);
  const fill = (k) => { const made = card(outputs[k]); cards[k].className = made.className; if (made.hasAttribute("aria-pressed")) cards[k].setAttribute("aria-pressed", made.getAttribute("aria-pressed")); cards[k].replaceChildren(...made.childNodes); };
  choice.onChange((what) => {
    if (what === "output") outputs.forEach((_, k) => fill(k));
    else if (what === "pose") fill(outputs.indexOf(choice.output));
  });
})();

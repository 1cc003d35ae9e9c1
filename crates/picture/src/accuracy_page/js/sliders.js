"use strict";
// What if: parameters moved by hand, to first order, and the worst along with them; with all at their worst, the worst found.
(() => {
  if (!linkdyn.outputs.length) return;
  const { choice, sources, element, file, id } = linkdyn;
  const STEPS = 100;
  const moving = sources.map(({ name, slider }, source) => ({ name: name.replace(/^parameters\./, ""), slider, source })).filter(({ slider }) => slider);

  const inputs = moving.map(({ name, slider, source }) => {
    const input = element("input", { type: "range", min: slider.range[0] < 0 ? -STEPS : 0, max: slider.range[1] > 0 ? STEPS : 0, step: 1, "aria-label": linkdyn.plain(name) });
    input.value = 0;
    const output = element("span", { className: "number" });
    const say = () => {
      const by = choice.delta[source], part = by < 0 ? -by / slider.range[0] : by / slider.range[1];
      input.value = by === 0 ? 0 : Math.round(STEPS * part);
      const range = file.both(...slider.range, slider.unit, 3);
      output.replaceChildren(element("span", { text: file.value(slider.value + by, slider.unit, 7) }), element("small", { text: by ? file.signed(by, slider.unit, 3) : slider.is_tolerance ? range : "no tolerance" }));
    };
    input.addEventListener("input", () => {
      const part = Number(input.value) / STEPS;
      choice.move(source, part < 0 ? -part * slider.range[0] : part * slider.range[1]);
    });
    say();
    id("sliders").append(element("label", { className: "slider" }, element("span", { text: name, className: "text" }), input, output));
    return { input, say, source };
  });

  const NAMES = ["found_low", "found_high"];
  const gauge = () => {
    const { output, corner } = choice, by = choice.shift(choice.detail), at = (name) => choice.at(name);
    // In the corner the output is where the worst found is, which stays.
    const moved = corner === null && Number.isFinite(by) ? by : 0, now = corner === null ? moved : at(NAMES[corner]);
    const ends = [at("reach_low"), at("reach_high"), at("certified_low"), at("certified_high")];
    const all = [0, moved, ...ends.map((end) => end + moved), ...(output.limits || [])].filter(Number.isFinite);
    const [low, high] = [Math.min(...all), Math.max(...all)], wide = (high - low) * 1.1 || 1;
    const place = (value) => 100 * (value - (low + high) / 2) / wide + 50;
    const mark = (className, from, to) => {
      if (!Number.isFinite(from) || (to !== undefined && !Number.isFinite(to))) return [];
      const made = element("i", { className });
      made.style.left = `${place(from)}%`;
      if (to !== undefined) made.style.width = `${place(to) - place(from)}%`;
      return [made];
    };
    id("gauge").replaceChildren(...mark("bound", ends[2] + moved, ends[3] + moved), ...mark("reach", ends[0] + moved, ends[1] + moved),
      ...mark("zero", 0), ...(output.limits || []).flatMap((limit) => mark("limit", limit)), ...mark("now", now));
  };

  const fill = () => {
    const { output, detail, corner } = choice, { unit } = output, nominal = choice.at("nominal"), by = choice.shift(detail);
    const found = corner === null ? NaN : choice.at(NAMES[corner]);
    id("what_level").textContent = corner === null ? "to first order" : "worst found";
    corners.forEach((button, side) => { button.disabled = !choice.worst(side); button.setAttribute("aria-pressed", side === corner); });
    const worst = file.both(by + choice.at("reach_low"), by + choice.at("reach_high"), unit);
    id("moved").textContent = corner !== null ? `${linkdyn.plain(output.name)} = ${file.value(nominal + found, unit, 7)} (${file.signed(found, unit)}): the worst found, as drawn, with all other sources at their worst; the parameters alone change it by ${file.signed(by, unit)} to first order`
      : !Number.isFinite(by) ? "No first order exists at this pose."
      : `${linkdyn.plain(output.name)} = ${file.value(nominal + by, unit, 7)} (${by === 0 ? "nominal" : `${file.signed(by, unit)} to first order`})${worst ? `, worst ${worst}` : ""}`;
    const colours = [`blue: ${linkdyn.reach}`, ...(Number.isFinite(choice.at("certified_low")) ? ["light: certified"] : []), ...(output.limits ? ["red: limits"] : [])];
    const free = inputs.length && moving.some(({ slider }) => !slider.is_tolerance) ? " Parameters without tolerance move by ±1 %." : "";
    id("gauge_note").textContent = `${colours.join(", ")}.${free}`;
    id("gauge").setAttribute("aria-label", id("moved").textContent);
    id("reset").disabled = !choice.isMoved;
    inputs.forEach(({ say }) => say());
    gauge();
  };
  const corners = ["All to the lowest", "All to the highest"].map((text, side) => element("button", { type: "button", text, "aria-pressed": false, on: { click: () => choice.toWorst(side) } }));
  id("corners").append(...corners);
  id("corners").hidden = !linkdyn.level || !moving.some(({ slider }) => slider.is_tolerance);
  id("reset").addEventListener("click", () => choice.reset());
  id("reset").hidden = !inputs.length;
  if (!inputs.length) id("sliders").append(element("p", { className: "muted", text: "No length of this model is a parameter: there is nothing to move." }));
  choice.onChange(fill);
  fill();
})();

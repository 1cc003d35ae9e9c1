"use strict";
// The drawer: what the drawing shows, and how.
(() => {
  const { element, player, stage, mechanism, moments, id } = linkdyn;
  const { options } = stage;
  const box = (text, on, change) => {
    const input = element("input", { type: "checkbox", on: { change: () => { change(input.checked); stage.draw(); } } });
    input.checked = on;
    return element("label", {}, input, element("span", { text, className: "text" }));
  };
  const kinds = { bodies: "Bodies' names", joints: "Joints' names", points: "Points", centres: "Centres of mass", drivers: "Drivers" };
  for (const [key, text] of Object.entries(kinds)) id("show").append(box(text, options.show[key], (on) => { options.show[key] = on; }));
  if (moments.has) id("show").append(box("Bending moments", options.moments, (on) => { options.moments = on; }));
  id("arrows").disabled = !stage.hasForces;
  if (!stage.hasForces && !mechanism.loads.length) id("forces").hidden = true;
  id("arrows").addEventListener("change", () => { options.arrows = id("arrows").checked; stage.draw(); });
  id("loads").addEventListener("change", () => { options.loads = id("loads").checked; stage.draw(); });
  id("arrow_scale").addEventListener("input", () => { options.arrowScale = Number(id("arrow_scale").value); stage.draw(); });
  const points = mechanism.bodies.flatMap(({ name, points }, body) => body ? points.map(([point], number) => [`${name}.${point}`, `${body},${number}`]) : []).slice(0, 300);
  id("follow").append(element("option", { value: "", text: "nothing" }), ...points.map(([text, value]) => element("option", { value, text })));
  id("follow").addEventListener("change", () => { options.follow = id("follow").value ? id("follow").value.split(",").map(Number) : null; if (options.follow) stage.draw(); else stage.whole(); });
  const order = [...points].sort((a, b) => options.traces.has(b[1]) - options.traces.has(a[1]));
  id("traces").append(...order.map(([text, key]) => box(text, options.traces.has(key), (on) => on ? options.traces.add(key) : options.traces.delete(key))));
  id("zoom_in").addEventListener("click", () => stage.zoom(1.25));
  id("zoom_out").addEventListener("click", () => stage.zoom(0.8));
  id("whole").addEventListener("click", stage.whole);
  id("loop").addEventListener("change", () => { player.repeat = id("loop").checked; });

  const side = id("side"), button = id("options");
  const open = (on) => {
    side.hidden = !on;
    button.setAttribute("aria-expanded", on);
    if (on) id("shut").focus(); else if (side.contains(document.activeElement) || document.activeElement === document.body) button.focus();
  };
  button.addEventListener("click", () => open(side.hidden));
  id("shut").addEventListener("click", () => open(false));
  linkdyn.drawer = { get open() { return !side.hidden; }, set open(on) { open(on); } };
})();

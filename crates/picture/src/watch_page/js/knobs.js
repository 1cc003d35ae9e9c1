// A slider for each parameter. The newest value is computed, never a queue of older ones; a run that takes long is given up for it.
const knobs = (() => {
  const id = (name) => document.getElementById(name);
  const STEPS = 200, LONG = 250;
  const made = new Map();
  let generation = 0, busy = null, waiting = false;

  const element = (tag, given = {}, ...children) => { const node = Object.assign(document.createElement(tag), given); node.append(...children); return node; };
  const plain = (value) => String(Number(value.toPrecision(12)));
  const step = ({ least, most }) => {
    const rough = (most - least) / STEPS, power = 10 ** Math.floor(Math.log10(rough));
    return power * ([1, 2, 5, 10].find((part) => part * power >= rough * (1 - 1e-9)) || 10);
  };
  const post = (path, body, signal) => fetch(path, { method: "POST", body: JSON.stringify(body), signal });
  const turned = () => [...made.values()].filter((knob) => knob.now !== knob.value);
  const values = () => Object.fromEntries(turned().map((knob) => [knob.name, knob.now]));

  const write = (knob) => {
    const size = step(knob), on = knob.now !== knob.value;
    Object.assign(knob.slider, { min: Math.floor(knob.least / size), max: Math.ceil(knob.most / size) });
    knob.slider.value = Math.round(knob.now / size);
    knob.slider.setAttribute("aria-valuetext", `${plain(knob.now)} ${knob.unit}`);
    if (document.activeElement !== knob.field || !knob.typing) knob.field.value = plain(knob.now);
    knob.root.classList.toggle("turned", on);
    knob.root.title = on ? `${knob.name}: ${plain(knob.value)} ${knob.unit} in the file` : "";
    for (const name of ["back", "write"]) id(name).disabled = !turned().length;
  };
  const set = (knob, value) => {
    knob.now = value;
    [knob.least, knob.most] = [Math.min(knob.least, value), Math.max(knob.most, value)];
    knob.why.textContent = "";
    write(knob);
    run();
  };

  // One request at a time; what is turned meanwhile comes next.
  const run = () => {
    waiting = true;
    if (!busy) next();
    else if (performance.now() - busy.since > LONG) busy.stop.abort();
  };
  const next = async () => {
    if (!waiting || !shown) return;
    waiting = false;
    const own = busy = { since: performance.now(), stop: new AbortController() }, begun = generation;
    const late = setTimeout(() => { id("state").textContent = "computing …"; if (waiting) own.stop.abort(); }, LONG);
    try {
      const answer = await post("try", values(), own.stop.signal);
      const told = answer.status === 409 ? null : answer.status === 422 ? await answer.json() : await answer.text();
      if (told !== null && begun === generation) {
        if (answer.ok && !await give(told, turned().length > 0)) reload();
        say("values", answer.ok ? [] : [told].flat());
      }
    } catch (why) {
      if (why.name !== "AbortError") say("values", [`linkdyn does not answer: ${why.message}`]);
    }
    clearTimeout(late);
    busy = null;
    if (waiting) next(); else id("state").textContent = "";
  };

  const make = (given) => {
    const number = made.size, knob = { ...given, now: given.value, typing: false };
    knob.slider = element("input", { type: "range", step: 1, id: `knob${number}` });
    knob.field = element("input", { type: "text", autocomplete: "off", spellcheck: false });
    knob.field.setAttribute("aria-label", `${given.name}, value with or without a unit`);
    knob.why = element("span", { className: "why" });
    knob.root = element("div", { className: "knob" }, element("label", { htmlFor: `knob${number}`, textContent: given.name, title: given.name }),
      element("span", { className: "value" }, knob.field, element("span", { className: "unit", textContent: given.unit.replaceAll("*", "·").replaceAll("^2", "²") })), knob.slider, knob.why);
    knob.slider.addEventListener("input", () => {
      const value = Number(knob.slider.value) * step(knob);
      set(knob, Number(Math.min(Math.max(value, knob.least), knob.most).toPrecision(10)));
    });
    knob.field.addEventListener("input", () => { knob.typing = true; });
    knob.field.addEventListener("change", async () => {
      knob.typing = false;
      const answer = await post("read", { [knob.name]: knob.field.value }), told = await answer.json();
      if (answer.ok) set(knob, told); else knob.why.textContent = told.join("\n");
    });
    knob.field.addEventListener("keydown", ({ key }) => { if (key === "Escape") { knob.typing = false; knob.why.textContent = ""; write(knob); } });
    return knob;
  };

  // The parameters of the file that was saved.
  const saved = (list) => {
    generation++;
    waiting = false;
    const same = list.length === made.size && list.every(({ name, unit }) => made.get(name)?.unit === unit);
    if (!same) {
      made.clear();
      for (const given of list) made.set(given.name, make(given));
      id("list").replaceChildren(...[...made.values()].map(({ root }) => root));
    }
    for (const given of list) { const knob = made.get(given.name); Object.assign(knob, given, { now: given.value }); knob.why.textContent = ""; }
    made.forEach(write);
    id("knobs").hidden = !made.size;
  };
  id("back").addEventListener("click", () => { made.forEach((knob) => { knob.now = knob.value; knob.why.textContent = ""; }); made.forEach(write); run(); });
  id("write").addEventListener("click", async () => {
    const answer = await post("write", values());
    if (!answer.ok) say("values", await answer.json());
  });
  return { saved, made };
})();
look();

"use strict";
// All plots: what they are over, which part is in view, which of them take a column.
(() => {
  const { Plot, player, units, element, byName, mechanism, summary, choices, id } = linkdyn;
  const { shown, presets, first, oneScale } = choices;
  const MOST_COLUMNS = 6, MOST_MATCHES = 12;
  const cards = id("cards"), names = id("plotbar").appendChild(element("datalist", { id: "names" }));
  const drivers = mechanism.drivers.map(({ name }) => byName.get(`driver.${name}.value`)).filter(Boolean);
  const clock = { name: "time", label: "time", unit: "s", get values() { return linkdyn.time; } };
  const axes = [clock, ...drivers.map((column) => ({ name: column.name, unit: column.unit, label: linkdyn.plain(column.name.slice(7, -6)), get values() { return column.values; } }))];

  // Whether values only rise or only fall.
  const orderOf = (values) => {
    let [up, down] = [true, true];
    for (let k = 1; k < values.length; k++) {
      if (!(values[k] >= values[k - 1])) up = false;
      if (!(values[k] <= values[k - 1])) down = false;
    }
    return { monotone: up || down, reversed: !up && down };
  };

  const plots = {
    list: [], abscissa: clock, order: orderOf(linkdyn.time), zoom: null, cut: true, events: [], shown, tools: null, hover() {}, leave() {},

    range(xs) {
      const real = xs.filter((x) => x !== null);
      if (!real.length) return [0, 1];
      const [low, high] = real.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]);
      return high > low ? [low, high] : [low - 0.5, high + 0.5];
    },
    setZoom(zoom) {
      plots.zoom = zoom;
      id("unzoom").disabled = !zoom;
      for (const { u } of plots.list) if (u) u.setData(u.data, true);
      plots.mark();
    },
    // The row whose abscissa is nearest, and of several the one nearest to the row that is shown.
    nearest(value) {
      const { values } = plots.abscissa;
      if (plots.order.monotone && !plots.order.reversed && linkdyn.rows > 2) {
        const k = player.rowAt(value, values);
        return k + 1 < linkdyn.rows && Math.abs(values[k + 1] - value) < Math.abs(values[k] - value) ? k + 1 : k;
      }
      const [low, high] = plots.range(Array.from(values));
      return plots.closest([values, value, high - low]);
    },
    // The row nearest in several quantities, each [values, value, size]; a row near the one that is shown is a little nearer.
    closest(...quantities) {
      let [best, least] = [player.row, Infinity];
      for (let k = 0; k < linkdyn.rows; k++) {
        const away = Math.hypot(...quantities.map(([values, value, size]) => (values[k] - value) / size)) + 0.02 * Math.abs(k - player.row) / linkdyn.rows;
        if (away < least) [best, least] = [k, away];
      }
      return best;
    },
    // All that fit a pattern, the one that has the name, or the first that has it as a part.
    match(text) {
      const part = text.trim().toLowerCase();
      if (!part) return [];
      if (part.includes("*")) {
        const parts = part.split("*").map((piece) => piece.replace(/[.+?^${}()|[\]\\]/g, "\\$&"));
        const pattern = new RegExp(`^${parts.join(".*")}$`);
        return shown.filter((column) => pattern.test(column.name.toLowerCase())).slice(0, MOST_MATCHES);
      }
      const found = shown.find((column) => column.name === text.trim()) || shown.find((column) => column.name.toLowerCase() === part)
        || shown.find((column) => column.name.toLowerCase().startsWith(part)) || shown.find((column) => column.name.toLowerCase().includes(part));
      return found ? [found] : [];
    },
    suggest(text) {
      const part = text.trim().toLowerCase();
      const found = shown.filter((column) => column.name.toLowerCase().includes(part)).slice(0, 300);
      names.replaceChildren(...found.map((column) => element("option", { value: column.name })));
    },
    // Into a plot that takes it, else into a new one; the plot where it is.
    add(column, plot) {
      const has = plots.list.find((other) => !other.across && other.columns.includes(column));
      const target = plot && plot.takes(column) ? plot : has ? null : plots.list.find((other) => other !== plot && other.columns.length < MOST && other.units.includes(column.unit) && other.takes(column));
      if (target) { target.add(column); return target; }
      return has || plots.open([column]);
    },
    // Several at once: what fits into the plot, up to as many as can be distinguished, and the rest into new ones.
    addAll(list, plot) {
      const fitting = list.filter((column) => plot.takes(column)).slice(0, Math.max(MOST_COLUMNS - plot.columns.length, list.length === 1 ? 1 : 0));
      const kinds = new Set(plot.units);
      const taken = fitting.filter(({ unit }) => kinds.has(unit) || (kinds.size < 2 && kinds.add(unit)));
      if (taken.length) plot.add(...taken);
      let rest = list.filter((column) => !taken.includes(column) && !plot.columns.includes(column));
      while (rest.length) {
        const next = oneScale(rest);
        if (!next.length) return;
        plots.open(next);
        rest = rest.filter((column) => !next.includes(column));
      }
    },
    put(list, options) {
      const plot = new Plot(plots, [...list], options);
      plots.list.push(plot);
      cards.append(plot.root);
      plot.head();
      return plot;
    },
    open(list, options) {
      if (!list.length) return null;
      const plot = plots.put(list, options);
      plot.wake();
      return plot;
    },
    // Plots on the first screen are drawn at once; the others one by one, so that the page answers meanwhile.
    start() {
      const near = plots.list.filter(({ root }) => root.getBoundingClientRect().top < innerHeight);
      near.forEach((plot) => plot.wake());
      const next = () => { const plot = plots.list.find(({ awake }) => !awake); if (plot) { plot.wake(); setTimeout(next, 0); } };
      setTimeout(next, 20);
    },
    // Shows a plot that is there.
    point(plot) {
      plot.root.scrollIntoView({ block: "nearest" });
      plot.root.classList.remove("called");
      void plot.root.offsetWidth;
      plot.root.classList.add("called");
    },
    remove(plot) {
      if (plot.u) plot.u.destroy();
      plot.root.remove();
      plots.list = plots.list.filter((other) => other !== plot);
    },
    rebuild() { plots.list.forEach((plot) => plot.build()); },
    mark() { plots.list.forEach((plot) => plot.mark()); },
  };
  const MOST = 4;

  // Events on the abscissa that is chosen; their times are kept for the scrub bar and tables.
  const place = () => {
    const at = (instant) => plots.abscissa === clock ? instant : plots.abscissa.values[player.rowAt(instant)];
    const driver = plots.abscissa === clock ? null : plots.abscissa.name.slice(7, -6);
    plots.events = summary.events.map((event) => {
      const end = linkdyn.eventEnd(event);
      const exact = driver !== null && event.driver === driver;
      return { word: linkdyn.eventWord(event), low: linkdyn.ofContact(event), interval: end > event.time, from: exact && event.value !== undefined ? event.value : at(event.time), to: exact && event.end_value !== undefined ? event.end_value : at(end) };
    });
  };

  const choice = id("presets");
  choice.append(element("option", { text: "+ plot", value: "" }), ...presets.map(({ title }, k) => element("option", { text: title, value: k })));
  choice.addEventListener("change", () => {
    if (choice.value !== "") { const preset = presets[Number(choice.value)]; plots.point(plots.open(preset.list, preset)); }
    choice.value = "";
  });

  const across = id("abscissa");
  const over = (number) => {
    plots.abscissa = axes[number];
    plots.order = orderOf(plots.abscissa.values);
    across.value = number;
    place();
  };
  across.append(...axes.map(({ label }, k) => element("option", { text: label, value: k })));
  across.addEventListener("change", () => { over(Number(across.value)); plots.setZoom(null); plots.rebuild(); });
  id("unzoom").addEventListener("click", () => plots.setZoom(null));

  const cut = id("cut");
  cut.checked = plots.cut;
  id("cutting").hidden = !shown.some((column) => choices.lives(column) && linkdyn.cutOf(column).some((end) => end !== null));
  cut.addEventListener("change", () => { plots.cut = cut.checked; plots.setZoom(plots.zoom); });

  // An engineer reads over the crank's angle, where it goes one way.
  const value = linkdyn.rows > 1 && mechanism.drivers.length === 1 && drivers.length === 1 ? drivers[0].values : null;
  over(value && orderOf(value).monotone && value[0] !== value[linkdyn.rows - 1] ? 1 : 0);
  if (linkdyn.rows > 1) {
    first.forEach((preset) => plots.put(preset.list, preset));
    if (!first.length && shown.length) plots.put(oneScale(shown).slice(0, 3));
  }
  id("plots").hidden = linkdyn.rows < 2 || !shown.length;

  linkdyn.onData(() => {
    plots.order = orderOf(plots.abscissa.values);
    place();
    plots.list.forEach((plot) => plot.renew());
  });
  player.onRow(() => plots.list.forEach((plot) => { if (plot.seen) plot.mark(); }));
  units.onChange(() => { plots.zoom = null; id("unzoom").disabled = true; plots.rebuild(); });
  linkdyn.theme.onChange(() => plots.rebuild());
  linkdyn.plots = plots;
})();

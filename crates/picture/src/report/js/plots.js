"use strict";
// All plots: what they are over, which part is in view, which columns to begin with.
(() => {
  const { Plot, player, units, element, columns, byName, mechanism, summary, time, rows } = linkdyn;
  const cards = document.getElementById("cards"), names = document.getElementById("plotbar").appendChild(element("datalist", { id: "names" }));
  const shown = columns.filter((column) => column.wanted && column.name !== "time");
  const drivers = mechanism.drivers.map(({ name }) => byName.get(`driver.${name}.value`)).filter(Boolean);
  const clock = { name: "time", label: "time", unit: "s", values: time };
  const axes = [clock, ...drivers.map((column) => ({ ...column, label: linkdyn.plain(column.name.slice(7, -6)) }))];

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
    list: [], abscissa: clock, order: orderOf(time), zoom: null, cut: false, events: [], shown,

    range(xs) {
      const real = xs.filter((x) => x !== null);
      if (!real.length) return [0, 1];
      const [low, high] = real.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]);
      return high > low ? [low, high] : [low - 0.5, high + 0.5];
    },
    setZoom(zoom) {
      plots.zoom = zoom;
      document.getElementById("unzoom").disabled = !zoom;
      for (const { u } of plots.list) if (u) u.setData(u.data, true);
      plots.mark();
    },
    // The row whose abscissa is nearest, and of several the one nearest to the row that is shown.
    nearest(value) {
      const { values } = plots.abscissa;
      if (plots.order.monotone && !plots.order.reversed && rows > 2) {
        const k = plots.abscissa === clock ? player.rowAt(value) : lower(values, value);
        return k + 1 < rows && Math.abs(values[k + 1] - value) < Math.abs(values[k] - value) ? k + 1 : k;
      }
      let [best, least] = [player.row, Infinity];
      const [low, high] = plots.range(Array.from(values));
      for (let k = 0; k < rows; k++) {
        const away = Math.abs(values[k] - value) / (high - low) + 0.02 * Math.abs(k - player.row) / rows;
        if (away < least) [best, least] = [k, away];
      }
      return best;
    },
    find: (name) => shown.find((column) => column.name === name.trim()),
    suggest(text) {
      const part = text.trim().toLowerCase();
      const found = shown.filter((column) => column.name.toLowerCase().includes(part)).slice(0, 300);
      names.replaceChildren(...found.map((column) => element("option", { value: column.name })));
    },
    // Into a plot that takes it, else into a new one.
    add(column, plot) {
      const target = plot && plot.takes(column) ? plot : plots.list.find((other) => other !== plot && other.columns.length < 4 && other.units.includes(column.unit) && other.takes(column));
      if (target) target.add(column); else if (!plots.list.some((other) => other.columns.includes(column))) plots.open([column]);
    },
    open(list) {
      if (!list.length) return;
      const plot = new Plot(plots, [...list]);
      plots.list.push(plot);
      cards.append(plot.root);
      plot.head();
      plot.fit();
    },
    remove(plot) {
      if (plot.u) plot.u.destroy();
      plot.root.remove();
      plots.list = plots.list.filter((other) => other !== plot);
    },
    rebuild() { plots.list.forEach((plot) => plot.build()); },
    mark() { plots.list.forEach((plot) => plot.mark()); },
  };
  const lower = (values, value) => { let [a, b] = [0, rows - 1]; while (a < b) { const m = Math.ceil((a + b) / 2); if (values[m] <= value) a = m; else b = m - 1; } return a; };

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

  // What is worth a plot, by kind of quantity.
  const ending = (pattern, filter = () => true) => shown.filter((column) => pattern.test(column.name) && filter(column));
  const bodies = new Set(mechanism.bodies.map(({ name }) => name));
  const ofBody = (column) => bodies.has(column.name.split(".")[0]) && column.name.split(".").length === 2;
  const presets = [
    ["Driver efforts", ending(/^driver\..*\.effort$/)],
    ["Joint forces", ending(/^joint\..*\.f$/)],
    ["Transmission angles", ending(/^transmission\..*\.angle$/)],
    ["Velocity ratio, mechanical advantage", ending(/^transmission\.(ratio|advantage)$/)],
    ["Shaking force", ending(/^shaking\.(fx|fy|f)$/)],
    ["Shaking moment", ending(/^shaking\.moment$/)],
    ["Energies", ending(/^energy\./)],
    ["Angles of bodies", ending(/\.angle$/, ofBody)],
    ["Angular velocities", ending(/\.omega$/, ofBody)],
    ["Angular accelerations", ending(/\.alpha$/, ofBody)],
    ["Eccentricities", ending(/^joint\..*\.(eccentricity|ex|ey)$/)],
    ["Penetrations", ending(/^joint\..*\.penetration$/)],
    ["Contact forces", ending(/^joint\..*\.(normal|tangential)_force$/)],
    ["Points", ending(/\.[xy]$/, (column) => column.name.split(".").length === 3)],
    ["Applied forces", ending(/^force\..*\.(f|torque)$/)],
  ].filter(([, list]) => list.length).map(([title, list]) => [title, oneScale(list)]);

  // Columns that change, at most six, of at most two units.
  function oneScale(list) {
    const some = list.filter(({ values }) => values.some((value) => Number.isFinite(value)));
    const lively = some.filter(({ values }) => values.some((value) => Number.isFinite(value) && value !== 0));
    const kinds = [...new Set((lively.length ? lively : some).map(({ unit }) => unit))].slice(0, 2);
    return (lively.length ? lively : some).filter(({ unit }) => kinds.includes(unit)).slice(0, 6);
  }
  const filled = presets.filter(([, list]) => list.length);

  const choice = document.getElementById("presets");
  choice.append(element("option", { text: "a plot …", value: "" }), ...filled.map(([title], k) => element("option", { text: title, value: k })));
  choice.addEventListener("change", () => { if (choice.value !== "") plots.open(filled[Number(choice.value)][1]); choice.value = ""; });

  const across = document.getElementById("abscissa");
  across.append(...axes.map(({ label }, k) => element("option", { text: label, value: k })));
  across.addEventListener("change", () => {
    plots.abscissa = axes[Number(across.value)];
    plots.order = orderOf(plots.abscissa.values);
    plots.setZoom(null);
    place();
    plots.rebuild();
  });
  document.getElementById("unzoom").addEventListener("click", () => plots.setZoom(null));

  // Near singular positions peaks would hide all else.
  plots.cut = summary.events.some(({ type }) => type === "change_point" || type === "dead_centre");
  const cut = document.getElementById("cut");
  cut.checked = plots.cut;
  cut.addEventListener("change", () => { plots.cut = cut.checked; plots.setZoom(plots.zoom); });

  place();
  if (rows > 1) {
    filled.slice(0, 6).forEach(([, list]) => plots.open(list));
    if (!filled.length && shown.length) plots.open(oneScale(shown).slice(0, 3));
  }
  document.getElementById("plots").hidden = rows < 2 || !shown.length;

  player.onRow(() => plots.mark());
  units.onChange(() => { plots.zoom = null; document.getElementById("unzoom").disabled = true; plots.rebuild(); });
  linkdyn.theme.onChange(() => plots.rebuild());
  linkdyn.plots = plots;
})();

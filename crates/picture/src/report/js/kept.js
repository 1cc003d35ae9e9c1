"use strict";
// What a reader has chosen survives a new run: the page that shows the report of each run asks for it, and gives it to the next report
// in its address. Names that are not there any more are left out.
(() => {
  const { player, plots, stage, units, theme, byName, id } = linkdyn;
  const MOST = 60;
  const inputs = () => [...id("side").querySelectorAll("input, select")];
  const finite = (list, count) => Array.isArray(list) && list.length === count && list.every(Number.isFinite);

  // What a page shows that nobody has touched is not kept: the next run may have better to offer.
  const chosen = {
    plots: () => plots.list.map(({ columns, across, equal }) => [columns.map(({ name }) => name), across && across.name, equal]),
    drawer: () => inputs().map((input) => input.type === "checkbox" ? input.checked : input.value),
    instant: () => linkdyn.time[player.row],
    over: () => id("abscissa").selectedIndex,
  };
  const untouched = Object.fromEntries(Object.entries(chosen).map(([key, of]) => [key, JSON.stringify(of())]));
  const touched = () => Object.entries(chosen).map(([key, of]) => [key, of()]).filter(([key, now]) => JSON.stringify(now) !== untouched[key]);
  const state = () => ({
    ...Object.fromEntries(touched()), units: units.system, theme: theme.chosen, cut: plots.cut, zoom: plots.zoom,
    view: stage.view, speed: player.speed, playing: player.playing, scroll: scrollY,
  });

  // As if the reader did it.
  const set = (input, key, value, event = "change") => { if (input[key] !== value && !input.disabled) { input[key] = value; input.dispatchEvent(new Event(event)); } };
  const restore = (kept) => {
    if (["light", "dark"].includes(kept.theme)) theme.chosen = kept.theme;
    if (kept.units === "si") set(id("units"), "value", "si");
    if (kept.over < id("abscissa").length) set(id("abscissa"), "selectedIndex", kept.over);
    set(id("cut"), "checked", kept.cut !== false);
    if (Array.isArray(kept.plots)) {
      [...plots.list].forEach(plots.remove);
      for (const [names, across, equal] of kept.plots.slice(0, MOST)) {
        const columns = names.map((name) => byName.get(name)).filter(Boolean);
        if (columns.length && (!across || byName.has(across))) plots.put(columns, { across: across ? byName.get(across) : null, equal: Boolean(equal) });
      }
    }
    if (finite(kept.zoom, 2)) plots.setZoom(kept.zoom);
    const all = inputs();
    if (Array.isArray(kept.drawer) && kept.drawer.length === all.length) {
      all.forEach((input, k) => set(input, input.type === "checkbox" ? "checked" : "value", kept.drawer[k], input.type === "range" ? "input" : "change"));
    }
    if (finite(kept.view, 3)) stage.view = kept.view;
    if (kept.speed !== 1) set(id("speed"), "value", String(kept.speed));
    if (Number.isFinite(kept.instant)) player.seek(player.nearest(kept.instant));
    if (kept.playing === true) player.play();
    if (kept.scroll > 0) scrollTo(0, kept.scroll);
  };
  linkdyn.kept = { state, restore };
  const found = /^#kept=(.+)$/.exec(location.hash);
  if (found) try { restore(JSON.parse(decodeURIComponent(found[1]))); } catch (why) { console.info(`not all is kept: ${why.message}`); }

  // The page around this one has spoken: it hears of the theme, too.
  let around = null;
  const tell = () => { if (around) around.postMessage({ dark: theme.dark }, "*"); };
  theme.onChange(tell);
  if (parent !== window) addEventListener("message", ({ source, data }) => {
    if (source !== parent) return;
    if (!around) { around = source; tell(); }
    if (data === "linkdyn: what is chosen?") source.postMessage({ chosen: JSON.stringify(state()) }, "*");
    if (typeof data?.run === "string") {
      let taken = false;
      try { taken = linkdyn.renew(data.run, data.trying === true); } catch (why) { console.warn(`the page is made anew: ${why.message}`); }
      const done = () => setTimeout(() => source.postMessage({ taken, number: data.number }, "*"), 0);
      // Told when it is on the screen; behind other windows nothing is drawn.
      if (document.hidden) done(); else requestAnimationFrame(done);
    }
    if (typeof data?.dim === "boolean") document.body.classList.toggle("old", data.dim);
  });
})();

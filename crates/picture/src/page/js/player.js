"use strict";
// The instant that is shown. Every frame is a computed row, nothing in between is made up.
(() => {
  const { id, icon } = linkdyn;
  const listeners = [], stateListeners = [];
  let row = 0, playing = false, speed = 1, repeat = true, last = null, clock = 0;

  const end = () => Math.max(linkdyn.rows - 1, 0);
  const span = () => linkdyn.rows > 1 ? linkdyn.time[linkdyn.rows - 1] - linkdyn.time[0] : 0;
  // Seconds of the mechanism per second of the viewer: at speed 1 a motion takes a time in which one can see something.
  const rate = () => speed === "real" ? 1 : speed * span() / Math.min(Math.max(span(), 4), 12);
  const tell = () => stateListeners.forEach((listen) => listen());

  const seek = (wanted) => {
    const next = Math.min(Math.max(Math.round(wanted), 0), end());
    clock = span() > 0 ? linkdyn.time[next] - linkdyn.time[0] : 0;
    if (next === row) return;
    row = next;
    listeners.forEach((listen) => listen(row));
  };

  // The last row whose time is not later.
  const rowAt = (instant, values = linkdyn.time, rows = linkdyn.rows) => {
    let low = 0, high = Math.max(rows - 1, 0);
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (values[middle] <= instant) low = middle; else high = middle - 1;
    }
    return low;
  };
  // The row whose time is nearest.
  const nearest = (instant) => {
    const { time } = linkdyn, row = rowAt(instant);
    return row < end() && Math.abs(time[row + 1] - instant) < Math.abs(time[row] - instant) ? row + 1 : row;
  };

  const frame = () => {
    if (!playing) return;
    const now = performance.now();
    // A tab that slept does not jump.
    const passed = last === null ? 0 : Math.min((now - last) / 1000, 0.1);
    last = now;
    let shown = clock + passed * rate();
    if (shown >= span()) {
      if (!repeat) { seek(end()); pause(); return; }
      shown %= span();
    }
    seek(rowAt(linkdyn.time[0] + shown));
    clock = shown;
    requestAnimationFrame(frame);
  };
  const play = () => {
    if (playing || !(span() > 0)) return;
    if (row === end()) seek(0);
    playing = true;
    last = null;
    tell();
    requestAnimationFrame(frame);
  };
  const pause = () => { if (playing) { playing = false; tell(); } };
  const toggle = () => playing ? pause() : play();

  linkdyn.player = {
    seek, rowAt, nearest, play, pause, rate, toggle,
    // The same instant of another run; who listens to rows hears of the run itself.
    renew: (instant) => { row = nearest(instant); const inside = clock < span(); if (!playing || !inside) clock = span() > 0 ? linkdyn.time[row] - linkdyn.time[0] : 0; },
    step: (by) => { pause(); seek(row + by); },
    get row() { return row; },
    get playing() { return playing; },
    get speed() { return speed; },
    set speed(value) { speed = value; tell(); },
    get repeat() { return repeat; },
    set repeat(value) { repeat = value; },
    onRow: (listen) => listeners.push(listen),
    onState: (listen) => stateListeners.push(listen),
    offState: (listen) => { const at = stateListeners.indexOf(listen); if (at >= 0) stateListeners.splice(at, 1); },
  };

  // The button and the scrub bar.
  const scrub = id("scrub");
  scrub.addEventListener("input", () => { pause(); seek(Number(scrub.value)); });
  id("play").addEventListener("click", toggle);
  stateListeners.push(() => {
    id("play").replaceChildren(icon(playing ? "pause" : "play"));
    id("play").setAttribute("aria-pressed", playing);
    id("play").setAttribute("aria-label", playing ? "Pause" : "Play");
  });
  listeners.push(() => { scrub.value = row; });
})();

"use strict";
// The instant that is shown. Every frame is a computed row, nothing in between is made up.
(() => {
  const { rows, time } = linkdyn;
  const listeners = [];
  const stateListeners = [];
  // A run that ended early is opened where it is stuck.
  const early = !["completed", "completed_with_gaps"].includes(linkdyn.summary.status);
  let row = early ? Math.max(rows - 1, 0) : 0, playing = false, speed = 1, repeat = true;
  let last = null, clock = 0;

  const span = rows > 1 ? time[rows - 1] - time[0] : 0;
  // The whole run in a time in which one can see something.
  const duration = Math.min(Math.max(span, 4), 12);

  const seek = (wanted) => {
    const next = Math.min(Math.max(Math.round(wanted), 0), Math.max(rows - 1, 0));
    clock = span > 0 ? time[next] - time[0] : 0;
    if (next === row) return;
    row = next;
    listeners.forEach((listen) => listen(row));
  };

  // The last row whose time is not later.
  const rowAt = (instant) => {
    let low = 0, high = rows - 1;
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (time[middle] <= instant) low = middle; else high = middle - 1;
    }
    return low;
  };

  const frame = () => {
    if (!playing) return;
    const now = performance.now();
    // A tab that slept does not jump.
    const passed = last === null ? 0 : Math.min((now - last) / 1000, 0.1);
    last = now;
    let shown = clock + passed * rate();
    if (shown >= span) {
      if (!repeat) { seek(rows - 1); pause(); return; }
      shown %= span;
    }
    seek(rowAt(time[0] + shown));
    clock = shown;
    requestAnimationFrame(frame);
  };

  // Seconds of the mechanism per second of the viewer.
  const rate = () => speed === "real" ? 1 : speed * span / duration;

  const tell = () => stateListeners.forEach((listen) => listen());
  const play = () => {
    if (playing || !(span > 0)) return;
    if (row === rows - 1) seek(0);
    playing = true;
    last = null;
    tell();
    requestAnimationFrame(frame);
  };
  const pause = () => { if (playing) { playing = false; tell(); } };

  linkdyn.player = {
    seek, rowAt, play, pause, rate, span,
    toggle: () => playing ? pause() : play(),
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
})();

"use strict";
// Light or dark: as the system has it until the reader chooses; paper is light.
(() => {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const listeners = [];
  let chosen = null, paper = false;
  const tell = () => listeners.forEach((listen) => listen());
  system.addEventListener("change", tell);
  const { dataset } = document.documentElement;
  const settle = () => { const name = paper ? "light" : chosen; if (name) dataset.theme = name; else delete dataset.theme; tell(); };
  const choose = (name) => { chosen = name; settle(); };
  linkdyn.theme = {
    get dark() { return !paper && (chosen ? chosen === "dark" : system.matches); },
    get chosen() { return chosen; },
    set chosen(name) { choose(name); },
    toggle: () => choose(linkdyn.theme.dark ? "light" : "dark"),
    // While printing, and for pictures that are exported.
    set paper(on) { paper = on; settle(); },
    onChange: (listen) => listeners.push(listen),
  };

  // A colour of the style sheet as it is now, as a canvas needs it.
  const probe = document.body.appendChild(linkdyn.element("span", { hidden: "" }));
  linkdyn.colour = (name) => { probe.style.color = `var(--${name})`; return getComputedStyle(probe).color; };
  // The colour of a curve by its number.
  const { curves } = linkdyn.given.palette;
  linkdyn.tone = (k) => curves[k % curves.length][linkdyn.theme.dark ? "dark" : "light"];
})();

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
    toggle: () => choose(linkdyn.theme.dark ? "light" : "dark"),
    // While printing, and for pictures to take away.
    set paper(on) { paper = on; settle(); },
    onChange: (listen) => listeners.push(listen),
  };
})();

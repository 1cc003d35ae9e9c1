"use strict";
// Light or dark: as the system has it until the reader chooses; paper is light.
(() => {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const listeners = [];
  let chosen = null, paper = false;
  const tell = () => listeners.forEach((listen) => listen());
  system.addEventListener("change", tell);
  const choose = (name) => { chosen = name; document.documentElement.dataset.theme = name; tell(); };
  linkdyn.theme = {
    get dark() { return !paper && (chosen ? chosen === "dark" : system.matches); },
    toggle: () => choose(linkdyn.theme.dark ? "light" : "dark"),
    // While printing; the style sheet does the same by itself.
    set paper(on) { paper = on; tell(); },
    onChange: (listen) => listeners.push(listen),
  };
})();

// Makes a film of the run with the page's own button.
(async () => {
  const { exports, player } = linkdyn;
  // A browser that draws to no screen gives frames as it likes: here they come with the virtual time.
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
  await new Promise((done) => setTimeout(done, 300));
  player.seek(7);
  player.speed = 4;
  const shown = new Set();
  player.onRow((row) => shown.add(row));
  const button = [...document.querySelectorAll("#export button")].find(({ textContent }) => textContent === "Film");
  let given = null;
  document.addEventListener("click", ({ target }) => { if (target.download) given = target.download; }, true);
  const film = await exports.film(button), bytes = new Uint8Array(await film.arrayBuffer());
  const text = new TextDecoder("latin1").decode(bytes);
  // A cluster of blocks begins with this id, and so does each simple block.
  answer({ type: film.type, size: bytes.length, head: [...bytes.slice(0, 4)], webm: text.slice(0, 64).includes("webm"), video: text.includes("V_VP"),
    clusters: text.split("\u001fC\u00b6u").length - 1, shown: shown.size, row: player.row, repeats: player.repeat, word: button.textContent, given, requests: performance.getEntriesByType("resource").length });
})();

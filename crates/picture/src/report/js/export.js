"use strict";
// Export: plots and the drawing as SVG or PNG, columns as CSV, a film, a link to an instant.
(() => {
  const { element, plots, stage, player, theme, figure, SvgPen, summary, shapes, id } = linkdyn;
  const SHARP = 3;
  const plain = (text) => linkdyn.plain(text).replace(/[^\p{L}\p{N}._-]+/gu, "_").slice(0, 80) || "linkdyn";

  // Gives the reader a file.
  const give = (name, blob) => {
    const link = element("a", { href: URL.createObjectURL(blob), download: name });
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  };
  const text = (name, kind, content) => give(name, new Blob([content], { type: kind }));

  // Pictures are for paper: light.
  const onPaper = (draws) => {
    const was = theme.dark;
    if (was) theme.paper = true;
    try { return draws(); } finally { if (was) theme.paper = false; }
  };
  const paper = "#ffffff";
  const svg = ({ width, height }, draws) => onPaper(() => { const pen = new SvgPen(width, height); draws(pen); return pen.text(paper); });
  const png = ({ width, height }, draws) => onPaper(() => new Promise((done) => {
    const canvas = element("canvas");
    [canvas.width, canvas.height] = [Math.round(width * SHARP), Math.round(height * SHARP)];
    const pen = canvas.getContext("2d");
    pen.scale(SHARP, SHARP);
    pen.fillStyle = paper; pen.fillRect(0, 0, width, height);
    draws(pen);
    canvas.toBlob(done, "image/png");
  }));

  const title = plain(summary.model.name);
  const plotName = (plot) => `${title}-${plain(plot.columns.map(({ name }) => name).join("-")).slice(0, 60)}`;
  const plotSvg = (plot) => svg(figure.size(plot, new SvgPen(1, 1)), (pen) => figure.draw(plot, pen));
  const plotPng = (plot) => png(figure.size(plot, new SvgPen(1, 1)), (pen) => figure.draw(plot, pen));
  const poseDraws = (pen) => stage.pose(pen);
  const poseName = () => `${title}-${plain(linkdyn.units.number(linkdyn.time[player.row], 5))}s`;

  // A film of the whole run as it is played, in what the browser can record.
  const KINDS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];
  const kind = () => typeof MediaRecorder === "undefined" ? undefined : KINDS.find((kind) => MediaRecorder.isTypeSupported(kind));
  const film = (button) => new Promise((done) => {
    const { canvas } = stage, parts = [], type = kind(), before = [player.row, player.repeat];
    // A canvas has no ground of its own: the film gets one.
    const copy = element("canvas"), pen = copy.getContext("2d");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const paint = () => { pen.fillStyle = linkdyn.colour("card"); pen.fillRect(0, 0, copy.width, copy.height); pen.drawImage(canvas, 0, 0); };
    paint();
    const recorder = new MediaRecorder(copy.captureStream(60), { mimeType: type, videoBitsPerSecond: 6e6 });
    recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
    const word = button.textContent;
    const follow = () => { if (recorder.state !== "recording") return; paint(); requestAnimationFrame(follow); };
    const stop = () => { if (!player.playing && recorder.state === "recording") setTimeout(() => recorder.stop(), 120); };
    recorder.addEventListener("stop", () => {
      player.offState(stop);
      player.repeat = before[1];
      player.seek(before[0]);
      button.textContent = word;
      const blob = new Blob(parts, { type });
      give(`${title}.${type.includes("mp4") ? "mp4" : "webm"}`, blob);
      done(blob);
    });
    button.textContent = "Recording …";
    player.pause(); player.seek(0); player.repeat = false;
    recorder.start(250);
    player.onState(stop);
    requestAnimationFrame(follow);
    player.play();
  });

  // Of each plot.
  const OF_PLOT = [["SVG", (plot) => text(`${plotName(plot)}.svg`, "image/svg+xml", plotSvg(plot))],
    ["PNG", async (plot) => give(`${plotName(plot)}.png`, await plotPng(plot))],
    ["CSV", (plot) => text(`${plotName(plot)}.csv`, "text/csv", figure.csv(plot))]];
  plots.tools = (plot) => {
    const menu = element("select", { className: "save", title: "Export this plot", "aria-label": "Export this plot" },
      element("option", { text: "export", value: "" }), ...OF_PLOT.map(([name], k) => element("option", { text: name, value: k })));
    menu.addEventListener("change", () => { if (menu.value !== "" && plot.u) OF_PLOT[Number(menu.value)][1](plot); menu.value = ""; });
    return menu;
  };
  plots.list.forEach((plot) => plot.head());

  // A link to an instant: #t=SECONDS.
  const hash = () => `#t=${Number(linkdyn.time[player.row].toPrecision(8))}`;
  const go = () => {
    const found = /^#t=([-+.\deE]+)$/.exec(location.hash), instant = found ? Number(found[1]) : NaN;
    if (Number.isFinite(instant) && linkdyn.rows) player.seek(player.nearest(instant));
  };
  const link = (button) => {
    location.hash = hash();
    const said = (word) => { const before = "Link to this instant"; button.textContent = word; setTimeout(() => { button.textContent = before; }, 1500); };
    if (navigator.clipboard) navigator.clipboard.writeText(location.href).then(() => said("Copied"), () => said("See the address bar")); else said("See the address bar");
  };

  // Of the drawing.
  const button = (word, title, act) => { const made = element("button", { type: "button", text: word, title, on: { click: () => act(made) } }); id("export").append(made); };
  if (linkdyn.rows && shapes.known) {
    button("Drawing SVG", "The mechanism as it is shown, as lines", () => text(`${poseName()}.svg`, "image/svg+xml", svg(stage.size, poseDraws)));
    button("Drawing PNG", "The mechanism as it is shown, as pixels", async () => give(`${poseName()}.png`, await png(stage.size, poseDraws)));
    if (linkdyn.rows > 1 && kind()) button("Film", "The whole run, at the chosen speed", (made) => film(made));
  }
  if (linkdyn.rows) {
    const all = () => { const plot = { abscissa: { name: "time", unit: "s", values: linkdyn.time }, zoom: null, columns: [...new Set(plots.list.flatMap(({ columns, across }) => across ? [across, ...columns] : columns))] }; return figure.csv(plot); };
    button("CSV", "The columns of all plots", () => text(`${title}.csv`, "text/csv", all()));
    button("Link to this instant", "A link that opens this page at the instant shown", link);
  }
  id("export").hidden = !linkdyn.rows;
  addEventListener("hashchange", go);
  go();
  linkdyn.exports = { plotSvg, plotPng, poseSvg: () => svg(stage.size, poseDraws), csv: figure.csv, film, hash };
})();

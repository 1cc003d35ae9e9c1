"use strict";
// Joints with clearance, magnified: bearing and journal, the path of the journal's centre. The journal is drawn so that the
// radial clearance is a fifth of the bearing.
(() => {
  const { mechanism, player, units, column, rows, element, drawing } = linkdyn;
  const SIZE = 112, BEARING = 46, GAP = 11;
  const insets = mechanism.joints
    .filter(({ clearance }) => clearance && clearance.radius > 0)
    .map(({ name, clearance }) => ({ name, radius: clearance.radius, ex: column(`joint.${name}.ex`), ey: column(`joint.${name}.ey`) }))
    .filter(({ ex, ey }) => ex && ey)
    .slice(0, 24);

  for (const inset of insets) {
    const canvas = element("canvas", { role: "img", "aria-label": `Journal in the bearing of joint ${linkdyn.plain(inset.name)}` });
    const ratio = window.devicePixelRatio || 1;
    canvas.width = canvas.height = SIZE * ratio;
    inset.pen = canvas.getContext("2d");
    inset.pen.scale(ratio, ratio);
    inset.value = element("span", { className: "number" });
    const caption = element("figcaption", {}, element("span", { text: inset.name, className: "text" }), " ", inset.value);
    document.getElementById("insets").append(element("figure", { className: "inset" }, canvas, caption));
  }
  document.getElementById("clearance").hidden = insets.length === 0;

  const draw = () => {
    if (!insets.length) return;
    const colours = drawing.palette(), row = player.row;
    for (const { pen, radius, ex, ey, value } of insets) {
      const at = (k) => [SIZE / 2 + ex.values[k] / radius * GAP, SIZE / 2 - ey.values[k] / radius * GAP];
      pen.clearRect(0, 0, SIZE, SIZE);
      pen.fillStyle = colours.line;
      pen.beginPath(); pen.arc(SIZE / 2, SIZE / 2, BEARING + 7, 0, 2 * Math.PI); pen.arc(SIZE / 2, SIZE / 2, BEARING, 0, 2 * Math.PI, true); pen.fill("evenodd");
      pen.strokeStyle = colours.steel; pen.lineWidth = 1.4;
      pen.beginPath(); pen.arc(SIZE / 2, SIZE / 2, BEARING, 0, 7); pen.stroke();
      const e = Math.hypot(ex.values[row], ey.values[row]);
      if (Number.isFinite(e)) {
        // On the bearing, to the eye: contact.
        const touches = e > radius * (1 - 1e-6);
        pen.fillStyle = touches ? colours.force : colours.accent;
        pen.globalAlpha = 0.28;
        pen.beginPath(); pen.arc(...at(row), BEARING - GAP, 0, 7); pen.fill();
        pen.globalAlpha = 1;
        pen.strokeStyle = touches ? colours.force : colours.accent;
        pen.stroke();
      }
      pen.strokeStyle = colours.muted; pen.lineWidth = 1;
      pen.beginPath();
      let down = false;
      for (let k = 0; k < rows; k++) {
        const p = at(k);
        if (!p.every(Number.isFinite)) { down = false; continue; }
        if (down) pen.lineTo(...p); else pen.moveTo(...p);
        down = true;
      }
      pen.stroke();
      if (Number.isFinite(e)) { pen.fillStyle = colours.ink; pen.beginPath(); pen.arc(...at(row), 2.6, 0, 7); pen.fill(); }
      value.textContent = units.quantity(e, "m", 3);
    }
  };
  player.onRow(draw);
  units.onChange(draw);
  linkdyn.clearance = { draw };
})();

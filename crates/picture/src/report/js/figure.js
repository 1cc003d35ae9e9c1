"use strict";
// A plot on any pen, with a legend, as it stands in a document: ticks, curves, events and peaks from the plot on the screen.
(() => {
  const { units, axes, dashes, tone, colour, plotMarks } = linkdyn;
  const LINE = 18;

  // Names of the curves in rows; returns their height.
  const legend = (pen, plot, left, width, draw) => {
    let [x, row] = [left, 0];
    pen.font = axes.FONT; pen.textBaseline = "middle"; pen.textAlign = "left";
    plot.columns.forEach((column, k) => {
      const text = linkdyn.plain(column.name), wide = 34 + pen.measureText(text).width;
      if (x > left && x + wide > width - 8) { x = left; row++; }
      const y = 12 + row * LINE;
      if (draw) {
        pen.strokeStyle = tone(k); pen.lineWidth = 2; pen.setLineDash(dashes(k));
        pen.beginPath(); pen.moveTo(x, y); pen.lineTo(x + 24, y); pen.stroke(); pen.setLineDash([]);
        pen.fillStyle = colour("ink"); pen.fillText(text, x + 29, y);
      }
      x += wide + 14;
    });
    return (row + 1) * LINE + 4;
  };

  // Ticks and labels as uPlot has laid them out; `at` turns a value of a scale into a place.
  const drawAxes = (pen, plot, frame, at) => {
    const { u } = plot;
    pen.font = axes.FONT; pen.strokeStyle = colour("grid"); pen.lineWidth = 1;
    u.axes.forEach((axis, k) => {
      const texts = axis._values || [], far = axis.side === 1;
      pen.fillStyle = k === 0 ? colour("muted") : plot.ink(axis.scale);
      (axis._splits || []).forEach((value, number) => {
        if (value === null || !texts[number]) return;
        const place = at(value, axis.scale);
        pen.beginPath();
        if (k === 0) {
          pen.moveTo(place, frame.top); pen.lineTo(place, frame.top + frame.height + 4);
          pen.textAlign = "center"; pen.textBaseline = "top"; pen.fillText(texts[number], place, frame.top + frame.height + 7);
        } else {
          if (k === 1) { pen.moveTo(frame.left - 4, place); pen.lineTo(frame.left + frame.width, place); }
          pen.textAlign = far ? "left" : "right"; pen.textBaseline = "middle"; pen.fillText(texts[number], far ? frame.left + frame.width + 7 : frame.left - 7, place);
        }
        pen.stroke();
      });
      pen.textAlign = "center";
      if (k === 0) { pen.textBaseline = "bottom"; pen.fillText(axis.label, frame.left + frame.width / 2, frame.top + frame.height + 40); return; }
      pen.save();
      pen.translate(far ? plot.width - 6 : 12, frame.top + frame.height / 2); pen.rotate(-Math.PI / 2); pen.textBaseline = "middle";
      pen.fillText(axis.label, 0, 0);
      pen.restore();
    });
  };

  // Draws the plot; its size, without drawing, where there is no pen.
  const size = (plot, pen) => { const top = legend(pen, plot, 12, plot.width, false); return { width: plot.width, height: plot.height + top, top }; };
  const draw = (plot, pen) => {
    const { u } = plot, ratio = devicePixelRatio, { top } = size(plot, pen);
    const frame = { left: u.bbox.left / ratio, top: u.bbox.top / ratio + top, width: u.bbox.width / ratio, height: u.bbox.height / ratio };
    const at = (value, scale) => u.valToPos(value, scale) + (scale === "x" ? frame.left : frame.top);
    legend(pen, plot, 12, plot.width, true);
    drawAxes(pen, plot, frame, at);
    // Marks think in the pixels of a canvas.
    const u2 = { bbox: frame, ctx: pen, data: u.data, scales: u.scales, valToPos: at };
    plotMarks.events(plot, u2, 1);
    pen.save();
    pen.beginPath(); pen.rect(frame.left, frame.top, frame.width, frame.height); pen.clip();
    plot.columns.forEach((column, k) => {
      pen.strokeStyle = tone(k); pen.lineWidth = 1.7; pen.lineJoin = "round"; pen.setLineDash(dashes(k));
      pen.beginPath();
      let down = false;
      for (const row of plot.inView(u.data)) {
        const [x, y] = [u.data[0][row], u.data[k + 1][row]];
        if (y === null) { down = false; continue; }
        // Far outside the frame a line is still a line.
        const place = [at(x, "x"), Math.min(Math.max(at(y, plot.scale(column)), -1e5), 1e5)];
        if (down) pen.lineTo(...place); else pen.moveTo(...place);
        down = true;
      }
      pen.stroke();
    });
    pen.setLineDash([]);
    pen.restore();
    plotMarks.words(plot, u2, 1);
  };

  // The rows in view as CSV, in the units that are shown.
  const csv = (plot) => {
    const cell = (text) => /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
    const { abscissa } = plot, shown = [...(abscissa.name === "time" ? [] : [{ name: "time", unit: "s", values: linkdyn.time }]), abscissa, ...plot.columns];
    const head = shown.map(({ name, unit }) => cell(`${linkdyn.plain(name)}[${units.of(unit).label === "–" ? "1" : units.of(unit).label}]`)).join(",");
    const factor = units.of(abscissa.unit).factor, { zoom } = plot, lines = [head];
    for (let row = 0; row < linkdyn.rows; row++) {
      const x = abscissa.values[row] * factor;
      if (zoom && (x < zoom[0] || x > zoom[1])) continue;
      lines.push(shown.map(({ values, unit }) => Number.isFinite(values[row]) ? String(Number((values[row] * units.of(unit).factor).toPrecision(15))) : "").join(","));
    }
    return `${lines.join("\n")}\n`;
  };

  linkdyn.figure = { size, draw, csv };
})();

"use strict";
// Bending moments along links with a cross-section, on the side that they stretch, all to one scale; the largest of a link has its value.
(() => {
  const { mechanism, shapes, drawing, units, byName, endsOf } = linkdyn;
  const links = mechanism.bodies.flatMap(({ name, section }, body) => {
    const stations = [], station = () => section && byName.get(`section.${name}.bending_moment_${stations.length + 1}`);
    for (let column = station(); column; column = station()) stations.push(column);
    return stations.length > 1 ? [{ name, ends: section.map((point) => [body, point]), stations }] : [];
  });
  let most;
  linkdyn.onData(() => { most = undefined; });
  const largest = () => most ??= Math.max(0, ...links.flatMap(({ stations }) => stations.flatMap(endsOf)).filter(Number.isFinite).map(Math.abs));

  const draw = ({ pen, to, row, width, height, colours, names }) => {
    const long = Math.min(width, height) * 0.15 / largest();
    if (Number.isFinite(long)) for (const { name, ends, stations } of links) {
      const places = ends.map((end) => shapes.place(end, row)), moments = stations.map(({ values }) => values[row]);
      if (!places.every(Boolean) || !moments.every(Number.isFinite)) continue;
      const [from, end] = places.map(to), along = [end[0] - from[0], end[1] - from[1]], length = Math.hypot(...along);
      if (!(length > 0)) continue;
      const at = (k) => {
        const part = k / (moments.length - 1), by = moments[k] * long / length;
        return [from[0] + along[0] * part - along[1] * by, from[1] + along[1] * part + along[0] * by];
      };
      drawing.path(pen, [from, ...moments.map((_, k) => at(k)), end]);
      pen.fillStyle = pen.strokeStyle = colours.force; pen.lineWidth = 1.4;
      pen.globalAlpha = 0.18; pen.fill(); pen.globalAlpha = 1; pen.stroke();
      const k = moments.reduce((best, moment, k) => Math.abs(moment) > Math.abs(moments[best]) ? k : best, 0);
      if (Math.abs(moments[k]) > 1e-9 * most) names.push({ text: units.quantity(moments[k], "N*m", 3), at: at(k), colour: colours.force, beside: 2, key: `moment ${name}` });
    }
  };

  linkdyn.moments = { draw, has: links.length > 0 };
})();

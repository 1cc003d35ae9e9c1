// Where the parts of symbols are drawn, in millimetres: the drawing on a pen that takes notes instead of ink.
(() => {
  const { drawing, shapes, mechanism, rows, column } = linkdyn;
  const BAR = 7;
  const strokes = (row) => {
    const all = [];
    let points = [];
    const nothing = () => {};
    const pen = {
      beginPath() { points = []; }, moveTo(x, y) { points.push([x, y]); }, lineTo(x, y) { points.push([x, y]); }, stroke() { all.push(points); },
      globalAlpha: 1, arc: nothing, closePath: nothing, fill: nothing, fillRect: nothing, setLineDash: nothing,
    };
    drawing.draw(pen, { to: ([x, y]) => [x * 1000, -y * 1000], scale: 1000, bar: BAR, row, colours: drawing.palette(), show: {} });
    return all;
  };
  const far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
  const middle = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  const point = (body, name, row) => {
    const k = mechanism.bodies.findIndex((found) => found.name === body);
    const [x, y] = shapes.place([k, mechanism.bodies[k].points.findIndex(([found]) => found === name)], row);
    return [x * 1000, -y * 1000];
  };
  answer([0, rows - 1].map((row) => {
    const all = strokes(row);
    // A box along the axis, told by its width: barrel and rod.
    const box = (wide) => all.filter((path) => path.length === 4 && Math.abs(far(path[0], path[3]) - 2 * wide * BAR) < 1e-6);
    const [barrels, rods] = [box(1.7), box(0.56)], [barrel, rod] = [barrels[0], rods[0]];
    const foot = point("tube", "foot", row), [base, end] = [middle(barrel[0], barrel[3]), middle(barrel[1], barrel[2])];
    const [inner, tip] = [middle(rod[0], rod[3]), middle(rod[1], rod[2])];
    const coils = all.filter((path) => path.length === 61), hinge = point("arm", "hinge", row);
    const angles = coils[0].map(([x, y]) => Math.atan2(-(y - hinge[1]), x - hinge[0])), radii = coils[0].map((at) => far(at, hinge));
    const turned = angles.slice(1).reduce((sum, angle, k) => sum + Math.atan2(Math.sin(angle - angles[k]), Math.cos(angle - angles[k])), 0);
    return {
      barrels: barrels.length, rods: rods.length, coils: coils.length,
      foot_to_base: far(foot, base), tip_to_eye: far(tip, point("rod", "eye", row)), barrel: far(base, end), inner: far(foot, inner), tip: far(foot, tip),
      inner_radius: Math.min(...radii), outer_radius: Math.max(...radii), turned,
      outer_end: Math.cos(angles[60] - column("arm.angle").values[row]), inner_end: Math.cos(angles[0]),
    };
  }));
})();

"use strict";
// Where bodies and points are at a row, in metres and global axes.
// Measured again where another motion is shown.
linkdyn.measureShapes = ({ mechanism, rows, column, given } = linkdyn) => {

  const poses = mechanism.bodies.map(({ name }, k) => {
    if (k === 0) return null;
    const found = ["x", "y", "angle"].map((quantity) => column(`${name}.${quantity}`));
    return found.every(Boolean) ? found.map((found) => found.values) : undefined;
  });
  // Whether the poses are in the page at all.
  const known = mechanism.bodies.length > 1 && poses.slice(1).every(Boolean);

  // Pose of a body in a row; null if the cells are empty.
  // Where a hand has put the bodies, whatever the row; none while there is none.
  const pose = (body, row) => {
    if (body === 0) return [0, 0, 0];
    if (shapes.posed) return shapes.posed[body - 1];
    const of = poses[body];
    if (!of || row >= rows) return null;
    const found = [of[0][row], of[1][row], of[2][row]];
    return found.every(Number.isFinite) ? found : null;
  };

  const carry = ([x, y, angle], px, py) => {
    const c = Math.cos(angle), s = Math.sin(angle);
    return [x + c * px - s * py, y + s * px + c * py];
  };
  const turn = ([, , angle], vx, vy) => carry([0, 0, angle], vx, vy);

  // A point (body, number) in a row.
  const place = ([body, number], row) => {
    const at = shapes.pose(body, row), point = mechanism.bodies[body].points[number];
    return at && point ? carry(at, point[1], point[2]) : null;
  };
  // Corners of the hull of a body.
  const hull = (body, row) => (given.drawing.hulls[body] || []).map((number) => shapes.place([body, number], row));

  const shapes = { posed: null, known, pose, place, carry, turn, hull };
  return shapes;
};
linkdyn.shapes = linkdyn.measureShapes();

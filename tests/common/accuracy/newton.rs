//! Positions of a mechanism with gaps in its joints, by Newton's method on equations of its own: nothing of the engine.

use linkdyn_model::{DriverKind, GROUND, JointKind, Measured, Model, PointRef};

/// A mechanism at one position of its drivers.
pub struct Newton<'m> {
    pub model: &'m Model,
    bodies: Vec<&'m str>,
    joints: Vec<Joint>,
    drivers: Vec<Driver>,
}

/// What is off: two gaps by joint, one by driver.
pub struct Gaps {
    pub joints: Vec<[f64; 2]>,
    pub drivers: Vec<f64>,
}

/// A point of a body, by the body's number; none of the ground.
struct End {
    body: Option<usize>,
    own: [f64; 2],
}

struct Joint {
    ends: [End; 2],
    kind: Kind,
}

enum Kind {
    Revolute,
    /// Unit vector along the guide, and the angle that is held.
    Prismatic([f64; 2], f64),
    Slot([f64; 2]),
    Fixed(f64),
    Gear {
        ratio: f64,
        mesh: f64,
        /// In the carrier, over its length's square.
        line: [f64; 2],
        carrier: Option<usize>,
    },
}

enum Driver {
    /// Angle of a body relative to another.
    Rotation(Option<usize>, Option<usize>),
    /// Along the guide of a joint, a unit vector.
    Translation(usize, [f64; 2]),
}

fn turn([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    [x / x.hypot(y), y / x.hypot(y)]
}

fn frame(body: Option<usize>, q: &[[f64; 3]]) -> [f64; 3] {
    body.map_or([0.0; 3], |body| q[body])
}

fn place(end: &End, q: &[[f64; 3]]) -> [f64; 2] {
    let [x, y, angle] = frame(end.body, q);
    let [u, v] = turn(end.own, angle);
    [x + u, y + v]
}

impl<'m> Newton<'m> {
    /// Of a model whose bodies stand at `start` (x, y, angle) without gaps.
    pub fn new(model: &'m Model, start: &[[f64; 3]]) -> Self {
        let names = model.bodies.keys().map(String::as_str);
        let mut newton = Newton {
            model,
            bodies: names.filter(|name| *name != GROUND).collect(),
            joints: Vec::new(),
            drivers: Vec::new(),
        };
        for (name, joint) in &model.joints {
            let ends = [0, 1].map(|k: usize| newton.end(&joint.between[k]));
            let kind = match &joint.kind {
                JointKind::Revolute { .. } => Kind::Revolute,
                JointKind::Prismatic { axis, angle, .. } => Kind::Prismatic(unit(*axis), *angle),
                JointKind::Slot { axis, .. } => Kind::Slot(unit(*axis)),
                JointKind::Fixed { angle } => Kind::Fixed(*angle),
                // Free to go.
                JointKind::Contact { .. } => continue,
                JointKind::Gear { ratio, angle, .. } => {
                    let carrier = model.carrier(name, joint).expect("a gear");
                    let carrier = carrier.expect("a carrier").body.to_owned();
                    let drawn = |body: &str| match body {
                        GROUND => 0.0,
                        body => model.bodies[body].pose.angle,
                    };
                    let [first, second] =
                        [0, 1].map(|k: usize| drawn(&joint.between[k].body) - drawn(&carrier));
                    let carrier = newton.number(&carrier);
                    let span = minus(place(&ends[1], start), place(&ends[0], start));
                    let line = turn(span, -frame(carrier, start)[2]);
                    Kind::Gear {
                        ratio: *ratio,
                        mesh: angle.unwrap_or(second - ratio * first),
                        line: line.map(|part| part / dot(line, line)),
                        carrier,
                    }
                }
                kind => panic!("accuracy has no {}", kind.word()),
            };
            newton.joints.push(Joint { ends, kind });
        }
        for driver in model.drivers.values() {
            newton.drivers.push(match &driver.kind {
                DriverKind::Rotation { body, relative_to } => Driver::Rotation(
                    newton.number(body),
                    relative_to.as_deref().and_then(|to| newton.number(to)),
                ),
                DriverKind::Length { .. } | DriverKind::Point { .. } => panic!("accuracy has none"),
                DriverKind::Translation { joint } => {
                    let index = model.joints.get_index_of(joint).expect("a joint");
                    match &newton.joints[index].kind {
                        Kind::Prismatic(axis, _) | Kind::Slot(axis) => {
                            Driver::Translation(index, *axis)
                        }
                        Kind::Revolute | Kind::Fixed(_) | Kind::Gear { .. } => panic!("no guide"),
                    }
                }
            });
        }
        newton
    }

    fn number(&self, body: &str) -> Option<usize> {
        self.bodies.iter().position(|own| *own == body)
    }

    fn end(&self, point: &PointRef) -> End {
        End {
            body: self.number(&point.body),
            own: self.model.bodies[&point.body].points[&point.point],
        }
    }

    /// What the equations lack.
    fn lack(&self, drive: &[f64], gaps: &Gaps, q: &[[f64; 3]]) -> Vec<f64> {
        let mut rows = Vec::with_capacity(3 * q.len());
        for (joint, [e, f]) in self.joints.iter().zip(&gaps.joints) {
            let [first, second] = &joint.ends;
            let d = minus(place(second, q), place(first, q));
            let [a, b] = [first, second].map(|end| frame(end.body, q)[2]);
            let across = |axis: [f64; 2]| {
                let [x, y] = turn(axis, a);
                dot([-y, x], d)
            };
            match &joint.kind {
                Kind::Revolute => rows.extend([d[0] + e, d[1] + f]),
                Kind::Prismatic(axis, angle) => {
                    rows.extend([across(*axis) + e, b - a - angle + f]);
                }
                Kind::Slot(axis) => rows.push(across(*axis) + e),
                Kind::Fixed(angle) => rows.extend([d[0], d[1], b - a - angle]),
                Kind::Gear {
                    ratio,
                    mesh,
                    line,
                    carrier,
                } => {
                    let c = frame(*carrier, q)[2];
                    let [x, y] = turn(*line, c);
                    let leaned = c + dot([-y, x], d);
                    rows.push(mesh + ratio * a + (1.0 - ratio) * leaned - b + e);
                }
            }
        }
        for (index, driver) in self.drivers.iter().enumerate() {
            let value = match *driver {
                Driver::Rotation(body, to) => frame(body, q)[2] - frame(to, q)[2],
                Driver::Translation(joint, axis) => {
                    let [first, second] = &self.joints[joint].ends;
                    let d = minus(place(second, q), place(first, q));
                    dot(turn(axis, frame(first.body, q)[2]), d)
                }
            };
            rows.push(value - drive[index] - gaps.drivers[index]);
        }
        rows
    }

    /// Where the bodies are; none where the corrections do not settle.
    pub fn solve(&self, drive: &[f64], gaps: &Gaps, start: &[[f64; 3]]) -> Option<Vec<[f64; 3]>> {
        const DIFFERENCE: f64 = 1e-7;
        let (mut q, mut last) = (start.to_vec(), f64::INFINITY);
        let n = 3 * q.len();
        for _ in 0..40 {
            let lack = self.lack(drive, gaps, &q);
            let mut rows: Vec<Vec<f64>> = lack.iter().map(|lack| vec![-lack]).collect();
            for column in (0..n).rev() {
                let mut moved = q.clone();
                moved[column / 3][column % 3] += DIFFERENCE;
                let there = self.lack(drive, gaps, &moved);
                for ((row, there), here) in rows.iter_mut().zip(there).zip(&lack) {
                    row.push((there - here) / DIFFERENCE);
                }
            }
            rows.iter_mut().for_each(|row| row.reverse());
            let step = eliminate(rows)?;
            for (column, step) in step.iter().enumerate() {
                q[column / 3][column % 3] += step;
            }
            let size = step.iter().map(|s| s.abs()).fold(0.0, f64::max);
            if size < 1e-15 || (size < 1e-12 && size > 0.3 * last) {
                return Some(q);
            }
            last = size;
        }
        None
    }

    /// The value of an output.
    pub fn value(&self, of: &Measured, q: &[[f64; 3]]) -> f64 {
        match of {
            Measured::Distance([from, to]) => {
                let [from, to] = [from, to].map(|point| place(&self.end(point), q));
                let [x, y] = minus(to, from);
                x.hypot(y)
            }
            Measured::Column(column) => {
                let parts: Vec<&str> = column.split('.').collect();
                match parts[..] {
                    [body, "x"] => frame(self.number(body), q)[0],
                    [body, "y"] => frame(self.number(body), q)[1],
                    [body, "angle"] => frame(self.number(body), q)[2],
                    [body, point, axis] => {
                        let (body, point) = (body.to_owned(), point.to_owned());
                        place(&self.end(&PointRef { body, point }), q)[usize::from(axis == "y")]
                    }
                    _ => panic!("{column}"),
                }
            }
        }
    }
}

/// Solves rows [A | b] by elimination with pivots.
fn eliminate(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs()))?;
        rows.swap(k, pivot);
        let own = rows[k].clone();
        if own[k] == 0.0 {
            return None;
        }
        for row in &mut rows[k + 1..] {
            let by = row[k] / own[k];
            if by != 0.0 {
                (k..=n).for_each(|column| row[column] -= by * own[column]);
            }
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

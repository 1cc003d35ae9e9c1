//! Positions of a mechanism with gaps in its joints, by Newton's method on equations of its own: nothing of the engine.

use linkdyn_model::{DriverKind, GROUND, JointKind, Measured, Model, PointRef};

/// A mechanism at one position of its drivers.
pub struct Newton<'m> {
    pub model: &'m Model,
    bodies: Vec<&'m str>,
    gears: Vec<Option<Mesh>>,
}

/// Of a gear: line of centres in the carrier and its length, angle of the mesh, name of the carrier.
type Mesh = ([f64; 2], f64, f64, String);

/// What is off: two gaps by joint, one by driver.
pub struct Gaps {
    pub joints: Vec<[f64; 2]>,
    pub drivers: Vec<f64>,
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

impl<'m> Newton<'m> {
    /// Of a model whose bodies stand at `start` (x, y, angle) without gaps.
    pub fn new(model: &'m Model, start: &[[f64; 3]]) -> Self {
        let names = model.bodies.keys().map(String::as_str);
        let bodies = names.filter(|name| *name != GROUND).collect();
        let mut newton = Newton {
            model,
            bodies,
            gears: Vec::new(),
        };
        let mut gears = Vec::new();
        for (name, joint) in &model.joints {
            gears.push(match &joint.kind {
                JointKind::Gear { ratio, angle, .. } => {
                    let carrier = model.carrier(name, joint).expect("a gear");
                    let carrier = carrier.expect("a carrier").body.to_owned();
                    let drawn = |body: &str| match body {
                        GROUND => 0.0,
                        body => model.bodies[body].pose.angle,
                    };
                    let [first, second] =
                        [0, 1].map(|k: usize| drawn(&joint.between[k].body) - drawn(&carrier));
                    let mesh = angle.unwrap_or(second - ratio * first);
                    let [from, to] = [0, 1].map(|k: usize| newton.place(&joint.between[k], start));
                    let line = turn(minus(to, from), -newton.frame(&carrier, start)[2]);
                    Some((line, dot(line, line).sqrt(), mesh, carrier))
                }
                JointKind::Revolute { .. }
                | JointKind::Prismatic { .. }
                | JointKind::Slot { .. }
                | JointKind::Fixed { .. } => None,
            });
        }
        newton.gears = gears;
        newton
    }

    fn frame(&self, body: &str, q: &[[f64; 3]]) -> [f64; 3] {
        let index = self.bodies.iter().position(|own| *own == body);
        index.map_or([0.0; 3], |index| q[index])
    }

    fn place(&self, point: &PointRef, q: &[[f64; 3]]) -> [f64; 2] {
        let [x, y, angle] = self.frame(&point.body, q);
        let [u, v] = turn(self.model.bodies[&point.body].points[&point.point], angle);
        [x + u, y + v]
    }

    /// What the equations lack.
    fn lack(&self, drive: &[f64], gaps: &Gaps, q: &[[f64; 3]]) -> Vec<f64> {
        let mut rows = Vec::new();
        for (index, joint) in self.model.joints.values().enumerate() {
            let [first, second] = &joint.between;
            let d = minus(self.place(second, q), self.place(first, q));
            let [a, b] = [first, second].map(|end| self.frame(&end.body, q)[2]);
            let [e, f] = gaps.joints[index];
            let across = |axis: [f64; 2]| {
                let [x, y] = turn(axis, a);
                dot([-y, x], d) / axis[0].hypot(axis[1])
            };
            match &joint.kind {
                JointKind::Revolute { .. } => rows.extend([d[0] + e, d[1] + f]),
                JointKind::Prismatic { axis, angle, .. } => {
                    rows.extend([across(*axis) + e, b - a - angle + f]);
                }
                JointKind::Slot { axis, .. } => rows.push(across(*axis) + e),
                JointKind::Fixed { angle } => rows.extend([d[0], d[1], b - a - angle]),
                JointKind::Gear { ratio, .. } => {
                    let (line, length, mesh, carrier) = self.gears[index].as_ref().expect("a gear");
                    let c = self.frame(carrier, q)[2];
                    let [x, y] = turn(*line, c);
                    let leaned = c + dot([-y, x], d) / (length * length);
                    rows.push(mesh + ratio * a + (1.0 - ratio) * leaned - b + e);
                }
            }
        }
        for (index, driver) in self.model.drivers.values().enumerate() {
            let value = match &driver.kind {
                DriverKind::Rotation { body, relative_to } => {
                    let relative = relative_to
                        .as_deref()
                        .map_or(0.0, |to| self.frame(to, q)[2]);
                    self.frame(body, q)[2] - relative
                }
                DriverKind::Translation { joint } => {
                    let joint = &self.model.joints[joint];
                    let (JointKind::Prismatic { axis, .. } | JointKind::Slot { axis, .. }) =
                        &joint.kind
                    else {
                        panic!("no guide")
                    };
                    let [first, second] = &joint.between;
                    let d = minus(self.place(second, q), self.place(first, q));
                    dot(turn(*axis, self.frame(&first.body, q)[2]), d) / axis[0].hypot(axis[1])
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
                let [x, y] = minus(self.place(to, q), self.place(from, q));
                x.hypot(y)
            }
            Measured::Column(column) => {
                let parts: Vec<&str> = column.split('.').collect();
                match parts[..] {
                    [body, "x"] => self.frame(body, q)[0],
                    [body, "y"] => self.frame(body, q)[1],
                    [body, "angle"] => self.frame(body, q)[2],
                    [body, point, axis] => {
                        let (body, point) = (body.to_owned(), point.to_owned());
                        self.place(&PointRef { body, point }, q)[usize::from(axis == "y")]
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

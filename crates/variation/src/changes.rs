//! By how much entries of J and gaps can change as the coordinates move by |Δq| ≤ X, and what that does to the rows.
//!
//! An entry that turns with bodies by an angle α changes by its slope there times α, and its size times α²/2; in the mean along the
//! way by half of the one and a third of the other:
//!
//! ```text
//! pin     ∓ρ⊥ of the angle                            with its body
//! guide   [nᵀ, u·w | −nᵀ, −u·ρ₂], w = P₂ − r₁         with its body, −u·ρ₂ with both; u·w also as the points move
//! gear    k tᵀ, see `element::gear`                   with its carrier, k tᵀρ with its wheel, too; k t·d as the centres move
//! ```
//!
//! and gaps by
//!
//! ```text
//! point, off by d           ∂φ/∂P turns with the body of the guide, d with its own      |d| (|Δθ| + greatest |Δθ|)
//! zone, off by d            d keeps its direction                                       2 |d| greatest |Δθ|
//! direction, off by α       u·d and n·d change                                          α (|Δd| + (|u·d| + |n·d|)(|Δθ₁| + α))
//! ratio, off by δ           ∂φ/∂r = θ₁ − θ_c − …                                        δ (|Δθ₁| + |Δθ_c|)
//! ```

use super::geometry::{Dimension, Dimensions, Here, PointId, driver_block};
use super::question::Question;
use super::source::Acts;
use linkdyn_engine::element::{Axis, BodyId, Kinematics, Marker};
use linkdyn_engine::system::{Block, DriverRole, JointData, JointRole, Origin, System};
use linkdyn_linear::math::{Vec2, perp};

/// An entry of J that turns with bodies.
struct Turning {
    row: usize,
    column: Option<usize>,
    /// Columns of the angles that it turns with.
    by: [Option<usize>; 2],
    /// Its first derivative at the pose, and its size there, or what of it turns.
    slope: f64,
    size: f64,
}

/// One that changes as points move, besides.
struct Moving {
    row: usize,
    column: Option<usize>,
    /// Its change by a metre.
    by: f64,
    points: [Marker; 2],
    /// Of a guide the arm of the first body is no part of w.
    is_guide: bool,
}

/// Joints and drivers whose entries turn: what they are at a pose follows from it.
enum Turned {
    /// A pin's body: its first entry.
    Pin { entry: usize },
    /// A guide; along or across which rows are measured.
    Guide {
        points: [Marker; 2],
        axis: Vec2,
        is_along: bool,
    },
    /// A gear: its first entry.
    Gear { entry: usize, points: [Marker; 2] },
}

/// A gap that turns: with an angle, or with the greatest of all.
struct Gap {
    row: usize,
    angle: Option<usize>,
    by: f64,
}

/// A guide whose direction is off.
struct Swung {
    rows: [Option<usize>; 2],
    points: [Marker; 2],
    axis: Vec2,
    /// How far \[rad\], and |u·d| + |n·d| at the pose \[m\].
    step: f64,
    length: f64,
}

/// All that changes.
pub(super) struct Changes {
    system_columns: Vec<[Option<usize>; 3]>,
    turned: Vec<Turned>,
    turning: Vec<Turning>,
    moving: Vec<Moving>,
    gaps: Vec<Gap>,
    swung: Vec<Swung>,
    /// Dimensions whose steps leave something out, how much, and what that is at the pose (m).
    slack: Vec<(usize, f64)>,
    left_out: Vec<f64>,
    /// How far each point can be off by steps and zones, and what steps leave out \[m\].
    pub points: Vec<[f64; 2]>,
    /// Whether nothing bounds some.
    pub are_unbounded: bool,
}

impl Changes {
    pub fn new(system: &System, question: &Question) -> Changes {
        let column = |body: usize, axis: Axis| {
            let columns = match body {
                0 => None,
                body => system.layout.columns(BodyId::moving(body - 1)),
            };
            columns.map(|columns| match axis {
                Axis::X => columns.x(),
                Axis::Y => columns.y(),
                Axis::Theta => columns.theta(),
            })
        };
        let axes = [Axis::X, Axis::Y, Axis::Theta];
        let bodies = 0..system.bodies.len() + 1;
        let mut changes = Changes {
            system_columns: bodies
                .map(|body| axes.map(|axis| column(body, axis)))
                .collect(),
            turned: Vec::new(),
            turning: Vec::new(),
            moving: Vec::new(),
            gaps: Vec::new(),
            swung: Vec::new(),
            slack: Vec::new(),
            left_out: vec![0.0; system.m()],
            points: vec![[0.0; 2]; question.dimensions.points.len()],
            are_unbounded: false,
        };
        for block in &system.blocks {
            match &block.origin {
                Origin::Joint(id) => changes.add_joint(&system.joints[id.0], block),
                Origin::Driver(id) => {
                    if let DriverRole::Translation { joint } = system.drivers[id.0].role {
                        let joint = &system.joints[joint.0];
                        if let Some(axis) = joint.role().axis() {
                            changes.add_guide(block, joint.points(), axis, true);
                        }
                    }
                }
                // No row stands for a stop where nothing moves by itself.
                Origin::Stop(_) | Origin::Initial(_) => {}
            }
        }
        changes.add_gaps(system, question);
        changes
    }

    fn column(&self, body: BodyId, axis: Axis) -> Option<usize> {
        self.system_columns[body.0][axis as usize]
    }

    fn angle(&self, body: BodyId) -> Option<usize> {
        self.column(body, Axis::Theta)
    }

    fn add_joint(&mut self, joint: &JointData, block: &Block) {
        let points = joint.points();
        match joint.role() {
            JointRole::Revolute | JointRole::Fixed => {
                for (marker, side) in points.iter().zip([0, 4]) {
                    let entry = block.entries().start + side;
                    self.turned.push(Turned::Pin { entry });
                    for row in [block.row(), block.row() + 1] {
                        let turned = (marker.body, Axis::Theta);
                        self.add(row, turned, [marker.body, BodyId::GROUND]);
                    }
                }
            }
            JointRole::Prismatic { axis, .. } | JointRole::Slot { axis } => {
                self.add_guide(block, points, axis, false);
            }
            JointRole::Gear => {
                let entry = block.entries().start;
                self.turned.push(Turned::Gear { entry, points });
                let entries = block.constraint.entries();
                let carrier = entries[entries.len() - 1].1;
                for Marker { body, .. } in points {
                    for axis in [Axis::X, Axis::Y] {
                        self.add(block.row(), (body, axis), [carrier, BodyId::GROUND]);
                    }
                    self.add(block.row(), (body, Axis::Theta), [carrier, body]);
                }
                self.add(
                    block.row(),
                    (carrier, Axis::Theta),
                    [carrier, BodyId::GROUND],
                );
                self.moving.push(Moving {
                    row: block.row(),
                    column: self.angle(carrier),
                    by: 0.0,
                    points,
                    is_guide: false,
                });
            }
            // It has no rows.
            JointRole::Contact => {}
            // Questions about a mechanism with another kind are refused.
            _ => self.are_unbounded = true,
        }
    }

    fn add_guide(&mut self, block: &Block, points: [Marker; 2], axis: Vec2, is_along: bool) {
        self.turned.push(Turned::Guide {
            points,
            axis,
            is_along,
        });
        let [first, second] = points.map(|point| point.body);
        for (body, other) in [(first, BodyId::GROUND), (second, second)] {
            for axis in [Axis::X, Axis::Y] {
                self.add(block.row(), (body, axis), [first, BodyId::GROUND]);
            }
            self.add(block.row(), (body, Axis::Theta), [first, other]);
        }
        self.moving.push(Moving {
            row: block.row(),
            column: self.angle(first),
            by: 1.0,
            points,
            is_guide: true,
        });
    }

    fn add(&mut self, row: usize, (body, axis): (BodyId, Axis), by: [BodyId; 2]) {
        self.turning.push(Turning {
            row,
            column: self.column(body, axis),
            by: by.map(|body| self.angle(body)),
            slope: 0.0,
            size: 0.0,
        });
    }

    /// How far points and dimensions can be off, and the gaps that turn by that.
    fn add_gaps(&mut self, system: &System, question: &Question) {
        let dimensions = question.dimensions;
        let mut steps = vec![0.0; dimensions.all.len()];
        for source in &question.sources {
            let most = source.room.most();
            match &source.acts {
                Acts::Dimensions { steps: by, .. } => {
                    by.iter().for_each(|&(k, by)| steps[k] += by.abs() * most);
                }
                Acts::Point(id) => {
                    self.points[id.0][0] += most;
                    let holds = dimensions.points[id.0].holds.iter();
                    for (row, by) in holds.flat_map(|hold| hold.rows().map(|row| (row, hold.most)))
                    {
                        self.gap(row, None, 2.0 * by * most);
                    }
                }
                Acts::Row(_) => {}
            }
        }
        let none = vec![0.0; steps.len()];
        let slack = question.slack.as_deref().unwrap_or(&none);
        for (k, (step, slack)) in steps.iter().zip(slack).enumerate() {
            if *slack > 0.0 {
                self.slack.push((k, *slack));
            }
            let most = step + slack;
            match &dimensions.all[k] {
                Dimension::Point(PointId(point), _) => {
                    let [off, beyond] = &mut self.points[*point];
                    (*off, *beyond) = (*off + step, *beyond + slack);
                    let point = &dimensions.points[*point];
                    for hold in &point.holds {
                        for row in hold.rows() {
                            self.gap(row, None, hold.most * most);
                            let angle = self.angle(point.body);
                            self.gap(row, Some(angle), hold.most * most);
                        }
                    }
                }
                Dimension::Direction { joint, driver } if most > 0.0 => {
                    let data = &system.joints[*joint];
                    let driven = driver.map(|id| driver_block(system, id).row());
                    self.swung.extend(data.role().axis().map(|axis| Swung {
                        rows: [Some(system.blocks[*joint].row()), driven],
                        points: data.points(),
                        axis,
                        step: most,
                        length: 0.0,
                    }));
                }
                Dimension::Ratio { joint, carrier, .. } => {
                    let [first, _] = system.joints[*joint].bodies();
                    let row = system.blocks[*joint].row();
                    for body in [first, *carrier] {
                        self.gap(row, Some(self.angle(body)), most);
                    }
                }
                Dimension::Direction { .. }
                | Dimension::Angle { .. }
                | Dimension::Mesh { .. }
                | Dimension::Motion { .. } => {}
            }
        }
    }

    /// Adds a gap that turns with an angle (of ground never), or with the greatest.
    fn gap(&mut self, row: usize, angle: Option<Option<usize>>, by: f64) {
        let is_ground = angle == Some(None);
        if by > 0.0 && !is_ground {
            let angle = angle.flatten();
            self.gaps.push(Gap { row, angle, by });
        }
    }

    /// Takes what is known of a pose.
    pub fn take(&mut self, here: &Here<'_>, dimensions: &Dimensions) {
        let (at, jacobian) = (&here.at, &here.evaluation.jacobian);
        let mut turning = self.turning.iter_mut();
        let mut moving = self.moving.iter_mut();
        let mut set = |slope: f64, size: f64| {
            if let Some(next) = turning.next() {
                (next.slope, next.size) = (slope.abs(), size.abs());
            }
        };
        for turned in &self.turned {
            match turned {
                Turned::Pin { entry } => {
                    let (x, y) = (jacobian[entry + 3], jacobian[entry + 1]);
                    set(x, y);
                    set(y, x);
                }
                Turned::Guide {
                    points,
                    axis,
                    is_along,
                } => {
                    let u = at.poses[points[0].body.0].turn(*axis);
                    // φ = f − u·d has −u where a guide has n, and n where it has u.
                    let pair = if *is_along {
                        [perp(u), u]
                    } else {
                        [u, perp(u)]
                    };
                    guide_slopes(at, points, pair, &mut set);
                    moving.next();
                }
                Turned::Gear { entry, points } => {
                    let by = gear_slopes(at, points, &jacobian[*entry..], &mut set).norm();
                    moving.next().into_iter().for_each(|moving| moving.by = by);
                }
            }
        }
        for guide in &mut self.swung {
            let [first, second] = &guide.points;
            let u = at.poses[first.body.0].turn(guide.axis);
            let d = second.place(at) - first.place(at);
            guide.length = u.dot(&d).abs() + perp(u).dot(&d).abs();
        }
        self.left_out.fill(0.0);
        let mut rows = vec![0.0; self.left_out.len()];
        for &(k, step) in &self.slack {
            rows.fill(0.0);
            dimensions.push(here, k, step, &mut rows);
            let each = self.left_out.iter_mut().zip(&rows);
            each.for_each(|(left, row)| *left += row.abs());
        }
    }

    /// What the rows change (m) where the coordinates are off by X: in the mean along the way, and anywhere on it.
    pub fn rows(&self, x: &[f64]) -> Vec<[f64; 2]> {
        let of = |column: Option<usize>| column.map_or(0.0, |column| x[column]);
        let mut rows: Vec<[f64; 2]> = self.left_out.iter().map(|left| [*left; 2]).collect();
        let mut add = |row: usize, mean: f64, most: f64| {
            rows[row] = [rows[row][0] + mean, rows[row][1] + most];
        };
        for entry in &self.turning {
            let angle = of(entry.by[0]) + of(entry.by[1]);
            let linear = entry.slope * angle;
            let square = 0.5 * entry.size * angle * angle;
            let by = of(entry.column);
            add(
                entry.row,
                (0.5 * linear + square / 3.0) * by,
                (linear + square) * by,
            );
        }
        for entry in &self.moving {
            let [first, second] = entry.points.map(|point| self.shift(&point, x));
            let length = match entry.is_guide {
                true => (first.0 + second.0).norm() + second.1,
                false => first.0.norm() + first.1 + second.0.norm() + second.1,
            };
            let change = entry.by * length * of(entry.column);
            add(entry.row, 0.5 * change, change);
        }
        let angles = self.system_columns.iter().map(|&[.., angle]| of(angle));
        let greatest = angles.fold(0.0, f64::max);
        for gap in &self.gaps {
            let by = gap.by * gap.angle.map_or(greatest, |angle| x[angle]);
            add(gap.row, by, by);
        }
        for guide in &self.swung {
            let points = guide.points.iter().map(|point| self.shift(point, x));
            let moved: f64 = points.map(|(shift, swing)| shift.norm() + swing).sum();
            let turn = of(self.angle(guide.points[0].body)) + guide.step;
            let by = guide.step * (moved + guide.length * turn);
            guide
                .rows
                .iter()
                .flatten()
                .for_each(|&row| add(row, by, by));
        }
        rows
    }

    /// How far the body of a point is off, and how far the point moves as it turns.
    fn shift(&self, point: &Marker, x: &[f64]) -> (Vec2, f64) {
        let [a, b, angle] = self.system_columns[point.body.0].map(|own| own.map_or(0.0, |k| x[k]));
        (Vec2::new(a, b), point.s.norm() * angle)
    }
}

/// Entries [nᵀ, u·w | −nᵀ, −u·ρ₂] of a guide, w = P₂ − r₁.
fn guide_slopes(
    at: &Kinematics,
    [first, second]: &[Marker; 2],
    [u, n]: [Vec2; 2],
    set: &mut impl FnMut(f64, f64),
) {
    let rho = second.rho(at);
    let w = second.place(at) - at.poses[first.body.0].r;
    for arm in [w, rho] {
        set(u.x, n.x);
        set(u.y, n.y);
        set(n.dot(&arm), u.dot(&arm));
    }
}

/// Entries of a gear, see `element::gear`: k = (1 − r)/ℓ stands before t, which the Jacobian shows. Says k t.
fn gear_slopes(
    at: &Kinematics,
    [first, second]: &[Marker; 2],
    jacobian: &[f64],
    set: &mut impl FnMut(f64, f64),
) -> Vec2 {
    // k t stands in the entries of the second centre; e = −t⊥.
    let kt = Vec2::new(jacobian[3], jacobian[4]);
    let ke = -perp(kt);
    for marker in [first, second] {
        let rho = marker.rho(at);
        set(ke.x, kt.x);
        set(ke.y, kt.y);
        set(kt.dot(&rho), ke.dot(&rho));
    }
    let span = second.place(at) - first.place(at);
    set(kt.dot(&span), ke.dot(&span));
    kt
}

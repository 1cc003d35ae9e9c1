//! A model as coordinates and sums of vectors: what its equations are made of.
//!
//! Bodies that slide in each other or are fixed to each other turn together: they share an angle, with a constant between them. A tree of
//! joints from the ground gives every point as a sum of vectors; a body on which no joint hangs has x and y of its own; each joint
//! that is not in the tree closes a loop.

use std::collections::VecDeque;

use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::{
    Checked, DriverKind, ForceKind, Frame, GROUND, JointKind, Model, PointRef, Value,
};

use super::identifiers::{Identifiers, legal};
use super::law::TimeLaw;
use super::place::{Place, Plane, Summand, turned};
use super::refused::refused;

/// How a body, a joint or a force is called in the model.
pub type Name = String;

/// What a coordinate is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoordinateKind {
    /// The absolute angle of a body \[rad\].
    Angle,
    /// The slide of a prismatic joint \[m\].
    Slide,
    /// x or y of the centre of mass of a body \[m\].
    Free(usize),
}

/// A coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinate {
    /// What it is.
    pub kind: CoordinateKind,
    /// Its body or its joint.
    pub of: Name,
    /// Its identifier, `phi_crank`.
    pub identifier: String,
    /// Whether a joint to the ground has it, so that it is taken for independent rather than others.
    pub is_first: bool,
}

/// A constant vector.
#[derive(Debug, Clone, PartialEq)]
pub struct Vector {
    /// Its identifier, `CRANK_O_A`.
    pub identifier: String,
    /// In the frame that turns with its coordinate \[m\], of a direction \[1\].
    pub value: Plane,
    /// What it is, in words of the model.
    pub about: String,
    /// Whether it is a direction.
    pub is_direction: bool,
}

/// How a body turns: the angle φ + offset, where it has one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Turn {
    /// The coordinate φ; none of what does not turn.
    pub angle: Option<usize>,
    /// \[rad\]
    pub offset: f64,
}

/// A body that moves, or is fixed to the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct MovingBody {
    /// Its name.
    pub name: Name,
    /// \[kg\]
    pub mass: f64,
    /// About the centre of mass [kg·m²].
    pub inertia: f64,
    /// The centre of mass in the body's frame \[m\].
    pub com: Plane,
    /// The centre of mass.
    pub centre: Place,
    /// How it turns.
    pub turn: Turn,
    /// Its points.
    pub points: Vec<(Name, Place)>,
}

/// A loop that a joint closes.
#[derive(Debug, Clone, PartialEq)]
pub struct Closure {
    /// The joint.
    pub joint: Name,
    /// What must be zero.
    pub gap: Place,
}

/// A linear function of the coordinates: its coefficients, which are 1 or −1, and a constant.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Linear {
    /// Coordinates and their coefficients.
    pub row: Vec<(usize, f64)>,
    /// What is added.
    pub constant: f64,
}

/// A driver: its row of coordinates follows a law of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// Its name.
    pub name: Name,
    /// The coordinates.
    pub row: Vec<(usize, f64)>,
    /// What their sum is.
    pub law: TimeLaw,
}

/// A force element.
#[derive(Debug, Clone, PartialEq)]
pub struct Acting {
    /// Its name.
    pub name: Name,
    /// What acts.
    pub kind: Action,
}

/// What acts.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Stiffness, damping and free length, along a line.
    Spring(Place, [f64; 2], TimeLaw),
    /// A push along a line.
    Push(Place, TimeLaw),
    /// Stiffness, damping and free angle, of a difference of angles.
    Torsion(Linear, [f64; 2], TimeLaw),
    /// A force at a place, in a frame that turns or in that of the ground.
    Force(Place, [TimeLaw; 2], Turn),
    /// A torque, on a difference of angles.
    Torque(Vec<(usize, f64)>, TimeLaw),
}

/// A mechanism in coordinates p.
#[derive(Debug, Clone, PartialEq)]
pub struct Linkage {
    /// What the model is called.
    pub name: String,
    /// [m/s²]
    pub gravity: Plane,
    /// p: angles, then slides, then free coordinates.
    pub coordinates: Vec<Coordinate>,
    /// All constant vectors.
    pub vectors: Vec<Vector>,
    /// In the order of the model.
    pub bodies: Vec<MovingBody>,
    /// Loops.
    pub closures: Vec<Closure>,
    /// Drivers.
    pub drives: Vec<Drive>,
    /// Forces.
    pub forces: Vec<Acting>,
    /// Of each slide, in the order of the coordinates, what it is of.
    pub(super) slides: Vec<Guideway>,
    /// The identifiers that are taken.
    pub(super) taken: Identifiers,
}

/// A slide as the model has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Guideway {
    /// The first and the second body.
    pub bodies: [Name; 2],
    /// Their points in their frames \[m\].
    pub points: [Plane; 2],
    /// Unit vector in the first body's frame.
    pub axis: Plane,
}

/// In SI units: entries are products of five numbers at most, which must not overflow.
const LARGEST: f64 = 1e60;

/// Identifiers that the program has itself.
const RESERVED: [&str; 20] = [
    "BODIES",
    "MASSES",
    "INERTIAS",
    "TURNS",
    "OFFSETS",
    "COORDINATES",
    "INDEPENDENT",
    "DRIVERS",
    "GIVEN",
    "SCALES",
    "GRAVITY",
    "START",
    "START_RATES",
    "START_ACCELERATIONS",
    "START_TURNS",
    "START_EFFORTS",
    "STRIDE",
    "MOST_STRIDES",
    "MOST_STEPS",
    "CLOSED",
];

impl Linkage {
    /// That of a model.
    ///
    /// # Errors
    /// All that is not written as equations.
    pub fn of(model: &Checked, name: &str) -> Result<Linkage, Complaints> {
        let complaints = refused(model);
        if !complaints.is_empty() {
            return Err(complaints.into());
        }
        let linkage = Builder::new(model, name).linkage();
        match linkage.too_large() {
            None => Ok(linkage),
            Some(path) => {
                let message = "a number is too large for products of it to be written as equations";
                Err(Complaint::new(path, message)
                    .hint("1e60 in SI units at most")
                    .into())
            }
        }
    }

    /// Where a number is so large that products might overflow.
    fn too_large(&self) -> Option<String> {
        let is_large = |numbers: &[f64]| numbers.iter().any(|number| number.abs() > LARGEST);
        let mut bodies = self.bodies.iter();
        let of_body = bodies.find(|own| is_large(&[own.mass, own.inertia, own.com[0], own.com[1]]));
        let mut drives = self.drives.iter();
        let of_drive = drives.find(|own| is_large(own.law.numbers()));
        let mut forces = self.forces.iter();
        let of_force = forces.find(|own| match &own.kind {
            Action::Spring(_, factors, law) | Action::Torsion(_, factors, law) => {
                is_large(factors) || is_large(law.numbers())
            }
            Action::Push(_, law) | Action::Torque(_, law) => is_large(law.numbers()),
            Action::Force(_, laws, _) => laws.iter().any(|law| is_large(law.numbers())),
        });
        let is_far = self.vectors.iter().any(|own| is_large(&own.value));
        let found = [
            is_large(&self.gravity).then(|| "gravity".to_owned()),
            of_body.map(|own| format!("bodies.{}", own.name)),
            is_far.then(|| "bodies".to_owned()),
            of_drive.map(|own| format!("drivers.{}.motion", own.name)),
            of_force.map(|own| format!("forces.{}", own.name)),
        ];
        found.into_iter().flatten().next()
    }
}

/// The centre of mass in identifiers.
const COM: &str = "com";

/// A linkage in the making.
struct Builder<'m> {
    model: &'m Model,
    linkage: Linkage,
    /// Where the tree has come to bodies, by their numbers, the ground's last.
    anchors: Vec<Option<Anchor>>,
    /// How they turn.
    turns: Vec<Turn>,
    /// Joints that close loops.
    rest: Vec<usize>,
}

/// Where the tree has come to a body.
#[derive(Debug, Clone)]
struct Anchor {
    /// The point of the body; the centre of mass, of a free body, has no name.
    point: Option<Name>,
    /// In the body's frame \[m\].
    at: Plane,
    /// Where that is.
    place: Place,
}

impl<'m> Builder<'m> {
    fn new(model: &'m Model, name: &str) -> Self {
        let linkage = Linkage {
            name: name.to_owned(),
            gravity: model.gravity,
            coordinates: Vec::new(),
            vectors: Vec::new(),
            bodies: Vec::new(),
            closures: Vec::new(),
            drives: Vec::new(),
            forces: Vec::new(),
            slides: Vec::new(),
            taken: Identifiers::with(&RESERVED),
        };
        let count = moving(model).count() + 1;
        Builder {
            model,
            linkage,
            anchors: vec![None; count],
            turns: vec![Turn::default(); count],
            rest: Vec::new(),
        }
    }

    fn linkage(mut self) -> Linkage {
        self.share_angles();
        self.add_slides();
        self.grow();
        self.add_bodies();
        self.close();
        self.add_drives();
        self.add_forces();
        self.linkage
    }

    /// The number of a body; the ground is the last one.
    fn number(&self, body: &str) -> usize {
        let found = moving(self.model).position(|(name, _)| name == body);
        found.unwrap_or(self.anchors.len() - 1)
    }

    fn ends(&self, joint: usize) -> [usize; 2] {
        let between = &self.model.joints[joint].between;
        between.each_ref().map(|point| self.number(&point.body))
    }

    fn coordinate(&mut self, kind: CoordinateKind, of: &str) -> usize {
        let prefix = match kind {
            CoordinateKind::Angle => "phi",
            CoordinateKind::Slide => "s",
            CoordinateKind::Free(0) => "x",
            CoordinateKind::Free(_) => "y",
        };
        let wish = format!("{prefix}_{}", legal(of).to_ascii_lowercase());
        let identifier = self.linkage.taken.take(wish.trim_end_matches('_'));
        self.linkage.coordinates.push(Coordinate {
            kind,
            of: of.to_owned(),
            identifier,
            is_first: false,
        });
        self.linkage.coordinates.len() - 1
    }

    /// Gives the bodies their angles.
    fn share_angles(&mut self) {
        let count = self.anchors.len();
        let mut known = vec![false; count];
        let ground = count - 1;
        for first in std::iter::once(ground).chain(0..ground) {
            if known[first] {
                continue;
            }
            let own = moving(self.model).nth(first);
            let angle = own.map(|(name, _)| self.coordinate(CoordinateKind::Angle, name));
            known[first] = true;
            self.turns[first] = Turn { angle, offset: 0.0 };
            let mut queue = VecDeque::from([first]);
            while let Some(body) = queue.pop_front() {
                for (k, joint) in self.model.joints.values().enumerate() {
                    let (JointKind::Prismatic { angle: more, .. }
                    | JointKind::Fixed { angle: more }) = joint.kind
                    else {
                        continue;
                    };
                    let [a, b] = self.ends(k);
                    let (next, more) = match (a == body, b == body) {
                        (true, _) => (b, more),
                        (_, true) => (a, -more),
                        (false, false) => continue,
                    };
                    if !known[next] {
                        known[next] = true;
                        let offset = self.turns[body].offset + more;
                        self.turns[next] = Turn { angle, offset };
                        queue.push_back(next);
                    }
                }
            }
        }
        // What turns about the ground is a crank.
        for (k, joint) in self.model.joints.values().enumerate() {
            let turns = self.ends(k).map(|body| self.turns[body].angle);
            if let (JointKind::Revolute { .. }, [Some(angle), None] | [None, Some(angle)]) =
                (&joint.kind, turns)
            {
                self.linkage.coordinates[angle].is_first = true;
            }
        }
    }

    /// A coordinate for each prismatic joint.
    fn add_slides(&mut self) {
        let model = self.model;
        for (name, joint) in &model.joints {
            let JointKind::Prismatic { axis, .. } = &joint.kind else {
                continue;
            };
            let slide = self.coordinate(CoordinateKind::Slide, name);
            let is_first = joint.between.iter().any(|point| point.body == GROUND);
            self.linkage.coordinates[slide].is_first = is_first;
            let length = axis[0].hypot(axis[1]);
            let between = joint.between.each_ref();
            self.linkage.slides.push(Guideway {
                bodies: between.map(|point| point.body.clone()),
                points: between.map(|point| model.bodies[&point.body].points[&point.point]),
                axis: axis.map(|part| part / length),
            });
        }
    }

    /// Where a joint lets its second point be, from the first: along its slide.
    fn slid(&mut self, joint: usize, from: &Place, sign: f64) -> Place {
        let model = self.model;
        let Some((name, own)) = model.joints.get_index(joint) else {
            return from.clone();
        };
        let JointKind::Prismatic { .. } = own.kind else {
            return from.clone();
        };
        let earlier = model.joints.values().take(joint);
        let order = earlier
            .filter(|joint| matches!(joint.kind, JointKind::Prismatic { .. }))
            .count();
        let mut coordinates = self.linkage.coordinates.iter();
        let slides = coordinates.position(|one| one.kind == CoordinateKind::Slide);
        let slide = slides.unwrap_or_default() + order;
        let axis = self.linkage.slides[order].axis;
        let turn = self.turns[self.ends(joint)[0]];
        let words = [name.as_str(), "axis"];
        let about = format!("direction of joint {name:?}");
        let mut summand = self.vector(&words, turned(axis, turn.offset), about, true);
        summand.angle = turn.angle;
        summand.slide = Some(slide);
        summand.sign = sign;
        from.plus(summand)
    }

    /// A constant vector, made where it is new.
    fn vector(
        &mut self,
        words: &[&str],
        value: Plane,
        about: String,
        is_direction: bool,
    ) -> Summand {
        let mut vectors = self.linkage.vectors.iter();
        let known = vectors.position(|own| own.about == about);
        let vector = known.unwrap_or_else(|| {
            // What is zero stands in no sum, and has no name.
            let is_written = value != [0.0, 0.0];
            let identifier = is_written.then(|| self.linkage.taken.constant(words));
            self.linkage.vectors.push(Vector {
                identifier: identifier.unwrap_or_default(),
                value,
                about,
                is_direction,
            });
            self.linkage.vectors.len() - 1
        });
        Summand {
            sign: 1.0,
            vector,
            value,
            angle: None,
            slide: None,
        }
    }

    /// A point of a body that the tree has reached, or another place in its frame.
    fn point(&mut self, body: usize, name: Option<&str>, at: Plane) -> Place {
        let Some(anchor) = self.anchors[body].clone() else {
            return Place::default();
        };
        let turn = self.turns[body];
        let vector = turned([at[0] - anchor.at[0], at[1] - anchor.at[1]], turn.offset);
        let said = |name: Option<&str>| match name {
            None => "centre of mass".to_owned(),
            Some(name) => format!("{name:?}"),
        };
        let own = moving(self.model).nth(body).map(|(name, _)| name);
        let from = anchor.point.as_deref();
        let (words, about) = match own {
            None => (
                vec![GROUND, name.unwrap_or(COM)],
                format!("ground: origin to {}", said(name)),
            ),
            Some(own) => (
                vec![own, from.unwrap_or(COM), name.unwrap_or(COM)],
                format!("{own:?}: {} to {}", said(from), said(name)),
            ),
        };
        let mut summand = self.vector(&words, vector, about, false);
        summand.angle = turn.angle;
        anchor.place.plus(summand)
    }

    fn point_of(&mut self, point: &PointRef) -> Place {
        let at = self.model.bodies[&point.body].points[&point.point];
        self.point(self.number(&point.body), Some(&point.point), at)
    }

    /// The tree: from the ground along joints to all bodies, and from bodies that it does not reach.
    fn grow(&mut self) {
        let model = self.model;
        let ground = self.anchors.len() - 1;
        let mut is_used = vec![false; model.joints.len()];
        for first in std::iter::once(ground).chain(0..ground) {
            if self.anchors[first].is_some() {
                continue;
            }
            let (at, place) = match moving(model).nth(first) {
                None => ([0.0; 2], Place::default()),
                Some((name, body)) => (body.com.unwrap_or_default(), self.free(name)),
            };
            let point = None;
            self.anchors[first] = Some(Anchor { point, at, place });
            let mut queue = VecDeque::from([first]);
            while let Some(body) = queue.pop_front() {
                for (k, joint) in model.joints.values().enumerate() {
                    let ends = self.ends(k);
                    let Some(side) = ends.iter().position(|end| *end == body) else {
                        continue;
                    };
                    let next = ends[1 - side];
                    if is_used[k] || self.anchors[next].is_some() {
                        continue;
                    }
                    is_used[k] = true;
                    let from = self.point_of(&joint.between[side]);
                    let sign = if side == 0 { 1.0 } else { -1.0 };
                    let place = self.slid(k, &from, sign);
                    let end = &joint.between[1 - side];
                    let at = model.bodies[&end.body].points[&end.point];
                    let point = Some(end.point.clone());
                    self.anchors[next] = Some(Anchor { point, at, place });
                    queue.push_back(next);
                }
            }
        }
        self.rest = (0..is_used.len()).filter(|&k| !is_used[k]).collect();
    }

    /// A place with coordinates of its own.
    fn free(&mut self, body: &str) -> Place {
        let mut place = Place::default();
        for (k, (word, axis)) in [("x", [1.0, 0.0]), ("y", [0.0, 1.0])]
            .into_iter()
            .enumerate()
        {
            let coordinate = self.coordinate(CoordinateKind::Free(k), body);
            self.linkage.coordinates[coordinate].is_first = true;
            let about = format!("direction of {word}");
            let mut summand = self.vector(&[word, "direction"], axis, about, true);
            summand.slide = Some(coordinate);
            place = place.plus(summand);
        }
        place
    }

    fn add_bodies(&mut self) {
        let model = self.model;
        for (number, (name, body)) in moving(model).enumerate() {
            let com = body.com.unwrap_or_default();
            let centre = self.point(number, None, com);
            let points = body.points.iter();
            let points =
                points.map(|(point, at)| (point.clone(), self.point(number, Some(point), *at)));
            let points = points.collect();
            self.linkage.bodies.push(MovingBody {
                name: name.to_owned(),
                mass: body.mass.unwrap_or_default(),
                inertia: body.inertia.unwrap_or_default(),
                com,
                centre,
                turn: self.turns[number],
                points,
            });
        }
    }

    /// Loops of the joints that are not in the tree.
    fn close(&mut self) {
        let model = self.model;
        for k in std::mem::take(&mut self.rest) {
            let Some((name, joint)) = model.joints.get_index(k) else {
                continue;
            };
            let first = self.point_of(&joint.between[0]);
            let second = self.point_of(&joint.between[1]);
            let gap = self.slid(k, &first, 1.0).minus(&second);
            self.linkage.closures.push(Closure {
                joint: name.clone(),
                gap,
            });
        }
    }

    /// θ of a body less that of another.
    fn angle_between(&self, body: &str, from: Option<&str>) -> Linear {
        let [own, from] =
            [Some(body), from].map(|name| name.map(|name| self.turns[self.number(name)]));
        let mut linear = Linear::default();
        for (turn, sign) in [(own, 1.0), (from, -1.0)] {
            let Some(turn) = turn else { continue };
            linear.constant += sign * turn.offset;
            let Some(angle) = turn.angle else { continue };
            match linear.row.iter().position(|one| one.0 == angle) {
                Some(same) => drop(linear.row.remove(same)),
                None => linear.row.push((angle, sign)),
            }
        }
        linear
    }

    fn add_drives(&mut self) {
        for (name, driver) in &self.model.drivers {
            let Some(law) = TimeLaw::of_motion(&driver.motion) else {
                continue;
            };
            let (row, law) = match &driver.kind {
                DriverKind::Rotation { body, relative_to } => {
                    let Linear { row, constant } = self.angle_between(body, relative_to.as_deref());
                    (row, law.less(constant))
                }
                DriverKind::Translation { joint } => {
                    let slides = self.linkage.coordinates.iter();
                    let mut slides = slides.enumerate();
                    let slide = slides
                        .find(|(_, own)| own.kind == CoordinateKind::Slide && own.of == *joint);
                    (slide.map(|(k, _)| (k, 1.0)).into_iter().collect(), law)
                }
                // The caller has refused them.
                DriverKind::Length { .. } | DriverKind::Point { .. } => continue,
            };
            self.linkage.drives.push(Drive {
                name: name.clone(),
                row,
                law,
            });
        }
    }

    fn add_forces(&mut self) {
        let model = self.model;
        for (name, force) in &model.forces {
            let line = |builder: &mut Self, between: &[PointRef; 2]| {
                let [first, second] = between.each_ref().map(|point| builder.point_of(point));
                second.minus(&first)
            };
            let law = |value: &Value| TimeLaw::of_value(value);
            let kind = match &force.kind {
                ForceKind::Spring {
                    between,
                    stiffness,
                    damping,
                    free_length,
                } => {
                    let line = line(self, between);
                    law(free_length).map(|free| Action::Spring(line, [*stiffness, *damping], free))
                }
                ForceKind::Actuator { between, force } => {
                    let line = line(self, between);
                    law(force).map(|force| Action::Push(line, force))
                }
                ForceKind::TorsionSpring {
                    between: [first, second],
                    stiffness,
                    damping,
                    free_angle,
                } => {
                    let twist = self.angle_between(second, Some(first));
                    law(free_angle).map(|free| Action::Torsion(twist, [*stiffness, *damping], free))
                }
                ForceKind::Load { at, vector, frame } => {
                    let place = self.point_of(at);
                    let turn = match frame {
                        Frame::Ground => Turn::default(),
                        Frame::Body => self.turns[self.number(&at.body)],
                    };
                    match vector.each_ref().map(law) {
                        [Some(x), Some(y)] => Some(Action::Force(place, [x, y], turn)),
                        [None, _] | [_, None] => None,
                    }
                }
                ForceKind::Torque {
                    body,
                    value,
                    relative_to,
                } => {
                    let row = self.angle_between(body, relative_to.as_deref()).row;
                    law(value).map(|value| Action::Torque(row, value))
                }
                // The caller has refused them.
                ForceKind::GasSpring { .. }
                | ForceKind::Cylinder { .. }
                | ForceKind::DcMotor { .. }
                | ForceKind::Cable { .. } => None,
            };
            let acting = kind.map(|kind| Acting {
                name: name.clone(),
                kind,
            });
            self.linkage.forces.extend(acting);
        }
    }
}

/// The bodies but the ground.
pub fn moving(model: &Model) -> impl Iterator<Item = (&str, &linkdyn_model::Body)> {
    let bodies = model.bodies.iter();
    bodies
        .filter(|(name, _)| *name != GROUND)
        .map(|(name, body)| (name.as_str(), body))
}

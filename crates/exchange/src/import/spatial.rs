//! A mechanism of bodies in space as a planar one: its plane, what moves in it, and the model.
//!
//! All axes of hinges are parallel to the plane's normal n, and all slides lie in the plane. With the directions e₁, e₂ and n of a
//! right-handed frame:
//!
//! ```text
//! point             x = e₁·r, y = e₂·r          [m]       its height n·r has no effect
//! angle             θ = (n·axis) q              [rad]
//! moment of inertia I = nᵀ J n                  [kg·m²]   J about the centre of mass
//! gravity           (e₁·g, e₂·g)                [m/s²]
//! ```
//!
//! Bodies that are welded are one body. Everything is given as drawn, in coordinates of the world at the start.

use nalgebra::{Isometry3, Matrix3, Point3, UnitQuaternion, Vector3};
use serde_json::{Map, Value, json};

use super::Imported;
use super::xml::{Remarks, short};
use crate::draft::{Draft, Entry, number, numbers};
use crate::source::{MOST_PARTS, Refused};

/// Sine of the angle between two axes that are meant to be parallel: files have 1.57 for a right angle.
const PARALLEL: f64 = 1e-3;
/// Digits of lengths after the first one of the largest, and of angles: two less than a number has, which hides rounding.
const DIGITS: i32 = 14;

/// A mechanism in space.
#[derive(Default)]
pub(super) struct Scene {
    pub name: String,
    /// What kind of file it is from.
    pub from: &'static str,
    /// Acceleration of gravity [m/s²].
    pub gravity: Vector3<f64>,
    /// Whether angles of the source are degrees.
    pub is_in_degrees: bool,
    /// The ground first.
    pub bodies: Vec<Solid>,
    pub holds: Vec<Hold>,
    pub couplings: Vec<Coupling>,
    pub cords: Vec<Cord>,
}

/// A body.
#[derive(Default)]
pub(super) struct Solid {
    pub name: String,
    pub weight: Option<Weight>,
    /// Points with names.
    pub sites: Vec<(String, Point3<f64>)>,
}

/// Mass \[kg\], its centre \[m\], and moments of inertia about it in the axes of the world [kg·m²].
#[derive(Clone, Copy)]
pub(super) struct Weight {
    pub mass: f64,
    pub com: Point3<f64>,
    pub inertia: Matrix3<f64>,
}

impl Weight {
    /// From one frame into another.
    pub fn moved(self, frame: &Isometry3<f64>) -> Weight {
        let turn = frame.rotation.to_rotation_matrix();
        Weight {
            mass: self.mass,
            com: frame * self.com,
            inertia: turn * self.inertia * turn.transpose(),
        }
    }

    /// Both as one body.
    pub fn and(self, other: Weight) -> Weight {
        let mass = self.mass + other.mass;
        if mass <= 0.0 {
            return self;
        }
        let com = (self.com.coords * self.mass + other.com.coords * other.mass) / mass;
        let about = |part: &Weight| {
            let arm = part.com.coords - com;
            let arms = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
            part.inertia + arms * part.mass
        };
        let inertia = about(&self) + about(&other);
        Weight {
            mass,
            com: com.into(),
            inertia,
        }
    }
}

/// What holds two bodies together: a joint, or what closes a loop.
pub(super) struct Hold {
    pub name: String,
    /// Where it stands in the source.
    pub place: String,
    /// The first one, and the second one, whose motion in the first counts.
    pub between: [usize; 2],
    pub kind: HoldKind,
    pub travel: Travel,
    /// Inertia that resists its rate [kg·m² or kg].
    pub armature: f64,
}

/// What a joint lets move.
pub(super) enum HoldKind {
    /// A hinge, with its place on both bodies; without an axis it may turn in all directions.
    Turn {
        at: [Point3<f64>; 2],
        axis: Option<Vector3<f64>>,
    },
    /// A slide through a point.
    Slide { at: Point3<f64>, axis: Vector3<f64> },
    /// A pin about an axis that slides along a line of one of the bodies, which is the first one for the other joints.
    Guide {
        at: Point3<f64>,
        along: Vector3<f64>,
        is_of_second: bool,
        axis: Vector3<f64>,
        turn: Travel,
    },
    /// Nothing: both are one body.
    Rigid,
    /// Nothing, once this rotation of the second body has taken it to its place.
    Weld {
        at: [Point3<f64>; 2],
        turn: UnitQuaternion<f64>,
    },
    /// Everything in the plane with this normal.
    Free { normal: Option<Vector3<f64>> },
}

/// How far it moves \[rad or m\] from where it is drawn, and what acts on it.
#[derive(Clone, Copy, Default, PartialEq)]
pub(super) struct Travel {
    pub limits: Option<[f64; 2]>,
    /// [N·m/rad or N/m]
    pub stiffness: f64,
    /// Where the spring has no force.
    pub rest: f64,
    /// [N·m·s/rad or N·s/m]
    pub damping: f64,
}

/// The coordinate of the first joint is `offset` + `ratio` times that of the second.
pub(super) struct Coupling {
    pub name: String,
    pub place: String,
    pub joints: [usize; 2],
    pub ratio: f64,
    pub offset: f64,
}

/// A spring along points of bodies.
pub(super) struct Cord {
    pub name: String,
    pub place: String,
    pub through: Vec<(usize, Point3<f64>)>,
    pub stiffness: f64,
    pub damping: f64,
    pub free_length: f64,
    /// Whether it is slack where it would push.
    pub is_cable: bool,
}

/// The plane of motion.
struct MotionPlane {
    x: Vector3<f64>,
    y: Vector3<f64>,
    normal: Vector3<f64>,
}

impl MotionPlane {
    /// Right-handed, with y upwards or ahead, and x to the right.
    fn across(normal: Vector3<f64>) -> MotionPlane {
        let snapped = normal.map(|part| if part.abs() < PARALLEL { 0.0 } else { part });
        let normal = snapped.normalize();
        let up = if normal.z.abs() < 0.9 {
            Vector3::z()
        } else {
            Vector3::y()
        };
        let y = (up - normal * normal.dot(&up)).normalize();
        let x = y.cross(&normal);
        let is_left = (0..3).map(|k| x[k]).find(|part| part.abs() > 1e-9) < Some(0.0);
        let sign = if is_left { -1.0 } else { 1.0 };
        MotionPlane {
            x: x * sign,
            y,
            normal: normal * sign,
        }
    }

    fn of(scene: &Scene) -> Result<MotionPlane, Refused> {
        let (mut hinge, mut slides) = (None, Vec::new());
        for hold in &scene.holds {
            let axis = match hold.kind {
                HoldKind::Turn { axis, .. } => axis,
                HoldKind::Guide { axis, along, .. } => {
                    slides.push((hold, along));
                    Some(axis)
                }
                HoldKind::Slide { axis, .. } => {
                    slides.push((hold, axis));
                    None
                }
                HoldKind::Free { normal } => normal,
                HoldKind::Rigid | HoldKind::Weld { .. } => None,
            };
            let Some(axis) = axis else { continue };
            let (first, other) = *hinge.get_or_insert((axis, hold));
            if first.cross(&axis).norm() > PARALLEL {
                let cause = format!(
                    "its axis ({}) is not parallel to that of joint {} ({}): this is no planar mechanism",
                    shown(axis),
                    short(&other.name),
                    shown(first)
                );
                return Err(spatial(hold, cause));
            }
        }
        let normal = hinge.map(|(axis, _)| axis).or_else(|| {
            let (_, first) = slides.first()?;
            let others = slides.iter().map(|(_, axis)| *axis);
            let others = others.chain([scene.gravity, Vector3::z(), Vector3::y()]);
            let mut normals = others.map(|other| first.cross(&other));
            normals.find(|normal| normal.norm() > PARALLEL)
        });
        let Some(normal) = normal else {
            return Err(Refused::new(
                "",
                "no hinge and no slide says in which plane it moves",
                "a mechanism has joints",
            ));
        };
        let plane = MotionPlane::across(normal.normalize());
        for (hold, axis) in slides {
            if axis.dot(&plane.normal).abs() > PARALLEL {
                let cause = format!(
                    "it slides along ({}), out of the plane across ({})",
                    shown(axis),
                    shown(plane.normal)
                );
                return Err(spatial(hold, cause));
            }
        }
        Ok(plane)
    }

    fn point(&self, at: &Point3<f64>) -> [f64; 2] {
        self.direction(&at.coords)
    }

    fn direction(&self, of: &Vector3<f64>) -> [f64; 2] {
        [self.x.dot(of), self.y.dot(of)]
    }

    /// Of an axis, 1 or −1: how angles about it count.
    fn sign(&self, axis: &Vector3<f64>) -> f64 {
        self.normal.dot(axis).signum()
    }

    /// In words.
    fn words(&self) -> String {
        format!(
            "x is ({}) of the source, y ({}); angles turn about ({})",
            shown(self.x),
            shown(self.y),
            shown(self.normal)
        )
    }
}

fn spatial(hold: &Hold, cause: String) -> Refused {
    let mend = "only motion in one plane is read: hinges parallel, slides across them";
    Refused::new(&hold.place, cause, mend)
}

fn shown(direction: Vector3<f64>) -> String {
    let part = |k: usize| number(rounded(direction[k], 6)).to_string();
    format!("{} {} {}", part(0), part(1), part(2))
}

/// With so many digits after the point.
fn rounded(value: f64, digits: i32) -> f64 {
    let digits = usize::try_from(digits).unwrap_or_default();
    // What was printed is a number; it may be as large as 1e15.
    format!("{value:.digits$}").parse().unwrap_or(value)
}

/// With as many digits as a number has for certain.
fn significant(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// The model as it comes to be.
struct Writer<'a> {
    plane: MotionPlane,
    draft: Draft,
    remarks: &'a mut Remarks,
    /// The body that each is part of.
    whole: Vec<usize>,
    names: Vec<String>,
    /// Of each body its points, and where they are.
    points: Vec<Map<String, Value>>,
    places: Vec<Vec<[f64; 2]>>,
    digits: i32,
    size: f64,
    is_in_degrees: bool,
    /// Of each joint its name, its points and the sign of its coordinate, where it is one.
    written: Vec<Option<Written>>,
}

/// A joint that was written.
struct Written {
    points: [String; 2],
    sign: f64,
}

impl Scene {
    /// The planar model, and what it lacks.
    pub fn planar(mut self, mut remarks: Remarks) -> Result<Imported, Refused> {
        let sites: usize = self.bodies.iter().map(|body| body.sites.len()).sum();
        let parts = self.bodies.len().max(self.holds.len()).max(sites);
        let parts = parts.max(self.cords.len() + self.couplings.len());
        if parts > MOST_PARTS {
            return Err(Refused::new(
                "",
                format!("{parts} bodies, joints or points are too many for a planar linkage"),
                format!("{MOST_PARTS} at most"),
            ));
        }
        let plane = MotionPlane::of(&self)?;
        let whole = self.weld();
        let places = self.holds.iter().flat_map(Hold::places);
        let places = places.chain(
            self.bodies
                .iter()
                .flat_map(|body| body.sites.iter().map(|site| site.1)),
        );
        let size = places.map(|at| {
            let [x, y] = plane.point(&at);
            x.abs().max(y.abs())
        });
        let size = size.fold(0.0, f64::max);
        // 1e15 m has no digits after the point, 1e-15 m has 29.
        let first = if size > 0.0 {
            size.log10().floor() as i32
        } else {
            0
        };
        let digits = (DIGITS - first).clamp(0, 60);
        let mut draft = Draft {
            name: std::mem::take(&mut self.name),
            about: format!("From {}: {}.", self.from, plane.words()),
            ..Draft::default()
        };
        draft.units.insert("length".into(), "m".into());
        let angle = if self.is_in_degrees { "deg" } else { "rad" };
        draft.units.insert("angle".into(), angle.into());
        let count = self.bodies.len();
        let mut writer = Writer {
            plane,
            draft,
            remarks: &mut remarks,
            whole,
            names: Vec::new(),
            points: vec![Map::new(); count],
            places: vec![Vec::new(); count],
            digits,
            size,
            is_in_degrees: self.is_in_degrees,
            written: Vec::new(),
        };
        writer.names(&self.bodies);
        writer.sites(&self.bodies);
        for hold in &self.holds {
            let written = writer.joint(hold);
            writer.written.push(written);
        }
        self.couplings
            .iter()
            .for_each(|coupling| writer.couple(coupling, &self.holds));
        self.cords.iter().for_each(|cord| writer.cord(cord));
        writer.masses(&self);
        let draft = writer.draft;
        let left_out = remarks.list();
        Ok(Imported { draft, left_out })
    }

    /// Joins bodies that nothing moves against each other; of each the body that it is part of, the foremost one.
    fn weld(&self) -> Vec<usize> {
        let mut whole: Vec<usize> = (0..self.bodies.len()).collect();
        let root = |whole: &[usize], mut body: usize| {
            while whole[body] != body {
                body = whole[body];
            }
            body
        };
        for hold in &self.holds {
            if let HoldKind::Rigid = hold.kind {
                let [a, b] = hold.between.map(|body| root(&whole, body));
                whole[a.max(b)] = a.min(b);
            }
        }
        (0..whole.len()).map(|body| root(&whole, body)).collect()
    }
}

impl Hold {
    /// The points that it needs.
    fn places(&self) -> Vec<Point3<f64>> {
        match self.kind {
            HoldKind::Turn { at, .. } | HoldKind::Weld { at, .. } => at.to_vec(),
            HoldKind::Slide { at, .. } | HoldKind::Guide { at, .. } => vec![at],
            HoldKind::Rigid | HoldKind::Free { .. } => Vec::new(),
        }
    }
}

impl Writer<'_> {
    fn names(&mut self, bodies: &[Solid]) {
        let mut taken = Map::new();
        for (index, body) in bodies.iter().enumerate() {
            let name = match (self.whole[index] == index, index) {
                (_, 0) => "ground".to_owned(),
                (true, _) => Draft::named(&taken, &body.name, "body"),
                (false, _) => String::new(),
            };
            taken.insert(name.clone(), Value::Null);
            self.names.push(name);
        }
    }

    fn sites(&mut self, bodies: &[Solid]) {
        for (index, body) in bodies.iter().enumerate() {
            let whole = self.whole[index];
            for (name, at) in &body.sites {
                let own = format!("{}.", self.names[whole]);
                let wish = name.strip_prefix(&own).unwrap_or(name);
                let at = self.flat(at);
                self.put(whole, at, wish);
            }
        }
    }

    fn flat(&self, at: &Point3<f64>) -> [f64; 2] {
        self.plane.point(at).map(|part| rounded(part, self.digits))
    }

    fn put(&mut self, body: usize, at: [f64; 2], wish: &str) -> String {
        let name = Draft::named(&self.points[body], wish, "P");
        self.points[body].insert(name.clone(), numbers(at));
        self.places[body].push(at);
        format!("{}.{name}", self.names[body])
    }

    /// The point of a body there, a new one if it has none.
    fn point(&mut self, body: usize, at: &Point3<f64>, wish: &str) -> String {
        let (body, at) = (self.whole[body], self.flat(at));
        let near = 2.0 * 10f64.powi(-self.digits);
        let is_there =
            |place: &[f64; 2]| (place[0] - at[0]).abs() <= near && (place[1] - at[1]).abs() <= near;
        match self.places[body].iter().position(is_there) {
            Some(index) => {
                let name = self.points[body].keys().nth(index);
                format!("{}.{}", self.names[body], name.map_or("", String::as_str))
            }
            None => self.put(body, at, wish),
        }
    }

    fn angle(&self, angle: f64) -> Value {
        let angle = if self.is_in_degrees {
            angle.to_degrees()
        } else {
            angle
        };
        // A degree has two digits less behind the point.
        let digits = if self.is_in_degrees {
            DIGITS - 2
        } else {
            DIGITS
        };
        number(rounded(angle, digits))
    }

    /// The direction of a line, its larger part 1 or −1 where it is along an axis.
    fn axis(&self, axis: &Vector3<f64>) -> Value {
        numbers(self.plane.direction(axis).map(|part| rounded(part, DIGITS)))
    }

    /// Writes a joint; nothing where both its bodies are one or it holds nothing.
    fn joint(&mut self, hold: &Hold) -> Option<Written> {
        if let HoldKind::Rigid = hold.kind {
            return None;
        }
        let [first, second] = hold.between.map(|body| self.whole[body]);
        if first == second {
            self.remarks.about(
                &hold.place,
                "nothing moves between its bodies, which are welded",
            );
            return None;
        }
        let name = Draft::named(&self.draft.joints, &hold.name, "joint");
        let mut entry = Entry::new();
        let (mut between, mut sign) = ([first, second], 1.0);
        match &hold.kind {
            HoldKind::Turn { at, axis } => {
                self.gap(hold, at);
                let points = self.ends(&name, between, at);
                sign = axis.map_or(1.0, |axis| self.plane.sign(&axis));
                joint(&mut entry, "revolute", &points);
                self.limits(&mut entry, hold, &hold.travel, sign);
                self.torsion(&name, between, &hold.travel, sign);
            }
            HoldKind::Slide { at, axis } => {
                let points = self.ends(&name, between, &[*at, *at]);
                joint(&mut entry, "prismatic", &points);
                entry.insert("axis".into(), self.axis(axis));
                self.limits(&mut entry, hold, &hold.travel, 1.0);
                self.spring(&name, between, (*at, *axis), &hold.travel);
            }
            HoldKind::Guide {
                at,
                along,
                is_of_second,
                axis,
                turn,
            } => {
                // The line is that of the first body of the slot, the pin that of the second.
                let mut along = *along;
                if *is_of_second {
                    between.reverse();
                    along = -along;
                }
                let points = self.ends(&name, between, &[*at, *at]);
                joint(&mut entry, "slot", &points);
                entry.insert("axis".into(), self.axis(&along));
                self.limits(&mut entry, hold, &hold.travel, 1.0);
                self.spring(&name, between, (*at, along), &hold.travel);
                let sign = self.plane.sign(axis);
                self.torsion(&name, [first, second], turn, sign);
                if turn.limits.is_some() {
                    let what = "limits of its angle: a pin in a slot turns freely";
                    self.remarks.about(&hold.place, what);
                }
            }
            HoldKind::Weld { at, turn } => {
                self.gap(hold, at);
                let points = self.ends(&name, between, at);
                joint(&mut entry, "fixed", &points);
                let turn = turn.scaled_axis();
                let across = turn.dot(&self.plane.normal);
                if (turn - self.plane.normal * across).norm() > PARALLEL {
                    self.remarks.about(&hold.place, "its turn out of the plane");
                }
                if rounded(across, DIGITS) != 0.0 {
                    entry.insert("angle".into(), self.angle(across));
                }
            }
            HoldKind::Free { .. } | HoldKind::Rigid => return None,
        }
        let is_hinge = matches!(hold.kind, HoldKind::Turn { .. });
        if hold.armature != 0.0 && !(is_hinge && first == 0) {
            let what = "armature: give the inertia of a rotor to a body of its own";
            self.remarks.about(&hold.place, what);
        }
        let points = match entry
            .get("between")
            .and_then(Value::as_array)
            .map(Vec::as_slice)
        {
            Some([Value::String(a), Value::String(b)]) => [a.clone(), b.clone()],
            _ => return None,
        };
        self.draft.joints.insert(name, Value::Object(entry));
        Some(Written { points, sign })
    }

    /// Says where a loop is open as drawn.
    fn gap(&mut self, hold: &Hold, at: &[Point3<f64>; 2]) {
        let [[ax, ay], [bx, by]] = at.map(|end| self.plane.point(&end));
        let gap = (bx - ax).hypot(by - ay);
        if gap > PARALLEL * self.size {
            let gap = number(rounded(gap, 6));
            let what = format!("its points are {gap} m apart: the assembly brings them together");
            self.remarks.about(&hold.place, what);
        }
    }

    fn ends(&mut self, name: &str, between: [usize; 2], at: &[Point3<f64>; 2]) -> [String; 2] {
        [0, 1].map(|end| self.point(between[end], &at[end], name))
    }

    /// Limits that have the start between them.
    fn limits(&mut self, entry: &mut Entry, hold: &Hold, travel: &Travel, sign: f64) {
        let Some([low, high]) = travel.limits else {
            return;
        };
        if low > 0.0 || high < 0.0 || low >= high {
            let what = "its limits: where it is drawn is not between them";
            self.remarks.about(&hold.place, what);
            return;
        }
        let [low, high] = if sign < 0.0 {
            [-high, -low]
        } else {
            [low, high]
        };
        let is_angle = matches!(hold.kind, HoldKind::Turn { .. });
        let end = |value: f64| match (value.is_finite(), is_angle) {
            (false, _) => Value::Null,
            (true, true) => self.angle(value),
            (true, false) => number(rounded(value, self.digits)),
        };
        let ends = [low, high].map(end);
        if ends[0] != ends[1] {
            entry.insert("limits".into(), ends.into_iter().collect());
        }
    }

    fn torsion(&mut self, joint: &str, between: [usize; 2], travel: &Travel, sign: f64) {
        if travel.stiffness <= 0.0 && travel.damping <= 0.0 {
            return;
        }
        let names = between.map(|body| self.names[body].as_str());
        let mut entry = Entry::new();
        entry.insert("type".into(), "torsion_spring".into());
        entry.insert("between".into(), json!(names));
        resistance(&mut entry, travel.stiffness, travel.damping);
        if travel.stiffness > 0.0 {
            entry.insert("free_angle".into(), self.angle(sign * travel.rest));
        }
        if self.is_in_degrees {
            let units = [
                ("angular_stiffness", "N*m/rad"),
                ("angular_damping", "N*m*s/rad"),
            ];
            self.draft
                .units
                .extend(units.map(|(key, unit)| (key.to_owned(), unit.into())));
        }
        self.force(&format!("{joint}_spring"), entry);
    }

    /// The spring of a slide, from a point of the line so far behind that its length is never zero.
    fn spring(
        &mut self,
        joint: &str,
        between: [usize; 2],
        (at, axis): (Point3<f64>, Vector3<f64>),
        travel: &Travel,
    ) {
        if travel.stiffness <= 0.0 && travel.damping <= 0.0 {
            return;
        }
        let ends = travel.limits.unwrap_or_default();
        let far = ends.map(|end| if end.is_finite() { end.abs() } else { 0.0 });
        let reach = 2.0 * (self.size.max(1e-3) + far[0].max(far[1]) + travel.rest.abs());
        let reach = significant(reach);
        let behind = at - axis * reach;
        let points = [
            self.point(between[0], &behind, &format!("{joint}_spring")),
            self.point(between[1], &at, joint),
        ];
        let mut entry = Entry::new();
        entry.insert("type".into(), "spring".into());
        entry.insert("between".into(), json!(points));
        resistance(&mut entry, travel.stiffness, travel.damping);
        if travel.stiffness > 0.0 {
            let free = rounded(reach + travel.rest, self.digits);
            entry.insert("free_length".into(), number(free));
        }
        self.force(&format!("{joint}_spring"), entry);
    }

    fn force(&mut self, wish: &str, entry: Entry) {
        let name = Draft::named(&self.draft.forces, wish, "spring");
        self.draft.forces.insert(name, Value::Object(entry));
    }

    /// A gear or a rack, where both joints are on one body.
    fn couple(&mut self, coupling: &Coupling, holds: &[Hold]) {
        let joints = coupling.joints.map(|index| {
            let kind = holds.get(index).map(|hold| (&hold.kind, hold.between));
            kind.zip(self.written.get(index).and_then(Option::as_ref))
        });
        let (
            [
                Some(((kind, ends), follower)),
                Some(((other_kind, other_ends), leader)),
            ],
            true,
        ) = (joints, coupling.joints[0] != coupling.joints[1])
        else {
            self.remarks.about(
                &coupling.place,
                "one of the joints that it couples is left out",
            );
            return;
        };
        let (ends, others) = (
            ends.map(|body| self.whole[body]),
            other_ends.map(|body| self.whole[body]),
        );
        // The body that both joints have, and which end of each it is.
        let shared = [(0, 0), (0, 1), (1, 0), (1, 1)];
        let shared = shared.into_iter().find(|&(a, b)| ends[a] == others[b]);
        let Some((a, b)) = shared else {
            let what = "a gear couples joints that share a body, and these share none";
            self.remarks.about(&coupling.place, what);
            return;
        };
        // Of the angle that is measured from the shared body.
        let seen = |end: usize| if end == 0 { 1.0 } else { -1.0 };
        let mut entry = Entry::new();
        let mut put = |key: &str, value: Value| entry.insert(key.into(), value);
        match (kind, other_kind) {
            (HoldKind::Turn { .. }, HoldKind::Turn { .. }) if coupling.ratio != 0.0 => {
                put("type", "gear".into());
                put(
                    "between",
                    json!([leader.points[1 - b], follower.points[1 - a]]),
                );
                let ratio = seen(a) * follower.sign * coupling.ratio * leader.sign * seen(b);
                put("ratio", number(significant(ratio)));
                put("carrier", self.names[ends[a]].as_str().into());
                let angle = seen(a) * follower.sign * coupling.offset;
                if rounded(angle, DIGITS) != 0.0 {
                    put("angle", self.angle(angle));
                }
            }
            (HoldKind::Slide { axis, .. }, HoldKind::Turn { .. })
                if coupling.ratio != 0.0 && coupling.offset == 0.0 =>
            {
                put("type", "rack".into());
                put(
                    "between",
                    json!([leader.points[1 - b], follower.points[1 - a]]),
                );
                let axis = self.axis(&(axis * seen(a)));
                put("axis", axis);
                let radius = coupling.ratio * leader.sign * seen(b);
                put("radius", number(significant(radius)));
            }
            _ => {
                let what = "gears couple two hinges, or a slide that follows a hinge";
                self.remarks.about(&coupling.place, what);
                return;
            }
        }
        let name = Draft::named(&self.draft.joints, &coupling.name, "gear");
        self.draft.joints.insert(name, Value::Object(entry));
    }

    fn cord(&mut self, cord: &Cord) {
        let heights = cord
            .through
            .iter()
            .map(|(_, at)| at.coords.dot(&self.plane.normal));
        let heights: Vec<f64> = heights.collect();
        let is_flat = heights
            .iter()
            .all(|height| (height - heights[0]).abs() <= PARALLEL * self.size);
        if !is_flat {
            let what = "it leads out of the plane, and so is longer than in it";
            self.remarks.about(&cord.place, what);
            return;
        }
        let name = Draft::named(&self.draft.forces, &cord.name, "spring");
        let ends = cord.through.iter();
        let points: Vec<String> = ends
            .map(|(body, at)| self.point(*body, at, &name))
            .collect();
        let mut entry = Entry::new();
        let (kind, key) = if cord.is_cable {
            ("cable", "through")
        } else {
            ("spring", "between")
        };
        entry.insert("type".into(), kind.into());
        entry.insert(key.into(), json!(points));
        resistance(&mut entry, cord.stiffness, cord.damping);
        let free = number(rounded(cord.free_length, self.digits));
        if cord.stiffness > 0.0 {
            entry.insert("free_length".into(), free);
        }
        self.draft.forces.insert(name, Value::Object(entry));
    }

    /// Bodies with their masses, gravity, and what to compute.
    fn masses(&mut self, scene: &Scene) {
        let count = scene.bodies.len();
        let mut weights: Vec<Option<Weight>> = vec![None; count];
        for (index, body) in scene.bodies.iter().enumerate() {
            let Some(weight) = body.weight else { continue };
            let whole = &mut weights[self.whole[index]];
            *whole = Some(whole.map_or(weight, |other| other.and(weight)));
        }
        // What turns on the ground turns with its rotor.
        let mut rotors = vec![0.0; count];
        for hold in &scene.holds {
            let [first, second] = hold.between.map(|body| self.whole[body]);
            if first == 0 && matches!(hold.kind, HoldKind::Turn { .. }) {
                rotors[second] += hold.armature;
            }
        }
        let is_moving = |index: &usize| *index > 0 && self.whole[*index] == *index;
        let mass = |index: usize| weights[index].map_or(0.0, |weight| weight.mass);
        let has_masses = (0..count).filter(is_moving).any(|index| mass(index) > 0.0);
        let normal = self.plane.normal;
        for index in (0..count).filter(|index| *index == 0 || is_moving(index)) {
            let mut entry = Entry::new();
            if has_masses && index > 0 {
                let weight = weights[index].filter(|weight| weight.mass > 0.0);
                let inertia = weight.map_or(0.0, |weight| normal.dot(&(weight.inertia * normal)));
                let inertia = significant(inertia.max(0.0) + rotors[index]);
                entry.insert("mass".into(), number(significant(mass(index))));
                entry.insert("inertia".into(), number(inertia));
                if let Some(weight) = weight {
                    let com = self.plane.point(&weight.com);
                    let com = com.map(|part| rounded(part, self.digits));
                    entry.insert("com".into(), numbers(com));
                } else {
                    let place = format!("body {}", short(&self.names[index]));
                    self.remarks
                        .about(place, "mass, of which the source has none: 0");
                }
            }
            if !self.points[index].is_empty() {
                let points = std::mem::take(&mut self.points[index]);
                entry.insert("points".into(), Value::Object(points));
            }
            if index > 0 || !entry.is_empty() {
                let name = self.names[index].clone();
                self.draft.bodies.insert(name, Value::Object(entry));
            }
        }
        let analysis = if has_masses {
            self.gravity(&scene.gravity);
            json!({ "type": "dynamics", "end": 2, "outputs": 201 })
        } else {
            json!({ "type": "assembly" })
        };
        if let Value::Object(analysis) = analysis {
            self.draft.analysis = analysis;
        }
    }

    fn gravity(&mut self, gravity: &Vector3<f64>) {
        let across = gravity.dot(&self.plane.normal);
        if across.abs() > PARALLEL * gravity.norm() {
            let what = "its part across the plane, to which no joint yields";
            self.remarks.about("gravity", what);
        }
        let inside = self
            .plane
            .direction(gravity)
            .map(|part| rounded(part, DIGITS));
        if inside != [0.0, 0.0] {
            self.draft.gravity = Some(inside);
        }
    }
}

fn joint(entry: &mut Entry, kind: &str, points: &[String; 2]) {
    entry.insert("type".into(), kind.into());
    entry.insert("between".into(), json!(points));
}

fn resistance(entry: &mut Entry, stiffness: f64, damping: f64) {
    for (key, value) in [("stiffness", stiffness), ("damping", damping)] {
        if value > 0.0 {
            entry.insert(key.into(), number(significant(value)));
        }
    }
}

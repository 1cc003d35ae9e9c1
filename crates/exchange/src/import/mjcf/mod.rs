//! MJCF, the format of MuJoCo: a tree of bodies with their joints, and equalities that close loops.
//!
//! A model is drawn where its keyframe `home` puts it, otherwise at its reference position (`qpos0`). Loops close as they are at the
//! reference position, as in MuJoCo. Masses, default classes, frames and forward kinematics are those of its documentation
//! (`XML reference` and `Computation`, MuJoCo 4.0).

mod held;
mod shape;
mod ties;
mod tree;

use std::collections::HashMap;
use std::f64::consts::PI;

use nalgebra::{
    Isometry3, Matrix3, Point3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3,
};
use roxmltree::Node;

use self::tree::{Branch, MjcfJoint, MjcfKind, Tree, unit};
use super::Imported;
use super::spatial::{Scene, Weight};
use super::xml::{self, DEEPEST, Remarks, XmlLines, short};
use crate::source::{MOST_PARTS, Refused};

/// From here on a limit is none [degrees, rad or m].
const ENDLESS: f64 = 1e9;

/// Reads a model.
pub(super) fn read(text: &str) -> Result<Imported, Refused> {
    let document = xml::parse(text, "mujoco")?;
    let root = document.root_element();
    let mut reader = MjcfReader::new(XmlLines::of(text));
    reader.scene.name = root.attribute("model").unwrap_or_default().to_owned();
    reader.settings(root)?;
    for world in root
        .children()
        .filter(|node| node.has_tag_name("worldbody"))
    {
        reader.inside(world, 0, Isometry3::identity(), "main", 0)?;
    }
    reader.settle_masses();
    let start = reader.start(root)?;
    let poses = Poses {
        reference: reader
            .tree
            .poses(&reader.tree.coordinates(|joint| joint.reference))
            .0,
        spring: reader
            .tree
            .poses(&reader.tree.coordinates(|joint| joint.rest))
            .0,
        start: reader.tree.poses(&start).0,
    };
    reader.draw(&start);
    for section in root.children().filter(Node::is_element) {
        match section.tag_name().name() {
            "equality" => reader.each(section, |reader, node| reader.equality(node, &poses))?,
            "tendon" => reader.each(section, |reader, node| reader.tendon(node, &poses))?,
            "actuator" => reader.each(section, |reader, node| {
                reader.actuator(node);
                Ok(())
            })?,
            // Read before, or without any effect on motion.
            "compiler" | "option" | "default" | "worldbody" | "keyframe" | "asset" | "visual"
            | "statistic" | "size" => {}
            other => {
                let what = format!("<{other}>");
                reader.remarks.at(&reader.lines, section, what);
            }
        }
    }
    reader.scene.planar(reader.remarks)
}

/// What `compiler` says.
struct Compiler {
    is_in_degrees: bool,
    has_auto_limits: bool,
    euler: [char; 3],
    /// Whether geoms give masses always, never, or where there is no `inertial`.
    from_geoms: Option<bool>,
    groups: [f64; 2],
    total_mass: f64,
}

/// Poses of all bodies, in three positions.
struct Poses {
    reference: Vec<Isometry3<f64>>,
    spring: Vec<Isometry3<f64>>,
    start: Vec<Isometry3<f64>>,
}

struct MjcfReader<'a, 'i> {
    lines: XmlLines,
    remarks: Remarks,
    scene: Scene,
    compiler: Compiler,
    /// Of each class and element its defaults, and of each class the class around it.
    defaults: HashMap<(&'a str, &'a str), Vec<Node<'a, 'i>>>,
    parents: HashMap<&'a str, &'a str>,
    tree: Tree,
    bodies: HashMap<String, usize>,
    sites: HashMap<String, (usize, Point3<f64>)>,
    /// Of each joint with a name the body, which one of its joints it is, and later what holds it.
    joints: HashMap<String, (usize, usize)>,
    holds: HashMap<(usize, usize), usize>,
}

impl<'a, 'i> MjcfReader<'a, 'i> {
    fn new(lines: XmlLines) -> Self {
        let world = Branch {
            name: "world".into(),
            place: String::new(),
            parent: 0,
            frame: Isometry3::identity(),
            joints: Vec::new(),
            weight: None,
            sites: Vec::new(),
        };
        MjcfReader {
            lines,
            remarks: Remarks::default(),
            scene: Scene {
                from: "MJCF",
                gravity: Vector3::new(0.0, 0.0, -9.81),
                is_in_degrees: true,
                ..Scene::default()
            },
            compiler: Compiler {
                is_in_degrees: true,
                has_auto_limits: true,
                euler: ['x', 'y', 'z'],
                from_geoms: None,
                groups: [0.0, 5.0],
                total_mass: -1.0,
            },
            defaults: HashMap::new(),
            parents: HashMap::new(),
            tree: Tree {
                branches: vec![world],
                coordinates: 0,
            },
            bodies: HashMap::from([("world".to_owned(), 0)]),
            sites: HashMap::new(),
            joints: HashMap::new(),
            holds: HashMap::new(),
        }
    }

    fn each(
        &mut self,
        section: Node<'a, 'i>,
        read: impl Fn(&mut Self, Node<'a, 'i>) -> Result<(), Refused>,
    ) -> Result<(), Refused> {
        section
            .children()
            .filter(Node::is_element)
            .try_for_each(|node| read(self, node))
    }

    fn settings(&mut self, root: Node<'a, 'i>) -> Result<(), Refused> {
        for node in root.children().filter(Node::is_element) {
            match node.tag_name().name() {
                "compiler" => self.compiler(node)?,
                "option" => self.option(node)?,
                "default" => self.default(node, None, 0)?,
                "include" => return Err(self.foreign(node)),
                _ => {}
            }
        }
        self.scene.is_in_degrees = self.compiler.is_in_degrees;
        Ok(())
    }

    fn foreign(&self, node: Node) -> Refused {
        let cause = format!(
            "<{}> makes bodies that are not in the file",
            node.tag_name().name()
        );
        let mend = "write one file of all first, as mj_saveLastXML of MuJoCo does";
        self.lines.refuse(node, cause, mend)
    }

    fn compiler(&mut self, node: Node) -> Result<(), Refused> {
        for attribute in node.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            let unknown = |legal: &str| {
                let cause = format!("{name} is {:?}", short(value));
                Err(self.lines.refuse(node, cause, legal))
            };
            match (name, value) {
                ("angle", "degree") => self.compiler.is_in_degrees = true,
                ("angle", "radian") => self.compiler.is_in_degrees = false,
                ("angle", _) => return unknown("degree or radian"),
                ("autolimits", "true") => self.compiler.has_auto_limits = true,
                ("autolimits", "false") => self.compiler.has_auto_limits = false,
                ("coordinate", "global") => {
                    return unknown(
                        "local; MuJoCo 2.3.3 or older converts it: load and save it there",
                    );
                }
                ("eulerseq", letters) => {
                    let letters: Vec<char> = letters.chars().collect();
                    match <[char; 3]>::try_from(letters) {
                        Ok(all) if all.iter().all(|c| "xyzXYZ".contains(*c)) => {
                            self.compiler.euler = all;
                        }
                        _ => return unknown("three of x y z, or X Y Z"),
                    }
                }
                ("inertiafromgeom", "true") => self.compiler.from_geoms = Some(true),
                ("inertiafromgeom", "false") => self.compiler.from_geoms = Some(false),
                ("inertiafromgeom", "auto") => self.compiler.from_geoms = None,
                ("inertiafromgeom", _) => return unknown("true, false or auto"),
                ("inertiagrouprange", range) => {
                    self.compiler.groups = self.lines.numbers(node, name, range)?;
                }
                ("settotalmass", mass) => {
                    [self.compiler.total_mass] = self.lines.numbers(node, name, mass)?;
                }
                ("boundmass" | "boundinertia", bound) if bound != "0" => {
                    let what = format!("{name}: masses are as they stand");
                    self.remarks.at(&self.lines, node, what);
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn option(&mut self, node: Node) -> Result<(), Refused> {
        if let Some(gravity) = node.attribute("gravity") {
            self.scene.gravity = self.lines.numbers(node, "gravity", gravity)?.into();
        }
        for name in ["density", "viscosity", "wind"] {
            let values = node.attribute(name).unwrap_or_default();
            if self
                .lines
                .list(node, name, values)?
                .iter()
                .any(|value| *value != 0.0)
            {
                let what = format!("{name}: nothing flows around a linkage");
                self.remarks.at(&self.lines, node, what);
            }
        }
        let flags = node.children().filter(|child| child.has_tag_name("flag"));
        if flags
            .into_iter()
            .any(|flag| flag.attribute("gravity") == Some("disable"))
        {
            self.scene.gravity = Vector3::zeros();
        }
        Ok(())
    }

    fn default(
        &mut self,
        node: Node<'a, 'i>,
        parent: Option<&'a str>,
        depth: usize,
    ) -> Result<(), Refused> {
        self.deep(node, depth)?;
        let class = node.attribute("class");
        let class = match (class, parent) {
            (Some(class), _) => class,
            (None, None) => "main",
            (None, Some(_)) => self.lines.needed(node, "class")?,
        };
        if let Some(parent) = parent {
            self.parents.entry(class).or_insert(parent);
        }
        for child in node.children().filter(Node::is_element) {
            match child.tag_name().name() {
                "default" => self.default(child, Some(class), depth + 1)?,
                tag => self.defaults.entry((class, tag)).or_default().push(child),
            }
        }
        Ok(())
    }

    fn deep(&self, node: Node, depth: usize) -> Result<(), Refused> {
        if depth < DEEPEST {
            return Ok(());
        }
        let cause = format!("it is inside more than {DEEPEST} others");
        Err(self.lines.refuse(node, cause, "a linkage is not so deep"))
    }

    /// The element, then its defaults from its class to the outermost.
    fn levels(&self, node: Node<'a, 'i>, class: &'a str) -> Vec<Node<'a, 'i>> {
        let mut levels = vec![node];
        let mut class = Some(node.attribute("class").unwrap_or(class));
        // A class that is its own parent ends here.
        for _ in 0..DEEPEST {
            let Some(name) = class else { break };
            let found = self.defaults.get(&(name, node.tag_name().name()));
            levels.extend(found.into_iter().flatten().rev());
            let outer = self.parents.get(name).copied();
            class = outer.or((name != "main").then_some("main"));
        }
        levels
    }

    fn list(&self, levels: &[Node<'a, 'i>], name: &str) -> Result<Option<Vec<f64>>, Refused> {
        let found = levels
            .iter()
            .find_map(|level| Some((level, level.attribute(name)?)));
        found
            .map(|(level, text)| self.lines.list(*level, name, text))
            .transpose()
    }

    fn numbers<const N: usize>(
        &self,
        levels: &[Node<'a, 'i>],
        name: &str,
        otherwise: [f64; N],
    ) -> Result<[f64; N], Refused> {
        let found = levels
            .iter()
            .find_map(|level| Some((level, level.attribute(name)?)));
        let found = found.map(|(level, text)| self.lines.numbers(*level, name, text));
        Ok(found.transpose()?.unwrap_or(otherwise))
    }

    /// The first of several numbers: stiffness and damping may be polynomials.
    fn linear(&mut self, levels: &[Node<'a, 'i>], name: &str) -> Result<f64, Refused> {
        let list = self.list(levels, name)?.unwrap_or_default();
        let (first, rest) = list.split_first().unwrap_or((&0.0, &[]));
        if rest.iter().any(|value| *value != 0.0) {
            let what = format!("{name}: all coefficients but the first");
            self.remarks.at(&self.lines, levels[0], what);
        }
        if *first < 0.0 {
            let cause = format!("{name} is {first}");
            return Err(self.lines.refuse(levels[0], cause, "0 or more"));
        }
        Ok(*first)
    }

    fn radians(&self, angle: f64) -> f64 {
        if self.compiler.is_in_degrees {
            angle.to_radians()
        } else {
            angle
        }
    }

    /// The frame of an element, by whatever gives its orientation.
    fn frame(&self, levels: &[Node<'a, 'i>]) -> Result<Isometry3<f64>, Refused> {
        let [x, y, z] = self.numbers(levels, "pos", [0.0; 3])?;
        let rotation = self.orientation(levels)?;
        Ok(Isometry3::from_parts(Translation3::new(x, y, z), rotation))
    }

    fn orientation(&self, levels: &[Node<'a, 'i>]) -> Result<UnitQuaternion<f64>, Refused> {
        let names = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];
        let given = levels.iter().find_map(|level| {
            let name = names.into_iter().find(|name| level.has_attribute(*name))?;
            Some((*level, name, level.attribute(name)?))
        });
        let Some((node, name, text)) = given else {
            return Ok(UnitQuaternion::identity());
        };
        let lines = &self.lines;
        Ok(match name {
            "quat" => quaternion(lines, node, name, lines.numbers(node, name, text)?)?,
            "axisangle" => {
                let [x, y, z, angle] = lines.numbers(node, name, text)?;
                let axis = Unit::new_unchecked(lines.direction(node, name, [x, y, z])?);
                UnitQuaternion::from_axis_angle(&axis, self.radians(angle))
            }
            "euler" => {
                let angles: [f64; 3] = lines.numbers(node, name, text)?;
                let turns = self.compiler.euler.into_iter().zip(angles);
                turns.fold(UnitQuaternion::identity(), |all, (letter, angle)| {
                    let axis = match letter.to_ascii_lowercase() {
                        'x' => Vector3::x_axis(),
                        'y' => Vector3::y_axis(),
                        _ => Vector3::z_axis(),
                    };
                    let turn = UnitQuaternion::from_axis_angle(&axis, self.radians(angle));
                    // About axes that turn along, or about fixed ones.
                    if letter.is_lowercase() {
                        all * turn
                    } else {
                        turn * all
                    }
                })
            }
            "xyaxes" => {
                let [a, b, c, d, e, f] = lines.numbers(node, name, text)?;
                let x = lines.direction(node, name, [a, b, c])?;
                let y = Vector3::new(d, e, f);
                let y = lines.direction(node, name, (y - x * x.dot(&y)).into())?;
                let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
                UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes))
            }
            _ => {
                let z = lines.direction(node, name, lines.numbers(node, name, text)?)?;
                upright(&z)
            }
        })
    }

    /// Reads what is inside a body or a frame.
    fn inside(
        &mut self,
        around: Node<'a, 'i>,
        body: usize,
        frame: Isometry3<f64>,
        class: &'a str,
        depth: usize,
    ) -> Result<(), Refused> {
        self.deep(around, depth)?;
        if self.tree.branches.len() > MOST_PARTS {
            let mend = format!("{MOST_PARTS} at most");
            let cause = "there are too many bodies for a planar linkage";
            return Err(self.lines.refuse(around, cause, &mend));
        }
        let mut geoms: Option<Weight> = None;
        for node in around.children().filter(Node::is_element) {
            let inner = node.attribute("childclass").unwrap_or(class);
            match node.tag_name().name() {
                "body" => {
                    let place = frame * self.frame(&[node])?;
                    let index = self.body(node, body, place);
                    self.inside(node, index, Isometry3::identity(), inner, depth + 1)?;
                }
                "frame" => {
                    let place = frame * self.frame(&[node])?;
                    self.inside(node, body, place, inner, depth + 1)?;
                }
                "joint" | "freejoint" => self.joint(node, body, &frame, class)?,
                "site" => {
                    let place = self.frame(&self.levels(node, class))?;
                    let at = frame * Point3::from(place.translation.vector);
                    if let Some(name) = node.attribute("name") {
                        self.sites.entry(name.to_owned()).or_insert((body, at));
                        self.tree.branches[body].sites.push((name.to_owned(), at));
                    }
                }
                "geom" if body > 0 => {
                    let weight = self.geom(node, class)?;
                    let weight = weight.map(|weight| weight.moved(&frame));
                    geoms = match (geoms, weight) {
                        (Some(all), Some(weight)) => Some(all.and(weight)),
                        (all, weight) => all.or(weight),
                    };
                    let what = "<geom>: shape and contacts, not its mass";
                    self.remarks.at(&self.lines, node, what);
                }
                "inertial" if body > 0 && self.compiler.from_geoms != Some(true) => {
                    self.tree.branches[body].weight = Some(self.inertial(node)?);
                }
                "include" | "attach" | "replicate" | "composite" | "flexcomp" => {
                    return Err(self.foreign(node));
                }
                "inertial" | "geom" => {}
                other => {
                    let what = format!("<{other}>");
                    self.remarks.at(&self.lines, node, what);
                }
            }
        }
        let is_given = around.children().any(|node| node.has_tag_name("inertial"));
        let counts = self.compiler.from_geoms.unwrap_or(!is_given);
        if let (true, Some(geoms)) = (counts, geoms) {
            let own = self.tree.branches[body].weight;
            self.tree.branches[body].weight = Some(own.map_or(geoms, |own| own.and(geoms)));
        }
        Ok(())
    }

    fn body(&mut self, node: Node, parent: usize, frame: Isometry3<f64>) -> usize {
        for (name, idle) in [("mocap", "false"), ("gravcomp", "0")] {
            if node.attribute(name).is_some_and(|value| value != idle) {
                let what = name.to_owned();
                self.remarks.at(&self.lines, node, what);
            }
        }
        let index = self.tree.branches.len();
        let name = node.attribute("name").unwrap_or("body").to_owned();
        self.bodies.entry(name.clone()).or_insert(index);
        self.tree.branches.push(Branch {
            name,
            place: self.lines.place(node),
            parent,
            frame,
            joints: Vec::new(),
            weight: None,
            sites: Vec::new(),
        });
        index
    }

    fn joint(
        &mut self,
        node: Node<'a, 'i>,
        body: usize,
        frame: &Isometry3<f64>,
        class: &'a str,
    ) -> Result<(), Refused> {
        if body == 0 {
            let mend = "put it into a <body>";
            return Err(self.lines.refuse(node, "the world has no joints", mend));
        }
        let levels = self.levels(node, class);
        let text = |name: &str| levels.iter().find_map(|level| level.attribute(name));
        let kind = match text("type") {
            _ if node.has_tag_name("freejoint") => MjcfKind::Free,
            Some("hinge") | None => MjcfKind::Hinge,
            Some("slide") => MjcfKind::Slide,
            Some("ball") => MjcfKind::Ball,
            Some("free") => MjcfKind::Free,
            Some(other) => {
                let cause = format!("the type of a joint is {:?}", short(other));
                return Err(self.lines.refuse(node, cause, "hinge, slide, ball or free"));
            }
        };
        for (name, what) in [
            (
                "frictionloss",
                "frictionloss: friction that does not depend on the load",
            ),
            ("springdamper", "springdamper: give stiffness and damping"),
        ] {
            let values = self.list(&levels, name)?.unwrap_or_default();
            if values.iter().any(|value| *value != 0.0) {
                self.remarks.at(&self.lines, node, what);
            }
        }
        let angle = |value: f64| {
            if kind == MjcfKind::Slide {
                value
            } else {
                self.radians(value)
            }
        };
        let [reference] = self.numbers(&levels, "ref", [0.0])?;
        let [rest] = self.numbers(&levels, "springref", [0.0])?;
        let range: [f64; 2] = self.numbers(&levels, "range", [0.0; 2])?;
        let is_limited = match text("limited") {
            Some("true") => true,
            Some("false") => false,
            _ => self.compiler.has_auto_limits && range != [0.0; 2],
        };
        let (reference, rest) = (angle(reference), angle(rest));
        let end = |end: f64| {
            if end.abs() < ENDLESS {
                angle(end)
            } else {
                end * f64::INFINITY
            }
        };
        let limits = is_limited.then(|| range.map(end));
        let at: Point3<f64> = self.numbers(&levels, "pos", [0.0; 3])?.into();
        let axis = self.numbers(&levels, "axis", [0.0, 0.0, 1.0])?;
        let axis = self.lines.direction(node, "axis", axis)?;
        let [armature] = self.numbers(&levels, "armature", [0.0])?;
        let (stiffness, damping) = (
            self.linear(&levels, "stiffness")?,
            self.linear(&levels, "damping")?,
        );
        let branch = &mut self.tree.branches[body];
        let name = node.attribute("name");
        if let Some(name) = name {
            let place = (body, branch.joints.len());
            self.joints.entry(name.to_owned()).or_insert(place);
        }
        branch.joints.push(MjcfJoint {
            name: name.unwrap_or(&branch.name).to_owned(),
            place: self.lines.place(node),
            kind,
            at: frame * at,
            axis: frame.rotation * axis,
            reference,
            limits,
            stiffness,
            rest,
            damping,
            armature: armature.max(0.0),
            first: self.tree.coordinates,
        });
        self.tree.coordinates += kind.size();
        Ok(())
    }

    fn inertial(&self, node: Node<'a, 'i>) -> Result<Weight, Refused> {
        let lines = &self.lines;
        let [mass] = lines.numbers(node, "mass", lines.needed(node, "mass")?)?;
        let frame = self.frame(&[node])?;
        let inertia = match (node.attribute("fullinertia"), node.attribute("diaginertia")) {
            (Some(full), _) => {
                let [xx, yy, zz, xy, xz, yz] = lines.numbers(node, "fullinertia", full)?;
                Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
            }
            (None, Some(diagonal)) => {
                let diagonal: [f64; 3] = lines.numbers(node, "diaginertia", diagonal)?;
                Matrix3::from_diagonal(&diagonal.into())
            }
            (None, None) => Matrix3::zeros(),
        };
        if mass < 0.0 || (0..3).any(|k| inertia[(k, k)] < 0.0) {
            return Err(lines.refuse(node, "mass or inertia is negative", "0 or more"));
        }
        let weight = Weight {
            mass,
            com: Point3::origin(),
            inertia,
        };
        Ok(weight.moved(&frame))
    }

    /// Mass of a solid shape, in the frame around it.
    fn geom(&mut self, node: Node<'a, 'i>, class: &'a str) -> Result<Option<Weight>, Refused> {
        let levels = self.levels(node, class);
        let text = |name: &str| levels.iter().find_map(|level| level.attribute(name));
        let [group] = self.numbers(&levels, "group", [0.0])?;
        if group < self.compiler.groups[0] || group > self.compiler.groups[1] {
            return Ok(None);
        }
        let kind = text("type").unwrap_or("sphere");
        if ["mesh", "hfield", "sdf", "plane"].contains(&kind) {
            if self.numbers(&levels, "mass", [1.0])? != [0.0] {
                let what = format!("the mass of a geom of type {kind}: give <inertial>");
                self.remarks.at(&self.lines, node, what);
            }
            return Ok(None);
        }
        if text("shellinertia") == Some("true") {
            let what = "shellinertia: shapes are solid";
            self.remarks.at(&self.lines, node, what);
        }
        let mut size = self.list(&levels, "size")?.unwrap_or_default();
        let mut frame = self.frame(&levels)?;
        if let (Some(ends), Some(&first)) = (text("fromto"), size.first()) {
            let [a, b, c, d, e, f] = self.lines.numbers(node, "fromto", ends)?;
            let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
            let z = self.lines.direction(node, "fromto", (from - to).into())?;
            frame = Isometry3::from_parts(((from + to) / 2.0).into(), upright(&z));
            let half = (to - from).norm() / 2.0;
            size = match kind {
                "box" | "ellipsoid" => vec![first, first, half],
                _ => vec![first, half],
            };
        }
        let refuse = |cause: String, mend: &str| Err(self.lines.refuse(node, cause, mend));
        let solid = match shape::size(kind) {
            None => {
                let mend = "sphere, capsule, cylinder, box, ellipsoid, mesh, plane, hfield or sdf";
                return refuse(format!("the type of a geom is {:?}", short(kind)), mend);
            }
            Some(count) if size.len() < count => {
                let mend = "sphere 1, capsule and cylinder 2 (1 with fromto), box and ellipsoid 3";
                return refuse(format!("size has too few numbers for a {kind}"), mend);
            }
            Some(count) if size[..count].iter().any(|part| *part <= 0.0) => {
                return refuse("the size of a geom is not positive".into(), "above 0");
            }
            Some(_) => shape::solid(kind, &size),
        };
        let (volume, inertia) = solid;
        let [density] = self.numbers(&levels, "density", [1000.0])?;
        let [mass] = self.numbers(&levels, "mass", [density * volume])?;
        if mass < 0.0 {
            return refuse("mass or density is negative".into(), "0 or more");
        }
        let weight = Weight {
            mass,
            com: Point3::origin(),
            inertia: Matrix3::from_diagonal(&Vector3::from(inertia)) * mass,
        };
        Ok(Some(weight.moved(&frame)))
    }

    fn settle_masses(&mut self) {
        let weights = || self.tree.branches.iter().filter_map(|branch| branch.weight);
        let total: f64 = weights().map(|weight| weight.mass).sum();
        if self.compiler.total_mass <= 0.0 || total <= 0.0 {
            return;
        }
        let scale = self.compiler.total_mass / total;
        for weight in self
            .tree
            .branches
            .iter_mut()
            .filter_map(|branch| branch.weight.as_mut())
        {
            weight.mass *= scale;
            weight.inertia *= scale;
        }
    }

    /// Where the model starts: at its keyframe `home`, or at the reference position.
    fn start(&mut self, root: Node<'a, 'i>) -> Result<Vec<f64>, Refused> {
        let reference = self.tree.coordinates(|joint| joint.reference);
        let keys = root.children().filter(|node| node.has_tag_name("keyframe"));
        let keys = keys.flat_map(|frame| frame.children().filter(|node| node.has_tag_name("key")));
        let mut start = None;
        for key in keys {
            if key.attribute("name") != Some("home") || start.is_some() {
                let what =
                    "a keyframe: the model starts at the one that is named home, or at qpos0";
                self.remarks.at(&self.lines, key, what);
                continue;
            }
            for name in ["qvel", "ctrl", "act", "mpos", "mquat"] {
                if key.has_attribute(name) {
                    let what = format!("{name} of a keyframe");
                    self.remarks.at(&self.lines, key, what);
                }
            }
            let Some(text) = key.attribute("qpos") else {
                continue;
            };
            let values = self.lines.list(key, "qpos", text)?;
            if values.len() != self.tree.coordinates {
                let cause = format!("qpos has {} numbers", values.len());
                let mend = format!("the joints have {}", self.tree.coordinates);
                return Err(self.lines.refuse(key, cause, &mend));
            }
            self.remarks
                .about("qpos0", "the model starts as its keyframe home");
            start = Some(values);
        }
        Ok(start.unwrap_or(reference))
    }
}

fn quaternion(
    lines: &XmlLines,
    node: Node,
    name: &str,
    parts: [f64; 4],
) -> Result<UnitQuaternion<f64>, Refused> {
    if parts.iter().map(|part| part * part).sum::<f64>() < 1e-20 {
        let cause = format!("{name} is no rotation");
        return Err(lines.refuse(node, cause, "1 0 0 0 turns nothing"));
    }
    Ok(unit(parts))
}

/// The least rotation that takes z there.
fn upright(z: &Vector3<f64>) -> UnitQuaternion<f64> {
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), z);
    // Half a turn has no least axis.
    turn.unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI))
}

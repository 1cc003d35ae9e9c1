//! SDF, the format of Gazebo: models of links, and joints between any two of them, also such that close loops.
//!
//! Everything is drawn where the poses of the file put it, and there all joints are at zero. Frames are those of SDF 1.7 to 1.12
//! (`pose_frame_semantics` of sdformat.org), and axes of files before 1.5 and with `use_parent_model_frame` are in the frame of the model.

use std::collections::HashMap;

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, UnitQuaternion, Vector3};
use roxmltree::Node;

use super::Imported;
use super::spatial::{Coupling, Hold, HoldKind, Scene, Solid, Travel, Weight};
use super::xml::{self, Remarks, XmlLines, short};
use crate::source::{MOST_PARTS, Refused};

/// From here on a limit is none.
const ENDLESS: f64 = 1e15;

/// Reads a world or a model.
pub(super) fn read(text: &str) -> Result<Imported, Refused> {
    let document = xml::parse(text, "sdf")?;
    let root = document.root_element();
    let version: f64 = root
        .attribute("version")
        .and_then(|v| v.parse().ok())
        .unwrap_or(1.12);
    let mut reader = SdfReader {
        lines: XmlLines::of(text),
        remarks: Remarks::default(),
        scene: Scene {
            from: "SDF",
            bodies: vec![Solid::default()],
            ..Scene::default()
        },
        // 1.10 to 1.12 are later than 1.9.
        is_before_frames: version < 1.45 && !(1.095..1.2).contains(&version),
        mimics: Vec::new(),
    };
    let world = child(root, "world");
    reader.gravity(world)?;
    let around = world.unwrap_or(root);
    let name = around.attribute("name").filter(|_| world.is_some());
    let mut count = 0;
    for node in around.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "model" => {
                count += 1;
                let own = node.attribute("name").unwrap_or_default();
                // The ground's plane and other scenery are not what the model is called after.
                if reader.scene.name.is_empty() && child(node, "joint").is_some() {
                    reader.scene.name = own.to_owned();
                }
                reader.model(node)?;
            }
            "joint" | "include" | "frame" => return Err(reader.foreign(node)),
            "world" | "gravity" | "physics" | "scene" | "light" | "gui" | "atmosphere"
            | "magnetic_field" | "wind" => {}
            other => {
                let what = format!("<{other}>");
                reader.remarks.at(&reader.lines, node, what);
            }
        }
    }
    if count == 0 {
        return Err(reader.lines.refuse(
            around,
            "there is no <model> in it",
            "name a file with one",
        ));
    }
    if reader.scene.name.is_empty() {
        reader.scene.name = name.unwrap_or_default().to_owned();
    }
    reader.couple()?;
    reader.scene.planar(reader.remarks)
}

/// An element inside another one.
pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children()
        .find(|child| child.tag_name().name() == name)
}

/// The text of an element inside another one.
pub(super) fn text<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    child(node, name)?.text().map(str::trim)
}

/// A link or a frame by its name: the body that it belongs to, and where it is in the world.
pub(super) type Frames = HashMap<String, (usize, Isometry3<f64>)>;

/// A joint that follows another one.
pub(super) struct Mimic {
    place: String,
    follower: usize,
    leader: String,
    ratio: f64,
    offset: f64,
}

struct SdfReader {
    lines: XmlLines,
    remarks: Remarks,
    scene: Scene,
    is_before_frames: bool,
    mimics: Vec<Mimic>,
}

/// What has a pose in a model.
struct SdfPlaced<'a, 'i> {
    node: Node<'a, 'i>,
    pose: Isometry3<f64>,
    relative_to: &'a str,
    /// The frame that it moves with; a link moves by itself.
    attached_to: Option<&'a str>,
}

impl SdfReader {
    fn gravity(&mut self, world: Option<Node>) -> Result<(), Refused> {
        self.scene.gravity = Vector3::new(0.0, 0.0, -9.8);
        let holders = [world, world.and_then(|world| child(world, "physics"))];
        let given = holders
            .into_iter()
            .flatten()
            .find_map(|node| child(node, "gravity"));
        match given {
            Some(node) => {
                let text = node.text().unwrap_or_default();
                self.scene.gravity = self.lines.numbers(node, "gravity", text)?.into();
            }
            None => self.remarks.about(
                "gravity",
                "none is given: 9.8 m/s² along −z, the default of SDF",
            ),
        }
        Ok(())
    }

    fn foreign(&self, node: Node) -> Refused {
        let cause = format!("<{}> is not read here", node.tag_name().name());
        let mend = "write one flat model first, as gz sdf -p does";
        self.lines.refuse(node, cause, mend)
    }

    fn model(&mut self, model: Node) -> Result<(), Refused> {
        let lines = &self.lines;
        let (pose, relative_to) = pose(lines, model)?;
        if relative_to.is_some() {
            let mend = "give its pose in the world";
            return Err(lines.refuse(model, "the pose of a model is relative to a frame", mend));
        }
        let mut placed: HashMap<&str, SdfPlaced> = HashMap::new();
        let mut links = Vec::new();
        for node in model.children().filter(Node::is_element) {
            let tag = node.tag_name().name();
            match tag {
                "include" | "model" => return Err(self.foreign(node)),
                "link" | "joint" | "frame" => {}
                "pose" | "static" | "self_collide" | "allow_auto_disable" | "enable_wind" => {
                    continue;
                }
                other => {
                    let what = format!("<{other}>");
                    self.remarks.at(&self.lines, node, what);
                    continue;
                }
            }
            let lines = &self.lines;
            let name = lines.needed(node, "name")?;
            let attached_to = match tag {
                "link" => None,
                "joint" => Some(text(node, "child").unwrap_or_default()),
                _ => Some(node.attribute("attached_to").unwrap_or("__model__")),
            };
            let (pose, relative_to) = self::pose(lines, node)?;
            let relative_to = relative_to.or(attached_to).unwrap_or("__model__");
            if tag == "link" {
                links.push(node);
            }
            let own = SdfPlaced {
                node,
                pose,
                relative_to,
                attached_to,
            };
            if placed.insert(name, own).is_some() {
                let cause = format!("there are two of the name {:?}", short(name));
                return Err(lines.refuse(node, cause, "names in a model are unique"));
            }
            if placed.len() > 3 * MOST_PARTS {
                let mend = format!("{} at most", 3 * MOST_PARTS);
                return Err(lines.refuse(
                    node,
                    "there are too many links, joints and frames",
                    &mend,
                ));
            }
        }
        let is_static = text(model, "static").is_some_and(|flag| flag == "true" || flag == "1");
        let mut bodies: HashMap<&str, usize> = HashMap::from([("world", 0)]);
        for link in &links {
            let name = link.attribute("name").unwrap_or_default();
            bodies.insert(name, self.scene.bodies.len());
            self.scene.bodies.push(Solid {
                name: name.to_owned(),
                ..Solid::default()
            });
        }
        if let Some(first) = links.first().and_then(|link| link.attribute("name")) {
            bodies.insert("__model__", bodies[first]);
        }
        let frames = self.frames(model, pose, &placed, &bodies)?;
        for link in &links {
            let (body, at) = frames[link.attribute("name").unwrap_or_default()];
            if is_static {
                self.scene.holds.push(rigid(*link, &self.lines, [0, body]));
            } else {
                self.link(*link, body, &at)?;
            }
        }
        for frame in model.children().filter(|node| node.has_tag_name("frame")) {
            let name = frame.attribute("name").unwrap_or_default();
            let (body, at) = frames[name];
            let at = Point3::from(at.translation.vector);
            self.scene.bodies[body].sites.push((name.to_owned(), at));
        }
        let held = self.scene.holds.len();
        for joint in model.children().filter(|node| node.has_tag_name("joint")) {
            let name = joint.attribute("name").unwrap_or_default();
            let at = frames[name].1;
            self.joint(joint, &frames, at)?;
        }
        let is_tied = |hold: &Hold| hold.between.contains(&0);
        if !is_static && !links.is_empty() && !self.scene.holds[held..].iter().any(is_tied) {
            let what = "nothing: but no joint ties it to the world; if a link is the frame, add a fixed joint with the parent world";
            self.remarks.at(&self.lines, model, what);
        }
        Ok(())
    }

    /// Where all frames are in the world, and which body each moves with.
    fn frames(
        &self,
        model: Node,
        pose: Isometry3<f64>,
        placed: &HashMap<&str, SdfPlaced>,
        bodies: &HashMap<&str, usize>,
    ) -> Result<Frames, Refused> {
        let lines = &self.lines;
        let mut frames = Frames::from([
            ("world".to_owned(), (0, Isometry3::identity())),
            (
                "__model__".to_owned(),
                (bodies.get("__model__").copied().unwrap_or(0), pose),
            ),
        ]);
        let find = |node: Node, name: &str| {
            placed.get(name).ok_or_else(|| {
                let cause = format!("there is no link, joint or frame {:?}", short(name));
                lines.refuse(node, cause, "name one of the same model, or world")
            })
        };
        let circle = |node: Node| {
            lines.refuse(
                node,
                "frames refer to each other in a circle",
                "give one a pose in __model__",
            )
        };
        for (name, own) in placed {
            // From the frame to one that is known, and back.
            let (mut chain, mut next) = (Vec::new(), *name);
            let mut node = own.node;
            while !frames.contains_key(next) {
                let frame = find(node, next)?;
                chain.push((next, frame));
                if chain.len() > placed.len() {
                    return Err(circle(model));
                }
                (next, node) = (frame.relative_to, frame.node);
            }
            for (name, frame) in chain.into_iter().rev() {
                let at = frames[frame.relative_to].1 * frame.pose;
                let (mut holder, mut steps) = (name, 0);
                let body = loop {
                    if let Some(body) = bodies.get(holder) {
                        break *body;
                    }
                    let next = find(frame.node, holder)?;
                    holder = next.attached_to.unwrap_or("__model__");
                    steps += 1;
                    if steps > placed.len() {
                        return Err(circle(model));
                    }
                };
                frames.insert(name.to_owned(), (body, at));
            }
        }
        Ok(frames)
    }

    fn link(&mut self, link: Node, body: usize, at: &Isometry3<f64>) -> Result<(), Refused> {
        for node in link.children().filter(Node::is_element) {
            match node.tag_name().name() {
                "pose" | "inertial" | "self_collide" | "kinematic" | "enable_wind" => {}
                "gravity" if matches!(node.text().map(str::trim), Some("true" | "1")) => {}
                other => {
                    let what = format!("<{other}>");
                    self.remarks.at(&self.lines, node, what);
                }
            }
        }
        let weight = match child(link, "inertial") {
            Some(inertial) => {
                if inertial
                    .attribute("auto")
                    .is_some_and(|auto| auto == "true" || auto == "1")
                {
                    let what = "auto: mass and inertia are those that stand there";
                    self.remarks.at(&self.lines, inertial, what);
                }
                let (pose, _) = pose(&self.lines, inertial)?;
                let mass = text(inertial, "mass").unwrap_or("1");
                let [mass] = self.lines.numbers(inertial, "mass", mass)?;
                let inertia = child(inertial, "inertia");
                let part =
                    |name: &str, otherwise: f64| match inertia.and_then(|node| text(node, name)) {
                        None => Ok(otherwise),
                        Some(text) => self.lines.numbers(inertial, name, text).map(|[part]| part),
                    };
                let [xx, yy, zz] = [part("ixx", 1.0)?, part("iyy", 1.0)?, part("izz", 1.0)?];
                let [xy, xz, yz] = [part("ixy", 0.0)?, part("ixz", 0.0)?, part("iyz", 0.0)?];
                let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
                weight(&self.lines, inertial, mass, inertia)?.moved(&pose)
            }
            None => {
                let what = "<inertial>, which is missing: 1 kg and 1 kg·m², the default of SDF";
                self.remarks.at(&self.lines, link, what);
                weight(&self.lines, link, 1.0, Matrix3::identity())?
            }
        };
        self.scene.bodies[body].weight = Some(weight.moved(at));
        Ok(())
    }

    fn joint(&mut self, node: Node, frames: &Frames, at: Isometry3<f64>) -> Result<(), Refused> {
        let index = self.scene.holds.len();
        let (hold, mimic) = joint(
            (&self.lines, &mut self.remarks),
            node,
            frames,
            at,
            self.is_before_frames,
        )?;
        self.mimics.extend(mimic.map(|mimic| Mimic {
            follower: index,
            ..mimic
        }));
        self.scene.holds.push(hold);
        Ok(())
    }

    fn couple(&mut self) -> Result<(), Refused> {
        let mimics = std::mem::take(&mut self.mimics);
        follow(&mut self.scene, mimics)
    }
}

/// Joints that follow others as couplings.
pub(super) fn follow(scene: &mut Scene, mimics: Vec<Mimic>) -> Result<(), Refused> {
    let names = scene.holds.iter().enumerate();
    let names: HashMap<String, usize> = names
        .map(|(index, hold)| (hold.name.clone(), index))
        .collect();
    for mimic in mimics {
        let Some(leader) = names.get(&mimic.leader) else {
            let cause = format!("it follows {:?}, which is no joint", short(&mimic.leader));
            return Err(Refused::new(mimic.place, cause, "name a joint"));
        };
        scene.couplings.push(Coupling {
            name: format!("{}_mimic", scene.holds[mimic.follower].name),
            place: mimic.place,
            joints: [mimic.follower, *leader],
            ratio: mimic.ratio,
            offset: mimic.offset,
        });
    }
    Ok(())
}

impl Mimic {
    /// Coordinate = ratio · that of the leader + offset.
    pub(super) fn new(
        place: String,
        follower: usize,
        leader: &str,
        [ratio, offset]: [f64; 2],
    ) -> Mimic {
        Mimic {
            place,
            follower,
            leader: leader.to_owned(),
            ratio,
            offset,
        }
    }
}

/// A mass about the origin of its frame.
pub(super) fn weight(
    lines: &XmlLines,
    node: Node,
    mass: f64,
    inertia: Matrix3<f64>,
) -> Result<Weight, Refused> {
    if mass < 0.0 || (0..3).any(|k| inertia[(k, k)] < 0.0) {
        return Err(lines.refuse(node, "mass or inertia is negative", "0 or more"));
    }
    Ok(Weight {
        mass,
        com: Point3::origin(),
        inertia,
    })
}

/// Both bodies are one.
pub(super) fn rigid(node: Node, lines: &XmlLines, between: [usize; 2]) -> Hold {
    Hold {
        name: node.attribute("name").unwrap_or_default().to_owned(),
        place: lines.place(node),
        between,
        kind: HoldKind::Rigid,
        travel: Travel::default(),
        armature: 0.0,
    }
}

/// A frame from x, y, z and the angles about fixed axes.
pub(super) fn frame([x, y, z, roll, pitch, yaw]: [f64; 6]) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Isometry3::from_parts(Translation3::new(x, y, z), turn)
}

/// The pose in an element, and the frame that it is relative to.
pub(super) fn pose<'a>(
    lines: &XmlLines,
    around: Node<'a, '_>,
) -> Result<(Isometry3<f64>, Option<&'a str>), Refused> {
    let Some(node) = child(around, "pose") else {
        return Ok((Isometry3::identity(), None));
    };
    let relative_to = node.attribute("relative_to").or(node.attribute("frame"));
    let relative_to = relative_to.filter(|name| !name.is_empty());
    let text = node.text().unwrap_or("0 0 0 0 0 0");
    if node.attribute("rotation_format") == Some("quat_xyzw") {
        let [px, py, pz, x, y, z, w] = lines.numbers(node, "pose", text)?;
        let turn = UnitQuaternion::try_new(nalgebra::Quaternion::new(w, x, y, z), 1e-10);
        let Some(turn) = turn else {
            return Err(lines.refuse(
                node,
                "the quaternion is no rotation",
                "0 0 0 1 turns nothing",
            ));
        };
        return Ok((
            Isometry3::from_parts(Translation3::new(px, py, pz), turn),
            relative_to,
        ));
    }
    let mut parts: [f64; 6] = lines.numbers(node, "pose", text)?;
    if node
        .attribute("degrees")
        .is_some_and(|degrees| degrees == "true" || degrees == "1")
    {
        parts[3..]
            .iter_mut()
            .for_each(|angle| *angle = angle.to_radians());
    }
    Ok((frame(parts), relative_to))
}

/// A joint, whose frame is given in the world, and what it follows; the place of the follower is to be set.
pub(super) fn joint(
    (lines, remarks): (&XmlLines, &mut Remarks),
    node: Node,
    frames: &Frames,
    at: Isometry3<f64>,
    is_before_frames: bool,
) -> Result<(Hold, Option<Mimic>), Refused> {
    let end = |name: &str| {
        let Some(link) = text(node, name) else {
            let mend = format!("write <{name}>link</{name}>");
            return Err(lines.refuse(node, format!("the joint has no <{name}>"), &mend));
        };
        lines
            .find(node, "link", link, frames)
            .map(|(body, _)| *body)
    };
    let between = [end("parent")?, end("child")?];
    let kind = lines.needed(node, "type")?;
    let mut hold = rigid(node, lines, between);
    let place = Point3::from(at.translation.vector);
    let both = [place, place];
    match kind {
        "fixed" => return Ok((hold, None)),
        "ball" => {
            remarks.at(lines, node, "turns of a ball joint out of the plane");
            hold.kind = HoldKind::Turn {
                at: both,
                axis: None,
            };
            return Ok((hold, None));
        }
        "revolute" | "continuous" | "prismatic" => {}
        other => {
            let cause = format!("a joint of type {:?} has no counterpart", short(other));
            let mend = "revolute, continuous, prismatic, fixed and ball are read";
            return Err(lines.refuse(node, cause, mend));
        }
    }
    let Some(axis) = child(node, "axis") else {
        return Err(lines.refuse(
            node,
            "the joint has no <axis>",
            "write <axis><xyz>0 1 0</xyz></axis>",
        ));
    };
    let xyz = child(axis, "xyz");
    let direction = xyz.and_then(|xyz| xyz.text()).unwrap_or("0 0 1");
    let direction = lines.numbers(axis, "xyz", direction)?;
    let direction = lines.direction(axis, "xyz", direction)?;
    let in_model = text(axis, "use_parent_model_frame").map(|flag| flag == "1" || flag == "true");
    let seen_from = match xyz.and_then(|xyz| xyz.attribute("expressed_in")) {
        Some(name) if !name.is_empty() => lines.find(axis, "frame", name, frames)?.1,
        _ if in_model.unwrap_or(is_before_frames) => {
            frames.get("__model__").map_or(at, |frame| frame.1)
        }
        _ => at,
    };
    let direction = seen_from.rotation * direction;
    let part = |around: Option<Node>, name: &str, otherwise: f64| {
        match around.and_then(|around| Some((around, text(around, name)?))) {
            None => Ok(otherwise),
            Some((_, "inf" | "+inf" | "Inf" | "INF")) => Ok(f64::INFINITY),
            Some((_, "-inf" | "-Inf" | "-INF")) => Ok(f64::NEG_INFINITY),
            // 1.79769e308 is none, too.
            Some((around, text)) => match text.parse::<f64>() {
                Ok(value) if value.abs() >= ENDLESS => Ok(value.signum() * f64::INFINITY),
                _ => lines.numbers(around, name, text).map(|[value]| value),
            },
        }
    };
    let (limit, dynamics) = (child(axis, "limit"), child(axis, "dynamics"));
    let limits = [
        part(limit, "lower", f64::NEG_INFINITY)?,
        part(limit, "upper", f64::INFINITY)?,
    ];
    let is_endless = limits.iter().all(|end| end.is_infinite()) || kind == "continuous";
    hold.travel = Travel {
        limits: (!is_endless).then_some(limits),
        stiffness: part(dynamics, "spring_stiffness", 0.0)?,
        rest: part(dynamics, "spring_reference", 0.0)?,
        damping: part(dynamics, "damping", 0.0)?,
    };
    let Travel {
        stiffness,
        rest,
        damping,
        ..
    } = hold.travel;
    if !(0.0..ENDLESS).contains(&stiffness)
        || !(0.0..ENDLESS).contains(&damping)
        || rest.is_infinite()
    {
        let cause = "stiffness or damping is negative or endless";
        return Err(lines.refuse(axis, cause, "0 or more"));
    }
    if part(dynamics, "friction", 0.0)? != 0.0 {
        let what = "friction that does not depend on the load";
        remarks.at(lines, axis, what);
    }
    hold.kind = match kind {
        "prismatic" => HoldKind::Slide {
            at: place,
            axis: direction,
        },
        _ => HoldKind::Turn {
            at: both,
            axis: Some(direction),
        },
    };
    if text(axis, "initial_position").is_some_and(|angle| angle.parse() != Ok(0.0)) {
        let what = "initial_position: joints start at zero, where the poses put the links";
        remarks.at(lines, axis, what);
    }
    let mimic = child(axis, "mimic");
    let mimic = mimic.map(|mimic| {
        let leader = lines.needed(mimic, "joint")?;
        let number = |name: &str, otherwise: f64| {
            let given = text(mimic, name).map(|text| lines.numbers(mimic, name, text));
            given
                .transpose()
                .map(|value| value.map_or(otherwise, |[value]| value))
        };
        let ratio = number("multiplier", 1.0)?;
        let offset = number("offset", 0.0)? - ratio * number("reference", 0.0)?;
        Ok(Mimic::new(lines.place(node), 0, leader, [ratio, offset]))
    });
    Ok((hold, mimic.transpose()?))
}

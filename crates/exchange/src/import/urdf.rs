//! URDF, the format of ROS: a tree of links, and extensions that close loops.
//!
//! URDF itself has trees only. What closes loops in files that exist:
//!
//! | element | of |
//! | --- | --- |
//! | `<gazebo><joint>` as in SDF | Gazebo, which reads it as part of its own model |
//! | `<loop_joint>` with `link1`, `link2` | Isaac Sim; older versions of Drake |
//! | `<loop>` with `predecessor`, `successor` | URDF+ (Chignoli et al., arXiv 2411.19753) |
//! | `<constraint>` with `parent_origin`, `child_origin` | ros/urdfdom pull request 264 (2026); `constraint_joint` of the MIT parser |
//! | `<drake:ball_constraint>` | Drake |
//!
//! The model is drawn with all joints at zero, and the link without a parent is the ground.

use std::collections::HashMap;

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use roxmltree::Node;

use super::Imported;
use super::sdf::{self, Frames, Mimic, child, follow, rigid, text, weight};
use super::spatial::{Hold, HoldKind, Scene, Solid, Travel};
use super::xml::{self, Remarks, XmlLines, short};
use crate::source::{MOST_PARTS, Refused};

/// Reads a robot.
pub(super) fn read(text: &str) -> Result<Imported, Refused> {
    let document = xml::parse(text, "robot")?;
    let root = document.root_element();
    let mut reader = UrdfReader {
        lines: XmlLines::of(text),
        remarks: Remarks::default(),
        scene: Scene {
            from: "URDF",
            name: root.attribute("name").unwrap_or_default().to_owned(),
            gravity: Vector3::new(0.0, 0.0, -9.81),
            ..Scene::default()
        },
        mimics: Vec::new(),
    };
    reader.robot(root)?;
    follow(&mut reader.scene, reader.mimics)?;
    reader.scene.planar(reader.remarks)
}

struct UrdfReader {
    lines: XmlLines,
    remarks: Remarks,
    scene: Scene,
    mimics: Vec<Mimic>,
}

impl UrdfReader {
    fn robot(&mut self, root: Node) -> Result<(), Refused> {
        let elements: Vec<Node> = root.children().filter(Node::is_element).collect();
        let is_macro = |node: &Node| {
            let space = node.tag_name().namespace().unwrap_or_default();
            space.ends_with("xacro") || node.attributes().any(|value| value.value().contains("${"))
        };
        if let Some(node) = root.descendants().filter(Node::is_element).find(is_macro) {
            return Err(xml::xacro(self.lines.place(node)));
        }
        let of = |tag: &str| -> Vec<Node> {
            elements
                .iter()
                .copied()
                .filter(|node| node.tag_name().name() == tag)
                .collect()
        };
        let (links, joints) = (of("link"), of("joint"));
        if links.len().max(joints.len()) > MOST_PARTS {
            let mend = format!("{MOST_PARTS} at most");
            return Err(self
                .lines
                .refuse(root, "there are too many links or joints", &mend));
        }
        let frames = self.tree(root, &links, &joints)?;
        for link in &links {
            let (body, at) = frames[link.attribute("name").unwrap_or_default()];
            self.link(*link, body, &at)?;
        }
        for joint in &joints {
            self.joint(*joint, &frames)?;
        }
        for node in elements {
            match node.tag_name().name() {
                "link" | "joint" | "material" => {}
                "gazebo" => self.gazebo(node, &frames)?,
                "loop_joint" | "loop" | "constraint" | "constraint_joint" => {
                    self.closer(node, &frames)?;
                }
                "ball_constraint" => self.ball(node, &frames)?,
                other => {
                    let what = format!("<{other}>");
                    self.remarks.at(&self.lines, node, what);
                }
            }
        }
        if self.scene.bodies.iter().any(|body| body.weight.is_some()) {
            self.remarks
                .about("gravity", "URDF has none: 9.81 m/s² along −z");
        }
        Ok(())
    }

    /// Bodies, the ground first, and where they are.
    fn tree(&mut self, root: Node, links: &[Node], joints: &[Node]) -> Result<Frames, Refused> {
        let lines = &self.lines;
        let mut names = HashMap::new();
        for link in links {
            let name = lines.needed(*link, "name")?;
            if names.insert(name.to_owned(), *link).is_some() {
                let cause = format!("there are two links {:?}", short(name));
                return Err(lines.refuse(*link, cause, "names of links are unique"));
            }
        }
        let mut parents: HashMap<&str, &str> = HashMap::new();
        let mut children: HashMap<&str, Vec<(&str, Isometry3<f64>)>> = HashMap::new();
        for joint in joints {
            let [parent, own] = ["parent", "child"].map(|tag| link_of(lines, *joint, tag));
            let (parent, own) = (parent?, own?);
            for name in [parent, own] {
                lines.find(*joint, "link", name, &names)?;
            }
            if parents.insert(own, parent).is_some() {
                let cause = format!("link {:?} has two parents: URDF is a tree", short(own));
                let mend = "close the loop by a <joint> inside <gazebo>, or a <loop_joint>";
                return Err(lines.refuse(*joint, cause, mend));
            }
            let origin = origin(lines, *joint, "origin")?;
            children.entry(parent).or_default().push((own, origin));
        }
        let roots = links.iter().filter_map(|link| link.attribute("name"));
        let roots: Vec<&str> = roots.filter(|name| !parents.contains_key(name)).collect();
        let [ground] = roots.as_slice() else {
            let few = roots.iter().take(4).map(|name| short(name));
            let (cause, mend) = match roots.len() {
                0 => ("no link is without parent".to_owned(), "a tree has a root"),
                _ => (
                    format!(
                        "several links have no parent: {}",
                        few.collect::<Vec<_>>().join(", ")
                    ),
                    "join all but one of them by joints",
                ),
            };
            return Err(lines.refuse(root, cause, mend));
        };
        let mut frames = Frames::from([((*ground).to_owned(), (0, Isometry3::identity()))]);
        let mut open = vec![(*ground, Isometry3::identity())];
        while let Some((name, at)) = open.pop() {
            for (child, origin) in children.remove(name).unwrap_or_default() {
                open.push((child, at * origin));
                frames.insert(child.to_owned(), (0, at * origin));
            }
        }
        let is_reached =
            |link: &&Node| frames.contains_key(link.attribute("name").unwrap_or_default());
        if let Some(link) = links.iter().find(|link| !is_reached(link)) {
            let mend = "every link hangs on the root by joints";
            return Err(lines.refuse(*link, "it is its own parent", mend));
        }
        frames
            .entry("world".to_owned())
            .or_insert((0, Isometry3::identity()));
        // The ground first, the others in the order of the file.
        self.scene.bodies.push(Solid {
            name: (*ground).to_owned(),
            ..Solid::default()
        });
        for link in links {
            let name = link.attribute("name").unwrap_or_default();
            if name == *ground {
                continue;
            }
            if let Some(frame) = frames.get_mut(name) {
                frame.0 = self.scene.bodies.len();
            }
            self.scene.bodies.push(Solid {
                name: name.to_owned(),
                ..Solid::default()
            });
        }
        Ok(frames)
    }

    fn link(&mut self, link: Node, body: usize, at: &Isometry3<f64>) -> Result<(), Refused> {
        for node in link.children().filter(Node::is_element) {
            match node.tag_name().name() {
                "inertial" => {}
                other => {
                    let what = format!("<{other}>");
                    self.remarks.at(&self.lines, node, what);
                }
            }
        }
        let Some(inertial) = child(link, "inertial").filter(|_| body > 0) else {
            return Ok(());
        };
        let lines = &self.lines;
        let value = |tag: &str, name: &str, otherwise: f64| {
            let given = child(inertial, tag).and_then(|node| Some((node, node.attribute(name)?)));
            let given = given.map(|(node, text)| lines.numbers(node, name, text));
            given
                .transpose()
                .map(|value| value.map_or(otherwise, |[value]| value))
        };
        let mass = value("mass", "value", 0.0)?;
        let part = |name: &str| value("inertia", name, 0.0);
        let [xx, yy, zz] = [part("ixx")?, part("iyy")?, part("izz")?];
        let [xy, xz, yz] = [part("ixy")?, part("ixz")?, part("iyz")?];
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let frame = origin(lines, inertial, "origin")?;
        let weight = weight(lines, inertial, mass, inertia)?.moved(&frame);
        self.scene.bodies[body].weight = Some(weight.moved(at));
        Ok(())
    }

    fn joint(&mut self, node: Node, frames: &Frames) -> Result<(), Refused> {
        let lines = &self.lines;
        let [parent, own] = ["parent", "child"].map(|tag| link_of(lines, node, tag));
        let ((first, _), (second, at)) = (frames[parent?], frames[own?]);
        let mut hold = rigid(node, lines, [first, second]);
        let axis = attribute(lines, node, "axis", "xyz", [1.0, 0.0, 0.0])?;
        let axis = at.rotation * lines.direction(node, "axis", axis)?;
        let place = Point3::from(at.translation.vector);
        let one =
            |tag: &str, name: &str| attribute(lines, node, tag, name, [0.0]).map(|[value]| value);
        let kind = lines.needed(node, "type")?;
        hold.kind = match kind {
            "revolute" | "continuous" => HoldKind::Turn {
                at: [place, place],
                axis: Some(axis),
            },
            "prismatic" => HoldKind::Slide { at: place, axis },
            "fixed" => {
                // Frames without anything are points of interest.
                let name = link_of(lines, node, "child")?.to_owned();
                self.scene.bodies[second].sites.push((name, place));
                HoldKind::Rigid
            }
            "planar" => HoldKind::Free { normal: Some(axis) },
            "floating" => HoldKind::Free { normal: None },
            other => {
                let cause = format!("a joint of type {:?} has no counterpart", short(other));
                let mend = "revolute, continuous, prismatic, fixed, planar and floating are read";
                return Err(lines.refuse(node, cause, mend));
            }
        };
        let limits = [one("limit", "lower")?, one("limit", "upper")?];
        let is_limited =
            child(node, "limit").is_some() && (kind == "revolute" || kind == "prismatic");
        let damping = one("dynamics", "damping")?;
        if damping < 0.0 {
            return Err(lines.refuse(node, "damping is negative", "0 or more"));
        }
        hold.travel = Travel {
            limits: (is_limited && limits != [0.0; 2]).then_some(limits),
            damping,
            ..Travel::default()
        };
        if let Some(mimic) = child(node, "mimic") {
            let leader = lines.needed(mimic, "joint")?;
            let [ratio] = attribute(lines, node, "mimic", "multiplier", [1.0])?;
            let law = [ratio, one("mimic", "offset")?];
            let mimic = Mimic::new(lines.place(node), self.scene.holds.len(), leader, law);
            self.mimics.push(mimic);
        }
        if one("dynamics", "friction")? != 0.0 {
            let what = "friction that does not depend on the load";
            self.remarks.at(lines, node, what);
        }
        for (tag, names) in [
            ("limit", ["effort", "velocity"].as_slice()),
            ("safety_controller", &[]),
            ("calibration", &[]),
        ] {
            let Some(part) = child(node, tag) else {
                continue;
            };
            let what = match names.iter().any(|name| part.has_attribute(*name)) {
                true => "effort and velocity of limits".to_owned(),
                false if names.is_empty() => format!("<{tag}>"),
                false => continue,
            };
            self.remarks.at(lines, part, what);
        }
        self.scene.holds.push(hold);
        Ok(())
    }

    /// Joints of SDF, which may close loops.
    fn gazebo(&mut self, node: Node, frames: &Frames) -> Result<(), Refused> {
        for part in node.children().filter(Node::is_element) {
            if !part.has_tag_name("joint") {
                let what = format!("<{}> in <gazebo>", part.tag_name().name());
                self.remarks.at(&self.lines, part, what);
                continue;
            }
            let (pose, relative_to) = sdf::pose(&self.lines, part)?;
            let base = match relative_to.or(text(part, "child")) {
                Some(name) => self.lines.find(part, "link", name, frames)?.1,
                None => Isometry3::identity(),
            };
            let tools = (&self.lines, &mut self.remarks);
            let (hold, mimic) = sdf::joint(tools, part, frames, base * pose, false)?;
            if mimic.is_some() {
                self.remarks.at(&self.lines, part, "<mimic> in <gazebo>");
            }
            self.scene.holds.push(hold);
        }
        Ok(())
    }

    /// Two frames of links that coincide.
    fn closer(&mut self, node: Node, frames: &Frames) -> Result<(), Refused> {
        let lines = &self.lines;
        let pairs = [
            ["link1", "link2"],
            ["predecessor", "successor"],
            ["parent", "child"],
        ];
        let is_there = |pair: &&[&str; 2]| child(node, pair[0]).is_some();
        let Some(pair) = pairs.iter().find(is_there) else {
            let mend = "name both links: <link1 link=\"…\"/>, <link2 link=\"…\"/>";
            return Err(lines.refuse(node, "it names no links", mend));
        };
        // Some files call both of them link1.
        let mut doubles = node.children().filter(|child| child.has_tag_name(pair[0]));
        let second = child(node, pair[1]).or_else(|| doubles.nth(1));
        let (Some(a), Some(b)) = (child(node, pair[0]), second) else {
            let cause = format!("it has no <{}>", pair[1]);
            return Err(lines.refuse(node, cause, "a loop is closed between two links"));
        };
        let end = |part: Node, tag: &str| -> Result<(usize, Isometry3<f64>), Refused> {
            let name = lines.needed(part, "link")?;
            let (body, at) = lines.find(part, "link", name, frames)?;
            let separate = format!("{tag}_origin");
            let own = if child(node, &separate).is_some() {
                origin(lines, node, &separate)?
            } else if child(part, "origin").is_some() {
                origin(lines, part, "origin")?
            } else {
                placed(lines, part)?
            };
            Ok((*body, at * own))
        };
        let (first, second) = (end(a, pair[0])?, end(b, pair[1])?);
        let at = [first, second].map(|(_, frame)| Point3::from(frame.translation.vector));
        let tag = ["axis", "parent_axis"]
            .into_iter()
            .find(|tag| child(node, tag).is_some());
        let axis = tag.map(|tag| {
            let axis = attribute(lines, node, tag, "xyz", [0.0, 0.0, 1.0])?;
            Ok(first.1.rotation * lines.direction(node, tag, axis)?)
        });
        let axis = axis.transpose()?;
        let mut hold = rigid(node, lines, [first.0, second.0]);
        hold.kind = match lines.needed(node, "type")? {
            "revolute" | "continuous" => HoldKind::Turn { at, axis },
            "spherical" | "ball" | "position" | "point" => HoldKind::Turn { at, axis: None },
            "fixed" => HoldKind::Weld {
                at,
                turn: first.1.rotation * second.1.rotation.inverse(),
            },
            other => {
                let cause = format!("a loop of type {:?} has no counterpart", short(other));
                let mend = "revolute, continuous, spherical and fixed are read";
                return Err(lines.refuse(node, cause, mend));
            }
        };
        self.scene.holds.push(hold);
        Ok(())
    }

    fn ball(&mut self, node: Node, frames: &Frames) -> Result<(), Refused> {
        let lines = &self.lines;
        let end = |body: &str, point: &str| {
            let part = |name: &str| {
                let mend = format!("write <drake:{name} …/>");
                child(node, name)
                    .ok_or_else(|| lines.refuse(node, format!("it has no {name}"), &mend))
            };
            let (body, point) = (part(body)?, part(point)?);
            let name = lines.needed(body, "name")?;
            let (body, at) = lines.find(node, "link", name, frames)?;
            let place: [f64; 3] = lines.numbers(point, "value", lines.needed(point, "value")?)?;
            Ok::<_, Refused>((*body, at * Point3::from(place)))
        };
        let first = end("ball_constraint_body_A", "ball_constraint_p_AP")?;
        let second = end("ball_constraint_body_B", "ball_constraint_p_BQ")?;
        let hold = rigid(node, lines, [first.0, second.0]);
        self.scene.holds.push(Hold {
            name: "ball_constraint".to_owned(),
            kind: HoldKind::Turn {
                at: [first.1, second.1],
                axis: None,
            },
            ..hold
        });
        Ok(())
    }
}

/// The link that an element of a joint names.
fn link_of<'a>(lines: &XmlLines, joint: Node<'a, '_>, tag: &str) -> Result<&'a str, Refused> {
    let Some(node) = child(joint, tag) else {
        let mend = format!("write <{tag} link=\"…\"/>");
        return Err(lines.refuse(joint, format!("the joint has no <{tag}>"), &mend));
    };
    lines.needed(node, "link")
}

/// Numbers of an attribute of an element inside another one.
fn attribute<const N: usize>(
    lines: &XmlLines,
    around: Node,
    tag: &str,
    name: &str,
    otherwise: [f64; N],
) -> Result<[f64; N], Refused> {
    let given = child(around, tag).and_then(|node| Some((node, node.attribute(name)?)));
    let given = given.map(|(node, text)| lines.numbers(node, name, text));
    given.transpose().map(|values| values.unwrap_or(otherwise))
}

/// The frame in an element inside another one.
fn origin(lines: &XmlLines, around: Node, tag: &str) -> Result<Isometry3<f64>, Refused> {
    child(around, tag).map_or(Ok(Isometry3::identity()), |node| placed(lines, node))
}

/// The frame by `xyz` and `rpy` of an element.
fn placed(lines: &XmlLines, node: Node) -> Result<Isometry3<f64>, Refused> {
    let part = |name: &str| match node.attribute(name) {
        Some(text) => lines.numbers(node, name, text),
        None => Ok([0.0; 3]),
    };
    let ([x, y, z], [roll, pitch, yaw]) = (part("xyz")?, part("rpy")?);
    Ok(sdf::frame([x, y, z, roll, pitch, yaw]))
}

//! What closes loops and what pulls: equalities, tendons, actuators.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion};
use roxmltree::Node;

use super::super::spatial::{Cord, Coupling, Hold, HoldKind, Travel};
use super::super::xml::short;
use super::{MjcfReader, Poses, quaternion};
use crate::source::Refused;

impl<'a, 'i> MjcfReader<'a, 'i> {
    pub(super) fn equality(&mut self, node: Node<'a, 'i>, poses: &Poses) -> Result<(), Refused> {
        let tag = node.tag_name().name();
        let name = node.attribute("name").unwrap_or(tag).to_owned();
        let levels = self.levels(node, "main");
        if levels.iter().find_map(|level| level.attribute("active")) == Some("false") {
            self.remarks
                .at(&self.lines, node, "an equality that is not active");
            return Ok(());
        }
        let place = self.lines.place(node);
        let lines = &self.lines;
        let body = |name: &str| match node.attribute(name) {
            Some(body) => lines.find(node, "body", body, &self.bodies).copied(),
            None if name == "body2" => Ok(0),
            None => lines.needed(node, name).map(|_| 0),
        };
        match tag {
            "connect" | "weld" => {
                let sites = node.attribute("site1").zip(node.attribute("site2"));
                let sites = sites.map(|(a, b)| {
                    let site = |name: &str| lines.find(node, "site", name, &self.sites).copied();
                    Ok((site(a)?, site(b)?))
                });
                let (ends, turn) = match sites.transpose()? {
                    Some(ends) => (ends, UnitQuaternion::identity()),
                    None => self.anchored(node, [body("body1")?, body("body2")?], poses)?,
                };
                let ((first, a), (second, b)) = ends;
                let at = [poses.start[first] * a, poses.start[second] * b];
                let kind = match tag {
                    "connect" => HoldKind::Turn { at, axis: None },
                    _ => HoldKind::Weld { at, turn },
                };
                self.scene.holds.push(Hold {
                    name,
                    place,
                    between: [first, second],
                    kind,
                    travel: Travel::default(),
                    armature: 0.0,
                });
                Ok(())
            }
            "joint" => self.coupling(node, name, place),
            other => {
                let what = format!("an equality of kind {other}");
                self.remarks.at(&self.lines, node, what);
                Ok(())
            }
        }
    }

    /// Both ends of an equality in the frames of their bodies, and how a weld turns the second one.
    #[allow(clippy::type_complexity)]
    fn anchored(
        &self,
        node: Node,
        [first, second]: [usize; 2],
        poses: &Poses,
    ) -> Result<
        (
            ((usize, Point3<f64>), (usize, Point3<f64>)),
            UnitQuaternion<f64>,
        ),
        Refused,
    > {
        let between = poses.reference[first].inverse() * poses.reference[second];
        if node.has_tag_name("connect") {
            let anchor = self.lines.needed(node, "anchor")?;
            let anchor: Point3<f64> = self.lines.numbers(node, "anchor", anchor)?.into();
            let ends = ((first, anchor), (second, between.inverse() * anchor));
            return Ok((ends, UnitQuaternion::identity()));
        }
        let mut pose = between;
        if let Some(text) = node.attribute("relpose") {
            let [x, y, z, w, i, j, k] = self.lines.numbers(node, "relpose", text)?;
            if [w, i, j, k] != [0.0; 4] {
                let turn = quaternion(&self.lines, node, "relpose", [w, i, j, k])?;
                pose = Isometry3::from_parts(Translation3::new(x, y, z), turn);
            }
        }
        let start = [first, second].map(|body| poses.start[body].rotation);
        let turn = start[0] * pose.rotation * start[1].inverse();
        let at = Point3::from(pose.translation.vector);
        Ok((((first, at), (second, Point3::origin())), turn))
    }

    fn coupling(&mut self, node: Node<'a, 'i>, name: String, place: String) -> Result<(), Refused> {
        let lines = &self.lines;
        let poly = node.attribute("polycoef").unwrap_or("0 1");
        let poly = lines.list(node, "polycoef", poly)?;
        let [Some(offset), Some(ratio)] = [0, 1].map(|k| poly.get(k).copied().or(Some(k as f64)))
        else {
            return Ok(());
        };
        let joint = |name: &str| lines.find(node, "joint", name, &self.joints).copied();
        let first = joint(lines.needed(node, "joint1")?)?;
        let second = node.attribute("joint2").map(joint).transpose()?;
        let joints =
            second.map(|second| [first, second].map(|joint| self.holds.get(&joint).copied()));
        let (Some([Some(a), Some(b)]), true) = (joints, poly.iter().skip(2).all(|c| *c == 0.0))
        else {
            let what = "an equality of joints: only a linear one of two joints, each alone in its body, is a gear";
            self.remarks.at(&self.lines, node, what);
            return Ok(());
        };
        // From the reference position to the drawing.
        let moved = |(body, k): (usize, usize), hold: usize| {
            let joint = &self.tree.branches[body].joints[k];
            let rest = self.scene.holds[hold].travel.rest;
            joint.rest - rest - joint.reference
        };
        let offset = offset + ratio * moved(second.unwrap_or(first), b) - moved(first, a);
        let offset = if offset.abs() < 1e-14 { 0.0 } else { offset };
        self.scene.couplings.push(Coupling {
            name,
            place,
            joints: [a, b],
            ratio,
            offset,
        });
        Ok(())
    }

    pub(super) fn tendon(&mut self, node: Node<'a, 'i>, poses: &Poses) -> Result<(), Refused> {
        let mut levels = self.levels(node, "main");
        // Defaults of tendons are called so, whatever they are.
        let class = node.attribute("class").unwrap_or("main");
        levels.extend(self.defaults.get(&(class, "tendon")).into_iter().flatten());
        let (stiffness, damping) = (
            self.linear(&levels, "stiffness")?,
            self.linear(&levels, "damping")?,
        );
        let parts: Vec<Node> = node.children().filter(Node::is_element).collect();
        let is_plain = parts.len() >= 2 && parts.iter().all(|part| part.has_tag_name("site"));
        if !node.has_tag_name("spatial") || !is_plain || (stiffness == 0.0 && damping == 0.0) {
            let what = "a tendon: only one with stiffness or damping through sites is a spring";
            self.remarks.at(&self.lines, node, what);
            return Ok(());
        }
        for name in ["range", "frictionloss", "armature"] {
            if levels.iter().any(|level| level.has_attribute(name)) {
                let what = format!("{name} of a tendon");
                self.remarks.at(&self.lines, node, what);
            }
        }
        let site = |part: &Node| {
            let name = self.lines.needed(*part, "site")?;
            self.lines.find(*part, "site", name, &self.sites).copied()
        };
        let sites = parts.iter().map(site).collect::<Result<Vec<_>, _>>()?;
        let place = |poses: &[Isometry3<f64>]| -> Vec<Point3<f64>> {
            sites.iter().map(|(body, at)| poses[*body] * at).collect()
        };
        let length =
            |at: Vec<Point3<f64>>| at.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum();
        let rest = self.list(&levels, "springlength")?.unwrap_or_default();
        let (least, most) = match rest.as_slice() {
            [length] if *length >= 0.0 => (*length, *length),
            [least, most] if *least >= 0.0 => (*least, *most),
            _ => {
                let length: f64 = length(place(&poses.spring));
                (length, length)
            }
        };
        let is_cable = least == 0.0 && most > 0.0;
        let is_known = match is_cable {
            true => stiffness > 0.0,
            false => least == most && sites.len() == 2,
        };
        if !is_known {
            let what =
                "a tendon: a spring has two sites and one length, a cable a springlength from 0";
            self.remarks.at(&self.lines, node, what);
            return Ok(());
        }
        let bodies = sites.iter().map(|(body, _)| *body);
        self.scene.cords.push(Cord {
            name: node.attribute("name").unwrap_or("tendon").to_owned(),
            place: self.lines.place(node),
            through: bodies.zip(place(&poses.start)).collect(),
            stiffness,
            damping,
            free_length: most,
            is_cable,
        });
        Ok(())
    }

    pub(super) fn actuator(&mut self, node: Node) {
        let tag = node.tag_name().name();
        let joint = node.attribute("joint").or(node.attribute("jointinparent"));
        let of = joint.map_or(String::new(), |joint| format!(" on joint {}", short(joint)));
        let what = format!("<{tag}>{of}: a program sets it; add a driver, a torque or a force");
        self.remarks.at(&self.lines, node, what);
    }
}

//! MJCF, the format of MuJoCo.
//!
//! The plane is x–z of MuJoCo: x stays, y becomes z, and angles turn about −y, so that they keep their signs. MuJoCo has a tree of bodies;
//! a minimal spanning tree of the joints gives it, slides first, as only pins and welds can close loops there (`connect`, `weld`). The
//! coordinates of its joints are the angles and slides of ours.

use std::collections::HashMap;
use std::fmt::Write;

use linkdyn_model::force::{ForceKind, Value};
use linkdyn_model::joint::{Joint, JointKind};
use linkdyn_model::{Checked, GROUND, PointRef};
use petgraph::algo::min_spanning_tree;
use petgraph::data::Element;
use petgraph::graph::{NodeIndex, UnGraph};

use super::Exported;
use crate::source::{LeftOut, MOST_PARTS, Refused};

/// Share of the mean mass, and of the mean inertia, that a body without gets: MuJoCo has no bodies without mass.
const TINY: f64 = 1e-6;
/// Smaller parts of numbers are rounding [m, rad].
const ROUND_OFF: f64 = 1e-15;

/// Writes a model; `poses` are places and angles of its bodies' frames where it is assembled.
///
/// # Errors
/// Where a joint has no counterpart.
pub fn mjcf(model: &Checked, poses: &[(String, [f64; 3])]) -> Result<Exported, Refused> {
    if model.bodies.len().max(model.joints.len()) > MOST_PARTS {
        let cause = format!("{} bodies are too many", model.bodies.len());
        return Err(Refused::new("", cause, format!("{MOST_PARTS} at most")));
    }
    let mut writer = MjcfWriter {
        model,
        poses: poses
            .iter()
            .map(|(name, pose)| (name.as_str(), *pose))
            .collect(),
        trunk: HashMap::new(),
        closers: Vec::new(),
        left_out: Vec::new(),
        springs: HashMap::new(),
        origins: HashMap::new(),
        tiny: tiny(model),
    };
    writer.refuse()?;
    writer.span()?;
    let tendons = writer.forces();
    let world = writer.world();
    let equalities = writer.equalities()?;
    writer.omit();
    let name = model.name.as_deref().unwrap_or("linkdyn");
    let [x, y] = model.gravity;
    let mut text = format!(
        "<mujoco model=\"{}\">\n  <compiler angle=\"radian\" autolimits=\"true\"/>\n  \
         <option gravity=\"{} 0 {}\" integrator=\"RK4\" timestep=\"0.001\"/>\n  \
         <default>\n    <equality solref=\"0.002 1\" solimp=\"0.99 0.9999 0.0001 0.5 2\"/>\n  </default>\n",
        escaped(name),
        shown(x),
        shown(y)
    );
    for (tag, body) in [
        ("worldbody", world),
        ("equality", equalities),
        ("tendon", tendons),
    ] {
        if !body.is_empty() {
            // Into a String it cannot fail.
            let _ = write!(text, "  <{tag}>\n{body}  </{tag}>\n");
        }
    }
    text.push_str("</mujoco>\n");
    let left_out = writer.left_out;
    Ok(Exported { text, left_out })
}

/// A joint of the tree: its name, the body that it holds up, and whether that is its first one.
#[derive(Clone, Copy)]
struct Limb<'a> {
    joint: &'a str,
    child: &'a str,
    is_reversed: bool,
}

struct MjcfWriter<'a> {
    model: &'a Checked,
    poses: HashMap<&'a str, [f64; 3]>,
    /// Of each body what it carries.
    trunk: HashMap<&'a str, Vec<Limb<'a>>>,
    closers: Vec<&'a str>,
    left_out: Vec<LeftOut>,
    /// Of joints of the tree stiffness, damping and the angle without torque.
    springs: HashMap<&'a str, [f64; 3]>,
    /// Where the frame of a body in MJCF has its origin, in that of the model.
    origins: HashMap<&'a str, [f64; 2]>,
    tiny: [f64; 2],
}

/// Mass and inertia of bodies without.
fn tiny(model: &Checked) -> [f64; 2] {
    let mean = |of: fn(&linkdyn_model::Body) -> Option<f64>| {
        let values: Vec<f64> = model
            .bodies
            .values()
            .filter_map(of)
            .filter(|v| *v > 0.0)
            .collect();
        match values.len() {
            0 => 1.0,
            count => values.iter().sum::<f64>() / count as f64,
        }
    };
    [
        mean(|body| body.mass) * TINY,
        mean(|body| body.inertia) * TINY,
    ]
}

impl<'a> MjcfWriter<'a> {
    fn pose(&self, body: &str) -> [f64; 3] {
        self.poses.get(body).copied().unwrap_or_default()
    }

    fn point(&self, point: &PointRef) -> [f64; 2] {
        let body = self.model.bodies.get(&point.body);
        let point = body.and_then(|body| body.points.get(&point.point));
        point.copied().unwrap_or_default()
    }

    /// Whether both are one point of a body.
    fn is_same(&self, a: &PointRef, b: &PointRef) -> bool {
        a.body == b.body && self.point(a) == self.point(b)
    }

    fn left_out(&mut self, place: String, what: impl Into<String>) {
        let what = what.into();
        self.left_out.push(LeftOut { place, what });
    }

    /// Joints without counterpart hold something, so that nothing is written without them.
    fn refuse(&self) -> Result<(), Refused> {
        if self.model.bodies.contains_key("world") {
            let cause = "MuJoCo calls the ground so";
            return Err(Refused::new("body world", cause, "rename it"));
        }
        for (name, joint) in &self.model.joints {
            match joint.kind {
                JointKind::Revolute { .. }
                | JointKind::Prismatic { .. }
                | JointKind::Slot { .. }
                | JointKind::Gear { .. }
                | JointKind::Fixed { .. } => {}
                JointKind::Cam(_)
                | JointKind::Rack { .. }
                | JointKind::Rolling { .. }
                | JointKind::Belt { .. }
                | JointKind::Bushing(_)
                | JointKind::Beam(_)
                | JointKind::Contact { .. } => {
                    let cause = format!("MJCF has no joint of type {}", joint.kind.word());
                    let mend = "revolute, prismatic, slot, gear and fixed are written";
                    return Err(Refused::new(format!("joint {name}"), cause, mend));
                }
            }
        }
        Ok(())
    }

    /// The spanning tree, from the ground and from one body of each part that is free.
    fn span(&mut self) -> Result<(), Refused> {
        let model = self.model;
        let mut graph = UnGraph::<&str, (u8, usize)>::new_undirected();
        let ground = graph.add_node(GROUND);
        let mut nodes: HashMap<&str, NodeIndex> = HashMap::from([(GROUND, ground)]);
        for name in model.bodies.keys().filter(|name| *name != GROUND) {
            nodes.insert(name, graph.add_node(name));
        }
        let sprung = model.forces.values().filter_map(|force| match &force.kind {
            ForceKind::TorsionSpring {
                between: [a, b], ..
            } => Some([a.min(b), a.max(b)]),
            _ => None,
        });
        let sprung: Vec<[&String; 2]> = sprung.collect();
        let geared = model
            .joints
            .values()
            .filter(|joint| matches!(joint.kind, JointKind::Gear { .. }));
        let geared: Vec<&PointRef> = geared.flat_map(|gear| &gear.between).collect();
        for (index, joint) in model.joints.values().enumerate() {
            // Closers have neither limits nor springs.
            let has_more = joint.stops.limits.is_some()
                || sprung.contains(&pair(joint))
                || joint
                    .between
                    .iter()
                    .any(|end| geared.iter().any(|wheel| self.is_same(wheel, end)));
            let rank = match joint.kind {
                JointKind::Gear { .. } => continue,
                JointKind::Prismatic { .. } | JointKind::Slot { .. } => 0,
                _ if has_more => 1,
                _ => 2,
            };
            let [a, b] = [0, 1].map(|end: usize| nodes[joint.between[end].body.as_str()]);
            graph.add_edge(a, b, (rank, index));
        }
        let mut is_in_tree = vec![false; model.joints.len()];
        for element in min_spanning_tree(&graph) {
            if let Element::Edge { weight, .. } = element {
                is_in_tree[weight.1] = true;
            }
        }
        let mut adjacent: HashMap<&str, Vec<(&str, &Joint)>> = HashMap::new();
        for (index, (name, joint)) in model.joints.iter().enumerate() {
            if is_in_tree[index] {
                for end in &joint.between {
                    adjacent.entry(&end.body).or_default().push((name, joint));
                }
            } else {
                match joint.kind {
                    JointKind::Revolute { .. } | JointKind::Fixed { .. } => self.closers.push(name),
                    JointKind::Gear { .. } => {}
                    _ => {
                        let cause = "it closes a loop of slides alone, which MuJoCo cannot close";
                        let mend = "a loop is closed at a revolute or a fixed joint";
                        return Err(Refused::new(format!("joint {name}"), cause, mend));
                    }
                }
            }
        }
        let mut is_seen: HashMap<&str, ()> = HashMap::new();
        let roots = std::iter::once(GROUND).chain(model.bodies.keys().map(String::as_str));
        for root in roots {
            if is_seen.insert(root, ()).is_some() {
                continue;
            }
            if root != GROUND {
                let limb = Limb {
                    joint: "",
                    child: root,
                    is_reversed: false,
                };
                self.trunk.entry(GROUND).or_default().push(limb);
            }
            let mut open = vec![root];
            while let Some(body) = open.pop() {
                for (name, joint) in adjacent.get(body).into_iter().flatten() {
                    let is_reversed = joint.between[0].body != body;
                    let child = joint.between[usize::from(!is_reversed)].body.as_str();
                    if is_seen.insert(child, ()).is_some() {
                        continue;
                    }
                    let limb = Limb {
                        joint: name,
                        child,
                        is_reversed,
                    };
                    self.trunk.entry(body).or_default().push(limb);
                    open.push(child);
                }
            }
        }
        Ok(())
    }

    /// Springs as tendons, those of angles for the joints.
    fn forces(&mut self) -> String {
        let model = self.model;
        let mut text = String::new();
        for (name, force) in &model.forces {
            let place = format!("force {name}");
            if force.limits().is_some() {
                self.left_out(place.clone(), "the ends of its stroke");
            }
            let tendon = |stiffness: f64, damping: f64, lengths: String, through: &[PointRef]| {
                let sites = through.iter().map(|point| {
                    format!("      <site site=\"{}\"/>\n", escaped(&point.to_string()))
                });
                format!(
                    "    <spatial name=\"{}\" stiffness=\"{}\" damping=\"{}\" springlength=\"{lengths}\">\n{}    </spatial>\n",
                    escaped(name),
                    shown(stiffness),
                    shown(damping),
                    sites.collect::<String>()
                )
            };
            match &force.kind {
                ForceKind::Spring {
                    between,
                    stiffness,
                    damping,
                    free_length: Value::Constant(free),
                } if *free >= 0.0 => {
                    text += &tendon(*stiffness, *damping, shown(*free), between);
                }
                ForceKind::Cable {
                    through,
                    stiffness,
                    damping,
                    free_length: Value::Constant(free),
                } if *free > 0.0 => {
                    if *damping > 0.0 {
                        let what = "the damping of a tendon also acts where it is slack";
                        self.left_out(place, what);
                    }
                    let lengths = format!("0 {}", shown(*free));
                    text += &tendon(*stiffness, *damping, lengths, through);
                }
                ForceKind::TorsionSpring {
                    between: [a, b],
                    stiffness,
                    damping,
                    free_angle: Value::Constant(free),
                } => {
                    let limbs = self
                        .trunk
                        .iter()
                        .flat_map(|(body, limbs)| limbs.iter().map(move |limb| (*body, *limb)));
                    // The angle of the second body in the first, as that of the joint.
                    let found = limbs.filter_map(|(body, limb)| {
                        let is_along = (a, b) == (&body.to_owned(), &limb.child.to_owned());
                        let is_back = (b, a) == (&body.to_owned(), &limb.child.to_owned());
                        let turns = model.joints.get(limb.joint).is_some_and(|joint| {
                            matches!(
                                joint.kind,
                                JointKind::Revolute { .. } | JointKind::Slot { .. }
                            )
                        });
                        ((is_along || is_back) && turns)
                            .then_some((limb, is_along != limb.is_reversed))
                    });
                    match found.min_by_key(|(limb, _)| limb.joint) {
                        Some((limb, is_same)) if !self.springs.contains_key(limb.joint) => {
                            let free = if is_same { *free } else { -*free };
                            self.springs
                                .insert(limb.joint, [*stiffness, *damping, free]);
                        }
                        _ => self.left_out(
                            place,
                            "a torsion spring is that of a joint of the tree, one of each",
                        ),
                    }
                }
                ForceKind::Spring { .. }
                | ForceKind::Cable { .. }
                | ForceKind::TorsionSpring { .. }
                | ForceKind::Actuator { .. }
                | ForceKind::GasSpring { .. }
                | ForceKind::Cylinder { .. }
                | ForceKind::DcMotor { .. }
                | ForceKind::Load { .. }
                | ForceKind::Torque { .. } => {
                    self.left_out(
                        place,
                        "only springs and cables with constant numbers are written",
                    );
                }
            }
        }
        text
    }

    /// All bodies, each in the one that carries it.
    fn world(&mut self) -> String {
        let mut text = self.sites(GROUND, 2);
        let limbs =
            |writer: &Self, body: &str, depth: usize| -> Vec<(usize, &'a str, Option<Limb<'a>>)> {
                // Backwards, as the last one is taken first; the end of each body follows it.
                let limbs = writer.trunk.get(body).into_iter().flatten().rev();
                limbs.map(|limb| (depth, limb.child, Some(*limb))).collect()
            };
        let mut open = limbs(self, GROUND, 2);
        let mut carriers: HashMap<&str, &str> = HashMap::new();
        for (body, limbs) in &self.trunk {
            carriers.extend(limbs.iter().map(|limb| (limb.child, *body)));
        }
        while let Some((depth, body, limb)) = open.pop() {
            let indent = "  ".repeat(depth);
            let Some(limb) = limb else {
                text += &format!("{indent}</body>\n");
                continue;
            };
            text += &self.body(carriers[body], limb, depth);
            open.push((depth, body, None));
            open.extend(limbs(self, body, depth + 1));
        }
        text
    }

    fn sites(&self, body: &str, depth: usize) -> String {
        let [ox, oy] = self.origins.get(body).copied().unwrap_or_default();
        let points = self.model.bodies.get(body).map(|body| &body.points);
        let site = |(name, [x, y]): (&String, &[f64; 2])| {
            format!(
                "{}<site name=\"{}\" pos=\"{}\"/>\n",
                "  ".repeat(depth),
                escaped(&format!("{body}.{name}")),
                place([x - ox, y - oy])
            )
        };
        points.into_iter().flatten().map(site).collect()
    }

    /// The beginning of a body, with its joints, mass and points.
    fn body(&mut self, carrier: &'a str, limb: Limb<'a>, depth: usize) -> String {
        let model = self.model;
        let indent = "  ".repeat(depth);
        let joint = model.joints.get(limb.joint);
        let ends = joint.map(|joint| {
            let [a, b] = &joint.between;
            if limb.is_reversed { [b, a] } else { [a, b] }
        });
        // The origin is at the joint; of a body that is free at that of its own frame.
        let origin = ends.map_or([0.0; 2], |[_, own]| self.point(own));
        let (above, below) = (self.pose(carrier), self.pose(limb.child));
        let turn = below[2] - above[2];
        let above_origin = self.origins.get(carrier).copied().unwrap_or_default();
        let is_pin = joint.is_some_and(|joint| {
            matches!(
                joint.kind,
                JointKind::Revolute { .. } | JointKind::Fixed { .. }
            )
        });
        let at = match ends {
            // What is a pin is one exactly.
            Some([there, _]) if is_pin => self.point(there),
            _ => {
                let world = moved(below, origin);
                let [dx, dy] = [world[0] - above[0], world[1] - above[1]];
                turned([dx, dy], -above[2])
            }
        };
        let at = [at[0] - above_origin[0], at[1] - above_origin[1]];
        self.origins.insert(limb.child, origin);
        let mut text = format!(
            "{indent}<body name=\"{}\" pos=\"{}\"",
            escaped(limb.child),
            place(at)
        );
        if turn.abs() > ROUND_OFF {
            text += &format!(" axisangle=\"0 -1 0 {}\"", shown(turn));
        }
        text += ">\n";
        text += &self.inertial(limb.child, origin, depth + 1);
        let lines = match (joint, ends) {
            (Some(joint), Some(ends)) => self.joint(joint, limb, ends, turn),
            _ => {
                let part = |kind: &str, name: &str, axis: &str| {
                    format!(
                        "<joint name=\"{}.{name}\" type=\"{kind}\" axis=\"{axis}\"/>",
                        escaped(limb.child)
                    )
                };
                let own = turned([1.0, 0.0], -turn);
                let up = turned([0.0, 1.0], -turn);
                vec![
                    part("slide", "x", &place(own)),
                    part("slide", "z", &place(up)),
                    part("hinge", "angle", "0 -1 0"),
                ]
            }
        };
        lines
            .iter()
            .for_each(|line| text += &format!("{indent}  {line}\n"));
        text + &self.sites(limb.child, depth + 1)
    }

    fn inertial(&mut self, name: &str, origin: [f64; 2], depth: usize) -> String {
        let model = self.model;
        let body = &model.bodies[name];
        let [mass, inertia] =
            [body.mass, body.inertia].map(|value| value.filter(|value| *value > 0.0));
        let missing = match (mass, inertia) {
            (None, None) => Some("mass and no inertia"),
            (None, Some(_)) => Some("mass"),
            (Some(_), None) => Some("inertia"),
            (Some(_), Some(_)) => None,
        };
        if let Some(missing) = missing {
            let what =
                format!("it has no {missing}: MuJoCo needs some, and gets a millionth of the mean");
            self.left_out(format!("body {name}"), what);
        }
        let com = body.com.unwrap_or(origin);
        let inertia = shown(inertia.unwrap_or(self.tiny[1]));
        format!(
            "{}<inertial pos=\"{}\" mass=\"{}\" diaginertia=\"{inertia} {inertia} {inertia}\"/>\n",
            "  ".repeat(depth),
            place([com[0] - origin[0], com[1] - origin[1]]),
            shown(mass.unwrap_or(self.tiny[0]))
        )
    }

    /// The joints of a body; its coordinates are those of the joint in the model.
    fn joint(&self, joint: &Joint, limb: Limb<'a>, ends: [&PointRef; 2], turn: f64) -> Vec<String> {
        let name = escaped(limb.joint);
        let limits = |limits: Option<[Option<f64>; 2]>| {
            let Some([low, high]) = limits else {
                return String::new();
            };
            // An end that there is not is far away.
            let ends = [low.unwrap_or(-1e10), high.unwrap_or(1e10)].map(shown);
            format!(" range=\"{} {}\"", ends[0], ends[1])
        };
        let reference = |value: f64| match value.abs() > ROUND_OFF {
            true => format!(" ref=\"{}\"", shown(value)),
            false => String::new(),
        };
        let spring = match self.springs.get(limb.joint) {
            Some([stiffness, damping, free]) => format!(
                " stiffness=\"{}\" damping=\"{}\" springref=\"{}\"",
                shown(*stiffness),
                shown(*damping),
                shown(*free)
            ),
            None => String::new(),
        };
        // About −y angles of the child grow as ours do; those of its carrier in it the other way.
        let (axis, angle) = match limb.is_reversed {
            false => ("0 -1 0", turn),
            true => ("0 1 0", -turn),
        };
        let hinge = |name: &str, extra: &str| {
            format!(
                "<joint name=\"{name}\" type=\"hinge\" axis=\"{axis}\"{}{extra}{spring}/>",
                reference(angle)
            )
        };
        let slide = |direction: [f64; 2]| {
            let [first, second] = &joint.between;
            let poses = [first, second].map(|end| (self.pose(&end.body), self.point(end)));
            let [a, b] = poses.map(|(pose, point)| moved(pose, point));
            let along = turned(direction, poses[0].0[2]);
            let value = (b[0] - a[0]) * along[0] + (b[1] - a[1]) * along[1];
            // In the frame of the child, along which it moves if it is the second body.
            let own = turned(along, -self.pose(&ends[1].body)[2]);
            let own = if limb.is_reversed {
                [-own[0], -own[1]]
            } else {
                own
            };
            format!(
                "<joint name=\"{name}\" type=\"slide\" axis=\"{}\"{}{}/>",
                place(own),
                reference(value),
                limits(joint.stops.limits)
            )
        };
        let unit = |[x, y]: [f64; 2]| [x / x.hypot(y), y / x.hypot(y)];
        match joint.kind {
            JointKind::Revolute { .. } => vec![hinge(&name, &limits(joint.stops.limits))],
            JointKind::Prismatic { axis, .. } => vec![slide(unit(axis))],
            JointKind::Slot { axis, .. } => {
                let mut both = vec![slide(unit(axis)), hinge(&format!("{name}.angle"), "")];
                // The line of the child turns with it.
                if limb.is_reversed {
                    both.reverse();
                }
                both
            }
            _ => Vec::new(),
        }
    }

    fn equalities(&mut self) -> Result<String, Refused> {
        let model = self.model;
        let mut text = String::new();
        for name in &self.closers {
            let joint = &model.joints[*name];
            let [a, b] = &joint.between;
            let tag = match joint.kind {
                JointKind::Fixed { .. } => "weld",
                _ => "connect",
            };
            text += &match tag {
                "weld" => {
                    let body = |name: &str| {
                        if name == GROUND {
                            "world".into()
                        } else {
                            escaped(name)
                        }
                    };
                    format!(
                        "    <weld name=\"{}\" body1=\"{}\" body2=\"{}\"/>\n",
                        escaped(name),
                        body(&a.body),
                        body(&b.body)
                    )
                }
                _ => format!(
                    "    <connect name=\"{}\" site1=\"{}\" site2=\"{}\"/>\n",
                    escaped(name),
                    escaped(&a.to_string()),
                    escaped(&b.to_string())
                ),
            };
        }
        for (name, joint) in &model.joints {
            let JointKind::Gear { ratio, carrier, .. } = &joint.kind else {
                continue;
            };
            let wheels =
                [0, 1].map(|end: usize| self.bearing(&joint.between[end], carrier.as_deref()));
            let [Some((first, a)), Some((second, b))] = wheels else {
                let cause = "its wheels do not turn on joints of the tree in MJCF";
                let mend = "MuJoCo couples wheels whose joints close no loop";
                return Err(Refused::new(format!("joint {name}"), cause, mend));
            };
            text += &format!(
                "    <joint name=\"{}\" joint1=\"{}\" joint2=\"{}\" polycoef=\"0 {} 0 0 0\"/>\n",
                escaped(name),
                escaped(second),
                escaped(first),
                shown(b * ratio * a)
            );
        }
        Ok(text)
    }

    /// The joint of the tree on which a wheel turns, and 1 where the wheel is its second body.
    fn bearing(&self, wheel: &PointRef, carrier: Option<&str>) -> Option<(&'a str, f64)> {
        let model = self.model;
        let found = model
            .joints
            .iter()
            .filter(|(_, joint)| matches!(joint.kind, JointKind::Revolute { .. }));
        let mut found = found.filter_map(|(name, joint)| {
            let [a, b] = &joint.between;
            let (sign, other) = match (a.body == wheel.body, b.body == wheel.body) {
                (true, _) => (-1.0, b),
                (_, true) => (1.0, a),
                _ => return None,
            };
            let own = if sign > 0.0 { b } else { a };
            let is_it = carrier.is_none_or(|carrier| other.body == carrier)
                && self.is_same(own, wheel)
                && !self.closers.contains(&name.as_str());
            is_it.then_some((name.as_str(), sign))
        });
        found.next()
    }

    /// What is not written.
    fn omit(&mut self) {
        let model = self.model;
        for (name, joint) in &model.joints {
            let stops = &joint.stops;
            let closes = self.closers.contains(&name.as_str());
            let parts = [
                (joint.kind.clearance().is_some(), "clearance"),
                (joint.kind.friction().is_some(), "friction"),
                (
                    closes && stops.limits.is_some(),
                    "limits (it closes a loop)",
                ),
                (
                    stops.restitution.is_some() || stops.stiffness.is_some(),
                    "law of its stops",
                ),
                (stops.latch.is_some(), "latch"),
                (
                    stops.active.is_some() || stops.lock.is_some(),
                    "times at which it holds",
                ),
                (stops.one_way.is_some(), "clutch"),
            ];
            for (_, what) in parts.iter().filter(|(is_there, _)| *is_there) {
                self.left_out(format!("joint {name}"), format!("its {what}"));
            }
        }
        for (name, _) in model
            .bodies
            .iter()
            .filter(|(_, body)| body.elastic.is_some())
        {
            self.left_out(format!("body {name}"), "it is rigid");
        }
        for name in model.drivers.keys() {
            self.left_out(
                format!("driver {name}"),
                "MJCF prescribes no motion: it needs an actuator and a program",
            );
        }
        if !model.initial.is_empty() {
            self.left_out("initial".into(), "velocities at the start");
        }
    }
}

/// Both bodies of a joint, in one order.
fn pair(joint: &Joint) -> [&String; 2] {
    let [a, b] = [&joint.between[0].body, &joint.between[1].body];
    [a.min(b), a.max(b)]
}

/// A point of a body in the plane.
fn moved([x, y, angle]: [f64; 3], point: [f64; 2]) -> [f64; 2] {
    let [px, py] = turned(point, angle);
    [x + px, y + py]
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// Of the plane in space.
fn place([x, y]: [f64; 2]) -> String {
    format!("{} 0 {}", clean(x), clean(y))
}

/// With all its digits.
fn shown(value: f64) -> String {
    // −0 becomes 0.
    format!("{}", value + 0.0)
}

/// The same without what is rounding.
fn clean(value: f64) -> String {
    shown(if value.abs() < ROUND_OFF { 0.0 } else { value })
}

/// In an attribute.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '"' => escaped.push_str("&quot;"),
            _ => escaped.push(c),
        }
    }
    escaped
}

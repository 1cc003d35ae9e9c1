//! What no schema can say: names that must exist, values that belong together, choices that exclude each other.
//!
//! Works on the value in SI units, where null stands for what is complained about already; such things are passed over.

use std::collections::HashMap;

use serde_json::{Map, Value};

use super::GROUND;
use super::analysis::MOST_OUTPUTS;
use super::check_clearance;
use super::check_forces;
use super::node::join;
use super::source::Source;
use super::suggest;
use super::validate::{ENOUGH, Reference};
use crate::error::Complaint;

/// What the checks found; places are looked up later.
pub(super) struct Checked<'a> {
    pub model: &'a Value,
    /// Names of bodies that are refused for a dot in them.
    dotted: Vec<&'a str>,
    pub complaints: Vec<Complaint>,
    pub warnings: Vec<Complaint>,
}

/// Checks everything that concerns more than one value.
pub(super) fn check<'a>(
    model: &'a Value,
    references: &[Reference],
    source: &Source,
) -> Checked<'a> {
    let dotted = members(&model["bodies"])
        .map(|(name, _)| name.as_str())
        .filter(|name| name.contains('.'))
        .collect();
    let mut checked = Checked {
        model,
        dotted,
        complaints: Vec::new(),
        warnings: Vec::new(),
    };
    for reference in references {
        checked.reference(reference, source);
    }
    checked.bodies();
    checked.joints();
    checked.drivers();
    check_forces::forces(&mut checked);
    check_forces::motions(&mut checked);
    checked.initial();
    checked.wanted_points();
    checked.transmission();
    checked.analysis();
    checked.sample();
    checked
}

/// The members of an object, none where it is not one.
pub(super) fn members(value: &Value) -> impl Iterator<Item = (&String, &Value)> {
    value.as_object().into_iter().flatten()
}

/// The body named by a text, as far as the dot.
fn body_of(reference: &Value) -> Option<&str> {
    Some(reference.as_str()?.split_once('.')?.0)
}

/// What was probably meant, else all there is.
fn did_you_mean(word: &str, names: &Map<String, Value>, what: &str) -> String {
    match suggest::nearest(word, names.keys().map(String::as_str)) {
        Some(near) => format!("did you mean {near:?}?"),
        None => format!("{what}: {}", suggest::list(names.keys())),
    }
}

impl Checked<'_> {
    pub(super) fn complain(
        &mut self,
        path: impl Into<String>,
        message: impl Into<String>,
    ) -> &mut Complaint {
        self.complaints.push(Complaint::new(path, message));
        let last = self.complaints.len() - 1;
        &mut self.complaints[last]
    }

    /// Complains where a text names nothing.
    fn reference(&mut self, reference: &Reference, source: &Source) {
        if self.complaints.len() >= ENOUGH {
            return;
        }
        let Reference { path, kind, text } = reference;
        let complaint = match kind.as_str() {
            "point" => self.point(path, text),
            "body" => self.body(path, text),
            "driver" => self.named(path, text, "drivers", "driver"),
            _ => self.named(path, text, "joints", "joint"),
        };
        self.complaints
            .extend(complaint.map(|complaint| source.place(complaint)));
    }

    fn named(&self, path: &str, name: &str, map: &str, what: &str) -> Option<Complaint> {
        let empty = Map::new();
        let things = match &self.model[map] {
            Value::Object(things) => things,
            // left out where it may be, or faulty
            _ if map != "bodies" && self.model.get(map).is_none() => &empty,
            _ => return None,
        };
        if things.contains_key(name) {
            return None;
        }
        let hint = did_you_mean(name, things, &format!("the {map}"));
        Some(Complaint::new(path, format!("there is no {what} {name:?}")).hint(hint))
    }

    fn body(&self, path: &str, name: &str) -> Option<Complaint> {
        if name == GROUND {
            return None;
        }
        if let Some((body, _)) = name.split_once('.')
            && self.model["bodies"].get(body).is_some()
        {
            let complaint = Complaint::new(path, "a body is expected, this is a point");
            return Some(complaint.hint(format!("write {body:?}")));
        }
        self.named(path, name, "bodies", "body")
    }

    fn point(&self, path: &str, text: &str) -> Option<Complaint> {
        let bodies = self.model["bodies"].as_object()?;
        // a body whose name is refused for its dot is not missed again
        if self.dotted.iter().any(|name| text.starts_with(name)) {
            return None;
        }
        let Some((body, point)) = text.split_once('.') else {
            let hint = match bodies.get(text).and_then(|body| body["points"].as_object()) {
                Some(points) => {
                    format!(
                        "write it as body.point; the points of {text:?}: {}",
                        suggest::list(points.keys())
                    )
                }
                None => "write it as body.point, such as \"crank.A\"".into(),
            };
            return Some(Complaint::new(path, "this is no point of a body").hint(hint));
        };
        let empty = Map::new();
        let points = match bodies.get(body) {
            Some(Value::Object(body)) => match body.get("points") {
                Some(Value::Object(points)) => points,
                Some(_) => return None,
                None => &empty,
            },
            Some(_) => return None,
            None if body == GROUND => {
                match bodies.keys().find(|name| name.eq_ignore_ascii_case(GROUND)) {
                    Some(name) => {
                        let hint = format!("the fixed body is written {GROUND:?}, not {name:?}");
                        return Some(
                            Complaint::new(path, format!("there is no body {GROUND:?}")).hint(hint),
                        );
                    }
                    None => &empty,
                }
            }
            None => {
                let hint = did_you_mean(body, bodies, "the bodies");
                return Some(Complaint::new(path, format!("there is no body {body:?}")).hint(hint));
            }
        };
        if points.contains_key(point)
            || points
                .keys()
                .any(|name| name.contains('.') && point.starts_with(name))
        {
            return None;
        }
        let mut hint = format!("its points: {}", suggest::list(points.keys()));
        if let Some(near) =
            suggest::nearest(point, points.keys().map(String::as_str)).filter(|_| points.len() > 1)
        {
            hint = format!("did you mean {:?}? {hint}", format!("{body}.{near}"));
        }
        Some(Complaint::new(path, format!("body {body:?} has no point {point:?}")).hint(hint))
    }

    fn bodies(&mut self) {
        let model = self.model;
        for (name, body) in members(&model["bodies"]) {
            let mass = body["mass"].as_f64().unwrap_or(0.0);
            if mass > 0.0 && body.get("com").is_none() {
                let path = join("bodies", name);
                self.complain(
                    path,
                    "\"com\" is missing, it has no default where there is mass",
                )
                .hint = Some(
                    "give the centre of mass in the body's frame, as in \"com\": [0, 0]".into(),
                );
            }
        }
    }

    fn joints(&mut self) {
        let model = self.model;
        for (name, joint) in members(&model["joints"]) {
            let path = join("joints", name);
            let [first, second] = [0, 1].map(|index| body_of(&joint["between"][index]));
            if let (Some(first), Some(second)) = (first, second)
                && first == second
            {
                self.complain(
                    format!("{path}.between"),
                    format!("both points are of {first:?}"),
                )
                .hint = Some("a joint connects two bodies".into());
            }
            check_clearance::clearance(self, &joint["clearance"], &format!("{path}.clearance"));
            check_clearance::joint_friction(self, joint, &path);
        }
    }

    fn drivers(&mut self) {
        let model = self.model;
        let mut driven: HashMap<String, &String> = HashMap::new();
        for (name, driver) in members(&model["drivers"]) {
            let path = join("drivers", name);
            let text = |key: &str| driver[key].as_str();
            let coordinate = match text("type") {
                Some("rotation") => {
                    let Some(body) = text("body") else { continue };
                    if driver.get("relative_to").is_some_and(Value::is_null) {
                        continue;
                    }
                    let other = text("relative_to").unwrap_or(GROUND);
                    if body == GROUND && other == GROUND {
                        let hint = "name the body that the driver turns";
                        self.complain(
                            format!("{path}.body"),
                            "ground is fixed, nothing can turn it",
                        )
                        .hint = Some(hint.into());
                        continue;
                    }
                    if body == other {
                        let message =
                            format!("the angle of {body:?} relative to itself cannot be driven");
                        self.complain(format!("{path}.body"), message);
                        continue;
                    }
                    let (first, second) = if body < other {
                        (body, other)
                    } else {
                        (other, body)
                    };
                    format!("the angle between {first:?} and {second:?}")
                }
                Some("translation") => {
                    let Some(joint) = text("joint") else { continue };
                    let kind = model["joints"][joint]["type"].as_str();
                    if let Some(kind) = kind.filter(|kind| !["prismatic", "slot"].contains(kind)) {
                        self.complain(
                            format!("{path}.joint"),
                            format!("this joint is {kind}, neither prismatic nor slot"),
                        )
                        .hint = Some(
                            "a translation drives the slide of a prismatic joint or a slot".into(),
                        );
                        continue;
                    }
                    format!("the slide of joint {joint:?}")
                }
                Some(_) | None => continue,
            };
            if let Some(first) = driven.get(&coordinate) {
                let message = format!("{coordinate} is driven by {first:?} already");
                self.complain(path, message).hint = Some("keep one of them".into());
            } else {
                driven.insert(coordinate, name);
            }
        }
    }

    fn initial(&mut self) {
        let model = self.model;
        let Some(bodies) = model["bodies"].as_object() else {
            return;
        };
        for (name, _) in members(&model["initial"]) {
            let path = join("initial", name);
            if name == GROUND {
                self.complain(path, "ground is fixed, it has no initial values");
            } else if !bodies.contains_key(name) {
                let hint = did_you_mean(name, bodies, "the bodies");
                self.complain(path, format!("there is no body {name:?}"))
                    .hint = Some(hint);
            }
        }
    }

    fn wanted_points(&mut self) {
        let points = self.model["points"].as_array();
        let mut seen = HashMap::new();
        for (index, point) in points.into_iter().flatten().enumerate() {
            let Some(text) = point.as_str() else { continue };
            if let Some(first) = seen.insert(text, index) {
                self.complain(format!("points[{index}]"), "the point is listed twice")
                    .hint = Some(format!("first as points[{first}]"));
            }
        }
    }

    /// A transmission leads from one driver to a body that moves.
    fn transmission(&mut self) {
        let model = self.model;
        let transmission = &model["analysis"]["transmission"];
        if !transmission.is_object() {
            return;
        }
        if transmission["output"].as_str() == Some(GROUND) {
            self.complain(
                "analysis.transmission.output",
                "ground is fixed, nothing is transmitted to it",
            );
        }
        let drivers = members(&model["drivers"]).count();
        if transmission.get("driver").is_none() && drivers != 1 {
            let message = format!("\"driver\" is missing, the model has {drivers} of them");
            self.complain("analysis.transmission", message).hint =
                Some("name the driver from which the transmission leads".into());
        }
    }

    /// Not more samples than fit.
    fn sample(&mut self) {
        let sample = &self.model["analysis"]["sample"];
        let [from, to, step] = ["from", "to", "step"].map(|key| sample[key].as_f64());
        let (Some(from), Some(to), Some(step)) = (from, to, step) else {
            return;
        };
        if ((to - from) / step).abs() > MOST_OUTPUTS as f64 {
            let message = format!("more than {MOST_OUTPUTS} outputs between \"from\" and \"to\"");
            self.complain("analysis.sample.step", message).hint = Some("take a larger step".into());
        }
    }

    /// Exactly one way to say which instants are wanted.
    fn analysis(&mut self) {
        let analysis = &self.model["analysis"];
        let Some(kind) = analysis["type"].as_str() else {
            return;
        };
        let [end, outputs, sample] =
            ["end", "outputs", "sample"].map(|key| analysis.get(key).is_some());
        let needed = !matches!(kind, "assembly" | "statics");
        if !needed && analysis["outputs_at"] == "events" {
            self.complain(
                "analysis.outputs_at",
                format!("{kind} has one instant and no events"),
            )
            .hint = Some("leave it out, or choose an analysis of a motion".into());
        }
        let (path, message, hint) = match (end, outputs, sample) {
            (true, _, true) => (
                "analysis.end",
                "\"end\" and \"sample\" exclude each other",
                "keep one of them",
            ),
            (false, true, true) => (
                "analysis.outputs",
                "\"outputs\" and \"sample\" exclude each other",
                "keep one of them",
            ),
            (true, false, false) if needed => (
                "analysis",
                "\"outputs\" is missing",
                "the number of output instants, both ends included",
            ),
            (false, true, false) if needed => (
                "analysis",
                "\"end\" is missing",
                "the end time, the start is 0",
            ),
            (false, false, false) if needed => {
                let hint = "give \"end\" and \"outputs\", or \"sample\"";
                ("analysis", "it is not said for which instants", hint)
            }
            _ => return,
        };
        self.complain(path, message).hint = Some(hint.into());
    }
}

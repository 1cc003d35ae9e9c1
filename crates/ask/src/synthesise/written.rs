//! A linkage as a model: bodies with points, pins and guides, every dimension a parameter.

use super::problem::{Goal, LinkageTask};
use indexmap::IndexMap;
use linkdyn_linear::bilinear::Number;
use linkdyn_model::display::Shown;
use linkdyn_synthesis::linkage::{Joint, Kind, Linkage};
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;

/// How fast the crank turns in the written model.
const SPEED: &str = "10 deg/s";
/// From row to row \[rad\].
const STEP: f64 = 5.0 * TAU / 360.0;

/// Names of a linkage's parts in its model.
#[derive(Debug, Clone, PartialEq)]
pub struct Names {
    /// Of all bodies, `ground` first.
    pub bodies: Vec<String>,
    /// The output's point, `coupler.P`.
    pub point: String,
    /// Responses of the angle of transmission at each pin of the last body.
    pub transmission: Vec<String>,
    /// The crank's angle at the first position \[rad\].
    pub start: f64,
}

/// Names of the bodies of a linkage.
fn bodies(linkage: &Linkage) -> Vec<String> {
    let is_guided = linkage.joints.iter().any(|joint| joint.pin().is_none());
    let own: Vec<&str> = match (linkage.bodies, is_guided) {
        (4, false) => vec!["ground", "crank", "coupler", "rocker"],
        (4, true) => vec!["ground", "crank", "coupler", "slider"],
        _ => vec!["ground"],
    };
    let further = (own.len()..linkage.bodies).map(|k| match k == linkage.crank {
        true => "crank".to_owned(),
        false => format!("link_{k}"),
    });
    own.iter()
        .map(|own| (*own).to_owned())
        .chain(further)
        .collect()
}

/// `A`, `B` … of the pins in their order.
fn letter(number: usize) -> String {
    let letter = char::from(b'A' + (number % 15) as u8);
    match number / 15 {
        0 => letter.to_string(),
        more => format!("{letter}{more}"),
    }
}

/// What writes numbers in the units of the task, and gathers parameters.
struct Writer<'w> {
    length: &'w Shown,
    parameters: Map<String, Value>,
}

impl Writer<'_> {
    fn number(&self, value: f64) -> String {
        format!("{:?} {}", value / self.length.size, self.length.symbol)
    }

    /// A length as a parameter; the expression of it.
    fn length(&mut self, name: &str, value: f64) -> String {
        let text = self.number(value);
        self.parameters.insert(name.to_owned(), json!(text));
        format!("={name}")
    }

    fn place(&mut self, name: &str, place: Number) -> Value {
        let x = self.length(&format!("{name}_x"), place.re);
        json!([x, self.length(&format!("{name}_y"), place.im)])
    }
}

/// An angle as text.
fn angle(value: f64) -> String {
    format!("{:?} deg", value.to_degrees())
}

/// Where the frame of a body begins, and e^{iθ} of its angle, as it is drawn: its first pin, and the way to its second one.
pub fn frame(linkage: &Linkage, body: usize) -> (Number, Number) {
    let own = linkage
        .joints
        .iter()
        .filter(|joint| joint.bodies.contains(&body));
    let mut pins = own.filter_map(Joint::pin);
    let origin = pins.next().unwrap_or_default();
    let along = pins.next().map(|second| second - origin);
    (
        origin,
        along.map_or(Number::new(1.0, 0.0), |way| way / way.norm()),
    )
}

/// The model of a linkage whose crank turns so far from the first position \[rad\].
pub fn document(
    problem: &LinkageTask,
    linkage: &Linkage,
    title: &str,
    turn: f64,
) -> (Value, Names) {
    let names = bodies(linkage);
    let mut writer = Writer {
        length: &problem.display.length,
        parameters: Map::new(),
    };
    let has_point = problem.goal != Goal::Function;
    let all: Vec<(usize, Number)> = linkage
        .joints
        .iter()
        .enumerate()
        .filter_map(|(k, joint)| joint.pin().map(|at| (k, at)))
        .collect();
    let mut written: IndexMap<&str, Value> = IndexMap::new();
    for (body, name) in names.iter().enumerate() {
        let own: Vec<(String, Number)> = all
            .iter()
            .filter(|(k, _)| linkage.joints[*k].bodies.contains(&body))
            .map(|(k, at)| (letter(*k), *at))
            .collect();
        let mut points = Map::new();
        if body == 0 {
            for (letter, at) in &own {
                let place = writer.place(&format!("{name}_{letter}"), *at);
                points.insert(letter.clone(), place);
            }
            if let Some((letter, at)) = guided(linkage) {
                let place = writer.place(&format!("{name}_{letter}"), at);
                points.insert(letter, place);
            }
            written.insert(name, json!({ "points": points }));
            continue;
        }
        let (origin, along) = frame(linkage, body);
        for (k, (letter, at)) in own.iter().enumerate() {
            let local = (at - origin) * along.conj();
            let place = match k {
                0 => json!([0, 0]),
                1 if own.len() == 2 => json!([writer.length(name, local.norm()), 0]),
                1 => json!([writer.length(&format!("{name}_{letter}"), local.norm()), 0]),
                _ => writer.place(&format!("{name}_{letter}"), local),
            };
            points.insert(letter.clone(), place);
        }
        if has_point && body == linkage.output {
            let local = (linkage.point - origin) * along.conj();
            let place = writer.place(&format!("{name}_P"), local);
            points.insert("P".into(), place);
        }
        let position = [origin.re, origin.im].map(|value| writer.number(value));
        written.insert(
            name,
            json!({ "points": points, "pose": { "position": position, "angle": angle(along.arg()) } }),
        );
    }
    let joints: Map<String, Value> = linkage
        .joints
        .iter()
        .enumerate()
        .map(|(k, joint)| joint_of(linkage, &names, k, joint.kind, &mut writer))
        .collect();
    let crank = &names[linkage.crank];
    let start = frame(linkage, linkage.crank).1.arg();
    let velocity = match turn < 0.0 {
        true => format!("-{SPEED}"),
        false => SPEED.to_owned(),
    };
    // Whole steps, so that rows are evenly spaced over a whole turn.
    let step = turn / (turn.abs() / STEP).ceil().max(1.0);
    let mut analysis = json!({
        "type": "quasi_statics",
        "sample": { "driver": "motor", "from": angle(start), "to": angle(start + turn), "step": angle(step.abs()) }
    });
    let mut responses = Map::new();
    let mut transmission = Vec::new();
    if let Some((last, pins)) = linkage.transmitted() {
        analysis["transmission"] = json!({ "output": names[last] });
        for pin in pins {
            let name = format!("transmission_{}", letter(pin));
            responses.insert(
                name.clone(),
                json!(format!("min(transmission.{}.angle)", joint_name(pin))),
            );
            transmission.push(name);
        }
    }
    responses.insert("effort".into(), json!("max(abs(driver.motor.effort))"));
    let point = format!("{}.P", names[linkage.output]);
    let mut forces = Map::new();
    if let Some(load) = problem.asked.load {
        if load.force != [0.0; 2] && has_point {
            let force = load.force.map(|value| format!("{value:?} N"));
            forces.insert(
                "load".into(),
                json!({ "type": "force", "at": point, "vector": force }),
            );
        }
        if load.torque != 0.0 {
            let torque = format!("{:?} N*m", load.torque);
            forces.insert(
                "torque".into(),
                json!({ "type": "torque", "body": names[linkage.output], "value": torque }),
            );
        }
    }
    let points: Vec<&String> = if has_point { vec![&point] } else { Vec::new() };
    let is_degrees = problem.display.angle.symbol == "°";
    let document = json!({
        "format": "linkdyn/1",
        "name": title,
        "units": { "length": problem.display.length.symbol, "angle": if is_degrees { "deg" } else { "rad" } },
        "parameters": writer.parameters,
        "bodies": written,
        "joints": joints,
        "drivers": { "motor": { "type": "rotation", "body": crank,
            "motion": { "type": "constant_velocity", "start": angle(start), "velocity": velocity } } },
        "forces": forces,
        "points": points,
        "analysis": analysis,
        "responses": responses,
    });
    (
        document,
        Names {
            bodies: names,
            point,
            transmission,
            start,
        },
    )
}

/// The name of a joint.
fn joint_name(number: usize) -> String {
    letter(number).to_lowercase()
}

/// The ground's point on the line of a guide: where its slider is pinned, at the first position.
fn guided(linkage: &Linkage) -> Option<(String, Number)> {
    let (k, joint) = linkage
        .joints
        .iter()
        .enumerate()
        .find(|(_, own)| own.pin().is_none())?;
    let slider = joint.bodies.into_iter().find(|body| *body != 0)?;
    let mut pins = linkage
        .joints
        .iter()
        .filter(|own| own.bodies.contains(&slider));
    Some((letter(k), pins.find_map(Joint::pin)?))
}

fn joint_of(
    linkage: &Linkage,
    names: &[String],
    number: usize,
    kind: Kind,
    writer: &mut Writer<'_>,
) -> (String, Value) {
    let own = letter(number);
    let [a, b] = linkage.joints[number].bodies;
    let value = match kind {
        Kind::Pin(_) => {
            json!({ "type": "revolute", "between": [format!("{}.{own}", names[a]), format!("{}.{own}", names[b])] })
        }
        Kind::Guide(direction) => {
            let slide = json!(angle(direction));
            writer.parameters.insert("slide".into(), slide);
            let slider = if a == 0 { b } else { a };
            let pin = linkage
                .joints
                .iter()
                .position(|joint| joint.pin().is_some() && joint.bodies.contains(&slider));
            let point = format!("{}.{}", names[slider], letter(pin.unwrap_or_default()));
            json!({ "type": "prismatic", "between": [format!("{}.{own}", names[0]), point], "axis": ["=cos(slide)", "=sin(slide)"] })
        }
    };
    (joint_name(number), value)
}

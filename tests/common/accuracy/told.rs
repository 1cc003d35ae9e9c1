//! Models told as questions about accuracy: every number of the geometry a parameter, everything that may be off, off.

use linkdyn_engine::analysis::Control;
use linkdyn_model::error::Complaints;
use linkdyn_model::{Checked, Loaded, Model};
use linkdyn_variation::{Accuracy, Parameters, Refusal, Scope, accuracy};
use serde_json::{Map, Value, json};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A model that was read, with its parameters.
pub struct Told {
    pub loaded: Loaded,
    /// How often the model was read with other values.
    pub readings: AtomicUsize,
}

impl Told {
    pub fn read(json: &Value) -> Result<Told, Complaints> {
        let loaded = linkdyn_model::load(json.to_string().as_bytes(), &[])?;
        let readings = AtomicUsize::new(0);
        Ok(Told { loaded, readings })
    }

    /// The accuracy of a model with these parameters.
    pub fn ask(&self, model: &Checked) -> Result<Accuracy, Refusal> {
        self.ask_for(model, Scope::default())
    }

    /// The same of some outputs or levels.
    pub fn ask_for(&self, model: &Checked, scope: Scope) -> Result<Accuracy, Refusal> {
        let known = &self.loaded.parameters;
        let limits: Vec<[f64; 2]> = known
            .iter()
            .map(|parameter| {
                let tolerance = parameter.tolerance.as_ref();
                tolerance.map_or([0.0; 2], |own| [own.lower.min(0.0), own.upper.max(0.0)])
            })
            .collect();
        let dependence = self.loaded.source.dependence();
        let parameters = Parameters {
            all: known,
            derivatives: &dependence.at(&[]),
            enclosed: &|| dependence.within(&limits),
            with: &|by| {
                self.readings.fetch_add(1, Ordering::Relaxed);
                let named = by.iter().map(|&(k, by)| (known[k].name.as_str(), by));
                let named: Vec<(&str, f64)> = named.collect();
                self.loaded.source.with_deviations(&named).ok()
            },
        };
        accuracy(model, &parameters, scope, &Control::default())
    }

    /// The accuracy of the model as it stands.
    #[track_caller]
    pub fn answer(&self) -> Accuracy {
        self.ask(&self.loaded.model)
            .unwrap_or_else(|said| panic!("{said:?}"))
    }
}

/// Numbers that became parameters.
#[derive(Default)]
struct Numbers(Map<String, Value>);

impl Numbers {
    /// Puts a parameter where a number stands.
    fn take(&mut self, place: &mut Value, unit: &str) {
        let number = place.as_f64().expect("a number");
        let name = format!("p{}", self.0.len());
        *place = json!(format!("={name}"));
        let value = if unit.is_empty() {
            json!(number)
        } else {
            json!(format!("{number:e} {unit}"))
        };
        self.0.insert(name, value);
    }

    fn take_all(&mut self, places: &mut Value, unit: &str) {
        let places = places.as_array_mut().expect("a list");
        places.iter_mut().for_each(|place| self.take(place, unit));
    }

    fn take_motion(&mut self, motion: &mut Value, unit: &str) {
        let powers = [unit.into(), format!("{unit}/s"), format!("{unit}/s^2")];
        let mut take = |key: &str, unit: &str| {
            if motion.get(key).is_some() {
                self.take(&mut motion[key], unit);
            }
        };
        take("start", unit);
        take("velocity", &powers[1]);
        take("acceleration", &powers[2]);
        take("offset", unit);
        take("amplitude", unit);
        take("frequency", "Hz");
        take("phase", "rad");
        if let Some(all) = motion.get_mut("coefficients").and_then(Value::as_array_mut) {
            for (k, place) in all.iter_mut().enumerate() {
                let unit = match k {
                    0 => unit.to_owned(),
                    1 => powers[1].clone(),
                    k => format!("{unit}/s^{k}"),
                };
                self.take(place, &unit);
            }
        }
        if let Some(all) = motion.get_mut("points").and_then(Value::as_array_mut) {
            all.iter_mut()
                .for_each(|point| self.take(&mut point[1], unit));
        }
    }
}

/// Bodies that mesh without an angle, whose poses say it.
fn meshing(model: &Model) -> Vec<String> {
    let mut names = Vec::new();
    for (name, joint) in &model.joints {
        if let linkdyn_model::JointKind::Gear { angle: None, .. } = joint.kind {
            names.extend(joint.between.iter().map(|end| end.body.clone()));
            let carrier = model.carrier(name, joint).expect("a gear");
            names.push(carrier.expect("a carrier").body.to_owned());
        }
    }
    names.sort();
    names.dedup();
    names.retain(|name| name != linkdyn_model::GROUND);
    names
}

/// Whether accuracy counts all of its joints and drivers.
pub fn is_counted(model: &Model) -> bool {
    use linkdyn_model::{DriverKind, JointKind};
    let is_counted = |kind: &JointKind| {
        matches!(
            kind,
            JointKind::Revolute { .. }
                | JointKind::Prismatic { .. }
                | JointKind::Slot { .. }
                | JointKind::Gear { .. }
                | JointKind::Fixed { .. }
        )
    };
    let is_length = |kind: &DriverKind| matches!(kind, DriverKind::Length { .. });
    model.joints.values().all(|joint| is_counted(&joint.kind))
        && !model.drivers.values().any(|driver| is_length(&driver.kind))
}

/// The model as JSON in SI units, kinematic, at some instants, without clearances.
pub fn bare(model: &Model, outputs: usize) -> Value {
    let mut json = model.to_json();
    let top = json.as_object_mut().expect("an object");
    for key in ["forces", "initial", "accuracy", "materials", "outputs"] {
        top.remove(key);
    }
    for driver in drivers(&mut json) {
        driver
            .as_object_mut()
            .expect("a driver")
            .remove("tolerance");
    }
    for body in json["bodies"].as_object_mut().expect("bodies").values_mut() {
        for point in body["points"].as_object_mut().expect("points").values_mut() {
            if let Some(place) = point.get("position") {
                *point = place.clone();
            }
        }
    }
    let analysis = model.analysis.as_ref().expect("an analysis");
    json["analysis"] = match &analysis.sample {
        // Away from the ends of the stroke, so that a motion that is off has these values, too.
        Some(sample) => {
            let span = sample.to - sample.from;
            let (from, to) = (sample.from + 0.02 * span, sample.to - 0.02 * span);
            json!({ "type": "kinematics", "sample": { "driver": sample.driver, "from": from, "to": to,
                "step": (to - from) / (outputs - 1) as f64 } })
        }
        None => json!({ "type": "kinematics", "end": analysis.end, "outputs": outputs }),
    };
    for joint in json["joints"].as_object_mut().expect("joints").values_mut() {
        let joint = joint.as_object_mut().expect("a joint");
        joint.retain(|key, _| {
            ["type", "between", "axis", "angle", "ratio", "carrier"].contains(&key.as_str())
        });
    }
    json
}

/// The drivers of a model; there may be none.
fn drivers(json: &mut Value) -> impl Iterator<Item = &mut Value> {
    let drivers = json.get_mut("drivers").and_then(Value::as_object_mut);
    drivers.into_iter().flat_map(|all| all.values_mut())
}

/// The same with a parameter for every number of its geometry and of its motions.
pub fn parametric(model: &Model, outputs: usize) -> Value {
    let mut json = bare(model, outputs);
    let mut numbers = Numbers::default();
    let meshing = meshing(model);
    for (name, body) in json["bodies"].as_object_mut().expect("bodies") {
        for point in body["points"].as_object_mut().expect("points").values_mut() {
            let place = match point {
                Value::Object(own) => own.get_mut("position").expect("a position"),
                own => own,
            };
            numbers.take_all(place, "m");
        }
        if meshing.contains(name) {
            if body["pose"]["angle"].is_null() {
                body["pose"]["angle"] = json!(0.0);
            }
            numbers.take(&mut body["pose"]["angle"], "rad");
        }
    }
    for joint in json["joints"].as_object_mut().expect("joints").values_mut() {
        let kind = joint["type"].as_str().expect("a type").to_owned();
        if joint.get("axis").is_some() {
            numbers.take_all(&mut joint["axis"], "");
        }
        if ["prismatic", "fixed"].contains(&kind.as_str()) && joint.get("angle").is_none() {
            joint["angle"] = json!(0.0);
        }
        for (key, unit) in [("angle", "rad"), ("ratio", "")] {
            if joint.get(key).is_some() {
                numbers.take(&mut joint[key], unit);
            }
        }
    }
    let is_sampled = json["analysis"].get("sample").is_some();
    for driver in drivers(&mut json) {
        let unit = if driver["type"] == "rotation" {
            "rad"
        } else {
            "m"
        };
        // Sampled by its value, a motion has no say.
        if !is_sampled {
            numbers.take_motion(&mut driver["motion"], unit);
        }
    }
    json["parameters"] = Value::Object(numbers.0);
    json
}

/// Gives everything that can be off a size c \[m\] or \[rad\]: pins, plays, backlash, drivers, some zones.
pub fn spoil(json: &mut Value, c: f64) {
    for joint in json["joints"].as_object_mut().expect("joints").values_mut() {
        match joint["type"].as_str().expect("a type") {
            "revolute" => joint["clearance"] = json!({ "model": "ideal", "radius": c }),
            "prismatic" => {
                joint["play"] = json!(c);
                joint["guide_length"] = json!(0.05);
            }
            "slot" => joint["play"] = json!(c),
            "gear" => joint["backlash"] = json!(c),
            _ => {}
        }
    }
    for driver in json["drivers"]
        .as_object_mut()
        .expect("drivers")
        .values_mut()
    {
        driver["tolerance"] = json!(c);
    }
    // With a zone where a wheel turns on the ground nothing is certified.
    let has_gears = json["joints"].to_string().contains("\"gear\"");
    for (name, body) in json["bodies"].as_object_mut().expect("bodies") {
        if has_gears && name == linkdyn_model::GROUND {
            continue;
        }
        let points = body["points"].as_object_mut().expect("points");
        if let Some(point) = points.values_mut().last() {
            *point = json!({ "position": point.clone(), "tolerance": c });
        }
    }
}

/// Gives all parameters a tolerance, none of them the same to both sides.
pub fn tolerate(json: &mut Value, t: f64) {
    for value in json["parameters"]
        .as_object_mut()
        .expect("some")
        .values_mut()
    {
        let unit = value.as_str().and_then(|text| text.split_once(' '));
        let tolerance = match unit {
            Some((_, unit)) => json!([format!("{:e} {unit}", -0.3 * t), format!("{t:e} {unit}")]),
            None => json!([-0.3 * t, t]),
        };
        *value = json!({ "value": value.clone(), "tolerance": tolerance });
    }
}

/// Asks for angle and place of all bodies, for points and for distances; at a driver's value, or over the stroke.
pub fn ask_outputs(json: &mut Value, model: &Model, at: Option<f64>) {
    let mut outputs = Map::new();
    let mut add = |mut asked: Value| {
        if let Some(value) = at {
            asked["at"] = json!({ "value": value });
        }
        outputs.insert(format!("o{}", outputs.len()), asked);
    };
    let mut far: Vec<String> = Vec::new();
    for (name, body) in &model.bodies {
        let point = body.points.keys().last();
        far.extend(point.map(|point| format!("{name}.{point}")));
        if name == linkdyn_model::GROUND {
            continue;
        }
        for quantity in ["angle", "x", "y"] {
            add(json!({ "column": format!("{name}.{quantity}") }));
        }
        if let Some(point) = point {
            add(json!({ "column": format!("{name}.{point}.x") }));
        }
    }
    if let [first, .., last] = &far[..] {
        add(json!({ "distance": [first, last] }));
    }
    json["accuracy"] = json!({ "outputs": outputs });
}

/// Numbers in [0, 1) that repeat.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In [−1, 1).
    pub fn both(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
}

//! A model as the text of a file, in units of choice.

#[path = "write_joints.rs"]
mod joints;

use linkdyn_model::{
    AnalysisKind, Driver, DriverKind, Force, ForceKind, Frame, Friction, FrictionLaw, GROUND,
    JointKind, Model, Motion, PointRef, Value as Law,
};
use serde_json::{Map, Value, json};

/// SI units in one of ours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Names in `units`.
    pub names: &'static [(&'static str, &'static str)],
    pub length: f64,
    pub angle: f64,
    pub mass: f64,
}

pub const SI: Scale = Scale {
    names: &[],
    length: 1.0,
    angle: 1.0,
    mass: 1.0,
};

/// Millimetres, degrees, tonnes: forces in N, torques in N·mm.
pub const WORKSHOP: Scale = Scale {
    names: &[
        ("length", "mm"),
        ("angle", "deg"),
        ("mass", "t"),
        ("inertia", "t*mm^2"),
        ("torque", "N*mm"),
        ("stiffness", "N/mm"),
        ("damping", "N*s/mm"),
        ("angular_stiffness", "N*mm/deg"),
        ("angular_damping", "N*mm*s/deg"),
        ("velocity", "mm/s"),
        ("angular_velocity", "deg/s"),
        ("acceleration", "mm/s^2"),
        ("angular_acceleration", "deg/s^2"),
    ],
    length: 1e3,
    angle: 180.0 / std::f64::consts::PI,
    mass: 1e-3,
};

impl Scale {
    /// The model as JSON; its clearances are left out.
    pub fn write(&self, model: &Model) -> Value {
        let units = self
            .names
            .iter()
            .map(|(name, unit)| (name.to_string(), json!(unit)))
            .collect::<Map<_, _>>();
        let analysis = model.analysis.as_ref().expect("an analysis");
        assert_eq!(analysis.kind, AnalysisKind::InverseDynamics);
        let mut words = json!({ "type": "inverse_dynamics" });
        if let Some(sample) = &analysis.sample {
            let unit = self.driven(&model.drivers[&sample.driver]);
            words["sample"] = json!({ "driver": sample.driver, "from": sample.from * unit, "to": sample.to * unit,
                "step": sample.step * unit });
        } else {
            words["end"] = json!(analysis.end);
            words["outputs"] = json!(analysis.outputs);
        }
        json!({
            "format": "linkdyn/1",
            "units": if units.is_empty() { json!("SI") } else { Value::Object(units) },
            "gravity": self.pair(model.gravity),
            "bodies": self.bodies(model),
            "joints": self.joints(model),
            "drivers": model.drivers.iter().map(|(name, driver)| (name.clone(), self.driver(driver))).collect::<Map<_, _>>(),
            "forces": model.forces.iter().map(|(name, force)| (name.clone(), self.force(force))).collect::<Map<_, _>>(),
            "tables": model.tables.iter().map(|(name, table)| (name.clone(), without_nulls(json!(table)))).collect::<Map<_, _>>(),
            "points": model.points.iter().map(PointRef::to_string).collect::<Vec<_>>(),
            "analysis": words,
        })
    }

    fn pair(&self, [x, y]: [f64; 2]) -> Value {
        json!([x * self.length, y * self.length])
    }

    fn bodies(&self, model: &Model) -> Value {
        let mut bodies = Map::new();
        for (name, body) in &model.bodies {
            let points = body
                .points
                .iter()
                .map(|(name, point)| (name.clone(), self.pair(*point)));
            let mut words = json!({ "points": points.collect::<Map<_, _>>() });
            if name != GROUND {
                words["pose"] = json!({ "position": self.pair(body.pose.position), "angle": body.pose.angle * self.angle });
                let inertia = self.mass * self.length * self.length;
                for (key, value) in [
                    ("mass", body.mass.map(|m| m * self.mass)),
                    ("inertia", body.inertia.map(|i| i * inertia)),
                ] {
                    if let Some(value) = value {
                        words[key] = json!(value);
                    }
                }
                if let Some(com) = body.com {
                    words["com"] = self.pair(com);
                }
            }
            bodies.insert(name.clone(), words);
        }
        Value::Object(bodies)
    }

    /// Coulomb's friction, the only one among these models.
    fn friction(
        &self,
        words: &mut Value,
        friction: Option<&Friction>,
        (key, length): (&str, Option<f64>),
    ) {
        let Some(friction) = friction else { return };
        assert_eq!(friction.law, FrictionLaw::Coulomb);
        let threshold = friction
            .threshold_velocity
            .map(|velocity| velocity * self.length);
        words["friction"] = json!({ "law": "coulomb", "coefficient": friction.coefficient, "threshold_velocity": threshold });
        if let Some(length) = length {
            words[key] = json!(length * self.length);
        }
    }

    fn joints(&self, model: &Model) -> Value {
        let mut joints = Map::new();
        for (name, joint) in &model.joints {
            let between = joint.between.each_ref().map(PointRef::to_string);
            let words = match &joint.kind {
                JointKind::Revolute {
                    friction,
                    pin_radius,
                    ..
                } => {
                    let mut words = json!({ "type": "revolute", "between": between });
                    self.friction(&mut words, friction.as_deref(), ("pin_radius", *pin_radius));
                    words
                }
                JointKind::Prismatic {
                    axis,
                    angle,
                    friction,
                    guide_length,
                    ..
                } => {
                    let angle = angle * self.angle;
                    let mut words = json!({ "type": "prismatic", "between": between, "axis": axis, "angle": angle });
                    self.friction(
                        &mut words,
                        friction.as_deref(),
                        ("guide_length", *guide_length),
                    );
                    words
                }
                JointKind::Slot { axis, .. } => {
                    json!({ "type": "slot", "between": between, "axis": axis })
                }
                JointKind::Gear {
                    ratio,
                    carrier,
                    angle,
                    ..
                } => {
                    let mut words = json!({ "type": "gear", "between": between, "ratio": ratio });
                    if let Some(carrier) = carrier {
                        words["carrier"] = json!(carrier);
                    }
                    if let Some(angle) = angle {
                        words["angle"] = json!(angle * self.angle);
                    }
                    words
                }
                JointKind::Cam(cam) => self.cam(cam, &between),
                JointKind::Belt { .. } => self.belt(joint, &between),
                JointKind::Bushing(bushing) => self.bushing(bushing, &between),
                JointKind::Rack { .. } => self.rack(joint, &between),
                JointKind::Fixed { angle } => {
                    json!({ "type": "fixed", "between": between, "angle": angle * self.angle })
                }
                JointKind::Contact { .. } => self.contact(joint, &between),
                kind => panic!("no bundled model has {}", kind.word()),
            };
            joints.insert(name.clone(), words);
        }
        Value::Object(joints)
    }

    /// Scale of what a driver drives.
    fn driven(&self, driver: &Driver) -> f64 {
        match driver.kind {
            DriverKind::Rotation { .. } => self.angle,
            DriverKind::Translation { .. }
            | DriverKind::Length { .. }
            | DriverKind::Point { .. } => self.length,
        }
    }

    fn driver(&self, driver: &Driver) -> Value {
        let motion = self.motion(&driver.motion, self.driven(driver));
        match &driver.kind {
            DriverKind::Rotation {
                body,
                relative_to: None,
            } => {
                json!({ "type": "rotation", "body": body, "motion": motion })
            }
            DriverKind::Rotation {
                body,
                relative_to: Some(other),
            } => {
                json!({ "type": "rotation", "body": body, "relative_to": other, "motion": motion })
            }
            DriverKind::Length { between } => {
                let between = between.each_ref().map(PointRef::to_string);
                json!({ "type": "length", "between": between, "motion": motion })
            }
            DriverKind::Point { point, axis } => {
                json!({ "type": "point", "point": point.to_string(), "axis": axis, "motion": motion })
            }
            DriverKind::Translation { joint } => {
                json!({ "type": "translation", "joint": joint, "motion": motion })
            }
        }
    }

    fn motion(&self, motion: &Motion, unit: f64) -> Value {
        match motion {
            Motion::Polynomial { coefficients } => {
                json!({ "type": "polynomial", "coefficients": coefficients.iter().map(|c| c * unit).collect::<Vec<_>>() })
            }
            Motion::Harmonic {
                offset,
                amplitude,
                frequency,
                phase,
            } => json!({ "type": "harmonic",
                "offset": offset * unit, "amplitude": amplitude * unit, "frequency": frequency, "phase": phase * self.angle }),
            Motion::Table {
                points,
                interpolation,
                velocities,
            } => {
                let mut table = json!({ "type": "table", "points": points.iter().map(|[t, f]| [*t, f * unit]).collect::<Vec<_>>(),
                    "interpolation": interpolation });
                if let Some(all) = velocities {
                    table["velocities"] =
                        json!(all.iter().map(|slope| slope * unit).collect::<Vec<_>>());
                }
                table
            }
            Motion::Cycloidal(_)
            | Motion::Polynomial345(_)
            | Motion::Polynomial4567(_)
            | Motion::ModifiedSine(_)
            | Motion::ModifiedTrapezoid(_)
            | Motion::TrapezoidalVelocity(_)
            | Motion::SCurve(_)
            | Motion::Sequence { .. } => scaled(&json!(motion), unit),
            Motion::ConstantVelocity { start, velocity } => {
                json!({ "type": "constant_velocity", "start": start * unit, "velocity": velocity * unit })
            }
            Motion::ConstantAcceleration {
                start,
                velocity,
                acceleration,
            } => json!({ "type": "constant_acceleration",
                "start": start * unit, "velocity": velocity * unit, "acceleration": acceleration * unit }),
        }
    }

    fn law(&self, law: &Law, unit: f64) -> Value {
        match law {
            Law::Constant(value) => json!(value * unit),
            Law::Motion(motion) => self.motion(motion, unit),
            Law::Formula(formula) if formula.table.is_some() => {
                let mut table = without_nulls(json!(formula.table));
                table["of"] = json!(formula.formula);
                table
            }
            Law::Formula(formula) => json!(formula.formula),
        }
    }

    /// Forces in N, torques in N·m times the length's scale (N·mm).
    fn force(&self, force: &Force) -> Value {
        let mut words = self.force_kind(force);
        let stroke = &force.stroke;
        if let Some(limits) = stroke.limits {
            words["limits"] = json!(limits.map(|limit| limit.map(|limit| limit * self.length)));
        }
        for (key, value, scale) in [
            ("restitution", stroke.restitution, 1.0),
            ("stop_stiffness", stroke.stop_stiffness, 1.0 / self.length),
            ("stop_damping", stroke.stop_damping, 1.0 / self.length),
        ] {
            if let Some(value) = value {
                words[key] = json!(value * scale);
            }
        }
        words
    }

    fn force_kind(&self, force: &Force) -> Value {
        match &force.kind {
            ForceKind::Spring {
                between,
                stiffness,
                damping,
                free_length,
            } => json!({ "type": "spring",
                "between": between.each_ref().map(PointRef::to_string), "stiffness": stiffness / self.length,
                "damping": damping / self.length, "free_length": self.law(free_length, self.length) }),
            ForceKind::Actuator { between, force } => json!({ "type": "actuator",
                "between": between.each_ref().map(PointRef::to_string), "force": self.law(force, 1.0) }),
            ForceKind::GasSpring {
                between,
                force,
                extended,
                stroke,
                progression,
                exponent,
                damping,
            } => json!({ "type": "gas_spring",
                "between": between.each_ref().map(PointRef::to_string), "force": force,
                "extended": extended * self.length, "stroke": stroke * self.length,
                "progression": progression, "exponent": exponent, "damping": damping / self.length }),
            ForceKind::Cylinder {
                between,
                bore,
                rod,
                pressure,
                rod_pressure,
            } => json!({ "type": "cylinder",
                "between": between.each_ref().map(PointRef::to_string),
                "bore": bore * self.length, "rod": rod * self.length,
                "pressure": self.law(pressure, 1.0 / (self.length * self.length)),
                "rod_pressure": self.law(rod_pressure, 1.0 / (self.length * self.length)) }),
            ForceKind::DcMotor {
                body,
                relative_to,
                voltage,
                torque_constant,
                resistance,
                inductance,
                gear,
            } => {
                let mut words = json!({ "type": "dc_motor", "body": body,
                    "voltage": self.law(voltage, 1.0), "torque_constant": torque_constant,
                    "resistance": resistance, "inductance": inductance, "gear": gear });
                if let Some(other) = relative_to {
                    words["relative_to"] = json!(other);
                }
                words
            }
            ForceKind::Cable {
                through,
                stiffness,
                damping,
                free_length,
            } => json!({ "type": "cable",
                "through": through.iter().map(PointRef::to_string).collect::<Vec<_>>(),
                "stiffness": stiffness / self.length, "damping": damping / self.length,
                "free_length": self.law(free_length, self.length) }),
            ForceKind::TorsionSpring {
                between,
                stiffness,
                damping,
                free_angle,
            } => json!({ "type": "torsion_spring",
                "between": between, "stiffness": stiffness * self.length / self.angle,
                "damping": damping * self.length / self.angle, "free_angle": self.law(free_angle, self.angle) }),
            ForceKind::Load { at, vector, frame } => json!({ "type": "force", "at": at.to_string(),
                "vector": vector.each_ref().map(|law| self.law(law, 1.0)),
                "frame": match frame { Frame::Ground => "ground", Frame::Body => "body" } }),
            ForceKind::Torque {
                body,
                value,
                relative_to,
            } => {
                let mut words = json!({ "type": "torque", "body": body, "value": self.law(value, self.length) });
                if let Some(other) = relative_to {
                    words["relative_to"] = json!(other);
                }
                words
            }
        }
    }
}

/// A rise or a sequence with its values in another unit; what is not said is left out.
fn scaled(motion: &Value, unit: f64) -> Value {
    let Some(members) = motion.as_object() else {
        return motion.clone();
    };
    let values = ["start", "rise", "end", "velocity", "acceleration", "jerk"];
    let written = members.iter().filter(|(_, value)| !value.is_null());
    let written = written.map(|(key, value)| {
        let value = match (value, value.as_f64()) {
            (Value::Array(parts), _) => parts.iter().map(|part| scaled(part, unit)).collect(),
            (_, Some(number)) if values.contains(&key.as_str()) => json!(number * unit),
            (other, _) => other.clone(),
        };
        (key.clone(), value)
    });
    Value::Object(written.collect())
}

/// An object without keys that hold nothing.
fn without_nulls(mut value: Value) -> Value {
    if let Value::Object(members) = &mut value {
        members.retain(|_, value| !value.is_null());
    }
    value
}

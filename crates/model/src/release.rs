//! A driver let go: its driving torque or force becomes an input.

use crate::driver::{DriverKind, PointAxis};
use crate::error::{Complaint, Complaints};
use crate::force::{Force, ForceKind, Frame, Stroke, Value};
use crate::formula::Formula;
use crate::gate::Checked;
use crate::input::ModelInput;
use crate::point::PointRef;
use crate::suggest;
use crate::{GROUND, Model};

impl Checked {
    /// The same model in which a driver prescribes nothing: the input of its name is its driving torque \[N·m\] or force \[N\], zero until it
    /// is set.
    ///
    /// Nothing says then where it starts but the poses; `Mechanism::release` of the package `linkdyn` adds that.
    ///
    /// What acts is what the multiplier of the driver would be: a torque on the body and its opposite on the one from which the angle counts,
    /// forces on both points of a length, a force along the axis on the second body of a slide, and its opposite on the first.
    ///
    /// # Errors
    /// Where there is no such driver, where there is an input or a force of that name already, and where something else of the model names
    /// the driver.
    pub fn release(&self, driver: &str) -> Result<Checked, Complaints> {
        let Some(found) = self.drivers.get(driver) else {
            let complaint = Complaint::new("drivers", format!("there is no driver {driver:?}"));
            let known = suggest::list(self.drivers.keys());
            return Err(vec![complaint.hint(format!("the drivers: {known}"))].into());
        };
        let back = format!("{driver} back");
        for (section, is_there) in [
            ("inputs", self.inputs.contains_key(driver)),
            (
                "forces",
                self.forces.contains_key(driver) || self.forces.contains_key(&back),
            ),
        ] {
            if is_there {
                let message = format!(
                    "{driver:?} stands here already, and the released driver needs the name"
                );
                return Err(
                    vec![Complaint::new(section, message).hint("rename one of them")].into(),
                );
            }
        }
        let forces = effort(self, driver, &found.kind);
        self.edit(|model| {
            let unit = match &found.kind {
                DriverKind::Rotation { .. } => "N*m",
                DriverKind::Translation { .. }
                | DriverKind::Length { .. }
                | DriverKind::Point { .. } => "N",
            };
            model.drivers.shift_remove(driver);
            let input = ModelInput {
                start: 0.0,
                unit: unit.into(),
            };
            model.inputs.insert(driver.into(), input);
            let names = [driver.to_owned(), back];
            for (name, kind) in names.into_iter().zip(forces) {
                let stroke = Stroke::default();
                model.forces.insert(name, Force { kind, stroke });
            }
        })
    }
}

/// The forces that an input exerts in the place of a driver.
fn effort(model: &Model, name: &str, kind: &DriverKind) -> Vec<ForceKind> {
    let value = |text: String| Value::Formula(Formula::new(format!("={text}")));
    let input = format!("input.{name}");
    let scaled = |factor: f64| value(format!("{factor:?}*{input}"));
    let load = |at: &PointRef, vector: [Value; 2], frame: Frame| ForceKind::Load {
        at: at.clone(),
        vector,
        frame,
    };
    match kind {
        DriverKind::Rotation { body, relative_to } => vec![ForceKind::Torque {
            body: body.clone(),
            value: value(input),
            relative_to: relative_to.clone().filter(|other| other != GROUND),
        }],
        DriverKind::Length { between } => vec![ForceKind::Actuator {
            between: between.clone(),
            force: value(input),
        }],
        DriverKind::Point { point, axis } => {
            let vector = match axis {
                PointAxis::X => [value(input), Value::default()],
                PointAxis::Y => [Value::default(), value(input)],
            };
            vec![load(point, vector, Frame::Ground)]
        }
        DriverKind::Translation { joint } => {
            let joint = &model.joints[joint];
            // the gate lets nothing else slide
            let axis = joint.kind.guide().unwrap_or([1.0, 0.0]);
            let length = axis[0].hypot(axis[1]);
            let [x, y] = axis.map(|part| part / length);
            let [first, second] = &joint.between;
            if first.body == GROUND {
                return vec![load(second, [scaled(x), scaled(y)], Frame::Ground)];
            }
            let back = load(first, [scaled(-x), scaled(-y)], Frame::Body);
            if second.body == GROUND {
                return vec![back];
            }
            // The axis turns with the first body.
            let turned = format!("{}.angle + {:?} rad", first.body, y.atan2(x));
            let along = ["cos", "sin"].map(|of| value(format!("{input}*{of}({turned})")));
            vec![load(second, along, Frame::Ground), back]
        }
    }
}

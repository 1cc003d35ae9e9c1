//! `report.html` of a run: what of the model is drawn, and the quantities that follow from the results.

use super::open::Opened;
use linkdyn_engine::analysis::{Outcome, derived::derived};
use linkdyn_model::{ClearanceModel, DriverKind, ForceKind, GROUND, JointKind, Model, PointRef};
use linkdyn_output::{Stage, Summary};
use linkdyn_picture::report::{
    self, Body, Clearance, Driver, Gear, Joint, Load, Mechanism, PointId, Spring, TorsionSpring,
};

use std::collections::HashMap;

/// Bodies beyond which centres of mass are not drawn.
const MANY: usize = 2000;

/// The text of the page.
pub fn text(opened: &Opened, outcome: &Outcome) -> String {
    let model = &opened.loaded.model;
    let (curves, complete) = (outcome.curves(), outcome.all_curves());
    let summary = Summary {
        model_name: &opened.name,
        model_sha256: &opened.sha256,
        settings: &outcome.settings,
        report: &outcome.report,
        trajectory: &curves,
        drawing: serde_json::Value::Null,
        load: opened.time,
        write: Stage::default(),
    };
    let (derived, mut notes) = derived(model, &complete);
    if !outcome.peaks.is_empty() {
        notes.push(format!(
            "Besides the {} outputs this page has {} instants between them: where columns have their smallest or largest value, \
             and where contacts begin, press most and end.",
            outcome.trajectory.len(),
            outcome.peaks.len()
        ));
    }
    report::to_text(&report::Page {
        summary: &summary,
        about: model.about.as_deref(),
        source: model.source.as_deref(),
        mechanism: &mechanism(model),
        complete: &complete,
        derived: &derived,
        notes,
    })
}

/// Numbers of the bodies, ground first.
struct Numbers<'m> {
    model: &'m Model,
    bodies: HashMap<&'m str, usize>,
}

impl Numbers<'_> {
    fn body(&self, name: &str) -> usize {
        self.bodies.get(name).copied().unwrap_or(0)
    }

    fn point(&self, point: &PointRef) -> PointId {
        let number = self
            .model
            .bodies
            .get(&point.body)
            .and_then(|body| body.points.get_index_of(&point.point));
        (self.body(&point.body), number.unwrap_or(0))
    }

    fn ends(&self, ends: &[PointRef; 2]) -> [PointId; 2] {
        ends.each_ref().map(|end| self.point(end))
    }
}

/// What is drawn of a model.
fn mechanism(model: &Model) -> Mechanism {
    let names = [GROUND].into_iter().chain(
        model
            .bodies
            .keys()
            .map(String::as_str)
            .filter(|name| *name != GROUND),
    );
    let numbers = Numbers {
        model,
        bodies: names.clone().zip(0..).collect(),
    };
    let bodies = names.map(|name| {
        let body = model.bodies.get(name);
        let points = body.into_iter().flat_map(|body| &body.points);
        Body {
            name: name.to_string(),
            points: points
                .map(|(name, [x, y])| (name.clone(), *x, *y))
                .collect(),
            com: body
                .and_then(|body| body.com)
                .filter(|_| model.bodies.len() <= MANY),
        }
    });
    let mut mechanism = Mechanism {
        bodies: bodies.collect(),
        joints: model
            .joints
            .iter()
            .map(|(name, joint)| joint_of(&numbers, name, joint))
            .collect(),
        points: model
            .points
            .iter()
            .map(|point| numbers.point(point))
            .collect(),
        ..Mechanism::default()
    };
    for (name, driver) in &model.drivers {
        let name = name.clone();
        mechanism.drivers.push(match &driver.kind {
            DriverKind::Rotation { body, relative_to } => Driver {
                name,
                body: Some(numbers.body(body)),
                relative_to: Some(
                    relative_to
                        .as_deref()
                        .map_or(0, |other| numbers.body(other)),
                ),
                joint: None,
            },
            DriverKind::Translation { joint } => Driver {
                name,
                body: None,
                relative_to: None,
                joint: model.joints.get_index_of(joint),
            },
        });
    }
    for (name, force) in &model.forces {
        let name = name.clone();
        match &force.kind {
            ForceKind::Spring {
                between, stiffness, ..
            } => {
                mechanism.springs.push(Spring {
                    name,
                    between: numbers.ends(between),
                    damper: *stiffness == 0.0,
                });
            }
            ForceKind::TorsionSpring { between, .. } => {
                let bodies = between.each_ref().map(|body| numbers.body(body));
                mechanism
                    .torsion_springs
                    .push(TorsionSpring { name, bodies });
            }
            ForceKind::Load { at, .. } => {
                let at = numbers.point(at);
                mechanism.loads.push(Load {
                    name,
                    at: Some(at),
                    body: at.0,
                });
            }
            ForceKind::Torque { body, .. } => {
                mechanism.loads.push(Load {
                    name,
                    at: None,
                    body: numbers.body(body),
                });
            }
        }
    }
    mechanism
}

fn joint_of(numbers: &Numbers, name: &str, joint: &linkdyn_model::Joint) -> Joint {
    let (mut axis, mut gear, mut gap) = (None, None, None);
    let kind = match &joint.kind {
        JointKind::Revolute { clearance, .. } => {
            gap = clearance
                .as_deref()
                .and_then(|c| Some((clearance_word(c.model)?, c.radius?)));
            "revolute"
        }
        JointKind::Prismatic { axis: along, .. } => {
            axis = unit(*along);
            "prismatic"
        }
        JointKind::Slot { axis: along } => {
            axis = unit(*along);
            "slot"
        }
        JointKind::Gear { ratio, .. } => {
            gear = numbers
                .model
                .carrier(name, joint)
                .and_then(Result::ok)
                .and_then(|carrier| {
                    let [[x1, y1], [x2, y2]] = carrier.centres;
                    // Wheels roll on each other: |R₁| = |ratio|·|R₂|, R₂ = ℓ/(1 − ratio).
                    let second = ((x2 - x1).hypot(y2 - y1) / (1.0 - ratio)).abs();
                    let radii = [second * ratio.abs(), second];
                    let internal = *ratio > 0.0;
                    second.is_finite().then_some(Gear {
                        radii,
                        internal,
                        carrier: numbers.body(carrier.body),
                    })
                });
            "gear"
        }
        JointKind::Fixed { .. } => "fixed",
    };
    let clearance = gap.map(|(model, radius)| Clearance { model, radius });
    Joint {
        name: name.to_string(),
        kind,
        between: numbers.ends(&joint.between),
        axis,
        gear,
        clearance,
    }
}

/// Models that leave an eccentricity.
fn clearance_word(model: ClearanceModel) -> Option<&'static str> {
    match model {
        ClearanceModel::Ideal => None,
        ClearanceModel::MasslessLink => Some("massless_link"),
        ClearanceModel::TwoState => Some("two_state"),
        ClearanceModel::ThreeState => Some("three_state"),
        ClearanceModel::Contact => Some("contact"),
    }
}

fn unit([x, y]: [f64; 2]) -> Option<[f64; 2]> {
    let length = x.hypot(y);
    (length > 0.0).then(|| [x / length, y / length])
}

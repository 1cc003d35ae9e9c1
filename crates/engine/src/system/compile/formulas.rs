//! Formulas of what moves, and the scales of their kinks.

use super::Compiler;
use super::laws::law;
use super::roles::joint_role;
use crate::element::formula::{Formula, Function, MOST_ARGUMENTS, Strength};
use crate::element::quantity::{Measured, Quantity};
use crate::element::{BodyId, Marker};
use crate::motion::Law;
use crate::system::{DriverRole, OutputRatio};
use linkdyn_linear::math::Vec2;
use linkdyn_model::formula::{Argument, Coordinate, Order};
use linkdyn_model::ratio::Ratio;
use linkdyn_model::response::{Catalogue, Program, Tangent};
use linkdyn_model::{ForceKind, PointRef, Value};
use std::sync::Arc;

/// The origin of the ground.
const ORIGIN: Marker = Marker {
    body: BodyId::GROUND,
    s: Vec2::new(0.0, 0.0),
};

impl Compiler<'_> {
    /// What a value is, of time or of what moves.
    pub(super) fn strength(&mut self, value: &Value) -> Strength {
        match value {
            Value::Constant(value) => Strength::OfTime(Law::Polynomial(vec![*value])),
            Value::Motion(motion) => Strength::OfTime(law(motion)),
            Value::Formula(formula) => {
                let catalogue = self
                    .catalogue
                    .get_or_insert_with(|| Catalogue::of(self.model));
                let compiled = formula.compile(catalogue);
                let compiled = compiled.expect("the gate compiles each formula");
                let arguments = compiled.arguments.iter();
                let before = self.system.formulas.last();
                self.kinks.extend(&compiled.moving.kinks);
                let formula = Arc::new(Formula {
                    arguments: arguments.map(|one| self.quantity(one)).collect(),
                    function: Arc::new(Expression {
                        program: compiled.moving.program,
                        parameters: compiled.parameters,
                    }),
                    first: before.map_or(0, |before| before.kinks().end),
                    force: self.system.forces.len(),
                });
                self.system.formulas.push(formula.clone());
                Strength::OfMotion(formula)
            }
        }
    }

    /// Ratios of velocities.
    pub(super) fn add_outputs(&mut self) {
        if self.model.outputs.is_empty() {
            return;
        }
        let catalogue = Catalogue::of(self.model);
        for (name, text) in &self.model.outputs {
            let ratio = Ratio::read(text, &catalogue).expect("the gate reads each output");
            let measured = |argument: &Argument| match self.quantity(argument) {
                Quantity::Value(measured) | Quantity::Rate(measured) => measured,
                Quantity::Drive(driver) => self.driven(driver),
                Quantity::Time => unreachable!("time is no quantity of a ratio"),
            };
            let output = OutputRatio {
                name: name.clone(),
                quantities: ratio.quantities.each_ref().map(measured),
                unit: ratio.unit(),
            };
            self.system.outputs.push(output);
        }
    }

    /// What a driver moves.
    fn driven(&self, driver: usize) -> Measured {
        match self.system.drivers[driver].role {
            DriverRole::Rotation { body, relative_to } => Measured::Turn {
                first: relative_to,
                second: body,
            },
            DriverRole::Length {
                between: [first, second],
            } => Measured::Distance { first, second },
            DriverRole::Translation { joint } => {
                let joint = &self.system.joints[joint.0];
                let [first, second] = joint.points;
                // only what has an axis slides
                let axis = joint.role.axis().unwrap_or_else(Vec2::x);
                Measured::Along {
                    first,
                    second,
                    axis,
                }
            }
        }
    }

    fn quantity(&self, argument: &Argument) -> Quantity {
        let (measured, order) = match argument {
            Argument::Time => return Quantity::Time,
            Argument::Driver(name) => {
                // the formula names one that there is
                let index = self.model.drivers.get_index_of(name);
                return Quantity::Drive(index.unwrap_or_default());
            }
            Argument::Body(name, coordinate, order) => {
                let body = self.body(name);
                let origin = Marker {
                    body,
                    s: -self.com[body.0],
                };
                (coordinate_of(*coordinate, origin), order)
            }
            Argument::Point(point, coordinate, order) => {
                (coordinate_of(*coordinate, self.marker(point)), order)
            }
            Argument::Spring(name, order) => (self.stretch(&self.model.forces[name].kind), order),
            Argument::Turn(name, order) => {
                let [first, second] = &self.model.joints[name].between;
                let turn = Measured::Turn {
                    first: self.body(&first.body),
                    second: self.body(&second.body),
                };
                (turn, order)
            }
            Argument::Slide(name, order) => {
                let joint = &self.model.joints[name];
                // only what has an axis slides
                let axis = joint_role(&joint.kind).axis();
                let [first, second] = &joint.between;
                let along = Measured::Along {
                    first: self.marker(first),
                    second: self.marker(second),
                    axis: axis.unwrap_or_else(Vec2::x),
                };
                (along, order)
            }
        };
        match order {
            Order::Value => Quantity::Value(measured),
            Order::Rate => Quantity::Rate(measured),
        }
    }

    /// What a spring's length or angle is.
    pub(super) fn stretch(&self, kind: &ForceKind) -> Measured {
        let distance = |[first, second]: &[PointRef; 2]| Measured::Distance {
            first: self.marker(first),
            second: self.marker(second),
        };
        match kind {
            ForceKind::Spring { between, .. } | ForceKind::Actuator { between, .. } => {
                distance(between)
            }
            ForceKind::TorsionSpring { between, .. } => Measured::Turn {
                first: self.body(&between[0]),
                second: self.body(&between[1]),
            },
            // these have no ends
            ForceKind::Load { .. } | ForceKind::Torque { .. } => Measured::Turn {
                first: BodyId::GROUND,
                second: BodyId::GROUND,
            },
        }
    }

    /// Scales of what the kinks of all formulas compare, in SI: products of the mechanism's own length, mass and time.
    pub(super) fn kinks(&self) -> Vec<f64> {
        let scale = &self.system.scale;
        let base = [scale.length, scale.mass, scale.time, 1.0];
        let product = |powers: &[f64; 4]| {
            let factors = base.iter().zip(powers);
            factors.map(|(base, power)| base.powf(*power)).product()
        };
        self.kinks.iter().map(product).collect()
    }
}

/// An expression of a model as a function of its arguments.
#[derive(Debug)]
struct Expression {
    program: Program,
    /// In SI.
    parameters: Vec<f64>,
}

const _: () = assert!(linkdyn_model::response::MOST_ARGUMENTS <= MOST_ARGUMENTS);

impl Function for Expression {
    fn value(&self, inputs: &[f64], held: Option<&[i32]>) -> f64 {
        self.program.value_on(inputs, &self.parameters, held)
    }

    fn slope(&self, inputs: &[f64], index: usize, held: Option<&[i32]>) -> f64 {
        let mut tangents = [Tangent::default(); MOST_ARGUMENTS];
        for (tangent, value) in tangents.iter_mut().zip(inputs) {
            tangent.value = *value;
        }
        tangents[index].slope = 1.0;
        let along = self.program.value_on(&tangents, &self.parameters, held);
        along.slope
    }

    fn kinks(&self) -> usize {
        self.program.kinks()
    }

    fn take_sides(&self, inputs: &[f64], sides: &mut [i32]) {
        self.program.take_sides(inputs, &self.parameters, sides);
    }

    fn beyond(&self, inputs: &[f64], held: &[i32], scales: &[f64]) -> f64 {
        let held = (held, scales);
        self.program.beyond(inputs, &self.parameters, held)
    }
}

fn coordinate_of(coordinate: Coordinate, point: Marker) -> Measured {
    let along = |axis| Measured::Along {
        first: ORIGIN,
        second: point,
        axis,
    };
    match coordinate {
        Coordinate::X => along(Vec2::x()),
        Coordinate::Y => along(Vec2::y()),
        Coordinate::Angle => Measured::Turn {
            first: BodyId::GROUND,
            second: point.body,
        },
    }
}

//! Formulas of what moves, and the scales of their kinks.

use super::Compiler;
use super::laws::law;
use super::roles::joint_role;
use crate::element::formula::{Formula, Function, MOST_ARGUMENTS, Strength};
use crate::element::quantity::{Measured, Quantity};
use crate::element::{Axis, BodyId, Marker};
use crate::motion::{Curve, Law, Shape};
use crate::system::{
    DriverId, DriverRole, InputData, MeasuredColumn, OutputKind, OutputRatio, StateData, TimedData,
    Trigger,
};
use linkdyn_linear::math::{Vec2, perp, unit};
use linkdyn_model::event::Event;
use linkdyn_model::formula::{Argument, Coordinate, Order};
use linkdyn_model::ratio::OutputText;
use linkdyn_model::response::{Catalogue, Fixed, Look, Program, Tangent};
use linkdyn_model::{ForceKind, Interpolation, PointRef, Table, Value};
use std::f64::consts::TAU;
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
                let force = self.system.forces.len();
                Strength::OfMotion(self.formula(formula, force))
            }
        }
    }

    /// A formula of a force, or behind all forces of a state.
    fn formula(&mut self, formula: &linkdyn_model::Formula, force: usize) -> Arc<Formula> {
        let catalogue = self
            .catalogue
            .get_or_insert_with(|| Catalogue::of(self.model));
        let compiled = formula.compile(catalogue);
        let compiled = compiled.expect("the gate compiles each formula");
        let tables = self.tables(formula);
        let arguments = compiled.arguments.iter().enumerate();
        let arguments = arguments.flat_map(|(input, argument)| {
            let summands = self.quantities(argument).into_iter();
            summands.map(move |quantity| (input, quantity))
        });
        let arguments = arguments.collect();
        let before = self.system.formulas.last();
        self.kinks.extend(&compiled.moving.kinks);
        let formula = Arc::new(Formula {
            arguments,
            function: Arc::new(Expression {
                program: compiled.moving.program,
                parameters: compiled.parameters,
                tables,
                names: self.model.tables.keys().cloned().collect(),
            }),
            first: before.map_or(0, |before| before.kinks().end),
            force,
        });
        self.system.formulas.push(formula.clone());
        formula
    }

    /// A function of an element; its kinks are where a force is zero.
    pub(super) fn own_formula(
        &mut self,
        function: Arc<dyn Function>,
        arguments: Vec<Quantity>,
    ) -> Arc<Formula> {
        const FORCE: [f64; 4] = [1.0, 1.0, -2.0, 0.0];
        let before = self.system.formulas.last();
        let kinks = std::iter::repeat_n(FORCE, function.kinks());
        self.kinks.extend(kinks);
        let formula = Arc::new(Formula {
            arguments: arguments.into_iter().enumerate().collect(),
            function,
            first: before.map_or(0, |before| before.kinks().end),
            force: self.system.forces.len(),
        });
        self.system.formulas.push(formula.clone());
        formula
    }

    /// Integrated states, behind all forces.
    pub(super) fn add_states(&mut self) {
        let inputs = self.model.inputs.iter().map(|(name, input)| InputData {
            name: name.clone(),
            start: input.start,
        });
        self.system.inputs = inputs.collect();
        for (index, (name, state)) in self.model.states.iter().enumerate() {
            let force = self.system.force_data.len() + index;
            let rate = self.formula(&state.rate, force);
            let data = StateData {
                name: name.clone(),
                units: state.units(),
                start: state.start,
                rate: Strength::OfMotion(rate),
            };
            self.system.states.push(data);
        }
        let currents = std::mem::take(&mut self.integrated);
        self.system.states.extend(currents);
    }

    /// Events that close and open, behind all states.
    pub(super) fn add_events(&mut self) {
        for (index, (contact, timed)) in std::mem::take(&mut self.timed).into_iter().enumerate() {
            let owner = self.system.force_data.len() + self.system.states.len() + index;
            let mut trigger = |event: &Option<Event>| {
                let event = event.as_ref()?;
                let formula = event.formula().expect("the gate reads each event");
                Some(Trigger {
                    formula: self.formula(&formula, owner),
                    either_way: event.is_either_way(),
                })
            };
            let (from, until) = (trigger(&timed.from), trigger(&timed.until));
            self.system.timed.push(TimedData {
                contact,
                from,
                until,
            });
        }
    }

    /// The tables that a formula may look through, its own behind all others.
    fn tables(&mut self, formula: &linkdyn_model::Formula) -> Vec<Arc<dyn Look>> {
        let named = self.model.tables.values();
        let curves = self
            .curves
            .get_or_insert_with(|| named.map(curve).collect());
        let own = formula.table.as_ref().map(curve);
        curves.iter().cloned().chain(own).collect()
    }

    /// Ratios of velocities.
    pub(super) fn add_outputs(&mut self) {
        if self.model.outputs.is_empty() {
            return;
        }
        let catalogue = Catalogue::of(self.model);
        for (name, text) in &self.model.outputs {
            let read = OutputText::read(text, &catalogue).expect("the gate reads each output");
            let measured = |quantity| match quantity {
                Quantity::Value(measured) | Quantity::Rate(measured) => measured,
                Quantity::Drive(driver) => self.driven(driver),
                Quantity::Time | Quantity::State(_) => {
                    unreachable!("neither time nor a state is a quantity of a ratio")
                }
            };
            let sum = |argument| {
                let quantities = self.quantities(argument).into_iter();
                quantities.map(measured).collect()
            };
            let (kind, by) = match &read {
                OutputText::Ratio(ratio) => (
                    OutputKind::Ratio(ratio.quantities.each_ref().map(sum)),
                    match &ratio.quantities[1] {
                        Argument::Driver(driver) => {
                            self.model.drivers.get_index_of(driver).map(DriverId)
                        }
                        _ => None,
                    },
                ),
                OutputText::Centre(centre) => {
                    let kind = OutputKind::Centre {
                        bodies: centre.bodies.each_ref().map(|name| self.body(name)),
                        axis: match centre.coordinate {
                            Coordinate::X => Axis::X,
                            Coordinate::Y | Coordinate::Angle => Axis::Y,
                        },
                    };
                    (kind, None)
                }
            };
            let output = OutputRatio {
                name: name.clone(),
                kind,
                by,
                unit: read.unit(),
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
                from: 0.0,
            },
            DriverRole::Length {
                between: [first, second],
            } => Measured::Distance { first, second },
            DriverRole::Coordinate { origin, axis } => match axis {
                Axis::X => coordinate_of(Coordinate::X, origin),
                Axis::Y => coordinate_of(Coordinate::Y, origin),
                Axis::Theta => coordinate_of(Coordinate::Angle, origin),
            },
            DriverRole::Translation { joint } => {
                let joint = &self.system.joints[joint.0];
                let [first, second] = joint.points();
                // only what has an axis slides
                let axis = joint.role().axis().unwrap_or_else(Vec2::x);
                Measured::Along {
                    first,
                    second,
                    axis,
                }
            }
        }
    }

    /// The quantities of which an argument is the sum.
    fn quantities(&self, argument: &Argument) -> Vec<Quantity> {
        let (measured, order) = match argument {
            Argument::Time => return vec![Quantity::Time],
            Argument::Input(name) => {
                // the formula names one that there is
                let index = self.model.inputs.get_index_of(name);
                return vec![Quantity::State(index.unwrap_or_default())];
            }
            Argument::State(name) => {
                // the formula names one that there is
                let index = self.model.states.get_index_of(name);
                let before = self.model.inputs.len();
                return vec![Quantity::State(before + index.unwrap_or_default())];
            }
            Argument::Driver(name) => {
                // the formula names one that there is
                let index = self.model.drivers.get_index_of(name);
                return vec![Quantity::Drive(index.unwrap_or_default())];
            }
            Argument::Spring(name, order) => (self.stretches(&self.model.forces[name].kind), order),
            Argument::Body(name, coordinate, order) => {
                let body = self.body(name);
                let origin = Marker {
                    body,
                    s: -self.com[body.0],
                };
                (vec![coordinate_of(*coordinate, origin)], order)
            }
            Argument::Point(point, coordinate, order) => {
                let point = self.marker(point);
                (vec![coordinate_of(*coordinate, point)], order)
            }
            Argument::Turn(name, order) => {
                let [first, second] = &self.model.joints[name].between;
                let turn = Measured::Turn {
                    first: self.body(&first.body),
                    second: self.body(&second.body),
                    from: 0.0,
                };
                (vec![turn], order)
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
                (vec![along], order)
            }
            Argument::Measure(name, order) => {
                (vec![self.measured(&self.model.measures[name])], order)
            }
        };
        let of = match order {
            Order::Value => Quantity::Value,
            Order::Rate => Quantity::Rate,
        };
        measured.into_iter().map(of).collect()
    }

    /// What a measure measures; an angle is within half a turn where the bodies are drawn.
    fn measured(&self, measure: &linkdyn_model::Measurement) -> Measured {
        // the gate has counted the points, and a line is of one body
        let line = |points: &[PointRef]| {
            let [from, to] = [&points[0], &points[1]].map(|point| self.marker(point));
            (from, to.s - from.s)
        };
        match measure {
            linkdyn_model::Measurement::Distance([first, second]) => Measured::Distance {
                first: self.marker(first),
                second: self.marker(second),
            },
            linkdyn_model::Measurement::DistanceToLine(points) => {
                let (first, along) = line(&points[1..]);
                Measured::Along {
                    first,
                    second: self.marker(&points[0]),
                    axis: perp(unit(along)),
                }
            }
            linkdyn_model::Measurement::Angle(points) => {
                let [(first, base), (second, along)] = [line(&points[..2]), line(&points[2..])];
                let [first, second] = [first.body, second.body];
                let from = along.y.atan2(along.x) - base.y.atan2(base.x);
                let drawn = self.drawn(second) - self.drawn(first) + from;
                Measured::Turn {
                    first,
                    second,
                    from: from - TAU * (drawn / TAU).round(),
                }
            }
        }
    }

    /// The angle at which a body is drawn \[rad\].
    fn drawn(&self, body: BodyId) -> f64 {
        let columns = self.system.layout.columns(body);
        columns.map_or(0.0, |columns| self.system.guess[columns.theta()])
    }

    /// Measures among the results.
    pub(super) fn add_measures(&mut self) {
        for (name, measure) in &self.model.measures {
            self.system.measured.push(MeasuredColumn {
                name: name.clone(),
                measured: self.measured(measure),
            });
        }
    }

    /// What a spring's length or angle is the sum of; nothing where a force has none.
    pub(super) fn stretches(&self, kind: &ForceKind) -> Vec<Measured> {
        let distance = |first: &PointRef, second: &PointRef| Measured::Distance {
            first: self.marker(first),
            second: self.marker(second),
        };
        match kind {
            ForceKind::Spring { between, .. }
            | ForceKind::Actuator { between, .. }
            | ForceKind::GasSpring { between, .. }
            | ForceKind::Cylinder { between, .. } => {
                vec![distance(&between[0], &between[1])]
            }
            ForceKind::Cable { through, .. } => {
                let pairs = through.windows(2);
                pairs.map(|pair| distance(&pair[0], &pair[1])).collect()
            }
            ForceKind::TorsionSpring { between, .. } => vec![Measured::Turn {
                first: self.body(&between[0]),
                second: self.body(&between[1]),
                from: 0.0,
            }],
            ForceKind::Load { .. } | ForceKind::Torque { .. } | ForceKind::DcMotor { .. } => {
                Vec::new()
            }
        }
    }

    /// Scales of what the kinks of all formulas compare, in SI: products of the mechanism's own length, mass and time; behind them
    /// a radian for each cam that has breaks.
    pub(super) fn kinks(&self) -> Vec<f64> {
        let scale = &self.system.scale;
        let base = [scale.length, scale.mass, scale.time, 1.0];
        let product = |powers: &[f64; 4]| {
            let factors = base.iter().zip(powers);
            factors.map(|(base, power)| base.powf(*power)).product()
        };
        let cams = self.system.cams().filter(|cam| cam.kink.is_some());
        let formulas = self.kinks.iter().map(product);
        formulas.chain(cams.map(|_| 1.0)).collect()
    }
}

/// An expression of a model as a function of its arguments.
#[derive(Debug)]
struct Expression {
    program: Program,
    /// In SI.
    parameters: Vec<f64>,
    tables: Vec<Arc<dyn Look>>,
    /// Of the tables that have any.
    names: Vec<String>,
}

impl Expression {
    fn fixed(&self) -> Fixed<'_> {
        Fixed {
            parameters: &self.parameters,
            tables: &self.tables,
        }
    }
}

/// A table as a function.
fn curve(table: &Table) -> Arc<dyn Look> {
    let shape = match table.interpolation {
        Interpolation::Linear => Shape::Lines,
        Interpolation::Monotone => Shape::Monotone,
        Interpolation::Natural | Interpolation::Periodic => Shape::Spline,
    };
    Arc::new(Curve::new(
        &table.closed(),
        shape,
        table.repeats().is_some(),
    ))
}

impl Look for Curve {
    fn side(&self, x: f64) -> i32 {
        Curve::side(self, x)
    }

    fn beyond(&self, x: f64, side: i32) -> f64 {
        Curve::beyond(self, x, side)
    }

    fn jet(&self, x: f64, side: i32) -> [f64; 2] {
        Curve::jet(self, x, side)
    }

    fn is_outside(&self, x: f64) -> bool {
        Curve::is_outside(self, x)
    }
}

const _: () = assert!(linkdyn_model::response::MOST_ARGUMENTS <= MOST_ARGUMENTS);

impl Function for Expression {
    fn value(&self, inputs: &[f64], held: Option<&[i32]>) -> f64 {
        self.program.value_on(inputs, self.fixed(), held)
    }

    fn slope(&self, inputs: &[f64], index: usize, held: Option<&[i32]>) -> f64 {
        let mut tangents = [Tangent::default(); MOST_ARGUMENTS];
        for (tangent, value) in tangents.iter_mut().zip(inputs) {
            tangent.value = *value;
        }
        tangents[index].slope = 1.0;
        let along = self.program.value_on(&tangents, self.fixed(), held);
        along.slope
    }

    fn kinks(&self) -> usize {
        self.program.kinks()
    }

    fn take_sides(&self, inputs: &[f64], sides: &mut [i32]) {
        self.program.take_sides(inputs, self.fixed(), sides);
    }

    fn beyond(&self, inputs: &[f64], held: &[i32], scales: &[f64]) -> f64 {
        let held = (held, scales);
        self.program.beyond(inputs, self.fixed(), held)
    }

    fn outside(&self, inputs: &[f64]) -> Option<&str> {
        let table = self.program.outside(inputs, self.fixed())?;
        Some(self.names.get(table).map_or("", String::as_str))
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
            from: 0.0,
        },
    }
}

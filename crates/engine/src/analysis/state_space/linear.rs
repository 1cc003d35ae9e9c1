//! A, B, C, D about one point.

use super::answer::{LinearSystem, NoLinearSystem, StateSpaceQuestion, Variable};
use super::inputs::{Input, NamedInput};
use super::outputs::OutputColumns;
use super::points::OperatingPoint;
use crate::analysis::equilibrium::coordinate_name;
use crate::analysis::sample::{ContactSample, Sample};
use crate::analysis::words::locked;
use crate::element::pair::{ContactId, Hold, Surface};
use crate::element::{Axis, Measure};
use crate::mechanism::driven::Failure;
use crate::mechanism::released::{GivenPoint, Released};
use crate::mechanism::ridders::{Derivative, derivatives};
use crate::system::System;
use linkdyn_linear::state_space::{eigenvalues, static_gain};
use linkdyn_model::Checked;
use linkdyn_output::{BodyQuantity, Channel, DriverQuantity, Status};

/// The linear system about a point.
///
/// # Errors
/// Inputs and outputs that do not fit, and points without linear equations.
pub fn about(
    model: &Checked,
    question: &StateSpaceQuestion,
    point: OperatingPoint,
) -> Result<LinearSystem, NoLinearSystem> {
    let mut local = NearPoint::new(model, question, &point)?;
    let (states, inputs) = (local.states(), local.inputs());
    let (x, w) = (values(&states), values(&inputs));
    let mut start = Vec::new();
    local
        .evaluate(&x, &w, &mut start)
        .map_err(|failure| singular(local.system(), failure))?;
    let rates = start[..x.len()].to_vec();
    let outputs = local.outputs_at(&start[x.len()..])?;
    let mut matrices = MatrixColumns::new(x.len(), outputs.len(), local.f());
    let mut place = (x.clone(), w.clone());
    for column in 0..x.len() + w.len() {
        let length = local.length(column, &x, &w);
        let count = start.len();
        let found = derivatives(count, length, |h, to| {
            let before = *number_of(&mut place, column, x.len());
            *number_of(&mut place, column, x.len()) = before + h;
            let solved = local.evaluate(&place.0, &place.1, to);
            *number_of(&mut place, column, x.len()) = before;
            solved.is_ok() && to.iter().all(|value| value.is_finite())
        });
        let found = found.ok_or_else(|| singular(local.system(), Failure::Singular))?;
        matrices.take(column, x.len(), &local, &found);
    }
    let n = x.len();
    let flat = |rows: &[Vec<f64>]| rows.concat();
    let poles = eigenvalues(&flat(&matrices.a), n).ok_or_else(|| NoLinearSystem::Failed {
        status: Status::Singular,
        message: "the eigenvalues do not converge".into(),
    })?;
    let gain = static_gain(
        [
            &flat(&matrices.a),
            &flat(&matrices.b),
            &flat(&matrices.c),
            &flat(&matrices.d),
        ],
        [n, w.len(), outputs.len()],
    )
    .filter(|_| poles.iter().all(|pole| *pole != [0.0; 2]));
    Ok(LinearSystem {
        time: point.time,
        equilibrium: point.equilibrium.clone(),
        states,
        inputs,
        outputs,
        rates,
        errors: matrices.errors(),
        a: matrices.a,
        b: matrices.b,
        c: matrices.c,
        d: matrices.d,
        phases: point.phases(),
        poles,
        gain: gain.map(|gain| gain.chunks(w.len().max(1)).map(<[f64]>::to_vec).collect()),
        warnings: point.warnings.clone(),
    })
}

fn number_of(place: &mut (Vec<f64>, Vec<f64>), column: usize, states: usize) -> &mut f64 {
    match column.checked_sub(states) {
        None => &mut place.0[column],
        Some(input) => &mut place.1[input],
    }
}

fn values(all: &[Variable]) -> Vec<f64> {
    all.iter().map(|one| one.value).collect()
}

fn singular(system: &System, failure: Failure) -> NoLinearSystem {
    let message = match failure {
        Failure::Locked { force } => locked(system, force),
        Failure::Singular | Failure::Diverged { .. } | Failure::Inconsistent { .. } => {
            "the point has no linear equations: the mechanism is in a singular position, or what is free to move has neither mass nor inertia".into()
        }
    };
    NoLinearSystem::Failed {
        status: Status::Singular,
        message,
    }
}

/// The mechanism at places about a point.
struct NearPoint<'p> {
    released: Released<'p>,
    outputs: OutputColumns<'p>,
    named: Vec<NamedInput>,
    /// Drivers whose accelerations are inputs.
    led: Vec<usize>,
    holds: &'p [Hold],
    pressed: &'p [bool],
    /// ṗ at the point (f).
    rates: Vec<f64>,
    sample: Sample,
    efforts: Vec<f64>,
    force: Vec<f64>,
}

impl<'p> NearPoint<'p> {
    fn new(
        model: &Checked,
        question: &StateSpaceQuestion,
        point: &'p OperatingPoint,
    ) -> Result<Self, NoLinearSystem> {
        let system = point.system;
        let refused = |failure: Failure| singular(system, failure);
        let all = |free: Vec<usize>| {
            let at = (point.q, point.inputs.clone());
            Released::new(system, &point.columns, at, (free, point.rubs)).map_err(refused)
        };
        // First as it is, for what holds it and where forces act.
        let mut held = all(Vec::new())?;
        let rates: Vec<f64> = point
            .columns
            .iter()
            .map(|column| point.v[*column])
            .collect();
        let force = vec![0.0; system.n()];
        let positions = held.start().to_vec();
        held.evaluate(&GivenPoint {
            positions: &positions,
            rates: &rates,
            efforts: &[],
            force: &force,
        })
        .map_err(refused)?;
        let at = held.driven.evaluation.kinematics(&held.inputs);
        let named = NamedInput::all((model, system), &at, &question.inputs)?;
        let (mut free, mut led) = (Vec::new(), Vec::new());
        for own in &named {
            match own.input {
                Input::Effort(driver) => free.push(driver),
                Input::Acceleration(driver) => led.push(driver),
                Input::Force(_) | Input::Number(_) => {}
            }
        }
        let driven = [&free[..], &led].concat();
        if let Some(driver) = held.sharing(&driven) {
            let name = &system.drivers[driver].name;
            return Err(NoLinearSystem::Question(format!(
                "input \"driver.{name}\": the driver shares its motion with others, or with redundant joints, and can't move alone (leave out the others)"
            )));
        }
        let efforts = free.iter().map(|driver| held.efforts()[*driver]).collect();
        let of_free = free.iter().map(|driver| point.inputs.drive[*driver][1]);
        let rates: Vec<f64> = rates.iter().copied().chain(of_free).collect();
        let released = all(free)?;
        let mut otherwise: Vec<Channel> = Vec::new();
        for column in &point.columns {
            let (body, axis) = system.layout.coordinate(*column);
            let quantity = match axis {
                Axis::X => BodyQuantity::X,
                Axis::Y => BodyQuantity::Y,
                Axis::Theta => BodyQuantity::Angle,
            };
            otherwise.extend(body.index().map(|body| Channel::Body(body, quantity)));
        }
        let drivers = driven.iter();
        otherwise.extend(drivers.map(|driver| Channel::Driver(*driver, DriverQuantity::Value)));
        let outputs = OutputColumns::new(system, point.rubs, &question.outputs, &otherwise)?;
        let local = NearPoint {
            sample: Sample::new(system),
            released,
            outputs,
            named,
            led,
            holds: &point.holds,
            pressed: &point.pressed,
            rates,
            efforts,
            force,
        };
        if local.count() == 0 {
            return Err(NoLinearSystem::Question(
                "nothing is free to move, and there are no states; drivers and joints hold everything (let a driver go: the input driver.NAME)"
                    .into(),
            ));
        }
        Ok(local)
    }

    fn system(&self) -> &'p System {
        self.outputs.system()
    }

    /// Degrees of freedom.
    fn f(&self) -> usize {
        self.released.freedom()
    }

    /// Number of states.
    fn count(&self) -> usize {
        2 * self.f() + self.system().states.len() + 2 * self.led.len()
    }

    /// x.
    fn states(&self) -> Vec<Variable> {
        let system = self.system();
        let coordinates = self.released.driven.independent.iter();
        let name_and_measure = |column: usize| {
            let measure = match system.layout.coordinate(column).1 {
                Axis::X | Axis::Y => Measure::Length,
                Axis::Theta => Measure::Angle,
            };
            (coordinate_name(system, column), measure)
        };
        let of_driver = |driver: &usize| {
            let data = &system.drivers[*driver];
            (format!("driver.{}", data.name), data.measure)
        };
        let own = coordinates.map(|own| name_and_measure(own.column));
        let own: Vec<_> = own
            .chain(self.released.free.iter().map(of_driver))
            .collect();
        let position = |(name, measure): &(String, Measure), value: f64| Variable {
            name: name.clone(),
            unit: unit(*measure, 0).into(),
            value,
        };
        let rate = |(name, measure): &(String, Measure), value: f64| Variable {
            name: format!("{name}.rate"),
            unit: unit(*measure, 1).into(),
            value,
        };
        let at = self.released.start().iter();
        let positions = own.iter().zip(at).map(|(own, value)| position(own, *value));
        let rates = own
            .iter()
            .zip(&self.rates)
            .map(|(own, value)| rate(own, *value));
        let values = &self.released.inputs.states[system.inputs.len()..];
        let integrated = system.states.iter().zip(values);
        let integrated = integrated.map(|(state, value)| Variable {
            name: format!("state.{}", state.name),
            unit: state.units[0].into(),
            value: *value,
        });
        let led = self.led.iter().flat_map(|driver| {
            let (own, jet) = (of_driver(driver), self.released.inputs.drive[*driver]);
            [position(&own, jet[0]), rate(&own, jet[1])]
        });
        positions
            .chain(rates)
            .chain(integrated)
            .chain(led)
            .collect()
    }

    /// w.
    fn inputs(&self) -> Vec<Variable> {
        let mut efforts = self.efforts.iter();
        let value = |input: &Input, efforts: &mut std::slice::Iter<f64>| match input {
            Input::Effort(_) => efforts.next().copied().unwrap_or_default(),
            Input::Acceleration(driver) => self.released.inputs.drive[*driver][2],
            Input::Force(_) => 0.0,
            Input::Number(number) => self.released.inputs.states[*number],
        };
        let named = self.named.iter();
        let named = named.map(|own| Variable {
            name: own.name.clone(),
            unit: own.unit.clone(),
            value: value(&own.input, &mut efforts),
        });
        named.collect()
    }

    /// y with these values.
    fn outputs_at(&self, values: &[f64]) -> Result<Vec<Variable>, NoLinearSystem> {
        let headings = self.outputs.headings().zip(values);
        let all: Vec<Variable> = headings
            .map(|(column, value)| Variable {
                name: column.name.clone(),
                unit: column.unit.into(),
                value: *value,
            })
            .collect();
        match all.iter().find(|output| !output.value.is_finite()) {
            Some(output) => Err(NoLinearSystem::Question(format!(
                "output {:?}: it has no value at this point",
                output.name
            ))),
            None => Ok(all),
        }
    }

    /// By what length a state or an input changes.
    fn length(&self, column: usize, x: &[f64], w: &[f64]) -> f64 {
        let (system, f) = (self.system(), self.f());
        let scale = system.scale;
        let of = |measure: Measure| match measure {
            Measure::Angle => 1.0,
            Measure::Length => system.size,
        };
        let position = |k: usize| match self.released.driven.independent.get(k) {
            Some(own) => system.column_scale(own.column),
            None => {
                let driver = self.released.free[k - self.released.driven.independent.len()];
                of(system.drivers[driver].measure)
            }
        };
        let Some(input) = column.checked_sub(x.len()) else {
            let integrated = 2 * f..2 * f + system.states.len();
            return match column {
                _ if column < f => position(column),
                _ if column < 2 * f => (position(column - f) / scale.time).max(x[column].abs()),
                _ if integrated.contains(&column) => x[column].abs().max(1.0),
                _ => {
                    let led = column - integrated.end;
                    let length = of(system.drivers[self.led[led / 2]].measure);
                    match led % 2 {
                        0 => length,
                        _ => (length / scale.time).max(x[column].abs()),
                    }
                }
            };
        };
        let typical = match &self.named[input].input {
            Input::Acceleration(driver) => {
                of(system.drivers[*driver].measure) / (scale.time * scale.time)
            }
            Input::Effort(_) | Input::Force(_) => match self.named[input].unit.as_str() {
                "N" => scale.force(),
                _ => scale.force() * scale.length,
            },
            Input::Number(_) => 1.0,
        };
        typical.max(w[input].abs())
    }

    /// ẋ and y at a place.
    fn evaluate(&mut self, x: &[f64], w: &[f64], to: &mut Vec<f64>) -> Result<(), Failure> {
        let (f, z) = (self.f(), self.system().states.len());
        let (mechanical, rest) = x.split_at(2 * f);
        let (states, led) = rest.split_at(z);
        let numbers = self.system().inputs.len();
        self.released.inputs.states[numbers..].copy_from_slice(states);
        self.efforts.clear();
        self.force.fill(0.0);
        let mut led = self.led.iter().zip(led.chunks_exact(2));
        for (own, value) in self.named.iter().zip(w) {
            match &own.input {
                Input::Effort(_) => self.efforts.push(*value),
                Input::Acceleration(_) => {
                    if let Some((driver, motion)) = led.next() {
                        self.released.inputs.drive[*driver] = [motion[0], motion[1], *value];
                    }
                }
                Input::Force(force) => {
                    let sum = self.force.iter_mut().zip(force);
                    sum.for_each(|(sum, unit)| *sum += unit * value);
                }
                Input::Number(number) => self.released.inputs.states[*number] = *value,
            }
        }
        let given = GivenPoint {
            positions: &mechanical[..f],
            rates: &mechanical[f..],
            efforts: &self.efforts,
            force: &self.force,
        };
        self.released.evaluate(&given)?;
        to.extend_from_slice(&mechanical[f..]);
        to.extend_from_slice(&self.released.accelerations);
        let at = self
            .released
            .driven
            .evaluation
            .kinematics(&self.released.inputs);
        to.extend(
            self.system()
                .states
                .iter()
                .map(|state| state.rate.value(&at)),
        );
        for driver in &self.led {
            let [_, rate, acceleration] = self.released.inputs.drive[*driver];
            to.extend([rate, acceleration]);
        }
        self.read(to);
        Ok(())
    }

    /// Appends y.
    fn read(&mut self, to: &mut Vec<f64>) {
        let (released, sample) = (&mut self.released, &mut self.sample);
        // What a driver that is let go does is no longer what was given.
        for (driver, rate) in released
            .free
            .iter()
            .zip(&released.accelerations[released.driven.independent.len()..])
        {
            released.inputs.drive[*driver][2] = *rate;
        }
        sample.q.copy_from_slice(&released.q);
        sample.v.copy_from_slice(&released.v);
        sample.a.copy_from_slice(&released.a);
        sample.lambda.copy_from_slice(&released.lambda);
        sample.force.copy_from_slice(&released.force);
        sample.balance.copy_from_slice(&released.balance);
        let sizes = released.driven.dependent_forces.sizes();
        if released.rubs {
            sample.dependent_forces.copy_from_slice(sizes);
        }
        let system = released.driven.system;
        for (contact, own) in sample.contacts.iter_mut().enumerate() {
            *own = contact_sample(released, (self.holds, self.pressed), contact);
        }
        let (evaluation, inputs) = (&released.driven.evaluation, &released.inputs);
        sample.contact_energy[0] = evaluation.contact_energy(system, inputs);
        self.outputs.read(system, evaluation, inputs, sample, to);
    }
}

/// A contact, as it is held.
fn contact_sample(
    released: &Released,
    (holds, pressed): (&[Hold], &[bool]),
    contact: usize,
) -> ContactSample {
    let system = released.driven.system;
    let (evaluation, inputs) = (&released.driven.evaluation, &released.inputs);
    let pair = &system.contacts[contact];
    let mut reading = evaluation.contact(system, inputs, ContactId(contact));
    let hold = holds.get(contact).copied().unwrap_or(Hold::Free);
    let row = || system.held_block(contact).map_or(0, |block| block.row());
    let state = match (hold, pressed.get(contact) == Some(&true)) {
        (Hold::Free, true) => {
            if let Surface::Compliant(laws) = &pair.surface {
                reading.normal = laws.normal.continued(reading.penetration, 0.0, 0.0);
            }
            1.0
        }
        (Hold::Free, false) => match reading.normal {
            0.0 => 0.0,
            _ => 1.0,
        },
        (Hold::Slides, _) => {
            let block = system.dependent_forces.iter().rposition(|own| {
                Some(own.block) == system.blocks.iter().position(|block| block.row() == row())
            });
            let sizes = released.driven.dependent_forces.sizes();
            let friction = block
                .filter(|_| released.rubs)
                .map_or(0.0, |force| sizes[force]);
            reading.slide(released.lambda[row()], friction);
            1.0
        }
        (Hold::Sticks, _) => {
            reading.stick([released.lambda[row()], released.lambda[row() + 1]]);
            2.0
        }
    };
    ContactSample { reading, state }
}

fn unit(measure: Measure, order: usize) -> &'static str {
    match (measure, order) {
        (Measure::Angle, 0) => "rad",
        (Measure::Angle, _) => "rad/s",
        (Measure::Length, 0) => "m",
        (Measure::Length, _) => "m/s",
    }
}

/// A, B, C, D and their errors, while columns come.
struct MatrixColumns {
    a: Vec<Vec<f64>>,
    b: Vec<Vec<f64>>,
    c: Vec<Vec<f64>>,
    d: Vec<Vec<f64>>,
    /// Largest error by row, of each matrix.
    worst: [Vec<f64>; 4],
    f: usize,
}

impl MatrixColumns {
    fn new(states: usize, outputs: usize, f: usize) -> Self {
        MatrixColumns {
            a: vec![Vec::new(); states],
            b: vec![Vec::new(); states],
            c: vec![Vec::new(); outputs],
            d: vec![Vec::new(); outputs],
            worst: [states, states, outputs, outputs].map(|rows| vec![0.0; rows]),
            f,
        }
    }

    /// Takes the derivatives of ẋ and y by one state, or one input behind them.
    fn take(&mut self, column: usize, states: usize, local: &NearPoint, found: &[Derivative]) {
        let (of_rates, of_outputs) = found.split_at(states);
        let is_state = column < states;
        let [first, second] = match is_state {
            true => [(0, &mut self.a), (2, &mut self.c)],
            false => [(1, &mut self.b), (3, &mut self.d)],
        };
        let led = 2 * self.f + local.system().states.len();
        let is_known = |row: usize| row < self.f || row >= led;
        for ((number, matrix), all) in [(first, of_rates), (second, of_outputs)] {
            for (row, own) in all.iter().enumerate() {
                let mut own = *own;
                if number < 2 && is_known(row) {
                    // Rates of positions are states, and those of a driver's motion a state and an input.
                    own = Derivative {
                        value: own.value.round(),
                        error: 0.0,
                    };
                }
                // What may be nothing but its error is nothing.
                let value = if own.value.abs() <= own.error {
                    0.0
                } else {
                    own.value
                };
                matrix[row].push(value);
                self.worst[number][row] = self.worst[number][row].max(own.error);
            }
        }
    }

    /// By the largest entries of rows.
    fn errors(&self) -> [f64; 4] {
        let matrices = [&self.a, &self.b, &self.c, &self.d];
        let mut errors = [0.0; 4];
        for ((error, matrix), worst) in errors.iter_mut().zip(matrices).zip(&self.worst) {
            for (row, worst) in matrix.iter().zip(worst) {
                let largest = row.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
                if largest > 0.0 {
                    *error = f64::max(*error, worst / largest);
                }
            }
        }
        errors
    }
}

//! Ready parts: gas springs, cylinders and motors, by the numbers of their data sheets.

use super::{Compiler, Currents};
use crate::element::BodyId;
use crate::element::formula::Strength;
use crate::element::gas_spring::GasLaw;
use crate::element::linear::Weighted;
use crate::element::quantity::{Measured, Quantity};
use crate::system::StateData;
use linkdyn_model::ForceKind;
use std::f64::consts::FRAC_PI_4;
use std::sync::Arc;

impl Compiler<'_> {
    /// What a gas spring or a cylinder pushes its points apart with.
    pub(super) fn push(&mut self, kind: &ForceKind) -> Strength {
        match kind {
            ForceKind::GasSpring {
                force,
                extended,
                stroke,
                progression,
                exponent,
                damping,
                ..
            } => {
                let law = GasLaw {
                    force: *force,
                    extended: *extended,
                    stroke: *stroke,
                    progression: *progression,
                    exponent: *exponent,
                    damping: *damping,
                };
                let length = self.stretches(kind)[0];
                let arguments = vec![Quantity::Value(length), Quantity::Rate(length)];
                Strength::OfMotion(self.own_formula(Arc::new(law), arguments))
            }
            ForceKind::Cylinder {
                bore,
                rod,
                pressure,
                rod_pressure,
                ..
            } => {
                let full = FRAC_PI_4 * bore * bore;
                let ring = FRAC_PI_4 * (bore - rod) * (bore + rod);
                let [pressure, rod_pressure] =
                    [pressure, rod_pressure].map(|value| self.strength(value));
                Strength::Sum(vec![(full, pressure), (-ring, rod_pressure)])
            }
            _ => unreachable!("no other kind pushes by a law of its own"),
        }
    }

    /// Torque of a motor, and the same by its current.
    ///
    /// ```text
    /// T = k g i,   L di/dt = u − R i − k g ω;   without L: i = (u − k g ω)/R
    /// ```
    pub(super) fn motor(&mut self, kind: &ForceKind) -> (Strength, Option<f64>) {
        let ForceKind::DcMotor {
            body,
            relative_to,
            voltage,
            torque_constant,
            resistance,
            inductance,
            gear,
        } = kind
        else {
            unreachable!("the caller has a motor");
        };
        let by_current = torque_constant * gear;
        let omega = Quantity::Rate(Measured::Turn {
            first: relative_to
                .as_deref()
                .map_or(BodyId::GROUND, |name| self.body(name)),
            second: self.body(body),
            from: 0.0,
        });
        let voltage = self.strength(voltage);
        let torque = if *inductance == 0.0 || self.currents == Currents::Steady {
            let by_voltage = by_current / resistance;
            let braking = self.weighted(vec![-by_voltage * by_current], vec![omega]);
            Strength::Sum(vec![(by_voltage, voltage), (1.0, braking)])
        } else {
            let before = self.model.inputs.len() + self.model.states.len();
            let current = Quantity::State(before + self.integrated.len());
            let factors = vec![-by_current / inductance, -resistance / inductance];
            let losses = self.weighted(factors, vec![omega, current]);
            let torque = self.weighted(vec![by_current], vec![current]);
            let name = self.model.forces.get_index(self.system.forces.len());
            let name = name.map_or("", |(name, _)| name);
            self.integrated.push(StateData {
                name: format!("{name}.current"),
                units: ["A", "A/s"],
                start: 0.0,
                rate: Strength::Sum(vec![(1.0 / inductance, voltage), (1.0, losses)]),
            });
            torque
        };
        (torque, Some(by_current))
    }

    fn weighted(&mut self, factors: Vec<f64>, arguments: Vec<Quantity>) -> Strength {
        Strength::OfMotion(self.own_formula(Arc::new(Weighted { factors }), arguments))
    }
}

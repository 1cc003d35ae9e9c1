//! One free impact: from the first touch to the last, by integration.

use crate::CaseError;
use linkdyn_engine::contact::normal::Law;
use linkdyn_engine::integrate::{Dop853, Limits, Ode, Refused, Stepper, Tolerance};

/// Local error of the integration, relative to largest penetration and approach [–].
const TOLERANCE: f64 = 1e-13;

/// m δ̈ = −F(δ, δ̇; δ̇₀), from δ = 0.
struct Flight<'a> {
    law: &'a Law,
    mass: f64,
    approach: f64,
}

impl Flight<'_> {
    /// F, at the start as it is just after.
    fn force(&self, y: &[f64]) -> f64 {
        self.law
            .force(y[0].max(f64::MIN_POSITIVE), y[1], self.approach)
            .force
    }

    /// dF/dt.
    fn force_rate(&self, y: &[f64]) -> f64 {
        let value = self
            .law
            .force(y[0].max(f64::MIN_POSITIVE), y[1], self.approach);
        value.d_penetration * y[1] - value.d_rate * value.force / self.mass
    }

    fn in_contact(&self, y: &[f64]) -> bool {
        self.law.force(y[0], y[1], self.approach).force > 0.0
    }
}

impl Ode for Flight<'_> {
    fn dimension(&self) -> usize {
        2
    }

    fn eval(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Refused> {
        dy[0] = y[1];
        dy[1] = -self.force(y) / self.mass;
        Ok(())
    }

    fn accept(&mut self, _: f64, _: &[f64]) {}
}

/// Restitution, largest penetration, duration and peak force of an impact.
pub fn fly(law: &Law, mass: f64, speed: f64) -> Result<[f64; 4], CaseError> {
    let broken = |what: &dyn std::fmt::Debug| CaseError::Broken(format!("{law:?}: {what:?}"));
    // The elastic penetration as the scale.
    let energy = 0.5 * mass * speed * speed;
    let mut depth = 1.0;
    while law.elastic_energy(depth) > energy {
        depth *= 0.5;
    }
    let mut flight = Flight {
        law,
        mass,
        approach: speed,
    };
    let tolerance = Tolerance {
        rtol: TOLERANCE,
        atol: vec![TOLERANCE * depth, TOLERANCE * speed],
        cap: Vec::new(),
    };
    let mut stepper = Dop853::new(tolerance, Limits::default());
    // Longer than any contact of the tables, shorter than is needed to see none of it.
    let end = 100.0 * depth / speed;
    let start = [0.0, speed];
    stepper
        .start(&mut flight, 0.0, &start, end)
        .map_err(|failure| broken(&failure))?;
    let (mut deepest, mut peak) = (0.0, flight.force(&start));
    let mut before = start;
    while stepper.t() < end {
        stepper
            .step(&mut flight, end)
            .map_err(|failure| broken(&failure))?;
        let now = [stepper.y()[0], stepper.y()[1]];
        if before[1] > 0.0 && now[1] <= 0.0 {
            deepest = locate(&mut stepper, &mut flight, |_, y| y[1] > 0.0)
                .map_err(|refused| broken(&refused))?
                .1[0];
        }
        if flight.force_rate(&before) > 0.0 && flight.force_rate(&now) <= 0.0 {
            let rises = |flight: &Flight, y: &[f64; 2]| flight.force_rate(y) > 0.0;
            let (_, y) =
                locate(&mut stepper, &mut flight, rises).map_err(|refused| broken(&refused))?;
            peak = flight.force(&y);
        }
        if !flight.in_contact(&now) {
            let contact = |flight: &Flight, y: &[f64; 2]| flight.in_contact(y);
            let (t, y) =
                locate(&mut stepper, &mut flight, contact).map_err(|refused| broken(&refused))?;
            return Ok([-y[1] / speed, deepest, t, peak]);
        }
        before = now;
    }
    Err(broken(&"the contact does not end"))
}

/// Where in the last step `holds` ends.
fn locate(
    stepper: &mut Dop853,
    flight: &mut Flight,
    holds: impl Fn(&Flight, &[f64; 2]) -> bool,
) -> Result<(f64, [f64; 2]), Refused> {
    let (mut before, mut after) = (stepper.previous(), stepper.t());
    let mut y = [0.0; 2];
    loop {
        let middle = 0.5 * (before + after);
        stepper.interpolate(flight, middle, &mut y)?;
        if middle <= before || middle >= after {
            return Ok((middle, y));
        }
        if holds(flight, &y) {
            before = middle
        } else {
            after = middle
        }
    }
}

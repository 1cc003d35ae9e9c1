//! How exact a step of the motion has to be, component by component of y.

use super::Flow;
use crate::analysis::dynamics::settings::Exactness;
use crate::element::pair::{Pair, Shape, Surface};
use crate::integrate::Tolerance;

/// Rates near zero are measured against this [L/T, 1/T]: slow against the motion, fast against its round-off.
const SLOW: f64 = 2e-3;

/// Errors of the energy ledger are bounded by this, times rtol, of the kinetic energy at the last event.
const LEDGER: f64 = 10.0;
/// A mechanism in which locks and clutches hold has no less than this part of its own energy [–].
const REST: f64 = 1e-6;
/// No step is bounded by less than this part of what it moves, for evaluations are no better.
const ROUND_OFF: f64 = 1e-14;
/// The same of contacts' lengths, which are differences of coordinates, and of coordinates in sizes.
const LEAST: f64 = 1e-16;
/// Lengths are measured against no less than this part of a clearance, or of the mechanism where a stop yields [–].
const SHALLOW: f64 = 1e-2;
const SHALLOW_STOP: f64 = 1e-6;

impl Flow<'_> {
    /// The bound of the local error. In a mechanism with contacts lengths are measured against the smallest clearance, or the
    /// smallest depth at which a contact would hold all the kinetic energy of the moment, where that is less: an error of the
    /// penetration is one of the energy, force times error. Rates near zero are measured
    /// against `SLOW`.
    pub fn tolerance(&self, wanted: Exactness) -> Tolerance {
        let layout = &self.layout;
        let dimension = layout.dimension();
        let system = self.system();
        let (rtol, atol) = (
            wanted.rtol.max(ROUND_OFF),
            wanted.atol.max(ROUND_OFF * system.size.min(1.0)),
        );
        let clearance = system
            .contacts
            .iter()
            .map(Pair::size)
            .fold(f64::INFINITY, f64::min);
        let mut tolerance = if clearance.is_finite() {
            Tolerance {
                rtol,
                atol: vec![f64::MAX; dimension],
                cap: vec![f64::INFINITY; dimension],
            }
        } else {
            Tolerance {
                rtol,
                atol: vec![atol; dimension],
                cap: Vec::new(),
            }
        };
        for (force, dependent) in system.dependent_forces.iter().enumerate() {
            if let (Some(component), Some(scale)) =
                (layout.memory(force), dependent.force.memory_scale())
            {
                tolerance.atol[component] = rtol * scale;
            }
        }
        for component in layout.states() {
            tolerance.atol[component] = atol;
        }
        if !clearance.is_finite() {
            return tolerance;
        }
        let evaluation = self.equations.evaluation();
        let mut energy = evaluation.kinetic_energy(system, self.equations.velocity());
        // What begins to hold may leave next to nothing of it, by round-off.
        if system.begins_to_hold() && energy > 0.0 {
            energy = energy.max(REST * system.scale.mass * system.scale.velocity().powi(2));
        }
        let depth = system
            .contacts
            .iter()
            .map(|contact| depth(contact, energy))
            .fold(f64::INFINITY, f64::min);
        let rates = layout.rates().start;
        for (k, column) in self.equations.independent_columns().enumerate() {
            let small = depth / system.size * system.column_scale(column);
            tolerance.cap[k] = small;
            tolerance.atol[k] = atol
                .min(rtol * small)
                .max(LEAST * system.column_scale(column));
            let rate = system.column_scale(column) / system.scale.time;
            tolerance.atol[rates + k] = atol.min(SLOW * rtol * rate);
        }
        for contact in 0..system.contacts.len() {
            if let Some(component) = layout.bristle(contact) {
                tolerance.atol[component] = rtol * clearance;
            }
            if energy > 0.0 {
                tolerance.atol[layout.sums(contact).start] = LEDGER * rtol * energy;
            }
        }
        // Where all is smooth the motion needs no steps as short as the work of its drivers.
        if energy > 0.0 {
            tolerance.atol[layout.work()] = LEDGER * rtol * energy;
        }
        tolerance
    }
}

/// Depth at which a contact would hold this energy, within [`SHALLOW`] … 1 of its clearance \[m\].
fn depth(contact: &Pair, energy: f64) -> f64 {
    let Surface::Compliant(laws) = &contact.surface else {
        return contact.size();
    };
    let shallowest = match contact.shape {
        Shape::Journal(_) => SHALLOW,
        Shape::Stop(_) | Shape::Edge(_) | Shape::Clasp(_) => SHALLOW_STOP,
    };
    let (mut low, mut high) = (shallowest * contact.size(), contact.size());
    if laws.normal.elastic_energy(high) <= energy {
        return high;
    }
    // Its order of magnitude is enough.
    while high > 1.1 * low {
        let middle = (low * high).sqrt();
        if laws.normal.elastic_energy(middle) < energy {
            low = middle
        } else {
            high = middle
        }
    }
    low
}

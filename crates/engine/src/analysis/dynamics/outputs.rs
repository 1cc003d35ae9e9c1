//! The loop's results: rows, and how good they are.

use super::flow::Flow;
use super::sampling::Sampling;
use super::settings::Settings;
use crate::analysis::power::Powers;
use crate::analysis::record::Recorder;
use crate::analysis::sample::Sample;
use crate::system::System;
use linkdyn_output::{Report, Trajectory};

pub struct Outputs<'a, 'r> {
    system: &'a System,
    sampling: Sampling,
    pub report: &'r mut Report,
    powers: Powers,
    /// Least and largest energy, and largest kinetic energy \[J\].
    energy: Option<[f64; 3]>,
    ledger: Option<EnergyBalance>,
}

/// Kinetic + potential + contact energy + dissipated − work, which stays what it is at the start.
#[derive(Debug, Clone, Copy)]
struct EnergyBalance {
    start: f64,
    imbalance: f64,
    largest: f64,
}

impl<'a, 'r> Outputs<'a, 'r> {
    pub fn new(system: &'a System, settings: &Settings, report: &'r mut Report) -> Self {
        let (rows, kept) = (settings.instants.len(), settings.kept.as_deref());
        let recorder = Recorder::keeping(system, settings.contents, kept, rows);
        Outputs {
            system,
            sampling: Sampling::with(system, recorder),
            report,
            powers: Powers::default(),
            energy: None,
            ledger: None,
        }
    }

    /// A row at the point of the last evaluation, where contacts have dissipated so much, and everything else has done so
    /// much work \[J\].
    pub fn record(&mut self, flow: &mut Flow, [dissipated, work]: [f64; 2]) {
        self.sampling.take(flow);
        let equations = &mut flow.equations;
        let system = equations.own_system();
        let quality = &mut self.report.quality;
        quality.constraint_residual = quality.constraint_residual.max(equations.residual());
        let Sample {
            v,
            a,
            lambda,
            force,
            ..
        } = &self.sampling.sample;
        let (evaluation, inputs) = (equations.evaluation(), &equations.inputs);
        let efforts = &lambda[system.joint_rows()..];
        let drivers = efforts
            .iter()
            .zip(&inputs.drive)
            .map(|(effort, jet)| (*effort, jet[1]));
        self.powers.note(self.system, [v, a, force], drivers);
        let moving = evaluation.kinetic_energy(self.system, v);
        let potential = evaluation.potential_energy(self.system, inputs);
        let elastic = evaluation.contact_energy(self.system, inputs);
        let energy = moving + potential;
        let [least, most, largest] = self.energy.unwrap_or([energy, energy, 0.0]);
        self.energy = Some([least.min(energy), most.max(energy), largest.max(moving)]);
        if !self.system.contacts.is_empty() {
            let sum = energy + elastic + dissipated - work;
            let ledger = self.ledger.get_or_insert(EnergyBalance {
                start: sum,
                imbalance: 0.0,
                largest: 0.0,
            });
            ledger.imbalance = ledger.imbalance.max((sum - ledger.start).abs());
            ledger.largest = [moving, elastic, dissipated, work.abs()]
                .into_iter()
                .fold(ledger.largest, f64::max);
        }
        self.sampling.sample.contact_energy = [elastic, dissipated];
        self.sampling.push(flow);
    }

    /// The rows; what was learnt on the way goes to the report.
    pub fn finish(self) -> Trajectory {
        let part = |imbalance: f64, whole: f64| if whole > 0.0 { imbalance / whole } else { 0.0 };
        let quality = &mut self.report.quality;
        quality.power_imbalance = Some(self.powers.relative_imbalance());
        quality.energy_imbalance = self
            .ledger
            .map(|ledger| part(ledger.imbalance, ledger.largest));
        if self.system.is_conservative()
            && let Some([least, most, largest]) = self.energy
        {
            quality.energy_drift = Some(part(most - least, largest));
        }
        self.sampling.recorder.close(self.system, self.report);
        self.sampling.recorder.trajectory
    }
}

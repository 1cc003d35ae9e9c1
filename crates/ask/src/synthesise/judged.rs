//! Candidates put through the engine: defects, and how good they are.

use super::problem::{Goal, LinkageTask};
use super::search::{EXACT, Gathered};
use super::written::{Names, document, frame};
use crate::shape::poses_of;
use crate::{ModelFile, Text};
use linkdyn_engine::analysis::{
    AllCircuits, CircuitsQuestion, Control, Outcome, Prepared, all_circuits,
};
use linkdyn_linear::bilinear::Number;
use linkdyn_model::FileAccess;
use linkdyn_synthesis::fit::{Candidate, Limits, fit};
use linkdyn_synthesis::linkage::{Linkage, Places};
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// The same on a circuit, between points of which it is interpolated.
const NEAR_CIRCUIT: f64 = 0.03;
/// Rows of the run from each wanted position to the next.
const ROWS: usize = 24;
/// Values of the crank at which circuits are looked for.
const VALUES: usize = 36;

/// Why a candidate is of no use.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Defect {
    /// Pivots or lengths are not as wanted.
    Limits,
    /// Some positions are on another circuit: it would have to be taken apart.
    Circuit,
    /// Some positions are on another branch: the crank gets stuck on the way.
    Branch,
    /// It passes the positions in another order.
    Order,
    /// Its angle of transmission is too small.
    Transmission,
    /// It does not run.
    Run(String),
}

/// A linkage that does what is wanted.
#[derive(Debug, Clone)]
pub struct FoundLinkage {
    /// The kind, `four_bar`.
    pub kind: String,
    /// The linkage and its crank's angles.
    pub candidate: Candidate,
    /// Its model.
    pub model: Value,
    /// Its point, `coupler.P`; there is none of a function.
    pub point: String,
    /// Largest distance of its point from what is wanted \[m\], of the engine's run.
    pub off: Option<f64>,
    /// Largest difference of its output's angle \[rad\].
    pub off_angle: Option<f64>,
    /// Least angle of transmission \[rad\].
    pub transmission: Option<f64>,
    /// Largest diagonal of a box around all pins \[m\].
    pub size: f64,
    /// Largest effort of the crank \[N·m\].
    pub effort: Option<f64>,
    /// Standard deviation of the point, of the angle, by that of the holes \[–\], \[rad/m\]: root mean square over the positions.
    pub spread: [f64; 2],
    /// Whether the crank can turn on and on.
    pub turns_fully: bool,
    /// The front on which it stands, 1 for those that no other one beats in everything.
    pub front: usize,
    /// Times and poses of the moving bodies, for its picture.
    pub motion: Option<(Vec<f64>, Vec<f64>)>,
}

impl LinkageTask {
    /// What a candidate is worth.
    ///
    /// # Errors
    /// Its defect.
    pub fn judged(
        &self,
        of: &Gathered,
        candidate: &Candidate,
        control: &Control,
    ) -> Result<FoundLinkage, Defect> {
        if !self.allows(&candidate.linkage) {
            return Err(Defect::Limits);
        }
        let given: Option<Vec<f64>> = self.wanted.iter().map(|own| own.crank).collect();
        let Some(turns) = given.or_else(|| in_order(&candidate.turns)) else {
            return Err(Defect::Order);
        };
        let mut candidate = Candidate {
            turns,
            ..candidate.clone()
        };
        if !self.passes(&candidate, of.off) {
            return Err(self.apart(&candidate, control));
        }
        // The last digits.
        let limits = Limits {
            kept: None,
            ..self.limits(&candidate.linkage)
        };
        let found = fit(&candidate, &self.wanted, &limits, &|| false);
        if let Some(found) = found.filter(|found| found.rms < EXACT) {
            candidate = found.candidate;
        }
        self.run(of, candidate, control)
    }

    /// Whether the linkage comes from each position to the next, and is not further off than that, by the extent.
    fn passes(&self, candidate: &Candidate, most: f64) -> bool {
        let linkage = &candidate.linkage;
        let mut places = linkage.first();
        let mut at = 0.0;
        for (turn, wanted) in candidate.turns.iter().zip(&self.wanted) {
            match linkage.led(places, at, *turn) {
                Some(next) => places = next,
                None => return false,
            }
            at = *turn;
            let position = linkage.position(&places, linkage.output);
            let off = wanted
                .point
                .map(|point| (position.of(linkage.point) - point).norm() / self.size);
            let off_angle = wanted
                .angle
                .map(|angle| whole(linkage.angle(&places, linkage.output) - angle));
            if off.into_iter().chain(off_angle).any(|off| off > most) {
                return false;
            }
        }
        true
    }

    /// Whether it has to be taken apart, or gets stuck.
    fn apart(&self, candidate: &Candidate, control: &Control) -> Defect {
        let circuits = self.circuits(candidate, control);
        let drawn = circuits.as_ref().and_then(|(all, output)| {
            let own = all.circuits.iter().find(|own| own.is_drawn)?;
            Some((own, *output))
        });
        let Some((circuit, output)) = drawn else {
            return Defect::Branch;
        };
        let start = circuits.as_ref().map_or(0.0, |(all, _)| all.values[0]);
        let linkage = &candidate.linkage;
        let (origin, along) = frame(linkage, output + 1);
        let is_on = |turn: f64, wanted: &linkdyn_synthesis::fit::Wanted| {
            circuit.course.windows(2).any(|two| {
                let [before, after] = [0, 1].map(|k| {
                    let off = two[k].0 - start - turn;
                    off - TAU * ((two[0].0 - start - turn) / TAU).round()
                });
                if before * after > 0.0 || before.abs() > 1.0 {
                    return false;
                }
                let part = if before == after {
                    0.0
                } else {
                    before / (before - after)
                };
                let [a, b] = [&two[0].1[output], &two[1].1[output]];
                let [x, y, angle] = [0, 1, 2].map(|k| a[k] + part * (b[k] - a[k]));
                let turned = angle - along.arg();
                let at =
                    Number::new(x, y) + Number::from_polar(1.0, turned) * (linkage.point - origin);
                let near = wanted
                    .point
                    .is_none_or(|point| (at - point).norm() <= NEAR_CIRCUIT * self.size);
                near && wanted
                    .angle
                    .is_none_or(|angle| whole(turned - angle) <= NEAR_CIRCUIT)
            })
        };
        let mut all = candidate.turns.iter().zip(&self.wanted);
        match all.all(|(turn, wanted)| is_on(*turn, wanted)) {
            true => Defect::Branch,
            false => Defect::Circuit,
        }
    }

    /// The circuits, by the engine, and which of the moving bodies is the output.
    fn circuits(&self, candidate: &Candidate, control: &Control) -> Option<(AllCircuits, usize)> {
        let (document, names) = document(self, &candidate.linkage, "", TAU);
        let file = read(&document)?;
        let question = CircuitsQuestion {
            driver: None,
            count: VALUES,
            range: None,
            most: 100,
        };
        let all = all_circuits(file.model(), &question, control).ok()??;
        let output = all
            .bodies
            .iter()
            .position(|own| *own == names.bodies[candidate.linkage.output])?;
        Some((all, output))
    }

    /// Runs it through all positions.
    fn run(
        &self,
        of: &Gathered,
        candidate: Candidate,
        control: &Control,
    ) -> Result<FoundLinkage, Defect> {
        let linkage = &candidate.linkage;
        let turns = &candidate.turns;
        let last = turns.iter().copied().fold(
            0.0,
            |far: f64, turn| if turn.abs() > far.abs() { turn } else { far },
        );
        let whole_turn = TAU.copysign(last);
        let turns_fully = linkage
            .led(linkage.first(), 0.0, whole_turn)
            .is_some_and(|end| {
                // Back where it began, with whole turns of its bodies.
                end.iter().enumerate().all(|(k, v)| match k % 3 {
                    2 => whole(*v) < 1e-6,
                    _ => true,
                })
            });
        let title = format!(
            "{} for {}",
            of.kind.replace('_', "-"),
            match self.goal {
                Goal::Path => "a path",
                Goal::Motion => "positions",
                Goal::Function => "a function",
            }
        );
        let turn = if turns_fully { whole_turn } else { last };
        let (model, names) = document(self, linkage, &title, turn);
        let broken = |why: &str| Defect::Run(why.to_owned());
        let file = read(&model).ok_or_else(|| broken("its model can't be read"))?;
        let points: Vec<Value> = turns
            .iter()
            .enumerate()
            .map(|(k, turn)| json!([k, format!("{:?} rad", names.start + turn)]))
            .collect();
        let motion = json!({ "type": "table", "points": points, "interpolation": "monotone" });
        let steps = turns.len() - 1;
        let puts = [
            format!("drivers.motor.motion={motion}"),
            "analysis.sample=null".to_owned(),
            format!("analysis.end={steps}"),
            format!("analysis.outputs={}", steps * ROWS + 1),
        ];
        let file = file.with(&puts).map_err(|why| broken(&why.to_string()))?;
        let outcome = Prepared::new(file.model())
            .and_then(|prepared| prepared.run(control))
            .map_err(|why| broken(&why.to_string()))?;
        if let Some(why) = outcome
            .report
            .message
            .as_ref()
            .filter(|_| outcome.all().len() <= steps * ROWS)
        {
            return Err(broken(why));
        }
        let response = |name: &str| {
            let own = outcome.responses.iter().find(|own| own.name == name);
            own.and_then(|own| own.value)
        };
        let angles = names.transmission.iter().filter_map(|name| response(name));
        let transmission = angles.reduce(f64::min);
        if self
            .asked
            .transmission
            .is_some_and(|least| transmission.is_none_or(|own| own < least))
        {
            return Err(Defect::Transmission);
        }
        let (off, off_angle) = self
            .off(&outcome, &names, linkage)
            .ok_or_else(|| broken("its results lack columns"))?;
        // Beside a dead centre the run may have gone another way.
        let parts = off.map(|off| off / self.size).into_iter().chain(off_angle);
        if parts.into_iter().any(|part| part > of.off) {
            return Err(Defect::Branch);
        }
        let (size, spread) = measured(linkage, turns).ok_or_else(|| broken("it does not close"))?;
        let motion = poses_of(file.model(), &outcome);
        Ok(FoundLinkage {
            kind: of.kind.clone(),
            model,
            off,
            off_angle,
            transmission,
            size,
            effort: response("effort").filter(|_| self.asked.load.is_some()),
            spread,
            turns_fully,
            front: 0,
            motion,
            point: names.point,
            candidate,
        })
    }

    /// How far the run is off at the wanted positions.
    fn off(
        &self,
        outcome: &Outcome,
        names: &Names,
        linkage: &Linkage,
    ) -> Option<(Option<f64>, Option<f64>)> {
        let rows = outcome.all();
        let column = |name: String| rows.column_index(&name);
        let body = &names.bodies[linkage.output];
        let angle = column(format!("{body}.angle"))?;
        let first = rows.row(0)[angle];
        let (mut off, mut off_angle): (Option<f64>, Option<f64>) = (None, None);
        for (k, wanted) in self.wanted.iter().enumerate() {
            let row = (k * ROWS < rows.len()).then(|| rows.row(k * ROWS))?;
            if let Some(point) = wanted.point {
                let [x, y] = [
                    column(format!("{}.x", names.point))?,
                    column(format!("{}.y", names.point))?,
                ];
                let own = (Number::new(row[x], row[y]) - point).norm();
                off = Some(off.unwrap_or(0.0).max(own));
            }
            if let Some(angle_there) = wanted.angle {
                let own = whole(row[angle] - first - angle_there);
                off_angle = Some(off_angle.unwrap_or(0.0).max(own));
            }
        }
        Some((off, off_angle))
    }
}

/// Distance of an angle from the next whole turn.
fn whole(angle: f64) -> f64 {
    (angle - TAU * (angle / TAU).round()).abs()
}

/// The crank's angles, counted on in one direction; `None` where it does not pass them in their order.
fn in_order(turns: &[f64]) -> Option<Vec<f64>> {
    let rises = |own: &[f64]| own.windows(2).all(|two| two[1] > two[0]);
    let falls = |own: &[f64]| own.windows(2).all(|two| two[1] < two[0]);
    if rises(turns) || falls(turns) {
        return Some(turns.to_vec());
    }
    let onwards = |sign: f64| -> Vec<f64> {
        // The first one is 0 but for round-off, which would make it a whole turn.
        let own = turns
            .iter()
            .skip(1)
            .map(|turn| sign * (sign * turn).rem_euclid(TAU));
        std::iter::once(0.0).chain(own).collect()
    };
    let both = [onwards(1.0), onwards(-1.0)];
    let fit = both.into_iter().filter(|own| rises(own) || falls(own));
    fit.min_by(|a, b| {
        let far = |own: &[f64]| own.last().map_or(0.0, |turn| turn.abs());
        far(a).total_cmp(&far(b))
    })
}

/// Diagonal of the box around all pins in all positions, and the spread.
fn measured(linkage: &Linkage, turns: &[f64]) -> Option<(f64, [f64; 2])> {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    let mut add = |places: &Places| {
        let pins = linkage
            .joints
            .iter()
            .filter_map(|joint| Some((joint.bodies[0], joint.pin()?)));
        for (body, at) in pins.chain([(linkage.output, linkage.point)]) {
            let at = linkage.position(places, body).of(at);
            for (axis, value) in [at.re, at.im].into_iter().enumerate() {
                low[axis] = low[axis].min(value);
                high[axis] = high[axis].max(value);
            }
        }
    };
    let (mut places, mut at) = (linkage.first(), 0.0);
    let mut sums = [0.0; 2];
    for turn in turns {
        for part in 1..=8 {
            let next = at + (turn - at) * f64::from(part) / 8.0;
            places = linkage.led(places, at + (turn - at) * f64::from(part - 1) / 8.0, next)?;
            add(&places);
        }
        at = *turn;
        let own = linkage.spread(&places, at)?;
        sums.iter_mut()
            .zip(own)
            .for_each(|(sum, own)| *sum += own * own);
    }
    let spread = sums.map(|sum| (sum / turns.len() as f64).sqrt());
    Some(((high[0] - low[0]).hypot(high[1] - low[1]), spread))
}

/// A document as a model.
pub fn read(document: &Value) -> Option<ModelFile> {
    let bytes = document.to_string().into_bytes();
    let text = Text::new(
        "the linkage".into(),
        "linkage".into(),
        bytes,
        FileAccess::default(),
    );
    ModelFile::read(text, Vec::new()).ok()
}

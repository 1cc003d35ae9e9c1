//! What is wanted, in numbers.

use crate::{ModelFile, Unanswered};
use linkdyn_linear::bilinear::Number;
use linkdyn_model::display::DisplayUnits;
use linkdyn_model::synthesise::{LinkageKind, Region, Synthesise, WantedPosition};
use linkdyn_synthesis::fit::Wanted;
use linkdyn_synthesis::linkage::{Joint, Linkage};

/// What is asked of the output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Goal {
    /// A point passes points.
    Path,
    /// A body passes positions, of some of which the angle may be free.
    Motion,
    /// The output turns as the crank says.
    Function,
}

/// The task.
#[derive(Debug, Clone)]
pub struct LinkageTask {
    /// As it was asked.
    pub asked: Synthesise,
    /// What kind of output.
    pub goal: Goal,
    /// What is wanted at each position.
    pub wanted: Vec<Wanted>,
    /// Angles of crank and output, of a function \[rad\].
    pub pairs: Vec<[f64; 2]>,
    /// Distance of the pivots, of a function \[m\].
    pub base: f64,
    /// Middle of what is wanted, and its extent \[m\].
    pub middle: Number,
    /// As above.
    pub size: f64,
    /// Where fixed pivots are.
    pub pivots: [[f64; 2]; 2],
    /// Least and greatest distance of pins \[m\].
    pub lengths: [f64; 2],
    /// Units of the task.
    pub display: DisplayUnits,
}

/// How far around what is wanted pivots may be, by its extent, where nobody says.
const ROOM: f64 = 3.0;
/// Links longer than this, by the extent, are no use where nobody says.
const LONGEST: f64 = 10.0;
const SHORTEST: f64 = 1e-3;

impl LinkageTask {
    /// Of a file that has a task.
    ///
    /// # Errors
    /// Where it has none.
    pub fn of(file: &ModelFile) -> Result<LinkageTask, Unanswered> {
        let Some(asked) = &file.model().synthesise else {
            return Err(Unanswered::question(
                "\"synthesise\" is missing (as in \"synthesise\": { \"path\": [[0, 0], [10, 5], [20, 5]] })",
            ));
        };
        let crank = |k: usize| asked.crank.as_ref().map(|own| own[k] - own[0]);
        let number = |[x, y]: [f64; 2]| Number::new(x, y);
        let (goal, wanted): (Goal, Vec<Wanted>) =
            match (&asked.path, &asked.positions, &asked.function) {
                (Some(path), ..) => {
                    let one = |(k, point): (usize, &[f64; 2])| Wanted {
                        crank: crank(k),
                        point: Some(number(*point)),
                        angle: None,
                    };
                    (Goal::Path, path.iter().enumerate().map(one).collect())
                }
                (_, Some(positions), _) => {
                    // Angles are counted from that of the first position.
                    let first = positions[0].angle;
                    let one = |(k, own): (usize, &WantedPosition)| Wanted {
                        crank: crank(k),
                        point: Some(number(own.point)),
                        angle: own.angle.zip(first).map(|(own, first)| own - first),
                    };
                    (
                        Goal::Motion,
                        positions.iter().enumerate().map(one).collect(),
                    )
                }
                (_, _, pairs) => {
                    let pairs = pairs.as_deref().unwrap_or_default();
                    let one = |pair: &[f64; 2]| Wanted {
                        crank: Some(pair[0] - pairs[0][0]),
                        point: None,
                        angle: Some(pair[1] - pairs[0][1]),
                    };
                    (Goal::Function, pairs.iter().map(one).collect())
                }
            };
        let base = asked.base.unwrap_or(1.0);
        let points: Vec<Number> = match goal {
            Goal::Function => vec![Number::default(), Number::from(base)],
            Goal::Path | Goal::Motion => wanted.iter().filter_map(|own| own.point).collect(),
        };
        let middle = points.iter().sum::<Number>() / points.len() as f64;
        let apart = points
            .iter()
            .flat_map(|a| points.iter().map(move |b| (a - b).norm()));
        let size = apart.fold(0.0, f64::max);
        let around = [middle.re, middle.im].map(|at| [at - ROOM * size, at + ROOM * size]);
        Ok(LinkageTask {
            goal,
            pairs: asked.function.clone().unwrap_or_default(),
            base,
            middle,
            size,
            pivots: asked.pivots.map_or(around, |Region { x, y }| [x, y]),
            lengths: asked.lengths.unwrap_or([SHORTEST * size, LONGEST * size]),
            display: file.model().display.clone(),
            asked: asked.clone(),
            wanted,
        })
    }

    /// Whether a linkage keeps to pivots and lengths.
    pub fn allows(&self, linkage: &Linkage) -> bool {
        let is_within = |at: Number| {
            let near = 1e-9 * self.size;
            [at.re, at.im]
                .iter()
                .zip(self.pivots)
                .all(|(v, [low, high])| *v >= low - near && *v <= high + near)
        };
        let mut pins = linkage.joints.iter();
        let pivots = self.goal == Goal::Function
            || pins.all(|joint| !joint.bodies.contains(&0) || joint.pin().is_none_or(is_within));
        let lengths = (1..linkage.bodies).all(|body| {
            let own: Vec<Number> = linkage
                .joints
                .iter()
                .filter(|joint| joint.bodies.contains(&body))
                .filter_map(Joint::pin)
                .collect();
            let mut apart = own
                .iter()
                .enumerate()
                .flat_map(|(k, a)| own[..k].iter().map(move |b| (a - b).norm()));
            let [low, high] = self.lengths;
            apart.all(|length| length >= low * (1.0 - 1e-9) && length <= high * (1.0 + 1e-9))
        });
        pivots && lengths
    }

    /// Which linkages are tried by name.
    pub fn kinds(&self) -> Vec<LinkageKind> {
        match self.asked.linkages.is_empty() && self.asked.bodies.is_none() {
            true => vec![LinkageKind::FourBar],
            false => self.asked.linkages.clone(),
        }
    }
}

//! The sources, sorted by what they do: passes over all of them are plain loops.

use super::dimensions::PointId;
use super::source::{Influence, Play, length};

/// A play that stands in rows of φ by itself: its number and the first of its rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct InRows {
    pub play: usize,
    pub row: usize,
}

/// A play with any direction in the plane, up to a radius \[m\].
#[derive(Debug, Clone, Copy)]
pub(super) struct Disc {
    pub play: usize,
    radius: f64,
    /// Whether it is the zone of a point.
    pub is_zone: bool,
}

/// A play of one number, from one end to the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub play: usize,
    /// The least and the greatest.
    pub ends: [f64; 2],
    pub is_parameter: bool,
    /// Whether what it does bends, so that it does not stand between its ends.
    pub bends: bool,
}

/// A parameter: a stretch of all steps.
#[derive(Debug, Clone, Copy)]
struct Parameter {
    play: usize,
    begin: usize,
    end: usize,
    bends: bool,
}

/// The plays by what they do; one may stand in several lists.
#[derive(Debug, Clone, Default)]
pub(super) struct Sorted {
    /// In one row, and in two rows.
    single: Vec<InRows>,
    double: Vec<InRows>,
    pub discs: Vec<Disc>,
    pub lines: Vec<Line>,
    /// Sliders on guides.
    pub guided: Vec<usize>,
    pub zones: Vec<(usize, PointId)>,
    parameters: Vec<Parameter>,
    /// Those that step one dimension: play, dimension, and how far for a unit.
    ones: Vec<(usize, usize, f64)>,
    /// The other parameters, by number.
    others: Vec<usize>,
    /// Dimensions that parameters step, and how far for a unit.
    steps: Vec<(usize, f64)>,
    /// The same of those that don't bend, each with its play.
    straight: Vec<(usize, usize, f64)>,
    /// Whether these are all, and no dimension is stepped twice.
    are_apart: bool,
}

impl Disc {
    /// The e with the greatest g·e, times `side` (±1) the least; zero without influence.
    #[inline]
    pub fn extreme(&self, g: Influence, side: f64) -> Influence {
        let size = length(g);
        if size > 0.0 {
            let scale = self.radius * side / size;
            [scale * g[0], scale * g[1]]
        } else {
            [0.0; 2]
        }
    }

    /// By how much the output differs between both sides.
    pub fn span(&self, g: Influence) -> f64 {
        2.0 * self.radius * length(g)
    }
}

impl Line {
    /// The end with the greatest g·e, times `side` (±1) the least.
    #[inline]
    pub fn extreme(&self, g: f64, side: f64) -> f64 {
        let [low, high] = self.ends;
        // A parameter without influence stays at its upper limit on both sides.
        let is_high = match self.is_parameter {
            true => side * g >= 0.0,
            false => side * g.signum() >= 0.0,
        };
        if is_high { high } else { low }
    }

    /// By how much the output differs between both ends.
    pub fn span(&self, g: f64) -> f64 {
        (self.ends[1] - self.ends[0]) * g.abs()
    }
}

impl Sorted {
    pub fn new(plays: &[Play]) -> Sorted {
        let mut sorted = Sorted::default();
        for (play, own) in plays.iter().enumerate() {
            sorted.add(play, own);
        }
        let (all, once) = (sorted.steps.len(), sorted.stepped().len());
        sorted.are_apart = sorted.straight.len() == all && once == all;
        sorted
    }

    fn add(&mut self, play: usize, own: &Play) {
        match own {
            Play::Pin { row, .. } | Play::Guided { row, .. } => {
                self.double.push(InRows { play, row: *row });
            }
            Play::Sides { row, .. } | Play::Driver { row, .. } => {
                self.single.push(InRows { play, row: *row });
            }
            Play::Zone { point, .. } => self.zones.push((play, *point)),
            Play::Parameter { steps, bends, .. } => {
                let begin = self.steps.len();
                self.steps.extend_from_slice(steps);
                let straight = steps.iter().filter(|_| !bends);
                self.straight.extend(straight.map(|&(k, by)| (play, k, by)));
                self.parameters.push(Parameter {
                    play,
                    begin,
                    end: self.steps.len(),
                    bends: *bends,
                });
                if let [(k, by)] = steps[..] {
                    self.ones.push((play, k, by));
                } else {
                    self.others.push(self.parameters.len() - 1);
                }
            }
        }
        match own {
            Play::Pin { clearance, .. } => self.discs.push(Disc {
                play,
                radius: clearance[1],
                is_zone: false,
            }),
            Play::Zone { radius, .. } => self.discs.push(Disc {
                play,
                radius: *radius,
                is_zone: true,
            }),
            Play::Guided { .. } => self.guided.push(play),
            Play::Sides { .. } | Play::Driver { .. } | Play::Parameter { .. } => {
                self.lines.extend(own.ends().map(|ends| Line {
                    play,
                    ends,
                    is_parameter: matches!(own, Play::Parameter { .. }),
                    bends: matches!(own, Play::Parameter { bends: true, .. }),
                }));
            }
        }
    }

    /// Dimensions that parameters step, in order, each once.
    pub fn stepped(&self) -> Vec<usize> {
        let mut stepped: Vec<usize> = self.steps.iter().map(|&(k, _)| k).collect();
        stepped.sort_unstable();
        stepped.dedup();
        stepped
    }

    /// e of the parameters.
    pub fn parameters<'a>(&'a self, e: &'a [Influence]) -> impl Iterator<Item = f64> + 'a {
        self.parameters.iter().map(|own| e[own.play][0])
    }

    /// The same of those that bend, and zero of the others.
    pub fn bent<'a>(&'a self, e: &'a [Influence]) -> impl Iterator<Item = f64> + 'a {
        let bent = |own: &Parameter| if own.bends { e[own.play][0] } else { 0.0 };
        self.parameters.iter().map(bent)
    }

    /// Sets the steps of the dimensions, where each hangs on one parameter that does not bend; whether that is so.
    pub fn set_steps(&self, e: &[Influence], steps: &mut [f64]) -> bool {
        if self.are_apart {
            for &(play, k, by) in &self.straight {
                steps[k] = by * e[play][0];
            }
        }
        self.are_apart
    }

    /// Adds to the steps of the dimensions what parameters do that don't bend.
    pub fn step(&self, e: &[Influence], steps: &mut [f64]) {
        for &(play, k, by) in &self.straight {
            steps[k] += by * e[play][0];
        }
    }

    /// g of all plays but zones, from the multipliers of a load on the output and what it says of the dimensions.
    pub fn influences(&self, lambda: &[f64], of_dimensions: &[f64], g: &mut [Influence]) {
        for &InRows { play, row } in &self.double {
            g[play] = [-lambda[row], -lambda[row + 1]];
        }
        for &InRows { play, row } in &self.single {
            g[play] = [-lambda[row], 0.0];
        }
        for &(play, k, by) in &self.ones {
            g[play] = [by * of_dimensions[k], 0.0];
        }
        for own in self.others.iter().map(|&number| &self.parameters[number]) {
            let mut sum = 0.0;
            for &(k, by) in &self.steps[own.begin..own.end] {
                sum += by * of_dimensions[k];
            }
            g[own.play] = [sum, 0.0];
        }
    }

    /// Adds the gaps of those that stand in rows by themselves.
    pub fn gap(&self, e: &[Influence], rows: &mut [f64]) {
        for &InRows { play, row } in &self.double {
            rows[row] += e[play][0];
            rows[row + 1] += e[play][1];
        }
        for &InRows { play, row } in &self.single {
            rows[row] += e[play][0];
        }
    }

    /// How many numbers of influences the multipliers do not tell: of parameters one, of zones two.
    pub fn untold(&self) -> usize {
        self.parameters.len() + 2 * self.zones.len()
    }

    /// Those numbers, less what they are elsewhere.
    pub fn differences(&self, g: &[Influence], less: &[Influence], numbers: &mut [f64]) {
        let (numbers, pairs) = numbers.split_at_mut(self.parameters.len());
        for (own, number) in self.parameters.iter().zip(numbers) {
            *number = g[own.play][0] - less[own.play][0];
        }
        for (&(play, _), pair) in self.zones.iter().zip(pairs.as_chunks_mut().0) {
            *pair = [0, 1].map(|k| g[play][k] - less[play][k]);
        }
    }

    /// g where multipliers and those numbers differ by so much from what they are elsewhere.
    pub fn differ(
        &self,
        (lambda, numbers): (&[f64], &[f64]),
        elsewhere: &[Influence],
        g: &mut [Influence],
    ) {
        for &InRows { play, row } in &self.double {
            let [a, b] = elsewhere[play];
            g[play] = [a - lambda[row], b - lambda[row + 1]];
        }
        for &InRows { play, row } in &self.single {
            g[play] = [elsewhere[play][0] - lambda[row], 0.0];
        }
        let (numbers, pairs) = numbers.split_at(self.parameters.len());
        for (own, more) in self.parameters.iter().zip(numbers) {
            g[own.play] = [elsewhere[own.play][0] + more, 0.0];
        }
        for (&(play, _), more) in self.zones.iter().zip(pairs.as_chunks().0) {
            let [a, b] = elsewhere[play];
            let [x, y] = more;
            g[play] = [a + x, b + y];
        }
    }
}

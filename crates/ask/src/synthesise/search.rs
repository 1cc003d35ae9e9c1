//! Candidates: all of them where an exact method knows them, else from many starts.

use super::problem::{Goal, LinkageTask};
use linkdyn_engine::analysis::Control;
use linkdyn_linear::bilinear::{Number, Random};
use linkdyn_model::synthesise::LinkageKind;
use linkdyn_synthesis::chains::{self, Chain, chains};
use linkdyn_synthesis::dyad::{Dyad, Position, guide, links, links_on_line};
use linkdyn_synthesis::fit::{Candidate, Limits, Wanted, distance, fit};
use linkdyn_synthesis::four_bar::{
    Passing, freudenstein, function_four_bar, relative, slider_crank,
};
use linkdyn_synthesis::keep::Kept;
use linkdyn_synthesis::linkage::{Joint, Kind, Linkage};
use linkdyn_synthesis::path::{CURVES, POINTS, through_nine};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Lines of fixed pivots on which links through four positions are looked for.
const LINES: usize = 61;
/// Most four-bars of a curve of links, evenly chosen.
const MOST_PAIRS: usize = 3000;
/// Drawings from which the best one is the start of a search.
const DRAWINGS: usize = 40;
/// Starts at a time; there are no more once enough was found.
const BATCH: u64 = 64;
/// Makes seeds that are next to each other different.
const SPREAD_SEEDS: u64 = 0x9e37_79b9_7f4a_7c15;
/// Distance, by the extent of what is wanted, from which on it is another position.
const OTHER: f64 = 1e-4;
/// A fit that leaves less than this is exact.
pub const EXACT: f64 = 1e-10;
/// Fits that leave more than this times what the best leaves are not kept.
const WORSE: f64 = 3.0;

/// What a search gave.
#[derive(Debug, Clone, Default)]
pub struct Gathered {
    /// The kind of linkage, `four_bar`.
    pub kind: String,
    /// How they were found, in words.
    pub method: String,
    /// How far off, by the extent of what is wanted, a position may be before it is another one.
    pub off: f64,
    /// The candidates.
    pub candidates: Vec<Candidate>,
    /// Whether these are all that there are.
    pub is_complete: bool,
    /// Why there may be more, or what came of it.
    pub notes: Vec<String>,
    /// Of a search from starts, what it came to.
    pub searched: Option<SearchCounts>,
}

/// What searches came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchCounts {
    /// Choices of crank and output.
    pub choices: usize,
    /// Starts.
    pub starts: u64,
    /// Starts that came to a minimum.
    pub minima: usize,
    /// Those of them that pass all positions exactly.
    pub exact: usize,
    /// What the best one leaves (root mean square), by the extent.
    pub best: f64,
}

impl SearchCounts {
    /// Both together.
    pub fn with(self, other: SearchCounts) -> SearchCounts {
        SearchCounts {
            choices: self.choices + other.choices,
            starts: self.starts + other.starts,
            minima: self.minima + other.minima,
            exact: self.exact + other.exact,
            best: self.best.min(other.best),
        }
    }
}

/// What least squares came to.
#[derive(Debug, Default)]
struct Fitted {
    /// What was left (root mean square, by the extent), and the candidate.
    found: Vec<(f64, Candidate)>,
    /// Starts.
    used: u64,
}

/// What pins what, before it has dimensions.
#[derive(Debug, Clone)]
struct Template {
    kind: String,
    bodies: usize,
    joints: Vec<[usize; 2]>,
    guide: Option<usize>,
    crank: usize,
    output: usize,
}

impl LinkageTask {
    /// All linkages of a kind, or some on a curve of them, where an exact method knows them; outer `None`: stopped.
    pub fn exact(&self, kind: LinkageKind, control: &Control) -> Option<Option<Gathered>> {
        match kind {
            LinkageKind::FourBar => self.four_bars(&|| control.stop().is_some()),
            LinkageKind::SliderCrank => Some(self.slider_cranks()),
            _ => Some(None),
        }
    }

    /// Linkages of a kind from many starts, each choice of crank and output in turn; `None`: stopped.
    pub fn sought(
        &self,
        kind: LinkageKind,
        control: &Control,
        take: &mut dyn FnMut(Gathered),
    ) -> Option<()> {
        self.all_fitted(&self.templates(kind), control, take)
    }

    /// The same with all chains of so many bodies.
    pub fn sought_in_chains(
        &self,
        bodies: usize,
        control: &Control,
        take: &mut dyn FnMut(Gathered),
    ) -> Option<()> {
        self.all_fitted(&self.all_templates(bodies, None), control, take)
    }

    fn all_fitted(
        &self,
        templates: &[Template],
        control: &Control,
        take: &mut dyn FnMut(Gathered),
    ) -> Option<()> {
        let stop = || control.stop().is_some();
        for template in templates {
            let fitted = self.fitted(template, &stop);
            let is_stopped = stop();
            take(self.gathered(&template.kind, fitted));
            if is_stopped {
                return None;
            }
        }
        Some(())
    }

    /// What came of a choice of crank and output.
    fn gathered(&self, kind: &str, fitted: Fitted) -> Gathered {
        let mut found = fitted.found;
        let count = found.len();
        let best = found
            .iter()
            .map(|(rms, _)| *rms)
            .fold(f64::INFINITY, f64::min);
        found.retain(|(rms, _)| *rms <= (WORSE * best).max(EXACT));
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let exact = found.iter().filter(|(rms, _)| *rms < EXACT).count();
        let mut candidates: Vec<Candidate> = found.into_iter().map(|(_, own)| own).collect();
        if self.goal == Goal::Path && !self.is_timed() && kind == "four_bar" && exact > 0 {
            candidates = with_cognates(candidates, &self.points().unwrap_or_default());
        }
        Gathered {
            kind: kind.to_owned(),
            method: "least squares".into(),
            // Of least squares single positions are further off than the root mean square.
            off: OTHER + 10.0 * best.min(1.0),
            candidates,
            is_complete: false,
            notes: Vec::new(),
            searched: Some(SearchCounts {
                choices: 1,
                starts: fitted.used,
                minima: count,
                exact,
                best,
            }),
        }
    }

    /// Points of all positions, where all have one.
    fn points(&self) -> Option<Vec<Number>> {
        self.wanted.iter().map(|own| own.point).collect()
    }

    fn is_timed(&self) -> bool {
        self.wanted.iter().all(|own| own.crank.is_some())
    }

    /// Positions of the output, where all have an angle.
    fn positions(&self) -> Option<Vec<Position>> {
        let one = |own: &Wanted| Some((own.point?, Number::from_polar(1.0, own.angle?)));
        let all: Option<Vec<(Number, Number)>> = self.wanted.iter().map(one).collect();
        all.map(|all| Position::counted(&all))
    }

    /// All four-bars, where an exact method has them; outer `None`: stopped.
    fn four_bars(&self, stop: &(dyn Fn() -> bool + Sync)) -> Option<Option<Gathered>> {
        let count = self.wanted.len();
        Some(match (self.goal, self.is_timed(), count) {
            (Goal::Function, ..) => self.function_four_bars(),
            (Goal::Motion, false, 4 | 5) => self.positions().map(|own| self.moving_four_bars(&own)),
            (Goal::Path, true, 5) => self.timed_four_bars(),
            (Goal::Path, false, POINTS) => {
                let points = self.points()?;
                let nine: [Number; POINTS] = points.clone().try_into().ok()?;
                let paths = through_nine(&nine, stop)?;
                let passing = paths
                    .found
                    .iter()
                    .map(|dyads| Passing::through(*dyads, &points));
                let mut notes = vec![format!(
                    "{} coupler curves in complex numbers of {CURVES}, {} four-bars are real, cognates included",
                    paths.complex,
                    paths.found.len()
                )];
                let singular = CURVES.saturating_sub(paths.complex + paths.missing);
                if singular > 0 {
                    notes.push(format!(
                        "{singular} of the {CURVES} are at infinity or degenerate for these points"
                    ));
                }
                if paths.missing > 0 {
                    notes.push(format!(
                        "up to {} coupler curves may be missing: paths to them were lost",
                        paths.missing
                    ));
                }
                Some(Gathered {
                    searched: None,
                    kind: "four_bar".into(),
                    method: "all four-bars through nine points".into(),
                    candidates: passing.flat_map(|own| own.candidates()).collect(),
                    is_complete: paths.missing == 0,
                    off: OTHER,
                    notes,
                })
            }
            _ => None,
        })
    }

    /// Through five positions all, through four a selection of them.
    fn moving_four_bars(&self, positions: &[Position]) -> Gathered {
        let points = self.points().unwrap_or_default();
        let (dyads, complex, is_complete) = self.dyads(positions, points[0]);
        let pairs = pairs(&dyads);
        let passing = pairs.iter().map(|dyads| Passing {
            dyads: *dyads,
            points: points.clone(),
            turns: positions.iter().map(|own| own.turn).collect(),
        });
        Gathered {
            searched: None,
            kind: "four_bar".into(),
            method: match is_complete {
                true => "all four-bars through five positions",
                false => "four-bars of two links each on Burmester's curve of four positions",
            }
            .into(),
            candidates: passing.flat_map(|own| own.candidates()).collect(),
            is_complete,
            off: OTHER,
            notes: vec![match is_complete {
                true => format!("{} of {complex} links are real", dyads.len()),
                false => format!(
                    "{} links along the curve of fixed pivots, of which there are infinitely many",
                    dyads.len()
                ),
            }],
        }
    }

    /// Links through five or four positions, how many there are in complex numbers, and whether these are all.
    fn dyads(&self, positions: &[Position], near: Number) -> (Vec<Dyad>, usize, bool) {
        if let Ok(five) = <[Position; 5]>::try_from(positions) {
            let (dyads, complex) = links(&five, near);
            return (dyads, complex, true);
        }
        let Ok(four) = <[Position; 4]>::try_from(positions) else {
            return (Vec::new(), 0, false);
        };
        // Lines in a direction of no meaning, across the region of the pivots.
        let normal = Number::from_polar(1.0, 0.377);
        let [x, y] = self.pivots;
        let corners = x
            .iter()
            .flat_map(|x| y.iter().map(|y| (normal.conj() * Number::new(*x, *y)).re));
        let corners: Vec<f64> = corners.collect();
        let low = corners.iter().copied().fold(f64::INFINITY, f64::min);
        let high = corners.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lines: Vec<usize> = (0..LINES).collect();
        let found = lines.par_iter().flat_map_iter(|k| {
            let part = (*k as f64 + 0.5) / LINES as f64;
            links_on_line(&four, near, normal, low + part * (high - low))
        });
        let is_near = |dyad: &Dyad| {
            [dyad.fixed.re, dyad.fixed.im]
                .iter()
                .zip(self.pivots)
                .all(|(v, [low, high])| *v >= low && *v <= high)
        };
        (found.filter(is_near).collect(), 0, false)
    }

    /// Both links of a timed path: the crank from its own angles, then the other from the coupler's.
    fn timed_four_bars(&self) -> Option<Gathered> {
        let points = self.points()?;
        let turns: Vec<Number> = self
            .wanted
            .iter()
            .map(|own| Number::from_polar(1.0, own.crank.unwrap_or_default()))
            .collect();
        // |p − a − φ c| is the length of the coupler: a link of a plane that turns with the crank and moves with the point.
        let poses: Vec<(Number, Number)> =
            points.iter().copied().zip(turns.iter().copied()).collect();
        let own: [Position; 5] = Position::counted(&poses).try_into().ok()?;
        let (cranks, _) = links(&own, points[0]);
        let mut candidates = Vec::new();
        for found in cranks {
            // The point is p, the plane's moving point is p − c; so a is fixed and c = p₀ − moving.
            let (fixed, arm) = (found.fixed, points[0] - found.moving);
            let pin = fixed + arm;
            let first = points[0] - pin;
            let poses = points.iter().zip(&turns).map(|(p, turn)| {
                let way = (p - fixed - turn * arm) / first;
                (*p, way / way.norm())
            });
            let own: [Position; 5] = Position::counted(&poses.collect::<Vec<_>>())
                .try_into()
                .ok()?;
            let crank = Dyad { fixed, moving: pin };
            for other in links(&own, points[0]).0 {
                let is_same =
                    (other.fixed - fixed).norm() + (other.moving - pin).norm() < 1e-6 * self.size;
                if !is_same {
                    let passing = Passing {
                        dyads: [crank, other],
                        points: points.clone(),
                        turns: own.iter().map(|own| own.turn).collect(),
                    };
                    candidates.extend(passing.candidates().into_iter().take(1));
                }
            }
        }
        Some(Gathered {
            searched: None,
            kind: "four_bar".into(),
            method: "all four-bars through five points with the crank's angles".into(),
            candidates,
            is_complete: true,
            off: OTHER,
            notes: Vec::new(),
        })
    }

    fn function_four_bars(&self) -> Option<Gathered> {
        let crank: Vec<f64> = self.pairs.iter().map(|pair| pair[0]).collect();
        let (pins, method, is_complete): (Vec<[Number; 2]>, &str, bool) =
            match (self.asked.directions, crank.len()) {
                (true, 3) => (
                    freudenstein(self.base, &self.pairs).into_iter().collect(),
                    "Freudenstein's equation for three pairs of directions",
                    true,
                ),
                (false, 4 | 5) => {
                    let positions = relative(self.base, &self.pairs);
                    let near = Number::from(0.3 * self.base);
                    let (found, _, is_complete) = self.dyads(&positions, near);
                    let pins = found.iter().map(|own| [own.moving, own.fixed]).collect();
                    let method = match is_complete {
                        true => "all four-bars for five pairs of angles",
                        false => "four-bars on the curve of four pairs of angles",
                    };
                    (pins, method, is_complete)
                }
                _ => return None,
            };
        Some(Gathered {
            searched: None,
            kind: "four_bar".into(),
            method: method.into(),
            candidates: pins
                .into_iter()
                .map(|pins| function_four_bar(self.base, pins, &crank))
                .collect(),
            is_complete,
            off: OTHER,
            notes: Vec::new(),
        })
    }

    fn slider_cranks(&self) -> Option<Gathered> {
        if self.goal != Goal::Motion || self.is_timed() {
            return None;
        }
        let positions: [Position; 4] = self.positions()?.try_into().ok()?;
        let point = self.points()?[0];
        let guide = guide(&positions, point)?;
        let (dyads, ..) = self.dyads(&positions, point);
        Some(Gathered {
            searched: None,
            kind: "slider_crank".into(),
            method: "the only slider of four positions, with links on Burmester's curve".into(),
            candidates: dyads
                .iter()
                .map(|own| slider_crank(*own, guide, &positions, point))
                .collect(),
            is_complete: false,
            off: OTHER,
            notes: vec![format!(
                "{} links along the curve of fixed pivots, of which there are infinitely many",
                dyads.len()
            )],
        })
    }

    /// What is pinned to what in a kind.
    fn templates(&self, kind: LinkageKind) -> Vec<Template> {
        let ring = |joints: [[usize; 2]; 4], guide| Template {
            kind: word(kind).into(),
            bodies: 4,
            joints: joints.into(),
            guide,
            crank: 1,
            output: if self.goal == Goal::Function { 3 } else { 2 },
        };
        match kind {
            LinkageKind::FourBar => vec![ring([[0, 1], [1, 2], [2, 3], [3, 0]], None)],
            LinkageKind::SliderCrank => {
                let own = ring([[0, 1], [1, 2], [2, 3], [0, 3]], Some(3));
                let slides = Template {
                    output: 3,
                    ..own.clone()
                };
                if self.is_on_line() {
                    vec![slides, own]
                } else {
                    vec![own]
                }
            }
            _ => self.all_templates(6, Some(word(kind))),
        }
    }

    /// Whether a slider can be the output: on a line.
    fn is_on_line(&self) -> bool {
        let Some(points) = self.points().filter(|_| self.goal == Goal::Path) else {
            return false;
        };
        let far = points
            .iter()
            .max_by(|a, b| (*a - points[0]).norm().total_cmp(&(*b - points[0]).norm()));
        let way = far.map_or(Number::default(), |far| far - points[0]);
        points
            .iter()
            .all(|p| (way.conj() * (p - points[0])).im.abs() <= 1e-9 * way.norm_sqr())
    }

    /// All choices of ground, crank and output of all chains of so many bodies.
    fn all_templates(&self, bodies: usize, named: Option<&str>) -> Vec<Template> {
        let mut all = Vec::new();
        for chain in chains(bodies) {
            for fixed in chains::inversions(&chain) {
                let name =
                    chains::name(&chain, fixed).map_or(format!("{bodies}_bodies"), str::to_owned);
                if named.is_some_and(|named| named != name) {
                    continue;
                }
                all.extend(self.choices(&chain, fixed, &name));
            }
        }
        all
    }

    fn choices(&self, chain: &Chain, fixed: usize, name: &str) -> Vec<Template> {
        let pins = chains::pins(chain);
        let is_near = |a: usize, b: usize| pins.contains(&(a, b)) || pins.contains(&(b, a));
        let count = chain.node_count();
        let cranks = (0..count).filter(|crank| is_near(fixed, *crank));
        let choices = cranks.flat_map(|crank| {
            let fits = move |output: &usize| {
                *output != fixed
                    && *output != crank
                    && is_near(fixed, *output) == (self.goal == Goal::Function)
            };
            (0..count)
                .filter(fits)
                .map(move |output| vec![fixed, crank, output])
        });
        let one = |own: Vec<usize>| {
            // Ground first, then the crank.
            let mut order = vec![own[0], own[1]];
            order.extend((0..count).filter(|body| !own[..2].contains(body)));
            let number = |body: usize| {
                order
                    .iter()
                    .position(|own| *own == body)
                    .unwrap_or_default()
            };
            Template {
                kind: name.to_owned(),
                bodies: count,
                joints: pins.iter().map(|(a, b)| [number(*a), number(*b)]).collect(),
                guide: None,
                crank: 1,
                output: number(own[2]),
            }
        };
        chains::different(chain, choices)
            .into_iter()
            .map(one)
            .collect()
    }

    /// The room in which pins are drawn.
    fn drawn(&self, template: &Template, random: &mut Random) -> Candidate {
        let mut part = || random.turn().arg() / TAU + 0.5;
        let mut within = |[low, high]: [f64; 2]| low + (high - low) * part();
        let far = 1.5 * self.size;
        let [x, y] = [self.middle.re, self.middle.im].map(|at| [at - far, at + far]);
        let mut pivot = Number::default();
        let mut joints: Vec<Joint> = Vec::new();
        for (k, bodies) in template.joints.iter().enumerate() {
            let is_ground = bodies.contains(&0);
            let is_crank = bodies.contains(&template.crank);
            let kind = match (template.guide == Some(k), self.goal, is_ground) {
                (true, ..) => Kind::Guide(within([-PI, PI])),
                (_, Goal::Function, true) if is_crank => Kind::Pin(Number::default()),
                (_, Goal::Function, true) if bodies.contains(&template.output) => {
                    Kind::Pin(Number::from(self.base))
                }
                (_, _, true) => {
                    Kind::Pin(Number::new(within(self.pivots[0]), within(self.pivots[1])))
                }
                _ => Kind::Pin(Number::new(within(x), within(y))),
            };
            joints.push(Joint {
                bodies: *bodies,
                kind,
            });
        }
        let is_pivot =
            |joint: &&Joint| joint.bodies.contains(&0) && joint.bodies.contains(&template.crank);
        if let Some(Kind::Pin(at)) = joints.iter().find(is_pivot).map(|joint| joint.kind) {
            pivot = at;
        }
        for joint in &mut joints {
            if joint.bodies.contains(&template.crank) && !joint.bodies.contains(&0) {
                let angle = match (self.asked.directions, self.pairs.first()) {
                    (true, Some(pair)) => pair[0],
                    _ => within([-PI, PI]),
                };
                joint.kind =
                    Kind::Pin(pivot + Number::from_polar(within([0.05, 1.0]) * self.size, angle));
            }
        }
        let point = self.wanted[0].point.unwrap_or(Number::from(self.base));
        // The crank's angles in the same parts as the way of the point, one way or the other.
        let total = within([0.15, 0.97]) * TAU * if within([-1.0, 1.0]) < 0.0 { -1.0 } else { 1.0 };
        let mut ways = vec![0.0];
        for pair in self.wanted.windows(2) {
            let way = match (pair[0].point, pair[1].point) {
                (Some(a), Some(b)) => (b - a).norm(),
                _ => 1.0,
            };
            ways.push(ways[ways.len() - 1] + way);
        }
        let length = ways[ways.len() - 1].max(1e-300);
        let turns = self
            .wanted
            .iter()
            .zip(&ways)
            .map(|(own, way)| own.crank.unwrap_or(total * way / length));
        Candidate {
            turns: turns.collect(),
            linkage: Linkage {
                bodies: template.bodies,
                joints,
                crank: template.crank,
                output: template.output,
                point,
            },
        }
    }

    /// Limits of the dimensions in a search.
    pub fn limits(&self, linkage: &Linkage) -> Limits {
        let far = self.lengths[1].min(1e3 * self.size) + self.size;
        let around = |at: f64| [at - far, at + far];
        let free = [around(self.middle.re), around(self.middle.im)];
        let mut dimensions = Vec::new();
        for joint in &linkage.joints {
            let is_ground = joint.bodies.contains(&0);
            match joint.kind {
                Kind::Guide(_) => dimensions.push([-2.0 * PI, 2.0 * PI]),
                Kind::Pin(at)
                    if is_ground
                        && self.goal == Goal::Function
                        && (joint.bodies.contains(&linkage.crank)
                            || joint.bodies.contains(&linkage.output)) =>
                {
                    dimensions.extend([[at.re; 2], [at.im; 2]]);
                }
                Kind::Pin(_) if is_ground => dimensions.extend(self.pivots),
                Kind::Pin(_) => dimensions.extend(free),
            }
        }
        match self.goal {
            Goal::Function => dimensions.extend([[linkage.point.re; 2], [linkage.point.im; 2]]),
            Goal::Path | Goal::Motion => dimensions.extend(free),
        }
        let directions = match (self.asked.directions, self.pairs.first()) {
            (true, Some([crank, output])) => {
                vec![(linkage.crank, *crank), (linkage.output, *output)]
            }
            _ => Vec::new(),
        };
        Limits {
            dimensions,
            directions,
            length: self.size,
            kept: Some(Kept {
                lengths: self.lengths,
                transmission: self.asked.transmission,
            }),
        }
    }

    /// From many starts.
    fn fitted(&self, template: &Template, stop: &(dyn Fn() -> bool + Sync)) -> Fitted {
        let starts = self.asked.starts.unwrap_or(super::STARTS);
        let seed = self.asked.seed.unwrap_or(1);
        let enough = 4 * self.asked.most.unwrap_or(super::MOST) as usize;
        let known = self.known_starts(template);
        let mut own = Fitted::default();
        let known = known
            .par_iter()
            .filter_map(|start| self.searched(start, stop));
        own.found.extend(known.collect::<Vec<_>>());
        while own.used < starts && !stop() {
            let batch = own.used..starts.min(own.used + BATCH);
            own.used = batch.end;
            let found = batch.into_par_iter().filter_map(|number| {
                let mut random = Random::new(seed.wrapping_mul(SPREAD_SEEDS) ^ (number << 20));
                let drawings = (0..DRAWINGS).map(|_| self.drawn(template, &mut random));
                let drawings = drawings.filter_map(|own| {
                    let limits = self.limits(&own.linkage);
                    Some((distance(&own, &self.wanted, &limits)?, own))
                });
                let (_, start) = drawings.min_by(|a, b| a.0.total_cmp(&b.0))?;
                self.searched(&start, stop)
            });
            own.found.extend(found.collect::<Vec<_>>());
            let is_exact =
                |(rms, own): &&(f64, Candidate)| *rms < EXACT && self.allows(&own.linkage);
            if own.found.iter().filter(is_exact).count() >= enough {
                break;
            }
        }
        own
    }

    fn searched(
        &self,
        start: &Candidate,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<(f64, Candidate)> {
        let found = fit(start, &self.wanted, &self.limits(&start.linkage), &|| {
            stop()
        })?;
        Some((found.rms, found.candidate))
    }

    /// Starts from exact answers to a part of the task.
    fn known_starts(&self, template: &Template) -> Vec<Candidate> {
        let is_function = self.goal == Goal::Function && template.kind == "four_bar";
        if !is_function || self.pairs.len() < 3 {
            return Vec::new();
        }
        let crank: Vec<f64> = self.pairs.iter().map(|pair| pair[0]).collect();
        if self.asked.directions {
            let own = freudenstein(self.base, &self.pairs);
            return own
                .into_iter()
                .map(|pins| function_four_bar(self.base, pins, &crank))
                .collect();
        }
        if self.pairs.len() < 5 {
            return Vec::new();
        }
        // The first, the last and three between.
        let last = self.pairs.len() - 1;
        let some: Vec<[f64; 2]> = (0..5).map(|k| self.pairs[k * last / 4]).collect();
        let (found, ..) = self.dyads(&relative(self.base, &some), Number::from(0.3 * self.base));
        found
            .iter()
            .map(|own| function_four_bar(self.base, [own.moving, own.fixed], &crank))
            .collect()
    }
}

/// Four-bars, each followed by its cognates, which draw the same curve.
fn with_cognates(found: Vec<Candidate>, points: &[Number]) -> Vec<Candidate> {
    let of = |own: Candidate| {
        let pins: Vec<Number> = own.linkage.joints.iter().filter_map(Joint::pin).collect();
        let dyads = [
            Dyad {
                fixed: pins[0],
                moving: pins[1],
            },
            Dyad {
                fixed: pins[3],
                moving: pins[2],
            },
        ];
        let passing = Passing::through(dyads, points);
        let others = passing
            .cognates()
            .into_iter()
            .flat_map(|own| own.candidates());
        let [_, reversed] = passing.candidates();
        std::iter::once(own)
            .chain([reversed])
            .chain(others)
            .collect::<Vec<_>>()
    };
    found.into_iter().flat_map(of).collect()
}

/// Pairs of links, evenly chosen where there are too many.
fn pairs(dyads: &[Dyad]) -> Vec<[Dyad; 2]> {
    let all = dyads
        .iter()
        .enumerate()
        .flat_map(|(k, a)| dyads[..k].iter().map(move |b| [*a, *b]));
    let all: Vec<[Dyad; 2]> = all.collect();
    let step = all.len().div_ceil(MOST_PAIRS).max(1);
    all.into_iter().step_by(step).collect()
}

/// The word of a kind in files.
pub fn word(kind: LinkageKind) -> &'static str {
    match kind {
        LinkageKind::FourBar => "four_bar",
        LinkageKind::SliderCrank => "slider_crank",
        LinkageKind::Watt1 => "watt_1",
        LinkageKind::Watt2 => "watt_2",
        LinkageKind::Stephenson1 => "stephenson_1",
        LinkageKind::Stephenson2 => "stephenson_2",
        LinkageKind::Stephenson3 => "stephenson_3",
    }
}

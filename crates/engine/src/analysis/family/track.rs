//! The nominal mechanism at its stations: the outputs, and what lies between them where that is far.
//!
//! Between two stations the quintic that meets q, v, a at both is near enough to the motion that the correction in the
//! middle is small; where it is not, a station is put there. So stations stand dense where the motion bends, as near
//! singular positions. A variant that is not as smooth between them shows by the same correction (`beside`).

use super::super::assembly::assemble;
use super::super::control::Control;
use super::super::driven::{path, range, refuse};
use super::super::instants::{Instants, OutputInstant};
use super::super::question::Kind;
use super::super::run::Prepared;
use super::needs::Needs;
use crate::mechanism::continuation::{End, Parameter, Path};
use crate::mechanism::driven::{Aside, Driven};
use crate::system::{Inputs, System};
use linkdyn_linear::hermite::{Node, quintic};

/// Correction in the middle of two stations [rad, sizes of the mechanism].
pub const SMOOTH: f64 = 1e-5;
/// Stations for each output, at most, and for a few.
const DENSEST: usize = 8;
const FEW: usize = 64;
/// Halvings of an interval.
const HALVINGS: u32 = 10;

/// What the variants are found beside.
pub struct Track {
    pub stations: Vec<Station>,
    pub solver: Aside,
    pub reactions: bool,
    pub needs: Needs,
    pub changes: Changes,
}

/// The nominal mechanism at an instant.
pub struct Station {
    pub instant: OutputInstant,
    /// An output, not put between.
    pub is_output: bool,
    pub node: Node,
    /// Sign of det J.
    pub sign: f64,
    /// Half-way from the station before.
    pub middle: Option<Middle>,
}

/// The nominal mechanism half-way between two stations.
pub struct Middle {
    pub time: f64,
    pub q: Vec<f64>,
}

/// Whether numbers of the analysis and of drivers differ between variants.
#[derive(Debug, Clone, Copy)]
pub struct Changes {
    pub analysis: bool,
    pub drivers: bool,
}

/// What solves the nominal mechanism along its path.
struct Follower<'s> {
    driven: Driven<'s>,
    path: Path,
    inputs: Inputs,
}

impl Track {
    /// Of a prepared model; `None` if variants need more than it has.
    pub fn new(prepared: &Prepared, changes: Changes) -> Option<Track> {
        let (system, question) = prepared.parts();
        let settings = question.driven();
        let is_sampled = matches!(settings.instants, Instants::Sampled(_));
        if question.kind != Kind::Prescribed
            || system.links > 0
            || settings.at_events
            || !system.initial.is_empty()
            || !system.initial_rates.is_empty()
            || changes.analysis
            || (is_sampled && changes.drivers)
            || refuse(system, settings.contents.reactions, false).is_err()
        {
            return None;
        }
        let instants = settings.instants.list(system).ok()?;
        let mut follower = Follower::new(system, &instants)?;
        let stations = follower.stations(&instants)?;
        Some(Track {
            stations,
            solver: follower.driven.set_aside(),
            reactions: settings.contents.reactions,
            needs: Needs::new(prepared)?,
            changes,
        })
    }
}

impl<'s> Follower<'s> {
    /// Follows the motion; `None` if there are singular positions or redundant constraints.
    fn new(system: &'s System, instants: &[OutputInstant]) -> Option<Self> {
        let start = Inputs::at_time(system, 0.0);
        let assembled = assemble(system, &start).ok()?;
        super::super::assembly::check_driven(system, &assembled, &start).ok()?;
        let mut driven = Driven::new(system, &assembled.q, &start).ok()?;
        let mut q = assembled.q;
        driven.correct(&mut q, &start).ok()?;
        let first = match Parameter::of(system) {
            Parameter::DriverValue => start.drive[0][0],
            Parameter::Time | Parameter::Coordinate => 0.0,
        };
        let range = range(system, instants);
        let path = path(&mut driven, (first, &q), range, &Control::default()).ok()?;
        let is_whole = path.low == End::Reached && path.high == End::Reached;
        let is_regular = path.windows().is_empty() && !driven.is_redundant();
        (is_whole && is_regular).then_some(Follower {
            driven,
            path,
            inputs: start,
        })
    }

    /// Takes the drivers' values at an instant, and the path's position there to `q`, corrected.
    fn position(&mut self, instant: &OutputInstant, node: &mut Node) -> Option<()> {
        let system = self.driven.system;
        self.inputs.time = instant.time;
        instant.drive(system, &mut self.inputs.drive);
        let s = match self.path.parameter {
            Parameter::DriverValue => self.inputs.drive[0][0],
            Parameter::Time | Parameter::Coordinate => instant.time,
        };
        let Node { q, d, dd, .. } = node;
        self.path.guess(s, q, d, dd)?;
        self.driven.correct(q, &self.inputs).ok()?;
        Some(())
    }

    fn station(&mut self, instant: OutputInstant, is_output: bool) -> Option<Station> {
        let zero = vec![0.0; self.driven.system.n()];
        let mut node = Node {
            s: instant.time,
            q: zero.clone(),
            d: zero.clone(),
            dd: zero,
        };
        self.position(&instant, &mut node)?;
        self.driven.factor(&self.inputs).ok()?;
        self.driven.velocity(&self.inputs, &mut node.d);
        self.driven.acceleration(&self.inputs, &mut node.dd);
        Some(Station {
            sign: self.driven.determinant_sign(),
            instant,
            is_output,
            node,
            middle: None,
        })
    }

    fn stations(&mut self, instants: &[OutputInstant]) -> Option<Vec<Station>> {
        let most = DENSEST * instants.len() + FEW;
        let mut stations: Vec<Station> = Vec::with_capacity(instants.len());
        for instant in instants {
            let next = self.station(*instant, true)?;
            match stations.last().is_some() {
                true => self.reach(&mut stations, next, HALVINGS)?,
                false => stations.push(next),
            }
            if stations.len() > most {
                return None;
            }
        }
        Some(stations)
    }

    /// Adds a station, and those that are needed on the way to it.
    fn reach(&mut self, stations: &mut Vec<Station>, mut next: Station, left: u32) -> Option<()> {
        let last = stations.last()?;
        let (from, to) = (&last.node, &next.node);
        if to.s <= from.s {
            return None;
        }
        let half_way = OutputInstant {
            time: 0.5 * (from.s + to.s),
            exact: None,
        };
        let middle = self.station(half_way, false)?;
        let mut guess = middle.node.q.clone();
        quintic(from, to, half_way.time, &mut guess, None);
        guess
            .iter_mut()
            .zip(&middle.node.q)
            .for_each(|(q, exact)| *q -= exact);
        if self.driven.system.scaled_norm(&guess) > SMOOTH {
            if left == 0 {
                return None;
            }
            self.reach(stations, middle, left - 1)?;
            return self.reach(stations, next, left - 1);
        }
        next.middle = Some(Middle {
            time: half_way.time,
            q: middle.node.q,
        });
        stations.push(next);
        Some(())
    }
}

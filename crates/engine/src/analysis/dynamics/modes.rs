//! The modes of a contact: its phases, the guards that end them, and what is reset there.
//!
//! Each phase has **guards**, functions of the state that become positive where the phase ends:
//!
//! ```text
//! flight     min(δ, room + ε)               the journal meets the bearing
//! contact    −δ − ε, −room − ε              it leaves, or the surface ends there
//!            −h(δ, δ̇)                       the law would pull, h ≤ 0 (Kelvin and Voigt: K δ + D δ̇)
//!            v_t − v_up,  v_low − v_t       the friction law goes over to its next piece
//! released   −δ − ε,  h(δ, δ̇)               it leaves; it presses again
//! behind     −δ − ε, −room − ε              it is out of the material
//!
//! rigid surfaces:
//! flight     min(δ, δ̇, room + ε)            an impact
//! contact    −N                             the multiplier of the journal on the surface would pull (of a latch beyond what it holds,
//!                                           of what an event has closed |N|)
//!            −room − ε                      the surface ends there
//!            −s v_t                         it slides no more in the way s
//!            |T| − μ N                      it sticks, and friction can't hold it any longer
//! ```
//!
//! Where an outline goes on smoothly, or around a corner, a touch goes over to the next piece at −room − ε and changes nothing else
//! (see [`super::seams`]): while a piece is touched, its neighbours are not met.
//!
//! A one-way clutch has the guard δ̇ in flight; locks and joints that events close have none.
//!
//! Between events the equations are smooth; events are located on the step's continuous extension.

use crate::contact::friction;
use crate::element::edge::Edge;
use crate::element::pair::{Contact, Pair, Phase, Reading, Rigid, Surface};
use crate::system::Scale;

/// A journal has left where it is this far, in parts of its size (a bearing's clearance), from the surface: well above round-off.
pub const GONE: f64 = 1e-10;
/// Penetration of a tip that only grazes an outline, in parts of the mechanism.
const GRAZE: f64 = 1e-12;
/// Approach of a rigid journal that is round-off [L/T]: velocities of constrained bodies are good to some 1e-12.
const CREEP: f64 = 1e-10;
/// Pull on a journal that stays on its bearing which is round-off [M L/T²]: multipliers lose a few digits more.
const PULL: f64 = 1e-9;
/// Sliding velocity past the end of a piece of the friction law from which the next piece holds [L/T]: as little as
/// velocities resolve, for the law is continuous there.
const PAST: f64 = 1e-12;
/// Sliding of a journal on a rigid bearing that is round-off [L/T]: forces are large where journals wedge, and round-off in their
/// velocities too.
pub const STILL: f64 = 1e-9;
/// Part of the friction that is round-off where a journal sticks.
const GRIP: f64 = 1e-8;

/// The largest of a contact's guards, with round-off by the mechanism's own length, mass and time.
pub fn largest_guard(scale: &Scale, pair: &Pair, memory: &Contact, reading: &Reading) -> f64 {
    match (&pair.surface, memory.phase) {
        (Surface::Compliant(_), Phase::Flight) => met(pair, reading),
        // It touches always.
        (Surface::Rigid(_), Phase::Flight) if pair.is_one_way() => {
            (reading.rate - creep(scale)) * scale.time
        }
        // On its way out it may still be where it touched.
        (Surface::Rigid(_), Phase::Flight) => {
            let approach = reading.rate - creep(scale);
            // Between corners that leave no room a tip may graze both by round-off.
            let graze = pair.edge().map_or(0.0, |edge| GRAZE * edge.size);
            (reading.penetration - graze)
                .min(approach * scale.time)
                .min(reading.room + GONE * pair.size())
        }
        (Surface::Rigid(rigid), Phase::Contact) => {
            let ended = -reading.room - GONE * pair.size();
            lets_go(scale, (pair, rigid), reading)
                .max(turns(scale, rigid, memory, reading))
                .max(ended)
        }
        (Surface::Compliant(laws), Phase::Contact) => {
            let hold = laws
                .normal
                .hold(reading.penetration, reading.rate, memory.approach);
            gone(pair, reading)
                .max(-hold)
                .max(past(&laws.friction, memory, reading) - PAST * scale.velocity())
        }
        (Surface::Compliant(laws), Phase::Released) => gone(pair, reading).max(laws.normal.hold(
            reading.penetration,
            reading.rate,
            memory.approach,
        )),
        (Surface::Rigid(_), Phase::Released) => f64::NEG_INFINITY,
        (_, Phase::Behind) => gone(pair, reading),
    }
}

/// Approach that is round-off [m/s].
pub fn creep(scale: &Scale) -> f64 {
    CREEP * scale.velocity()
}

/// Positive where a rigid journal on its bearing goes over from sliding to something else, or from sticking.
fn turns(scale: &Scale, rigid: &Rigid, memory: &Contact, reading: &Reading) -> f64 {
    if rigid.friction == 0.0 {
        return f64::NEG_INFINITY;
    }
    match memory.piece {
        0 => {
            let most = rigid.friction * reading.normal;
            reading.tangential.abs() - (1.0 + GRIP) * most - PULL * scale.force()
        }
        way => -f64::from(way) * reading.sliding - STILL * scale.velocity(),
    }
}

/// Positive where surfaces that stay together would be pulled, or by more than their latch holds.
fn lets_go(scale: &Scale, (pair, rigid): (&Pair, &Rigid), reading: &Reading) -> f64 {
    // What an event has closed holds from both sides.
    let pull = match pair.is_timed() {
        true => reading.normal.abs(),
        false => -reading.normal,
    };
    pull - rigid.latch.unwrap_or(0.0) - PULL * scale.force()
}

/// Positive beyond the ends of the friction law's piece.
fn past(friction: &friction::Law, memory: &Contact, reading: &Reading) -> f64 {
    let (low, up) = friction.bounds(memory.piece);
    (reading.sliding - up).max(low - reading.sliding)
}

/// Positive where surfaces overlap; pieces of an outline that meet do so, too, where they meet.
fn met(pair: &Pair, reading: &Reading) -> f64 {
    reading.penetration.min(reading.room + GONE * pair.size())
}

/// Whether a tip is past the end of a piece of its outline: it is where the guard of that end has become positive, also when the position
/// has been solved once more.
pub fn is_past(pair: &Pair, reading: &Reading) -> bool {
    pair.edge().is_some() && -reading.room > 0.5 * GONE * pair.size()
}

fn gone(pair: &Pair, reading: &Reading) -> f64 {
    (-reading.penetration).max(-reading.room) - GONE * pair.size()
}

/// Whether the surface is there where the contact is.
pub fn is_there(pair: &Pair, reading: &Reading) -> bool {
    let deepest = pair.edge().map_or(f64::INFINITY, |edge| edge.deepest);
    reading.room >= -GONE * pair.size() && reading.penetration <= deepest
}

/// Whether a tip goes behind a piece of its outline, or comes out from there; its memory is changed then.
pub fn passes(pair: &Pair, memory: &mut Contact, reading: &Reading) -> bool {
    let Some(edge) = pair.edge() else {
        return false;
    };
    let to = match memory.phase {
        Phase::Flight if is_behind(edge, reading) => Phase::Behind,
        Phase::Behind if gone(pair, reading) > 0.0 => Phase::Flight,
        Phase::Flight | Phase::Contact | Phase::Released | Phase::Behind => return false,
    };
    *memory = Contact {
        phase: to,
        ..Contact::default()
    };
    true
}

fn is_behind(edge: &Edge, reading: &Reading) -> bool {
    reading.room > -GONE * edge.size && reading.penetration > edge.deepest
}

/// The phase in which a journal is at the start; in flight where a neighbour `carries` the touch.
pub fn first_phase(pair: &Pair, reading: &Reading, carries: bool) -> Contact {
    let mut memory = Contact::default();
    if carries || passes(pair, &mut memory, reading) {
        return memory;
    }
    let touches = met(pair, reading) > 0.0;
    if touches && matches!(pair.surface, Surface::Compliant(_)) {
        begin(pair, reading, &mut memory);
    }
    memory
}

fn begin(pair: &Pair, reading: &Reading, memory: &mut Contact) {
    *memory = Contact {
        phase: Phase::Contact,
        approach: reading.rate.max(0.0),
        ..Contact::default()
    };
    if let Surface::Compliant(laws) = &pair.surface {
        memory.piece = laws.friction.piece(reading.sliding);
    }
}

/// What a contact's guards say has happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    Begin,
    Release,
    Press,
    End,
    /// The friction law's next piece holds.
    Piece,
}

/// Changes the memory where a guard has become positive.
pub fn change(
    scale: &Scale,
    pair: &Pair,
    memory: &mut Contact,
    reading: &Reading,
) -> Option<Change> {
    let next_piece = |friction: &friction::Law, memory: &mut Contact, slack: f64| {
        (past(friction, memory, reading) > slack).then(|| {
            memory.piece = friction.piece(reading.sliding);
            Change::Piece
        })
    };
    let Surface::Compliant(laws) = &pair.surface else {
        // What a rigid journal does comes with impulses.
        return None;
    };
    match memory.phase {
        Phase::Flight => (met(pair, reading) > 0.0).then(|| {
            begin(pair, reading, memory);
            Change::Begin
        }),
        Phase::Behind => None,
        Phase::Contact | Phase::Released if gone(pair, reading) > 0.0 => {
            *memory = Contact::default();
            Some(Change::End)
        }
        Phase::Contact => {
            if laws
                .normal
                .hold(reading.penetration, reading.rate, memory.approach)
                < 0.0
            {
                memory.phase = Phase::Released;
                Some(Change::Release)
            } else {
                next_piece(&laws.friction, memory, PAST * scale.velocity())
            }
        }
        Phase::Released => (laws
            .normal
            .hold(reading.penetration, reading.rate, memory.approach)
            > 0.0)
            .then(|| {
                memory.phase = Phase::Contact;
                memory.piece = laws.friction.piece(reading.sliding);
                Change::Press
            }),
    }
}

/// State of a contact in the results: flight, sliding, sticking.
pub fn state(pair: &Pair, memory: &Contact) -> f64 {
    match (&pair.surface, memory.phase) {
        (_, Phase::Flight | Phase::Released | Phase::Behind) => 0.0,
        (_, Phase::Contact) if sticks(pair, memory) => 2.0,
        (_, Phase::Contact) => 1.0,
    }
}

/// Whether a journal in contact sticks.
pub fn sticks(pair: &Pair, memory: &Contact) -> bool {
    match &pair.surface {
        Surface::Compliant(laws) => laws.friction.sticks(memory.piece),
        Surface::Rigid(rigid) => rigid.friction > 0.0 && memory.piece == 0,
    }
}

//! The beginning of a motion: how exact its steps are, and in which phases its contacts are.

use super::events::Events;
use super::extremes::Extremes;
use super::fault::Fault;
use super::flow::Flow;
use super::impulses::{Impulses, Instant, Jams, at_rest, rests};
use super::ledger::Ledger;
use super::margins::Margins;
use super::modes::{first_phase, passes};
use super::passages::Passages;
use super::settings::{Exactness, Settings};
use super::simulation::Simulation;
use super::state::State;
use super::steps::Steps;
use super::switches::Switches;
use super::words::{backward_start, deep_start, describe, unclosed};
use crate::analysis::control::Stop;
use crate::analysis::outside::Outside;
use crate::analysis::words::friction_may_lock;
use crate::element::pair::{Contact, Surface};
use linkdyn_output::Status;

/// Newton's step, by rtol, below which the equations are taken for those of its end: a hundredth of what the step's error
/// may be.
const LAG: f64 = 1e-2;
/// The same with contacts, where positions matter by parts of the clearance.
const CONTACT_LAG: f64 = 1e-10;
/// With contacts a step's error is bounded by this part of rtol: an impact takes some twenty steps and multiplies what was
/// wrong before it, and a run has many.
const IMPACTS: f64 = 1e-2;
/// No less than this, which is near round-off.
const FINEST: f64 = 1e-13;
/// Deepest penetration at the start, in parts of the clearance.
const DEEPEST_START: f64 = 0.1;
const DEEPEST_RIGID: f64 = 1e-9;

impl<'s> Simulation<'s> {
    /// A motion from t = 0, for a run until `end`.
    ///
    /// # Errors
    /// A start with deep penetration, or where the equations can't be evaluated.
    pub fn begin(settings: &Settings, mut flow: Flow<'s>, end: f64) -> Result<Self, Stop> {
        let mut ledger = Ledger::new(flow.system());
        let Exactness { mut rtol, atol } = settings.wanted;
        flow.set_lag(LAG * rtol);
        if !ledger.is_empty() {
            rtol = (IMPACTS * rtol).max(FINEST.min(rtol));
            flow.set_lag(CONTACT_LAG.min(LAG * rtol));
        }
        // Its rows are those of the mechanism as it is, before contacts at the start bring theirs.
        let mut extremes = (settings.watched.as_ref())
            .map(|watched| Box::new(Extremes::new(flow.system(), settings, watched)));
        let mut state = State::new(flow.layout());
        first_phases(&mut flow, &state, &mut ledger)?;
        flow.store(&mut state);
        let starts = flow.system().states.iter().map(|own| own.start);
        let own = state.states_mut().iter_mut();
        own.zip(starts).for_each(|(own, start)| *own = start);
        flow.freeze_branches();
        let mut jams = Jams::new();
        let (has_timed, leans) = (!flow.system().timed.is_empty(), leans(&flow));
        let mut start = |begin: fn(&mut Impulses) -> Result<(), Fault>| {
            let at = Instant {
                time: 0.0,
                flow: &mut flow,
                state: &mut state,
                ledger: &mut ledger,
                jams: &mut jams,
            };
            begin(&mut Impulses::new(at, rtol))
        };
        let mut rested = Ok(());
        if has_timed {
            rested = start(|impulses| impulses.engage());
        }
        if rested.is_ok() && leans {
            rested = start(|impulses| impulses.rest().map_err(Fault::Unsolved));
        }
        let started = rested.and_then(|()| {
            Steps::new(settings, Exactness { rtol, atol }, (&mut flow, &state), end)
        });
        let steps = started.map_err(|fault| {
            let system = flow.system();
            let message = unclosed(system, fault, 0.0);
            let message = message.unwrap_or_else(|| {
                describe(fault, 0.0, &friction_may_lock(system), &system.display)
            });
            Stop::failed(Status::Singular, message)
        })?;
        if let Some(extremes) = &mut extremes {
            extremes.begin_piece(&mut flow, &state, &ledger, 0.0);
        }
        let outside = Outside::new(flow.system());
        let passages = Passages::new(settings.contents, &flow);
        Ok(Simulation {
            flow,
            state,
            steps,
            event: None,
            events: Events::default(),
            ledger,
            switches: Switches::default(),
            outside,
            jams,
            margins: Margins::new(),
            extremes,
            passages,
            is_pushed_anew: false,
        })
    }
}

/// Whether a joint is at one of its rigid stops, or a tip on an outline.
fn leans(flow: &Flow) -> bool {
    let mut contacts = flow.system().contacts.iter().enumerate();
    contacts.any(|(contact, pair)| pair.limits() && rests(flow, contact))
}

/// The phases in which contacts are at the start.
fn first_phases(flow: &mut Flow, state: &State, ledger: &mut Ledger) -> Result<(), Stop> {
    let system = flow.system();
    for (contact, pair) in system.contacts.iter().enumerate() {
        let reading = flow.reading(contact);
        let deepest = match pair.surface {
            Surface::Compliant(_) => DEEPEST_START,
            Surface::Rigid(_) => DEEPEST_RIGID,
        };
        if pair.is_one_way() && reading.rate > at_rest(flow) {
            return Err(Stop::Input(vec![backward_start(system, contact)]));
        }
        let carried = flow.is_carried(contact);
        let is_behind = carried || passes(pair, &mut Contact::default(), &reading);
        if !is_behind && reading.penetration.min(reading.room) > deepest * pair.size() {
            return Err(Stop::Input(vec![deep_start(system, contact, &reading)]));
        }
        *flow.memory_mut(contact) = first_phase(pair, &reading, carried);
        let entry = ledger.entry((flow, state), contact, &reading, 0.0);
        ledger.start(contact, is_behind, &entry, &flow.reading(contact));
    }
    Ok(())
}

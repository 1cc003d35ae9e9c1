//! Ends of joints' ways: how messages speak of them, and what a motion that does not see them does there.

use super::control::Stop as Failed;
use crate::element::Kinematics;
use crate::element::pair::{ContactId, Pair, Surface};
use crate::element::quantity::Measured;
use crate::element::stop::{Stop, Travel};
use crate::system::{Evaluation, Inputs, JointRole, System};
use linkdyn_model::display::DisplayUnits;
use linkdyn_model::error::Complaint;
use std::f64::consts::TAU;

/// Beyond an end by less than this part of the mechanism is round-off.
pub const BEYOND: f64 = 1e-9;
/// How deep stops that yield may be pressed in at the start, in parts of the mechanism.
const DEEPEST: f64 = 0.1;

/// A place of a joint on its way, in words.
pub fn place(stop: &Stop, display: &DisplayUnits, value: f64) -> String {
    match stop.turns() {
        true => display.angle(value),
        false => display.length(value),
    }
}

/// A small depth \[m\] beyond a stop or an outline, in words.
pub fn depth(pair: &Pair, display: &DisplayUnits, depth: f64, digits: usize) -> String {
    match pair.stop() {
        Some(stop) if stop.turns() => display.angle_to(depth / stop.arm, digits),
        _ => display.length_to(depth, digits),
    }
}

/// Looks at a mechanism that is at rest at a position (n).
pub fn seen<T>(system: &System, q: &[f64], look: impl FnOnce(&Kinematics) -> T) -> T {
    let mut evaluation = Evaluation::new(system);
    evaluation.set_position(q);
    look(&evaluation.kinematics(&Inputs::still(system)))
}

/// Whole turns \[rad\] that bring an angle between the limits of its joint, by contact: bodies may be drawn at any turn.
pub fn turns(system: &System, at: &Kinematics) -> Vec<f64> {
    let mut turns = vec![0.0; system.contacts.len()];
    for ends in system
        .joints
        .iter()
        .filter_map(|joint| joint.extras().stops.as_deref())
    {
        let [Some(lower), Some(upper), ..] = *ends else {
            continue;
        };
        let stops = [lower, upper].map(|id| system.contacts[id.0].stop());
        let [Some(first), Some(last)] = stops else {
            continue;
        };
        if !first.turns() {
            continue;
        }
        let angle = first.coordinate(at);
        let is_within =
            |turn: &f64| (first.limit - BEYOND..=last.limit + BEYOND).contains(&(angle - turn));
        let turn = TAU * ((angle - 0.5 * (first.limit + last.limit)) / TAU).round();
        // As they are written, where that will do.
        let turn = [0.0, turn].into_iter().find(is_within).unwrap_or(0.0);
        (turns[lower.0], turns[upper.0]) = (turn, turn);
    }
    turns
}

/// The system with its stops at the turn at which the mechanism is; `None` if they are there.
pub fn at_this_turn(system: &System, q: &[f64]) -> Option<System> {
    let turns = seen(system, q, |at| turns(system, at));
    turns
        .iter()
        .any(|turn| *turn != 0.0)
        .then(|| system.turned(&turns))
}

/// The system at rest, with its stops at the turn at which the mechanism is, and with its locks and one-way clutches where they are;
/// `None` if that is what it is.
pub fn at_rest(system: &System, q: &[f64]) -> Option<System> {
    let turned = at_this_turn(system, q);
    let system = turned.as_ref().unwrap_or(system);
    let place = |id: ContactId| {
        let stop = system.contacts[id.0].stop();
        seen(system, q, |at| stop.map_or(0.0, |stop| stop.coordinate(at)))
    };
    system.standing(place).or(turned)
}

/// Refuses a start beyond the end of a joint's way; stops that yield may be pressed in a little.
///
/// # Errors
/// The first such joint.
pub fn check_start(system: &System, q: &[f64]) -> Result<(), Failed> {
    seen(system, q, |at| check(system, at))
}

fn check(system: &System, at: &Kinematics) -> Result<(), Failed> {
    for (contact, pair) in system.contacts.iter().enumerate() {
        let Some(stop) = pair.stop() else { continue };
        if stop.read(at).penetration > deepest(pair) {
            let here = stop.coordinate(at);
            let complaint = beyond(system, ContactId(contact), stop, here);
            return Err(Failed::Input(vec![complaint]));
        }
    }
    for joint in system.joints.iter().filter(|joint| joint.is_contact()) {
        let pieces = || system.contacts[joint.extras().edges.clone()].iter();
        let near: Vec<[f64; 2]> = pieces().filter_map(|pair| pair.edge()?.near(at)).collect();
        let least = near
            .iter()
            .map(|[distance, _]| *distance)
            .fold(f64::INFINITY, f64::min);
        // Where two are as near, it is the corner between them.
        let nearest = near
            .iter()
            .filter(|[distance, _]| *distance <= least + BEYOND * system.size);
        let height: f64 = nearest.map(|[_, height]| height).sum();
        let allowed = pieces().map(deepest).fold(0.0, f64::max);
        if height < -allowed {
            return Err(Failed::Input(vec![deep(
                system,
                joint.extras().edges.start,
                least,
            )]));
        }
    }
    for (contact, pair) in system.contacts.iter().enumerate() {
        let Some(edge) = pair.edge() else { continue };
        let mut reading = edge.read(at);
        // Over the end of a piece the tip is as deep as beside it.
        if reading.room.abs() <= BEYOND * system.size {
            reading.room = reading.penetration;
        }
        let depth = edge.depth(&reading, system.size);
        if depth > deepest(pair) {
            return Err(Failed::Input(vec![deep(system, contact, depth)]));
        }
    }
    Ok(())
}

/// How deep a contact may be pressed in at the start \[m\].
fn deepest(pair: &Pair) -> f64 {
    let part = match pair.surface {
        Surface::Rigid(_) => BEYOND,
        Surface::Compliant(_) => DEEPEST,
    };
    part * pair.size()
}

/// A tip that starts in the material.
pub fn deep(system: &System, contact: usize, depth: f64) -> Complaint {
    let name = system.owner_name(ContactId(contact));
    Complaint::new(
        format!("joints.{name}.outline"),
        format!(
            "the mechanism starts with the tip {} deep in the outline",
            system.display.length(depth)
        ),
    )
    .hint("the material is on the left of the way along the outline: turn it round, or give another start")
}

fn beyond(system: &System, id: ContactId, stop: &Stop, here: f64) -> Complaint {
    Complaint::new(
        format!("{}.limits", system.owner_path(id)),
        format!(
            "the mechanism starts at {}, beyond the {} limit {}",
            place(stop, &system.display, here),
            stop.side.word(),
            place(stop, &system.display, stop.limit)
        ),
    )
    .hint(match stop.way {
        Travel::Turn => "it is the angle of the second body in the first: give wider limits, or another start",
        Travel::Along(_) => "it is the slide of the second point along \"axis\": give wider limits, or another start",
        Travel::Apart => "it is the distance of its points: give wider limits, or another start",
    })
}

/// How far a motion that drivers prescribe goes beyond the ends of its joints' ways.
#[derive(Debug, Clone, Default)]
pub struct Overrun {
    /// Depth \[m\] at most, and when \[s\], by stop.
    most: Vec<(ContactId, f64, f64)>,
    /// Of the first output.
    turns: Option<Vec<f64>>,
    /// Pins in slots that points draw.
    pins: Option<Vec<Pin>>,
}

/// A pin in a slot that points draw.
#[derive(Debug, Clone)]
struct Pin {
    /// The slot, by its number.
    joint: usize,
    slide: Measured,
    /// Where its drawing begins and ends \[m\].
    drawn: [f64; 2],
    /// Whether it has been within.
    within: bool,
    /// How far it goes beyond \[m\], and when \[s\].
    most: (f64, f64),
}

impl Pin {
    fn all(system: &System) -> Vec<Pin> {
        let joints = system.joints.iter().enumerate();
        let pins = joints.filter_map(|(joint, data)| {
            let (Some(drawn), JointRole::Slot { axis }) = (&data.extras().drawn, data.role())
            else {
                return None;
            };
            let [first, second] = data.points();
            Some(Pin {
                joint,
                slide: Measured::Along {
                    first,
                    second,
                    axis,
                },
                drawn: **drawn,
                within: false,
                most: (0.0, 0.0),
            })
        });
        pins.collect()
    }

    fn note(&mut self, at: &Kinematics, least: f64) {
        let ([slide, _], [low, high]) = (self.slide.value(at), self.drawn);
        let beyond = (low - slide).max(slide - high);
        self.within |= beyond <= 0.0;
        if beyond > self.most.0.max(least) {
            self.most = (beyond, at.time);
        }
    }
}

impl Overrun {
    /// Looks at an output.
    pub fn note(&mut self, system: &System, at: &Kinematics) {
        let pins = self.pins.get_or_insert_with(|| Pin::all(system));
        pins.iter_mut()
            .for_each(|pin| pin.note(at, BEYOND * system.size));
        if system.contacts.is_empty() {
            return;
        }
        let turns = self.turns.get_or_insert_with(|| turns(system, at));
        for (contact, pair) in system.contacts.iter().enumerate() {
            let depth = match (pair.stop(), pair.edge()) {
                // How fast it turns the way that its clutch holds.
                (Some(stop), _) if pair.is_one_way() => stop.read(at).rate * system.scale.time,
                (Some(stop), _) => stop.turned(turns[contact]).read(at).penetration,
                (_, Some(edge)) => edge.depth(&edge.read(at), system.size),
                (None, None) => continue,
            };
            if depth <= BEYOND * pair.size() {
                continue;
            }
            let id = ContactId(contact);
            match self.most.iter_mut().find(|(known, ..)| *known == id) {
                Some(known) if depth <= known.1 => {}
                Some(known) => *known = (id, depth, at.time),
                None => self.most.push((id, depth, at.time)),
            }
        }
    }

    /// What is said of pins that are in their slots now and then.
    fn pins_that_leave(&self, system: &System) -> impl Iterator<Item = String> {
        let pins = self.pins.iter().flatten();
        let leaves = pins.filter(|pin| pin.within && pin.most.0 > 0.0);
        leaves.map(|pin| {
            let (beyond, time) = pin.most;
            format!(
                "the pin of joint \"{}\" leaves its slot as the points of its body draw it, by {} at t = {}: a slot has no end of \
                 its own; give it \"limits\", or let a joint of type \"contact\" set the pin free",
                system.joints[pin.joint].name,
                system.display.length_to(beyond, 3),
                system.display.time(time)
            )
        })
    }

    /// What is said of it.
    pub fn warnings(&self, system: &System) -> Vec<String> {
        let display = &system.display;
        let warning = |&(id, deepest, time): &(ContactId, f64, f64)| {
            let pair = &system.contacts[id.0];
            let owner = system.owner_words(id);
            if pair.is_one_way() {
                return format!(
                    "the drivers turn {owner} the way that its one-way clutch holds, most at t = {}: a motion that is \
                     prescribed does not stop there",
                    display.time(time)
                );
            }
            let deepest = depth(pair, display, deepest, 3);
            let Some(stop) = pair.stop() else {
                return format!(
                    "the drivers take the tip of {owner} into the outline, by {deepest} at t = {}: a motion that is \
                     prescribed does not stop there",
                    display.time(time)
                );
            };
            format!(
                "the drivers take {} beyond its {} limit {}, by {} at t = {}: a motion that is prescribed does not \
                 stop there",
                owner,
                stop.side.word(),
                place(stop, display, stop.limit),
                deepest,
                display.time(time)
            )
        };
        let beyond = self.most.iter().map(warning);
        beyond.chain(self.pins_that_leave(system)).collect()
    }
}

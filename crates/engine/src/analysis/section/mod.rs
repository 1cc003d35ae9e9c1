//! Internal forces of straight links: what a cut across the axis carries.
//!
//! All that acts on the body is moved to the foot on the axis of the point where it acts, with the moment of its arm; what is beyond
//! the ends, to the nearer end. Along the axis lies a uniform bar with
//!
//! ```text
//! p, q = ρA (g − a(x))       a(x) = a_c + α × r − ω² r,  r = from the centre of mass to the axis at x        [N/m]
//! ```
//!
//! and what the body has of mass and inertia beyond that bar is a rigid lump at its own centre of mass. So forces and moments
//! balance, and nothing is left beyond the ends. The signs are those of [`beam`].

mod actions;
mod beam;

pub use actions::Actions;

use crate::element::Kinematics;
use crate::system::{BodyPart, ElasticAxis, SectionData, System};
use actions::Action;
use beam::{Concentrated, CutForces, Peaks, SAME_PLACE, StraightLink};
use linkdyn_linear::math::{Vec2, perp};
use linkdyn_model::display::number;
use linkdyn_output::{Channel, Column, SectionQuantity, Trajectory};

/// What a link carries inside at an instant.
pub struct SectionReading<'s> {
    data: &'s SectionData,
    beam: StraightLink,
    peaks: Peaks,
}

impl<'s> SectionReading<'s> {
    /// Of a moving body with a cross-section, on which these act.
    pub fn new(
        (system, data): (&System, &'s SectionData),
        at: &Kinematics,
        (body, a): (usize, &[f64]),
        actions: &Actions,
    ) -> Self {
        let (pose, twist) = (&at.poses[body + 1], &at.twists[body + 1]);
        let columns = system.layout.moving(body);
        let ([x, y, alpha], omega) = if system.is_slow {
            ([0.0; 3], 0.0)
        } else {
            (columns.read(a), twist.omega)
        };
        let (along, rho) = (pose.turn(data.axis), pose.turn(data.from));
        let across = perp(along);
        // g − a of the axis: at its beginning, and by x
        let fall = system.gravity - Vec2::new(x, y);
        let first = fall - perp(rho) * alpha + rho * (omega * omega);
        let by_x = along * (omega * omega) - across * alpha;
        let axis = system.axes.iter().find(|axis| axis.body == body);
        let mut loads = Vec::new();
        for (x, action) in axis
            .into_iter()
            .flat_map(|axis| of_sections(system, axis, actions))
        {
            loads.push(Concentrated {
                x,
                along: action.force.dot(&along),
                across: action.force.dot(&across),
                moment: action.torque,
            });
        }
        let mut load = |action: &Action| {
            let arm = action.place - (pose.r + rho);
            let mut x = arm.dot(&along).clamp(0.0, data.length);
            if x < SAME_PLACE * data.length {
                x = 0.0;
            } else if data.length - x < SAME_PLACE * data.length {
                x = data.length;
            }
            loads.push(Concentrated {
                x,
                along: action.force.dot(&along),
                across: action.force.dot(&across),
                moment: action.torque + (arm - along * x).perp(&action.force),
            });
        };
        actions.on(body).for_each(&mut load);
        if axis.is_none() {
            load(&lump(
                (system, data, body),
                (
                    rho + along * (data.length / 2.0),
                    first + by_x * (data.length / 2.0),
                ),
                (pose.r, fall, alpha),
            ));
        }
        let spread = [along, across].map(|on| [first, by_x].map(|one| data.bar * one.dot(&on)));
        if let Some(axis) = axis {
            vibrate((system, axis, a), at, (along, alpha), &mut loads);
        }
        let mut beam = StraightLink::new(data.length, loads.clone(), spread);
        if let Some(axis) = axis {
            bend(axis, at, (&beam, along), &mut loads);
            beam = StraightLink::new(data.length, loads, spread);
        }
        SectionReading {
            peaks: beam.peaks(data.area, data.modulus),
            beam,
            data,
        }
    }

    /// Forces that are left beyond the ends of the axis, and the size of all on it \[N\].
    pub fn unbalanced(&self) -> [f64; 2] {
        self.beam.unbalanced()
    }

    /// The cut at a station.
    fn station(&self, station: usize) -> CutForces {
        let part = station as f64 / (self.data.stations - 1) as f64;
        self.beam.at(part * self.data.length)
    }

    /// One of the quantities.
    pub fn value(&self, quantity: SectionQuantity) -> f64 {
        let Peaks {
            tension,
            compression,
            shear,
            moment,
            stress,
            at,
        } = self.peaks;
        if !self.beam.unbalanced()[0].is_finite() {
            return f64::NAN;
        }
        match quantity {
            SectionQuantity::AxialForce(station) => self.station(station)[0],
            SectionQuantity::ShearForce(station) => self.station(station)[1],
            SectionQuantity::BendingMoment(station) => self.station(station)[2],
            SectionQuantity::Tension => tension,
            SectionQuantity::Compression => compression,
            SectionQuantity::Shear => shear,
            SectionQuantity::Bending => moment,
            SectionQuantity::Stress => stress,
            SectionQuantity::StressAt => at,
            SectionQuantity::Buckling => self
                .data
                .buckling_load
                .map_or(f64::NAN, |load| compression / load),
        }
    }
}

/// What acts on the sections of an elastic link, by their places on its axis \[m\].
fn of_sections<'a>(
    system: &'a System,
    axis: &'a ElasticAxis,
    actions: &'a Actions,
) -> impl Iterator<Item = (f64, &'a Action)> {
    let name = &system.bodies[axis.body].name;
    let bodies = system.bodies.iter().enumerate();
    let sections =
        bodies.filter(move |(_, data)| data.part() == BodyPart::Section && data.link() == name);
    sections.flat_map(move |(body, data)| {
        let x = data.carried().map_or(0.0, |own| own.place.norm());
        actions.on(body).map(move |action| (x, action))
    })
}

/// Inertia of an elastic link beside that of a rigid one, by parts of its axis.
fn vibrate(
    (system, axis, a): (&System, &ElasticAxis, &[f64]),
    at: &Kinematics,
    (along, alpha): (Vec2, f64),
    loads: &mut Vec<Concentrated>,
) {
    let [mass, rotary] = axis.heavy;
    let last = axis.stations.len() - 1;
    for (k, station) in axis.stations.iter().enumerate().filter(|_| !system.is_slow) {
        let part = if k == 0 || k == last { 0.5 } else { 1.0 };
        let force = station.vibrates(at, a, &system.layout) * (-part * mass / last as f64);
        loads.push(Concentrated {
            x: station.place.norm(),
            along: force.dot(&along),
            across: force.dot(&perp(along)),
            moment: -rotary * alpha * part / last as f64,
        });
    }
}

/// What axial forces exert on a link that is bent: −N Δw between places of its axis.
fn bend(
    axis: &ElasticAxis,
    at: &Kinematics,
    (beam, along): (&StraightLink, Vec2),
    loads: &mut Vec<Concentrated>,
) {
    let across = perp(along);
    let places: Vec<(f64, f64)> = axis
        .stations
        .iter()
        .map(|station| {
            let off = station.pose(at).0 - at.poses[station.frame.0].r;
            (station.place.norm(), off.dot(&across))
        })
        .collect();
    for pair in places.windows(2) {
        let x = (pair[0].0 + pair[1].0) / 2.0;
        loads.push(Concentrated {
            x,
            along: 0.0,
            across: 0.0,
            moment: -beam.at(x)[0] * (pair[1].1 - pair[0].1),
        });
    }
}

/// Weight and inertia of what the body has beyond the bar, whose centre is at `middle` from that of the mass, and falls with `falls`.
fn lump(
    (system, data, body): (&System, &SectionData, usize),
    (middle, falls): (Vec2, Vec2),
    (centre, fall, alpha): (Vec2, Vec2, f64),
) -> Action {
    let [mass, _, inertia] = system.layout.moving(body).read(system.mass.diagonal());
    let bar = data.bar * data.length;
    let of_bar = falls * bar;
    let turns = middle.perp(&of_bar) - bar * data.length * data.length / 12.0 * alpha;
    let (force, about_centre) = (fall * mass - of_bar, -inertia * alpha - turns);
    let rest = mass - bar;
    let rho = if rest > SAME_PLACE * mass {
        middle * (-bar / rest)
    } else {
        Vec2::zeros()
    };
    Action {
        body,
        place: centre + rho,
        force,
        torque: about_centre - rho.perp(&force),
    }
}

/// Headings of the columns of these.
pub fn headings(system: &System) -> impl Iterator<Item = Column> {
    system.sections.iter().flat_map(|(body, section)| {
        let stations = (0..section.stations).flat_map(SectionQuantity::of_station);
        let peaks = SectionQuantity::PEAKS
            .into_iter()
            .filter(|peak| *peak != SectionQuantity::Buckling || section.buckling_load.is_some());
        stations.chain(peaks).map(|quantity| {
            let channel = Channel::Section(*body, quantity);
            Column::of(channel, &system.bodies[*body].name, quantity.unit())
        })
    })
}

/// Links that buckle in some row.
pub fn warnings<'s>(system: &'s System, rows: &'s Trajectory) -> impl Iterator<Item = String> + 's {
    let columns = rows.columns.iter().enumerate();
    columns.filter_map(|(index, column)| {
        let Some(Channel::Section(body, SectionQuantity::Buckling)) = column.channel else {
            return None;
        };
        let known = rows.rows().filter(|row| row[index].is_finite());
        let worst = known.max_by(|one, other| one[index].total_cmp(&other[index]))?;
        let load = system.sections.get(&body)?.buckling_load?;
        let factor = worst[index];
        (factor > 1.0).then(|| {
            let [force, load, factor] = [factor * load, load, factor].map(|one| number(one, 4));
            format!(
                "body \"{}\" buckles: its largest compression, {force} N at t = {}, is {factor} times the load of {load} N under which \
                 a bar with pinned ends does (Euler)",
                system.bodies[body].name,
                system.display.time(worst[0])
            )
        })
    })
}

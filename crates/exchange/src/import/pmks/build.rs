//! The model of a drawing.

use linkdyn_model::GROUND;
use serde_json::{Value, json};

use super::super::Imported;
use super::super::pins::{self, At};
use super::drawing::{Bar, Drawing, Index, Load, Pin, Slot, Units};
use crate::draft::{Draft, Entry, number, numbers};
use crate::source::{LeftOut, Refused};

/// PMKS+ reckons with it, whatever the unit \[m/s²\].
const GRAVITY: f64 = 9.81;

/// A coordinate in a link is rounded to thousandths, a direction by that at both ends of its slot.
const ROUNDING: f64 = 2e-3;

/// The model, and what of the drawing it lacks.
pub(super) fn draft(file: &str, drawing: Drawing) -> Result<Imported, Refused> {
    let index = drawing.checked()?;
    let mut build = Build {
        draft: Draft {
            name: pins::titled(file, "Mechanism from PMKS+"),
            source: "PMKS+, a share link".into(),
            ..Draft::default()
        },
        left_out: drawing.left_out.clone(),
        bodies: vec![None; drawing.links.len()],
        drawing: &drawing,
        index: &index,
    };
    build.units();
    build.links();
    let machines = build.machines();
    let mut ends = Vec::new();
    let mut driven = vec![false; drawing.links.len()];
    for joint in &drawing.joints {
        let meets = build.meets(joint);
        let machine = meets.links.first().map(|&link| machines[link]);
        let drives = joint.is_input && {
            let is_first =
                machine.is_none_or(|machine| !std::mem::replace(&mut driven[machine], true));
            if !is_first {
                build.lacks(
                    format!("joint {}", joint.name),
                    "a second input of one linkage: the first drives it",
                );
            }
            is_first
        };
        let end = match &joint.slide {
            None => build.pin(joint, &meets, drives),
            Some(slide) => build.slide(joint, slide, &meets, drives),
        };
        ends.extend(end);
        if let Some(body) = meets
            .bodies
            .iter()
            .find(|body| *body != GROUND && joint.is_traced)
        {
            let point = pins::point(&mut build.draft, body, &joint.name, joint.at);
            build.draft.points.push(point);
        }
    }
    for load in &drawing.loads {
        build.load(load);
    }
    let has_masses = build.has_masses();
    pins::analysis(
        &mut build.draft,
        ends.into_iter().reduce(f64::max),
        has_masses,
    );
    Ok(Imported {
        draft: build.draft,
        left_out: build.left_out,
    })
}

struct Build<'d> {
    draft: Draft,
    left_out: Vec<LeftOut>,
    /// The body of each link; none where it is part of another.
    bodies: Vec<Option<String>>,
    drawing: &'d Drawing,
    index: &'d Index,
}

/// What meets in a joint, each once: the moving links, and the bodies, the ground first.
struct Meets {
    links: Vec<usize>,
    bodies: Vec<String>,
}

impl Build<'_> {
    fn lacks(&mut self, place: impl Into<String>, what: impl Into<String>) {
        self.left_out.push(LeftOut {
            place: place.into(),
            what: what.into(),
        });
    }

    fn has_masses(&self) -> bool {
        let links = self
            .drawing
            .links
            .iter()
            .any(|link| link.mass > 0.0 && link.is_root);
        links || !self.drawing.loads.is_empty()
    }

    fn units(&mut self) {
        let named: &[(&str, &str)] = match self.drawing.units {
            Units::Inch => &[
                ("length", "in"),
                ("mass", "lb"),
                ("inertia", "lb*in^2"),
                ("force", "lbf"),
            ],
            Units::Centimetre => &[("length", "cm"), ("mass", "g"), ("inertia", "kg*cm^2")],
            Units::Metre => &[],
        };
        let units = named
            .iter()
            .map(|(what, unit)| ((*what).to_owned(), (*unit).into()));
        self.draft.units.extend(units);
        if self.drawing.has_gravity && self.has_masses() {
            self.draft.gravity = Some([0.0, -GRAVITY]);
        }
    }

    /// A body for each whole link that moves, with its points; a link with two pins on the ground is part of it.
    fn links(&mut self) {
        let is_frame = |link: &Bar| {
            let mut fixed = link.joints.iter().filter_map(|id| {
                let joint = &self.drawing.joints[self.index.joints[id]];
                (joint.is_ground && joint.slide.is_none()).then_some(joint.at)
            });
            fixed
                .next()
                .is_some_and(|first| fixed.any(|other| other != first))
        };
        let frames: Vec<bool> = self.drawing.links.iter().map(is_frame).collect();
        let has_masses = self.has_masses();
        // The ground stands first, as a person writes it.
        let grounded = self.drawing.joints.iter().filter(|joint| joint.is_ground);
        for joint in grounded {
            pins::point(&mut self.draft, GROUND, &joint.name, joint.at);
        }
        for (at, link) in self.drawing.links.iter().enumerate() {
            if !link.is_root || self.index.whole(&link.id) != at {
                continue;
            }
            let mut more = Entry::new();
            if has_masses {
                more.insert("mass".into(), number(link.mass));
                more.insert("inertia".into(), number(link.inertia));
            }
            if has_masses && link.mass > 0.0 {
                more.insert("com".into(), numbers(link.com));
            }
            let name = match frames[at] {
                true => GROUND.to_owned(),
                false => pins::body(&mut self.draft, &link.name, more),
            };
            if frames[at] {
                self.lacks(
                    format!("link {}", link.name),
                    "its mass: it is pinned to the ground twice, and so part of it",
                );
            }
            for id in &link.joints {
                let joint = &self.drawing.joints[self.index.joints[id]];
                pins::point(&mut self.draft, &name, &joint.name, joint.at);
            }
            self.bodies[at] = Some(name);
        }
    }

    /// The body of a whole link.
    fn body(&self, link: usize) -> &str {
        self.bodies[link].as_deref().unwrap_or(GROUND)
    }

    /// The link that has the slot of a joint.
    fn carrier(&self, joint: &Pin) -> Option<usize> {
        let [link, ..] = joint.slide.as_ref()?.on.as_ref()?;
        Some(self.index.whole(link))
    }

    fn meets(&self, joint: &Pin) -> Meets {
        let whole = self.drawing.links.iter().enumerate();
        let links = whole
            .filter(|(at, link)| self.bodies[*at].is_some() && link.joints.contains(&joint.id));
        let links: Vec<usize> = links.map(|(at, _)| at).collect();
        let mut bodies = Vec::new();
        if joint.is_ground && joint.slide.is_none() {
            bodies.push(GROUND.to_owned());
        }
        let grounds = links.iter().filter(|&&link| self.body(link) == GROUND);
        let moving = links.iter().filter(|&&link| self.body(link) != GROUND);
        for &link in grounds.chain(moving) {
            let body = self.body(link).to_owned();
            if !bodies.contains(&body) {
                bodies.push(body);
            }
        }
        Meets {
            links: links
                .into_iter()
                .filter(|&link| self.body(link) != GROUND)
                .collect(),
            bodies,
        }
    }

    /// The machine of each link: links that share a joint, even a pivot on the ground, are one.
    fn machines(&self) -> Vec<usize> {
        let mut machines: Vec<usize> = (0..self.drawing.links.len()).collect();
        fn root(machines: &mut [usize], mut at: usize) -> usize {
            while machines[at] != at {
                machines[at] = machines[machines[at]];
                at = machines[at];
            }
            at
        }
        for joint in &self.drawing.joints {
            let carrier = self
                .carrier(joint)
                .filter(|&link| self.body(link) != GROUND);
            let together: Vec<usize> = self.meets(joint).links.into_iter().chain(carrier).collect();
            for pair in together.windows(2) {
                let (a, b) = (root(&mut machines, pair[0]), root(&mut machines, pair[1]));
                machines[a] = b;
            }
        }
        (0..machines.len())
            .map(|at| root(&mut machines, at))
            .collect()
    }

    /// The velocity of an input, with its sign: against the clock is positive, and so is outward.
    fn velocity(&self, joint: &Pin, usual: f64) -> f64 {
        let signed = if self.drawing.is_clockwise {
            -usual
        } else {
            usual
        };
        joint.speed.unwrap_or(signed)
    }

    /// A pin; how long its motor takes for a turn, if it has one.
    fn pin(&mut self, joint: &Pin, meets: &Meets, drives: bool) -> Option<f64> {
        pins::pin(&mut self.draft, &joint.name, &meets.bodies, joint.at);
        if !drives {
            return None;
        }
        let place = format!("joint {}", joint.name);
        let [first, second, others @ ..] = &meets.bodies[..] else {
            self.lacks(place, "an input where no two bodies meet");
            return None;
        };
        if !others.is_empty() {
            self.lacks(
                &place,
                format!(
                    "an input where more than two bodies meet turns {second} relative to {first}"
                ),
            );
        }
        let velocity = self.velocity(joint, self.drawing.speed);
        if velocity == 0.0 {
            self.lacks(place, "an input that stands still: its velocity is 0");
        }
        pins::motor(
            &mut self.draft,
            second,
            first,
            &format!("{} rpm", number(velocity)),
        );
        (velocity != 0.0).then(|| 60.0 / velocity.abs())
    }

    /// A slide; how long its ram takes to the end of its slot, if it has one.
    fn slide(&mut self, joint: &Pin, slide: &Slot, meets: &Meets, drives: bool) -> Option<f64> {
        let place = format!("joint {}", joint.name);
        let carrier = self
            .carrier(joint)
            .map_or(GROUND, |link| self.body(link))
            .to_owned();
        let mut riders = meets
            .bodies
            .iter()
            .filter(|body| **body != carrier)
            .cloned();
        let Some(rider) = riders.next() else {
            self.lacks(place, "a slide with nothing that slides on it");
            return None;
        };
        let others: Vec<String> = riders.collect();
        let (axis, reach) = self.axis(joint, slide);
        // A point of a slot is where the pin was drawn, and not where it is later.
        let place = match slide.on.is_some() {
            true => format!("{}_slot", joint.name),
            false => joint.name.clone(),
        };
        let held = pins::point(&mut self.draft, &carrier, &place, joint.at);
        let [turning, sliding] = match slide.turns {
            true => ["revolute", "slot"],
            false => ["fixed", "prismatic"],
        };
        // A block with mass is a body of its own, which does not turn; otherwise what rides slides itself.
        let has_block = slide.mass > 0.0 && self.has_masses();
        let (block, kind) = match has_block {
            true => (self.block(joint, slide), "prismatic"),
            false => (rider.clone(), sliding),
        };
        let holds = pins::point(&mut self.draft, &block, &joint.name, joint.at);
        let name = pins::join(
            &mut self.draft,
            &joint.name,
            kind,
            [&held, &holds],
            pins::axis(axis),
        );
        for other in has_block.then_some(rider).into_iter().chain(others) {
            let rides = pins::point(&mut self.draft, &other, &joint.name, joint.at);
            pins::join(
                &mut self.draft,
                &joint.name,
                turning,
                [&holds, &rides],
                Entry::new(),
            );
        }
        if !drives {
            return None;
        }
        let velocity = self.velocity(joint, self.drawing.linear_speed);
        let unit = self.drawing.units.length();
        pins::ram(
            &mut self.draft,
            &name,
            &format!("{} {unit}/s", number(velocity)),
        );
        let way = match reach {
            Some([back, ahead]) => {
                if velocity > 0.0 {
                    ahead
                } else {
                    back
                }
            }
            None => self.size() / 4.0,
        };
        (velocity != 0.0 && way > 0.0).then(|| way / velocity.abs())
    }

    /// A block on a slide.
    fn block(&mut self, joint: &Pin, slide: &Slot) -> String {
        let more = Entry::from_iter([
            ("mass".to_owned(), number(slide.mass)),
            ("inertia".to_owned(), number(0.0)),
            ("com".to_owned(), numbers(joint.at)),
        ]);
        pins::body(&mut self.draft, &format!("{}_block", joint.name), more)
    }

    /// The axis of a slide, and how far it is to both ends of its slot.
    fn axis(&mut self, joint: &Pin, slide: &Slot) -> (Value, Option<[f64; 2]>) {
        let Some([link, a, b]) = &slide.on else {
            if slide.angle == 0.0 {
                return (json!([1, 0]), None);
            }
            let angle = number(slide.angle);
            return (
                json!([format!("=cos({angle} rad)"), format!("=sin({angle} rad)")]),
                None,
            );
        };
        let [from, to] = [a, b].map(|id| self.drawing.joints[self.index.joints[id]].at);
        let (along, back) = (less(to, from), less(joint.at, from));
        let length = along[0].hypot(along[1]);
        let place = format!("joint {}", joint.name);
        if length == 0.0 {
            self.lacks(
                place,
                format!("the direction of its slot: {a} and {b} are at one place"),
            );
            return (json!([1, 0]), None);
        }
        let off = ((along[0] * back[1] - along[1] * back[0]) / length).abs();
        if off > ROUNDING {
            let unit = self.drawing.units.length();
            self.lacks(
                place,
                format!("it stands {off:.3} {unit} beside the line of {link} through {a} and {b}: its slot goes through it"),
            );
        }
        let way = (along[0] * back[0] + along[1] * back[1]) / length;
        (numbers(along), Some([way, length - way]))
    }

    /// The larger side of the drawing.
    fn size(&self) -> f64 {
        let span = |k: usize| {
            let all = || self.drawing.joints.iter().map(|joint| joint.at[k]);
            all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
        };
        span(0).max(span(1))
    }

    fn load(&mut self, load: &Load) {
        let body = self.body(self.index.whole(&load.link)).to_owned();
        let place = format!("force {}", load.name);
        if body == GROUND {
            self.lacks(place, "it acts on the ground");
            return;
        }
        let [x, y] = less(load.to, load.from);
        let length = x.hypot(y);
        if length == 0.0 {
            self.lacks(place, "it has no direction");
            return;
        }
        let along = if load.is_outward {
            load.magnitude
        } else {
            -load.magnitude
        } / length;
        let at = pins::point(&mut self.draft, &body, &load.name, load.from);
        let mut force =
            json!({ "type": "force", "at": at, "vector": numbers([x * along, y * along]) });
        if load.is_local {
            force["frame"] = "body".into();
        }
        let name = Draft::named(&self.draft.forces, &load.name, "force");
        self.draft.forces.insert(name, force);
    }
}

fn less(a: At, b: At) -> At {
    [a[0] - b[0], a[1] - b[1]]
}

//! All names of results that a model can have, whatever it computes.

use super::bodies::{BODY, ElasticNames, of};
use super::catalogue::{Catalogue, JointNames, Load};
use super::facts::{ClearanceSum, EVENTS, Fact, Item, List};
use crate::dimension::{Dimension, Powers, powers};
use crate::error::Complaint;
use crate::expression::{Known, Place, Results};
use crate::suggest;

const POINT: [&str; 6] = ["x", "y", "vx", "vy", "ax", "ay"];

const JOINT: [(&str, Dimension); 12] = [
    ("fx", Dimension::Force),
    ("fy", Dimension::Force),
    ("torque", Dimension::Torque),
    ("ex", Dimension::Length),
    ("ey", Dimension::Length),
    ("eccentricity", Dimension::Length),
    ("penetration", Dimension::Length),
    ("normal_force", Dimension::Force),
    ("tangential_force", Dimension::Force),
    ("sliding_speed", Dimension::Velocity),
    ("tight", Dimension::Force),
    ("slack", Dimension::Force),
];

const SHAKING: [(&str, Dimension); 3] = [
    ("fx", Dimension::Force),
    ("fy", Dimension::Force),
    ("moment", Dimension::Torque),
];

/// Of forces: columns of those at a point, of torques, of springs and actuators, of torsion springs.
const LOAD: [&str; 3] = ["fx", "fy", "power"];
const TORQUE: [&str; 2] = ["torque", "power"];
const SPRING: [&str; 6] = ["length", "rate", "f", "fx", "fy", "power"];
/// Of springs and actuators with limits.
const STROKE: [&str; 7] = ["length", "rate", "f", "fx", "fy", "power", "stop"];
const MOTOR: [&str; 3] = ["torque", "power", "current"];
const CABLE: [&str; 4] = ["length", "rate", "f", "power"];
const TORSION: [&str; 4] = ["angle", "omega", "torque", "power"];
/// Of joints that turn, that slide, and of all.
const TURN: [&str; 2] = ["angle", "omega"];
const SLIDE: [&str; 2] = ["slide", "rate"];
const SIZE: [&str; 1] = ["f"];
/// Of cams.
const TOUCH: [&str; 4] = ["contact_x", "contact_y", "curvature", "pressure_angle"];

/// The dimension of what forces and joints show, by the last word of a name.
fn shown(word: &str) -> Option<Powers> {
    let dimension = match word {
        "length" | "slide" | "contact_x" | "contact_y" => Dimension::Length,
        "curvature" => return Some(powers(-1, 0, 0, 0)),
        "current" => return Some(Powers::default()),
        "rate" => Dimension::Velocity,
        "angle" | "pressure_angle" => Dimension::Angle,
        "omega" => Dimension::AngularVelocity,
        "f" | "fx" | "fy" | "stop" => Dimension::Force,
        "torque" => Dimension::Torque,
        "power" => return Some(powers(2, 1, -3, 0)),
        _ => return None,
    };
    Some(dimension.powers())
}

/// Of bodies with a cross-section: at each station, and along the whole axis.
const STATION: [(&str, Dimension); 3] = [
    ("axial_force", Dimension::Force),
    ("shear_force", Dimension::Force),
    ("bending_moment", Dimension::Torque),
];
const SECTION: [(&str, Dimension); 6] = [
    ("tension", Dimension::Force),
    ("compression", Dimension::Force),
    ("shear_force", Dimension::Force),
    ("bending_moment", Dimension::Torque),
    ("stress", Dimension::Stress),
    ("stress_at", Dimension::Length),
];

const TRANSMISSION: [&str; 2] = ["ratio", "advantage"];

const ENERGY: [&str; 4] = ["kinetic", "potential", "contact", "dissipated"];

impl JointNames {
    /// The last words of columns that it has if they are requested.
    fn shown(&self) -> impl Iterator<Item = &'static str> {
        let turn = TURN.into_iter().filter(|_| self.turns);
        let slide = SLIDE.into_iter().filter(|_| self.slides);
        let touch = TOUCH.into_iter().filter(|_| self.touches);
        turn.chain(slide).chain(SIZE).chain(touch)
    }
}

impl Catalogue {
    /// The name of the column that a name stands for: `t` is `time`, and `driver.motor` its value.
    pub fn column_name(&self, name: &str) -> String {
        match name.strip_prefix("driver.") {
            _ if name == "t" => "time".to_owned(),
            Some(driver) if self.drivers.iter().any(|one| one.0 == driver) => {
                format!("{name}.value")
            }
            _ if self.is_stretch(name) => format!("force.{name}"),
            Some(_) | None => name.to_owned(),
        }
    }

    /// Whether it is the length of a spring or an actuator, or its rate, without the first word: `shock.length`.
    pub(super) fn is_stretch(&self, name: &str) -> bool {
        let spring = name
            .rsplit_once('.')
            .filter(|(_, word)| ["length", "rate"].contains(word));
        spring.is_some_and(|(spring, _)| self.spring_turns(spring) == Some(false))
    }

    /// Whether it is the last word of columns of bodies.
    pub(crate) fn is_of_bodies(word: &str) -> bool {
        BODY.iter().any(|row| row.0 == word)
    }

    /// The number of a joint.
    fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// The dimension of a column that the model can have.
    fn column(&self, name: &str) -> Option<Powers> {
        let name = self.column_name(name);
        if name == "time" {
            return Some(Dimension::Time.powers());
        }
        let (owner, word) = name.rsplit_once('.')?;
        if self.bodies.iter().any(|body| body == owner)
            && let Some(found) = of(&BODY, word)
        {
            return Some(found);
        }
        if self.points.iter().any(|point| point == owner) && POINT.contains(&word) {
            return of(&BODY, word);
        }
        let mut links = self.elastic.iter();
        if let Some(found) = links.find_map(|one| one.column(owner, word)) {
            return Some(found);
        }
        match owner {
            "energy" if ENERGY.contains(&word) => return Some(powers(2, 1, -2, 0)),
            "shaking" => return of(&SHAKING, word),
            "transmission" => return self.transmitted(word),
            "state" => return self.state(word),
            "measure" => return self.measure(word, 0),
            "output" => {
                let output = self.outputs.iter().find(|one| one.0 == word)?;
                return output.1.as_ref().ok().copied();
            }
            _ => {}
        }
        match owner.split_once('.')? {
            ("joint", joint) => {
                let joint = &self.joints[self.joint(joint)?];
                match word {
                    "state" => Some(Powers::default()),
                    word if joint.shown().any(|one| one == word) => shown(word),
                    "friction" | "stop" if joint.slides => Some(Dimension::Force.powers()),
                    "friction" | "stop" => Some(Dimension::Torque.powers()),
                    word => of(&JOINT, word),
                }
            }
            ("driver", driver) => {
                let (_, dimension) = self.drivers.iter().find(|one| one.0 == driver)?;
                match (word, (*dimension)?) {
                    ("value", dimension) => Some(dimension.powers()),
                    ("effort", Dimension::Length) => Some(Dimension::Force.powers()),
                    ("effort", _) => Some(Dimension::Torque.powers()),
                    (_, _) => None,
                }
            }
            ("measure", measure) if word == "rate" => self.measure(measure, 1),
            ("section", body) => {
                let (_, stations) = self.sections.iter().find(|one| one.0 == body)?;
                let of_station = || {
                    let (kind, station) = word.rsplit_once('_')?;
                    let station: usize = station.parse().ok()?;
                    (1..=*stations).contains(&station).then_some(())?;
                    of(&STATION, kind)
                };
                match word {
                    "buckling" => Some(Powers::default()),
                    word => of(&SECTION, word).or_else(of_station),
                }
            }
            ("state", state) if word == "rate" => Some(self.state(state)?.per_second(1)),
            ("force", force) => {
                let (_, words) = self.force_words().find(|(name, _)| *name == force)?;
                words.contains(&word).then(|| shown(word))?
            }
            ("transmission", joint) => {
                self.joint(joint).filter(|_| self.transmission.is_some())?;
                (word == "angle").then(|| Dimension::Angle.powers())
            }
            (_, _) => None,
        }
    }

    /// The dimension of a measure or a derivative of it by time.
    fn measure(&self, name: &str, order: i32) -> Option<Powers> {
        let dimension = match self.measures_angle(name)? {
            true => Dimension::Angle,
            false => Dimension::Length,
        };
        Some(dimension.powers().per_second(order))
    }

    /// Names of forces, and the last words of their columns.
    fn force_words(&self) -> impl Iterator<Item = (&str, &'static [&'static str])> {
        let of = |turn: &'static [_], push: &'static [_]| {
            move |one: &'_ Load| if one.turns { turn } else { push }
        };
        let (load, spring) = (of(&TORQUE, &LOAD), of(&TORSION, &SPRING));
        let stroke = of(&TORSION, &STROKE);
        let loads = self
            .loads
            .iter()
            .map(move |one| (one.name.as_str(), load(one)));
        let springs = self.springs.iter();
        let cables = self.cables.iter();
        let springs = springs.map(move |one| {
            let words = if one.stops { stroke(one) } else { spring(one) };
            (one.name.as_str(), words)
        });
        loads
            .chain(springs)
            .chain(cables.map(|one| (one.name.as_str(), &CABLE[..])))
            .chain(
                self.motors
                    .iter()
                    .map(|one| (one.name.as_str(), &MOTOR[..])),
            )
    }

    /// The dimension of ratio or advantage.
    fn transmitted(&self, word: &str) -> Option<Powers> {
        let [driver, output] = self.transmission?;
        // metres per radian of the output for the driver
        let lengths = match (driver, output) {
            (Dimension::Angle, Dimension::Length) => 1,
            (Dimension::Length, Dimension::Angle) => -1,
            (_, _) => 0,
        };
        match word {
            "ratio" => Some(powers(lengths, 0, 0, -lengths)),
            "advantage" => Some(powers(-lengths, 0, 0, 0)),
            _ => None,
        }
    }

    /// A number of the whole run, or what there is of each contact or event.
    fn other(&self, name: &str) -> Option<Known> {
        let fact = |fact: Fact| Known {
            place: Place::Fact(fact),
            powers: fact.powers(),
        };
        if let Some(&found) = Fact::OF_RUNS.iter().find(|one| one.name() == name) {
            return Some(fact(found));
        }
        let (owner, word) = name.rsplit_once('.')?;
        let item = |list: List, item: Item| Known {
            place: Place::Item(list, item),
            powers: item.row().1,
        };
        let of_contact = || {
            Item::OF_CONTACTS
                .into_iter()
                .find(|one| one.row().0 == word)
        };
        match owner.split_once('.') {
            None if owner == "contacts" => Some(item(List::Contacts(None), of_contact()?)),
            None if owner == "events" => {
                let kind = EVENTS.iter().position(|kind| *kind == word)?;
                Some(item(List::Events(kind), Item::Time))
            }
            Some(("contacts", joint)) => {
                let joint = self.joint(joint)?;
                Some(item(List::Contacts(Some(joint)), of_contact()?))
            }
            Some(("clearances", joint)) => {
                let joint = self.joint(joint)?;
                if word == "wear" {
                    return Some(item(List::Wear(joint), Item::Wear));
                }
                let mut sums = ClearanceSum::ALL.into_iter();
                let sum = sums.find(|sum| sum.row().0 == word)?;
                Some(fact(Fact::Clearance(joint, sum)))
            }
            None | Some(_) => None,
        }
    }

    /// Names that a slip of the pen may have meant.
    fn names(&self) -> Vec<String> {
        let mut names = vec!["time".to_owned()];
        let bodies = self.bodies.iter();
        names.extend(bodies.flat_map(|body| BODY.map(|row| format!("{body}.{}", row.0))));
        let points = self.points.iter();
        names.extend(points.flat_map(|point| POINT.map(|word| format!("{point}.{word}"))));
        for joint in &self.joints {
            let name = &joint.name;
            let words = JOINT.map(|row| row.0);
            let words = words
                .into_iter()
                .chain(["friction", "state", "stop"])
                .chain(joint.shown());
            names.extend(words.map(|word| format!("joint.{name}.{word}")));
            let sums = ClearanceSum::ALL.map(|sum| sum.row().0);
            let sums = sums.into_iter().chain(["wear"]);
            names.extend(sums.map(|word| format!("clearances.{name}.{word}")));
        }
        for (driver, _) in &self.drivers {
            names.extend(["value", "effort"].map(|word| format!("driver.{driver}.{word}")));
        }
        names.extend(ENERGY.map(|word| format!("energy.{word}")));
        names.extend(SHAKING.map(|row| format!("shaking.{}", row.0)));
        for (name, words) in self.force_words() {
            names.extend(words.iter().map(|word| format!("force.{name}.{word}")));
        }
        for (body, stations) in &self.sections {
            let words = SECTION.map(|row| row.0).into_iter().chain(["buckling"]);
            names.extend(words.map(|word| format!("section.{body}.{word}")));
            let of = |station| STATION.map(|row| format!("section.{body}.{}_{station}", row.0));
            names.extend((1..=*stations).flat_map(of));
        }
        names.extend(self.elastic.iter().flat_map(ElasticNames::names));
        names.extend(self.outputs.iter().map(|one| format!("output.{}", one.0)));
        names.extend(self.measured());
        for (state, _) in &self.states {
            names.extend([format!("state.{state}"), format!("state.{state}.rate")]);
        }
        if self.transmission.is_some() {
            names.extend(TRANSMISSION.map(|word| format!("transmission.{word}")));
            let joints = self.joints.iter();
            names.extend(joints.map(|joint| format!("transmission.{}.angle", joint.name)));
        }
        names.extend(Item::OF_CONTACTS.map(|item| format!("contacts.{}", item.row().0)));
        names.extend(EVENTS.map(|kind| format!("events.{kind}")));
        names.extend(Fact::OF_RUNS.map(|fact| fact.name().to_owned()));
        names
    }
}

/// Columns have no places here: which ones a run has is known when it is compiled.
impl Results for Catalogue {
    fn find(&self, name: &str) -> Option<Known> {
        let column = self.column(name).map(|powers| Known {
            place: Place::Row(0),
            powers,
        });
        column.or_else(|| self.other(name))
    }

    fn missing(&self, name: &str, parameters: &[String]) -> Complaint {
        let said = Complaint::new(
            "",
            format!(
                "there is no column, parameter or number {:?}",
                crate::node::excerpt(name)
            ),
        );
        let output = name.strip_prefix("output.");
        let output = self.outputs.iter().find(|one| Some(&*one.0) == output);
        if let Some((_, Err(fault))) = output {
            let message = format!("{name} has no value: {}", fault.message);
            return Complaint {
                hint: fault.hint.clone(),
                ..Complaint::new("", message)
            };
        }
        let owner = name.rsplit_once('.').map_or("", |(owner, _)| owner);
        if self.unwanted.iter().any(|point| point == owner) {
            let said = Complaint::new(
                "",
                format!("the motion of {owner} is not among the results"),
            );
            return said.hint(format!("write {owner:?} into \"points\""));
        }
        if name.contains('[') {
            return said.hint("the name of a column goes without its unit");
        }
        let names = self.names();
        let all = names.iter().chain(parameters).map(String::as_str);
        match suggest::nearest(name, all) {
            Some(near) => said.hint(format!("did you mean {:?}?", quoted(near))),
            None => said.hint(
                "as in rod.angle, joint.a.fx, driver.motor.effort or t; a name with other signs than letters, digits and _ \
                 stands in single quotes",
            ),
        }
    }
}

/// A name as an expression writes it.
fn quoted(name: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    match name.chars().all(plain) {
        true => name.to_owned(),
        false => format!("'{name}'"),
    }
}

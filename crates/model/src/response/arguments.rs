//! The names of what moves, for formulas.

use super::Catalogue;
use super::catalogue::Load;
use crate::dimension::{Dimension, Powers};
use crate::formula::{Argument, Coordinate, Order};
use crate::point::PointRef;

const BODY: [(&str, Coordinate, Order); 6] = [
    ("x", Coordinate::X, Order::Value),
    ("y", Coordinate::Y, Order::Value),
    ("angle", Coordinate::Angle, Order::Value),
    ("vx", Coordinate::X, Order::Rate),
    ("vy", Coordinate::Y, Order::Rate),
    ("omega", Coordinate::Angle, Order::Rate),
];
/// Of joints and torsion springs.
const TURN: [(&str, Order); 2] = [("angle", Order::Value), ("omega", Order::Rate)];
const SLIDE: [(&str, Order); 2] = [("slide", Order::Value), ("rate", Order::Rate)];
/// Of springs, actuators and cables.
const STRETCH: [(&str, Order); 2] = [("length", Order::Value), ("rate", Order::Rate)];

fn order(words: [(&str, Order); 2], word: &str) -> Option<Order> {
    let row = words.iter().find(|row| row.0 == word)?;
    Some(row.1)
}

impl Catalogue {
    /// What a name stands for; `None` if nothing that moves is called so.
    pub(crate) fn argument(&self, name: &str) -> Option<Argument> {
        if name == "t" || name == "time" {
            return Some(Argument::Time);
        }
        let (owner, word) = name.rsplit_once('.')?;
        let row = || BODY.iter().find(|row| row.0 == word);
        if self.bodies.iter().any(|body| body == owner)
            && let Some(&(_, coordinate, order)) = row()
        {
            return Some(Argument::Body(owner.to_owned(), coordinate, order));
        }
        if self
            .points
            .iter()
            .chain(&self.unwanted)
            .any(|point| point == owner)
            && let Some(&(_, coordinate, order)) = row()
            && coordinate != Coordinate::Angle
        {
            let point = PointRef::try_from(owner.to_owned()).ok()?;
            return Some(Argument::Point(point, coordinate, order));
        }
        if self.is_stretch(name) {
            return self.argument(&format!("force.{name}"));
        }
        let known = |name: &str| self.drives(name).is_some();
        match name.split_once('.')? {
            ("driver", driver) if known(driver) => Some(Argument::Driver(driver.to_owned())),
            ("input", input) if self.input(input).is_some() => {
                Some(Argument::Input(input.to_owned()))
            }
            ("state", state) if self.state(state).is_some() => {
                Some(Argument::State(state.to_owned()))
            }
            ("driver", rest) => {
                let driver = rest.strip_suffix(".value").filter(|driver| known(driver))?;
                Some(Argument::Driver(driver.to_owned()))
            }
            ("measure", rest) => {
                let (name, order) = match rest.strip_suffix(".rate") {
                    Some(name) => (name, Order::Rate),
                    None => (rest, Order::Value),
                };
                self.measures_angle(name)?;
                Some(Argument::Measure(name.to_owned(), order))
            }
            ("joint", rest) => {
                let (joint, word) = rest.rsplit_once('.')?;
                let own = self.joints.iter().find(|one| one.name == joint)?;
                let slide = order(SLIDE, word).filter(|_| own.slides);
                let turn = order(TURN, word).filter(|_| own.turns);
                let slide = slide.map(|order| Argument::Slide(joint.to_owned(), order));
                slide.or_else(|| Some(Argument::Turn(joint.to_owned(), turn?)))
            }
            ("force", rest) => {
                let (spring, word) = rest.rsplit_once('.')?;
                let words = if self.spring_turns(spring)? {
                    TURN
                } else {
                    STRETCH
                };
                Some(Argument::Spring(spring.to_owned(), order(words, word)?))
            }
            (_, _) => None,
        }
    }

    /// The dimension of an input, where there is one of this name.
    pub(crate) fn input(&self, name: &str) -> Option<Powers> {
        Some(self.inputs.iter().find(|one| one.0 == name)?.1)
    }

    /// The dimension of a state, where there is one of this name.
    pub(crate) fn state(&self, name: &str) -> Option<Powers> {
        Some(self.states.iter().find(|one| one.0 == name)?.1)
    }

    /// Whether a measure is an angle; `None` if there is no such measure.
    pub(crate) fn measures_angle(&self, name: &str) -> Option<bool> {
        Some(self.measures.iter().find(|one| one.0 == name)?.1)
    }

    /// The names of measures and their rates.
    pub(super) fn measured(&self) -> impl Iterator<Item = String> {
        let names = self.measures.iter();
        names.flat_map(|(name, _)| [format!("measure.{name}"), format!("measure.{name}.rate")])
    }

    /// The tables, with the dimensions of their columns.
    pub(crate) fn tables(&self) -> &[(String, [Powers; 2])] {
        &self.tables
    }

    /// Of a driver, where there is one of this name and it is known what it drives.
    pub(crate) fn drives(&self, name: &str) -> Option<Dimension> {
        self.drivers.iter().find(|one| one.0 == name)?.1
    }

    /// Springs, actuators and cables: what has a length or an angle.
    fn stretching(&self) -> impl Iterator<Item = &Load> {
        self.springs.iter().chain(&self.cables)
    }

    /// Whether a spring is one of torsion; `None` if there is no such spring.
    pub(crate) fn spring_turns(&self, name: &str) -> Option<bool> {
        let spring = self.stretching().find(|one| one.name == name)?;
        Some(spring.turns)
    }

    /// Names that a slip of the pen may have meant.
    pub(crate) fn arguments(&self) -> Vec<String> {
        let mut names = vec!["time".to_owned()];
        for body in &self.bodies {
            names.extend(BODY.map(|row| format!("{body}.{}", row.0)));
        }
        for point in self.points.iter().chain(&self.unwanted) {
            let words = BODY.iter().filter(|row| row.1 != Coordinate::Angle);
            names.extend(words.map(|row| format!("{point}.{}", row.0)));
        }
        for joint in &self.joints {
            let slides = SLIDE.iter().filter(|_| joint.slides);
            let words = TURN.iter().filter(|_| joint.turns).chain(slides);
            names.extend(words.map(|row| format!("joint.{}.{}", joint.name, row.0)));
        }
        for spring in self.stretching() {
            let words = if spring.turns { TURN } else { STRETCH };
            names.extend(words.map(|row| format!("force.{}.{}", spring.name, row.0)));
        }
        names.extend(self.drivers.iter().map(|one| format!("driver.{}", one.0)));
        names.extend(self.inputs.iter().map(|one| format!("input.{}", one.0)));
        names.extend(self.states.iter().map(|one| format!("state.{}", one.0)));
        names.extend(self.measured());
        names
    }
}

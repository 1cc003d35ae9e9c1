//! What a model consists of, as far as results are named after it.

use super::bodies::ElasticNames;
use crate::dimension::{Dimension, Powers};
use crate::error::Complaint;
use crate::node::{Kind, Node};
use crate::ratio::OutputText;
use crate::{DriverKind, ForceKind, GROUND, JointKind, Model};

/// What a model consists of, as far as results are named after it.
#[derive(Debug, Clone, Default)]
pub struct Catalogue {
    pub(crate) bodies: Vec<String>,
    /// Points whose motion is wanted, `body.point`.
    pub(super) points: Vec<String>,
    /// All other points.
    pub(super) unwanted: Vec<String>,
    pub(super) joints: Vec<JointNames>,
    /// With what each drives.
    pub(super) drivers: Vec<(String, Option<Dimension>)>,
    pub(super) loads: Vec<Load>,
    pub(super) springs: Vec<Load>,
    pub(super) cables: Vec<Load>,
    pub(super) motors: Vec<Load>,
    /// With the dimension of each, or why it can't be read.
    pub(super) outputs: Vec<(String, Result<Powers, Complaint>)>,
    /// Tables with the dimensions of their columns.
    pub(super) tables: Vec<(String, [Powers; 2])>,
    /// Inputs with their dimensions.
    pub(super) inputs: Vec<(String, Powers)>,
    /// States with their dimensions.
    pub(super) states: Vec<(String, Powers)>,
    /// Measures, and whether each is an angle.
    pub(super) measures: Vec<(String, bool)>,
    /// Bodies with a cross-section, and their numbers of stations.
    pub(super) sections: Vec<(String, usize)>,
    /// Bodies that bend.
    pub(super) elastic: Vec<ElasticNames>,
    /// What drives and what is driven, where the analysis wants a transmission.
    pub(super) transmission: Option<[Dimension; 2]>,
}

#[derive(Debug, Clone)]
pub(super) struct Load {
    pub(super) name: String,
    /// A torque, not a force; of a spring, one of torsion.
    pub(super) turns: bool,
    /// Its stroke has an end.
    pub(super) stops: bool,
}

#[derive(Debug, Clone)]
pub(super) struct JointNames {
    pub(super) name: String,
    /// Whether it slides.
    pub(super) slides: bool,
    /// Whether its bodies turn against each other about its points.
    pub(super) turns: bool,
    /// Whether it is a cam.
    pub(super) touches: bool,
}

impl Catalogue {
    /// Of a typed model.
    pub fn of(model: &Model) -> Self {
        let wanted: Vec<String> = model.points.iter().map(ToString::to_string).collect();
        let bodies = model.bodies.iter().filter(|(name, _)| *name != GROUND);
        let mut catalogue = Catalogue {
            elastic: ElasticNames::of(model),
            ..Catalogue::default()
        };
        for (name, body) in bodies {
            catalogue.body(name, body.points.keys().map(String::as_str), &wanted);
            let section = body.section.as_deref();
            let section = section.map(|section| (name.clone(), section.stations.unwrap_or(5)));
            catalogue.sections.extend(section);
        }
        for (name, joint) in &model.joints {
            catalogue.joints.push(JointNames {
                name: name.clone(),
                slides: joint.kind.guide().is_some(),
                turns: joint.kind.turns(),
                touches: matches!(joint.kind, JointKind::Cam(_)),
            });
        }
        for (name, driver) in &model.drivers {
            let dimension = match driver.kind {
                DriverKind::Rotation { .. } => Dimension::Angle,
                DriverKind::Translation { .. }
                | DriverKind::Length { .. }
                | DriverKind::Point { .. } => Dimension::Length,
            };
            catalogue.drivers.push((name.clone(), Some(dimension)));
        }
        for (name, force) in &model.forces {
            let (list, turns) = match force.kind {
                ForceKind::Load { .. } => (&mut catalogue.loads, false),
                ForceKind::Torque { .. } => (&mut catalogue.loads, true),
                ForceKind::DcMotor { .. } => (&mut catalogue.motors, true),
                ForceKind::Spring { .. }
                | ForceKind::Actuator { .. }
                | ForceKind::GasSpring { .. }
                | ForceKind::Cylinder { .. } => (&mut catalogue.springs, false),
                ForceKind::TorsionSpring { .. } => (&mut catalogue.springs, true),
                ForceKind::Cable { .. } => (&mut catalogue.cables, false),
            };
            let name = name.clone();
            list.push(Load {
                name,
                turns,
                stops: force.limits().is_some(),
            });
        }
        let analysis = model.analysis.as_ref();
        if let Some(wanted) = analysis.and_then(|analysis| analysis.transmission.as_ref()) {
            let slides = model.joints.values().any(|joint| {
                let bodies = [&joint.between[0].body, &joint.between[1].body];
                matches!(joint.kind, JointKind::Prismatic { .. })
                    && is_guide(bodies.map(String::as_str), &wanted.output)
            });
            catalogue.transmit(wanted.driver.as_deref(), slides);
        }
        let measures = model.measures.iter();
        let measures = measures.map(|(name, measure)| (name.clone(), measure.is_angle()));
        catalogue.measures = measures.collect();
        let outputs = model.outputs.iter();
        catalogue.put_out(outputs.map(|(name, text)| (name.as_str(), text.as_str())));
        let tables = model.tables.iter();
        let tables = tables.map(|(name, table)| {
            // the gate has complained of what is no unit
            (name.clone(), table.columns().unwrap_or_default())
        });
        let powers = |unit: &str| crate::table::unit(unit).map(|unit| unit.powers);
        let inputs = model.inputs.iter();
        let inputs =
            inputs.map(|(name, input)| (name.clone(), powers(&input.unit).unwrap_or_default()));
        let states = model.states.iter();
        let states =
            states.map(|(name, state)| (name.clone(), powers(&state.unit).unwrap_or_default()));
        catalogue
            .with_tables(tables.collect())
            .with_inputs(inputs.collect())
            .with_states(states.collect())
    }

    /// The same with inputs.
    pub(crate) fn with_inputs(self, inputs: Vec<(String, Powers)>) -> Self {
        Catalogue { inputs, ..self }
    }

    /// The same with states.
    pub(crate) fn with_states(self, states: Vec<(String, Powers)>) -> Self {
        Catalogue { states, ..self }
    }

    /// The same with tables.
    pub(crate) fn with_tables(self, tables: Vec<(String, [Powers; 2])>) -> Self {
        Catalogue { tables, ..self }
    }

    /// Of a file, before it is a model.
    pub(crate) fn of_file(root: &Node) -> Self {
        let mut catalogue = Catalogue::default();
        let members = |key: &str| match root.get(key).map(|node| &node.kind) {
            Some(Kind::Object(members)) => members.iter().collect(),
            _ => Vec::new(),
        };
        let kind = |node: &Node| node.get("type").and_then(Node::as_str).map(str::to_owned);
        let wanted: Vec<String> = match root.get("points").map(|node| &node.kind) {
            Some(Kind::Array(items)) => items
                .iter()
                .filter_map(Node::as_str)
                .map(str::to_owned)
                .collect(),
            _ => Vec::new(),
        };
        for (name, member) in members("bodies") {
            if name == GROUND {
                continue;
            }
            let points = match member.node.get("points").map(|node| &node.kind) {
                Some(Kind::Object(points)) => points.keys().map(String::as_str).collect(),
                _ => Vec::new(),
            };
            catalogue.body(name, points.into_iter(), &wanted);
            catalogue
                .elastic
                .extend(ElasticNames::of_file(name, &member.node));
            let section = member.node.get("section").map(|section| {
                let stations = match section.get("stations").map(|node| &node.kind) {
                    Some(Kind::Number(number)) => number.as_u64(),
                    _ => None,
                };
                let stations = stations.and_then(|count| usize::try_from(count).ok());
                (name.clone(), stations.unwrap_or(5))
            });
            catalogue.sections.extend(section);
        }
        for (name, member) in members("joints") {
            let slides = matches!(kind(&member.node).as_deref(), Some("prismatic" | "slot"));
            let turns = matches!(kind(&member.node).as_deref(), Some("revolute" | "slot"));
            catalogue.joints.push(JointNames {
                name: name.clone(),
                slides,
                turns,
                touches: kind(&member.node).as_deref() == Some("cam"),
            });
        }
        for (name, member) in members("drivers") {
            let dimension = match kind(&member.node).as_deref() {
                Some("rotation") => Some(Dimension::Angle),
                Some("translation" | "length" | "point") => Some(Dimension::Length),
                _ => None,
            };
            catalogue.drivers.push((name.clone(), dimension));
        }
        for (name, member) in members("forces") {
            let (list, turns) = match kind(&member.node).as_deref() {
                Some("force") => (&mut catalogue.loads, false),
                Some("torque") => (&mut catalogue.loads, true),
                Some("dc_motor") => (&mut catalogue.motors, true),
                Some("spring" | "actuator" | "gas_spring" | "cylinder") => {
                    (&mut catalogue.springs, false)
                }
                Some("torsion_spring") => (&mut catalogue.springs, true),
                Some("cable") => (&mut catalogue.cables, false),
                _ => continue,
            };
            let stops = member.node.get("limits").is_some() || member.node.get("stroke").is_some();
            let name = name.clone();
            list.push(Load { name, turns, stops });
        }
        let wanted = root
            .get("analysis")
            .and_then(|analysis| analysis.get("transmission"));
        if let Some(wanted) = wanted {
            let word = |key: &str| wanted.get(key).and_then(Node::as_str);
            let output = word("output").unwrap_or_default();
            let slides = members("joints").iter().any(|(_, member)| {
                let between = match member.node.get("between").map(|node| &node.kind) {
                    Some(Kind::Array(ends)) => ends.as_slice(),
                    _ => &[],
                };
                let mut bodies = between.iter().filter_map(Node::as_str);
                let mut body = || bodies.next().and_then(|end| Some(end.split_once('.')?.0));
                let bodies = [body().unwrap_or_default(), body().unwrap_or_default()];
                kind(&member.node).as_deref() == Some("prismatic") && is_guide(bodies, output)
            });
            catalogue.transmit(word("driver"), slides);
        }
        let measures = members("measures").into_iter();
        let measures = measures.map(|(name, one)| (name.clone(), one.node.get("angle").is_some()));
        catalogue.measures = measures.collect();
        let outputs = members("outputs").into_iter();
        catalogue
            .put_out(outputs.filter_map(|(name, one)| Some((name.as_str(), one.node.as_str()?))));
        catalogue
    }

    /// Outputs with their texts.
    fn put_out<'a>(&mut self, outputs: impl Iterator<Item = (&'a str, &'a str)>) {
        for (name, text) in outputs {
            let powers = OutputText::read(text, self).map(|output| output.powers());
            self.outputs.push((name.to_owned(), powers));
        }
    }

    /// A transmission from a driver, or the only one there is, to a body that slides or turns.
    fn transmit(&mut self, driver: Option<&str>, slides: bool) {
        let mut drivers = self.drivers.iter();
        let known = drivers.find(|one| driver.is_none_or(|driver| one.0 == driver));
        let output = if slides {
            Dimension::Length
        } else {
            Dimension::Angle
        };
        self.transmission = known.and_then(|one| Some([one.1?, output]));
    }

    fn body<'a>(&mut self, name: &str, points: impl Iterator<Item = &'a str>, wanted: &[String]) {
        self.bodies.push(name.to_owned());
        for point in points {
            let point = format!("{name}.{point}");
            match wanted.contains(&point) {
                true => self.points.push(point),
                false => self.unwanted.push(point),
            }
        }
    }
}

/// Whether a guide between two bodies lets this one slide on ground.
fn is_guide(bodies: [&str; 2], output: &str) -> bool {
    bodies == [GROUND, output] || bodies == [output, GROUND]
}

//! Names that must exist.

use std::collections::HashMap;

use indexmap::IndexMap;

use super::{ENOUGH, Rules};
use crate::error::Complaint;
use crate::shape::Named;
use crate::{GROUND, Model, suggest};

/// Something that is named in a model.
#[derive(Debug, Clone, Copy)]
pub(super) enum Reference<'t> {
    /// A point, `body.point`.
    Point(&'t str),
    /// A body, a joint or a driver.
    Name(Named, &'t str),
}

/// Complains where a text names nothing; each with its path.
pub(super) fn references(rules: &mut Rules<'_>, named: &[(String, Reference<'_>)]) {
    let bodies = rules.model.bodies.keys();
    let mut look = Names {
        model: rules.model,
        dotted: { bodies }
            .filter(|name| name.contains('.'))
            .map(String::as_str)
            .collect(),
        rules,
    };
    for (path, reference) in named {
        match *reference {
            Reference::Point(text) => look.point(path, text),
            Reference::Name(kind, name) => look.name(path, kind, name),
        }
    }
    look.columns();
}

/// What was probably meant, else all there is.
fn did_you_mean<T>(word: &str, names: &IndexMap<String, T>, what: &str) -> String {
    match suggest::nearest(word, names.keys().map(String::as_str)) {
        Some(near) => format!("did you mean {near:?}?"),
        None => format!("{what}: {}", suggest::list(names.keys())),
    }
}

/// What a text without a dot is where a point is wanted.
pub fn no_point(model: &Model, path: &str, text: &str) -> Complaint {
    let hint = match model.bodies.get(text) {
        Some(body) => format!(
            "write it as body.point; the points of {text:?}: {}",
            suggest::list(body.points.keys())
        ),
        None => "write it as body.point, such as \"crank.A\"".into(),
    };
    Complaint::new(path, "this is no point of a body").hint(hint)
}

pub(super) struct Names<'r, 'm> {
    pub(super) model: &'m Model,
    /// Names of bodies that are refused for a dot in them.
    dotted: Vec<&'m str>,
    pub(super) rules: &'r mut Rules<'m>,
}

impl Names<'_, '_> {
    /// Whether it is not yet known what is wrong at a path.
    pub(super) fn is_open(&self, path: &str) -> bool {
        self.rules.complaints.len() < ENOUGH && !self.rules.holes.has(path)
    }

    pub(super) fn name(&mut self, path: &str, kind: Named, name: &str) {
        if !self.is_open(path) {
            return;
        }
        let model = self.model;
        let complaint = match kind {
            Named::Body if name == GROUND => None,
            Named::Body => match name.split_once('.') {
                Some((body, _)) if model.bodies.contains_key(body) => Some(
                    Complaint::new(path, "a body is expected, this is a point")
                        .hint(format!("write {body:?}")),
                ),
                Some(_) | None => self.missing(path, name, &model.bodies, "bodies", "body"),
            },
            Named::Joint => self.missing(path, name, &model.joints, "joints", "joint"),
            Named::Driver => self.missing(path, name, &model.drivers, "drivers", "driver"),
        };
        self.rules.complaints.extend(complaint);
    }

    /// Complains of a force that is not there.
    pub(super) fn force(&mut self, path: &str, name: &str) {
        let complaint = self.missing(path, name, &self.model.forces, "forces", "force");
        self.rules.complaints.extend(complaint);
    }

    fn missing<T>(
        &self,
        path: &str,
        name: &str,
        things: &IndexMap<String, T>,
        map: &str,
        what: &str,
    ) -> Option<Complaint> {
        if self.rules.holes.has(map) || things.contains_key(name) {
            return None;
        }
        let hint = did_you_mean(name, things, &format!("the {map}"));
        Some(Complaint::new(path, format!("there is no {what} {name:?}")).hint(hint))
    }

    pub(super) fn point(&mut self, path: &str, text: &str) {
        if self.is_open(path) && !self.rules.holes.has("bodies") {
            let complaint = self.missing_point(path, text);
            self.rules.complaints.extend(complaint);
        }
    }

    fn missing_point(&self, path: &str, text: &str) -> Option<Complaint> {
        // A body whose name is refused for its dot is not missed again.
        if self.dotted.iter().any(|name| text.starts_with(name)) {
            return None;
        }
        let bodies = &self.model.bodies;
        let (body, point) = text.split_once('.')?;
        let empty = IndexMap::new();
        let points = match bodies.get(body) {
            Some(found) => {
                if self.rules.holes.has(&format!("bodies.{body}.points")) {
                    return None;
                }
                &found.points
            }
            None if body == GROUND => {
                match bodies.keys().find(|name| name.eq_ignore_ascii_case(GROUND)) {
                    Some(name) => {
                        let hint = format!("the fixed body is written {GROUND:?}, not {name:?}");
                        return Some(
                            Complaint::new(path, format!("there is no body {GROUND:?}")).hint(hint),
                        );
                    }
                    None => &empty,
                }
            }
            None => {
                let hint = did_you_mean(body, bodies, "the bodies");
                return Some(Complaint::new(path, format!("there is no body {body:?}")).hint(hint));
            }
        };
        let is_begun = |name: &String| name.contains('.') && point.starts_with(name.as_str());
        if points.contains_key(point) || points.keys().any(is_begun) {
            return None;
        }
        let mut hint = format!("its points: {}", suggest::list(points.keys()));
        if let Some(near) =
            suggest::nearest(point, points.keys().map(String::as_str)).filter(|_| points.len() > 1)
        {
            hint = format!("did you mean {:?}? {hint}", format!("{body}.{near}"));
        }
        Some(Complaint::new(path, format!("body {body:?} has no point {point:?}")).hint(hint))
    }
}

/// Initial values are of bodies that move.
pub(super) fn initial(rules: &mut Rules<'_>) {
    let model = rules.model;
    if rules.holes.has("bodies") {
        return;
    }
    for name in model.initial.keys() {
        let path = format!("initial.{name}");
        if name == GROUND {
            let message = "ground is fixed, it has no initial values";
            rules.complaints.push(Complaint::new(path, message));
        } else if !model.bodies.contains_key(name) {
            let hint = did_you_mean(name, &model.bodies, "the bodies");
            rules.complain(path, format!("there is no body {name:?}"), hint);
        }
    }
}

/// No point is wanted twice.
pub(super) fn wanted_points(rules: &mut Rules<'_>) {
    let model = rules.model;
    let mut seen = HashMap::new();
    for (index, point) in model.points.iter().enumerate() {
        let path = format!("points[{index}]");
        if rules.holes.has(&path) {
            continue;
        }
        if let Some(first) = seen.insert((&point.body, &point.point), index) {
            let hint = format!("first as points[{first}]");
            rules.complain(path, "the point is listed twice", hint);
        }
    }
}

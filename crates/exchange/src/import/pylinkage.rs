//! Linkages of pylinkage.
//!
//! Three kinds of files that its versions wrote are read, told apart by their keys:
//!
//! | keys | versions | what stands in it |
//! | --- | --- | --- |
//! | `joints`, with `Static`, `Crank`, `Revolute`, `Fixed`, `Prismatic` | 0.7 to 0.9 | dyads: points, what they hang on, and distances |
//! | `joints` and `links` | from 0.8 | joints with places, links between them |
//! | `nodes` and `edges`, with places | 0.7 | a graph: points, and distances between them |
//!
//! Distances are the dimensions, and places the drawing. Where they agree the points of all bodies are the places, digit for digit;
//! where they do not, a body keeps its distances and its direction in the drawing, and the assembly brings the bodies together.

use std::collections::{BTreeSet, HashSet};

use indexmap::IndexMap;
use linkdyn_model::GROUND;
use serde_json::{Map, Value};

use super::Imported;
use super::pins::{self, At};
use crate::draft::{Draft, Entry, number, numbers};
use crate::source::{LeftOut, MOST_PARTS, Options, Refused};

/// Places agree with distances to this share of the larger side of the drawing: what rounding of doubles leaves, a thousandfold.
const AGREES: f64 = 1e-12;

/// The name of fixed points that have none.
const PIVOT: &str = "O";

/// Reads a linkage; `name` is that of the file.
pub(super) fn read(name: &str, text: &str, options: &Options) -> Result<Imported, Refused> {
    let value: Value = serde_json::from_str(text).map_err(|error| {
        let place = format!("line {}, column {}", error.line(), error.column());
        let cause = error.to_string();
        let cause = cause
            .split(" at line ")
            .next()
            .unwrap_or_default()
            .to_owned();
        Refused::new(
            place,
            cause,
            "write the file with json.dump or mechanism_to_json",
        )
    })?;
    let Value::Object(file) = value else {
        return Err(unknown("this is a list, and a linkage is an object"));
    };
    let mut linkage = DrawnLinkage::default();
    if file.contains_key("nodes") {
        graph(&mut linkage, &file)?;
    } else if file.contains_key("links") {
        mechanism(&mut linkage, &file)?;
    } else if file.contains_key("joints") {
        dyads(&mut linkage, &file)?;
    } else if file.contains_key("format") {
        return Err(Refused::new(
            "",
            "this has the key \"format\": it is a model already",
            "linkdyn check reads it",
        ));
    } else {
        return Err(unknown("it has neither joints nor nodes"));
    }
    let title = file
        .get("name")
        .and_then(Value::as_str)
        .filter(|name| !name.is_empty());
    linkage.imported(
        title.map_or_else(|| pins::titled(name, "Linkage of pylinkage"), str::to_owned),
        options,
    )
}

fn unknown(cause: &str) -> Refused {
    Refused::new(
        "",
        cause,
        "linkage_to_dict and mechanism_to_dict write what is read",
    )
}

/// Points, what is rigid between them, and what moves them.
#[derive(Default)]
struct DrawnLinkage {
    /// Names and places.
    nodes: IndexMap<String, At>,
    /// Whether a node is fixed.
    is_fixed: Vec<bool>,
    links: Vec<Rod>,
    /// The links of each node.
    links_of: Vec<Vec<usize>>,
    slides: Vec<Guide>,
    /// The link that turns, and how far in a step \[rad\].
    motors: Vec<(usize, f64)>,
    /// Steps until an arc ends.
    until: Option<f64>,
    /// Nodes whose places do not agree with distances, and by how much at most.
    misfits: BTreeSet<usize>,
    worst: f64,
    left_out: Vec<LeftOut>,
}

/// A rigid link: its name, and its nodes with their places in it.
struct Rod {
    name: String,
    nodes: Vec<(usize, At)>,
}

/// A node that slides on a line.
struct Guide {
    node: usize,
    line: Line,
}

enum Line {
    /// Of the ground, through a place in a direction.
    Fixed(At, At),
    /// Of a link, through two of its nodes.
    Of(usize, [usize; 2]),
}

impl DrawnLinkage {
    fn node(&mut self, name: &str, at: At, is_fixed: bool) -> Result<usize, Refused> {
        if self.nodes.len() >= MOST_PARTS {
            let cause = format!("more than {MOST_PARTS} joints are too many for a planar linkage");
            return Err(Refused::new("", cause, format!("{MOST_PARTS} at most")));
        }
        let (node, before) = self.nodes.insert_full(name.to_owned(), at);
        if before.is_some() {
            let cause = format!("there are two joints \"{name}\"");
            return Err(Refused::new("", cause, "give each joint its own name"));
        }
        self.is_fixed.push(is_fixed);
        self.links_of.push(Vec::new());
        Ok(node)
    }

    fn link(&mut self, name: Option<&str>, nodes: Vec<(usize, At)>) -> usize {
        let names: Vec<&str> = nodes
            .iter()
            .filter_map(|(node, _)| Some(self.nodes.get_index(*node)?.0.as_str()))
            .collect();
        let short = names.iter().all(|name| name.chars().count() == 1);
        let of_nodes = || names.join(if short { "" } else { "-" });
        let name = name.map_or_else(of_nodes, str::to_owned);
        for (node, _) in &nodes {
            self.links_of[*node].push(self.links.len());
        }
        self.links.push(Rod { name, nodes });
        self.links.len() - 1
    }

    /// The larger side of the drawing.
    fn size(&self) -> f64 {
        let span = |k: usize| {
            let all = || self.nodes.values().map(|at| at[k]);
            all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
        };
        span(0).max(span(1))
    }

    /// Whether a distance is that of the drawing.
    fn agrees(&self, drawn: f64, distance: f64) -> bool {
        (drawn - distance).abs() <= AGREES * self.size().max(distance.abs())
    }

    /// A link of two nodes that has a length, unless it is there already.
    fn bar(&mut self, a: usize, b: usize, length: f64) -> usize {
        let is_bar = |link: &&usize| {
            let nodes = &self.links[**link].nodes;
            nodes.len() == 2 && nodes.iter().any(|(node, _)| *node == b)
        };
        if let Some(&link) = self.links_of[a].iter().find(is_bar) {
            return link;
        }
        let (from, to) = (self.nodes[a], self.nodes[b]);
        let along = less(to, from);
        let drawn = along[0].hypot(along[1]);
        let end = if self.agrees(drawn, length) {
            to
        } else {
            let along = if drawn > 0.0 {
                along.map(|part| part / drawn)
            } else {
                [1.0, 0.0]
            };
            let off = (drawn - length).abs();
            self.misfits.insert(b);
            self.worst = self.worst.max(off);
            [from[0] + length * along[0], from[1] + length * along[1]]
        };
        self.link(None, vec![(a, from), (b, end)])
    }

    /// A link that has both nodes; both on the ground are none.
    fn common(&self, a: usize, b: usize) -> Option<usize> {
        let has = |link: &&usize| self.links[**link].nodes.iter().any(|(node, _)| *node == b);
        self.links_of[a].iter().find(has).copied()
    }

    /// A point that is fixed to the line from a node to another: to the link of both, to the ground, or to a link of its own that is
    /// pinned to the first and has a slot for the second.
    fn rider(&mut self, node: usize, [a, b]: [usize; 2], polar: Option<[f64; 2]>) {
        let link = self.common(a, b);
        let drawn = self.nodes[node];
        let place = |nodes: [At; 2]| -> At {
            let along = less(nodes[1], nodes[0]);
            let Some([distance, angle]) = polar else {
                return drawn;
            };
            let angle = along[1].atan2(along[0]) + angle;
            [
                nodes[0][0] + distance * angle.cos(),
                nodes[0][1] + distance * angle.sin(),
            ]
        };
        let of_link = |link: usize, node: usize| {
            let all = &self.links[link].nodes;
            all.iter()
                .find(|(other, _)| *other == node)
                .map_or(drawn, |(_, at)| *at)
        };
        let nodes = match link {
            Some(link) => [of_link(link, a), of_link(link, b)],
            None => [self.nodes[a], self.nodes[b]],
        };
        let placed = place(nodes);
        let off = less(placed, drawn);
        let at = if self.agrees(off[0].hypot(off[1]), 0.0) {
            drawn
        } else {
            placed
        };
        match link {
            Some(link) => {
                self.links[link].nodes.push((node, at));
                self.links_of[node].push(link);
            }
            None if self.is_fixed[a] && self.is_fixed[b] => {
                self.nodes[node] = at;
                self.is_fixed[node] = true;
            }
            None => {
                let from = self.nodes[a];
                let link = self.link(None, vec![(a, from), (node, at)]);
                let line = Line::Of(link, [a, b]);
                self.slides.push(Guide { node: b, line });
            }
        }
    }

    /// The line through two nodes.
    fn line(&mut self, [a, b]: [usize; 2]) -> Line {
        let [from, to] = [self.nodes[a], self.nodes[b]];
        if self.is_fixed[a] && self.is_fixed[b] {
            return Line::Fixed(from, less(to, from));
        }
        let link = self.common(a, b).unwrap_or_else(|| {
            let link = self.link(None, vec![(a, from)]);
            let line = Line::Of(link, [a, b]);
            self.slides.push(Guide { node: b, line });
            link
        });
        Line::Of(link, [a, b])
    }

    /// The model.
    fn imported(mut self, name: String, options: &Options) -> Result<Imported, Refused> {
        let mut draft = Draft {
            name,
            source: "pylinkage".into(),
            ..Draft::default()
        };
        match &options.length {
            Some(unit) => {
                draft.units.insert("length".into(), unit.as_str().into());
            }
            None => self.left_out.push(LeftOut {
                place: "file".into(),
                what: "a unit of length: m is taken; --length mm says another".into(),
            }),
        }
        let names: Vec<String> = self.nodes.keys().cloned().collect();
        if !self.misfits.is_empty() {
            let misfits: Vec<&str> = self
                .misfits
                .iter()
                .map(|&node| names[node].as_str())
                .collect();
            let what = format!(
                "where they are drawn: their distances differ by {} at most, and hold",
                self.worst
            );
            self.left_out.push(LeftOut {
                place: format!("joints {}", misfits.join(", ")),
                what,
            });
        }
        let places: Vec<At> = self.nodes.values().copied().collect();
        for (node, name) in names
            .iter()
            .enumerate()
            .filter(|(node, _)| self.is_fixed[*node])
        {
            pins::point(&mut draft, GROUND, name, places[node]);
        }
        let mut bodies = Vec::new();
        for link in &self.links {
            let body = pins::body(&mut draft, &link.name, Entry::new());
            for (node, at) in &link.nodes {
                pins::point(&mut draft, &body, &names[*node], *at);
            }
            bodies.push(body);
        }
        let place = |link: usize, node: usize| {
            let nodes = &self.links[link].nodes;
            nodes
                .iter()
                .find(|(other, _)| *other == node)
                .map_or(places[node], |(_, at)| *at)
        };
        for (node, name) in names.iter().enumerate() {
            let ground =
                self.is_fixed[node].then(|| pins::point(&mut draft, GROUND, name, places[node]));
            let links = self.links_of[node].iter();
            let points = links.map(|&link| (link, place(link, node)));
            let points: Vec<String> = ground
                .into_iter()
                .chain(points.map(|(link, at)| pins::point(&mut draft, &bodies[link], name, at)))
                .collect();
            if let Some((first, others)) = points.split_first() {
                for other in others {
                    pins::join(&mut draft, name, "revolute", [first, other], Entry::new());
                }
            }
        }
        for slide in &self.slides {
            let name = &names[slide.node];
            let of = self.links_of[slide.node]
                .iter()
                .find(|&&link| !matches!(slide.line, Line::Of(other, _) if other == link));
            let rides = match of {
                Some(&link) => {
                    pins::point(&mut draft, &bodies[link], name, place(link, slide.node))
                }
                None if self.is_fixed[slide.node] => {
                    pins::point(&mut draft, GROUND, name, places[slide.node])
                }
                None => continue,
            };
            let (held, axis) = match &slide.line {
                Line::Fixed(through, along) => (
                    pins::point(&mut draft, GROUND, &format!("{name}_guide"), *through),
                    *along,
                ),
                Line::Of(link, [a, b]) => {
                    let from = place(*link, *a);
                    (
                        pins::point(&mut draft, &bodies[*link], &names[*a], from),
                        less(place(*link, *b), from),
                    )
                }
            };
            if axis == [0.0, 0.0] {
                let place = format!("joint {name}");
                return Err(Refused::new(
                    place,
                    "its line has no direction: both ends are at one place",
                    "draw the ends apart",
                ));
            }
            pins::join(
                &mut draft,
                name,
                "slot",
                [&held, &rides],
                pins::axis(numbers(axis)),
            );
        }
        let mut ends = Vec::new();
        for &(link, angle) in &self.motors {
            pins::motor(
                &mut draft,
                &bodies[link],
                GROUND,
                &format!("{} rad/s", number(angle)),
            );
            ends.extend((angle != 0.0).then(|| std::f64::consts::TAU / angle.abs()));
        }
        let end = ends.into_iter().reduce(f64::max);
        let end = self
            .until
            .map_or(end, |until| Some(end.map_or(until, |end| end.min(until))));
        pins::analysis(&mut draft, end.filter(|end| end.is_finite()), false);
        Ok(Imported {
            draft,
            left_out: self.left_out,
        })
    }
}

fn less(a: At, b: At) -> At {
    [a[0] - b[0], a[1] - b[1]]
}

/// A record of the file: a member of one of its lists, with its place for messages.
struct Record<'v> {
    members: &'v Map<String, Value>,
    place: String,
}

impl<'v> Record<'v> {
    /// The records of a list.
    fn all(file: &'v Map<String, Value>, key: &str, one: &str) -> Result<Vec<Record<'v>>, Refused> {
        let list = match file.get(key) {
            None | Some(Value::Null) => return Ok(Vec::new()),
            Some(Value::Array(list)) => list,
            Some(_) => {
                return Err(Refused::new(
                    key,
                    "this is no list",
                    format!("a list of {key}"),
                ));
            }
        };
        let record = |(k, value): (usize, &'v Value)| {
            let members = value.as_object().ok_or_else(|| {
                Refused::new(
                    format!("{one} {}", k + 1),
                    "this is no object",
                    "an object with its keys",
                )
            })?;
            let named = ["name", "id"]
                .iter()
                .find_map(|key| members.get(*key)?.as_str());
            let place = named.map_or_else(
                || format!("{one} {}", k + 1),
                |name| format!("{one} {name}"),
            );
            Ok(Record { members, place })
        };
        list.iter().enumerate().map(record).collect()
    }

    fn refused(&self, cause: impl Into<String>, mend: &str) -> Refused {
        Refused::new(&self.place, cause, mend)
    }

    fn text(&self, key: &str) -> Result<&'v str, Refused> {
        let text = self.members.get(key).and_then(Value::as_str);
        text.ok_or_else(|| self.refused(format!("its {key} is missing"), "a text"))
    }

    /// A number; none where it is missing.
    fn number(&self, key: &str) -> Result<Option<f64>, Refused> {
        match self.members.get(key) {
            None | Some(Value::Null) => Ok(None),
            Some(value) => match value.as_f64().filter(|value| value.is_finite()) {
                Some(value) => Ok(Some(value)),
                None => Err(self.refused(format!("its {key} is no number"), "a number")),
            },
        }
    }

    fn needed(&self, key: &str) -> Result<f64, Refused> {
        let value = self.number(key)?;
        value.ok_or_else(|| {
            self.refused(
                format!("its {key} is missing"),
                "run the linkage one step before it is saved",
            )
        })
    }

    /// Two numbers in a list; none where they are missing.
    fn pair(&self, key: &str) -> Result<Option<At>, Refused> {
        match self.members.get(key) {
            None | Some(Value::Null) => Ok(None),
            Some(Value::Array(pair)) => match pair[..] {
                [Value::Null, _] | [_, Value::Null] => Ok(None),
                [ref x, ref y] => match (x.as_f64(), y.as_f64()) {
                    (Some(x), Some(y)) if x.is_finite() && y.is_finite() => Ok(Some([x, y])),
                    _ => Err(self.refused(format!("its {key} is no pair of numbers"), "[x, y]")),
                },
                _ => Err(self.refused(format!("its {key} is no pair of numbers"), "[x, y]")),
            },
            Some(_) => Err(self.refused(format!("its {key} is no pair of numbers"), "[x, y]")),
        }
    }

    fn position(&self) -> Result<At, Refused> {
        let at = self.pair("position")?;
        at.ok_or_else(|| {
            self.refused(
                "its position is missing",
                "run the linkage one step before it is saved",
            )
        })
    }

    /// Names in a list.
    fn names(&self, key: &str) -> Result<Vec<&'v str>, Refused> {
        let list = self.members.get(key).and_then(Value::as_array);
        let names =
            list.and_then(|list| list.iter().map(Value::as_str).collect::<Option<Vec<_>>>());
        names.ok_or_else(|| self.refused(format!("its {key} are missing"), "a list of names"))
    }
}

/// Versions 0.7 to 0.9: each joint hangs on others.
fn dyads(linkage: &mut DrawnLinkage, file: &Map<String, Value>) -> Result<(), Refused> {
    let records = Record::all(file, "joints", "joint")?;
    for record in &records {
        let at = [record.needed("x")?, record.needed("y")?];
        linkage.node(record.text("name")?, at, record.text("type")? == "Static")?;
    }
    // A joint is built when those are on which it hangs; the list may have another order.
    let mut is_built = vec![false; records.len()];
    let mut waits: Vec<usize> = (0..records.len()).collect();
    while !waits.is_empty() {
        let before = waits.len();
        let mut later = Vec::new();
        for node in waits {
            let record = &records[node];
            let parents = ["joint0", "joint1", "joint2"].map(|key| parent(linkage, record, key));
            let parents = parents.into_iter().collect::<Result<Vec<_>, _>>()?;
            let is_ready = |parent: &Option<usize>| {
                parent.is_none_or(|parent| parent >= records.len() || is_built[parent])
            };
            if parents.iter().all(is_ready) {
                dyad(linkage, node, record, &parents)?;
                is_built[node] = true;
            } else {
                later.push(node);
            }
        }
        if later.len() == before {
            let cause = "it hangs on joints that hang on it";
            return Err(records[later[0]].refused(
                cause,
                "joint0 and joint1 are joints that are solved before it",
            ));
        }
        waits = later;
    }
    Ok(())
}

/// Builds a joint of a dyad.
fn dyad(
    linkage: &mut DrawnLinkage,
    node: usize,
    record: &Record<'_>,
    parents: &[Option<usize>],
) -> Result<(), Refused> {
    let parent = |k: usize| {
        let lacks = || {
            record.refused(
                format!("its joint{k} is missing"),
                "the name of a joint, {\"ref\": \"A\"}",
            )
        };
        let parent = parents.get(k).copied().flatten().ok_or_else(lacks)?;
        match parent == node {
            false => Ok(parent),
            true => Err(record.refused(
                format!("its joint{k} is itself"),
                "the name of another joint",
            )),
        }
    };
    match record.text("type")? {
        "Static" => {}
        "Crank" => {
            let link = linkage.bar(parent(0)?, node, record.needed("distance")?);
            linkage.motors.push((link, record.needed("angle")?));
        }
        "Revolute" => {
            for (k, length) in [(0, "distance0"), (1, "distance1")] {
                linkage.bar(parent(k)?, node, record.needed(length)?);
            }
        }
        "Fixed" => {
            let polar = [record.needed("distance")?, record.needed("angle")?];
            linkage.rider(node, [parent(0)?, parent(1)?], Some(polar));
        }
        "Prismatic" | "Linear" => {
            linkage.bar(parent(0)?, node, record.needed("revolute_radius")?);
            let line = linkage.line([parent(1)?, parent(2)?]);
            linkage.slides.push(Guide { node, line });
        }
        other => {
            let cause = format!("{other:?} is no kind of joint");
            let mend = "Static, Crank, Revolute, Fixed, Prismatic or Linear";
            return Err(record.refused(cause, mend));
        }
    }
    Ok(())
}

/// The joint on which another hangs: by its name, or a fixed one that stands in its place.
fn parent(
    linkage: &mut DrawnLinkage,
    record: &Record<'_>,
    key: &str,
) -> Result<Option<usize>, Refused> {
    let members = match record.members.get(key) {
        None | Some(Value::Null) => return Ok(None),
        Some(Value::Object(members)) => members,
        Some(_) => {
            let cause = format!("its {key} is no object");
            return Err(record.refused(cause, "the name of a joint, {\"ref\": \"A\"}"));
        }
    };
    if members.get("inline") == Some(&Value::Bool(true)) {
        let place = format!("{key} of {}", record.place);
        let inline = Record { members, place };
        let at = [inline.needed("x")?, inline.needed("y")?];
        // It is looked up several times, and one place is one pivot.
        let is_it =
            |(_, (name, place)): &(usize, (&String, &At))| name.starts_with(PIVOT) && **place == at;
        if let Some((node, _)) = linkage.nodes.iter().enumerate().find(is_it) {
            return Ok(Some(node));
        }
        // Its own name is a number of the computer's memory.
        let mut names = Draft::names(PIVOT, PIVOT);
        let free = names.find(|name| !linkage.nodes.contains_key(name));
        return linkage.node(&free.unwrap_or_default(), at, true).map(Some);
    }
    let name = members
        .get("ref")
        .and_then(Value::as_str)
        .unwrap_or_default();
    match linkage.nodes.get_index_of(name) {
        Some(node) => Ok(Some(node)),
        None => Err(record.refused(
            format!("its {key} is {name:?}, and there is no such joint"),
            "the name of a joint, {\"ref\": \"A\"}",
        )),
    }
}

/// From version 0.8: joints that have places, and links of them.
fn mechanism(linkage: &mut DrawnLinkage, file: &Map<String, Value>) -> Result<(), Refused> {
    let joints = Record::all(file, "joints", "joint")?;
    let links = Record::all(file, "links", "link")?;
    let is = |record: &Record<'_>, kind: &str| {
        record.members.get("type").and_then(Value::as_str) == Some(kind)
    };
    let mut fixed: Vec<&str> = Vec::new();
    for link in &links {
        if is(link, "ground") {
            fixed.extend(link.names("joints")?);
        } else if let Some(motor) = link.members.get("motor_joint").and_then(Value::as_str) {
            fixed.push(motor);
        }
    }
    let fixed: HashSet<&str> = fixed.into_iter().collect();
    let mut riders = Vec::new();
    for joint in &joints {
        let id = joint.text("id")?;
        let is_fixed = is(joint, "ground") || fixed.contains(id);
        let node = linkage.node(id, joint.position()?, is_fixed)?;
        if is(joint, "tracker") {
            riders.push((node, joint));
        }
        if is(joint, "prismatic") {
            let axis = joint.pair("axis")?.unwrap_or([1.0, 0.0]);
            let through = joint.pair("line_point")?.unwrap_or([0.0, 0.0]);
            let line = Line::Fixed(through, axis);
            linkage.slides.push(Guide { node, line });
        }
    }
    let find = |linkage: &DrawnLinkage, record: &Record<'_>, name: &str| {
        linkage.nodes.get_index_of(name).ok_or_else(|| {
            record.refused(
                format!("there is no joint {name:?}"),
                "the id of a joint of the file",
            )
        })
    };
    for record in links.iter().filter(|link| !is(link, "ground")) {
        let mut nodes: Vec<(usize, At)> = Vec::new();
        for name in record.names("joints")? {
            let node = find(linkage, record, name)?;
            if !nodes.iter().any(|(other, _)| *other == node) {
                nodes.push((node, linkage.nodes[node]));
            }
        }
        let id = record.text("id")?;
        let name = record
            .members
            .get("name")
            .and_then(Value::as_str)
            .unwrap_or(id);
        let link = linkage.link(Some(name), nodes);
        let is_arc = is(record, "arc_driver");
        if !is_arc && !is(record, "driver") {
            continue;
        }
        let velocity = record
            .number("angular_velocity")?
            .unwrap_or(std::f64::consts::TAU / 360.0);
        linkage.motors.push((link, velocity));
        if is_arc {
            let (start, end) = (record.needed("arc_start")?, record.needed("arc_end")?);
            let from = record.number("initial_angle")?.unwrap_or(start);
            let way = if velocity > 0.0 {
                end - from
            } else {
                start - from
            };
            let until = way / velocity;
            if until.is_finite() && until > 0.0 {
                linkage.until = Some(linkage.until.map_or(until, |before| before.min(until)));
            }
            linkage.left_out.push(LeftOut {
                place: record.place.clone(),
                what: "that it swings back at the ends of its arc: the analysis stops at the first"
                    .into(),
            });
        }
    }
    for (node, record) in riders {
        let ends = [
            find(linkage, record, record.text("ref_joint1_id")?)?,
            find(linkage, record, record.text("ref_joint2_id")?)?,
        ];
        let polar = match (record.number("distance")?, record.number("angle")?) {
            (Some(distance), Some(angle)) => Some([distance, angle]),
            _ => None,
        };
        if ends.contains(&node) {
            return Err(
                record.refused("it is fixed to itself", "ref_joint1_id names another joint")
            );
        }
        linkage.rider(node, ends, polar);
    }
    Ok(())
}

/// Version 0.7: a graph whose nodes have places.
fn graph(linkage: &mut DrawnLinkage, file: &Map<String, Value>) -> Result<(), Refused> {
    let nodes = Record::all(file, "nodes", "node")?;
    if nodes
        .iter()
        .all(|node| !node.members.contains_key("position"))
    {
        return Err(Refused::new(
            "",
            "this is a topology without dimensions",
            "write the mechanism with mechanism_to_json, which has the places of the joints",
        ));
    }
    for node in &nodes {
        let role = node.members.get("role").and_then(Value::as_str);
        if node.members.get("joint_type").and_then(Value::as_str) == Some("PRISMATIC") {
            let cause = "a slide of a graph has no line";
            return Err(node.refused(cause, "write the mechanism with mechanism_to_json"));
        }
        linkage.node(node.text("id")?, node.position()?, role == Some("GROUND"))?;
    }
    let find = |linkage: &DrawnLinkage, record: &Record<'_>, name: &str| {
        linkage.nodes.get_index_of(name).ok_or_else(|| {
            record.refused(
                format!("there is no node {name:?}"),
                "the id of a node of the file",
            )
        })
    };
    for record in &Record::all(file, "hyperedges", "hyperedge")? {
        let mut all: Vec<(usize, At)> = Vec::new();
        for name in record.names("nodes")? {
            let node = find(linkage, record, name)?;
            all.push((node, linkage.nodes[node]));
        }
        let name = record.members.get("name").and_then(Value::as_str);
        linkage.link(name, all);
    }
    for record in &Record::all(file, "edges", "edge")? {
        let [a, b] = ["source", "target"].map(|key| find(linkage, record, record.text(key)?));
        let (a, b) = (a?, b?);
        if a == b || linkage.common(a, b).is_some() {
            continue;
        }
        let along = less(linkage.nodes[b], linkage.nodes[a]);
        let length = record
            .number("distance")?
            .unwrap_or(along[0].hypot(along[1]));
        let link = linkage.bar(a, b, length);
        let driver = [a, b].into_iter().find(|node| {
            nodes[*node].members.get("role").and_then(Value::as_str) == Some("DRIVER")
        });
        let is_crank = driver.is_some() && [a, b].iter().any(|node| linkage.is_fixed[*node]);
        if let Some(driver) = driver.filter(|_| is_crank) {
            linkage.motors.push((link, nodes[driver].needed("angle")?));
        }
    }
    Ok(())
}

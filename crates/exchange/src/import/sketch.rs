//! A sketch as a linkage: lines are bars, circles are pins, layers are links.
//!
//! | step    | does                                                                               |
//! | ------- | ---------------------------------------------------------------------------------- |
//! | roles   | which layers are links, the ground and pins; whether all bars are on one layer     |
//! | spots   | circles, points and ends of bars that are one place                                |
//! | links   | what is connected on a layer; of one layer alone each line                         |
//! | joints  | a pin joins all links that have its spot                                           |
//! | names   | of spots from the nearest texts                                                    |
//!
//! Coordinates stay those of the drawing, so that all bodies have the frame of the ground.

use std::collections::BTreeMap;

use linkdyn_model::{GROUND, Unit};
use serde_json::{Map, Value, json};

use super::Imported;
use crate::draft::{Draft, Entry, numbers};
use crate::form::{Form, chords, short, tidy};
use crate::source::{LeftOut, Options, Refused};

/// What was drawn.
#[derive(Debug, Default)]
pub struct Sketch {
    /// Its title.
    pub title: String,
    /// Lines, circles, points and texts with y upwards, in the order of the file.
    pub drawn: Vec<Drawn>,
    /// Unit of coordinates, where the file says it.
    pub unit: Option<&'static str>,
    left_out: Vec<LeftOut>,
    skipped: BTreeMap<String, (String, usize)>,
}

/// A form with its layer.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// Layer of a DXF; group or colour of an SVG.
    pub layer: String,
    /// Where it stands in the file.
    pub place: String,
    /// What it is.
    pub form: Form,
    /// Whether its area is filled.
    pub is_filled: bool,
}

impl Sketch {
    /// Says that something of the file is not in the model.
    pub fn leave(&mut self, place: impl Into<String>, what: impl Into<String>) {
        let left = LeftOut {
            place: place.into(),
            what: what.into(),
        };
        // Of a polyline the same may be said of many corners.
        if !self.left_out.contains(&left) {
            self.left_out.push(left);
        }
    }

    /// Counts a kind of entity that is not read.
    pub fn skip(&mut self, place: impl Into<String>, what: impl Into<String>) {
        let first = self.skipped.entry(what.into());
        first.or_insert_with(|| (place.into(), 0)).1 += 1;
    }
}

/// Ends nearer than this to each other, and to the centre of a pin, are one; in parts of the drawing's size.
const SAME: f64 = 1e-6;
const NEAR: f64 = 1e-3;
/// Circles that are larger draw no end from their rim to their centre, in parts of the drawing's size.
const PIN: f64 = 0.03;
/// The largest filled triangle that is a sign of the ground, in parts of the drawing's size.
const SIGN: f64 = 0.2;
/// How far a text may be from what it names, in heights of its letters.
const BESIDE: f64 = 2.5;
/// Lines, circles and points, and texts of them that name something, and ends and corners of bars, at most.
const MOST_FORMS: usize = 4_000;
const MOST_TEXTS: usize = 500;
const MOST_ENDS: usize = 4_000;
/// What lies farther is no place.
const FARTHEST: f64 = 1e12;

const GROUNDS: [&str; 2] = ["ground", "fixed"];
const PINS: [&str; 4] = ["pin", "pins", "pivots", "joints"];
const DRIVEN: [&str; 3] = ["crank", "driver", "input"];

fn is_one_of(name: &str, words: &[&str]) -> bool {
    words.contains(&name.trim().to_lowercase().as_str())
}

/// Whether a layer has a meaning of its own.
pub fn is_special(layer: &str) -> bool {
    is_one_of(layer, &GROUNDS) || is_one_of(layer, &PINS)
}

/// A place that links may share.
#[derive(Debug)]
struct Spot {
    at: [f64; 2],
    /// How near an end must be to be there.
    reach: f64,
    is_pin: bool,
    place: String,
    name: Option<String>,
    /// Whether a link has it as a point even if nothing is joined there.
    is_point: bool,
}

/// A part that moves as a whole, or the ground.
#[derive(Debug)]
struct Part {
    layer: String,
    place: String,
    spots: Vec<usize>,
    /// Straights, for pins on them.
    pieces: Vec<[[f64; 2]; 2]>,
    /// Outlines, for pins in them.
    outlines: Vec<Vec<[f64; 2]>>,
}

impl Part {
    fn new(layer: &str, place: &str) -> Self {
        Part {
            layer: layer.to_owned(),
            place: place.to_owned(),
            spots: Vec::new(),
            pieces: Vec::new(),
            outlines: Vec::new(),
        }
    }

    fn take(&mut self, spot: usize) {
        if !self.spots.contains(&spot) {
            self.spots.push(spot);
        }
    }
}

/// What a drawn form is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Role {
    Bar,
    Outline,
    /// A filled triangle.
    Support,
    Pin,
    /// A circle around pins.
    Disc,
    Point,
    Text,
}

/// A sketch while it is understood.
struct Reading {
    sketch: Sketch,
    size: f64,
    unit: String,
    roles: Vec<Role>,
    /// Whether all bars are on one layer.
    is_single: bool,
    has_pins: bool,
    spots: Vec<Spot>,
    /// The ground first.
    parts: Vec<Part>,
}

/// The linkage of a sketch; `name` is that of its file.
///
/// # Errors
/// Where there is none.
pub fn linkage(name: &str, mut sketch: Sketch, options: &Options) -> Result<Imported, Refused> {
    let unit = unit(&mut sketch, options)?;
    let mut reading = Reading::new(sketch, unit)?;
    reading.find_pins();
    reading.find_links()?;
    reading.add_grounds();
    reading.join();
    let driven = reading.name_spots();
    reading.draft(name, driven)
}

fn unit(sketch: &mut Sketch, options: &Options) -> Result<String, Refused> {
    if let Some(wish) = &options.length {
        let parsed = [wish.as_str(), "m"].map(|unit| Unit::parse(unit).ok());
        let [Some(own), Some(metre)] = parsed else {
            return Err(not_length(wish));
        };
        own.convert(1.0, metre).ok_or_else(|| not_length(wish))?;
        return Ok(wish.clone());
    }
    let found = sketch.unit.unwrap_or_else(|| {
        sketch.leave(
            "units",
            "the drawing names no unit: taken as mm (--length says another)",
        );
        "mm"
    });
    Ok(found.into())
}

fn not_length(unit: &str) -> Refused {
    Refused::new(
        "--length",
        format!("{} is no unit of length", super::quoted(unit)),
        "such as mm, cm, m, in or ft",
    )
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Distance from a straight between its ends; far away beyond them.
fn from_straight(at: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let length = distance(a, b);
    let along = ((at[0] - a[0]) * (b[0] - a[0]) + (at[1] - a[1]) * (b[1] - a[1])) / length;
    let across = ((at[1] - a[1]) * (b[0] - a[0]) - (at[0] - a[0]) * (b[1] - a[1])) / length;
    match (0.0..=length).contains(&along) {
        true => across.abs(),
        false => f64::INFINITY,
    }
}

/// Whether a closed line goes around a place (even and odd crossings).
fn is_inside(at: [f64; 2], corners: &[[f64; 2]]) -> bool {
    let mut inside = false;
    for (k, [x, y]) in corners.iter().enumerate() {
        let [u, v] = corners[(k + 1) % corners.len()];
        if (*y > at[1]) != (v > at[1]) && at[0] < x + (at[1] - y) / (v - y) * (u - x) {
            inside = !inside;
        }
    }
    inside
}

impl Reading {
    fn new(mut sketch: Sketch, unit: String) -> Result<Self, Refused> {
        let nothing = |what: &str| {
            Refused::new(
                "",
                what,
                "lines are bars, circles their pins: linkdyn docs exchange",
            )
        };
        let is_text = |form: &Form| matches!(form, Form::Text { .. });
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for drawn in &sketch.drawn {
            for place in drawn.form.places() {
                if !place.iter().all(|x| x.abs() <= FARTHEST) {
                    return Err(Refused::new(
                        drawn.place.clone(),
                        "this lies farther away than a drawing reaches",
                        format!("coordinates within {FARTHEST:e}"),
                    ));
                }
                if !is_text(&drawn.form) {
                    low = [0, 1].map(|k| low[k].min(place[k]));
                    high = [0, 1].map(|k| high[k].max(place[k]));
                }
            }
        }
        let forms = sketch.drawn.iter().filter(|drawn| !is_text(&drawn.form));
        match forms.count() {
            0 => return Err(nothing("there are no lines and no circles in it")),
            count if count > MOST_FORMS => {
                return Err(Refused::new(
                    "",
                    format!("{count} lines, circles and points are too many for a linkage"),
                    format!("{MOST_FORMS} at most"),
                ));
            }
            _ => {}
        }
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        if size.is_nan() || size <= 1e-9 {
            return Err(nothing("all of it lies at one place"));
        }
        // Lines without a length are points.
        for drawn in &mut sketch.drawn {
            let places = drawn.form.places();
            if let Form::Line { .. } = drawn.form {
                let first = places.first().copied();
                let far = places.iter().map(|at| distance(*at, first.unwrap_or(*at)));
                if far.fold(0.0, f64::max) <= SAME * size {
                    drawn.form = Form::Point(first.unwrap_or(low));
                }
            }
        }
        Ok(Reading {
            roles: Vec::new(),
            is_single: false,
            has_pins: false,
            spots: Vec::new(),
            parts: vec![Part::new(GROUND, "")],
            sketch,
            size,
            unit,
        })
    }

    /// A length as it is said.
    fn said(&self, length: f64) -> String {
        format!("{} {}", short(length), self.unit)
    }

    /// Roles of all forms, and a spot for each circle and each point.
    fn find_pins(&mut self) {
        let drawn = std::mem::take(&mut self.sketch.drawn);
        let circles = drawn.iter().filter_map(|drawn| match drawn.form {
            Form::Circle { centre, radius } => Some((centre, radius)),
            Form::Line { .. } | Form::Point(_) | Form::Text { .. } => None,
        });
        let circles: Vec<([f64; 2], f64)> = circles.collect();
        // A circle around others, or around a smaller one with the same centre, is the rim of a disc.
        let is_disc = |centre: [f64; 2], radius: f64| {
            let mut others = circles.iter();
            others.any(|(other, small)| {
                let far = distance(*other, centre);
                far + small < radius && (far > NEAR * self.size || *small < 0.5 * radius)
            })
        };
        let triangle = |drawn: &Drawn| match &drawn.form {
            Form::Line { corners, closed } => {
                let places: Vec<[f64; 2]> = corners.iter().map(|corner| corner.place).collect();
                let wide = places.iter().map(|at| distance(*at, places[0]));
                let is_small = wide.fold(0.0, f64::max) <= SIGN * self.size;
                // With pins at two of its corners it is a link.
                let at_pin = |at: &[f64; 2]| circles.iter().any(|(c, r)| distance(*c, *at) <= *r);
                let pins = places.iter().filter(|at| at_pin(at)).count();
                *closed && drawn.is_filled && places.len() == 3 && is_small && pins < 2
            }
            Form::Circle { .. } | Form::Point(_) | Form::Text { .. } => false,
        };
        let role = |drawn: &Drawn| match &drawn.form {
            Form::Circle { centre, radius } if is_disc(*centre, *radius) => Role::Disc,
            Form::Circle { .. } => Role::Pin,
            Form::Line { .. } if triangle(drawn) => Role::Support,
            Form::Line { .. } => Role::Bar,
            Form::Point(_) => Role::Point,
            Form::Text { .. } => Role::Text,
        };
        self.roles = drawn.iter().map(role).collect();
        self.has_pins = self.roles.contains(&Role::Pin);
        for (drawn, role) in drawn.iter().zip(&self.roles) {
            if let (Form::Circle { centre, radius }, Role::Pin) = (&drawn.form, role) {
                let reach = radius.min(PIN * self.size).max(NEAR * self.size);
                let known = self
                    .spots
                    .iter()
                    .find(|spot| spot.is_pin && distance(spot.at, *centre) <= NEAR * self.size);
                match known.map(|spot| distance(spot.at, *centre)) {
                    Some(far) if far > SAME * self.size => {
                        let what = format!(
                            "its centre is {} from that of another circle: moved there",
                            self.said(far)
                        );
                        self.sketch.leave(drawn.place.clone(), what);
                    }
                    Some(_) => {}
                    None => self.spots.push(Spot {
                        at: *centre,
                        reach,
                        is_pin: true,
                        place: drawn.place.clone(),
                        name: None,
                        is_point: true,
                    }),
                }
            }
        }
        for drawn in &drawn {
            if let Form::Point(at) = drawn.form {
                let spot = self.spot(at, &drawn.place);
                self.spots[spot].is_point = true;
                self.spots[spot].is_pin |= is_one_of(&drawn.layer, &GROUNDS);
            }
        }
        // A closed line without a corner at a pin is the outline of a link; without circles all corners are pins.
        let outlines: Vec<bool> = drawn
            .iter()
            .map(|drawn| match &drawn.form {
                Form::Line { corners, closed } => {
                    let at_pin = |at: [f64; 2]| self.pin_at(at).is_some();
                    let mut places = corners.iter().map(|corner| corner.place);
                    *closed && self.has_pins && !places.any(at_pin)
                }
                Form::Circle { .. } | Form::Point(_) | Form::Text { .. } => false,
            })
            .collect();
        for (role, is_outline) in self.roles.iter_mut().zip(outlines) {
            if *role == Role::Bar && is_outline {
                *role = Role::Outline;
            }
        }
        self.sketch.drawn = drawn;
    }

    fn pin_at(&self, at: [f64; 2]) -> Option<usize> {
        let pins = self
            .spots
            .iter()
            .enumerate()
            .filter(|(_, spot)| spot.is_pin);
        let near = pins.map(|(k, spot)| (k, distance(spot.at, at), spot.reach));
        let within = near.filter(|(_, far, reach)| far <= reach);
        let nearest = within.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(nearest.0)
    }

    /// The spot at a place; what is moved to a pin is said.
    fn spot(&mut self, at: [f64; 2], place: &str) -> usize {
        if let Some(pin) = self.pin_at(at) {
            let far = distance(self.spots[pin].at, at);
            if far > SAME * self.size {
                let what = format!(
                    "its end is {} from the centre of a circle: moved there",
                    self.said(far)
                );
                self.sketch.leave(place, what);
            }
            return pin;
        }
        let near = self.size * if self.has_pins { SAME } else { NEAR };
        let mut spots = self.spots.iter();
        if let Some(known) = spots.position(|spot| distance(spot.at, at) <= near) {
            return known;
        }
        self.spots.push(Spot {
            at,
            reach: NEAR * self.size,
            is_pin: false,
            place: place.to_owned(),
            name: None,
            is_point: false,
        });
        self.spots.len() - 1
    }

    /// The links of all layers.
    fn find_links(&mut self) -> Result<(), Refused> {
        let drawn = self.sketch.drawn.clone();
        let is_link = |drawn: &Drawn| !is_special(&drawn.layer);
        let is_line = |role: Role| [Role::Bar, Role::Outline].contains(&role);
        let lines = || {
            drawn
                .iter()
                .zip(&self.roles)
                .filter(|(_, role)| is_line(**role))
        };
        let mut layers: Vec<&str> = Vec::new();
        for (own, _) in lines().filter(|(drawn, _)| is_link(drawn)) {
            if !layers.contains(&own.layer.as_str()) {
                layers.push(&own.layer);
            }
        }
        let ends: usize = drawn
            .iter()
            .zip(&self.roles)
            .map(|(drawn, role)| match (&drawn.form, role) {
                (Form::Line { corners, .. }, Role::Bar) => corners.len(),
                _ => 0,
            })
            .sum();
        if ends > MOST_ENDS {
            return Err(Refused::new(
                "",
                format!("{ends} ends and corners of bars are too many for a linkage"),
                format!("{MOST_ENDS} at most"),
            ));
        }
        self.is_single = layers.len() == 1;
        let roles = self.roles.clone();
        let all: Vec<(&Drawn, Role)> = drawn.iter().zip(roles).collect();
        if self.is_single {
            self.single_links(&all);
        } else {
            for layer in layers {
                let own = all.iter().filter(|(drawn, _)| drawn.layer == layer);
                self.links_of_layer(own.copied());
            }
        }
        // What is on the ground's layers stands still.
        for (own, role) in all {
            if is_one_of(&own.layer, &GROUNDS) && ![Role::Text, Role::Disc].contains(&role) {
                let corners = match (&own.form, role) {
                    (Form::Circle { centre, .. } | Form::Point(centre), _) => vec![*centre],
                    (Form::Line { corners, .. }, Role::Outline) => {
                        self.parts[0].outlines.push(chords(corners, true));
                        Vec::new()
                    }
                    (Form::Line { corners, .. }, Role::Bar) => {
                        corners.iter().map(|corner| corner.place).collect()
                    }
                    _ => Vec::new(),
                };
                for at in corners {
                    let spot = self.spot(at, &own.place);
                    self.parts[0].take(spot);
                }
            }
        }
        Ok(())
    }

    /// Each line is a link; lines with corners at pins are parted there.
    fn single_links(&mut self, all: &[(&Drawn, Role)]) {
        for (drawn, role) in all.iter().filter(|(drawn, _)| !is_special(&drawn.layer)) {
            let Form::Line { corners, closed } = &drawn.form else {
                continue;
            };
            let mut part = Part::new(&drawn.layer, &drawn.place);
            let places: Vec<[f64; 2]> = corners.iter().map(|corner| corner.place).collect();
            match role {
                Role::Outline => {
                    let around = chords(corners, true);
                    let spots = self.spots.iter().enumerate();
                    let inside = spots.filter(|(_, spot)| is_inside(spot.at, &around));
                    inside.for_each(|(spot, _)| part.take(spot));
                }
                Role::Bar => {
                    let last = places.len() - 1;
                    for (k, at) in places.iter().enumerate() {
                        let spot = self.spot(*at, &drawn.place);
                        self.spots[spot].is_point |= !closed && (k == 0 || k == last);
                        part.take(spot);
                        let parts = self.spots[spot].is_pin || !self.has_pins;
                        if parts && !closed && k > 0 && k < last {
                            let mut next = Part::new(&drawn.layer, &drawn.place);
                            next.take(spot);
                            self.parts.push(std::mem::replace(&mut part, next));
                        }
                        let next = places.get(k + 1).or(places.first().filter(|_| *closed));
                        part.pieces.extend(next.map(|next| [*at, *next]));
                    }
                }
                Role::Support | Role::Pin | Role::Disc | Role::Point | Role::Text => continue,
            }
            self.parts.push(part);
        }
    }

    /// What is connected on a layer is a link: by corners at one spot, circles on it, outlines around it.
    fn links_of_layer<'d>(&mut self, own: impl Iterator<Item = (&'d Drawn, Role)>) {
        let mut found: Vec<Part> = Vec::new();
        for (drawn, role) in own {
            let mut part = Part::new(&drawn.layer, &drawn.place);
            match (&drawn.form, role) {
                (Form::Line { corners, closed }, Role::Bar) => {
                    let last = corners.len() - 1;
                    for (k, corner) in corners.iter().enumerate() {
                        let spot = self.spot(corner.place, &drawn.place);
                        self.spots[spot].is_point |= !closed && (k == 0 || k == last);
                        part.take(spot);
                    }
                    let places = corners.iter().map(|corner| corner.place);
                    let next = places.clone().cycle().skip(1);
                    let pieces = places.zip(next).map(|(from, to)| [from, to]);
                    part.pieces
                        .extend(pieces.take(if *closed { last + 1 } else { last }));
                }
                (Form::Circle { centre, .. } | Form::Point(centre), Role::Pin | Role::Point) => {
                    let pin = self.pin_at(*centre);
                    part.take(pin.unwrap_or_else(|| self.spot(*centre, &drawn.place)));
                }
                (Form::Line { .. } | Form::Circle { .. }, Role::Outline | Role::Disc) => {
                    let around = match &drawn.form {
                        Form::Line { corners, .. } => chords(corners, true),
                        Form::Circle { centre, radius } => rim(*centre, *radius),
                        Form::Point(_) | Form::Text { .. } => Vec::new(),
                    };
                    part.outlines.push(around);
                }
                _ => continue,
            }
            found.push(part);
        }
        // An outline takes the spots of its layer that lie in it.
        let spots: Vec<usize> = found.iter().flat_map(|part| part.spots.clone()).collect();
        for part in &mut found {
            for around in std::mem::take(&mut part.outlines) {
                let inside = |spot: &&usize| is_inside(self.spots[**spot].at, &around);
                spots
                    .iter()
                    .filter(inside)
                    .for_each(|spot| part.take(*spot));
                part.outlines.push(around);
            }
        }
        // A circle or point on a straight belongs to it.
        let bars: Vec<(usize, [[f64; 2]; 2])> = found
            .iter()
            .filter_map(|part| Some((*part.spots.first()?, part)))
            .flat_map(|(first, part)| part.pieces.iter().map(move |piece| (first, *piece)))
            .collect();
        for part in found.iter_mut().filter(|part| part.pieces.is_empty()) {
            if let [single] = part.spots[..] {
                let at = self.spots[single].at;
                let near = |piece: &[[f64; 2]; 2]| from_straight(at, *piece) <= NEAR * self.size;
                let on = bars.iter().filter(|(_, piece)| near(piece));
                on.for_each(|(first, _)| part.take(*first));
            }
        }
        let start = self.parts.len();
        for part in found {
            self.merge(start, part);
        }
    }

    /// Adds a part to those from `start` on with which it has a spot in common, which become one.
    fn merge(&mut self, start: usize, mut part: Part) {
        let mut k = start;
        let mut home = None;
        while k < self.parts.len() {
            let shares = |spot: &usize| self.parts[k].spots.contains(spot);
            if !part.spots.iter().any(shares) {
                k += 1;
                continue;
            }
            let mut other = self.parts.remove(k);
            for spot in std::mem::take(&mut part.spots) {
                other.take(spot);
            }
            other.pieces.append(&mut part.pieces);
            other.outlines.append(&mut part.outlines);
            part = other;
            home.get_or_insert(k);
        }
        let home = home.unwrap_or(self.parts.len());
        self.parts.insert(home, part);
    }

    /// What a filled triangle stands at is on the ground.
    fn add_grounds(&mut self) {
        let drawn = std::mem::take(&mut self.sketch.drawn);
        for (own, role) in drawn.iter().zip(self.roles.clone()) {
            let (Form::Line { corners, .. }, Role::Support) = (&own.form, role) else {
                continue;
            };
            let corners: Vec<[f64; 2]> = corners.iter().map(|corner| corner.place).collect();
            let wide = corners.iter().map(|at| distance(*at, corners[0]));
            let wide = wide.fold(0.0, f64::max);
            let touched = self.spots.iter().enumerate().filter(|(_, spot)| {
                let mut far = corners.iter().map(|at| distance(*at, spot.at));
                let reach = spot.reach.min(0.3 * wide);
                is_inside(spot.at, &corners) || far.any(|far| far <= reach)
            });
            let touched: Vec<usize> = touched.map(|(k, _)| k).collect();
            for spot in &touched {
                self.spots[*spot].is_pin = true;
                self.parts[0].take(*spot);
            }
            if touched.is_empty() {
                self.sketch.leave(
                    own.place.clone(),
                    "a sign of the ground at no pin and no end",
                );
            }
        }
        self.sketch.drawn = drawn;
    }

    /// Gives pins of no link to what lies under them.
    fn join(&mut self) {
        for spot in 0..self.spots.len() {
            if !self.spots[spot].is_pin || self.owners(spot).len() > 1 {
                continue;
            }
            let at = self.spots[spot].at;
            let near = NEAR * self.size;
            for part in &mut self.parts[1..] {
                if part
                    .pieces
                    .iter()
                    .any(|piece| from_straight(at, *piece) <= near)
                {
                    part.take(spot);
                }
            }
            // A circle of no link joins the outlines around it.
            if self.owners(spot).is_empty() {
                for part in &mut self.parts {
                    if part.outlines.iter().any(|around| is_inside(at, around)) {
                        part.take(spot);
                    }
                }
            }
        }
    }

    /// The parts that have a spot.
    fn owners(&self, spot: usize) -> Vec<usize> {
        let parts = self.parts.iter().enumerate();
        parts
            .filter(|(_, part)| part.spots.contains(&spot))
            .map(|(k, _)| k)
            .collect()
    }

    /// Whether links are joined at a spot.
    fn joins(&self, spot: usize) -> bool {
        self.spots[spot].is_pin || !self.has_pins
    }

    /// Names spots by the texts next to them; returns the spot at which a text says that it is driven.
    fn name_spots(&mut self) -> Option<usize> {
        let drawn = std::mem::take(&mut self.sketch.drawn);
        let texts: Vec<(&str, &Drawn)> = drawn
            .iter()
            .filter_map(|drawn| match &drawn.form {
                Form::Text { text, .. } => Some((text.trim(), drawn)),
                Form::Line { .. } | Form::Circle { .. } | Form::Point(_) => None,
            })
            .filter(|(text, _)| !text.is_empty())
            .take(MOST_TEXTS)
            .collect();
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (k, (_, drawn)) in texts.iter().enumerate() {
            let Form::Text { at, height, .. } = &drawn.form else {
                continue;
            };
            let [width, _] = drawn.form.text_size();
            let marks = [*at, [at[0] + width / 2.0, at[1] + height / 2.0]];
            for (spot, own) in self.spots.iter().enumerate() {
                let far = marks.map(|mark| distance(mark, own.at));
                let far = far[0].min(far[1]);
                let reach = own.reach.max(NEAR * self.size);
                if far <= BESIDE * height + width / 2.0 + reach {
                    pairs.push((far, k, spot));
                }
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut used = vec![false; texts.len()];
        let mut driven = None;
        for (_, k, spot) in pairs {
            if used[k] {
                continue;
            }
            if is_one_of(texts[k].0, &DRIVEN) {
                used[k] = true;
                driven.get_or_insert(spot);
            } else if self.spots[spot].name.is_none() {
                used[k] = true;
                self.spots[spot].name = Some(texts[k].0.to_owned());
            }
        }
        for ((text, drawn), _) in texts.iter().zip(used).filter(|(_, used)| !used) {
            let text = super::quoted(text);
            self.sketch.leave(
                drawn.place.clone(),
                format!("the text {text} is next to no pin"),
            );
        }
        self.sketch.drawn = drawn;
        driven
    }

    /// Drops parts that are joined to nothing; the ground stays.
    fn drop_loose(&mut self) {
        let counts: Vec<usize> = (0..self.spots.len())
            .map(|spot| self.owners(spot).len())
            .collect();
        let mut parts = std::mem::take(&mut self.parts);
        let mut k = 0;
        parts.retain(|part| {
            k += 1;
            let is_joined = |spot: &usize| counts[*spot] > 1 && self.joins(*spot);
            let stays = k == 1 || part.spots.iter().any(is_joined);
            if !stays {
                let layer = super::quoted(&part.layer);
                let what = format!("what is drawn on {layer} is joined to nothing");
                self.sketch.leave(part.place.clone(), what);
            }
            stays
        });
        // In the order of the drawing, whatever they were found by.
        parts.iter_mut().for_each(|part| part.spots.sort_unstable());
        self.parts = parts;
    }

    /// The model.
    fn draft(mut self, file: &str, driven: Option<usize>) -> Result<Imported, Refused> {
        self.drop_loose();
        if self.parts.len() < 2 {
            return Err(Refused::new(
                "",
                "no circle and no common end joins two links",
                "draw bars as lines, a circle where they turn on each other, and what stands still on a layer \"ground\"",
            ));
        }
        let mut draft = Draft {
            name: match self.sketch.title.trim() {
                "" => file.rsplit_once('.').map_or(file, |(stem, _)| stem).into(),
                title => title.into(),
            },
            source: format!("The drawing {file}"),
            ..Draft::default()
        };
        draft
            .units
            .insert("length".into(), self.unit.clone().into());
        let names = self.spot_names();
        let bodies = self.add_bodies(&mut draft, &names);
        let pins = self.add_joints(&mut draft, &names, &bodies);
        self.add_driver(&mut draft, &bodies, driven, pins);
        self.say_the_rest();
        Ok(Imported {
            draft,
            left_out: self.sketch.left_out,
        })
    }

    /// Names of all spots: those of texts, else letters.
    fn spot_names(&self) -> Vec<String> {
        let mut taken: Map<String, Value> = Map::new();
        let mut names: Vec<Option<String>> = vec![None; self.spots.len()];
        for (spot, name) in self.spots.iter().zip(&mut names) {
            if let Some(wish) = &spot.name {
                let own = Draft::named(&taken, wish, "P");
                taken.insert(own.clone(), Value::Null);
                *name = Some(own);
            }
        }
        let letters = ('A'..='Z').map(String::from);
        let mut letters = letters.chain((27..).map(|k| format!("P{k}")));
        let mut free = || letters.by_ref().find(|name| !taken.contains_key(name));
        let mut is_used = vec![false; self.spots.len()];
        let spots = self.parts.iter().flat_map(|part| &part.spots);
        spots.for_each(|spot| is_used[*spot] = self.is_drawn(*spot));
        for (name, is_used) in names.iter_mut().zip(is_used) {
            if name.is_none() && is_used {
                *name = free();
            }
        }
        names.into_iter().map(Option::unwrap_or_default).collect()
    }

    /// Whether a link has a spot as a point.
    fn is_drawn(&self, spot: usize) -> bool {
        let own = &self.spots[spot];
        own.is_point || own.name.is_some() || self.joins(spot) && self.owners(spot).len() > 1
    }

    fn add_bodies(&mut self, draft: &mut Draft, names: &[String]) -> Vec<String> {
        let mut bodies: Vec<String> = Vec::new();
        for (k, part) in self.parts.iter().enumerate() {
            let name = match k {
                0 => GROUND.to_owned(),
                // The layer on which everything is that is on none.
                _ if part.layer == "0" => Draft::named(&draft.bodies, "", "link"),
                _ => Draft::named(&draft.bodies, &part.layer, "link"),
            };
            let mut points = Entry::new();
            for spot in &part.spots {
                let is_joined = self.joins(*spot) && self.owners(*spot).len() > 1;
                if is_joined || (k > 0 && self.is_drawn(*spot)) {
                    let at = self.spots[*spot].at.map(|x| tidy(x, self.size));
                    points.insert(names[*spot].clone(), numbers(at));
                    if !is_joined {
                        draft.points.push(format!("{name}.{}", names[*spot]));
                    }
                }
            }
            bodies.push(name.clone());
            if k > 0 || !points.is_empty() {
                draft.bodies.insert(name, json!({ "points": points }));
            }
        }
        bodies
    }

    /// A pin of k links is k − 1 joints with the first of them; returns how many there are.
    fn add_joints(&mut self, draft: &mut Draft, names: &[String], bodies: &[String]) -> usize {
        for (spot, name) in names.iter().enumerate() {
            let owners = self.owners(spot);
            let own = &self.spots[spot];
            let (at, place) = (own.at, own.place.clone());
            if owners.len() < 2 {
                if own.is_pin && owners.is_empty() {
                    self.sketch
                        .leave(place, "a circle at no end, line or outline of a link");
                }
                continue;
            }
            if !self.joins(spot) {
                let [x, y] = at.map(short);
                let links: Vec<&str> = owners.iter().map(|k| bodies[*k].as_str()).collect();
                let links = links.join(", ");
                let what = format!("{links} meet at {x}, {y} without a circle: not joined");
                self.sketch.leave(place, what);
                continue;
            }
            for other in &owners[1..] {
                let joint = Draft::named(&draft.joints, name, "pin");
                let ends = [owners[0], *other].map(|part| format!("{}.{name}", bodies[part]));
                let entry = json!({ "type": "revolute", "between": ends });
                draft.joints.insert(joint, entry);
            }
        }
        draft.joints.len()
    }

    /// Turns the crank, or says what is missing.
    fn add_driver(
        &mut self,
        draft: &mut Draft,
        bodies: &[String],
        driven: Option<usize>,
        pins: usize,
    ) {
        let at_text = driven.and_then(|spot| self.owners(spot).into_iter().find(|k| *k > 0));
        let mut parts = self.parts.iter().skip(1);
        let named = parts.position(|part| is_one_of(&part.layer, &DRIVEN));
        let crank = at_text.or(named.map(|k| k + 1));
        if let Some(crank) = crank {
            let motion = json!({ "type": "constant_velocity", "velocity": "60 rpm" });
            let driver = json!({ "type": "rotation", "body": bodies[crank], "motion": motion });
            draft.drivers.insert("motor".into(), driver);
            let analysis = json!({ "type": "kinematics", "end": 1, "outputs": 361 });
            if let Value::Object(analysis) = analysis {
                draft.analysis = analysis;
            }
        }
        if self.parts[0].spots.is_empty() {
            self.sketch.leave(
                "ground",
                "nothing is on a layer named ground or fixed: nothing holds the mechanism",
            );
            return;
        }
        let mobility = 3 * (self.parts.len() as i64 - 1) - 2 * pins as i64;
        let what = match (crank, mobility) {
            (Some(_), 1) => return,
            (Some(_), other) => format!(
                "the mobility by counting is {other}, and one link is driven: linkdyn check tells what is missing or too much"
            ),
            (None, other) => format!(
                "none: no layer and no text is called crank, driver or input; the mobility by counting is {other} (so many \"drivers\" make it move)"
            ),
        };
        self.sketch.leave("drivers", what);
    }

    fn say_the_rest(&mut self) {
        let roles = self.roles.iter();
        let outlines = roles.filter(|role| [Role::Outline, Role::Disc].contains(role));
        let outlines = outlines.count();
        if outlines > 0 {
            let what = format!(
                "{outlines}: a link has points and no shape of its own; mass and inertia are not computed"
            );
            self.sketch.leave("outlines", what);
        }
        for (what, (place, count)) in std::mem::take(&mut self.sketch.skipped) {
            let count = match count {
                1 => String::new(),
                more => format!(" (and {} more)", more - 1),
            };
            self.sketch.leave(place, format!("not read: {what}{count}"));
        }
    }
}

/// A circle as a polygon.
fn rim([x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let at = |k: usize| {
        let (sin, cos) = (k as f64 * std::f64::consts::TAU / 48.0).sin_cos();
        [x + radius * cos, y + radius * sin]
    };
    (0..=48).map(at).collect()
}

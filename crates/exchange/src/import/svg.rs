//! SVG as vector editors write it: lines, circles, paths and texts in groups, with transforms.
//!
//! Coordinates become millimetres where the drawing has a size of its own, with y upwards: y → −y. Curves count by their ends, as outlines
//! by chords; a closed curve that is a circle is one. Style sheets are not read, attributes and `style` are.
//! Source: W3C, Scalable Vector Graphics (SVG) 2, 2018, chapters 5, 7 to 10.

use std::collections::HashMap;

use roxmltree::{Document, Node};
use svgtypes::{
    Length, LengthUnit, PathParser, PathSegment, PointsParser, SimplePathSegment,
    SimplifyingPathParser, Transform, ViewBox,
};

use super::sketch::{Drawn, Sketch, is_special};
use super::xml::{self, XmlLines};
use crate::form::{Affine, Form};
use crate::source::Refused;

const SVG: &str = "http://www.w3.org/2000/svg";
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const XLINK: &str = "http://www.w3.org/1999/xlink";
/// User units of an inch.
const INCH: f64 = 96.0;
const MM: f64 = 25.4;
/// Elements and corners with all that `use` repeats, at most.
const MOST: usize = 50_000;
/// The largest number of a path.
const FARTHEST: f64 = 1e9;
/// Chords of a curve.
const CHORDS: u32 = 8;
/// How much the radius of a circle may vary that is drawn by curves: four cubics have 3e-4.
const ROUND: f64 = 1e-3;

/// Reads what is drawn; with `scaled` false a user unit stays a unit of length.
///
/// # Errors
/// Where it is no SVG.
pub fn read(text: &str, scaled: bool) -> Result<Sketch, Refused> {
    let document = xml::parse(text, "svg")?;
    let mut reader = SvgReader {
        lines: XmlLines::of(text),
        ids: ids(&document),
        sketch: Sketch::default(),
        rows: Vec::new(),
        count: 0,
    };
    let root = document.root_element();
    let scale = match scaled {
        true => reader.scale(root)?,
        false => 1.0,
    };
    let look = Look {
        by: Affine([scale, 0.0, 0.0, -scale, 0.0, 0.0]),
        group: None,
        stroke: None,
        fill: None,
        font: 16.0,
        anchor: 0.0,
    };
    reader.inside(root, &look, 0)?;
    Ok(reader.layered())
}

fn ids<'d, 'i>(document: &'d Document<'i>) -> HashMap<&'d str, Node<'d, 'i>> {
    let nodes = document.descendants();
    nodes
        .filter_map(|node| Some((node.attribute("id")?, node)))
        .collect()
}

/// What an element has from those around it.
#[derive(Debug, Clone)]
struct Look {
    by: Affine,
    group: Option<String>,
    stroke: Option<String>,
    fill: Option<String>,
    font: f64,
    /// Part of a text that is to the left of its place.
    anchor: f64,
}

/// What was drawn, before it is known what a layer is.
#[derive(Debug)]
struct Row {
    group: Option<String>,
    colour: Option<String>,
    drawn: Drawn,
}

struct SvgReader<'d, 'i> {
    lines: XmlLines,
    ids: HashMap<&'d str, Node<'d, 'i>>,
    sketch: Sketch,
    rows: Vec<Row>,
    count: usize,
}

impl<'d, 'i> SvgReader<'d, 'i> {
    /// Millimetres of a user unit.
    fn scale(&mut self, root: Node<'d, 'i>) -> Result<f64, Refused> {
        let pixel = MM / INCH;
        let view = match root.attribute("viewBox") {
            None => None,
            Some(text) => Some(text.parse::<ViewBox>().map_err(|_| {
                let cause = format!("viewBox {} can't be read", super::quoted(text));
                let mend = "four numbers: left, top, width and height above 0";
                self.lines.refuse(root, cause, mend)
            })?),
        };
        let mut scales = Vec::new();
        for name in ["width", "height"] {
            let size = self.length(root, name)?.filter(|size| *size > 0.0);
            let own = view.map(|view| if name == "width" { view.w } else { view.h });
            scales.extend(size.zip(own).map(|(size, own)| size * pixel / own));
        }
        self.sketch.unit = Some("mm");
        let place = self.lines.place(root);
        match (view, scales.into_iter().reduce(f64::min)) {
            (Some(_), Some(scale)) => return Ok(scale),
            (None, _) if root.attribute("width").is_some() => {}
            _ => self.sketch.leave(
                place,
                "the drawing has no size: its unit is taken as 1/96 in (--length says another)",
            ),
        }
        Ok(pixel)
    }

    /// A length in user units; none where there is none, or where it depends on what is around it.
    fn length(&self, node: Node<'d, 'i>, name: &str) -> Result<Option<f64>, Refused> {
        let Some(text) = node.attribute(name) else {
            return Ok(None);
        };
        let first = text.split([' ', ',']).find(|word| !word.is_empty());
        let read: Option<Length> = first.and_then(|word| word.parse().ok());
        let Some(length) = read.filter(|length| length.number.is_finite()) else {
            let cause = format!("{name} {} is no length", super::quoted(text));
            let mend = "a number, with mm, cm, in, px, pt, pc or nothing behind it";
            return Err(self.lines.refuse(node, cause, mend));
        };
        let unit = match length.unit {
            LengthUnit::None | LengthUnit::Px => 1.0,
            LengthUnit::Mm => INCH / MM,
            LengthUnit::Cm => 10.0 * INCH / MM,
            LengthUnit::In => INCH,
            LengthUnit::Pt => INCH / 72.0,
            LengthUnit::Pc => INCH / 6.0,
            LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return Ok(None),
        };
        Ok(Some(length.number * unit))
    }

    fn inside(&mut self, node: Node<'d, 'i>, look: &Look, depth: usize) -> Result<(), Refused> {
        if depth > xml::DEEPEST {
            let cause = format!("elements lie deeper than {} in each other", xml::DEEPEST);
            return Err(self.lines.refuse(
                node,
                cause,
                "ungroup some, and look for a use of itself",
            ));
        }
        let children = node.children().filter(|child| child.is_element());
        for child in children.filter(|child| is_svg(*child)) {
            self.element(child, look, depth + 1)?;
        }
        Ok(())
    }

    fn element(&mut self, node: Node<'d, 'i>, outer: &Look, depth: usize) -> Result<(), Refused> {
        self.take(node, 1)?;
        let name = node.tag_name().name();
        let Some(look) = self.look(node, outer)? else {
            self.sketch.skip(self.lines.place(node), "hidden");
            return Ok(());
        };
        let form = match name {
            "g" | "a" | "switch" => return self.inside(node, &look, depth),
            "svg" => {
                if node.attribute("viewBox").is_some() {
                    let place = self.lines.place(node);
                    self.sketch
                        .leave(place, "the viewBox of an inner svg is not read");
                }
                let (x, y) = (self.length(node, "x")?, self.length(node, "y")?);
                let look = look.shifted(x.unwrap_or(0.0), y.unwrap_or(0.0));
                return self.inside(node, &look, depth);
            }
            "use" => return self.used(node, &look, depth),
            "title" if depth == 1 => {
                self.sketch.title = words(node);
                return Ok(());
            }
            // Nothing of it is seen where it stands.
            "defs" | "symbol" | "clipPath" | "mask" | "marker" | "pattern" | "title" | "desc"
            | "metadata" | "linearGradient" | "radialGradient" | "filter" => return Ok(()),
            "path" => return self.path(node, &look),
            "line" => {
                let ends = [["x1", "y1"], ["x2", "y2"]];
                let ends = ends.map(|axes| self.place(node, axes));
                let [from, to] = ends;
                from?
                    .zip(to?)
                    .map(|(from, to)| Form::line([from, to], false))
            }
            "polyline" | "polygon" => {
                let text = node.attribute("points").unwrap_or_default();
                let places: Vec<[f64; 2]> = PointsParser::from(text).map(Into::into).collect();
                self.take(node, places.len())?;
                Some(Form::line(places, name == "polygon"))
            }
            "rect" => {
                let place = self.place(node, ["x", "y"])?;
                let sizes = [self.length(node, "width")?, self.length(node, "height")?];
                match (place, sizes) {
                    (Some([x, y]), [Some(w), Some(h)]) => {
                        let corners = [[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
                        Some(Form::line(corners, true))
                    }
                    _ => None,
                }
            }
            "circle" | "ellipse" => {
                let radii = match name {
                    "circle" => [self.length(node, "r")?; 2],
                    _ => [self.length(node, "rx")?, self.length(node, "ry")?],
                };
                match (self.place(node, ["cx", "cy"])?, radii) {
                    (Some(centre), [Some(radius), Some(other)])
                        if radius > 0.0 && (radius - other).abs() <= ROUND * radius =>
                    {
                        Some(Form::Circle { centre, radius })
                    }
                    _ => None,
                }
            }
            "text" => self.text(node, &look)?,
            _ => None,
        };
        match form {
            Some(form) => self.add(node, &look, form),
            None => {
                let place = self.lines.place(node);
                self.sketch.skip(place, format!("<{name}>"));
            }
        }
        Ok(())
    }

    /// Counts so much of an element.
    fn take(&mut self, node: Node<'d, 'i>, count: usize) -> Result<(), Refused> {
        self.count += count;
        if self.count <= MOST {
            return Ok(());
        }
        let cause = "this is too much for a linkage";
        let mend = format!("{MOST} elements and corners at most, with all that is used again");
        Err(self.lines.refuse(node, cause, &mend))
    }

    /// How an element looks; nothing where it is hidden.
    fn look(&self, node: Node<'d, 'i>, outer: &Look) -> Result<Option<Look>, Refused> {
        let mut look = outer.clone();
        if let Some(text) = node.attribute("transform") {
            let Ok(t) = text.parse::<Transform>() else {
                let cause = format!("transform {} can't be read", super::quoted(text));
                let mend = "translate, rotate, scale, skewX, skewY and matrix, with numbers";
                return Err(self.lines.refuse(node, cause, mend));
            };
            look.by = outer.by.of(&Affine([t.a, t.b, t.c, t.d, t.e, t.f]));
        }
        let style = node.attribute("style").unwrap_or_default();
        let styled = style.split(';').filter_map(|rule| rule.split_once(':'));
        let plain = [
            "stroke",
            "fill",
            "display",
            "visibility",
            "font-size",
            "text-anchor",
        ];
        let plain = plain
            .into_iter()
            .filter_map(|name| Some((name, node.attribute(name)?)));
        for (name, value) in plain.chain(styled) {
            let value = value.trim();
            match (name.trim(), value) {
                ("display", "none") | ("visibility", "hidden") => return Ok(None),
                ("stroke", _) => look.stroke = Some(colour(value)),
                ("fill", _) => look.fill = Some(colour(value)),
                ("font-size", _) => {
                    let size = value.trim_end_matches("px").trim().parse().ok();
                    look.font = size
                        .filter(|size: &f64| size.is_finite())
                        .unwrap_or(look.font);
                }
                ("text-anchor", _) => {
                    look.anchor = match value {
                        "middle" => 0.5,
                        "end" => 1.0,
                        _ => 0.0,
                    }
                }
                _ => {}
            }
        }
        let label = node.attribute((INKSCAPE, "label"));
        let id = node.attribute("id").filter(|id| !is_automatic(id));
        let own = label.or(id);
        let own = match node.tag_name().name() {
            "g" | "svg" | "use" => own,
            // A single line or circle may say that it stands still.
            _ => own.filter(|own| is_special(own)),
        };
        look.group = own.map(str::to_owned).or(look.group);
        Ok(Some(look))
    }

    fn place(&self, node: Node<'d, 'i>, axes: [&str; 2]) -> Result<Option<[f64; 2]>, Refused> {
        let mut place = [Some(0.0); 2];
        for (part, axis) in place.iter_mut().zip(axes) {
            if node.has_attribute(axis) {
                *part = self.length(node, axis)?;
            }
        }
        Ok(place[0].zip(place[1]).map(Into::into))
    }

    fn used(&mut self, node: Node<'d, 'i>, look: &Look, depth: usize) -> Result<(), Refused> {
        let href = node.attribute("href");
        let href = href.or_else(|| node.attribute((XLINK, "href")));
        let target = href.and_then(|href| self.ids.get(href.strip_prefix('#')?).copied());
        let Some(target) = target else {
            let href = super::quoted(href.unwrap_or_default());
            let place = self.lines.place(node);
            self.sketch
                .leave(place, format!("use of {href}, which is not in this file"));
            return Ok(());
        };
        let [x, y] = self.place(node, ["x", "y"])?.unwrap_or_default();
        let look = look.shifted(x, y);
        match target.tag_name().name() {
            "symbol" => self.inside(target, &look, depth + 1),
            _ if depth > xml::DEEPEST => self.inside(target, &look, depth),
            _ => self.element(target, &look, depth + 1),
        }
    }

    fn path(&mut self, node: Node<'d, 'i>, look: &Look) -> Result<(), Refused> {
        let mut places: Vec<[f64; 2]> = Vec::new();
        let mut curved = false;
        let text = node.attribute("d").unwrap_or_default();
        // An arc becomes the more curves the larger it is.
        if PathParser::from(text)
            .flatten()
            .any(|segment| reach(&segment) > FARTHEST)
        {
            let cause = format!("path {} has too large numbers", super::quoted(text));
            let mend = format!("{FARTHEST:e} at most");
            return Err(self.lines.refuse(node, cause, &mend));
        }
        for segment in SimplifyingPathParser::from(text) {
            let Ok(segment) = segment else {
                let cause = format!("path {} can't be read to its end", super::quoted(text));
                return Err(self.lines.refuse(node, cause, "draw it anew"));
            };
            self.take(node, 1)?;
            let from = places.last().copied().unwrap_or_default();
            let mut curve = |controls: &[[f64; 2]]| {
                curved = true;
                (1..=CHORDS).for_each(|k| {
                    let t = f64::from(k) / f64::from(CHORDS);
                    places.push(bezier(from, controls, t));
                });
            };
            match segment {
                SimplePathSegment::MoveTo { x, y } => {
                    self.piece(node, look, std::mem::take(&mut places), curved, false);
                    curved = false;
                    places.push([x, y]);
                }
                SimplePathSegment::LineTo { x, y } => places.push([x, y]),
                SimplePathSegment::CurveTo {
                    x1,
                    y1,
                    x2,
                    y2,
                    x,
                    y,
                } => curve(&[[x1, y1], [x2, y2], [x, y]]),
                SimplePathSegment::Quadratic { x1, y1, x, y } => curve(&[[x1, y1], [x, y]]),
                SimplePathSegment::ClosePath => {
                    self.piece(node, look, std::mem::take(&mut places), curved, true);
                    curved = false;
                }
            }
        }
        self.piece(node, look, places, curved, false);
        Ok(())
    }

    /// A piece of a path between two moves.
    fn piece(
        &mut self,
        node: Node<'d, 'i>,
        look: &Look,
        mut places: Vec<[f64; 2]>,
        curved: bool,
        mut closed: bool,
    ) {
        if places.is_empty() {
            return;
        }
        // Editors go back to the start before they close.
        if places.len() > 2 && places.first() == places.last() {
            closed = true;
            places.pop();
        }
        let form = match circle(&places).filter(|_| curved && closed) {
            Some(circle) => circle,
            // A curved bar is what it joins: its ends.
            None if curved && !closed => {
                let ends = [places.first(), places.last()].into_iter().flatten();
                Form::line(ends.copied(), false)
            }
            None => Form::line(places, closed),
        };
        self.add(node, look, form);
    }

    fn text(&self, node: Node<'d, 'i>, look: &Look) -> Result<Option<Form>, Refused> {
        let mut seats = node.descendants().filter(|inner| inner.has_attribute("x"));
        let seat = seats.next().unwrap_or(node);
        let Some(at) = self.place(seat, ["x", "y"])? else {
            return Ok(None);
        };
        let inner = if seat == node {
            None
        } else {
            self.look(seat, look)?
        };
        let look = inner.as_ref().unwrap_or(look);
        let form = Form::Text {
            at,
            height: 0.7 * look.font,
            text: words(node),
        };
        let [width, _] = form.text_size();
        let back = Affine([1.0, 0.0, 0.0, 1.0, -look.anchor * width, 0.0]);
        Ok(form.moved(&back))
    }

    fn add(&mut self, node: Node<'d, 'i>, look: &Look, form: Form) {
        let place = self.lines.place(node);
        let Some(form) = form.moved(&look.by) else {
            self.sketch
                .skip(place, "a circle that its transform makes an ellipse");
            return;
        };
        let named = |colour: &Option<String>| colour.clone().filter(|name| name != "none");
        self.rows.push(Row {
            group: look.group.clone(),
            colour: named(&look.stroke).or_else(|| named(&look.fill)),
            drawn: Drawn {
                layer: String::new(),
                place,
                form,
                // Without a word areas are black.
                is_filled: look.fill.as_deref() != Some("none"),
            },
        });
    }

    /// Groups are layers where there are several, else the colours of strokes.
    fn layered(mut self) -> Sketch {
        let is_line = |row: &&Row| matches!(row.drawn.form, Form::Line { .. });
        let is_own = |group: &Option<String>| !group.as_deref().is_some_and(is_special);
        let lines = self.rows.iter().filter(is_line);
        let mut groups: Vec<&Option<String>> = lines.map(|row| &row.group).collect();
        groups.retain(|group| is_own(group));
        let several = groups.windows(2).any(|pair| pair[0] != pair[1]);
        for row in &mut self.rows {
            let first = match several || !is_own(&row.group) {
                true => row.group.clone().or_else(|| row.colour.clone()),
                false => row.colour.clone().or_else(|| row.group.clone()),
            };
            row.drawn.layer = first.unwrap_or_else(|| "link".into());
        }
        // Of one colour, the group is the better name.
        let lines = self.rows.iter().filter(is_line);
        let mut own = lines.filter(|row| is_own(&row.group));
        let first = own.next().map(|row| row.drawn.layer.clone());
        if !several && own.all(|row| Some(&row.drawn.layer) == first.as_ref()) {
            for row in &mut self.rows {
                row.drawn.layer = row.group.clone().unwrap_or_else(|| "link".into());
            }
        }
        let rows = self.rows.into_iter();
        self.sketch.drawn.extend(rows.map(|row| row.drawn));
        self.sketch
    }
}

impl Look {
    fn shifted(&self, x: f64, y: f64) -> Look {
        Look {
            by: self.by.of(&Affine([1.0, 0.0, 0.0, 1.0, x, y])),
            ..self.clone()
        }
    }
}

/// The largest number that says where a segment of a path goes.
fn reach(segment: &PathSegment) -> f64 {
    let numbers = match *segment {
        PathSegment::MoveTo { x, y, .. }
        | PathSegment::LineTo { x, y, .. }
        | PathSegment::CurveTo { x, y, .. }
        | PathSegment::SmoothCurveTo { x, y, .. }
        | PathSegment::Quadratic { x, y, .. }
        | PathSegment::SmoothQuadratic { x, y, .. } => [x, y, 0.0, 0.0],
        PathSegment::HorizontalLineTo { x, .. } => [x, 0.0, 0.0, 0.0],
        PathSegment::VerticalLineTo { y, .. } => [0.0, y, 0.0, 0.0],
        PathSegment::EllipticalArc { rx, ry, x, y, .. } => [rx, ry, x, y],
        PathSegment::ClosePath { .. } => [0.0; 4],
    };
    numbers.into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// Elements of editors' own are not drawn.
fn is_svg(node: Node<'_, '_>) -> bool {
    node.tag_name().namespace().is_none_or(|own| own == SVG)
}

/// Whether an editor made an id up.
fn is_automatic(id: &str) -> bool {
    let rest = id.trim_start_matches(|letter: char| letter.is_ascii_alphabetic());
    let stem = &id[..id.len() - rest.len()];
    let stems = [
        "g", "group", "layer", "svg", "use", "path", "line", "circle",
    ];
    stems.contains(&stem.to_ascii_lowercase().as_str())
        && rest.chars().all(|c| c.is_ascii_digit() || "-_".contains(c))
}

/// A colour, of two ways to write it one.
fn colour(text: &str) -> String {
    let text = text.to_ascii_lowercase();
    match text.strip_prefix('#') {
        Some(digits) if digits.len() == 3 && digits.is_ascii() => {
            let twice = digits.chars().flat_map(|digit| [digit, digit]);
            std::iter::once('#').chain(twice).collect()
        }
        _ => text,
    }
}

fn words(node: Node<'_, '_>) -> String {
    let texts = node.descendants().filter(|inner| inner.is_text());
    let whole: String = texts.filter_map(|inner| inner.text()).collect();
    whole.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A place of a Bézier curve (de Casteljau).
fn bezier(from: [f64; 2], controls: &[[f64; 2]], t: f64) -> [f64; 2] {
    let mut places: Vec<[f64; 2]> = std::iter::once(from)
        .chain(controls.iter().copied())
        .collect();
    while places.len() > 1 {
        let between =
            |pair: &[[f64; 2]]| [0, 1].map(|k| pair[0][k] + t * (pair[1][k] - pair[0][k]));
        places = places.windows(2).map(between).collect();
    }
    places[0]
}

/// The circle on which all places lie.
fn circle(places: &[[f64; 2]]) -> Option<Form> {
    let least = [0, 1].map(|k| places.iter().fold(f64::INFINITY, |low, at| low.min(at[k])));
    let most = [0, 1].map(|k| {
        places
            .iter()
            .fold(f64::NEG_INFINITY, |high, at| high.max(at[k]))
    });
    let centre = [0, 1].map(|k| (least[k] + most[k]) / 2.0);
    let radius = (most[0] - least[0]) / 2.0;
    let off = |at: &[f64; 2]| ((at[0] - centre[0]).hypot(at[1] - centre[1]) - radius).abs();
    let is_round = radius > 0.0 && places.iter().all(|at| off(at) <= ROUND * radius);
    is_round.then_some(Form::Circle { centre, radius })
}

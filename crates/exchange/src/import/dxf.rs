//! DXF: pairs of lines, a group code and a value, as CAD programs write it in ASCII.
//!
//! Of model space LINE, LWPOLYLINE, POLYLINE, CIRCLE, ARC, POINT, SOLID, TEXT, MTEXT and INSERT are read, with arcs of polylines, blocks in
//! blocks, mirrored planes, layers that are off. The rest is counted. Source: Autodesk, DXF Reference (2012), the pages of these
//! entities.

use std::collections::{HashMap, HashSet};

use super::sketch::{Drawn, Sketch};
use crate::form::{Affine, Corner, Form};
use crate::source::Refused;

/// Blocks in blocks, at most.
const DEEPEST: usize = 8;
/// Forms and corners after all blocks are put in, at most.
const MOST: usize = 50_000;
/// Groups of one of them, at most.
const GROUPS: usize = 40;
/// The largest coordinate.
const FARTHEST: f64 = 1e12;

/// How an ASCII file is made from another one.
const AS_ASCII: &str = "save it as DXF in ASCII, as R2000 or R12";

/// Reads what is drawn.
///
/// # Errors
/// Where it is no DXF in ASCII.
pub fn read(bytes: &[u8]) -> Result<Sketch, Refused> {
    let other = [
        (&b"AutoCAD Binary DXF"[..], "a binary DXF"),
        (b"AC10", "a DWG"),
    ];
    for (start, what) in other {
        if bytes.starts_with(start) {
            return Err(Refused::new("", format!("this is {what}"), AS_ASCII));
        }
    }
    // Names of old files are in the code page of their computer; ASCII is the same in all of them.
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect(),
    };
    let mut reader = DxfReader::default();
    reader.read(&text)?;
    reader.expanded()
}

/// An entity with what it says.
#[derive(Debug, Default)]
struct Entity<'t> {
    kind: &'t str,
    line: usize,
    groups: Vec<(i32, &'t str, usize)>,
}

/// What an entity is.
#[derive(Debug, Clone)]
enum Piece {
    Form { form: Form, is_filled: bool },
    Insert { block: String, by: Affine },
}

/// A piece with its layer and line.
#[derive(Debug, Clone)]
struct Placed {
    layer: String,
    line: usize,
    piece: Piece,
}

/// A block: its base point, and what is in it.
#[derive(Debug, Default)]
struct Block {
    base: [f64; 2],
    pieces: Vec<Placed>,
}

/// A polyline whose corners follow as entities of their own.
#[derive(Debug)]
struct Old {
    layer: String,
    line: usize,
    corners: Vec<Corner>,
    closed: bool,
    mirrored: bool,
}

/// What was read so far.
#[derive(Debug, Default)]
struct DxfReader {
    sketch: Sketch,
    blocks: HashMap<String, Block>,
    /// The block that is open.
    open: Option<(String, Block)>,
    old: Option<Old>,
    model: Vec<Placed>,
    hidden: HashSet<String>,
    count: usize,
}

impl DxfReader {
    fn read(&mut self, text: &str) -> Result<(), Refused> {
        let (mut section, mut variable) = ("", "");
        let mut entity = Entity::default();
        let mut is_whole = false;
        let mut lines = text.trim_start_matches('\u{feff}').lines().zip(1..);
        while let Some((code, line)) = lines.next() {
            let Ok(code) = code.trim().parse::<i32>() else {
                let found = super::quoted(code.trim());
                return Err(Refused::new(
                    format!("line {line}"),
                    format!("{found} is no group code"),
                    "a DXF has a whole number and its value on lines of their own, by turns",
                ));
            };
            let Some((value, _)) = lines.next() else {
                // An empty line at the end.
                break;
            };
            match code {
                0 => {
                    self.take(section, &entity)?;
                    entity = Entity {
                        kind: value.trim(),
                        line,
                        groups: Vec::new(),
                    };
                    match entity.kind {
                        "ENDSEC" => section = "",
                        "EOF" => {
                            is_whole = true;
                            break;
                        }
                        _ => {}
                    }
                }
                2 if entity.kind == "SECTION" && section.is_empty() => section = value.trim(),
                9 if section == "HEADER" => variable = value.trim(),
                70 if variable == "$INSUNITS" => {
                    self.sketch.unit = unit_of(value.trim());
                    if self.sketch.unit.is_none() && value.trim() != "0" {
                        self.sketch.leave(
                            format!("line {line}"),
                            format!("$INSUNITS {} is no unit that is read", value.trim()),
                        );
                    }
                    variable = "";
                }
                999 => {}
                _ if ["TABLES", "BLOCKS", "ENTITIES"].contains(&section) => {
                    self.count()?;
                    entity.groups.push((code, value, line + 1));
                }
                _ => {}
            }
        }
        if !is_whole {
            if self.model.is_empty() && self.blocks.is_empty() {
                return Err(Refused::new(
                    "",
                    "there are no entities, and no EOF at its end",
                    AS_ASCII,
                ));
            }
            self.take(section, &entity)?;
            self.sketch.leave(
                "its end",
                "there is no EOF: the rest of the file may be missing",
            );
        }
        Ok(())
    }

    /// No more groups than a drawing of a linkage has.
    fn count(&mut self) -> Result<(), Refused> {
        self.count += 1;
        if self.count > GROUPS * MOST {
            return Err(too_many());
        }
        Ok(())
    }

    /// Takes an entity, which is complete, as part of a section.
    fn take(&mut self, section: &str, entity: &Entity<'_>) -> Result<(), Refused> {
        match (section, entity.kind) {
            ("TABLES", "LAYER") => {
                let is_off = entity.int(62).is_some_and(|colour| colour < 0);
                if is_off || entity.int(70).is_some_and(|flags| flags & 1 != 0) {
                    self.hidden.insert(entity.text(2).unwrap_or_default());
                }
            }
            ("BLOCKS", "BLOCK") => {
                let block = Block {
                    base: entity.place(10)?.unwrap_or_default(),
                    pieces: Vec::new(),
                };
                self.open = Some((entity.text(2).unwrap_or_default(), block));
            }
            ("BLOCKS", "ENDBLK") => self.blocks.extend(self.open.take()),
            ("BLOCKS" | "ENTITIES", kind) if !["", "SECTION", "ENDSEC"].contains(&kind) => {
                self.entity(entity)?;
            }
            _ => {}
        }
        Ok(())
    }

    fn entity(&mut self, entity: &Entity<'_>) -> Result<(), Refused> {
        let skip = |reader: &mut Self, what: String| {
            reader.sketch.skip(format!("line {}", entity.line), what)
        };
        if entity.int(67) == Some(1) {
            skip(self, "of paper space".into());
            return Ok(());
        }
        if entity.int(60) == Some(1) {
            skip(self, "invisible".into());
            return Ok(());
        }
        // Axes of its plane: mirrored where its normal points away.
        let normal = [(210, 0.0), (220, 0.0), (230, 1.0)];
        let mut axis = [0.0; 3];
        for (part, (code, usual)) in axis.iter_mut().zip(normal) {
            *part = entity.number(code)?.unwrap_or(usual);
        }
        let is_flat = axis[0].abs().max(axis[1].abs()) < 1e-9 * axis[2].abs();
        if !is_flat {
            skip(self, format!("{} out of the plane", entity.kind));
            return Ok(());
        }
        let mirrored = axis[2] < 0.0;
        let layer = entity.text(8).unwrap_or_else(|| "0".into());
        let form = match entity.kind {
            "POLYLINE" => {
                let flags = entity.int(70).unwrap_or(0);
                if flags & (16 | 64) != 0 {
                    skip(self, "POLYLINE that is a mesh".into());
                    return Ok(());
                }
                self.old = Some(Old {
                    layer,
                    line: entity.line,
                    corners: Vec::new(),
                    closed: flags & 1 != 0,
                    mirrored,
                });
                return Ok(());
            }
            "VERTEX" => {
                // Control points of a spline, and nothing without its polyline.
                let is_control = entity.int(70).is_some_and(|flags| flags & 16 != 0);
                let corner = Corner {
                    place: entity.needed(10)?,
                    bulge: entity.number(42)?.unwrap_or(0.0),
                };
                if let Some(old) = self.old.as_mut().filter(|_| !is_control) {
                    old.corners.push(corner);
                }
                return Ok(());
            }
            "SEQEND" => {
                if let Some(old) = self.old.take() {
                    let form = Form::Line {
                        corners: old.corners,
                        closed: old.closed,
                    };
                    self.put(old.layer, old.line, form, false, old.mirrored);
                }
                return Ok(());
            }
            "LINE" => Form::line([entity.needed(10)?, entity.needed(11)?], false),
            "LWPOLYLINE" => Form::Line {
                corners: entity.corners()?,
                closed: entity.int(70).is_some_and(|flags| flags & 1 != 0),
            },
            "CIRCLE" => Form::Circle {
                centre: entity.needed(10)?,
                radius: entity.positive(40)?,
            },
            "ARC" => entity.arc()?,
            "POINT" => Form::Point(entity.needed(10)?),
            "SOLID" | "TRACE" => entity.solid()?,
            "TEXT" | "MTEXT" => entity.words()?,
            "INSERT" => {
                let many = [70, 71].map(|code| entity.int(code).unwrap_or(1));
                if many.iter().any(|count| *count > 1) {
                    skip(self, "INSERT as an array".into());
                    return Ok(());
                }
                let [x, y] = entity.needed(10)?;
                let turn = entity.number(50)?.unwrap_or(0.0).to_radians();
                let scale = |code| Ok::<f64, Refused>(entity.number(code)?.unwrap_or(1.0));
                let (sx, sy) = (scale(41)?, scale(42)?);
                let (sin, cos) = turn.sin_cos();
                let by = Affine([sx * cos, sx * sin, -sy * sin, sy * cos, x, y]);
                let by = if mirrored { MIRROR.of(&by) } else { by };
                let block = entity.text(2).unwrap_or_default();
                let piece = Piece::Insert { block, by };
                self.place(layer, entity.line, piece);
                return Ok(());
            }
            other => {
                skip(self, super::quoted(other));
                return Ok(());
            }
        };
        // The ends of a line and a point are in the axes of the world, whatever its normal.
        let mirrored = mirrored && !["LINE", "POINT", "MTEXT"].contains(&entity.kind);
        let is_filled = ["SOLID", "TRACE"].contains(&entity.kind);
        self.put(layer, entity.line, form, is_filled, mirrored);
        Ok(())
    }

    fn put(&mut self, layer: String, line: usize, form: Form, is_filled: bool, mirrored: bool) {
        let moved = mirrored.then(|| form.moved(&MIRROR)).flatten();
        let form = moved.unwrap_or(form);
        self.place(layer, line, Piece::Form { form, is_filled });
    }

    fn place(&mut self, layer: String, line: usize, piece: Piece) {
        let placed = Placed { layer, line, piece };
        match &mut self.open {
            Some((_, block)) => block.pieces.push(placed),
            None => self.model.push(placed),
        }
    }

    /// The drawing with all blocks put in.
    fn expanded(mut self) -> Result<Sketch, Refused> {
        let whole = Affine([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        let mut expansion = Expansion {
            blocks: &self.blocks,
            hidden: &self.hidden,
            sketch: &mut self.sketch,
            count: 0,
        };
        expansion.add(&self.model, &whole, None, 0)?;
        Ok(self.sketch)
    }
}

/// The plane seen from behind.
const MIRROR: Affine = Affine([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

struct Expansion<'r> {
    blocks: &'r HashMap<String, Block>,
    hidden: &'r HashSet<String>,
    sketch: &'r mut Sketch,
    count: usize,
}

impl Expansion<'_> {
    /// Adds pieces; those of layer 0 in a block are on the layer on which it is put in.
    fn add(
        &mut self,
        pieces: &[Placed],
        by: &Affine,
        outer: Option<&str>,
        depth: usize,
    ) -> Result<(), Refused> {
        for Placed { layer, line, piece } in pieces {
            let layer = match outer {
                Some(outer) if layer == "0" => outer,
                _ => layer,
            };
            if self.hidden.contains(layer) {
                let layer = super::quoted(layer);
                let what = format!("on layer {layer}, which is off");
                self.sketch.skip(format!("line {line}"), what);
                continue;
            }
            self.count += match piece {
                Piece::Form {
                    form: Form::Line { corners, .. },
                    ..
                } => corners.len(),
                _ => 1,
            };
            if self.count > MOST {
                return Err(too_many());
            }
            match piece {
                Piece::Form { form, is_filled } => match form.moved(by) {
                    Some(form) => self.sketch.drawn.push(Drawn {
                        layer: layer.to_owned(),
                        place: format!("line {line}"),
                        form,
                        is_filled: *is_filled,
                    }),
                    None => self.sketch.skip(
                        format!("line {line}"),
                        "round, in a block of unequal scales",
                    ),
                },
                Piece::Insert { block, .. } if depth == DEEPEST => {
                    let block = super::quoted(block);
                    return Err(Refused::new(
                        format!("line {line}"),
                        format!("the block {block} lies deeper than {DEEPEST} blocks"),
                        "explode the blocks",
                    ));
                }
                Piece::Insert { block, by: own } => match self.blocks.get(block) {
                    Some(inner) => {
                        let [x, y] = inner.base;
                        let base = Affine([1.0, 0.0, 0.0, 1.0, -x, -y]);
                        let by = by.of(&own.of(&base));
                        self.add(&inner.pieces, &by, Some(layer), depth + 1)?;
                    }
                    None => {
                        let block = super::quoted(block);
                        self.sketch.skip(
                            format!("line {line}"),
                            format!("INSERT of the missing block {block}"),
                        );
                    }
                },
            }
        }
        Ok(())
    }
}

fn too_many() -> Refused {
    Refused::new(
        "",
        "there are too many entities for a linkage",
        format!("{MOST} lines, corners and circles at most"),
    )
}

/// The unit of `$INSUNITS`.
fn unit_of(code: &str) -> Option<&'static str> {
    Some(match code {
        "1" => "in",
        "2" => "ft",
        "4" => "mm",
        "5" => "cm",
        "6" => "m",
        "7" => "km",
        "13" => "um",
        "14" => "dm",
        _ => return None,
    })
}

impl Entity<'_> {
    fn find(&self, code: i32) -> Option<(&str, usize)> {
        let mut groups = self.groups.iter();
        let (_, value, line) = groups.find(|(own, ..)| *own == code)?;
        Some((value.trim(), *line))
    }

    fn int(&self, code: i32) -> Option<i32> {
        self.find(code)?.0.parse().ok()
    }

    fn text(&self, code: i32) -> Option<String> {
        Some(unescaped(self.find(code)?.0))
    }

    fn number(&self, code: i32) -> Result<Option<f64>, Refused> {
        self.find(code).map(number).transpose()
    }

    fn place(&self, code: i32) -> Result<Option<[f64; 2]>, Refused> {
        Ok(self
            .number(code)?
            .zip(self.number(code + 10)?)
            .map(Into::into))
    }

    fn lacks(&self, what: &str) -> Refused {
        Refused::new(
            format!("line {}", self.line),
            format!("this {} has no {what}", super::quoted(self.kind)),
            "open and save it with a CAD program",
        )
    }

    fn needed(&self, code: i32) -> Result<[f64; 2], Refused> {
        self.place(code)?
            .ok_or_else(|| self.lacks(&format!("place (groups {code} and {})", code + 10)))
    }

    fn positive(&self, code: i32) -> Result<f64, Refused> {
        let found = self.number(code)?.filter(|value| *value > 0.0);
        found.ok_or_else(|| self.lacks(&format!("radius above 0 (group {code})")))
    }

    fn corners(&self) -> Result<Vec<Corner>, Refused> {
        let mut corners: Vec<Corner> = Vec::new();
        for (code, value, line) in &self.groups {
            let value = || number((value.trim(), *line));
            match (code, corners.last_mut()) {
                (10, _) => corners.push(Corner::straight([value()?, 0.0])),
                (20, Some(last)) => last.place[1] = value()?,
                (42, Some(last)) => last.bulge = value()?,
                _ => {}
            }
        }
        Ok(corners)
    }

    fn arc(&self) -> Result<Form, Refused> {
        let ([x, y], radius) = (self.needed(10)?, self.positive(40)?);
        let angle = |code| Ok::<f64, Refused>(self.number(code)?.unwrap_or(0.0).to_radians());
        let (from, to) = (angle(50)?, angle(51)?);
        let turn = (to - from).rem_euclid(std::f64::consts::TAU);
        if turn < 1e-9 {
            return Ok(Form::Circle {
                centre: [x, y],
                radius,
            });
        }
        let at = |angle: f64| [x + radius * angle.cos(), y + radius * angle.sin()];
        let begin = Corner {
            place: at(from),
            bulge: (turn / 4.0).tan(),
        };
        Ok(Form::Line {
            corners: vec![begin, Corner::straight(at(to))],
            closed: false,
        })
    }

    /// A filled triangle or quadrangle; the third and the fourth corner lie crosswise.
    fn solid(&self) -> Result<Form, Refused> {
        let mut corners = vec![self.needed(10)?, self.needed(11)?];
        corners.extend(self.place(13)?);
        corners.push(self.needed(12)?);
        corners.dedup();
        Ok(Form::line(corners, true))
    }

    fn words(&self) -> Result<Form, Refused> {
        let pieces = self
            .groups
            .iter()
            .filter(|(code, ..)| [3, 1].contains(code));
        let text: String = pieces.map(|(_, value, _)| *value).collect();
        let height = self.number(40)?.unwrap_or(0.0).abs();
        let form = |at: [f64; 2], text: String| Form::Text { at, height, text };
        if self.kind == "MTEXT" {
            let text = form(self.needed(10)?, plain(&unescaped(&text)));
            // 1 to 9: left, middle, right; from the top downwards.
            let seat = (self.int(71).unwrap_or(1) - 1).clamp(0, 8);
            return Ok(shifted(text, [seat % 3, 2 - seat / 3]));
        }
        let text = unescaped(&text).replace("%%u", "").replace("%%o", "");
        let (across, up) = (self.int(72).unwrap_or(0), self.int(73).unwrap_or(0));
        let second = self.place(11)?.filter(|_| (across, up) != (0, 0));
        let Some(at) = second else {
            return Ok(form(self.needed(10)?, text));
        };
        let across = match across {
            1 | 4 => 1,
            2 => 2,
            _ => 0,
        };
        let up = match (up, self.int(72)) {
            (2, _) | (_, Some(4)) => 1,
            (3, _) => 2,
            _ => 0,
        };
        Ok(shifted(form(at, text), [across, up]))
    }
}

/// A text whose place is so many halves of its size away from its lower left corner.
fn shifted(text: Form, halves: [i32; 2]) -> Form {
    let [width, height] = text.text_size();
    let [x, y] = [width, height];
    let by = [
        -0.5 * f64::from(halves[0]) * x,
        -0.5 * f64::from(halves[1]) * y,
    ];
    let moved = text.moved(&Affine([1.0, 0.0, 0.0, 1.0, by[0], by[1]]));
    moved.unwrap_or(text)
}

fn number((value, line): (&str, usize)) -> Result<f64, Refused> {
    let found = value.parse().ok();
    found
        .filter(|number: &f64| number.abs() <= FARTHEST)
        .ok_or_else(|| {
            Refused::new(
                format!("line {line}"),
                format!("{} is no number of a drawing", super::quoted(value)),
                format!("a finite number within {FARTHEST:e}"),
            )
        })
}

/// A text with its escapes `\U+00E9` as letters.
fn unescaped(text: &str) -> String {
    let mut pieces = text.split("\\U+");
    let mut whole = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let letter = piece.get(..4).and_then(|code| {
            let code = u32::from_str_radix(code, 16).ok()?;
            char::from_u32(code)
        });
        match letter {
            Some(letter) => {
                whole.push(letter);
                whole.push_str(&piece[4..]);
            }
            None => {
                whole.push_str("\\U+");
                whole.push_str(piece);
            }
        }
    }
    whole
}

/// An MTEXT without its formats.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '{' | '}' => {}
            '\\' => match letters.next() {
                Some('P' | '~') => plain.push(' '),
                Some(own @ ('\\' | '{' | '}')) => plain.push(own),
                // Switches of a letter.
                Some('L' | 'l' | 'O' | 'o' | 'K' | 'k') | None => {}
                // Formats with a value.
                Some(_) => {
                    letters.by_ref().find(|letter| *letter == ';');
                }
            },
            own => plain.push(own),
        }
    }
    plain
}

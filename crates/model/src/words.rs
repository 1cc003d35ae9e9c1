//! The words of a model file: what each key means, and what may stand there. All of it stands in the table `words.txt`, from
//! which a file is read, the numbers of a model are checked, a model is printed back and the schema is made. The program finds the
//! names in the table when it first needs one, and reads what is described under a name when somebody asks for it.

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::dimension::Dimension;
use crate::shape::{
    Asked, Bound, Choice, Default, Described, Drives, Either, Field, Measure, Named, Need, Object,
    Shape, Tagged, Word,
};

const TABLE: &str = include_str!("words.txt");

/// A length.
pub const LENGTH: Shape = Shape::Quantity(Measure::Of(Dimension::Length), Bound::Any);

/// What is described under a name.
#[derive(Debug, Clone, Copy)]
pub enum Definition {
    /// The formats that this version reads.
    Format(&'static str),
    /// A point, and what it is.
    Point(&'static str),
    /// Materials, and what they are.
    Materials(&'static str),
    /// Vocabulary.
    Choice(&'static Described<Choice>),
    /// An object.
    Object(&'static Described<Object>),
    /// Objects told apart by their `type`.
    Tagged(&'static Tagged),
}

static WORDS: LazyLock<Vocabulary> = LazyLock::new(|| Vocabulary::read(TABLE));

/// An object of the table.
///
/// # Panics
/// The table has none of this name; the names in the code are those of the table.
pub fn object(name: &str) -> &'static Described<Object> {
    match WORDS.known.get(name) {
        Some(Definition::Object(found)) => found,
        _ => panic!("words.txt describes no object {name:?}"),
    }
}

/// The whole file.
pub fn file() -> &'static Described<Object> {
    object("linkdyn/1")
}

/// Objects of the table that are told apart by their `type`.
///
/// # Panics
/// As [`object`].
pub fn kinds(name: &str) -> &'static Tagged {
    match WORDS.known.get(name) {
        Some(Definition::Tagged(found)) => found,
        _ => panic!("words.txt describes no kinds of {name:?}"),
    }
}

/// The keys that a word of a choice needs beside it.
pub fn needs(choice: &str, word: &str) -> &'static [&'static str] {
    let words = match WORDS.known.get(choice) {
        Some(Definition::Choice(found)) => found.words.as_slice(),
        _ => &[],
    };
    let found = words.iter().find(|one| one.word == word);
    found.map_or(&[], |found| &found.needs)
}

/// All that the schema defines by a name, in the order of the table.
pub fn definitions() -> impl Iterator<Item = (&'static str, Definition)> {
    let defined = WORDS.blocks.iter();
    let defined = defined.filter(|block| !matches!(block.word, "file" | "part" | "kind"));
    defined.filter_map(|block| Some((block.name, *WORDS.known.get(block.name)?)))
}

/// A description in the table: its first line, and the lines below.
#[derive(Debug)]
struct Block {
    word: &'static str,
    name: &'static str,
    about: &'static str,
    rows: Vec<&'static str>,
}

/// The names of the table.
struct Vocabulary {
    blocks: &'static [Block],
    known: HashMap<&'static str, Definition>,
}

impl Vocabulary {
    /// Finds the descriptions in the table.
    fn read(table: &'static str) -> Vocabulary {
        let mut blocks: Vec<Block> = Vec::new();
        let lines = table.lines().filter(|line| !line.starts_with('#'));
        for line in lines.filter(|line| !line.is_empty()) {
            match (line.strip_prefix("  "), blocks.last_mut()) {
                (Some(row), Some(block)) => block.rows.push(row),
                _ => blocks.push(first_line(line).unwrap_or_else(|| broken(line))),
            }
        }
        let blocks = blocks.leak();
        let named = blocks.iter().enumerate();
        let named = named.filter(|(_, block)| block.word != "kind");
        let known = named.map(|(index, block)| (block.name, define(block, &blocks[index + 1..])));
        Vocabulary {
            known: known.collect(),
            blocks,
        }
    }
}

/// The table is a part of the program: a line that can't be read ends it with that line.
fn broken(line: &str) -> ! {
    panic!("this line of words.txt can't be read: {line}")
}

/// What is kept for ever.
fn kept<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}

/// `word Name: about`.
fn first_line(line: &'static str) -> Option<Block> {
    let (head, about) = line.split_once(": ")?;
    let (word, name) = head.split_once(' ')?;
    Some(Block {
        word,
        name,
        about,
        rows: Vec::new(),
    })
}

/// What a block describes, with those below it.
fn define(block: &'static Block, below: &'static [Block]) -> Definition {
    let Block { name, about, .. } = *block;
    match block.word {
        "format" => Definition::Format(about),
        "point" => Definition::Point(about),
        "materials" => Definition::Materials(about),
        "choice" => Definition::Choice(kept(Described::new(name, move || Choice {
            about,
            words: block.rows.iter().map(|&row| word(row)).collect(),
        }))),
        "kinds" => {
            let kinds = below.iter().take_while(|block| block.word == "kind");
            Definition::Tagged(kept(Tagged {
                name,
                about,
                variants: kinds.map(described).collect(),
            }))
        }
        _ => Definition::Object(kept(described(block))),
    }
}

fn described(block: &'static Block) -> Described<Object> {
    Described::new(block.name, move || read_object(block))
}

fn read_object(block: &Block) -> Object {
    let mut object = Object {
        about: block.about,
        fields: Vec::new(),
        refused: Vec::new(),
        drives: Drives::Nothing,
        either: None,
    };
    for &row in &block.rows {
        let read = match row.contains('|') {
            true => field(row).map(|field| object.fields.push(field)),
            false => beside(row, &mut object),
        };
        read.unwrap_or_else(|| broken(row));
    }
    object
}

/// `key | what stands there | need | about`.
fn field(row: &'static str) -> Option<Field> {
    let (key, rest) = columns(row);
    let (shape, rest) = columns(rest);
    let (need, about) = columns(rest);
    let need = match need.split_once(' ') {
        None if need.is_empty() => Need::Optional,
        None if need == "required" => Need::Required,
        Some(("=", value)) => Need::Default(default(value)?),
        Some(("~", value)) => Need::Silent(default(value)?),
        _ => return None,
    };
    let shape = self::shape(shape)?;
    Some(Field {
        key,
        about,
        need,
        shape,
    })
}

/// What stands at a place: a word, what it is of, and which numbers are legal.
fn shape(text: &'static str) -> Option<Shape> {
    let (word, rest) = text.split_once(' ').unwrap_or((text, ""));
    let rest = rest.strip_prefix("of ").unwrap_or(rest);
    let quantity = |text: &str| {
        let (measure, legal) = text.split_once(' ').unwrap_or((text, ""));
        Some((self::measure(measure)?, bound(legal)?))
    };
    Some(match word {
        "format" => Shape::Format,
        "units" => Shape::Units,
        "parameters" => Shape::Parameters,
        "text" => Shape::Text,
        "name" => Shape::Name(match rest {
            "body" => Named::Body,
            "joint" => Named::Joint,
            "driver" => Named::Driver,
            _ => return None,
        }),
        "point" => Shape::Point,
        "range" => quantity(rest).map(|(measure, bound)| Shape::Range(measure, bound))?,
        "axes" => quantity(rest).map(|(measure, bound)| Shape::PerAxis(measure, bound))?,
        "end" => Shape::End(measure(rest)?),
        "place" => Shape::Place,
        "nominal" => Shape::Nominal,
        "deviations" => Shape::Deviations,
        "alike" => Shape::Alike(bound(rest)?),
        "number" => Shape::Number(bound(rest)?),
        "coefficient" => Shape::Coefficient(bound(rest)?),
        "count" => {
            let (least, most) = rest.strip_prefix("from ")?.split_once(" to ")?;
            // A page counts in 32 bits.
            let most = usize::try_from(most.parse::<u64>().ok()?);
            Shape::Count(least.parse().ok()?, most.unwrap_or(usize::MAX))
        }
        "flag" => Shape::Flag,
        "contact_stiffness" => Shape::ContactStiffness,
        "direction" => Shape::Direction,
        "pair" => Shape::Pair(kept(self::shape(rest)?)),
        "list" => {
            let (least, of) = rest.split_once(" of ")?;
            Shape::List(kept(self::shape(of)?), least.parse().ok()?)
        }
        "table" => Shape::Table,
        "curve" => Shape::Curve(object_named(rest)?),
        "input" => Shape::Input,
        "state" => Shape::State(object_named(rest)?),
        "entries" => Shape::Entries,
        "entry" => Shape::Entry,
        "varying" => Shape::Varying(Dimension::from_name(rest)?),
        "formula" => Shape::Formula(Dimension::from_name(rest)?),
        "event" => Shape::Event,
        "materials" => Shape::Materials,
        "map" => Shape::Map(kept(self::shape(rest)?)),
        "responses" => Shape::Responses,
        "response" => Shape::Response,
        "limit" => Shape::Limit,
        "design" => Shape::Asked(Asked::Design),
        "sought" => Shape::Asked(Asked::Value),
        "constraint" => Shape::Asked(Asked::Constraint),
        "bodies" => Shape::Bodies,
        name if name.starts_with(char::is_uppercase) => match *WORDS.known.get(name)? {
            Definition::Choice(of) => Shape::Choice(of),
            Definition::Object(of) => Shape::Object(of),
            Definition::Tagged(of) => Shape::Tagged(of),
            Definition::Format(_) | Definition::Point(_) | Definition::Materials(_) => {
                return None;
            }
        },
        _ => quantity(text).map(|(measure, bound)| Shape::Quantity(measure, bound))?,
    })
}

fn object_named(name: &str) -> Option<&'static Described<Object>> {
    match WORDS.known.get(name)? {
        Definition::Object(object) => Some(object),
        _ => None,
    }
}

/// `word | about | keys that it needs`.
fn word(row: &'static str) -> Word {
    let (word, rest) = columns(row);
    let (about, needs) = columns(rest);
    Word {
        word,
        about,
        needs: needs.split(", ").filter(|key| !key.is_empty()).collect(),
    }
}

/// The first column of a row, and the rest.
fn columns(row: &'static str) -> (&'static str, &'static str) {
    let (first, rest) = row.split_once('|').unwrap_or((row, ""));
    (first.trim(), rest.trim())
}

/// What is said of an object beside its keys.
fn beside(row: &'static str, object: &mut Object) -> Option<()> {
    let (head, said) = row.split_once(": ").unwrap_or((row, ""));
    let (word, rest) = head.split_once(' ').unwrap_or((head, ""));
    if word == "refused" {
        object.refused.push((rest, said));
        return Some(());
    }
    if word == "drives" {
        object.drives = match said {
            "sampled" => Drives::Sampled,
            "posed" => Drives::Posed,
            "measured" => Drives::Measured,
            dimension => Drives::Always(Dimension::from_name(dimension)?),
        };
        return Some(());
    }
    // "one of a, b: …", "any of a, b: …", "not both a, b"
    object.either = Some(Either {
        keys: rest.split_once(' ')?.1.split(", ").collect(),
        needed: (!said.is_empty()).then_some(said),
        exclusive: word != "any",
    });
    Some(())
}

fn measure(name: &str) -> Option<Measure> {
    Some(match name {
        "linear_stiffness" => Measure::LinearStiffness,
        "driven" => Measure::Driven(0),
        "driven_velocity" => Measure::Driven(1),
        "driven_acceleration" => Measure::Driven(2),
        "driven_jerk" => Measure::Driven(3),
        "driven_coefficient" => Measure::DrivenCoefficient,
        name => Measure::Of(Dimension::from_name(name)?),
    })
}

/// `>= 0`, `> 0`, `> 0 to 1`, `from 0 to 1` or `not 0`.
fn bound(text: &str) -> Option<Bound> {
    let number = |text: &str| text.parse::<f64>().ok();
    let (sign, rest) = text.split_once(' ').unwrap_or((text, ""));
    Some(match (sign, rest.split_once(" to ")) {
        ("", _) => Bound::Any,
        (">=", None) => Bound::AtLeast(number(rest)?),
        (">", None) => Bound::Above(number(rest)?),
        (">", Some((limit, most))) => Bound::Within(number(limit)?, number(most)?),
        ("from", Some((least, most))) => Bound::Between(number(least)?, number(most)?),
        ("not", None) if rest == "0" => Bound::NotZero,
        _ => return None,
    })
}

fn default(text: &'static str) -> Option<Default> {
    Some(match text {
        "0" => Default::Zero,
        "[0, 0]" => Default::Zeros,
        "empty" => Default::Empty,
        "same" => Default::Same,
        text => match text.strip_prefix("number ") {
            Some(number) => Default::Number(number.parse().ok()?),
            None => Default::Text(text),
        },
    })
}

#[cfg(test)]
mod tests;

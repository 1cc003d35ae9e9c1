//! XML as robots are written in: elements with places, numbers in attributes, and what of it is left out.

use std::collections::HashMap;

use nalgebra::Vector3;
use roxmltree::{Document, Error, Node, ParsingOptions};

use crate::source::{LeftOut, Refused};

/// Elements, texts and comments of a file, at most.
const MOST_NODES: u32 = 500_000;
/// Attributes of an element, at most: they are compared with each other.
const MOST_ATTRIBUTES: usize = 256;
/// Declarations of name spaces in a file, at most: elements inherit all of them.
const MOST_NAMESPACES: usize = 256;
/// Elements within each other, at most, where they are read by recursion.
pub(super) const DEEPEST: usize = 200;
/// No number of a mechanism is larger; sums of products of such numbers are finite.
const LARGEST: f64 = 1e15;

/// Reads a text, whose first element has to be `root`.
pub(super) fn parse<'t>(text: &'t str, root: &str) -> Result<Document<'t>, Refused> {
    // From one tag to the next, as values have no `<`.
    let is_crowded = |tag: &str| tag.split('=').skip(1).filter(is_quoted).count() > MOST_ATTRIBUTES;
    if text.split('<').any(is_crowded) {
        let mend = format!("{MOST_ATTRIBUTES} at most");
        return Err(Refused::new("", "an element has too many attributes", mend));
    }
    if text.matches("xmlns").count() > MOST_NAMESPACES {
        let mend = format!("{MOST_NAMESPACES} at most");
        return Err(Refused::new("", "it declares too many name spaces", mend));
    }
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options).map_err(|error| not_xml(&error))?;
    let found = document.root_element();
    if found.tag_name().name() != root {
        return Err(Refused::new(
            XmlLines::of(text).place(found),
            format!(
                "the first element is <{}>, not <{root}>",
                found.tag_name().name()
            ),
            "--from says what a file is: mjcf, urdf, sdf",
        ));
    }
    Ok(document)
}

/// Whether what follows an equals sign is the value of an attribute.
fn is_quoted(rest: &&str) -> bool {
    rest.trim_start().starts_with(['"', '\''])
}

fn not_xml(error: &Error) -> Refused {
    let place = format!("line {}", error.pos().row);
    match error {
        Error::DtdDetected => Refused::new(
            "",
            "it declares a document type or entities, which are not read",
            "remove <!DOCTYPE …>, and write entities out",
        ),
        Error::NodesLimitReached => Refused::new(
            "",
            format!("more than {MOST_NODES} elements are too many for a mechanism"),
            "leave out what is no mechanism",
        ),
        Error::UnknownNamespace(prefix, _) if prefix == "xacro" => xacro(place),
        Error::NoRootNode => Refused::new("", "there is no element in it", "is it the right file?"),
        _ => {
            let text = error.to_string();
            let cause = text
                .rsplit_once(" at ")
                .map_or(text.as_str(), |(cause, _)| cause);
            Refused::new(place, format!("this is no XML: {cause}"), "mend it there")
        }
    }
}

/// What becomes of xacro.
pub(super) fn xacro(place: String) -> Refused {
    Refused::new(
        place,
        "this is xacro, from which URDF is made",
        "make it first: xacro robot.urdf.xacro > robot.urdf",
    )
}

/// Where lines begin \[byte\].
pub(super) struct XmlLines(Vec<usize>);

impl XmlLines {
    pub(super) fn of(text: &str) -> XmlLines {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        XmlLines(ends.map(|(place, _)| place).collect())
    }

    fn line(&self, node: Node) -> usize {
        1 + self.0.partition_point(|&end| end < node.range().start)
    }

    /// `line 12`, with the kind and the name of what stands there: `line 12, joint elbow`.
    pub(super) fn place(&self, node: Node) -> String {
        let line = self.line(node);
        match node.attribute("name") {
            Some(name) => format!("line {line}, {} {}", node.tag_name().name(), short(name)),
            None => format!("line {line}"),
        }
    }

    /// Refuses something.
    pub(super) fn refuse(&self, node: Node, cause: impl Into<String>, mend: &str) -> Refused {
        Refused::new(self.place(node), cause, mend)
    }

    /// Numbers of a text, whose `name` is that of its attribute or element.
    pub(super) fn list(&self, node: Node, name: &str, text: &str) -> Result<Vec<f64>, Refused> {
        let number = |word: &str| {
            let value = word.parse::<f64>().ok();
            let value = value.filter(|value| value.abs() <= LARGEST);
            value.ok_or_else(|| {
                let cause = format!("{name}: {:?} is no number", short(word));
                self.refuse(node, cause, "numbers as 0.5 or 1e-3, at most 1e15")
            })
        };
        text.split_ascii_whitespace().map(number).collect()
    }

    /// So many of them.
    pub(super) fn numbers<const N: usize>(
        &self,
        node: Node,
        name: &str,
        text: &str,
    ) -> Result<[f64; N], Refused> {
        let list = self.list(node, name, text)?;
        let found = list.len();
        <[f64; N]>::try_from(list).map_err(|_| {
            let numbers = if found == 1 { "number" } else { "numbers" };
            self.refuse(
                node,
                format!("{name} has {found} {numbers}"),
                &format!("it has {N}"),
            )
        })
    }

    /// A direction of length 1.
    pub(super) fn direction(
        &self,
        node: Node,
        name: &str,
        [x, y, z]: [f64; 3],
    ) -> Result<Vector3<f64>, Refused> {
        let direction = Vector3::new(x, y, z).try_normalize(1e-12);
        direction.ok_or_else(|| {
            let cause = format!("{name} has no direction");
            self.refuse(node, cause, "write one, as in 0 1 0")
        })
    }

    /// An attribute that has to be there.
    pub(super) fn needed<'a>(&self, node: Node<'a, '_>, name: &str) -> Result<&'a str, Refused> {
        node.attribute(name).ok_or_else(|| {
            let tag = node.tag_name().name();
            let mend = format!("write <{tag} {name}=\"…\">");
            self.refuse(node, format!("<{tag}> has no {name}"), &mend)
        })
    }

    /// What a name is of, by all of its kind.
    pub(super) fn find<'a, T>(
        &self,
        node: Node,
        kind: &str,
        name: &str,
        all: &'a HashMap<String, T>,
    ) -> Result<&'a T, Refused> {
        all.get(name).ok_or_else(|| {
            let mut names: Vec<String> = all.keys().map(|name| short(name)).collect();
            names.sort();
            names.truncate(8);
            let mend = match names.as_slice() {
                [] => format!("it has no {kind} with a name"),
                names => format!("there are {}", names.join(", ")),
            };
            self.refuse(node, format!("there is no {kind} {:?}", short(name)), &mend)
        })
    }
}

/// A name in a message.
pub(super) fn short(name: &str) -> String {
    match name.char_indices().nth(40) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_owned(),
    }
}

/// What is left out, the same thing once with the lines on which it stands.
#[derive(Default)]
pub(super) struct Remarks {
    all: Vec<Remark>,
    known: HashMap<String, usize>,
}

struct Remark {
    what: String,
    place: String,
    count: usize,
    last: usize,
}

impl Remarks {
    /// What stands at an element.
    pub(super) fn at(&mut self, lines: &XmlLines, node: Node, what: impl Into<String>) {
        let (what, last) = (what.into(), lines.line(node));
        if let Some(&index) = self.known.get(&what) {
            let remark = &mut self.all[index];
            (remark.count, remark.last) = (remark.count + 1, last);
            return;
        }
        self.known.insert(what.clone(), self.all.len());
        let place = lines.place(node);
        let count = 1;
        self.all.push(Remark {
            what,
            place,
            count,
            last,
        });
    }

    /// What is about something else.
    pub(super) fn about(&mut self, place: impl Into<String>, what: impl Into<String>) {
        let place = place.into();
        self.all.push(Remark {
            what: what.into(),
            place,
            count: 1,
            last: 0,
        });
    }

    /// All of them.
    pub(super) fn list(self) -> Vec<LeftOut> {
        let written = |remark: Remark| {
            let place = match remark.count {
                1 => remark.place,
                count => {
                    let first = remark.place.split(',').next().unwrap_or_default();
                    let first = first.trim_start_matches("line ");
                    format!("lines {first} … {}, {count} times", remark.last)
                }
            };
            LeftOut {
                place,
                what: remark.what,
            }
        };
        self.all.into_iter().map(written).collect()
    }
}

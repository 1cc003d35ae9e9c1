//! XML: what is refused before it is read, and where its elements stand.

use roxmltree::{Document, Error, Node, ParsingOptions};

use crate::source::Refused;

/// Elements, texts and comments of a file, at most.
const MOST_NODES: u32 = 500_000;
/// Attributes of an element, at most: they are compared with each other.
const MOST_ATTRIBUTES: usize = 256;
/// Declarations of name spaces in a file, at most: elements inherit all of them.
const MOST_NAMESPACES: usize = 256;
/// Elements within each other, at most, where they are read by recursion.
pub(super) const DEEPEST: usize = 200;

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
            Lines::of(text).place(found),
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

/// Where lines begin \[byte\].
pub(super) struct Lines(Vec<usize>);

impl Lines {
    pub(super) fn of(text: &str) -> Lines {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Lines(ends.map(|(place, _)| place).collect())
    }

    fn line(&self, node: Node) -> usize {
        1 + self.0.partition_point(|&end| end < node.range().start)
    }

    /// `line 12`, with the kind and the name of what stands there: `line 12, joint elbow`.
    pub(super) fn place(&self, node: Node) -> String {
        format!("line {}", self.line(node))
    }

    /// Refuses something.
    pub(super) fn refuse(&self, node: Node, cause: impl Into<String>, mend: &str) -> Refused {
        Refused::new(self.place(node), cause, mend)
    }
}

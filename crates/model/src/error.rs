//! Faults of the input, each with its place.

use std::error::Error;
use std::fmt;
use std::ops::Deref;

/// Line and column (both from 1, columns in characters) in the model file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// One fault of the input: where, what stands there, what is wrong, what would mend it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// Path in the model, `joints.b.between[1]`; empty for the file as a whole.
    pub path: String,
    /// Where that is in the text, when it stands there (not, when it came from `--set`).
    pub place: Option<Place>,
    /// The offending text.
    pub found: Option<String>,
    /// What is wrong.
    pub message: String,
    /// What would mend it.
    pub hint: Option<String>,
}

impl Complaint {
    /// A fault at `path`; the place is looked up later.
    pub fn new(path: impl Into<String>, message: impl Into<String>) -> Self {
        Complaint {
            path: path.into(),
            place: None,
            found: None,
            message: message.into(),
            hint: None,
        }
    }

    /// Adds what would mend it.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// Adds the offending text.
    pub fn found(mut self, found: impl Into<String>) -> Self {
        self.found = Some(found.into());
        self
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::new();
        // a fault has a place in the file, or in a --set, which says its path itself
        let set = self
            .found
            .as_deref()
            .filter(|found| self.place.is_none() && found.starts_with("--set "));
        let said = set
            .and_then(|set| set["--set ".len()..].split_once('='))
            .is_some_and(|(path, _)| path == self.path);
        if let Some(place) = self.place {
            text += &format!("line {}, column {}: ", place.line, place.column);
        } else if let Some(set) = set {
            text += &format!("{set}: ");
        }
        if !self.path.is_empty() && !said {
            text += &format!("{}: ", self.path);
        }
        if let Some(found) = self.found.as_ref().filter(|_| set.is_none()) {
            text += &format!("{found}: ");
        }
        text += &self.message;
        if let Some(hint) = &self.hint {
            text += &format!(" ({hint})");
        }
        // names may hold anything, a terminal should not obey them
        f.write_str(&text.replace(char::is_control, " "))
    }
}

impl Error for Complaint {}

/// All faults of one input, at least one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaints(pub Vec<Complaint>);

impl Deref for Complaints {
    type Target = [Complaint];

    fn deref(&self) -> &[Complaint] {
        &self.0
    }
}

impl IntoIterator for Complaints {
    type Item = Complaint;
    type IntoIter = std::vec::IntoIter<Complaint>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl From<Complaints> for Vec<Complaint> {
    fn from(complaints: Complaints) -> Self {
        complaints.0
    }
}

impl From<Vec<Complaint>> for Complaints {
    fn from(complaints: Vec<Complaint>) -> Self {
        Complaints(complaints)
    }
}

impl From<Complaint> for Complaints {
    fn from(complaint: Complaint) -> Self {
        Complaints(vec![complaint])
    }
}

impl fmt::Display for Complaints {
    /// A line each.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, complaint) in self.0.iter().enumerate() {
            if index > 0 {
                f.write_str("\n")?;
            }
            write!(f, "{complaint}")?;
        }
        Ok(())
    }
}

impl Error for Complaints {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.0.first().map(|first| first as &(dyn Error + 'static))
    }
}

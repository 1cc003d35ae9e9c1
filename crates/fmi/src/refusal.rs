//! Why a call is not done.

/// How bad it is, as both versions of the interface number it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(i32)]
pub enum Severity {
    /// The step was not taken to its end.
    Discard = 2,
    /// The call is wrong, or can't be done.
    Error = 3,
    /// The instance is broken.
    Fatal = 4,
}

/// Why a call is not done, for the importer's log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// How bad it is.
    pub severity: Severity,
    /// Why, in a line.
    pub message: String,
}

impl Refusal {
    /// A wrong call.
    pub fn new(message: impl Into<String>) -> Self {
        Refusal {
            severity: Severity::Error,
            message: message.into(),
        }
    }
}

impl From<linkdyn::Error> for Refusal {
    fn from(error: linkdyn::Error) -> Self {
        let lines: Vec<String> = match error.complaints() {
            [] => vec![error.to_string()],
            complaints => complaints.iter().map(ToString::to_string).collect(),
        };
        Refusal::new(lines.join("; "))
    }
}

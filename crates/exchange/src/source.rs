//! What a file is, what can be said about reading it, and why it can't be read.

use std::fmt;

/// No file of more bytes is read.
pub const LONGEST: usize = 16 << 20;
/// No mechanism of more bodies or joints is read: it is something else.
pub const MOST_PARTS: usize = 2_000;

/// What a file is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A link that PMKS+ shares, or the text behind its `?`.
    Pmks,
    /// A linkage of pylinkage as JSON.
    Pylinkage,
    /// MuJoCo's MJCF.
    Mjcf,
    /// A robot of ROS.
    Urdf,
    /// A model of Gazebo.
    Sdf,
    /// A drawing of CAD programs.
    Dxf,
    /// A drawing of vector graphics.
    Svg,
    /// A table of points.
    Csv,
}

impl Format {
    /// All of them.
    pub const ALL: [Format; 8] = [
        Format::Pmks,
        Format::Pylinkage,
        Format::Mjcf,
        Format::Urdf,
        Format::Sdf,
        Format::Dxf,
        Format::Svg,
        Format::Csv,
    ];

    /// Its word among the options of the command.
    pub fn word(self) -> &'static str {
        match self {
            Format::Pmks => "pmks",
            Format::Pylinkage => "pylinkage",
            Format::Mjcf => "mjcf",
            Format::Urdf => "urdf",
            Format::Sdf => "sdf",
            Format::Dxf => "dxf",
            Format::Svg => "svg",
            Format::Csv => "csv",
        }
    }

    /// What a file is by its name and by what stands in it; nothing where that does not say it.
    pub fn of(name: &str, bytes: &[u8]) -> Option<Format> {
        let start = &bytes[..bytes.len().min(4096)];
        let text = String::from_utf8_lossy(start);
        let text = text.trim_start_matches('\u{feff}').trim_start();
        let ending = name
            .rsplit_once('.')
            .map(|(_, ending)| ending.to_ascii_lowercase());
        if text.starts_with('<') {
            let marks = [
                ("<mujoco", Format::Mjcf),
                ("<robot", Format::Urdf),
                ("<sdf", Format::Sdf),
                ("<svg", Format::Svg),
            ];
            let first = marks
                .iter()
                .filter_map(|(mark, format)| Some((text.find(mark)?, *format)));
            return first
                .min_by_key(|(place, _)| *place)
                .map(|(_, format)| format);
        }
        if text.starts_with('{') || text.starts_with('[') {
            return Some(Format::Pylinkage);
        }
        if text.starts_with("http://") || text.starts_with("https://") {
            return Some(Format::Pmks);
        }
        match ending.as_deref() {
            Some("dxf") => Some(Format::Dxf),
            Some("svg") => Some(Format::Svg),
            Some("csv") => Some(Format::Csv),
            Some("pmks" | "url") => Some(Format::Pmks),
            Some("json") => Some(Format::Pylinkage),
            _ => None,
        }
    }
}

/// What a source leaves open.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// The unit of its lengths, such as `mm`; without it what the source says, or the unit that its users take.
    pub length: Option<String>,
}

/// Something of the source that the model lacks, or that was changed on the way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Where it stands: `line 12`, `joint elbow`.
    pub place: String,
    /// What it is, and what became of it.
    pub what: String,
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.what)
    }
}

/// Why a source can't be read: where, what was found, and how to mend it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}{cause} ({mend})", if .place.is_empty() { String::new() } else { format!("{}: ", .place) })]
pub struct Refused {
    /// Where: `line 12`; empty where it is about the whole.
    pub place: String,
    /// What was found.
    pub cause: String,
    /// How to mend it.
    pub mend: String,
}

impl Refused {
    /// At a place.
    pub fn new(
        place: impl Into<String>,
        cause: impl Into<String>,
        mend: impl Into<String>,
    ) -> Self {
        Refused {
            place: place.into(),
            cause: cause.into(),
            mend: mend.into(),
        }
    }
}

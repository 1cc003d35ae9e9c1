//! Models that travel with the program: every file of `models/`, and one family of any size.

mod four_bars;

use std::borrow::Cow;
use std::fmt;

/// One bundled model.
#[derive(Debug, Clone, Copy)]
pub struct Bundled {
    /// The file's name without `.json`.
    pub name: &'static str,
    /// Shorter or other names.
    pub aliases: &'static [&'static str],
    /// The file.
    pub text: &'static str,
}

const fn of(name: &'static str, aliases: &'static [&'static str], text: &'static str) -> Bundled {
    Bundled {
        name,
        aliases,
        text,
    }
}

/// All of them, in alphabetical order; a test holds this against the folder.
pub const MODELS: &[Bundled] = &[
    of(
        "andrews-squeezer",
        &["andrews", "a03"],
        include_str!("../../../models/andrews-squeezer.json"),
    ),
    of(
        "bicycle-suspension",
        &["bicycle"],
        include_str!("../../../models/bicycle-suspension.json"),
    ),
    of(
        "cam-roller",
        &["cam"],
        include_str!("../../../models/cam-roller.json"),
    ),
    of(
        "chebyshev",
        &[],
        include_str!("../../../models/chebyshev.json"),
    ),
    of(
        "double-pendulum",
        &[],
        include_str!("../../../models/double-pendulum.json"),
    ),
    of(
        "double-wishbone",
        &["suspension"],
        include_str!("../../../models/double-wishbone.json"),
    ),
    of("engine", &[], include_str!("../../../models/engine.json")),
    of(
        "excavator",
        &[],
        include_str!("../../../models/excavator.json"),
    ),
    of(
        "four-bar",
        &[],
        include_str!("../../../models/four-bar.json"),
    ),
    of(
        "four-bar-spring",
        &[],
        include_str!("../../../models/four-bar-spring.json"),
    ),
    of(
        "geared-five-bar",
        &[],
        include_str!("../../../models/geared-five-bar.json"),
    ),
    of(
        "geneva",
        &["maltese-cross"],
        include_str!("../../../models/geneva.json"),
    ),
    of(
        "hoeken",
        &["hoecken"],
        include_str!("../../../models/hoeken.json"),
    ),
    of(
        "jansen-leg",
        &["jansen", "strandbeest"],
        include_str!("../../../models/jansen-leg.json"),
    ),
    of(
        "klann-leg",
        &["klann"],
        include_str!("../../../models/klann-leg.json"),
    ),
    of(
        "nfourbar",
        &["n-four-bar", "a02"],
        include_str!("../../../models/nfourbar.json"),
    ),
    of(
        "parallel-crank",
        &[],
        include_str!("../../../models/parallel-crank.json"),
    ),
    of(
        "peaucellier",
        &["inversor"],
        include_str!("../../../models/peaucellier.json"),
    ),
    of(
        "pendulum",
        &["a01"],
        include_str!("../../../models/pendulum.json"),
    ),
    of(
        "quick-return",
        &[],
        include_str!("../../../models/quick-return.json"),
    ),
    of(
        "scotch-yoke",
        &[],
        include_str!("../../../models/scotch-yoke.json"),
    ),
    of(
        "slider-crank",
        &[],
        include_str!("../../../models/slider-crank.json"),
    ),
    of(
        "slider-crank-clearance",
        &["clearance"],
        include_str!("../../../models/slider-crank-clearance.json"),
    ),
    of(
        "solar-array",
        &[],
        include_str!("../../../models/solar-array.json"),
    ),
    of(
        "stephenson-iii",
        &[],
        include_str!("../../../models/stephenson-iii.json"),
    ),
    of(
        "toggle-clamp",
        &["clamp"],
        include_str!("../../../models/toggle-clamp.json"),
    ),
    of(
        "walking-strandbeest",
        &["walker"],
        include_str!("../../../models/walking-strandbeest.json"),
    ),
    of(
        "watt-i-lock",
        &["lock"],
        include_str!("../../../models/watt-i-lock.json"),
    ),
    of(
        "watt-straight-line",
        &["watt"],
        include_str!("../../../models/watt-straight-line.json"),
    ),
    of(
        "whitworth",
        &[],
        include_str!("../../../models/whitworth.json"),
    ),
    of("wiper", &[], include_str!("../../../models/wiper.json")),
];

/// The model that comes in any size: `nfourbar:40` has 40 loops.
pub const FAMILY: &str = "nfourbar";

/// The bundled model of that name or alias.
pub fn find(name: &str) -> Option<&'static Bundled> {
    MODELS
        .iter()
        .find(|model| model.name == name || model.aliases.contains(&name))
}

/// Names and aliases of all of them.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    MODELS
        .iter()
        .flat_map(|model| std::iter::once(model.name).chain(model.aliases.iter().copied()))
}

/// Why there is no bundled model of a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotBundled {
    /// No model has this name.
    Unknown,
    /// A size was asked of a model that has one size only.
    OneSize(&'static str),
    /// The size is no number in the range.
    BadSize,
}

impl fmt::Display for NotBundled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotBundled::Unknown => f.write_str("no bundled model of that name"),
            NotBundled::OneSize(name) => {
                write!(
                    f,
                    "the model {name:?} has one size; only {FAMILY:?} comes in others, as in \"{FAMILY}:40\""
                )
            }
            NotBundled::BadSize => write!(
                f,
                "the size of {FAMILY:?} is its number of loops, a whole number from 1 to {}, as in \"{FAMILY}:40\"",
                four_bars::MOST_LOOPS
            ),
        }
    }
}

/// The file of that name, or alias, or of a size, as in `nfourbar:40`.
///
/// # Errors
/// Where there is none.
pub fn text(name: &str) -> Result<Cow<'static, str>, NotBundled> {
    let (stem, size) = name
        .split_once(':')
        .map_or((name, None), |(stem, size)| (stem, Some(size)));
    let model = find(stem).ok_or(NotBundled::Unknown)?;
    let Some(size) = size else {
        return Ok(Cow::Borrowed(model.text));
    };
    if model.name != FAMILY {
        return Err(NotBundled::OneSize(model.name));
    }
    let loops = size
        .parse()
        .ok()
        .filter(|loops| (1..=four_bars::MOST_LOOPS).contains(loops));
    loops
        .map(|loops| Cow::Owned(four_bars::text(loops)))
        .ok_or(NotBundled::BadSize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_model_file_is_bundled() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models");
        let files: BTreeSet<String> = std::fs::read_dir(folder)
            .expect("models/")
            .filter_map(|entry| {
                entry
                    .ok()?
                    .file_name()
                    .into_string()
                    .ok()?
                    .strip_suffix(".json")
                    .map(String::from)
            })
            .collect();
        let bundled: BTreeSet<String> = MODELS.iter().map(|model| model.name.to_string()).collect();
        assert_eq!(files, bundled);
    }

    #[test]
    fn names_and_aliases_are_unique() {
        let all: Vec<&str> = names().collect();
        assert_eq!(
            all.iter().collect::<BTreeSet<_>>().len(),
            all.len(),
            "{all:?}"
        );
    }

    #[test]
    fn sizes_are_for_the_family_alone() {
        assert_eq!(
            text("lock").as_deref(),
            Ok(find("watt-i-lock").expect("bundled").text)
        );
        assert_eq!(text("nfourbar:2"), text("a02"));
        assert!(
            text("nfourbar:40")
                .expect("a model")
                .contains("\"rocker40\"")
        );
        assert_eq!(text("four-bar:3"), Err(NotBundled::OneSize("four-bar")));
        assert_eq!(text("no-bar:3"), Err(NotBundled::Unknown));
        for size in ["", "0", "-1", "x", "1e3", "50001", "99999999999999999999"] {
            assert_eq!(
                text(&format!("nfourbar:{size}")),
                Err(NotBundled::BadSize),
                "{size}"
            );
        }
    }
}

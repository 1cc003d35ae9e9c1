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

/// All of them, in alphabetical order; a test holds this against the folder.
pub const MODELS: &[Bundled] = &[
    Bundled {
        name: "andrews-squeezer",
        aliases: &["andrews", "a03"],
        text: include_str!("../../../models/andrews-squeezer.json"),
    },
    Bundled {
        name: "bicycle-suspension",
        aliases: &["bicycle"],
        text: include_str!("../../../models/bicycle-suspension.json"),
    },
    Bundled {
        name: "cam-roller",
        aliases: &["cam"],
        text: include_str!("../../../models/cam-roller.json"),
    },
    Bundled {
        name: "chebyshev",
        aliases: &[],
        text: include_str!("../../../models/chebyshev.json"),
    },
    Bundled {
        name: "double-pendulum",
        aliases: &[],
        text: include_str!("../../../models/double-pendulum.json"),
    },
    Bundled {
        name: "double-wishbone",
        aliases: &["suspension"],
        text: include_str!("../../../models/double-wishbone.json"),
    },
    Bundled {
        name: "engine",
        aliases: &[],
        text: include_str!("../../../models/engine.json"),
    },
    Bundled {
        name: "excavator",
        aliases: &[],
        text: include_str!("../../../models/excavator.json"),
    },
    Bundled {
        name: "four-bar",
        aliases: &[],
        text: include_str!("../../../models/four-bar.json"),
    },
    Bundled {
        name: "four-bar-spring",
        aliases: &[],
        text: include_str!("../../../models/four-bar-spring.json"),
    },
    Bundled {
        name: "geared-five-bar",
        aliases: &[],
        text: include_str!("../../../models/geared-five-bar.json"),
    },
    Bundled {
        name: "geneva",
        aliases: &["maltese-cross"],
        text: include_str!("../../../models/geneva.json"),
    },
    Bundled {
        name: "hoeken",
        aliases: &["hoecken"],
        text: include_str!("../../../models/hoeken.json"),
    },
    Bundled {
        name: "jansen-leg",
        aliases: &["jansen", "strandbeest"],
        text: include_str!("../../../models/jansen-leg.json"),
    },
    Bundled {
        name: "klann-leg",
        aliases: &["klann"],
        text: include_str!("../../../models/klann-leg.json"),
    },
    Bundled {
        name: "nfourbar",
        aliases: &["n-four-bar", "a02"],
        text: include_str!("../../../models/nfourbar.json"),
    },
    Bundled {
        name: "parallel-crank",
        aliases: &[],
        text: include_str!("../../../models/parallel-crank.json"),
    },
    Bundled {
        name: "peaucellier",
        aliases: &["inversor"],
        text: include_str!("../../../models/peaucellier.json"),
    },
    Bundled {
        name: "pendulum",
        aliases: &["a01"],
        text: include_str!("../../../models/pendulum.json"),
    },
    Bundled {
        name: "quick-return",
        aliases: &[],
        text: include_str!("../../../models/quick-return.json"),
    },
    Bundled {
        name: "scotch-yoke",
        aliases: &[],
        text: include_str!("../../../models/scotch-yoke.json"),
    },
    Bundled {
        name: "slider-crank",
        aliases: &[],
        text: include_str!("../../../models/slider-crank.json"),
    },
    Bundled {
        name: "slider-crank-clearance",
        aliases: &["clearance"],
        text: include_str!("../../../models/slider-crank-clearance.json"),
    },
    Bundled {
        name: "solar-array",
        aliases: &[],
        text: include_str!("../../../models/solar-array.json"),
    },
    Bundled {
        name: "stephenson-iii",
        aliases: &[],
        text: include_str!("../../../models/stephenson-iii.json"),
    },
    Bundled {
        name: "toggle-clamp",
        aliases: &["clamp"],
        text: include_str!("../../../models/toggle-clamp.json"),
    },
    Bundled {
        name: "walking-strandbeest",
        aliases: &["walker"],
        text: include_str!("../../../models/walking-strandbeest.json"),
    },
    Bundled {
        name: "watt-i-lock",
        aliases: &["lock"],
        text: include_str!("../../../models/watt-i-lock.json"),
    },
    Bundled {
        name: "watt-straight-line",
        aliases: &["watt"],
        text: include_str!("../../../models/watt-straight-line.json"),
    },
    Bundled {
        name: "whitworth",
        aliases: &[],
        text: include_str!("../../../models/whitworth.json"),
    },
    Bundled {
        name: "wiper",
        aliases: &[],
        text: include_str!("../../../models/wiper.json"),
    },
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

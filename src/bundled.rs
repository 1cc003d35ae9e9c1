//! Models that travel with the program: every file of `models/`.

/// One bundled model.
#[derive(Debug, Clone, Copy)]
pub struct Bundled {
    /// The file's name without `.json`.
    pub name: &'static str,
    /// Shorter names.
    pub aliases: &'static [&'static str],
    /// The file.
    pub text: &'static str,
}

/// All of them, in alphabetical order; a test holds this against the folder.
pub const MODELS: &[Bundled] = &[
    Bundled { name: "four-bar", aliases: &[], text: include_str!("../models/four-bar.json") },
    Bundled { name: "geared-five-bar", aliases: &[], text: include_str!("../models/geared-five-bar.json") },
    Bundled { name: "parallel-crank", aliases: &[], text: include_str!("../models/parallel-crank.json") },
    Bundled { name: "quick-return", aliases: &[], text: include_str!("../models/quick-return.json") },
    Bundled { name: "scotch-yoke", aliases: &[], text: include_str!("../models/scotch-yoke.json") },
    Bundled { name: "slider-crank", aliases: &[], text: include_str!("../models/slider-crank.json") },
    Bundled { name: "stephenson-iii", aliases: &[], text: include_str!("../models/stephenson-iii.json") },
    Bundled { name: "watt-i-lock", aliases: &["lock"], text: include_str!("../models/watt-i-lock.json") },
];

/// The bundled model of that name or alias.
pub fn find(name: &str) -> Option<&'static Bundled> {
    MODELS.iter().find(|model| model.name == name || model.aliases.contains(&name))
}

/// Names and aliases of all of them.
pub fn names() -> impl Iterator<Item = &'static str> {
    MODELS.iter().flat_map(|model| std::iter::once(model.name).chain(model.aliases.iter().copied()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_model_file_is_bundled() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/models");
        let files: BTreeSet<String> = std::fs::read_dir(folder)
            .expect("models/")
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok()?.strip_suffix(".json").map(String::from))
            .collect();
        let bundled: BTreeSet<String> = MODELS.iter().map(|model| model.name.to_string()).collect();
        assert_eq!(files, bundled);
    }

    #[test]
    fn names_and_aliases_are_unique() {
        let all: Vec<&str> = names().collect();
        assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len(), "{all:?}");
    }
}

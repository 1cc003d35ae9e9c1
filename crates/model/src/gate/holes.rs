//! Places of a model that hold nothing that counts: what a reader found faulty there was said already.

use std::collections::HashSet;

/// Paths of such places.
#[derive(Debug, Default)]
pub struct Holes {
    paths: HashSet<String>,
    /// Paths whose last key is no name.
    keys: HashSet<String>,
}

impl Holes {
    /// What stands at a path is faulty.
    pub fn add(&mut self, path: &str) {
        self.paths.insert(path.to_owned());
    }

    /// The last key of a path is no name.
    pub fn add_key(&mut self, path: &str) {
        self.keys.insert(path.to_owned());
    }

    /// Whether it was said that the last key of a path is no name.
    pub fn has_key(&self, path: &str) -> bool {
        self.keys.contains(path)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.paths.is_empty() && self.keys.is_empty()
    }

    /// Whether something within a path is faulty.
    pub fn within(&self, path: &str) -> bool {
        let is_within = |hole: &String| {
            let rest = hole.strip_prefix(path);
            rest.is_some_and(|rest| rest.starts_with(['.', '[']))
        };
        self.paths.iter().any(is_within)
    }

    /// Whether what stands at a path, or what it is in, is faulty.
    pub fn has(&self, path: &str) -> bool {
        let ends = path
            .match_indices(['.', '['])
            .map(|(at, _)| at)
            .chain([path.len()]);
        !self.paths.is_empty()
            && (self.paths.contains("")
                || ends
                    .into_iter()
                    .any(|end| self.paths.contains(&path[..end])))
    }
}

//! How often what happened.

use indexmap::IndexMap;
use serde::Serialize;

/// Counts by reason.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Tally {
    counts: IndexMap<String, u64>,
}

impl Tally {
    /// Counts a reason.
    pub fn push(&mut self, reason: &str) {
        self.add(reason, 1);
    }

    fn add(&mut self, reason: &str, count: u64) {
        match self.counts.get_mut(reason) {
            Some(known) => *known += count,
            None => {
                self.counts.insert(reason.to_string(), count);
            }
        }
    }

    /// Takes the counts of another part.
    pub fn merge(&mut self, other: &Tally) {
        for (reason, &count) in &other.counts {
            self.add(reason, count);
        }
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.counts.values().sum()
    }

    /// The reasons with their counts, most frequent first, then by text.
    pub fn sorted(&self) -> Vec<(&str, u64)> {
        let all = self.counts.iter();
        let mut all: Vec<_> = all
            .map(|(reason, &count)| (reason.as_str(), count))
            .collect();
        all.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(b.0)));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_sorted_by_frequency() {
        let mut first = Tally::default();
        ["dead centre", "does not assemble"]
            .into_iter()
            .for_each(|reason| first.push(reason));
        let mut second = Tally::default();
        ["does not assemble", "a limit", "does not assemble"]
            .into_iter()
            .for_each(|reason| second.push(reason));
        first.merge(&second);
        let expected = [("does not assemble", 3), ("a limit", 1), ("dead centre", 1)];
        assert_eq!(first.sorted(), expected);
        assert_eq!(first.total(), 5);
    }
}

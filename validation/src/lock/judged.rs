//! A claim of the paper with the verdict of its rule.

use crate::{Claim, UNKNOWN, Verdict};

/// How far a claim is reproduced.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reproduced {
    Yes,
    Partly,
    /// With some of the centres of mass that the paper leaves open.
    ForSomeCentres,
    No,
}

impl Reproduced {
    /// All, some or none of `tried` statements hold.
    pub fn of(held: usize, tried: usize) -> Self {
        match held {
            0 => Reproduced::No,
            _ if held == tried => Reproduced::Yes,
            _ => Reproduced::Partly,
        }
    }

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Reproduced::Yes => "reproduced",
            Reproduced::Partly => "partly",
            Reproduced::ForSomeCentres => {
                "possible for some centres of mass, which the paper does not give"
            }
            Reproduced::No => "not",
        }
    }

    /// The verdict with the claim, its rule and its figures.
    pub fn judged(self, what: &str, reference: &str, rule: String, figures: String) -> Judged {
        Judged {
            reproduced: self,
            what: what.into(),
            reference: reference.into(),
            rule,
            figures,
            reason: UNKNOWN,
        }
    }
}

impl Judged {
    /// With the reason why it differs, where it does.
    pub fn because(self, reason: &'static str) -> Judged {
        Judged { reason, ..self }
    }
}

/// A claim of the paper, and what its rule says of it.
#[derive(Debug, Clone)]
pub struct Judged {
    pub reproduced: Reproduced,
    pub what: String,
    pub reference: String,
    pub rule: String,
    pub figures: String,
    /// Why it differs, where it does.
    pub reason: &'static str,
}

impl Judged {
    /// As a claim of the case.
    pub fn claim(self) -> Claim {
        Claim {
            what: self.what,
            reference: self.reference,
            ours: format!("{}: {}", self.reproduced.word(), self.figures),
            difference: format!("rule: {}", self.rule),
            verdict: match self.reproduced {
                Reproduced::Yes => Verdict::Agrees,
                Reproduced::Partly | Reproduced::ForSomeCentres | Reproduced::No => {
                    Verdict::Finding(self.reason)
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_some_and_none() {
        let words: Vec<&str> = [4, 1, 0]
            .map(|held| Reproduced::of(held, 4).word())
            .to_vec();
        assert_eq!(words, ["reproduced", "partly", "not"]);
    }
}

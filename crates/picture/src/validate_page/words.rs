//! Verdicts in plain words.

/// What follows from a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judged {
    /// Within the tolerance.
    Agrees,
    /// A difference that is explained, without an error of linkdyn in it.
    Finding,
    /// An error of linkdyn.
    Fault,
}

/// What the three words mean.
pub const MEANINGS: &str = "A finding is a difference to the reference that is explained, not an error of linkdyn: \
the source leaves something out, its numbers do not converge, or a law does not give what is said of it. A fault is an error of linkdyn.";

impl Judged {
    /// The word of a comparison.
    pub fn word(self) -> &'static str {
        match self {
            Judged::Agrees => "agrees",
            Judged::Finding => "differs, explained",
            Judged::Fault => "error of linkdyn",
        }
    }

    /// The class of its colour.
    pub(super) fn class(self) -> &'static str {
        match self {
            Judged::Agrees => "good",
            Judged::Finding => "warn",
            Judged::Fault => "bad",
        }
    }
}

/// How many comparisons ended how.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Within the tolerance.
    pub agreed: usize,
    /// Differences that are explained.
    pub findings: usize,
    /// Errors of linkdyn.
    pub faults: usize,
}

impl Counts {
    /// With one comparison more.
    pub fn add(&mut self, judged: Judged) {
        match judged {
            Judged::Agrees => self.agreed += 1,
            Judged::Finding => self.findings += 1,
            Judged::Fault => self.faults += 1,
        }
    }

    /// Counts of several cases.
    pub fn sum(all: impl IntoIterator<Item = Counts>) -> Counts {
        all.into_iter()
            .fold(Counts::default(), |sum, counts| Counts {
                agreed: sum.agreed + counts.agreed,
                findings: sum.findings + counts.findings,
                faults: sum.faults + counts.faults,
            })
    }

    /// The class of their colour: what is explained is no warning.
    pub(super) fn class(self) -> &'static str {
        if self.faults > 0 { "bad" } else { "good" }
    }

    /// `28 of 38 comparisons agree, 10 differ for reasons that are explained. No error of linkdyn was found.`
    pub fn sentence(self) -> String {
        let Counts {
            agreed,
            findings,
            faults,
        } = self;
        let all = agreed + findings + faults;
        let agree = match (agreed == all, all) {
            (true, 0) => "Nothing was compared".to_string(),
            (true, 1) => "The one comparison agrees".to_string(),
            (true, _) => format!("All {all} comparisons agree"),
            (false, 1) => "The one comparison does not agree".to_string(),
            (false, _) => format!("{agreed} of {all} comparisons agree"),
        };
        let differ = match findings {
            0 => String::new(),
            1 => ", 1 differs for a reason that is explained".to_string(),
            _ => format!(", {findings} differ for reasons that are explained"),
        };
        let wrong = match faults {
            0 => "No error of linkdyn was found.".to_string(),
            1 => "1 shows an error of linkdyn.".to_string(),
            _ => format!("{faults} show errors of linkdyn."),
        };
        format!("{agree}{differ}. {wrong}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_told_in_words() {
        let told = |agreed, findings, faults| {
            Counts {
                agreed,
                findings,
                faults,
            }
            .sentence()
        };
        assert_eq!(
            told(38, 0, 0),
            "All 38 comparisons agree. No error of linkdyn was found."
        );
        assert_eq!(
            told(28, 10, 0),
            "28 of 38 comparisons agree, 10 differ for reasons that are explained. No error of linkdyn was found."
        );
        assert_eq!(
            told(1, 1, 2),
            "1 of 4 comparisons agree, 1 differs for a reason that is explained. 2 show errors of linkdyn."
        );
    }
}

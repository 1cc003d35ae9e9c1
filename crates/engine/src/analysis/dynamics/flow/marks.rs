//! The guards at the evaluations of the last step.

/// Evaluations remembered: those of one step of any method are among them.
const REMEMBERED: usize = 24;

/// Times of evaluations, and the largest of all guards there, above zero where an event has passed.
pub(super) struct Marks {
    marks: [(f64, f64); REMEMBERED],
    next: usize,
}

impl Marks {
    /// None yet.
    pub fn new() -> Self {
        Marks {
            marks: [(f64::NEG_INFINITY, f64::NEG_INFINITY); REMEMBERED],
            next: 0,
        }
    }

    /// An evaluation.
    pub fn note(&mut self, t: f64, guard: f64) {
        self.marks[self.next] = (t, guard);
        self.next = (self.next + 1) % REMEMBERED;
    }

    /// Whether one within (from, to] has passed an event.
    pub fn has_passed(&self, from: f64, to: f64) -> bool {
        let within = |&&(t, _): &&(f64, f64)| t > from && t <= to;
        self.marks
            .iter()
            .filter(within)
            .any(|&(_, guard)| guard > 0.0)
    }
}

//! The guards at the evaluations of the last step.

/// Evaluations remembered: those of one step of any method are among them.
const REMEMBERED: usize = 24;

/// What of a guard makes no event: a rate that is not above this, and a change of its value that is not.
#[derive(Debug, Clone, Copy, Default)]
pub struct Least {
    /// In its unit by second.
    pub rate: f64,
    /// In its unit.
    pub change: f64,
}

/// A guard at one time, by functions that are smooth within a step, above zero together where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The guard itself; of a contact in flight its level \[m\].
    pub value: f64,
    /// The rate of that; NaN where it is not known.
    pub rate: f64,
    /// How far a contact in flight is from where its surface ends \[m\]; infinite of all others.
    pub rooms: [f64; 2],
}

impl Sample {
    /// Of a guard whose rate is not known.
    pub fn of(value: f64) -> Self {
        Sample {
            value,
            rate: f64::NAN,
            rooms: [f64::INFINITY; 2],
        }
    }

    /// Of a guard that is looked at where the mechanism is evaluated, and nowhere between.
    pub fn never() -> Self {
        Sample::of(f64::NEG_INFINITY)
    }
}

/// Times of evaluations, the guards there, and the largest of all of them, above zero where an event has passed.
#[derive(Clone)]
pub(super) struct Marks {
    marks: [(f64, f64); REMEMBERED],
    next: usize,
    /// Evaluations since the step began.
    since: usize,
    /// Those of each guard, evaluation by evaluation.
    samples: Vec<Sample>,
    guards: usize,
    /// Levels of the arguments of each formula, evaluation by evaluation.
    levels: Vec<[f64; 2]>,
    arguments: usize,
}

impl Marks {
    /// None yet, of so many guards and arguments of formulas.
    pub fn new([guards, arguments]: [usize; 2]) -> Self {
        Marks {
            marks: [(f64::NEG_INFINITY, f64::NEG_INFINITY); REMEMBERED],
            next: 0,
            since: 0,
            samples: vec![Sample::never(); REMEMBERED * guards],
            guards,
            levels: vec![[0.0; 2]; REMEMBERED * arguments],
            arguments,
        }
    }

    /// The samples of an evaluation that is noted next.
    pub fn samples_mut(&mut self) -> &mut [Sample] {
        &mut self.samples[self.next * self.guards..][..self.guards]
    }

    /// The levels of the formulas' arguments there.
    pub fn levels_mut(&mut self) -> &mut [[f64; 2]] {
        &mut self.levels[self.next * self.arguments..][..self.arguments]
    }

    /// An evaluation, and the largest of its guards.
    pub fn note(&mut self, t: f64, guard: f64) {
        self.marks[self.next] = (t, guard);
        self.next = (self.next + 1) % REMEMBERED;
        self.since += 1;
    }

    /// A step begins.
    pub fn begin_step(&mut self) {
        self.since = 0;
    }

    /// Where the last evaluations are, the last one first.
    fn newest(&self) -> impl Iterator<Item = usize> {
        (1..=REMEMBERED).map(|back| (self.next + REMEMBERED - back) % REMEMBERED)
    }

    /// Whether one within (from, to] has passed an event.
    pub fn has_passed(&self, from: f64, to: f64) -> bool {
        self.newest().any(|index| {
            let (t, guard) = self.marks[index];
            t > from && t <= to && guard > 0.0
        })
    }

    /// The evaluations of the step from one time to another, the last one first, and that of its beginning. Those of a longer step
    /// that was rejected stand before one beyond its end.
    pub fn of_step(&self, from: f64, to: f64) -> impl Iterator<Item = Mark<'_>> {
        let time = |index: &usize| self.marks[*index].0;
        let own = self.newest().take(self.since);
        let own = own.take_while(move |index| time(index) <= to);
        let before = self.newest().skip(self.since);
        let beginning = before.filter(move |index| time(index) == from).take(1);
        let all = own.filter(move |index| time(index) >= from);
        all.chain(beginning).map(|index| Mark {
            time: self.marks[index].0,
            samples: &self.samples[index * self.guards..][..self.guards],
            levels: &self.levels[index * self.arguments..][..self.arguments],
        })
    }
}

/// What is known of an evaluation.
pub struct Mark<'a> {
    /// When \[s\].
    pub time: f64,
    /// A sample of each guard.
    pub samples: &'a [Sample],
    /// The levels of the arguments of all formulas.
    pub levels: &'a [[f64; 2]],
}

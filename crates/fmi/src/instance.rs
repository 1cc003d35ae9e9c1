//! An instance of a unit: its life, the values of its variables, steps, derivatives, states.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use linkdyn::fmu::{Interface, MODEL, Role, STEERED, token};
use linkdyn::{Event, Mechanism, Quantity};

use crate::motion::Motion;
use crate::phase::Phase;
use crate::refusal::{Refusal, Severity};
use crate::state::State;

/// How far an importer's clock may be from the instance's, of the step.
const CLOCK: f64 = 1e-6;

/// Where messages go: a category, and a line.
pub type Log = Box<dyn Fn(Option<Severity>, &str, &str)>;

/// With what an instance is made.
pub struct Made<'a> {
    /// The unit's token, as its description has it.
    pub token: &'a str,
    /// The folder `resources` of the unit.
    pub resources: &'a Path,
    /// Events end steps, and are acknowledged.
    pub stops_at_events: bool,
    /// Events are logged.
    pub is_logging: bool,
}

/// When the motion begins, and ends at the latest \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start {
    /// Where the model's t is 0.
    pub start: f64,
    /// No step goes beyond.
    pub end: Option<f64>,
}

/// What a step led to.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stepped {
    /// The instant \[s\].
    pub time: f64,
    /// It ended at an event, before its end.
    pub is_early: bool,
    /// An event is to be acknowledged.
    pub has_event: bool,
}

/// An instance.
pub struct Instance {
    mechanism: Mechanism,
    interface: Arc<Interface>,
    token: String,
    stops_at_events: bool,
    /// Whether events are logged.
    pub is_logging: bool,
    log: Log,
    phase: Phase,
    /// By value reference, of what can be set.
    values: Vec<f64>,
    start: f64,
    end: Option<f64>,
    events: u32,
    motion: Option<Motion>,
}

/// Life.
impl Instance {
    /// Reads the model.
    ///
    /// # Errors
    /// Where the folder has no model, or another one than the token says, or it has faults.
    pub fn new(made: &Made, log: Log) -> Result<Self, Refusal> {
        let path = made.resources.join(MODEL);
        let text = fs::read(&path)
            .map_err(|why| Refusal::new(format!("{}: can't be read: {why}", path.display())))?;
        let steered = fs::read(made.resources.join(STEERED)).unwrap_or_default();
        let own = token(&text, &steered);
        if own != made.token {
            return Err(Refusal::new(format!(
                "the token {:?} is not that of the model in {}: {own:?}",
                made.token,
                path.display()
            )));
        }
        let mechanism = Mechanism::open(&path)?;
        let steered = match &steered[..] {
            [] => Vec::new(),
            list => serde_json::from_slice(list)
                .map_err(|why| Refusal::new(format!("{STEERED}: {why}")))?,
        };
        let interface = Arc::new(Interface::new(&mechanism, &steered)?);
        Ok(Instance {
            values: starts(&interface),
            mechanism,
            interface,
            token: own,
            stops_at_events: made.stops_at_events,
            is_logging: made.is_logging,
            log,
            phase: Phase::Instantiated,
            start: 0.0,
            end: None,
            events: 0,
            motion: None,
        })
    }

    /// Its variables.
    pub fn interface(&self) -> &Interface {
        &self.interface
    }

    /// Says something to the importer.
    pub fn log(&self, severity: Option<Severity>, category: &str, message: &str) {
        (self.log)(severity, category, message);
    }

    /// A fault of linkdyn has left it in pieces.
    pub fn break_down(&mut self) {
        self.phase = Phase::Broken;
    }

    /// Refuses what is legal in other phases only.
    fn need(&self, legal: &[Phase], what: &str) -> Result<(), Refusal> {
        if legal.contains(&self.phase) {
            return Ok(());
        }
        let legal: Vec<&str> = legal.iter().map(|phase| phase.name()).collect();
        let legal = legal.join(" or ");
        let now = self.phase.name();
        Err(Refusal::new(format!(
            "{what} is legal {legal}, and this is {now}"
        )))
    }

    /// When the motion begins and ends.
    ///
    /// # Errors
    /// Too late, or no numbers.
    pub fn set_start(&mut self, Start { start, end }: Start) -> Result<(), Refusal> {
        self.need(&[Phase::Instantiated], "setting the start time")?;
        let is_good = start.is_finite() && end.is_none_or(|end| end.is_finite() && end >= start);
        if !is_good {
            return Err(Refusal::new(format!(
                "the simulation can't go from {start} s to {} s",
                end.unwrap_or(f64::INFINITY)
            )));
        }
        (self.start, self.end) = (start, end);
        Ok(())
    }

    /// Begins initialization.
    ///
    /// # Errors
    /// Where it is not the time for that.
    pub fn enter_initialization(&mut self) -> Result<(), Refusal> {
        self.need(&[Phase::Instantiated], "entering initialization mode")?;
        self.phase = Phase::Initialization;
        Ok(())
    }

    /// Ends initialization: the motion begins.
    ///
    /// # Errors
    /// Where it is not the time for that, or the motion can't begin.
    pub fn exit_initialization(&mut self) -> Result<(), Refusal> {
        self.need(&[Phase::Initialization], "leaving initialization mode")?;
        self.motion()?;
        self.phase = match self.stops_at_events {
            true => Phase::Event,
            false => Phase::Step,
        };
        Ok(())
    }

    /// Goes over to the acknowledgement of an event.
    ///
    /// # Errors
    /// Where it is not the time for that.
    pub fn enter_event(&mut self) -> Result<(), Refusal> {
        if !self.stops_at_events {
            return Err(Refusal::new(
                "event mode is legal in an instance that was made with eventModeUsed",
            ));
        }
        self.need(&[Phase::Step], "entering event mode")?;
        self.phase = Phase::Event;
        Ok(())
    }

    /// Whether there is something to do at an event: nothing, the engine has done it.
    ///
    /// # Errors
    /// Where it is not the time for that.
    pub fn update_discrete_states(&self) -> Result<(), Refusal> {
        self.need(
            &[Phase::Initialization, Phase::Event],
            "updating discrete states",
        )
    }

    /// Goes on with steps.
    ///
    /// # Errors
    /// Where it is not the time for that.
    pub fn enter_step(&mut self) -> Result<(), Refusal> {
        self.need(&[Phase::Event], "entering step mode")?;
        self.phase = Phase::Step;
        Ok(())
    }

    /// Ends the motion.
    ///
    /// # Errors
    /// Where none has begun.
    pub fn terminate(&mut self) -> Result<(), Refusal> {
        self.need(&[Phase::Step, Phase::Event], "terminating")?;
        self.phase = Phase::Terminated;
        Ok(())
    }

    /// Everything is as it was when the instance was made.
    ///
    /// # Errors
    /// After a fault of linkdyn.
    pub fn reset(&mut self) -> Result<(), Refusal> {
        self.whole()?;
        self.phase = Phase::Instantiated;
        self.values = starts(&self.interface);
        (self.start, self.end, self.events) = (0.0, None, 0);
        self.motion = None;
        Ok(())
    }

    /// Refuses to go on after a fault of linkdyn.
    fn whole(&self) -> Result<(), Refusal> {
        if self.phase == Phase::Broken {
            return Err(Refusal::new(
                "the instance can only be freed after a fault of linkdyn",
            ));
        }
        Ok(())
    }
}

/// The values that variables have before they are set.
fn starts(interface: &Interface) -> Vec<f64> {
    let references = 0..interface.variables.len();
    references
        .map(|reference| interface.start(reference).unwrap_or_default())
        .collect()
}

/// Values.
impl Instance {
    fn role(&self, reference: u32) -> Result<Role, Refusal> {
        let variable = self.interface.variables.get(reference as usize);
        let variable = variable.ok_or_else(|| {
            Refusal::new(format!(
                "no variable has the value reference {reference}: they go from 0 to {}",
                self.interface.variables.len() - 1
            ))
        })?;
        Ok(variable.role)
    }

    /// Values of variables that are real numbers.
    ///
    /// # Errors
    /// Others, and outputs before initialization.
    pub fn get(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), Refusal> {
        same(references.len(), values.len())?;
        self.whole()?;
        for (reference, value) in references.iter().zip(values) {
            *value = match self.role(*reference)? {
                Role::Time => self.time(),
                Role::Parameter(_) | Role::Input(_) | Role::Acceleration => {
                    self.values[*reference as usize]
                }
                Role::Output { column, .. } => self.output(*reference, column)?,
                Role::Events => return Err(self.mistaken(*reference, "a whole number")),
            };
        }
        Ok(())
    }

    /// Values of variables that are whole numbers.
    ///
    /// # Errors
    /// Others.
    pub fn get_counts(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Refusal> {
        same(references.len(), values.len())?;
        self.whole()?;
        for (reference, value) in references.iter().zip(values) {
            *value = match self.role(*reference)? {
                Role::Events => i32::try_from(self.events).unwrap_or(i32::MAX),
                Role::Time
                | Role::Parameter(_)
                | Role::Input(_)
                | Role::Acceleration
                | Role::Output { .. } => {
                    return Err(self.mistaken(*reference, "a real number"));
                }
            };
        }
        Ok(())
    }

    /// Sets variables that are real numbers: inputs, and before the motion begins parameters.
    ///
    /// # Errors
    /// Others, and values that are no numbers.
    pub fn set(&mut self, references: &[u32], values: &[f64]) -> Result<(), Refusal> {
        same(references.len(), values.len())?;
        self.whole()?;
        for (&reference, &value) in references.iter().zip(values) {
            let role = self.role(reference)?;
            let name = self.name(reference);
            if !value.is_finite() {
                return Err(Refusal::new(format!("{name} can't be {value}")));
            }
            match role {
                Role::Parameter(_) => {
                    let what = format!("setting {name}");
                    self.need(&[Phase::Instantiated, Phase::Initialization], &what)?;
                    if std::mem::replace(&mut self.values[reference as usize], value) != value {
                        self.motion = None;
                    }
                }
                Role::Input(_) | Role::Acceleration => {
                    let what = format!("setting {name}");
                    self.need(&Phase::BEFORE_THE_END, &what)?;
                    let was = std::mem::replace(&mut self.values[reference as usize], value);
                    if let Some(motion) = self.motion.as_mut().filter(|_| was != value) {
                        motion.set(reference, value)?;
                    }
                }
                Role::Time | Role::Output { .. } | Role::Events => {
                    return Err(Refusal::new(format!(
                        "{name} can't be set: parameters and inputs can"
                    )));
                }
            }
        }
        Ok(())
    }

    /// The instant \[s\].
    pub fn time(&self) -> f64 {
        self.start + self.motion.as_ref().map_or(0.0, Motion::time)
    }

    fn output(&mut self, reference: u32, column: linkdyn::Column) -> Result<f64, Refusal> {
        if self.phase == Phase::Instantiated {
            let what = format!("the value of {}", self.name(reference));
            self.need(&[Phase::Initialization, Phase::Step, Phase::Event], &what)?;
        }
        self.motion()?.value(column)
    }

    fn name(&self, reference: u32) -> String {
        self.interface.variables[reference as usize].name.clone()
    }

    fn mistaken(&self, reference: u32, what: &str) -> Refusal {
        Refusal::new(format!("{} is {what}", self.name(reference)))
    }

    /// The motion, which begins when it is first needed.
    fn motion(&mut self) -> Result<&mut Motion, Refusal> {
        let motion = match self.motion.take() {
            Some(motion) => motion,
            None => {
                let mechanism = self.with_values(&self.values)?;
                Motion::new(&mechanism, &self.interface, &self.values)?
            }
        };
        Ok(self.motion.insert(motion))
    }

    /// The mechanism with these values of parameters.
    fn with_values(&self, values: &[f64]) -> Result<Mechanism, Refusal> {
        let mut given = Vec::new();
        for (variable, &value) in self.interface.variables.iter().zip(values) {
            let Role::Parameter(handle) = variable.role else {
                continue;
            };
            if value != handle.nominal().si() {
                given.push((handle, quantity(value, &variable.unit)?));
            }
        }
        match given.is_empty() {
            true => Ok(self.mechanism.clone()),
            false => Ok(self.mechanism.with(given)?),
        }
    }
}

/// A value in an SI unit.
fn quantity(value: f64, unit: &str) -> Result<Quantity, Refusal> {
    match unit {
        "" => Ok(value.into()),
        unit => Ok(Quantity::new(value, unit)?),
    }
}

/// As many values as references.
fn same(references: usize, values: usize) -> Result<(), Refusal> {
    match references == values {
        true => Ok(()),
        false => Err(Refusal::new(format!(
            "{values} values for {references} value references"
        ))),
    }
}

/// Steps.
impl Instance {
    /// Steps from `now`, which is the instant, by `step` \[s\].
    ///
    /// # Errors
    /// A wrong instant or step, and, as [`Severity::Discard`], a motion that can't go on: it is where its last step ended.
    pub fn step(&mut self, now: f64, step: f64) -> Result<Stepped, Refusal> {
        self.need(&[Phase::Step], "a step")?;
        let time = self.time();
        if !(step > 0.0 && step.is_finite()) {
            return Err(Refusal::new(format!(
                "a step of {step} s: it must be positive"
            )));
        }
        let slack = CLOCK * step;
        let is_there = (now - time).abs() <= slack;
        if !is_there {
            return Err(Refusal::new(format!(
                "a step from t = {now} s, and the instance is at t = {time} s"
            )));
        }
        let until = now + step;
        if let Some(end) = self.end.filter(|end| until > end + slack) {
            return Err(Refusal::new(format!(
                "a step to t = {until} s, beyond the end of the simulation at t = {end} s"
            )));
        }
        let (start, to_event) = (self.start, self.stops_at_events);
        let target = until - start;
        let stepped = self.motion()?.step(target, to_event);
        let happened = stepped.map_err(|refusal| Refusal {
            severity: Severity::Discard,
            ..refusal
        })?;
        self.note(&happened);
        let reached = self.time();
        Ok(Stepped {
            time: reached,
            is_early: reached < until,
            has_event: to_event && !happened.is_empty(),
        })
    }

    fn note(&mut self, happened: &[Event]) {
        self.events = self.events.saturating_add(happened.len() as u32);
        if self.is_logging {
            for event in happened {
                self.log(None, "logEvents", &told(event));
            }
        }
    }
}

/// An event in words.
fn told(event: &Event) -> String {
    let of = event.joint.as_ref().or(event.driver.as_ref());
    let parts = [
        Some(event.kind.name()),
        of.map(String::as_str),
        event.note.as_deref(),
    ];
    let parts: Vec<&str> = parts.into_iter().flatten().collect();
    format!("t = {} s: {}", event.time, parts.join(", "))
}

/// Step of inputs for differences, of their size, or of 1 where that is less.
const DIFFERENCE: f64 = 1e-3;

/// Derivatives.
impl Instance {
    /// How outputs change where inputs change by a seed, at the instant: by central differences of two steps, of fourth order. So it is
    /// exact, but for round-off, where accelerations and forces are linear in inputs, or squares of them.
    ///
    /// # Errors
    /// Variables that are no outputs, or no inputs.
    pub fn derivative(
        &mut self,
        (knowns, seed): (&[u32], &[f64]),
        (unknowns, sensitivity): (&[u32], &mut [f64]),
    ) -> Result<(), Refusal> {
        same(knowns.len(), seed.len())?;
        same(unknowns.len(), sensitivity.len())?;
        let legal = [Phase::Initialization, Phase::Step, Phase::Event];
        self.need(&legal, "a directional derivative")?;
        let mut columns = Vec::new();
        for &unknown in unknowns {
            let Role::Output { column, .. } = self.role(unknown)? else {
                return Err(self.mistaken(unknown, "no output that has derivatives"));
            };
            columns.push(column);
        }
        let mut inputs = Vec::new();
        for (&known, &seed) in knowns.iter().zip(seed) {
            if !matches!(self.role(known)?, Role::Input(_) | Role::Acceleration) {
                let what = "no input, by which outputs have derivatives";
                return Err(self.mistaken(known, what));
            }
            if !seed.is_finite() {
                let name = self.name(known);
                return Err(Refusal::new(format!("the seed of {name} is {seed}")));
            }
            inputs.push((known, self.values[known as usize], seed));
        }
        let most = |&(_, value, seed): &(u32, f64, f64)| {
            DIFFERENCE * f64::max(1.0, value.abs()) / seed.abs()
        };
        let step = inputs.iter().map(most).fold(f64::INFINITY, f64::min);
        sensitivity.fill(0.0);
        if !step.is_finite() {
            return Ok(());
        }
        let motion = self.motion()?;
        let point = motion.point();
        // f′ = (8 (f(h/2) − f(−h/2)) − (f(h) − f(−h))) / (6 h/2 · 2)
        let weights = [(0.5, 8.0), (-0.5, -8.0), (1.0, -1.0), (-1.0, 1.0)];
        let mut differences = || {
            for (part, weight) in weights {
                for &(known, value, seed) in &inputs {
                    motion.set(known, value + part * step * seed)?;
                }
                for (column, sum) in columns.iter().zip(&mut *sensitivity) {
                    *sum += weight * motion.value(*column)? / (6.0 * step);
                }
            }
            Ok(())
        };
        let done = differences();
        motion.restore(&point);
        done
    }
}

/// States.
impl Instance {
    /// Keeps where it is.
    ///
    /// # Errors
    /// After a fault of linkdyn.
    pub fn state(&mut self) -> Result<State, Refusal> {
        self.whole()?;
        Ok(State {
            phase: self.phase,
            values: self.values.clone(),
            start: self.start,
            end: self.end,
            events: self.events,
            point: self.motion.as_mut().map(Motion::point),
        })
    }

    /// Goes to a state of this instance, or of another one of the unit.
    ///
    /// # Errors
    /// After a fault of linkdyn, and where the motion can't be had again.
    pub fn set_state(&mut self, state: &State) -> Result<(), Refusal> {
        self.whole()?;
        if state.values.len() != self.values.len() {
            return Err(Refusal::new("the state is one of another unit"));
        }
        match &state.point {
            None => self.motion = None,
            Some(point) => {
                let own = self.motion.as_mut();
                if !own.is_some_and(|motion| motion.restore(point)) {
                    let mechanism = self.with_values(&state.values)?;
                    self.motion = Some(Motion::repeat(&mechanism, &self.interface, point)?);
                }
            }
        }
        self.values.clone_from(&state.values);
        self.phase = state.phase;
        (self.start, self.end, self.events) = (state.start, state.end, state.events);
        Ok(())
    }

    /// A state as bytes.
    ///
    /// # Errors
    /// Where it has too many steps.
    pub fn bytes(&self, state: &State) -> Result<Vec<u8>, Refusal> {
        state.bytes(&self.token)
    }

    /// A state from bytes.
    ///
    /// # Errors
    /// Where they are none of this unit.
    pub fn state_of(&self, bytes: &[u8]) -> Result<State, Refusal> {
        State::read(bytes, &self.token)
    }
}

//! A motion that is stepped from outside: forces come and go between its steps, and it can go back to where it was.
//!
//! It is the same [`Simulation`] that a run steps through, with steps that end where it is wanted.

use super::ended::Ended;
use super::sampling::Sampling;
use super::scene::Scene;
use super::settings::Settings;
use super::simulation::Simulation;
use super::start::Start;
use crate::analysis::control::{Control, Stop};
use crate::analysis::derived_columns::{DerivedColumns, DerivedSelection};
use crate::analysis::rows::Columns;
use crate::system::{ForceLaw, Pushes, Steered, System};
use linkdyn_model::error::Complaint;
use linkdyn_output::Event;
use self_cell::self_cell;
use std::borrow::Cow;
use std::sync::{Arc, Weak};

/// A motion at an instant, which can be stepped on.
pub struct Stepped {
    cell: Cell,
    /// Result columns of the instant.
    row: Vec<f64>,
    /// q and v (n) there.
    state: [Vec<f64>; 2],
    /// That instant \[s\].
    time: f64,
}

/// A point of a motion to which it can go back. The motion keeps it as long as there is a copy of this.
#[derive(Debug, Clone)]
pub struct Snapshot(Arc<()>);

self_cell!(
    struct Cell {
        owner: Scene<'static>,
        #[not_covariant]
        dependent: SteppedMotion,
    }
);

/// The motion and what is kept of it.
struct SteppedMotion<'s> {
    now: Simulation<'s>,
    snapshots: Vec<(Weak<()>, Simulation<'s>)>,
    sampling: Sampling,
    beside: DerivedColumns<'s>,
}

impl Stepped {
    /// At t = 0, with these columns behind those that the run has, and these drivers steered.
    ///
    /// # Errors
    /// Faults of the input, and a start that is impossible.
    pub(in crate::analysis) fn new(
        system: &System,
        start: Start,
        settings: &Settings,
        following: &DerivedSelection,
        steered: &[usize],
    ) -> Result<Self, Stop> {
        let mut system = system.clone();
        system.is_pushed = true;
        for driver in steered {
            system.drivers[*driver].is_steered = true;
        }
        // The first step is chosen by how far the model's run would go.
        let end = settings.instants.last().copied();
        let end = end.filter(|end| *end > 0.0).unwrap_or(system.scale.time);
        let scene = Scene::new(Cow::Owned(system), start)?;
        let cell = Cell::try_new(scene, |scene| {
            let system = scene.system();
            let columns = Columns::of(&settings.contents.columns(system));
            Ok::<_, Stop>(SteppedMotion {
                now: scene.begin(settings, end)?,
                snapshots: Vec::new(),
                sampling: Sampling::new(system, settings.contents, 1),
                beside: DerivedColumns::new(system, &columns, following),
            })
        })?;
        let mut stepped = Stepped {
            cell,
            row: Vec::new(),
            state: [Vec::new(), Vec::new()],
            time: 0.0,
        };
        stepped.sample()?;
        Ok(stepped)
    }

    /// The mechanism.
    pub fn system(&self) -> &System {
        self.cell.borrow_owner().system()
    }

    /// The instant \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Coordinates (n) \[m, rad\].
    pub fn position(&self) -> &[f64] {
        &self.state[0]
    }

    /// Their rates (n) [m/s, rad/s].
    pub fn velocity(&self) -> &[f64] {
        &self.state[1]
    }

    /// The result columns.
    pub fn row(&self) -> &[f64] {
        &self.row
    }

    /// Steps to a later instant, and tells what happened since this was asked last; where it stops at events, it goes no farther
    /// than to the first one that there is to tell.
    ///
    /// # Errors
    /// An instant that has passed or is not finite, and where the motion can't go on.
    pub fn step_to(
        &mut self,
        time: f64,
        stops_at_events: bool,
        control: &Control,
    ) -> Result<Vec<Event>, Stop> {
        if !time.is_finite() {
            let message = format!("the instant is {time}, not a finite number of seconds");
            return Err(Complaint::new("time", message).into());
        }
        if time < self.time {
            let now = self.system().display.time(self.time);
            let message = format!("the simulation is at t = {now} and does not step back");
            let complaint = Complaint::new("time", message);
            return Err(complaint.hint("restore a snapshot").into());
        }
        let reached = (self.cell)
            .with_dependent_mut(|_, kept| kept.now.step_to(time, stops_at_events, control));
        // Where it can't go on, it is where its last step ended.
        self.time = (self.cell).with_dependent(|_, kept| kept.now.time());
        let sampled = self.sample();
        reached.map_err(Stop::from).and(sampled)?;
        Ok(self.cell.with_dependent_mut(|_, kept| kept.now.news()))
    }

    /// Forces F (n) \[N, N·m\] act from now on, until other ones do.
    pub fn hold(&mut self, force: &[f64]) {
        self.push(Pushes::Held(force.into()));
    }

    /// F is this function of time, position and velocity from now on.
    pub fn follow(&mut self, law: Arc<ForceLaw>) {
        self.push(Pushes::Law(law));
    }

    fn push(&mut self, pushes: Pushes) {
        self.cell
            .with_dependent_mut(|_, kept| kept.now.push(pushes));
    }

    /// Names of the inputs.
    pub fn inputs(&self) -> impl Iterator<Item = &str> {
        self.system().inputs.iter().map(|input| input.name.as_str())
    }

    /// The value of an input.
    pub fn input(&self, input: usize) -> f64 {
        (self.cell).with_dependent(|_, kept| kept.now.flow.equations.inputs.states[input])
    }

    /// An input has this value from now on.
    pub fn set_input(&mut self, input: usize, value: f64) {
        self.cell.with_dependent_mut(|_, kept| {
            kept.now.flow.equations.inputs.states[input] = value;
            kept.now.is_pushed_anew = true;
        });
    }

    /// A driver goes on from where it is, with this acceleration [rad/s² or m/s²] from now on.
    ///
    /// # Errors
    /// Where it was not said at the beginning that it is steered.
    pub fn set_acceleration(&mut self, driver: usize, acceleration: f64) -> Result<(), Stop> {
        if !self.system().drivers[driver].is_steered {
            let name = &self.system().drivers[driver].name;
            let message = "its acceleration can't be set, it follows its motion";
            let complaint = Complaint::new(format!("drivers.{name}"), message);
            return Err(complaint
                .hint("begin the simulation with this driver steered")
                .into());
        }
        let time = self.time;
        self.cell.with_dependent_mut(|scene, kept| {
            let inputs = &mut kept.now.flow.equations.inputs;
            inputs.set_time(scene.system(), time);
            let [value, rate, _] = inputs.drive[driver];
            inputs.steered.retain(|one| one.driver != driver);
            let jet = [value, rate, acceleration];
            let since = time;
            inputs.steered.push(Steered { driver, since, jet });
            kept.now.is_pushed_anew = true;
        });
        Ok(())
    }

    /// Keeps the motion as it is.
    pub fn snapshot(&mut self) -> Snapshot {
        let mark = Arc::new(());
        self.cell.with_dependent_mut(|_, kept| {
            kept.snapshots.retain(|(mark, _)| mark.strong_count() > 0);
            let now = kept.now.clone();
            kept.snapshots.push((Arc::downgrade(&mark), now));
        });
        Snapshot(mark)
    }

    /// Goes back to where it was; from there it goes on as it did, bit by bit.
    ///
    /// # Errors
    /// Where the snapshot is one of another motion.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Stop> {
        let time = self.cell.with_dependent_mut(|_, kept| {
            let mut snapshots = kept.snapshots.iter();
            let is_it = |mark: &Weak<()>| mark.as_ptr() == Arc::as_ptr(&snapshot.0);
            let (_, kept_then) = snapshots.find(|(mark, _)| is_it(mark))?;
            kept.now = kept_then.clone();
            Some(kept.now.time())
        });
        let Some(time) = time else {
            let message = "the snapshot is one of another simulation";
            return Err(Complaint::new("snapshot", message).into());
        };
        self.time = time;
        self.sample()
    }

    /// Evaluates the mechanism where it is.
    fn sample(&mut self) -> Result<(), Stop> {
        let (time, row, [q, v]) = (self.time, &mut self.row, &mut self.state);
        self.cell.with_dependent_mut(|scene, kept| {
            let SteppedMotion {
                now,
                sampling,
                beside,
                ..
            } = kept;
            let fault = match now.output(time) {
                Ok((flow, [dissipated, _])) => {
                    sampling.take(flow);
                    let (system, inputs) = (scene.system(), &flow.equations.inputs);
                    let elastic = flow.equations.evaluation().contact_energy(system, inputs);
                    sampling.sample.contact_energy = [elastic, dissipated];
                    sampling.push(flow);
                    let numbers = scene.system().inputs.len();
                    beside.give(&flow.equations.inputs.states[..numbers]);
                    None
                }
                Err(fault) => Some(fault),
            };
            if let Some(fault) = fault {
                return Err(now.ended_at(fault, time).into());
            }
            q.clone_from(&sampling.sample.q);
            v.clone_from(&sampling.sample.v);
            std::mem::swap(row, &mut sampling.recorder.trajectory.data);
            sampling.recorder.trajectory.data.clear();
            let own = row.clone();
            beside.push(&own, row);
            Ok(())
        })
    }
}

/// What a step from outside asks of the motion.
impl Simulation<'_> {
    /// Steps to `time`, where the last step ends; or to the first event before it, if that is where to stop.
    ///
    /// # Errors
    /// As [`Simulation::reach`].
    pub fn step_to(
        &mut self,
        time: f64,
        stops_at_events: bool,
        control: &Control,
    ) -> Result<(), Ended> {
        self.steps.set_end(time);
        while stops_at_events && self.reached() < time {
            // A step, or what happens at the end of the last one.
            match self.event.take() {
                Some(event) => self.changed(event)?,
                None => self.reach(self.reached().next_up(), control)?,
            }
            if self.ledger.has_news() {
                return Ok(());
            }
        }
        self.reach(time, control)
    }

    /// What happens at an event, as [`Simulation::reach`] tells its failure.
    fn changed(&mut self, event: f64) -> Result<(), Ended> {
        self.change(event).map_err(|fault| self.ended(fault, event))
    }

    /// End of the last step \[s\].
    pub fn time(&self) -> f64 {
        self.steps.time()
    }

    /// Other forces act from outside from now on.
    pub fn push(&mut self, pushes: Pushes) {
        self.flow.equations.inputs.pushes = pushes;
        self.is_pushed_anew = true;
    }

    /// What has happened since this was asked last, by time.
    pub fn news(&mut self) -> Vec<Event> {
        let mut events = self.ledger.news();
        events.extend(self.passages.news());
        events.sort_by(|a, b| a.time.total_cmp(&b.time));
        events
    }
}

impl From<Ended> for Stop {
    fn from(ended: Ended) -> Self {
        // Of rows that are kept it has none.
        let message = ended.message.split("; the rows until").next();
        Stop::failed(ended.status, message.unwrap_or_default().to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::Stepped;

    #[test]
    fn a_motion_may_go_on_in_another_thread() {
        fn is_send<T: Send>() {}
        is_send::<Stepped>();
    }
}

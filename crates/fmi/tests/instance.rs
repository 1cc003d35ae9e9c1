//! Instances beside runs and closed forms, their states, and calls that are wrong.

use std::fs;
use std::path::{Path, PathBuf};

use linkdyn::fmu::{STEERED, token};
use linkdyn::prelude::*;
use linkdyn_fmi::{Instance, Made, Refusal, Severity, Start, State};

/// A flywheel that a torque turns, with a bristle of friction in its bearing and a stop: events, states and memories.
const WHEEL: &str = r#"{ "format": "linkdyn/1", "units": "SI", "parameters": { "inertia": "2 kg*m^2", "r": "1 m" },
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "wheel": { "mass": 1, "inertia": "=inertia", "com": [0, 0], "points": { "O": [0, 0], "A": ["=r", 0] } } },
  "joints": { "pin": { "type": "revolute", "between": ["ground.O", "wheel.O"] } },
  "inputs": { "torque": "0 N*m", "drag": 1 },
  "forces": { "motor": { "type": "torque", "body": "wheel", "value": "=input.torque - 0.1 N*m*input.drag^2" } },
  "points": ["wheel.A"],
  "analysis": { "type": "dynamics", "end": 1, "outputs": 11, "solver": { "rtol": 1e-11, "atol": 1e-13 } } }"#;

/// A ball that bounces, in a guide with a stop.
const BALL: &str = r#"{ "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
  "bodies": { "ground": { "points": { "O": [0, 0] } },
    "ball": { "mass": 2, "inertia": 0.1, "com": [0, 0], "points": { "P": [0, 0] }, "pose": { "position": [0, 0.8] } } },
  "joints": { "guide": { "type": "prismatic", "between": ["ground.O", "ball.P"], "axis": [0, 1], "limits": [0, 2], "restitution": 0.5 } },
  "initial": { "ball": { "y": 0.8, "vy": 0 } },
  "analysis": { "type": "dynamics", "end": 1, "outputs": 11, "columns": ["ball.y", "ball.vy"] } }"#;

/// The resources of a unit, in a folder of their own.
struct Unit {
    folder: PathBuf,
    token: String,
}

impl Unit {
    fn new(name: &str, model: &str, steered: &str) -> Self {
        let name = format!("fmi-{}-{name}", std::process::id());
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::create_dir_all(&folder).expect("a folder");
        fs::write(folder.join("model.json"), model).expect("written");
        if !steered.is_empty() {
            fs::write(folder.join(STEERED), steered).expect("written");
        }
        let token = token(model.as_bytes(), steered.as_bytes());
        Unit { folder, token }
    }

    fn try_instance(&self, token: &str, stops_at_events: bool) -> Result<Instance, Refusal> {
        let made = Made {
            token,
            resources: &self.folder,
            stops_at_events,
            is_logging: false,
        };
        Instance::new(&made, Box::new(|_, _, _| {}))
    }

    fn instance(&self) -> Instance {
        self.try_instance(&self.token, false).expect("an instance")
    }

    /// At the beginning of the motion.
    fn begun(&self) -> Instance {
        begun(self.instance())
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

fn begun(mut instance: Instance) -> Instance {
    instance.enter_initialization().expect("legal");
    instance.exit_initialization().expect("it begins");
    instance
}

fn reference(instance: &Instance, name: &str) -> u32 {
    let variables = &instance.interface().variables;
    let found = variables.iter().position(|variable| variable.name == name);
    u32::try_from(found.unwrap_or_else(|| panic!("{name}"))).expect("few variables")
}

fn value(instance: &mut Instance, name: &str) -> f64 {
    let mut value = [0.0];
    let reference = reference(instance, name);
    instance.get(&[reference], &mut value).expect("a value");
    value[0]
}

fn set(instance: &mut Instance, name: &str, value: f64) {
    let reference = reference(instance, name);
    instance.set(&[reference], &[value]).expect("it can be set");
}

/// Steps, with all outputs after each as bits.
fn walk(instance: &mut Instance, steps: usize, step: f64) -> Vec<u64> {
    let variables = instance.interface().variables.len() as u32 - 1;
    let all: Vec<u32> = (0..variables).collect();
    let mut bits = Vec::new();
    for _ in 0..steps {
        let now = instance.time();
        instance.step(now, step).expect("a step");
        let mut values = vec![0.0; all.len()];
        instance.get(&all, &mut values).expect("values");
        bits.extend(values.iter().map(|value| value.to_bits()));
    }
    bits
}

fn refused<T>(result: Result<T, Refusal>) -> String {
    match result {
        Ok(_) => panic!("it was not refused"),
        Err(refusal) => refusal.message,
    }
}

/// J φ̈ = M: a torque of 6 N·m for a second, then none.
#[test]
fn inputs_move_the_mechanism() {
    let unit = Unit::new("inputs", WHEEL, "");
    let mut wheel = unit.instance();
    set(&mut wheel, "input.drag", 0.0);
    set(&mut wheel, "parameters.inertia", 3.0);
    wheel.enter_initialization().expect("legal");
    set(&mut wheel, "input.torque", 6.0);
    let alpha = value(&mut wheel, "wheel.alpha");
    assert!((alpha - 2.0).abs() < 1e-14, "{alpha}");
    wheel.exit_initialization().expect("it begins");
    walk(&mut wheel, 10, 0.1);
    let omega = value(&mut wheel, "wheel.omega");
    assert!((omega - 2.0).abs() < 1e-12, "{omega}");
    set(&mut wheel, "input.torque", 0.0);
    let alpha = value(&mut wheel, "wheel.alpha");
    assert!(
        alpha.abs() < 1e-14,
        "an output follows an input at once: {alpha}"
    );
    walk(&mut wheel, 10, 0.1);
    let angle = value(&mut wheel, "wheel.angle");
    assert!((angle - 3.0).abs() < 1e-11, "{angle}");
}

/// φ̈ is given by the driver that is led.
#[test]
fn a_driver_is_led_by_its_acceleration() {
    let model = BALL.replace(
        r#""bodies": {"#,
        r#""drivers": { "motor": { "type": "rotation", "body": "crank", "motion": { "type": "constant_velocity", "velocity": "2 rad/s" } } },
           "bodies": { "crank": { "mass": 1, "inertia": 1, "com": [0, 0], "points": { "O": [0, 0] } },"#,
    );
    let model = model.replace(
        r#""joints": {"#,
        r#""joints": { "pin": { "type": "revolute", "between": ["ground.O", "crank.O"] },"#,
    );
    let model = model.replace(r#""ball.vy""#, r#""crank.angle", "driver.motor.effort""#);
    let unit = Unit::new("led", &model, r#"["motor"]"#);
    let mut crank = unit.begun();
    set(&mut crank, "driver.motor.acceleration", 3.0);
    let effort = value(&mut crank, "driver.motor.effort");
    assert!((effort - 3.0).abs() < 1e-12, "{effort}");
    walk(&mut crank, 7, 0.1);
    let angle = value(&mut crank, "crank.angle");
    assert!((angle - (1.4 + 1.5 * 0.49)).abs() < 1e-12, "{angle}");
}

/// Against the row of a run: the events of a bouncing ball lie inside steps.
#[test]
fn an_instance_moves_as_a_run_does() {
    let model = BALL.replace(
        "\"outputs\": 11",
        "\"outputs\": 11, \"solver\": { \"rtol\": 1e-11, \"atol\": 1e-13 }",
    );
    let run = model
        .parse::<Mechanism>()
        .expect("a model")
        .run()
        .expect("a run");
    let height = run.mechanism().column("ball.y").expect("a column");
    let heights: Vec<f64> = run.column(height).to_vec();
    let unit = Unit::new("run", &model, "");
    let mut ball = unit.begun();
    for (row, time) in run.time().iter().enumerate().skip(1) {
        let now = ball.time();
        ball.step(now, time - now).expect("a step");
        let [own, expected] = [value(&mut ball, "ball.y"), heights[row]];
        assert!(
            (own - expected).abs() < 1e-9,
            "t = {time}: {own}, {expected}"
        );
    }
    let events = reference(&ball, "events");
    let mut count = [0];
    ball.get_counts(&[events], &mut count).expect("a count");
    assert!(count[0] >= 2, "{count:?}");
}

/// A step ends at an event where that was wanted: of the fall from 0.8 m.
#[test]
fn steps_end_at_events_where_that_is_wanted() {
    let unit = Unit::new("events", BALL, "");
    let mut ball = begun(unit.try_instance(&unit.token, true).expect("an instance"));
    let refusal = refused(ball.step(0.0, 0.5));
    assert_eq!(
        refusal,
        "a step is legal in step mode, and this is in event mode"
    );
    ball.update_discrete_states().expect("legal");
    ball.enter_step().expect("legal");
    let stepped = ball.step(0.0, 0.5).expect("a step");
    let fall = (2.0 * 0.8 / 9.81_f64).sqrt();
    assert!(
        stepped.is_early && stepped.has_event && (stepped.time - fall).abs() < 1e-9,
        "{stepped:?}"
    );
    ball.enter_event().expect("legal");
    ball.enter_step().expect("legal");
    let now = ball.time();
    let stepped = ball.step(now, 0.5 - now).expect("a step");
    assert_eq!((stepped.time, stepped.is_early), (0.5, false));
}

/// The same bits after a state was set: in the instance, in another one, and from bytes; with steps, inputs and events between.
#[test]
fn a_state_leads_to_the_same_bits() {
    for (name, model) in [("state-wheel", WHEEL), ("state-ball", BALL)] {
        let unit = Unit::new(name, model, "");
        let mut one = unit.begun();
        let shake = |instance: &mut Instance, torque: f64| {
            if model == WHEEL {
                set(instance, "input.torque", torque);
                // An output between steps is an evaluation more.
                value(instance, "wheel.alpha");
            }
        };
        walk(&mut one, 5, 0.07);
        shake(&mut one, 4.0);
        walk(&mut one, 2, 0.013);
        shake(&mut one, 5.0);
        let state = one.state().expect("a state");
        let bytes = one.bytes(&state).expect("bytes");
        let expected = walk(&mut one, 9, 0.05);
        shake(&mut one, 1.0);
        one.set_state(&state).expect("it goes back");
        let same = one.state().expect("a state");
        assert_eq!(
            one.bytes(&same).expect("bytes"),
            bytes,
            "{name}: it is the state"
        );
        assert_eq!(walk(&mut one, 9, 0.05), expected, "{name}: in memory");
        let again = one.state_of(&bytes).expect("a state");
        assert_eq!(one.bytes(&again).expect("bytes"), bytes);
        one.set_state(&again).expect("it goes back");
        assert_eq!(walk(&mut one, 9, 0.05), expected, "{name}: from bytes");
        let mut other = unit.instance();
        other.set_state(&again).expect("it goes there");
        assert_eq!(
            walk(&mut other, 9, 0.05),
            expected,
            "{name}: in another instance"
        );
        one.reset().expect("legal");
        let mut one = begun(one);
        one.set_state(&state).expect("it goes back");
        assert_eq!(walk(&mut one, 9, 0.05), expected, "{name}: after a reset");
    }
}

#[test]
fn bytes_that_are_no_state_are_refused() {
    let unit = Unit::new("bytes", BALL, "");
    let mut ball = unit.begun();
    walk(&mut ball, 3, 0.1);
    let state = ball.state().expect("a state");
    let bytes = ball.bytes(&state).expect("bytes");
    let damaged = "the bytes are no state of a linkdyn unit, or damaged";
    for at in 0..bytes.len() {
        let mut other = bytes.clone();
        other[at] ^= 1;
        assert_eq!(refused(ball.state_of(&other)), damaged);
        assert_eq!(refused(ball.state_of(&bytes[..at])), damaged);
    }
    let wheel = Unit::new("bytes-wheel", WHEEL, "");
    let mut wheel = wheel.instance();
    let strange = "the bytes are the state of another unit, or of another version of linkdyn";
    assert_eq!(refused(wheel.state_of(&bytes)), strange);
    assert_eq!(
        refused(wheel.set_state(&state)),
        "the state is one of another unit"
    );
}

/// J φ̈ = M − 0.1 d²: ∂φ̈/∂M = 1/J, ∂φ̈/∂d = −0.2 d/J, and nothing of what is behind them by integration.
#[test]
fn outputs_have_derivatives_by_inputs() {
    let unit = Unit::new("derivative", WHEEL, "");
    let mut wheel = unit.begun();
    set(&mut wheel, "input.drag", 3.0);
    walk(&mut wheel, 3, 0.1);
    let names = ["input.torque", "input.drag", "wheel.alpha", "wheel.omega"];
    let [torque, drag, alpha, omega] = names.map(|name| reference(&wheel, name));
    let mut state = wheel.state().expect("a state");
    let mut sensitivity = [0.0; 2];
    let knowns = (&[torque, drag][..], &[1.0, 2.0][..]);
    wheel
        .derivative(knowns, (&[alpha, omega], &mut sensitivity))
        .expect("a derivative");
    let expected = (1.0 - 0.2 * 3.0 * 2.0) / 2.0;
    assert!(
        (sensitivity[0] - expected).abs() < 1e-11,
        "{sensitivity:?}, {expected}"
    );
    assert_eq!(sensitivity[1], 0.0);
    let after = walk(&mut wheel, 5, 0.1);
    wheel.set_state(&state).expect("it goes back");
    assert_eq!(
        walk(&mut wheel, 5, 0.1),
        after,
        "a derivative leaves no trace"
    );
    state = wheel.state().expect("a state");
    drop(state);
    let mut one = [0.0];
    let refusal = wheel.derivative((&[omega], &[1.0]), (&[alpha], &mut one));
    assert_eq!(
        refused(refusal),
        "wheel.omega is no input, by which outputs have derivatives"
    );
    let refusal = wheel.derivative((&[torque], &[1.0]), (&[drag], &mut one));
    assert_eq!(
        refused(refusal),
        "input.drag is no output that has derivatives"
    );
    let refusal = wheel.derivative((&[torque], &[f64::NAN]), (&[alpha], &mut one));
    assert_eq!(refused(refusal), "the seed of input.torque is NaN");
}

#[test]
fn wrong_calls_are_refused() {
    let unit = Unit::new("wrong", WHEEL, "");
    let token = unit.token.clone();
    let path = unit.folder.join("model.json");
    assert_eq!(
        refused(unit.try_instance("{other}", false)),
        format!(
            "the token \"{{other}}\" is not that of the model in {}: {token:?}",
            path.display()
        )
    );
    let mut wheel = unit.instance();
    let mut one = [0.0];
    let last = wheel.interface().variables.len() as u32 - 1;
    let [angle, torque, inertia] =
        ["wheel.angle", "input.torque", "parameters.inertia"].map(|name| reference(&wheel, name));
    let early = "the value of wheel.angle is legal in initialization mode or in step mode or in event mode, and this is before initialization";
    assert_eq!(refused(wheel.get(&[angle], &mut one)), early);
    let refusal = refused(wheel.get(&[last + 1], &mut one));
    assert_eq!(
        refusal,
        format!(
            "no variable has the value reference {}: they go from 0 to {last}",
            last + 1
        )
    );
    assert_eq!(
        refused(wheel.get(&[last], &mut one)),
        "events is a whole number"
    );
    assert_eq!(
        refused(wheel.get_counts(&[angle], &mut [0])),
        "wheel.angle is a real number"
    );
    assert_eq!(
        refused(wheel.get(&[0, 1], &mut one)),
        "1 values for 2 value references"
    );
    assert_eq!(
        refused(wheel.set(&[angle], &[1.0])),
        "wheel.angle can't be set: parameters and inputs can"
    );
    assert_eq!(
        refused(wheel.set(&[torque], &[f64::NAN])),
        "input.torque can't be NaN"
    );
    let start = |start, end| Start { start, end };
    let refusal = refused(wheel.set_start(start(1.0, Some(0.0))));
    assert_eq!(refusal, "the simulation can't go from 1 s to 0 s");
    assert_eq!(
        refused(wheel.step(0.0, 0.1)),
        "a step is legal in step mode, and this is before initialization"
    );
    assert_eq!(
        refused(wheel.exit_initialization()),
        "leaving initialization mode is legal in initialization mode, and this is before initialization"
    );
    wheel.set_start(start(10.0, Some(11.0))).expect("legal");
    set(&mut wheel, "parameters.inertia", 0.0);
    wheel.enter_initialization().expect("legal");
    let refusal = refused(wheel.exit_initialization());
    assert!(refusal.contains("inertia"), "{refusal}");
    set(&mut wheel, "parameters.inertia", 2.0);
    wheel.exit_initialization().expect("it begins");
    assert_eq!(
        refused(wheel.set(&[inertia], &[1.0])),
        "setting parameters.inertia is legal before initialization or in initialization mode, and this is in step mode"
    );
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(
            refused(wheel.step(10.0, step)),
            format!("a step of {step} s: it must be positive")
        );
    }
    assert_eq!(
        refused(wheel.step(0.0, 0.1)),
        "a step from t = 0 s, and the instance is at t = 10 s"
    );
    assert_eq!(
        refused(wheel.step(f64::NAN, 0.1)),
        "a step from t = NaN s, and the instance is at t = 10 s"
    );
    assert_eq!(
        refused(wheel.step(10.0, 1.5)),
        "a step to t = 11.5 s, beyond the end of the simulation at t = 11 s"
    );
    assert_eq!(wheel.step(10.0, 1.0).expect("a step").time, 11.0);
    assert_eq!(
        refused(wheel.enter_event()),
        "event mode is legal in an instance that was made with eventModeUsed"
    );
    wheel.terminate().expect("legal");
    assert_eq!(
        refused(wheel.set(&[torque], &[1.0])),
        "setting input.torque is legal before initialization or in initialization mode or in step mode or in event mode, and this is after \
         the end of the simulation"
    );
    wheel.reset().expect("legal");
    assert_eq!(wheel.time(), 0.0);
}

/// A step that can't be taken to its end is discarded, and tells where the motion is.
#[test]
fn a_motion_that_ends_discards_its_step() {
    let model = WHEEL.replace(
        "=input.torque",
        "=input.torque/sqrt(input.drag - time/(1 s))*1",
    );
    let unit = Unit::new("discard", &model, "");
    let mut wheel = unit.begun();
    set(&mut wheel, "input.torque", 1.0);
    let refusal = wheel
        .step(0.0, 2.0)
        .expect_err("there is no root of a negative number");
    assert_eq!(refusal.severity, Severity::Discard, "{refusal:?}");
    let time = wheel.time();
    assert!(time > 0.5 && time <= 1.0, "{time}: {refusal:?}");
    let state: State = wheel.state().expect("a state");
    wheel.set_state(&state).expect("it is where it was");
}

/// A hundred of them in one process, in threads, each with another inertia.
#[test]
fn a_hundred_instances_do_not_know_each_other() {
    let unit = Unit::new("hundred", WHEEL, "");
    let unit = &unit;
    std::thread::scope(|scope| {
        for thread in 0..4 {
            scope.spawn(move || {
                let mut all: Vec<Instance> = (0..25)
                    .map(|one| {
                        let mut wheel = unit.instance();
                        set(
                            &mut wheel,
                            "parameters.inertia",
                            f64::from(25 * thread + one + 1),
                        );
                        set(&mut wheel, "input.drag", 0.0);
                        set(&mut wheel, "input.torque", 1.0);
                        begun(wheel)
                    })
                    .collect();
                for _ in 0..10 {
                    for wheel in &mut all {
                        walk(wheel, 1, 0.1);
                    }
                }
                for (one, wheel) in (0..).zip(&mut all) {
                    let expected = 1.0 / f64::from(25 * thread + one + 1);
                    let omega = value(wheel, "wheel.omega");
                    assert!((omega - expected).abs() < 1e-12, "{omega}, {expected}");
                }
            });
        }
    });
}

/// Two wheels on a shaft that is a spring, in units of their own: a driven crank gives its angle and speed, the spring its torque. The
/// error of coupled steps goes with their length.
#[test]
fn coupled_units_converge_in_first_order() {
    let unit = Unit::new("coupled", WHEEL, "");
    let errors: Vec<f64> = [40, 80, 160]
        .map(|steps| {
            let step = 1.0 / f64::from(steps);
            let mut wheels = [unit.instance(), unit.instance()].map(|mut wheel| {
                set(&mut wheel, "input.drag", 0.0);
                begun(wheel)
            });
            for _ in 0..steps {
                let states = wheels
                    .each_mut()
                    .map(|wheel| [value(wheel, "wheel.angle"), value(wheel, "wheel.omega")]);
                // Torque of the shaft, 30 N·m/rad; of the motor, 4 N·m.
                let shaft = 30.0 * (states[0][0] - states[1][0]);
                set(&mut wheels[0], "input.torque", 4.0 - shaft);
                set(&mut wheels[1], "input.torque", shaft);
                for wheel in &mut wheels {
                    let now = wheel.time();
                    wheel.step(now, step).expect("a step");
                }
            }
            // Half the sum of angles is M t²/(4 J), half the difference M/(4 k) (1 − cos √(2k/J) t).
            let [first, second] = wheels.each_mut().map(|wheel| value(wheel, "wheel.angle"));
            let expected = 4.0 / (2.0 * 30.0) * (1.0 - f64::cos(f64::sqrt(2.0 * 30.0 / 2.0)));
            let sum = 4.0 / 2.0 / 2.0;
            assert!((first + second - sum).abs() < 1e-9, "{first}, {second}");
            (first - second - expected).abs()
        })
        .to_vec();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 1.0).abs() < 0.15, "{errors:?}: order {order}");
    }
}

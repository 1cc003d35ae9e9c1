//! The step loop allocates nothing: refactoring, solving, watching for singular configurations, integrating, and the
//! equations of motion and of driven mechanisms; and what memory stays in use.

use crate::benchmarks;
use crate::linkage;
use crate::ode;
use allocation_counter::measure;
use linkdyn_engine::analysis::sample::Sample;
use linkdyn_engine::analysis::{assembly, driven};
use linkdyn_engine::integrate::{Limits, Method, Tolerance};
use linkdyn_engine::mechanism::continuation::{Parameter, follow};
use linkdyn_engine::mechanism::driven::Driven;
use linkdyn_engine::mechanism::reduced::Reduced;
use linkdyn_engine::system::compile::compile;
use linkdyn_engine::system::{Inputs, System};
use linkdyn_linear::{ColumnOrder, Pattern, SparseLu};
use linkdyn_model::AnalysisKind;

/// Allocations of this thread while `work` runs.
fn allocations(work: impl FnOnce()) -> u64 {
    measure(work).count_total
}

/// What `work` makes, the bytes that stay in use for it, and the most that were in use at once.
fn bytes<T>(work: impl FnOnce() -> T) -> (T, [i64; 2]) {
    let mut made = None;
    let info = measure(|| made = Some(work()));
    let most = i64::try_from(info.bytes_max).expect("a count of bytes");
    (made.expect("made"), [info.bytes_current, most])
}

#[test]
fn refactor_and_solves_allocate_nothing() {
    let values_at = |angle: f64| {
        let (bodies, pins) = linkage::four_bar_chain(20, angle);
        let matrix = linkage::kkt(
            &linkage::jacobian(bodies, &pins, &[]),
            &mut linkage::Random(2),
        );
        let (pattern, slots) =
            Pattern::from_entries(matrix.rows, matrix.columns, &matrix.positions()).unwrap();
        let mut values = vec![0.0; pattern.entries()];
        for (&slot, &(_, _, value)) in slots.iter().zip(&matrix.entries) {
            values[slot as usize] += value;
        }
        (pattern, values)
    };
    let (pattern, first) = values_at(0.8);
    let (_, second) = values_at(0.9);
    let n = pattern.columns();
    let order = ColumnOrder::paired(&pattern, &first).unwrap();
    let mut lu = SparseLu::new(pattern, order);
    lu.factor(&first).unwrap();
    let (mut b, mut right, mut left) = (vec![1.0; n], vec![0.0; n], vec![0.0; n]);
    // makes its room
    lu.solve_refined(&first, &mut b);
    let count = allocations(|| {
        lu.refactor(&second).unwrap();
        lu.solve(&mut b);
        lu.solve_transposed(&mut b);
        lu.solve_refined(&second, &mut b);
        lu.solve_transposed_refined(&second, &mut b);
        lu.smallest_singular(3, &mut right, &mut left);
        lu.determinant();
        lu.smallest_pivot_ratio(&second);
        lu.pivot_spread();
    });
    assert_eq!((count, lu.fallbacks()), (0, 0));

    // Choosing the same pivots again finds its space, too.
    let count = allocations(|| lu.factor(&second).unwrap());
    assert_eq!(count, 0);
    assert!(
        allocations(|| drop(std::hint::black_box(vec![1]))) > 0,
        "the counter counts"
    );
}

#[test]
fn steps_and_dense_output_allocate_nothing() {
    for (method, f) in [
        (Method::Dop853, ode::pendulum as fn(f64, &[f64], &mut [f64])),
        (Method::Radau, ode::van_der_pol),
        (Method::Auto, ode::van_der_pol),
    ] {
        let mut stepper = method.stepper(ode::tolerance(2, 1e-6), Limits::default());
        let mut problem = ode::Problem::new(2, f);
        let mut y = [2.0, 0.0];
        stepper
            .start(&mut problem, 0.0, &[2.0, 0.0], 1000.0)
            .unwrap();
        let count = allocations(|| {
            while stepper.t() != 1000.0 {
                stepper.step(&mut problem, 1000.0).unwrap();
                stepper
                    .interpolate(
                        &mut problem,
                        0.5 * (stepper.previous() + stepper.t()),
                        &mut y,
                    )
                    .unwrap();
            }
        });
        assert_eq!(count, 0, "{method:?}");
        assert_eq!(stepper.stiff(), method == Method::Auto);
    }
}

/// A model's equations of motion at their assembled start, and what integrates them.
pub(super) fn compiled(json: &serde_json::Value) -> System {
    let model = linkdyn_model::load(json.to_string().as_bytes(), &[])
        .expect("a sound model")
        .model;
    compile(&model, AnalysisKind::Dynamics).expect("compiles")
}

pub(super) fn start(system: &System) -> (Reduced<'_>, Vec<f64>) {
    let inputs = Inputs::at_time(system, 0.0);
    let assembled = assembly::assemble(system, &inputs).expect("assembles");
    let v = assembly::velocities(system, &assembled.q, &inputs).expect("velocities");
    let mut reduced = Reduced::new(
        system,
        &assembled.all.free_columns,
        (&assembled.q, &v, 0.0),
        None,
    )
    .expect("regular");
    reduced.set_lag(1e-8);
    let mut y = vec![0.0; 2 * reduced.freedom()];
    reduced.state(&mut y);
    (reduced, y)
}

/// Two rods of 1 m, let go from the side.
fn double_pendulum() -> serde_json::Value {
    let rod = |x: f64| {
        serde_json::json!({ "mass": 1, "inertia": 1.0 / 12.0, "com": [0.5, 0], "points": { "A": [0, 0], "B": [1, 0] },
                            "pose": { "position": [x, 0], "angle": 0 } })
    };
    serde_json::json!({
        "format": "linkdyn/1", "units": "SI", "gravity": [0, -9.81],
        "bodies": { "ground": { "points": { "O": [0, 0] } }, "upper": rod(0.0), "lower": rod(1.0) },
        "joints": { "o": { "type": "revolute", "between": ["ground.O", "upper.A"] },
                    "p": { "type": "revolute", "between": ["upper.B", "lower.A"] } },
        "analysis": { "type": "dynamics", "end": 10, "outputs": 11 },
    })
}

/// Rods of 1 m, let go from the side.
fn chain(links: usize) -> serde_json::Value {
    let mut chain = double_pendulum();
    let rod = chain["bodies"]["lower"].clone();
    for k in 2..links {
        let mut next = rod.clone();
        next["pose"]["position"] = serde_json::json!([k, 0]);
        chain["bodies"][format!("rod{k}")] = next;
        let before = match k {
            2 => "lower.B".to_owned(),
            _ => format!("rod{}.B", k - 1),
        };
        chain["joints"][format!("pin{k}")] =
            serde_json::json!({ "type": "revolute", "between": [before, format!("rod{k}.A")] });
    }
    chain
}

/// The same with stiff springs and dampers in the pins.
fn stiff_chain(links: usize) -> serde_json::Value {
    let mut chain = chain(links);
    let mut forces = serde_json::Map::new();
    let joints = chain["joints"].as_object().expect("joints").clone();
    for (name, joint) in joints {
        let body = |end: usize| {
            let point = joint["between"][end].as_str().expect("a point");
            point.split('.').next().expect("a body").to_owned()
        };
        let spring = serde_json::json!({ "type": "torsion_spring", "between": [body(0), body(1)],
            "stiffness": 1e5, "damping": 10, "free_angle": 0 });
        forces.insert(name, spring);
    }
    chain["forces"] = forces.into();
    chain
}

/// Two rods with friction in both pins.
fn pulled_pendulum() -> serde_json::Value {
    let mut pendulum = double_pendulum();
    let torque = "=table(lower.angle; -1 rad, 0 N*m; 1 rad, 0.2 N*m) - 0.1 N*m*s^2/rad^2*lower.omega*abs(joint.p.omega)";
    pendulum["forces"] =
        serde_json::json!({ "f": { "type": "torque", "body": "lower", "value": torque } });
    pendulum
}

/// Its stops are far from where it swings, and looked at all the same.
fn stopped_pendulum() -> serde_json::Value {
    let mut model = double_pendulum();
    for joint in model["joints"]
        .as_object_mut()
        .expect("joints")
        .values_mut()
    {
        joint["limits"] = serde_json::json!([-50.0, 50.0]);
        joint["stiffness"] = serde_json::json!(1e4);
    }
    model
}

/// What closes and opens, and a clutch, stand among its rows and formulas.
fn clasped_pendulum() -> serde_json::Value {
    let mut model = double_pendulum();
    model["joints"]["o"]["one_way"] = serde_json::json!("forward");
    model["joints"]["p"]["lock"] =
        serde_json::json!({ "from": "lower.omega >= 1e3 rad/s", "until": "time >= 9 s" });
    model
}

fn rubbing_pendulum() -> serde_json::Value {
    let mut pendulum = double_pendulum();
    for joint in ["o", "p"] {
        pendulum["joints"][joint]["friction"] = serde_json::json!({ "law": "threlfall", "coefficient": 0.1, "threshold_velocity": 0.01 });
        pendulum["joints"][joint]["pin_radius"] = serde_json::json!(0.01);
    }
    pendulum
}

/// Steps and outputs of forward dynamics from a warm start, with the multipliers at every output.
///
/// Left out is what happens once or seldom: making the solver, which follows the curve of a mechanism of one degree of
/// freedom; the first steps, in which work space grows to its size; an exchange of pins, which chooses an order of
/// elimination for the new matrix. Loops that are redundant are left out, too: their rows are chosen anew.
#[test]
fn steps_of_forward_dynamics_allocate_nothing_and_repeat_bit_by_bit() {
    for (name, json, end, method) in [
        ("double pendulum", double_pendulum(), 1.0, Method::Auto),
        ("with friction", rubbing_pendulum(), 1.0, Method::Auto),
        ("with stops", stopped_pendulum(), 1.0, Method::Auto),
        ("with a lock", clasped_pendulum(), 1.0, Method::Auto),
        ("with formulas", pulled_pendulum(), 1.0, Method::Radau),
        ("a chain, sparse", chain(8), 0.5, Method::Auto),
        ("a stiff chain, sparse", stiff_chain(8), 0.5, Method::Radau),
        ("A02, N = 2", benchmarks::four_bars(2), 10.0, Method::Auto),
    ] {
        let system = compiled(&json);
        let run = || {
            let (mut reduced, y) = start(&system);
            let tolerance = Tolerance {
                rtol: 1e-6,
                atol: vec![1e-6; y.len()],
                cap: Vec::new(),
            };
            let mut stepper = method.stepper(tolerance, Limits::default());
            stepper.start(&mut reduced, 0.0, &y, end).expect("starts");
            let mut lambda = vec![0.0; system.m()];
            let (mut counts, mut states) = (Vec::new(), Vec::with_capacity(100_000));
            let mut between = y.clone();
            while stepper.t() < end {
                let count = allocations(|| {
                    stepper.step(&mut reduced, end).expect("steps");
                    stepper
                        .interpolate(
                            &mut reduced,
                            0.5 * (stepper.previous() + stepper.t()),
                            &mut between,
                        )
                        .expect("interpolates");
                    reduced.evaluate(stepper.t(), stepper.y()).expect("regular");
                    reduced.multipliers(&mut lambda);
                });
                counts.push(count);
                states.extend(
                    stepper
                        .y()
                        .iter()
                        .chain(&between)
                        .chain(&lambda)
                        .map(|x| x.to_bits()),
                );
            }
            (counts, states)
        };
        let (counts, states) = run();
        assert!(counts.len() > 10, "{name}: {} steps", counts.len());
        assert_eq!(counts[3..].iter().sum::<u64>(), 0, "{name}: {counts:?}");
        assert!(run().1 == states, "{name}: another run gives other bits");
    }
}

#[test]
fn instants_of_a_driven_mechanism_allocate_nothing_and_repeat_bit_by_bit() {
    let text = linkdyn_model::bundled::find("watt-i-lock")
        .expect("bundled")
        .text;
    let model = linkdyn_model::load(text.as_bytes(), &[])
        .expect("a sound model")
        .model;
    let system = compile(&model, AnalysisKind::InverseDynamics).expect("compiles");
    let begin = Inputs::at_time(&system, 0.0);
    let mut q = assembly::assemble(&system, &begin).expect("assembles").q;
    let mut solver = Driven::new(&system, &q, &begin).expect("regular");
    solver.correct(&mut q, &begin).expect("converges");
    let range = (begin.drive[0][0], begin.drive[0][0] + 2.0);
    let parameter = (Parameter::of(&system), begin.clone());
    let path = follow(&mut solver, parameter, (range.0, &q), range, &|_| false).expect("a path");
    let mut inputs = begin;
    let mut sample = Sample::new(&system);
    let mut run = || {
        let mut bits = 0u64;
        for k in 0..500 {
            inputs.drive[0] = [range.0 + 2.0 * f64::from(k) / 500.0, 10.0, 1.0];
            driven::solve_instant(&mut solver, &path, &inputs, &mut sample).expect("regular");
            for x in sample
                .q
                .iter()
                .chain(&sample.v)
                .chain(&sample.a)
                .chain(&sample.lambda)
            {
                bits = bits.rotate_left(1) ^ x.to_bits();
            }
        }
        bits
    };
    let first = run();
    let mut second = 0;
    assert_eq!(allocations(|| second = run()), 0);
    assert_eq!(first, second, "another run gives other bits");
}

/// Bytes per body of a mechanism of 2001 bodies after its first step: the system, the solver with its factors, the
/// curve that a mechanism of one degree of freedom follows (72 B per body and node), the integrator. The model's words and
/// what assembly needs are gone by then. The most at once is in use while the curve is followed, with all the nodes of its march.
#[test]
fn a_large_mechanism_fits_into_little_memory() {
    let json = benchmarks::four_bars(1000);
    let (system, [of_system, _]) = bytes(|| compiled(&json));
    let inputs = Inputs::at_time(&system, 0.0);
    let (solver, [of_solver, _]) =
        bytes(|| Driven::with_independent(&system, &[2], &system.guess, &inputs).expect("regular"));
    drop((solver, inputs));
    let (running, [of_motion, most_of_motion]) = bytes(|| {
        let (mut reduced, y) = start(&system);
        let mut stepper = Method::Auto.stepper(
            Tolerance {
                rtol: 1e-6,
                atol: vec![1e-6; y.len()],
                cap: Vec::new(),
            },
            Limits::default(),
        );
        stepper.start(&mut reduced, 0.0, &y, 1.0).expect("starts");
        stepper.step(&mut reduced, 1.0).expect("steps");
        (reduced, y, stepper)
    });
    drop(running);
    let (all, most) = (of_system + of_motion, of_system + most_of_motion);
    let bodies = system.bodies.len() as i64;
    let rest = all - of_system - of_solver;
    println!(
        "bytes per body: system {}, factors and their workspace {}, curve and integrator {}, at most at once {}",
        of_system / bodies,
        of_solver / bodies,
        rest / bodies,
        most / bodies
    );
    assert!(
        (of_system + of_solver) / bodies < 1470,
        "{of_system} {of_solver}"
    );
    // A node more, by round-off, would be 72 B.
    assert!(all / bodies < 2000, "{all}");
    assert!(most / bodies < 6600, "{most}");
}

//! Models edited at random in Rust: the gate complains, or the model compiles, assembles and runs; nothing panics, and what
//! is printed is read as the same model.
//!
//! `LINKDYN_EDITS` is the number of edits, `LINKDYN_EDIT_SEED` where they begin.

#[path = "../common/fuzz/rng.rs"]
#[allow(dead_code)]
mod rng;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use crate::models;
use linkdyn_engine::analysis::{Control, check, run};
use linkdyn_model::{
    Checked, DriverKind, ForceKind, JointKind, Loaded, Model, Motion, PointRef, Value,
};
use rng::Rng;

/// Numbers that people and programs make by mistake.
const ODD: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    1e308,
    -1e300,
    1e-320,
    1e16,
    0.1,
    3.0,
];

/// Names that are there, that are not, and that can't be.
const NAMES: [&str; 12] = [
    "ground",
    "crank",
    "coupler",
    "A",
    "B",
    "note",
    "",
    "a.b",
    "x[0]",
    "new\nline",
    "ü",
    "*",
];

/// Models with all kinds of words.
fn sources() -> Vec<Loaded> {
    let named = [
        "four-bar",
        "four-bar-spring",
        "geared-five-bar",
        "slider-crank-clearance",
        "scotch-yoke",
        "double-pendulum",
        "double-wishbone",
    ];
    let mut sources: Vec<Loaded> = named
        .iter()
        .map(|name| {
            let text = linkdyn_model::bundled::find(name).expect("bundled").text;
            linkdyn_model::load(text.as_bytes(), &[]).expect("sound")
        })
        .collect();
    let words = include_bytes!("edits.json");
    sources.push(linkdyn_model::load(words, &[]).unwrap_or_else(|said| panic!("{said:?}")));
    sources
}

fn of_motion<'m>(motion: &'m mut Motion, numbers: &mut Vec<&'m mut f64>) {
    match motion {
        Motion::Polynomial { coefficients } => numbers.extend(coefficients),
        Motion::Harmonic {
            offset,
            amplitude,
            frequency,
            phase,
        } => numbers.extend([offset, amplitude, frequency, phase]),
        Motion::Table { points } => numbers.extend(points.iter_mut().flatten()),
        Motion::ConstantVelocity { start, velocity } => numbers.extend([start, velocity]),
        Motion::ConstantAcceleration {
            start,
            velocity,
            acceleration,
        } => numbers.extend([start, velocity, acceleration]),
    }
}

fn of_value<'m>(value: &'m mut Value, numbers: &mut Vec<&'m mut f64>) {
    match value {
        Value::Constant(number) => numbers.push(number),
        Value::Motion(motion) => of_motion(motion, numbers),
    }
}

/// Numbers of a model that are always there.
fn numbers(model: &mut Model) -> Vec<&mut f64> {
    let mut numbers: Vec<&mut f64> = model.gravity.iter_mut().collect();
    for body in model.bodies.values_mut() {
        numbers.extend(body.points.values_mut().flatten());
        numbers.extend(&mut body.pose.position);
        numbers.push(&mut body.pose.angle);
        numbers.extend(body.com.iter_mut().flatten());
    }
    for joint in model.joints.values_mut() {
        match &mut joint.kind {
            JointKind::Prismatic { axis, angle, .. } => {
                numbers.extend(axis.iter_mut().chain([angle]))
            }
            JointKind::Slot { axis } => numbers.extend(axis),
            JointKind::Gear { ratio, .. } => numbers.push(ratio),
            JointKind::Fixed { angle } => numbers.push(angle),
            JointKind::Revolute { .. } => {}
        }
    }
    for driver in model.drivers.values_mut() {
        of_motion(&mut driver.motion, &mut numbers);
    }
    for force in model.forces.values_mut() {
        match &mut force.kind {
            ForceKind::Spring {
                stiffness,
                damping,
                free_length: free,
                ..
            }
            | ForceKind::TorsionSpring {
                stiffness,
                damping,
                free_angle: free,
                ..
            } => {
                numbers.extend([stiffness, damping]);
                of_value(free, &mut numbers);
            }
            ForceKind::Load { vector, .. } => {
                vector
                    .iter_mut()
                    .for_each(|part| of_value(part, &mut numbers));
            }
            ForceKind::Torque { value, .. } => of_value(value, &mut numbers),
        }
    }
    if let Some(analysis) = &mut model.analysis {
        numbers.extend([&mut analysis.solver.rtol, &mut analysis.solver.atol]);
        if let Some(sample) = &mut analysis.sample {
            numbers.extend([&mut sample.from, &mut sample.to, &mut sample.step]);
        }
    }
    numbers
}

/// Numbers of a model that may be left out.
fn options(model: &mut Model) -> Vec<&mut Option<f64>> {
    let mut options = Vec::new();
    for body in model.bodies.values_mut() {
        options.extend([&mut body.mass, &mut body.inertia]);
    }
    for initial in model.initial.values_mut() {
        options.extend([&mut initial.x, &mut initial.angle, &mut initial.vy]);
        options.push(&mut initial.angular_velocity);
    }
    for joint in model.joints.values_mut() {
        let friction = match &mut joint.kind {
            JointKind::Revolute {
                clearance,
                friction,
                pin_radius,
            } => {
                options.push(pin_radius);
                if let Some(clearance) = clearance.as_deref_mut() {
                    options.extend([&mut clearance.radius, &mut clearance.bearing_radius]);
                    options.push(&mut clearance.axial_length);
                    if let Some(normal) = &mut clearance.normal {
                        options.extend([&mut normal.stiffness, &mut normal.exponent]);
                        options.extend([&mut normal.restitution, &mut normal.damping]);
                    }
                    if let Some(impact) = &mut clearance.impact {
                        options.extend([&mut impact.restitution, &mut impact.friction]);
                    }
                }
                friction
            }
            JointKind::Prismatic {
                friction,
                guide_length,
                ..
            } => {
                options.push(guide_length);
                friction
            }
            JointKind::Gear { angle, .. } => {
                options.push(angle);
                continue;
            }
            JointKind::Slot { .. } | JointKind::Fixed { .. } => continue,
        };
        if let Some(friction) = friction.as_deref_mut() {
            options.extend([&mut friction.coefficient, &mut friction.static_coefficient]);
            options.extend([
                &mut friction.threshold_velocity,
                &mut friction.lower_velocity,
            ]);
            options.extend([
                &mut friction.upper_velocity,
                &mut friction.bristle_stiffness,
            ]);
        }
    }
    if let Some(analysis) = &mut model.analysis {
        options.extend([&mut analysis.end, &mut analysis.solver.max_step]);
        options.push(&mut analysis.solver.initial_step);
    }
    options
}

fn of_point(point: &mut PointRef) -> [&mut String; 2] {
    [&mut point.body, &mut point.point]
}

/// Texts of a model that name something.
fn names(model: &mut Model) -> Vec<&mut String> {
    let mut names: Vec<&mut String> = model.points.iter_mut().flat_map(of_point).collect();
    for joint in model.joints.values_mut() {
        names.extend(joint.between.iter_mut().flat_map(of_point));
        if let JointKind::Gear { carrier, .. } = &mut joint.kind {
            names.extend(carrier);
        }
    }
    for driver in model.drivers.values_mut() {
        match &mut driver.kind {
            DriverKind::Rotation { body, relative_to } => {
                names.push(body);
                names.extend(relative_to);
            }
            DriverKind::Translation { joint } => names.push(joint),
        }
    }
    for force in model.forces.values_mut() {
        match &mut force.kind {
            ForceKind::Spring { between, .. } => {
                names.extend(between.iter_mut().flat_map(of_point));
            }
            ForceKind::TorsionSpring { between, .. } => names.extend(between),
            ForceKind::Load { at, .. } => names.extend(of_point(at)),
            ForceKind::Torque {
                body, relative_to, ..
            } => {
                names.push(body);
                names.extend(relative_to);
            }
        }
    }
    if let Some(analysis) = &mut model.analysis {
        names.push(&mut analysis.solver.method);
        names.extend(analysis.sample.as_mut().map(|sample| &mut sample.driver));
        names.extend(
            analysis
                .transmission
                .as_mut()
                .map(|wanted| &mut wanted.output),
        );
    }
    names
}

/// Removes, renames, moves or doubles one thing of a map.
macro_rules! edit_map {
    ($map:expr, $rng:expr) => {{
        let map = &mut $map;
        if !map.is_empty() {
            let at = $rng.below(map.len());
            match $rng.below(4) {
                0 => {
                    map.shift_remove_index(at);
                }
                1 => map.move_index(at, 0),
                2 => {
                    if let Some((_, thing)) = map.shift_remove_index(at) {
                        map.insert($rng.word(&NAMES).to_owned(), thing);
                    }
                }
                _ => {
                    let (_, thing) = map.get_index(at).expect("it is there");
                    let thing = thing.clone();
                    map.insert(format!("{}{at}", $rng.word(&NAMES)), thing);
                }
            }
        }
    }};
}

/// Takes out or exchanges a part of what a model would be as JSON.
fn edit_words(value: &mut serde_json::Value, rng: &mut Rng) {
    use serde_json::Value as Json;
    match value {
        Json::Object(members) if !members.is_empty() => {
            let at = rng.below(members.len());
            let key = members.keys().nth(at).cloned().unwrap_or_default();
            if rng.once_in(6) {
                members.shift_remove(&key);
            } else if let Some(member) = members.get_mut(&key) {
                edit_words(member, rng);
            }
        }
        Json::Array(items) if !items.is_empty() => {
            let at = rng.below(items.len());
            match rng.below(6) {
                0 => {
                    items.remove(at);
                }
                1 => items.push(items[at].clone()),
                _ => edit_words(&mut items[at], rng),
            }
        }
        Json::String(text) => {
            let words = [
                "revolute",
                "prismatic",
                "slot",
                "gear",
                "fixed",
                "rotation",
                "translation",
                "contact",
                "two_state",
                "three_state",
                "massless_link",
                "ideal",
                "dynamics",
                "statics",
                "kinematics",
                "hertz",
                "johnson",
                "flores",
                "lugre",
                "stribeck",
            ];
            *text = rng.word(&words).to_owned();
        }
        Json::Number(_) => *value = rng.unit().into(),
        Json::Null | Json::Bool(_) | Json::Array(_) | Json::Object(_) => {}
    }
}

fn edit(model: &mut Model, rng: &mut Rng) {
    let odd = ODD[rng.below(ODD.len())];
    match rng.below(10) {
        0 | 1 => {
            let mut numbers = numbers(model);
            let at = rng.below(numbers.len());
            *numbers[at] = odd;
        }
        2 => {
            let mut numbers = numbers(model);
            let at = rng.below(numbers.len());
            *numbers[at] *= 1.0 + 0.1 * rng.unit();
        }
        3 => {
            let mut options = options(model);
            let at = rng.below(options.len());
            *options[at] = Some(odd).filter(|_| !rng.once_in(3));
        }
        4 => {
            let mut names = names(model);
            if !names.is_empty() {
                let at = rng.below(names.len());
                *names[at] = rng.word(&NAMES).to_owned();
            }
        }
        5 => match rng.below(6) {
            0 => edit_map!(model.joints, rng),
            1 => edit_map!(model.drivers, rng),
            2 => edit_map!(model.forces, rng),
            3 => edit_map!(model.initial, rng),
            _ => edit_map!(model.bodies, rng),
        },
        6 => {
            let at = rng.below(model.bodies.len());
            if let Some((_, body)) = model.bodies.get_index_mut(at) {
                edit_map!(body.points, rng);
            }
        }
        _ => {
            let mut words = serde_json::to_value(&*model).unwrap_or_default();
            edit_words(&mut words, rng);
            if let Ok(mut edited) = serde_json::from_value::<Model>(words) {
                edited.display = model.display.clone();
                *model = edited;
            }
        }
    }
}

/// A model of the same words that is over soon.
fn short(model: &Checked) -> Option<Checked> {
    let short = model.edit(|model| {
        let Some(analysis) = &mut model.analysis else {
            return;
        };
        analysis.outputs = analysis.outputs.map(|outputs| outputs.min(3));
        if let Some(sample) = &mut analysis.sample {
            sample.step = sample.to - sample.from;
        }
    });
    short.ok()
}

/// What must hold of an edited model; whether it passed the gate.
fn holds(loaded: &Loaded, model: Model, is_run: bool) -> bool {
    let model = match model.check() {
        Ok(model) => model,
        Err(complaints) => {
            assert!(!complaints.is_empty());
            for complaint in complaints {
                assert!(!complaint.message.is_empty() && !complaint.path.is_empty());
                loaded.source.place(complaint);
            }
            return false;
        }
    };
    for (source, json) in [
        ("its file", loaded.source.print(&model)),
        ("nothing", model.to_json()),
    ] {
        let text = json.to_string();
        let again = linkdyn_model::load(text.as_bytes(), &[])
            .unwrap_or_else(|said| panic!("printed over {source}: {said:?}\n{json:#}"));
        assert_eq!(
            again.model.to_json().to_string(),
            model.to_json().to_string(),
            "printed over {source}: {json:#}"
        );
    }
    if is_run && let Some(model) = short(&model) {
        let control = Control {
            deadline: Some(Instant::now() + Duration::from_millis(20)),
            ..Control::default()
        };
        for complaint in check(&model).err().into_iter().flatten() {
            assert!(!complaint.message.is_empty());
        }
        for complaint in run(&model, &control).err().into_iter().flatten() {
            assert!(!complaint.message.is_empty());
        }
    }
    true
}

#[test]
fn edited_models_are_refused_or_run() {
    let number = |name: &str, otherwise: u64| {
        let text = std::env::var(name).ok();
        text.map_or(otherwise, |text| text.parse().expect("a number"))
    };
    let (count, seed) = (
        number("LINKDYN_EDITS", 2000),
        number("LINKDYN_EDIT_SEED", 7),
    );
    let sources = sources();
    let mut passed = 0;
    for index in 0..count {
        let mut rng = Rng::new(seed, index);
        let loaded = &sources[rng.below(sources.len())];
        let mut model = Model::clone(&loaded.model);
        for _ in 0..=rng.below(3) {
            edit(&mut model, &mut rng);
        }
        let kept = model.clone();
        let is_run = rng.once_in(4);
        let held = catch_unwind(AssertUnwindSafe(|| holds(loaded, model, is_run)));
        match held {
            Ok(held) => passed += u64::from(held),
            Err(_) => panic!("edit {index} of seed {seed}: {kept:?}"),
        }
    }
    println!("{count} edits, {passed} passed the gate");
    assert!(
        passed > count / 10 && passed < count,
        "{passed} of {count} passed"
    );
}

#[test]
fn a_model_is_printed_as_it_was_written() {
    for named in models::all() {
        let text = named.json.to_string();
        let loaded = linkdyn_model::load(text.as_bytes(), &[])
            .unwrap_or_else(|said| panic!("{}: {said:?}", named.name));
        let printed = loaded.source.print(&loaded.model);
        assert_eq!(printed.to_string(), text, "{}", named.name);
        // Without its file, a model is the same after it is printed and read.
        let alone = loaded.model.to_json();
        let again = linkdyn_model::load(alone.to_string().as_bytes(), &[])
            .unwrap_or_else(|said| panic!("{}: {said:?}\n{alone:#}", named.name));
        let mut model = again.model.clone().into_model();
        model.display = loaded.model.display.clone();
        assert_eq!(model, *loaded.model, "{}", named.name);
        assert_eq!(again.model.to_json().to_string(), alone.to_string());
        assert_eq!(again.source.print(&again.model), alone, "{}", named.name);
    }
}

//! What variants cost: `cargo bench --bench study -- --only NAME --seconds 1`.
//!
//! Each mechanism has a parameter for every number of its geometry. Its variants are off by up to a part in a thousand in
//! all of them at once. Beside each other, in one process: reading the model with other values, compiling it, running
//! it, and a variant of the family. Then variants per minute on one thread and on as many as there are.

// The tests use the rest.
#[allow(dead_code)]
#[path = "../tests/common/accuracy/told.rs"]
mod told;

use std::hint::black_box;
use std::time::{Duration, Instant};

use linkdyn_engine::analysis::{Control, Family, Prepared};
use linkdyn_engine::system::compile::compile;
use linkdyn_model::{Given, Loaded, bundled};
use serde_json::{Value, json};
use told::{Random, parametric};

/// Deviation of all parameters, relative.
const OFF: f64 = 1e-3;

struct Case {
    name: &'static str,
    model: &'static str,
    outputs: usize,
    /// With reactions.
    forces: bool,
    responses: &'static [&'static str],
}

const CASES: &[Case] = &[
    Case {
        name: "slider-crank, 36 positions",
        model: "slider-crank",
        outputs: 36,
        forces: false,
        responses: &["range(piston.x)", "max(abs(rod.angle))"],
    },
    Case {
        name: "four-bar, 36 positions",
        model: "four-bar",
        outputs: 36,
        forces: false,
        responses: &["range(rocker.angle)", "max(coupler.x)"],
    },
    Case {
        name: "four-bar, 361 positions",
        model: "four-bar",
        outputs: 361,
        forces: false,
        responses: &["range(rocker.angle)", "max(coupler.x)"],
    },
    Case {
        name: "lock, 36 positions, all reactions",
        model: "watt-i-lock",
        outputs: 36,
        forces: true,
        responses: &[],
    },
];

impl Case {
    fn load(&self) -> Loaded {
        let text = bundled::find(self.model).expect("bundled").text;
        let model = linkdyn_model::load(text.as_bytes(), &[])
            .expect("sound")
            .model;
        let mut json = parametric(&model, self.outputs);
        if self.model == "four-bar" {
            // one of its three turns
            json["analysis"]["end"] =
                json!(json["analysis"]["end"].as_f64().expect("an end") / 3.0);
        }
        let mut responses = serde_json::Map::new();
        let mut add = |text: String| responses.insert(format!("r{}", responses.len()), json!(text));
        for text in self.responses {
            add((*text).to_owned());
        }
        if self.forces {
            if let Some(forces) = model.to_json().get("forces") {
                json["forces"] = forces.clone();
            }
            json["analysis"]["type"] = json!("inverse_dynamics");
            // below the change point, up to which one motion goes
            if json["analysis"].get("sample").is_some() {
                let [from, to] = [-45f64, 110.0].map(f64::to_radians);
                let step = (to - from) / (self.outputs - 1) as f64;
                let sample = &mut json["analysis"]["sample"];
                (sample["from"], sample["to"], sample["step"]) =
                    (json!(from), json!(to), json!(step));
            }
            for joint in model.joints.keys() {
                add(format!("max(hypot(joint.{joint}.fx, joint.{joint}.fy))"));
            }
            for driver in model.drivers.keys() {
                add(format!("max(abs(driver.{driver}.effort))"));
            }
        }
        json["responses"] = Value::Object(responses);
        linkdyn_model::load(json.to_string().as_bytes(), &[]).expect("sound")
    }
}

/// Seconds of one of `work`, which is done for some time.
fn seconds(work: &mut dyn FnMut(), most: Duration) -> f64 {
    work();
    let (begin, mut count) = (Instant::now(), 0);
    while begin.elapsed() < most {
        (0..8).for_each(|_| work());
        count += 8;
    }
    begin.elapsed().as_secs_f64() / f64::from(count)
}

/// Variants per minute on some threads at once.
fn per_minute(family: &Family, variants: &[Vec<f64>], threads: usize, most: Duration) -> f64 {
    let count = |shift: usize| {
        let mut member = family.begin();
        let mut out = vec![0.0; family.responses().len()];
        let (begin, mut count) = (Instant::now(), 0_u32);
        for values in variants.iter().cycle().skip(shift) {
            member
                .run(values, &Control::default(), &mut out)
                .expect("sound");
            count += 1;
            if count % 64 == 0 && begin.elapsed() >= most {
                break;
            }
        }
        60.0 * f64::from(count) / begin.elapsed().as_secs_f64()
    };
    std::thread::scope(|scope| {
        let all: Vec<_> = (0..threads)
            .map(|k| scope.spawn(move || count(k)))
            .collect();
        let done = all.into_iter().map(|one| one.join().expect("no panic"));
        done.sum()
    })
}

fn measure(case: &Case, most: Duration) {
    let loaded = case.load();
    let names = loaded.parameters.iter().map(|one| one.name.as_str());
    let names: Vec<&str> = names.collect();
    let family = Family::new(&loaded, &names, Given::Values).expect("it runs");
    let mut random = Random(1);
    let mut variant = || -> Vec<f64> {
        let parameters = loaded.parameters.iter();
        let off = parameters.map(|one| one.value * (1.0 + OFF * random.both()));
        off.collect()
    };
    let variants: Vec<Vec<f64>> = (0..1024).map(|_| variant()).collect();
    let model = family.model(&variants[0]).expect("sound");
    let kind = model.analysis.as_ref().expect("one").kind;
    let prepared = Prepared::new(&model).expect("sound");
    let control = Control::default();
    let mut member = family.begin();
    let mut out = vec![0.0; family.responses().len()];
    let mut turn = variants.iter().cycle();
    println!(
        "{} ({} parameters, {} responses)",
        case.name,
        names.len(),
        out.len()
    );
    let stage = |what: &str, work: &mut dyn FnMut()| {
        println!("    {what:<28} {:8.1} µs", 1e6 * seconds(work, most / 4));
    };
    stage("read with other values", &mut || {
        black_box(family.model(&variants[0]).expect("sound"));
    });
    stage("compile", &mut || {
        black_box(compile(&model, kind).expect("sound"));
    });
    stage("run", &mut || {
        black_box(prepared.run(&control).expect("sound"));
    });
    stage("a variant of the family", &mut || {
        let values = turn.next().expect("it goes round");
        black_box(member.run(values, &control, &mut out).expect("sound"));
    });
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let one = per_minute(&family, &variants, 1, most);
    let all = per_minute(&family, &variants, threads, most);
    println!(
        "    per minute: {:.2} million on 1 thread, {:.2} million on {threads}: {:.2} times{}",
        one / 1e6,
        all / 1e6,
        all / one,
        if family.is_tracked() {
            ""
        } else {
            "; each is run by itself"
        }
    );
}

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let after = |name: &str| {
        let place = words.iter().position(|word| word == name)?;
        words.get(place + 1).cloned()
    };
    let only = after("--only").unwrap_or_default();
    let wanted = after("--seconds").map(|text| text.parse().expect("--seconds: a number"));
    for case in CASES.iter().filter(|case| case.name.contains(&only)) {
        measure(case, Duration::from_secs_f64(wanted.unwrap_or(2.0)));
    }
}

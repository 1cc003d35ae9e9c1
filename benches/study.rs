//! What a variant costs, by stages.
use linkdyn_engine::analysis::{Control, Family, Prepared};
use linkdyn_engine::system::compile::compile;
use linkdyn_model::{Given, bundled};
use std::hint::black_box;
use std::time::Instant;

fn time(name: &str, n: u32, mut f: impl FnMut()) {
    let mut best = f64::INFINITY;
    for _ in 0..std::env::var("ROUNDS").map_or(5, |r| r.parse().unwrap()) {
        let t = Instant::now();
        let n = std::env::var("COUNT").map_or(n, |r| r.parse().unwrap());
        for _ in 0..n {
            f();
        }
        best = best.min(t.elapsed().as_secs_f64() / f64::from(n));
    }
    println!("{name:20} {:8.2} us", best * 1e6);
}

fn main() {
    for (model, parameter, value, sets) in [
        (
            "slider-crank",
            "crank",
            0.0501,
            vec![
                "responses.a=max(piston.x)-min(piston.x)",
                "responses.b=max(abs(rod.angle))",
                "analysis.type=kinematics",
                "analysis.outputs=36",
            ],
        ),
        (
            "four-bar",
            "",
            0.0,
            vec![
                "responses.a=max(rocker.angle)-min(rocker.angle)",
                "responses.b=max(coupler.x)",
                "analysis.type=kinematics",
                "analysis.outputs=36",
            ],
        ),
        (
            "four-bar",
            "",
            0.0,
            vec![
                "responses.a=max(rocker.angle)-min(rocker.angle)",
                "responses.b=max(coupler.x)",
                "analysis.type=kinematics",
                "analysis.outputs=361",
            ],
        ),
        (
            "watt-i-lock",
            "",
            0.0,
            vec![
                "responses.a=max(abs(driver.motor.effort))",
                "analysis.sample.step=\"5 deg\"",
            ],
        ),
    ] {
        let text = bundled::find(model).unwrap().text;
        let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
        let loaded = linkdyn_model::load(text.as_bytes(), &sets).unwrap();
        let (parameter, value) = match parameter {
            "" => {
                let Some(p) = loaded.parameters.first() else {
                    continue;
                };
                (p.name.as_str(), p.value * 1.002)
            }
            _ => (parameter, value),
        };
        println!("{model} {parameter} {value}");
        let given = [(parameter, value)];
        time("with_parameters", 500, || {
            black_box(loaded.source.with_parameters(&given).unwrap());
        });
        let model = loaded.source.with_parameters(&given).unwrap();
        let kind = model.analysis.as_ref().unwrap().kind;
        time("compile", 500, || {
            black_box(compile(&model, kind).unwrap());
        });
        time("prepared", 500, || {
            black_box(Prepared::new(&model).unwrap());
        });
        let prepared = Prepared::new(&model).unwrap();
        let control = Control::default();
        time("run", 500, || {
            black_box(prepared.run(&control).unwrap());
        });
        let family = Family::new(&loaded, &[parameter], Given::Values).unwrap();
        let mut member = family.begin();
        let mut out = vec![0.0; family.responses().len()];
        println!("tracked {} {}", family.is_tracked(), family.describe());
        time("family", 500, || {
            black_box(member.run(&[value], &control, &mut out).unwrap());
        });
        println!(
            "{out:?} {:?}",
            prepared
                .run(&control)
                .unwrap()
                .responses
                .iter()
                .map(|a| a.value)
                .collect::<Vec<_>>()
        );
    }
}

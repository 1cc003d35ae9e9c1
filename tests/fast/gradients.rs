//! Gradients of responses: closed forms, and central differences on all models.

mod follows;
mod rest;

use crate::accuracy::told::Random;
use crate::family::{off, spread};
use crate::models::{self, Named};
use linkdyn_engine::analysis::{Control, Family, Member};
use linkdyn_model::{Given, Loaded};
use std::f64::consts::TAU;

/// Derivatives of closed forms are met to this part of their size.
const EXACT: f64 = 1e-12;
/// Central differences, extrapolated once, are met to this part.
const ALLOWED: f64 = 1e-7;
/// Step of the differences, by the length over which a parameter matters; the next is half of it.
const STEP: f64 = 5e-4;
/// With half the step they must be the same to this part, or else they say nothing.
const SETTLED: f64 = 1e-6;

/// A family of a bundled model with responses.
fn family(name: &str, sets: &[&str], responses: &[&str], parameters: &[&str]) -> Family {
    let text = linkdyn_model::bundled::find(name).expect("bundled").text;
    let named = responses.iter().enumerate();
    let named = named.map(|(k, text)| format!("responses.r{k}={text}"));
    let sets: Vec<String> = sets
        .iter()
        .map(|own| (*own).to_owned())
        .chain(named)
        .collect();
    let loaded = linkdyn_model::load(text.as_bytes(), &sets).expect("sound");
    Family::new(&loaded, parameters, Given::Values).expect("it runs")
}

/// Values and gradient.
fn gradient(family: &Family, values: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let count = family.responses().len();
    let mut responses = vec![f64::NAN; count];
    let mut gradient = vec![f64::NAN; count * values.len()];
    let lengths: Vec<f64> = values.iter().map(|own| own.abs()).collect();
    let mut member = family.begin();
    let control = Control::default();
    let ended = member.gradient(values, &lengths, &control, &mut responses, &mut gradient);
    ended.expect("it runs");
    (responses, gradient)
}

fn assert_met(what: &str, found: &[f64], exact: &[f64]) {
    for (k, (found, exact)) in found.iter().zip(exact).enumerate() {
        // Slopes of lengths by lengths are made of terms around 1.
        let size = exact.abs().max(1.0);
        assert!(
            (found - exact).abs() <= EXACT * size,
            "{what}, {k}: {found} is not {exact}, off by {:e}",
            (found - exact) / size
        );
    }
}

/// Stroke 2 r; largest acceleration r ω² (1 + r/l) at the outer end; x = r cos θ + √(l² − r² sin² θ).
#[test]
fn a_slider_crank_has_the_slopes_of_its_closed_forms() {
    let sets = [
        "analysis.type=kinematics",
        "analysis.end=1",
        "analysis.outputs=38",
        "drivers.motor.motion={\"type\":\"constant_velocity\",\"start\":\"10 deg\",\"velocity\":\"60 rpm\"}",
    ];
    let responses = [
        "max(piston.x) - min(piston.x)",
        "range(piston.x)*crank/rod",
        "max(abs(piston.ax))",
        "at(piston.x, driver.motor = 70 deg)",
        "last(piston.vx)",
        "at(driver.motor, piston.x = rod)",
    ];
    let family = family("slider-crank", &sets, &responses, &["crank", "rod"]);
    for (r, l) in [(0.05, 0.2), (0.045, 0.23)] {
        let (values, found) = gradient(&family, &[r, l]);
        let w = TAU;
        let x = |a: f64| {
            let root = (l * l - r * r * a.sin().powi(2)).sqrt();
            [a.cos() - r * a.sin().powi(2) / root, l / root]
        };
        let a = 70_f64.to_radians();
        // d/dθ of ∂x/∂(r, l) at the last angle, times ω
        let b = 10_f64.to_radians();
        let (s, c) = b.sin_cos();
        let root = (l * l - r * r * s * s).sqrt();
        let late = [
            -s - 2.0 * r * s * c / root - r.powi(3) * s.powi(3) * c / root.powi(3),
            l * r * r * s * c / root.powi(3),
        ];
        // x = l where cos θ = r/2l
        let angle = (r / (2.0 * l)).acos();
        let steep = -1.0 / angle.sin();
        let exact = [
            [2.0, 0.0],
            [4.0 * r / l, -2.0 * r * r / (l * l)],
            [w * w * (1.0 + 2.0 * r / l), -w * w * r * r / (l * l)],
            x(a),
            late.map(|own| w * own),
            [steep / (2.0 * l), -steep * r / (2.0 * l * l)],
        ];
        assert!((values[5] - angle).abs() < 1e-12, "{values:?}");
        for (k, exact) in exact.iter().enumerate() {
            assert_met(responses[k], &found[2 * k..2 * k + 2], exact);
        }
    }
}

/// Of a cycloidal rise h in T: the angle h (z − sin(2πz)/2π) at z = t/T, and the peak 2π h/T² of its acceleration.
#[test]
fn a_rise_has_the_slopes_of_its_closed_forms() {
    let sets = [
        "parameters.h=1 rad",
        "parameters.T=0.5 s",
        "analysis.type=kinematics",
        "analysis.end=0.3",
        "analysis.outputs=31",
        "drivers.motor.motion={\"type\":\"cycloidal\",\"rise\":\"=h\",\"duration\":\"=T\"}",
    ];
    let responses = ["last(crank.angle)", "max(abs(crank.alpha))"];
    let family = family("slider-crank", &sets, &responses, &["h", "T"]);
    for (h, t) in [(1.0, 0.5), (0.8, 0.45)] {
        let (values, found) = gradient(&family, &[h, t]);
        let z = 0.3 / t;
        let angle = z - (TAU * z).sin() / TAU;
        let speed = 1.0 - (TAU * z).cos();
        assert!((values[0] - h * angle).abs() < 1e-14, "{values:?}");
        assert_met(responses[0], &found[..2], &[angle, -h * speed * z / t]);
        let peak = TAU / (t * t);
        assert!((values[1] - h * peak).abs() < 1e-9 * peak, "{values:?}");
        for (found, exact) in found[2..].iter().zip([peak, -2.0 * h * peak / t]) {
            assert!(
                (found - exact).abs() < 1e-9 * exact.abs(),
                "{found} {exact}"
            );
        }
    }
}

/// The angle of transmission is least where crank and base lie in line: cos μ = (b² + c² − (d − a)²)/2bc.
#[test]
fn a_four_bar_has_the_slopes_of_its_angle_of_transmission() {
    let sets = ["analysis.type=kinematics", "analysis.outputs=50"];
    let least = "min(acos(cos(coupler.angle - rocker.angle)))";
    let names = ["base", "crank", "coupler", "rocker"];
    let family = family("four-bar", &sets, &[least], &names);
    let [d, a, b, c] = [0.3, 0.1, 0.25, 0.2];
    let (values, found) = gradient(&family, &[d, a, b, c]);
    let of = |d: f64| (b * b + c * c - d * d) / (2.0 * b * c);
    let (short, long) = (d - a, d + a);
    // The smaller of both ends of the stroke, seen as an angle between 0 and π.
    let (span, by_crank) = match of(short).acos() < of(long).acos() {
        true => (short, -1.0),
        false => (long, 1.0),
    };
    let cos = of(span);
    assert!(
        (values[0] - cos.acos()).abs() < 1e-12,
        "{values:?} is not {}",
        cos.acos()
    );
    let by = -1.0 / (1.0 - cos * cos).sqrt();
    let by_span = by * -span / (b * c);
    let exact = [
        by_span,
        by_crank * by_span,
        by * (1.0 / c - cos / b),
        by * (1.0 / b - cos / c),
    ];
    assert_met(least, &found, &exact);
}

/// What moves has derivatives where joints have friction; what they carry has none that are known.
#[test]
fn friction_leaves_the_slopes_of_the_motion() {
    let friction = "joints.crankpin.friction={\"law\":\"coulomb\",\"coefficient\":0.1,\"threshold_velocity\":0.01}";
    let sets = [
        "analysis.end=0.3",
        "analysis.outputs=12",
        "drivers.motor.motion={\"type\":\"constant_velocity\",\"start\":\"40 deg\",\"velocity\":\"60 rpm\"}",
        friction,
        "joints.crankpin.pin_radius=0.01",
    ];
    let responses = ["first(piston.x)", "mean(driver.motor.effort)"];
    let (r, l) = (0.045_f64, 0.23_f64);
    let angle = 40_f64.to_radians();
    let root = (l * l - r * r * angle.sin().powi(2)).sqrt();
    let exact = [angle.cos() - r * angle.sin().powi(2) / root, l / root];
    for rubs in [false, true] {
        let sets = if rubs { &sets[..] } else { &sets[..3] };
        let family = family("slider-crank", sets, &responses, &["crank", "rod"]);
        let (_, found) = gradient(&family, &[r, l]);
        assert_met(responses[0], &found[..2], &exact);
        assert!(
            found[2..].iter().all(|own| own.is_nan() == rubs),
            "{found:?}"
        );
    }
}

/// Derivatives that can't be had are not made up.
#[test]
fn kinks_and_second_derivatives_are_not_known() {
    let sets = [
        "analysis.type=kinematics",
        "analysis.end=1",
        "analysis.outputs=38",
        "drivers.motor.motion={\"type\":\"constant_velocity\",\"velocity\":\"60 rpm\"}",
    ];
    let responses = [
        "min(abs(piston.vx))",
        "argmax(piston.vx)",
        "count(piston.x = rod)",
        "max(piston.x)",
    ];
    let family = family("slider-crank", &sets, &responses, &["crank"]);
    let (_, found) = gradient(&family, &[0.05]);
    // What touches zero stays there.
    assert!(found[0].is_nan() || found[0].abs() < 1e-9, "{found:?}");
    assert!(found[1..3].iter().all(|own| own.is_nan()), "{found:?}");
    assert!((found[3] - 1.0).abs() < EXACT, "{found:?}");
}

/// A response at values where one parameter is off.
fn moved(member: &mut Member, values: &[f64], (k, by): (usize, f64), count: usize) -> Vec<f64> {
    let mut values = values.to_vec();
    values[k] += by;
    let mut responses = vec![f64::NAN; count];
    let _ = member.run(&values, &Control::default(), &mut responses);
    responses
}

#[derive(Default)]
struct Tally {
    known: usize,
    unknown: usize,
    worst: f64,
    what: String,
}

/// The family of a model by all its parameters.
fn family_of(loaded: &Loaded) -> Option<Family> {
    let parameters = loaded.parameters.iter();
    let names: Vec<&str> = parameters.map(|one| one.name.as_str()).collect();
    Family::new(loaded, &names, Given::Values).ok()
}

fn compare(
    name: &str,
    (loaded, family): (&Loaded, &Family),
    random: &mut Random,
    tally: &mut Tally,
) {
    let mut values = off(loaded, 0.01, random);
    // Zeros stay: a number that leaves zero may be another model.
    for (value, own) in values.iter_mut().zip(&loaded.parameters) {
        *value = if own.value == 0.0 { 0.0 } else { *value };
    }
    let length = |own: &f64| if own.abs() < 1e-9 { 0.01 } else { own.abs() };
    let lengths: Vec<f64> = values.iter().map(length).collect();
    let (count, columns) = (family.responses().len(), family.parameters());
    let (mut responses, mut gradient) = (vec![f64::NAN; count], vec![f64::NAN; count * columns]);
    let mut member = family.begin();
    let control = Control::default();
    if member
        .gradient(&values, &lengths, &control, &mut responses, &mut gradient)
        .is_err()
    {
        return;
    }
    for k in 0..columns {
        // The quotient over both sides, and by how much those of each side are apart.
        let quotient = |member: &mut Member, part: f64| -> Vec<[f64; 2]> {
            let h = part * STEP * lengths[k];
            let [up, down] = [h, -h].map(|by| moved(member, &values, (k, by), count));
            let of = |j: usize| {
                let apart = (up[j] - 2.0 * responses[j] + down[j]) / h;
                [(up[j] - down[j]) / (2.0 * h), apart]
            };
            (0..count).map(of).collect()
        };
        let (wide, near) = (quotient(&mut member, 1.0), quotient(&mut member, 0.5));
        for j in 0..count {
            let [[wide, wide_apart], [near, apart]] = [wide[j], near[j]];
            let expected = near + (near - wide) / 3.0;
            let found = gradient[j * columns + k];
            if found.is_nan() {
                tally.unknown += usize::from(expected.is_finite());
                continue;
            }
            let size = expected.abs().max(responses[j].abs() / lengths[k]).max(0.1);
            // Differences that do not settle say nothing, nor those beside a kink, where two extremes are the same: there both
            // sides are not twice as far apart with twice the step.
            let is_smooth = (wide_apart - 2.0 * apart).abs() <= 1e-6 * size;
            let is_settled = (near - wide).abs() <= SETTLED * size && is_smooth;
            // Of a sum of forces that cancel there is round-off, and so there is of its slope.
            let text = &family.responses().list()[j].text;
            let is_nothing = responses[j].abs() < 1e-6 && expected.abs() < 1e-6;
            if text.contains("shaking.f") && is_nothing {
                assert!(found.abs() < 1e-5, "{name}: {text}: {found}");
                continue;
            }
            if !expected.is_finite() || !is_settled {
                continue;
            }
            tally.known += 1;
            // What halving the step changes is how far the differences themselves may be trusted.
            let part = ((found - expected).abs() - (near - wide).abs()).max(0.0) / size;
            if part > tally.worst {
                tally.worst = part;
                let response = &family.responses().list()[j].text;
                tally.what = format!(
                    "{name}: {response} by {}: {found}, not {expected}",
                    loaded.parameters[k].name
                );
            }
        }
    }
}

/// Models that were bundled when the numbers of the others had been drawn.
const LATER: [&str; 3] = ["bicycle-suspension", "excavator", "wiper"];

#[test]
fn gradients_are_those_of_central_differences() {
    let mut random = Random(14);
    let (mut known, mut unknown, mut faults) = (0, 0, Vec::new());
    // What came later is tried last, so that the others keep their numbers.
    let later = |named: &Named| LATER.contains(&named.name.as_str());
    let (later, first): (Vec<Named>, Vec<Named>) = models::all().into_iter().partition(later);
    for named in first.into_iter().chain(later) {
        for kind in ["kinematics", "inverse_dynamics"] {
            let Some(loaded) = spread(&named.json, kind) else {
                continue;
            };
            let mut tally = Tally::default();
            let Some(family) = family_of(&loaded).filter(Family::is_tracked) else {
                continue;
            };
            compare(&named.name, (&loaded, &family), &mut random, &mut tally);
            println!(
                "{:36} {kind:16} {:4} {:4} {:.1e} {}",
                named.name, tally.known, tally.unknown, tally.worst, tally.what
            );
            known += tally.known;
            unknown += tally.unknown;
            if tally.worst > ALLOWED {
                faults.push(format!("{:e} {}", tally.worst, tally.what));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    println!("{known} known, {unknown} not");
    assert!(
        known >= 10_000 && unknown <= known / 4,
        "{known} known, {unknown} not"
    );
}

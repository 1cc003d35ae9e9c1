//! Internal forces of links with a cross-section: against beams, against a four-bar by hand, and in equilibrium.

use crate::mechanisms::*;
use crate::models;
use linkdyn_engine::analysis::Outcome;
use linkdyn_model::{AnalysisKind, LinkSection, Model, SectionShape, bundled};
use serde_json::{Value, json};

/// A beam of 0.8 m along x from A, with points C inside and B at its end.
fn beam(mass: f64, section: Value, joints: Value, forces: Value) -> Value {
    json!({ "format": "linkdyn/1", "units": "SI", "gravity": [0.0, -10.0],
        "bodies": {
            "ground": { "points": { "A": [0, 0], "C": [0.5, 0], "B": [0.8, 0] } },
            "beam": { "mass": mass, "inertia": mass * 0.64 / 12.0, "com": [0.4, 0],
                "points": { "A": [0, 0], "M": [0.4, 0], "C": [0.5, 0], "B": [0.8, 0], "T": [0.8, 0.1] },
                "section": section } },
        "joints": joints, "forces": forces, "analysis": { "type": "statics" } })
}

fn rectangle(stations: usize) -> Value {
    json!({ "from": "A", "to": "B", "type": "rectangle", "width": 0.01, "height": 0.02, "stations": stations,
            "young_modulus": 2e11 })
}

/// Area and section modulus of that.
const AREA: f64 = 2e-4;
const MODULUS: f64 = 0.01 * 0.02 * 0.02 / 6.0;

#[track_caller]
fn is(run: &Outcome, quantity: &str, known: f64) {
    let ours = column(run, &format!("section.beam.{quantity}"))[0];
    let off = (ours - known).abs();
    assert!(
        off <= 1e-12 * known.abs().max(1.0),
        "{quantity}: {ours} instead of {known}"
    );
}

#[test]
fn a_cantilever_bends_as_beams_do() {
    let fixed = json!({ "f": { "type": "fixed", "between": ["ground.A", "beam.A"] } });
    let load = json!({ "p": { "type": "force", "at": "beam.B", "vector": [300, -100] } });
    let run = completed(&beam(0.0, rectangle(5), fixed.clone(), load));
    for k in 0..5 {
        let x = 0.2 * k as f64;
        is(&run, &format!("axial_force_{}", k + 1), 300.0);
        is(&run, &format!("shear_force_{}", k + 1), -100.0);
        is(
            &run,
            &format!("bending_moment_{}", k + 1),
            -100.0 * (0.8 - x),
        );
    }
    is(&run, "tension", 300.0);
    is(&run, "compression", 0.0);
    is(&run, "shear_force", 100.0);
    is(&run, "bending_moment", 80.0);
    is(&run, "stress", 300.0 / AREA + 80.0 / MODULUS);
    is(&run, "stress_at", 0.0);
    is(&run, "buckling", 0.0);
    // pushed at a point beside the axis: the arm bends it everywhere
    let load = json!({ "p": { "type": "force", "at": "beam.T", "vector": [-300, 0] } });
    let run = completed(&beam(0.0, rectangle(3), fixed.clone(), load));
    assert!(run.report.warnings.is_empty(), "{:?}", run.report.warnings);
    for k in 1..=3 {
        is(&run, &format!("axial_force_{k}"), -300.0);
        is(&run, &format!("bending_moment_{k}"), 30.0);
    }
    let euler = std::f64::consts::PI.powi(2) * 2e11 * (0.02 * 1e-6 / 12.0) / 0.64;
    is(&run, "buckling", 300.0 / euler);
    let load = json!({ "p": { "type": "force", "at": "beam.B", "vector": [-6000, 0] } });
    let run = completed(&beam(0.0, rectangle(3), fixed, load));
    assert_eq!(
        run.report.warnings,
        [
            "body \"beam\" buckles: its largest compression, 6000 N at t = 0 s, is 1.167 times the load of 5140 N under which a bar \
             with pinned ends does (Euler)"
        ]
    );
}

fn supported(at: &str) -> Value {
    json!({ "a": pin("ground.A", "beam.A"),
        "b": { "type": "slot", "between": [format!("ground.{at}"), format!("beam.{at}")], "axis": [1, 0] } })
}

#[test]
fn a_simple_beam_carries_a_load_and_its_weight() {
    let load = json!({ "p": { "type": "force", "at": "beam.M", "vector": [0, -100] } });
    // w = 4·10/0.8 = 50 N/m
    let run = completed(&beam(4.0, rectangle(5), supported("B"), load));
    for (k, shear, moment) in [
        (1, -70.0, 0.0),
        (2, -60.0, 13.0),
        // on the side of less x of the load
        (3, -50.0, 24.0),
        (4, 60.0, 13.0),
        (5, 70.0, 0.0),
    ] {
        is(&run, &format!("axial_force_{k}"), 0.0);
        is(&run, &format!("shear_force_{k}"), shear);
        is(&run, &format!("bending_moment_{k}"), moment);
    }
    is(
        &run,
        "bending_moment",
        100.0 * 0.8 / 4.0 + 50.0 * 0.64 / 8.0,
    );
    is(&run, "stress_at", 0.4);
    // its weight alone, with stations at its ends alone
    let run = completed(&beam(4.0, rectangle(2), supported("B"), json!({})));
    is(&run, "bending_moment", 50.0 * 0.64 / 8.0);
    is(&run, "stress", 4.0 / MODULUS);
}

#[test]
fn an_overhang_bends_over_its_support() {
    let load = json!({ "p": { "type": "force", "at": "beam.B", "vector": [0, -100] } });
    let run = completed(&beam(0.0, rectangle(9), supported("C"), load));
    is(&run, "bending_moment", 30.0);
    is(&run, "stress_at", 0.5);
    is(&run, "shear_force_2", 60.0);
    is(&run, "shear_force_6", 60.0);
    is(&run, "shear_force_7", -100.0);
    is(&run, "bending_moment_3", -60.0 * 0.2);
    is(&run, "bending_moment_8", -100.0 * 0.1);
    // its weight alone: A carries R = W (0.5 − 0.4)/0.5, inside M = R²/2w at x = R/w, over the support M = −w 0.3²/2
    let run = completed(&beam(4.0, rectangle(2), supported("C"), json!({})));
    let left = 40.0 * (0.5 - 0.4) / 0.5;
    let (inside, over) = (left * left / 100.0, 50.0 * 0.3 * 0.3 / 2.0);
    assert!(over > inside);
    is(&run, "bending_moment", over);
}

/// The four-bar's coupler by its own kinematics and d'Alembert's principle.
struct ByHand {
    /// Largest N, V and M of all.
    largest: [f64; 3],
    /// By instant and station.
    cuts: Vec<[[f64; 3]; 9]>,
}

type V = [f64; 2];

fn plus(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1]]
}

fn times(a: V, by: f64) -> V {
    [a[0] * by, a[1] * by]
}

fn cross(a: V, b: V) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn polar(length: f64, angle: f64) -> V {
    [length * angle.cos(), length * angle.sin()]
}

/// Acceleration of a place at `r` of a body that turns with ω, α, relative to its origin.
fn turning(r: V, omega: f64, alpha: f64) -> V {
    [
        -alpha * r[1] - omega * omega * r[0],
        alpha * r[0] - omega * omega * r[1],
    ]
}

/// Solves a x + b y = c of plane vectors.
fn solved(a: V, b: V, c: V) -> V {
    let det = cross(a, b);
    [cross(c, b) / det, cross(a, c) / det]
}

fn by_hand(times_of: &[f64]) -> ByHand {
    let (base, crank, coupler, rocker, omega) = (0.3, 0.1, 0.25, 0.2, 10.0);
    let gravity = [0.0, -9.81];
    let (mass, inertia, com) = (1.9, 9e-3, [0.125, 0.02]);
    let (rocker_mass, rocker_inertia, rocker_com) = (1.5, 5e-3, 0.1);
    let bar = 7850.0 * 0.008 * 0.012;
    let mut hand = ByHand {
        largest: [0.0; 3],
        cuts: Vec::new(),
    };
    for time in times_of {
        let theta = 60f64.to_radians() + omega * time;
        let a = polar(crank, theta);
        // B by the triangle of A, B and O4
        let d = [a[0] - base, a[1]];
        let diagonal = d[0].hypot(d[1]);
        let corner = ((diagonal * diagonal + rocker * rocker - coupler * coupler)
            / (2.0 * diagonal * rocker))
            .acos();
        let psi = d[1].atan2(d[0]) - corner;
        let b = plus([base, 0.0], polar(rocker, psi));
        let (ab, o4b) = (plus(b, times(a, -1.0)), polar(rocker, psi));
        let phi = ab[1].atan2(ab[0]);
        let perp = |r: V| [-r[1], r[0]];
        // v_A + φ̇ ⊥AB = ψ̇ ⊥O4B, and the same of accelerations
        let [phi_rate, psi_rate] = solved(perp(ab), times(perp(o4b), -1.0), times(perp(a), -omega));
        let a_a = turning(a, omega, 0.0);
        let known = plus(
            times(plus(a_a, turning(ab, phi_rate, 0.0)), -1.0),
            turning(o4b, psi_rate, 0.0),
        );
        let [phi_2, psi_2] = solved(perp(ab), times(perp(o4b), -1.0), known);
        let (e, n) = (polar(1.0, phi), perp(polar(1.0, phi)));
        let at = |s: V| plus(times(e, s[0]), times(n, s[1]));
        let accelerated = |s: V| plus(a_a, turning(at(s), phi_rate, phi_2));
        let lost = |m: f64, s: V| times(plus(gravity, times(accelerated(s), -1.0)), m);
        // force B on the coupler: moments of the coupler about A, of the rocker about O4 (which gets −B)
        let of_coupler = cross(at(com), lost(mass, com)) - inertia * phi_2;
        let g = polar(rocker_com, psi);
        let fall = plus(gravity, times(turning(g, psi_rate, psi_2), -1.0));
        let of_rocker = cross(g, times(fall, rocker_mass)) - rocker_inertia * psi_2;
        // AB × B = −of_coupler, O4B × B = of_rocker
        let det = ab[0] * o4b[1] - ab[1] * o4b[0];
        let (c, r) = (-of_coupler, of_rocker);
        let force_b = [
            (o4b[0] * c - ab[0] * r) / det,
            (o4b[1] * c - ab[1] * r) / det,
        ];
        let force_a = times(plus(force_b, lost(mass, com)), -1.0);
        // what the body has beyond the bar
        let of_bar = bar * coupler;
        let rest = mass - of_bar;
        let rest_com = [
            com[0] * mass / rest - 0.5 * coupler * of_bar / rest,
            com[1] * mass / rest,
        ];
        let apart = |s: V| (s[0] - com[0]).powi(2) + (s[1] - com[1]).powi(2);
        let rest_inertia = inertia
            - of_bar * (coupler * coupler / 12.0 + apart([0.5 * coupler, 0.0]))
            - rest * apart(rest_com);
        let mut cuts = [[0.0; 3]; 9];
        for (k, cut) in cuts.iter_mut().enumerate() {
            let x = coupler * k as f64 / 8.0;
            let mut part = |force: V, s: V, couple: f64| {
                let local = [
                    force[0] * e[0] + force[1] * e[1],
                    force[0] * n[0] + force[1] * n[1],
                ];
                cut[0] -= local[0];
                cut[1] -= local[1];
                cut[2] -= cross([s[0] - x, s[1]], local) + couple;
            };
            part(force_a, [0.0, 0.0], 0.0);
            if rest_com[0] < x - 1e-9 {
                part(lost(rest, rest_com), rest_com, -rest_inertia * phi_2);
            }
            // by Simpson's rule, which is exact here
            for (weight, place) in [(1.0, 0.0), (4.0, 0.5), (1.0, 1.0)] {
                let s = [place * x, 0.0];
                part(lost(bar * x * weight / 6.0, s), s, 0.0);
            }
            let largest = hand.largest.iter_mut().zip(cut.iter());
            largest.for_each(|(largest, own)| *largest = largest.max(own.abs()));
        }
        hand.cuts.push(cuts);
    }
    hand
}

#[test]
fn the_four_bars_coupler_is_cut_as_by_hand() {
    let mut model = models::load_bundled("four-bar", &["analysis.outputs=36"]);
    model.bodies["coupler"].section = Some(Box::new(LinkSection {
        from: "A".into(),
        to: "B".into(),
        shape: SectionShape::Rectangle {
            width: 0.008,
            height: 0.012,
        },
        material: Some(linkdyn_model::LinkMaterial::Steel),
        young_modulus: None,
        density: None,
        stations: Some(9),
    }));
    model.analysis.as_mut().expect("one").end = Some(std::f64::consts::TAU / 10.0 * 35.0 / 36.0);
    let run = models::solve(&model);
    let hand = by_hand(&column(&run, "time"));
    assert_eq!(hand.cuts.len(), 36);
    let mut worst = 0.0_f64;
    for (quantity, word) in ["axial_force", "shear_force", "bending_moment"]
        .iter()
        .enumerate()
    {
        for station in 0..9 {
            let ours = column(&run, &format!("section.coupler.{word}_{}", station + 1));
            for (row, ours) in ours.iter().enumerate() {
                let known = hand.cuts[row][station][quantity];
                let off = (ours - known).abs() / hand.largest[quantity];
                assert!(
                    off < 1e-12,
                    "{word} {row} {station}: {ours} {known}, {off:e}"
                );
                worst = worst.max(off);
            }
        }
    }
    println!("off by {worst:e}");
    assert!(run.report.quality.section_imbalance.expect("a section") < 1e-13);
}

/// Journals in their bearings, by each model of contact.
const CONTACTS: [&[&str]; 4] = [
    &[],
    &["joints.wristpin.clearance.model=two_state"],
    &["joints.wristpin.clearance.model=three_state"],
    &[
        "joints.wristpin.clearance.model=three_state",
        "joints.wristpin.clearance.impact.restitution=0",
        "analysis.end=12 ms",
    ],
];

/// A hinged rod on which every kind of force acts, and that falls on a stop and rests there; a tip of it slides on an outline.
fn loaded_rod(analysis: Value) -> Value {
    let mut bodies = json!({ "ground": { "points": { "O": [0, 0], "W": [0.3, 0.4], "Q": [-0.2, 0.1], "F": [0, 0] } },
        "rod": { "mass": 1.0, "inertia": 0.2, "com": [0.4, 0.05], "points": { "O": [0, 0], "C": [0.3, 0.02], "E": [1.0, 0] } },
        "hung": { "mass": 0.3, "inertia": 0.01, "com": [0.05, 0], "points": { "A": [0, 0], "B": [0.1, 0] } } });
    bodies["hung"]["pose"] = json!({ "position": [1.0, 0.0], "angle": -1.0 });
    let friction = json!({ "law": "coulomb", "coefficient": 0.2, "threshold_velocity": 0.01 });
    let joints = json!({
        "o": { "type": "revolute", "between": ["ground.O", "rod.O"], "limits": [-0.1, null], "friction": friction, "pin_radius": 0.02 },
        "soft": { "type": "bushing", "between": ["rod.E", "hung.A"], "radial_stiffness": 5e3, "radial_damping": 20.0,
                  "torsional_stiffness": 1.0, "torsional_damping": 0.01 },
        "b": { "type": "belt", "between": ["ground.Q", "rod.O"], "radii": [0.05, 0.05], "pretension": 20.0, "stiffness": 500.0, "carrier": "ground",
               "damping": 1.0 } });
    let mut model = model(bodies, joints, json!({}));
    model["forces"] = json!({
        "s": { "type": "spring", "between": ["ground.W", "rod.C"], "stiffness": 20.0, "damping": 1.0, "free_length": 0.2 },
        "t": { "type": "torsion_spring", "between": ["ground", "rod"], "stiffness": 0.3, "damping": 0.05, "free_angle": 0.2 },
        "c": { "type": "cable", "through": ["ground.W", "rod.E", "rod.C", "ground.Q"], "stiffness": 15.0, "free_length": 0.5 },
        "m": { "type": "torque", "body": "rod", "value": 0.2 },
        "n": { "type": "torque", "body": "hung", "relative_to": "rod", "value": 0.05 },
        "l": { "type": "force", "at": "hung.B", "vector": [0.2, -0.3], "frame": "body" } });
    model["analysis"] = analysis;
    model
}

/// Nothing that acts on a body is left out: on each body of each model that has two points, nothing is left beyond the ends.
#[test]
fn nothing_is_left_beyond_the_ends_in_any_model() {
    let (mut tried, mut faults) = (0, Vec::new());
    let mut all: Vec<(String, Model)> = models::all()
        .into_iter()
        .map(|named| (named.name, models::load(&named.json)))
        .collect();
    // journals that fly, touch, slide and stick
    for sets in CONTACTS {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        let text = bundled::find("slider-crank-clearance").expect("it").text;
        let loaded = linkdyn_model::load(text.as_bytes(), &sets);
        let loaded = loaded.unwrap_or_else(|said| panic!("{sets:?}: {said:?}"));
        all.push((format!("{sets:?}"), loaded.model.into_model()));
    }
    let rests = json!({ "type": "dynamics", "end": 2.0, "outputs": 101 });
    all.push(("loaded rod".into(), models::load(&loaded_rod(rests))));
    for (name, mut model) in all {
        let Some(analysis) = &mut model.analysis else {
            continue;
        };
        let is_known = |body: &linkdyn_model::Body| body.mass.is_some() && body.inertia.is_some();
        let mut moving = model.bodies.iter().filter(|(name, _)| *name != "ground");
        if analysis.kind == AnalysisKind::Kinematics && moving.all(|(_, body)| is_known(body)) {
            analysis.kind = AnalysisKind::InverseDynamics;
        }
        for (body, words) in &mut model.bodies {
            let mut points = words.points.iter();
            let Some((from, place)) = points.next().filter(|_| body != "ground") else {
                continue;
            };
            let Some((to, other)) = points.find(|(_, other)| *other != place) else {
                continue;
            };
            let length = (other[0] - place[0]).hypot(other[1] - place[1]);
            let shape = SectionShape::General {
                area: 1e-4,
                second_moment: 1e-9,
                section_modulus: Some(1e-7),
                shear_area: None,
            };
            let density = words.mass.filter(|mass| *mass > 0.0);
            words.section = Some(Box::new(LinkSection {
                from: from.clone(),
                to: to.clone(),
                shape,
                material: None,
                young_modulus: None,
                density: Some(density.map_or(1.0, |mass| 0.5 * mass / (1e-4 * length))),
                stations: Some(2),
            }));
        }
        let run = models::solve(&model);
        if let Some(imbalance) = run.report.quality.section_imbalance {
            tried += 1;
            println!("{imbalance:9.2e} {}", name);
            if imbalance.is_nan() || imbalance >= 1e-9 {
                faults.push(format!("{}: {imbalance:e}", name));
            }
        }
    }
    println!("{tried} models");
    assert!(faults.is_empty() && tried > 30, "{tried}: {faults:#?}");
}

/// The table of `docs/validation.md`: its bars go into the bundled lock, its numbers come out.
#[test]
fn the_links_of_the_lock_carry_what_the_book_says() {
    let book = include_str!("../../docs/validation.md");
    let rows: Vec<Vec<&str>> = book
        .lines()
        .filter(|line| line.starts_with("| `link"))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows.len(), 5);
    let mut lock: Value =
        serde_json::from_str(bundled::find("lock").expect("bundled").text).expect("JSON");
    lock["analysis"]["sample"]["to"] = json!("116 deg");
    for row in &rows {
        let (from, to) = row[1].split_once(", ").expect("two pins");
        lock["bodies"][row[0].trim_matches('`')]["section"] = json!({ "type": "rectangle", "from": from, "to": to,
            "width": row[2].trim_end_matches(", ours"), "height": row[2], "material": "steel" });
    }
    let run = completed(&lock);
    for row in &rows {
        let quantities = ["tension", "compression", "bending_moment", "stress"];
        for (quantity, said) in quantities.iter().zip(&row[3..]) {
            let (number, unit) = said.split_once(' ').expect("a unit");
            let size = if unit == "MPa" { 1e6 } else { 1.0 };
            let known: f64 = number.parse().expect("a number");
            let values = column(
                &run,
                &format!("section.{}.{quantity}", row[0].trim_matches('`')),
            );
            let ours = values.iter().fold(0.0_f64, |most, value| most.max(*value)) / size;
            assert!(
                (ours / known - 1.0).abs() < 1e-4,
                "{row:?}: {quantity} {ours}"
            );
        }
    }
}

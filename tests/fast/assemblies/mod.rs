//! All assemblies and circuits: counts that are published, closed forms, and a search of its own from random starts.

mod circuits;
mod refused;
mod search;
mod workspace;

use crate::mechanisms::*;
use linkdyn_engine::analysis::{AllAssemblies, Control, all_assemblies};
use serde_json::{Value, json};

fn all(model: &Value) -> AllAssemblies {
    all_assemblies(&loaded(model).model, 0.0, 1000, &Control::default())
        .unwrap_or_else(|said| panic!("{said:?}"))
}

fn bundled(name: &str) -> Value {
    let text = linkdyn_model::bundled::text(name).expect("there");
    serde_json::from_str(&text).expect("JSON")
}

/// Numbers that are always the same, in −1 … 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Bodies that pins join, at random places; the first is the ground.
fn truss(edges: &[[usize; 2]], seed: u64) -> Value {
    let mut random = Random(seed);
    let name = |body: usize| match body {
        0 => "ground".to_owned(),
        body => format!("b{body}"),
    };
    let (mut bodies, mut joints) = (json!({}), json!({}));
    for [a, b] in edges {
        let place = json!([random.next(), random.next()]);
        let joint = format!("j{a}{b}");
        for body in [a, b] {
            bodies[name(*body)]["points"][&joint] = place.clone();
        }
        let between = [a, b].map(|body| format!("{}.{joint}", name(*body)));
        joints[&joint] = json!({ "type": "revolute", "between": between });
    }
    json!({ "format": "linkdyn/1", "units": "SI", "bodies": bodies, "joints": joints })
}

/// Baranov's trusses: the pentad of two loops, the three of seven links, and the least and the most of the 28 of nine links. Counts of
/// assemblies in complex numbers: Wampler, Proc. R. Soc. A 457, 2001 (6; 14, 16, 18); those of nine links agree with a second draw.
#[test]
fn trusses_have_as_many_assemblies_as_published() {
    let five: &[[usize; 2]] = &[[0, 1], [0, 2], [0, 3], [1, 4], [2, 4], [3, 4]];
    let seven: [(&[[usize; 2]], usize); 3] = [
        (
            &[
                [0, 1],
                [0, 5],
                [0, 6],
                [1, 2],
                [2, 3],
                [2, 6],
                [3, 4],
                [4, 5],
                [4, 6],
            ],
            14,
        ),
        (
            &[
                [0, 1],
                [0, 3],
                [0, 6],
                [1, 2],
                [1, 4],
                [2, 3],
                [3, 5],
                [4, 5],
                [4, 6],
            ],
            16,
        ),
        (
            &[
                [0, 1],
                [0, 2],
                [0, 5],
                [0, 6],
                [1, 4],
                [2, 3],
                [3, 4],
                [3, 6],
                [4, 5],
            ],
            18,
        ),
    ];
    let nine: [(&[[usize; 2]], usize); 2] = [
        (
            &[
                [0, 1],
                [0, 3],
                [0, 2],
                [0, 4],
                [1, 8],
                [1, 6],
                [2, 7],
                [2, 5],
                [3, 5],
                [3, 6],
                [4, 7],
                [4, 8],
            ],
            30,
        ),
        (
            &[
                [0, 3],
                [0, 7],
                [0, 1],
                [1, 6],
                [1, 4],
                [2, 3],
                [2, 5],
                [2, 6],
                [3, 8],
                [4, 5],
                [4, 8],
                [5, 7],
            ],
            58,
        ),
    ];
    for (edges, complex) in [(five, 6)].into_iter().chain(seven).chain(nine) {
        for seed in 0..if edges.len() > 9 { 1 } else { 5 } {
            let found = all(&truss(edges, seed));
            assert_eq!(found.doubts, [""; 0], "{edges:?} {seed}");
            let [group] = &found.groups[..] else {
                panic!("{:?}", found.groups)
            };
            assert_eq!(group.complex, complex, "{edges:?} {seed}");
            // The drawing is one of them, and real ones come in pairs.
            assert!(found.found[0].is_drawn && found.found.iter().all(|one| one.is_proven));
            assert_eq!(found.found.len() % 2, 0, "{edges:?} {seed}");
        }
    }
}

/// Bundled models: how many there are, counted by hand from their dyads, and by Wampler for the lock's group of two loops.
#[test]
fn bundled_models_have_all_their_assemblies() {
    for (name, count) in [
        ("pendulum", 1),
        ("four-bar", 2),
        ("slider-crank", 2),
        ("scotch-yoke", 1),
        ("andrews-squeezer", 4),
        ("jansen-leg", 8),
        ("excavator", 16),
        ("watt-i-lock", 4),
    ] {
        let found = all(&bundled(name));
        assert_eq!(
            (found.found.len(), &found.doubts[..]),
            (count, &[][..]),
            "{name}"
        );
        let drawn = found.found.iter().filter(|one| one.is_drawn).count();
        assert!(drawn == 1 && found.found[0].is_drawn, "{name}");
    }
}

/// A kite whose ends coincide turns as a whole: a curve of assemblies, of which one point is told; a cam is searched for, and said so.
#[test]
fn what_is_not_isolated_or_not_polynomial_is_said() {
    let kite = bundled("peaucellier");
    let found = all(&kite);
    assert!(
        found.notes[0].starts_with("special dimensions"),
        "{:?}",
        found.notes
    );
    let proven = found.found.iter().filter(|one| one.is_proven).count();
    assert_eq!((found.found.len(), proven), (6, 4));
    let cam = all(&bundled("cam-roller"));
    let said = "cams, racks, belts, rolling, gears within a loop and elastic links have no polynomials: the place of";
    assert!(cam.doubts[0].starts_with(said), "{:?}", cam.doubts);
    assert!(cam.found.iter().any(|one| one.is_drawn));
}

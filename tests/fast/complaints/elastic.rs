//! Elastic links that only a run can tell to be wrong: by the number of their amplitudes, and by their inertia.

use linkdyn_engine::analysis::{Control, run};

/// What a run says of a pendulum of 0.25 m by the rest of its body.
fn said(rest: &str) -> Vec<String> {
    let text = format!(
        r#"{{ "format": "linkdyn/1", "units": {{ "length": "mm" }}, "gravity": [0, -9810],
            "bodies": {{ "ground": {{ "points": {{ "O": [0, 0] }} }},
                         "rod": {{ "points": {{ "A": [0, 0], "B": [250, 0] }}, {rest} }} }},
            "joints": {{ "a": {{ "type": "revolute", "between": ["ground.O", "rod.A"] }} }},
            "analysis": {{ "type": "dynamics", "end": 0.001, "outputs": 2 }} }}"#
    );
    let loaded = linkdyn_model::load(text.as_bytes(), &[]);
    let loaded = loaded.unwrap_or_else(|said| panic!("{said}"));
    match run(&loaded.model, &Control::default()) {
        Ok(_) => Vec::new(),
        Err(complaints) => complaints.iter().map(ToString::to_string).collect(),
    }
}

fn bar(rest: &str) -> String {
    format!(
        r#""elastic": {{ "from": "A", "to": "B", "section": {{ "type": "circle", "diameter": 6 }}, "material": "steel"{rest} }}"#
    )
}

/// The half wave of a bar of 0.8 kg, with another mass matrix.
fn modal(inertia: f64, mass: f64) -> String {
    format!(
        r#""mass": 0.8, "inertia": {inertia:e}, "com": [125, 0], "elastic": {{ "from": "A", "to": "B", "modal": {{
            "mass": [[{mass:e}]], "stiffness": [[1e4]], "momentum": [[0, 0.5093]], "radial": [0], "angular_momentum": [0.06366] }} }}"#
    )
}

#[test]
fn runs_refuse_what_is_no_elastic_link() {
    let no_body = "bodies.rod.elastic: these numbers belong to no body: a deflection would have no kinetic energy, or a negative one (mass and \
                   inertia, \"mass\", \"momentum\", \"radial\", \"angular_momentum\" and \"gyroscopic\" are integrals over one body)";
    let cases: [(String, &[&str]); 9] = [
        (bar(""), &[]),
        (modal(0.8 * 0.0625 / 12.0, 0.4), &[]),
        (
            bar(r#", "amplitudes": [1, 0, 0]"#),
            &[
                "bodies.rod.elastic.amplitudes: a list of 2 is expected, this one has 3 (one for each amplitude: bending shapes first, slowest first, then axial ones)",
            ],
        ),
        (
            bar(r#", "modes": 3, "rates": ["1 m/s"]"#),
            &[
                "bodies.rod.elastic.rates: a list of 3 is expected, this one has 1 (one for each amplitude: bending shapes first, slowest first, then axial ones)",
            ],
        ),
        (
            bar(r#", "frame": "tangent", "axial": true, "amplitudes": [0, 0]"#),
            &[
                "bodies.rod.elastic.amplitudes: a list of 4 is expected, this one has 2 (one for each amplitude: bending shapes first, slowest first, then axial ones)",
            ],
        ),
        (modal(0.8 * 0.0625 / 12.0, -0.4), &[no_body]),
        (modal(0.8 * 0.0625 / 12.0, 0.0), &[no_body]),
        // The half wave has more momentum than this mass could.
        (modal(0.8 * 0.0625 / 12.0, 0.3), &[no_body]),
        (modal(0.0, 0.4), &[no_body]),
    ];
    let mut wrong = String::new();
    for (rest, wanted) in cases {
        let said = said(&rest);
        if said != wanted {
            wrong += &format!("{rest}:\n  said {said:#?}\n  want {wanted:#?}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

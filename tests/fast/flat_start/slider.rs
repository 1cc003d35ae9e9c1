//! Slider-cranks drawn in line.

use super::*;

#[test]
fn a_slider_crank_in_line_falls_and_hangs() {
    let (r, l) = (0.1, 0.3);
    for start in [0.0, PI] {
        let model = still(slider_crank(
            r,
            l,
            start,
            false,
            &json!({ "type": "polynomial", "coefficients": [start] }),
        ));
        let run = outcome(&model);
        assert_eq!(
            run.report.status,
            Status::Completed,
            "{:?}",
            run.report.message
        );
        close(column(&run, "crank.angle")[0].sin(), -1.0, 1e-14);
        assert_eq!(run.report.mobility.rank, 1);
        // The joints keep their rank there: only a slider that is driven has its dead centre.
        assert!(run.report.warnings.is_empty(), "{:?}", run.report.warnings);
        // J = r² (⅓ + 1 + 1), for rod and slider do not turn there.
        close(
            linearised(&model, false).modes[0].frequency(),
            (G / r / (7.0 / 3.0)).sqrt(),
            1e-11,
        );
    }
}

#[test]
fn a_slider_that_holds_its_crank_in_line_is_refused() {
    let model = slider_crank(
        0.1,
        0.3,
        0.0,
        true,
        &json!({ "type": "polynomial", "coefficients": [0.4] }),
    );
    for kind in ["statics", "modes"] {
        let said = if kind == "modes" {
            let found = linearised(&model, false);
            assert_eq!(found.status, Status::Singular);
            found.message.expect("a message")
        } else {
            let mut model = model.clone();
            model["analysis"] = json!({ "type": "statics" });
            refusal(&outcome(&model)).to_string()
        };
        assert!(said.contains("\"crank\" and \"rod\" are in line"), "{said}");
        assert!(said.contains("dead centre"), "{said}");
    }
    // The same of a crank that is held flat.
    let mut model = drawn(0.0, 0.0, false);
    model["drivers"] = json!({ "m": { "type": "rotation", "body": "c",
        "motion": { "type": "polynomial", "coefficients": [0.0] } } });
    let run = outcome(&model);
    assert!(
        refusal(&run).contains("\"k\" and \"r\" are in line"),
        "{:?}",
        run.report.message
    );
}

/// Crank and rod of one length: over the pivot the slider may stay, or go on.
#[test]
fn an_isosceles_slider_crank_leaves_its_pivot_where_it_is_pulled() {
    let r = 0.2;
    let mut model = still(slider_crank(
        r,
        r,
        FRAC_PI_2,
        false,
        &json!({ "type": "polynomial", "coefficients": [0.0] }),
    ));
    model["gravity"] = json!([-G, 0.0]);
    let run = outcome(&model);
    assert_eq!(
        run.report.status,
        Status::Completed,
        "{:?}",
        run.report.message
    );
    // Pulled to x = 2 r cos θ: V = (½ + 3/2 + 2) r g cos θ, against V = r g cos θ where the slider stays.
    close(column(&run, "slider.x")[0], -2.0 * r, 1e-12);
    // J = r² (⅓ + ¼ + 1/12), K = 4 r g.
    close(
        linearised(&model, false).modes[0].frequency(),
        (6.0 * G / r).sqrt(),
        1e-9,
    );
    assert!(
        run.report.warnings[0].starts_with(SINGULAR),
        "{:?}",
        run.report.warnings
    );
}

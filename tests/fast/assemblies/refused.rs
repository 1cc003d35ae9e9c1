//! What is asked for wrongly.

use super::*;
use linkdyn_engine::analysis::{CircuitsQuestion, all_circuits};

fn refused(model: &Value, question: &CircuitsQuestion) -> String {
    let said = all_circuits(&loaded(model).model, question, &Control::default());
    said.expect_err("refused").to_string()
}

#[test]
fn circuits_want_one_driver_that_moves() {
    let question = CircuitsQuestion {
        count: 4,
        most: 10,
        ..CircuitsQuestion::default()
    };
    assert_eq!(
        refused(&bundled("pendulum"), &question),
        "drivers: circuits are those of a driver, and there is none (add one of the freedom that moves)"
    );
    assert_eq!(
        refused(&bundled("excavator"), &question),
        "drivers: there are several drivers: lift, crowd, curl (say --driver NAME)"
    );
    let other = CircuitsQuestion {
        driver: Some("boom".into()),
        ..question.clone()
    };
    assert_eq!(
        refused(&bundled("excavator"), &other),
        "drivers: there is no driver \"boom\" (the drivers: lift, crowd, curl)"
    );
    let mut still = bundled("excavator");
    still["drivers"]["lift"]["motion"] = json!({ "type": "polynomial", "coefficients": ["1.5 m"] });
    let lift = CircuitsQuestion {
        driver: Some("lift".into()),
        ..question
    };
    assert_eq!(
        refused(&still, &lift),
        "drivers: the motion of driver \"lift\" stands still (say --range A:B)"
    );
}

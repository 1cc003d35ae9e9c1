//! Bad outlines.

use super::{disc, floor, join};
use linkdyn_engine::analysis::{self, Control};
use linkdyn_model::load;
use serde_json::{Value, json};

/// What is wrong with outlines, and what would be right.
#[test]
fn faulty_outlines_are_told() {
    let said = |more: Value| {
        let mut model = disc([0.0, 1.0], [0.0; 2], floor(), json!({}), 1.0);
        join(&mut model["joints"]["t"], more);
        let text = match load(model.to_string().as_bytes(), &[]) {
            Err(refused) => refused.to_string(),
            Ok(loaded) => match analysis::run(&loaded.model, &Control::default()) {
                Err(refused) => refused.to_string(),
                Ok(_) => "nothing".to_owned(),
            },
        };
        text[text.find("joints.t").unwrap_or(0)..].to_owned()
    };
    for (more, expected) in [
        (
            json!({ "outline": [[0.0, 0.0]] }),
            "joints.t.outline: a list of at least 2 is expected, this one has 1",
        ),
        (
            json!({ "outline": [[1.0, 0.0], [0.0]] }),
            "joints.t.outline[1]: a list of at least 2 is expected, this one has 1",
        ),
        (
            json!({ "outline": [[1.0, 0.0], [0.0, 0.0, 1.0, 2.0]] }),
            "joints.t.outline[1]: a point of an outline has two or three numbers, not 4 (write [x, y], or [x, y, r] where an arc of radius r leads to it)",
        ),
        (
            json!({ "outline": [[1.0, 0.0], [1.0, 0.0]] }),
            "joints.t.outline[1]: this is where point 0 of the outline is (leave out one of them)",
        ),
        (
            json!({ "outline": [[1.0, 0.0, 2.0], [0.0, 0.0]] }),
            "joints.t.outline[0][2]: 2.0: no arc leads to the first point of an outline (the radius stands at the point that the arc leads to)",
        ),
        (
            json!({ "outline": [[1.0, 0.0], [0.0, 0.0, 0.0]] }),
            "joints.t.outline[1][2]: 0.0: an arc has a radius (leave it out where a straight leads to the point)",
        ),
        (
            json!({ "outline": [[1.0, 0.0], [0.0, 0.0, 0.4]] }),
            "joints.t.outline[1][2]: 0.4: an arc of radius 0.4 m can't lead over 1 m from the point before (its diameter is no less than the distance; an arc is never more than half a turn)",
        ),
        (
            json!({ "outline": [[0.1, 0.0], [0.0, 0.0, -0.08]] }),
            "joints.t.outline[1][2]: -0.08: the tip of radius 0.1 m does not fit into this arc of radius 0.08 m (an arc that turns right is hollow: give it a larger radius than the tip)",
        ),
        (
            json!({ "radius": -1.0 }),
            "joints.t.radius: -1.0: must not be negative",
        ),
        (
            json!({ "arc": [1.0, 1.0] }),
            "joints.t.arc: both ends of the tip are one (leave it out where the tip is a full circle)",
        ),
        (
            json!({ "limits": [0.0, 1.0] }),
            "joints.t.limits: \"limits\": a contact ends where its outline does",
        ),
        (
            json!({ "damping": 3.0 }),
            "joints.t.damping: 3.0: \"stiffness\" is missing: what has damping yields (give the stiffness, or \"restitution\" instead of the damping)",
        ),
        (
            json!({ "stiffness": 3.0, "restitution": 0.2 }),
            "joints.t.restitution: 0.2: both yield, since there is a \"stiffness\": what they give back follows from stiffness and damping (leave out one of them)",
        ),
        (
            json!({ "outline": [[-5.0, 0.0], [5.0, 0.0]] }),
            "joints.t.outline: the mechanism starts with the tip 1 m deep in the outline (the material is on the left of the way along the outline: turn it round, or give another start)",
        ),
    ] {
        let text = said(more);
        assert_eq!(text, expected);
    }
}

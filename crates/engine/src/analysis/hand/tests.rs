use super::*;
use linkdyn_model::bundled;

fn hand(text: &str) -> Hand {
    let loaded = linkdyn_model::load(text.as_bytes(), &[]).expect("a legal model");
    Hand::new(&loaded.model).expect("it can be held")
}

/// A four-bar on pivots at 0 and d, bars as given, assembled with the crank at an angle, B above the line of the pivots.
fn four_bar([a, b, c, d]: [f64; 4], crank: f64) -> (Hand, [[f64; 3]; 3]) {
    let text = format!(
        r#"{{ "format": "linkdyn/1", "units": "SI", "bodies": {{ "ground": {{ "points": {{ "O": [0, 0], "D": [{d}, 0] }} }},
            "crank": {{ "points": {{ "O": [0, 0], "A": [{a}, 0] }} }}, "coupler": {{ "points": {{ "A": [0, 0], "B": [{b}, 0] }} }},
            "rocker": {{ "points": {{ "D": [0, 0], "B": [{c}, 0] }} }} }},
            "joints": {{ "o": {{ "type": "revolute", "between": ["ground.O", "crank.O"] }}, "a": {{ "type": "revolute", "between": ["crank.A", "coupler.A"] }},
            "b": {{ "type": "revolute", "between": ["coupler.B", "rocker.B"] }}, "d": {{ "type": "revolute", "between": ["ground.D", "rocker.D"] }} }} }}"#
    );
    let [ax, ay] = [a * crank.cos(), a * crank.sin()];
    let [bx, by] = closed([a, b, c, d], crank, 1.0).expect("it closes");
    let poses = [
        [0.0, 0.0, crank],
        [ax, ay, (by - ay).atan2(bx - ax)],
        [d, 0.0, by.atan2(bx - d)],
    ];
    let mut hand = hand(&text);
    hand.take(&poses).expect("it closes");
    (hand, poses)
}

/// Where B is by the two circles: `side` of the line from A to D.
fn closed([a, b, c, d]: [f64; 4], crank: f64, side: f64) -> Option<[f64; 2]> {
    let [ax, ay] = [a * crank.cos(), a * crank.sin()];
    let (ex, ey) = (d - ax, -ay);
    let far = ex.hypot(ey);
    let along = (b * b - c * c + far * far) / (2.0 * far);
    let square = b * b - along * along;
    let across = (square >= 0.0).then(|| square.sqrt())? * side;
    let (ux, uy) = (ex / far, ey / far);
    Some([ax + along * ux - across * uy, ay + along * uy + across * ux])
}

/// A number from 0 to 1.
fn random(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

#[test]
fn a_pendulum_points_at_its_target() {
    let mut hand = hand(
        r#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "ground": { "points": { "O": [1, 2] } }, "bar": { "points": { "O": [0, 0], "A": [3, 0] } } },
            "joints": { "o": { "type": "revolute", "between": ["ground.O", "bar.O"] } } }"#,
    );
    hand.take(&[[1.0, 2.0, 0.3]]).expect("it closes");
    for angle in [0.5_f64, 2.0, 3.0, -2.5, -0.1] {
        let target = [1.0 + 7.0 * angle.cos(), 2.0 + 7.0 * angle.sin()];
        let pulled = hand.pull(0, [3.0, 0.0], target);
        let [_, _, turned] = pulled.poses[0];
        assert!(((turned - angle).sin()).abs() < 1e-5, "{angle}: {pulled:?}");
        assert!((pulled.distance - 4.0).abs() < 1e-9 && pulled.singular.is_none());
    }
}

#[test]
fn a_four_bar_never_changes_its_assembly() {
    // By Grashof's rule the crank turns round, and the angle between coupler and rocker never becomes 0 or 180°.
    let bars = [0.1, 0.25, 0.2, 0.3];
    let (mut hand, _) = four_bar(bars, 1.0);
    let mut state = 7;
    let mut turned = 0.0_f64;
    for _ in 0..2_000 {
        let target = [
            random(&mut state) * 1.2 - 0.4,
            random(&mut state) * 1.2 - 0.6,
        ];
        let pulled = hand.pull(1, [0.25, 0.0], target);
        let angle = pulled.poses[0][2];
        let [bx, by] = closed(bars, angle, 1.0).expect("it closes everywhere");
        let [cx, cy, coupler] = pulled.poses[1];
        let off = (cx + 0.25 * coupler.cos() - bx).hypot(cy + 0.25 * coupler.sin() - by);
        assert!(off < 1e-9, "at {angle}: {off}");
        turned = turned.max(angle.abs());
    }
    assert!(turned > 6.3, "it goes round: {turned}");
}

#[test]
fn branches_that_come_near_are_not_changed() {
    // Less than a parallelogram by a hundredth to a thousandth: where the bars lie in line, the two ways to close it nearly meet.
    for less in [1e-3, 3e-4, 1e-4] {
        let bars = [0.1 - less, 0.3, 0.1, 0.3];
        let (mut hand, _) = four_bar(bars, 1.0);
        let mut state = 3;
        let mut turned = 1.0_f64;
        for _ in 0..400 {
            let target = [
                random(&mut state) * 0.6 - 0.3,
                random(&mut state) * 0.6 - 0.3,
            ];
            let pulled = hand.pull(0, [bars[0], 0.0], target);
            let [bx, by] = closed(bars, pulled.poses[0][2], 1.0).expect("it closes everywhere");
            let [cx, cy, coupler] = pulled.poses[1];
            let off = (cx + 0.3 * coupler.cos() - bx).hypot(cy + 0.3 * coupler.sin() - by);
            assert!(off < 1e-6 || pulled.singular.is_some(), "{less}: {off}");
            turned = turned.max(pulled.poses[0][2].abs());
        }
        assert!(turned > 3.2, "it goes through the line: {turned}");
    }
}

#[test]
fn a_change_point_is_crossed_with_a_word() {
    let bars = [0.1, 0.3, 0.1, 0.3];
    let (mut hand, _) = four_bar(bars, 0.5);
    let pulled = hand.pull(0, [0.1, 0.0], [0.08, -0.06]);
    assert!((pulled.poses[0][2].sin() + 0.6).abs() < 1e-3, "{pulled:?}");
    let said = pulled.singular.clone().unwrap_or_default();
    assert!(said.contains("in line"), "{pulled:?}");
    // Straight through: the coupler stays level.
    assert!(pulled.poses[1][2].abs() < 1e-6, "{pulled:?}");
}

#[test]
fn a_reachable_point_is_reached_by_a_five_bar() {
    let mut hand = hand(
        r#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "ground": { "points": { "O": [0, 0], "D": [1, 0] } },
            "a": { "points": { "O": [0, 0], "A": [0, 1] } }, "b": { "points": { "A": [0, 1], "P": [0.5, 2] } },
            "c": { "points": { "P": [0.5, 2], "C": [1, 1] } }, "d": { "points": { "C": [1, 1], "D": [1, 0] } } },
            "joints": { "o": { "type": "revolute", "between": ["ground.O", "a.O"] }, "p": { "type": "revolute", "between": ["a.A", "b.A"] },
            "q": { "type": "revolute", "between": ["b.P", "c.P"] }, "r": { "type": "revolute", "between": ["c.C", "d.C"] },
            "s": { "type": "revolute", "between": ["d.D", "ground.D"] } } }"#,
    );
    hand.take(&[[0.0; 3]; 4]).expect("it closes");
    for target in [[0.3, 1.7], [0.9, 1.9], [0.5, 1.2], [0.2, 1.5]] {
        let pulled = hand.pull(1, [0.5, 2.0], target);
        assert!(pulled.distance < 1e-11, "{target:?}: {pulled:?}");
    }
}

#[test]
fn a_slider_crank_stops_where_it_is_stretched_and_says_so() {
    let mut hand = hand(
        r#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "ground": { "points": { "O": [0, 0] } }, "crank": { "points": { "O": [0, 0], "A": [1, 0] } },
            "rod": { "points": { "A": [0, 0], "B": [3, 0] } }, "piston": { "points": { "B": [0, 0] } } },
            "joints": { "o": { "type": "revolute", "between": ["ground.O", "crank.O"] }, "a": { "type": "revolute", "between": ["crank.A", "rod.A"] },
            "b": { "type": "revolute", "between": ["rod.B", "piston.B"] }, "g": { "type": "prismatic", "between": ["ground.O", "piston.B"], "axis": [1, 0] } } }"#,
    );
    let crank = 1.2_f64;
    let rod = -(crank.sin() / 3.0).asin();
    let end = crank.cos() + 3.0 * rod.cos();
    hand.take(&[
        [0.0, 0.0, crank],
        [crank.cos(), crank.sin(), rod],
        [end, 0.0, 0.0],
    ])
    .expect("it closes");
    let pulled = hand.pull(2, [0.0, 0.0], [9.0, 0.0]);
    assert!((pulled.poses[2][0] - 4.0).abs() < 1e-4, "{pulled:?}");
    let said = pulled.singular.clone().unwrap_or_default();
    assert!(said.contains("in line"), "{pulled:?}");
    // Back it goes on the side from which it came.
    let pulled = hand.pull(2, [0.0, 0.0], [3.0, 0.0]);
    assert!(
        pulled.distance < 1e-9 && pulled.poses[0][2].sin().abs() > 0.1,
        "{pulled:?}"
    );
}

#[test]
fn a_stop_is_met_and_named() {
    let mut hand = hand(
        r#"{ "format": "linkdyn/1", "units": { "angle": "deg" }, "bodies": { "ground": { "points": { "O": [0, 0] } }, "bar": { "points": { "O": [0, 0], "A": [1, 0] } } },
            "joints": { "hinge": { "type": "revolute", "between": ["ground.O", "bar.O"], "limits": [-30, 60] } } }"#,
    );
    hand.take(&[[0.0; 3]]).expect("it closes");
    let pulled = hand.pull(0, [1.0, 0.0], [-1.0, 1.0]);
    let degrees = pulled.poses[0][2].to_degrees();
    assert!((degrees - 60.0).abs() < 1e-3, "{degrees}");
    assert!(pulled.stopped.is_some_and(|what| what.contains("hinge")));
}

#[test]
fn bundled_mechanisms_stay_together() {
    for name in bundled::names() {
        let text = bundled::text(name).expect("it is bundled");
        let mut hand = hand(&text);
        let start: Vec<[f64; 3]> = hand.poses();
        if hand.take(&start).is_err() {
            continue;
        }
        let (bodies, size) = (hand.system.bodies.len(), hand.system.size);
        let mut state = 3;
        for _ in 0..12 {
            let body = (random(&mut state) * bodies as f64) as usize;
            let [x, y, _] = hand.poses()[body];
            let target = [x, y].map(|own| own + size * (random(&mut state) - 0.5));
            let pulled = hand.pull(body, [0.0, 0.0], target);
            assert!(
                pulled.poses.iter().flatten().all(|own| own.is_finite()),
                "{name}"
            );
            let mut evaluation = Evaluation::new(&hand.system);
            evaluation.set_position(&hand.q);
            evaluation.eval_phi(&hand.system, &hand.inputs);
            let rows = hand.system.joint_rows();
            let off = evaluation.phi[..rows]
                .iter()
                .fold(0.0, |most: f64, own| most.max(own.abs()));
            assert!(off < 1e-10 * size.max(1.0), "{name}: {off}");
        }
    }
}

#[test]
fn what_continues_a_position_is_on_its_branch() {
    let bars = [0.1, 0.25, 0.2, 0.3];
    for side in [1.0, -1.0] {
        let (mut hand, _) = four_bar(bars, 1.0);
        let [bx, by] = closed(bars, 1.05, side).expect("it closes");
        let (ax, ay) = (0.1 * 1.05_f64.cos(), 0.1 * 1.05_f64.sin());
        let near = [
            [0.002, 0.0, 1.05],
            [ax, ay + 0.001, (by - ay).atan2(bx - ax) + 0.01],
            [0.3, 0.0, by.atan2(bx - 0.3) - 0.01],
        ];
        let poses = hand.beside(&near, 0.0).expect("it closes");
        let [x, y, angle] = poses[1];
        let [bx, by] = closed(bars, poses[0][2], side).expect("it closes");
        let off = (x + 0.25 * angle.cos() - bx).hypot(y + 0.25 * angle.sin() - by);
        assert!(off < 1e-9, "{side}: {off}");
    }
}

use super::*;

/// Ground 0, crank 1, coupler 2, rocker 3.
fn four_bar() -> Topology {
    Topology::new(4, &[(0, 1, 2), (1, 2, 2), (2, 3, 2), (0, 3, 2)])
}

#[test]
fn four_bar_has_one_loop_and_mobility_one() {
    let topology = four_bar();
    assert_eq!(topology.mobility(), 1);
    assert_eq!(topology.islands().len(), 1);
    assert_eq!(
        topology.loop_names(&["a", "b", "c", "d"]),
        ["a – b – c – d"]
    );
    assert_eq!(topology.loops()[0].bodies, [0, 1, 2, 3]);
    assert_eq!(topology.loops()[0].chord, 2);
    assert_eq!(topology.joints_by_distance(), [0, 3, 1, 2]);
    assert_eq!(topology.distance(2), Some(2));
    assert_eq!(topology.parent(2), Some((1, 1)));
}

#[test]
fn watt_six_bar_has_two_loops_and_mobility_one() {
    // Bodies 0 … 5 stand for the links 1 … 6: a 1–2, b 2–3, c 3–4, g 1–4, d 4–5, e 5–6, f 3–6.
    let joints = [
        (0, 1, 2),
        (1, 2, 2),
        (2, 3, 2),
        (3, 4, 2),
        (4, 5, 2),
        (2, 5, 2),
        (0, 3, 2),
    ];
    let topology = Topology::new(6, &joints);
    assert_eq!(topology.mobility(), 1);
    let names = topology.loop_names(&["a", "b", "c", "d", "e", "f", "g"]);
    assert_eq!(names, ["a – b – c – g", "c – f – e – d"]);
    assert_eq!(topology.loops()[1].bodies, [3, 2, 5, 4]);
}

#[test]
fn two_joints_between_the_same_bodies_form_a_loop() {
    let topology = Topology::new(2, &[(0, 1, 2), (1, 0, 2)]);
    assert_eq!(topology.mobility(), -1);
    assert_eq!(
        topology.loops(),
        [Loop {
            joints: vec![0, 1],
            bodies: vec![0, 1],
            chord: 1
        }]
    );
}

#[test]
fn three_joints_between_the_same_bodies_form_two_loops() {
    let topology = Topology::new(3, &[(0, 1, 2), (1, 2, 1), (1, 2, 1), (2, 1, 1)]);
    assert_eq!(
        topology.loop_names(&["p", "q", "r", "s"]),
        ["q – r", "q – s"]
    );
}

#[test]
fn a_joint_of_a_body_with_itself_is_a_loop_of_one() {
    let topology = Topology::new(2, &[(0, 1, 2), (1, 1, 2)]);
    assert_eq!(
        topology.loops(),
        [Loop {
            joints: vec![1],
            bodies: vec![1],
            chord: 1
        }]
    );
}

#[test]
fn a_body_without_joint_is_an_island() {
    let topology = Topology::new(3, &[(0, 1, 2)]);
    assert_eq!(topology.mobility(), 4);
    assert_eq!(topology.unheld_bodies(), [2]);
    assert_eq!(
        topology.islands()[1],
        Island {
            bodies: vec![2],
            joints: vec![],
            grounded: false
        }
    );
    assert_eq!(topology.distance(2), None);
}

#[test]
fn two_islands_have_their_own_trees_and_loops() {
    let joints = [(2, 3, 2), (0, 1, 2), (3, 4, 2), (4, 2, 2)];
    let topology = Topology::new(5, &joints);
    assert_eq!(topology.mobility(), 4);
    assert_eq!(topology.islands().len(), 2);
    assert_eq!(topology.islands()[0].joints, [1]);
    assert_eq!(
        topology.islands()[1],
        Island {
            bodies: vec![2, 3, 4],
            joints: vec![0, 2, 3],
            grounded: false
        }
    );
    assert_eq!(topology.loops().len(), 1);
    assert_eq!(topology.loops()[0].joints, [0, 2, 3]);
    assert_eq!(topology.joints_by_distance(), [1, 0, 2, 3]);
    assert!(topology.unheld_bodies().is_empty());
}

#[test]
fn ground_alone_is_a_topology() {
    let topology = Topology::new(1, &[]);
    assert_eq!(
        (
            topology.mobility(),
            topology.loops().len(),
            topology.islands().len()
        ),
        (0, 0, 1)
    );
}

#[test]
fn loops_number_joints_minus_bodies_plus_islands() {
    // A grid of parallel and crossing joints from a small fixed congruential sequence.
    let mut seed = 12345_u64;
    let mut next = |bound: usize| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % bound
    };
    for _ in 0..200 {
        let bodies = 1 + next(12);
        let joints: Vec<_> = (0..next(25))
            .map(|_| (next(bodies), next(bodies), 2))
            .collect();
        let topology = Topology::new(bodies, &joints);
        assert_eq!(
            topology.loops().len(),
            joints.len() + topology.islands().len() - bodies,
            "{joints:?}"
        );
        for one in topology.loops() {
            // Every walk is closed.
            for (i, &joint) in one.joints.iter().enumerate() {
                let (here, there) = (one.bodies[i], one.bodies[(i + 1) % one.bodies.len()]);
                let (first, second) = (joints[joint].0, joints[joint].1);
                assert!(
                    [(here, there), (there, here)].contains(&(first, second)),
                    "{one:?} of {joints:?}"
                );
            }
        }
    }
}

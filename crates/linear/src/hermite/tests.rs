use super::*;

fn node(s: f64) -> Node {
    Node {
        s,
        q: vec![s.sin(), (2.0 * s).exp()],
        d: vec![s.cos(), 2.0 * (2.0 * s).exp()],
        dd: vec![-s.sin(), 4.0 * (2.0 * s).exp()],
    }
}

#[test]
fn quintic_is_of_sixth_order() {
    let error = |h: f64| {
        let (mut q, mut d) = ([0.0; 2], [0.0; 2]);
        quintic(
            &node(0.3),
            &node(0.3 + h),
            0.3 + 2.0 * h,
            &mut q,
            Some(&mut d),
        );
        let want = node(0.3 + 2.0 * h);
        ((q[0] - want.q[0]).abs(), (d[0] - want.d[0]).abs())
    };
    let (coarse, fine) = (error(0.2), error(0.1));
    let order = (coarse.0 / fine.0).log2();
    assert!((order - 6.0).abs() < 0.4, "{order}");
    let order = (coarse.1 / fine.1).log2();
    assert!((order - 5.0).abs() < 0.4, "{order}");
}

#[test]
fn osculating_polynomial_meets_a_smooth_function() {
    let nodes: Vec<Node> = [-0.3, -0.2, -0.1, 0.1, 0.2, 0.3].map(node).to_vec();
    let p = Osculating::new(&nodes, 0.0);
    let (mut q, mut d, mut dd) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    for s in [0.0, 0.05, -0.25] {
        p.eval(s, &mut q, &mut d, &mut dd);
        let want = node(s);
        for k in 0..2 {
            assert!((q[k] - want.q[k]).abs() < 1e-14, "{s}: {q:?} {want:?}");
            assert!(
                (d[k] - want.d[k]).abs() < 1e-12 && (dd[k] - want.dd[k]).abs() < 1e-10,
                "{s}: {dd:?} {want:?}"
            );
        }
    }
}

/// A polynomial of the degree that K nodes bear, at `s` through nodes at `at`: what it misses by no more than round-off of its
/// sums, of which a weight and its value are known to some units each.
fn repeats<const K: usize>(at: [f64; K], s: f64, power: i32) {
    let slope = f64::from(power);
    let jet = |s: f64| {
        [
            1.0 + s.powi(power),
            slope * s.powi(power - 1),
            slope * (slope - 1.0) * s.powi(power - 2),
        ]
    };
    let nodes = at.map(|s| {
        let [q, d, dd] = jet(s).map(|value| vec![value]);
        Node { s, q, d, dd }
    });
    let (mut q, mut d, mut dd) = ([0.0], [0.0], [0.0]);
    osculate(nodes.each_ref(), s, [&mut q, &mut d, &mut dd]);
    let weights = weights(&at, s);
    for (order, (got, want)) in [q[0], d[0], dd[0]].into_iter().zip(jet(s)).enumerate() {
        let terms = nodes.iter().enumerate().map(|(j, node)| {
            let values = [node.q[0] - jet(s)[0], node.d[0], node.dd[0]];
            let terms = values.iter().zip(&weights);
            terms
                .map(|(value, weights)| (value * weights[order][j]).abs())
                .sum::<f64>()
        });
        let room = 4.0 * f64::EPSILON * (want.abs() + terms.sum::<f64>());
        assert!(
            (got - want).abs() < room,
            "{power} {order}: {got} {want} {room}"
        );
        assert!(room < 1e-9 * want, "{power} {order}: {room}");
    }
}

#[test]
fn osculating_polynomials_repeat_polynomials_of_their_degree() {
    for power in [2, 5, 8] {
        repeats([0.7, 1.0, 1.2], 1.5, power);
    }
    for power in [2, 7, 11] {
        repeats([0.7, 0.9, 1.2, 1.3], 1.05, power);
    }
}

#[test]
fn components_are_alike_however_many_there_are() {
    let many = 3 * MANY + 1;
    let nodes = [-0.3, -0.1, 0.2, 0.3].map(|s: f64| Node {
        s,
        q: (0..many).map(|k| (s + k as f64).sin()).collect(),
        d: (0..many).map(|k| (s + k as f64).cos()).collect(),
        dd: (0..many).map(|k| -(s + k as f64).sin()).collect(),
    });
    let [mut q, mut d, mut dd] = std::array::from_fn(|_| vec![0.0; many]);
    osculate(nodes.each_ref(), 0.05, [&mut q, &mut d, &mut dd]);
    for first in [0, 1, many - 3, many - 1] {
        let few = nodes.each_ref().map(|node| Node {
            s: node.s,
            q: node.q[first..].to_vec(),
            d: node.d[first..].to_vec(),
            dd: node.dd[first..].to_vec(),
        });
        let [mut own, mut own_d, mut own_dd] = std::array::from_fn(|_| vec![0.0; many - first]);
        osculate(few.each_ref(), 0.05, [&mut own, &mut own_d, &mut own_dd]);
        assert_eq!(own, q[first..]);
        assert_eq!((own_d, own_dd), (d[first..].to_vec(), dd[first..].to_vec()));
    }
}

#[test]
fn coordinates_abreast_are_those_one_by_one() {
    let nodes = [0.1, 0.4, 0.6, 1.1, 1.3, 1.6].map(|s: f64| {
        let place = |k: usize| s + 0.3 * k as f64;
        let many = |of: fn(f64) -> f64| (0..11).map(|k| of(place(k))).collect();
        let (q, d, dd) = (many(f64::sin), many(f64::cos), many(|x| -x.sin()));
        Node { s, q, d, dd }
    });
    let nodes: [&Node; 6] = std::array::from_fn(|k| &nodes[k]);
    let made = |of: &dyn Fn([&mut [f64]; 3])| {
        let [mut q, mut d, mut dd] = [[0.0; 11]; 3];
        of([&mut q, &mut d, &mut dd]);
        [q, d, dd].map(|values| values.map(f64::to_bits))
    };
    let own = (nodes.map(|node| node.s), [0.0; 6]);
    let abreast = made(&|to| assert_eq!(osculate_abreast(nodes, own, 0.9, to), [0.0; 3]));
    assert_eq!(abreast, made(&|to| osculate(nodes, 0.9, to)));
}

/// A wheel that turns three times while the parameter turns once, and what goes to and fro.
#[test]
fn nodes_stand_for_those_of_other_turns() {
    let turn = std::f64::consts::TAU;
    let nodes: [Node; 6] = std::array::from_fn(|k| {
        let s = turn / 6.0 * k as f64;
        Node {
            s,
            q: vec![3.0 * s + s.sin(), s.cos()],
            d: vec![3.0 + s.cos(), -s.sin()],
            dd: vec![-s.sin(), -s.cos()],
        }
    });
    for (first, s) in [(0, 2.6), (2, 5.0), (3, 6.1), (-3, -0.2), (-9, -6.4)] {
        let around: [i32; 6] = std::array::from_fn(|j| first + j as i32);
        let turns = around.map(|k| f64::from(k.div_euclid(6)));
        let around = around.map(|k| &nodes[k.rem_euclid(6) as usize]);
        let at = std::array::from_fn(|j| around[j].s + turn * turns[j]);
        let [mut q, mut d, mut dd] = [[0.0; 2]; 3];
        let grown = osculate_abreast(around, (at, turns), s, [&mut q, &mut d, &mut dd]);
        let shift = 3.0 * turn;
        let got = [
            q[0] + shift * grown[0],
            d[0] + shift * grown[1],
            dd[0] + shift * grown[2],
        ];
        let want = [3.0 * s + s.sin(), 3.0 + s.cos(), -s.sin()];
        for (got, want) in got.iter().zip(want) {
            assert!((got - want).abs() < 1e-12, "{s}: {got} {want}");
        }
        for (got, want) in [q[1], d[1], dd[1]]
            .iter()
            .zip([s.cos(), -s.sin(), -s.cos()])
        {
            assert!((got - want).abs() < 1e-12, "{s}: {got} {want}");
        }
    }
}

#[test]
fn neville_repeats_a_polynomial() {
    let f = |x: f64| 1.0 - 2.0 * x + x.powi(3);
    let x = [-1.0, 0.5, 1.0, 2.0];
    assert!((interpolate(&x, &x.map(f), 0.3) - f(0.3)).abs() < 1e-14);
}

#[test]
fn weights_meet_what_each_node_says() {
    // x⁵ − 2x³ + x, of which nodes say one, two or three data
    let jet = |x: f64| {
        let value = x.powi(5) - 2.0 * x.powi(3) + x;
        [
            value,
            5.0 * x.powi(4) - 6.0 * x * x + 1.0,
            20.0 * x.powi(3) - 12.0 * x,
        ]
    };
    for nodes in [
        &[(0.3, 3), (0.7, 3)][..],
        &[(-0.2, 3), (0.1, 1), (0.5, 2)],
        &[(0.0, 1), (0.2, 1), (0.5, 1), (0.9, 1), (1.1, 1), (1.2, 1)],
        &[(0.4, 2), (1.0, 3), (1.3, 1), (1.5, 1)],
    ] {
        for s in [-0.5, 0.35, 2.0] {
            let data = nodes
                .iter()
                .flat_map(|(at, count)| jet(*at)[..*count].to_vec());
            let weights = value_weights(nodes, s);
            let found: f64 = weights
                .iter()
                .zip(data)
                .map(|(weight, own)| weight * own)
                .sum();
            let largest = weights
                .iter()
                .fold(1.0, |most: f64, own| most.max(own.abs()));
            assert!((found - jet(s)[0]).abs() < 1e-14 * largest, "{nodes:?} {s}");
        }
    }
}

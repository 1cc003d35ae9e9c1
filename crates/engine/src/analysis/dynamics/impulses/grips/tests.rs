use super::*;

/// Numbers from −1 to 1, the same ones by seed.
fn numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (seed >> 33) as f64 / f64::from(1_u32 << 31) * 2.0 - 1.0
    }
}

fn solve(
    mass: &DMatrix<f64>,
    along: &[Along],
    free: [&[f64]; 2],
) -> Option<(Vec<ContactMode>, Vec<[f64; 2]>)> {
    Grips {
        along,
        free,
        mass: mass.clone(),
        held: None,
    }
    .solve()
}

/// A block of 2 kg on a slope: N = m g cos α, and T = −m g sin α while tan α ≤ μ; else −μ N.
#[test]
fn a_block_on_a_slope_by_hand() {
    let mass = DMatrix::identity(2, 2) * 0.5;
    let friction = 0.4;
    for (slope, sticks) in [(0.0, true), (0.3995, true), (0.4005, false), (-0.5, false)] {
        let angle = f64::atan(slope);
        let (press, pull) = (9.81 * angle.cos(), 9.81 * angle.sin());
        let found = solve(&mass, &[Along::Rests(friction)], [&[press], &[pull]]);
        let (modes, forces) = found.expect("there is a solution");
        let holds = if sticks {
            -2.0 * pull
        } else {
            -friction * 2.0 * press * pull.signum()
        };
        assert_eq!(
            modes[0] == ContactMode::Sticks,
            sticks,
            "{slope}: {modes:?}"
        );
        assert!((forces[0][0] - 2.0 * press).abs() < 1e-12, "{forces:?}");
        assert!((forces[0][1] - holds).abs() < 1e-12, "{forces:?}");
    }
    // What is pulled off leaves, whatever pulls along the slope; and what leaves anyway is left alone.
    for press in [-1.0, f64::NEG_INFINITY] {
        let found = solve(&mass, &[Along::Rests(friction)], [&[press], &[5.0]]);
        assert_eq!(found, Some((vec![ContactMode::Leaves], vec![[0.0; 2]])));
    }
}

/// A rod that slides with its tip ahead: the steeper friction turns it into the ground, W_nn + ρ W_nt < 0, and no forces answer that.
#[test]
fn painleves_rod_has_no_answer() {
    let mass = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]);
    let answer = |ratio: f64| solve(&mass, &[Along::Slides(ratio)], [&[3.0], &[0.0]]);
    assert_eq!(answer(-0.6), None);
    let (modes, forces) = answer(-0.25).expect("a smaller coefficient has one");
    assert_eq!(
        (modes, forces),
        (vec![ContactMode::Slips(-0.25)], vec![[6.0, -1.5]])
    );
    // At rest it sticks: det W/W_tt = 0.2.
    let rests = solve(&mass, &[Along::Rests(0.6)], [&[3.0], &[0.0]]);
    let (modes, forces) = rests.expect("there is a solution");
    assert_eq!(modes, [ContactMode::Sticks]);
    assert!(
        (forces[0][0] - 15.0).abs() < 1e-9 && (forces[0][1] + 6.0).abs() < 1e-9,
        "{forces:?}"
    );
}

/// Two contacts, at rest or sliding, of many inverse masses A Aᵀ: what is found satisfies Coulomb's law, and at rest there always is
/// a solution (D. E. Stewart, J. C. Trinkle 1996).
#[test]
fn what_is_found_is_coulombs_law() {
    let mut random = numbers(7);
    let mut sticking = 0;
    for round in 0..4000 {
        let root = DMatrix::from_fn(4, 4, |_, _| random());
        let mass = &root * root.transpose() + DMatrix::identity(4, 4) * 0.01;
        let friction = [0.1, 0.5, 2.0][round % 3];
        let rests = round % 2 == 0;
        let along = [
            Along::Rests(friction),
            if rests {
                Along::Rests(friction)
            } else {
                Along::Slides(friction)
            },
        ];
        let (presses, pulls) = ([random(), random()], [random(), random()]);
        let Some((modes, forces)) = solve(&mass, &along, [&presses, &pulls]) else {
            assert!(!rests, "round {round}: no solution at rest");
            continue;
        };
        let pushes = DVector::from_iterator(4, forces.iter().flatten().copied());
        let changed = &mass * &pushes;
        let size = 1e-9 * (1.0 + pushes.amax());
        for k in 0..2 {
            let [normal, tangential] = forces[k];
            let off = changed[2 * k] - presses[k];
            let rate = pulls[k] + changed[2 * k + 1];
            assert!(normal >= 0.0 && off >= -size && normal * off.abs() < size * (1.0 + normal));
            assert!(
                tangential.abs() <= friction * normal + size,
                "{modes:?} {forces:?}"
            );
            match (modes[k], along[k]) {
                (ContactMode::Leaves, _) => assert_eq!(forces[k], [0.0; 2]),
                (ContactMode::Sticks, _) => {
                    sticking += 1;
                    assert!(rate.abs() < size, "{rate}");
                }
                (ContactMode::Slips(_), Along::Slides(ratio)) => {
                    assert_eq!(tangential, ratio * normal)
                }
                (ContactMode::Slips(ratio), Along::Rests(_)) => {
                    assert_eq!((ratio.abs(), tangential), (friction, ratio * normal));
                    assert!(rate * ratio <= size, "{rate} {ratio}");
                }
            }
        }
    }
    assert!(sticking > 500, "{sticking}");
}

/// What sticks, and what begins to slide while round-off moves it the other way, is stopped; what slides its way already goes on.
#[test]
fn what_begins_to_slide_does_not_slide_back() {
    let mass = DMatrix::from_row_slice(2, 2, &[1.0, 0.2, 0.2, 0.5]);
    let (friction, creep) = (0.4, 1e-9);
    for (way, sliding, stops) in [
        (1.0, -creep, true),
        (1.0, creep, false),
        (-1.0, creep, true),
    ] {
        let grips = Grips {
            along: &[Along::Rests(friction)],
            free: [&[0.0], &[sliding]],
            mass: mass.clone(),
            held: None,
        };
        let pushes = grips
            .resting(&[ContactMode::Slips(-friction * way)])
            .expect("pushes");
        let pushed = DVector::from_row_slice(&pushes[0]);
        let changed = &mass * pushed;
        assert!(changed[0].abs() < 1e-24, "{changed}");
        let left = sliding + changed[1];
        assert!(
            if stops {
                left.abs() < 1e-24
            } else {
                left == sliding
            },
            "{left:e}"
        );
    }
}

/// The tree finds what trying all choices one by one finds, and nothing else, of contacts that jam or don't.
#[test]
fn the_tree_finds_the_first_of_all_choices() {
    let mut random = numbers(11);
    let (mut none, mut later) = (0, 0);
    for round in 0..400 {
        // Now and then what two contacts hold is the same, so that pivots vanish.
        let root = DMatrix::from_fn(6, 6, |row, _| match row {
            2 if round % 5 == 0 => 0.25,
            _ => random(),
        });
        let mut mass = &root * root.transpose();
        if round % 5 != 0 {
            mass += DMatrix::identity(6, 6) * 0.01;
        }
        let friction = [0.3, 0.8, 2.0][round % 3];
        let along: Vec<Along> = (0..3)
            .map(|k| match (round + k) % 4 {
                0 => Along::Rests(friction),
                1 => Along::Slides(friction),
                _ => Along::Slides(-friction),
            })
            .collect();
        let presses: Vec<f64> = (0..3).map(|_| random()).collect();
        let pulls: Vec<f64> = (0..3).map(|_| random()).collect();
        let grips = Grips {
            along: &along,
            free: [&presses, &pulls],
            mass,
            held: (round % 7 == 0).then_some(1),
        };
        let choices: Vec<Vec<ContactMode>> = (0..3).map(|k| grips.choices(k)).collect();
        let (mut first, mut place) = (None, 0);
        'all: for &third in &choices[2] {
            for &second in &choices[1] {
                for &one in &choices[0] {
                    let modes = vec![one, second, third];
                    if let Attempt::Solved(forces) = grips.attempt(&modes) {
                        first = Some((modes, forces));
                        break 'all;
                    }
                    place += 1;
                }
            }
        }
        none += usize::from(first.is_none());
        later += usize::from(first.is_some() && place > 3);
        assert_eq!(grips.search(), first, "round {round}");
    }
    assert!(none > 10 && later > 50, "{none} {later}");
}

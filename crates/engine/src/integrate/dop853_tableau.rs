//! Coefficients of DOP853: the explicit Runge–Kutta method of order 8 by Dormand and Prince with Hairer's embedded
//! estimates of orders 5 and 3 and continuous extension of order 7.
//!
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer 1993,
//! §II.5 (method), §II.6 (continuous extension) and §II.10 (estimates), rounded to the nearest doubles.
//! All are numbers without unit. Only entries other than zero are listed, as (stage counted from 0, coefficient);
//! their order conditions are tested below.

/// Entries of one row that are not zero: stage, coefficient.
pub(super) type Row<const N: usize> = [(usize, f64); N];

/// Stages of a step, without the evaluation at its end.
pub(super) const STAGES: usize = 12;
/// The slope at the end of a step (first stage of the next one).
pub(super) const LAST: usize = 12;
/// Slopes kept for one step: its stages, its end and three for the continuous extension.
pub(super) const SLOPES: usize = 16;

/// Abscissae c of all slopes, in steps.
pub(super) const C: [f64; 16] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    0.3333333333333333,
    0.25,
    0.3076923076923077,
    0.6512820512820513,
    0.6,
    0.8571428571428571,
    1.0,
    1.0,
    0.1,
    0.2,
    0.7777777777777778,
];

/// Argument of stage 1.
pub(super) const A1: Row<1> = [(0, 0.05260015195876773)];
/// Argument of stage 2.
pub(super) const A2: Row<2> = [(0, 0.0197250569845379), (1, 0.0591751709536137)];
/// Argument of stage 3.
pub(super) const A3: Row<2> = [(0, 0.02958758547680685), (2, 0.08876275643042054)];
/// Argument of stage 4.
pub(super) const A4: Row<3> = [
    (0, 0.2413651341592667),
    (2, -0.8845494793282861),
    (3, 0.924834003261792),
];
/// Argument of stage 5.
pub(super) const A5: Row<3> = [
    (0, 0.037037037037037035),
    (3, 0.17082860872947386),
    (4, 0.12546768756682242),
];
/// Argument of stage 6.
pub(super) const A6: Row<4> = [
    (0, 0.037109375),
    (3, 0.17025221101954405),
    (4, 0.06021653898045596),
    (5, -0.017578125),
];
/// Argument of stage 7.
pub(super) const A7: Row<5> = [
    (0, 0.03709200011850479),
    (3, 0.17038392571223998),
    (4, 0.10726203044637328),
    (5, -0.015319437748624402),
    (6, 0.008273789163814023),
];
/// Argument of stage 8.
pub(super) const A8: Row<6> = [
    (0, 0.6241109587160757),
    (3, -3.3608926294469414),
    (4, -0.868219346841726),
    (5, 27.59209969944671),
    (6, 20.154067550477894),
    (7, -43.48988418106996),
];
/// Argument of stage 9.
pub(super) const A9: Row<7> = [
    (0, 0.47766253643826434),
    (3, -2.4881146199716677),
    (4, -0.590290826836843),
    (5, 21.230051448181193),
    (6, 15.279233632882423),
    (7, -33.28821096898486),
    (8, -0.020331201708508627),
];
/// Argument of stage 10.
pub(super) const A10: Row<8> = [
    (0, -0.9371424300859873),
    (3, 5.186372428844064),
    (4, 1.0914373489967295),
    (5, -8.149787010746927),
    (6, -18.52006565999696),
    (7, 22.739487099350505),
    (8, 2.4936055526796523),
    (9, -3.0467644718982196),
];
/// Argument of stage 11.
pub(super) const A11: Row<9> = [
    (0, 2.273310147516538),
    (3, -10.53449546673725),
    (4, -2.0008720582248625),
    (5, -17.9589318631188),
    (6, 27.94888452941996),
    (7, -2.8589982771350235),
    (8, -8.87285693353063),
    (9, 12.360567175794303),
    (10, 0.6433927460157636),
];
/// Weights of order 8.
pub(super) const B: Row<8> = [
    (0, 0.054293734116568765),
    (5, 4.450312892752409),
    (6, 1.8915178993145003),
    (7, -5.801203960010585),
    (8, 0.3111643669578199),
    (9, -0.1521609496625161),
    (10, 0.20136540080403034),
    (11, 0.04471061572777259),
];
/// Estimate of order 5: its weights less those of order 8.
pub(super) const E5: Row<8> = [
    (0, 0.01312004499419488),
    (5, -1.2251564463762044),
    (6, -0.4957589496572502),
    (7, 1.6643771824549864),
    (8, -0.35032884874997366),
    (9, 0.3341791187130175),
    (10, 0.08192320648511571),
    (11, -0.022355307863886294),
];
/// Estimate of order 3.
pub(super) const E3: Row<8> = [
    (0, -0.18980075407240762),
    (5, 4.450312892752409),
    (6, 1.8915178993145003),
    (7, -5.801203960010585),
    (8, -0.4226823213237919),
    (9, -0.1521609496625161),
    (10, 0.20136540080403034),
    (11, 0.02265179219836082),
];
/// Argument of slope 13 (continuous extension).
pub(super) const A13: Row<8> = [
    (0, 0.056167502283047954),
    (6, 0.25350021021662483),
    (7, -0.2462390374708025),
    (8, -0.12419142326381637),
    (9, 0.15329179827876568),
    (10, 0.00820105229563469),
    (11, 0.007567897660545699),
    (12, -0.008298),
];
/// Argument of slope 14 (continuous extension).
pub(super) const A14: Row<8> = [
    (0, 0.03183464816350214),
    (5, 0.028300909672366776),
    (6, 0.053541988307438566),
    (7, -0.05492374857139099),
    (10, -0.00010834732869724932),
    (11, 0.0003825710908356584),
    (12, -0.00034046500868740456),
    (13, 0.1413124436746325),
];
/// Argument of slope 15 (continuous extension).
pub(super) const A15: Row<8> = [
    (0, -0.42889630158379194),
    (5, -4.697621415361164),
    (6, 7.683421196062599),
    (7, 4.06898981839711),
    (8, 0.3567271874552811),
    (12, -0.0013990241651590145),
    (13, 2.9475147891527724),
    (14, -9.15095847217987),
];
/// Coefficient 3 of the continuous extension.
pub(super) const D3: Row<12> = [
    (0, -8.428938276109013),
    (5, 0.5667149535193777),
    (6, -3.0689499459498917),
    (7, 2.38466765651207),
    (8, 2.117034582445028),
    (9, -0.871391583777973),
    (10, 2.2404374302607883),
    (11, 0.6315787787694688),
    (12, -0.08899033645133331),
    (13, 18.148505520854727),
    (14, -9.194632392478356),
    (15, -4.436036387594894),
];
/// Coefficient 4 of the continuous extension.
pub(super) const D4: Row<12> = [
    (0, 10.427508642579134),
    (5, 242.28349177525817),
    (6, 165.20045171727028),
    (7, -374.5467547226902),
    (8, -22.113666853125306),
    (9, 7.733432668472264),
    (10, -30.674084731089398),
    (11, -9.332130526430229),
    (12, 15.697238121770845),
    (13, -31.139403219565178),
    (14, -9.35292435884448),
    (15, 35.81684148639408),
];
/// Coefficient 5 of the continuous extension.
pub(super) const D5: Row<12> = [
    (0, 19.985053242002433),
    (5, -387.0373087493518),
    (6, -189.17813819516758),
    (7, 527.8081592054236),
    (8, -11.57390253995963),
    (9, 6.8812326946963),
    (10, -1.0006050966910838),
    (11, 0.7777137798053443),
    (12, -2.778205752353508),
    (13, -60.19669523126412),
    (14, 84.32040550667716),
    (15, 11.99229113618279),
];
/// Coefficient 6 of the continuous extension.
pub(super) const D6: Row<12> = [
    (0, -25.69393346270375),
    (5, -154.18974869023643),
    (6, -231.5293791760455),
    (7, 357.6391179106141),
    (8, 93.40532418362432),
    (9, -37.45832313645163),
    (10, 104.0996495089623),
    (11, 29.8402934266605),
    (12, -43.53345659001114),
    (13, 96.32455395918828),
    (14, -39.17726167561544),
    (15, -149.72683625798564),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The rows of A as a full matrix, up to the last stage of the continuous extension.
    fn full() -> [[f64; SLOPES]; SLOPES] {
        let mut a = [[0.0; SLOPES]; SLOPES];
        let rows: [&[(usize, f64)]; SLOPES] = [
            &[],
            &A1,
            &A2,
            &A3,
            &A4,
            &A5,
            &A6,
            &A7,
            &A8,
            &A9,
            &A10,
            &A11,
            &B,
            &A13,
            &A14,
            &A15,
        ];
        for (into, row) in a.iter_mut().zip(rows) {
            for &(stage, coefficient) in row {
                into[stage] += coefficient;
            }
        }
        a
    }

    fn weighted(row: &[(usize, f64)], values: &[f64]) -> f64 {
        row.iter().map(|&(stage, b)| b * values[stage]).sum()
    }

    fn product(a: &[[f64; SLOPES]; SLOPES], values: &[f64]) -> Vec<f64> {
        a.iter()
            .map(|row| row.iter().zip(values).map(|(a, v)| a * v).sum())
            .collect()
    }

    fn power(k: i32) -> Vec<f64> {
        C.iter().map(|c| c.powi(k)).collect()
    }

    fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
        a.iter().zip(b).map(|(a, b)| a * b).collect()
    }

    fn near(value: f64, expected: f64) {
        assert!(
            (value - expected).abs() < 3e-14,
            "{value} is not {expected}"
        );
    }

    #[test]
    fn rows_sum_to_the_abscissae() {
        for (sum, c) in product(&full(), &[1.0; SLOPES]).into_iter().zip(C) {
            near(sum, c);
        }
    }

    #[test]
    fn weights_meet_order_conditions_up_to_8() {
        let a = full();
        for k in 0..8 {
            near(weighted(&B, &power(k)), 1.0 / f64::from(k + 1));
        }
        assert!(
            (weighted(&B, &power(8)) - 1.0 / 9.0).abs() > 1e-6,
            "order 8, not 9"
        );
        // trees with one branch Σ b cᵏ a cᵐ, up to order 8: k + m + 2 nodes
        for k in 0..7 {
            for m in 1..=6 - k {
                let tree = times(&power(k), &product(&a, &power(m)));
                near(weighted(&B, &tree), 1.0 / f64::from((m + 1) * (m + k + 2)));
            }
        }
        // the tall tree of each order and two bushes
        let mut tall = power(1);
        let mut factorial = 2.0;
        for order in 3..=8 {
            tall = product(&a, &tall);
            factorial *= f64::from(order);
            near(weighted(&B, &tall), 1.0 / factorial);
        }
        let inner = product(&a, &power(2));
        near(weighted(&B, &times(&inner, &inner)), 1.0 / (7.0 * 9.0));
        near(
            weighted(&B, &product(&a, &times(&inner, &power(2)))),
            1.0 / (3.0 * 6.0 * 7.0),
        );
    }

    #[test]
    fn estimates_have_their_orders() {
        for k in 0..5 {
            assert!(weighted(&E5, &power(k)).abs() < 1e-14, "c^{k}");
        }
        assert!(weighted(&E5, &power(5)).abs() > 1e-4);
        for k in 0..3 {
            assert!(weighted(&E3, &power(k)).abs() < 1e-14, "c^{k}");
        }
        assert!(weighted(&E3, &power(3)).abs() > 1e-4);
    }

    /// With y′ = (k + 1) tᵏ the extension is θ^(k+1), for k + 1 up to its order.
    #[test]
    fn extension_integrates_powers_up_to_7() {
        for k in 0..7 {
            let slopes: Vec<f64> = power(k).into_iter().map(|p| p * f64::from(k + 1)).collect();
            let higher = [&D3[..], &D4, &D5, &D6].map(|row| weighted(row, &slopes));
            let (start, end) = (slopes[0], slopes[LAST]);
            let dense = [
                1.0,
                start - 1.0,
                2.0 - start - end,
                higher[0],
                higher[1],
                higher[2],
                higher[3],
            ];
            for x in [0.1, 0.37, 0.5, 0.93] {
                let value = dense.iter().enumerate().rev().fold(0.0, |sum, (power, d)| {
                    (sum + d) * if power % 2 == 0 { x } else { 1.0 - x }
                });
                assert!(
                    (value - f64::powi(x, k + 1)).abs() < 1e-12,
                    "θ^{}: {value} at {x}",
                    k + 1
                );
            }
        }
    }
}

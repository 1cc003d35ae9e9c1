//! Coefficients of Radau IIA with three, five and seven stages, and the transformations that take their stages apart.
//!
//! ```text
//! Z = h A F       stages y + Zᵢ with slopes F
//! A⁻¹ T = T Λ     Λ = diag(γ, [α₁ β₁; −β₁ α₁], …)
//! (γ/h − J) e = f(t, y) + Σ Eᵢ Zᵢ / h
//! ```
//!
//! The abscissae c are the zeros of dˢ⁻¹/dxˢ⁻¹ (xˢ⁻¹ (x − 1)ˢ), and A integrates polynomials of degree s − 1 to each. γ and α ± iβ
//! are the eigenvalues of A⁻¹; the columns of T are its eigenvectors, real and imaginary parts, with last component 1. E belongs to
//! the quadrature with f(t, y) of weight 1/γ beside the stages, of order s. Worked out with 60 digits; the tests below hold what
//! defines them.
//!
//! Source: E. Hairer, G. Wanner, *Stiff differential equations solved by Radau methods*, J. Comput. Appl. Math. 111, 1999.

/// Numbers of one method, without unit.
#[derive(Debug)]
pub(super) struct Tableau {
    /// Number of stages s; the order is 2 s − 1.
    pub stages: usize,
    /// Abscissae, in steps (s).
    pub c: &'static [f64],
    /// The real eigenvalue of A⁻¹.
    pub gamma: f64,
    /// The others: real and imaginary parts.
    pub pairs: &'static [[f64; 2]],
    /// T by rows (s × s).
    pub t: &'static [f64],
    /// T⁻¹ by rows (s × s).
    pub t_inverse: &'static [f64],
    /// Weights of the stages in the estimate (s).
    pub e: &'static [f64],
}

/// By number of stages.
pub(super) static TABLEAUS: [Tableau; 3] = [THREE, FIVE, SEVEN];

const THREE: Tableau = Tableau {
    stages: 3,
    c: &[0.1550510257216822, 0.6449489742783178, 1.0],
    gamma: 3.637834252744496,
    pairs: &[[2.6810828736277523, 3.0504301992474105]],
    t: &[
        0.09443876248897524,
        -0.1412552950209542,
        0.030029194105147424,
        0.2502131229653333,
        0.20412935229379994,
        -0.3829421127572619,
        1.0,
        1.0,
        0.0,
    ],
    t_inverse: &[
        4.178718591551905,
        0.32768282076106237,
        0.5233764454994495,
        -4.178718591551905,
        -0.32768282076106237,
        0.47662355450055044,
        0.5028726349457868,
        -2.571926949855605,
        0.5960392048282249,
    ],
    e: &[-10.048809399827416, 1.382142733160749, -0.3333333333333333],
};

const FIVE: Tableau = Tableau {
    stages: 5,
    c: &[
        0.05710419611451768,
        0.2768430136381238,
        0.5835904323689168,
        0.8602401356562195,
        1.0,
    ],
    gamma: 6.2867047517292765,
    pairs: &[
        [5.70095329867179, 3.2102656003085497],
        [3.655694325463572, 6.543736899360077],
    ],
    t: &[
        0.013576867344947943,
        -0.011478515255229515,
        0.01401985889287541,
        -0.010242047817908826,
        -0.04767387729029572,
        0.0016179004017190875,
        -0.007668830749180163,
        -0.024708578426518527,
        0.05017286451737106,
        0.09433181918161143,
        0.07915785334744721,
        0.01939846399882895,
        -0.08180035370375117,
        -0.23053953404341795,
        -0.1027030453801259,
        0.41225608268046143,
        0.40760117128019907,
        -0.19968242788680252,
        0.37789390224886127,
        -0.46674413033249434,
        1.0,
        1.0,
        0.0,
        1.0,
        0.0,
    ],
    t_inverse: &[
        27.697693775684087,
        12.783337911304406,
        3.20848938671343,
        -0.9514904122489162,
        0.7415504960259897,
        -33.041880213519,
        -17.376953479063566,
        -0.17212906325400557,
        -0.09916977798254265,
        0.5312281158383066,
        8.611443979875292,
        -9.699991409528808,
        -1.9147286396968743,
        -2.41869200608494,
        1.0474634879353375,
        5.344186437834912,
        4.593615567759161,
        -3.0363603234594243,
        1.050660190231459,
        -0.27277861186429625,
        -3.748059807439805,
        3.984965736343885,
        1.0444156416080188,
        -1.1840985681379486,
        0.44991777015678036,
    ],
    e: &[
        -27.78093394406464,
        3.641478498049213,
        -1.2525477211691187,
        0.5920031671845428,
        -0.2,
    ],
};

const SEVEN: Tableau = Tableau {
    stages: 7,
    c: &[
        0.029316427159784893,
        0.1480785996684843,
        0.3369846902811543,
        0.5586715187715501,
        0.7692338620300545,
        0.9269456713197411,
        1.0,
    ],
    gamma: 8.936832788405216,
    pairs: &[
        [8.511834825102946, 3.281013624325059],
        [7.14105521918764, 6.623045922639276],
        [4.378693561506806, 10.169693283795011],
    ],
    t: &[
        0.0024435843048706113,
        -0.0012386461879528741,
        0.0027606174805438525,
        -0.004055161452331024,
        -0.004427232753268285,
        0.021567551351320772,
        -0.008783567925144144,
        -0.001815339648319317,
        -6.666635339396339e-05,
        -0.00318547482516621,
        0.00841556827655959,
        0.00403194957022455,
        -0.03813164813441155,
        0.021525560594006874,
        0.004605339331161875,
        -0.0023521809829433384,
        -0.00041690777252975626,
        -0.008560431061603433,
        0.006923212665023909,
        0.05739650893938172,
        -0.05885052920842679,
        0.017870023342853068,
        0.0031150711523461752,
        -0.025116604913438822,
        -0.03737124230238446,
        -0.00823900729850772,
        -0.03821469359696835,
        0.16573681127294385,
        0.12818100807728391,
        0.10171773248171515,
        -0.09504502035604623,
        0.0053667613791817705,
        -0.19321111610126201,
        -0.2491742124652637,
        -0.27356330579866234,
        0.5200651497488247,
        0.5217519452747653,
        -0.1280719446355439,
        0.5265742264584493,
        -0.27553439498962584,
        0.5315846490836285,
        -0.4863228366175729,
        1.0,
        1.0,
        0.0,
        1.0,
        0.0,
        1.0,
        0.0,
    ],
    t_inverse: &[
        227.51530596268069,
        166.64802246760974,
        43.26514588452621,
        3.623090061341016,
        3.572674832938798,
        -2.7435563656033675,
        1.4514535402547504,
        -299.1862480282521,
        -243.04074536874478,
        -48.77710407803787,
        -2.0386719057419342,
        1.673560239861085,
        -1.0873740320571061,
        0.9019382492960993,
        93.0765028974353,
        -23.881631056281144,
        -39.278880730813846,
        -14.38891568549108,
        3.5104383993993613,
        -4.8632848855661805,
        2.2464827295912397,
        74.6783322350227,
        87.40858897990081,
        4.024158737379998,
        -3.714806315158364,
        -3.4300939859823174,
        2.6966048097653124,
        -0.9386927436075462,
        -58.356528851906575,
        10.06877395780018,
        30.36638884256667,
        1.020020865184866,
        0.11241750037842496,
        -1.8906408310003777,
        0.9716486393831483,
        -3.007390169451292,
        -11.015866078765772,
        1.4877994561316563,
        2.1303881595592826,
        -1.8161410868175656,
        1.134325587895161,
        -0.41469904594330353,
        8.441963188321084,
        0.650525274057515,
        -6.9406707303698765,
        3.2050475255978985,
        -1.0712809435464785,
        0.3548507491216222,
        -0.09198549132786554,
    ],
    e: &[
        -54.374436894128614,
        7.000024004259187,
        -2.355661091987557,
        1.1322890661061344,
        -0.6468913267673587,
        0.38753338537535237,
        -0.14285714285714285,
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// A⁻¹ = T Λ T⁻¹ by rows.
    fn inverse(tableau: &Tableau) -> Vec<f64> {
        let s = tableau.stages;
        let mut middle = vec![0.0; s * s];
        for j in 0..s {
            middle[j] = tableau.gamma * tableau.t_inverse[j];
            for (m, [alpha, beta]) in tableau.pairs.iter().enumerate() {
                let (b, c) = (1 + 2 * m, 2 + 2 * m);
                let (of_b, of_c) = (tableau.t_inverse[b * s + j], tableau.t_inverse[c * s + j]);
                middle[b * s + j] = alpha * of_b + beta * of_c;
                middle[c * s + j] = alpha * of_c - beta * of_b;
            }
        }
        let entry = |i: usize, j: usize| -> f64 {
            (0..s)
                .map(|k| tableau.t[i * s + k] * middle[k * s + j])
                .sum()
        };
        (0..s * s).map(|at| entry(at / s, at % s)).collect()
    }

    #[test]
    fn stages_integrate_polynomials() {
        // A⁻¹ takes cᵏ, integrals of k cᵏ⁻¹, back to these.
        for tableau in &TABLEAUS {
            let s = tableau.stages;
            let inverse = inverse(tableau);
            for k in 1..=s as i32 {
                for i in 0..s {
                    let found: f64 = (0..s)
                        .map(|j| inverse[i * s + j] * tableau.c[j].powi(k))
                        .sum();
                    let wanted = f64::from(k) * tableau.c[i].powi(k - 1);
                    assert!(
                        (found - wanted).abs() < 1e-11,
                        "{s} stages, {k}: {found} {wanted}"
                    );
                }
            }
            assert_eq!(tableau.c[s - 1], 1.0);
        }
    }

    #[test]
    fn estimates_vanish_where_the_quadrature_is_exact() {
        // Of y = xᵏ with J = 0 the stages are exact, and f(0) is 1 for k = 1 alone.
        for tableau in &TABLEAUS {
            for k in 1..=tableau.stages as i32 {
                let stages: f64 = tableau
                    .e
                    .iter()
                    .zip(tableau.c)
                    .map(|(e, c)| e * c.powi(k))
                    .sum();
                let slope = if k == 1 { 1.0 } else { 0.0 };
                assert!((slope + stages).abs() < 1e-12, "{k}: {stages}");
            }
            let beyond = tableau.stages as i32 + 1;
            let stages: f64 = tableau
                .e
                .iter()
                .zip(tableau.c)
                .map(|(e, c)| e * c.powi(beyond))
                .sum();
            assert!(stages.abs() > 1e-5, "{stages}");
        }
    }

    /// The numbers of RADAU5 by their closed forms (Hairer and Wanner 1996, §IV.8).
    #[test]
    fn three_stages_are_radau5() {
        let tableau = &TABLEAUS[0];
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-13 * b.abs().max(1.0), "{a} {b}");
        let root = 6.0_f64.sqrt();
        let [nine, three] = [81.0_f64.cbrt(), 9.0_f64.cbrt()];
        let gamma = 30.0 / (6.0 + nine - three);
        near(tableau.gamma, gamma);
        // The eigenvalues of A⁻¹ are the roots of λ³ − 9 λ² + 36 λ − 60.
        let [alpha, beta] = tableau.pairs[0];
        near(gamma + 2.0 * alpha, 9.0);
        near(gamma * (alpha * alpha + beta * beta), 60.0);
        let c = [(4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0];
        let e = [
            (-13.0 - 7.0 * root) / 3.0,
            (-13.0 + 7.0 * root) / 3.0,
            -1.0 / 3.0,
        ];
        for i in 0..3 {
            near(tableau.c[i], c[i]);
            near(tableau.e[i], e[i]);
        }
    }
}

//! Derivatives against closed forms and central differences, and enclosures against numbers inside.

mod boxes;
mod bundled;

use super::*;
use crate::{Leaf, Loaded, load};

/// A file with these parameters, whose crank has its point at the expression.
fn file(parameters: &str, expression: &str) -> Result<Loaded, Complaints> {
    let text = format!(
        r#"{{ "format": "linkdyn/1", "units": {{ "length": "mm", "angle": "deg" }}, "parameters": {{ {parameters} }},
        "bodies": {{ "crank": {{ "points": {{ "A": ["={expression}", 0] }} }} }} }}"#
    );
    load(text.as_bytes(), &[])
}

const KNOWN: &str = r#""x": 0.3, "y": 0.7, "l": "50 mm", "k": "80 mm", "phi": "40 deg", "n": 3"#;

fn read(expression: &str) -> Loaded {
    file(KNOWN, expression).unwrap_or_else(|said| panic!("{expression}: {said}"))
}

fn only(expression: &str) -> Leaf {
    let mut leaves = read(expression).source.derivatives().leaves;
    assert_eq!(leaves.len(), 1, "{expression}");
    leaves.remove(0)
}

/// A gradient without gaps.
fn dense(leaf: &Leaf) -> [f64; 6] {
    let mut dense = [0.0; 6];
    leaf.gradient
        .iter()
        .for_each(|(index, by)| dense[*index] = *by);
    dense
}

/// Expressions of lengths, and what they are differentiated in.
const SMOOTH: [&str; 27] = [
    "l + 2*k",
    "l - k/3",
    "l*k/1 m",
    "-l*l/k",
    "l^2/k",
    "l^(1/3)*k^(2/3)",
    "(l/k)^x*k",
    "x^y*1 m",
    "x^-2*1 mm",
    "(0-x)^3*k",
    "sqrt(l*k)",
    "sqrt(l^2 - (k*sin(phi)/2)^2)",
    "hypot(l, k)",
    "abs(l - k)",
    "min(l, k, 1 m)",
    "max(l, k, 1 mm)",
    "l*sin(phi)",
    "k*cos(2*phi)",
    "l*tan(phi)",
    "l*asin(x)/1 rad",
    "l*acos(x*y)/1 rad",
    "l*atan(x/y)/1 rad",
    "k*atan2(l, -k)/1 rad",
    "l*exp(x*y)",
    "l*ln(n/x)",
    "l*floor(n/2)+k*ceil(x)-l*round(10*y+0.3)",
    "n*x + y^2",
];

#[test]
fn derivatives_are_central_differences() {
    // (f(+h) − f(−h))/2h errs by h²f‴/6 + ε|f|/h, least near h = 1e-5 of the parameter: some 1e-10 of f over it
    for expression in SMOOTH {
        let loaded = read(expression);
        let leaf = only(expression);
        assert_eq!(leaf.fault, None, "{expression}");
        let at = |values: &[(&str, f64)]| {
            let model = loaded.source.with_parameters(values);
            model
                .unwrap_or_else(|said| panic!("{expression}: {said}"))
                .bodies["crank"]
                .points["A"][0]
        };
        let value = at(&[]);
        // an exact value of a plain number is off by its factor alone
        assert!(
            (leaf.value.unwrap() - value).abs() <= 4e-16 * value.abs(),
            "{expression}"
        );
        for (parameter, by) in loaded.parameters.iter().zip(dense(&leaf)) {
            let step = 1e-5 * parameter.value;
            let name = parameter.name.as_str();
            let found = (at(&[(name, parameter.value + step)])
                - at(&[(name, parameter.value - step)]))
                / (2.0 * step);
            let scale = by.abs() + value.abs() / parameter.value;
            assert!(
                (found - by).abs() < 2e-9 * scale,
                "{expression} by {name}: {by}, differences say {found}"
            );
        }
    }
}

#[test]
fn derivatives_are_those_of_the_hand() {
    let (x, y, l, m, phi) = (0.3_f64, 0.7_f64, 0.05_f64, 0.08_f64, 40f64.to_radians());
    for (expression, wanted) in [
        ("l + 2*k", [0.0, 0.0, 1.0, 2.0, 0.0, 0.0]),
        ("l*k/1 m", [0.0, 0.0, m, l, 0.0, 0.0]),
        ("l^2/k", [0.0, 0.0, 2.0 * l / m, -l * l / m / m, 0.0, 0.0]),
        (
            "x^y*1 m",
            [y * x.powf(y - 1.0), x.powf(y) * x.ln(), 0.0, 0.0, 0.0, 0.0],
        ),
        ("l*sin(phi)", [0.0, 0.0, phi.sin(), 0.0, l * phi.cos(), 0.0]),
        (
            "l*cos(phi)",
            [0.0, 0.0, phi.cos(), 0.0, -l * phi.sin(), 0.0],
        ),
        (
            "l*tan(phi)",
            [0.0, 0.0, phi.tan(), 0.0, l / phi.cos().powi(2), 0.0],
        ),
        (
            "1 m*asin(x)/1 rad",
            [1.0 / (1.0 - x * x).sqrt(), 0.0, 0.0, 0.0, 0.0, 0.0],
        ),
        (
            "1 m*acos(x)/1 rad",
            [-1.0 / (1.0 - x * x).sqrt(), 0.0, 0.0, 0.0, 0.0, 0.0],
        ),
        (
            "1 m*atan(x)/1 rad",
            [1.0 / (1.0 + x * x), 0.0, 0.0, 0.0, 0.0, 0.0],
        ),
        (
            "1 m*atan2(l, k)/1 rad",
            [
                0.0,
                0.0,
                m / (l * l + m * m),
                -l / (l * l + m * m),
                0.0,
                0.0,
            ],
        ),
        ("1 m*exp(x)", [x.exp(), 0.0, 0.0, 0.0, 0.0, 0.0]),
        ("1 m*ln(x)", [1.0 / x, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (
            "sqrt(l*k)",
            [
                0.0,
                0.0,
                0.5 * (m / l).sqrt(),
                0.5 * (l / m).sqrt(),
                0.0,
                0.0,
            ],
        ),
        (
            "hypot(l, k)",
            [0.0, 0.0, l / l.hypot(m), m / l.hypot(m), 0.0, 0.0],
        ),
        ("abs(l - k)", [0.0, 0.0, -1.0, 1.0, 0.0, 0.0]),
        ("min(l, k)", [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        ("max(l, k)", [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]),
        ("-l", [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]),
        ("l*floor(x)", [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        ("l*ceil(x)", [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        ("l*round(n + x)", [0.0, 0.0, 3.0, 0.0, 0.0, 0.0]),
        // a plain number stands in millimetres here
        ("n*x", [3e-3, 0.0, 0.0, 0.0, 0.0, 3e-4]),
    ] {
        for (found, wanted) in dense(&only(expression)).into_iter().zip(wanted) {
            assert!(
                (found - wanted).abs() <= 1e-15 * wanted.abs().max(1.0),
                "{expression}: {found}, not {wanted}"
            );
        }
    }
}

#[test]
fn kinks_and_jumps_have_no_derivative_but_a_reason() {
    for (parameters, expression, reason) in [
        (r#""l": "5 mm""#, "abs(l - 5 mm)", "abs has a kink at zero"),
        (
            r#""l": "5 mm""#,
            "min(l, 5 mm)",
            "min has a kink where two are equal",
        ),
        (
            r#""l": "5 mm""#,
            "max(5 mm, l)",
            "max has a kink where two are equal",
        ),
        (
            r#""l": "5 mm""#,
            "sqrt(l - 5 mm)*sqrt(1 m)",
            "a root of zero",
        ),
        (
            r#""l": "5 mm""#,
            "(l - 5 mm)^0.5*sqrt(1 m)",
            "a root of zero",
        ),
        (
            r#""l": "5 mm""#,
            "hypot(l - 5 mm, 0 m)",
            "hypot has a kink at zero",
        ),
        (r#""n": 3"#, "floor(n)", "floor jumps here"),
        (r#""n": 3"#, "ceil(n)", "ceil jumps here"),
        (r#""n": 2.5"#, "round(n)", "round jumps here"),
        (
            r#""n": 1"#,
            "asin(n)*1 m/1 rad",
            "asin and acos are infinitely steep at -1 and 1",
        ),
        (
            r#""n": -1"#,
            "acos(n)*1 m/1 rad",
            "asin and acos are infinitely steep at -1 and 1",
        ),
        (
            r#""n": 0"#,
            "atan2(n, -1)*1 m/1 rad",
            "atan2 jumps where its vector points to the left",
        ),
        (
            r#""n": 2"#,
            "(-1)^n",
            "a power of a base that is not above zero, whose exponent changes",
        ),
        (r#""n": 3, "k": "=floor(n)""#, "2*k", "floor jumps here"),
    ] {
        let loaded =
            file(parameters, expression).unwrap_or_else(|said| panic!("{expression}: {said}"));
        let leaves = loaded.source.derivatives().leaves;
        assert_eq!(leaves[0].fault.as_deref(), Some(reason), "{expression}");
        assert!(
            leaves[0].gradient.is_empty() && leaves[0].value.is_some(),
            "{expression}"
        );
    }
    // of constants there is none to miss
    let leaf = only("l*abs(0)*min(1, 1) + floor(2)*l");
    assert_eq!(
        (leaf.fault.as_deref(), leaf.gradient),
        (None, vec![(2, 2.0)])
    );
}

#[test]
fn parameters_that_follow_have_a_deviation_of_their_own() {
    let loaded = file(
        r#""a": "2 mm", "b": "=3*a", "c": "=a*b/1 mm", "d": "1 mm""#,
        "b + c",
    )
    .unwrap();
    let derivatives = loaded.source.derivatives();
    assert_eq!(derivatives.parameters, ["a", "b", "c", "d"]);
    // ∂(b + c)/∂a = 3 + (b + 3a)/1 mm
    let gradient: Vec<(usize, f64)> = derivatives.leaves[0].gradient.clone();
    assert_eq!(
        gradient.iter().map(|one| one.0).collect::<Vec<_>>(),
        [0, 1, 2]
    );
    for ((_, found), wanted) in gradient.into_iter().zip([15.0, 3.0, 1.0]) {
        assert!((found - wanted).abs() < 1e-14, "{found}, not {wanted}");
    }
    // and can be tried: b deviates by 1 mm, on top of what a does
    let at = |deviations: &[(&str, f64)]| {
        loaded.source.with_deviations(deviations).unwrap().bodies["crank"].points["A"][0]
    };
    assert!((at(&[("b", 1e-3)]) - 21e-3).abs() < 1e-17);
    assert!((at(&[("a", 1e-3), ("b", 1e-3)]) - 40e-3).abs() < 1e-17);
    assert!(
        (loaded.source.dependence().at(&[1e-3, 1e-3]).leaves[0]
            .value
            .unwrap()
            - 40e-3)
            .abs()
            < 1e-17
    );
    let said = loaded
        .source
        .with_deviations(&[("z", 1.0)])
        .unwrap_err()
        .to_string();
    assert_eq!(
        said,
        "line 1, column 85: parameters: there is no parameter \"z\" (the parameters: a, b, c, d)"
    );
}

#[test]
fn every_quantity_of_a_file_is_a_leaf_at_its_path() {
    let text = r#"{ "format": "linkdyn/1", "units": "SI", "gravity": [0, "=-g*9.81 m/s^2"],
      "parameters": { "g": 1, "l": { "value": 2, "tolerance": "=0.01*g" }, "w": "=3*g" },
      "bodies": { "ground": { "points": { "O": [0, 0], "Q": { "position": ["=l", 0], "tolerance": "=g*1e-4" } } },
                  "bar": { "mass": "=w", "inertia": 1, "com": [0, "=w"], "points": { "A": [0, "=2 m"] } },
                  "block": { "points": { "C": [0, 0] } } },
      "joints": { "a": { "type": "revolute", "between": ["ground.O", "bar.A"],
                         "clearance": { "model": "ideal", "radius": ["=g*1e-5", "=g*2e-5"] } },
                  "d": { "type": "prismatic", "between": ["bar.A", "block.C"], "axis": [1, "=g"], "play": "=g*1e-5" } },
      "drivers": { "motor": { "type": "rotation", "body": "bar",
                              "motion": { "type": "polynomial", "coefficients": [0, "=w"] } } },
      "analysis": { "type": "kinematics", "end": "=g", "outputs": "=w*10" } }"#;
    let loaded = load(text.as_bytes(), &[]).unwrap_or_else(|said| panic!("{said}"));
    let derivatives = loaded.source.derivatives();
    let leaves = &derivatives.leaves;
    let paths: Vec<&str> = leaves.iter().map(|leaf| leaf.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "gravity[1]",
            "bodies.ground.points.Q.position[0]",
            "bodies.ground.points.Q.tolerance",
            "bodies.bar.mass",
            "bodies.bar.com[1]",
            "joints.a.clearance.radius[0]",
            "joints.a.clearance.radius[1]",
            "joints.d.axis[1]",
            "joints.d.play",
            "drivers.motor.motion.coefficients[1]",
            "analysis.end",
            "analysis.outputs",
        ]
    );
    assert_eq!(leaves[0].gradient, [(0, -9.81)]);
    assert_eq!(leaves[4].gradient, [(0, 3.0), (2, 1.0)]);
}

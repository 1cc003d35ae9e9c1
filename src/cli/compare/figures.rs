//! A figure per compared column: the curves of all models over time.

use linkdyn_output::TIME;
use linkdyn_output::{Column, Trajectory};
use linkdyn_picture::{Axis, Chart, Curve, Cut, Panel, svg, words};

/// Letters of a file's name, without its ending, at most.
const LONGEST: usize = 100;
/// Width and height \[mm\]: a page's full width, since curves with impacts are dense.
const SIZE: [f64; 2] = [180.0, 80.0];

/// A file's name and content.
pub type Figure = (String, String);

/// The figures of columns, each with a curve per model; a column that no model has a value of has none.
pub fn figures(columns: &[Column], models: &[(&str, Trajectory)]) -> Vec<Figure> {
    let mut figures: Vec<Figure> = Vec::new();
    for column in columns {
        let curve = |(model, table): &(&str, Trajectory)| {
            let values = |name: &str| {
                table
                    .values(name)
                    .unwrap_or_else(|| vec![f64::NAN; table.len()])
            };
            Curve::new(*model, values(TIME), values(&column.label()))
        };
        let unit = if column.unit == "1" { "" } else { column.unit };
        let curves: Vec<Curve> = models.iter().map(curve).collect();
        let mut axis = Axis::new(column.name.as_str(), unit);
        let mut note = String::new();
        if let Some((range, ends)) = without_peaks(&curves) {
            axis.range = Some(range);
            note = cut_off(ends, unit);
        }
        let chart = Chart {
            note,
            x: Axis::new(TIME, "s"),
            panels: vec![Panel { axis, curves }],
            size_mm: SIZE.map(Some),
            line_width: 0.8,
            ..Chart::default()
        };
        if let Ok(scene) = chart.draw() {
            let name = file_name(&column.name, &figures);
            figures.push((name, svg::write(&scene)));
        }
    }
    figures
}

/// A range that leaves out a few peaks, by the rule of all pictures, and the range of all values; none without peaks.
fn without_peaks(curves: &[Curve]) -> Option<([f64; 2], [f64; 2])> {
    let [mut shown, mut all] = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let wider = |range: &mut [f64; 2], [low, high]: [f64; 2]| {
        *range = [range[0].min(low), range[1].max(high)];
    };
    let mut is_cut = false;
    for curve in curves {
        let values = curve.y.iter().copied();
        let mut own = [f64::INFINITY, f64::NEG_INFINITY];
        for value in values.clone().filter(|value| value.is_finite()) {
            wider(&mut own, [value, value]);
        }
        wider(&mut all, own);
        let cut = Cut::of(values).unwrap_or_default();
        wider(
            &mut shown,
            [cut.low.unwrap_or(own[0]), cut.high.unwrap_or(own[1])],
        );
        is_cut |= cut != Cut::default();
    }
    let margin = 0.05 * (shown[1] - shown[0]);
    // What one curve cuts off, another one may show.
    let hides = shown[0] > all[0] || shown[1] < all[1];
    (is_cut && hides).then_some(([shown[0] - margin, shown[1] + margin], all))
}

/// What is told of peaks.
fn cut_off(ends: [f64; 2], unit: &str) -> String {
    let [least, most] = ends.map(|value| words::minus(&short(value)));
    format!(
        "peaks cut off: values from {least} to {most} {}",
        words::unit(unit)
    )
    .trim_end()
    .to_string()
}

/// A number to four digits.
fn short(x: f64) -> String {
    if x == 0.0 || (1e-3..1e5).contains(&x.abs()) {
        let digits = (3.0 - x.abs().max(1e-3).log10().floor()).clamp(0.0, 6.0) as usize;
        if x == 0.0 {
            "0".into()
        } else {
            format!("{x:.digits$}")
        }
    } else {
        format!("{x:.3e}")
    }
}

/// `joint.b.force.svg`: what no file system minds, and no other figure has.
fn file_name(column: &str, others: &[Figure]) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || ['.', '-', '_'].contains(&letter);
    let plain = column.trim_start_matches('.').chars().take(LONGEST);
    let plain: String = plain
        .map(|letter| if is_plain(letter) { letter } else { '_' })
        .collect();
    let is_new = |name: &String| {
        others
            .iter()
            .all(|(other, _)| other.to_lowercase() != name.to_lowercase())
    };
    let numbered = (2..).map(|number| format!("{plain}-{number}.svg"));
    std::iter::once(format!("{plain}.svg"))
        .chain(numbered)
        .find(is_new)
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_peaks_do_not_squeeze_the_rest() {
        let times: Vec<f64> = (0..1001).map(f64::from).collect();
        let mut y: Vec<f64> = times.iter().map(|t| (0.1 * t).sin()).collect();
        assert_eq!(
            without_peaks(&[Curve::new("a", times.clone(), y.clone())]),
            None
        );
        (y[500], y[700]) = (1e6, f64::NAN);
        let (range, all) = without_peaks(&[Curve::new("a", times, y)]).expect("a peak");
        assert!(
            all[1] == 1e6 && range[0] < -1.0 && range[1] > 1.4 && range[1] < 3.5,
            "{range:?} {all:?}"
        );
        assert_eq!(
            without_peaks(&[Curve::new("a", vec![0.0, 1.0], vec![0.0, 1e9])]),
            None
        );
        assert_eq!(without_peaks(&[]), None);
    }

    #[test]
    fn peaks_are_told_in_units_as_the_axis_writes_them() {
        assert_eq!(
            cut_off([-134.6, 17730.0], "N*m"),
            "peaks cut off: values from −134.6 to 17730 N·m"
        );
        assert_eq!(
            cut_off([-1e-5, 2e9], ""),
            "peaks cut off: values from −1.000e−5 to 2.000e9"
        );
    }

    #[test]
    fn names_of_files_are_plain_and_different() {
        let mut others: Vec<Figure> = Vec::new();
        for (column, name) in [
            ("joint.b.force", "joint.b.force.svg"),
            ("joint.../b.force", "joint..._b.force.svg"),
            ("joint.B.force", "joint.B.force-2.svg"),
            ("../x y", "_x_y.svg"),
            ("Kolben größer.x", "Kolben_größer.x.svg"),
        ] {
            let found = file_name(column, &others);
            assert_eq!(found, name);
            others.push((found, String::new()));
        }
    }
}

//! What the paper says in words, C1 to C6, each judged by a rule on numbers.
//!
//! "Near" is within [`NEAR`] of the position that the paper names. C3 to C6 are about deviations, which depend on the output
//! step, and the paper names none: each statement is tried at every step, and is reproduced when it holds at all of them,
//! partly when at some.

use super::bounds::{ABRUPT, CLEAR, NEAR, NEAR_OTHER};
use super::centres::Centres;
use super::forces::ForceNear;
use super::judged::{Judged, Reproduced};
use super::models::{Quantity, RADII, STEPS, Stroke};
use super::table::{DISTURBED, Deviations, NEAR_CHANGE_POINT, Runs};
use crate::Claim;

/// Reasons why claims are not reproduced.
const OPEN_CENTRES: &str =
    "It follows from the centres of mass of links 3 and 4, which the paper does not give.";
const NO_BOUND: &str = "F12 of the ideal lock has no bound at its change point, so that its largest deviations lie there; \
     why the paper has them near -40 deg is not known.";
pub const OPEN_STEP: &str = "It depends on the step over which a clearance link turns, which the paper does not give; \
     where a joint force reverses within a step the link turns by up to 180 deg.";

/// Largest change between neighbouring outputs at 0.1° by that at 1° up to which a curve counts as smooth (0.1 when it is
/// differentiable, 1 when it jumps).
const SMOOTH: f64 = 0.2;
/// Mean deviation by the ideal curve's range up to which a clearance "matters little".
const LITTLE: f64 = 0.01;
/// Ratio of mean deviations at 100 and 10 µm from which 100 µm matters "clearly more".
const CLEARLY_MORE: f64 = 3.0;
/// Choices of centres of mass that are named in a claim.
const MOST_CHOICES: usize = 6;

/// C1 to C6: `runs` of the bundled model, `map` of all choices of centres of mass.
pub fn claims(runs: &Runs, map: &[ForceNear]) -> Vec<Claim> {
    let mut judged = vec![smooth(runs), abrupt(map)];
    judged.extend(of_deviations(&runs.deviations));
    judged.into_iter().map(Judged::claim).collect()
}

/// C3 to C6.
pub fn of_deviations(deviations: &Deviations) -> [Judged; 4] {
    [
        largest(deviations),
        sensitive(deviations),
        wider(deviations),
        little(deviations),
    ]
}

fn smooth(runs: &Runs) -> Judged {
    let ratio =
        |quantity: Quantity| jump(&runs.ideal[3], quantity) / jump(&runs.ideal[1], quantity);
    let ratios = Quantity::ALL[..4]
        .iter()
        .map(|&quantity| (quantity, ratio(quantity)));
    let held = ratios.clone().filter(|(_, ratio)| *ratio <= SMOOTH).count();
    let figures: Vec<String> = ratios
        .map(|(quantity, ratio)| format!("{} {ratio:.3}", quantity.symbol()))
        .collect();
    Reproduced::of(held, 4).judged(
        "C1: at e = 0 theta2, omega2, alpha2, M_d are smooth over the stroke",
        "smooth curves",
        format!(
            "largest change between outputs at {}° by that at {}° is at most {SMOOTH}",
            STEPS[3], STEPS[1]
        ),
        figures.join(", "),
    )
}

/// Largest change between neighbouring outputs.
fn jump(stroke: &Stroke, quantity: Quantity) -> f64 {
    stroke
        .curve(quantity)
        .windows(2)
        .fold(0.0, |largest: f64, pair| {
            let change = (pair[1] - pair[0]).abs();
            if change.is_nan() {
                f64::INFINITY
            } else {
                largest.max(change)
            }
        })
}

/// C2, of F12 for every choice of the centres of mass that the paper leaves open.
fn abrupt(map: &[ForceNear]) -> Judged {
    let held: Vec<&ForceNear> = map.iter().filter(|near| near.abrupt()).collect();
    let reproduced = match held.len() {
        0 => Reproduced::No,
        count if count == map.len() => Reproduced::Yes,
        _ => Reproduced::ForSomeCentres,
    };
    let ratios = |near: &ForceNear| {
        format!(
            "change {:.1}, turn {:.1} of the median",
            near.change, near.turn_near
        )
    };
    let elsewhere = map
        .iter()
        .filter(|near| near.turn_most >= ABRUPT && !near.abrupt())
        .count();
    let mut figures = vec![format!("{} of {} choices", held.len(), map.len())];
    figures.extend(held.iter().take(MOST_CHOICES).map(|near| {
        let [size, at] = near.least;
        format!(
            "[{}] {}, least |F12| {size:.1} N at {at:.1}°",
            near.centres.symbols(),
            ratios(near)
        )
    }));
    figures.push(format!(
        "with {elsewhere} others the direction turns as fast elsewhere"
    ));
    let model = map.iter().find(|near| near.centres == Centres::MODEL);
    figures.extend(model.map(|near| format!("the model's choice: {}", ratios(near))));
    reproduced.judged(
        "C2: at e = 0 F12 changes abruptly near theta6 = -40 deg",
        "abrupt change",
        format!(
            "change of F12 per degree, or turn of its direction, within {NEAR}° of -40° is at least {ABRUPT} times \
             the median over -50…{CLEAR}°: reproduced when with all choices of the centres of mass of links 3 and 4"
        ),
        figures.join("; "),
    )
    .because(OPEN_CENTRES)
}

fn largest(deviations: &Deviations) -> Judged {
    let count = |quantities: &[Quantity], position: f64| {
        let rows = quantities
            .iter()
            .flat_map(|&q| (0..RADII.len()).flat_map(move |radius| deviations.row(radius, q)));
        let places: Vec<f64> = rows.map(|deviation| deviation.at).collect();
        let held = places
            .iter()
            .filter(|at| (*at - position).abs() <= NEAR)
            .count();
        let (low, high) = places
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), at| {
                (l.min(*at), h.max(*at))
            });
        (held, places.len(), low, high)
    };
    let first = count(&Quantity::ALL[..4], NEAR_CHANGE_POINT);
    let second = count(&[Quantity::Force], NEAR_OTHER);
    Reproduced::of(first.0 + second.0, first.1 + second.1).judged(
        "C3: the largest deviations of theta2, omega2, alpha2, M_d are near 117.5 deg, that of F12 near -40 deg",
        "117.5 deg; -40 deg",
        format!("position within {NEAR}°, at both clearances and all four steps"),
        format!(
            "first half at {} of {} rows (they lie at {:.1}…{:.1}°), second half at {} of {} (at {:.1}…{:.1}°)",
            first.0, first.1, first.2, first.3, second.0, second.1, second.2, second.3
        ),
    )
    .because(NO_BOUND)
}

/// Tries a statement at every step.
fn at_steps(mut holds: impl FnMut(usize) -> bool) -> (Reproduced, String) {
    let held: Vec<bool> = (0..STEPS.len()).map(&mut holds).collect();
    let names = |wanted: bool| {
        let steps = STEPS.iter().zip(&held).filter(|(_, held)| **held == wanted);
        steps
            .map(|(step, _)| format!("{step}°"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let count = held.iter().filter(|held| **held).count();
    let reproduced = Reproduced::of(count, STEPS.len());
    let text = match count {
        0 => "holds at no step".to_string(),
        _ if count == STEPS.len() => "holds at all steps".to_string(),
        _ => format!("holds at {}, not at {}", names(true), names(false)),
    };
    (reproduced, text)
}

/// A figure per step.
fn by_step(figure: impl Fn(usize) -> String) -> String {
    (0..STEPS.len()).map(figure).collect::<Vec<_>>().join(" / ")
}

fn sensitive(deviations: &Deviations) -> Judged {
    let share = |radius: usize, step: usize, q: Quantity| {
        deviations.at(radius, step, q).max / deviations.ranges[q.index()]
    };
    let others = |step: usize| {
        let shares = Quantity::ALL[1..]
            .iter()
            .flat_map(|&q| (0..RADII.len()).map(move |radius| (radius, q)));
        shares.fold(f64::INFINITY, |least, (radius, q)| {
            least.min(share(radius, step, q))
        })
    };
    let angle =
        |step: usize| share(0, step, Quantity::Theta2).max(share(1, step, Quantity::Theta2));
    let (reproduced, text) = at_steps(|step| angle(step) <= DISTURBED && others(step) > DISTURBED);
    reproduced.judged(
        "C4: theta2 is hardly affected by the clearance, omega2, alpha2, M_d, F12 strongly",
        "in words",
        format!(
            "largest deviation of theta2 at most {} % of the ideal curve's range, of each other quantity more",
            100.0 * DISTURBED
        ),
        format!(
            "{text}; theta2 {} %, least of the others {} % (steps 2.5 / 1 / 0.5 / 0.1°)",
            by_step(|step| format!("{:.2}", 100.0 * angle(step))),
            by_step(|step| format!("{:.1}", 100.0 * others(step)))
        ),
    )
    .because(OPEN_STEP)
}

fn wider(deviations: &Deviations) -> Judged {
    let mean = |radius, step, q| deviations.at(radius, step, q).mean;
    let width = |radius, step, q| deviations.at(radius, step, q).disturbed;
    let (reproduced, text) = at_steps(|step| {
        Quantity::ALL
            .iter()
            .all(|&q| mean(1, step, q) > mean(0, step, q))
            && Quantity::ALL[1..]
                .iter()
                .all(|&q| width(1, step, q) > width(0, step, q))
    });
    let widths =
        |radius| by_step(|step| format!("{:.0}", 100.0 * width(radius, step, Quantity::Alpha2)));
    reproduced.judged(
        "C5: the larger e, the larger the mean deviations and the wider the disturbed range",
        "in words",
        format!(
            "mean deviation of all five, and the part of the stroke with a deviation above {} % of the ideal curve's \
             range of the four after theta2, larger at 100 than at 10 um",
            100.0 * DISTURBED
        ),
        format!(
            "{text}; disturbed part of alpha2 {} % of the stroke at 10 um, {} % at 100 um (steps 2.5 / 1 / 0.5 / 0.1°)",
            widths(0),
            widths(1)
        ),
    )
    .because(OPEN_STEP)
}

fn little(deviations: &Deviations) -> Judged {
    let share = |step: usize| {
        let shares = Quantity::ALL
            .iter()
            .map(|&q| deviations.at(0, step, q).mean / deviations.ranges[q.index()]);
        shares.fold(0.0, f64::max)
    };
    let more = |step: usize| {
        let ratio = |q: Quantity| deviations.at(1, step, q).mean / deviations.at(0, step, q).mean;
        Quantity::ALL[1..]
            .iter()
            .fold(f64::INFINITY, |least, &q| least.min(ratio(q)))
    };
    let (reproduced, text) = at_steps(|step| share(step) <= LITTLE && more(step) >= CLEARLY_MORE);
    reproduced.judged(
        "C6: e = 10 um matters little, e = 100 um clearly more",
        "in words",
        format!(
            "at 10 um no mean deviation above {} % of the ideal curve's range; at 100 um at least {CLEARLY_MORE} times \
             as much in each of the four after theta2",
            100.0 * LITTLE
        ),
        format!(
            "{text}; largest mean at 10 um {} %, least ratio {} (steps 2.5 / 1 / 0.5 / 0.1°)",
            by_step(|step| format!("{:.2}", 100.0 * share(step))),
            by_step(|step| format!("{:.1}", more(step)))
        ),
    )
    .because(OPEN_STEP)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_that_hold_are_named() {
        assert_eq!(
            at_steps(|step| step < 2),
            (
                Reproduced::Partly,
                "holds at 2.5°, 1°, not at 0.5°, 0.1°".into()
            )
        );
        assert_eq!(at_steps(|_| true).0, Reproduced::Yes);
    }

    /// F12 that turns near −40° by so many times its median, for every choice.
    fn turning(by: impl Fn(usize) -> f64) -> Vec<ForceNear> {
        let near = |(index, centres)| ForceNear {
            centres,
            least: [1.0, -42.0],
            turn: [1.0, -42.0],
            turn_most: by(index),
            change: 1.0,
            turn_near: by(index),
            there: 1.0,
        };
        Centres::all().enumerate().map(near).collect()
    }

    #[test]
    fn what_holds_with_some_centres_of_mass_is_possible_and_not_reproduced() {
        let claims = [
            turning(|_| 9.9),
            turning(|index| if index < 4 { 10.0 } else { 1.0 }),
            turning(|_| 10.1),
        ]
        .map(|map| abrupt(&map).claim());
        let begins = [
            "not: 0 of 49",
            "possible for some centres of mass, which the paper does not give: 4 of 49",
            "reproduced: 49 of 49",
        ];
        for (claim, begin) in claims.iter().zip(begins) {
            assert!(claim.ours.starts_with(begin), "{claim:?}");
        }
        assert_eq!(
            claims.map(|claim| claim.verdict.reason()),
            [Some(OPEN_CENTRES), Some(OPEN_CENTRES), None]
        );
    }
}

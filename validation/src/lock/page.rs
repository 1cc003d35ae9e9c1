//! What the case prints: the paper's figures beside ours, and what lies around them, in tables of at most 120 columns.

use std::fmt::Write;

use super::bounds::{ABRUPT, CLEAR, NEAR};
use super::centres::{Centre, Centres, Ternary};
use super::facts::Fact;
use super::figures::Drawn;
use super::first_pass::{self, FirstPass, Sign};
use super::forces::ForceNear;
use super::format::{list, short};
use super::models::{Found, JOINTS, Order, Quantity, RADII, STEPS, Stroke};
use super::reversals::{FAST, Turn};
use super::table::{Paper, Runs, SETTLED, settles};

/// Lines under headings. Writing to a String can't fail.
#[derive(Debug, Default)]
pub struct Page(String);

impl Page {
    /// All of it, with the heading of the claims that follow.
    pub fn text(mut self) -> String {
        self.heading("Claims");
        self.0
    }

    /// A line, or several.
    pub fn line(&mut self, text: impl AsRef<str>) {
        let _ = writeln!(self.0, "{}", text.as_ref().trim_end());
    }

    /// The heading of a section.
    pub fn heading(&mut self, text: &str) {
        let _ = writeln!(self.0, "\n## {text}\n");
    }

    /// What this is about.
    pub fn opening(&mut self) {
        self.line(
            "Zhi, Wang, Sun 2014 (J. Harbin Inst. Technol. 46(8), 102–106): cargo-door lock, theta6 from -50 to 125°,\n\
             ideal and with massless clearance links of length e in all seven hinges. The paper leaves out the layout,\n\
             the centres of mass, the sign of the links and the output step; what we chose, and why, stands in\n\
             validation/lock/SOURCE.md.",
        );
    }

    pub fn facts(&mut self, facts: &[Fact]) {
        self.heading("Singular positions of the ideal lock, beside a calculation with 50 digits");
        self.line(format!(
            "{:34} {:>20} {:>20} {:>11} {:>9}",
            "", "50 digits", "ours", "difference", "allowed"
        ));
        for fact in facts {
            let Fact {
                what,
                reference,
                ours,
                tolerance,
            } = fact;
            let difference = ours - reference;
            self.line(format!(
                "{what:34} {reference:>20} {ours:>20} {difference:>11.1e} {tolerance:>9.0e}"
            ));
        }
        self.line("F12 has no bound at the change point: 117.5° lies 0.0122° beside it.");
    }

    /// The paper's table beside ours, for one choice of centres of mass and hinge order.
    pub fn table(&mut self, runs: &Runs, paper: &Paper) {
        let order = match runs.request.order {
            Order::SixOnThree => "",
            Order::FiveOnThree => "; variant hinge order",
        };
        self.heading(&format!(
            "|deviation from e = 0| over the stroke; centres of mass: {}{order}",
            runs.request.centres.words()
        ));
        let steps: String = STEPS
            .iter()
            .map(|step| format!(" {:>9}", format!("{step}°")))
            .collect();
        let half = |name: &str| format!("{name:>9}{steps}   ");
        self.line(format!("{:17}{}{}", "", half("paper max"), half("mean")));
        let (mut settled, mut unsettled) = (Vec::new(), Vec::new());
        for quantity in Quantity::ALL {
            for (index, radius) in RADII.iter().enumerate() {
                let row = runs.row(index, quantity);
                let name = format!("{} e={radius} um", quantity.symbol());
                let [max, mean] = paper.deviation(index, quantity);
                let mut text = format!("{name:17}");
                let halves = [
                    ("max", max, row.iter().map(|d| d.max).collect::<Vec<f64>>()),
                    ("mean", mean, row.iter().map(|d| d.mean).collect()),
                ];
                for (statistic, printed, ours) in halves {
                    let cells: String = ours
                        .iter()
                        .map(|&value| format!(" {:>9}", short(value)))
                        .collect();
                    let (mark, names) = if settles(&ours) {
                        (" ", &mut settled)
                    } else {
                        ("*", &mut unsettled)
                    };
                    let _ = write!(text, "{printed:>9}{cells}{mark}  ");
                    names.push(format!("{name} {statistic}"));
                }
                self.line(text);
            }
        }
        self.line(format!(
            "* does not converge: the values at the two finest steps differ by more than {:.0} %: {} of 20 rows.",
            100.0 * SETTLED,
            unsettled.len()
        ));
        let (names, what) = if unsettled.len() > settled.len() {
            (settled, "All but: ")
        } else {
            (unsettled, "These: ")
        };
        if !names.is_empty() {
            self.line(format!("  {what}{}.", names.join("; ")));
        }
    }

    /// The files of the figures, and what they leave out.
    pub fn figures(&mut self, figures: &[Drawn]) {
        self.heading("Counterparts of the paper's figures 4 to 8, beside this page");
        for Drawn { file, about } in figures {
            self.line(format!("{file:12} {about}"));
        }
    }

    /// Why rows do not converge.
    pub fn turns(&mut self, turns: &[Vec<Turn>; 7]) {
        self.heading(&format!(
            "Why: where the ideal hinge forces turn by more than {FAST}° per degree of theta6 (outputs 0.1° apart)"
        ));
        for (joint, turns) in JOINTS.iter().zip(turns) {
            let turns = turns.iter().map(|t| {
                format!(
                    "{:.1}° ({}°/°, {} N)",
                    t.theta6,
                    short(t.rate),
                    short(t.force)
                )
            });
            self.line(format!("{joint}: {}", turns.collect::<Vec<_>>().join(", ")));
        }
        self.line(
            "A clearance link turns with its force. Where the force reverses between two outputs, the link turns by up to 180°\n\
             in one step: its angular velocity grows as 1/step, its centripetal acceleration as 1/step², and the model has no\n\
             limit. The forces that follow turn other links, so that at fine steps the disturbance spreads over the stroke.\n\
             Coarse outputs may pass by a reversal, and give moderate numbers.",
        );
    }

    /// Where the largest deviations are.
    pub fn places(&mut self, runs: &Runs) {
        self.heading("Where the largest deviation lies, theta6 in degrees (the paper: near 117.5, F12 near -40)");
        let steps: String = STEPS
            .iter()
            .map(|step| format!(" {:>7}", format!("{step}°")))
            .collect();
        self.line(format!(
            "{:12}{:>10}{steps}{:>14}{steps}",
            "", "e=10 um", "e=100 um"
        ));
        for quantity in Quantity::ALL {
            let half = |radius: usize| -> String {
                runs.row(radius, quantity)
                    .iter()
                    .map(|deviation| format!(" {:>7.1}", deviation.at))
                    .collect()
            };
            self.line(format!(
                "{:22}{}{:14}{}",
                quantity.symbol(),
                half(0),
                "",
                half(1)
            ));
        }
    }

    /// Instants without assembly or fixed point.
    pub fn leftovers(&mut self, runs: &Runs) {
        self.heading(
            "Instants without assembly (left out above), and without a fixed point within 50 passes (last pass kept)",
        );
        for strokes in &runs.clearance {
            for stroke in strokes {
                self.leftover(stroke);
            }
        }
    }

    fn leftover(&mut self, stroke: &Stroke) {
        let name = format!("e={} um, {}°", stroke.request.radius, stroke.request.step);
        let [nothing, last_pass] = [Found::Nothing, Found::LastPass]
            .map(|what| (stroke.count(what), stroke.intervals(what)));
        let all = stroke.found.len();
        self.line(format!(
            "{name:16} no assembly    {:>4} of {all:>4}: {}",
            nothing.0,
            list(&nothing.1)
        ));
        self.line(format!(
            "{:16} no fixed point {:>4} of {all:>4}: {}",
            "",
            last_pass.0,
            list(&last_pass.1)
        ));
    }

    /// The first pass.
    pub fn first_passes(&mut self, passes: &[FirstPass], paper: &Paper) {
        self.heading(&format!(
            "First pass alone (links along the ideal forces, positions from eqs 11 and 12), every {}°",
            first_pass::STEP
        ));
        for pass in passes {
            let sign = match pass.sign {
                Sign::Pressing => "journal where it presses",
                Sign::Opposite => "opposite sign",
            };
            self.line(format!(
                "e={:3} um, {sign:24} no assembly: {}",
                pass.radius,
                list(&pass.gaps())
            ));
            if pass.sign == Sign::Pressing {
                let radius = RADII
                    .iter()
                    .position(|radius| *radius == pass.radius)
                    .unwrap_or_default();
                let [max, mean] = paper.deviation(radius, Quantity::Theta2);
                let ours = pass.statistics(2.5);
                self.line(format!(
                    "    |change of theta2| at 117.5°: {:.4} rad; over outputs 2.5° apart max {:.4}, mean {:.4} (paper {max}, {mean})",
                    pass.at(117.5),
                    ours[0],
                    ours[1]
                ));
            }
        }
        self.line(
            "At 117.5° the branch with clearance bends sharply: its accelerations turn the forces of loop 1, and with them all\n\
             links, round. With the links there, the lock has no assembly (opposite sign, above): the procedure ends\n\
             there without a solution.",
        );
    }

    /// F12 of the ideal lock near −40°: the map over all choices of centres of mass, and some of them in more detail.
    pub fn forces(&mut self, map: &[ForceNear]) {
        self.heading(&format!(
            "F12 of the ideal lock clear of the change point (theta6 up to {CLEAR}°), by centres of mass"
        ));
        self.line(format!(
            "Largest turn of the direction of F12 within {NEAR}° of -40° by its median, and theta6 of the least |F12|. Rows: centre\n\
             of mass of link 3, columns: of link 4, at the mean of the three joints, the middle of a side or a joint. The paper\n\
             gives none of them. * marks an abrupt change near -40° ({ABRUPT} times the median, of the direction or the vector)."
        ));
        let columns = Centre::ALL.map(|centre| format!(" {:>14}", Ternary::Link4.symbol(centre)));
        self.line(format!("{:5}{}", "", columns.concat()));
        for link3 in Centre::ALL {
            let row = map.iter().filter(|near| near.centres.link3 == link3);
            let cells = row.map(|near| {
                let mark = if near.abrupt() { "*" } else { " " };
                format!(
                    " {:>5.1}{mark}{:>8}",
                    near.turn_near,
                    format!("{:.1}°", near.least[1])
                )
            });
            self.line(format!(
                "{:5}{}",
                Ternary::Link3.symbol(link3),
                cells.collect::<String>()
            ));
        }
        let [near, anywhere] = [
            map.iter().filter(|near| near.abrupt()).count(),
            map.iter().filter(|near| near.turn_most >= ABRUPT).count(),
        ];
        self.line(format!(
            "{near} of {} choices change abruptly near -40°, {anywhere} somewhere up to {CLEAR}°: where it is follows from the centres of mass.\n",
            map.len()
        ));
        self.line(format!(
            "{:40} {:>9} {:>17} {:>20} {:>27}",
            "centres of mass", "at -40°", "least", "fastest turn", "near -40° by the median"
        ));
        for near in map
            .iter()
            .filter(|near| near.abrupt() || Centres::TABLES.contains(&near.centres))
        {
            let least = format!("{:.2} N at {:.1}°", near.least[0], near.least[1]);
            let turn = format!("{:.1}°/° at {:.1}°", near.turn[0], near.turn[1]);
            let ratio = format!("change {:.1}, turn {:.2}", near.change, near.turn_near);
            let there = format!("{:.2} N", near.there);
            self.line(format!(
                "{:40} {there:>9} {least:>17} {turn:>20} {ratio:>27}",
                near.centres.words()
            ));
        }
    }

    /// The other hinge order.
    pub fn variant(&mut self, base: &Stroke, variant: &Stroke, angles: f64) {
        self.heading(
            "Variant hinge order: link 5 on link 3 at f, link 6 on link 4 at d (ideal hinges)",
        );
        self.line(format!(
            "largest difference of any link angle: {angles:.1e} rad (the vector sum is the same); the forces differ:"
        ));
        let header: String = ["M_d [N*m]", "variant", "F12 [N]", "variant"]
            .map(|name| format!(" {name:>12}"))
            .concat();
        self.line(format!("{:>10}{header}", "theta6"));
        for theta6 in [-50.0, -40.0, 0.0, 50.0, 100.0, 110.0, 117.5, 125.0] {
            let Some(row) = base.theta6.iter().position(|at| (at - theta6).abs() < 1e-6) else {
                continue;
            };
            let cell =
                |stroke: &Stroke, quantity| format!(" {:>12}", short(stroke.curve(quantity)[row]));
            let cells =
                [Quantity::Torque, Quantity::Force].map(|q| cell(base, q) + &cell(variant, q));
            self.line(format!("{:>10}{}", format!("{theta6}°"), cells.concat()));
        }
    }
}

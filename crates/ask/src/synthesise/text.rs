//! The linkages in words.

use super::front::{Ranked, WORSE};
use super::problem::{Goal, LinkageTask};
use super::search::SearchCounts;
use super::{Synthesised, Tried};
use crate::text::{Page, Side, Table, count, number};

const DIGITS: usize = 4;

impl Synthesised {
    /// The linkages in words.
    pub fn text(&self) -> Page {
        let mut page = Page::default();
        let wanted = &self.problem.wanted;
        let what = match self.problem.goal {
            Goal::Path => count(wanted.len(), "point"),
            Goal::Motion => count(wanted.len(), "position"),
            Goal::Function => count(wanted.len(), "pair") + " of angles",
        };
        let found = match self.count() {
            0 => "no linkage".to_owned(),
            several => count(several, "linkage"),
        };
        page.line(format!("{}: {found} for {what}", self.file.name()));
        for own in &self.tried {
            page.rows(&own.kind.replace('_', "-"), own.lines(&self.problem));
        }
        if self.is_stopped {
            page.row("interrupted", "what was found until then");
        }
        page.rows("linkages", self.table());
        page.rows("left out", self.left_out());
        page
    }

    /// Good ones that are not listed.
    pub(super) fn left_out(&self) -> Option<String> {
        let Ranked {
            further_off, more, ..
        } = self.ranked;
        let further = format!("{further_off} more than {WORSE} times as far off as the nearest");
        let beyond = format!("{more} beyond the number that \"most\" keeps");
        let all = [(further_off, further), (more, beyond)];
        let some = all.into_iter().filter(|(count, _)| *count > 0);
        let some: Vec<String> = some.map(|(_, words)| words).collect();
        (!some.is_empty()).then(|| some.join("; "))
    }

    /// A row for each.
    fn table(&self) -> Vec<String> {
        if self.ranked.designs.is_empty() {
            return Vec::new();
        }
        let display = &self.problem.display;
        let heads = [
            "",
            "kind",
            "front",
            "off by",
            "transmission",
            "size",
            "spread",
            "effort",
            "crank",
        ];
        let mut table = Table::new(2, heads.map(|head| (Side::Left, head.len())));
        table.row(heads);
        for (own, row) in self.ranked.designs.iter().zip(1..) {
            let off = own.off.map(|off| display.length_to(off, 2));
            let off_angle = own.off_angle.map(|off| display.angle_to(off, 2));
            let off: Vec<String> = off.into_iter().chain(off_angle).collect();
            let spread = match self.problem.goal {
                Goal::Function => format!("{} mrad/mm", number(own.spread[1], 3)),
                Goal::Path | Goal::Motion => number(own.spread[0], 3),
            };
            table.row([
                row.to_string(),
                own.kind.replace('_', "-"),
                own.front.to_string(),
                off.join(", "),
                own.transmission
                    .map_or("–".into(), |angle| display.angle_to(angle, DIGITS)),
                display.length_to(own.size, DIGITS),
                spread,
                own.effort.map_or("–".into(), |effort| {
                    format!("{} N·m", number(effort, DIGITS))
                }),
                if own.turns_fully {
                    "turns fully".to_owned()
                } else {
                    "swings".to_owned()
                },
            ]);
        }
        table.lines().collect()
    }
}

impl Tried {
    /// How candidates of a kind fared.
    pub(super) fn lines(&self, task: &LinkageTask) -> Vec<String> {
        let mut lines = match &self.searched {
            Some(own) => searched(own, &self.method, task),
            None => vec![self.method.clone()],
        };
        lines.extend(self.notes.clone());
        let without = [
            (self.outside, "outside the limits"),
            (self.order, "in another order"),
            (self.circuit, "on several circuits"),
            (self.branch, "get stuck on the way"),
            (self.transmission, "with a smaller angle of transmission"),
            (self.broken.0, "do not run"),
        ];
        let without: Vec<String> = without
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, words)| format!("{count} {words}"))
            .collect();
        let of = match self.candidates {
            0 => "no candidate".to_owned(),
            several => format!("{} of {} are good", self.good, count(several, "candidate")),
        };
        lines.push(match without.is_empty() {
            true => of,
            false => format!("{of}; {}", without.join(", ")),
        });
        lines.extend(
            self.broken
                .1
                .iter()
                .map(|why| format!("does not run: {why}")),
        );
        lines
    }
}

/// What searches came to.
fn searched(own: &SearchCounts, method: &str, task: &LinkageTask) -> Vec<String> {
    let starts = format!("{method} from {}", count(own.starts as usize, "start"));
    let starts = match own.choices {
        1 => starts,
        choices => format!("{starts}, of {choices} choices of crank and output"),
    };
    let came = match (own.minima, own.exact) {
        (0, _) => "none came to a motion through all positions".to_owned(),
        (minima, 0) => {
            let left = match task.goal {
                Goal::Function => task.display.angle_to(own.best, 3),
                // Two components to a distance.
                Goal::Path | Goal::Motion => {
                    let distance = std::f64::consts::SQRT_2 * own.best * task.size;
                    task.display.length_to(distance, 3)
                }
            };
            format!("{minima} came to a minimum; the best is {left} off, root mean square")
        }
        (_, exact) => format!("{exact} came to linkages that pass all positions exactly"),
    };
    vec![starts, came]
}

//! Assemblies and circuits in words.

use super::grashof::turning;
use super::{AssembliesFound, CircuitsFound};
use crate::text::{Page, Side, Table, count, number};
use linkdyn_engine::analysis::{FoundCircuit, Turning};
use linkdyn_engine::element::Measure;

const DIGITS: usize = 6;
/// Rows of the table of poses.
const MOST_ROWS: usize = 60;

impl AssembliesFound {
    /// The assemblies in words.
    pub fn text(&self) -> Page {
        let found = &self.found;
        let mut page = Page::default();
        let all = match found.doubts.is_empty() {
            true => String::new(),
            false => "at least ".to_owned(),
        };
        page.line(format!(
            "{} ({}): {all}{}",
            self.file.name(),
            self.file.label(),
            match found.found.len() {
                0 => "no assembly".to_owned(),
                1 => "1 assembly".to_owned(),
                several => format!("{several} assemblies"),
            }
        ));
        let drivers = found.drivers.iter();
        let drivers = drivers.map(|(name, value)| format!("{name} at {}", number(*value, DIGITS)));
        page.rows("drivers", drivers);
        page.rows(
            "held",
            found
                .held
                .iter()
                .map(|name| format!("{name}, which nothing determines, as it is drawn")),
        );
        page.rows(
            "groups",
            found.groups.iter().map(|group| {
                let bodies = group.bodies.join(", ");
                match group.loops {
                    None if found.doubts.is_empty() => bodies,
                    None => format!("{bodies}: searched from many starts"),
                    Some(0) => bodies,
                    Some(loops) => format!(
                        "{bodies}: {}, {} in complex numbers of {} at most",
                        count(loops, "loop"),
                        count(group.complex, "place"),
                        group.paths
                    ),
                }
            }),
        );
        page.rows("assemblies", self.table().lines());
        page.rows("doubts", &found.doubts);
        page.rows("notes", &found.notes);
        page
    }

    fn table(&self) -> Table {
        let found = &self.found;
        let width = found.bodies.iter().map(|name| name.chars().count()).max();
        let widths = [5, width.unwrap_or(4) + 2, 14, 14, 14, 0];
        let mut table = Table::new(0, widths.map(|width| (Side::Left, width)));
        table.row(["", "body", "x [m]", "y [m]", "angle [rad]", ""]);
        let rows = found.found.iter().zip(1..).flat_map(|(one, number)| {
            let poses = found.bodies.iter().zip(&one.poses).enumerate();
            poses.map(move |(body, (name, pose))| (one, number, body, name, pose))
        });
        for (one, own, body, name, pose) in rows.take(MOST_ROWS) {
            let [x, y, angle] = pose.map(|value| number(value, DIGITS));
            let (label, remark) = match body {
                0 => (own.to_string(), self.remark(one.is_drawn, one.is_proven)),
                _ => (String::new(), String::new()),
            };
            table.row([label.as_str(), name, &x, &y, &angle, &remark]);
        }
        table
    }

    /// What is to be said of an assembly.
    pub(super) fn remark(&self, is_drawn: bool, is_proven: bool) -> String {
        let words = [
            is_drawn.then_some("as drawn"),
            (!is_proven).then_some("not proven to be isolated"),
        ];
        words.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

impl CircuitsFound {
    /// The unit of the driver's values in files.
    pub(super) fn unit(&self) -> &'static str {
        match self.found.driver.1 {
            Measure::Angle => "rad",
            Measure::Length => "m",
        }
    }

    /// A value of the driver, as it is told.
    pub(super) fn value(&self, value: f64) -> String {
        match self.found.driver.1 {
            Measure::Angle => format!("{}°", number(value.to_degrees(), DIGITS)),
            Measure::Length => format!("{} m", number(value, DIGITS)),
        }
    }

    /// The circuits in words.
    pub fn text(&self) -> Page {
        let found = &self.found;
        let mut page = Page::default();
        let at_least = match found.doubts.is_empty() {
            true => "",
            false => "at least ",
        };
        page.line(format!(
            "{} ({}): {at_least}{} of driver {}",
            self.file.name(),
            self.file.label(),
            count(found.circuits.len(), "circuit"),
            found.driver.0
        ));
        let (least, most) = (found.counts.iter().min(), found.counts.iter().max());
        page.row(
            "assemblies",
            format!(
                "{} to {} at {} values from {} to {}",
                least.copied().unwrap_or_default(),
                most.copied().unwrap_or_default(),
                found.values.len(),
                self.value(found.values[0]),
                self.value(found.values[found.values.len() - 1])
            ),
        );
        if let Some(own) = self.four_bar {
            page.row("four-bar", own.class.words());
        }
        let circuits = found.circuits.iter().zip(1..);
        page.rows(
            "circuits",
            circuits.flat_map(|(one, number)| self.told(one, number)),
        );
        page.rows("doubts", &found.doubts);
        page
    }

    /// A circuit in words.
    pub(super) fn told(&self, one: &FoundCircuit, number: usize) -> Vec<String> {
        let drawn = if one.is_drawn {
            ", the one that is drawn"
        } else {
            ""
        };
        let changes = one
            .turnings
            .iter()
            .filter(|(kind, ..)| *kind == Turning::ChangePoint);
        let mut lines = Vec::new();
        if one.turns_fully() {
            lines.push(format!("{number}: the driver turns fully{drawn}"));
        } else {
            lines.push(format!(
                "{number}: {}{drawn}",
                count(one.branches().len(), "branch").replace("branchs", "branches")
            ));
            for [low, high] in one.branches() {
                lines.push(format!(
                    "   from {} to {}",
                    self.value(low),
                    self.value(high)
                ));
            }
        }
        let turning = turning(one).into_iter();
        let turning: Vec<&str> = turning.map(|body| &self.found.bodies[body][..]).collect();
        if !turning.is_empty() {
            lines.push(format!("   turning fully: {}", turning.join(", ")));
        }
        for (_, value, _) in changes {
            lines.push(format!(
                "   change point at {}: branches cross",
                self.value(*value)
            ));
        }
        if one.turnings.iter().any(|(kind, ..)| *kind == Turning::Lost) {
            lines.push("   it can't be followed any further at an end".into());
        }
        lines
    }
}

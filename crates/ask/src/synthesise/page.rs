//! The page: each linkage in motion, with what is wanted of it.

use super::Synthesised;
use super::judged::{FoundLinkage, read};
use crate::shape::with_profiles;
use linkdyn_picture::poses::{Pose, Poses, global};
use linkdyn_picture::{Fault, Mechanism, MovingMechanism, Shape, films_page};

/// Pictures of a motion, at most.
const MOST_ROWS: usize = 64;

impl Synthesised {
    /// The page; `None` if there is no linkage.
    ///
    /// # Errors
    /// When a linkage can't be drawn.
    pub fn html(&self) -> Option<Result<String, Fault>> {
        if self.ranked.designs.is_empty() {
            return None;
        }
        let words = self.text().to_string();
        let mut lines = words.lines();
        let mut facts: Vec<String> = lines.next().map(str::to_owned).into_iter().collect();
        if self.is_stopped {
            facts.push("interrupted: what was found until then".into());
        }
        facts.extend(self.left_out().map(|left| format!("left out: {left}")));
        let found = self.tried.iter().flat_map(|own| {
            let kind = own.kind.replace('_', "-");
            let lines = own.lines(&self.problem).into_iter();
            lines.map(move |line| format!("{kind}: {line}"))
        });
        let found: Vec<String> = found.collect();
        let films: Option<Vec<Result<MovingMechanism, Fault>>> = self
            .ranked
            .designs
            .iter()
            .zip(1..)
            .map(|(design, number)| self.film(design, number))
            .collect();
        let films: Result<Vec<MovingMechanism>, Fault> = films?.into_iter().collect();
        let title = format!("{}: linkages", self.file.name());
        Some(films.map(|films| films_page(&title, &facts, &films, ("How they were found", &found))))
    }

    fn film(&self, design: &FoundLinkage, number: usize) -> Option<Result<MovingMechanism, Fault>> {
        let file = read(&design.model)?;
        let (times, poses) = design.motion.as_ref()?;
        let shape = with_profiles(file.model());
        let bodies = shape.bodies.len() - 1;
        let step = times.len().div_ceil(MOST_ROWS).max(1);
        let row = |row: usize| -> Vec<Pose> {
            let own = poses[3 * bodies * row..3 * bodies * (row + 1)].chunks_exact(3);
            let own = own.map(|own| [own[0], own[1], own[2]]);
            std::iter::once([0.0; 3]).chain(own).collect()
        };
        let rows: Vec<Vec<Pose>> = (0..times.len()).step_by(step).map(row).collect();
        // Of all instants, so that narrow turns of the path are seen.
        let path = (0..times.len()).filter_map(|at| place(&shape, &row(at), &design.point));
        let path = path.collect();
        let display = &self.problem.display;
        let mut texts = vec![format!("{number}: {}", design.kind.replace('_', "-"))];
        let off = |off: f64| format!("off by {} at most", display.length_to(off, 2));
        texts.extend(design.off.map(off));
        let angle = |off: f64| format!("its angle by {}", display.angle_to(off, 2));
        texts.extend(design.off_angle.map(angle));
        texts.extend(
            design
                .transmission
                .map(|angle| format!("transmission {} at least", display.angle_to(angle, 4))),
        );
        texts.push(format!("size {}", display.length_to(design.size, 4)));
        texts.push(format!(
            "spread {}",
            crate::text::number(design.spread[0], 3)
        ));
        texts.extend(
            design
                .effort
                .map(|effort| format!("effort {} N·m", crate::text::number(effort, 4))),
        );
        if design.front == 1 {
            texts.push("no other one is better in everything".into());
        }
        let marks = self.problem.wanted.iter().filter_map(|own| own.point);
        let film = Mechanism::new(shape, Poses::of(&rows)).map(|mechanism| MovingMechanism {
            texts,
            mechanism,
            rows: rows.len(),
            path,
            marks: marks.map(|at| [at.re, at.im]).collect(),
        });
        Some(film)
    }
}

/// Where a point of a body is, `coupler.P`.
fn place(shape: &Shape, poses: &[Pose], point: &str) -> Option<[f64; 2]> {
    let (body, point) = point.split_once('.')?;
    let number = shape.bodies.iter().position(|own| own.name == body)?;
    let mut points = shape.bodies[number].points.iter();
    let (_, x, y) = points.find(|(name, ..)| name == point)?;
    Some(global(poses[number], [*x, *y]))
}

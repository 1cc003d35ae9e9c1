//! Pages: each assembly drawn; the driver's value against the angles of bodies, a curve for each circuit.

use super::{AssembliesFound, CircuitsFound};
use crate::ModelFile;
use crate::shape::with_profiles;
use crate::text::Page;
use linkdyn_engine::analysis::FoundCircuit;
use linkdyn_engine::element::Measure;
use linkdyn_picture::charts_page::scenes_page;
use linkdyn_picture::poses::{Pose, Poses};
use linkdyn_picture::{Axis, Chart, Curve, Fault, Mechanism, Panel, Scene};
use std::f64::consts::TAU;

/// Width of a drawing \[pt\], and width and height of a figure \[mm\].
const WIDTH: f64 = 220.0;
const SIZE: [f64; 2] = [110.0, 70.0];
/// Drawings of assemblies, and figures of bodies, at most.
const MOST_DRAWN: usize = 64;
const MOST_BODIES: usize = 12;

impl AssembliesFound {
    /// The page; `None` if there is no assembly.
    ///
    /// # Errors
    /// When an assembly can't be drawn.
    pub fn html(&self) -> Option<Result<String, Fault>> {
        let found = &self.found;
        if found.found.is_empty() {
            return None;
        }
        let poses = found
            .found
            .iter()
            .take(MOST_DRAWN)
            .map(|one| &one.poses[..]);
        let scenes = drawn(&self.file, &found.bodies, poses);
        let captions = found.found.iter().zip(1..).map(|(one, number)| {
            match self.remark(one.is_drawn, one.is_proven) {
                remark if remark.is_empty() => format!("{number}"),
                remark => format!("{number}: {remark}"),
            }
        });
        let facts = facts(&self.text(), [&found.doubts, &found.notes]);
        let title = format!("{}: assemblies", self.file.name());
        Some(
            scenes.map(|scenes| {
                scenes_page(&title, &facts, &captions.zip(scenes).collect::<Vec<_>>())
            }),
        )
    }
}

/// The first line, and what is to be known.
fn facts(page: &Page, more: [&[String]; 2]) -> Vec<String> {
    let words = page.to_string();
    let first = words.lines().take(1).map(str::to_owned);
    first.chain(more.concat()).collect()
}

/// Drawings of positions of the moving bodies, all to one scale.
fn drawn<'a>(
    file: &ModelFile,
    names: &[String],
    poses: impl Iterator<Item = &'a [[f64; 3]]>,
) -> Result<Vec<Scene>, Fault> {
    let shape = with_profiles(file.model());
    let places: Vec<Option<usize>> = shape
        .bodies
        .iter()
        .map(|body| names.iter().position(|name| *name == body.name))
        .collect();
    let row = |poses: &[[f64; 3]]| -> Vec<Pose> {
        places
            .iter()
            .map(|place| place.map_or([0.0; 3], |place| poses[place]))
            .collect()
    };
    let rows: Vec<Vec<Pose>> = poses.map(row).collect();
    let mechanism = Mechanism::new(shape, Poses::of(&rows))?;
    Ok((0..rows.len())
        .map(|k| mechanism.plain(k as f64, WIDTH, None))
        .collect())
}

impl CircuitsFound {
    /// The page; `None` if there is no circuit.
    ///
    /// # Errors
    /// When a figure can't be drawn.
    pub fn html(&self) -> Option<Result<String, Fault>> {
        if self.found.circuits.is_empty() {
            return None;
        }
        Some(self.page())
    }

    fn page(&self) -> Result<String, Fault> {
        let found = &self.found;
        let mut figures = Vec::new();
        for (body, name) in found.bodies.iter().enumerate().take(MOST_BODIES) {
            figures.push((format!("angle of {name}"), self.angles(body)?));
        }
        let firsts = found
            .circuits
            .iter()
            .filter_map(|circuit| circuit.course.first());
        let scenes = drawn(
            &self.file,
            &found.bodies,
            firsts.map(|(_, poses)| &poses[..]),
        )?;
        let captions = found
            .circuits
            .iter()
            .zip(1..)
            .map(|(circuit, number)| self.told(circuit, number).join("; "));
        figures.extend(captions.zip(scenes));
        let facts = facts(&self.text(), [&found.doubts, &[]]);
        let title = format!("{}: circuits", self.file.name());
        Ok(scenes_page(&title, &facts, &figures))
    }

    /// The figure of the last body whose angle changes; `None` if there is no circuit, or none changes.
    pub fn map(&self) -> Option<Result<(String, Scene), Fault>> {
        let found = &self.found;
        let course = &found.circuits.first()?.course;
        // Neither one that stands still, nor one that turns with the driver.
        let changes = |body: &usize| {
            let varies = |with: f64| {
                let angles = course.iter();
                let angles = angles.map(|(value, poses)| poses[*body][2] - with * value);
                let first = course[0].1[*body][2] - with * course[0].0;
                angles.into_iter().any(|angle| {
                    let by = angle - first;
                    (by - TAU * (by / TAU).round()).abs() > 1e-6
                })
            };
            varies(0.0) && varies(1.0)
        };
        let body = (0..found.bodies.len()).rev().find(changes)?;
        let told = found
            .circuits
            .iter()
            .zip(1..)
            .map(|(circuit, number)| self.told(circuit, number).join("; "));
        let words = format!(
            "Circuits over {}: {}",
            found.driver.0,
            told.collect::<Vec<_>>().join(". ")
        );
        Some(self.angles(body).map(|scene| (words, scene)))
    }

    /// A body's angle over the driver's value, a curve for each circuit.
    fn angles(&self, body: usize) -> Result<Scene, Fault> {
        let found = &self.found;
        let curves = found.circuits.iter().zip(1..);
        let curves = curves.map(|(circuit, number)| self.curve(circuit, number, body));
        let unit = match found.driver.1 {
            Measure::Angle => "deg",
            Measure::Length => "m",
        };
        let panel = Panel {
            axis: Axis::new(format!("{}.angle", found.bodies[body]), "deg"),
            curves: curves.collect(),
        };
        let chart = Chart {
            x: Axis::new(found.driver.0.clone(), unit),
            panels: vec![panel],
            size_mm: SIZE.map(Some),
            ..Chart::default()
        };
        chart.draw()
    }

    /// A body's angle over the driver's value, within one turn of both.
    fn curve(&self, circuit: &FoundCircuit, number: usize, body: usize) -> Curve {
        let first = self.found.values.first().copied().unwrap_or_default();
        let is_angle = self.found.driver.1 == Measure::Angle;
        let (mut x, mut y): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
        for (value, poses) in &circuit.course {
            let at = match is_angle {
                true => (value - first).to_degrees().rem_euclid(360.0) + first.to_degrees(),
                false => *value,
            };
            let angle = (poses[body][2].to_degrees() + 180.0).rem_euclid(360.0) - 180.0;
            // Where a turn ends the curve begins anew.
            if let (Some(last_x), Some(last_y)) = (x.last(), y.last())
                && ((at - last_x).abs() > 180.0 && is_angle || (angle - last_y).abs() > 180.0)
            {
                x.push(at);
                y.push(f64::NAN);
            }
            x.push(at);
            y.push(angle);
        }
        Curve::new(format!("circuit {number}"), x, y)
    }
}

//! One pose without words, and where its parts are on the page: for pages that say the words themselves.

use super::moving::Mechanism;
use super::parts::on_page;
use super::view::View;
use crate::fault::Fault;
use crate::palette::CURVES;
use crate::poses::Poses;
use crate::scene::{Ink, Pen, Place, Scene};
use crate::shape::{JointKind, PointId, Shape};

/// Places and names in a drawing.
#[derive(Debug, Clone, Default)]
pub struct Marks {
    /// Middle of each body, the ground left out, with its name.
    pub body_names: Vec<(String, Place)>,
    /// Points of each body, the ground first.
    pub points: Vec<Vec<Place>>,
    /// Names of the joints.
    pub joint_names: Vec<String>,
    /// Both points of each joint.
    pub joints: Vec<[Place; 2]>,
    /// Whether a joint holds its points together.
    pub holds: Vec<bool>,
}

impl Mechanism {
    /// A mechanism in small motions about a position. What is small of second order opens its pins a little, and is not drawn.
    ///
    /// # Errors
    /// When the extent is no number that a picture can have.
    pub fn of_small_motion(shape: Shape, poses: Poses) -> Result<Self, Fault> {
        let mut mechanism = Mechanism::new(shape, poses)?;
        mechanism.pins_are_whole = true;
        Ok(mechanism)
    }

    /// One pose on a page of that width \[pt\]; a faded one without what acts.
    pub fn plain(&self, time: f64, width: f64, faded: Option<f64>) -> Scene {
        let height = self.frame.height(width);
        let mut scene = Scene::new(width, height);
        let view = View::new(&self.frame, [0.0, 0.0], [width, height]);
        if faded.is_none() {
            self.draw_backdrop(&mut scene, &view, time);
        }
        self.draw_pose(&mut scene, &view, time, faded);
        scene
    }

    /// Draws the way of a point \[m\] in a drawing of that width.
    pub fn trace(&self, scene: &mut Scene, width: f64, path: &[[f64; 2]]) {
        let view = View::new(&self.frame, [0.0, 0.0], [width, self.frame.height(width)]);
        let places: Vec<Place> = path.iter().map(|place| view.place(*place)).collect();
        scene.line("trace", places, Pen::new(Ink::new(CURVES[1]), 0.75));
    }

    /// Marks places \[m\] in a drawing of that width.
    pub fn mark(&self, scene: &mut Scene, width: f64, places: &[[f64; 2]]) {
        let height = self.frame.height(width);
        let view = View::new(&self.frame, [0.0, 0.0], [width, height]);
        let pen = Pen::new(Ink::new(CURVES[2]), 1.0);
        for place in places {
            scene.circle("wanted", view.place(*place), 2.5, None, Some(pen));
        }
    }

    /// Where the parts of the same pose are.
    pub fn marks(&self, time: f64, width: f64) -> Marks {
        let Some(poses) = self.poses.at(time) else {
            return Marks::default();
        };
        let view = View::new(&self.frame, [0.0, 0.0], [width, self.frame.height(width)]);
        let at = |point: PointId| on_page(self, &view, &poses, point);
        let middle = |body: usize| -> Place {
            let points = 0..self.shape.bodies[body].points.len();
            let places: Vec<Place> = points.map(|point| at((body, point))).collect();
            if places.is_empty() {
                return self.body_on_page(&view, &poses, body);
            }
            [0, 1].map(|k| places.iter().map(|at| at[k]).sum::<f64>() / places.len() as f64)
        };
        let bodies = self.shape.bodies.iter().enumerate().skip(1);
        let joints = self.shape.joints.iter();
        let points = |(number, body): (usize, &crate::shape::Body)| {
            (0..body.points.len())
                .map(|point| at((number, point)))
                .collect()
        };
        Marks {
            points: self.shape.bodies.iter().enumerate().map(points).collect(),
            body_names: bodies
                .map(|(number, body)| (body.name.clone(), middle(number)))
                .collect(),
            joint_names: joints.clone().map(|joint| joint.name.clone()).collect(),
            holds: joints
                .clone()
                .map(|joint| {
                    matches!(
                        joint.kind,
                        JointKind::Revolute { .. } | JointKind::Bushing | JointKind::Fixed
                    )
                })
                .collect(),
            joints: joints.map(|joint| joint.between.map(&at)).collect(),
        }
    }
}

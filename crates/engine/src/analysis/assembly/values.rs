//! What is prescribed at the start.

use crate::element::{Constraint, Kinematics};
use crate::system::{Evaluation, Inputs, Origin, System};

/// What is prescribed, and by how much it is off at a position: what is asked less what is there.
pub(super) struct Values {
    /// By driver.
    pub drivers: Vec<f64>,
    /// By initial value.
    pub starts: Vec<f64>,
}

impl Values {
    /// At a position.
    pub fn at(system: &System, q: &[f64], inputs: &Inputs) -> Self {
        let mut evaluation = Evaluation::new(system);
        evaluation.set_position(q);
        let at: Kinematics = evaluation.kinematics(inputs);
        let mut drivers = vec![0.0; system.drivers.len()];
        for block in &system.blocks {
            if let Origin::Driver(id) = block.origin {
                // All drivers' equations say: what is wanted less what is.
                let off = &mut drivers[id.0];
                block.constraint.position(&at, std::slice::from_mut(off));
            }
        }
        let starts = system.starts.iter().map(|start| start.off(&at)).collect();
        Values { drivers, starts }
    }

    /// The farthest of them, as number among drivers and then initial values, and by how much it is off, in rad or sizes.
    pub fn farthest(&self, system: &System) -> Option<(usize, f64)> {
        let drivers = system.drivers.iter().map(|driver| driver.measure);
        let starts = system.starts.iter().map(|start| start.rows()[0]);
        let scales = drivers.chain(starts).map(|m| system.measure_scale(m));
        let off = self.drivers.iter().chain(&self.starts).zip(scales);
        let off = off.map(|(off, scale)| (off / scale).abs()).enumerate();
        off.max_by(|(_, a), (_, b)| a.total_cmp(b))
    }
}

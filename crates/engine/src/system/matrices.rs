//! Matrices that leave the engine, for whoever wants to look at them or compute with them outside.
//!
//! ```text
//! J            (m, n)            rows: joints, then drivers; columns: bodies, see `element::coordinates`
//! K = | M Jᵀ | (n + m, n + m)    the equations of motion, K [a; λ] = [Q; γ]
//!     | J 0  |
//! ```
//!
//! Matrix Market files of them are read by Octave, SciPy, Julia and most solvers (Boisvert, Pozo and Remington 1996).
//! Within the engine matrices are slices of values on fixed patterns.

use super::{Evaluation, Inputs, System};
use sprs::{CsMat, TriMat};
use std::io;

/// The terms of the equations of motion at a state: M a + Jᵀ λ = Q, J a = γ, with J v = −φ_t and φ = 0 where it is legal.
#[derive(Debug, Clone, PartialEq)]
pub struct Terms {
    /// φ (m) [m, rad]
    pub phi: Vec<f64>,
    /// φ_t (m)
    pub rate: Vec<f64>,
    /// γ (m)
    pub gamma: Vec<f64>,
    /// Q (n) [N, N·m]
    pub force: Vec<f64>,
    /// Diagonal of M (n) [kg, kg·m²]
    pub mass: Vec<f64>,
    /// Entries of J: row, column, value.
    pub jacobian: Vec<(usize, usize, f64)>,
}

impl System {
    /// The terms at coordinates and velocities (n) and a time \[s\]. Clearance links are closed, and contacts begin there: what
    /// they would remember of the motion before is not known.
    pub fn terms(&self, q: &[f64], v: &[f64], time: f64) -> Terms {
        let inputs = Inputs::at_time(self, time);
        let mut at = Evaluation::new(self);
        at.set_position(q);
        at.set_velocity(v);
        at.eval_phi(self, &inputs);
        at.eval_jacobian(self, &inputs);
        let (n, m) = (self.n(), self.m());
        let (mut rate, mut gamma, mut force) = (vec![0.0; m], vec![0.0; m], vec![0.0; n]);
        at.eval_rate(self, &inputs, &mut rate);
        at.eval_gamma(self, &inputs, &mut gamma);
        at.eval_force(self, &inputs, &mut force);
        Terms {
            jacobian: self.jacobian_entries(&at).collect(),
            mass: self.mass.diagonal().to_vec(),
            phi: at.phi,
            rate,
            gamma,
            force,
        }
    }

    /// Names of the coordinates (n), as the columns of a run have them.
    pub fn coordinates(&self) -> Vec<String> {
        let mut names = vec![String::new(); self.n()];
        for (body, columns) in self.bodies.iter().zip(self.layout.bodies()) {
            for (place, word) in columns.range().zip(["x", "y", "angle"]) {
                names[place] = format!("{}.{word}", body.name);
            }
        }
        names
    }

    /// The constraint Jacobian J (m × n) [1, m, 1/m …], from the values of an [`Evaluation`].
    pub fn jacobian(&self, evaluation: &Evaluation) -> CsMat<f64> {
        let mut triplets = TriMat::with_capacity((self.m(), self.n()), self.entries.len());
        for (row, column, value) in self.jacobian_entries(evaluation) {
            triplets.add_triplet(row, column, value);
        }
        triplets.to_csr()
    }

    /// The matrix K of the equations of motion, from the values of an [`Evaluation`].
    pub fn equations_of_motion(&self, evaluation: &Evaluation) -> CsMat<f64> {
        let (n, m) = (self.n(), self.m());
        let mut triplets = TriMat::with_capacity((n + m, n + m), n + 2 * self.entries.len());
        for (column, &mass) in self.mass.diagonal().iter().enumerate() {
            triplets.add_triplet(column, column, mass);
        }
        for (row, column, value) in self.jacobian_entries(evaluation) {
            triplets.add_triplet(n + row, column, value);
            triplets.add_triplet(column, n + row, value);
        }
        triplets.to_csr()
    }

    /// Entries of J but those of ground: row, column, value.
    fn jacobian_entries<'a>(
        &'a self,
        evaluation: &'a Evaluation,
    ) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
        let entries = self.entries.iter().zip(&evaluation.jacobian);
        entries.filter_map(|(entry, &value)| {
            let column = entry.column()? as usize;
            Some((entry.row as usize, column, value))
        })
    }
}

/// Writes a matrix as a Matrix Market file, coordinates counted from 1.
///
/// # Errors
/// Those of the writer.
pub fn write_matrix_market(matrix: &CsMat<f64>, to: &mut impl io::Write) -> io::Result<()> {
    sprs::io::write_matrix_market_to_bufwrite(to, matrix)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Inputs;
    use crate::system::compile::compile;
    use linkdyn_model::AnalysisKind;

    const MODEL: &str = r#"{
      "format": "linkdyn/1",
      "units": "SI",
      "bodies": {
        "ground": { "points": { "O": [0, 0] } },
        "crank": { "mass": 2, "inertia": 3, "com": [0.1, 0],
                   "points": { "O": [0, 0], "A": [0.3, 0] } },
        "rod": { "mass": 5, "inertia": 7, "com": [0.2, 0.1], "points": { "A": [0, 0] },
                 "pose": { "position": [0.3, 0], "angle": 0.7 } }
      },
      "joints": {
        "o": { "type": "revolute", "between": ["ground.O", "crank.O"] },
        "a": { "type": "revolute", "between": ["crank.A", "rod.A"] }
      },
      "drivers": {
        "motor": { "type": "rotation", "body": "crank",
                   "motion": { "type": "constant_velocity", "start": 0, "velocity": 5 } }
      },
      "analysis": { "type": "dynamics", "end": 1, "outputs": 3 }
    }"#;

    fn read_back(matrix: &CsMat<f64>) -> CsMat<f64> {
        let mut file = Vec::new();
        write_matrix_market(matrix, &mut file).expect("written to memory");
        let read: TriMat<f64> =
            sprs::io::read_matrix_market_from_bufread(&mut file.as_slice()).expect("read");
        read.to_csr()
    }

    #[test]
    fn matrices_are_read_back_bit_for_bit() {
        let loaded = linkdyn_model::load(MODEL.as_bytes(), &[]).expect("a model");
        let system = compile(&loaded.model, AnalysisKind::Dynamics).expect("a system");
        let inputs = Inputs::at_time(&system, 0.0);
        let mut evaluation = Evaluation::new(&system);
        evaluation.set_position(&system.guess);
        evaluation.eval_jacobian(&system, &inputs);

        let jacobian = system.jacobian(&evaluation);
        assert_eq!(jacobian.shape(), (5, 6));
        assert_eq!(read_back(&jacobian), jacobian);

        let equations = system.equations_of_motion(&evaluation);
        let read = read_back(&equations);
        assert_eq!(read, equations);
        assert_eq!(read.transpose_view().to_csr(), equations);
        for (value, (row, column)) in &jacobian {
            assert_eq!(read.get(6 + row, column), Some(value));
        }
        let diagonal: Vec<f64> = (0..6).filter_map(|k| read.get(k, k).copied()).collect();
        assert_eq!(diagonal, [2.0, 2.0, 3.0, 5.0, 5.0, 7.0]);
    }
}

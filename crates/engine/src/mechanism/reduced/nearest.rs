//! Accelerations as the nearest ones to free motion that the constraints allow, where all that moves has mass.
//!
//! ```text
//! z = M^½ a,  B = R⁻¹ J M^-½:     z nearest to M^-½ Q with B z = R⁻¹ γ
//! ```
//!
//! which is Gauss's principle of least constraint, and the Schur complement J M⁻¹ Jᵀ of M in [M Jᵀ; J 0]. M is diagonal, so that this
//! matrix has entries only where two rows share a body: of a chain two rows a pin, where the whole matrix has five a link. Where rows
//! are weak by it (`linkdyn_linear::gram`) the whole matrix is solved instead.

use crate::mechanism::driven::Driven;
use linkdyn_linear::gram::Gram;

/// The matrix of a choice of rows, and its factors.
#[derive(Clone)]
pub(super) struct Nearest {
    gram: Gram,
    /// The entries of J that it is made of, each with its weight.
    entries: Vec<(u32, f64)>,
    /// M^-½ (n).
    roots: Vec<f64>,
    /// 1/R of each row.
    scales: Vec<f64>,
    z: Vec<f64>,
    c: Vec<f64>,
    /// Whether the factors are those of the point at hand.
    pub is_sound: bool,
}

impl Nearest {
    /// Of active rows of joints and drivers; `None` if something that moves has no mass.
    pub fn of(driven: &Driven, rows: &[u32]) -> Option<Self> {
        let system = driven.system;
        let masses = system.mass.diagonal();
        if !masses.iter().all(|m| *m > 0.0) {
            return None;
        }
        let roots: Vec<f64> = masses.iter().map(|m| 1.0 / m.sqrt()).collect();
        let scales = rows.iter().map(|row| 1.0 / system.row_scale(*row as usize));
        let scales: Vec<f64> = scales.collect();
        let mut own = Vec::new();
        for (owner, entry) in system.entries.iter().enumerate() {
            if let (Some(column), Ok(row)) = (entry.column(), rows.binary_search(&entry.row)) {
                let weight = scales[row] * roots[column as usize];
                own.push(([row as u32, column], (owner as u32, weight)));
            }
        }
        own.sort_by_key(|([_, column], _)| *column);
        let (places, entries): (Vec<_>, Vec<_>) = own.into_iter().unzip();
        Some(Nearest {
            gram: Gram::new([rows.len(), roots.len()], &places),
            entries,
            z: vec![0.0; roots.len()],
            c: vec![0.0; rows.len()],
            roots,
            scales,
            is_sound: false,
        })
    }

    /// Factors of the Jacobian at hand; whether they are sound.
    pub fn factor(&mut self, driven: &Driven) -> bool {
        let jacobian = &driven.evaluation.jacobian;
        let values = self.gram.values_mut().iter_mut();
        for (to, (owner, weight)) in values.zip(&self.entries) {
            *to = jacobian[*owner as usize] * weight;
        }
        self.is_sound = self.gram.factor().is_ok();
        self.is_sound
    }

    /// x (n) nearest to M⁻¹ force, with J x = γ in the rows.
    pub fn solve(&mut self, force: &[f64], gamma: impl Iterator<Item = f64>, x: &mut [f64]) {
        for ((z, force), root) in self.z.iter_mut().zip(force).zip(&self.roots) {
            *z = force * root;
        }
        for ((c, gamma), scale) in self.c.iter_mut().zip(gamma).zip(&self.scales) {
            *c = gamma * scale;
        }
        self.gram.project(&mut self.z, &self.c);
        for ((x, z), root) in x.iter_mut().zip(&self.z).zip(&self.roots) {
            *x = z * root;
        }
    }
}

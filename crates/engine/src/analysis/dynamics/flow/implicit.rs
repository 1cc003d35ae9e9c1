//! The flow as equations that solve an implicit method's systems themselves.
//!
//! Beside (u, u̇) y has sums that f does not depend on: the energy ledger of contacts. Of J their columns are zero, and their rows
//! are left out: an iteration that has (u, u̇) has them in the next.

use super::Flow;
use crate::element::pair::Surface;
use crate::integrate::{Implicit, Refused};

impl Flow<'_> {
    /// Whether the equations solve their systems themselves: without bristles and states, whose rates depend on themselves, and
    /// without journals that stay on rigid bearings.
    pub(super) fn is_implicit(&self) -> bool {
        let contacts = &self.system().contacts;
        let has_bristle = |surface: &Surface| match surface {
            Surface::Compliant(laws) => laws.friction.has_bristle(),
            Surface::Rigid(_) => false,
        };
        self.equations.is_implicit()
            && self.system().states.is_empty()
            && !self.has_sustained()
            && !contacts.iter().any(|contact| has_bristle(&contact.surface))
    }

    fn mechanical(&self) -> usize {
        self.layout.mechanical().end
    }
}

impl Implicit for Flow<'_> {
    fn linearise(&mut self) -> Result<(), Refused> {
        let taken = self.equations.linearise();
        self.refusal = taken.err();
        taken.map_err(|_| Refused)
    }

    fn factor(&mut self, real: f64, complex: &[[f64; 2]]) -> bool {
        self.shifts.clear();
        self.shifts.push([real, 0.0]);
        self.shifts.extend_from_slice(complex);
        self.equations.factor_shifted(real, complex)
    }

    fn solve(&mut self, b: &mut [f64]) {
        let (mechanical, sums) = b.split_at_mut(self.mechanical());
        self.equations.solve_shifted(mechanical);
        let [real, _] = self.shifts[0];
        sums.iter_mut().for_each(|b| *b /= real);
    }

    fn solve_complex(&mut self, number: usize, [re, im]: [&mut [f64]; 2]) {
        let own = self.mechanical();
        let ((re, re_sums), (im, im_sums)) = (re.split_at_mut(own), im.split_at_mut(own));
        self.equations.solve_shifted_complex(number, [re, im]);
        let s = self.shifts[1 + number];
        let square = s[0] * s[0] + s[1] * s[1];
        for (re, im) in re_sums.iter_mut().zip(im_sums) {
            let b = [*re, *im];
            *re = (b[0] * s[0] + b[1] * s[1]) / square;
            *im = (b[1] * s[0] - b[0] * s[1]) / square;
        }
    }

    fn eval_stage(
        &mut self,
        stage: (usize, bool),
        t: f64,
        y: &[f64],
        dy: &mut [f64],
    ) -> Result<(), Refused> {
        let mechanical = &y[self.layout.mechanical()];
        let evaluated = self.equations.evaluate_stage(stage, t, mechanical);
        self.refusal = evaluated.err();
        evaluated.map_err(|_| Refused)?;
        self.eval_rates(t, y, dy);
        Ok(())
    }
}

//! Parameters that follow from each other in a circle.

use super::{Found, Parameters};
use crate::error::Complaint;
use crate::expression::written::Written;
use crate::node::{Node, excerpt};

/// Most parameters of a circle that are named.
const MOST_NAMED: usize = 8;

impl Parameters {
    /// Complains about each circle among those that still wait.
    pub(super) fn circles<'a>(
        &self,
        nodes: &[&'a Node],
        waits: &[usize],
        faults: &mut Vec<Found<'a>>,
    ) {
        // walk number in which one was met
        let mut met = vec![None; waits.len()];
        for start in (0..waits.len()).filter(|&index| waits[index] > 0) {
            let mut walk = Vec::new();
            let mut next = Some(start);
            while let Some(index) = next.filter(|&index| met[index].is_none()) {
                met[index] = Some(start);
                walk.push(index);
                next = match &self.written[index] {
                    Written::Expression(expression) => {
                        expression.parameters().find(|&named| waits[named] > 0)
                    }
                    Written::Value(_) | Written::Faulty => None,
                };
            }
            let Some(closing) = next.filter(|&index| met[index] == Some(start)) else {
                continue;
            };
            let circle: Vec<usize> = walk
                .into_iter()
                .skip_while(|&index| index != closing)
                .collect();
            let mut names: Vec<String> = circle
                .iter()
                .take(MOST_NAMED)
                .map(|&index| excerpt(&self.names[index]))
                .collect();
            if circle.len() > MOST_NAMED {
                names.push("…".into());
            }
            names.push(excerpt(&self.names[closing]));
            let message = format!(
                "the parameters follow from each other in a circle: {}",
                names.join(" → ")
            );
            let complaint = Complaint::new(self.path(closing), message)
                .hint("give one of them a value of its own");
            faults.push(Found {
                node: nodes[closing],
                at: None,
                complaint,
            });
        }
    }
}

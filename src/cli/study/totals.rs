//! What the rows of a study come to, taken in the order of the variants: the same digits whoever computed them.

use super::head::Head;
use linkdyn_study::chunks::Rows;
use linkdyn_study::summary::{
    Bins, EXACT, Histogram, Indices, Limits, Response, Share, SobolIndices, Summary, Tally,
};
use serde::Serialize;

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;
/// All responses together keep so many values for exact quantiles.
const KEPT: usize = 12_000_000;

/// Sums as they grow.
pub struct Totals<'h> {
    head: &'h Head,
    completed: u64,
    within: u64,
    failures: Tally,
    responses: Vec<Response>,
    indices: Vec<SobolIndices>,
    /// Responses of the rows of a point that is not whole yet, by response.
    point: Vec<Vec<f64>>,
}

/// What they come to.
#[derive(Debug, Serialize)]
pub struct Told {
    /// Variants that came to their end, with the interval of the true share.
    pub completed: Option<Share>,
    /// Variants that came to their end and keep all limits.
    pub within_limits: Option<Share>,
    /// How often which reason.
    pub failures: indexmap::IndexMap<String, u64>,
    /// By response.
    pub responses: indexmap::IndexMap<String, OfResponse>,
}

/// What one response comes to [SI].
#[derive(Debug, Serialize)]
pub struct OfResponse {
    pub unit: String,
    pub limits: Limits,
    #[serde(flatten)]
    pub summary: Summary,
    pub histogram: Option<Histogram>,
    /// Of the inputs, in their order.
    pub indices: Option<Indices>,
}

impl<'h> Totals<'h> {
    /// Nothing yet.
    pub fn new(head: &'h Head) -> Self {
        let count = head.responses.len();
        let exact = EXACT.min(KEPT / count.max(1));
        let all = head.responses.iter();
        Totals {
            head,
            completed: 0,
            within: 0,
            failures: Tally::default(),
            responses: all.map(|own| Response::new(own.limits, exact)).collect(),
            indices: match head.rows_per_point {
                Some(_) => vec![SobolIndices::new(head.inputs.len()); count],
                None => Vec::new(),
            },
            point: vec![Vec::new(); count],
        }
    }

    /// Takes the rows after these.
    pub fn take(&mut self, rows: &Rows) {
        for row in rows.iter() {
            match row.reason {
                Some(reason) => self.failures.push(reason),
                None => {
                    self.completed += 1;
                    let mut all = self.head.responses.iter().zip(row.responses);
                    self.within += u64::from(all.all(|(own, x)| own.limits.hold(*x)));
                }
            }
            for (sum, x) in self.responses.iter_mut().zip(row.responses) {
                sum.push(*x);
            }
            self.take_point(row.responses);
        }
    }

    fn take_point(&mut self, values: &[f64]) {
        let Some(rows) = self.head.rows_per_point else {
            return;
        };
        let points = self.point.iter_mut().zip(&mut self.indices);
        for ((point, indices), x) in points.zip(values) {
            point.push(*x);
            if point.len() as u64 == rows {
                indices.push(point);
                point.clear();
            }
        }
    }

    /// What they come to.
    pub fn told(&self) -> Told {
        let total = self.completed + self.failures.total();
        let limited = self.head.responses.iter();
        let is_limited = limited
            .map(|own| own.limits)
            .any(|limits| limits.lower.is_some() || limits.upper.is_some());
        let failures = self.failures.sorted();
        let responses = self.head.responses.iter().zip(&self.responses);
        let of = |(k, (own, sum)): (usize, (&super::head::Asked, &Response))| {
            let told = OfResponse {
                unit: own.unit.clone(),
                limits: own.limits,
                summary: sum.summary(),
                histogram: sum.quantiles().histogram(Bins::FreedmanDiaconis),
                indices: self
                    .indices
                    .get(k)
                    .and_then(|indices| indices.indices(self.head.seed)),
            };
            (own.name.clone(), told)
        };
        Told {
            completed: Share::new(self.completed, total, CONFIDENCE),
            within_limits: is_limited
                .then(|| Share::new(self.within, total, CONFIDENCE))
                .flatten(),
            failures: failures
                .into_iter()
                .map(|(reason, count)| (reason.to_owned(), count))
                .collect(),
            responses: responses.enumerate().map(of).collect(),
        }
    }
}

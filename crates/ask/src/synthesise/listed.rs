//! The kinematic chains of so many bodies, as a list.

use crate::text::{Page, count};
use linkdyn_synthesis::chains::{chains, inversions, name, pins};
use serde::Serialize;

pub use linkdyn_synthesis::chains::MOST_BODIES;

/// A chain.
#[derive(Debug, Clone, Serialize)]
pub struct ListedChain {
    /// Pairs of bodies that are pinned to each other.
    pub pins: Vec<(usize, usize)>,
    /// Bodies that make different mechanisms when they are fixed.
    pub fixed: Vec<Fixed>,
}

/// A mechanism of a chain.
#[derive(Debug, Clone, Serialize)]
pub struct Fixed {
    /// The body that is fixed.
    pub body: usize,
    /// Its name, of four or six bodies: `watt_1`.
    pub name: Option<&'static str>,
}

/// All chains of so many bodies.
#[derive(Debug, Clone, Serialize)]
pub struct ListedChains {
    /// How many bodies.
    pub bodies: usize,
    /// The chains.
    pub chains: Vec<ListedChain>,
}

/// All chains of so many bodies.
pub fn all_chains(bodies: usize) -> ListedChains {
    let one = |chain: &linkdyn_synthesis::chains::Chain| {
        let fixed = inversions(chain).into_iter().map(|body| Fixed {
            body,
            name: name(chain, body),
        });
        ListedChain {
            pins: pins(chain),
            fixed: fixed.collect(),
        }
    };
    ListedChains {
        bodies,
        chains: chains(bodies).iter().map(one).collect(),
    }
}

impl ListedChains {
    /// The chains in words.
    pub fn text(&self) -> Page {
        let mut page = Page::default();
        let mechanisms: usize = self.chains.iter().map(|own| own.fixed.len()).sum();
        page.line(format!(
            "{} of {} bodies, {}",
            count(self.chains.len(), "chain"),
            self.bodies,
            count(mechanisms, "mechanism")
        ));
        for (own, number) in self.chains.iter().zip(1..) {
            let pins = own.pins.iter().map(|(a, b)| format!("{a}-{b}"));
            page.row(&number.to_string(), pins.collect::<Vec<_>>().join(" "));
            let fixed = own.fixed.iter().map(|fixed| match fixed.name {
                Some(name) => format!("{} ({name})", fixed.body),
                None => fixed.body.to_string(),
            });
            page.row(
                "",
                format!("fixed: {}", fixed.collect::<Vec<_>>().join(", ")),
            );
        }
        page
    }
}

//! Where the centres of mass of the ternary links 3 and 4 may lie. The paper prints masses and inertias, but no centre.
//!
//! Tried are the means of one, two or all three joints of a link, for both links apart: 7 × 7 choices.
//!
//! ```text
//! link 3:  mean of b, c, f;  middles of l3 (b–c), l3a (b–f), l3b (c–f);  b, c, f
//! link 4:  mean of g, c, d;  middles of l4 (g–c), l4a (g–d), l4b (c–d);  g, c, d
//! ```

use serde_json::{Value, json};

use super::document::point;
use crate::CaseError;

/// A choice for one link, whose joints are: its first, c, and the one of the second loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Centre {
    /// Mean of the three joints: the bundled model's choice.
    Joints,
    /// Middle of the side in the first loop, b–c and g–c (l3 and l4).
    FirstLoop,
    /// Middle of the longest side, b–f and g–d (l3a and l4a).
    LongSide,
    /// Middle of the side in the second loop, c–f and c–d (l3b and l4b).
    SecondLoop,
    /// Its first joint, b and g.
    AtFirst,
    /// Joint c.
    AtCommon,
    /// The joint of the second loop, f and d.
    AtSecond,
}

impl Centre {
    pub const ALL: [Centre; 7] = [
        Centre::Joints,
        Centre::FirstLoop,
        Centre::LongSide,
        Centre::SecondLoop,
        Centre::AtFirst,
        Centre::AtCommon,
        Centre::AtSecond,
    ];

    /// Which of a link's three joints it is the mean of.
    fn of(self) -> &'static [usize] {
        match self {
            Centre::Joints => &[0, 1, 2],
            Centre::FirstLoop => &[0, 1],
            Centre::LongSide => &[0, 2],
            Centre::SecondLoop => &[1, 2],
            Centre::AtFirst => &[0],
            Centre::AtCommon => &[1],
            Centre::AtSecond => &[2],
        }
    }
}

/// A ternary link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ternary {
    Link3,
    Link4,
}

impl Ternary {
    /// Its name in the model, and those of its joints.
    fn names(self) -> (&'static str, [&'static str; 3]) {
        match self {
            Ternary::Link3 => ("link3", ["b", "c", "f"]),
            Ternary::Link4 => ("link4", ["g", "c", "d"]),
        }
    }

    /// A choice in the paper's symbols: `mean`, `l3a`, `b`.
    pub fn symbol(self, centre: Centre) -> &'static str {
        match (self, centre) {
            (_, Centre::Joints) => "mean",
            (Ternary::Link3, Centre::FirstLoop) => "l3",
            (Ternary::Link3, Centre::LongSide) => "l3a",
            (Ternary::Link3, Centre::SecondLoop) => "l3b",
            (Ternary::Link3, Centre::AtFirst) => "b",
            (Ternary::Link4, Centre::FirstLoop) => "l4",
            (Ternary::Link4, Centre::LongSide) => "l4a",
            (Ternary::Link4, Centre::SecondLoop) => "l4b",
            (Ternary::Link4, Centre::AtFirst) => "g",
            (_, Centre::AtCommon) => "c",
            (Ternary::Link3, Centre::AtSecond) => "f",
            (Ternary::Link4, Centre::AtSecond) => "d",
        }
    }

    /// `middle of l3`, `joint b`.
    fn words(self, centre: Centre) -> String {
        let symbol = self.symbol(centre);
        match centre.of() {
            [_] => format!("joint {symbol}"),
            [_, _] => format!("middle of {symbol}"),
            _ => "the mean".into(),
        }
    }

    /// Puts the centre into the model file.
    fn place(self, centre: Centre, document: &mut Value) -> Result<(), CaseError> {
        let (body, joints) = self.names();
        let mut sum = [0.0; 2];
        for &joint in centre.of() {
            let [x, y] = point(document, body, joints[joint])?;
            sum = [sum[0] + x, sum[1] + y];
        }
        let count = centre.of().len() as f64;
        document["bodies"][body]["com"] = json!([sum[0] / count, sum[1] / count]);
        Ok(())
    }
}

/// The choices for both links; binary links have their centres at mid-length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Centres {
    pub link3: Centre,
    pub link4: Centre,
}

impl Centres {
    /// The bundled model's.
    pub const MODEL: Centres = Centres::alike(Centre::Joints);

    /// Those whose table of deviations is printed.
    pub const TABLES: [Centres; 3] = [
        Centres::MODEL,
        Centres::alike(Centre::FirstLoop),
        Centres::alike(Centre::LongSide),
    ];

    /// The same in both links.
    const fn alike(centre: Centre) -> Self {
        Centres {
            link3: centre,
            link4: centre,
        }
    }

    /// All of them, link 3 slower than link 4.
    pub fn all() -> impl Iterator<Item = Centres> {
        Centre::ALL.into_iter().flat_map(|link3| {
            Centre::ALL
                .into_iter()
                .map(move |link4| Centres { link3, link4 })
        })
    }

    /// In the paper's symbols: `l3, l4a`.
    pub fn symbols(self) -> String {
        format!(
            "{}, {}",
            Ternary::Link3.symbol(self.link3),
            Ternary::Link4.symbol(self.link4)
        )
    }

    /// In words.
    pub fn words(self) -> String {
        if self == Centres::MODEL {
            return "mean of the three joints (the model's)".into();
        }
        let third = Ternary::Link3.words(self.link3);
        match (self.link3.of(), self.link4.of()) {
            ([_, _], [_, _]) => format!("{third} and {}", Ternary::Link4.symbol(self.link4)),
            _ => format!(
                "link 3: {third}, link 4: {}",
                Ternary::Link4.words(self.link4)
            ),
        }
    }

    /// Puts them into the model file; the bundled model's own are left as they are printed.
    ///
    /// # Errors
    /// When the links do not have their joints.
    pub fn place(self, document: &mut Value) -> Result<(), CaseError> {
        for (link, centre) in [(Ternary::Link3, self.link3), (Ternary::Link4, self.link4)] {
            if centre != Centre::Joints {
                link.place(centre, document)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::document::bundled;
    use super::*;

    fn com(document: &Value, body: &str) -> [f64; 2] {
        [0, 1].map(|axis| {
            document["bodies"][body]["com"][axis]
                .as_f64()
                .expect("a number")
        })
    }

    #[test]
    fn the_models_own_centres_are_the_means_of_three_joints() {
        let printed = bundled().expect("bundled");
        let mut placed = printed.clone();
        for (link, body) in [(Ternary::Link3, "link3"), (Ternary::Link4, "link4")] {
            link.place(Centre::Joints, &mut placed)
                .expect("it has its joints");
            let (ours, theirs) = (com(&placed, body), com(&printed, body));
            assert!(
                (0..2).all(|axis| (ours[axis] - theirs[axis]).abs() < 1e-12),
                "{body}: {ours:?}, {theirs:?}"
            );
        }
    }

    #[test]
    fn every_choice_is_another_place() {
        let all: Vec<Centres> = Centres::all().collect();
        assert_eq!(all.len(), 49);
        let places = all.iter().map(|centres| {
            let mut document = bundled().expect("bundled");
            centres.place(&mut document).expect("it has its joints");
            [com(&document, "link3"), com(&document, "link4")]
        });
        let places: Vec<[[f64; 2]; 2]> = places.collect();
        assert!(
            (0..49).all(|a| (0..a).all(|b| places[a] != places[b])),
            "{places:?}"
        );
        // |gd| = 505 mm: the middle of l4a is half as far from g.
        let at = all
            .iter()
            .position(|centres| centres.symbols() == "l3, l4a")
            .expect("one of them");
        let [third, fourth] = places[at];
        assert_eq!(third, [215.0, 0.0]);
        assert!(
            (fourth[0].hypot(fourth[1]) - 252.5).abs() < 1e-9,
            "{fourth:?}"
        );
    }
}

//! A drawing of PMKS+, whatever its link was written in.

use std::collections::HashMap;

use super::super::pins::At;
use crate::source::{LeftOut, MOST_PARTS, Refused};

/// What lengths, masses, inertias and forces are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    /// in, lb, lb·in², lbf.
    Inch,
    /// cm, g, kg·cm², N.
    Centimetre,
    /// m, kg, kg·m², N.
    Metre,
}

impl Units {
    /// The unit of lengths.
    pub fn length(self) -> &'static str {
        match self {
            Units::Inch => "in",
            Units::Centimetre => "cm",
            Units::Metre => "m",
        }
    }
}

/// A pin or a slide.
#[derive(Debug, Clone, PartialEq)]
pub struct Pin {
    pub id: String,
    pub name: String,
    pub at: At,
    pub is_ground: bool,
    pub is_input: bool,
    pub is_welded: bool,
    pub is_traced: bool,
    /// Its own velocity, in rpm or units of length per second; without one that of the drawing.
    pub speed: Option<f64>,
    pub slide: Option<Slot>,
}

/// What a joint slides on.
#[derive(Debug, Clone, PartialEq)]
pub struct Slot {
    /// The direction of a guide on the ground \[rad\].
    pub angle: f64,
    /// Whether what slides may turn.
    pub turns: bool,
    /// Of the block.
    pub mass: f64,
    /// The link that has the slot, and the two of its joints that it goes through.
    pub on: Option<[String; 3]>,
}

/// A rigid link.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    pub id: String,
    pub name: String,
    pub mass: f64,
    pub inertia: f64,
    pub com: At,
    pub joints: Vec<String>,
    /// The links that were welded into this one.
    pub parts: Vec<String>,
    /// Whether it is no part of another.
    pub is_root: bool,
}

/// A force on a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    pub name: String,
    pub link: String,
    pub from: At,
    pub to: At,
    pub magnitude: f64,
    /// Whether it turns with the link.
    pub is_local: bool,
    pub is_outward: bool,
}

/// All of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    pub units: Units,
    pub has_gravity: bool,
    pub is_clockwise: bool,
    /// Of motors \[rpm\].
    pub speed: f64,
    /// Of rams, in units of length per second.
    pub linear_speed: f64,
    pub joints: Vec<Pin>,
    pub links: Vec<Bar>,
    pub loads: Vec<Load>,
    pub left_out: Vec<LeftOut>,
}

/// The speed of a ram where a link says none, in units of length per second.
pub const USUAL_LINEAR_SPEED: f64 = 5.0;

impl Drawing {
    /// Joints and links by their names, which are unique, and all that links and slots name is there.
    ///
    /// # Errors
    /// Where that is not so.
    pub fn checked(&self) -> Result<Index, Refused> {
        let again = |what: &str, id: &str| {
            let cause = format!("there are two {what}s \"{id}\"");
            Refused::new("", cause, "the link is damaged: copy it again")
        };
        if self.joints.len().max(self.links.len()) > MOST_PARTS {
            let most = self.joints.len().max(self.links.len());
            let cause = format!("{most} joints or links are too many for a planar linkage");
            return Err(Refused::new("", cause, format!("{MOST_PARTS} at most")));
        }
        let mut index = Index::default();
        for (at, joint) in self.joints.iter().enumerate() {
            if index.joints.insert(joint.id.clone(), at).is_some() {
                return Err(again("joint", &joint.id));
            }
        }
        for (at, link) in self.links.iter().enumerate() {
            if index.links.insert(link.id.clone(), at).is_some() {
                return Err(again("link", &link.id));
            }
        }
        let lacks = |place: String, what: &str, id: &str| {
            let cause = format!("there is no {what} \"{id}\"");
            Refused::new(place, cause, "the link is damaged: copy it again")
        };
        for link in &self.links {
            for id in &link.joints {
                if !index.joints.contains_key(id) {
                    return Err(lacks(format!("link {}", link.id), "joint", id));
                }
            }
            for id in &link.parts {
                let Some(&part) = index.links.get(id) else {
                    return Err(lacks(format!("link {}", link.id), "link", id));
                };
                index.whole.insert(part, index.links[&link.id]);
            }
        }
        for joint in &self.joints {
            let Some([link, ends @ ..]) = joint.slide.as_ref().and_then(|slide| slide.on.as_ref())
            else {
                continue;
            };
            let place = || format!("joint {}", joint.id);
            if !index.links.contains_key(link) {
                return Err(lacks(place(), "link", link));
            }
            if let Some(id) = ends.iter().find(|id| !index.joints.contains_key(*id)) {
                return Err(lacks(place(), "joint", id));
            }
        }
        for load in &self.loads {
            if !index.links.contains_key(&load.link) {
                return Err(lacks(format!("force {}", load.name), "link", &load.link));
            }
        }
        Ok(index)
    }
}

/// Where joints and links stand.
#[derive(Debug, Clone, Default)]
pub struct Index {
    pub joints: HashMap<String, usize>,
    pub links: HashMap<String, usize>,
    /// The links that are part of another, and which.
    whole: HashMap<usize, usize>,
}

impl Index {
    /// The link of which a link is a part: itself, where it is whole.
    pub fn whole(&self, link: &str) -> usize {
        let mut at = self.links[link];
        // Parts have no parts; a chain of them in a damaged link ends all the same.
        for _ in 0..self.whole.len() {
            match self.whole.get(&at) {
                Some(&next) => at = next,
                None => break,
            }
        }
        at
    }
}

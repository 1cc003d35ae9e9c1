//! How large the face is: what the package `linkdyn` shows without the command, counted from the sources.
//!
//! Counted are modules, functions, constants, types, their public fields and the public methods of their own `impl`s, each once,
//! however often it is exported. Not counted are pages of the guide, which are modules without items, and the modules for the
//! command and the Python package, which are hidden from the documentation. Re-exports are followed into the package and the module
//! that they come from. Variants of enums and their fields are counted separately: they say what values there are, not what can be
//! called.

use std::collections::BTreeSet;
use std::fs;

use syn::{Attribute, Fields, ImplItem, Item};

use super::items::{ALL, attributes, is_hidden, is_public, name, names, visibility};
use super::source::root;
use super::sources::{Place, Sources};

/// What was counted.
#[derive(Debug, Default, PartialEq, Eq)]
struct Face {
    /// `linkdyn_model::Model::check`.
    items: BTreeSet<String>,
    variants: BTreeSet<String>,
    undocumented: BTreeSet<String>,
}

impl Sources {
    /// Counts what a module shows.
    fn count_module(&self, package: &str, module: &[String], face: &mut Face) {
        for item in &self.packages[package][module] {
            if !is_public(visibility(item)) || is_hidden(attributes(item)) {
                continue;
            }
            if let Item::Use(item) = item {
                for (known, target) in names(item) {
                    assert_ne!(known, ALL, "{target:?}: name what is exported, one by one");
                    let place = self.resolve(package, module, &target);
                    let place =
                        place.unwrap_or_else(|| panic!("{known}: {target:?} leads nowhere"));
                    self.count(&place, face);
                }
            } else if let Some(name) = name(item) {
                self.count(&(package.to_string(), module.to_vec(), name), face);
            }
        }
    }

    /// Counts an item with its parts.
    fn count(&self, place: &Place, face: &mut Face) {
        let (package, module, name_of_it) = place;
        let path = [
            std::slice::from_ref(package),
            &module[..],
            std::slice::from_ref(name_of_it),
        ]
        .concat()
        .join("::");
        let items = &self.packages[package][module];
        let is_it = |item: &&Item| name(item).is_some_and(|own| own == *name_of_it);
        for item in items.iter().filter(is_it) {
            if !is_public(visibility(item)) {
                continue;
            }
            let inner = [&module[..], std::slice::from_ref(name_of_it)].concat();
            if let Item::Mod(_) = item
                && self.packages[package][&inner].is_empty()
            {
                // A page of the guide.
                return;
            }
            if !face.note(path.clone(), attributes(item)) {
                return;
            }
            match item {
                Item::Mod(_) => {
                    self.count_module(package, &inner, face);
                }
                Item::Trait(item) => {
                    for part in &item.items {
                        let syn::TraitItem::Fn(part) = part else {
                            continue;
                        };
                        face.note(format!("{path}::{}", part.sig.ident), &part.attrs);
                    }
                }
                Item::Struct(item) => face.fields(&path, &item.fields, false),
                Item::Enum(item) => {
                    for variant in &item.variants {
                        let path = format!("{path}::{}", variant.ident);
                        face.variants.insert(path.clone());
                        face.document(&path, &variant.attrs);
                        face.fields(&path, &variant.fields, true);
                    }
                }
                _ => {}
            }
        }
        self.count_methods(place, &path, face);
    }

    /// Counts public methods and constants of a type's own `impl`s, wherever in its package they stand.
    fn count_methods(&self, place: &Place, path: &str, face: &mut Face) {
        let package = &place.0;
        for (module, items) in &self.packages[package] {
            for item in items {
                let Item::Impl(item) = item else { continue };
                let syn::Type::Path(of) = &*item.self_ty else {
                    continue;
                };
                let segments = of.path.segments.iter();
                let segments: Vec<String> = segments.map(|one| one.ident.to_string()).collect();
                if item.trait_.is_some()
                    || segments.last() != Some(&place.2)
                    || self.resolve(package, module, &segments).as_ref() != Some(place)
                {
                    continue;
                }
                for part in &item.items {
                    let (name, visibility, attributes) = match part {
                        ImplItem::Fn(part) => (&part.sig.ident, &part.vis, &part.attrs),
                        ImplItem::Const(part) => (&part.ident, &part.vis, &part.attrs),
                        _ => continue,
                    };
                    if is_public(visibility) && !is_hidden(attributes) {
                        face.note(format!("{path}::{name}"), attributes);
                    }
                }
            }
        }
    }
}

impl Face {
    /// Takes an item; whether it is new.
    fn note(&mut self, path: String, attributes: &[Attribute]) -> bool {
        self.document(&path, attributes);
        self.items.insert(path)
    }

    fn document(&mut self, path: &str, attributes: &[Attribute]) {
        if !attributes
            .iter()
            .any(|attribute| attribute.path().is_ident("doc"))
        {
            self.undocumented.insert(path.to_string());
        }
    }

    /// Takes public fields; those of variants are all public. Fields without a name say nothing that could be documented.
    fn fields(&mut self, path: &str, fields: &Fields, of_variant: bool) {
        for field in fields
            .iter()
            .filter(|field| of_variant || is_public(&field.vis))
            .filter(|field| !is_hidden(&field.attrs))
        {
            let Some(name) = &field.ident else { continue };
            let path = format!("{path}::{name}");
            self.document(&path, &field.attrs);
            let known = if of_variant {
                &mut self.variants
            } else {
                &mut self.items
            };
            known.insert(path);
        }
    }
}

/// The face of `linkdyn`.
fn face() -> Face {
    let of = |folder: &'static str| {
        move |file: &str| fs::read_to_string(root().join(folder).join(file)).ok()
    };
    let sources = Sources::parse(
        &[
            ("linkdyn", &of("src")),
            ("linkdyn_ask", &of("crates/ask/src")),
            ("linkdyn_engine", &of("crates/engine/src")),
            ("linkdyn_exchange", &of("crates/exchange/src")),
            ("linkdyn_linear", &of("crates/linear/src")),
            ("linkdyn_model", &of("crates/model/src")),
            ("linkdyn_output", &of("crates/output/src")),
            ("linkdyn_picture", &of("crates/picture/src")),
            ("linkdyn_study", &of("crates/study/src")),
            ("linkdyn_variation", &of("crates/variation/src")),
        ],
        is_hidden,
    );
    let mut face = Face::default();
    sources.count_module("linkdyn", &[], &mut face);
    face
}

#[test]
fn the_face_is_counted() {
    let face = face();
    let listed: Vec<&str> = face.items.iter().map(String::as_str).collect();
    println!(
        "{} items, {} variants and their fields",
        listed.len(),
        face.variants.len()
    );
    // What must be there: of the face itself, re-exported, of an own module of another package, fields and methods.
    for known in [
        "linkdyn::mechanism::Mechanism::open",
        "linkdyn::mechanism::Mechanism::run",
        "linkdyn::quantity::mm",
        "linkdyn_model::Model::bodies",
        "linkdyn_model::Model::check",
        "linkdyn_model::joint::Joint::between",
        "linkdyn_engine::analysis::check::found::Check::mobility",
    ] {
        assert!(
            face.items.contains(known),
            "{known} was not found among\n{}",
            listed.join("\n")
        );
    }
}

#[test]
fn the_face_is_documented() {
    assert_eq!(face().undocumented, BTreeSet::new());
}

/// Two packages, of which one shows parts of the other.
#[test]
fn exports_are_followed_and_each_item_counts_once() {
    let front = |file: &str| {
        let text = match file {
            "lib.rs" => {
                "//! Front.\npub mod all; mod own; pub use own::Own; pub use back::{Model as Shown, shape::area};
                 #[cfg(feature = \"command\")] pub mod cli; pub fn free() {}"
            }
            "all.rs" => "//! All of it.\npub use crate::{Own, Shown};",
            "own.rs" => "/// An own one. \npub struct Own { pub size: f64, kept: f64 }",
            _ => return None,
        };
        Some(text.to_string())
    };
    let back = |file: &str| {
        let text = match file {
            "lib.rs" => "mod model; pub mod shape; pub use model::Model; pub struct NotShown;",
            "model.rs" => {
                "mod more; pub struct Model { pub name: String } pub enum Unseen { One }
                 impl Model { pub fn new() {} fn kept() {} pub(crate) fn inner() {} pub const MOST: usize = 1; }
                 impl Clone for Model { fn clone(&self) {} }"
            }
            "model/more.rs" => "use super::Model; impl Model { pub fn more() {} }",
            "shape/mod.rs" => "pub fn area() {} pub fn other() {} pub struct Model; impl Model { pub fn another() {} }",
            _ => return None,
        };
        Some(text.to_string())
    };
    let sources = Sources::parse(&[("front", &front), ("back", &back)], is_hidden);
    let mut face = Face::default();
    sources.count_module("front", &[], &mut face);
    let expected = [
        "back::model::Model",
        "back::model::Model::MOST",
        "back::model::Model::more",
        "back::model::Model::name",
        "back::model::Model::new",
        "back::shape::area",
        "front::all",
        "front::free",
        "front::own::Own",
        "front::own::Own::size",
    ];
    assert_eq!(Vec::from_iter(face.items), expected);
    assert!(!face.undocumented.contains("front::own::Own"));
    assert!(!face.undocumented.contains("front::all"));
    assert!(face.undocumented.contains("front::free"));
}

//! No circles: files that need each other are one file, or one of them holds what belongs into a third.
//!
//! A file needs those whose items its `use` brings, through re-exports to where they are defined. What is only passed on
//! (`pub use`) is not needed. Tests are left out.

use std::collections::BTreeMap;
use std::fs;

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;
use syn::{Attribute, Visibility};

use super::items::{ALL, as_use, attributes, names, visibility};
use super::source::root;
use super::sources::Sources;

/// Packages by the name that `use` knows them by, and their folders.
const PACKAGES: [(&str, &str); 14] = [
    ("linkdyn", "src"),
    ("linkdyn_ask", "crates/ask/src"),
    ("linkdyn_engine", "crates/engine/src"),
    ("linkdyn_exchange", "crates/exchange/src"),
    ("linkdyn_fmi", "crates/fmi/src"),
    ("linkdyn_linear", "crates/linear/src"),
    ("linkdyn_model", "crates/model/src"),
    ("linkdyn_optimise", "crates/optimise/src"),
    ("linkdyn_output", "crates/output/src"),
    ("linkdyn_picture", "crates/picture/src"),
    ("linkdyn_study", "crates/study/src"),
    ("linkdyn_synthesis", "crates/synthesis/src"),
    ("linkdyn_validation", "validation/src"),
    ("linkdyn_variation", "crates/variation/src"),
];

/// Whether a module is only there for tests.
pub fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let list = attribute.meta.require_list();
        attribute.path().is_ident("cfg") && list.is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

/// What files take from each other: of a file, from another one, these names.
type Needs = BTreeMap<String, BTreeMap<String, Vec<String>>>;

fn needs(sources: &Sources) -> Needs {
    let mut needs = Needs::new();
    let path =
        |package: &str, module: &[String]| [&[package.to_string()], module].concat().join("::");
    for (package, modules) in &sources.packages {
        for (module, items) in modules {
            let file = path(package, module);
            let own = items.iter().filter(|item| {
                matches!(visibility(item), Visibility::Inherited) && !is_test(attributes(item))
            });
            for (known, target) in own.filter_map(as_use).flat_map(names) {
                let place = sources.resolve(package, module, &target);
                let Some((of, mut inner, name)) = place else {
                    continue;
                };
                // A module itself, or everything in it.
                let below = [&inner[..], std::slice::from_ref(&name)].concat();
                if known == ALL || sources.packages[&of].contains_key(&below) {
                    inner = below;
                }
                let other = path(&of, &inner);
                if other != file {
                    let taken = needs.entry(file.clone()).or_default().entry(other);
                    taken.or_default().push(known);
                }
            }
        }
    }
    needs
}

/// The circles of files, each as sorted paths of modules.
fn circles(needs: &Needs) -> Vec<Vec<&str>> {
    let mut graph = DiGraphMap::<&str, ()>::new();
    for (file, others) in needs {
        for other in others.keys() {
            graph.add_edge(file, other, ());
        }
    }
    let mut found = tarjan_scc(&graph);
    found.retain(|files| files.len() > 1);
    found.iter_mut().for_each(|files| files.sort());
    found.sort();
    found
}

/// What the files of a circle take from each other, line by line.
fn told(needs: &Needs, circle: &[&str]) -> String {
    let lines = circle.iter().flat_map(|file| {
        let others = needs[*file].iter();
        let within = others.filter(|(other, _)| circle.contains(&other.as_str()));
        within.map(move |(other, names)| format!("{file} needs {other}: {}\n", names.join(", ")))
    });
    lines.collect()
}

/// The sources of all packages.
pub fn parsed() -> Sources {
    let readers = PACKAGES.map(|(name, folder)| {
        (name, move |file: &str| {
            fs::read_to_string(root().join(folder).join(file)).ok()
        })
    });
    let packages: Vec<_> = readers
        .iter()
        .map(|(name, read)| (*name, read as &super::items::File))
        .collect();
    Sources::parse(&packages, is_test)
}

#[test]
fn no_files_need_each_other() {
    let needs = needs(&parsed());
    let found = circles(&needs);
    let told: Vec<String> = found.iter().map(|circle| told(&needs, circle)).collect();
    assert!(
        found.is_empty(),
        "{} circles:\n{}",
        found.len(),
        told.join("\n")
    );
}

#[test]
fn a_circle_through_a_re_export_is_found() {
    let file = |file: &str| {
        let text = match file {
            "lib.rs" => "mod a; mod b; mod c; pub use b::B;",
            "a.rs" => "use crate::B; pub struct A;",
            "b.rs" => "use super::a::A; #[cfg(test)] mod tests { use crate::c::C; } pub struct B;",
            "c.rs" => "use crate::a; pub struct C;",
            _ => return None,
        };
        Some(text.to_string())
    };
    let sources = Sources::parse(&[("own", &file)], is_test);
    let needs = needs(&sources);
    let found = circles(&needs);
    assert_eq!(found, [["own::a", "own::b"]]);
    assert_eq!(
        told(&needs, &found[0]),
        "own::a needs own::b: B\nown::b needs own::a: A\n"
    );
}

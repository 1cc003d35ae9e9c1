//! No circles: files that need each other are one file, or one of them holds what belongs into a third.
//!
//! A file needs those whose items its `use` brings, through re-exports to where they are defined. What is only passed on
//! (`pub use`) is not needed. Tests are left out.

use std::collections::BTreeMap;
use std::fs;

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;
use syn::Attribute;

use super::items::{ALL, as_use, attributes, is_public, names, visibility};
use super::source::root;
use super::sources::Sources;

/// Packages by the name that `use` knows them by, and their folders.
const PACKAGES: [(&str, &str); 9] = [
    ("linkdyn", "src"),
    ("linkdyn_engine", "crates/engine/src"),
    ("linkdyn_linear", "crates/linear/src"),
    ("linkdyn_model", "crates/model/src"),
    ("linkdyn_optimise", "crates/optimise/src"),
    ("linkdyn_output", "crates/output/src"),
    ("linkdyn_picture", "crates/picture/src"),
    ("linkdyn_study", "crates/study/src"),
    ("linkdyn_validation", "validation/src"),
];

/// Circles that are left. The number only falls.
const AT_MOST: usize = 37;

/// Whether a module is only there for tests.
fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let list = attribute.meta.require_list();
        attribute.path().is_ident("cfg") && list.is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

/// The circles of files, each as sorted paths of modules.
fn circles(sources: &Sources) -> Vec<Vec<String>> {
    let mut needs: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let path =
        |package: &str, module: &[String]| [&[package.to_string()], module].concat().join("::");
    for (package, modules) in &sources.packages {
        for (module, items) in modules {
            let own = needs.entry(path(package, module)).or_default();
            let needed = items
                .iter()
                .filter(|item| !is_public(visibility(item)) && !is_test(attributes(item)));
            for (known, target) in needed.filter_map(as_use).flat_map(names) {
                // Of a `use` of everything the module itself is needed.
                let place = sources.resolve(package, module, &target);
                let Some((of, mut inner, name)) = place else {
                    continue;
                };
                let below = [&inner[..], std::slice::from_ref(&name)].concat();
                if known == ALL || sources.packages[&of].contains_key(&below) {
                    inner = below;
                }
                own.push(path(&of, &inner));
            }
        }
    }
    let mut graph = DiGraphMap::<&str, ()>::new();
    for (own, others) in &needs {
        for other in others.iter().filter(|other| *other != own) {
            graph.add_edge(own, other, ());
        }
    }
    let mut found: Vec<Vec<String>> = tarjan_scc(&graph)
        .into_iter()
        .filter(|files| files.len() > 1)
        .map(|files| files.into_iter().map(String::from).collect())
        .collect();
    found.iter_mut().for_each(|files| files.sort());
    found.sort();
    found
}

#[test]
fn no_files_need_each_other() {
    let readers = PACKAGES.map(|(name, folder)| {
        (name, move |file: &str| {
            fs::read_to_string(root().join(folder).join(file)).ok()
        })
    });
    let packages: Vec<_> = readers
        .iter()
        .map(|(name, read)| (*name, read as &super::items::File))
        .collect();
    let sources = Sources::parse(&packages, is_test);
    let found = circles(&sources);
    let told: Vec<String> = found.iter().map(|files| files.join("\n  ")).collect();
    assert!(
        found.len() <= AT_MOST,
        "{} circles, {AT_MOST} at most:\n{}",
        found.len(),
        told.join("\n\n")
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
    assert_eq!(circles(&sources), [["own::a", "own::b"]]);
}

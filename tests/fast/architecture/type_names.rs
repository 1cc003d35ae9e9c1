//! A type name stands once in a package: who reads it knows which type it is.

use std::collections::{BTreeMap, BTreeSet};

use syn::Item;

use super::circles::{is_test, parsed};
use super::items::{attributes, name};

/// Names that stand in several files of a package, without the `Options` that every command has. The number only falls.
const AT_MOST: usize = 54;

#[test]
fn type_names_stand_once_in_a_package() {
    let sources = parsed();
    let mut several = Vec::new();
    for (package, modules) in &sources.packages {
        let mut files: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (module, items) in modules {
            let own = items.iter().filter(|item| {
                matches!(
                    item,
                    Item::Struct(_) | Item::Enum(_) | Item::Trait(_) | Item::Type(_)
                ) && !is_test(attributes(item))
            });
            for name in own.filter_map(name) {
                files.entry(name).or_default().insert(module.join("::"));
            }
        }
        files.retain(|name, files| files.len() > 1 && name != "Options");
        several.extend(files.into_iter().map(|(name, files)| {
            let files: Vec<String> = files.into_iter().collect();
            format!("{package}: {name} in {}", files.join(", "))
        }));
    }
    assert!(
        several.len() <= AT_MOST,
        "{} names, {AT_MOST} at most:\n{}",
        several.len(),
        several.join("\n")
    );
}

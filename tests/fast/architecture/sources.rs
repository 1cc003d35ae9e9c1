//! Where names lead: the items that a path means, through re-exports and packages.

use std::collections::{BTreeMap, BTreeSet};

use syn::Item;

use super::items::{ALL, File, LeavesOut, Modules, as_use, load, name, names, parse};

/// A name that a `use` brings, and the path behind it.
type Brought = (String, Vec<String>);

/// Packages, by the name that `use` knows them by.
pub struct Sources {
    pub packages: BTreeMap<String, Modules>,
    /// What the `use`s of each module bring from our packages: name, and the path behind it.
    uses: BTreeMap<(String, Vec<String>), Vec<Brought>>,
}

/// The path of an item: package, modules, name.
pub type Place = (String, Vec<String>, String);

/// Steps on the way there: package, module, the rest of the path.
type Steps = BTreeSet<(String, Vec<String>, Vec<String>)>;

impl Sources {
    /// Parses packages; what `leaves_out` says is left out with all below it.
    pub fn parse(packages: &[(&str, &File)], leaves_out: LeavesOut) -> Self {
        let read = |(name, file): &(&str, &File)| {
            let mut modules = Modules::new();
            let text = file("lib.rs").expect("a root");
            load(
                &mut modules,
                Vec::new(),
                parse(&text).items,
                file,
                leaves_out,
            );
            (name.to_string(), modules)
        };
        let packages: BTreeMap<String, Modules> = packages.iter().map(read).collect();
        let known = &packages;
        let uses = packages.iter().flat_map(|(package, modules)| {
            modules.iter().map(move |(module, items)| {
                let is_ours = |(_, target): &Brought| {
                    let first = &target[0];
                    let inner = [&module[..], std::slice::from_ref(first)].concat();
                    ["crate", "self", "super"].contains(&first.as_str())
                        || known.contains_key(first)
                        || modules.contains_key(&inner)
                };
                let brought = items.iter().filter_map(as_use).flat_map(names);
                let brought = brought.filter(is_ours);
                ((package.clone(), module.clone()), brought.collect())
            })
        });
        Sources {
            uses: uses.collect(),
            packages,
        }
    }

    /// Where a path leads that stands in a module, through re-exports; none where that is no package of ours.
    pub fn resolve(&self, package: &str, module: &[String], path: &[String]) -> Option<Place> {
        self.lead(package, module, path, &mut BTreeSet::new())
    }

    /// The same; `seen` are the steps so far, since two modules may take everything from each other.
    fn lead(
        &self,
        package: &str,
        module: &[String],
        path: &[String],
        seen: &mut Steps,
    ) -> Option<Place> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => self.lead_from(package, &[], rest, seen),
            "self" => self.lead_from(package, module, rest, seen),
            "super" => self.lead(package, module.split_last()?.1, rest, seen),
            other if self.packages.contains_key(other) && !rest.is_empty() => {
                self.lead_from(other, &[], rest, seen)
            }
            _ => self.lead_from(package, module, path, seen),
        }
    }

    /// The same, from the module on.
    fn lead_from(
        &self,
        package: &str,
        module: &[String],
        path: &[String],
        seen: &mut Steps,
    ) -> Option<Place> {
        if !seen.insert((package.to_string(), module.to_vec(), path.to_vec())) {
            return None;
        }
        let (first, rest) = path.split_first()?;
        let items = self.packages.get(package)?.get(module)?;
        let inner = [module, std::slice::from_ref(first)].concat();
        if !rest.is_empty() && self.packages[package].contains_key(&inner) {
            return self.lead_from(package, &inner, rest, seen);
        }
        let here = || Some((package.to_string(), module.to_vec(), first.clone()));
        let is_it = |item: &&Item| rest.is_empty() && name(item).is_some_and(|own| own == *first);
        // A function may have the name of the private module that it comes from.
        if items
            .iter()
            .filter(is_it)
            .any(|item| !matches!(item, Item::Mod(_)))
        {
            return here();
        }
        for (known, target) in &self.uses[&(package.to_string(), module.to_vec())] {
            let whole = match known.as_str() {
                ALL => [&target[..], path].concat(),
                known if known == first => [&target[..], rest].concat(),
                _ => continue,
            };
            let found = self.lead(package, module, &whole, seen);
            if found.is_some() {
                return found;
            }
        }
        items.iter().find(is_it).and_then(|_| here())
    }
}

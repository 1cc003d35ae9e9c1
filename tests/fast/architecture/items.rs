//! Items of parsed sources: modules, names, visibility, what a `use` brings.

use std::collections::BTreeMap;

use syn::{Attribute, Item, ItemUse, UseTree, Visibility};

/// The items of each module, by its path.
pub type Modules = BTreeMap<Vec<String>, Vec<Item>>;

/// The text of a file of a package, by its path below the root's folder; none where there is no such file.
pub type File<'f> = dyn Fn(&str) -> Option<String> + 'f;

/// What a `use` of everything brings.
pub const ALL: &str = "*";

/// What of the modules is left out, by its attributes.
pub type LeavesOut = fn(&[Attribute]) -> bool;

/// Takes a module and those below it, but for what is left out. A file's own documentation is its module's.
pub fn load(
    modules: &mut Modules,
    path: Vec<String>,
    mut items: Vec<Item>,
    file: &File,
    leaves_out: LeavesOut,
) {
    for item in &mut items {
        let Item::Mod(item) = item else { continue };
        if leaves_out(&item.attrs) {
            continue;
        }
        let inner = [&path[..], &[item.ident.to_string()]].concat();
        let below = match &item.content {
            Some((_, items)) => items.clone(),
            None => {
                let stem = inner.join("/");
                let text = file(&format!("{stem}.rs")).or_else(|| file(&format!("{stem}/mod.rs")));
                let parsed = parse(&text.unwrap_or_else(|| panic!("no file of {stem}")));
                item.attrs.extend(parsed.attrs);
                parsed.items
            }
        };
        load(modules, inner, below, file, leaves_out);
    }
    modules.insert(path, items);
}

/// A file's items and its own attributes.
pub fn parse(text: &str) -> syn::File {
    syn::parse_file(text).expect("Rust")
}

/// Tests, the command, and what documentation does not show.
pub fn is_hidden(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let Ok(list) = attribute.meta.require_list() else {
            return false;
        };
        let words = list.tokens.to_string();
        let is = |name: &str| attribute.path().is_ident(name);
        is("cfg") && (words == "test" || words.contains("command"))
            || is("doc") && words == "hidden"
    })
}

pub fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

pub fn as_use(item: &Item) -> Option<&ItemUse> {
    match item {
        Item::Use(item) => Some(item),
        _ => None,
    }
}

/// Each name that a `use` brings, with the path behind it.
pub fn names(item: &ItemUse) -> Vec<(String, Vec<String>)> {
    fn walk(tree: &UseTree, before: &[String], found: &mut Vec<(String, Vec<String>)>) {
        let with = |name: String| [before, &[name]].concat();
        match tree {
            UseTree::Path(path) => walk(&path.tree, &with(path.ident.to_string()), found),
            // `a::{self}` is `a`.
            UseTree::Name(name) if name.ident == "self" => {
                found.extend(before.last().map(|last| (last.clone(), before.to_vec())));
            }
            UseTree::Name(name) => {
                let name = name.ident.to_string();
                found.push((name.clone(), with(name)));
            }
            UseTree::Rename(rename) => {
                found.push((rename.rename.to_string(), with(rename.ident.to_string())));
            }
            UseTree::Group(group) => group
                .items
                .iter()
                .for_each(|tree| walk(tree, before, found)),
            UseTree::Glob(_) => found.push((ALL.to_string(), before.to_vec())),
        }
    }
    let mut found = Vec::new();
    walk(&item.tree, &[], &mut found);
    found
}

/// The name of an item that has one.
pub fn name(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Mod(item) => &item.ident,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(ident.to_string())
}

pub fn visibility(item: &Item) -> &Visibility {
    match item {
        Item::Const(item) => &item.vis,
        Item::Enum(item) => &item.vis,
        Item::Fn(item) => &item.vis,
        Item::Mod(item) => &item.vis,
        Item::Static(item) => &item.vis,
        Item::Struct(item) => &item.vis,
        Item::Trait(item) => &item.vis,
        Item::Type(item) => &item.vis,
        Item::Union(item) => &item.vis,
        Item::Use(item) => &item.vis,
        _ => &Visibility::Inherited,
    }
}

pub fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

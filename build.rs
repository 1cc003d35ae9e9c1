//! The editor's page goes into the command where it is wanted and built.

use std::env;
use std::path::Path;

fn main() {
    println!("cargo:rustc-check-cfg=cfg(has_editor)");
    println!("cargo:rerun-if-changed=build.rs");
    if env::var_os("CARGO_FEATURE_EDIT").is_none() {
        return;
    }
    let page = "web/dist/editor.html";
    println!("cargo:rerun-if-changed={page}");
    if Path::new(page).exists() {
        println!("cargo:rustc-cfg=has_editor");
    } else {
        println!(
            "cargo:warning={page} is not there: `node web/build.mjs` makes it; `linkdyn edit` needs --page"
        );
    }
}

//! The editor's page, and the library of functional mock-up units, go into the command where they are wanted and built.

use std::env;
use std::path::Path;

fn main() {
    println!("cargo:rustc-check-cfg=cfg(has_editor, has_fmu_library)");
    println!("cargo:rerun-if-changed=build.rs");
    if env::var_os("CARGO_FEATURE_EDIT").is_some() {
        editor();
    }
    if env::var_os("CARGO_FEATURE_FMU").is_some() {
        library();
    }
}

fn editor() {
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

/// The library of the system that is built for.
fn library() {
    let name = match env::var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("windows") => "linkdyn_fmi.dll",
        Ok("macos") => "liblinkdyn_fmi.dylib",
        _ => "liblinkdyn_fmi.so",
    };
    let path = format!("crates/fmi/dist/{name}");
    println!("cargo:rerun-if-changed={path}");
    if Path::new(&path).exists() {
        println!("cargo:rustc-cfg=has_fmu_library");
        let folder = env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
        println!("cargo:rustc-env=LINKDYN_FMU_LIBRARY={folder}/{path}");
    } else {
        println!(
            "cargo:warning={path} is not there: `cargo build --release -p linkdyn-fmi` makes {name}; `linkdyn export --fmu` needs --library"
        );
    }
}

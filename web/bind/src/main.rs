//! Writes the script through which a page calls the engine: `linkdyn-web-bind FILE.wasm DIRECTORY`.

use std::env;
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else {
        eprintln!("usage: linkdyn-web-bind FILE.wasm DIRECTORY");
        return ExitCode::from(2);
    };
    let mut bindgen = Bindgen::new();
    let made = bindgen
        .input_path(input)
        .out_name("linkdyn")
        .web(true)
        .map(|made| {
            made.remove_name_section(true)
                .remove_producers_section(true)
        });
    match made.and_then(|made| made.typescript(true).generate(output)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why:#}");
            ExitCode::FAILURE
        }
    }
}

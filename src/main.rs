//! The command `linkdyn`.

fn main() -> std::process::ExitCode {
    linkdyn::cli::main()
}

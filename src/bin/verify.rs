//! `verify`, as this package's library has it.

/// Runs the program on the process's arguments.
fn main() -> std::process::ExitCode {
    viewcert_cli::main(std::env::args_os()).into()
}

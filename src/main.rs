//! `verify`: arguments in, reports out.

fn main() -> std::process::ExitCode {
    viewcert::cli::main()
}

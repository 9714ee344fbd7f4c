//! The checker alone, for whoever wants to build nothing of the prover.

fn main() -> std::process::ExitCode {
    viewcert_check::program::run(std::env::args_os()).into()
}

//! `viewcert-check`, installed beside `verify`; `crates/check` builds the same program alone.

fn main() -> std::process::ExitCode {
    viewcert_check::program::run(std::env::args_os()).into()
}

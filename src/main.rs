//! `verify`: arguments in, reports out.
fn main() {}

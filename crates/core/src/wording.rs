//! Numbers of things in messages.

/// A number of things: "1 camera", "2 cameras".
pub fn counted(count: usize, thing: &str) -> String {
    let many = match thing.strip_suffix('y') {
        _ if count == 1 => return format!("1 {thing}"),
        Some(stem) => format!("{stem}ies"),
        None => format!("{thing}s"),
    };
    format!("{count} {many}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_thing_is_not_many() {
        assert_eq!(counted(1, "entry"), "1 entry");
        assert_eq!(counted(0, "entry"), "0 entries");
        assert_eq!(counted(2, "camera"), "2 cameras");
    }
}

//! Text from elsewhere.

/// Longest text from a certificate or a file name that is printed, in characters.
const LONGEST: usize = 1000;

/// Text from elsewhere without what a terminal would obey: control characters and those that turn
/// the direction of writing are spelt out; what is too long is cut.
pub fn printable(text: &str) -> String {
    let mut safe = String::new();
    for c in text.chars().take(LONGEST) {
        let turns = matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
            || matches!(c, '\u{2060}'..='\u{2069}' | '\u{feff}');
        if c.is_control() || turns {
            safe.extend(c.escape_unicode());
        } else {
            safe.push(c);
        }
    }
    if text.chars().nth(LONGEST).is_some() {
        safe.push_str("...");
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_printable_moves_the_cursor() {
        let text = "a\u{1b}[2J\nVERIFIED \u{202e}\u{e4}";
        let expected = "a\\u{1b}[2J\\u{a}VERIFIED \\u{202e}\u{e4}";
        assert_eq!(printable(text), expected);
        assert_eq!(printable(&"x".repeat(2000)).len(), LONGEST + 3);
    }
}

//! Numbers of things in messages, and text from elsewhere in them.

/// A number of things: "1 camera", "2 cameras".
pub fn counted(count: usize, thing: &str) -> String {
    let many = match thing.strip_suffix('y') {
        _ if count == 1 => return format!("1 {thing}"),
        Some(stem) => format!("{stem}ies"),
        None => format!("{thing}s"),
    };
    format!("{count} {many}")
}

/// Longest text from a file or a file name that is printed, in characters.
const LONGEST: usize = 8192;

/// Text from elsewhere on one line: as [`spelt`] says, ends of lines and tabs too; what is too long is cut.
pub fn printable(text: &str) -> String {
    let mut safe = String::new();
    for c in text.chars().take(LONGEST) {
        match c {
            '\n' | '\t' => safe += &format!("\\u{:04x}", c as u32),
            c => spelt(c, &mut safe),
        }
    }
    if text.chars().nth(LONGEST).is_some() {
        safe.push_str("...");
    }
    safe
}

/// Adds a character. Of what a terminal would obey, control characters and those that turn the direction of
/// writing or do not show, the number is spelt out, as JSON spells it within a string; but for ends of lines and
/// tabs.
pub fn spelt(c: char, text: &mut String) {
    let turns = matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(c, '\u{2060}'..='\u{2069}' | '\u{feff}');
    if (c.is_control() && !matches!(c, '\n' | '\t')) || turns {
        *text += &format!("\\u{:04x}", c as u32);
    } else {
        text.push(c);
    }
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

    #[test]
    fn nothing_printable_moves_the_cursor() {
        let text = "a\u{1b}[2J\nVERIFIED \u{202e}\u{e4}";
        let expected = "a\\u001b[2J\\u000aVERIFIED \\u202e\u{e4}";
        assert_eq!(printable(text), expected);
        assert_eq!(printable(&"x".repeat(2 * LONGEST)).len(), LONGEST + 3);
    }
}

//! Names that look the same and are different cameras: most often one image, written by two programs.

use std::borrow::Cow;
use std::collections::HashMap;

use unicode_normalization::{UnicodeNormalization, is_nfc};

/// A note about names that look the same, if there are such. Linear in the bytes of the names.
pub(crate) fn note(names: &[Box<str>]) -> Option<String> {
    let folds = |name: &str| !name.is_ascii() || name.contains('\\') || name.starts_with("./");
    if !names.iter().any(|name| folds(name)) {
        return None;
    }
    let mut seen: HashMap<Cow<'_, str>, &str> = HashMap::new();
    let mut first = None;
    let mut count = 0;
    for name in names {
        if let Some(other) = seen.insert(look(name), name) {
            count += 1;
            first.get_or_insert((other, &**name));
        }
    }
    let (a, b) = first?;
    let more = match count {
        1 => String::new(),
        _ => format!(", and {} more are alike", count - 1),
    };
    Some(format!(
        "`{a}` and `{b}` look the same and are two cameras: they differ in {}{more}",
        difference(a, b)
    ))
}

/// What a name looks like: accents in one form, folders behind slashes, nothing that is not seen.
fn look(name: &str) -> Cow<'_, str> {
    if name.is_ascii() && !name.contains('\\') && !name.starts_with("./") {
        return name.into();
    }
    let text: String = name
        .nfc()
        .filter(|&c| !is_invisible(c))
        .map(plain)
        .collect();
    match text.strip_prefix("./") {
        Some(rest) => rest.to_owned().into(),
        None => text.into(),
    }
}

fn plain(c: char) -> char {
    match c {
        '\\' => '/',
        c if c.is_whitespace() => ' ',
        c => c,
    }
}

fn is_invisible(c: char) -> bool {
    matches!(c, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{2064}' | '\u{feff}')
}

fn difference(a: &str, b: &str) -> &'static str {
    let nfc = |name: &str| name.nfc().collect::<String>();
    let slashes = |name: &str| name.replace('\\', "/").trim_start_matches("./").to_owned();
    match () {
        () if nfc(a) == nfc(b) => "how accents are encoded (NFC, NFD)",
        () if slashes(a) == slashes(b) => "how folders are written (`\\`, `/`, `./`)",
        () if is_nfc(a) == is_nfc(b) => "characters that are not seen",
        () => "characters that are not seen, and how accents are encoded",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(names: &[&str]) -> Option<String> {
        let names: Vec<Box<str>> = names.iter().map(|&name| name.into()).collect();
        note(&names)
    }

    #[test]
    fn names_that_look_the_same() {
        for (a, b, reason) in [
            ("caf\u{e9}.jpg", "cafe\u{301}.jpg", "accents"),
            ("a/b.jpg", "a\\b.jpg", "folders"),
            ("./b.jpg", "b.jpg", "folders"),
            ("a\u{200b}.jpg", "a.jpg", "not seen"),
            ("a\u{a0}b.jpg", "a b.jpg", "not seen"),
        ] {
            let note = found(&["x", a, "y", b]).unwrap_or_default();
            assert!(
                note.contains("look the same") && note.contains(reason),
                "{note}"
            );
        }
        assert!(found(&["a/b.jpg", "a/B.jpg", "\u{e9}", "e", "a\\c.jpg"]).is_none());
        let note = found(&["a\\1", "a/1", "a\\2", "a/2"]).unwrap();
        assert!(note.ends_with("and 1 more are alike"), "{note}");
    }
}

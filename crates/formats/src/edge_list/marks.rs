//! Marks that tell the two ends of a pair apart in names of columns: `img1` and `img2`.

/// Two marks, in this order.
const MARKS: [[&str; 2]; 18] = [
    ["1", "2"],
    ["a", "b"],
    ["i", "j"],
    ["l", "r"],
    ["left", "right"],
    ["one", "two"],
    ["first", "second"],
    ["from", "to"],
    ["src", "dst"],
    ["src", "tgt"],
    ["source", "target"],
    ["start", "end"],
    ["query", "ref"],
    ["query", "db"],
    ["query", "map"],
    ["q", "db"],
    ["gauche", "droite"],
    ["links", "rechts"],
];

/// The word that two names in lower case have around two marks, if they are equal but for these.
pub(super) fn word(first: &str, second: &str) -> Option<String> {
    MARKS
        .iter()
        .find_map(|marks| without(first, second, *marks))
}

/// The same for marks that count from 0.
pub(super) fn word_from_zero(first: &str, second: &str) -> Option<String> {
    without(first, second, ["0", "1"])
}

fn without(first: &str, second: &str, [one, two]: [&str; 2]) -> Option<String> {
    first.match_indices(one).find_map(|(at, _)| {
        let (start, end) = (&first[..at], &first[at + one.len()..]);
        let other = second.strip_prefix(start)?.strip_prefix(two)?;
        let word = format!("{start}{end}");
        (other == end && !word.is_empty()).then_some(word)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_stand_anywhere() {
        for (first, second, expected) in [
            ("img1", "img2", "img"),
            ("leftimg", "rightimg", "img"),
            ("imageapath", "imagebpath", "imagepath"),
            ("firstimage", "secondimage", "image"),
            ("qname", "dbname", "name"),
        ] {
            assert_eq!(word(first, second).as_deref(), Some(expected), "{first}");
        }
        for (first, second) in [
            ("img2", "img1"),
            ("1", "2"),
            ("img1", "pic2"),
            ("a", "b"),
            ("", ""),
        ] {
            assert_eq!(word(first, second), None, "{first}");
        }
        assert_eq!(word_from_zero("im0", "im1").as_deref(), Some("im"));
    }
}

use super::*;

/// No text of a certificate can end its line, move the cursor, or hide what follows.
#[test]
fn reasons_are_one_line_of_printable_characters() {
    let failure = Failure::rejected("a\nVERIFIED b\r\u{1b}[2K\u{202e}\u{e9}`");
    assert_eq!(
        failure.to_string(),
        "a\\nVERIFIED b\\r\\u{1b}[2K\\u{202e}\\u{e9}`"
    );
    let unreadable = Unreadable::from("\u{0}".to_string());
    assert_eq!(unreadable.to_string(), "\\u{0}");
}

#[test]
fn reasons_are_cut() {
    let exact = "x".repeat(LONGEST_REASON - 3);
    assert_eq!(shown(&exact), exact);
    assert_eq!(shown(&(exact.clone() + "y")), exact.clone() + "...");
    assert_eq!(shown(&"\n".repeat(10_000)).len(), LONGEST_REASON - 1);
}

#[test]
fn steps_are_put_in_front() {
    let failed: Checked<()> = Err(Failure::too_large("12 of 11", "--most"));
    let failed = failed.within(|| "b".into()).within(|| "a".into());
    let wanted = "too large for the limits: a.b: 12 of 11; raise it with --most";
    assert_eq!(failed.unwrap_err().to_string(), wanted);
}

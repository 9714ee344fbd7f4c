use super::*;

/// Bounds that contradict each other: by a mistake in this program only.
#[test]
fn a_contradiction_is_rejected() {
    let shown = |rank: i64, upper: i64| Shown {
        bounds: vec![Lower {
            rank,
            at: None,
            note: None,
        }],
        upper,
        drawn: None,
        classes: None,
        apart: Vec::new(),
        by_solutions: false,
    };
    let sizes = Sizes {
        nodes: 4,
        required: 29,
        core_required: 29,
    };
    assert!(shown(29, 29).conclude(&sizes, Vec::new()).is_ok());
    let failed = shown(29, 28).conclude(&sizes, Vec::new()).err().unwrap();
    let wanted = "the lower bound 29 contradicts the upper bound 28";
    assert_eq!(failed.to_string(), wanted);
}

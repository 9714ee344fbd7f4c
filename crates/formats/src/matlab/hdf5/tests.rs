use proptest::prelude::*;

use super::super::read;

const SPARSE: &[u8] = include_bytes!("../samples/sparse.mat");
const FULL: &[u8] = include_bytes!("../samples/full.mat");
/// Matrices of h5py, each by a name that says what is odd about it.
const OTHERS: &[u8] = include_bytes!("../samples/others.mat");
const PROMISE: &[u8] = include_bytes!("../samples/promise.mat");

fn edges(bytes: &[u8], variable: Option<&str>) -> (usize, Vec<(u32, u32)>) {
    let graph = read(bytes, variable).unwrap_or_else(|fault| panic!("{}", fault.in_file("in")));
    (graph.nodes(), graph.edges().to_vec())
}

fn refusal(bytes: &[u8], variable: Option<&str>) -> String {
    read(bytes, variable).unwrap_err().in_file("in").to_string()
}

#[test]
fn matrices_of_matlab() {
    let square = (4, vec![(0, 1), (0, 3), (1, 2), (2, 3)]);
    for bytes in [SPARSE, FULL] {
        assert_eq!(edges(bytes, None), square);
        assert_eq!(edges(bytes, Some("A")), square);
        let error = refusal(bytes, Some("B"));
        assert!(error.contains("the file holds A (4x4 "), "{error}");
        assert!(error.contains("note (2 char)"), "{error}");
        assert!(!error.contains("#refs#"), "{error}");
        let error = refusal(bytes, Some("note"));
        assert!(
            error.contains("variable note: a char is not a numeric matrix"),
            "{error}"
        );
    }
}

#[test]
fn matrices_of_others() {
    for (name, nodes, expected) in [
        ("plain", 3, &[(0, 1), (1, 2)][..]),
        ("truth", 2, &[(0, 1)]),
        ("real", 3, &[(0, 2), (1, 2)]),
        ("pairless", 3, &[]),
        ("unnamed", 2, &[(0, 1)]),
        ("zeros", 2, &[(0, 1)]),
    ] {
        assert_eq!(
            edges(OTHERS, Some(name)),
            (nodes, expected.to_vec()),
            "{name}"
        );
    }
    for (name, phrase) in [
        ("wide", "the matrix is 2x3, not square"),
        ("deep", "the matrix is 2x2x2, not square"),
        ("nan", "entry (1, 2) is not a number"),
        ("lopsided", "(2, 3) is non-zero, (3, 2) is zero"),
        ("loop", "diagonal entry (2, 2) is non-zero"),
        ("complex", "the matrix is complex"),
        ("half", "a number of 2 bytes is not a numeric matrix"),
        ("nothing", "the graph is empty"),
        ("cells", "a cell is not a numeric matrix"),
        ("words", "is not a numeric matrix"),
        ("structure", "a struct is not a numeric matrix"),
        ("short", "the matrix is 2x1, not square"),
        ("falling", "the column starts of a sparse matrix"),
        ("beyond", "the row numbers of a sparse matrix"),
        ("unsorted", "the row numbers of a sparse matrix"),
        ("overlong", "the column starts of a sparse matrix"),
    ] {
        let error = refusal(OTHERS, Some(name));
        assert!(
            error.starts_with(&format!("in: variable {name}: ")),
            "{error}"
        );
        assert!(error.contains(phrase), "{name}: {error}");
    }
    let error = refusal(OTHERS, None);
    assert!(
        error.contains("square matrices; the file holds beyond (2x2 sparse)"),
        "{error}"
    );
}

#[test]
fn promises_are_not_believed() {
    let error = refusal(PROMISE, None);
    assert!(
        error.contains("a matrix larger than the file can hold"),
        "{error}"
    );
    for bytes in [SPARSE, FULL, OTHERS] {
        for length in [8, 128, 520, 600, 1000, bytes.len() / 2, bytes.len() - 1] {
            let error = refusal(&bytes[..length], Some("A"));
            assert!(error.starts_with("in: ") && error.contains("; "), "{error}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Changed bytes are read or refused; what is read is a graph.
    #[test]
    fn damage_is_no_panic(
        which in 0..3usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        end in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let mut bytes = [SPARSE, FULL, OTHERS][which].to_vec();
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if let Some(end) = end {
            bytes.truncate(end.index(bytes.len()));
        }
        for variable in [None, Some("A"), Some("unnamed"), Some("real")] {
            if let Ok(graph) = read(&bytes, variable) {
                prop_assert!(graph.edges().is_sorted_by(|a, b| a < b));
            }
        }
    }
}

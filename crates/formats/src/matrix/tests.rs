use proptest::prelude::*;

use super::*;
use crate::quaternion::rotation;

/// The graph of a full matrix, column by column.
fn read(size: u32, entry: impl Fn(u32, u32) -> f64) -> Result<Parsed, Problem> {
    read_with(size, entry, &ListOptions::default())
}

fn read_with(
    size: u32,
    entry: impl Fn(u32, u32) -> f64,
    options: &ListOptions,
) -> Result<Parsed, Problem> {
    let places = (0..size).flat_map(|column| (0..size).map(move |row| (row, column)));
    let entries = places.map(|(row, column)| (row, column, entry(row, column)));
    let entries = entries.filter(|entry| entry.2 != 0.0).collect();
    graph(size, entries, options).map(|(parsed, _)| parsed)
}

fn refusal(found: Result<Parsed, Problem>) -> String {
    let problem = found.unwrap_err();
    format!("{problem}; {}", problem.remedy())
}

/// Blocks of 3 x 3: of essential matrices or rotations, with both signs, and of real numbers.
#[test]
fn blocks_are_no_pairs() {
    let turn = rotation([1.0, 0.2, -0.3, 0.4]);
    let of = |block: &dyn Fn(usize, usize) -> f64| {
        let entry = |r: u32, c: u32| match (r / 3).cmp(&(c / 3)) {
            std::cmp::Ordering::Less => block((r % 3) as usize, (c % 3) as usize),
            std::cmp::Ordering::Equal => 0.0,
            std::cmp::Ordering::Greater => block((c % 3) as usize, (r % 3) as usize),
        };
        refusal(read(9, entry))
    };
    for blocks in [
        of(&|r, c| turn[r][c]),
        of(&|r, c| [[0.0, -3.0, 2.0], [3.0, 0.0, -1.0], [-2.0, 1.0, 0.0]][r][c]),
        of(&|r, c| 0.1 + (r + 4 * c) as f64),
    ] {
        assert!(blocks.starts_with("entries are numbers from "), "{blocks}");
        let what = "distances or blocks of poses, perhaps; if each that is not zero is a pair, save A ~= 0";
        assert!(blocks.contains(what), "{blocks}");
    }
}

/// K_{3,3,3}: with equal entries, or with counts, it is a graph.
#[test]
fn threes_of_rows_with_counts_are_cameras() {
    let part = |r: u32, c: u32| r / 3 != c / 3;
    let Parsed { graph, notes, .. } = read(9, |r, c| f64::from(u8::from(part(r, c)))).unwrap();
    assert_eq!((graph.nodes(), graph.edges().len()), (9, 27));
    assert_eq!(notes, [""; 0]);
    let counts = |r: u32, c: u32| f64::from(16 + (r.min(c) * 31 + r.max(c) * 17) % 97);
    let Parsed { graph, notes, .. } =
        read(9, |r, c| if part(r, c) { counts(r, c) } else { 0.0 }).unwrap();
    assert_eq!((graph.nodes(), graph.edges().len()), (9, 27));
    assert!(
        notes[0].starts_with("entries are integers from 16 to "),
        "{notes:?}"
    );
}

#[test]
fn what_the_values_are_is_said() {
    // A cycle of five with weights, counts, ones; all pairs with counts.
    let cycle = |r: u32, c: u32| (r + 1) % 5 == c || (c + 1) % 5 == r;
    let with = |value: &dyn Fn(u32, u32) -> f64| {
        read(5, |r, c| {
            if cycle(r, c) {
                value(r.min(c), r.max(c))
            } else {
                0.0
            }
        })
        .unwrap()
    };
    let meaning = "(counts, weights?): each that is not zero is a pair";
    let Parsed { notes, .. } = with(&|r, c| f64::from(10 * (r + c)));
    assert_eq!(
        notes,
        [format!("entries are integers from 10 to 70 {meaning}")]
    );
    for one in [1.0, -1.0, 0.25] {
        assert_eq!(with(&|_, _| one).notes, [""; 0]);
    }
    let all = read(5, |r, c| if r == c { 0.0 } else { f64::from(r + c) }).unwrap();
    assert_eq!(all.graph.edges().len(), 10);
    assert_eq!(
        all.notes,
        [format!("entries are integers from 1 to 7 {meaning}")]
    );
}

#[test]
fn tables_and_what_is_no_number_are_refused() {
    let distance = |r: u32, c: u32| (f64::from(r) - f64::from(c)).abs() * 1.25;
    let text = refusal(read(5, distance));
    assert!(
        text.starts_with("entries are numbers from 1.25 to 5: "),
        "{text}"
    );
    for (value, what) in [
        (f64::INFINITY, "infinite"),
        (f64::NEG_INFINITY, "infinite"),
        (f64::NAN, "not a number (NaN)"),
    ] {
        let found = read(3, |r, c| if r == c { 0.0 } else { value });
        assert_eq!(
            refusal(found),
            format!("entry (2, 1) is {what}; put zero where there is no pair")
        );
    }
}

#[test]
fn rounding_errors_are_no_pairs() {
    let cycle = |r: u32, c: u32| (r + 1) % 5 == c || (c + 1) % 5 == r;
    let noise = |r: u32, c: u32| {
        if cycle(r, c) {
            0.5
        } else {
            1e-17 * f64::from(r + c)
        }
    };
    let text = refusal(read(5, |r, c| {
        if (r, c) == (0, 2) || (c, r) == (0, 2) || r == c {
            0.0
        } else {
            noise(r, c)
        }
    }));
    assert!(
        text.starts_with("entries are numbers from 3.000e-17 to 0.5: "),
        "{text}"
    );
    assert_eq!(shown(1e-17), "1.000e-17");
    assert_eq!(shown(-0.125), "-0.125");
    assert_eq!(shown(1.0 / 3.0), "0.3333");
}

#[test]
fn entries_in_any_order_are_added_up() {
    let options = ListOptions::default();
    let entries = vec![
        (2, 1, 1.0),
        (1, 0, 1.0),
        (0, 1, 0.25),
        (1, 2, 1.0),
        (0, 1, 0.75),
        (2, 0, 2.0),
        (0, 2, 2.0),
    ];
    let (parsed, again) = graph(4, entries, &options).unwrap();
    assert_eq!((again, parsed.graph.nodes()), (1, 4));
    assert_eq!(parsed.graph.edges(), [(0, 1), (0, 2), (1, 2)]);
    assert_eq!(parsed.labels, Labels::Numbers { first: 1 });
    assert_eq!(parsed.notes.len(), 1);
    // Entries that cancel are zeros.
    let entries = vec![(0, 1, 1.0), (0, 1, -1.0), (1, 0, 0.0)];
    let (parsed, _) = graph(2, entries, &options).unwrap();
    assert_eq!(parsed.graph.edges(), []);
    assert_eq!(parsed.notes, ["explicit zeros are no pairs: 2 entries"]);
    let text = refusal(graph(3, vec![(2, 0, 1.0)], &options).map(|found| found.0));
    assert!(
        text.contains("(3, 1) is non-zero, (1, 3) is zero"),
        "{text}"
    );
    let problem = graph(u32::MAX, Vec::new(), &options).unwrap_err();
    assert!(problem.is_size(), "four billion rows");
}

/// A table of matches, with the numbers of features on its diagonal.
#[test]
fn light_entries_and_the_diagonal_are_left_out() {
    let entries = [
        (0, 0, 900.0),
        (1, 0, 12.0),
        (2, 0, 0.1),
        (0, 1, 12.0),
        (2, 1, 7.5),
        (0, 2, 0.1),
        (1, 2, 7.5),
        (2, 2, 800.0),
    ];
    let of = |min_weight: Option<&str>, skip_loops| {
        let options = ListOptions {
            min_weight: min_weight.map(|least| least.parse().unwrap()),
            skip_loops,
            ..ListOptions::default()
        };
        graph(3, entries.to_vec(), &options).map(|(parsed, _)| parsed)
    };
    assert!(refusal(of(None, false)).starts_with("entries are numbers from 0.1 to 900"));
    assert!(refusal(of(Some("1"), false)).starts_with("diagonal entry (1, 1)"));
    for (least, edges, said) in [
        (Some("0.1"), 3, None),
        (
            Some("0.1000000000000000001"),
            2,
            Some("1 pair below 0.1000000000000000001"),
        ),
        (Some("7.5"), 2, Some("1 pair below 7.5")),
        (Some("12"), 1, Some("2 pairs below 12")),
    ] {
        let parsed = of(least, true).unwrap();
        assert_eq!(
            (parsed.graph.nodes(), parsed.graph.edges().len()),
            (3, edges)
        );
        let expected: Vec<&str> = std::iter::once("2 entries on the diagonal")
            .chain(said)
            .collect();
        assert_eq!(parsed.read.ignored, expected);
        assert!(!parsed.notes.iter().any(|note| note.contains("900")));
    }
}

proptest! {
    /// Random 0/1 matrices, and weights, are read by their definition whatever the size.
    #[test]
    fn weights_do_not_matter(
        n in 1u32..13,
        bits in prop::collection::vec(prop::bool::weighted(0.4), 13 * 13),
        counts in any::<bool>(),
    ) {
        let is_pair = |r: u32, c: u32| r != c && bits[(13 * r.min(c) + r.max(c)) as usize];
        let value = |r: u32, c: u32| if counts { f64::from(15 + r * c + r + c) } else { 1.0 };
        let Parsed { graph, .. } = read(n, |r, c| if is_pair(r, c) { value(r, c) } else { 0.0 }).unwrap();
        let expected: Vec<(u32, u32)> = (0..n)
            .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
            .filter(|&(i, j)| is_pair(i, j))
            .collect();
        prop_assert_eq!(graph.edges(), &expected[..]);
        prop_assert_eq!(graph.nodes(), n as usize);
    }
}

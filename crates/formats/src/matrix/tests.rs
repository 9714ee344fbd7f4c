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

type Block = [[f64; 3]; 3];

/// The matrix of blocks of these pairs: block (i, j) and, transposed, block (j, i).
fn of_blocks(cameras: usize, blocks: &[(usize, usize, Block)]) -> Vec<Vec<f64>> {
    let mut matrix = vec![vec![0.0; 3 * cameras]; 3 * cameras];
    for &(i, j, block) in blocks {
        for r in 0..3 {
            for c in 0..3 {
                matrix[3 * i + r][3 * j + c] = block[r][c];
                matrix[3 * j + c][3 * i + r] = block[r][c];
            }
        }
    }
    matrix
}

fn read_blocks(matrix: &[Vec<f64>]) -> Result<Parsed, Problem> {
    read(matrix.len() as u32, |r, c| matrix[r as usize][c as usize])
}

fn product(a: Block, b: Block) -> Block {
    std::array::from_fn(|r| std::array::from_fn(|c| (0..3).map(|k| a[r][k] * b[k][c]).sum()))
}

/// `[t]_x`, so that its product with t is zero.
fn cross([x, y, z]: [f64; 3]) -> Block {
    [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
}

/// Five cameras, six pairs: what the matrices of the same pairs are read as.
const PAIRS: [(usize, usize); 6] = [(0, 1), (1, 2), (0, 2), (2, 3), (3, 4), (2, 4)];

fn assert_five_cameras(matrix: &[Vec<f64>], what: &str) {
    let Parsed {
        graph,
        labels,
        notes,
        ..
    } = read_blocks(matrix).unwrap();
    let pairs = graph.edges().iter().map(|&(i, j)| (i as usize, j as usize));
    let mut expected = PAIRS.to_vec();
    expected.sort_unstable();
    assert_eq!((graph.nodes(), pairs.collect()), (5, expected));
    assert_eq!(labels, Labels::Numbers { first: 1 });
    let note = format!("the matrix consists of blocks of 3 x 3, {what}: 15 rows are 5 cameras");
    assert_eq!(notes, [note]);
}

/// The matrix of five cameras with these blocks of their pairs.
fn of_five(block: &dyn Fn(usize) -> Block) -> Vec<Vec<f64>> {
    let blocks: Vec<_> = PAIRS
        .iter()
        .enumerate()
        .map(|(k, &(i, j))| (i, j, block(k)))
        .collect();
    of_blocks(5, &blocks)
}

fn essential(k: usize) -> Block {
    let k = k as f64;
    let direction = [1.0 + k, 2.0 - k, 0.5 * k + 0.3];
    product(
        cross(direction),
        rotation([1.0, 0.2 * k - 0.3, 0.1, 0.4 - 0.1 * k]),
    )
}

#[test]
fn fundamental_matrices_are_pairs_of_cameras() {
    let fundamental = "fundamental or essential matrices";
    assert_five_cameras(&of_five(&essential), fundamental);
    // In pixels: K^-T E K^-1 with a focal length of 1,500.
    let calibration = [
        [1.0 / 1500.0, 0.0, 0.0],
        [0.0, 1.0 / 1500.0, 0.0],
        [-0.5, -0.4, 1.0],
    ];
    let transposed = [
        [1.0 / 1500.0, 0.0, -0.5],
        [0.0, 1.0 / 1500.0, -0.4],
        [0.0, 0.0, 1.0],
    ];
    let pixels = of_five(&|k| product(product(calibration, essential(k)), transposed));
    assert_five_cameras(&pixels, fundamental);
    // Each up to its own scale and sign, in one triangle alone.
    let mut scaled = pixels;
    for (k, &(i, j)) in PAIRS.iter().enumerate() {
        for row in &mut scaled[3 * j..3 * j + 3] {
            row[3 * i..3 * i + 3]
                .iter_mut()
                .for_each(|entry| *entry *= -0.5 * (k + 1) as f64);
        }
    }
    assert_five_cameras(&scaled, fundamental);
    // Pure translations: zeros within the blocks.
    assert_five_cameras(
        &of_five(&|k| cross([1.0, 2.0 + k as f64, 3.0])),
        fundamental,
    );
    let mut rotations = of_five(&|k| rotation([1.0, 0.3, k as f64, 0.2]));
    assert_five_cameras(&rotations, "relative rotations");
    for (k, row) in rotations.iter_mut().enumerate() {
        row[k] = 1.0;
    }
    assert_five_cameras(&rotations, "relative rotations");
}

#[test]
fn blocks_of_another_kind_are_refused_by_name() {
    let weights = |k: usize| -> Block {
        std::array::from_fn(|r| {
            std::array::from_fn(|c| 0.1 + ((7 * r + 4 * c + 5 * k) % 11) as f64)
        })
    };
    let text = refusal(read_blocks(&of_five(&weights)));
    assert!(
        text.starts_with("the entries come in blocks of 3 x 3, and the blocks are neither"),
        "{text}"
    );
    // One of the blocks is that of another pair.
    let mut wrong = of_five(&essential);
    let other = essential(17);
    for r in 0..3 {
        wrong[r][3..6].copy_from_slice(&other[r]);
    }
    let text = refusal(read_blocks(&wrong));
    assert!(
        text.contains("no multiple of block (i, j) transposed"),
        "{text}"
    );
    let mut upper = of_five(&essential);
    for (r, row) in upper.iter_mut().enumerate() {
        row[..r].fill(0.0);
    }
    let text = refusal(read_blocks(&upper));
    assert!(
        text.contains("without block (j, i); fill in the other triangle"),
        "{text}"
    );
    // What the advice says, done.
    let sum: Vec<Vec<f64>> = (0..15)
        .map(|r| (0..15).map(|c| upper[r][c] + upper[c][r]).collect())
        .collect();
    assert_five_cameras(&sum, "fundamental or essential matrices");
    let poses = read(8, |r, c| match (r / 4, c / 4) {
        (i, j) if i == j => f64::from(u8::from(r == c)),
        (i, _) => {
            let turn = rotation([1.0, 0.5, f64::from(i), 0.0]);
            match (r % 4, c % 4) {
                (3, c) => f64::from(u8::from(c == 3)),
                (r, 3) => f64::from(r) + 0.5,
                (r, c) => turn[r as usize][c as usize],
            }
        }
    });
    let text = refusal(poses);
    assert!(
        text.starts_with("this is a matrix of 4 x 4 blocks (relative poses)"),
        "{text}"
    );
}

/// K_{3,3,3} has the pattern of blocks: with equal entries, or with counts, it is a graph.
#[test]
fn threes_of_rows_with_counts_are_cameras() {
    let part = |r: u32, c: u32| r / 3 != c / 3;
    let Parsed { graph, notes, .. } = read(9, |r, c| f64::from(u8::from(part(r, c)))).unwrap();
    assert_eq!((graph.nodes(), graph.edges().len()), (9, 27));
    assert!(
        notes[0].starts_with("the rows come in threes with the same pairs"),
        "{notes:?}"
    );
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
    let Parsed { graph, notes, .. } = with(&|r, c| 0.5 + f64::from(r + c));
    assert_eq!(graph.edges().len(), 5);
    let meaning = "(counts, weights?): each that is not zero is a pair";
    assert_eq!(
        notes,
        [format!(
            "entries are real numbers from 1.5 to 7.5 {meaning}"
        )]
    );
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
        text.starts_with("every entry off the diagonal is non-zero, and they are no integers"),
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
        text.starts_with("some entries are so small beside others"),
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
        (0, 1, 0.5),
        (1, 2, 1.0),
        (0, 1, 0.5),
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
    assert!(matches!(of(None, false), Err(Problem::Diagonal(1))));
    assert!(matches!(of(Some("1"), false), Err(Problem::Diagonal(1))));
    for (least, edges, said) in [
        (None, 3, None),
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

/// Blocks and lists of pairs have no weights.
#[test]
fn weights_of_what_has_none_are_refused() {
    let options = ListOptions {
        min_weight: Some("5".parse().unwrap()),
        ..ListOptions::default()
    };
    let matrix = of_five(&essential);
    let read = read_with(15, |r, c| matrix[r as usize][c as usize], &options);
    assert!(refusal(read).starts_with("--min-weight: the entries belong to 3 x 3 blocks"));
    let list = list(4, &[], &options);
    assert!(refusal(list).starts_with("--min-weight: the numbers are pairs"));
}

#[test]
fn two_columns_are_pairs() {
    let list = |rows: &[[f64; 2]]| {
        let ends = |(row, pair): (u32, &[f64; 2])| [(row, 0, pair[0]), (row, 1, pair[1])];
        let entries = (0..).zip(rows).flat_map(ends);
        let entries: Vec<Entry> = entries.filter(|entry| entry.2 != 0.0).collect();
        super::list(rows.len() as u32, &entries, &ListOptions::default())
    };
    let Parsed {
        graph,
        labels,
        notes,
        ..
    } = list(&[[0.0, 7.0], [7.0, 9.0], [9.0, 0.0], [7.0, 0.0]]).unwrap();
    assert_eq!((graph.nodes(), graph.edges().len()), (3, 3));
    assert_eq!(labels, Labels::Integers(vec![0, 7, 9]));
    assert_eq!(notes.len(), 2);
    assert_eq!(notes[0], "the rows are pairs: two numbers of cameras each");
    for bad in [0.5, -1.0, f64::NAN, f64::INFINITY, 1e16] {
        let text = refusal(list(&[[1.0, 2.0], [2.0, bad], [1.0, 3.0]]));
        assert!(
            text.contains("is no number of a camera; write pairs as"),
            "{text}"
        );
    }
    let text = refusal(list(&[[1.0, 2.0], [2.0, 2.0], [1.0, 3.0]]));
    assert!(text.contains("camera 2 is paired with itself"), "{text}");
    // Matches of features: increasing indices, each in one row.
    let matches: Vec<[f64; 2]> = (0..40)
        .map(|k| [f64::from(3 * k), f64::from(211 * k % 997 * 5)])
        .collect();
    let text = refusal(list(&matches));
    assert!(
        text.starts_with("most pairs share no number with any other: matches of features"),
        "{text}"
    );
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

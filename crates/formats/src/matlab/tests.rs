use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use proptest::prelude::*;

use super::*;

const DOUBLE: u32 = 6;
const SPARSE: u32 = 5;
const LOGICAL: u32 = 0x200;
const COMPLEX: u32 = 0x800;

/// Types of numbers as they are stored.
const MI_INT8: u32 = 1;
const MI_UINT8: u32 = 2;
const MI_INT32: u32 = 5;
const MI_UINT32: u32 = 6;
const MI_DOUBLE: u32 = 9;

/// Writes the pieces of a file.
#[derive(Clone, Copy)]
struct Writer;

impl Writer {
    fn word(self, value: u32) -> [u8; 4] {
        value.to_le_bytes()
    }

    fn element(self, kind: u32, data: &[u8]) -> Vec<u8> {
        let mut bytes = [self.word(kind), self.word(data.len() as u32)].concat();
        bytes.extend(data);
        if kind != COMPRESSED {
            bytes.resize(bytes.len().next_multiple_of(8), 0);
        }
        bytes
    }

    /// Data of at most four bytes within the tag.
    fn small(self, kind: u32, data: &[u8]) -> Vec<u8> {
        let mut bytes = self.word((data.len() as u32) << 16 | kind).to_vec();
        bytes.extend(data);
        bytes.resize(8, 0);
        bytes
    }

    fn words(self, kind: u32, values: &[u32]) -> Vec<u8> {
        let data: Vec<u8> = values.iter().flat_map(|&v| self.word(v)).collect();
        self.element(kind, &data)
    }

    /// Numbers as elements of any type.
    fn numbers(self, kind: u32, values: &[i32]) -> Vec<u8> {
        let mut data = Vec::new();
        for &value in values {
            data.extend(match kind {
                1 | 2 => vec![value as u8],
                3 | 4 => (value as i16).to_le_bytes().to_vec(),
                5 | 6 => value.to_le_bytes().to_vec(),
                7 => (value as f32).to_le_bytes().to_vec(),
                9 => f64::from(value).to_le_bytes().to_vec(),
                12 | 13 => i64::from(value).to_le_bytes().to_vec(),
                _ => unreachable!("no such type"),
            });
        }
        self.element(kind, &data)
    }

    fn variable(self, flags: u32, size: &[u32], name: &str, values: &[Vec<u8>]) -> Vec<u8> {
        let mut content = self.words(MI_UINT32, &[flags, 0]);
        content.extend(self.words(MI_INT32, size));
        content.extend(if name.len() > 4 {
            self.element(MI_INT8, name.as_bytes())
        } else {
            self.small(MI_INT8, name.as_bytes())
        });
        content.extend(values.concat());
        self.element(MATRIX, &content)
    }

    fn deflated(self, variable: &[u8]) -> Vec<u8> {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(variable).unwrap();
        self.element(COMPRESSED, &encoder.finish().unwrap())
    }

    fn file(self, variables: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = b"MATLAB 5.0 MAT-file".to_vec();
        bytes.resize(124, b' ');
        bytes.extend([0, 1, b'I', b'M']);
        bytes.extend(variables.concat());
        bytes
    }

    /// Sparse matrix: rows and starts from the lists of rows of every column.
    fn sparse(self, flags: u32, columns: &[&[i32]], kind: u32, values: &[i32]) -> Vec<u8> {
        let starts: Vec<i32> = (0..=columns.len())
            .map(|c| columns[..c].iter().map(|rows| rows.len() as i32).sum())
            .collect();
        let n = columns.len() as u32;
        let values = [
            self.numbers(MI_INT32, &columns.concat()),
            self.numbers(MI_INT32, &starts),
            self.numbers(kind, values),
        ];
        self.variable(SPARSE | flags, &[n, n], "A", &values)
    }
}

const LITTLE: Writer = Writer;

/// A path 0 - 1 - 2, node 3 alone.
const PATH: [i32; 16] = [0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0];
const PATH_COLUMNS: [&[i32]; 4] = [&[1], &[0, 2], &[1], &[]];

fn is_path(file: &[u8]) -> bool {
    let graph = read(file, None).unwrap_or_else(|fault| panic!("{}", fault.in_file("f.mat")));
    graph.nodes() == 4 && graph.edges() == [(0, 1), (1, 2)]
}

fn refusal(file: &[u8]) -> String {
    read(file, None).unwrap_err().in_file("f.mat").to_string()
}

/// Full matrix of doubles with one variable, `A`.
fn full(size: &[u32], values: &[i32]) -> Vec<u8> {
    let values = [LITTLE.numbers(MI_DOUBLE, values)];
    LITTLE.file(&[LITTLE.variable(DOUBLE, size, "A", &values)])
}

#[test]
fn every_class_and_storage() {
    let writer = LITTLE;
    for class in DOUBLE..=15 {
        for kind in [1, 2, 3, 4, 5, 6, 7, 9, 12, 13] {
            for flags in [class, class | LOGICAL] {
                let values = [writer.numbers(kind, &PATH)];
                let variable = writer.variable(flags, &[4, 4], "A", &values);
                assert!(is_path(&writer.file(std::slice::from_ref(&variable))));
                assert!(is_path(&writer.file(&[writer.deflated(&variable)])));
            }
        }
    }
    for kind in [1, 2, 3, 4, 5, 6, 7, 9, 12, 13] {
        for flags in [0, LOGICAL] {
            let variable = writer.sparse(flags, &PATH_COLUMNS, kind, &[1, 2, 3, 1]);
            assert!(is_path(&writer.file(std::slice::from_ref(&variable))));
            assert!(is_path(&writer.file(&[writer.deflated(&variable)])));
        }
    }
}

/// Two cameras and one pair: four bytes of values in the tag.
#[test]
fn small_elements() {
    let writer = LITTLE;
    let values = [writer.small(MI_UINT8, &[0, 1, 1, 0])];
    let file = writer.file(&[writer.variable(DOUBLE, &[2, 2], "A", &values)]);
    assert_eq!(read(&file, None).unwrap().edges(), [(0, 1)]);
}

/// Zeros that are stored, and room behind the last entry.
#[test]
fn stored_zeros_are_no_pairs() {
    let columns: [&[i32]; 4] = [&[1, 3], &[0, 2], &[1], &[3]];
    let variable = LITTLE.sparse(0, &columns, MI_DOUBLE, &[1, 0, 1, 1, 1, 0]);
    assert!(is_path(&LITTLE.file(&[variable])));
    let values = [
        LITTLE.numbers(MI_INT32, &[1, 0, 2, 1, 0, 0]),
        LITTLE.numbers(MI_INT32, &[0, 1, 3, 4, 4]),
        LITTLE.numbers(MI_DOUBLE, &[1, 1, 1, 1, 7, 7]),
    ];
    assert!(is_path(&LITTLE.file(&[LITTLE.variable(
        SPARSE,
        &[4, 4],
        "A",
        &values
    )])));
}

#[test]
fn the_variable_is_a_or_the_only_square_one_or_the_one_named() {
    let variable = |size: &[u32], name: &str, values: &[i32]| {
        LITTLE.variable(DOUBLE, size, name, &[LITTLE.numbers(MI_UINT8, values)])
    };
    let path = |name| variable(&[4, 4], name, &PATH);
    let number = variable(&[1, 1], "count", &[4]);
    let list = variable(&[2, 1], "list", &[1, 2]);
    let pair = variable(&[2, 2], "pair", &[0, 1, 1, 0]);
    let text = LITTLE.variable(4, &[2, 2], "text", &[LITTLE.small(4, b"abcd")]);
    assert!(is_path(&LITTLE.file(&[pair.clone(), path("A")])));
    assert!(is_path(&LITTLE.file(&[
        number.clone(),
        list.clone(),
        path("graph"),
        text.clone()
    ])));
    let both = LITTLE.file(&[path("graph"), pair.clone()]);
    assert_eq!(
        refusal(&both),
        "f.mat: no variable A and 2 square matrices; the file holds graph (4x4), \
         pair (2x2); name the adjacency matrix with --variable"
    );
    assert_eq!(read(&both, Some("pair")).unwrap().nodes(), 2);
    let missing = read(&both, Some("A"))
        .unwrap_err()
        .in_file("f.mat")
        .to_string();
    assert!(
        missing.starts_with("f.mat: variable A: there is no such variable; the file holds graph")
    );
    assert!(
        refusal(&LITTLE.file(&[number, list]))
            .contains("there is no square matrix; the file holds count")
    );
    assert!(refusal(&LITTLE.file(&[])).contains("the file holds no variables"));
    assert!(refusal(&LITTLE.file(&[path("A"), path("A")])).contains("two variables of this name"));
    let named = read(&LITTLE.file(&[text]), Some("text"))
        .unwrap_err()
        .in_file("f.mat");
    assert!(
        named
            .to_string()
            .contains("variable text: this is no matrix of numbers")
    );
}

#[test]
fn what_is_no_adjacency_is_refused_with_its_place() {
    let starts = |text: String, start: &str| assert!(text.starts_with(start), "{text}");
    let place = |what| format!("f.mat: variable A: {what}");
    starts(
        refusal(&full(&[2, 3], &[0; 6])),
        &place("the matrix is 2x3, not square; give a square"),
    );
    starts(
        refusal(&full(&[2, 2, 2], &[0; 8])),
        &place("the matrix is 2x2x2, not square"),
    );
    starts(
        refusal(&full(&[0, 0], &[])),
        &place("the graph is empty; give"),
    );
    let (without_pairs, _) = Graph::from_pairs(3, Vec::new()).unwrap();
    assert_eq!(read(&full(&[3, 3], &[0; 9]), None).unwrap(), without_pairs);
    starts(
        refusal(&full(&[2, 2], &[0, 1, 1, 5])),
        &place("diagonal entry (2, 2) is non-zero"),
    );
    let complex = LITTLE.variable(DOUBLE | COMPLEX, &[2, 2], "A", &[]);
    starts(
        refusal(&LITTLE.file(&[complex])),
        &place("the matrix is complex; save"),
    );
    for class in [1, 2, 3, 4, 16] {
        let variable = LITTLE.variable(class, &[2, 2], "A", &[]);
        assert!(refusal(&LITTLE.file(&[variable])).contains("this is no matrix of numbers; give"));
    }
    let mut data = Vec::new();
    for value in [0.0, f64::NAN, 1.0, 0.0] {
        data.extend(value.to_le_bytes());
    }
    let values = [LITTLE.element(MI_DOUBLE, &data)];
    let nan = LITTLE.file(&[LITTLE.variable(DOUBLE, &[2, 2], "A", &values)]);
    starts(
        refusal(&nan),
        &place("entry (2, 1) is not a number (NaN); put zero"),
    );
}

/// Columns of which one entry has no mirror image: below, above, the last one.
#[test]
fn an_asymmetric_matrix_is_refused_with_the_entry() {
    type Columns = [&'static [i32]; 4];
    let cases: [(Columns, (u32, u32)); 4] = [
        ([&[1, 2], &[0], &[], &[]], (3, 1)),
        ([&[1], &[0], &[0], &[]], (1, 3)),
        ([&[1], &[0, 3], &[], &[2]], (4, 2)),
        ([&[1], &[0], &[], &[2]], (3, 4)),
    ];
    for (columns, (row, column)) in cases {
        let entries = vec![1; columns.concat().len()];
        let variable = LITTLE.sparse(0, &columns, MI_UINT8, &entries);
        let start = format!(
            "f.mat: variable A: the matrix is not symmetric: ({row}, {column}) is non-zero, \
             ({column}, {row}) is zero; if the direction"
        );
        let text = refusal(&LITTLE.file(&[variable]));
        assert!(text.starts_with(&start), "{text}");
    }
}

#[test]
fn sparse_indices_that_contradict_each_other_are_refused() {
    let sparse = |rows: &[i32], starts: &[i32], values: usize| {
        let values = [
            LITTLE.numbers(MI_INT32, rows),
            LITTLE.numbers(MI_INT32, starts),
            LITTLE.numbers(MI_DOUBLE, &vec![1; values]),
        ];
        refusal(&LITTLE.file(&[LITTLE.variable(SPARSE, &[2, 2], "A", &values)]))
    };
    for (rows, starts, values, problem) in [
        (&[1, 0][..], &[0, 1][..], 2, "the column starts"),
        (&[1, 0], &[0, 1, 2, 2], 2, "the column starts"),
        (&[1, 0], &[0, 1, 3], 3, "the column starts"),
        (&[1, 0], &[1, 1, 2], 2, "the column starts"),
        (&[1, 0], &[0, 2, 1], 2, "the column starts"),
        (&[1, 0], &[0, 1, -1], 2, "out of range"),
        (&[2, 0], &[0, 1, 2], 2, "the row numbers"),
        (&[1, 1, 0], &[0, 2, 3], 3, "the row numbers"),
        (&[1, 0], &[0, 1, 2], 1, "fewer values than entries"),
    ] {
        let text = sparse(rows, starts, values);
        assert!(
            text.contains("the file is corrupt") && text.contains(problem),
            "{text}"
        );
    }
}

#[test]
fn other_versions_are_refused_with_what_to_do() {
    let mut hdf5 = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".to_vec();
    hdf5.resize(600, 0);
    assert!(refusal(&hdf5).contains("viewcert.verify(h5py.File('FILE')['A'][:])"));
    let mut big = full(&[4, 4], &PATH);
    big[124..128].copy_from_slice(&[1, 0, b'M', b'I']);
    assert!(refusal(&big).contains("big-endian machine is not read here; save it"));
    assert!(!is_matlab(b"1 2\n2 3\n"));
    assert!(!is_matlab(&[0; 200]));
}

/// Every prefix of a file is refused, never a graph, and never by a panic.
#[test]
fn truncated_files_are_refused() {
    let sparse = LITTLE.sparse(0, &PATH_COLUMNS, MI_DOUBLE, &[1, 1, 1, 1]);
    for file in [
        LITTLE.file(&[LITTLE.deflated(&sparse)]),
        LITTLE.file(&[sparse]),
        full(&[4, 4], &PATH),
    ] {
        assert!(is_path(&file));
        for length in 0..file.len() {
            assert!(
                read(&file[..length], None).is_err(),
                "{length} of {}",
                file.len()
            );
        }
        let text = refusal(&file[..file.len() - 1]);
        assert!(
            text.starts_with("f.mat: the file is truncated: a variable takes"),
            "{text}"
        );
    }
}

#[test]
fn a_changed_byte_of_deflated_data_is_found_by_the_checksum() {
    let variable = LITTLE.sparse(0, &PATH_COLUMNS, MI_DOUBLE, &[1, 1, 1, 1]);
    let file = LITTLE.file(&[LITTLE.deflated(&variable)]);
    for at in HEADER_LENGTH + 8..file.len() {
        let mut changed = file.clone();
        changed[at] ^= 0x10;
        // Bits of the deflate stream that no symbol uses may change freely, and
        // two bits of the zlib header say only how it was packed.
        if let Ok(graph) = read(&changed, None) {
            assert_eq!(graph.edges(), [(0, 1), (1, 2)]);
        }
    }
    let last = file.len() - 1;
    let mut changed = file;
    changed[last] ^= 1;
    assert!(refusal(&changed).contains("the file is corrupt"));
}

/// Lengths that the file does not hold are refused before memory is taken.
#[test]
fn promises_are_not_believed() {
    let promise = |bytes: Vec<u8>| {
        let text = refusal(&bytes);
        assert!(
            text.contains("truncated") || text.contains("corrupt"),
            "{text}"
        );
    };
    let mut outer = LITTLE.file(&[LITTLE.words(MATRIX, &[0; 4])]);
    outer[HEADER_LENGTH + 4..HEADER_LENGTH + 8].copy_from_slice(&[0xf8, 0xff, 0xff, 0xff]);
    promise(outer);
    let large = i32::MAX as u32;
    let rows = LITTLE.numbers(MI_INT32, &[1, 0]);
    let starts = LITTLE.numbers(MI_INT32, &[0, 1, 2]);
    let values = LITTLE.numbers(MI_DOUBLE, &[1, 1]);
    let parts = [rows, starts, values];
    promise(LITTLE.file(&[LITTLE.variable(SPARSE, &[large, large], "A", &parts)]));
    promise(full(&[large, large], &[0, 1, 1, 0]));
    let mut inner = LITTLE.variable(DOUBLE, &[2, 2], "A", &[LITTLE.numbers(MI_DOUBLE, &[0; 4])]);
    let tag = inner.len() - 32 - 4;
    inner[tag..tag + 4].copy_from_slice(&0xffff_fff8u32.to_le_bytes());
    promise(LITTLE.file(std::slice::from_ref(&inner)));
    promise(LITTLE.file(&[LITTLE.deflated(&inner)]));
    inner[4..8].copy_from_slice(&0xffff_fff8u32.to_le_bytes());
    let text = refusal(&LITTLE.file(&[LITTLE.deflated(&inner)]));
    assert!(text.contains("deflated bytes cannot hold"), "{text}");
}

#[test]
fn entries_of_a_matrix_of_any_shape() {
    let file = full(&[2, 3], &[1, 0, 0, -4, 5, 0]);
    let entries = entries(&file, "A").unwrap();
    assert_eq!(entries, [(0, 0, 1.0), (1, 1, -4.0), (0, 2, 5.0)]);
}

proptest! {
    /// A random matrix against the definition: it is a graph exactly when it is
    /// symmetric, has an empty diagonal and an entry.
    #[test]
    fn sparse_and_full_agree_with_the_definition(
        n in 1usize..7,
        bits in prop::collection::vec(prop::bool::weighted(0.4), 49),
        mirror in prop::bool::weighted(0.8),
        deflate in any::<bool>(),
    ) {
        let entry = |r: usize, c: usize| if mirror {
r != c && bits[7 * r.min(c) + r.max(c)]
} else {
bits[7 * r + c]
};
        let writer = LITTLE;
        let dense: Vec<i32> = (0..n * n).map(|k| i32::from(entry(k % n, k / n))).collect();
        let columns: Vec<Vec<i32>> = (0..n)
            .map(|c| (0..n).filter(|&r| entry(r, c)).map(|r| r as i32).collect())
            .collect();
        let columns: Vec<&[i32]> = columns.iter().map(Vec::as_slice).collect();
        let ones = vec![1; columns.concat().len()];
        let size = [n as u32; 2];
        let values = [writer.numbers(MI_UINT8, &dense)];
        let edges: Vec<(u32, u32)> = (0..n)
            .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
            .filter(|&(i, j)| entry(i, j))
            .map(|(i, j)| (i as u32, j as u32))
            .collect();
        let proper = (0..n).all(|r| (0..=r).all(|c| entry(r, c) == entry(c, r) && !entry(r, r)));
        for variable in [
            writer.variable(DOUBLE, &size, "A", &values),
            writer.sparse(0, &columns, MI_DOUBLE, &ones),
        ] {
            let variable = if deflate { writer.deflated(&variable) } else { variable };
            match read(&writer.file(&[variable]), None) {
                Ok(graph) => {
                    prop_assert!(proper);
                    prop_assert_eq!(graph.edges(), &edges[..]);
                    prop_assert_eq!(graph.nodes(), n);
                }
                Err(_) => prop_assert!(!proper || edges.is_empty()),
            }
        }
    }
}

use std::io::Write;

use flate2::Compression;
use flate2::write::DeflateEncoder;
use proptest::prelude::*;

use super::*;
use viewcert::graph::Labels;

/// An array as NumPy writes it.
fn npy(descr: &str, fortran: bool, shape: &str, data: &[u8]) -> Vec<u8> {
    let fortran = if fortran { "True" } else { "False" };
    let header = format!("{{'descr': {descr}, 'fortran_order': {fortran}, 'shape': {shape}, }}\n");
    let length = (header.len() as u16).to_le_bytes();
    [MAGIC, &[1, 0], &length, header.as_bytes(), data].concat()
}

fn doubles(values: &[f64]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect()
}

/// A ZIP archive of these files, deflated.
fn npz(files: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut archive = rawzip::ZipArchiveWriter::new(&mut bytes);
    for (name, file) in files {
        let new = archive
            .new_file(name)
            .compression_method(rawzip::CompressionMethod::DEFLATE);
        let (mut entry, config) = new.start().unwrap();
        let mut writer = config.wrap(DeflateEncoder::new(&mut entry, Compression::best()));
        writer.write_all(file).unwrap();
        let (encoder, descriptor) = writer.finish().unwrap();
        encoder.finish().unwrap();
        entry.finish(descriptor).unwrap();
    }
    archive.finish().unwrap();
    bytes
}

fn refusal(found: Result<Parsed, Fault>) -> String {
    found.unwrap_err().in_file("in").to_string()
}

/// A path 0 - 1 - 2, node 3 alone.
const PATH: [f64; 16] = [
    0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
];

fn assert_path(found: Result<Parsed, Fault>) {
    let Parsed { graph, labels, .. } =
        found.unwrap_or_else(|fault| panic!("{}", fault.in_file("in")));
    assert_eq!((graph.nodes(), graph.edges()), (4, &[(0, 1), (1, 2)][..]));
    assert_eq!(labels, Labels::Numbers { first: 0 });
}

#[test]
fn every_type_in_both_orders_of_bytes() {
    fn write<const N: usize>(number: impl Fn(i8) -> [u8; N], big: bool) -> Vec<u8> {
        let mut data = Vec::new();
        for value in PATH {
            let mut bytes = number(value as i8);
            if big {
                bytes.reverse();
            }
            data.extend(bytes);
        }
        data
    }
    for big in [false, true] {
        let order = if big { '>' } else { '<' };
        for (kind, data) in [
            ("b1", write(|v| [v as u8], big)),
            ("i1", write(|v| v.to_le_bytes(), big)),
            ("u1", write(|v| [v as u8], big)),
            ("i2", write(|v| i16::from(v).to_le_bytes(), big)),
            ("u2", write(|v| (v as u16).to_le_bytes(), big)),
            ("i4", write(|v| i32::from(v).to_le_bytes(), big)),
            ("u4", write(|v| (v as u32).to_le_bytes(), big)),
            ("i8", write(|v| i64::from(v).to_le_bytes(), big)),
            ("u8", write(|v| (v as u64).to_le_bytes(), big)),
            ("f2", write(|v| (v as u16 * 0x3c00).to_le_bytes(), big)),
            ("f4", write(|v| f32::from(v).to_le_bytes(), big)),
            ("f8", write(|v| f64::from(v).to_le_bytes(), big)),
        ] {
            for fortran in [false, true] {
                let file = npy(&format!("'{order}{kind}'"), fortran, "(4, 4)", &data);
                assert_path(read(&file));
                assert_path(read_archive(&npz(&[("x.npy", file)]), None));
            }
        }
    }
}

/// Entries are called as NumPy calls them, whatever the order in which they are stored.
#[test]
fn the_place_of_a_bad_entry() {
    for (fortran, place, mirror) in [(false, "(0, 2)", "(2, 0)"), (true, "(2, 0)", "(0, 2)")] {
        let mut values = [0.0; 9];
        values[2] = 1.0;
        let text = refusal(read(&npy("'<f8'", fortran, "(3, 3)", &doubles(&values))));
        let expected = format!("in: the matrix is not symmetric: {place} is non-zero, {mirror} is");
        assert!(text.starts_with(&expected), "{text}");
        values[2] = f64::NAN;
        let text = refusal(read(&npy("'<f8'", fortran, "(3, 3)", &doubles(&values))));
        assert!(
            text.starts_with(&format!("in: entry {place} is not a number")),
            "{text}"
        );
    }
}

#[test]
fn lists_of_pairs() {
    let pairs = [5.0, 7.0, 7.0, 9.0, 9.0, 5.0];
    let expected = Labels::Integers(vec![5, 7, 9]);
    for (fortran, shape, values) in [
        (false, "(3, 2)", pairs),
        (true, "(2, 3)", pairs),
        (true, "(3, 2)", [5.0, 7.0, 9.0, 7.0, 9.0, 5.0]),
        (false, "(2, 3)", [5.0, 7.0, 9.0, 7.0, 9.0, 5.0]),
    ] {
        let Parsed {
            graph,
            labels,
            notes,
            ..
        } = read(&npy("'<f8'", fortran, shape, &doubles(&values))).unwrap();
        assert_eq!(
            (graph.nodes(), graph.edges().len(), labels),
            (3, 3, expected.clone())
        );
        let which = if shape == "(3, 2)" { "rows" } else { "columns" };
        assert_eq!(
            notes,
            [format!(
                "the {which} are pairs: two numbers of cameras each"
            )]
        );
    }
    let names = b"a\0b\0b\0cdcda\0";
    let Parsed { graph, labels, .. } = read(&npy("'|S2'", false, "(3, 2)", names)).unwrap();
    assert_eq!((graph.edges().len(), labels.label(2)), (3, "cd".into()));
}

#[test]
fn what_is_no_graph_is_refused() {
    for (descr, shape, size, phrase) in [
        ("'<f8'", "(3,)", 24, "the array is 3, and neither"),
        ("'<f8'", "()", 8, "the array is one value, and neither"),
        ("'<f8'", "(2, 2, 2)", 64, "the array is 2x2x2, and neither"),
        ("'<f8'", "(0, 0)", 0, "the graph is empty"),
        ("'<f8'", "(3, 4)", 96, "the array is 3x4, and neither"),
        ("'<c16'", "(2, 2)", 64, "the matrix is complex"),
        ("'|O'", "()", 9, "a NumPy array of Python objects"),
        (
            "'<M8[s]'",
            "(2, 2)",
            32,
            "a NumPy array of <M8[s] is not a numeric matrix",
        ),
        ("'<f16'", "(2, 2)", 64, "a NumPy array of <f16 is not"),
        (
            "[('a', '<i4')]",
            "(2, 2)",
            16,
            "a NumPy array of records is not",
        ),
        ("'<U1'", "(2, 3)", 24, "a NumPy array of text is not"),
        ("'<f8'", "(2, 2)", 31, "the file is truncated"),
        ("'<f8'", "(2, 2)", 33, "bytes follow the array"),
        (
            "'<f8'",
            "(4294967296, 4294967296)",
            8,
            "the graph has more than",
        ),
        ("'<f8'", "(65536, 65536)", 8, "the file is truncated"),
        (
            "'<i8'",
            "(1152921504606846976, 2)",
            8,
            "the file is truncated",
        ),
        (
            "'<U4096'",
            "(1152921504606846976, 2)",
            8,
            "the file is truncated",
        ),
    ] {
        let file = npy(descr, false, shape, &vec![0; size]);
        for found in [read(&file), read_archive(&npz(&[("A.npy", file)]), None)] {
            let text = refusal(found);
            // Within an archive it is the archive that is too long.
            assert!(
                text.contains(phrase) || text.contains("the file is"),
                "{text}"
            );
            assert!(text.contains("; "), "{text}");
        }
    }
    let one = npy("'<f8'", false, "(2, 2)", &doubles(&[0.0, 1.0, 1.0, 0.0]));
    let text = refusal(read(&[one.clone(), one].concat()));
    assert!(text.contains("a file of several NumPy arrays"), "{text}");
}

#[test]
fn the_array_that_is_meant() {
    let square = |name| (name, npy("'<f8'", false, "(4, 4)", &doubles(&PATH)));
    let list = ("ids.npy", npy("'<f8'", false, "(4,)", &doubles(&[1.0; 4])));
    let Parsed { notes, .. } =
        read_archive(&npz(&[square("adj.npy"), list.clone()]), None).unwrap();
    assert_eq!(
        notes,
        ["the graph is the variable adj, the only one that can be"]
    );
    let two = npz(&[square("x.npy"), square("y.npy"), list.clone()]);
    assert_eq!(
        refusal(read_archive(&two, None)),
        "in: no variable A and 2 square matrices; the file holds x (4x4 float64), y (4x4 float64), \
         ids (4 float64); name the adjacency matrix with --variable"
    );
    assert_path(read_archive(&two, Some("y")));
    assert_path(read_archive(
        &npz(&[square("x.npy"), square("A.npy")]),
        None,
    ));
    let text = refusal(read_archive(&npz(&[list]), None));
    assert!(
        text.contains("there is no square matrix, and there are no two columns"),
        "{text}"
    );
    let text = refusal(read_archive(
        &npz(&[square("x.npy"), square("x.npy")]),
        None,
    ));
    assert!(text.contains("two arrays of one name"), "{text}");
    let text = refusal(read_archive(b"PK\x03\x04", None));
    assert!(text.contains("the ZIP archive: "), "{text}");
}

/// A sparse matrix of the path, by the arrays that SciPy writes.
fn sparse(format: &str, arrays: &[(&str, &[i32])]) -> Vec<u8> {
    let integers = |values: &[i32]| -> Vec<u8> {
        let data: Vec<u8> = values
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect();
        npy("'<i4'", false, &format!("({},)", values.len()), &data)
    };
    let mut files = vec![
        ("format.npy", npy("'|S3'", false, "()", format.as_bytes())),
        ("shape.npy", integers(&[4, 4])),
    ];
    files.extend(
        arrays
            .iter()
            .map(|&(name, values)| (name, integers(values))),
    );
    npz(&files)
}

#[test]
fn sparse_matrices_of_scipy() {
    let data = ("data.npy", &[1, 1, 1, 1][..]);
    let rows = [
        ("indices.npy", &[1, 2, 0, 1][..]),
        ("indptr.npy", &[0, 1, 3, 4, 4]),
        data,
    ];
    for format in ["csr", "csc"] {
        assert_path(read_archive(&sparse(format, &rows), None));
    }
    let places = [
        ("row.npy", &[1, 0, 2, 1][..]),
        ("col.npy", &[0, 1, 1, 2]),
        data,
    ];
    assert_path(read_archive(&sparse("coo", &places), None));
    for (format, arrays, phrase) in [
        ("dia", &rows[..], "stored by diagonals"),
        (
            "csr",
            &rows[1..],
            "a sparse matrix without its array `indices`",
        ),
        (
            "coo",
            &places[1..],
            "a sparse matrix without its array `row`",
        ),
        (
            "csr",
            &[("indices.npy", &[1, 2, 0, 4]), rows[1], data],
            "the indices of a sparse",
        ),
        (
            "csr",
            &[("indices.npy", &[1, 2, 0, -1]), rows[1], data],
            "out of range",
        ),
        (
            "csr",
            &[rows[0], ("indptr.npy", &[0, 1, 3, 4]), data],
            "the indices of a sparse",
        ),
        (
            "csr",
            &[rows[0], ("indptr.npy", &[0, 3, 1, 4, 4]), data],
            "the indices of a sparse",
        ),
        (
            "csr",
            &[rows[0], rows[1], ("data.npy", &[1, 1, 1])],
            "the indices of a sparse",
        ),
        (
            "coo",
            &[("row.npy", &[1, 0, 2]), places[1], data],
            "the indices of a sparse",
        ),
        ("bsr", &rows, "the blocks of a sparse matrix"),
        (
            "coo",
            &[("row.npy", &[1, 3, 2, 1]), places[1], data],
            "(1, 0) is non-zero, (0, 1) is zero",
        ),
    ] {
        let text = refusal(read_archive(&sparse(format, arrays), None));
        assert!(text.contains(phrase), "{format}: {text}");
    }
    // An array of it can be named like any other.
    let text = refusal(read_archive(&sparse("csr", &rows), Some("data")));
    assert!(
        text.starts_with("in: variable data: the array is 4, and neither"),
        "{text}"
    );
}

/// What 200 bytes promise takes no memory.
#[test]
fn promises_are_not_believed() {
    let zeros = vec![0; 1 << 20];
    for (descr, shape) in [
        ("'<f8'", "(4294967295, 4294967295)"),
        ("'<i8'", "(2305843009213693951, 2)"),
        ("'<f8'", "(1073741824, 1073741824)"),
    ] {
        let file = npy(descr, false, shape, &zeros);
        let text = refusal(read(&file));
        assert!(
            text.contains("truncated") || text.contains("corrupt"),
            "{text}"
        );
        let archive = npz(&[("A.npy", file)]);
        assert!(archive.len() < 2000);
        let text = refusal(read_archive(&archive, None));
        assert!(
            text.contains("truncated") || text.contains("corrupt"),
            "{text}"
        );
    }
    let wide = [("data.npy", &[1][..]), ("row.npy", &[0]), ("col.npy", &[1])];
    let rows: Vec<u8> = [i32::MAX; 2]
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    let mut parts = vec![
        ("format.npy", npy("'|S3'", false, "()", b"coo")),
        ("shape.npy", npy("'<i4'", false, "(2,)", &rows)),
    ];
    for (name, values) in wide {
        let data: Vec<u8> = values
            .iter()
            .flat_map(|value: &i32| value.to_le_bytes())
            .collect();
        parts.push((name, npy("'<i4'", false, "(1,)", &data)));
    }
    let found = read_archive(&npz(&parts), None).unwrap_err();
    assert!(found.problem.is_size(), "{}", found.problem);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// Changed bytes are read or refused; what is read is a graph.
    #[test]
    fn damage_is_no_panic(
        which in 0..4usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        end in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let dense = npy("'<f8'", false, "(4, 4)", &doubles(&PATH));
        let data = ("data.npy", &[1, 1, 1, 1][..]);
        let mut bytes = match which {
            0 => dense,
            1 => npz(&[("A.npy", dense)]),
            2 => sparse("csr", &[("indices.npy", &[1, 2, 0, 1]), ("indptr.npy", &[0, 1, 3, 4, 4]), data]),
            _ => sparse("coo", &[("row.npy", &[1, 0, 2, 1]), ("col.npy", &[0, 1, 1, 2]), data]),
        };
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if let Some(end) = end {
            bytes.truncate(end.index(bytes.len()));
        }
        let found = [read(&bytes), read_archive(&bytes, None), read_archive(&bytes, Some("A"))];
        for Parsed { graph, .. } in found.into_iter().flatten() {
            prop_assert!(graph.edges().is_sorted_by(|a, b| a < b));
            prop_assert!(graph.edges().iter().all(|&(i, j)| i < j && (j as usize) < graph.nodes()));
        }
    }
}

//! The readers on the published graphs.

mod common;

use common::{data, verify, verify_with};
use std::collections::BTreeMap;
use std::path::Path;

use viewcert::graph::{Graph, Labels};
use viewcert_formats::{ReadOptions, matlab, read_graphs};

fn read_one(path: &Path) -> Graph {
    let path = path.to_str().unwrap();
    let mut graphs = read_graphs(path, &ReadOptions::default());
    let named = graphs
        .next()
        .unwrap()
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(graphs.next().is_none());
    assert_eq!(named.name, path);
    assert_eq!(named.labels, Labels::Numbers { first: 1 });
    named.graph
}

/// All 29 graphs of the paper's Table 3, sparse and deflated.
#[test]
fn table_3_has_the_published_nodes_and_edges() {
    let Some(data) = data() else { return };
    let table = std::fs::read_to_string(data.join("table3.csv")).unwrap();
    let mut rows = table.lines();
    assert!(
        rows.next()
            .unwrap()
            .starts_with("name,file,nodes,density_percent,edges,")
    );
    let mut graphs = 0;
    for row in rows {
        let fields: Vec<&str> = row.split(',').collect();
        let graph = read_one(&data.join("table3").join(fields[1]));
        assert_eq!(graph.nodes().to_string(), fields[2], "nodes of {row}");
        assert_eq!(graph.edges().len().to_string(), fields[4], "edges of {row}");
        graphs += 1;
    }
    assert_eq!(graphs, 29);
}

/// The five synthetic graphs. `house`, `triangles2` and `triangles3` also hold
/// `gt_comp`, the true component of every edge in the order in which edges are
/// numbered here, and `ncomp_gt`, how many there are: with that order every
/// component of the last two is a triangle, and the house is one triangle and
/// three edges.
#[test]
fn synthetic_graphs_and_their_true_components() {
    let Some(data) = data() else { return };
    let data = data.join("synthetic");
    for (name, nodes, edges) in [("G9", 9, 12), ("G90", 90, 140)] {
        let graph = read_one(&data.join(format!("{name}.mat")));
        assert_eq!((graph.nodes(), graph.edges().len()), (nodes, edges));
    }
    for (name, nodes, sizes) in [
        ("house", 5, vec![1, 1, 1, 3]),
        ("triangles2", 5, vec![3, 3]),
        ("triangles3", 7, vec![3, 3, 3]),
    ] {
        let path = data.join(format!("{name}.mat"));
        let graph = read_one(&path);
        assert_eq!(graph.nodes(), nodes);
        let bytes = std::fs::read(path).unwrap();
        let values = |variable| matlab::entries(&bytes, variable).unwrap();
        let components = values("gt_comp");
        assert_eq!(components.len(), graph.edges().len());
        let mut members: BTreeMap<u64, Vec<(u32, u32)>> = BTreeMap::new();
        for (edge, (row, column, component)) in (0..).zip(components) {
            assert_eq!((row, column), (edge, 0));
            let edge = graph.edges()[edge as usize];
            members.entry(component as u64).or_default().push(edge);
        }
        assert_eq!(values("ncomp_gt"), [(0, 0, members.len() as f64)]);
        let mut found: Vec<usize> = members.values().map(Vec::len).collect();
        found.sort_unstable();
        assert_eq!(found, sizes);
        for edges in members.values().filter(|edges| edges.len() == 3) {
            // Three sorted edges are a triangle exactly in this form.
            let [(a, b), (c, d), (e, f)] = edges[..] else {
                panic!("three edges");
            };
            assert_eq!((a, b, d), (c, e, f), "{name}: {edges:?}");
        }
    }
}

/// Section 2 of docs/certificate.md, written down once more without any thought of speed.
mod the_page {
    use std::collections::BTreeSet;

    pub struct Field {
        text: String,
        quoted: bool,
    }

    impl Field {
        fn is_number(&self) -> bool {
            !self.quoted && is_number(&self.text)
        }

        fn integer(&self) -> Option<u64> {
            if self.quoted {
                None
            } else {
                integer(&self.text)
            }
        }
    }

    fn is_number(text: &str) -> bool {
        let text = text.strip_prefix(['+', '-']).unwrap_or(text);
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, Some(exponent)),
            None => (text, None),
        };
        let digits = |text: &str| text.chars().all(|c| c.is_ascii_digit());
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        digits(whole)
            && digits(fraction)
            && !(whole.is_empty() && fraction.is_empty())
            && exponent.is_none_or(|exponent| {
                let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
                !exponent.is_empty() && digits(exponent)
            })
    }

    fn integer(text: &str) -> Option<u64> {
        let value: u64 = text.parse().ok()?;
        (value.to_string() == text).then_some(value)
    }

    /// The lines of a text.
    fn lines(bytes: &[u8]) -> Option<Vec<String>> {
        let text = String::from_utf8(bytes.to_vec()).ok()?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        let lines: Vec<String> = text
            .split('\n')
            .map(|line| line.strip_suffix('\r').unwrap_or(line).to_owned())
            .collect();
        let bad = |c: char| c < ' ' && c != '\t' || c == '\x7f' || c == '\u{feff}';
        (!lines.iter().any(|line| line.contains(bad))).then_some(lines)
    }

    fn fields(line: &str) -> Option<Vec<Field>> {
        let mut rest: &str = line;
        let mut fields = Vec::new();
        loop {
            let trimmed = rest.trim_start_matches([' ', '\t', ',']);
            let commas = rest[..rest.len() - trimmed.len()].matches(',').count();
            rest = trimmed;
            let over = rest.is_empty() || rest.starts_with(['#', '%']);
            if commas > 1 || commas == 1 && (over || fields.is_empty()) {
                return None;
            }
            if over {
                return Some(fields);
            }
            if let Some(inner) = rest.strip_prefix('"') {
                // Doubled quotes are hidden while the closing one is looked for.
                let hidden = inner.replace("\"\"", "\u{1}\u{1}");
                let end = hidden.find('"')?;
                let text = hidden[..end].replace("\u{1}\u{1}", "\"");
                rest = &inner[end + 1..];
                if text.is_empty() || !(rest.is_empty() || rest.starts_with([' ', '\t', ','])) {
                    return None;
                }
                fields.push(Field { text, quoted: true });
            } else {
                let end = rest.find([' ', '\t', ',']).unwrap_or(rest.len());
                let text = rest[..end].to_owned();
                rest = &rest[end..];
                if text.contains('"') {
                    return None;
                }
                let quoted = false;
                fields.push(Field { text, quoted });
            }
        }
    }

    fn brackets_close(text: &str) -> bool {
        let mut left: String = text.chars().filter(|c| "()[]{}".contains(*c)).collect();
        loop {
            let shorter = left.replace("()", "").replace("[]", "").replace("{}", "");
            if shorter == left {
                return left.is_empty();
            }
            left = shorter;
        }
    }

    const PAIRS: &str = "source target from to src dst node1 node2 node_1 node_2 image1 image2 \
         image_1 image_2 image_id1 image_id2 name1 name2 name_1 name_2 id1 id2";

    fn is_head(a: &str, b: &str) -> bool {
        let words: Vec<&str> = PAIRS.split_whitespace().collect();
        let (a, b) = (a.to_ascii_lowercase(), b.to_ascii_lowercase());
        words.chunks(2).any(|pair| pair[0] == a && pair[1] == b)
    }

    /// Labels in the order of the nodes, and the edges.
    pub type Listed = (Vec<String>, BTreeSet<(usize, usize)>);

    fn numbered(pairs: &[(String, String)], singles: &[String]) -> Option<Listed> {
        let mut labels: Vec<String> = pairs
            .iter()
            .flat_map(|(a, b)| [a.clone(), b.clone()])
            .chain(singles.iter().cloned())
            .collect();
        if labels.iter().all(|label| integer(label).is_some()) {
            labels.sort_by_key(|label| integer(label));
        } else {
            labels.sort();
        }
        labels.dedup();
        let place = |label: &String| labels.iter().position(|other| other == label).unwrap();
        let mut edges = BTreeSet::new();
        for (a, b) in pairs {
            if a == b {
                return None;
            }
            edges.insert((place(a).min(place(b)), place(a).max(place(b))));
        }
        Some((labels, edges))
    }

    pub fn lenient(bytes: &[u8]) -> Option<Listed> {
        let (mut pairs, mut singles) = (Vec::new(), Vec::new());
        for line in lines(bytes)? {
            match &fields(&line)?[..] {
                [] => {}
                [one] => singles.push(one.text.clone()),
                [a, b, ..] => pairs.push((a.text.clone(), b.text.clone())),
            }
        }
        if pairs.is_empty() && singles.is_empty() {
            return None;
        }
        numbered(&pairs, &singles)
    }

    pub fn strict(bytes: &[u8]) -> Option<Listed> {
        let lines = lines(bytes)?;
        let mut rows: Vec<Vec<Field>> = Vec::new();
        let mut hashes = Vec::new();
        for line in &lines {
            let found = fields(line)?;
            if line.trim_matches([' ', '\t']) == "#" {
                hashes.push(rows.len());
            }
            if !found.is_empty() {
                rows.push(found);
            }
        }
        let columns = rows.first()?.len();
        if ![2, 3, 9, 14].contains(&columns) || rows.iter().any(|row| row.len() != columns) {
            return None;
        }
        for field in rows.iter().flatten().filter(|field| !field.quoted) {
            let word = |c: char| c.is_ascii_alphanumeric() || !c.is_ascii();
            if !field.text.contains(word) || field.text.starts_with("//") {
                return None;
            }
        }
        // The head.
        let first = &rows[0];
        let occurs = |label: &str| {
            let labels = rows[1..].iter().flat_map(|row| &row[..2]);
            labels.into_iter().any(|field| field.text == label)
        };
        let either_occurs = first[..2].iter().any(|field| occurs(&field.text));
        let numbers = first[2..].iter().all(Field::is_number);
        let head = if !numbers && !first[..2].iter().any(Field::is_number) {
            let mut behind = first[1..].windows(2);
            if behind.any(|two| is_head(&two[0].text, &two[1].text)) || either_occurs {
                return None;
            }
            true
        } else {
            numbers && is_head(&first[0].text, &first[1].text) && !either_occurs
        };
        let rows = &rows[usize::from(head)..];
        if rows.is_empty()
            || rows
                .iter()
                .any(|row| !row[2..].iter().all(Field::is_number))
        {
            return None;
        }
        for field in rows
            .iter()
            .flat_map(|row| &row[..2])
            .filter(|field| !field.quoted)
        {
            if field.text.ends_with([';', ':']) || !brackets_close(&field.text) {
                return None;
            }
        }
        let pairs: Vec<(String, String)> = rows
            .iter()
            .map(|row| (row[0].text.clone(), row[1].text.clone()))
            .collect();
        let listed = numbered(&pairs, &[])?;
        // What it could be else.
        let quoted = rows.iter().any(|row| row[0].quoted || row[1].quoted);
        let integers: Option<Vec<Vec<u64>>> = rows
            .iter()
            .map(|row| row.iter().map(Field::integer).collect())
            .collect();
        if !head
            && !quoted
            && let Some(rows) = &integers
        {
            let others: BTreeSet<u64> = rows[1..].iter().flatten().copied().collect();
            let counts = columns == 2
                && rows[0][1] == rows.len() as u64 - 1
                && rows[0][0] >= others.len() as u64;
            let matrix = rows.len() == columns && rows.iter().flatten().all(|&value| value < 2);
            if counts || matrix {
                return None;
            }
            if columns == 3 {
                let largest = rows.iter().map(|row| row[0].max(row[1])).max()?;
                let stars = rows.iter().all(|row| {
                    row[0] < row[1] && row[1] < row[2] && row[2] <= largest.saturating_add(1)
                });
                let behind = |node: u64, other: u64| {
                    let mut lines = rows.iter();
                    lines.any(|row| row[0] == node && row[1..].contains(&other))
                };
                let neighbours = rows.windows(2).all(|two| two[0][0] < two[1][0])
                    && rows.iter().all(|row| {
                        row[0] != row[1]
                            && row[0] != row[2]
                            && row[1] != row[2]
                            && behind(row[1], row[0])
                            && behind(row[2], row[0])
                    });
                if stars || neighbours {
                    return None;
                }
            }
        }
        if let [at] = hashes[..] {
            let at = at.saturating_sub(usize::from(head));
            let (nodes, edges) = pairs.split_at(at);
            let firsts: BTreeSet<&String> = nodes.iter().map(|pair| &pair.0).collect();
            let listed = |label| firsts.contains(label);
            if !nodes.is_empty()
                && !edges.is_empty()
                && firsts.len() == nodes.len()
                && edges.iter().all(|(a, b)| listed(a) && listed(b))
            {
                return None;
            }
        }
        let (own, other): (Vec<&String>, Vec<&String>) = listed
            .0
            .iter()
            .partition(|label| **label == pairs[0].0 || **label == pairs[0].1);
        if !head
            && pairs.len() > 1
            && !either_occurs
            && own.iter().all(|label| !is_number(label))
            && other.iter().all(|label| integer(label).is_some())
        {
            return None;
        }
        let decimal = |label: &String| label.contains(['.', 'e', 'E']);
        if !quoted && listed.0.iter().all(|label| is_number(label)) && listed.0.iter().any(decimal)
        {
            return None;
        }
        Some(listed)
    }
}

/// The reader of edge lists and the page agree on every text.
mod edge_lists {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::{Config, TestRunner};
    use std::cell::Cell;
    use viewcert_formats::read::graphs;
    use viewcert_formats::{Format, ReadError};

    fn choice(words: &'static str) -> impl Strategy<Value = String> + Clone {
        let words: Vec<&str> = words.split(' ').collect();
        prop::sample::select(words).prop_map(|word| word.replace('_', " "))
    }

    /// A text that is an edge list, or nearly one: a kind of labels, so many columns, and little
    /// that does not belong.
    fn text() -> impl Strategy<Value = String> {
        let label = |kind: u8| match kind {
            0 => (0..5u32).prop_map(|value| value.to_string()).boxed(),
            1 => (0..2u32).prop_map(|value| value.to_string()).boxed(),
            2 => choice("7 4294967295 4294967296 18446744073709551615 18446744073709551616 10 9")
                .boxed(),
            3 => choice("1 1.5 2 -2 3e1 07 .5").boxed(),
            4 => choice("a b c d \"a\" \"x_y\" 1 \"1\" \"q\"\"r\" f(1) \u{e9}").boxed(),
            _ => choice("from to source target a 1").boxed(),
        };
        let odd = choice(
            "-> // //a x; k: (1 \"\" \" a\"b \"a\"b nan i \"->\" \"(1\" # %c \u{feff} 1e 0.5 [a](b) (a] a,,b ,",
        );
        let head = choice(
            "source,target from_to FROM,To id,source,target i_j_w a_b_c image1,image2,9 \"name1\",\"name2\" 5_4 4_3 3_2 5_5 src,dst,n,1,2,3,4,5,6",
        );
        let further = |kind: u8| match kind {
            0 => choice("1 0.5 -3. +.5e-7 7").boxed(),
            1 => choice("2 3 4 5 6").boxed(),
            _ => choice("1 2 9").boxed(),
        };
        let separator = || prop::sample::select(vec![" ", " ", "\t", ",", ", ", " ,", "  "]);
        let end = || {
            prop::sample::select(vec![
                "\n", "\n", "\n", "\r\n", " \n", " # c\n", "\n\n", "\n#\n",
            ])
        };
        let columns = prop::sample::select(vec![2usize, 2, 2, 2, 3, 3, 3, 9, 14, 1, 4]);
        (0..6u8, 0..3u8, columns)
            .prop_flat_map(move |(kind, more, columns)| {
                let fields = (
                    label(kind),
                    label(kind),
                    prop::collection::vec(further(more), columns.saturating_sub(2)),
                );
                let line =
                    (fields, separator(), end()).prop_map(move |((a, b, more), separator, end)| {
                        let mut fields = vec![a, b];
                        fields.extend(more);
                        fields.truncate(columns);
                        fields.join(separator) + end
                    });
                (
                    prop::collection::vec(line, 0..24),
                    prop::option::weighted(0.3, head.clone()),
                    prop::option::weighted(0.2, (odd.clone(), any::<prop::sample::Index>())),
                    any::<bool>(),
                )
            })
            .prop_map(|(lines, head, odd, cut)| {
                let mut text: String = head
                    .map(|head| head + "\n")
                    .into_iter()
                    .chain(lines)
                    .collect();
                if let Some((odd, at)) = odd {
                    let places: Vec<usize> = text
                        .char_indices()
                        .map(|(at, _)| at)
                        .chain([text.len()])
                        .collect();
                    text.insert_str(places[at.index(places.len())], &odd);
                }
                if cut && text.ends_with('\n') {
                    text.pop();
                }
                text
            })
    }

    fn read(text: &str, format: Option<Format>) -> Result<the_page::Listed, ReadError> {
        let options = ReadOptions {
            format,
            ..ReadOptions::default()
        };
        let input = std::io::Cursor::new(text.as_bytes().to_vec());
        let mut graphs = graphs("in".to_owned(), input, options);
        let named = graphs.next().unwrap()?;
        let nodes = 0..named.graph.nodes() as u32;
        let labels = nodes.map(|node| named.labels.label(node).into_owned());
        let edges = named.graph.edges().iter();
        let edges = edges.map(|&(i, j)| (i as usize, j as usize));
        Ok((labels.collect(), edges.collect()))
    }

    fn is_stars(text: &str) -> bool {
        let input = std::io::Cursor::new(text.as_bytes().to_vec());
        let named = graphs("in".to_owned(), input, ReadOptions::default()).next();
        let note = "each line joins its first field with all others";
        matches!(named, Some(Ok(named)) if named.notes.iter().any(|one| one == note))
    }

    #[test]
    fn agree_with_the_page() {
        let (strict, lenient) = (Cell::new(0), Cell::new(0));
        let cases = 20_000;
        let mut runner = TestRunner::new(Config::with_cases(cases));
        runner
            .run(&text(), |text| {
                let expected = the_page::strict(text.as_bytes());
                strict.set(strict.get() + usize::from(expected.is_some()));
                let found = read(&text, None).ok();
                // Lists of neighbours are no edge lists, and read all the same.
                if expected.is_some() || found.is_none() || !is_stars(&text) {
                    prop_assert_eq!(found, expected, "strictly");
                }
                let expected = the_page::lenient(text.as_bytes());
                lenient.set(lenient.get() + usize::from(expected.is_some()));
                let found = read(&text, Some(Format::Edges));
                prop_assert_eq!(found.ok(), expected, "leniently");
                Ok(())
            })
            .unwrap();
        // Enough of both kinds to mean something.
        for accepted in [strict.get(), lenient.get()] {
            assert!((1000..19_000).contains(&accepted), "{accepted} of {cases}");
        }
    }
}

/// nauty's programs write the same graphs in three encodings.
mod sparse6 {
    use super::*;
    use std::process::Command;

    /// What a program of nauty writes on standard output; `None` if it is not installed.
    fn nauty(program: &str, arguments: &[&str]) -> Option<Vec<u8>> {
        for name in [program.to_owned(), format!("nauty-{program}")] {
            if let Ok(made) = Command::new(&name).args(arguments).output() {
                assert!(made.status.success(), "{name} {arguments:?}");
                return Some(made.stdout);
            }
        }
        eprintln!("SKIPPED: neither {program} nor nauty-{program} is installed");
        None
    }

    #[test]
    fn random_graphs_are_those_of_graph6() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
        let mut graphs = 0;
        for (nodes, seed) in [1, 2, 3, 4, 5, 7, 8, 9, 16, 17, 32, 33, 63, 64, 70, 130]
            .into_iter()
            .zip(1..)
        {
            let (nodes, seed) = (nodes.to_string(), format!("-S{seed}"));
            for density in ["-P2", "-P9"] {
                let arguments = ["-s", "-q", density, &seed, &nodes, "65"];
                let Some(made) = nauty("genrang", &arguments) else {
                    return;
                };
                let random = path("random.s6");
                std::fs::write(&random, &made).unwrap();
                let all = |name: &str, option: &str| -> Option<Vec<Graph>> {
                    let file = path(name);
                    std::fs::write(&file, nauty("copyg", &[option, "-q", &random])?).unwrap();
                    let graphs = read_graphs(&file, &ReadOptions::default());
                    Some(graphs.map(|graph| graph.unwrap().graph).collect())
                };
                let Some(graph6) = all("random.g6", "-g") else {
                    return;
                };
                let sparse: Vec<Graph> = read_graphs(&random, &ReadOptions::default())
                    .map(|graph| graph.unwrap().graph)
                    .collect();
                assert_eq!(sparse, graph6);
                for option in ["-i", "-I3", "-sh"] {
                    assert_eq!(all("other.s6", option).unwrap(), graph6, "{option}");
                }
                graphs += graph6.len();
            }
        }
        assert_eq!(graphs, 2080);
    }
}

/// Two programs read edge lists, the prover and the checker, without a line in common. What the
/// first accepts, the second must read as the same graph (the first refuses more: control
/// characters, graphs without pairs).
mod two_readers {
    use super::*;
    use proptest::prelude::*;
    use viewcert::graph::sha256;

    fn text() -> impl Strategy<Value = String> {
        let label = prop_oneof![
            (0..30u32).prop_map(|number| number.to_string()),
            prop::sample::select(vec![
                "00",
                "07",
                "-3",
                "1.5",
                "a",
                "b7",
                "7b",
                "x#y",
                "\u{e9}",
                "4294967296",
                "9999999999999999999",
                "18446744073709551615",
                "18446744073709551616",
                "99999999999999999999",
            ])
            .prop_map(String::from),
        ];
        let separator = prop::sample::select(vec![" ", "\t", ",", " , ", "  "]);
        let end = prop::sample::select(vec![
            "\n", "\r\n", " \n", " # c\n", "%c\n", " 0.5\n", "\n\n", "",
        ]);
        let line = (label.clone(), separator, label, end, 0..20u8);
        let lines = prop::collection::vec(line, 0..12);
        lines.prop_map(|lines| {
            let mut text = String::new();
            for (first, separator, second, end, kind) in lines {
                match kind {
                    0 => text += &format!("{separator}{first}{end}"),
                    1 => text += &format!("#{first}{separator}{second}\n"),
                    2 => text += end,
                    _ => text += &format!("{first}{separator}{second}{end}"),
                }
            }
            text
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]
        #[test]
        fn agree(text in text()) {
            let path = concat!(env!("CARGO_TARGET_TMPDIR"), "/two-readers.txt");
            std::fs::write(path, &text).unwrap();
            if let Some(Ok(named)) = read_graphs(path, &ReadOptions::default()).next() {
                let checked = viewcert_check::Graph::read(text.as_bytes(), || None);
                prop_assert_eq!(checked.unwrap().sha256(), sha256(&named.graph));
            }
        }
    }
}

/// What the checker and the program both read is one graph for both: a file of another format is
/// never an edge list for the one and something else for the other.
mod one_graph_for_both {
    use super::*;
    use proptest::prelude::*;
    use std::cell::Cell;
    use std::io::Cursor;
    use viewcert::graph::sha256;
    use viewcert_formats::NamedGraph;
    use viewcert_formats::read::graphs;

    /// The first graph that the program finds in these bytes, if both programs read them.
    fn both(bytes: &[u8]) -> Option<(NamedGraph, viewcert_check::Graph)> {
        let input = Cursor::new(bytes.to_vec());
        let named = graphs("in".to_owned(), input, ReadOptions::default()).next()?;
        let checked = viewcert_check::Graph::read(bytes, || None);
        Some((named.ok()?, checked.ok()?))
    }

    #[test]
    fn of_all_samples() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/foreign");
        let mut alike = 0;
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if let Some((named, checked)) = both(&std::fs::read(&path).unwrap()) {
                assert_eq!(checked.sha256(), sha256(&named.graph), "{}", path.display());
                alike += 1;
            }
        }
        assert!(alike >= 20, "{alike}");
    }

    /// Lines of words of all formats, whose columns are often as many as edge lists have.
    fn text() -> impl Strategy<Value = String> {
        let words = vec![
            "strict",
            "graph",
            "digraph",
            "graph{",
            "{",
            "}",
            "{a--b",
            "b--c}",
            "{a->b",
            "c->a}",
            "a",
            "b",
            "c;",
            "--",
            "a--b",
            "[x=1]",
            "//",
            "/*",
            "*/x",
            "\"a",
            "b\"",
            "\"c\"",
            "#",
            "EDGE_SE2",
            "VERTEX_SE2",
            "VERTEX_SE3:QUAT",
            "EDGE_SE3:QUAT",
            "FIX",
            "PARAMS_X",
            "0",
            "1",
            "2",
            "3",
            "4",
            "7",
            "0.5",
            "<graphml>",
            "{\"nodes\":",
            "[]}",
            "subgraph",
        ];
        let word = prop::sample::select(words);
        let columns = prop::sample::select(vec![1usize, 2, 2, 2, 3, 3, 4, 6, 9, 13]);
        let first = prop::sample::select(vec![
            "strict graph",
            "graph x{",
            "digraph",
            "EDGE_SE2 0",
            "VERTEX_SE3:QUAT 1",
            "0 1",
            "0",
            "",
        ]);
        let line = move |columns| prop::collection::vec(word.clone(), columns);
        let lines = columns.prop_flat_map(move |columns| {
            let one = prop_oneof![9 => line(columns), 1 => line(columns + 1)];
            prop::collection::vec(one, 1..5)
        });
        (first, lines, prop::sample::select(vec!["\n", " ", ""])).prop_map(|(first, lines, end)| {
            let lines: Vec<String> = lines.iter().map(|words| words.join(" ")).collect();
            format!("{first}{end}{}\n", lines.join("\n"))
        })
    }

    #[test]
    fn of_texts_between_the_formats() {
        let (read, alike) = (Cell::new(0), Cell::new(0));
        let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig::with_cases(60_000));
        runner
            .run(&text(), |text| {
                let input = Cursor::new(text.clone().into_bytes());
                let named = graphs("in".to_owned(), input, ReadOptions::default()).next();
                read.set(read.get() + usize::from(named.is_some_and(|named| named.is_ok())));
                if let Some((named, checked)) = both(text.as_bytes()) {
                    prop_assert_eq!(checked.sha256(), sha256(&named.graph));
                    alike.set(alike.get() + 1);
                }
                Ok(())
            })
            .unwrap();
        // Some are read by the program alone, and some by both.
        let (read, alike) = (read.get(), alike.get());
        assert!(
            alike > 100 && read > alike + 20,
            "{read} read, {alike} by both"
        );
    }
}

/// What this program writes is no graph, and the message says what to do with it.
#[test]
fn own_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).unwrap();
        path(name)
    };
    let graph = write("graph.txt", "a b\nb c\nc a\n");
    let [certificate, page, picture] = ["c.json", "page.html", "picture.svg"].map(path);
    let options = [
        "--certificate",
        &certificate,
        "--html",
        &page,
        "--svg",
        &picture,
    ];
    let text = verify(&[&[&*graph][..], &options].concat());
    assert_eq!(text.code, 0, "{}", text.err);
    let mut own = vec![
        (certificate.clone(), "a certificate", "`verify check FILE"),
        (page, "a page", "give the graph that it shows"),
        (picture, "a picture", "give the graph that it shows"),
        (
            write("report.txt", &text.out),
            "a report",
            "give the graph that it is about",
        ),
    ];
    for command in [
        &[][..],
        &["compare"],
        &["conditions"],
        &["audit"],
        &["models"],
        &["overview"],
    ] {
        let run = verify(&[command, &[&*graph, "--json"]].concat());
        let name = format!("report-{}.json", command.first().unwrap_or(&"verify"));
        own.push((
            write(&name, &run.out),
            "a report",
            "give the graph that it is about",
        ));
    }
    let catalog = verify(&["catalog", "--nodes", "4", "--list"]).out;
    let table = write("catalog.tsv", &catalog);
    own.push((
        table.clone(),
        "a table of graphs",
        "cut -f1 FILE | tail -n +2 | verify -",
    ));
    for (file, what, advice) in &own {
        let run = verify(&[file]);
        assert_eq!((run.code, &*run.out), (2, ""), "{file}");
        let expected = format!("this is {what} that this program has written");
        assert!(
            run.err.contains(&expected) && run.err.contains(advice),
            "{}",
            run.err
        );
    }
    // The advice on a table, done.
    let graphs: String = catalog
        .lines()
        .skip(1)
        .map(|line| line.split('\t').next().unwrap().to_owned() + "\n")
        .collect();
    let run = verify_with(graphs.as_bytes(), &["-", "--json"]);
    assert_eq!(run.json().len(), catalog.lines().count() - 1);
    for option in ["--parts", "--displacements"] {
        let run = verify(&[&*graph, "--model", "calibrated", option, &certificate]);
        assert_eq!(run.code, 2);
        assert!(
            run.err
                .contains("this is a certificate that this program has written"),
            "{}",
            run.err
        );
    }
}

/// What is no certificate is not rejected: that would be said of a claim.
#[test]
fn swapped_arguments_of_check() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (graph, certificate, report) = (path("graph.txt"), path("c.json"), path("report.json"));
    std::fs::write(&graph, "a b\nb c\nc a\n").unwrap();
    let run = verify(&[&*graph, "--json", "--certificate", &certificate]);
    std::fs::write(&report, &run.out).unwrap();
    let refused = |arguments: &[&str]| {
        let run = verify(&[&["check"], arguments].concat());
        assert_eq!((run.code, &*run.out), (2, ""), "{arguments:?}");
        run.err
    };
    assert!(
        refused(&[&graph, &certificate]).contains("did you swap them? The certificate comes first")
    );
    for other in [&graph, &report] {
        let text = refused(&[other]);
        assert!(
            text.contains("this is no certificate") && !text.contains("swap"),
            "{text}"
        );
        assert!(refused(&[other, &graph]).contains("this is no certificate"));
    }
    assert_eq!(verify(&["check", &certificate, &graph]).code, 0);
}

#[test]
fn mistyped_commands() {
    for (word, meant) in [
        ("chekc", "check"),
        ("modles", "models"),
        ("Overview", "overview"),
    ] {
        let run = verify(&[word, "graph.txt"]);
        assert_eq!((run.code, &*run.out), (2, ""));
        let expected =
            format!("{word}: no such file and no such command; did you mean `verify {meant}`?\n");
        assert!(run.err.ends_with(&expected), "{}", run.err);
    }
    let run = verify(&["something"]);
    assert!(
        run.err
            .contains("something: no such file and no such command; give the path"),
        "{}",
        run.err
    );
    let run = verify(&["something.txt"]);
    assert!(
        run.err.contains("something.txt: cannot be read: "),
        "{}",
        run.err
    );
}

/// A wrong file is not answered by a flood.
#[test]
fn ten_bad_lines_are_shown() {
    let bad = "a b\n".repeat(1000);
    for (text, shown, good) in [
        (format!(">>graph6<<Bw\n{bad}C~\n"), 11, 2),
        (">>graph6<<Bw\na b\nc d\n".to_owned(), 2, 1),
    ] {
        let run = verify_with(text.as_bytes(), &["-", "--json"]);
        assert_eq!((run.code, run.json().len()), (2, good));
        assert_eq!(run.err.lines().count(), shown, "{}", run.err);
        let more = run
            .err
            .contains("-: 990 more lines cannot be read either\n");
        assert_eq!(more, shown > 10, "{}", run.err);
    }
}

//! The readers on the published graphs.

mod common;

use common::data;
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

/// Lists of pairs as docs/input.md cuts them, written down once more without any thought of speed, and
/// without any rule about what is no list.
mod the_page {
    use std::collections::BTreeSet;

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

    fn fields(line: &str) -> Option<Vec<String>> {
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
                fields.push(text);
            } else {
                let end = rest.find([' ', '\t', ',']).unwrap_or(rest.len());
                let text = rest[..end].to_owned();
                rest = &rest[end..];
                if text.contains('"') {
                    return None;
                }
                fields.push(text);
            }
        }
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

    /// The pairs of all lines, without the first one if it is a head.
    pub fn read(bytes: &[u8], head: bool) -> Option<Listed> {
        let (mut pairs, mut singles) = (Vec::new(), Vec::new());
        let mut left = usize::from(head);
        for line in lines(bytes)? {
            let fields = fields(&line)?;
            if left > 0 && !fields.is_empty() {
                left -= 1;
                continue;
            }
            match &fields[..] {
                [] => {}
                [one] => singles.push(one.clone()),
                [a, b, ..] => pairs.push((a.clone(), b.clone())),
            }
        }
        if pairs.is_empty() && singles.is_empty() {
            return None;
        }
        numbered(&pairs, &singles)
    }
}

/// The reader of edge lists and the page agree on every text.
mod edge_lists {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::{Config, TestRunner};
    use std::cell::Cell;
    use viewcert_formats::read::graphs;
    use viewcert_formats::{Format, NamedGraph};

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

    fn read(text: &str, format: Option<Format>) -> Option<NamedGraph> {
        let options = ReadOptions {
            format,
            ..ReadOptions::default()
        };
        let input = std::io::Cursor::new(text.as_bytes().to_vec());
        graphs("in".to_owned(), input, options).next()?.ok()
    }

    fn listed(named: &NamedGraph) -> the_page::Listed {
        let nodes = 0..named.graph.nodes() as u32;
        let labels = nodes.map(|node| named.labels.label(node).into_owned());
        let edges = named.graph.edges().iter();
        let edges = edges.map(|&(i, j)| (i as usize, j as usize));
        (labels.collect(), edges.collect())
    }

    #[test]
    fn agree_with_the_page() {
        let (strict, heads, lenient) = (Cell::new(0), Cell::new(0), Cell::new(0));
        let mut runner = TestRunner::new(Config::with_cases(20_000));
        runner
            .run(&text(), |text| {
                for (format, count) in [(None, &strict), (Some(Format::Edges), &lenient)] {
                    let Some(named) = read(&text, format) else {
                        continue;
                    };
                    let taken = named.read.taken.as_deref().unwrap_or_default();
                    // Tables whose pairs stand elsewhere, and other formats, have tests of their own.
                    if named.read.format != "edge list" || !taken.ends_with("columns 1 and 2") {
                        continue;
                    }
                    let head = named
                        .notes
                        .iter()
                        .any(|note| note.starts_with("the first line is a head"));
                    let expected = the_page::read(text.as_bytes(), head);
                    prop_assert_eq!(
                        Some(listed(&named)),
                        expected,
                        "{:?} {:?}",
                        format,
                        &named.read
                    );
                    count.set(count.get() + 1);
                    heads.set(heads.get() + usize::from(head));
                }
                Ok(())
            })
            .unwrap();
        // Enough of each kind to mean something.
        let counts = [strict.get(), lenient.get(), heads.get()];
        assert!(
            counts[0] > 1000 && counts[1] > 1000 && counts[2] > 100,
            "{counts:?}"
        );
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

/// Whether a graph was read from a list of pairs as it stands, or from another format that the checker
/// may read.
fn is_plain(named: &viewcert_formats::NamedGraph) -> bool {
    let read = &named.read;
    let taken = read.taken.as_deref().unwrap_or("columns 1 and 2");
    read.guessed.is_empty() && taken.ends_with("columns 1 and 2")
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
            let named = read_graphs(path, &ReadOptions::default()).next();
            if let Some(Ok(named)) = named && is_plain(&named) {
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
        Some((named.ok().filter(is_plain)?, checked.ok()?))
    }

    #[test]
    fn of_all_samples() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/foreign");
        let mut alike = 0;
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                continue;
            }
            if let Some((named, checked)) = both(&std::fs::read(&path).unwrap()) {
                assert_eq!(checked.sha256(), sha256(&named.graph), "{}", path.display());
                alike += 1;
            }
        }
        assert!(alike >= 15, "{alike}");
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

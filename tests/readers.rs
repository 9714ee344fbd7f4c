//! The readers on the published graphs.

use crate::common::{data, verify, verify_with};
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
#[ignore = "needs data"]
fn table_3_has_the_published_nodes_and_edges() {
    let data = data();
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
#[ignore = "needs data"]
fn synthetic_graphs_and_their_true_components() {
    let data = data();
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
    pub(super) type Listed = (Vec<String>, BTreeSet<(usize, usize)>);

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
    pub(super) fn read(bytes: &[u8], head: bool) -> Option<Listed> {
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
            "#_viewcert_pairs source,target source,target,w from_to FROM,To id,source,target i_j_w a_b_c image1,image2,9 \"name1\",\"name2\" 5_4 4_3 3_2 5_5 src,dst,n,1,2,3,4,5,6",
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
        // Most texts have one separator, as lists do.
        let usual = prop::sample::select(vec![" ", " ", "\t", ","]);
        let usual = prop::option::weighted(0.8, usual);
        (0..6u8, 0..3u8, columns, usual)
            .prop_flat_map(move |(kind, more, columns, usual)| {
                let fields = (
                    label(kind),
                    label(kind),
                    prop::collection::vec(further(more), columns.saturating_sub(2)),
                );
                let line =
                    (fields, separator(), end()).prop_map(move |((a, b, more), separator, end)| {
                        let is_loop = a == b;
                        let mut fields = vec![a, b];
                        fields.extend(more);
                        fields.truncate(columns);
                        (is_loop, fields.join(usual.unwrap_or(separator)) + end)
                    });
                let head = { head.clone() }.prop_map(move |head| match usual {
                    Some(usual) if !head.starts_with('#') => head.replace([' ', ','], usual),
                    _ => head,
                });
                (
                    prop::collection::vec(line, 0..24),
                    prop::option::weighted(0.5, head),
                    prop::option::weighted(0.2, (odd.clone(), any::<prop::sample::Index>())),
                    any::<bool>(),
                    prop::bool::weighted(0.2),
                )
            })
            .prop_map(|(lines, head, odd, cut, loops)| {
                // Most texts pair nothing with itself.
                let lines = lines.into_iter().filter(|(is_loop, _)| loops || !is_loop);
                let mut text: String = head
                    .map(|head| head + "\n")
                    .into_iter()
                    .chain(lines.map(|(_, line)| line))
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
                    let elsewhere = !taken.contains("columns 1 and 2") || text.contains(';');
                    if named.read.format != "edge list" || elsewhere {
                        continue;
                    }
                    let head = named
                        .notes
                        .iter()
                        .any(|note| note.starts_with("the first line is a head"));
                    let expected = the_page::read(text.as_bytes(), head);
                    let found = listed(&named);
                    // Below a head, columns that are ignored may be empty, and names may hold what
                    // separates the fields of other files.
                    let holds = |name: &String| name.contains([' ', '\t', ',']);
                    if head && (expected.is_none() || found.0.iter().any(holds)) {
                        continue;
                    }
                    // Between tabs or commas a field may begin as a comment does.
                    if found.0.iter().any(|name| name.starts_with(['#', '%'])) {
                        continue;
                    }
                    prop_assert_eq!(Some(found), expected, "{:?} {:?}", format, &named.read);
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
    use crate::common::nauty;

    #[test]
    #[ignore = "needs geng"]
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
                let made = nauty("genrang", &arguments);
                let random = path("random.s6");
                std::fs::write(&random, &made.stdout).unwrap();
                let all = |name: &str, option: &str| -> Vec<Graph> {
                    let file = path(name);
                    let made = nauty("copyg", &[option, "-q", &random]);
                    std::fs::write(&file, made.stdout).unwrap();
                    let graphs = read_graphs(&file, &ReadOptions::default());
                    graphs.map(|graph| graph.unwrap().graph).collect()
                };
                let graph6 = all("random.g6", "-g");
                let sparse: Vec<Graph> = read_graphs(&random, &ReadOptions::default())
                    .map(|graph| graph.unwrap().graph)
                    .collect();
                assert_eq!(sparse, graph6);
                assert_eq!(all("other.s6", "-sh"), graph6);
                graphs += graph6.len();
            }
        }
        assert_eq!(graphs, 2080);
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
    let certificate = path("c.json");
    let text = verify(&[&graph, "--certificate", &certificate]);
    assert_eq!(text.code, 0, "{}", text.err);
    let mut own = vec![(certificate.clone(), "a certificate", "`verify check FILE")];
    for command in [&[][..], &["audit"], &["models"], &["overview"]] {
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
    let run = verify(&[&*graph, "--given", &certificate]);
    assert_eq!(run.code, 2);
    assert!(
        run.err
            .contains("this is a certificate that this program has written"),
        "{}",
        run.err
    );
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
    for (text, shown, records) in [
        (format!(">>graph6<<Bw\n{bad}C~\n"), 11, 1002),
        (">>graph6<<Bw\na b\nc d\n".to_owned(), 2, 3),
    ] {
        let run = verify_with(text.as_bytes(), &["-", "--json"]);
        assert_eq!((run.code, run.json().len()), (2, records));
        assert_eq!(run.err.lines().count(), shown, "{}", run.err);
        let more = run
            .err
            .contains("-: 990 more lines cannot be read either\n");
        assert_eq!(more, shown > 10, "{}", run.err);
        if records == 3 {
            let run = verify_with(text.as_bytes(), &["-"]);
            assert!(run.out.contains("3 cameras, 3 pairs"), "{}", run.out);
        }
    }
}

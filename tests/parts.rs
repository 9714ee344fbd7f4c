//! Known parts through the real binary, against graphs with all pairs of each part, and
//! through both checkers.

use crate::common::{cycle, first_checker, second_checker, verify, verify_with};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use viewcert::decide::{Options, Question, Verdict, decide};
use viewcert::{Graph, KnownParts, Model};

/// A folder with a graph and known parts.
struct Files(tempfile::TempDir);

impl Files {
    fn new(graph: &str, parts: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        // Small graphs look like tables, and this comment says that they are none.
        let graph = format!("# viewcert pairs\n{graph}");
        fs::write(folder.path().join("graph.txt"), graph).unwrap();
        fs::write(folder.path().join("parts.txt"), given(parts)).unwrap();
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn name(&self, name: &str) -> String {
        self.path(name).to_str().unwrap().to_owned()
    }

    /// `verify` on the graph with its parts and further options.
    fn verify(&self, more: &[&str]) -> crate::common::Run {
        let (graph, parts) = (self.name("graph.txt"), self.name("parts.txt"));
        let own = [&graph, "--given", &parts];
        verify(&[&own[..], more].concat())
    }
}

/// What the lines of a text list, as known parts.
fn given(parts: &str) -> String {
    let line = |line: &str| {
        if line.starts_with(['#']) || line.is_empty() {
            format!("{line}\n")
        } else {
            format!("part {line}\n")
        }
    };
    parts.lines().map(line).collect()
}

/// Holds a line of a report against the schema of all reports.
fn is_valid(line: &serde_json::Value) {
    let schema = include_str!("../docs/report.schema.json");
    let schema = jsonschema::validator_for(&serde_json::from_str(schema).unwrap()).unwrap();
    let found: Vec<String> = schema.iter_errors(line).map(|e| e.to_string()).collect();
    assert!(found.is_empty(), "{found:?}: {line}");
}

/// The nodes of the components, and whatever else is claimed.
fn answer(verdict: &Verdict) -> (String, usize, BTreeSet<Vec<u32>>) {
    let components = verdict.components.iter();
    let nodes: Vec<Vec<u32>> = components.map(|component| component.nodes()).collect();
    let distinct: BTreeSet<Vec<u32>> = nodes.iter().cloned().collect();
    assert_eq!(distinct.len(), nodes.len());
    (verdict.value.to_string(), verdict.rank, distinct)
}

/// The graph with all pairs of each part: what parts are as good as at generic cameras.
fn with_cliques(graph: &Graph, parts: &KnownParts) -> Graph {
    let of_part = |part: &[u32]| -> Vec<(u32, u32)> {
        let ends = part.iter().enumerate();
        ends.flat_map(|(k, &i)| part[k + 1..].iter().map(move |&j| (i, j)))
            .collect()
    };
    let pairs = graph.edges().iter().copied();
    let pairs = pairs.chain(parts.iter().flat_map(of_part));
    Graph::new(graph.nodes() as u32, pairs).unwrap()
}

/// Random graphs with up to nine nodes and random parts: verdict, rank and components are those of
/// the graph with cliques, which is decided without contraction; every certificate is verified.
#[test]
fn parts_against_cliques() {
    let cases = (3u32..10).prop_flat_map(|nodes| {
        let node = 0..nodes;
        (
            Just(nodes),
            prop::collection::vec((node.clone(), node.clone()), 0..12),
            prop::collection::vec(prop::collection::vec(node, 1..5), 1..5),
        )
    });
    let config = Config::with_cases(250);
    let check = |(nodes, pairs, parts): (u32, Vec<(u32, u32)>, Vec<Vec<u32>>)| {
        let pairs = pairs.into_iter().filter(|(i, j)| i != j);
        let graph = Graph::new(nodes, pairs).unwrap();
        let parts = KnownParts::new(nodes, parts).unwrap();
        let cliques = with_cliques(&graph, &parts);
        for model in Model::ALL {
            let known = Question::with_parts(model, parts.clone());
            let found = decide(&graph, &Options::default().question(known)).unwrap();
            let whole = Question {
                whole_graph: model != Model::Affine,
                ..model.into()
            };
            let expected = decide(&cliques, &Options::default().question(whole)).unwrap();
            let (value, rank, components) = answer(&found);
            let (_, rank_expected, components_expected) = answer(&expected);
            prop_assert_eq!(rank, rank_expected);
            prop_assert_eq!(components, components_expected);
            // Solutions are counted with contraction only.
            let contracted = decide(&cliques, &Options::default().model(model)).unwrap();
            prop_assert_eq!(value, contracted.value.to_string());
            let bounds = |verdict: &Verdict| {
                let count = verdict.solutions.as_ref();
                count.map(|count| (count.at_least, count.at_most))
            };
            prop_assert_eq!(bounds(&found), bounds(&contracted));
            let text = found.certificate(&graph).named("random").to_string();
            let checked = viewcert_check::check(text.as_bytes(), None);
            let checked = checked.map_err(|failure| TestCaseError::fail(failure.to_string()))?;
            prop_assert_eq!(checked.parts, parts.len());
            prop_assert_eq!(checked.rank.0 as usize, rank);
        }
        Ok(())
    };
    TestRunner::new(config).run(&cases, check).unwrap();
}

/// Cycles of four rigs: 11 * 8 - 15 less one, 3 * 8 - 4, and 4 (4 * 3) + 16 of 8 * 8 - 12.
#[test]
fn answers_by_hand() {
    let files = Files::new(&cycle(4), "0 1 a\n1 2 b\nc 2 3\n0 3 d\n");
    let graph = format!("# viewcert pairs\n{}a a2\nb b2\nc c2\nd d2\n", cycle(4));
    fs::write(files.path("graph.txt"), graph).unwrap();
    // Each rig has one camera that hangs on it alone, by a pair: 11 (8 + 4) - 15, less 4 for each.
    for (model, code, rank, components) in [
        ("projective", 1, 4 * 18 + 4 * 7, 8),
        ("calibrated", 1, 20 + 4 * 2, 5),
        ("affine", 1, 4 * (4 * 3 + 4), 8),
    ] {
        let run = files.verify(&["--json", "--model", model]);
        assert_eq!(run.code, code, "{}", run.err);
        let line = &run.json()[0];
        is_valid(line);
        assert_eq!(line["parts"], 4);
        assert_eq!(line["rank"], rank, "{model}");
        assert_eq!(line["components"].as_array().unwrap().len(), components);
        let conditions = line["conditions"].as_array().unwrap();
        assert!(
            conditions
                .iter()
                .any(|text| text.as_str().unwrap().contains("4 known parts"))
        );
    }
    let text = files.verify(&["--model", "calibrated"]).out;
    assert!(
        text.contains("12 cameras, 8 pairs, 4 known parts\n"),
        "{text}"
    );
    assert!(
        text.contains("5 (proved): 8 cameras / 4 pairs, 2 cameras / 1 pair"),
        "{text}"
    );
    // Without the file nothing is known of parts.
    let line = verify(&[&files.name("graph.txt"), "--json"])
        .json()
        .remove(0);
    assert!(line.get("parts").is_none() && line.get("conditions").is_none());
}

/// Nothing but a part, a part that grows, and parts that make one body.
#[test]
fn one_body_is_explained() {
    for (graph, parts, reason) in [
        (
            "0 1\n1 2\n",
            "0 1 2\n",
            "known parts and pairs merge into one body of all 3",
        ),
        (
            "0 1\n1 2\n0 3\n1 3\n",
            "2 1 0\n",
            "known parts and pairs merge into one body of all 4",
        ),
        (
            "0 1\n1 2\n2 3\n",
            "0 1 2\n1 2 3\n",
            "known parts and pairs merge into one body of all 4",
        ),
    ] {
        let run = Files::new(graph, parts).verify(&[]);
        assert_eq!(run.code, 0, "{}", run.err);
        assert!(
            run.out.contains(&format!("  because     {reason}")),
            "{}",
            run.out
        );
    }
    // Centres in one plane: a part is rigid there; the cycle of four parts is not.
    let ring = Files::new("0 4\n1 5\n2 6\n3 7\n", "0 1 4\n1 2 5\n2 3 6\n0 3 7\n");
    let line = &ring
        .verify(&["--json", "--model", "calibrated", "--planar"])
        .json()[0];
    assert_eq!(
        (&line["verdict"], &line["rank"]),
        (&"solvable".into(), &20.into())
    );
    let planar = &line["planar"];
    assert_eq!(planar["verdict"], "not-finite-solvable");
    // 4 * 3 rows of R, and 8 - 1 for a connected graph.
    assert_eq!(
        (&planar["rank"], &planar["rank_required"]),
        (&19.into(), &20.into())
    );
}

/// Notes and refusals name the file, and the line where there is one.
#[test]
fn what_is_wrong_is_said() {
    let graph = "a b\nb c\nc d\n";
    let files = Files::new(graph, "a b c c\n# none\nd\nc b a\nb c\n");
    let line = &files.verify(&["--json"]).json()[0];
    let notes: Vec<&str> = line["notes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|n| n.as_str().unwrap())
        .collect();
    let own = files.name("parts.txt");
    let note = "2 parts add nothing: of fewer than two cameras, or given again";
    assert!(notes.contains(&&*format!("{own}: {note}")), "{notes:?}");
    assert_eq!(line["parts"], 2);
    for (parts, reason) in [
        ("a b\nb e\n", ":2: `e` is no camera of the graph"),
        ("", ": the file gives nothing"),
        ("a \"b\n", ":1: a quote"),
    ] {
        let run = Files::new(graph, parts).verify(&[]);
        assert_eq!((run.code, run.out.as_str()), (2, ""));
        assert!(
            run.err.contains(&format!("parts.txt{reason}")),
            "{}",
            run.err
        );
    }
    let (one, two) = (files.name("graph.txt"), files.name("graph.txt"));
    for (arguments, reason) in [
        (
            vec!["--method", "matrix"],
            "the matrix of the whole graph has none",
        ),
        (vec![two.as_str()], "this is about one graph"),
        (vec!["--proof", "p"], "explicit proofs rest on pairs alone"),
        (vec!["--certificate", &own], "parts.txt"),
    ] {
        let run = files.verify(&arguments);
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.err.contains(reason), "{}", run.err);
    }
    // What a report says with parts is no claim about the graph alone.
    let report = files.name("report.csv");
    fs::write(&report, files.verify(&["--table=csv"]).out).unwrap();
    let run = verify(&["audit", "--claims", &report]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("without which it is another claim"),
        "{}",
        run.err
    );
    let run = verify_with(b"0 1\n", &["-", "--given", "-"]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("standard input is the graph already"),
        "{}",
        run.err
    );
    // Other commands do not know the option.
    for command in [
        "overview", "audit", "advise", "split", "merge", "lists", "witness", "label",
    ] {
        let run = verify(&[command, &one, "--given", &own]);
        assert_eq!(run.code, 2, "{command}");
        assert!(
            run.err.contains("--given is an option of `verify`"),
            "{}",
            run.err
        );
    }
}

/// All models side by side, each with the parts.
#[test]
fn models_side_by_side() {
    let files = Files::new("0 4\n1 5\n2 6\n3 7\n", "0 1 4\n1 2 5\n2 3 6\n0 3 7\n");
    let (graph, parts) = (files.name("graph.txt"), files.name("parts.txt"));
    let run = verify(&["models", &graph, "--given", &parts, "--json"]);
    assert_eq!(run.code, 1);
    let line = &run.json()[0];
    is_valid(line);
    assert_eq!(line["parts"], 4);
    let ranks: Vec<_> = line["models"]
        .as_array()
        .unwrap()
        .iter()
        .map(|m| m["rank"].clone())
        .collect();
    assert_eq!(ranks, [48, 72, 20]);
    let change = &line["changes"].as_array().unwrap().last().unwrap();
    assert_eq!(
        (&change["from"], &change["to"]),
        (&"projective".into(), &"calibrated".into())
    );
    assert_eq!(change["at"].as_array().unwrap().len(), 4);
    let text = verify(&["models", &graph, "--given", &parts]).out;
    assert!(text.contains("8 cameras, 4 pairs, 4 known parts"), "{text}");
    let run = verify(&["models", &graph, &graph, "--given", &parts]);
    assert_eq!(run.code, 2);
}

fn second(arguments: &[&str]) -> Option<i32> {
    Some(second_checker(arguments).code)
}

fn first(arguments: &[&str]) -> Option<i32> {
    Some(first_checker(arguments).code)
}

/// Certificates of every model, for a graph with names: both checkers, and the program in the names
/// of the graph, want the same parts.
#[test]
#[ignore = "needs python3"]
fn certificates_are_about_graph_and_parts() {
    let graph = "a b\nb c\n\"c d\" a\ne f\ng h\n";
    let files = Files::new(graph, "a b e\nb c f\nc \"c d\" g\nh a \"c d\"\n");
    let other = files.name("other.txt");
    fs::write(&other, given("a b e\nb c f\nc \"c d\" g\n")).unwrap();
    for model in ["projective", "calibrated", "affine"] {
        let certificate = files.name("certificate.json");
        let run = files.verify(&["--model", model, "--certificate", &certificate]);
        assert!(run.code < 2, "{}", run.err);
        let (graph, parts) = (&*files.name("graph.txt"), &*files.name("parts.txt"));
        let [pairs, numbers, fewer] =
            ["pairs.txt", "numbers.txt", "fewer.txt"].map(|name| files.name(name));
        for (known, out) in [
            (None, &pairs),
            (Some(parts), &numbers),
            (Some(&*other), &fewer),
        ] {
            let known: Vec<&str> = known.map_or(vec![], |known| vec!["--given", known]);
            let run = verify(&[&["convert", graph, "-o", out], &known[..]].concat());
            assert_eq!((run.code, &*run.out), (0, ""), "{}", run.err);
        }
        let names = [graph, parts, &*other];
        let in_numbers = [&*pairs, &*numbers, &*fewer];
        let codes = |[graph, parts, other]: [&str; 3], check: &dyn Fn(&[&str]) -> Option<i32>| {
            let given = [
                vec![graph, "--given", parts],
                vec![graph],
                vec![graph, "--given", other],
            ];
            given.map(|given| check(&[&[&*certificate], &given[..]].concat()).unwrap())
        };
        // Whoever expects anything names the model too.
        let named = |arguments: &[&str]| -> Vec<String> {
            let more: &[&str] = match arguments.len() {
                1 => &[],
                _ => &["--model", model],
            };
            let all = arguments.iter().chain(more);
            all.map(|&word| word.to_owned()).collect()
        };
        let by = |check: fn(&[&str]) -> Option<i32>| {
            move |arguments: &[&str]| {
                let all = named(arguments);
                check(&all.iter().map(String::as_str).collect::<Vec<_>>())
            }
        };
        let own = by(|arguments| Some(verify(&[&["check"], arguments].concat()).code));
        let (first, second) = (by(first), by(second));
        assert_eq!(codes(names, &own), [0, 1, 1]);
        assert_eq!(codes(in_numbers, &first), [0, 1, 1]);
        assert_eq!(codes(in_numbers, &second), [0, 1, 1]);
        assert_eq!(codes([graph, &numbers, &numbers], &own), [2, 1, 2]);
        for check in [&first as &dyn Fn(&[&str]) -> Option<i32>, &second] {
            // Names are nothing that a checker reads.
            assert_eq!(codes(names, check), [2; 3]);
        }
        for check in [&own as &dyn Fn(&[&str]) -> Option<i32>, &first, &second] {
            assert_eq!(check(&[&certificate]), Some(0));
            assert_eq!(check(&[&certificate, "--given", &numbers]), Some(0));
            assert_eq!(check(&[&certificate, "--given", &fewer]), Some(1));
        }
        let text: serde_json::Value =
            serde_json::from_str(&fs::read_to_string(&certificate).unwrap()).unwrap();
        // A hash alone does not say that parts are known.
        let sha256 = text["graph"]["sha256"].as_str().unwrap();
        assert_eq!(first(&[&certificate, "--sha256", sha256]), Some(1));
        assert_eq!(
            first(&[&certificate, "--sha256", sha256, "--given", &numbers]),
            Some(0)
        );
        let run = verify(&["check", &certificate]);
        assert!(
            run.out
                .contains("VERIFIED known parts: 4, taken for given\n"),
            "{}",
            run.out
        );
    }
    let folder = files.0.path().to_str().unwrap();
    let run = verify(&["check", folder, "--given", &other]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("what is given goes with one certificate"),
        "{}",
        run.err
    );
}

/// Parts in place of three edges of a graph with nine nodes and two solutions (Arrigoni, Kohn,
/// Fusiello, Pajdla): evidence for their number rests on parts as on pairs.
#[test]
#[ignore = "needs python3"]
fn solutions_with_parts() {
    let graph = viewcert::graph::graph6::decode(b"HBQkcP_").unwrap();
    let line = |(_, &(i, j)): (usize, &(u32, u32))| format!("{i} {j}\n");
    let edges = || graph.edges().iter().enumerate();
    let parts: String = edges().filter(|(k, _)| k % 4 == 2).map(line).collect();
    let pairs: String = edges().filter(|(k, _)| k % 4 != 2).map(line).collect();
    let files = Files::new(&pairs, &parts);
    let certificate = files.name("certificate.json");
    let run = files.verify(&["--json", "--certificate", &certificate]);
    let line = &run.json()[0];
    assert_eq!(line["verdict"], "finite-solvable");
    assert_eq!(line["solutions"]["exactly"], 2);
    assert_eq!(
        (&line["graph"]["edges"], &line["parts"]),
        (&9.into(), &3.into())
    );
    assert_eq!(
        (first(&[&certificate]), second(&[&certificate])),
        (Some(0), Some(0))
    );
}

/// A grid, of which regions have full rank: a known part in it is merged with these, and both
/// checkers count it in.
#[test]
#[ignore = "needs python3"]
fn bodies_by_rank_with_parts() {
    let node = |row: u32, column: u32| 17 * row + column;
    let cells = (0..17).flat_map(|row| (0..17).map(move |column| (row, column)));
    let around = |(row, column)| {
        let here = node(row, column);
        let right = node(row, (column + 1) % 17);
        let below = node((row + 1) % 17, column);
        format!("{here} {right}\n{here} {below}\n")
    };
    let files = Files::new(&cells.map(around).collect::<String>(), "0 18 40\n");
    let folder = files.path("certificates");
    fs::create_dir(&folder).unwrap();
    let folder = folder.to_str().unwrap();
    // Rounds would show that it is unique.
    let run = files.verify(&["--json", "--solutions=off", "--certificate", folder]);
    let line = &run.json()[0];
    assert_eq!(line["verdict"], "finite-solvable");
    assert_eq!((&line["parts"], &line["rank"]), (&1.into(), &3164.into()));
    let only = fs::read_dir(folder).unwrap().next().unwrap().unwrap();
    let certificate = only.path().to_str().unwrap().to_owned();
    let text = fs::read_to_string(&certificate).unwrap();
    let value: serde_json::Value = serde_json::from_str(&text).unwrap();
    let bodies = value["bodies"].as_array().unwrap();
    assert!(bodies.iter().any(|body| body["seed"].is_object()));
    // The part is the body 0, and in the one that is left.
    assert!(value["rigid"]["bodies"][0].as_u64().unwrap() >= bodies.len() as u64);
    assert_eq!(
        (first(&[&certificate]), second(&[&certificate])),
        (Some(0), Some(0))
    );
}

/// A part of 100,000 cameras is no 5 * 10^9 pairs: it is decided, certified and checked in seconds.
#[test]
fn large_parts_stay_small() {
    let cameras = 100_000;
    let chain: String = (1..cameras).map(|k| format!("{} {k}\n", k - 1)).collect();
    let all: Vec<String> = (0..cameras - 1).map(|k| k.to_string()).collect();
    let files = Files::new(&chain, &all.join(" "));
    for (model, rank) in [
        ("projective", 11 * 99_999 - 15 + 7),
        ("calibrated", 3 * 99_999 - 4 + 2),
    ] {
        let certificate = files.name("certificate.json");
        let run = files.verify(&["--json", "--model", model, "--certificate", &certificate]);
        let line = &run.json()[0];
        assert_eq!(line["rank"], rank);
        let components = line["components"].as_array().unwrap();
        assert_eq!(components.len(), 2);
        assert_eq!(
            (&components[0]["nodes"], &components[0]["edges"]),
            (&99_999.into(), &99_998.into())
        );
        assert!(fs::metadata(&certificate).unwrap().len() < 2_000_000);
        let arguments = [
            &*certificate,
            &files.name("graph.txt"),
            "--given",
            &files.name("parts.txt"),
            "--model",
            model,
        ];
        assert_eq!(first(&arguments), Some(0));
    }
}

/// The page and the picture of a graph in which a part has no pairs.
#[test]
fn pictures_show_what_there_is() {
    let files = Files::new("0 1\n1 2\n2 3\n3 4\n4 5\n", "0 2 4\n");
    let (page, picture) = (files.name("page.html"), files.name("picture.svg"));
    let (graph, given) = (files.name("graph.txt"), files.name("parts.txt"));
    let run = verify(&["draw", &graph, &page, &picture, "--given", &given]);
    assert_eq!(run.code, 1, "{}", run.err);
    let html = fs::read_to_string(&page).unwrap();
    assert!(
        html.contains("1 known part"),
        "the page says nothing of the part"
    );
}

/// A pipe can be read once only: what it holds is found out in reading it.
#[cfg(unix)]
#[test]
fn parts_through_a_pipe() {
    let files = Files::new("0 1\n1 2\n2 3\n3 0\n", "0 2\n");
    let graph = files.name("graph.txt");
    for name in ["/dev/stdin", "-"] {
        let run = verify_with(b"part 0 2\n", &[&graph, "--given", name]);
        assert_eq!(run.code, 0, "{name}: {}", run.err);
        let run = verify_with(b"default known\n", &[&graph, "--intrinsics", name]);
        assert_eq!(run.code, 0, "{name}: {}", run.err);
    }
    for name in ["/dev/stdin", "-"] {
        let run = verify_with(b"centre 0 1 2 3\n", &[&graph, "--given", name]);
        assert_eq!(run.code, 2, "{name}");
        let why = format!("{name}: no camera is given for 3 nodes");
        assert!(run.err.contains(&why), "{}", run.err);
    }
}

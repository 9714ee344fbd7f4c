//! One solution at any size, through the program: rounds of removing cameras, tripods and links, and what
//! is not unique.

use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::process::Command;

pub(crate) type Pairs = Vec<(u32, u32)>;

/// What the program says of a graph of pairs, in its own JSON and with a certificate that it has checked.
fn decided(pairs: &[(u32, u32)]) -> (Value, Value) {
    let folder = tempfile::tempdir().unwrap();
    let text = pairs.iter().fold(String::new(), |mut text, (a, b)| {
        writeln!(text, "{a} {b}").unwrap();
        text
    });
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (graph, certificate) = (file("graph.txt"), file("certificate.json"));
    std::fs::write(&graph, text).unwrap();
    let run = |arguments: &[&str]| {
        let program = env!("CARGO_BIN_EXE_verify");
        let run = Command::new(program).args(arguments).output().unwrap();
        let said = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code().is_some_and(|code| code < 2), "{said}");
        run.stdout
    };
    let line = run(&[&graph, "--json", "--certificate", &certificate]);
    run(&["check", &certificate, &graph]);
    let written = std::fs::read(&certificate).unwrap();
    let [line, written] = [line, written].map(|text| serde_json::from_slice(&text).unwrap());
    (line, written)
}

/// The answer, and how many solutions there are at least and at most.
fn answer(pairs: &[(u32, u32)]) -> (String, Value, Value) {
    let (line, _) = decided(pairs);
    let solutions = &line["solutions"];
    (
        line["verdict"].as_str().unwrap().to_owned(),
        solutions["at_least"].clone(),
        solutions["at_most"].clone(),
    )
}

/// Two cycles through all nodes, in an order that the seed chooses, without a common pair.
pub(crate) fn two_cycles(nodes: u32, seed: u64) -> Pairs {
    let mut state = seed;
    let mut below = |bound: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize % bound
    };
    loop {
        let mut order: Vec<u32> = (0..nodes).collect();
        for k in (1..order.len()).rev() {
            order.swap(k, below(k + 1));
        }
        let cycle = |order: &[u32]| -> BTreeSet<(u32, u32)> {
            let next = order.iter().cycle().skip(1);
            let pairs = order.iter().zip(next);
            pairs.map(|(&a, &b)| (a.min(b), a.max(b))).collect()
        };
        let first: Vec<u32> = (0..nodes).collect();
        let (one, other) = (cycle(&first), cycle(&order));
        if one.is_disjoint(&other) {
            return one.into_iter().chain(other).collect();
        }
    }
}

/// Nine cameras and twelve pairs with just two solutions (published).
const TWO: &str = "13 14 25 35 26 46 07 47 57 08 38 68";

/// Pairs of nodes of one digit each.
fn pairs(text: &str) -> Pairs {
    let digit = |digit: u8| u32::from(digit - b'0');
    let pair = |two: &[u8]| (digit(two[0]), digit(two[1]));
    text.split(' ').map(|two| pair(two.as_bytes())).collect()
}

/// Each pair of a graph replaced by four cameras, all pairs of them, that hold its two.
fn by_fours(pairs: &[(u32, u32)]) -> Pairs {
    let mut next = 1 + pairs.iter().map(|pair| pair.0.max(pair.1)).max().unwrap();
    let mut all = Pairs::new();
    for &(a, b) in pairs {
        let four = [a, b, next, next + 1];
        next += 2;
        for (k, &x) in four.iter().enumerate() {
            all.extend(four[k + 1..].iter().map(|&y| (x, y)));
        }
    }
    all
}

#[test]
fn random_graphs_are_unique_by_rounds() {
    for (nodes, seed) in [(40, 1), (60, 2), (60, 3), (120, 4)] {
        let (line, certificate) = decided(&two_cycles(nodes, seed));
        assert_eq!(line["verdict"], "solvable", "{nodes} {seed}");
        let because = line["solutions"]["because"].as_str().unwrap();
        assert!(because.starts_with("unique: "), "{because}");
        assert!(because.contains(" of "), "{because}");
        assert_eq!(certificate["claim"]["solutions"]["at_most"], 1);
        let kinds = certificate["pieces"][0]["evidence"].as_array().unwrap();
        assert_eq!(kinds[0]["kind"], "one-solution");
        let rounds = certificate["solutions"]["rounds"].as_array().unwrap();
        let merged = |round: &Value| {
            let rule = match round["stresses"].is_null() {
                true => "removed",
                false => "stressed",
            };
            let merges = round["merges"].as_array().unwrap();
            merges.iter().any(|merge| merge["rule"] == rule)
        };
        assert!(!rounds.is_empty() && rounds.iter().all(merged));
    }
}

/// Ten cameras and fourteen pairs, three equations more than unknowns: no camera can go, and three stresses
/// join the pairs at two nodes.
#[test]
fn stresses_merge_at_nodes() {
    let pairs = pairs("06 07 08 12 13 18 19 26 37 47 48 49 56 59");
    let (line, certificate) = decided(&pairs);
    assert_eq!(line["verdict"], "solvable");
    assert_eq!(line["because"], "unique: 1 round of stresses");
    assert!(line["prime"].is_u64(), "{line}");
    let round = &certificate["solutions"]["rounds"][0];
    assert_eq!(round["stresses"].as_array().unwrap().len(), 3);
    let merges = round["merges"].as_array().unwrap();
    let stressed = merges.iter().filter(|merge| merge["rule"] == "stressed");
    let nodes: Vec<&Value> = stressed.map(|merge| &merge["at"][0]).collect();
    assert_eq!(nodes, [4, 8]);
}

/// A tripod on a triangle, and a link between two; a tripod one of whose ways leads into its body at once
/// has rank 50 of 51.
#[test]
fn tripods_and_links() {
    let triangle = [(0, 1), (0, 2), (1, 2)];
    let tripod = [&triangle[..], &[(0, 3), (3, 4), (1, 4), (3, 5), (2, 5)]].concat();
    let link = [(3, 4), (3, 5), (4, 5), (0, 3), (1, 4), (2, 6), (5, 6)];
    let link = [&triangle[..], &link].concat();
    for (pairs, nodes) in [(tripod, 6), (link, 7)] {
        let (line, certificate) = decided(&pairs);
        assert_eq!(line["verdict"], "solvable");
        let bodies = certificate["bodies"].as_array().unwrap();
        let merges = bodies.last().unwrap()["merge"].as_array().unwrap();
        assert_eq!(merges[0]["at"].as_array().unwrap().len(), nodes);
    }
    let four = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    let inside = [&four[..], &[(0, 4), (4, 5), (1, 5)]].concat();
    assert_eq!(answer(&inside).0, "not-finite-solvable");
}

/// No pair's loss breaks it, and yet there are two solutions; cameras on two joined ones change nothing.
#[test]
fn two_solutions_stay_two() {
    let two = ("finite-solvable".to_owned(), 2.into(), 2.into());
    assert_eq!(answer(&pairs(TWO)), two);
    let fours = by_fours(&pairs(TWO));
    assert_eq!(answer(&fours), two);
    for lost in [0, 17, 40, 71] {
        let mut pairs = fours.clone();
        pairs.remove(lost);
        assert_eq!(answer(&pairs), two);
    }
    let more = [(1, 9), (3, 9), (9, 10), (1, 10), (10, 11), (9, 11)];
    let hanging = [&pairs(TWO)[..], &more].concat();
    assert_eq!(answer(&hanging), two);
}

/// A camera on two that are not joined makes the two solutions one: one plane more must fit.
#[test]
fn a_camera_on_two_that_are_not_joined() {
    let pairs = [&pairs(TWO)[..], &[(1, 9), (2, 9)]].concat();
    let one = ("solvable".to_owned(), 1.into(), 1.into());
    assert_eq!(answer(&pairs), one);
}

/// Components of a graph that falls apart, each by itself.
#[test]
fn components_are_unique_by_rounds() {
    let one = two_cycles(40, 5);
    let other = one.iter().map(|&(a, b)| (a + 39, b + 39));
    let both: Pairs = one.iter().copied().chain(other).collect();
    let (line, _) = decided(&both);
    assert_eq!(line["verdict"], "not-finite-solvable");
    let components = line["components"].as_array().unwrap();
    assert_eq!(components.len(), 2);
    for component in components {
        // Those that are unique say nothing of it.
        assert!(component["solutions"].is_null(), "{component}");
    }
}

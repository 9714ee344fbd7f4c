//! Against `decide` of all pairs so far, which knows nothing of what came before.

use super::*;
use crate::geometry::model::Model;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Pairs in an order of arrival: random ones, neighbours in a sequence, a grid, or groups that are tied late.
fn sequence(random: &mut ChaCha8Rng) -> Vec<(u32, u32)> {
    let n = random.random_range(3..15);
    let mut pairs: Vec<(u32, u32)> = match random.random_range(0..5) {
        0 => (0..3 * n)
            .map(|_| (random.random_range(0..n), random.random_range(0..n)))
            .collect(),
        1 => (1..n)
            .flat_map(|k| [(k - 1, k), (k.saturating_sub(3), k)])
            .collect(),
        2 => (0..n)
            .flat_map(|k| [(k, k + 1), (k, k + 4)])
            .filter(|(a, b)| b % 4 > 0 || b - a == 4)
            .collect(),
        // Nodes of degree two and three on what is there: near the threshold.
        3 => (3..n)
            .flat_map(|k| (0..random.random_range(2..4)).map(move |j| (k, j)))
            .map(|(k, j)| (k, (k * 7 + j * 5 + 1) % k))
            .collect(),
        _ => {
            let group = |a: u32, b: u32| a % 3 == b % 3;
            let all = (0..n).flat_map(|a| (0..a).map(move |b| (a, b)));
            let (mut near, far): (Vec<_>, Vec<_>) = all.partition(|&(a, b)| group(a, b));
            near.extend(far.into_iter().filter(|_| random.random_range(0..4) == 0));
            near
        }
    };
    pairs.retain(|(a, b)| a != b);
    if random.random_range(0..2) == 0 {
        for last in (1..pairs.len()).rev() {
            pairs.swap(last, random.random_range(0..=last));
        }
    }
    // Numbers of images have gaps.
    pairs
        .iter()
        .map(|&(a, b)| (a * 10 + 5, b * 10 + 5))
        .collect()
}

/// The value, and the components with their nodes.
type Known = (Claim<Value>, Vec<Vec<u32>>);

fn from_scratch(pairs: &[(u32, u32)], options: &Options) -> Known {
    let graph = LabelledGraph::from_pairs(pairs.iter().copied()).unwrap();
    let verdict = decide(graph.graph(), options).unwrap();
    let names = |nodes: Vec<u32>| nodes.iter().map(|&v| *graph.label(v)).collect();
    let components = verdict.components.iter();
    let mut components: Vec<Vec<u32>> = components.map(|c| names(c.nodes())).collect();
    components.sort_by(|a, b| b.len().cmp(&a.len()).then_with(|| a.cmp(b)));
    (verdict.value_claim(), components)
}

fn compare(sequences: u64, seed: u64) {
    for k in 0..sequences {
        let mut random = ChaCha8Rng::seed_from_u64(seed + k);
        let models = [Model::Projective, Model::Calibrated, Model::Affine];
        let model = models[random.random_range(0..3)];
        let options = Options::default().model(model);
        let mut verifier = Verifier::new(options.clone()).unwrap();
        let pairs = sequence(&mut random);
        let mut told: Vec<Vec<u32>> = Vec::new();
        let mut waiting = Vec::new();
        for (at, &(a, b)) in pairs.iter().enumerate() {
            // One by one, or several at once.
            match random.random_range(0..2) {
                0 => drop(verifier.add_pair(a, b).unwrap()),
                _ => waiting.push((a, b)),
            }
            // Many pairs between two questions, or none.
            if random.random_range(0..4) > 0 && at + 1 < pairs.len() {
                continue;
            }
            verifier.add_pairs(waiting.drain(..)).unwrap();
            let so_far = &pairs[..=at];
            let (value, components) = from_scratch(so_far, &options);
            let place = format!("sequence {} of seed {seed}, {model}: {so_far:?}", seed + k);
            assert_eq!(verifier.verdict().unwrap(), value, "{place}");
            let found = verifier.components().unwrap();
            assert!(found.is_proved() && found.value == components, "{place}");
            let [x, y] = [0, 1].map(|_| 10 * random.random_range(0..15) + 5);
            let together = |set: &Vec<u32>| set.contains(&x) && set.contains(&y);
            let expected = x == y || components.iter().any(together);
            assert_eq!(verifier.same_component(x, y).unwrap(), expected, "{place}");
            let large = |set: &&Vec<u32>| set.len() > 2;
            let now: Vec<_> = components.iter().filter(large).cloned().collect();
            for change in verifier.changed().unwrap() {
                assert!(now.contains(&change.nodes) && !told.contains(&change.nodes));
                let inside = |part: &&Vec<u32>| part.iter().all(|v| change.nodes.contains(v));
                let mut parts: Vec<_> = told.iter().filter(inside).cloned().collect();
                parts.sort();
                let mut named = change.parts;
                named.sort();
                assert_eq!(named, parts, "{place}");
                told.retain(|part| !parts.contains(part));
                told.push(change.nodes);
            }
            told.sort();
            let mut now = now;
            now.sort();
            assert_eq!(told, now, "{place}");
        }
    }
}

#[test]
fn every_prefix_is_decided_as_a_whole() {
    compare(300, 1);
}

/// `SEQUENCES=2000 cargo test -p viewcert incremental -- --ignored`.
#[test]
#[ignore = "takes minutes"]
fn many_prefixes_are_decided_as_wholes() {
    let asked = std::env::var("SEQUENCES").map(|text| text.parse().unwrap());
    compare(asked.unwrap_or(2000), 1000);
}

#[test]
fn the_certificate_is_that_of_all_pairs() {
    let mut verifier = Verifier::new(Options::default()).unwrap();
    let pairs = [(7, 3), (3, 9), (9, 7), (7, 3), (1, 9), (1, 7)];
    let new: Vec<bool> = pairs.map(|(a, b)| verifier.add_pair(a, b).unwrap()).into();
    assert_eq!(new, [true, true, true, false, true, true]);
    let graph = LabelledGraph::from_pairs(pairs).unwrap();
    let verdict = decide(graph.graph(), &Options::default()).unwrap();
    let expected = verdict.certificate(graph.graph()).to_string();
    assert_eq!(verifier.certificate().unwrap(), expected);
}

#[test]
fn what_is_no_pair_or_more_than_pairs_is_refused() {
    let mut verifier = Verifier::new(Options::default()).unwrap();
    verifier.add_pair(0, 1).unwrap();
    let pairs = verifier.add_pairs([(0, 3), (2, 2), (1, 2)]);
    assert_eq!(pairs, Err(PairedWithItself(2)));
    assert_eq!(verifier.graph().labels(), [0, 1]);
    let parts = crate::KnownParts::new(3, [vec![0, 1, 2]]).unwrap();
    let asked = crate::Question::with_parts(Model::Projective, parts);
    let refused = Verifier::new(Options::default().question(asked));
    assert_eq!(refused.unwrap_err(), VerdictError::PairsAlone);
}

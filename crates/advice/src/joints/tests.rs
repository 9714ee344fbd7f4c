use super::*;
use crate::tests::{clusters, found, frames, options, verdict};
use viewcert::graph::Displacements;
use viewcert::{Model, decide};

type Pair = (u32, u32);

/// Two complete graphs on 0..4 and 4..8, and more pairs.
fn two(more: &[(u32, u32)]) -> Graph {
    let complete =
        |first: u32| (first..first + 4).flat_map(move |i| (i + 1..first + 4).map(move |j| (i, j)));
    Graph::new(
        10,
        complete(0).chain(complete(4)).chain(more.iter().copied()),
    )
    .unwrap()
}

/// Degrees of freedom by hand: two frames differ by 15 (4), a shared image takes 11 (3), a pair
/// 7 (2), an image seen from both 14 - 11 (4 - 3). Affine: 12, 8, 4 and 8 - 8.
#[test]
fn freedom_by_hand() {
    let cases: [(&[Pair], [Option<usize>; 3]); 4] = [
        (&[(0, 4)], [Some(8), Some(2), Some(8)]),
        (&[(0, 4), (1, 5)], [Some(1), None, Some(4)]),
        (&[(0, 4), (1, 5), (2, 6)], [None, None, None]),
        (&[(0, 8), (4, 8)], [Some(12), Some(3), Some(12)]),
    ];
    for (more, expected) in cases {
        for (model, expected) in Model::ALL.into_iter().zip(expected) {
            let (_, _, joints) = found(&two(more), model);
            let freedom: Vec<usize> = joints.joints.iter().map(|joint| joint.freedom).collect();
            assert_eq!(
                freedom,
                expected.into_iter().collect::<Vec<_>>(),
                "{model} {more:?}"
            );
            assert!(
                joints
                    .joints
                    .iter()
                    .all(|joint| joint.strength == Strength::Proof)
            );
        }
    }
    // Two triangles at one image.
    let graph = Graph::new(5, [(0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4)]).unwrap();
    for (model, freedom) in Model::ALL.into_iter().zip([4, 1, 4]) {
        let (_, _, joints) = found(&graph, model);
        assert_eq!(joints.joints.len(), 1);
        assert_eq!(joints.joints[0].how, How::shared(2));
        assert_eq!(joints.joints[0].freedom, freedom);
    }
}

/// The whole subgraph of two components and what joins them, decided without condensing it.
#[test]
fn freedom_is_that_of_the_whole_subgraph() {
    let mut kinds = BTreeSet::new();
    for model in Model::ALL {
        for graph in clusters(60) {
            let (_, parts, all) = found(&graph, model);
            assert!(all.complete);
            for joint in &all.joints {
                let [a, b] = joint.components.map(|k| parts.nodes_of(k));
                let mut edges: Vec<(u32, u32)> = graph.edges().to_vec();
                edges.retain(|(i, j)| {
                    [&a, &b]
                        .iter()
                        .any(|part| part.contains(i) && part.contains(j))
                });
                edges.extend(&joint.how.pairs);
                edges.extend(
                    joint
                        .how
                        .through
                        .iter()
                        .flat_map(|&[a, x, b]| [(a, x), (x, b)]),
                );
                let nodes: BTreeSet<u32> = edges.iter().flat_map(|&(i, j)| [i, j]).collect();
                let nodes: Vec<u32> = nodes.into_iter().collect();
                let number = |v| nodes.binary_search(&v).unwrap() as u32;
                let edges = edges.iter().map(|&(i, j)| (number(i), number(j)));
                let alone = Graph::new(nodes.len() as u32, edges).unwrap();
                let verdict = decide(&alone, &options(model)).unwrap();
                assert_eq!(joint.freedom, verdict.required - verdict.rank, "{joint:?}");
                assert!(joint.freedom > 0);
                let how = &joint.how;
                kinds.insert((how.shared.is_some(), how.pairs.len(), how.through.len()));
            }
        }
    }
    assert!(kinds.len() >= 4, "{kinds:?}");
}

/// The same with frames, of which one may lie in neither component or lead from one to the other.
#[test]
fn freedom_with_frames_is_that_of_the_whole_subgraph() {
    let mut kinds = BTreeSet::new();
    for (graph, known) in frames(300) {
        let plain = options(Model::Calibrated);
        let verdict = decide(&graph, &plain.clone().displacements(known.clone())).unwrap();
        let parts = Parts::new(&graph, &verdict);
        let all = joints(&graph, &verdict, &parts, &plain, 1000).unwrap();
        for joint in &all.joints {
            let how = &joint.how;
            let sides = joint.components.map(|k| parts.nodes_of(k));
            let within = |pair: (u32, u32)| {
                let mut sides = sides.iter();
                sides.any(|side| side.contains(&pair.0) && side.contains(&pair.1))
            };
            let by = how.through.iter().flat_map(|&[a, x, b]| [(a, x), (x, b)]);
            let links: Vec<Pair> = how.pairs.iter().copied().chain(by).collect();
            let is_link = |(i, j): Pair| links.contains(&(i, j)) || links.contains(&(j, i));
            let edges = graph.edges().iter().copied();
            let edges: Vec<Pair> = edges
                .filter(|&pair| within(pair) || is_link(pair))
                .collect();
            let twos = known.groups().iter().flat_map(|group| {
                let each = group.iter().enumerate();
                each.flat_map(|(k, &i)| group[k + 1..].iter().map(move |&j| (i, j)))
            });
            let twos: Vec<Pair> = twos.filter(|&pair| within(pair) || is_link(pair)).collect();
            let nodes = edges.iter().chain(&twos).flat_map(|&(i, j)| [i, j]);
            let nodes: Vec<u32> = nodes.collect::<BTreeSet<u32>>().into_iter().collect();
            let number = |v: &u32| nodes.binary_search(v).unwrap() as u32;
            let again = |pairs: &[Pair]| -> Vec<Pair> {
                pairs.iter().map(|(i, j)| (number(i), number(j))).collect()
            };
            let count = nodes.len() as u32;
            let alone = Graph::new(count, again(&edges)).unwrap();
            let known = Displacements::new(count, again(&twos)).unwrap();
            let verdict = decide(&alone, &plain.clone().displacements(known)).unwrap();
            assert_eq!(joint.freedom, verdict.required - verdict.rank, "{joint:?}");
            assert!(joint.freedom > 0);
            let scaled = joint.components.map(|k| parts.is_scaled(k));
            kinds.insert((
                how.shared.is_some(),
                scaled,
                twos.iter().any(|&two| !within(two)),
            ));
        }
    }
    // Shared or not, neither or one or both of known scale, with a frame between and without.
    assert!(kinds.len() >= 6, "{kinds:?}");
}

/// A 4-cycle: its pairs touch at four images.
#[test]
fn single_pairs_have_joints_if_there_is_nothing_larger() {
    let graph = Graph::new(4, [(0, 1), (1, 2), (2, 3), (0, 3)]).unwrap();
    let (_, parts, all) = found(&graph, Model::Projective);
    let mut at: Vec<u32> = all
        .joints
        .iter()
        .filter_map(|joint| joint.how.shared)
        .collect();
    at.sort_unstable();
    assert_eq!(at, [0, 1, 2, 3]);
    let few = joints(
        &graph,
        &verdict(&graph, Model::Projective),
        &parts,
        &options(Model::Projective),
        3,
    );
    let few = few.unwrap();
    assert_eq!((few.joints.len(), few.complete), (3, false));
}

/// A hundred triangles at one image have 4950 joints; those of the first ones are looked at.
#[test]
fn a_hub_of_many_parts_is_cut_short() {
    let triangles = (0..100).flat_map(|k| [(0, 2 * k + 1), (0, 2 * k + 2), (2 * k + 1, 2 * k + 2)]);
    let graph = Graph::new(201, triangles).unwrap();
    let (_, parts, all) = found(&graph, Model::Calibrated);
    assert_eq!((all.joints.len(), all.complete), (1000, false));
    assert!(
        all.joints
            .iter()
            .all(|joint| joint.how.shared == Some(0) && joint.freedom == 1)
    );
    let verdict = verdict(&graph, Model::Calibrated);
    let all = joints(&graph, &verdict, &parts, &options(Model::Calibrated), 5000).unwrap();
    assert_eq!((all.joints.len(), all.complete), (4950, true));
}

/// An image with a pair to each of a hundred triangles: 4950 paths.
#[test]
fn so_is_an_image_that_leads_to_many() {
    let triangles = (0..100).flat_map(|k| {
        let v = 3 * k + 1;
        [(0, v), (v, v + 1), (v, v + 2), (v + 1, v + 2)]
    });
    let graph = Graph::new(301, triangles).unwrap();
    let (_, _, all) = found(&graph, Model::Projective);
    assert_eq!((all.joints.len(), all.complete), (1000, false));
    let by = |joint: &Joint| joint.how.through.iter().all(|by| by[1] == 0);
    assert!(
        all.joints
            .iter()
            .all(|joint| by(joint) && joint.freedom == 12)
    );
}

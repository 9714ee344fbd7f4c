use super::*;
use viewcert::graph::Labels;
use viewcert_formats::Matching;

/// Knows of some pairs what it is told.
struct Told(BTreeMap<(u32, u32), Estimate>);

impl Geometry for Told {
    fn of(&mut self, pair: (u32, u32)) -> Result<Option<Estimate>> {
        Ok(self.0.get(&pair).copied())
    }

    fn has_prior_focal_length(&self, _: u32) -> bool {
        true
    }
}

fn estimate(images: (u32, u32), config: i64, angle: f64) -> Estimate {
    Estimate {
        images: [images.0, images.1],
        config,
        angle: Some(angle),
        forward: None,
        rotation: None,
        of_plane: None,
    }
}

fn named(graph: Graph) -> NamedGraph {
    let inliers = vec![20; graph.edges().len()];
    let names = (0..graph.nodes()).map(|k| k.to_string().into());
    let labels = Labels::Names(names.collect());
    NamedGraph {
        matching: Some(Matching {
            inliers,
            ..Matching::default()
        }),
        ..NamedGraph::new("", graph, labels)
    }
}

fn clique(images: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    let each = images.iter().enumerate();
    each.flat_map(|(k, &a)| images[k + 1..].iter().map(move |&b| (a.min(b), a.max(b))))
}

fn decided(graph: &Graph) -> Verdict {
    let options = viewcert::decide::Options::default().model(viewcert::Model::Calibrated);
    viewcert::decide::decide(graph, &options).unwrap()
}

#[test]
fn few_pairs_are_special_if_all_are() {
    let bridge = [(0, 4), (1, 5)];
    let edges = clique(&[0, 1, 2, 3])
        .chain(clique(&[4, 5, 6, 7]))
        .chain(bridge);
    let pairs = named(Graph::new(8, edges).unwrap());
    let special = |told: &[Estimate]| {
        let told = told
            .iter()
            .map(|known| ((known.images[0], known.images[1]), *known));
        let found = narrow(&pairs, None, &mut Told(told.collect())).unwrap();
        let [few] = &found.few[..] else {
            panic!("{found:?}")
        };
        assert_eq!((few.sides, few.pairs.len()), ([4, 4], 2));
        few.special
    };
    let [one, other] = bridge;
    assert!(!special(&[]));
    assert!(!special(&[estimate(one, 5, 0.0), estimate(other, 2, 1.5)]));
    assert!(special(&[estimate(one, 5, 0.0), estimate(other, 2, 0.9)]));
}

/// Two groups with two images in common, and a point that leads past them.
#[test]
fn hinges_are_alone_unless_a_track_leads_past() {
    let groups = [[0, 1, 2, 3], [2, 3, 4, 5]];
    let edges: std::collections::BTreeSet<_> = groups.iter().flat_map(|g| clique(g)).collect();
    let pairs = named(Graph::new(6, edges).unwrap());
    let told = Told(BTreeMap::from([((2, 3), estimate((2, 3), 2, 0.4))]));
    let of = |tracks: &[&[u32]]| {
        let points = (6..).zip(tracks);
        let edges = points.flat_map(|(point, seen)| seen.iter().map(move |&v| (v, point)));
        let graph = Graph::new(6 + tracks.len() as u32, edges).unwrap();
        let verdict = decided(&graph);
        let tracks = NamedGraph {
            cameras: Some(6),
            ..named(graph)
        };
        let mut told = Told(told.0.clone());
        narrow(&pairs, Some((&tracks, &verdict)), &mut told)
            .unwrap()
            .hinges
    };
    let [hinge] = &of(&[&[0, 1, 2, 3], &[2, 3, 4, 5]])[..] else {
        panic!()
    };
    assert_eq!((hinge.special, &hinge.sides[..]), (true, &[2, 2][..]));
    assert_eq!(hinge.pair.angle, Some(0.4));
    assert!(of(&[&[0, 1, 2, 3], &[2, 3, 4, 5], &[1, 2, 4]]).is_empty());
}

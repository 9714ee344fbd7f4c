use super::*;
use viewcert::decide::{Options, decide};
use viewcert::graph::{Graph, Labels};

fn named(nodes: u32, pairs: &[(u32, u32)]) -> NamedGraph {
    let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
    NamedGraph::new("a <graph>", graph, Labels::Numbers { first: 0 })
}

fn scene_of(input: &NamedGraph) -> Scene {
    Scene::new(input, &decide(&input.graph, &Options::default()).unwrap())
}

/// A triangle 0, 1, 2; a pair 2, 3; a triangle 3, 4, 5; 6 alone.
const CHAIN: [(u32, u32); 7] = [(0, 1), (0, 2), (1, 2), (2, 3), (3, 4), (3, 5), (4, 5)];

#[test]
fn every_node_and_edge_is_drawn_in_the_colour_of_its_component() {
    let scene = scene_of(&named(7, &CHAIN));
    assert_eq!((scene.larger, scene.marked()), (2, 2));
    let marks: Vec<Mark> = (0..3).map(|k| scene.mark(k)).collect();
    assert_eq!(marks, [Mark::Own(0), Mark::Own(1), Mark::Pair]);
    let of = [0, 2, 3, 6].map(|v| scene.groups_of.of(v).to_vec());
    assert_eq!(of, [vec![0], vec![0, 2], vec![1, 2], vec![]]);

    let drawn = scene.svg(true);
    assert_eq!(drawn.matches("data-node=").count(), 7);
    let lines = drawn.split("<path data-component=").skip(1);
    let lines = lines.map(|path| path.split("/>").next().unwrap().matches('L').count());
    assert_eq!(lines.collect::<Vec<_>>(), [3, 3, 1]);
    // Two hinges and one in the legend.
    assert_eq!(drawn.matches(r#"class="ink""#).count(), 3);
    assert!(drawn.contains("<title>a &lt;graph&gt;: 7 cameras, 7 pairs, 3 components</title>"));
    for said in [
        ">1: 3 cameras, 3 pairs<",
        ">1 single pair<",
        ">2 cameras in several<",
        ">1 camera without pairs<",
    ] {
        assert!(drawn.contains(said), "{said}: {drawn}");
    }
    assert!(!scene.svg(false).contains("in several"));
}

/// A 4-cycle has four components, all of them single pairs: these are told apart.
#[test]
fn single_pairs_have_marks_where_there_is_nothing_else() {
    let scene = scene_of(&named(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]));
    assert_eq!((scene.larger, scene.marked()), (0, 4));
    assert_eq!(scene.mark(3), Mark::Own(3));
    assert!(
        scene
            .colours()
            .iter()
            .all(|colour| COLOURS.contains(colour))
    );
}

/// Names stand beside the nodes of a small graph, their ends if they are long; not beside many.
#[test]
fn small_graphs_have_names() {
    let drawn = scene_of(&named(7, &CHAIN)).svg(false);
    for name in 0..7 {
        assert!(drawn.contains(&format!(">{name}</text>")), "{drawn}");
    }
    let of = |name: &str| {
        let graph = Graph::new(2, [(0, 1)]).unwrap();
        let labels = Labels::Names(vec![name.into(), "z".into()]);
        scene_of(&NamedGraph::new("g", graph, labels)).svg(false)
    };
    assert!(of("abcdefghijklmnopqrst").contains(">abcdefghijklmnopqrst</text>"));
    assert!(of("abcdefghijklmnopqrstu").contains(">\u{2026}cdefghijklmnopqrstu</text>"));
    let path: Vec<(u32, u32)> = (0..50).map(|v| (v, v + 1)).collect();
    assert!(!scene_of(&named(51, &path)).svg(false).contains("<text"));
}

/// A sequence of 2,400 cameras, each paired with the next two, and one that hangs on: every fourth
/// is drawn and joined to the next ones, and the pair that hangs on is there.
#[test]
fn of_a_large_graph_some_nodes_are_drawn() {
    let mut pairs: Vec<(u32, u32)> = (0..2400u32)
        .flat_map(|v| [(v, v + 1), (v, v + 2)])
        .filter(|&(_, w)| w < 2400)
        .collect();
    pairs.push((7, 2400));
    let scene = scene_of(&named(2401, &pairs));
    assert!(!scene.is_whole() && scene.points().is_none());
    let (nodes, lines) = scene.shown();
    assert!(nodes.len() <= 600 && nodes.len() > 400, "{}", nodes.len());
    let ends = |line: &Edge| [line.ends.0, line.ends.1].map(|k| nodes[k as usize]);
    assert!(
        lines
            .iter()
            .any(|line| ends(line) == [7, 2400] && line.group == Some(1))
    );
    let first = lines.iter().filter(|line| line.group == Some(0));
    assert!(first.clone().map(ends).all(|[a, b]| b - a <= 15));
    assert!(first.count() >= nodes.len() - 2);
    let drawn = scene.svg(true);
    assert_eq!(drawn.matches("<g data-node=").count(), nodes.len());
    let note = format!(
        "drawn: {} of 2401 cameras, each for those near it",
        nodes.len()
    );
    assert!(drawn.contains(&note));
}

/// Of many lines a forest of the strongest is drawn, and the strongest of each node.
#[test]
fn what_is_drawn_holds_together() {
    let line = |a, b, weight| Edge {
        ends: (a, b),
        group: Some(0),
        kind: Kind::Pair,
        weight,
    };
    let mut lines = vec![line(0, 20, 1)];
    for a in 0..20 {
        lines.extend((a + 1..20).map(|b| line(a, b, 10 + a + b)));
    }
    lines.sort_by_key(|line| Reverse(line.weight));
    let chosen = strongest(21, &lines);
    assert!(chosen.len() < lines.len());
    assert!(chosen.contains(&line(0, 20, 1)), "the only line of a node");
    assert!(chosen.contains(&lines[0]));
}

/// Two cameras and three points that both see, and a camera that sees one of the points: the points are lines
/// between those that see them.
#[test]
fn images_are_joined_by_points() {
    let pairs = [(0, 3), (0, 4), (0, 5), (1, 3), (1, 4), (1, 5), (2, 5)];
    let mut input = named(6, &pairs);
    input.cameras = Some(3);
    let options = Options::default().model(viewcert::geometry::model::Model::Calibrated);
    let verdict = decide(&input.graph, &options).unwrap();
    let scene = Scene::new(&input, &verdict);
    let found: Vec<_> = scene
        .edges
        .iter()
        .map(|edge| (edge.ends, edge.group, edge.weight))
        .collect();
    assert_eq!(
        found,
        [((0, 1), Some(0), 3), ((0, 2), None, 1), ((1, 2), None, 1)]
    );
    let drawn = scene.svg(true);
    for said in [
        ">1: 2 cameras, 3 points<",
        ">1 single observation<",
        ">1 camera in no larger component<",
    ] {
        assert!(drawn.contains(said), "{said}: {drawn}");
    }
}

#[test]
fn text_is_escaped() {
    assert_eq!(escaped("a<b&c"), "a&lt;b&amp;c");
    assert_eq!(escaped("\"\u{1}'\u{202e}\""), "&quot;\\u0001'\\u202e&quot;");
}

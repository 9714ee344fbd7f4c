use super::*;
use viewcert::decide::{Options, decide};
use viewcert::graph::{Graph, Labels};

fn named(nodes: u32, pairs: &[(u32, u32)]) -> NamedGraph {
    let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
    NamedGraph::new("a <graph>", graph, Labels::Numbers { first: 0 })
}

fn with_picture<T>(input: &NamedGraph, look: impl FnOnce(&Picture) -> T) -> T {
    let verdict = decide(&input.graph, &Options::default()).unwrap();
    look(&Picture::new(input, &verdict))
}

fn text(picture: &Picture, with_legend: bool) -> String {
    document(picture, &draw(picture), with_legend)
}

/// A triangle 0, 1, 2; a pair 2, 3; a triangle 3, 4, 5; 6 alone.
const CHAIN: [(u32, u32); 7] = [(0, 1), (0, 2), (1, 2), (2, 3), (3, 4), (3, 5), (4, 5)];

#[test]
fn every_node_and_edge_is_drawn_in_the_colour_of_its_component() {
    let input = named(7, &CHAIN);
    with_picture(&input, |picture| {
        assert_eq!((picture.larger(), picture.marked()), (2, 2));
        let marks: Vec<Mark> = (0..3).map(|k| picture.mark(k)).collect();
        assert_eq!(marks, [Mark::Own(0), Mark::Own(1), Mark::Pair]);
        let of = [0, 2, 3, 6].map(|v| picture.components_of(v).to_vec());
        assert_eq!(of, [vec![0], vec![0, 2], vec![1, 2], vec![]]);

        let drawn = text(picture, true);
        assert_eq!(drawn.matches("data-node=").count(), 7);
        let paths: Vec<&str> = drawn.matches("<path data-component=").collect();
        assert_eq!(paths.len(), 3);
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
        assert!(!text(picture, false).contains("in several"));
    });
}

/// A 4-cycle has four components, all of them single pairs: these are told apart.
#[test]
fn single_pairs_have_marks_where_there_is_nothing_else() {
    let input = named(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]);
    with_picture(&input, |picture| {
        assert_eq!((picture.larger(), picture.marked()), (0, 4));
        assert_eq!(picture.mark(3), Mark::Own(3));
        assert!(!text(picture, true).contains(GREY));
    });
}

/// 501 triangles in a row, each joined to the next by a pair: too many nodes to be drawn.
#[test]
fn large_graphs_are_drawn_by_components() {
    let mut pairs = Vec::new();
    for k in 0..501 {
        let v = 3 * k;
        pairs.extend([(v, v + 1), (v, v + 2), (v + 1, v + 2)]);
        if k > 0 {
            pairs.push((v - 1, v));
        }
    }
    let input = named(3 * 501, &pairs);
    with_picture(&input, |picture| {
        assert!(!picture.is_detailed());
        let drawn = text(picture, true);
        assert_eq!(drawn.matches("<g data-component=").count(), MOST_DISCS);
        assert_eq!(drawn.matches("<g data-node=").count(), 0);
        assert_eq!(drawn.matches("<title>component").count(), MOST_DISCS);
        // 299 of the 500 pairs join two of the first 300 triangles; with 201 triangles the other
        // 201 pairs are left out.
        assert_eq!(drawn.matches(r##"stroke-width="1.0"/>"##).count(), 299);
        assert!(
            drawn.contains("not drawn: 402 smaller components"),
            "{drawn}"
        );
        // Sentences go over several lines.
        let words: Vec<&str> = drawn
            .split(['<', '>'])
            .skip(2)
            .step_by(2)
            .flat_map(str::split_whitespace)
            .collect();
        let words = words.join(" ");
        assert!(words.contains("1503 cameras are too many to draw: a symbol is a component"));
        assert!(
            words.contains("A line: pairs that join two of them."),
            "{words}"
        );
        assert!(drawn.contains(">489 more components<"));
        assert!(drawn.contains(">500 single pairs<"));
    });
}

/// Names stand beside the nodes of a small graph, their ends if they are long; not beside many.
#[test]
fn small_graphs_have_names() {
    let input = named(7, &CHAIN);
    with_picture(&input, |picture| {
        let drawn = text(picture, true);
        for name in 0..7 {
            assert!(drawn.contains(&format!(">{name}</text>")), "{drawn}");
        }
        assert_eq!(drawn.matches("ink-text name").count(), 7);
    });
    assert_eq!(shortened("abcdefghijklmnopqrst"), "abcdefghijklmnopqrst");
    assert_eq!(
        shortened("abcdefghijklmnopqrstu"),
        "\u{2026}cdefghijklmnopqrstu"
    );
    let path: Vec<(u32, u32)> = (0..50).map(|v| (v, v + 1)).collect();
    with_picture(&named(51, &path), |picture| {
        assert_eq!(text(picture, true).matches("ink-text name").count(), 0);
    });
}

/// A sequence of 2,400 cameras, each paired with the next two, and one that hangs on: every fourth
/// is drawn and joined to the next ones, and the pair that hangs on is there.
#[test]
fn of_a_large_component_some_nodes_are_drawn() {
    let mut pairs: Vec<(u32, u32)> = (0..2400u32)
        .flat_map(|v| [(v, v + 1), (v, v + 2)])
        .filter(|&(_, w)| w < 2400)
        .collect();
    pairs.push((7, 2400));
    let input = named(2401, &pairs);
    with_picture(&input, |picture| {
        assert!(!picture.is_detailed());
        let (nodes, lines) = sample::sample(picture);
        assert!(nodes.len() <= 600 && nodes.len() > 400, "{}", nodes.len());
        let pair = sample::Line {
            ends: (7, 2400),
            component: 1,
        };
        assert!(lines.contains(&pair));
        let first = lines.iter().filter(|line| line.component == 0);
        assert!(first.clone().all(|line| line.ends.1 - line.ends.0 <= 15));
        assert!(first.count() >= nodes.len() - 2);
        let drawn = text(picture, true);
        assert_eq!(drawn.matches("<g data-node=").count(), nodes.len());
        let note = format!(
            "drawn: {} of 2401 cameras, each for those near it",
            nodes.len()
        );
        assert!(drawn.contains(&note));
    });
}

/// Colours repeat after six, shapes tell them apart.
#[test]
fn marks_are_different() {
    let looks: Vec<String> = (0..MARKS)
        .map(|k| symbol(Mark::Own(k), 5.0) + dashes(Mark::Own(k)))
        .collect();
    for (k, look) in looks.iter().enumerate() {
        assert!(!looks[..k].contains(look), "{k}");
    }
}

/// Two cameras and three points that both see, and a camera that sees one of the points.
#[test]
fn points_are_smaller_than_cameras() {
    let pairs = [(0, 3), (0, 4), (0, 5), (1, 3), (1, 4), (1, 5), (2, 5)];
    let mut input = named(6, &pairs);
    input.cameras = Some(3);
    let options = Options::default().model(viewcert::geometry::model::Model::Calibrated);
    let verdict = decide(&input.graph, &options).unwrap();
    let picture = Picture::new(&input, &verdict);
    let drawn = text(&picture, true);
    assert!(drawn.contains(">1: 2 cameras, 3 points<"), "{drawn}");
    assert!(drawn.contains(">1 single observation<"), "{drawn}");
    assert!(drawn.contains(">1 point in several<"), "{drawn}");
    assert!(radius_of(&picture, 4, 6.0) < radius_of(&picture, 0, 6.0));
}

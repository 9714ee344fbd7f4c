//! A page of drawings of small graphs.

use crate::layout::layout;
use crate::svg::Svg;
use viewcert::graph::Graph;

/// A graph to be drawn.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// The graph.
    pub graph: Graph,
    /// Whether it is proved uniquely solvable: its nodes are filled.
    pub unique: bool,
}

const COLUMNS: usize = 8;
const CELL: f64 = 130.0;
const MARGIN: f64 = 26.0;
const TOP: f64 = 60.0;
const HEADING: f64 = 36.0;

/// The page: drawings in the order given, a new heading wherever the number of nodes
/// changes.
pub fn page(drawings: &[Drawing]) -> String {
    let groups: Vec<&[Drawing]> = drawings
        .chunk_by(|a, b| a.graph.nodes() == b.graph.nodes())
        .collect();
    let rows: usize = groups
        .iter()
        .map(|group| group.len().div_ceil(COLUMNS))
        .sum();
    let height = TOP + HEADING * groups.len() as f64 + CELL * rows as f64 + MARGIN;
    let mut svg = Svg::new((COLUMNS as f64 * CELL + 2.0 * MARGIN) as u32, height as u32);
    svg.text(
        [MARGIN, 28.0],
        18,
        "start",
        "Finite-solvable viewing graphs with the least number of edges",
    );
    svg.text(
        [MARGIN, 48.0],
        12,
        "start",
        "filled nodes: solvable, the graph contracts to one body; open nodes: finite solvable",
    );
    let mut y = TOP;
    for group in groups {
        let first = &group[0].graph;
        let heading = format!(
            "{} cameras, {} pairs: {}",
            first.nodes(),
            first.edges().len(),
            group.len()
        );
        svg.text([MARGIN, y + 24.0], 14, "start", &heading);
        y += HEADING;
        for row in group.chunks(COLUMNS) {
            for (k, drawing) in row.iter().enumerate() {
                draw(&mut svg, [MARGIN + CELL * k as f64, y], drawing);
            }
            y += CELL;
        }
    }
    svg.finish()
}

fn draw(svg: &mut Svg, corner: [f64; 2], drawing: &Drawing) {
    let inner = CELL - 2.0 * MARGIN;
    let points: Vec<[f64; 2]> = layout(&drawing.graph)
        .into_iter()
        .map(|point| std::array::from_fn(|k| corner[k] + MARGIN / 2.0 + inner * point[k]))
        .collect();
    for &(i, j) in drawing.graph.edges() {
        let ends = (points[i as usize], points[j as usize]);
        svg.line(ends.0, ends.1, "stroke:#555;stroke-width:1.4");
    }
    let style = if drawing.unique {
        "fill:#1b6ca8;stroke:#1b6ca8"
    } else {
        "fill:#fff;stroke:#b5651d;stroke-width:1.6"
    };
    for &point in &points {
        svg.circle(point, 4.0, style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_and_edge_is_drawn() {
        let (triangle, _) = Graph::from_pairs(3, vec![(0, 1), (0, 2), (1, 2)]).unwrap();
        let drawing = Drawing {
            graph: triangle,
            unique: true,
        };
        let text = page(&[drawing.clone(), drawing]);
        assert_eq!(text.matches("<circle").count(), 6);
        assert_eq!(text.matches("<line").count(), 6);
        assert!(text.contains("3 cameras, 3 pairs: 2"));
    }
}

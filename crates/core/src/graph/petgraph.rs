//! Conversions from and to the undirected graphs of the crate petgraph.

use super::error::GraphError;
use super::viewing_graph::Graph;
use ::petgraph::graph::{NodeIndex, UnGraph};
use ::petgraph::visit::EdgeRef;

impl From<&Graph> for UnGraph<(), ()> {
    /// Nodes and edges keep their numbers.
    ///
    /// # Panics
    /// With 2^32 - 1 edges and more, for which petgraph has no numbers.
    fn from(graph: &Graph) -> Self {
        let mut converted = Self::with_capacity(graph.nodes(), graph.edges().len());
        for _ in 0..graph.nodes() {
            converted.add_node(());
        }
        for &(i, j) in graph.edges() {
            converted.add_edge(NodeIndex::from(i), NodeIndex::from(j), ());
        }
        converted
    }
}

impl<N, E> TryFrom<&UnGraph<N, E>> for Graph {
    type Error = GraphError;

    /// Nodes keep their numbers; edges between the same nodes become one.
    fn try_from(graph: &UnGraph<N, E>) -> Result<Self, GraphError> {
        let nodes = u32::try_from(graph.node_count()).expect("numbers of nodes have 32 bits");
        let number = |node: NodeIndex| node.index() as u32;
        let edges = graph.edge_references();
        Self::new(
            nodes,
            edges.map(|edge| (number(edge.source()), number(edge.target()))),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let graph = Graph::new(5, [(0, 1), (0, 2), (1, 2), (2, 3)]).unwrap();
        let converted = UnGraph::from(&graph);
        assert_eq!((converted.node_count(), converted.edge_count()), (5, 4));
        assert_eq!(Graph::try_from(&converted), Ok(graph));
    }

    #[test]
    fn weights_are_left_and_parallel_edges_merged() {
        let mut given = UnGraph::<&str, f64>::default();
        let [a, b, c] = ["a", "b", "c"].map(|name| given.add_node(name));
        given.extend_with_edges([(c, a, 0.5), (a, c, 0.7), (b, c, 1.0)]);
        let graph = Graph::try_from(&given).unwrap();
        assert_eq!(graph.edges(), [(0, 2), (1, 2)]);
    }

    #[test]
    fn a_loop_is_refused() {
        let given = UnGraph::<(), ()>::from_edges([(0, 1), (1, 1)]);
        assert_eq!(Graph::try_from(&given), Err(GraphError::SelfLoop(1)));
    }
}

//! The identity of a graph: SHA-256 of its canonical form.
//!
//! The canonical form is the bytes `viewcert graph 1` and a line feed, then the
//! number of nodes and the number of edges as 64-bit integers, then both ends
//! of every edge `(i, j)`, `i < j`, in lexicographic order as 32-bit integers;
//! all integers little endian. Labels are no part of it. Two graphs have the
//! same form exactly when they are equal as [`Graph`]s: it says nothing about
//! isomorphism.

use sha2::{Digest, Sha256};

use super::viewing_graph::Graph;

const HEADER: &[u8] = b"viewcert graph 1\n";
const CORE_HEADER: &[u8] = b"viewcert core 2\n";
const EDGES_A_BLOCK: usize = 8192;

/// SHA-256 of the canonical form of a graph. O(m) time, constant space.
pub fn sha256(graph: &Graph) -> [u8; 32] {
    let mut hash = header(HEADER, graph);
    edges(&mut hash, graph);
    hash.finalize().into()
}

/// SHA-256 of a core (docs/certificate.md, section 4), which names the nodes of the graph that
/// `core` numbers from 0. O(n + m) time, constant space.
///
/// # Panics
/// If there is not one name a node.
pub fn core_sha256(nodes: &[u32], core: &Graph) -> [u8; 32] {
    assert_eq!(nodes.len(), core.nodes(), "one name a node");
    let mut hash = header(CORE_HEADER, core);
    for node in nodes {
        hash.update(node.to_le_bytes());
    }
    edges(&mut hash, core);
    hash.finalize().into()
}

fn header(text: &[u8], graph: &Graph) -> Sha256 {
    let mut hash = Sha256::new();
    hash.update(text);
    hash.update((graph.nodes() as u64).to_le_bytes());
    hash.update((graph.edges().len() as u64).to_le_bytes());
    hash
}

fn edges(hash: &mut Sha256, graph: &Graph) {
    let mut block = vec![0; 8 * EDGES_A_BLOCK.min(graph.edges().len())];
    for edges in graph.edges().chunks(EDGES_A_BLOCK) {
        for (bytes, &(i, j)) in block.chunks_exact_mut(8).zip(edges) {
            bytes[..4].copy_from_slice(&i.to_le_bytes());
            bytes[4..].copy_from_slice(&j.to_le_bytes());
        }
        hash.update(&block[..8 * edges.len()]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hex(graph: &Graph) -> String {
        sha256(graph).iter().map(|b| format!("{b:02x}")).collect()
    }

    /// Digests by Python's hashlib over struct.pack('<QQ', n, m) and so on. The
    /// second graph, complete on 200 nodes, fills more than two blocks.
    #[test]
    fn digests_agree_with_an_independent_computation() {
        let small = vec![(0, 1), (0, 2), (1, 2), (2, 3)];
        let (small, _) = Graph::from_pairs(5, small).unwrap();
        assert_eq!(
            hex(&small),
            "804ee2193eb369d398b1724cb6e96f54144dc3c21d1ac2efba6b6c9d66dd17c6"
        );
        let complete = (0..200).flat_map(|i| (i + 1..200).map(move |j| (i, j)));
        let (complete, _) = Graph::from_pairs(200, complete.collect()).unwrap();
        assert_eq!(
            hex(&complete),
            "8cf1bfa69e1c0eb93fdf8cf56504659539410dba44f5110afe15df9cf731e413"
        );
    }

    /// By the same independent computation.
    #[test]
    fn the_digest_of_a_core_names_its_nodes() {
        let edges = vec![(0, 1), (0, 2), (1, 2), (2, 3)];
        let (core, _) = Graph::from_pairs(4, edges).unwrap();
        let digest = core_sha256(&[3, 5, 6, 9], &core);
        let digest: String = digest.iter().map(|b| format!("{b:02x}")).collect();
        assert_eq!(
            digest,
            "93beed85e2f4a6d6e0c369eae3563688a89f53d6624f7b3663f2d0b0528b7459"
        );
        assert_ne!(
            core_sha256(&[3, 5, 6, 8], &core),
            core_sha256(&[3, 5, 6, 9], &core)
        );
    }
}

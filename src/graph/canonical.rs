//! The identity of a graph: SHA-256 of its canonical form.
//!
//! The canonical form is the bytes `viewcert graph 1` and a line feed, then the
//! number of nodes and the number of edges as 64-bit integers, then both ends
//! of every edge `(i, j)`, `i < j`, in lexicographic order as 32-bit integers;
//! all integers little endian. Labels are no part of it. Two graphs have the
//! same form exactly when they are equal as [`Graph`]s: it says nothing about
//! isomorphism.

use sha2::{Digest, Sha256};

use super::Graph;

const HEADER: &[u8] = b"viewcert graph 1\n";
const EDGES_A_BLOCK: usize = 8192;

/// SHA-256 of the canonical form of a graph. O(m) time, constant space.
pub fn sha256(graph: &Graph) -> [u8; 32] {
    let mut hash = Sha256::new();
    hash.update(HEADER);
    hash.update((graph.nodes() as u64).to_le_bytes());
    hash.update((graph.edges().len() as u64).to_le_bytes());
    let mut block = vec![0; 8 * EDGES_A_BLOCK.min(graph.edges().len())];
    for edges in graph.edges().chunks(EDGES_A_BLOCK) {
        for (bytes, &(i, j)) in block.chunks_exact_mut(8).zip(edges) {
            bytes[..4].copy_from_slice(&i.to_le_bytes());
            bytes[4..].copy_from_slice(&j.to_le_bytes());
        }
        hash.update(&block[..8 * edges.len()]);
    }
    hash.finalize().into()
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
}

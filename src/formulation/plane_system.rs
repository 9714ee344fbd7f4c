//! The system behind plane flows, in one matrix: the equations of docs/theory.md,
//! section 3, before they are split into N and Lambda.
//!
//! ```text
//! a . (y_i^k - y_j^k) + lambda_e a^T P_j e_k = 0
//! ```
//!
//! for the two directions a of an edge and the columns k = 1..4: [ I_4 (x) N | rho ], whose
//! rank is 4 rank N + rank Lambda.

use super::Formulation;
use super::plane_flow::directions;
use super::skew::SparseRows;
use crate::camera::{Camera, centre};
use crate::exact::Field;
use crate::graph::Graph;

/// The unknowns are the cameras' columns, as in J_P, and then lambda_e for every edge.
#[derive(Clone, Copy, Debug)]
pub struct PlaneSystem;

/// The centre in the affine chart x_4 = 1; `None` at infinity.
fn affine_centre<F: Field>(field: &F, camera: &Camera<F::Elem>) -> Option<[F::Elem; 3]> {
    let [x, y, z, last] = centre(field, camera);
    let inverse = field.inv(&last)?;
    Some([x, y, z].map(|x| field.mul(&x, &inverse)))
}

impl<F: Field> Formulation<F> for PlaneSystem {
    fn name(&self) -> &'static str {
        "plane flow"
    }

    fn source(&self) -> &'static str {
        "docs/theory.md, section 3"
    }

    fn size_formula(&self) -> [&'static str; 2] {
        ["8m", "12n + m"]
    }

    fn size(&self, graph: &Graph) -> (usize, usize) {
        let edges = graph.edges().len();
        (8 * edges, 12 * graph.nodes() + edges)
    }

    fn trivial_kernel(&self, graph: &Graph) -> usize {
        graph.nodes() + 15
    }

    fn admits(&self, field: &F, _graph: &Graph, cameras: &[Camera<F::Elem>]) -> bool {
        cameras
            .iter()
            .all(|camera| affine_centre(field, camera).is_some())
    }

    fn matrix(&self, field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> SparseRows<F::Elem> {
        assert_eq!(cameras.len(), graph.nodes(), "one camera a node");
        let centres: Vec<[F::Elem; 3]> = cameras
            .iter()
            .map(|camera| affine_centre(field, camera).expect("admitted cameras"))
            .collect();
        let scales = 12 * graph.nodes();
        let mut rows = Vec::with_capacity(8 * graph.edges().len());
        for (e, &(i, j)) in graph.edges().iter().enumerate() {
            let (i, j) = (i as usize, j as usize);
            let both = directions(field, &centres[i], &centres[j]).expect("centres are distinct");
            for a in &both {
                let dot = (0..3).fold(field.zero(), |sum, r| {
                    field.add(&sum, &field.mul(&a[r], &centres[j][r]))
                });
                for k in 0..4 {
                    let camera_entry = a.get(k).cloned().unwrap_or_else(|| field.neg(&dot));
                    let at_i = (0..3).map(|r| (12 * i + 3 * k + r, a[r].clone()));
                    let at_j = (0..3).map(|r| (12 * j + 3 * k + r, field.neg(&a[r])));
                    rows.push(
                        at_i.chain(at_j)
                            .chain([(scales + e, camera_entry)])
                            .filter(|(_, x)| !field.is_zero(x))
                            .collect(),
                    );
                }
            }
        }
        rows
    }
}

//! `viewcert._native`: the libraries as Python sees them.
//!
//! In: arrays of pairs, paths, options. Out: graphs, verdicts and certificates as handles, numbers,
//! bytes and arrays. Nothing is decided or formatted here, but by the libraries and the report
//! crate; what a user sees is `lib/viewcert`, in Python. Work is
//! done without the interpreter's lock, and can be interrupted (`work`).

mod all;
mod at_cameras;
mod catalog;
mod check;
mod decided;
mod errors;
mod files;
mod graph;
mod incremental;
mod matrices;
mod pickled;
mod places;
mod program;
mod scenes;
mod studies;
mod work;

use pyo3::prelude::*;

/// The module.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::all::decide_all;
    #[pymodule_export]
    use super::at_cameras::{AtCameras, Cameras, VerifiedAtCameras, check_at_cameras};
    #[pymodule_export]
    use super::catalog::{Candidates, label, label_graph6};
    #[pymodule_export]
    use super::check::{Verified, VerifiedIntrinsics, check, check_intrinsics};
    #[pymodule_export]
    use super::decided::{Decided, decide};
    #[pymodule_export]
    use super::files::{Archive, check_all, contradictions, lists, merge, overview};
    #[pymodule_export]
    use super::graph::{Graph, graph_of_integers, graph_of_nodes, read};
    #[pymodule_export]
    use super::incremental::Growing;
    #[pymodule_export]
    use super::matrices::rigidity_matrix;
    #[pymodule_export]
    use super::pickled::{about_graph, graph_kept, same_graph};
    #[pymodule_export]
    use super::places::{component_of_pairs, pairs_among};
    #[pymodule_export]
    use super::program::{run_checker, run_verify};
    #[pymodule_export]
    use super::scenes::{drawing, witness};
    #[pymodule_export]
    use super::studies::{Claims, audit, audit_at_cameras, models, singular_value};
    #[pymodule_export]
    use super::work::{bytes_of, seconds_of};

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        work::no_global_threads();
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}

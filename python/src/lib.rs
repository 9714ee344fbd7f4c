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
mod pickled;
mod program;
mod scenes;
mod studies;
mod work;

use pyo3::prelude::*;

/// The module.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::{
        all::decide_all,
        at_cameras::{AtCameras, Cameras},
        catalog::{candidates, entries, label, label_graph6},
        check::check,
        decided::{Decided, decide},
        files::{check_all, contradictions, lists, merge, overview},
        graph::{Graph, graph_of_integers, graph_of_nodes, read},
        incremental::Growing,
        pickled::{about_graph, graph_kept, same_graph},
        program::{run_checker, run_verify},
        scenes::{drawing, witness},
        studies::{Claims, audit, audit_at_cameras, singular_value},
        work::{bytes_of, seconds_of},
    };

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        work::no_global_threads();
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}

//! Long work, seen and stopped from outside.
//!
//! The library neither prints nor keeps limits by itself: it tells an [`Observer`] what it is
//! doing, and asks a [`Watch`] every few milliseconds whether it may go on. Whoever starts the
//! work holds the other end: an interrupt flag, a deadline, a limit on the memory of its large
//! matrices. A limit never changes an answer; it only decides whether there is one.
//!
//! ```
//! use std::time::{Duration, Instant};
//! use viewcert::graph::Graph;
//! use viewcert::{Options, Value, decide};
//! use viewcert::watch::{Limits, Watch};
//!
//! let watch = Watch::new(Limits {
//!     deadline: Some(Instant::now() + Duration::from_secs(60)),
//!     memory: Some(1 << 30),
//! });
//! let options = Options::default().watch(watch.clone());
//! let graph = Graph::new(4, [(0, 1), (1, 2), (2, 3), (3, 0)])?;
//! assert_eq!(decide(&graph, &options)?.value, Value::NotFiniteSolvable);
//! // From any thread, at any time:
//! watch.interrupt();
//! assert!(decide(&graph, &options).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod limits;
mod progress;
mod task;

pub use limits::{Bytes, Limits, Reason, SoFar, Stopped, Watch};
pub use progress::{Observer, Stage, Step};
pub(crate) use task::{Reservation, matrix_bytes};
pub use task::{Task, Work, unwatched};

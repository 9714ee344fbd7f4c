//! Progress of many things on standard error: a bar on a terminal, plain lines elsewhere.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, Write};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between plain lines; short runs print none.
const INTERVAL: Duration = Duration::from_secs(10);

/// Progress of a run.
pub struct Progress {
    bar: ProgressBar,
    plain: Option<Mutex<Plain>>,
}

struct Plain {
    what: &'static str,
    start: Instant,
    last: Instant,
    done: u64,
    total: Option<u64>,
}

impl Progress {
    /// Starts at nothing out of `total`, if that is known, of `what`: "candidates".
    pub fn new(what: &'static str, total: Option<u64>) -> Self {
        if std::io::stderr().is_terminal() {
            let bar = match total {
                Some(total) => ProgressBar::new(total),
                None => ProgressBar::no_length(),
            };
            let template = match total {
                Some(_) => "{wide_bar} {pos}/{len} {msg} {per_sec} {eta} left",
                None => "{spinner} {pos} {msg} {per_sec} {elapsed}",
            };
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style);
            }
            bar.set_message(what);
            return Self { bar, plain: None };
        }
        let now = Instant::now();
        Self {
            bar: ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()),
            plain: Some(Mutex::new(Plain {
                what,
                start: now,
                last: now,
                done: 0,
                total,
            })),
        }
    }

    /// Counts what has been done since the last call.
    pub fn done(&self, more: u64) {
        self.bar.inc(more);
        let Some(plain) = &self.plain else {
            return;
        };
        let mut plain = plain.lock().unwrap_or_else(PoisonError::into_inner);
        plain.done += more;
        if plain.last.elapsed() < INTERVAL {
            return;
        }
        plain.last = Instant::now();
        let seconds = plain.start.elapsed().as_secs_f64();
        let rate = plain.done as f64 / seconds;
        let (of, left) = match plain.total {
            Some(total) => {
                let left = total.saturating_sub(plain.done) as f64 / rate;
                (format!(" of {total}"), format!(", {left:.0} s left"))
            }
            None => Default::default(),
        };
        // Progress is not worth failing for.
        let _ = writeln!(
            std::io::stderr(),
            "viewcert-lab: {}{of} {}{left}, {rate:.0} a second",
            plain.done,
            plain.what
        );
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.finish();
    }
}

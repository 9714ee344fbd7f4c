//! The bar of the work on one graph, on a terminal.

use crate::unpoisoned;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::{Mutex, MutexGuard};
use std::time::{Duration, Instant};
use viewcert::watch::{Observer, Stage};

/// What takes less time is not shown.
const SHOWN_AFTER: Duration = Duration::from_secs(1);

/// No remaining time is guessed from less than this.
const GUESSED_AFTER: Duration = Duration::from_millis(300);

/// The bar of the work on one graph: told by the library, drawn by whoever calls
/// [`draw`](Self::draw).
///
/// The library's threads only ever wait for `state`, which nobody holds while drawing.
#[derive(Debug, Default)]
pub(crate) struct Bar {
    shown: Mutex<Option<Shown>>,
    state: Mutex<State>,
}

#[derive(Debug)]
struct Shown {
    bar: ProgressBar,
    /// Whether it shows how far the work is.
    measured: bool,
}

#[derive(Debug, Default)]
struct State {
    /// When that began for which the bar is, if there is anything.
    since: Option<Instant>,
    /// What is being done while no work goes on.
    saying: String,
    /// In the order in which they began.
    works: Vec<Active>,
}

#[derive(Clone, Debug)]
struct Active {
    number: u64,
    stage: Stage,
    total: u64,
    /// Units expected after it.
    later: Option<u64>,
    done: u64,
    since: Instant,
    /// When something was done last.
    last: Instant,
}

impl Bar {
    fn state(&self) -> MutexGuard<'_, State> {
        unpoisoned(&self.state)
    }

    fn shown(&self) -> MutexGuard<'_, Option<Shown>> {
        unpoisoned(&self.shown)
    }

    /// From now on this is being done.
    pub(crate) fn say(&self, what: String) {
        let mut state = self.state();
        state.saying = what;
        state.since = Some(Instant::now());
    }

    /// Draws what goes on now, if it has gone on for long.
    pub(crate) fn draw(&self) {
        let mut shown = self.shown();
        let (active, saying) = {
            let state = self.state();
            if state
                .since
                .is_none_or(|since| since.elapsed() < SHOWN_AFTER)
            {
                return;
            }
            (state.works.last().cloned(), state.saying.clone())
        };
        let (message, measure) = match &active {
            None => (saying, None),
            Some(active) => {
                let measure = (active.total > 0).then_some((active.total, active.done));
                (format!("{}{}", active.stage, active.remaining()), measure)
            }
        };
        let shown = match &mut *shown {
            Some(shown) if shown.measured == measure.is_some() => shown,
            other => {
                if let Some(shown) = other.take() {
                    shown.bar.finish_and_clear();
                }
                other.insert(Shown::new(measure.is_some()))
            }
        };
        if let Some((total, done)) = measure {
            shown.bar.set_length(total);
            shown.bar.set_position(done.min(total));
        }
        shown.bar.set_message(message);
        shown.bar.tick();
    }

    /// Takes the bar off the terminal until something else goes on for long.
    pub(crate) fn clear(&self) {
        let mut shown = self.shown();
        {
            let mut state = self.state();
            state.since = None;
            state.saying.clear();
        }
        if let Some(shown) = shown.take() {
            shown.bar.finish_and_clear();
        }
    }
}

impl Shown {
    fn new(measured: bool) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        let template = if measured {
            "{spinner} {msg} {wide_bar} {percent} %"
        } else {
            "{spinner} {msg}"
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self { bar, measured }
    }
}

impl Active {
    /// The time that is left, as far as can be told.
    fn remaining(&self) -> String {
        let elapsed = self.last - self.since;
        let left = self.total.saturating_sub(self.done);
        let Some(later) = self.later.filter(|later| left + later > 0) else {
            return String::new();
        };
        if self.done == 0 || elapsed < GUESSED_AFTER {
            return String::new();
        }
        let seconds = elapsed.as_secs_f64() * (left + later) as f64 / self.done as f64;
        let seconds = (seconds - self.last.elapsed().as_secs_f64())
            .max(1.0)
            .ceil() as u64;
        match (seconds / 3600, seconds / 60 % 60, seconds % 60) {
            (0, 0, seconds) => format!(", {seconds} s left"),
            (0, minutes, seconds) => format!(", {minutes} min {seconds} s left"),
            (hours, minutes, _) => format!(", {hours} h {minutes} min left"),
        }
    }
}

impl Observer for Bar {
    fn begin(&self, work: u64, stage: Stage, total: u64, later: Option<u64>) {
        let now = Instant::now();
        let mut state = self.state();
        if state.works.is_empty() && !state.saying.is_empty() {
            // What was said is over.
            state.saying.clear();
            state.since = None;
        }
        state.since.get_or_insert(now);
        state.works.push(Active {
            number: work,
            stage,
            total,
            later,
            done: 0,
            since: now,
            last: now,
        });
    }

    fn done(&self, work: u64, units: u64) {
        let mut state = self.state();
        // The latest ones are asked for most.
        let active = state.works.iter_mut().rev();
        if let Some(active) = active.into_iter().find(|active| active.number == work) {
            active.done += units;
            if units > 0 {
                active.last = Instant::now();
            }
        }
    }

    fn end(&self, work: u64) {
        self.state().works.retain(|active| active.number != work);
    }
}

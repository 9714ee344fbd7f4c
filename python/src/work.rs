//! Work without the interpreter's lock, which Ctrl-C stops and which tells how far it is.
//!
//! Work is done on a thread of its own while the caller's looks, every few hundredths of a second,
//! for signals, and tells the callback what has happened. Work under the watch ends where it asks
//! whether it may go on. What does not ask (reading, checking) is left to itself after a moment: it
//! holds nothing of Python.
//!
//! All of it runs on the threads of this process: a process that was forked has none of its parent's,
//! and would wait for them for ever. So nothing else here may start threads, nor leave the interpreter
//! (`clippy.toml`), and whatever computes elsewhere all the same ends with an error (`no_global_threads`).

#![expect(clippy::disallowed_methods, reason = "this is where threads come from")]

use crate::errors::{InputError, TooLarge, of_any};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::collections::VecDeque;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use viewcert::watch::{Limits, Observer, Reason, Stage, Watch};
use viewcert_session::{MemoryLimit, TimeLimit};

/// Time between two looks for signals.
const TICK: Duration = Duration::from_millis(50);

/// How long stopped work may take to end by itself.
const GRACE: Duration = Duration::from_millis(500);

/// What a thread may use for its calls, as much as the first thread of a program: `verify` runs on one.
const STACK: usize = 8 << 20;

/// Most stages that are remembered until the callback is told.
const REMEMBERED: usize = 1000;

/// What one call of a user does: within limits, and telling a callback how far it is.
pub(crate) struct Job {
    threads: Arc<ThreadPool>,
    watch: Watch,
    told: Arc<Told>,
    progress: Option<Py<PyAny>>,
}

impl Job {
    /// Within what `viewcert.limits` says where the call stands; without that, the program's limit of memory.
    ///
    /// # Errors
    /// Limits that cannot be.
    pub(crate) fn new(py: Python<'_>) -> PyResult<Self> {
        let around = py.import("viewcert._limits")?.getattr("around")?.call0()?;
        let (seconds, memory, progress): (Option<f64>, Option<u64>, _) = around.extract()?;
        let time = seconds.map(Duration::try_from_secs_f64).transpose();
        let time = time.map_err(|_| {
            let seconds = seconds.unwrap_or_default();
            InputError::new_err(format!("time_limit={seconds}: give seconds, 0 or more"))
        })?;
        Ok(Self {
            threads: threads(py)?,
            watch: Watch::new(Limits {
                deadline: time.and_then(|time| Instant::now().checked_add(time)),
                memory: memory.or_else(viewcert_session::default_memory_limit),
            }),
            told: Arc::default(),
            progress,
        })
    }

    /// The same on so many threads of its own, if a number is given.
    ///
    /// # Errors
    /// If threads cannot be had, or none are wanted.
    pub(crate) fn on(self, count: Option<usize>) -> PyResult<Self> {
        let threads = match count {
            None => return Ok(self),
            Some(0) => {
                let least = "threads=0: there is one thread at least";
                return Err(InputError::new_err(least));
            }
            Some(count) => Arc::new(pool(count).map_err(none_left)?),
        };
        Ok(Self { threads, ..self })
    }

    /// The watch for the work, which tells the callback of its stages.
    pub(crate) fn watch(&self) -> Watch {
        match self.progress {
            Some(_) => self.watch.observed(self.told.clone()),
            None => self.watch.clone(),
        }
    }

    /// The same for work whose units are counted by whoever does it.
    pub(crate) fn unobserved(&self) -> Watch {
        self.watch.clone()
    }

    /// What the callback is told.
    pub(crate) fn told(&self) -> Arc<Told> {
        Arc::clone(&self.told)
    }

    /// Leaves work to itself, with the threads that it may hold for long: whatever comes next has others.
    fn leave(&self, _: Python<'_>) {
        let mut kept = unpoisoned(&POOL);
        kept.take_if(|(_, threads)| Arc::ptr_eq(threads, &self.threads));
    }

    /// Does `work`. The callback, if there is one, is called on this thread with what is being done, how many
    /// units of it are done, and how many there are (0 if that is not known).
    ///
    /// # Errors
    /// KeyboardInterrupt and what else a signal or the callback raises; a panic of `work` as
    /// RuntimeError; TooLarge if the time is over and the work does not end by itself.
    pub(crate) fn run<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> PyResult<T> {
        let (sender, receiver) = channel();
        self.threads.spawn(move || {
            // Nobody waits any more for work that was left to itself.
            let _ = sender.send(work());
        });
        let receiver = Mutex::new(receiver);
        let wait = |time| py.detach(|| unpoisoned(&receiver).recv_timeout(time));
        let look = || {
            py.check_signals()?;
            match &self.progress {
                Some(callback) => self.told.tell(py, callback),
                None => Ok(()),
            }
        };
        let mut late: Option<Instant> = None;
        loop {
            match wait(TICK) {
                Ok(done) => {
                    look()?;
                    return Ok(done);
                }
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(PyRuntimeError::new_err(
                        "internal error: the message is on standard error",
                    ));
                }
                Err(RecvTimeoutError::Timeout) => {
                    if let Err(error) = look() {
                        self.watch.interrupt();
                        // Whatever it ends with, the first error is the one to raise.
                        if matches!(wait(GRACE), Err(RecvTimeoutError::Timeout)) {
                            self.leave(py);
                        }
                        return Err(error);
                    }
                }
            }
            // What does not ask the watch has the same time.
            if self.watch.stopped() == Some(Reason::Time)
                && late.get_or_insert_with(Instant::now).elapsed() > GRACE
            {
                self.leave(py);
                return Err(TooLarge::new_err("the time limit was reached"));
            }
        }
    }
}

impl Job {
    /// Does work that may fail.
    ///
    /// # Errors
    /// As [`Job::run`]; those of the work.
    pub(crate) fn answer<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> anyhow::Result<T> + Send + 'static,
    ) -> PyResult<T> {
        self.run(py, work)?.map_err(|error| of_any(&error))
    }
}

/// The seconds of a limit such as `5m`, as the program takes it; nothing if it is none.
#[pyfunction]
pub(crate) fn seconds_of(text: &str) -> Option<f64> {
    let limit: TimeLimit = text.parse().ok()?;
    Some(limit.duration().as_secs_f64())
}

/// The bytes of a limit such as `2G`, likewise.
#[pyfunction]
pub(crate) fn bytes_of(text: &str) -> Option<u64> {
    let limit: MemoryLimit = text.parse().ok()?;
    Some(limit.bytes())
}

/// Work of a moment, which nobody interrupts: it may borrow.
///
/// # Errors
/// If threads cannot be had.
pub(crate) fn briefly<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let threads = threads(py)?;
    Ok(py.detach(|| threads.install(work)))
}

/// The threads of this process.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads that work computes with, of this process. Whoever asks holds the interpreter's lock, and so
/// does a process that forks: nobody asks meanwhile.
///
/// # Errors
/// If threads cannot be had.
fn threads(_: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let process = std::process::id();
    let mut kept = unpoisoned(&POOL);
    if let Some((owner, threads)) = &*kept
        && *owner == process
    {
        return Ok(Arc::clone(threads));
    }
    let new = Arc::new(pool(0).map_err(none_left)?);
    // Those of the parent are not here to be waited for.
    std::mem::forget(kept.replace((process, Arc::clone(&new))));
    Ok(new)
}

/// So many threads, or as many as there are cores.
fn pool(count: usize) -> Result<ThreadPool, ThreadPoolBuildError> {
    ThreadPoolBuilder::new()
        .num_threads(count)
        .stack_size(STACK)
        .thread_name(|number| format!("viewcert {number}"))
        // Whoever waits finds that there will be no answer.
        .panic_handler(|_| ())
        .build()
}

/// Threads that cannot be had.
fn none_left(error: ThreadPoolBuildError) -> PyErr {
    TooLarge::new_err(error.to_string())
}

/// Makes sure that rayon never starts threads by itself, which a fork would lose: it tries once, here, and
/// is refused.
pub(crate) fn no_global_threads() {
    let refuse = |_| Err(std::io::Error::other("work goes through `work`"));
    let refused = ThreadPoolBuilder::new()
        .spawn_handler(refuse)
        .build_global();
    debug_assert!(refused.is_err(), "no thread is started");
}

fn unpoisoned<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What work tells, until a callback has been told.
#[derive(Debug, Default)]
pub(crate) struct Told(Mutex<State>);

#[derive(Debug, Default)]
struct State {
    /// What began or ended, in that order.
    news: VecDeque<News>,
    /// What goes on, in the order in which it began.
    works: Vec<(u64, News)>,
}

/// A step of work: what it is, how much of it is done, and of how much.
#[derive(Clone, Debug, PartialEq, Eq)]
struct News {
    what: String,
    done: u64,
    total: u64,
}

impl State {
    fn remember(&mut self, news: News) {
        if self.news.len() < REMEMBERED {
            self.news.push_back(news);
        }
    }

    fn begin(&mut self, work: u64, what: String, total: u64) {
        let done = 0;
        let news = News { what, done, total };
        self.remember(news.clone());
        self.works.push((work, news));
    }
}

impl Told {
    /// Work of so many units begins, which are counted.
    pub(crate) fn expect(&self, what: &str, total: u64) {
        unpoisoned(&self.0).begin(0, what.to_owned(), total);
    }

    /// Tells the callback what is new, and how far the work is that began last.
    fn tell(&self, py: Python<'_>, callback: &Py<PyAny>) -> PyResult<()> {
        let news: Vec<News> = {
            let mut state = unpoisoned(&self.0);
            let going_on = state.works.last().map(|(_, news)| news.clone());
            let mut news: Vec<News> = state.news.drain(..).collect();
            news.extend(going_on.filter(|news| news.done > 0));
            news
        };
        for News { what, done, total } in news {
            callback.call1(py, (what, done, total))?;
        }
        Ok(())
    }

    /// Work of which so many units are done, told by whoever counts them.
    pub(crate) fn counted(&self, what: &str, more: u64) {
        let mut state = unpoisoned(&self.0);
        if state.works.is_empty() {
            state.begin(0, what.to_owned(), 0);
        }
        if let Some((_, news)) = state.works.last_mut() {
            news.done += more;
        }
    }
}

impl Observer for Told {
    fn begin(&self, work: u64, stage: Stage, total: u64, _: Option<u64>) {
        unpoisoned(&self.0).begin(work, stage.to_string(), total);
    }

    fn done(&self, work: u64, units: u64) {
        let mut state = unpoisoned(&self.0);
        if let Some((_, news)) = state.works.iter_mut().rfind(|(number, _)| *number == work) {
            news.done += units;
        }
    }

    fn end(&self, work: u64) {
        let mut state = unpoisoned(&self.0);
        if let Some(at) = state.works.iter().rposition(|(number, _)| *number == work) {
            let (_, news) = state.works.remove(at);
            if news.total > 0 {
                state.remember(news);
            }
        }
    }
}

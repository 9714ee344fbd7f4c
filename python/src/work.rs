//! Work without the interpreter's lock, which Ctrl-C stops and which tells how far it is.
//!
//! Work is done on a thread of its own while the caller's looks, every few hundredths of a second,
//! for signals, and tells the callback what has happened. Work under the watch ends where it asks
//! whether it may go on. What does not ask (reading, checking) is left to itself after a moment: it
//! holds nothing of Python.

use crate::errors::{InputError, TooLarge};
use pyo3::exceptions::{PyOSError, PyRuntimeError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::VecDeque;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use viewcert::watch::{Limits, Observer, Reason, Stage, Watch};

/// Time between two looks for signals.
const TICK: Duration = Duration::from_millis(50);

/// How long stopped work may take to end by itself.
const GRACE: Duration = Duration::from_millis(500);

/// Most stages that are remembered until the callback is told.
const REMEMBERED: usize = 1000;

/// What one call of a user does: within limits, and telling a callback how far it is.
pub(crate) struct Job {
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
        Self::within(py, (None, None), None, Told::default())
    }

    /// The same, with the arguments of the call before that: seconds and bytes, a callback, and what is told
    /// of the work beforehand.
    ///
    /// # Errors
    /// As there.
    pub(crate) fn within(
        py: Python<'_>,
        (seconds, memory): (Option<f64>, Option<u64>),
        progress: Option<Py<PyAny>>,
        told: Told,
    ) -> PyResult<Self> {
        let around = py.import("viewcert._limits")?.getattr("around")?.call0()?;
        let around: (Option<f64>, Option<u64>, Option<Py<PyAny>>) = around.extract()?;
        let seconds = seconds.or(around.0);
        let time = seconds.map(Duration::try_from_secs_f64).transpose();
        let time = time.map_err(|_| {
            let seconds = seconds.unwrap_or_default();
            InputError::new_err(format!("time_limit={seconds}: give seconds, 0 or more"))
        })?;
        let memory = memory.or(around.1);
        Ok(Self {
            watch: Watch::new(Limits {
                deadline: time.and_then(|time| Instant::now().checked_add(time)),
                memory: memory.or_else(viewcert_session::default_memory_limit),
            }),
            told: Arc::new(told),
            progress: progress.or(around.2),
        })
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
        let spawned = std::thread::Builder::new().spawn(move || {
            // Nobody waits any more for work that was left to itself.
            let _ = sender.send(work());
        });
        spawned.map_err(|error| PyOSError::new_err(error.to_string()))?;
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
                        let _ = wait(GRACE);
                        return Err(error);
                    }
                }
            }
            // What does not ask the watch has the same time.
            if self.watch.stopped() == Some(Reason::Time)
                && late.get_or_insert_with(Instant::now).elapsed() > GRACE
            {
                return Err(TooLarge::new_err("the time limit was reached"));
            }
        }
    }
}

/// Work that nobody limits, and that Ctrl-C stops all the same.
///
/// # Errors
/// As of [`Job::run`].
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let job = Job {
        watch: Watch::default(),
        told: Arc::default(),
        progress: None,
    };
    job.run(py, work)
}

/// The threads that `work` computes with, of this process: a process that was forked has none of
/// those of its parent.
///
/// # Errors
/// If threads cannot be had.
pub(crate) fn threads() -> PyResult<Arc<ThreadPool>> {
    static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    let process = std::process::id();
    let mut pool = unpoisoned(&POOL);
    if let Some((owner, pool)) = &*pool
        && *owner == process
    {
        return Ok(Arc::clone(pool));
    }
    let new = ThreadPoolBuilder::new().build();
    let new = Arc::new(new.map_err(|error| TooLarge::new_err(error.to_string()))?);
    if let Some(of_the_parent) = pool.replace((process, Arc::clone(&new))) {
        // Its threads are not here to be waited for.
        std::mem::forget(of_the_parent);
    }
    Ok(new)
}

/// So many threads of their own, or else those of this process.
///
/// # Errors
/// If threads cannot be had, or none are wanted.
pub(crate) fn threads_of(count: Option<usize>) -> PyResult<Arc<ThreadPool>> {
    match count {
        None => threads(),
        Some(0) => Err(InputError::new_err(
            "threads=0: there is one thread at least",
        )),
        Some(count) => {
            let pool = ThreadPoolBuilder::new().num_threads(count).build();
            let pool = pool.map_err(|error| TooLarge::new_err(error.to_string()))?;
            Ok(Arc::new(pool))
        }
    }
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
}

impl Told {
    /// Work of so many units, which are counted.
    pub(crate) fn expecting(what: &str, total: u64) -> Self {
        let news = News {
            what: what.to_owned(),
            done: 0,
            total,
        };
        Self(Mutex::new(State {
            news: VecDeque::from([news.clone()]),
            works: vec![(0, news)],
        }))
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

    /// Says how many units of work there are, before the first is done.
    pub(crate) fn expects(&self, what: &str, total: u64) {
        let news = News {
            what: what.to_owned(),
            done: 0,
            total,
        };
        let mut state = unpoisoned(&self.0);
        state.remember(news.clone());
        state.works.push((0, news));
    }

    /// Work of which so many units are done, told by whoever counts them.
    pub(crate) fn counted(&self, what: &str, more: u64) {
        let mut state = unpoisoned(&self.0);
        if state.works.is_empty() {
            let news = News {
                what: what.to_owned(),
                done: 0,
                total: 0,
            };
            state.works.push((0, news));
        }
        if let Some((_, news)) = state.works.last_mut() {
            news.done += more;
        }
    }
}

impl Observer for Told {
    fn begin(&self, work: u64, stage: Stage, total: u64, _: Option<u64>) {
        let news = News {
            what: stage.to_string(),
            done: 0,
            total,
        };
        let mut state = unpoisoned(&self.0);
        state.remember(news.clone());
        state.works.push((work, news));
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

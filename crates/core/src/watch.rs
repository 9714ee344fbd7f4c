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

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};
use std::time::Instant;

/// A kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Contraction of the whole graph to bodies.
    Contraction,
    /// The elimination of the paper's whole matrix.
    WholeMatrix,
    /// The elimination of N, which gives the plane flows.
    Flows,
    /// The rows of Lambda.
    Lambda,
    /// The elimination of Lambda.
    Elimination,
    /// The motion classes, and the components in them.
    Components,
    /// The search for a proof by counting.
    Counting,
    /// Further draws, for an error bound.
    Draws,
    /// The number of solutions.
    Solutions,
}

/// What is being done, to how many cameras.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stage {
    /// What.
    pub step: Step,
    /// The nodes of the core, or of the whole graph.
    pub cameras: usize,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let cameras = self.cameras;
        let step = match self.step {
            Step::Contraction => return write!(f, "contraction of {cameras} cameras"),
            Step::WholeMatrix => "whole Jacobian",
            Step::Flows => "flows",
            Step::Lambda => "Lambda",
            Step::Elimination => "elimination",
            Step::Components => "components",
            Step::Counting => "counting",
            Step::Draws => "draws for an error bound",
            Step::Solutions => return write!(f, "number of solutions of {cameras} cameras"),
        };
        write!(f, "core of {cameras} cameras: {step}")
    }
}

/// Told what the library is doing. Calls come from many threads and should return at once.
pub trait Observer: Send + Sync + fmt::Debug {
    /// Work begins on a stage, of so many units; 0 if that is not known. So many units are expected
    /// after it, if that is known. Works may be nested, and go on side by side; the number tells
    /// them apart.
    fn begin(&self, work: u64, stage: Stage, total: u64, later: Option<u64>);
    /// So many more units of it are done.
    fn done(&self, work: u64, units: u64);
    /// It has ended.
    fn end(&self, work: u64);
}

/// Why work was stopped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Somebody asked for it.
    Interrupted,
    /// The deadline has passed.
    Time,
    /// The program takes more memory than it may.
    Memory {
        /// The limit of the watch, in bytes, if it has one.
        limit: Option<u64>,
    },
    /// One thing that is needed takes more memory than is left.
    TooLarge {
        /// What, in words.
        what: String,
        /// Its size in bytes.
        needs: u64,
        /// The limit, in bytes.
        limit: u64,
    },
}

/// Work that was stopped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// Why.
    pub reason: Reason,
    /// What was being done.
    pub stage: Stage,
    /// How many hundredths of it were done, if that is known.
    pub percent: Option<u8>,
}

impl std::error::Error for Stopped {}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.reason {
            Reason::TooLarge { what, needs, limit } => {
                let (needs, limit) = (Bytes(*needs), Bytes(*limit));
                return write!(
                    f,
                    "{}: too large: {what} would take {needs} of memory, and the limit is {limit}",
                    self.stage
                );
            }
            Reason::Interrupted => write!(f, "interrupted")?,
            Reason::Time => write!(f, "the time limit was reached")?,
            Reason::Memory { limit: None } => write!(f, "the memory limit was reached")?,
            Reason::Memory { limit: Some(limit) } => {
                write!(f, "the memory limit of {} was reached", Bytes(*limit))?;
            }
        }
        write!(f, " at the {}", self.stage)?;
        match self.percent {
            Some(percent) => write!(f, ", {percent} % done"),
            None => Ok(()),
        }
    }
}

/// A number of bytes, for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bytes(pub u64);

impl fmt::Display for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (unit, shift) = match self.0 {
            0..0x10_0000 => ("KiB", 10),
            0x10_0000..0x4000_0000 => ("MiB", 20),
            _ => ("GiB", 30),
        };
        let tenths = (u128::from(self.0) * 10) >> shift;
        if tenths < 100 && tenths % 10 != 0 {
            write!(f, "{}.{} {unit}", tenths / 10, tenths % 10)
        } else {
            write!(f, "{} {unit}", tenths / 10)
        }
    }
}

/// The limits of a [`Watch`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits {
    /// When to stop.
    pub deadline: Option<Instant>,
    /// How many bytes the large matrices may take together.
    pub memory: Option<u64>,
}

/// One end of what can stop work; the other end is a clone of it. The default one never
/// stops anything, tells nobody, and costs nothing.
#[derive(Clone, Debug, Default)]
pub struct Watch {
    shared: Option<Arc<Shared>>,
    observer: Option<Arc<dyn Observer>>,
}

#[derive(Debug)]
struct Shared {
    /// 0, or one of the reasons below.
    stop: AtomicU8,
    limits: Limits,
    /// Bytes of large matrices.
    held: AtomicU64,
    works: AtomicU64,
}

const INTERRUPTED: u8 = 1;
const TIME: u8 = 2;
const MEMORY: u8 = 3;

static NOBODY: Watch = Watch {
    shared: None,
    observer: None,
};

impl Watch {
    /// A watch with limits, which can be interrupted.
    pub fn new(limits: Limits) -> Self {
        Self {
            shared: Some(Arc::new(Shared {
                stop: AtomicU8::new(0),
                limits,
                held: AtomicU64::new(0),
                works: AtomicU64::new(0),
            })),
            observer: None,
        }
    }

    /// The same watch, with somebody who is told about the work it is given to.
    pub fn observed(&self, observer: Arc<dyn Observer>) -> Self {
        Self {
            observer: Some(observer),
            ..self.clone()
        }
    }

    /// Stops all work under this watch, and its clones. The first reason counts.
    pub fn interrupt(&self) {
        self.stop(INTERRUPTED);
    }

    /// The same, because the program takes too much memory.
    pub fn out_of_memory(&self) {
        self.stop(MEMORY);
    }

    fn stop(&self, reason: u8) {
        if let Some(shared) = &self.shared {
            shared.stop(reason);
        }
    }

    /// Why all work under this watch stops; `None` if it may go on.
    pub fn stopped(&self) -> Option<Reason> {
        self.shared.as_deref().and_then(Shared::reason)
    }

    /// Names work that is about to be done.
    pub fn task(&self, step: Step, cameras: usize) -> Task<'_> {
        Task {
            watch: self,
            stage: Stage { step, cameras },
            told: self.observer.is_some(),
            later: Some(0),
        }
    }
}

impl Shared {
    fn stop(&self, reason: u8) {
        let _ = self
            .stop
            .compare_exchange(0, reason, Ordering::Relaxed, Ordering::Relaxed);
    }

    #[inline]
    fn is_stopped(&self) -> bool {
        if self.stop.load(Ordering::Relaxed) != 0 {
            return true;
        }
        let late = self
            .limits
            .deadline
            .is_some_and(|deadline| Instant::now() >= deadline);
        if late {
            self.stop(TIME);
        }
        late
    }

    fn reason(&self) -> Option<Reason> {
        if !self.is_stopped() {
            return None;
        }
        Some(match self.stop.load(Ordering::Relaxed) {
            INTERRUPTED => Reason::Interrupted,
            TIME => Reason::Time,
            _ => Reason::Memory {
                limit: self.limits.memory,
            },
        })
    }
}

/// Does work that nobody watches, so that nothing stops it: for what is short, and for tests.
///
/// ```
/// use viewcert::linalg::{dense_lu::eliminate_mod, matrix::Matrix, prime::PrimeField};
/// use viewcert::watch::unwatched;
///
/// let field = PrimeField::mersenne61();
/// let one = Matrix::new(1, 1, vec![field.from_u64(1)]);
/// assert_eq!(unwatched(|task| eliminate_mod(&field, one, task)).rank(), 1);
/// ```
pub fn unwatched<T>(work: impl FnOnce(&Task<'static>) -> Result<T, Stopped>) -> T {
    let task = NOBODY.task(Step::Flows, 0);
    work(&task).unwrap_or_else(|stopped| unreachable!("{stopped}"))
}

/// A stage under a watch: work on it can begin, once or several times.
#[derive(Clone, Copy, Debug)]
pub struct Task<'w> {
    watch: &'w Watch,
    stage: Stage,
    told: bool,
    later: Option<u64>,
}

impl<'w> Task<'w> {
    /// The same cameras, another step.
    pub fn at(&self, step: Step) -> Self {
        let stage = Stage { step, ..self.stage };
        Self { stage, ..*self }
    }

    /// The same, with so many units of other work expected after it; `None` if that is not known,
    /// or counted in other units.
    pub(crate) fn followed_by(&self, later: Option<u64>) -> Self {
        Self { later, ..*self }
    }

    /// A part of the work that is not worth telling; it can be stopped all the same.
    pub(crate) fn untold(&self) -> Self {
        Self {
            told: false,
            ..*self
        }
    }

    /// Begins work of so many units; 0 if that is not known.
    pub fn begin(&self, total: u64) -> Work<'w> {
        let mut number = 0;
        if let (true, Some(shared), Some(observer)) =
            (self.told, &self.watch.shared, &self.watch.observer)
        {
            number = shared.works.fetch_add(1, Ordering::Relaxed);
            observer.begin(number, self.stage, total, self.later);
        }
        Work {
            task: *self,
            number,
            total,
            done: AtomicU64::new(0),
        }
    }

    /// Whether the work may go on.
    ///
    /// # Errors
    /// If it was stopped.
    #[inline]
    pub fn check(&self) -> Result<(), Stopped> {
        match &self.watch.shared {
            Some(shared) if shared.is_stopped() => Err(self.stopped(None)),
            _ => Ok(()),
        }
    }

    /// Puts so many bytes on the account of the watch until the result is dropped.
    ///
    /// # Errors
    /// If there are not as many left. `what` says what they are for.
    pub(crate) fn reserve(&self, bytes: u64, what: fmt::Arguments) -> Result<Reservation, Stopped> {
        let mut reservation = Reservation {
            shared: self.watch.shared.clone(),
            bytes: 0,
        };
        reservation.resize(bytes, self, what)?;
        Ok(reservation)
    }

    #[cold]
    fn stopped(&self, percent: Option<u8>) -> Stopped {
        Stopped {
            reason: self.watch.stopped().unwrap_or(Reason::Interrupted),
            stage: self.stage,
            percent,
        }
    }
}

/// Work that has begun, and ends when this is dropped.
#[derive(Debug)]
pub struct Work<'w> {
    task: Task<'w>,
    number: u64,
    total: u64,
    done: AtomicU64,
}

impl<'w> Work<'w> {
    /// So many more units are done.
    ///
    /// # Errors
    /// If the work was stopped.
    #[inline]
    pub fn done(&self, units: u64) -> Result<(), Stopped> {
        let Some(shared) = &self.task.watch.shared else {
            return Ok(());
        };
        let before = self.done.fetch_add(units, Ordering::Relaxed);
        if self.task.told
            && let Some(observer) = &self.task.watch.observer
        {
            observer.done(self.number, units);
        }
        if shared.is_stopped() {
            let done = u128::from(before + units).min(u128::from(self.total));
            let percent = (100 * done).checked_div(u128::from(self.total));
            return Err(self.task.stopped(percent.map(|percent| percent as u8)));
        }
        Ok(())
    }

    /// Whether what is being computed will be thrown away: for loops that cannot return an
    /// error, before a call of [`done`](Self::done) that will.
    #[inline]
    pub(crate) fn is_stopped(&self) -> bool {
        let shared = self.task.watch.shared.as_deref();
        shared.is_some_and(Shared::is_stopped)
    }

    /// The task it is work on.
    pub fn task(&self) -> Task<'w> {
        self.task
    }
}

impl Drop for Work<'_> {
    fn drop(&mut self) {
        if self.task.told
            && let Some(observer) = &self.task.watch.observer
        {
            observer.end(self.number);
        }
    }
}

/// Memory on the account of a watch.
#[derive(Debug, Default)]
pub(crate) struct Reservation {
    shared: Option<Arc<Shared>>,
    bytes: u64,
}

impl Reservation {
    /// Changes the number of bytes.
    ///
    /// # Errors
    /// If there are not as many left; nothing changes then.
    pub(crate) fn resize(
        &mut self,
        bytes: u64,
        task: &Task,
        what: fmt::Arguments,
    ) -> Result<(), Stopped> {
        let Some(shared) = &self.shared else {
            return Ok(());
        };
        let others = shared
            .held
            .load(Ordering::Relaxed)
            .saturating_sub(self.bytes);
        if let Some(limit) = shared.limits.memory
            && others.saturating_add(bytes) > limit
        {
            return Err(Stopped {
                reason: Reason::TooLarge {
                    what: what.to_string(),
                    needs: bytes,
                    limit,
                },
                stage: task.stage,
                percent: None,
            });
        }
        // Between the look and this another thread may have taken some; the account is for
        // matrices that are far too large, not for the last byte.
        shared.held.fetch_add(bytes, Ordering::Relaxed);
        shared.held.fetch_sub(self.bytes, Ordering::Relaxed);
        self.bytes = bytes;
        Ok(())
    }
}

impl Clone for Reservation {
    fn clone(&self) -> Self {
        if let Some(shared) = &self.shared {
            shared.held.fetch_add(self.bytes, Ordering::Relaxed);
        }
        Self {
            shared: self.shared.clone(),
            bytes: self.bytes,
        }
    }
}

impl Drop for Reservation {
    fn drop(&mut self) {
        if let Some(shared) = &self.shared {
            shared.held.fetch_sub(self.bytes, Ordering::Relaxed);
        }
    }
}

/// The bytes of a matrix of words.
pub(crate) fn matrix_bytes(rows: usize, cols: usize) -> u64 {
    (rows as u64).saturating_mul(cols as u64).saturating_mul(8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;
    use std::time::Duration;

    #[derive(Debug, Default)]
    struct Record(Mutex<Vec<String>>);

    impl Observer for Record {
        fn begin(&self, work: u64, stage: Stage, total: u64, later: Option<u64>) {
            let line = format!("{work} {stage} of {total}, then {later:?}");
            self.0.lock().unwrap().push(line);
        }
        fn done(&self, work: u64, units: u64) {
            self.0.lock().unwrap().push(format!("{work} + {units}"));
        }
        fn end(&self, work: u64) {
            self.0.lock().unwrap().push(format!("{work} ends"));
        }
    }

    #[test]
    fn observers_are_told_and_stopped_work_says_how_far_it_was() {
        let record = Arc::new(Record::default());
        let watch = Watch::new(Limits::default()).observed(record.clone());
        let task = watch.task(Step::Elimination, 7).followed_by(Some(2));
        {
            let work = task.begin(8);
            work.done(3).unwrap();
            task.untold().begin(5).done(1).unwrap();
            watch.interrupt();
            let stopped = work.done(1).unwrap_err();
            assert_eq!(
                (&stopped.reason, stopped.percent),
                (&Reason::Interrupted, Some(50))
            );
            assert_eq!(
                stopped.to_string(),
                "interrupted at the core of 7 cameras: elimination, 50 % done"
            );
        }
        let expected = [
            "0 core of 7 cameras: elimination of 8, then Some(2)",
            "0 + 3",
            "0 + 1",
            "0 ends",
        ];
        assert_eq!(*record.0.lock().unwrap(), expected);
        // The first reason counts, and a task without units has no hundredths.
        watch.out_of_memory();
        assert_eq!(task.begin(0).done(0).unwrap_err().percent, None);
        assert_eq!(watch.stopped(), Some(Reason::Interrupted));
    }

    #[test]
    fn deadlines_pass() {
        let deadline = Some(Instant::now() + Duration::from_secs(3600));
        let early = Watch::new(Limits {
            deadline,
            memory: None,
        });
        assert_eq!(early.stopped(), None);
        let deadline = Some(Instant::now());
        let late = Watch::new(Limits {
            deadline,
            memory: None,
        });
        let stopped = late.task(Step::Contraction, 9).check().unwrap_err();
        assert_eq!(
            stopped.to_string(),
            "the time limit was reached at the contraction of 9 cameras"
        );
    }

    #[test]
    fn memory_is_accounted() {
        let watch = Watch::new(Limits {
            deadline: None,
            memory: Some(1000),
        });
        let task = watch.task(Step::Lambda, 3);
        let mut first = task.reserve(600, format_args!("one")).unwrap();
        let refused = task.reserve(401, format_args!("two")).unwrap_err();
        let reason = Reason::TooLarge {
            what: "two".into(),
            needs: 401,
            limit: 1000,
        };
        assert_eq!(refused.reason, reason);
        let second = task.reserve(400, format_args!("two")).unwrap();
        assert!(first.resize(601, &task, format_args!("one")).is_err());
        drop(second);
        first.resize(500, &task, format_args!("one")).unwrap();
        let copy = first.clone();
        assert!(task.reserve(1, format_args!("three")).is_err());
        drop((first, copy));
        assert!(task.reserve(1000, format_args!("all")).is_ok());
    }

    #[test]
    fn nobody_stops_what_nobody_watches() {
        unwatched(|task| {
            let work = task.begin(1);
            work.done(1)?;
            NOBODY.interrupt();
            assert!(!work.is_stopped() && task.check().is_ok());
            task.reserve(u64::MAX, format_args!("all"))
        });
    }

    #[test]
    fn sizes_for_people() {
        let shown = [0, 1024, 1536, 5 << 20, (3 << 30) + (1 << 29), 640 << 30];
        let shown = shown.map(|bytes| Bytes(bytes).to_string());
        let expected = ["0 KiB", "1 KiB", "1.5 KiB", "5 MiB", "3.5 GiB", "640 GiB"];
        assert_eq!(shown, expected);
    }
}

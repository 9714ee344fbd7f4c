//! Work under a watch, and the memory that it takes.

use super::limits::{Reason, Shared, Stopped, Watch};
use super::progress::{Stage, Step};
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

static NOBODY: Watch = Watch {
    shared: None,
    observer: None,
};

impl Watch {
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
            so_far: None,
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
            .held()
            .load(Ordering::Relaxed)
            .saturating_sub(self.bytes);
        if let Some(limit) = shared.limits.memory
            && others.saturating_add(bytes) > limit
        {
            return Err(Stopped {
                reason: Reason::TooLarge {
                    what: what.to_string(),
                    needs: bytes,
                    held: others,
                    limit,
                },
                stage: task.stage,
                percent: None,
                so_far: None,
            });
        }
        // Between the look and this another thread may have taken some; the account is for
        // matrices that are far too large, not for the last byte.
        shared.held().fetch_add(bytes, Ordering::Relaxed);
        shared.held().fetch_sub(self.bytes, Ordering::Relaxed);
        self.bytes = bytes;
        Ok(())
    }
}

impl Clone for Reservation {
    fn clone(&self) -> Self {
        if let Some(shared) = &self.shared {
            shared.held().fetch_add(self.bytes, Ordering::Relaxed);
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
            shared.held().fetch_sub(self.bytes, Ordering::Relaxed);
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
    use crate::watch::{Limits, Observer};
    use std::sync::Mutex;

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
            held: 600,
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
}

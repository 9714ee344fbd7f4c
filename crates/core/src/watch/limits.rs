//! What stops work, and why it was stopped.

use super::progress::{Observer, Stage};
use crate::wording::counted;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};
use std::time::Instant;

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
        /// What other large things take, in bytes.
        held: u64,
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
    /// What was proved before.
    pub so_far: Option<SoFar>,
}

/// What contraction and regions had proved before work was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SoFar {
    /// How many parts of three cameras and more are finite solvable, none inside of another.
    pub parts: usize,
    /// The cameras of the largest.
    pub largest: usize,
}

impl std::error::Error for Stopped {}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.reason {
            Reason::TooLarge {
                what,
                needs,
                held,
                limit,
            } => {
                let (needs, limit) = (Bytes(*needs), Bytes(*limit));
                let beside = match held {
                    0 => String::new(),
                    _ => format!(" beside {} in use", Bytes(*held)),
                };
                write!(
                    f,
                    "{}: too large: {what} would take {needs} of memory{beside}, and the limit is {limit}",
                    self.stage
                )?;
                return self.write_so_far(f);
            }
            Reason::Interrupted => write!(f, "interrupted")?,
            Reason::Time => write!(f, "the time limit was reached")?,
            Reason::Memory { limit: None } => write!(f, "the memory limit was reached")?,
            Reason::Memory { limit: Some(limit) } => {
                write!(f, "the memory limit of {} was reached", Bytes(*limit))?;
            }
        }
        write!(f, " at the {}", self.stage)?;
        if let Some(percent) = self.percent {
            write!(f, ", {percent} % done")?;
        }
        self.write_so_far(f)
    }
}

impl Stopped {
    fn write_so_far(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.so_far {
            Some(SoFar { parts, largest }) if parts > 0 => {
                let parts = counted(parts, "part");
                write!(
                    f,
                    "; so far: {parts} of three cameras and more finite solvable (proved), the largest of {largest}"
                )
            }
            _ => Ok(()),
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
    pub(super) shared: Option<Arc<Shared>>,
    pub(super) observer: Option<Arc<dyn Observer>>,
}

/// What a watch shares with its clones.
#[derive(Debug)]
pub(super) struct Shared {
    /// What stops this watch too, and keeps the account of memory.
    around: Option<Arc<Self>>,
    /// 0, or one of the reasons below.
    stop: AtomicU8,
    pub(super) limits: Limits,
    /// Bytes of large matrices, if nothing is around.
    held: AtomicU64,
    pub(super) works: AtomicU64,
}

const INTERRUPTED: u8 = 1;
const TIME: u8 = 2;
const MEMORY: u8 = 3;

impl Watch {
    /// A watch with limits, which can be interrupted.
    pub fn new(limits: Limits) -> Self {
        Self {
            shared: Some(Arc::new(Shared::new(None, limits))),
            observer: None,
        }
    }

    /// A watch for a part of the work: what stops this one stops it, and so does a deadline of its own. The
    /// memory that both take is one.
    pub fn until(&self, deadline: Option<Instant>) -> Self {
        if deadline.is_none() {
            return self.clone();
        }
        let memory = self.shared.as_ref().and_then(|around| around.limits.memory);
        let limits = Limits { deadline, memory };
        Self {
            shared: Some(Arc::new(Shared::new(self.shared.clone(), limits))),
            observer: self.observer.clone(),
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
}

impl Shared {
    fn new(around: Option<Arc<Self>>, limits: Limits) -> Self {
        Self {
            around,
            stop: AtomicU8::new(0),
            limits,
            held: AtomicU64::new(0),
            works: AtomicU64::new(0),
        }
    }

    /// Bytes of large matrices.
    pub(super) fn held(&self) -> &AtomicU64 {
        self.around
            .as_ref()
            .map_or(&self.held, |around| around.held())
    }

    fn stop(&self, reason: u8) {
        let _ = self
            .stop
            .compare_exchange(0, reason, Ordering::Relaxed, Ordering::Relaxed);
    }

    #[inline]
    pub(super) fn is_stopped(&self) -> bool {
        let around = self.around.as_ref();
        if self.stop.load(Ordering::Relaxed) != 0
            || around.is_some_and(|around| around.is_stopped())
        {
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
        if let Some(reason) = self.around.as_ref().and_then(|around| around.reason()) {
            return Some(reason);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::Step;
    use std::time::Duration;

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
    fn a_watch_within_another_has_its_own_deadline_and_its_memory() {
        let all = Watch::new(Limits {
            deadline: None,
            memory: Some(100),
        });
        let late = all.until(Some(Instant::now()));
        assert_eq!(late.stopped(), Some(Reason::Time));
        assert_eq!(all.stopped(), None, "the others go on");
        let other = all.until(Some(Instant::now() + Duration::from_secs(3600)));
        let shared = |watch: &Watch| watch.shared.clone().unwrap();
        shared(&other).held().fetch_add(7, Ordering::Relaxed);
        assert_eq!(shared(&all).held().load(Ordering::Relaxed), 7);
        all.interrupt();
        assert_eq!(other.stopped(), Some(Reason::Interrupted));
        assert_eq!(late.stopped(), Some(Reason::Interrupted));
    }

    #[test]
    fn sizes_for_people() {
        let shown = [0, 1024, 1536, 5 << 20, (3 << 30) + (1 << 29), 640 << 30];
        let shown = shown.map(|bytes| Bytes(bytes).to_string());
        let expected = ["0 KiB", "1 KiB", "1.5 KiB", "5 MiB", "3.5 GiB", "640 GiB"];
        assert_eq!(shown, expected);
    }
}

//! The session: its watch, its bar and its outputs, and the threads that keep its limits.
//!
//! Work under the session's [`Watch`] is stopped where it asks whether it may go on, some
//! milliseconds after the limit or the signal, and ends as any error does. What does not ask
//! (reading, floating point) gets half a second; then the program ends from here, after it has
//! removed the files that are half written.

use crate::bar::Bar;
use crate::exit::{
    BAD_INPUT, BROKEN_PIPE, INTERRUPTED, TERMINATED, TOO_LARGE, is_broken_pipe, is_too_large,
    stopped,
};
use crate::limits::{RunLimits, resident_memory};
use crate::outputs::Outputs;
use crate::{complain, unpoisoned};
use anyhow::{Context, Error, Result};
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use viewcert::watch::{Bytes, Limits, Reason, Watch};

/// Time between two looks at the clock, the memory and the bar.
const TICK: Duration = Duration::from_millis(50);

/// How long stopped work may take to end by itself.
const GRACE: Duration = Duration::from_millis(500);

/// One run. Copies are the same run; by default it has no limits, no bar and no signals.
#[derive(Clone, Debug, Default)]
pub struct Session(Arc<Run>);

#[derive(Debug, Default)]
struct Run {
    /// What messages begin with.
    program: &'static str,
    /// Without a deadline.
    watch: Watch,
    time: Option<Duration>,
    /// When what is being done now has to end.
    deadline: Mutex<Option<Instant>>,
    memory: Option<u64>,
    bar: Option<Arc<Bar>>,
    outputs: Outputs,
    /// What the program is doing, where the library does not tell.
    doing: Mutex<String>,
    /// Whether the signal that came was SIGTERM.
    terminated: AtomicBool,
    /// Whether somebody has said why the program ends.
    said: AtomicBool,
}

impl Session {
    /// Runs a program of this name: limits and signals count from the beginning, and at the end
    /// the exit code is that of the work, or of the error, which is said.
    pub fn run(
        program: &'static str,
        limits: &RunLimits,
        work: impl FnOnce(&Self) -> Result<u8>,
    ) -> u8 {
        let (session, done) = match Self::begin(program, limits) {
            Ok(session) => {
                let done = work(&session);
                session.hide();
                (session, done)
            }
            Err(error) => {
                let run = Run {
                    program,
                    ..Run::default()
                };
                (Self(Arc::new(run)), Err(error))
            }
        };
        done.unwrap_or_else(|error| {
            session.say_end(&error);
            session.exit_code(&error)
        })
    }

    /// A run under a watch that somebody else keeps, without bar and signals.
    pub fn under(watch: Watch) -> Self {
        Self(Arc::new(Run {
            watch,
            ..Run::default()
        }))
    }

    fn begin(program: &'static str, limits: &RunLimits) -> Result<Self> {
        let (time, memory) = (limits.duration(), limits.bytes());
        let run = Arc::new(Run {
            watch: Watch::new(Limits {
                deadline: None,
                memory,
            }),
            deadline: Mutex::new(time.and_then(|time| Instant::now().checked_add(time))),
            program,
            time,
            memory,
            bar: std::io::stderr().is_terminal().then(Arc::<Bar>::default),
            ..Run::default()
        });
        #[cfg(unix)]
        catch_signals(Arc::clone(&run)).context("signals cannot be caught")?;
        // In a page there are no threads: the time is looked at where the work is.
        if !cfg!(target_family = "wasm") {
            let guarded = Arc::clone(&run);
            std::thread::Builder::new()
                .name("limits".into())
                .spawn(move || guarded.guard())
                .context("no thread for the limits")?;
        }
        Ok(Self(run))
    }

    /// Where its files go.
    pub fn outputs(&self) -> &Outputs {
        &self.0.outputs
    }

    /// Its watch, until the time limit of what is being done now.
    pub fn watch(&self) -> Watch {
        self.0.watch.until(*unpoisoned(&self.0.deadline))
    }

    /// The watch of one of several works that begin side by side: each has the time limit to itself.
    pub fn watch_of_one(&self) -> Watch {
        self.0.watch.until(self.deadline(Duration::ZERO))
    }

    /// From now on the time limit is that of another work, of which so much is done already; or there is none,
    /// while several are done that have theirs.
    pub fn begin_work(&self, done: Option<Duration>) {
        *unpoisoned(&self.0.deadline) = done.and_then(|done| self.deadline(done));
    }

    fn deadline(&self, done: Duration) -> Option<Instant> {
        let left = self.0.time?.saturating_sub(done);
        Instant::now().checked_add(left)
    }

    /// Its watch, with the bar if there is a terminal to show it.
    pub fn shown_watch(&self) -> Watch {
        match &self.0.bar {
            Some(bar) => self.watch().observed(bar.clone()),
            None => self.watch(),
        }
    }

    /// Does a work under its watch: the bar shows how far it is, and is off the terminal when it ends.
    pub fn watched<T>(&self, work: impl FnOnce(&Watch) -> T) -> T {
        let done = work(&self.shown_watch());
        self.hide();
        done
    }

    /// Notes what the program is doing, for the message if it is stopped there.
    pub fn doing(&self, what: String) {
        *unpoisoned(&self.0.doing) = what;
    }

    /// The same for reading a file, which the bar shows if it takes long.
    pub fn reading(&self, path: &Path) {
        let what = match path.to_str() {
            Some("-") => "reading standard input".to_string(),
            _ => format!("reading {}", path.display()),
        };
        if let Some(bar) = &self.0.bar {
            bar.say(what.clone());
        }
        self.doing(what);
    }

    /// Takes the bar off the terminal: something else is to be written.
    pub fn hide(&self) {
        self.0.hide();
    }

    /// The exit code for an error.
    pub fn exit_code(&self, error: &Error) -> u8 {
        if is_broken_pipe(error) {
            return BROKEN_PIPE;
        }
        match stopped(error) {
            Some(stopped) => self.0.exit_code(&stopped.reason),
            None if is_too_large(error) => TOO_LARGE,
            None => BAD_INPUT,
        }
    }

    /// The name of the program.
    pub fn program(&self) -> &'static str {
        self.0.program
    }

    /// Says why the program ends, unless that has been said or nobody reads it.
    pub fn say_end(&self, error: &Error) {
        if !is_broken_pipe(error) && self.0.first_to_say() {
            // Nothing is left to tell if standard error is gone as well.
            let _ = complain(self.0.program, format_args!("{error:#}"));
        }
    }
}

impl Run {
    fn hide(&self) {
        if let Some(bar) = &self.bar {
            bar.clear();
        }
    }

    /// The exit code for work that was stopped, which is about to be reported.
    fn exit_code(&self, reason: &Reason) -> u8 {
        match reason {
            Reason::Interrupted if self.terminated.load(Ordering::Relaxed) => TERMINATED,
            Reason::Interrupted => INTERRUPTED,
            Reason::Time | Reason::Memory { .. } | Reason::TooLarge { .. } => TOO_LARGE,
        }
    }

    /// Whether this is the first message on the end of the program.
    fn first_to_say(&self) -> bool {
        !self.said.swap(true, Ordering::SeqCst)
    }

    /// Keeps the limits until the process ends.
    fn guard(&self) {
        let mut since: Option<Instant> = None;
        loop {
            std::thread::sleep(TICK);
            if let Some(limit) = self.memory
                && resident_memory().is_some_and(|bytes| bytes > limit)
            {
                self.watch.out_of_memory();
            }
            let watch = self.watch.until(*unpoisoned(&self.deadline));
            match (watch.stopped(), since) {
                (Some(reason), Some(since)) if since.elapsed() >= GRACE => self.end(&reason),
                (Some(_), None) => since = Some(Instant::now()),
                (Some(_), Some(_)) => (),
                (None, _) => since = None,
            }
            if let Some(bar) = &self.bar {
                bar.draw();
            }
        }
    }

    /// Ends the process from this thread.
    fn end(&self, reason: &Reason) -> ! {
        let _kept = self.outputs.abandon();
        self.hide();
        if self.first_to_say() {
            let limit = match (reason, self.time) {
                (Reason::Time, Some(time)) => format!("the time limit of {time:?} was reached"),
                (Reason::Memory { limit: Some(limit) }, _) => {
                    format!("the memory limit of {} was reached", Bytes(*limit))
                }
                _ => "interrupted".into(),
            };
            let doing = unpoisoned(&self.doing);
            if self.bar.is_some() {
                // A bar of another command may stand in this line.
                let _ = write!(std::io::stderr(), "\r\x1b[2K");
            }
            let during = if doing.is_empty() { "" } else { " while " };
            // Nothing is left to tell if standard error is gone.
            let _ = complain(self.program, format_args!("{limit}{during}{doing}"));
        }
        std::process::exit(i32::from(self.exit_code(reason)));
    }
}

/// From now on SIGINT and SIGTERM stop the work.
#[cfg(unix)]
fn catch_signals(run: Arc<Run>) -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM])?;
    std::thread::Builder::new()
        .name("signals".into())
        .spawn(move || {
            for signal in signals.forever() {
                if signal == SIGTERM {
                    run.terminated.store(true, Ordering::Relaxed);
                }
                run.watch.interrupt();
            }
        })?;
    Ok(())
}

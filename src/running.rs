//! Limits, signals and the bar: what may end a run early, and what shows that it goes on.
//!
//! Work under the run's [`Watch`] is stopped where it asks whether it may go on, some
//! milliseconds after the limit or the signal, and ends as any error does. What does not ask
//! (reading, floating point) gets half a second; then the program ends from here, after it has
//! removed the files that are half written.

use super::progress::Bar;
use super::{INTERRUPTED, TERMINATED, TOO_LARGE, atomic};
use anyhow::{Context, Result};
use clap::Args;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::str::FromStr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::{Duration, Instant};
use viewcert::watch::{Bytes, Limits, Reason, Watch};

/// Time between two looks at the clock, the memory and the bar.
const TICK: Duration = Duration::from_millis(50);

/// How long stopped work may take to end by itself.
const GRACE: Duration = Duration::from_millis(500);

/// Limits on a run, for all commands.
#[derive(Args)]
pub(super) struct LimitArguments {
    /// End with exit code 3 after this time: 90s, 5m, 1h; a plain number is seconds.
    #[arg(long, global = true, value_name = "DURATION", help_heading = "Limits")]
    time_limit: Option<TimeLimit>,
    /// End with exit code 3 instead of taking more memory: 500M, 2G; a plain number is bytes
    /// [default: three quarters of the machine's, where that is known].
    #[arg(long, global = true, value_name = "SIZE", help_heading = "Limits")]
    memory_limit: Option<MemoryLimit>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct TimeLimit(Duration);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct MemoryLimit(u64);

/// A positive number and the unit that follows it.
fn number_and_unit(text: &str) -> Option<(u64, &str)> {
    let end = text
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(text.len());
    let number = text[..end].parse().ok().filter(|&number| number > 0)?;
    Some((number, text[end..].trim()))
}

impl FromStr for TimeLimit {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parse = || {
            let (number, unit) = number_and_unit(text)?;
            let milliseconds = match unit {
                "ms" => 1,
                "" | "s" => 1000,
                "m" | "min" => 60_000,
                "h" => 3_600_000,
                "d" => 86_400_000,
                _ => return None,
            };
            Some(Self(Duration::from_millis(
                number.checked_mul(milliseconds)?,
            )))
        };
        parse().ok_or("a duration is a whole number with ms, s, m, h or d, as in 90s, and not 0")
    }
}

impl FromStr for MemoryLimit {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parse = || {
            let (number, unit) = number_and_unit(text)?;
            let shift = match unit.to_ascii_uppercase().trim_end_matches('B') {
                "" => 0,
                "K" | "KI" => 10,
                "M" | "MI" => 20,
                "G" | "GI" => 30,
                "T" | "TI" => 40,
                _ => return None,
            };
            number.checked_mul(1 << shift).map(Self)
        };
        parse().ok_or("a size is a whole number with K, M, G or T (powers of 1024), and not 0")
    }
}

/// The run of this process.
struct Running {
    watch: Watch,
    time: Option<Duration>,
    memory: Option<u64>,
    bar: Option<Arc<Bar>>,
    /// What the program is doing, where the library does not tell.
    doing: Mutex<String>,
    /// Whether the signal that came was SIGTERM.
    terminated: AtomicBool,
    /// Whether somebody has said why the program ends.
    said: AtomicBool,
}

static RUNNING: OnceLock<Running> = OnceLock::new();

/// Begins the run: from now on limits and signals count.
///
/// # Errors
/// If signals or threads cannot be had.
pub(super) fn begin(arguments: &LimitArguments) -> Result<()> {
    let time = arguments.time_limit.map(|limit| limit.0);
    let memory = arguments
        .memory_limit
        .map(|limit| limit.0)
        .or_else(default_memory_limit);
    let terminal = std::io::stderr().is_terminal();
    let running = RUNNING.get_or_init(|| Running {
        watch: Watch::new(Limits {
            deadline: time.and_then(|time| Instant::now().checked_add(time)),
            memory,
        }),
        time,
        memory,
        bar: terminal.then(Arc::<Bar>::default),
        doing: Mutex::default(),
        terminated: AtomicBool::new(false),
        said: AtomicBool::new(false),
    });
    #[cfg(unix)]
    catch_signals(running).context("signals cannot be caught")?;
    std::thread::Builder::new()
        .name("limits".into())
        .spawn(|| running.guard())
        .context("no thread for the limits")?;
    Ok(())
}

/// The watch of this run.
pub(super) fn watch() -> Watch {
    RUNNING
        .get()
        .map_or_else(Watch::default, |running| running.watch.clone())
}

/// The watch of this run, with the bar if there is a terminal to show it.
pub(super) fn shown_watch() -> Watch {
    match RUNNING.get().and_then(|running| running.bar.clone()) {
        Some(bar) => watch().observed(bar),
        None => watch(),
    }
}

/// Notes what the program is doing, for the message if it is stopped there.
pub(super) fn doing(what: String) {
    if let Some(running) = RUNNING.get() {
        *unpoisoned(&running.doing) = what;
    }
}

/// The same for reading a file, which the bar shows if it takes long.
pub(super) fn reading(path: &Path) {
    let what = match path.to_str() {
        Some("-") => "reading standard input".to_string(),
        _ => format!("reading {}", path.display()),
    };
    if let Some(bar) = RUNNING.get().and_then(|running| running.bar.as_ref()) {
        bar.say(what.clone());
    }
    doing(what);
}

/// Takes the bar off the terminal: something else is to be written.
pub(super) fn hide() {
    if let Some(bar) = RUNNING.get().and_then(|running| running.bar.as_ref()) {
        bar.clear();
    }
}

/// The exit code for work that was stopped, which is about to be reported.
pub(super) fn stopped(reason: &Reason) -> u8 {
    let terminated = |running: &Running| running.terminated.load(Ordering::Relaxed);
    match reason {
        Reason::Interrupted if RUNNING.get().is_some_and(terminated) => TERMINATED,
        Reason::Interrupted => INTERRUPTED,
        Reason::Time | Reason::Memory { .. } | Reason::TooLarge { .. } => TOO_LARGE,
    }
}

/// Whether this is the first message on the end of the program.
pub(super) fn first_to_say() -> bool {
    RUNNING
        .get()
        .is_none_or(|running| !running.said.swap(true, Ordering::SeqCst))
}

impl Running {
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
            match (self.watch.stopped(), since) {
                (Some(reason), Some(since)) if since.elapsed() >= GRACE => self.end(&reason),
                (Some(_), None) => since = Some(Instant::now()),
                _ => (),
            }
            if let Some(bar) = &self.bar {
                bar.draw();
            }
        }
    }

    /// Ends the process from this thread.
    fn end(&self, reason: &Reason) -> ! {
        let _kept = atomic::abandon();
        hide();
        if first_to_say() {
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
            let _ = writeln!(std::io::stderr(), "verify: {limit}{during}{doing}");
        }
        std::process::exit(i32::from(stopped(reason)));
    }
}

fn unpoisoned<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|broken| broken.into_inner())
}

/// From now on SIGINT and SIGTERM stop the work.
#[cfg(unix)]
fn catch_signals(running: &'static Running) -> std::io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM])?;
    std::thread::Builder::new()
        .name("signals".into())
        .spawn(move || {
            for signal in signals.forever() {
                if signal == SIGTERM {
                    running.terminated.store(true, Ordering::Relaxed);
                }
                running.watch.interrupt();
            }
        })?;
    Ok(())
}

/// The memory that a run takes at most if nothing else is said.
pub(super) fn default_memory_limit() -> Option<u64> {
    machine_memory().map(|bytes| bytes / 4 * 3)
}

/// The memory of the machine, or of the group of processes that this one belongs to.
fn machine_memory() -> Option<u64> {
    let total = field_of("/proc/meminfo", "MemTotal:");
    let group = std::fs::read_to_string("/sys/fs/cgroup/memory.max").ok();
    let group = group.and_then(|text| text.trim().parse().ok());
    total.into_iter().chain(group).min()
}

/// The memory that this process takes.
fn resident_memory() -> Option<u64> {
    field_of("/proc/self/status", "VmRSS:")
}

/// A number of KiB in a file of the kernel, in bytes.
fn field_of(path: &str, name: &str) -> Option<u64> {
    let text = std::fs::read_to_string(path).ok()?;
    let value = text.lines().find_map(|line| line.strip_prefix(name))?;
    let number: u64 = value.trim().strip_suffix("kB")?.trim().parse().ok()?;
    number.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations() {
        let seconds = |text: &str| TimeLimit::from_str(text).ok().map(|limit| limit.0);
        assert_eq!(seconds("7"), Some(Duration::from_secs(7)));
        assert_eq!(seconds("90s"), Some(Duration::from_secs(90)));
        assert_eq!(seconds("250ms"), Some(Duration::from_millis(250)));
        assert_eq!(seconds("5m"), seconds("300"));
        assert_eq!(seconds("1h"), seconds("60 min"));
        assert_eq!(seconds("1d"), seconds("24h"));
        for wrong in [
            "",
            "0",
            "s",
            "-1s",
            "1.5s",
            "1w",
            "1h30m",
            "99999999999999999h",
        ] {
            assert_eq!(seconds(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn sizes() {
        let bytes = |text: &str| MemoryLimit::from_str(text).ok().map(|limit| limit.0);
        assert_eq!(bytes("4096"), Some(4096));
        assert_eq!(bytes("500M"), Some(500 << 20));
        assert_eq!(bytes("2G"), Some(2 << 30));
        assert_eq!(bytes("2GiB"), bytes("2g"));
        assert_eq!(bytes("1T"), bytes("1024 GB"));
        for wrong in ["", "0", "G", "1.5G", "-1", "1X", "99999999T"] {
            assert_eq!(bytes(wrong), None, "{wrong}");
        }
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn linux_knows_its_memory() {
        let (all, own) = (machine_memory().unwrap(), resident_memory().unwrap());
        assert!(0 < own && own < all);
    }
}

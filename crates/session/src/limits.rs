//! Limits of time and memory: as they are written, and what the machine has.

use std::str::FromStr;
use std::time::Duration;

/// A limit of time: `90s`, `5m`, `1h`; a plain number is seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeLimit(Duration);

/// A limit of memory: `500M`, `2G`; a plain number is bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryLimit(u64);

impl TimeLimit {
    /// How long that is.
    pub fn duration(self) -> Duration {
        self.0
    }
}

impl MemoryLimit {
    /// How many bytes that is.
    pub fn bytes(self) -> u64 {
        self.0
    }
}

/// What a run may take.
#[derive(Clone, Copy, Debug, Default)]
pub struct RunLimits {
    /// Its time, from its beginning.
    pub time: Option<TimeLimit>,
    /// Its memory; if nothing is said three quarters of the machine's, where that is known.
    pub memory: Option<MemoryLimit>,
}

impl RunLimits {
    pub(crate) fn duration(&self) -> Option<Duration> {
        self.time.map(|limit| limit.0)
    }

    pub(crate) fn bytes(&self) -> Option<u64> {
        self.memory
            .map(|limit| limit.0)
            .or_else(default_memory_limit)
    }
}

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

/// The memory that a run takes at most if nothing else is said, in bytes; `None` where that of the
/// machine is not known.
pub fn default_memory_limit() -> Option<u64> {
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
pub(crate) fn resident_memory() -> Option<u64> {
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

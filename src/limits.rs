//! Limits on a run: options of all commands.

use clap::Args;
use viewcert_session::{MemoryLimit, RunLimits, TimeLimit};

/// Limits on a run, for all commands.
#[derive(Args)]
pub struct LimitArguments {
    /// End with exit code 3 after this time, of several graphs each: 90s, 5m, 1h; a plain number is seconds.
    #[arg(long, global = true, value_name = "DURATION", help_heading = "Limits")]
    time_limit: Option<TimeLimit>,
    /// End with exit code 3 instead of taking more memory: 500M, 2G; a plain number is bytes
    /// [default: three quarters of the machine's, where that is known].
    #[arg(long, global = true, value_name = "SIZE", help_heading = "Limits")]
    memory_limit: Option<MemoryLimit>,
}

impl LimitArguments {
    /// As the session takes them.
    pub fn limits(&self) -> RunLimits {
        RunLimits {
            time: self.time_limit,
            memory: self.memory_limit,
        }
    }
}

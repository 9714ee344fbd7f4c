//! Limits on a run: options of all commands.

use clap::Args;
use viewcert_session::{MemoryLimit, RunLimits, TimeLimit};

/// Limits on a run, for all commands.
#[derive(Args)]
pub struct LimitArguments {
    /// End with exit code 3 after this time for a graph: 90s, 5m, 1h.
    #[arg(
        long,
        global = true,
        value_name = "DURATION",
        help_heading = "Limits",
        hide_short_help = true
    )]
    time_limit: Option<TimeLimit>,
    /// End with exit code 3 instead of taking more memory: 500M, 2G.
    #[arg(
        long,
        global = true,
        value_name = "SIZE",
        help_heading = "Limits",
        hide_short_help = true
    )]
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

//! How many measured motions cannot all be right, by proof.

use anyhow::{Context, Result};
use std::path::Path;
use std::time::Instant;
use viewcert_advice::contradictions::{certificate, contradictions};
use viewcert_formats::{ReadOptions, read_motions};
use viewcert_report::contradictions::Contradicted;
use viewcert_session::Session;

/// The angle of an alarm, in degrees.
pub const ANGLE: u32 = 10;

/// What is asked of a file, whoever asks.
pub struct Asked<'a> {
    /// The file.
    pub file: &'a Path,
    /// The angle in degrees, 1 to 59.
    pub angle: u32,
    /// Where the certificate goes.
    pub certificate: Option<&'a Path>,
}

impl Asked<'_> {
    /// Reads the motions, finds what contradicts what, and calls `say` with it.
    ///
    /// # Errors
    /// A file that cannot be read, or holds no motions; those of `say`.
    pub fn of<T>(
        &self,
        session: &Session,
        say: impl FnOnce(&Contradicted) -> Result<T>,
    ) -> Result<T> {
        let start = Instant::now();
        session.reading(self.file);
        let is_hashed = self.certificate.is_some();
        let motions = read_motions(self.file, &ReadOptions::default(), is_hashed);
        session.hide();
        let motions = motions?;
        let name = motions.name.clone();
        let found = session.watched(|watch| contradictions(motions, self.angle, watch));
        let (motions, found) = found.context(name)?;
        if let Some(path) = self.certificate {
            let text = serde_json::to_vec(&certificate(&motions, &found))?;
            session.outputs().write(path, |out| out.write_all(&text))?;
        }
        say(&Contradicted {
            path: self.file.display().to_string(),
            motions,
            found,
            time: start.elapsed(),
        })
    }
}

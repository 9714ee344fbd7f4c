//! `plane-minor` (section 7 of the specification): a minor of the plane direction matrix R that
//! does not vanish at drawn points.

use crate::algebra::Field;
use crate::cameras::{self, Stream};
use crate::core::Core;
use crate::document::PlaneMinor;
use crate::elimination::{Echelon, Factors};
use crate::matrices::plane_direction;
use crate::pivots::Pivots;
use crate::rejection::Checked;
use crate::setting::{Lower, Setting};

/// Verifies `plane-minor`: the rank of R at points modulo p (theory, Corollary 13.12).
pub(crate) fn check_plane_minor(
    minor: &PlaneMinor,
    setting: &Setting,
    core: &Core,
) -> Checked<Lower> {
    let field = &Field::new(minor.prime)?;
    let mut stream = Stream::new("draw", core.hashes(setting), minor.seed, minor.draw);
    let points = cameras::plane_points(&mut stream, field, core.nodes)?;
    let (height, width) = (core.edges.len(), 2 * core.nodes);
    let pivots = Pivots::new(&minor.rows, &minor.cols, [height, width])?;
    let echelon = Echelon::new(field, width, setting.meter);
    Factors::new(echelon, &pivots, |row| {
        plane_direction(field, core, &points, row)
    })?;
    Ok(Lower {
        rank: 4 * minor.rows.len() as i64,
        at: Some((minor.prime, minor.seed, minor.draw)),
        note: None,
    })
}

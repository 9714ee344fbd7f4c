//! Lower bounds on the rank of a core (section 7 of the specification): pivots, and `minor`. The
//! other kinds have files of their own.

use crate::algebra::Field;
use crate::cameras::{self, Stream};
use crate::core::Core;
use crate::document::{Evidence, Minor};
use crate::elimination::{Echelon, Factors};
use crate::integer_minor::check_integer_minor;
use crate::matrices::jacobian;
use crate::pivots::Pivots;
use crate::plane_flow::check_plane_flow;
use crate::plane_minor::check_plane_minor;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::{Lower, Setting};

/// Verifies a lower bound: a rank at one point is one for the generic rank (theory, Proposition
/// 1.4).
pub(crate) fn check_lower(evidence: &Evidence, setting: &Setting, core: &Core) -> Checked<Lower> {
    core.charge_draw(setting)?;
    let model = setting.model;
    // Each matrix belongs to a question.
    let of = |fits: bool| -> Checked<()> {
        ensure!(fits, "not evidence in the {model} model");
        Ok(())
    };
    let lower = match evidence {
        Evidence::Minor(minor) => {
            of(!model.is_linear())?;
            check_minor(minor, setting, core)?
        }
        Evidence::IntegerMinor(minor) => {
            of(!model.is_linear())?;
            check_integer_minor(minor, setting, core)?
        }
        Evidence::PlaneFlow(flow) => {
            of(!model.in_plane())?;
            check_plane_flow(flow, setting, core)?
        }
        Evidence::PlaneMinor(minor) => {
            of(model.in_plane())?;
            check_plane_minor(minor, setting, core)?
        }
        _ => return Err(Failure::rejected("not a lower bound")),
    };
    let most = core.required(setting);
    ensure!(
        lower.rank <= most,
        "a rank of {} is impossible for {} nodes",
        lower.rank,
        core.nodes
    );
    Ok(lower)
}

/// Sees that lower bounds show a core to be rigid.
pub(crate) fn check_rigid(evidence: &[Evidence], setting: &Setting, core: &Core) -> Checked<()> {
    let required = core.required(setting);
    let mut is_rigid = false;
    for (k, one) in evidence.iter().enumerate() {
        let bound = check_lower(one, setting, core);
        let bound = bound.within(|| format!("evidence[{k}] ({})", one.kind()))?;
        is_rigid |= bound.rank == required;
    }
    ensure!(
        is_rigid,
        "not proved to have the rank {required} of its core"
    );
    Ok(())
}

/// A minor of J_P that does not vanish modulo p.
fn check_minor(minor: &Minor, setting: &Setting, core: &Core) -> Checked<Lower> {
    let field = &Field::new(minor.prime)?;
    let mut stream = Stream::new("draw", core.hashes(setting), minor.seed, minor.draw);
    let cameras = cameras::general(&mut stream, field, core.nodes)?;
    let pivots = Pivots::of_jacobian(&minor.rows, &minor.cols, core)?;
    let echelon = Echelon::new(field, 12 * core.nodes, setting.meter);
    Factors::new(echelon, &pivots, |row| {
        jacobian(field, &core.edges, &cameras, row)
    })?;
    Ok(Lower {
        rank: minor.rows.len() as i64,
        at: None,
        note: None,
    })
}

//! `draws` (section 9 of the specification): the rank at cameras that nobody can choose.

use crate::algebra::Field;
use crate::cameras::{self, Stream};
use crate::core::Core;
use crate::document::Draws;
use crate::elimination::Echelon;
use crate::matrices::{camera_at, jacobian};
use crate::rejection::{Checked, ensure};
use crate::setting::Setting;

/// What is verified of `draws`.
pub(crate) struct Drawn {
    pub seed: u64,
    /// The numbers of the draws that were used.
    pub numbers: Vec<u64>,
    /// The rank of the core.
    pub rank: i64,
    /// The exponent of the probability that the generic rank is larger.
    pub error: i64,
}

/// Verifies `draws` (theory, Theorem 7.2).
pub(crate) fn check_draws(evidence: &Draws, setting: &Setting, core: &Core) -> Checked<Drawn> {
    ensure!(
        !setting.model.is_linear(),
        "not evidence in the {} model",
        setting.model
    );
    let bits = u64::from((setting.model.required(core.nodes) as u64).ilog2()) + 1;
    ensure!(
        bits <= 36 && core.nodes < 1 << 31,
        "the core is too large for an error bound"
    );
    let count = 120u64.div_ceil(56 - bits);
    ensure!(evidence.count == count, "`count` must be {count}");
    let (mut numbers, mut ranks) = (Vec::new(), Vec::new());
    // Void draws are rarer than 2^-50: a few more than wanted are enough.
    for number in 0..count + 10 {
        core.charge_draw(setting)?;
        if numbers.len() as u64 == count {
            break;
        }
        if let Ok((field, centres)) = own_centres(setting, evidence.seed, number, core) {
            ranks.push(rank(&field, &centres, setting, core)?);
            numbers.push(number);
        }
    }
    ensure!(numbers.len() as u64 == count, "too many draws are void");
    ensure!(
        ranks.iter().max() == Some(&evidence.rank),
        "the largest of the ranks {ranks:?} is not {}",
        evidence.rank
    );
    Ok(Drawn {
        seed: evidence.seed,
        numbers,
        rank: evidence.rank,
        error: -((count * (56 - bits)) as i64),
    })
}

/// The field and the centres of a draw that begins by choosing its own prime.
pub(crate) fn own_centres(
    setting: &Setting,
    seed: u64,
    number: u64,
    core: &Core,
) -> Checked<(Field, Vec<[u64; 3]>)> {
    let mut stream = Stream::new("draw", core.hashes(setting), seed, number);
    let field = cameras::prime(&mut stream)?;
    let centres = cameras::centres(&mut stream, &field, &core.places)?;
    Ok((field, centres))
}

/// The rank of J_P at some centres.
pub(crate) fn rank(
    field: &Field,
    centres: &[[u64; 3]],
    setting: &Setting,
    core: &Core,
) -> Checked<i64> {
    let cameras: Vec<_> = centres.iter().map(|c| camera_at(field, c)).collect();
    let mut echelon = Echelon::new(field, 12 * core.nodes, setting.meter);
    let mut rank = 0;
    for row in 0..10 * core.edges.len() {
        rank += i64::from(echelon.push(jacobian(field, &core.edges, &cameras, row), None)?);
    }
    Ok(rank)
}

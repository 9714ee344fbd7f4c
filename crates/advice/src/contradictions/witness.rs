//! Closed walks that always lead one way: floats propose the witness.

use super::turns::{conj, times, turned, unit};
use super::web::Web;
use super::{Cycle, Step};

/// Most steps of a walk that is held against its directions.
pub(super) const MOST: usize = 4;

/// A walk with a vector that makes an angle well below 90 degrees, less what its steps may be off, with all of them.
pub(super) fn one_way(web: &Web, walk: &[Step], [theta, phi]: [u32; 2]) -> Option<Cycle> {
    let length = walk.len();
    let mut ways = [([0.0; 3], 0.0); MOST];
    for (m, way) in ways[..length].iter_mut().enumerate() {
        let (pair, forth) = walk[m];
        let motion = &web.motions[pair as usize];
        let vector = motion.vector.filter(|_| motion.is_wide)?;
        let away = m.min(length - 1 - m) as u32;
        let begins = m <= length - 1 - m;
        let by = match begins {
            true => conj(web.along(&walk[..m])),
            false => web.along(&walk[m + 1..]),
        };
        let by = match begins == forth {
            true => times(&by, &conj(web.turns[pair as usize])),
            false => by,
        };
        let vector = unit(vector.map(|x| if forth { -x as f64 } else { x as f64 }));
        let off = phi + away * theta;
        *way = (
            turned(&by, vector),
            f64::from(off.min(90)).to_radians().sin() + 1e-3,
        );
    }
    let ways = &ways[..length];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut witness = [0.0; 3];
    for (way, _) in ways {
        witness = [0, 1, 2].map(|k| witness[k] + way[k]);
    }
    // The worst of the ways pulls the vector towards itself.
    for round in 0..60 {
        witness = unit(witness);
        let margin = |(way, least): &([f64; 3], f64)| dot(witness, *way) - least;
        let worst = ways.iter().min_by(|a, b| margin(a).total_cmp(&margin(b)))?;
        let margin = margin(worst);
        if margin > 0.0 {
            return Some(Cycle {
                walk: walk.to_vec(),
                witness: Some(witness.map(|x| (x * 4096.0).round() as i64)),
            });
        }
        if margin.is_nan() || margin <= -1.0 {
            return None;
        }
        let pull = (0.1 - margin) / (1.0 + f64::from(round) / 8.0);
        witness = [0, 1, 2].map(|k| witness[k] + pull * worst.0[k]);
    }
    None
}

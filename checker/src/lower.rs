//! Lower bounds on the rank of a core, and its rank at random draws (sections 7 and 9 of the specification).

use crate::algebra::{Echelon, Field, Integers, Ring, check_diagonal, for_all};
use crate::cameras::{self, Stream, gcd};
use crate::document::{Draws, Evidence, IntegerMinor, Minor, Model, PlaneFlow};
use crate::evidence::Setting;
use crate::json::Big;
use crate::matrices::{bearings, camera_at, dot, jacobian, map_motion, scale_motion};
use crate::pieces::Core;
use crate::rejection::{Checked, Failure, Within, ensure};
use num_bigint::BigInt;
use std::collections::HashSet;

/// Prime, seed and number of a draw of centres.
pub(crate) type Draw = (u64, u64, u64);

/// A lower bound on the rank of a core.
pub(crate) struct Lower {
    pub rank: i64,
    /// Where the rank is reached, if centres modulo p were drawn.
    pub at: Option<Draw>,
    /// For people: what else was verified.
    pub note: Option<String>,
}

/// Verifies a lower bound.
pub(crate) fn check_lower(evidence: &Evidence, setting: &Setting, core: &Core) -> Checked<Lower> {
    let lower = match evidence {
        Evidence::PlaneFlow(flow) => check_plane_flow(flow, setting, core)?,
        _ if setting.model == Model::Calibrated => {
            return Err(Failure::rejected("not evidence in the calibrated model"));
        }
        Evidence::Minor(minor) => check_minor(minor, setting, core)?,
        Evidence::IntegerMinor(minor) => check_integer_minor(minor, setting, core)?,
        _ => return Err(Failure::rejected("not a lower bound")),
    };
    let most = setting.model.required(core.nodes);
    ensure!(
        lower.rank <= most,
        "a rank of {} is impossible for {} nodes",
        lower.rank,
        core.nodes
    );
    Ok(lower)
}

/// Sees that pivots are different rows and different columns of a matrix.
fn check_pivots(
    (rows, height): (&[usize], usize),
    (cols, width): (&[usize], usize),
) -> Checked<()> {
    ensure!(
        rows.len() == cols.len(),
        "{} pivot rows, but {} pivot columns",
        rows.len(),
        cols.len()
    );
    for (list, limit) in [(rows, height), (cols, width)] {
        let different: HashSet<&usize> = list.iter().filter(|&&index| index < limit).collect();
        ensure!(
            different.len() == list.len(),
            "the pivots are not different indices below {limit}"
        );
    }
    Ok(())
}

/// Eliminates along pivots, none of which may vanish.
fn eliminate<'f, E: IntoIterator<Item = (usize, u64)>>(
    field: &'f Field,
    (rows, height): (&[usize], usize),
    (cols, width): (&[usize], usize),
    row: impl Fn(usize) -> E,
) -> Checked<Echelon<'f>> {
    check_pivots((rows, height), (cols, width))?;
    let mut echelon = Echelon::new(field, width);
    for (k, (&number, &column)) in rows.iter().zip(cols).enumerate() {
        ensure!(
            echelon.push(row(number), Some(column)),
            "pivot {k} vanishes"
        );
    }
    Ok(echelon)
}

/// A minor of J_P that does not vanish modulo p.
fn check_minor(minor: &Minor, setting: &Setting, core: &Core) -> Checked<Lower> {
    let (field, seed) = (&Field::new(minor.prime)?, minor.seed);
    let mut stream = Stream::new("draw", [&setting.sha256, &core.sha256], seed, minor.draw);
    let cameras = cameras::general(&mut stream, field, core.nodes)?;
    let (rows, cols) = (
        (&*minor.rows, 10 * core.edges.len()),
        (&*minor.cols, 12 * core.nodes),
    );
    eliminate(field, rows, cols, |row| {
        jacobian(field, core, &cameras, row)
    })?;
    Ok(Lower {
        rank: minor.rows.len() as i64,
        at: None,
        note: None,
    })
}

/// The ranks of N and of Lambda at centres modulo p.
fn check_plane_flow(evidence: &PlaneFlow, setting: &Setting, core: &Core) -> Checked<Lower> {
    let PlaneFlow {
        rows,
        cols,
        flows,
        lambda_rows,
        lambda_cols,
        draw,
        ..
    } = evidence;
    let (field, seed) = (&Field::new(evidence.prime)?, evidence.seed);
    let centres = cameras::centres(
        &mut Stream::new("draw", [&setting.sha256, &core.sha256], seed, *draw),
        field,
        core.nodes,
    )?;
    let (edges, height, width) = (core.edges.len(), 2 * core.edges.len(), 3 * core.nodes);
    let n = bearings(field, core, &centres);
    let echelon =
        eliminate(field, (rows, height), (cols, width), |row| n[row]).within(|| "N".into())?;
    // The left kernel of the pivots' columns has no more dimensions than this.
    ensure!(
        *flows <= height - rows.len(),
        "{flows} flows, but only {} rows are not pivots",
        height - rows.len()
    );
    ensure!(
        setting.model == Model::Projective || *flows == 0,
        "flows in the calibrated model"
    );
    check_pivots((lambda_rows, 4 * flows), (lambda_cols, edges)).within(|| "Lambda".into())?;

    let mut is_pivot = vec![false; height];
    rows.iter().for_each(|&row| is_pivot[row] = true);
    let mut stream = Stream::new("flow", [&setting.sha256, &core.sha256], seed, *draw);
    let mut prescribed = |&is_pivot: &bool| {
        if is_pivot {
            0
        } else {
            field.element(stream.below(field.p))
        }
    };
    let mut all: Vec<Vec<u64>> = (0..*flows)
        .map(|_| is_pivot.iter().map(&mut prescribed).collect())
        .collect();
    // Of each flow, its entries of Lambda are left: four in every column.
    for_all(&mut all, |flows| {
        for flow in flows {
            let mut product = vec![0; width];
            for (row, &weight) in n.iter().zip(&*flow) {
                row.iter().for_each(|&(at, value)| {
                    product[at] = field.add(product[at], field.mul(weight, value))
                });
            }
            // At the pivots, the flow takes off what its prescribed entries leave in the columns of N.
            rows.iter()
                .zip(echelon.solve(&mut product))
                .for_each(|(&row, entry)| flow[row] = field.neg(entry));
            let column = |&e: &usize| {
                let (f, [a, b]) = ([flow[2 * e], flow[2 * e + 1]], [n[2 * e], n[2 * e + 1]]);
                let omega = [0, 1, 2].map(|k| dot(field, f, [a[k].1, b[k].1]));
                [
                    omega[0],
                    omega[1],
                    omega[2],
                    field.neg(dot(field, omega, centres[core.edges[e].1])),
                ]
            };
            let vanishes = product.iter().all(|&entry| entry == 0);
            *flow = lambda_cols
                .iter()
                .flat_map(column)
                .chain((!vanishes).then_some(0))
                .collect();
        }
    });
    let wrong = all
        .iter()
        .position(|flow| flow.len() != 4 * lambda_cols.len());
    ensure!(
        wrong.is_none(),
        "flow {wrong:?} does not vanish in all columns of N"
    );
    let lambda_row = |&row: &usize| {
        all[row / 4]
            .iter()
            .skip(row % 4)
            .step_by(4)
            .copied()
            .collect()
    };
    let mut lambda: Vec<_> = lambda_rows.iter().map(lambda_row).collect();
    check_diagonal(field, &mut lambda).within(|| "Lambda".into())?;
    let projective = 4 * rows.len() as i64 + lambda_rows.len() as i64 - edges as i64;
    let rank = if setting.model == Model::Projective {
        projective
    } else {
        rows.len() as i64
    };
    Ok(Lower {
        rank,
        at: Some((field.p, seed, *draw)),
        note: None,
    })
}

/// An exact minor of the integer J_P, and kernel vectors over the integers.
fn check_integer_minor(evidence: &IntegerMinor, setting: &Setting, core: &Core) -> Checked<Lower> {
    let IntegerMinor {
        numerator,
        denominator,
        rows,
        cols,
        draw,
        ..
    } = evidence;
    let seed = evidence.seed;
    let mut stream = Stream::new("draw", [&setting.sha256, &core.sha256], seed, *draw);
    let cameras = cameras::integer(&mut stream, (*numerator, *denominator), core.nodes)?;
    let (nodes, height, width) = (core.nodes, 10 * core.edges.len(), 12 * core.nodes);
    let entries = |row: usize| {
        let entries = jacobian(&Integers, core, &cameras, row);
        let content = entries
            .iter()
            .fold(0, |content, &(_, value)| gcd(content, value))
            .max(1);
        entries
            .into_iter()
            .map(move |(column, value)| (column, value / content))
    };
    check_pivots((rows, height), (cols, width))?;
    match (&evidence.determinant, &evidence.prime) {
        (Some(claimed), None) => {
            let dense_row = |&row: &usize| {
                let mut dense = vec![0; width];
                entries(row).for_each(|(column, value)| dense[column] = value);
                cols.iter().map(|&column| dense[column].into()).collect()
            };
            let found = determinant(rows.iter().map(dense_row).collect())?.to_string();
            ensure!(found == claimed.0, "`determinant` is not that of the minor");
        }
        (None, Some(prime)) => {
            let field = &Field::new(*prime)?;
            let modulo = |row| entries(row).map(|(column, value)| (column, field.signed(value)));
            eliminate(field, (rows, height), (cols, width), modulo)?;
        }
        _ => {
            return Err(Failure::rejected(
                "one of `determinant` and `prime` is null, and one is not",
            ));
        }
    }

    let read = |vector: &Vec<Big<String>>| {
        vector
            .iter()
            .map(|entry| entry.0.parse().unwrap_or_default())
            .collect()
    };
    let kernel: Vec<Vec<BigInt>> = evidence.kernel.iter().map(read).collect();
    for (k, vector) in kernel.iter().enumerate() {
        ensure!(
            vector.len() == width,
            "kernel[{k}] has {} entries instead of {width}",
            vector.len()
        );
        let product = |row| {
            entries(row)
                .map(|(column, value)| &vector[column] * value)
                .sum::<BigInt>()
        };
        let inside = (0..height).all(|row| product(row) == BigInt::ZERO);
        ensure!(inside, "kernel[{k}] is not in the kernel");
    }
    // Vectors that are independent modulo a prime are independent.
    let field = &Field::new((1 << 61) - 1)?;
    let residue = |value: &BigInt| field.signed((value % field.p).try_into().unwrap_or(0));
    let cameras: Vec<_> = cameras
        .iter()
        .map(|camera| camera.map(|row| row.map(|entry| field.signed(entry))))
        .collect();
    let scales = (0..nodes).map(|v| scale_motion(&cameras, v));
    let listed = kernel
        .iter()
        .map(|vector| vector.iter().map(residue).enumerate().collect());
    let mut vectors = scales
        .chain((0..15).map(|ab| map_motion(&cameras, 4, ab)))
        .chain(listed);
    let mut echelon = Echelon::new(field, width);
    let independent = kernel.is_empty() || vectors.all(|vector| echelon.push(vector, None));
    ensure!(
        independent,
        "the kernel vectors depend on each other or on the trivial ones"
    );
    let r = rows.len();
    let exact = r + nodes + 15 + kernel.len() == width;
    let place = format!("integer cameras (seed {seed}, draw {draw})");
    let note =
        exact.then(|| format!("a core of {nodes} nodes has rank exactly {r} over Q at {place}"));
    Ok(Lower {
        rank: r as i64,
        at: None,
        note,
    })
}

/// The determinant by fraction-free elimination (Bareiss 1968): all divisions are exact. Rejects a pivot that vanishes.
fn determinant(mut matrix: Vec<Vec<BigInt>>) -> Checked<BigInt> {
    let mut previous = BigInt::from(1);
    for k in 0..matrix.len() {
        let (done, rest) = matrix.split_at_mut(k + 1);
        let pivot = &done[k][k];
        ensure!(*pivot != BigInt::ZERO, "pivot {k} vanishes");
        for row in rest {
            let factor = std::mem::take(&mut row[k]);
            for (entry, above) in row[k + 1..].iter_mut().zip(&done[k][k + 1..]) {
                *entry = (&*entry * pivot - &factor * above) / &previous;
            }
        }
        previous = pivot.clone();
    }
    Ok(previous)
}

/// Verifies `draws`; returns the numbers of the draws, and the exponent of the probability that the rank is larger.
pub(crate) fn check_draws(
    evidence: &Draws,
    setting: &Setting,
    core: &Core,
) -> Checked<(Vec<u64>, i64)> {
    ensure!(
        setting.model == Model::Projective,
        "not evidence in the calibrated model"
    );
    let seed = evidence.seed;
    let bits = u64::from((setting.model.required(core.nodes) as u64).ilog2()) + 1;
    ensure!(bits <= 36, "the core is too large for an error bound");
    let count = 120u64.div_ceil(56 - bits);
    ensure!(evidence.count == count, "`count` must be {count}");
    // Void draws are rarer than 2^-50: a few more than wanted are enough.
    let drawn = (0..count + 10)
        .filter_map(|draw| Some((draw, own_centres(setting, seed, draw, core).ok()?)));
    let (mut numbers, mut ranks) = (Vec::new(), Vec::new());
    for (draw, (field, centres)) in drawn.take(count as usize) {
        let cameras: Vec<_> = centres
            .iter()
            .map(|centre| camera_at(&field, centre))
            .collect();
        let mut echelon = Echelon::new(&field, 12 * core.nodes);
        let found = (0..10 * core.edges.len())
            .filter(|&row| echelon.push(jacobian(&field, core, &cameras, row), None));
        ranks.push(found.count() as i64);
        numbers.push(draw);
    }
    ensure!(numbers.len() as u64 == count, "too many draws are void");
    ensure!(
        ranks.iter().max() == Some(&evidence.rank),
        "the largest of the ranks {ranks:?} is not {}",
        evidence.rank
    );
    Ok((numbers, -((count * (56 - bits)) as i64)))
}

/// The field and the centres of a draw that begins by choosing its own prime (section 9).
pub(crate) fn own_centres(
    setting: &Setting,
    seed: u64,
    draw: u64,
    core: &Core,
) -> Checked<(Field, Vec<[u64; 3]>)> {
    let mut stream = Stream::new("draw", [&setting.sha256, &core.sha256], seed, draw);
    let field = cameras::prime(&mut stream)?;
    let centres = cameras::centres(&mut stream, &field, core.nodes)?;
    Ok((field, centres))
}

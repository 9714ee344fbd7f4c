//! Lower bounds on the rank of a core, and its rank at random draws (sections 7 and 9 of the specification).

use crate::cameras;
use crate::formulation::{Integers, bearing, camera_at, direction, jacobian};
use crate::json::{Members, Value};
use crate::matrix::{factor, rank};
use crate::modular::{Field, largest_primes};
use crate::pieces::Core;
use crate::rejection::{Checked, Rejection, Within, ensure};

/// The question: unknown or known intrinsic parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// Finite or unique solvability from fundamental matrices.
    Projective,
    /// Solvability from essential matrices: parallel rigidity in space.
    Calibrated,
}

impl Model {
    /// The rank at which n >= 2 nodes are solvable up to finitely many solutions.
    pub(crate) fn required(self, nodes: usize) -> i64 {
        match self {
            Model::Projective => 11 * nodes as i64 - 15,
            Model::Calibrated => 3 * nodes as i64 - 4,
        }
    }
}

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

/// What all evidence refers to.
#[derive(Clone, Copy)]
pub(crate) struct Setting<'a> {
    pub model: Model,
    pub graph: &'a [u8; 32],
}

const NOT_A_PIVOT: usize = usize::MAX;

/// Pivots: rows, and for each column of the matrix its position among the pivot columns.
struct Pivots {
    rows: Vec<usize>,
    position: Vec<usize>,
}

impl Pivots {
    fn read(members: &mut Members, rows: (&str, usize), cols: (&str, usize)) -> Checked<Pivots> {
        let read = |members: &mut Members, (name, limit)| members.read(name, |list: &Value| list.indices(limit));
        let (rows, cols) = (read(members, rows)?, read(members, cols)?);
        ensure!(rows.len() == cols.len(), "{} pivot rows, but {} pivot columns", rows.len(), cols.len());
        // As long as the matrix is wide, not longer: the limits of columns are sizes of the core.
        let mut position = vec![NOT_A_PIVOT; cols.iter().max().map_or(0, |&last| last + 1)];
        cols.iter().enumerate().for_each(|(k, &column)| position[column] = k);
        Ok(Pivots { rows, position })
    }

    /// Writes the entries of a row that stand in pivot columns.
    fn write(&self, field: &Field, entries: impl IntoIterator<Item = (usize, u64)>, row: &mut [u64]) {
        for (column, value) in entries {
            if let Some(&position) = self.position.get(column).filter(|&&position| position != NOT_A_PIVOT) {
                row[position] = field.add(row[position], value);
            }
        }
    }
}

fn read_prime(members: &mut Members) -> Checked<Field> {
    members.read("prime", |prime| Field::new(prime.big()?))
}

fn read_draw(members: &mut Members) -> Checked<(u64, u64)> {
    Ok((members.read("seed", Value::big)?, members.read("draw", Value::count)?))
}

/// Reads prime, seed and draw.
pub(crate) fn read_draw_modulo(members: &mut Members) -> Checked<(Field, Draw)> {
    let field = read_prime(members)?;
    let (seed, draw) = read_draw(members)?;
    Ok((field, (field.prime(), seed, draw)))
}

/// Verifies one lower bound of the given kind; `None` if the kind is none of them.
pub(crate) fn lower(kind: &str, members: &mut Members, setting: Setting, core: &Core) -> Checked<Option<Lower>> {
    let check = match kind {
        "minor" => minor,
        "integer-minor" => integer_minor,
        "plane-flow" => plane_flow,
        _ => return Ok(None),
    };
    let projective = setting.model == Model::Projective;
    ensure!(projective || kind == "plane-flow", "not evidence in the calibrated model");
    let lower = check(members, setting, core)?;
    let most = setting.model.required(core.nodes);
    ensure!(lower.rank <= most, "a rank of {} is impossible for {} nodes", lower.rank, core.nodes);
    Ok(Some(lower))
}

/// A minor of J_P that does not vanish modulo p.
fn minor(members: &mut Members, setting: Setting, core: &Core) -> Checked<Lower> {
    let (field, (p, seed, draw)) = read_draw_modulo(members)?;
    let (cameras, at) = match members.read("cameras", Value::text)? {
        "general" => (cameras::general(&field, setting.graph, seed, draw, core.nodes)?, None),
        "centres" => {
            let centres = cameras::centres(&field, setting.graph, seed, draw, core.nodes)?;
            (centres.iter().map(|centre| camera_at(&field, centre)).collect(), Some((p, seed, draw)))
        }
        other => return Err(Rejection::new(format!("unknown kind of cameras `{other}`"))),
    };
    let pivots = Pivots::read(members, ("rows", 10 * core.edges.len()), ("cols", 12 * core.nodes))?;
    factor(&field, pivots.rows.len(), |k, row| {
        pivots.write(&field, jacobian(&field, core, &cameras, pivots.rows[k]), row);
    })?;
    Ok(Lower { rank: pivots.rows.len() as i64, at, note: None })
}

/// The rank of N and of Lambda at centres modulo p.
fn plane_flow(members: &mut Members, setting: Setting, core: &Core) -> Checked<Lower> {
    let (field, at) = read_draw_modulo(members)?;
    let centres = cameras::centres(&field, setting.graph, at.1, at.2, core.nodes)?;
    let height = 2 * core.edges.len();
    let pivots = Pivots::read(members, ("rows", height), ("cols", 3 * core.nodes))?;
    let mut is_pivot = vec![false; height];
    pivots.rows.iter().for_each(|&row| is_pivot[row] = true);
    let free: Vec<usize> = (0..height).filter(|&row| !is_pivot[row]).collect();
    let flows = members.read("flows", Value::count)? as usize;
    ensure!(flows <= free.len(), "{flows} flows, but N leaves at most {}", free.len());
    let lambda = Pivots::read(members, ("lambda_rows", 4 * flows), ("lambda_cols", core.edges.len()))?;
    ensure!(setting.model == Model::Projective || flows == 0, "`flows` is not zero in the calibrated model");

    let (a, b) = (pivots.rows.len(), lambda.rows.len());
    let factors =
        factor(&field, a, |k, row| pivots.write(&field, bearing(&field, core, &centres, pivots.rows[k]), row))
            .within(|| "N".into())?;
    let mut stream = cameras::flow_weights(setting.graph, at.1, at.2);
    let mut lambda_rows: Vec<Vec<u64>> = Vec::new();
    for first in (0..flows).step_by(128) {
        let mut flow_rows = Vec::new();
        let mut solutions = Vec::new();
        for _ in first..flows.min(first + 128) {
            let mut weights = vec![0; height];
            let mut sum = vec![0; a];
            for &row in &free {
                weights[row] = field.element(stream.below(field.prime()));
                let entries = bearing(&field, core, &centres, row);
                let scaled = entries.into_iter().map(|(column, value)| (column, field.mul(weights[row], value)));
                pivots.write(&field, scaled, &mut sum);
            }
            flow_rows.push(weights);
            solutions.push(sum);
        }
        factors.solve(&mut solutions);
        for (k, (mut weights, solution)) in (first..).zip(flow_rows.into_iter().zip(&solutions)) {
            pivots.rows.iter().zip(solution).for_each(|(&row, &x)| weights[row] = field.neg(x));
            let planes = planes(&field, core, &centres, &weights).within(|| format!("flow {k}"))?;
            for entry in 0..4 {
                let mut row = vec![0; b];
                lambda.write(&field, planes.iter().map(|plane| plane[entry]).enumerate(), &mut row);
                lambda_rows.push(row);
            }
        }
    }
    factor(&field, b, |k, row| row.copy_from_slice(&lambda_rows[lambda.rows[k]])).within(|| "Lambda".into())?;
    let rank = match setting.model {
        Model::Projective => 4 * a as i64 + b as i64 - core.edges.len() as i64,
        Model::Calibrated => a as i64,
    };
    Ok(Lower { rank, at: Some(at), note: None })
}

/// The plane (omega_e, -omega_e . c_j) of every edge for a combination of the rows of N, which must vanish.
fn planes(field: &Field, core: &Core, centres: &[[u64; 3]], weights: &[u64]) -> Checked<Vec<[u64; 4]>> {
    let mut sums = vec![[0; 3]; core.nodes];
    let mut planes = Vec::with_capacity(core.edges.len());
    for (e, &(i, j)) in core.edges.iter().enumerate() {
        let (first, second) = (direction(field, core, centres, 2 * e), direction(field, core, centres, 2 * e + 1));
        let mut plane = [0; 4];
        for k in 0..3 {
            plane[k] = field.add(field.mul(weights[2 * e], first[k]), field.mul(weights[2 * e + 1], second[k]));
            plane[3] = field.sub(plane[3], field.mul(plane[k], centres[j][k]));
            sums[i][k] = field.add(sums[i][k], plane[k]);
            sums[j][k] = field.sub(sums[j][k], plane[k]);
        }
        planes.push(plane);
    }
    let unbalanced = sums.iter().position(|sum| *sum != [0; 3]);
    ensure!(unbalanced.is_none(), "not conserved at the core node {}", unbalanced.unwrap_or_default());
    Ok(planes)
}

/// An exact minor of the integer J_P, and kernel vectors over the integers, both checked modulo enough primes.
fn integer_minor(members: &mut Members, setting: Setting, core: &Core) -> Checked<Lower> {
    let bounds = (members.read("numerator", Value::int)?, members.read("denominator", Value::int)?);
    let (seed, draw) = read_draw(members)?;
    let cameras = cameras::integer(bounds, setting.graph, seed, draw, core.nodes)?;
    let width = 12 * core.nodes;
    let pivots = Pivots::read(members, ("rows", 10 * core.edges.len()), ("cols", width))?;
    let r = pivots.rows.len();
    let determinant =
        members.read("determinant", |value| if value.is_null() { Ok(None) } else { value.decimal().map(Some) })?;
    let prime = members
        .read("prime", |value| if value.is_null() { Ok(None) } else { value.big().and_then(Field::new).map(Some) })?;
    ensure!(determinant.is_some() != prime.is_some(), "one of `determinant` and `prime` is null, and one is not");
    let kernel = members.read("kernel", |list| {
        let vector = |vector: &Value| -> Checked<Vec<(bool, String)>> {
            let entries =
                vector.list()?.iter().map(|entry| entry.decimal().map(|(sign, digits)| (sign, digits.to_string())));
            let entries: Vec<_> = entries.collect::<Checked<_>>()?;
            ensure!(entries.len() == width, "{} entries instead of {width}", entries.len());
            Ok(entries)
        };
        let numbered = list.list()?.iter().enumerate();
        numbered.map(|(k, value)| vector(value).within(|| format!("[{k}]"))).collect::<Checked<Vec<_>>>()
    })?;

    // Rows of J_P divided by their contents, and the bit lengths of the sums of their entries' absolute values.
    let wrapped: Vec<_> = cameras.iter().map(|camera| camera.map(|row| row.map(Some))).collect();
    let mut rows = Vec::new();
    for row in 0..10 * core.edges.len() {
        let entries: Option<Vec<(usize, i128)>> = jacobian(&Integers, core, &wrapped, row)
            .into_iter()
            .map(|(column, value)| Some((column, value?)))
            .collect();
        let mut entries = entries.ok_or_else(|| Rejection::new("the cameras are too large for 128-bit arithmetic"))?;
        let content = entries.iter().fold(0, |content, &(_, value)| cameras::gcd(content, value)).max(1);
        entries.iter_mut().for_each(|(_, value)| *value /= content);
        let bits: usize = entries
            .iter()
            .map(|(_, value)| value.unsigned_abs().checked_ilog2().map_or(0, |top| top as usize + 1))
            .max()
            .unwrap_or(0);
        rows.push((entries, bits + 4));
    }
    // Twelve entries below 2^b have a sum below 2^(b+4); a determinant is at most the product of such sums over its rows.
    let bound: usize = pivots.rows.iter().map(|&row| rows[row].1).sum();
    let mut fields = prime.into_iter().collect::<Vec<_>>();
    if let Some(determinant) = determinant {
        let claimed = decimal_bits(determinant.1);
        ensure!(3 * (determinant.1.len() - 1) <= bound, "`determinant` is larger than the minor can be");
        fields = largest_primes(bound.max(claimed) / 61 + 2);
    }
    for field in &fields {
        let entries = |row: usize| rows[row].0.iter().map(|&(column, value)| (column, field.signed(value)));
        let factors = factor(field, r, |k, row| pivots.write(field, entries(pivots.rows[k]), row))?;
        let agrees = determinant.is_none_or(|determinant| factors.determinant() == field.decimal(determinant));
        ensure!(agrees, "`determinant` is not that of the minor");
    }
    let largest = rows.iter().map(|(_, bits)| *bits).max().unwrap_or(0);
    for (k, vector) in kernel.iter().enumerate() {
        let bits = vector.iter().map(|(_, digits)| decimal_bits(digits)).max().unwrap_or(0);
        for field in largest_primes((bits + largest) / 61 + 1) {
            let vector: Vec<u64> = vector.iter().map(|(sign, digits)| field.decimal((*sign, digits))).collect();
            for (number, (entries, _)) in rows.iter().enumerate() {
                let products = entries.iter().map(|&(column, value)| field.mul(field.signed(value), vector[column]));
                let sum = products.fold(0, |sum, product| field.add(sum, product));
                ensure!(sum == 0, "kernel[{k}] is not in the kernel: row {number}");
            }
        }
    }
    let field = &largest_primes(1)[0];
    let vectors = kernel
        .iter()
        .map(|vector| vector.iter().map(|(sign, digits)| field.decimal((*sign, digits))).enumerate().collect());
    let trivial = trivial_kernel(field, &cameras);
    let count = kernel.len() + trivial.len();
    let independent = kernel.is_empty() || rank(field, width, trivial.into_iter().chain(vectors))? == count;
    ensure!(independent, "the kernel vectors depend on each other or on the trivial ones");
    let exact = kernel.len() + r + core.nodes + 15 == width;
    let note = exact.then(|| {
        format!(
            "a core of {} nodes has rank exactly {r} over Q at integer cameras (seed {seed}, draw {draw})",
            core.nodes
        )
    });
    Ok(Lower { rank: r as i64, at: None, note })
}

/// At least the bit length of a decimal integer: log2(10) < 10/3.
fn decimal_bits(digits: &str) -> usize {
    digits.len() * 10 / 3 + 1
}

/// The kernel that J_P always has: the scale of each camera, and P_v X for X = E_ab, (a, b) != (3, 3).
fn trivial_kernel(field: &Field, cameras: &[cameras::Camera<i128>]) -> Vec<Vec<(usize, u64)>> {
    let entry = |v: usize, r: usize, c: usize| field.signed(cameras[v][r][c]);
    let cells = (0..12).map(|cell| (cell % 3, cell / 3));
    let scale = |v: usize| cells.clone().map(move |(r, c)| (12 * v + 3 * c + r, entry(v, r, c))).collect();
    let map = |ab: usize| {
        let (a, b) = (ab / 4, ab % 4);
        (0..cameras.len()).flat_map(|v| (0..3).map(move |r| (12 * v + 3 * b + r, entry(v, r, a)))).collect()
    };
    (0..cameras.len()).map(scale).chain((0..15).map(map)).collect()
}

/// The rank of a core at random draws, each with a prime of its own.
pub(crate) struct Draws {
    pub rank: i64,
    pub seed: u64,
    /// The numbers of the draws.
    pub numbers: Vec<u64>,
    /// The probability that the generic rank is larger is at most 2^error_log2.
    pub error_log2: i64,
}

/// Verifies `draws`.
pub(crate) fn draws(members: &mut Members, setting: Setting, core: &Core) -> Checked<Draws> {
    ensure!(setting.model == Model::Projective, "not evidence in the calibrated model");
    let seed = members.read("seed", Value::big)?;
    let count = members.read("count", Value::count)?;
    let claimed = members.read("rank", Value::count)?;
    let bits = 64 - (setting.model.required(core.nodes) as u64).leading_zeros();
    ensure!(bits <= 36, "the core is too large for an error bound");
    let each = u64::from(56 - bits);
    ensure!(count == 120u64.div_ceil(each), "`count` must be {}", 120u64.div_ceil(each));
    let (mut numbers, mut reached) = (Vec::new(), false);
    // Void draws are rarer than 2^-50: a few more than wanted are enough.
    for draw in 0..count + 10 {
        let Ok((field, centres)) = cameras::centres_and_prime(setting.graph, seed, draw, core.nodes) else {
            continue;
        };
        if numbers.len() as u64 == count {
            break;
        }
        let cameras: Vec<_> = centres.iter().map(|centre| camera_at(&field, centre)).collect();
        let rows = (0..10 * core.edges.len()).map(|row| jacobian(&field, core, &cameras, row));
        let found = rank(&field, 12 * core.nodes, rows)? as u64;
        ensure!(found <= claimed, "the rank at draw {draw} is {found}, larger than {claimed}");
        reached |= found == claimed;
        numbers.push(draw);
    }
    ensure!(numbers.len() as u64 == count, "too many draws are void");
    ensure!(reached, "no draw has rank {claimed}");
    Ok(Draws { rank: claimed as i64, seed, numbers, error_log2: -((count * each) as i64) })
}

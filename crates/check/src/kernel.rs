//! `kernel` (section 7 of the specification): a motion of the cameras of a core that tells the
//! classes of its members apart.

use crate::algebra::{Field, Ring};
use crate::cameras::{self, Stream};
use crate::core::Core;
use crate::document::Kernel;
use crate::draws::{Drawn, own_centres};
use crate::elimination::Echelon;
use crate::matrices::{camera_at, map_motion, scale_motion};
use crate::rejection::{Checked, Within, ensure};
use crate::setting::{Draw, Setting};

/// Where classes were told apart.
#[derive(PartialEq)]
pub(crate) enum Place {
    /// At a draw of centres modulo a prime that the certificate names.
    Named(Draw),
    /// At the draw of `draws` with this number.
    Drawn(u64),
}

/// Verifies `kernel`, for classes of which `owner` has that of each member; returns where it tells
/// them apart (theory, Proposition 6.7, Theorems 6.8, 13.13 and 13.19).
pub(crate) fn check_kernel(
    kernel: &Kernel,
    setting: &Setting,
    core: &Core,
    (owner, classes): (&[usize], usize),
    drawn: Option<&Drawn>,
) -> Checked<Place> {
    core.charge_draw(setting)?;
    if setting.model.in_plane() {
        return check_plane_kernel(kernel, setting, core, (owner, classes));
    }
    let (field, centres, place) = centres(kernel, setting, core, drawn)?;
    let columns = if setting.model.is_linear() { 1 } else { 4 };
    let vector = residues(kernel, 3 * columns * core.nodes, &field)?;
    let motion = |edge| {
        let motion = edge_motion(&field, setting, core, &centres, &vector, edge)?;
        // X = (t, -s) in the only model with known lengths.
        ensure!(
            !core.is_scaled[edge] || motion[3] == 0,
            "the known length of the core edge {edge} changes"
        );
        Ok(motion)
    };
    check_apart(core, (owner, classes), motion)?;
    Ok(place)
}

/// Verifies `kernel` in the affine model: a motion of plane points (theory, Theorem 13.13).
fn check_plane_kernel(
    kernel: &Kernel,
    setting: &Setting,
    core: &Core,
    classes: (&[usize], usize),
) -> Checked<Place> {
    let (prime, seed, draw) = (kernel.prime, kernel.seed, kernel.draw);
    let field = Field::new(prime).within(|| "prime".into())?;
    let mut stream = Stream::new("draw", core.hashes(setting), seed, draw);
    let points = cameras::plane_points(&mut stream, &field, core.nodes)?;
    let vector = residues(kernel, 2 * core.nodes, &field)?;
    check_apart(core, classes, |edge| {
        plane_motion(&field, core, &points, &vector, edge)
    })?;
    Ok(Place::Named((prime, seed, draw)))
}

/// Sees that every class moves as one, and no two classes alike, given how each core edge moves.
pub(crate) fn check_apart<M: Clone + Ord>(
    core: &Core,
    (owner, classes): (&[usize], usize),
    edge_motion: impl Fn(usize) -> Checked<M>,
) -> Checked<()> {
    let mut motions: Vec<Option<M>> = vec![None; classes];
    for (edge, &member) in core.member.iter().enumerate() {
        let motion = edge_motion(edge)?;
        let class = owner[member];
        let same = *motions[class].get_or_insert_with(|| motion.clone()) == motion;
        ensure!(same, "class {class} does not move as one");
    }
    motions.sort_unstable();
    ensure!(
        motions.windows(2).all(|pair| pair[0] != pair[1]),
        "two classes move alike"
    );
    Ok(())
}

/// The centres at which the motion is: those of a draw of `draws` if the certificate names one of
/// these, with its prime.
fn centres(
    kernel: &Kernel,
    setting: &Setting,
    core: &Core,
    drawn: Option<&Drawn>,
) -> Checked<(Field, Vec<[u64; 3]>, Place)> {
    let (prime, seed, draw) = (kernel.prime, kernel.seed, kernel.draw);
    let field = Field::new(prime).within(|| "prime".into())?;
    if drawn.is_some_and(|drawn| drawn.seed == seed && drawn.numbers.contains(&draw)) {
        let (own, centres) = own_centres(setting, seed, draw, core)?;
        if own.p == prime {
            return Ok((field, centres, Place::Drawn(draw)));
        }
    }
    let mut stream = Stream::new("draw", core.hashes(setting), seed, draw);
    let centres = cameras::centres(&mut stream, &field, &core.places)?;
    Ok((field, centres, Place::Named((prime, seed, draw))))
}

/// The entries of the vector, of which there are `width`.
fn residues(kernel: &Kernel, width: usize, field: &Field) -> Checked<Vec<u64>> {
    let vector = &kernel.vector;
    ensure!(
        vector.len() == width,
        "`vector` has {} entries instead of {width}",
        vector.len()
    );
    ensure!(
        vector.iter().all(|entry| entry.0 < field.p),
        "an entry is not a residue modulo {}",
        field.p
    );
    Ok(vector.iter().map(|entry| field.element(entry.0)).collect())
}

/// How a kernel vector moves an edge: the matrix X, row by row, with dP_i = P_i X and
/// dP_j = P_j X + lambda P_j, less a multiple of I. In the calibrated model y = s c + t is the only
/// column of [ I | -c ] X, with X = (t, -s).
pub(crate) fn edge_motion(
    field: &Field,
    setting: &Setting,
    core: &Core,
    centres: &[[u64; 3]],
    vector: &[u64],
    edge: usize,
) -> Checked<Vec<u64>> {
    let columns = vector.len() / (3 * core.nodes);
    let ends = [core.edges[edge].0, core.edges[edge].1];
    let cameras = ends.map(|v| camera_at(field, &centres[v]));
    let mut motions: Vec<_> = (0..4 * columns)
        .map(|ab| map_motion(&cameras, columns, ab))
        .collect();
    motions.extend((columns == 4).then(|| scale_motion(&cameras, 1)));
    // They are independent, as the two centres are different.
    let mut echelon = Echelon::new(field, 6 * columns, setting.meter).solvable();
    for motion in motions {
        echelon.push(motion, None)?;
    }
    let moved = ends.map(|v| &vector[3 * columns * v..3 * columns * (v + 1)]);
    let mut moved: Vec<[u64; 1]> = moved.concat().into_iter().map(|entry| [entry]).collect();
    let mut x = echelon.solve(&mut moved)?.concat();
    ensure!(
        moved.iter().all(|&entry| entry == [0]),
        "not a kernel vector at the core edge {edge}"
    );
    x.truncate(4 * columns);
    if let Some(&last) = x.get(15) {
        for diagonal in [0, 5, 10, 15] {
            x[diagonal] = field.sub(x[diagonal], last);
        }
    }
    Ok(x)
}

/// How a kernel vector moves an edge in the plane: (s, t) with y = s p + t at both ends (theory,
/// (13.1)).
pub(crate) fn plane_motion(
    field: &Field,
    core: &Core,
    points: &[[u64; 2]],
    vector: &[u64],
    edge: usize,
) -> Checked<[u64; 3]> {
    let (i, j) = core.edges[edge];
    let moved = |v: usize| [vector[2 * v], vector[2 * v + 1]];
    let minus = |x: [u64; 2], y: [u64; 2]| [0, 1].map(|k| field.sub(x[k], y[k]));
    let times = |s: u64, x: [u64; 2]| x.map(|entry| field.mul(s, entry));
    let (difference, change) = (minus(points[i], points[j]), minus(moved(i), moved(j)));
    // One entry is not zero, as the two points are different.
    let q = usize::from(difference[0] == 0);
    let s = field.mul(change[q], field.inverse(difference[q]));
    ensure!(
        times(s, difference) == change,
        "not a kernel vector at the core edge {edge}"
    );
    let [x, y] = minus(moved(i), times(s, points[i]));
    Ok([s, x, y])
}

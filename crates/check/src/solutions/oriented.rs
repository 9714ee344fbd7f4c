//! Which solutions are real and oriented: conditions (S27) to (S33) of section 12 (theory, Theorems 10.18
//! and 10.19, Corollary 10.20).

use super::polynomial::{Polynomial, minors};
use crate::algebra::{Field, Ring};
use crate::cameras::{Camera, centre};
use crate::document::Model;
use crate::document::solutions::{Oriented, Place, Root};
use crate::elimination::{Echelon, SPARSE};
use crate::json::Big;
use crate::limits::Meter;
use crate::matrices::jacobian;
use crate::rejection::{Checked, Within, ensure};
use num_bigint::{BigInt, Sign};
use std::collections::BTreeSet;

/// The numbers [real, oriented] of all places, for members with these nodes and so many solutions.
pub(super) fn check(
    oriented: &Oriented,
    members: &[Vec<u32>],
    (nodes, solutions): (usize, u64),
    meter: &Meter,
) -> Checked<Vec<[usize; 2]>> {
    let others = solutions.saturating_sub(1) as usize;
    ensure!(others >= 1, "there is one solution only");
    check_lists(&oriented.members, members, nodes, meter)?;
    ensure!(!oriented.places.is_empty(), "there is no place");
    let mut found = BTreeSet::new();
    for (k, place) in oriented.places.iter().enumerate() {
        let numbers = At::new(place, &oriented.members, [nodes, others], meter)
            .and_then(|at| at.numbers(place));
        let numbers = numbers.within(|| format!("places[{k}]"))?;
        ensure!(found.insert(numbers), "two places have the same numbers");
    }
    Ok(found.into_iter().collect())
}

/// (S27).
fn check_lists(
    lists: &[Vec<u32>],
    members: &[Vec<u32>],
    nodes: usize,
    meter: &Meter,
) -> Checked<()> {
    let all: usize = lists.iter().map(Vec::len).sum();
    meter.charge(SPARSE * (members.len() as u64 + 1) * (all as u64 + 1))?;
    let mut is_held = vec![false; members.len()];
    for list in lists {
        ensure!(
            list.len() >= 2 && list.is_sorted_by(|a, b| a < b),
            "the list {list:?} of nodes has fewer than two or is not increasing"
        );
        let is_inside = |member: &[u32]| member.iter().all(|v| list.binary_search(v).is_ok());
        let inside: Vec<usize> = (0..members.len())
            .filter(|&k| is_inside(&members[k]))
            .collect();
        inside.iter().for_each(|&k| is_held[k] = true);
        let first = inside.first().map_or(&[][..], |&k| &members[k]);
        let mut reached: BTreeSet<u32> = first.iter().copied().collect();
        let mut before = usize::MAX;
        while before != reached.len() {
            before = reached.len();
            for &k in &inside {
                if members[k].iter().any(|v| reached.contains(v)) {
                    reached.extend(&members[k]);
                }
            }
        }
        ensure!(
            reached.len() == list.len(),
            "the members in the list {list:?} do not have all its nodes, or do not hang together"
        );
    }
    ensure!(
        !is_held.contains(&false),
        "a member of the piece lies in no list"
    );
    let sum: i64 = lists
        .iter()
        .map(|list| Model::Projective.required(list.len()))
        .sum();
    ensure!(
        sum == Model::Projective.required(nodes),
        "the lists are not tight"
    );
    Ok(())
}

/// A place, as far as it is read and (S28) to (S31) hold.
struct At<'a> {
    pairs: Vec<(usize, usize)>,
    centres: Vec<[BigInt; 3]>,
    eliminant: Polynomial,
    cameras: Vec<[[Polynomial; 4]; 3]>,
    /// A and B of each pair.
    sides: Vec<[Vec<Polynomial>; 2]>,
    /// The length of the longest number.
    words: u64,
    meter: &'a Meter,
}

impl<'a> At<'a> {
    fn new(
        place: &Place,
        lists: &[Vec<u32>],
        [nodes, others]: [usize; 2],
        meter: &'a Meter,
    ) -> Checked<Self> {
        ensure!(
            place.centres.len() == nodes && place.cameras.len() == nodes,
            "not as many centres and cameras as nodes"
        );
        let pairs: Vec<(usize, usize)> = lists.iter().flat_map(|list| pairs_of(list)).collect();
        let numbers = place.cameras.iter().flatten().flatten();
        let numbers = numbers.chain(place.centres.iter().flatten());
        let of_roots = place.roots.iter().flat_map(|root| {
            let plane = root.plane.iter().flatten();
            plane.chain(&root.between)
        });
        let numbers = numbers.chain(&place.eliminant).chain(of_roots);
        let bits = numbers.map(|Big(x)| x.bits()).max().unwrap_or(0);
        let (words, degree) = (1 + bits / 30, others as u64 + 1);
        let products = (nodes + pairs.len()) as u64 * 100 * degree.pow(2);
        let of_roots = 16 * degree.pow(3) * degree.max(place.roots.len() as u64);
        let products = (SPARSE * products).saturating_add(of_roots);
        meter.charge(products.saturating_mul(words * words))?;
        let eliminant = polynomial(&place.eliminant, others + 1)?;
        ensure!(
            eliminant.0.len() == others + 1,
            "the degree of the eliminant is not {others}"
        );
        let cameras = place.cameras.iter().map(|entries| camera(entries, others));
        let cameras = cameras.collect::<Checked<Vec<_>>>()?;
        let centre = |c: &[Big<BigInt>; 3]| c.each_ref().map(|Big(x)| x.clone());
        let mut at = Self {
            pairs,
            centres: place.centres.iter().map(centre).collect(),
            eliminant,
            cameras,
            sides: Vec::new(),
            words,
            meter,
        };
        at.check_centres(lists)?;
        at.check_residues(place)?;
        at.sides = at.pairs.iter().map(|&pair| at.sides_of(pair)).collect();
        at.check_multiples()?;
        Ok(at)
    }

    fn difference(&self, (i, j): (usize, usize)) -> [BigInt; 3] {
        let [a, b] = [&self.centres[i], &self.centres[j]];
        [0, 1, 2].map(|k| &a[k] - &b[k])
    }

    /// (S28).
    fn check_centres(&self, lists: &[Vec<u32>]) -> Checked<()> {
        let zero = [(); 3].map(|()| BigInt::default());
        for list in lists {
            let nodes: Vec<usize> = list.iter().map(|&v| v as usize).collect();
            let d = self.difference((nodes[0], nodes[1]));
            ensure!(d != zero, "two centres of a list are the same");
            for &v in &nodes[2..] {
                let e = self.difference((nodes[0], v));
                let cross = [(1, 2), (2, 0), (0, 1)].map(|(k, l)| &d[k] * &e[l] - &d[l] * &e[k]);
                ensure!(cross != zero, "three centres of a list are on a line");
            }
        }
        Ok(())
    }

    /// (S29) and (S31).
    fn check_residues(&self, place: &Place) -> Checked<()> {
        let field = &Field::new(place.prime.0)?;
        let mut factors = vec![vec![field.one; self.pairs.len()]];
        let mut different = BTreeSet::new();
        ensure!(
            place.residues.len() + 1 == self.eliminant.0.len(),
            "not as many residues as roots"
        );
        let last = self.eliminant.0.last();
        ensure!(
            last.is_some_and(|last| element(field, last) != 0),
            "the last coefficient of the eliminant is zero modulo p"
        );
        for &Big(residue) in &place.residues {
            ensure!(residue < field.p, "{residue} is no residue");
            ensure!(different.insert(residue), "two residues are the same");
            let at = field.element(residue);
            ensure!(
                value(field, &self.eliminant, at) == 0,
                "the eliminant does not vanish at {residue}"
            );
            let cameras = self.cameras.iter();
            let cameras: Vec<Camera<u64>> = cameras
                .map(|camera| {
                    camera
                        .each_ref()
                        .map(|row| row.each_ref().map(|f| value(field, f, at)))
                })
                .collect();
            self.check_cameras(field, &cameras)?;
            let factor = |&pair: &(usize, usize)| self.factor(field, &cameras, pair);
            factors.push(self.pairs.iter().map(factor).collect::<Checked<_>>()?);
        }
        for (k, ours) in factors.iter().enumerate() {
            for theirs in &factors[..k] {
                let both = ours.iter().zip(theirs);
                let quotients = both.map(|(&a, &b)| field.mul(a, field.inverse(b)));
                let times = |a, b| field.mul(a, b);
                let found =
                    self.potentials(quotients.collect(), field.one, times, |x| field.inverse(x));
                ensure!(
                    found.is_none(),
                    "two solutions are not shown to be different"
                );
            }
        }
        Ok(())
    }

    /// (S29): the cameras at a residue.
    fn check_cameras(&self, field: &Field, cameras: &[Camera<u64>]) -> Checked<()> {
        let centres: Vec<[u64; 4]> = cameras.iter().map(|camera| centre(field, camera)).collect();
        ensure!(
            !centres.contains(&[0; 4]),
            "a camera has rank below 3 modulo p"
        );
        let apart = |&(i, j): &(usize, usize)| {
            let [c, e] = [centres[i], centres[j]];
            (0..4).any(|k| (0..k).any(|l| field.mul(c[k], e[l]) != field.mul(c[l], e[k])))
        };
        ensure!(
            self.pairs.iter().all(apart),
            "two cameras of a pair have the same centre modulo p"
        );
        let rows = (0..10 * self.pairs.len()).map(|row| jacobian(field, &self.pairs, cameras, row));
        let rank = Echelon::of(field, 12 * cameras.len(), self.meter, rows)?.rank();
        ensure!(
            rank as i64 == Model::Projective.required(cameras.len()),
            "J_P of a solution has the rank {rank}"
        );
        Ok(())
    }

    /// (S31): s with A = s B modulo p; that there is one follows from (S30).
    fn factor(&self, field: &Field, cameras: &[Camera<u64>], pair: (usize, usize)) -> Checked<u64> {
        let d = self.difference(pair).map(|x| element(field, &x));
        let side = |v: usize| {
            let entry = |at: usize| {
                let (k, column) = (at % 3, at / 3);
                let (s, t) = ((k + 1) % 3, (k + 2) % 3);
                let [y, z] = [s, t].map(|row| cameras[v][row][column]);
                field.sub(field.mul(d[s], z), field.mul(d[t], y))
            };
            (0..12).map(entry).collect::<Vec<u64>>()
        };
        let (a, b) = (side(pair.0), side(pair.1));
        let at = (0..12).find(|&k| a[k] != 0 && b[k] != 0);
        let factor = at.map(|k| field.mul(a[k], field.inverse(b[k])));
        ensure!(factor.is_some(), "a pair has no factor modulo p");
        Ok(factor.unwrap_or_default())
    }

    /// Numbers t, one for each node and t = `one` at the first, such that t_i is `times(t_j, quotient)` on
    /// all pairs; `None` if there are none. Pairs join all nodes.
    fn potentials<T: Copy + PartialEq>(
        &self,
        quotients: Vec<T>,
        one: T,
        times: impl Fn(T, T) -> T,
        inverse: impl Fn(T) -> T,
    ) -> Option<Vec<T>> {
        let mut known: Vec<Option<T>> = vec![None; self.cameras.len()];
        known[0] = Some(one);
        let mut more = true;
        while std::mem::take(&mut more) {
            for (&(i, j), &quotient) in self.pairs.iter().zip(&quotients) {
                match (known[i], known[j]) {
                    (None, Some(t)) => (known[i], more) = (Some(times(t, quotient)), true),
                    (Some(t), None) => (known[j], more) = (Some(times(t, inverse(quotient))), true),
                    _ => {}
                }
            }
        }
        let known: Vec<T> = known.into_iter().collect::<Option<_>>()?;
        let mut all = self.pairs.iter().zip(&quotients);
        let fits = all.all(|(&(i, j), &quotient)| known[i] == times(known[j], quotient));
        fits.then_some(known)
    }

    /// (S30): A and B.
    fn sides_of(&self, pair: (usize, usize)) -> [Vec<Polynomial>; 2] {
        let d = self.difference(pair).map(Polynomial::constant);
        [pair.0, pair.1].map(|v| {
            let entry = |at: usize| {
                let (k, column) = (at % 3, at / 3);
                let (s, t) = ((k + 1) % 3, (k + 2) % 3);
                let [y, z] = [s, t].map(|row| &self.cameras[v][row][column]);
                d[s].times(z).minus(&d[t].times(y))
            };
            (0..12).map(entry).collect()
        })
    }

    /// (S30).
    fn check_multiples(&self) -> Checked<()> {
        for ([a, b], (i, j)) in self.sides.iter().zip(&self.pairs) {
            let is_multiple = |k: usize, l: usize| {
                let minor = a[k].times(&b[l]).minus(&a[l].times(&b[k]));
                minor.rest(&self.eliminant) == Polynomial::default()
            };
            ensure!(
                (0..12).all(|k| (0..k).all(|l| is_multiple(k, l))),
                "the pair [{i}, {j}] has another fundamental matrix"
            );
        }
        Ok(())
    }

    /// (S32), and the numbers of (S33).
    fn numbers(&self, place: &Place) -> Checked<[usize; 2]> {
        let mut before: Option<[&BigInt; 2]> = None;
        for root in &place.roots {
            let [a, b, d] = root.between.each_ref().map(|Big(x)| x);
            ensure!(d.sign() == Sign::Plus && a < b, "this is no interval");
            ensure!(
                before.is_none_or(|[end, of]| end * d <= a * of),
                "the intervals are not increasing"
            );
            before = Some([b, d]);
            let ends = [a, b].map(|end| self.eliminant.sign_at(end, d));
            ensure!(
                ends[0] != Sign::NoSign && ends[0] == -ends[1],
                "the eliminant has no other sign at the other end"
            );
        }
        ensure!(
            place.roots.len() == self.eliminant.real_roots(),
            "the intervals are not as many as the real roots"
        );
        let cameras = self.cameras.iter();
        let centres: Vec<_> = cameras.map(|camera| minors(camera.each_ref())).collect();
        let mut oriented = 1;
        for (k, root) in place.roots.iter().enumerate() {
            let is_oriented = self.is_oriented(root, &centres);
            oriented += usize::from(is_oriented.within(|| format!("roots[{k}]"))?);
        }
        Ok([1 + place.roots.len(), oriented])
    }

    /// (S33).
    fn is_oriented(&self, root: &Root, centres: &[[Polynomial; 4]]) -> Checked<bool> {
        let ends = root.between.each_ref().map(|Big(x)| x);
        let steps = SPARSE * 100 * (self.pairs.len() * self.eliminant.0.len()) as u64;
        self.meter
            .charge(steps.saturating_mul(self.words * self.words))?;
        let signs = self.sides.iter().map(|[a, b]| {
            let sum = Polynomial::dot(a, b);
            Ok(sum.sign_between(ends)? == Sign::Plus)
        });
        let signs = signs.collect::<Checked<Vec<bool>>>()?;
        let Some(signs) = self.potentials(signs, true, |t, same| t == same, |same| same) else {
            ensure!(
                root.plane.is_none() && root.five.is_none(),
                "the signs contradict each other, and more is shown"
            );
            return Ok(false);
        };
        let signed = centres.iter().zip(signs).map(|(centre, sign)| {
            centre
                .each_ref()
                .map(|f| if sign { f.clone() } else { f.negative() })
        });
        let centres: Vec<[Polynomial; 4]> = signed.collect();
        let products = match (&root.plane, &root.five) {
            (Some(plane), None) => {
                let weights = plane
                    .each_ref()
                    .map(|Big(x)| Polynomial::constant(x.clone()));
                let product = |centre: &[Polynomial; 4]| Polynomial::dot(&weights, centre);
                centres.iter().map(product).collect::<Vec<_>>()
            }
            (None, Some(five)) => {
                ensure!(
                    five.is_sorted_by(|a, b| a < b) && (five[4] as usize) < centres.len(),
                    "these are not five nodes"
                );
                let determinant = |omitted: usize| {
                    let others = (0..5).filter(|&k| k != omitted);
                    let others: Vec<_> = others.map(|k| &centres[five[k] as usize]).collect();
                    let product =
                        Polynomial::dot(others[0], &minors([others[1], others[2], others[3]]));
                    if omitted.is_multiple_of(2) {
                        product
                    } else {
                        product.negative()
                    }
                };
                (0..5).map(determinant).collect()
            }
            _ => return Err("not just one of plane and five nodes".to_string().into()),
        };
        let signs = products.iter().map(|f| f.sign_between(ends));
        let signs = signs.collect::<Checked<Vec<Sign>>>()?;
        ensure!(
            signs.iter().all(|&sign| sign == signs[0]),
            "the signs are not all the same"
        );
        Ok(root.plane.is_some())
    }
}

fn pairs_of(list: &[u32]) -> impl Iterator<Item = (usize, usize)> + '_ {
    let ends = move |first: usize, v: u32| (list[first] as usize, v as usize);
    let others = list[2..]
        .iter()
        .flat_map(move |&v| [ends(0, v), ends(1, v)]);
    std::iter::once(ends(0, list[1])).chain(others)
}

fn polynomial(coefficients: &[Big<BigInt>], most: usize) -> Checked<Polynomial> {
    ensure!(
        coefficients.len() <= most,
        "the degree of a polynomial is too high"
    );
    let last = coefficients.last();
    ensure!(
        last.is_none_or(|Big(last)| last.sign() != Sign::NoSign),
        "the last coefficient of a polynomial is zero"
    );
    Ok(Polynomial(
        coefficients.iter().map(|Big(x)| x.clone()).collect(),
    ))
}

fn camera(entries: &[Vec<Big<BigInt>>; 12], others: usize) -> Checked<[[Polynomial; 4]; 3]> {
    let mut camera: [[Polynomial; 4]; 3] = Default::default();
    for (entry, coefficients) in camera.iter_mut().flatten().zip(entries) {
        *entry = polynomial(coefficients, others)?;
    }
    Ok(camera)
}

fn element(field: &Field, number: &BigInt) -> u64 {
    let p = BigInt::from(field.p);
    let residue = ((number % &p) + &p) % p;
    field.element(u64::try_from(residue).unwrap_or_default())
}

fn value(field: &Field, f: &Polynomial, at: u64) -> u64 {
    let terms = f.0.iter().rev();
    terms.fold(0, |sum, a| field.add(field.mul(sum, at), element(field, a)))
}

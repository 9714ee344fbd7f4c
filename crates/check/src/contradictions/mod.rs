//! Certificates of contradictions between measured motions of pairs (docs/contradictions.md, which
//! has the conditions (C1) to (C9) and (B1) to (B7)). Nothing here is needed for another certificate.

mod database;
mod document;
mod motions;

pub use database::{Database, Row};
pub(crate) use document::Document;

use crate::limits::Meter;
use crate::rejection::{Checked, Within, ensure};
use document::{Cycle, Packing, Pair, Upper};
use motions::{ONE, Quaternion, big, conjugate, cosines, dot, product, square, turned};
use num_bigint::BigInt;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Operations for a step of a cycle, or a pair.
const STEP: u64 = 1 << 14;

/// What a certificate of contradictions proves.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct VerifiedContradictions {
    /// How many images and pairs there are.
    pub size: [usize; 2],
    /// The hash of the database that its numbers are said to be from.
    pub database: Option<String>,
    /// Whether they are verified to be.
    pub bound: bool,
    /// What is off at least.
    pub at_least: Vec<AtLeast>,
    /// By how many degrees pairs disagree with rotations of all images, and how many at most.
    pub at_most: Vec<(usize, usize)>,
}

/// How many pairs are off at least.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AtLeast {
    /// Rotations by more than so many degrees.
    pub theta: usize,
    /// Or directions by more than so many.
    pub phi: Option<usize>,
    /// So many pairs are taken for right, within so many thousandths of a degree.
    pub assumed: [usize; 2],
    /// So many of the others are off.
    pub pairs: u64,
}

/// Verifies a certificate, and with a database that its numbers are those of that database.
pub(crate) fn check(
    document: &Document,
    database: Option<&Database>,
    meter: &Meter,
) -> Checked<VerifiedContradictions> {
    ensure_well_formed(document)?;
    let cosines = &cosines();
    let proof = &Proof {
        document,
        cosines,
        meter,
    };
    for (k, packing) in document.packings.iter().enumerate() {
        let checked = proof.packing(packing);
        checked.within(|| format!("packings[{k}]"))?;
    }
    for (k, upper) in document.upper.iter().enumerate() {
        let checked = proof.upper(upper);
        checked.within(|| format!("upper[{k}]"))?;
    }
    if let Some(database) = database {
        database.bind(document, meter)?;
    }
    let at_least = document.packings.iter().map(|packing| AtLeast {
        theta: packing.theta,
        phi: packing.phi,
        assumed: [packing.assumed.len(), packing.assumed_within],
        pairs: packing.at_least,
    });
    let at_most = document.upper.iter();
    Ok(VerifiedContradictions {
        size: [document.images.len(), document.pairs.len()],
        database: document.database.clone(),
        bound: database.is_some(),
        at_least: at_least.collect(),
        at_most: at_most.map(|upper| (upper.theta, upper.at_most)).collect(),
    })
}

/// Types and ranges (C1), and which pairs may be there (C2).
fn ensure_well_formed(document: &Document) -> Checked<()> {
    let images = document.images.len();
    ensure!(images > 0, "no images");
    let names: BTreeSet<_> = document.images.iter().collect();
    ensure!(names.len() == images, "two images have one name");
    let is_digit = |byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
    let is_hash = |hash: &String| hash.len() == 64 && hash.bytes().all(is_digit);
    let fine = document.database.as_ref().is_none_or(is_hash);
    ensure!(fine, "`database` has not 64 digits");
    let is_database = document.database.is_some();
    let fine = is_database || document.excluded.is_empty();
    ensure!(fine, "pairs are excluded, and of no database");
    let mut seen = BTreeSet::new();
    for pair in document.pairs.iter().chain(&document.excluded) {
        let [i, j] = pair.ends;
        ensure!(i != j && i.max(j) < images, "{i} and {j} are no two images");
        let zero = pair.q == [0; 4] || pair.t == Some([0; 3]);
        ensure!(!zero, "the motion of {i} and {j} has zeros alone");
        let configured = match is_database {
            true => matches!(pair.configuration, Some(2 | 3)),
            false => pair.configuration.is_none(),
        };
        ensure!(configured, "{i} and {j} have another configuration");
        let once = !is_database || seen.insert([i.min(j), i.max(j)]);
        ensure!(once, "the pair of {i} and {j} is there twice");
    }
    Ok(())
}

/// What the conditions of packings and upper bounds refer to.
struct Proof<'a> {
    document: &'a Document,
    cosines: &'a [i128],
    meter: &'a Meter,
}

/// A step of a walk: its pair, whether it goes from the first end to the second, and its rotation.
type Step<'a> = (&'a Pair, bool, Quaternion);

impl Proof<'_> {
    /// (C3), (C8), and each cycle.
    fn packing(&self, packing: &Packing) -> Checked<()> {
        let (theta, phi, assumed) = (packing.theta, packing.phi, &packing.assumed);
        ensure!((1..=89).contains(&theta), "theta is not from 1 to 89");
        let fine = phi.is_none_or(|phi| (theta..=89).contains(&phi));
        ensure!(fine, "phi is not from theta to 89");
        let witnessed = packing.cycles.iter().any(|one| one.witness.is_some());
        ensure!(witnessed == phi.is_some(), "phi is for witnesses alone");
        ensure!(packing.denominator > 0, "the denominator is zero");
        let pairs = self.document.pairs.len();
        let fine = assumed.is_sorted_by(|a, b| a < b) && assumed.iter().all(|&k| k < pairs);
        ensure!(fine, "`assumed` is no increasing list of pairs");
        let fine = (1..=1000 * theta).contains(&packing.assumed_within);
        ensure!(fine, "assumed_within is not from 1 to 1000 theta");
        let is_free = |pair: &usize| assumed.binary_search(pair).is_err();
        let (mut carried, mut sum) = (BTreeMap::<usize, u128>::new(), 0_u128);
        for (k, cycle) in packing.cycles.iter().enumerate() {
            let used = self.cycle(cycle, packing);
            let used = used.within(|| format!("cycles[{k}]"))?;
            ensure!(
                used.iter().any(is_free),
                "all pairs of cycles[{k}] are assumed right"
            );
            let weight = u128::from(cycle.weight);
            for pair in used.into_iter().filter(is_free) {
                *carried.entry(pair).or_default() += weight;
            }
            sum += weight;
        }
        let most = u128::from(packing.denominator);
        for (k, weight) in carried {
            ensure!(weight <= most, "pair {k} carries {weight} of {most}");
        }
        let found = sum.div_ceil(most);
        let same = u128::from(packing.at_least) == found;
        ensure!(same, "the weights prove {found}");
        Ok(())
    }

    /// (C4), and (C6) or (C7); returns the pairs.
    fn cycle(&self, cycle: &Cycle, packing: &Packing) -> Checked<BTreeSet<usize>> {
        let length = cycle.walk.len();
        ensure!(length >= 2, "a walk has two steps at least");
        // Products grow with the steps.
        self.meter
            .charge(length as u64 * (STEP + 16 * length as u64))?;
        let (mut used, mut steps, mut ends) = (BTreeSet::new(), Vec::new(), Vec::new());
        let mut sum = 0;
        for &[k, sense] in &cycle.walk {
            let number = usize::try_from(k).unwrap_or(usize::MAX);
            let pair = self.document.pairs.get(number);
            let pair = pair.ok_or_else(|| format!("there is no pair {k}"))?;
            ensure!(used.insert(number), "pair {k} is taken twice");
            ensure!(matches!(sense, 1 | -1), "{sense} is no sense");
            sum += match packing.assumed.binary_search(&number) {
                Ok(_) => packing.assumed_within,
                Err(_) => 1000 * packing.theta,
            };
            let (forward, q, [i, j]) = (sense == 1, big(pair.q), pair.ends);
            ends.push(if forward { [i, j] } else { [j, i] });
            steps.push((pair, forward, if forward { q } else { conjugate(q) }));
        }
        let follows = |m: usize| ends[m][1] == ends[(m + 1) % length][0];
        ensure!((0..length).all(follows), "the walk is not closed");
        let sum = sum.div_ceil(1000);
        ensure!(sum < 180, "its angles sum to {sum}, which is not below 180");
        match (cycle.witness, packing.phi) {
            (Some(witness), Some(phi)) => self.directions(&steps, witness, [packing.theta, phi])?,
            _ => self.rotations(&steps, sum)?,
        }
        Ok(used)
    }

    /// (C6): the composed rotation turns by more than its pairs may be off together.
    fn rotations(&self, steps: &[Step], sum: usize) -> Checked<()> {
        let (whole, length) = (composed(steps), steps.len());
        let bound = ONE + self.cosines[sum] - ((length as i128) << 47);
        let turns = ((&whole[0] * &whole[0]) << 63_u32) < square(&whole) * bound;
        ensure!(turns, "it turns by {sum} degrees or less");
        Ok(())
    }

    /// (C7): going round, one always moves along the witness.
    fn directions(&self, steps: &[Step], w: [i64; 3], [theta, phi]: [usize; 2]) -> Checked<()> {
        ensure!(w != [0; 3], "the witness is zero");
        let (w, last) = (big(w), steps.len() - 1);
        for (m, (pair, forward, _)) in steps.iter().enumerate() {
            let links = m.min(last - m);
            let within = phi + links * theta;
            ensure!(within < 90, "phi + h theta is {within}");
            let t = pair.t.map(big);
            let t = t.ok_or_else(|| format!("step {m} has no vector"))?;
            // -t is the direction in the frame of j, and turned back that in the frame of i. Which of them the step
            // begins with is a matter of its sense.
            let early = m <= last - m;
            let here = match early == *forward {
                true => turned(&conjugate(big(pair.q)), &t),
                false => t,
            };
            let v = match early {
                true => turned(&conjugate(composed(&steps[..m])), &here),
                false => turned(&composed(&steps[m + 1..]), &here),
            };
            let bound = ONE - self.cosines[2 * within] + ((links as i128 + 1) << 48);
            let along = if *forward { -dot(&w, &v) } else { dot(&w, &v) };
            let least = square(&w) * square(&v) * bound;
            let moves = along > BigInt::ZERO && (&along * &along) << 63_u32 > least;
            ensure!(moves, "step {m} is not near enough to the witness");
        }
        Ok(())
    }

    /// (C9).
    fn upper(&self, upper: &Upper) -> Checked<()> {
        let (theta, rotations) = (upper.theta, &upper.rotations);
        ensure!((1..=89).contains(&theta), "theta is not from 1 to 89");
        let fine = rotations.len() == self.document.images.len() && !rotations.contains(&[0; 4]);
        ensure!(fine, "not a rotation for each image");
        let bound = ONE + self.cosines[theta] + (1 << 47);
        let mut off = 0;
        for pair in &self.document.pairs {
            self.meter.charge(STEP)?;
            let [i, j] = pair.ends.map(|image| big(rotations[image]));
            let rest = product(&conjugate(j), &product(&big(pair.q), &i));
            off += usize::from((&rest[0] * &rest[0]) << 63_u32 < square(&rest) * bound);
        }
        ensure!(off == upper.at_most, "{off} pairs do not agree");
        Ok(())
    }
}

/// The rotation along steps, from the first to the last.
fn composed(steps: &[Step]) -> Quaternion {
    let turns = steps.iter().map(|(_, _, turn)| turn);
    turns.fold(big([1, 0, 0, 0]), |before, turn| product(turn, &before))
}

impl VerifiedContradictions {
    /// Whether pairs contradict each other, whatever is assumed.
    pub(crate) fn verdict(&self) -> &'static str {
        let mut proved = self.at_least.iter();
        match proved.any(|least| least.assumed[0] == 0 && least.pairs > 0) {
            true => "contradictions",
            false => "no-contradictions",
        }
    }

    /// The hash of the database, if it names one.
    pub(crate) fn sha256(&self) -> &str {
        self.database.as_deref().unwrap_or_default()
    }
}

impl fmt::Display for VerifiedContradictions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [images, pairs] = self.size;
        let (here, of) = match self.bound {
            true => ("those of this database", "of this database"),
            false => ("those written here", "about the numbers written here"),
        };
        let database = match &self.database {
            Some(sha256) => format!("database with SHA-256 {sha256}"),
            None => "no database is named".into(),
        };
        writeln!(
            f,
            "numbers: {here}, {images} images, {pairs} pairs; {database}"
        )?;
        for least in &self.at_least {
            let (count, theta) = (least.pairs, least.theta);
            write!(f, "contradictions: at least {count} of {pairs} pairs ")?;
            write!(f, "are off by more than {theta} degrees")?;
            if let Some(phi) = least.phi {
                write!(f, ", or their directions by more than {phi}")?;
            }
            let [assumed, within] = least.assumed;
            if assumed > 0 {
                let within = within as f64 / 1000.0;
                write!(f, ", if {assumed} others are right within {within} degrees")?;
            }
            writeln!(f, " (proof), {of}")?;
        }
        for (theta, most) in &self.at_most {
            write!(f, "rotations: all pairs but {most} agree within ")?;
            writeln!(f, "{theta} degrees (proof), {of}")?;
        }
        Ok(())
    }
}

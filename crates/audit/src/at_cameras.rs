//! What somebody's floating point found at given cameras, held against what is so there.
//!
//! In: a table, one result a row. Out: for each row what it claims ([`FloatClaim`]), and, with the exact answer at the
//! cameras and the enclosed singular value, whether that is so.

use super::claims::{Claim, Claimed, Ruling};
use super::table::{self, BadRow, Row, TableError};
use crate::enclosure::{Enclosure, Matrix, SigmaError, enclose};
use std::cmp::Ordering;
use viewcert::at_cameras::{Centres, Here};
use viewcert::graph::Graph;
use viewcert::linalg::Ring;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::watch::Watch;

/// The columns that claim something.
const KNOWN: &str = "name model verdict rank components sigma sigma_error matrix norm";

/// What a row of a table claims.
#[derive(Clone, Debug)]
pub struct FloatClaim {
    /// What is claimed of these cameras.
    pub claim: Claim,
    sigma: Option<Sigma>,
}

/// A matrix, two bounds of its smallest singular value that is not of a trivial motion, and the Frobenius norm to which
/// cameras and fundamental matrices are scaled.
type Sigma = (Matrix, [Rational; 2], Option<Rational>);

/// Reads a table; see [`FloatClaim`] for what its columns say.
///
/// # Errors
/// The table is refused whole.
pub fn read_table(text: &str) -> Result<Vec<FloatClaim>, TableError> {
    let read = |row: &Row| {
        let line = row.line;
        claim(row).map_err(|BadRow(problem)| TableError { line, problem })
    };
    let rows = table::read(text, KNOWN, "seconds seconds_")?;
    rows.iter().map(read).collect()
}

fn claim(row: &Row) -> Result<FloatClaim, BadRow> {
    let claim = Claim::new(row)?;
    claim.ensure_some(("sigma", row.cell("sigma").is_some()))?;
    let sigma = sigma(row, &claim)?;
    Ok(FloatClaim { claim, sigma })
}

/// What a row claims of a singular value.
fn sigma(row: &Row, claim: &Claim) -> Result<Option<Sigma>, BadRow> {
    let bad = |why: &str| BadRow(why.to_owned());
    let size = |column| {
        let what = "a decimal or a fraction that is not negative";
        let found: Option<Rational> = row.parsed(column, what)?;
        let is_negative = |x: &Rational| x.numerator().sign() == Ordering::Less;
        match found.as_ref().is_some_and(is_negative) {
            true => Err(bad(&format!("{column}: take {what}"))),
            false => Ok(found),
        }
    };
    let (value, error, norm) = (size("sigma")?, size("sigma_error")?, size("norm")?);
    let (named, model) = (row.cell("matrix"), claim.model);
    let Some(value) = value else {
        return match error.is_some() || norm.is_some() || named.is_some() {
            true => Err(bad(
                "sigma_error, matrix and norm say more of sigma, which is missing",
            )),
            false => Ok(None),
        };
    };
    let of_model = |matrix: &Matrix| matrix.model() == model;
    let all: Vec<Matrix> = Matrix::ALL.into_iter().filter(of_model).collect();
    let is_named = |matrix: &&Matrix| named.is_none_or(|name| name == matrix.name());
    let matrix = *all.iter().find(is_named).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|matrix| matrix.name()).collect();
        let names = names.join(" or ");
        match named {
            Some(name) if !all.is_empty() => {
                bad(&format!("matrix: {name:?} is no matrix of the {model} model; take {names}"))
            }
            _ => bad("sigma: no matrix of the affine model is enclosed; claim verdict, rank or components alone"),
        }
    })?;
    if norm.as_ref().is_some_and(|norm| norm.numerator().is_zero()) {
        return Err(bad("norm: take a decimal or a fraction above 0"));
    }
    if norm.is_some() && model.in_space() {
        let why = "norm: the matrix is made of directions, which have norm 1; leave the norm out";
        return Err(bad(why));
    }
    let unit = || row.cell("sigma").and_then(last_place);
    let none = "sigma: take a decimal; with a fraction goes a sigma_error";
    let error = error.or_else(unit).ok_or_else(|| bad(none))?;
    let bounds = [Rationals.sub(&value, &error), Rationals.add(&value, &error)];
    Ok(Some((matrix, bounds, norm)))
}

/// One unit of the last digit that is written; nothing for what is no decimal.
fn last_place(text: &str) -> Option<Rational> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i64>().ok()?),
        None => (text, 0),
    };
    let behind = mantissa.split_once('.').map_or("", |(_, behind)| behind);
    let is_decimal = mantissa
        .bytes()
        .all(|b| b.is_ascii_digit() || b"+.".contains(&b));
    is_decimal.then(|| Rational::scaled(Integer::one(), 10, exponent - behind.len() as i64))
}

/// A claim's ruling, and the singular value that it is about, if it claims one, with its matrix.
pub type Found = (Ruling, Option<(Matrix, Enclosure)>);

/// Rules on a claim about cameras of which the answer in its model is known.
///
/// # Errors
/// See [`SigmaError`].
pub fn ruled(
    of: &FloatClaim,
    graph: &Graph,
    at: (&Centres, &Here),
    watch: &Watch,
) -> Result<Found, SigmaError> {
    let asked = of.sigma.as_ref().map(|(matrix, bounds, norm)| {
        let found = enclose(*matrix, graph, at, (norm.as_ref(), Some(bounds)), watch)?;
        Ok::<_, SigmaError>((*matrix, found))
    });
    let asked = asked.transpose()?;
    Ok((
        rule(of, at.1, asked.as_ref().map(|(_, found)| found)),
        asked,
    ))
}

/// Rules on a claim, by the exact answer in its model at the cameras and, where one is claimed, the enclosed singular value.
fn rule(of: &FloatClaim, here: &Here, sigma: Option<&Enclosure>) -> Ruling {
    let (mut wrong, mut open) = (Vec::new(), None);
    // Where the equations are linear, a full rank leaves no other cameras at all.
    let is_only = here.model.is_linear() || here.is_planar;
    match (of.claim.verdict, here.is_determined()) {
        (Some(Claimed::Solvable | Claimed::FiniteSolvable), false) => wrong.push(format!(
            "the cameras are not determined: the rank is {} of {}",
            here.rank.value, here.required
        )),
        (Some(Claimed::NotFiniteSolvable), true) => {
            wrong.push("the cameras are determined: the rank is full".to_owned());
        }
        (Some(Claimed::NotSolvable), true) if is_only => {
            wrong.push("these cameras are the only ones".to_owned());
        }
        (Some(Claimed::Solvable | Claimed::NotSolvable), true) if !is_only => {
            open = Some("the cameras are an isolated solution; whether there are others is not decided here".to_owned());
        }
        _ => {}
    }
    wrong.extend(
        of.claim
            .wrong(here.rank.value, here.required, here.components.value.len()),
    );
    if let (Some((_, bounds, _)), Some(found)) = (&of.sigma, sigma) {
        let between = match found.decimals() {
            [_, most] if most == "0" => most,
            [least, most] => format!("between {least} and {most}"),
        };
        match found.is_within(bounds) {
            Some(true) => {}
            Some(false) => wrong.push(format!("sigma is {between}")),
            None => {
                open = Some(format!(
                    "sigma is {between}, which holds part of what is claimed"
                ))
            }
        }
    }
    Ruling::new(&wrong, open)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows() {
        let text =
            "Name,rank,verdict,sigma,seconds_svd\nmine,29,Not determined,1.250e-3,7\n\n,,,0.5,\n";
        let claims = read_table(text).unwrap();
        assert_eq!((claims[0].claim.line, claims[1].claim.line), (2, 4));
        assert_eq!(claims[0].claim.name.as_deref(), Some("mine"));
        assert_eq!(claims[0].claim.rank, Some(29));
        assert_eq!(claims[0].claim.verdict, Some(Claimed::NotFiniteSolvable));
        assert_eq!(claims[0].sigma.as_ref().unwrap().0, Matrix::Plain);
        let bounds = |k: usize| claims[k].sigma.clone().unwrap().1.map(|x| x.to_string());
        assert_eq!(bounds(0), ["1249/1000000", "1251/1000000"]);
        assert_eq!(bounds(1), ["2/5", "3/5"]);
        let text = "model;sigma;sigma_error;matrix\ncalibrated;1/3;0.01;R_B\n";
        let claim = &read_table(text).unwrap()[0];
        assert_eq!(claim.sigma.as_ref().unwrap().0, Matrix::BearingByLength);
    }

    #[test]
    fn what_is_refused_by_line() {
        for (text, line, why) in [
            ("rank,ranks\n1,2\n", 1, "unknown column \"ranks\""),
            ("rank,name\n,a\n", 2, "nothing is claimed"),
            ("verdict\nundecided\n", 2, "nothing is claimed"),
            ("rank,norm\n1,10\n", 2, "sigma, which is missing"),
            ("rank,sigma_error\n1,10\n", 2, "sigma, which is missing"),
            ("model,sigma\naffine,1.0\n", 2, "affine model"),
            (
                "model,sigma,matrix\ncalibrated,1.0,J\n",
                2,
                "\"J\" is no matrix of the calibrated model; take bearing or R_B",
            ),
            (
                "model,sigma,norm\ncalibrated,1.0,2\n",
                2,
                "leave the norm out",
            ),
            ("rank\n-1\n", 2, "rank: \"-1\""),
            ("rank\n2.0\n", 2, "rank: \"2.0\""),
            ("components\nx\n", 2, "components: \"x\""),
            ("sigma\nnan\n", 2, "sigma: \"nan\""),
            ("sigma\n-1.0\n", 2, "not negative"),
            ("sigma\n1/3\n", 2, "sigma_error"),
            ("verdict\nmaybe\n", 2, "verdict: \"maybe\""),
            ("model,rank\northographic,1\n", 2, "\"orthographic\""),
            ("sigma,matrix\n1.0,K\n", 2, "matrix: \"K\" is no"),
            ("sigma,norm\n1.0,0\n", 2, "norm: take"),
        ] {
            let error = read_table(text).unwrap_err();
            assert_eq!(error.line, line, "{text:?}: {error}");
            assert!(error.problem.contains(why), "{text:?}: {error}");
        }
    }
}

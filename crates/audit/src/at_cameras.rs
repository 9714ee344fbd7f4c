//! What somebody's floating point found at given cameras, held against what is so there.
//!
//! In: a table, one result a row. Out: for each row what it claims ([`FloatClaim`]), and, with the exact answer at the
//! cameras and the enclosed singular value, whether that is so.

use super::claims::{Claimed, Ruling, model, verdict};
use super::table::{BadRow, Columns, Row, TableError};
use crate::enclosure::{Enclosure, Matrix, enclose};
use std::cmp::Ordering;
use viewcert::Model;
use viewcert::at_cameras::{Centres, Here};
use viewcert::graph::Graph;
use viewcert::linalg::Ring;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::watch::{Stopped, Watch};
use viewcert::wording::counted;

/// What a row of a table claims.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FloatClaim {
    /// Its line in the table, from 1.
    pub line: usize,
    /// What its author calls it.
    pub name: Option<String>,
    /// In which model; projective if no column says so.
    pub model: Model,
    /// Of these cameras.
    pub verdict: Option<Claimed>,
    /// The rank of the Jacobian.
    pub rank: Option<usize>,
    /// The number of parts that are determined.
    pub components: Option<usize>,
    /// Two bounds of the smallest singular value that is not of a trivial motion.
    pub sigma: Option<[Rational; 2]>,
    /// Of which matrix; nothing in the affine model.
    pub matrix: Option<Matrix>,
    /// The Frobenius norm to which cameras and fundamental matrices are scaled.
    pub norm: Option<Rational>,
}

/// Reads a table; see [`FloatClaim`] for what its columns say.
///
/// # Errors
/// The table is refused whole.
pub fn read_table(text: &str) -> Result<Vec<FloatClaim>, TableError> {
    let known = "name model verdict rank components sigma sigma_error matrix norm";
    let columns = Columns::new(known, "seconds seconds_", &[]);
    let rows = columns.read(text)?;
    let read = |row: &Row| {
        claim(row).map_err(|BadRow(problem)| TableError {
            line: row.line,
            problem,
        })
    };
    rows.iter().map(read).collect()
}

fn claim(row: &Row) -> Result<FloatClaim, BadRow> {
    let bad = |why: &str| Err(BadRow(why.to_owned()));
    let model = model(row)?;
    let size = |column| {
        let found = row.parsed(column, "a decimal or a fraction that is not negative")?;
        let is_negative = |x: &Rational| x.numerator().sign() == Ordering::Less;
        match found.as_ref().is_some_and(is_negative) {
            true => Err(BadRow(format!(
                "{column}: take a decimal or a fraction that is not negative"
            ))),
            false => Ok(found),
        }
    };
    let verdict = verdict(row)?;
    let matrix = match row.cell("matrix") {
        None => Matrix::ALL
            .into_iter()
            .find(|matrix| matrix.model() == model),
        Some(text) => match Matrix::ALL.into_iter().find(|matrix| matrix.name() == text) {
            None => {
                return bad(&format!(
                    "matrix: {text:?} is none of J_P, J, bearing and R_B"
                ));
            }
            Some(matrix) if matrix.model() != model => {
                return bad(&format!("matrix: {text} is no matrix of the {model} model"));
            }
            found => found,
        },
    };
    let (value, error, norm) = (size("sigma")?, size("sigma_error")?, size("norm")?);
    if value.is_none() && (error.is_some() || norm.is_some() || row.cell("matrix").is_some()) {
        return bad("sigma_error, matrix and norm say more of sigma, which is missing");
    }
    if value.is_some() && matrix.is_none() {
        return bad(
            "sigma: no matrix of the affine model is enclosed; claim verdict, rank or components alone",
        );
    }
    if norm.as_ref().is_some_and(|norm| norm.numerator().is_zero()) {
        return bad("norm: take a decimal or a fraction above 0");
    }
    if norm.is_some() && model.in_space() {
        return bad(
            "norm: the matrix is made of directions, which have norm 1; leave the norm out",
        );
    }
    let unit = row.cell("sigma").map(last_place);
    let sigma = match (value, error, unit) {
        (Some(value), Some(error), _) | (Some(value), None, Some(Some(error))) => {
            Some([Rationals.sub(&value, &error), Rationals.add(&value, &error)])
        }
        (Some(_), ..) => return bad("sigma: take a decimal; with a fraction goes a sigma_error"),
        (None, ..) => None,
    };
    let found = FloatClaim {
        line: row.line,
        name: row.cell("name").map(str::to_owned),
        model,
        verdict,
        rank: row.count("rank")?,
        components: row.count("components")?,
        sigma,
        matrix,
        norm,
    };
    let counts = found.rank.or(found.components);
    if found.verdict.is_none() && counts.is_none() && found.sigma.is_none() {
        return bad(
            "nothing is claimed: one of the columns verdict, rank, components, sigma is needed",
        );
    }
    Ok(found)
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

/// Why a singular value is not enclosed.
#[derive(Clone, Debug, thiserror::Error)]
pub enum SigmaError {
    /// More cameras than that.
    #[error("sigma: {}, and it is enclosed for up to {most}", counted(*.cameras, "camera"))]
    TooLarge {
        /// Cameras of the graph.
        cameras: usize,
        /// Cameras at most.
        most: usize,
    },
    /// The matrix takes whole cameras.
    #[error(
        "sigma: {0} takes whole cameras, and the file gives centres alone; give `camera` or `pose`"
    )]
    CentresAlone(&'static str),
    /// Work was stopped.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// The singular value of a matrix at cameras of which the answer is known, near enough for claimed bounds; exactly zero
/// where the rank is not full. See [`enclose`].
///
/// # Errors
/// See [`SigmaError`].
pub fn sigma(
    matrix: Matrix,
    graph: &Graph,
    (centres, here): (&Centres, &Here),
    (norm, claimed): (Option<&Rational>, Option<&[Rational; 2]>),
    watch: &Watch,
) -> Result<Enclosure, SigmaError> {
    if !here.is_determined() {
        return Ok(Enclosure::zero());
    }
    if let Some(most) = matrix.too_large(graph) {
        let cameras = graph.nodes();
        return Err(SigmaError::TooLarge { cameras, most });
    }
    let found = enclose(matrix, graph, centres, norm, claimed, watch)?;
    found.ok_or(SigmaError::CentresAlone(matrix.name()))
}

/// A claim's ruling, and the singular value that it is about, if it claims one, with its matrix.
pub type Found = (Ruling, Option<(Matrix, Enclosure)>);

/// Rules on a claim about cameras of which the answer in its model is known.
///
/// # Errors
/// See [`SigmaError`].
pub fn ruled(
    claim: &FloatClaim,
    graph: &Graph,
    (centres, here): (&Centres, &Here),
    watch: &Watch,
) -> Result<Found, SigmaError> {
    let asked = claim.sigma.as_ref().and(claim.matrix).map(|matrix| {
        let bounds = (claim.norm.as_ref(), claim.sigma.as_ref());
        let found = sigma(matrix, graph, (centres, here), bounds, watch)?;
        Ok::<_, SigmaError>((matrix, found))
    });
    let asked = asked.transpose()?;
    Ok((
        rule(claim, here, asked.as_ref().map(|(_, found)| found)),
        asked,
    ))
}

/// Rules on a claim, by the exact answer in its model at the cameras and, where one is claimed, the enclosed singular value.
fn rule(claim: &FloatClaim, here: &Here, sigma: Option<&Enclosure>) -> Ruling {
    let (mut wrong, mut open) = (Vec::new(), None);
    // Where the equations are linear, a full rank leaves no other cameras at all.
    let is_only = here.model.is_linear() || here.is_planar;
    match (claim.verdict, here.is_determined()) {
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
    for (what, claimed, is) in [
        ("rank", claim.rank, here.rank.value),
        ("components", claim.components, here.components.value.len()),
    ] {
        if let Some(claimed) = claimed.filter(|&claimed| claimed != is) {
            wrong.push(format!("{what} {is}, not {claimed}"));
        }
    }
    if let (Some(bounds), Some(found)) = (&claim.sigma, sigma) {
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
        assert_eq!((claims[0].line, claims[1].line), (2, 4));
        assert_eq!(claims[0].name.as_deref(), Some("mine"));
        assert_eq!(claims[0].rank, Some(29));
        assert_eq!(claims[0].verdict, Some(Claimed::NotFiniteSolvable));
        assert_eq!(claims[0].matrix, Some(Matrix::Plain));
        let bounds = |k: usize| claims[k].sigma.clone().unwrap().map(|x| x.to_string());
        assert_eq!(bounds(0), ["1249/1000000", "1251/1000000"]);
        assert_eq!(bounds(1), ["2/5", "3/5"]);
        let text = "model;sigma;sigma_error;matrix\ncalibrated;1/3;0.01;R_B\n";
        let claim = &read_table(text).unwrap()[0];
        assert_eq!(claim.matrix, Some(Matrix::BearingByLength));
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
                "J is no matrix of the calibrated",
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
            ("sigma,matrix\n1.0,K\n", 2, "matrix: \"K\""),
            ("sigma,norm\n1.0,0\n", 2, "norm: take"),
        ] {
            let error = read_table(text).unwrap_err();
            assert_eq!(error.line, line, "{text:?}: {error}");
            assert!(error.problem.contains(why), "{text:?}: {error}");
        }
    }
}

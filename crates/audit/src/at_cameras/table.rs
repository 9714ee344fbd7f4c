//! Tables of what floating point found at given cameras.
//!
//! In: CSV with a head. Out: for each row what it claims ([`FloatClaim`]), or what is wrong, by line.

use crate::enclosure::{Matrix, compare};
use std::cmp::Ordering;
use std::str::FromStr;
use viewcert::Model;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::Rational;
use viewcert::wording::counted;
use viewcert_formats::csv;

/// The columns that are read. Those that begin with `seconds` claim nothing.
const COLUMNS: [&str; 9] = [
    "name",
    "model",
    "verdict",
    "rank",
    "components",
    "sigma",
    "sigma_error",
    "matrix",
    "norm",
];

/// What a row of a table claims.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FloatClaim {
    /// Its line in the table, from 1.
    pub line: usize,
    /// What its author calls it.
    pub name: Option<String>,
    /// In which model; projective if no column says so.
    pub model: Model,
    /// Whether the cameras are determined.
    pub determined: Option<bool>,
    /// The rank of the Jacobian.
    pub rank: Option<usize>,
    /// The number of parts that are determined.
    pub components: Option<usize>,
    /// The smallest singular value that is not of a trivial motion, and by how much it may be off.
    pub sigma: Option<[Rational; 2]>,
    /// Of which matrix.
    pub matrix: Option<Matrix>,
    /// The Frobenius norm to which cameras and fundamental matrices are scaled.
    pub norm: Option<Rational>,
}

/// Why a table cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{problem}")]
pub struct FloatTableError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong there.
    pub problem: FloatProblem,
}

/// What is wrong with a table of floating-point results.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FloatProblem {
    /// No rows.
    #[error("the table needs a head with the names of the columns, and a row below it")]
    Empty,
    /// A column that says nothing here.
    #[error(
        "unknown column {0:?}; known are name, model, verdict, rank, components, sigma, sigma_error, matrix, norm, \
         and seconds..., which claims nothing; correct it or leave it out"
    )]
    Column(String),
    /// A column more than once.
    #[error("column {0:?} stands there twice")]
    Twice(String),
    /// A row with more or fewer cells than the head.
    #[error("{}, and the head has {expected}", counted(*.found, "cell"))]
    Cells {
        /// Cells of the head.
        expected: usize,
        /// Cells of the row.
        found: usize,
    },
    /// A quoted cell does not end.
    #[error("a quoted cell does not end on its line")]
    Quote,
    /// A cell does not hold what its column asks for.
    #[error("{column}: {text:?} is not {expected}")]
    Cell {
        /// The column.
        column: &'static str,
        /// The cell.
        text: String,
        /// What it should be.
        expected: &'static str,
    },
    /// A row without a claim.
    #[error("nothing is claimed: one of the columns verdict, rank, components, sigma is needed")]
    NoClaim,
    /// An error, a matrix or a norm of a value that is not given.
    #[error("sigma_error, matrix and norm say more of sigma, which is missing")]
    NoSigma,
    /// A matrix of another model.
    #[error("matrix: {0} is no matrix of the {1} model")]
    OtherModel(&'static str, Model),
    /// A norm of a matrix that is made of directions.
    #[error("norm: the matrix {0} is made of directions, which have norm 1; leave the norm out")]
    NoNorm(&'static str),
    /// The affine model has no matrix here.
    #[error(
        "sigma: no matrix of the affine model is enclosed; claim verdict, rank or components alone"
    )]
    Affine,
}

impl Matrix {
    /// The model in which it is computed.
    pub fn model(self) -> Model {
        match self {
            Self::Plain | Self::Augmented => Model::Projective,
            Self::Bearing | Self::BearingByLength => Model::Calibrated,
        }
    }

    /// The one that is meant where none is named; nothing in the affine model.
    pub fn usual(model: Model) -> Option<Self> {
        Self::ALL.into_iter().find(|matrix| matrix.model() == model)
    }
}

/// Reads a table: comma-separated values with a head; see [`FloatClaim`] for what its columns say. O(bytes).
///
/// # Errors
/// See [`FloatTableError`]: the table is refused whole.
pub fn read_table(text: &str) -> Result<Vec<FloatClaim>, FloatTableError> {
    let at = |line| move |problem| FloatTableError { line, problem };
    let text = text.trim_start_matches('\u{feff}');
    let lines = csv::lines(text).map_err(|quote| at(quote.line)(FloatProblem::Quote))?;
    let mut lines = lines.into_iter();
    let (number, head) = lines.next().ok_or_else(|| at(1)(FloatProblem::Empty))?;
    let head: Vec<String> = head.iter().map(|cell| cell.trim().to_lowercase()).collect();
    for (k, column) in head.iter().enumerate() {
        if !COLUMNS.contains(&&**column) && !column.starts_with("seconds") {
            return Err(at(number)(FloatProblem::Column(column.clone())));
        }
        if head[..k].contains(column) {
            return Err(at(number)(FloatProblem::Twice(column.clone())));
        }
    }
    let mut claims = Vec::new();
    for (line, cells) in lines {
        if cells.len() != head.len() {
            let (expected, found) = (head.len(), cells.len());
            return Err(at(line)(FloatProblem::Cells { expected, found }));
        }
        let cells: Vec<&str> = cells.iter().map(str::trim).collect();
        let cell = |name: &str| {
            let at = head.iter().position(|column| column == name)?;
            Some(cells[at]).filter(|cell| !cell.is_empty())
        };
        claims.push(claim(line, cell).map_err(at(line))?);
    }
    if claims.is_empty() {
        return Err(at(number)(FloatProblem::Empty));
    }
    Ok(claims)
}

fn claim<'a>(
    line: usize,
    cell: impl Fn(&str) -> Option<&'a str>,
) -> Result<FloatClaim, FloatProblem> {
    let wrong = |column, text: &str, expected| FloatProblem::Cell {
        column,
        text: text.to_owned(),
        expected,
    };
    let model = match cell("model") {
        None => Model::Projective,
        Some(text) => Model::from_str(text)
            .map_err(|_| wrong("model", text, "one of projective, calibrated and affine"))?,
    };
    let determined = match cell("verdict") {
        None => None,
        Some(text) => match &*text.to_lowercase().replace([' ', '_'], "-") {
            "determined" => Some(true),
            "not-determined" => Some(false),
            _ => return Err(wrong("verdict", text, "determined or not-determined")),
        },
    };
    let count = |column| {
        let number = |text: &'a str| {
            let number = text.parse::<usize>();
            number.map_err(|_| wrong(column, text, "a number of things: 0, 1, 2, ..."))
        };
        cell(column).map(number).transpose()
    };
    let size = |column| {
        let number = |text: &'a str| {
            let number = text.parse::<Rational>().ok();
            let number = number.filter(|x| x.numerator().sign() != Ordering::Less);
            let expected = "a decimal or a fraction that is not negative";
            number.ok_or_else(|| wrong(column, text, expected))
        };
        cell(column).map(number).transpose()
    };
    let error = size("sigma_error")?;
    let sigma = match (size("sigma")?, error) {
        (None, None) => None,
        (None, Some(_)) => return Err(FloatProblem::NoSigma),
        (Some(value), Some(error)) => Some([value, error]),
        (Some(value), None) => {
            let text = cell("sigma").unwrap_or_default();
            let unit = last_place(text);
            let expected = "a decimal; with a fraction goes a sigma_error";
            Some([value, unit.ok_or_else(|| wrong("sigma", text, expected))?])
        }
    };
    let matrix = match cell("matrix") {
        None => None,
        Some(text) => {
            let named = Matrix::ALL.into_iter().find(|matrix| matrix.name() == text);
            Some(named.ok_or_else(|| wrong("matrix", text, "one of J_P, J, bearing and R_B"))?)
        }
    };
    let found = FloatClaim {
        line,
        name: cell("name").map(str::to_owned),
        model,
        determined,
        rank: count("rank")?,
        components: count("components")?,
        sigma,
        matrix: matrix.or(Matrix::usual(model)),
        norm: norm(cell("norm"))?,
    };
    match (&found.sigma, found.matrix) {
        (None, _) if matrix.is_some() || found.norm.is_some() => Err(FloatProblem::NoSigma),
        (Some(_), None) => Err(FloatProblem::Affine),
        (_, Some(matrix)) if matrix.model() != model => {
            Err(FloatProblem::OtherModel(matrix.name(), model))
        }
        (_, Some(matrix)) if found.norm.is_some() && model == Model::Calibrated => {
            Err(FloatProblem::NoNorm(matrix.name()))
        }
        (None, _) if found.rank.or(found.components).is_none() && determined.is_none() => {
            Err(FloatProblem::NoClaim)
        }
        _ => Ok(found),
    }
}

/// A norm, in bounds between which integers of 256 bits have room for the frame of J beside it.
fn norm(cell: Option<&str>) -> Result<Option<Rational>, FloatProblem> {
    let number = |text: &str| {
        let bounds = ["0.1", "1e9"].map(str::parse::<Rational>);
        let number = match (text.parse::<Rational>(), bounds) {
            (Ok(x), [Ok(least), Ok(most)]) => {
                Some(x).filter(|x| compare(&least, x).is_le() && compare(x, &most).is_le())
            }
            _ => None,
        };
        number.ok_or_else(|| FloatProblem::Cell {
            column: "norm",
            text: text.to_owned(),
            expected: "a decimal or a fraction from 0.1 to 1e9",
        })
    };
    cell.map(number).transpose()
}

/// One unit of the last digit that is written; nothing for what is no decimal.
fn last_place(text: &str) -> Option<Rational> {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], text[at + 1..].parse::<i64>().ok()?),
        None => (text, 0),
    };
    let behind = mantissa.split_once('.').map_or("", |(_, behind)| behind);
    let is_decimal = mantissa
        .bytes()
        .all(|b| b.is_ascii_digit() || b"+.".contains(&b));
    let places = behind.len() as i64;
    is_decimal.then(|| Rational::scaled(Integer::one(), 10, exponent - places))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(text: &str) -> (usize, FloatProblem) {
        let error = read_table(text).unwrap_err();
        (error.line, error.problem)
    }

    #[test]
    fn rows() {
        let text =
            "Name,rank,verdict,sigma,seconds_svd\nmine,29,Not determined,1.250e-3,7\n\n,,,0.5,\n";
        let claims = read_table(text).unwrap();
        assert_eq!((claims[0].line, claims[1].line), (2, 4));
        assert_eq!(claims[0].name.as_deref(), Some("mine"));
        assert_eq!(
            (claims[0].rank, claims[0].determined),
            (Some(29), Some(false))
        );
        assert_eq!(claims[0].matrix, Some(Matrix::Plain));
        let bounds = |k: usize| claims[k].bounds().unwrap().map(|x| x.to_string());
        assert_eq!(bounds(0), ["1249/1000000", "1251/1000000"]);
        assert_eq!(bounds(1), ["2/5", "3/5"]);
        let text = "model,sigma,sigma_error,matrix\ncalibrated,1/3,0.01,R_B\n";
        let claim = &read_table(text).unwrap()[0];
        assert_eq!(claim.matrix, Some(Matrix::BearingByLength));
    }

    #[test]
    fn what_is_refused_by_line() {
        use FloatProblem as P;
        let cell = |text: &str| match problem(text) {
            (2, P::Cell { column, .. }) => column,
            other => panic!("{other:?}"),
        };
        assert_eq!(problem(""), (1, P::Empty));
        assert_eq!(problem("rank\n"), (1, P::Empty));
        assert_eq!(problem("rank,ranks\n1,2\n"), (1, P::Column("ranks".into())));
        assert_eq!(problem("rank,Rank\n1,2\n"), (1, P::Twice("rank".into())));
        let cells = P::Cells {
            expected: 2,
            found: 1,
        };
        assert_eq!(problem("rank,sigma\n1,2\n1\n"), (3, cells));
        assert_eq!(problem("rank\n\"1\n"), (2, P::Quote));
        assert_eq!(problem("rank,name\n,a\n"), (2, P::NoClaim));
        assert_eq!(problem("rank,norm\n1,10\n"), (2, P::NoSigma));
        assert_eq!(problem("rank,sigma_error\n1,10\n"), (2, P::NoSigma));
        assert_eq!(problem("model,sigma\naffine,1.0\n"), (2, P::Affine));
        let other = P::OtherModel("J", Model::Calibrated);
        assert_eq!(
            problem("model,sigma,matrix\ncalibrated,1.0,J\n"),
            (2, other)
        );
        let no_norm = P::NoNorm("bearing");
        assert_eq!(
            problem("model,sigma,norm\ncalibrated,1.0,2\n"),
            (2, no_norm)
        );
        for (column, bad) in [
            ("rank", "-1"),
            ("rank", "2.0"),
            ("components", "x"),
            ("sigma", "nan"),
            ("sigma", "-1.0"),
            ("sigma", "1/3"),
            ("verdict", "solvable"),
            ("model", "orthographic"),
            ("matrix", "K"),
            ("norm", "0"),
        ] {
            let text = match column {
                "matrix" | "norm" => format!("sigma,{column}\n1.0,{bad}\n"),
                _ => format!("{column}\n{bad}\n"),
            };
            assert_eq!(cell(&text), column);
        }
    }
}

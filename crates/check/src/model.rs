//! The models of section 3 of the specification.

use crate::json::Value;
use serde::de::{Deserializer, Error};
use std::fmt;

/// The cameras: unknown or known intrinsic parameters, or affine ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// Finite or unique solvability from fundamental matrices.
    #[default]
    Projective,
    /// Solvability from essential matrices: parallel rigidity in space.
    Calibrated,
    /// Solvability of affine cameras from their fundamental matrices: rigidity in the plane.
    Affine,
}

impl Model {
    const ALL: [Self; 3] = [Self::Projective, Self::Calibrated, Self::Affine];

    /// That of a name, if it is one.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|model| model.to_string() == name)
    }

    /// Whether finitely many solutions are one (section 6): its equations are linear.
    pub(crate) fn is_linear(self) -> bool {
        self != Self::Projective
    }

    /// Whether it is rigidity in space.
    pub(crate) fn in_space(self) -> bool {
        self == Self::Calibrated
    }

    /// Whether it is rigidity in the plane.
    pub(crate) fn in_plane(self) -> bool {
        self == Self::Affine
    }

    /// The rank at which nodes are solvable up to finitely many solutions (sections 3 and 6).
    pub(crate) fn required(self, nodes: usize) -> i64 {
        match self {
            _ if nodes == 1 => 0,
            Self::Projective => 11 * nodes as i64 - 15,
            Self::Calibrated => 3 * nodes as i64 - 4,
            Self::Affine => 8 * nodes as i64 - 12,
        }
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Projective => "projective",
            Self::Calibrated => "calibrated",
            Self::Affine => "affine",
        })
    }
}

impl Value for Model {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let name = String::read(from)?;
        Self::named(&name).ok_or_else(|| {
            D::Error::custom(format!(
                "`{name}` is not a model: `projective`, `calibrated` or `affine`"
            ))
        })
    }
}

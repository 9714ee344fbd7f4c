//! What has become of matching two images so far.

use crate::OtherPair;
use viewcert_formats::colmap::DEFAULT_MIN_INLIERS;

/// How many inliers a pair needs for both of COLMAP's mappers.
pub const PAIR_NEEDS: u32 = DEFAULT_MIN_INLIERS;

/// How many points that are reconstructed already an image has to see to be registered, in COLMAP's
/// incremental mapping (`abs_pose_min_num_inliers`).
pub const IMAGE_NEEDS: u32 = 30;

/// What has become of matching two images so far; what is most likely to lead on comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tried {
    /// Matched, with enough inliers for a mapper, and left out for another reason: a higher
    /// threshold, or the configuration.
    LeftOut,
    /// Matched, with enough matches, and never verified.
    Unverified,
    /// Not matched, as far as is known.
    Not,
    /// Matched, with some matches or inliers, too few for a mapper.
    Few,
    /// Matched in vain: no match, or none that the verification kept.
    InVain,
    /// Matched and used; what it gives is too little all the same.
    Used,
}

impl Tried {
    /// By what is known of the pair.
    pub fn of(known: Option<&OtherPair>) -> Self {
        let Some(pair) = known else {
            return Self::Not;
        };
        let matches = pair.matches.unwrap_or(0);
        match pair.inliers {
            _ if pair.used => Self::Used,
            inliers if inliers >= PAIR_NEEDS => Self::LeftOut,
            0 if matches >= PAIR_NEEDS && !pair.verified => Self::Unverified,
            0 if matches == 0 || matches >= PAIR_NEEDS => Self::InVain,
            _ => Self::Few,
        }
    }

    /// Whether two images were matched with too little or nothing coming of it.
    pub fn is_failure(self) -> bool {
        matches!(self, Self::Few | Self::InVain)
    }

    /// Whether matching or verifying them is still to be done.
    pub fn is_open(self) -> bool {
        matches!(self, Self::Unverified | Self::Not)
    }

    /// The word for programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::LeftOut => "left-out",
            Self::Unverified => "not-verified",
            Self::Not => "not-tried",
            Self::Few => "few",
            Self::InVain => "in-vain",
            Self::Used => "used",
        }
    }
}

//! Which of the files with tracks an input is, by its beginning.

use super::words;
use crate::model::{self, Encoding, Part};

/// A file with tracks, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TrackFile {
    /// A problem of bundle adjustment in the large.
    Bal,
    /// `bundle.out`.
    Bundler,
    /// A file of VisualSFM.
    Nvm,
    /// Matches of OpenMVG as text.
    OpenMvgMatches,
    /// Matches of AliceVision as text.
    AliceVisionMatches,
    /// `sfm_data.json` of OpenMVG.
    OpenMvg,
    /// `.sfm` of AliceVision.
    AliceVision,
    /// `tracks.csv` of OpenSfM.
    OpenSfm,
    /// A file of COLMAP's model.
    Colmap { part: Part, encoding: Encoding },
}

/// What a model of COLMAP is called in reports.
pub(super) const MODEL: &str = "model of COLMAP";

impl TrackFile {
    /// What it is called in reports.
    pub(super) fn format(self) -> &'static str {
        match self {
            Self::Bal => "bundle adjustment problem (BAL)",
            Self::Bundler => "Bundler file",
            Self::Nvm => "NVM file of VisualSFM",
            Self::OpenMvgMatches => "feature matches (OpenMVG)",
            Self::AliceVisionMatches => "feature matches (AliceVision)",
            Self::OpenMvg => "model of OpenMVG",
            Self::AliceVision => "model of AliceVision",
            Self::OpenSfm => "tracks of OpenSfM",
            Self::Colmap { .. } => MODEL,
        }
    }

    /// What it is called in messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Bal => "a bundle adjustment problem (BAL)",
            Self::Bundler => "a Bundler file",
            Self::Nvm => "an NVM file of VisualSFM",
            Self::OpenMvgMatches => "a file of feature matches (OpenMVG)",
            Self::AliceVisionMatches => "a file of feature matches (AliceVision)",
            Self::OpenMvg => "a model of OpenMVG",
            Self::AliceVision => "a model of AliceVision",
            Self::OpenSfm => "a file of tracks of OpenSfM",
            Self::Colmap { part, encoding } => part.title(encoding),
        }
    }
}

/// Which file begins with `head`, which is all of it if `whole`.
pub(crate) fn kind(head: &[u8], whole: bool) -> Option<TrackFile> {
    if head.contains(&0) {
        let part = model::part(head, whole)?;
        let encoding = Encoding::Binary;
        return Some(TrackFile::Colmap { part, encoding });
    }
    if let Some(file) = by_first_words(head) {
        return Some(file);
    }
    let colmap = |part| {
        let encoding = Encoding::Text;
        Some(TrackFile::Colmap { part, encoding })
    };
    let text = head.trim_ascii_start();
    let lines = words::first_lines(text, whole);
    let lines: Vec<&[&[u8]]> = lines.iter().map(Vec::as_slice).collect();
    let integers = |line: &[&[u8]]| line.iter().all(|word| words::integer(word).is_some());
    let is_below =
        |one, other| words::integer(one) < words::integer(other) && words::integer(one).is_some();
    let numbers = |line: &[&[u8]]| line.iter().all(|word| words::is_number(word));
    match lines[..] {
        [[cameras, points, observations], [camera, point, x, y], ..]
            if is_below(camera, cameras)
                && is_below(point, points)
                && is_below(b"0", observations)
                && numbers(&[x, y]) =>
        {
            Some(TrackFile::Bal)
        }
        [first @ [_, _], [count], third @ [_, _], ..]
            if integers(first) && integers(&[count]) && integers(third) =>
        {
            Some(TrackFile::OpenMvgMatches)
        }
        [first @ [_, _], [count], [kind, matches], ..]
            if integers(first) && integers(&[count, matches]) && is_describer(kind) =>
        {
            Some(TrackFile::AliceVisionMatches)
        }
        [first, ..] if is_point(first) => colmap(Part::Points),
        [[id, model, sizes @ ..], ..]
            if integers(&[id]) && sizes.len() > 3 && numbers(sizes) && is_camera(model) =>
        {
            colmap(Part::Cameras)
        }
        [first, ..]
            if first.len() >= 10
                && !numbers(first)
                && numbers(&first[..9])
                && integers(&[first[0], first[8]]) =>
        {
            colmap(Part::Images)
        }
        _ => None,
    }
}

/// Which file a text is by what stands in its first line.
pub(crate) fn by_first_words(head: &[u8]) -> Option<TrackFile> {
    let encoding = Encoding::Text;
    let colmap = |part| TrackFile::Colmap { part, encoding };
    let text = head.trim_ascii_start();
    let has = |name: &str| {
        text.windows(name.len())
            .any(|window| window == name.as_bytes())
    };
    if text.starts_with(b"{") && has("\"sfm_data_version\"") {
        return Some(TrackFile::OpenMvg);
    }
    if text.starts_with(b"{") && has("\"version\"") && has("\"viewId\"") {
        return Some(TrackFile::AliceVision);
    }
    [
        ("OPENSFM_TRACKS_VERSION_v", TrackFile::OpenSfm),
        ("NVM_V", TrackFile::Nvm),
        ("# Bundle file", TrackFile::Bundler),
        ("# 3D point list", colmap(Part::Points)),
        ("# Image list", colmap(Part::Images)),
        ("# Camera list", colmap(Part::Cameras)),
    ]
    .into_iter()
    .find_map(|(words, file)| text.starts_with(words.as_bytes()).then_some(file))
}

/// Whether this is the name of a model of cameras: capitals, as SIMPLE_RADIAL.
fn is_camera(word: &[u8]) -> bool {
    word.iter().all(|b| b.is_ascii_uppercase() || *b == b'_')
}

/// Whether this may be the name of a describer of AliceVision: small letters, as sift or akaze_ocv.
fn is_describer(word: &[u8]) -> bool {
    word[0].is_ascii_lowercase() && word.iter().all(|b| b.is_ascii_alphanumeric() || *b == b'_')
}

/// Whether this is a line of points3D.txt: a number, three coordinates, a colour, an error, and
/// pairs of numbers.
fn is_point(line: &[&[u8]]) -> bool {
    line.len() >= 10
        && line.len().is_multiple_of(2)
        && line[..8].iter().all(|word| words::is_number(word))
        && words::integer(line[0]).is_some()
        && line[4..7]
            .iter()
            .all(|word| words::integer(word).is_some_and(|value| value < 256))
        && line[8..].iter().all(|word| words::integer(word).is_some())
        && line[1..4].iter().any(|word| word.contains(&b'.'))
}
